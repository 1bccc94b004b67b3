// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs one tile per process and exchanges messages by MPI.
#pragma once

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/tiles/supersteps.hpp>

namespace terrane::cli {

/// The tile of this process, whose rank is the number of the tile. MPI must be initialised. Only
/// collective calls and messages between pairs of ranks are used.
class MpiSupersteps final : public tiles::Supersteps {
public:
    explicit MpiSupersteps(const Run& run);

    [[nodiscard]] std::size_t tiles() const override { return count_; }
    Status step(std::string_view name, const tiles::Step& work) override;
    Result<tiles::Bytes> relay(const tiles::Turn& turn) override;
    Status visit(const std::function<Status(tiles::Tile&)>& visit) override;

    [[nodiscard]] bool is_first() const { return tile_.index == 0; }

private:
    Status exchange(tiles::Outbox& out);

    const Run& run_;
    std::size_t count_ = 1;
    tiles::Tile tile_;
    tiles::Inbox inbox_;
};

} // namespace terrane::cli
