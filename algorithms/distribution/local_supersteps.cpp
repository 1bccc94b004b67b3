// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/distribution/local_supersteps.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>

namespace terrane::distribution {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Error not_written(const std::filesystem::path& path) {
    return {ErrorCode::write_failed, "a file for what does not fit into memory cannot be written",
            path.string()};
}
Error not_read(const std::filesystem::path& path) {
    return {ErrorCode::cannot_open, "a file for what does not fit into memory cannot be read",
            path.string()};
}

/// What precedes the bytes of a message in a file.
struct MessageHead {
    std::uint64_t from = 0, channel = 0, size = 0;
};

bool write_bytes(std::FILE* file, const void* bytes, std::size_t size) {
    return size == 0 || std::fwrite(bytes, 1, size, file) == size;
}

bool read_bytes(std::FILE* file, void* bytes, std::size_t size) {
    return size == 0 || std::fread(bytes, 1, size, file) == size;
}

/// Returns an error if a stop is requested.
Status go_on(const Run& run) {
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    return Done{};
}

/// Gives freed memory back, so that what one block needed does not count when the next one works.
void give_memory_back() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace

LocalSupersteps::LocalSupersteps(LocalOptions options, const Run& run) :
    options_(std::move(options)), run_(run) {
    for (std::uint32_t b = 0; b < options_.blocks; ++b) {
        Block& block = blocks_.emplace_back();
        block.index = b;
        block.count = static_cast<std::uint32_t>(options_.blocks);
    }
    is_saved_.assign(options_.blocks, false);
    if (!spools()) inboxes_.assign(2, std::vector<Inbox>(options_.blocks, Inbox(options_.blocks)));
}

LocalSupersteps::~LocalSupersteps() {
    if (!spools()) return;
    std::error_code ignored;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        std::filesystem::remove(state_file(b), ignored);
        for (const unsigned parity : {0U, 1U})
            std::filesystem::remove(message_file(b, parity), ignored);
    }
}

std::filesystem::path LocalSupersteps::state_file(std::size_t index) const {
    return options_.spool / ("state_" + std::to_string(index));
}

std::filesystem::path LocalSupersteps::message_file(std::size_t index, unsigned parity) const {
    return options_.spool / ("messages_" + std::to_string(parity) + "_" + std::to_string(index));
}

/// Reads a block from its file, unless it was never saved. Who requests a stop may remove the files
/// at once, so that what was read counts only if no stop is requested afterwards.
Status LocalSupersteps::load(std::size_t index) {
    if (!is_saved_[index]) return go_on(run_);
    const auto path = state_file(index);
    const File file(std::fopen(path.c_str(), "rb"));
    bool good = file != nullptr;
    blocks_[index].for_each_array([&](auto& array) {
        std::uint64_t size = 0;
        good = good && read_bytes(file.get(), &size, sizeof size);
        if (!good) return;
        array.resize(size);
        good = read_bytes(file.get(), array.data(), size * sizeof(array[0]));
    });
    if (auto done = go_on(run_); !done) return done;
    if (!good) return not_read(path);
    return Done{};
}

Status LocalSupersteps::save(std::size_t index) {
    if (!spools()) return Done{};
    const auto path = state_file(index);
    File file(std::fopen(path.c_str(), "wb"));
    if (!file) return not_written(path);
    bool good = true;
    blocks_[index].for_each_array([&](auto& array) {
        const std::uint64_t size = array.size();
        good = good && write_bytes(file.get(), &size, sizeof size) &&
               write_bytes(file.get(), array.data(), size * sizeof(array[0]));
        release(array);
    });
    good = std::fclose(file.release()) == 0 && good;
    if (!good) return not_written(path);
    is_saved_[index] = true;
    return Done{};
}

