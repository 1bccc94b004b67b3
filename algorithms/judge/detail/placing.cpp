// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/detail/placing.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>

namespace terrane::judging {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// The exact points of the vertices of a mesh: those that they stand for, else their own.
class Positions {
public:
    Positions(const Arrangement& exact, const OutputMesh& output, const Matching& matching) :
        exact_(exact), matching_(matching), store_(&exact.state->points) {
        std::vector<Point3> inputs(store_->inputs().begin(), store_->inputs().end());
        const std::size_t before = inputs.size();
        own_.assign(output.soup.points.size(), no_index);
        for (const std::uint32_t v : output.vertices) {
            if (!matching.preimages[v].empty()) continue;
            own_[v] = static_cast<std::uint32_t>(inputs.size());
            inputs.push_back(output.soup.points[v]);
        }
        if (inputs.size() == before) return;
        std::vector<Construction> constructed;
        for (std::size_t p = before; p < store_->size(); ++p)
            constructed.push_back(store_->construction(static_cast<PointIndex>(p)));
        shift_ = static_cast<std::uint32_t>(inputs.size() - before);
        first_constructed_ = static_cast<std::uint32_t>(before);
        extended_ = PointStore(std::move(inputs));
        extended_.append(constructed);
        store_ = &extended_;
    }
    Positions(const Positions&) = delete;
    Positions& operator=(const Positions&) = delete;

    [[nodiscard]] bool is_own(std::uint32_t v) const { return own_[v] != no_index; }
    [[nodiscard]] Sign turn(UpwardWitness upward, Axis axis, const Triangle& t) const {
        return store_->orient2d(upward, axis, point(t[0]), point(t[1]), point(t[2]));
    }

private:
    [[nodiscard]] PointIndex point(std::uint32_t v) const {
        if (is_own(v)) return own_[v];
        const PointIndex p = exact_.vertices[matching_.preimages[v][0]];
        return p < first_constructed_ ? p : p + shift_;
    }

    const Arrangement& exact_;
    const Matching& matching_;
    const PointStore* store_;
    PointStore extended_;     ///< with the own points of vertices after the input points
    std::uint32_t shift_ = 0; ///< of constructed points in it
    std::uint32_t first_constructed_ = 0;
    Numbers own_; ///< per vertex: its own point, or no_index
};

class Placer {
public:
    Placer(const Target& target, const Cells& cells, const Crowding& crowding,
           const OutputMesh& output, const Matching& matching, const Separation& separation,
           double bound) :
        target_(target),
        cells_(cells), crowding_(crowding), output_(output), matching_(matching),
        separation_(separation), bound_(bound), positions_(target.exact, output, matching) {}

    Placing operator()() {
        const auto& triangles = output_.soup.triangles;
        placing_.cell_of.assign(triangles.size(), no_index);
        placing_.facing.assign(triangles.size(), 1);
        for (const Numbers& patch : patches()) place_patch(patch);
        std::ranges::sort(placing_.off);
        return std::move(placing_);
    }

private:
    [[nodiscard]] const Triangle& corners(std::uint32_t t) const {
        return output_.soup.triangles[t];
    }

