// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/mpi/mpi_supersteps.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <mpi.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/cli/mpi/agreement.hpp>

namespace terrane::cli {

using namespace distribution;

namespace {

/// MPI counts in int, so long messages go in several.
constexpr std::size_t longest = std::size_t{1} << 30;

int as_int(std::size_t n) {
    return static_cast<int>(n);
}

/// Calls `transfer(at, size, tag)` for parts of bytes that MPI can count.
template <class Transfer>
void in_parts(Bytes& bytes, int channel, const Transfer& transfer) {
    for (std::size_t at = 0; at < bytes.size(); at += longest)
        transfer(bytes.data() + at, as_int(std::min(longest, bytes.size() - at)), channel);
}

} // namespace

MpiSupersteps::MpiSupersteps(const Run& run) : run_(run), inbox_(0) {
    int rank = 0, size = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    count_ = static_cast<std::size_t>(size);
    block_.index = static_cast<std::uint32_t>(rank);
    block_.count = static_cast<std::uint32_t>(size);
    inbox_ = Inbox(count_);
}

Status MpiSupersteps::step(std::string_view, const Step& work) {
    Outbox out(count_);
    std::size_t before = 0;
    const Status own = guarded("for a block of the arrangement", "arrange", [&]() -> Status {
        if (run_.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        before = block_.size() + inbox_.size();
        return work(block_, inbox_, out);
    });
    if (auto all = agreed(own); !all) return all;
    block_.work.memory =
        std::max<std::uint64_t>(block_.work.memory, std::max(before, block_.size() + out.size()));
    return exchange(out);
}

Status MpiSupersteps::exchange(Outbox& out) {
    using Sizes = std::array<std::uint64_t, channels>;
    std::vector<Sizes> sending(count_), receiving(count_);
    for (std::size_t b = 0; b < count_; ++b) {
        std::uint64_t sum = 0;
        for (std::size_t c = 0; c < channels; ++c) sum += sending[b][c] = out.bytes(b, c).size();
        if (sum == 0 || b == block_.index) continue;
        ++block_.work.messages;
        block_.work.bytes += sum;
    }
    MPI_Alltoall(sending.data(), channels, MPI_UINT64_T, receiving.data(), channels, MPI_UINT64_T,
                 MPI_COMM_WORLD);
    const Status room = guarded("for the messages of other blocks", "arrange", [&]() -> Status {
        inbox_ = Inbox(count_);
        for (std::size_t b = 0; b < count_; ++b)
            for (std::size_t c = 0; c < channels; ++c)
                if (b == block_.index)
                    inbox_.bytes(b, c) = std::move(out.bytes(b, c));
                else
                    inbox_.bytes(b, c).resize(receiving[b][c]);
        return Done{};
    });
    if (auto all = agreed(room); !all) return all;
    std::vector<MPI_Request> requests;
    for (std::size_t b = 0; b < count_; ++b) {
        if (b == block_.index) continue;
        for (int c = 0; c < as_int(channels); ++c) {
            in_parts(inbox_.bytes(b, static_cast<std::size_t>(c)), c,
                     [&](void* at, int size, int tag) {
                         MPI_Irecv(at, size, MPI_BYTE, as_int(b), tag, MPI_COMM_WORLD,
                                   &requests.emplace_back());
                     });
            in_parts(out.bytes(b, static_cast<std::size_t>(c)), c,
                     [&](const void* at, int size, int tag) {
                         MPI_Isend(at, size, MPI_BYTE, as_int(b), tag, MPI_COMM_WORLD,
                                   &requests.emplace_back());
                     });
        }
    }
    MPI_Waitall(as_int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return Done{};
}

Result<Bytes> MpiSupersteps::relay(const Turn& turn) {
    constexpr int tag = 100;
    Bytes bytes;
    const int rank = as_int(block_.index), last = as_int(count_) - 1;
    if (rank > 0) {
        std::uint64_t size = 0;
        MPI_Recv(&size, 1, MPI_UINT64_T, rank - 1, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        bytes.resize(size);
        MPI_Recv(bytes.data(), as_int(size), MPI_BYTE, rank - 1, tag, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
    }
    bytes = turn(block_, std::move(bytes));
    std::uint64_t size = bytes.size();
    if (rank < last) {
        MPI_Send(&size, 1, MPI_UINT64_T, rank + 1, tag, MPI_COMM_WORLD);
        MPI_Send(bytes.data(), as_int(size), MPI_BYTE, rank + 1, tag, MPI_COMM_WORLD);
    }
    MPI_Bcast(&size, 1, MPI_UINT64_T, last, MPI_COMM_WORLD);
    bytes.resize(size);
    MPI_Bcast(bytes.data(), as_int(size), MPI_BYTE, last, MPI_COMM_WORLD);
    return bytes;
}

Status MpiSupersteps::visit(const std::function<Status(Block&)>& visit) {
    return agreed(
        guarded("for a block of the arrangement", "arrange", [&] { return visit(block_); }));
}

} // namespace terrane::cli