Status LocalSupersteps::take_messages(std::size_t index, Inbox& in) {
    if (!spools()) {
        std::swap(in, inboxes_[parity_][index]);
        return Done{};
    }
    const auto path = message_file(index, parity_);
    {
        const File file(std::fopen(path.c_str(), "rb"));
        if (!file) return Done{}; // no block sent anything
        for (MessageHead head; read_bytes(file.get(), &head, sizeof head);) {
            Bytes& bytes = in.bytes(head.from, head.channel);
            bytes.resize(head.size);
            if (!read_bytes(file.get(), bytes.data(), head.size)) return not_read(path);
        }
    }
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return Done{};
}

Status LocalSupersteps::deliver(std::size_t index, Outbox& out) {
    for (std::size_t to = 0; to < blocks(); ++to) {
        std::size_t size = 0;
        for (std::size_t c = 0; c < channels; ++c) size += out.bytes(to, c).size();
        if (size == 0) continue;
        if (to != index) {
            ++blocks_[index].work.messages;
            blocks_[index].work.bytes += size;
        }
        if (!spools()) {
            for (std::size_t c = 0; c < channels; ++c)
                inboxes_[1 - parity_][to].bytes(index, c) = std::move(out.bytes(to, c));
            continue;
        }
        const auto path = message_file(to, 1 - parity_);
        File file(std::fopen(path.c_str(), "ab"));
        if (!file) return not_written(path);
        bool good = true;
        for (std::size_t c = 0; c < channels; ++c) {
            const Bytes bytes = std::exchange(out.bytes(to, c), {});
            if (bytes.empty()) continue;
            const MessageHead head{index, c, bytes.size()};
            good = good && write_bytes(file.get(), &head, sizeof head) &&
                   write_bytes(file.get(), bytes.data(), bytes.size());
        }
        good = std::fclose(file.release()) == 0 && good;
        if (!good) return not_written(path);
    }
    return Done{};
}

Status LocalSupersteps::step_of(std::size_t index, const Step& work) {
    return guarded("for a block of the arrangement", "arrange", [&]() -> Status {
        if (auto done = load(index); !done) return done;
        Inbox in(blocks());
        Outbox out(blocks());
        if (auto done = take_messages(index, in); !done) return done;
        if (auto done = go_on(run_); !done) return done; // else messages may be missing
        Block& block = blocks_[index];
        const std::size_t before = block.size() + in.size();
        if (auto done = work(block, in, out); !done) return done;
        const std::size_t after = block.size() + out.size();
        block.work.memory = std::max<std::uint64_t>(block.work.memory, std::max(before, after));
        in = Inbox(0);
        if (auto done = deliver(index, out); !done) return done;
        return save(index);
    });
}

Status LocalSupersteps::step(std::string_view, const Step& work) {
    std::vector<Status> done(blocks(), Done{});
    if (spools() || run_.threads <= 1) {
        for (std::size_t b = 0; b < blocks(); ++b)
            if (done[b] = step_of(b, work); !done[b]) return done[b];
        if (spools()) give_memory_back();
    } else {
        with_threads(run_, [&] {
            for_each_index(blocks(), [&](std::size_t b) { done[b] = step_of(b, work); });
        });
    }
    parity_ = 1 - parity_;
    for (const Status& status : done)
        if (!status) return status;
    return Done{};
}

Result<Bytes> LocalSupersteps::relay(const Turn& turn) {
    Bytes passed;
    for (std::size_t b = 0; b < blocks(); ++b) {
        if (auto done = load(b); !done) return done.error();
        passed = turn(blocks_[b], std::move(passed));
        if (auto done = save(b); !done) return done.error();
    }
    return passed;
}

Status LocalSupersteps::visit(const std::function<Status(Block&)>& visit) {
    for (std::size_t b = 0; b < blocks(); ++b) {
        if (auto done = load(b); !done) return done;
        if (auto done = visit(blocks_[b]); !done) return done;
        if (auto done = save(b); !done) return done;
    }
    return Done{};
}

} // namespace terrane::distribution