    /// Joins triangles across edges with two of them that do not separate cells.
    [[nodiscard]] std::vector<Numbers> patches() const {
        DisjointSets sets(output_.soup.triangles.size());
        output_.soup.edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (sides.size() == 2 && !separation_.separates(low, high))
                sets.join(sides[0].triangle, sides[1].triangle);
        });
        std::vector<Numbers> lists;
        Numbers number(output_.soup.triangles.size(), no_index);
        for (std::uint32_t t = 0; t < number.size(); ++t) {
            std::uint32_t& n = number[sets.find(t)];
            if (n == no_index) {
                n = static_cast<std::uint32_t>(lists.size());
                lists.emplace_back();
            }
            lists[n].push_back(t);
        }
        return lists;
    }

    /// Keeps the candidates that are cells at a vertex or, if `near`, near it, unless nothing is known of that.
    /// The first vertex gives them.
    void restrict(Numbers& candidates, bool& any, std::uint32_t v, bool near) const {
        if (matching_.preimages[v].empty()) return;
        Numbers here;
        for (const std::uint32_t x : matching_.preimages[v]) {
            const auto cells = cells_.at_vertex[x];
            here.insert(here.end(), cells.begin(), cells.end());
            if (!near) continue;
            const auto others = crowding_.cells_near[x];
            here.insert(here.end(), others.begin(), others.end());
        }
        sort_unique(here);
        if (!any) {
            candidates = std::move(here);
            any = true;
            return;
        }
        Numbers both;
        std::ranges::set_intersection(candidates, here, std::back_inserter(both));
        candidates = std::move(both);
    }

    [[nodiscard]] Numbers candidates_of(std::span<const std::uint32_t> triangles, bool near) const {
        Numbers candidates;
        bool any = false;
        for (const std::uint32_t t : triangles)
            for (const std::uint32_t v : corners(t)) {
                restrict(candidates, any, v, near);
                if (any && candidates.empty()) return {};
            }
        return candidates;
    }

    void place_patch(const Numbers& patch) {
        if (put_in_one_of(patch, false)) return;
        for (const std::uint32_t t : patch) { // a curve may be missing: each for itself
            const Numbers one{t};
            // Rounding may have moved an edge to a vertex near it.
            if (!put_in_one_of(one, false)) put_in_one_of(one, true);
        }
    }

    /// Puts triangles in the candidate of whose boundary they have most edges. Returns false if no cell is one.
    bool put_in_one_of(const Numbers& triangles, bool near) {
        const Numbers candidates = candidates_of(triangles, near);
        if (candidates.empty()) return false;
        for (const std::uint32_t t : triangles)
            if (near || candidates.size() > 1 ||
                std::ranges::any_of(corners(t),
                                    [&](std::uint32_t v) { return positions_.is_own(v); }))
                placing_.unsure.push_back(t);
        put(triangles, best_of(candidates, triangles));
        return true;
    }

    /// Returns the candidate of whose oriented boundary the patch has most edges.
    [[nodiscard]] std::uint32_t best_of(const Numbers& candidates, const Numbers& patch) {
        if (candidates.size() == 1) return candidates[0];
        if (boundary_.empty()) {
            for (const CellEdge& e : separation_.boundary())
                boundary_.push_back({e.cell, e.from, e.to});
            sort_unique(boundary_);
        }
        return *std::ranges::max_element(candidates, {}, [&](std::uint32_t cell) {
            std::size_t edges = 0;
            for (const std::uint32_t t : patch) {
                Triangle k = corners(t);
                if (facing_in(t, cell) < 0) std::swap(k[0], k[1]);
                for (unsigned i = 0; i < 3; ++i)
                    edges += std::ranges::binary_search(boundary_,
                                                        std::array{cell, k[i], k[(i + 1) % 3]});
            }
            return edges;
        });
    }

    void put(const Numbers& triangles, std::uint32_t cell) {
        int sum = 0;
        Numbers flat;
        for (const std::uint32_t t : triangles) {
            if (is_off(t, cell)) {
                placing_.off.push_back(t);
                continue;
            }
            placing_.cell_of[t] = cell;
            const int facing = facing_in(t, cell);
            if (facing == 0) flat.push_back(t);
            placing_.facing[t] = facing;
            sum += facing;
        }
        // What rounding made flat faces as the others.
        for (const std::uint32_t t : flat) placing_.facing[t] = sum < 0 ? -1 : 1;
    }

    /// Whether a corner that stands for no exact point is too far from the plane of a cell. Exact: the plane of a needle
    /// far from the origin has none of the digits of doubles.
    [[nodiscard]] bool is_off(std::uint32_t t, std::uint32_t cell) const {
        using namespace polynomial;
        const auto& points = target_.exact.state->points;
        const auto corner = [&](unsigned i) {
            return cartesian<Exact>(points.input(cells_.cells[cell].plane[i]));
        };
        const auto a = corner(0);
        const auto normal = cross(difference(corner(1), a), difference(corner(2), a));
        const Exact most(2 * bound_), limit = most * most * dot(normal, normal);
        return std::ranges::any_of(corners(t), [&](std::uint32_t v) {
            if (!positions_.is_own(v)) return false;
            const Exact height =
                dot(normal, difference(cartesian<Exact>(output_.soup.points[v]), a));
            return limit < height * height;
        });
    }

    /// Returns 1 or -1, or 0 for a triangle that is flat, or that merged points may have turned over.
    [[nodiscard]] int facing_in(std::uint32_t t, std::uint32_t cell) const {
        const UpwardRounding upward;
        const Cell& c = cells_.cells[cell];
        const bool merged = std::ranges::any_of(
            corners(t), [&](std::uint32_t v) { return matching_.preimages[v].size() > 1; });
        if (merged && height(t) <= 8 * bound_) return 0;
        return static_cast<int>(positions_.turn(upward, c.axis, corners(t)) * c.turn);
    }

    [[nodiscard]] double height(std::uint32_t t) const {
        const auto& points = output_.soup.points;
        double longest = 0;
        const Triangle& k = corners(t);
        for (unsigned i = 0; i < 3; ++i) {
            longest = std::max(longest, length(minus(points[k[i]], points[k[(i + 1) % 3]])));
        }
        const Point3 &a = points[k[0]], &b = points[k[1]], &c = points[k[2]];
        return length(cross(minus(b, a), minus(c, a))) / longest;
    }

    const Target& target_;
    const Cells& cells_;
    const Crowding& crowding_;
    const OutputMesh& output_;
    const Matching& matching_;
    const Separation& separation_;
    double bound_;
    Positions positions_;
    std::vector<std::array<std::uint32_t, 3>> boundary_; ///< {cell, from, to}; sorted, unique
    Placing placing_;
};

} // namespace

Placing place(const Target& target, const Cells& cells, const Crowding& crowding,
              const OutputMesh& output, const Matching& matching, const Separation& separation,
              double bound) {
    return Placer(target, cells, crowding, output, matching, separation, bound)();
}

} // namespace terrane::judging
