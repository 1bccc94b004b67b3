// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/local_supersteps.hpp>

#include <array>
#include <memory>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/tiles/detail/unnamed_file.hpp>

namespace terrane::tiles {

using detail::FreeSpace;
using detail::UnnamedFile;

namespace {

constexpr std::uint64_t nowhere = UINT64_MAX;

/// The head before the bytes of a message in a file.
struct MessageHead {
    std::uint64_t from = 0, channel = 0, size = 0;
    std::uint64_t before = nowhere; ///< where the message before to the same tile is
};

/// Where the state of a tile is.
struct SavedState {
    std::uint64_t at = 0, size = 0; ///< size 0: it was never saved
};

/// Returns an error if a stop is requested.
Status go_on(const Run& run) {
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    return Done{};
}

/// Gives freed memory back, so that what one tile needed does not count when the next one works.
void give_memory_back() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace

/// States and messages on the disk.
struct LocalSupersteps::Spool {
    /// The messages of one parity: all are read in a step, in which none is added.
    struct Messages {
        UnnamedFile file;
        std::vector<std::uint64_t> last; ///< per tile: where its last one is
        std::uint64_t end = 0;

        Messages(UnnamedFile made, std::size_t tiles) :
            file(std::move(made)), last(tiles, nowhere) {}

        [[nodiscard]] bool add(std::size_t to, std::size_t from, std::size_t channel,
                               const Bytes& bytes) {
            const MessageHead head{from, channel, bytes.size(), last[to]};
            last[to] = end;
            return file.write(&head, sizeof head, end) &&
                   file.write(bytes.data(), bytes.size(), end);
        }
        [[nodiscard]] bool take(std::size_t to, Inbox& in) const {
            for (std::uint64_t at = last[to]; at != nowhere;) {
                MessageHead head;
                if (!file.read(&head, sizeof head, at)) return false;
                Bytes& bytes = in.bytes(head.from, head.channel);
                bytes.resize(head.size);
                if (!file.read(bytes.data(), bytes.size(), at)) return false;
                at = head.before;
            }
            return true;
        }
        [[nodiscard]] bool clear() {
            end = 0;
            last.assign(last.size(), nowhere);
            return file.clear();
        }
    };

    std::filesystem::path folder;
    UnnamedFile states;
    FreeSpace free;                   ///< of `states`
    std::vector<SavedState> saved;    ///< per tile
    std::array<Messages, 2> messages; ///< by parity

    [[nodiscard]] Error not_written() const {
        return {ErrorCode::write_failed,
                "what does not fit into memory cannot be written to the disk", folder.string()};
    }
    [[nodiscard]] Error not_read() const {
        return {ErrorCode::cannot_open,
                "what does not fit into memory cannot be read from the disk", folder.string()};
    }

