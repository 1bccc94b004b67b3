// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs all blocks in this process: several at a time in memory, or one after the other, with states and
// messages in files meanwhile.
#pragma once

#include <filesystem>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/distribution/supersteps.hpp>

namespace terrane::distribution {

/// Options of LocalSupersteps.
struct LocalOptions {
    std::size_t blocks = 1;
    std::filesystem::path spool{}; ///< folder for states and messages; empty: they stay in memory
};

/// All blocks in one process. With a spool only one block is in memory at a time, with its messages.
/// Errors of step(): those of the work, out_of_memory, write_failed (the disk is full).
class LocalSupersteps final : public Supersteps {
public:
    LocalSupersteps(LocalOptions options, const Run& run);
    ~LocalSupersteps() override;

    [[nodiscard]] std::size_t blocks() const override { return options_.blocks; }
    Status step(std::string_view name, const Step& work) override;
    Result<Bytes> relay(const Turn& turn) override;
    Status visit(const std::function<Status(Block&)>& visit) override;

private:
    Status step_of(std::size_t index, const Step& work);
    Status load(std::size_t index);
    Status save(std::size_t index);
    Status take_messages(std::size_t index, Inbox& in);
    Status deliver(std::size_t index, Outbox& out);
    [[nodiscard]] std::filesystem::path state_file(std::size_t index) const;
    [[nodiscard]] std::filesystem::path message_file(std::size_t index, unsigned parity) const;
    [[nodiscard]] bool spools() const { return !options_.spool.empty(); }

    LocalOptions options_;
    const Run& run_;
    unsigned parity_ = 0;
    std::vector<Block> blocks_;
    std::vector<bool> is_saved_;              ///< per block; never without a spool
    std::vector<std::vector<Inbox>> inboxes_; ///< by parity, then by block; without a spool
};

} // namespace terrane::distribution
