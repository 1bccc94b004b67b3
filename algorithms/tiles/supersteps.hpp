// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs a computation that is divided into tiles as a sequence of steps (Valiant, A bridging model for
// parallel computation, 1990). In a step each tile works on its own state and on the messages that
// the others sent to it in the step before, and sends messages for the next one.
// So the same steps run as processes that exchange messages (MPI), as threads, and one tile after
// the other with its state on disk. None of these can change what a step computes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/tiles/messages.hpp>
#include <terrane/algorithms/tiles/tile.hpp>

namespace terrane::tiles {

/// The work of one tile in one step.
using Step = std::function<Status(Tile&, Inbox&, Outbox&)>;
/// The turn of one tile in a relay: it receives bytes from the tile before and returns those for
/// the next one.
using Turn = std::function<Bytes(Tile&, Bytes)>;

/// The tiles of a computation, of which this process has some or all.
class Supersteps {
public:
    Supersteps() = default;
    Supersteps(const Supersteps&) = delete;
    Supersteps& operator=(const Supersteps&) = delete;
    virtual ~Supersteps() = default;

    /// Returns the number of tiles in all processes.
    [[nodiscard]] virtual std::size_t tiles() const = 0;
    /// Performs one step of all tiles and exchanges their messages. Returns the error of the first tile
    /// that has one, in all processes.
    virtual Status step(std::string_view name, const Step& work) = 0;
    /// Gives each tile its turn, in order, and returns what the last one returned, in all
    /// processes. It does not touch the messages.
    virtual Result<Bytes> relay(const Turn& turn) = 0;
    /// Calls visit for each tile of this process, in order.
    virtual Status visit(const std::function<Status(Tile&)>& visit) = 0;
};

} // namespace terrane::tiles