    static Result<std::unique_ptr<Spool>> create(const LocalOptions& options);
    [[nodiscard]] bool load(std::size_t index, Tile& tile) const;
    [[nodiscard]] bool save(std::size_t index, Tile& tile);
};

Result<std::unique_ptr<LocalSupersteps::Spool>>
LocalSupersteps::Spool::create(const LocalOptions& options) {
    auto states = UnnamedFile::create(options.spool), even = UnnamedFile::create(options.spool),
         odd = UnnamedFile::create(options.spool);
    for (const auto* made : {&states, &even, &odd})
        if (!*made) return made->error();
    return std::make_unique<Spool>(Spool{
        options.spool,
        std::move(*states),
        {},
        std::vector<SavedState>(options.tiles),
        {Messages(std::move(*even), options.tiles), Messages(std::move(*odd), options.tiles)}});
}

bool LocalSupersteps::Spool::load(std::size_t index, Tile& tile) const {
    if (saved[index].size == 0) return true;
    std::uint64_t at = saved[index].at;
    bool good = true;
    tile.for_each_array([&](auto& array) {
        std::uint64_t size = 0;
        good = good && states.read(&size, sizeof size, at);
        if (!good) return;
        array.resize(size);
        good = states.read(array.data(), size * sizeof(array[0]), at);
    });
    return good;
}

bool LocalSupersteps::Spool::save(std::size_t index, Tile& tile) {
    SavedState& state = saved[index];
    free.give_back(state.at, state.size);
    state.size = tile.size();
    tile.for_each_array([&](const auto&) { state.size += sizeof(std::uint64_t); });
    std::uint64_t at = state.at = free.take(state.size);
    bool good = true;
    tile.for_each_array([&](auto& array) {
        const std::uint64_t size = array.size();
        good = good && states.write(&size, sizeof size, at) &&
               states.write(array.data(), size * sizeof(array[0]), at);
        release(array);
    });
    return good;
}

LocalSupersteps::LocalSupersteps(const LocalOptions& options, const Run& run) : run_(run) {
    for (std::uint32_t b = 0; b < options.tiles; ++b) {
        Tile& tile = tiles_.emplace_back();
        tile.index = b;
        tile.count = static_cast<std::uint32_t>(options.tiles);
    }
    if (options.spool.empty()) {
        inboxes_.assign(2, std::vector<Inbox>(options.tiles, Inbox(options.tiles)));
        return;
    }
    auto spool = Spool::create(options);
    if (spool)
        spool_ = std::move(*spool);
    else
        ready_ = spool.error();
}

LocalSupersteps::~LocalSupersteps() = default;

/// Reads a tile from the disk, unless it was never saved.
Status LocalSupersteps::load(std::size_t index) {
    if (!ready_) return ready_;
    if (auto done = go_on(run_); !done) return done;
    if (spool_ && !spool_->load(index, tiles_[index])) return spool_->not_read();
    return Done{};
}

Status LocalSupersteps::save(std::size_t index) {
    if (spool_ && !spool_->save(index, tiles_[index])) return spool_->not_written();
    return Done{};
}

Status LocalSupersteps::take_messages(std::size_t index, Inbox& in) {
    if (!spool_)
        std::swap(in, inboxes_[parity_][index]);
    else if (!spool_->messages[parity_].take(index, in))
        return spool_->not_read();
    return Done{};
}

Status LocalSupersteps::deliver(std::size_t index, Outbox& out) {
    for (std::size_t to = 0; to < tiles(); ++to) {
        std::size_t size = 0;
        for (std::size_t c = 0; c < channels; ++c) size += out.bytes(to, c).size();
        if (size == 0) continue;
        if (to != index) {
            ++tiles_[index].work.messages;
            tiles_[index].work.bytes += size;
        }
        for (std::size_t c = 0; c < channels; ++c) {
            Bytes bytes = std::exchange(out.bytes(to, c), {});
            if (!spool_)
                inboxes_[1 - parity_][to].bytes(index, c) = std::move(bytes);
            else if (!bytes.empty() && !spool_->messages[1 - parity_].add(to, index, c, bytes))
                return spool_->not_written();
        }
    }
    return Done{};
}

Status LocalSupersteps::step_of(std::size_t index, const Step& work) {
    return guarded("for a tile of the arrangement", "arrange", [&]() -> Status {
        if (auto done = load(index); !done) return done;
        Inbox in(tiles());
        Outbox out(tiles());
        if (auto done = take_messages(index, in); !done) return done;
        Tile& tile = tiles_[index];
        const std::size_t before = tile.size() + in.size();
        if (auto done = work(tile, in, out); !done) return done;
        const std::size_t after = tile.size() + out.size();
        tile.work.memory = std::max<std::uint64_t>(tile.work.memory, std::max(before, after));
        in = Inbox(0);
        if (auto done = deliver(index, out); !done) return done;
        return save(index);
    });
}

Status LocalSupersteps::step(std::string_view, const Step& work) {
    std::vector<Status> done(tiles(), Done{});
    if (spool_ || run_.threads <= 1) {
        for (std::size_t b = 0; b < tiles(); ++b)
            if (done[b] = step_of(b, work); !done[b]) return done[b];
        if (spool_ && !spool_->messages[parity_].clear()) return spool_->not_written();
        if (spool_) give_memory_back();
    } else {
        with_threads(run_, [&] {
            for_each_index(tiles(), [&](std::size_t b) { done[b] = step_of(b, work); });
        });
    }
    parity_ = 1 - parity_;
    for (const Status& status : done)
        if (!status) return status;
    return Done{};
}

Result<Bytes> LocalSupersteps::relay(const Turn& turn) {
    Bytes passed;
    for (std::size_t b = 0; b < tiles(); ++b) {
        if (auto done = load(b); !done) return done.error();
        passed = turn(tiles_[b], std::move(passed));
        if (auto done = save(b); !done) return done.error();
    }
    return passed;
}

Status LocalSupersteps::visit(const std::function<Status(Tile&)>& visit) {
    for (std::size_t b = 0; b < tiles(); ++b) {
        if (auto done = load(b); !done) return done;
        if (auto done = visit(tiles_[b]); !done) return done;
        if (auto done = save(b); !done) return done;
    }
    return Done{};
}

} // namespace terrane::tiles
