// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Decides in which order an input is moved and rounded again: to the decimals that it stands for, into a
// frame in which nearly coplanar clusters are coplanar, and to grids.
#pragma once

#include <optional>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/rounding/detail/cluster_frame.hpp>
#include <terrane/algorithms/rounding/detail/decimal_frame.hpp>
#include <terrane/algorithms/rounding/detail/snapped_input.hpp>

namespace terrane::rounding::detail {

/// The outcome of an attempt.
enum class Attempted {
    conforming, ///< within the limit
    in_contact, ///< triangles meet improperly, or surfaces moved too far
    torn        ///< a boundary was not closed; coarser grids would not do either
};

/// An input that can be moved, in one process or in tiles. Frames and grids are for the corners
/// of the triangles that are chosen: at first those in contact after the rounding where it lies.
class MovableInput {
public:
    MovableInput() = default;
    MovableInput(const MovableInput&) = delete;
    MovableInput& operator=(const MovableInput&) = delete;
    virtual ~MovableInput() = default;

    /// Return a frame, or nothing if none can be used.
    virtual Result<std::optional<DecimalFrame>> decimal_frame() = 0;
    virtual Result<std::optional<ClusterFrame>> cluster_frame() = 0;
    /// See grid_of_digits().
    [[nodiscard]] virtual std::optional<SnapGrid> grid(int digits, double limit) const = 0;

    /// Arrange and round the input as the chosen corners say.
    virtual Result<Attempted> attempt(const DecimalFrame& frame) = 0;
    virtual Result<Attempted> attempt(const ClusterFrame& frame) = 0;
    virtual Result<Attempted> attempt(const SnapGrid& grid) = 0;
    /// Chooses the corners of all triangles in contact after the last attempt, too. Returns false
    /// if all of them had been chosen before.
    virtual Result<bool> choose_more() = 0;
};

/// Moves an input until its rounding is conforming, in at most `most` attempts. Surfaces may move as far
/// as `limit`. Returns whether the last attempt is conforming.
Result<bool> attempt_moves(MovableInput& input, double limit, unsigned most);

} // namespace terrane::rounding::detail
