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

using namespace tiles;

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
    tile_.index = static_cast<std::uint32_t>(rank);
    tile_.count = static_cast<std::uint32_t>(size);
    inbox_ = Inbox(count_);
}

Status MpiSupersteps::step(std::string_view, const Step& work) {
    Outbox out(count_);
    std::size_t before = 0;
    const Status own = guarded("for a tile of the arrangement", "arrange", [&]() -> Status {
        if (run_.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        before = tile_.size() + inbox_.size();
        return work(tile_, inbox_, out);
    });
    if (auto all = agreed(own); !all) return all;
    tile_.work.memory =
        std::max<std::uint64_t>(tile_.work.memory, std::max(before, tile_.size() + out.size()));
    return exchange(out);
}

Status MpiSupersteps::exchange(Outbox& out) {
    using Sizes = std::array<std::uint64_t, channels>;
    std::vector<Sizes> sending(count_), receiving(count_);
    for (std::size_t b = 0; b < count_; ++b) {
        std::uint64_t sum = 0;
        for (std::size_t c = 0; c < channels; ++c) sum += sending[b][c] = out.bytes(b, c).size();
        if (sum == 0 || b == tile_.index) continue;
        ++tile_.work.messages;
        tile_.work.bytes += sum;
    }
    MPI_Alltoall(sending.data(), channels, MPI_UINT64_T, receiving.data(), channels, MPI_UINT64_T,
                 MPI_COMM_WORLD);
    const Status room = guarded("for the messages of other tiles", "arrange", [&]() -> Status {
        inbox_ = Inbox(count_);
        for (std::size_t b = 0; b < count_; ++b)
            for (std::size_t c = 0; c < channels; ++c)
                if (b == tile_.index)
                    inbox_.bytes(b, c) = std::move(out.bytes(b, c));
                else
                    inbox_.bytes(b, c).resize(receiving[b][c]);
        return Done{};
    });
    if (auto all = agreed(room); !all) return all;
    std::vector<MPI_Request> requests;
    for (std::size_t b = 0; b < count_; ++b) {
        if (b == tile_.index) continue;
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
    const int rank = as_int(tile_.index), last = as_int(count_) - 1;
    if (rank > 0) {
        std::uint64_t size = 0;
        MPI_Recv(&size, 1, MPI_UINT64_T, rank - 1, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        bytes.resize(size);
        MPI_Recv(bytes.data(), as_int(size), MPI_BYTE, rank - 1, tag, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
    }
    bytes = turn(tile_, std::move(bytes));
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

Status MpiSupersteps::visit(const std::function<Status(Tile&)>& visit) {
    return agreed(
        guarded("for a tile of the arrangement", "arrange", [&] { return visit(tile_); }));
}

} // namespace terrane::cli
