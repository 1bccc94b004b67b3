// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/cells/detail/cell_pieces.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

#include <tbb/parallel_sort.h>

#include <terrane/algorithms/core/parallel.hpp>

namespace terrane::cells::detail {
namespace {

using Planes = std::vector<double>;

/// A range of slabs between the planes across an axis.
struct Slabs {
    std::size_t first = 0, last = 0;
};

/// Finds the pieces of triangles, one after the other.
class PieceFinder {
public:
    PieceFinder(const RectilinearGrid& grid, std::vector<CellPiece>& out) :
        grid_(grid), places_(grid), out_(out) {}

    void add(std::uint32_t number, const std::array<Point3, 3>& corners) {
        if (is_beside(corners)) return;
        number_ = number;
        const CutTriangle triangle(corners);
        for_slabs(TrianglePart(triangle), 0, [&](std::size_t i, const TrianglePart& slice) {
            for_slabs(slice, 1, [&](std::size_t j, const TrianglePart& in_column) {
                add_column(j * places_.nx + i, in_column);
            });
        });
    }

private:
    [[nodiscard]] const Planes& planes(std::size_t axis) const {
        return axis == 0 ? grid_.x : axis == 1 ? grid_.y : grid_.z;
    }

    /// Tells whether a triangle is beside or below the grid.
    [[nodiscard]] bool is_beside(const std::array<Point3, 3>& corners) const {
        for (std::size_t a = 0; a < 3; ++a) {
            const auto [low, high] = ends(corners, a);
            if (high < planes(a).front() || (a < 2 && low > planes(a).back())) return true;
        }
        return false;
    }

    static std::pair<double, double> ends(const std::array<Point3, 3>& c, std::size_t axis) {
        return std::minmax({along(c[0], axis), along(c[1], axis), along(c[2], axis)});
    }

    /// Returns the slabs whose interior a part meets.
    [[nodiscard]] Slabs slabs_of(const TrianglePart& part, std::uint8_t axis) const {
        const Planes& at = planes(axis);
        const auto [low, high] = ends(part.triangle().corners, axis);
        const auto above = std::upper_bound(at.begin(), at.end(), low) - at.begin();
        const auto below = std::lower_bound(at.begin(), at.end(), high) - at.begin();
        const auto begin = std::size_t(std::max<std::ptrdiff_t>(above - 1, 0));
        const auto end =
            std::max(begin, std::size_t(std::min<std::ptrdiff_t>(below, std::ssize(at) - 1)));
        const std::size_t first = first_that(begin, end, [&](std::size_t s) {
            return part.reaches({axis, at[s + 1]}, Sign::Negative);
        });
        return {first, first_that(first, end, [&](std::size_t s) {
                    return !part.reaches({axis, at[s]}, Sign::Positive);
                })};
    }

    /// Returns the first number in [first, last) from which on something holds, or `last`.
    template <class Holds>
    static std::size_t first_that(std::size_t first, std::size_t last, const Holds& holds) {
        while (first < last) {
            const std::size_t middle = first + (last - first) / 2;
            if (holds(middle))
                last = middle;
            else
                first = middle + 1;
        }
        return first;
    }

    template <class Visit>
    void for_slabs(const TrianglePart& part, std::uint8_t axis, const Visit& visit) {
        const auto [first, last] = slabs_of(part, axis);
        for (std::size_t s = first; s < last; ++s) {
            TrianglePart slice = part;
            slice.cut({axis, planes(axis)[s]}, Sign::Positive);
            slice.cut({axis, planes(axis)[s + 1]}, Sign::Negative);
            if (!slice.is_empty()) visit(s, slice);
        }
    }

