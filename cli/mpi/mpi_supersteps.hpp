// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs one block per process and exchanges messages by MPI.
#pragma once

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/distribution/supersteps.hpp>

namespace terrane::cli {

/// The block of this process, whose rank is the number of the block. MPI must be initialised. Only
/// collective calls and messages between pairs of ranks are used.
class MpiSupersteps final : public distribution::Supersteps {
public:
    explicit MpiSupersteps(const Run& run);

    [[nodiscard]] std::size_t blocks() const override { return count_; }
    Status step(std::string_view name, const distribution::Step& work) override;
    Result<distribution::Bytes> relay(const distribution::Turn& turn) override;
    Status visit(const std::function<Status(distribution::Block&)>& visit) override;

    [[nodiscard]] bool is_first() const { return block_.index == 0; }

private:
    Status exchange(distribution::Outbox& out);

    const Run& run_;
    std::size_t count_ = 1;
    distribution::Block block_;
    distribution::Inbox inbox_;
};

} // namespace terrane::cli
