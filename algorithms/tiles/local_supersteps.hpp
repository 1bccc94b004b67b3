// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs all tiles in this process: several at a time in memory, or one after the other, with states and
// messages on the disk meanwhile, in files without names, so that nothing is left of them.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/tiles/supersteps.hpp>

namespace terrane::tiles {

/// Options of LocalSupersteps.
struct LocalOptions {
    std::size_t tiles = 1;
    std::filesystem::path
        spool{}; ///< folder on whose disk states and messages are; empty: they stay in
                 ///< memory
};

/// All tiles in one process. With a spool only one tile is in memory at a time, with its messages.
/// Errors: those of the work, out_of_memory, cannot_open (no file can be made in the folder), write_failed
/// (the disk is full).
class LocalSupersteps final : public Supersteps {
public:
    LocalSupersteps(const LocalOptions& options, const Run& run);
    ~LocalSupersteps() override;

    [[nodiscard]] std::size_t tiles() const override { return tiles_.size(); }
    Status step(std::string_view name, const Step& work) override;
    Result<Bytes> relay(const Turn& turn) override;
    Status visit(const std::function<Status(Tile&)>& visit) override;

private:
    struct Spool;

    Status step_of(std::size_t index, const Step& work);
    Status load(std::size_t index);
    Status save(std::size_t index);
    Status take_messages(std::size_t index, Inbox& in);
    Status deliver(std::size_t index, Outbox& out);

    const Run& run_;
    unsigned parity_ = 0;
    std::vector<Tile> tiles_;
    std::vector<std::vector<Inbox>> inboxes_; ///< by parity, then by tile; without a spool
    Status ready_ = Done{};
    std::unique_ptr<Spool> spool_; ///< null: without a spool, or it is not ready
};

} // namespace terrane::tiles