    void add_column(std::uint64_t column, const TrianglePart& part) {
        if (part.triangle().is_level()) return add_level(column, part);
        for_slabs(part, 2, [&](std::size_t k, const TrianglePart& in_cell) {
            add_piece(places_.of(column, k), in_cell, true);
        });
        const CellPlane top{2, grid_.z.back()};
        if (part.triangle().is_vertical() || !part.reaches(top, Sign::Positive)) return;
        TrianglePart above = part;
        above.cut(top, Sign::Positive);
        add_piece(places_.of(column, places_.nz), above, false);
    }

    /// A level triangle in the plane between two cells is in the bottom of the upper one.
    void add_level(std::uint64_t column, const TrianglePart& part) {
        const double z = part.triangle().corners[0].z;
        if (z < grid_.z.front()) return;
        const auto above = std::upper_bound(grid_.z.begin(), grid_.z.end(), z) - grid_.z.begin();
        const auto k = std::size_t(above - 1);
        add_piece(places_.of(column, k), part, k < places_.nz && grid_.z[k] < z);
    }

    void add_piece(std::uint64_t place, const TrianglePart& part, bool divides) {
        CellPiece piece{place, number_, divides, {}};
        if (!part.triangle().is_vertical()) {
            const CellBox box = box_at(grid_, place);
            piece.moments =
                in_twofold([&] { return MomentsOfPart<DoubleDouble>(part, box)(divides); });
        }
        out_.push_back(piece);
    }

    const RectilinearGrid& grid_;
    PlacesOfPieces places_;
    std::vector<CellPiece>& out_;
    std::uint32_t number_ = 0;
};

} // namespace

std::array<Point3, 3> corners_in(const Mesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

std::vector<CellPiece> find_pieces(const Mesh& mesh, const Volumes& volumes,
                                   const RectilinearGrid& grid, const Run& run) {
    constexpr std::size_t ranges_per_thread = 16; // a large triangle has many pieces
    auto found = concatenated(parts_of_ranges<std::vector<CellPiece>>(
        mesh.triangles.size(), run,
        [&](std::size_t first, std::size_t last) {
            std::vector<CellPiece> pieces;
            PieceFinder finder(grid, pieces);
            for (std::size_t t = first; t < last; ++t) {
                if (run.stop.stop_requested()) break;
                const auto number = static_cast<std::uint32_t>(t);
                if (!volumes.dangles(t)) finder.add(number, corners_in(mesh, number));
            }
            return pieces;
        },
        ranges_per_thread));
    with_threads(run, [&] {
        const auto before = [](const CellPiece& a, const CellPiece& b) {
            return a.place != b.place ? a.place < b.place : a.triangle < b.triangle;
        };
        if (run.threads <= 1)
            std::sort(found.begin(), found.end(), before);
        else
            tbb::parallel_sort(found.begin(), found.end(), before);
    });
    return found;
}

CellBox box_at(const RectilinearGrid& grid, std::uint64_t place) {
    const PlacesOfPieces places(grid);
    const std::uint64_t column = places.column_of(place);
    const std::uint64_t i = column % places.nx, j = column / places.nx;
    const std::uint64_t k = std::min(places.layer_of(place), places.nz - 1);
    return {{grid.x[i], grid.y[j], grid.z[k]}, {grid.x[i + 1], grid.y[j + 1], grid.z[k + 1]}};
}

TrianglePart part_at(const CutTriangle& triangle, const RectilinearGrid& grid,
                     std::uint64_t place) {
    const CellBox box = box_at(grid, place);
    TrianglePart part(triangle);
    const std::uint8_t axes = triangle.is_level() ? 2 : 3;
    const PlacesOfPieces places(grid);
    const bool is_above = places.layer_of(place) == places.nz;
    for (std::uint8_t a = 0; a < axes; ++a) {
        if (a == 2 && is_above) {
            part.cut({a, box.high.z}, Sign::Positive);
            break;
        }
        part.cut({a, along(box.low, a)}, Sign::Positive);
        part.cut({a, along(box.high, a)}, Sign::Negative);
    }
    return part;
}

} // namespace terrane::cells::detail
