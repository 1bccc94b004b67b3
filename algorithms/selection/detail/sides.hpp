// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The sides of open surfaces: which of the parts that a surface divides are on its lower side along an axis.
//
// (1) The triangles of a surface are turned alike across each edge that just two of them share. Of a patch of
//     triangles that are connected so, the upper side is the one that faces up in sum, by exact projected areas. A
//     patch that faces neither way in sum, such as a vertical one, divides without saying which side is which.
// (2) A part, which is a volume of the arrangement or a region of another surface, is on the side that it touches.
// (3) One that does not touch the surface is on its lower side if lines along the axis pass through the surface above
//     the part only, and on its upper side if below the part only. Passages up and down through the same surface cancel
//     out. There is a line for each two triangles, of the part's boundary and of the surface, that overlap as seen
//     along the axis, so that the answer depends neither on the order of triangles nor on how the part is divided. A
//     triangle that is seen as a line counts where lines on both of its sides say the same, and at a volume not at all.
// (4) A part that is on both sides, as the surface ends inside of it, or on none, is an error.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::selection {

/// Sides of a surface, as bits.
enum Sides : std::uint8_t { no_side = 0, low_side = 1, high_side = 2 };

/// A surface with a lower and an upper side, in an arrangement, which must outlive it.
class SidedSurface {
public:
    /// is_of: per surface of the arrangement, whether it is a part of this one.
    SidedSurface(const Arrangement& exact, const std::vector<bool>& is_of, Axis axis);

    /// Whether a triangle is part of the surface.
    [[nodiscard]] bool has(std::size_t triangle) const { return is_of_[triangle]; }
    /// Returns the sides on which the front of a triangle is, or its back. They may be both where the surface
    /// overlaps itself.
    [[nodiscard]] std::uint8_t at_front(std::size_t triangle) const { return front_[triangle]; }
    [[nodiscard]] std::uint8_t at_back(std::size_t triangle) const {
        const unsigned f = front_[triangle];
        return static_cast<std::uint8_t>((f & 1U) << 1U | f >> 1U);
    }
    /// Returns the sides on which other triangles of the arrangement are, by (3). skips_lines: those that are seen as
    /// lines are on none. Cost: that of candidate_pairs().
    [[nodiscard]] std::vector<std::uint8_t> along_lines(const std::vector<std::uint32_t>& triangles,
                                                        bool skips_lines) const;

private:
    void turn_alike();
    void find_upper(const std::vector<std::uint32_t>& patch_of, std::uint32_t patches);
    void mark_fronts();
    [[nodiscard]] std::uint8_t along_lines(std::uint32_t triangle,
                                           std::span<const std::uint32_t> near,
                                           bool skips_lines) const;
    [[nodiscard]] std::uint8_t along_line(const ExactPoint& place,
                                          std::span<const std::uint32_t> near, bool opposite) const;

    const Arrangement& exact_;
    const std::vector<bool>& surfaces_;
    Axis axis_;
    std::vector<std::uint32_t> inputs_; ///< its input triangles that have parts, ascending
    std::vector<int> upper_;            ///< per input triangle: 1 (front), -1 (back), 0 (unknown)
    std::vector<bool> is_of_;           ///< per triangle
    std::vector<std::uint8_t> front_;   ///< per triangle: Sides
};

/// What a surface may divide: volumes, or triangles of another surface.
struct Cells {
    struct Touch {
        std::uint32_t cell, triangle; ///< of the surface
        std::uint8_t sides;
    };
    std::vector<bool> asked; ///< per cell: whether its side is asked for; others are not looked at
    std::vector<std::array<std::uint32_t, 2>> joined; ///< cells of one part
    std::vector<Touch> touches;                       ///< cells at triangles of the surface
    /// {cell, triangle at it that is not of the surface}, all of them.
    std::vector<std::array<std::uint32_t, 2>> others;
    /// Whether they are volumes: lines through these pass through triangles that are not seen as lines.
    bool are_volumes = false;
};

/// How errors name a surface and its sides.
struct SideNames {
    std::string surface, low, high;
};

/// Tells for each cell that is asked for whether it is on the lower side. Errors: not_closed, by (4).
Result<std::vector<bool>> low_cells(const Arrangement& exact, const SidedSurface& surface,
                                    const Cells& cells, const SideNames& names);

} // namespace terrane::selection
