// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/detail/sides.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/selection/windings.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::selection {
namespace {

using InputPoint = polynomial::Coordinates<Exact, polynomial::One>;

std::array<InputPoint, 3> corners_of(const Arrangement& exact, std::uint32_t input) {
    const Triangle& c = exact.input_corners()[input];
    const auto at = [&](unsigned i) {
        return polynomial::cartesian<Exact>(exact.state->points.input(c[i]));
    };
    return {at(0), at(1), at(2)};
}

Point3 least_corner(const Arrangement& exact, std::size_t t) {
    const auto at = [&](unsigned i) { return exact.nearest(VertexId(exact.triangles[t][i])); };
    return std::min({at(0), at(1), at(2)});
}

} // namespace

SidedSurface::SidedSurface(const Arrangement& exact, const std::vector<bool>& is_of, Axis axis) :
    exact_(exact), surfaces_(is_of), axis_(axis), upper_(exact.input_corners().size(), 0),
    is_of_(exact.triangles.size()), front_(exact.triangles.size(), no_side) {
    for (std::size_t t = 0; t < exact.triangles.size(); ++t)
        for (const std::uint32_t p : exact.parents_of[t])
            if (is_of[exact.inputs.surface_of(InputTriangleId(p))]) {
                is_of_[t] = true;
                inputs_.push_back(p);
            }
    sort_unique(inputs_);
    turn_alike();
    mark_fronts();
}

void SidedSurface::turn_alike() {
    std::vector<Triangle> corners;
    for (const std::uint32_t p : inputs_) corners.push_back(exact_.input_corners()[p]);
    std::vector<std::uint32_t> from, to;
    std::vector<bool> turns; // per pair: whether the two are wound differently
    group_edges(corners, exact_.state->points.input_count())
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (sides.size() != 2) return;
            const std::uint32_t p = sides[0].triangle, q = sides[1].triangle;
            const bool differ =
                runs_along(corners[p], low, high) == runs_along(corners[q], low, high);
            for (const auto& [one, other] : {std::pair{p, q}, std::pair{q, p}}) {
                from.push_back(one);
                to.push_back(other);
                turns.push_back(differ);
            }
        });
    const auto around = lists_by_key<std::pair<std::uint32_t, bool>>(
        corners.size(), from, [&](std::size_t i) { return std::pair(to[i], turns[i]); });
    std::vector<std::uint32_t> patch_of(corners.size(), no_index);
    std::uint32_t patches = 0;
    for (std::uint32_t first = 0; first < corners.size(); ++first) {
        if (patch_of[first] != no_index) continue;
        std::vector<std::uint32_t> open{first};
        patch_of[first] = patches;
        upper_[inputs_[first]] = 1;
        while (!open.empty()) {
            const std::uint32_t p = open.back();
            open.pop_back();
            for (const auto& [q, differ] : around[p]) {
                if (patch_of[q] != no_index) continue;
                patch_of[q] = patches;
                upper_[inputs_[q]] = differ ? -upper_[inputs_[p]] : upper_[inputs_[p]];
                open.push_back(q);
            }
        }
        ++patches;
    }
    find_upper(patch_of, patches);
}

void SidedSurface::find_upper(const std::vector<std::uint32_t>& patch_of, std::uint32_t patches) {
    std::vector<Exact> sums(patches);
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        const auto [a, b, c] = corners_of(exact_, inputs_[i]);
        const Exact area = polynomial::orient2d(axis_, a, b, c);
        sums[patch_of[i]] = sums[patch_of[i]] + (upper_[inputs_[i]] > 0 ? area : -area);
    }
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        const Sign up = exact_sign(sums[patch_of[i]]);
        upper_[inputs_[i]] *= up == Sign::Positive ? 1 : up == Sign::Zero ? 0 : -1;
    }
}

void SidedSurface::mark_fronts() {
    const PointStore& points = exact_.state->points;
    for (std::size_t t = 0; t < is_of_.size(); ++t) {
        if (!is_of_[t]) continue;
        const auto parents = exact_.parents_of[t];
        const Triangle& p = exact_.input_corners()[parents[0]];
        const Axis axis =
            projection_axis(points.input(p[0]), points.input(p[1]), points.input(p[2]));
        const Sign own = turn_of(exact_, parents[0], axis); // it is wound as its first parent
        for (const std::uint32_t parent : parents) {
            if (!surfaces_[exact_.inputs.surface_of(InputTriangleId(parent))]) continue;
            const int up = turn_of(exact_, parent, axis) == own ? upper_[parent] : -upper_[parent];
            if (up != 0) front_[t] |= up > 0 ? high_side : low_side;
        }
    }
}

namespace {

constexpr std::uint8_t both_sides = low_side | high_side;

/// Parts of cells.
class Parts {
public:
    explicit Parts(const Cells& cells) :
        cells_(cells), sets_(cells.asked.size()), sides_(cells.asked.size(), no_side),
        place_(cells.asked.size(), no_index) {
        for (const auto& [c, d] : cells.joined)
            if (cells.asked[c] && cells.asked[d]) sets_.join(c, d);
        for (const Cells::Touch& touch : cells.touches)
            if (cells.asked[touch.cell]) add(sets_.find(touch.cell), touch.sides, touch.triangle);
    }

    /// Looks along lines from parts that do not touch the surface.
    void look_along_lines(const SidedSurface& surface) {
        std::vector<std::uint32_t> parts, triangles;
        for (const auto& [c, t] : cells_.others) {
            if (!cells_.asked[c] || sides_[sets_.find(c)] != no_side) continue;
            parts.push_back(sets_.find(c));
            triangles.push_back(t);
        }
        const auto sides = surface.along_lines(triangles, cells_.are_volumes);
        for (std::size_t i = 0; i < parts.size(); ++i) add(parts[i], sides[i], triangles[i]);
    }

    /// Returns the sides of the part of a cell.
    [[nodiscard]] std::uint8_t sides(std::uint32_t cell) { return sides_[sets_.find(cell)]; }
    /// Returns a triangle at which the sides of the part of a cell were seen last, or no_index.
    [[nodiscard]] std::uint32_t place(std::uint32_t cell) { return place_[sets_.find(cell)]; }

private:
    void add(std::uint32_t part, std::uint8_t sides, std::uint32_t triangle) {
        if (sides_[part] != both_sides) place_[part] = triangle;
        sides_[part] |= sides;
    }

    const Cells& cells_;
    DisjointSets sets_;
    std::vector<std::uint8_t> sides_;  ///< per part, by its lowest cell
    std::vector<std::uint32_t> place_; ///< likewise
};

} // namespace

Result<std::vector<bool>> low_cells(const Arrangement& exact, const SidedSurface& surface,
                                    const Cells& cells, const SideNames& names) {
    Parts parts(cells);
    parts.look_along_lines(surface);
    std::vector<bool> low(cells.asked.size());
    for (std::uint32_t c = 0; c < low.size(); ++c) {
        if (!cells.asked[c]) continue;
        low[c] = parts.sides(c) == low_side;
        if (low[c] || parts.sides(c) == high_side) continue;
        const std::uint32_t t = parts.place(c);
        const std::string place =
            t == no_index ? std::string() : " at " + place_text(least_corner(exact, t));
        return Error{ErrorCode::not_closed,
                     parts.sides(c) == both_sides
                         ? "does not divide the part" + place + ", which is on both sides of it"
                         : "the part" + place + " is neither " + names.low + " nor " + names.high +
                               " it",
                     names.surface};
    }
    return low;
}

} // namespace terrane::selection
