// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces as structured grids of VTK: a point for each (i, j, k), of which one axis has a single point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

/// Numbers of points along the two axes of a surface, the faster first.
using StructuredSize = std::array<std::size_t, 2>;

inline constexpr auto structured_volume =
    "the structured grid is a volume; a surface has one point along i, j or k, and ParaView's "
    "Extract Subset cuts one out";

/// Returns the size of a surface by the numbers of points along i, j and k; nothing for a volume.
inline std::optional<StructuredSize> structured_surface(const std::array<std::size_t, 3>& points) {
    const auto flat = std::ranges::find(points, std::size_t{1});
    if (flat == points.end()) return std::nullopt;
    if (flat == points.begin()) return StructuredSize{points[1], points[2]};
    return StructuredSize{points[0], points[flat == points.begin() + 1 ? 2 : 1]};
}

/// Returns whether a surface of this size has this number of points.
inline bool is_of(const StructuredSize& size, std::size_t points) {
    return size[0] != 0 && points % size[0] == 0 && points / size[0] == size[1];
}

/// Reads the numbers of points along i, j and k from an extent, "0 4 0 2 0 0". Fails where their product is not
/// `points`.
inline std::optional<std::array<std::size_t, 3>> points_of_extent(std::string_view extent,
                                                                  std::size_t points) {
    std::array<std::size_t, 3> counts{};
    Tokens tokens(extent);
    std::size_t product = 1;
    for (std::size_t& count : counts) {
        std::int64_t from = 0, to = 0;
        if (!parse_integer(tokens.next(), from) || !parse_integer(tokens.next(), to) ||
            from < INT32_MIN || to > INT32_MAX || to < from)
            return std::nullopt;
        count = static_cast<std::size_t>(to - from + 1);
        if (count > points / product) return std::nullopt;
        product *= count;
    }
    return product == points ? std::optional(counts) : std::nullopt;
}

/// What vtkGhostType hides, by point and by cell; an array that is too short hides no more.
struct HiddenParts {
    std::vector<std::int64_t> points, cells;

    [[nodiscard]] bool hide_point(std::size_t p) const {
        return p < points.size() && (points[p] & 2) != 0;
    }
    [[nodiscard]] bool hide_cell(std::size_t c) const {
        return c < cells.size() && (cells[c] & 32) != 0;
    }
};

/// Returns the number of cells of a surface.
inline std::size_t cells_of(const StructuredSize& size) {
    return size[0] < 2 || size[1] < 2 ? 0 : (size[0] - 1) * (size[1] - 1);
}

/// Appends the cells of a surface, whose points and cells are counted from `first` and `first_cell`, without those that
/// have a hidden corner or are hidden.
inline void append_structured(const StructuredSize& size, std::size_t first, std::size_t first_cell,
                              const HiddenParts& hidden, FilePart& part) {
    for (std::size_t j = 0, cell = 0; j + 1 < size[1]; ++j)
        for (std::size_t i = 0; i + 1 < size[0]; ++i, ++cell) {
            const std::size_t a = j * size[0] + i, d = a + size[0];
            const std::array corners{a, a + 1, d + 1, d};
            if (hidden.hide_cell(cell) ||
                std::ranges::any_of(corners, [&](std::size_t p) { return hidden.hide_point(p); }))
                continue;
            std::array<std::uint32_t, 4> face{};
            std::ranges::transform(corners, face.begin(), [&](std::size_t p) {
                return static_cast<std::uint32_t>(first + p);
            });
            append_face(face, part, static_cast<std::uint32_t>(first_cell + cell));
        }
}

} // namespace terrane::detail
