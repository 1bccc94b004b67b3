// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/reconstruction/holes/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/holes/detail/shape.hpp>

namespace terrane {

using namespace holes::detail;

namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// Traces the borders of the distinct triangles, cut along edges of more than two triangles.
class BorderTracer {
public:
    explicit BorderTracer(const Soup& soup) : soup_(soup), across_(soup.triangles.size()) {
        for (auto& sides : across_) sides.fill(Side{none, 0});
        connect();
    }

    std::vector<TracedLoop> trace() {
        for (std::uint32_t t = 0; t < across_.size(); ++t)
            for (unsigned i = 0; i < 3; ++i)
                if (across_[t][i].triangle == none && !seen_[t][i]) trace_from({t, i});
        for (TracedLoop& loop : loops_) orient(loop);
        return std::move(loops_);
    }

    /// Lists the vertices of each connected part, by the root triangle of the part.
    std::map<std::uint32_t, std::vector<std::uint32_t>> vertices_of_parts() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> result;
        for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t)
            for (const auto v : soup_.triangles[t]) result[parts_.find(t)].push_back(v);
        return result;
    }

private:
    /// Side i of a triangle runs from its corner i to the next.
    struct Side {
        std::uint32_t triangle;
        unsigned i;
    };
    /// A border side and the vertex at which a loop enters it.
    struct Step {
        std::uint32_t vertex;
        Side side;
    };

    void connect() {
        seen_.assign(across_.size(), {});
        shared_.assign(across_.size(), {});
        soup_.edges.for_each([&](std::uint32_t low, std::uint32_t high, const auto& sides) {
            const Side first = side_of(sides[0].triangle, low, high);
            for (const auto& side : sides) {
                parts_.join(first.triangle, side.triangle);
                const Side here = side_of(side.triangle, low, high);
                shared_[here.triangle][here.i] = sides.size() > 2;
            }
            if (sides.size() != 2) return;
            const Side second = side_of(sides[1].triangle, low, high);
            across_[first.triangle][first.i] = second;
            across_[second.triangle][second.i] = first;
        });
    }

    [[nodiscard]] Side side_of(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const {
        const Triangle& t = soup_.triangles[triangle];
        for (unsigned i = 0; i < 2; ++i)
            if ((t[i] == a && t[i + 1] == b) || (t[i] == b && t[i + 1] == a)) return {triangle, i};
        return {triangle, 2};
    }

    [[nodiscard]] std::uint32_t corner(Side s, unsigned end) const {
        return soup_.triangles[s.triangle][(s.i + end) % 3];
    }
    [[nodiscard]] std::uint32_t other_end(Side s, std::uint32_t v) const {
        return corner(s, 0) == v ? corner(s, 1) : corner(s, 0);
    }

    /// Returns the other border side of the fan of triangles around `pivot` that contains this
    /// side.
    [[nodiscard]] Side next_border_side(Side side, std::uint32_t pivot) const {
        while (true) {
            const unsigned next = corner(side, 1) == pivot ? (side.i + 1) % 3 : (side.i + 2) % 3;
            const Side inner{side.triangle, next};
            side = across_[inner.triangle][inner.i];
            if (side.triangle == none) return inner;
        }
    }

    void trace_from(Side start) {
        std::vector<Step> steps;
        Side side = start;
        auto vertex = corner(side, 0);
        do {
            seen_[side.triangle][side.i] = true;
            steps.push_back({vertex, side});
            vertex = other_end(side, vertex);
            side = next_border_side(side, vertex);
        } while (side.triangle != start.triangle || side.i != start.i);
        split(steps);
    }

    /// Splits a walk into loops that visit no vertex twice.
    void split(const std::vector<Step>& steps) {
        std::vector<Step> open;
        std::map<std::uint32_t, std::size_t> place; // index in `open`
        for (const Step& step : steps) {
            if (const auto met = place.find(step.vertex); met != place.end()) {
                const auto from = met->second;
                add_loop(std::span(open).subspan(from));
                for (auto i = from; i < open.size(); ++i) place.erase(open[i].vertex);
                open.resize(from);
            }
            place[step.vertex] = open.size();
            open.push_back(step);
        }
        add_loop(open);
    }

    /// Adds a loop. Two steps are no loop but a cut along an edge and back.
    void add_loop(std::span<const Step> steps) {
        TracedLoop loop;
        for (const auto& [vertex, side] : steps) {
            loop.vertices.push_back(vertex);
            loop.triangles.push_back(side.triangle);
            if (shared_[side.triangle][side.i]) ++loop.shared;
        }
        if (steps.size() < 3 || loop.shared == steps.size()) return;
        loop.part = soup_.input_of[parts_.find(loop.triangles[0])];
        loops_.push_back(std::move(loop));
    }

    /// Orients the loop so that most of its triangles lie on its left, and starts it at its lowest
    /// vertex.
    void orient(TracedLoop& loop) const {
        const auto n = loop.vertices.size();
        std::size_t along = 0;
        for (std::size_t i = 0; i < n; ++i)
            if (runs_along(soup_.triangles[loop.triangles[i]], loop.vertices[i],
                           loop.vertices[(i + 1) % n]))
                ++along;
        if (2 * along < n) { // edge i then ends at vertex i
            std::reverse(loop.vertices.begin(), loop.vertices.end());
            std::reverse(loop.triangles.begin(), loop.triangles.end() - 1);
        }
        const auto lowest = std::min_element(loop.vertices.begin(), loop.vertices.end());
        const auto shift = lowest - loop.vertices.begin();
        std::rotate(loop.vertices.begin(), lowest, loop.vertices.end());
        std::rotate(loop.triangles.begin(), loop.triangles.begin() + shift, loop.triangles.end());
    }

    const Soup& soup_;
    std::vector<std::array<Side, 3>> across_; ///< per side: the side across it; none at a border
    std::vector<std::array<bool, 3>> shared_; ///< per side: its edge has more than two triangles
    std::vector<std::array<bool, 3>> seen_;
    DisjointSets parts_{soup_.triangles.size()};
    std::vector<TracedLoop> loops_;
};

/// Finds the loops that surround a part or share edges with other triangles.
std::vector<bool> outer_loops(const Soup& soup, const std::vector<TracedLoop>& loops,
                              BorderTracer& tracer) {
    std::map<std::uint32_t, double> size_of_part;
    for (const auto& [triangle, vertices] : tracer.vertices_of_parts())
        size_of_part[soup.input_of[triangle]] = diagonal_of(soup.points, vertices);
    std::map<std::uint32_t, std::pair<double, std::size_t>> longest; // per part: diagonal and index
                                                                     // of a loop
    std::vector<bool> outer(loops.size());
    for (std::size_t i = 0; i < loops.size(); ++i) {
        outer[i] = loops[i].shared > 0;
        const double diagonal = diagonal_of(soup.points, loops[i].vertices);
        auto& best = longest.try_emplace(loops[i].part, -1.0, i).first->second;
        if (diagonal > best.first) best = {diagonal, i};
    }
    for (const auto& [part, best] : longest)
        if (best.first >= constants.outer_share * size_of_part[part]) outer[best.second] = true;
    return outer;
}

bool before(const BorderLoop& a, const BorderLoop& b) {
    const bool outer_a = a.kind == LoopKind::outer, outer_b = b.kind == LoopKind::outer;
    if (outer_a != outer_b) return outer_a;
    const double size_a = outer_a ? a.length : a.area, size_b = outer_a ? b.length : b.area;
    if (size_a != size_b) return size_a > size_b;
    return std::tie(a.vertices.front(), a.vertices[1]) <
           std::tie(b.vertices.front(), b.vertices[1]);
}

} // namespace

Result<std::vector<BorderLoop>> find_border_loops(const Surface& surface, const Run& run,
                                                  const GapRule& rule) {
    return guarded("for the holes", "holes", [&]() -> Result<std::vector<BorderLoop>> {
        if (const auto status = validate(std::span(&surface, 1)); !status) return status.error();
        const Soup soup = merge_surfaces(std::span(&surface, 1), run);
        BorderTracer tracer(soup);
        const auto traced = tracer.trace();
        const auto outer = outer_loops(soup, traced, tracer);
        std::vector<BorderLoop> loops(traced.size());
        for (std::size_t i = 0; i < traced.size(); ++i) {
            if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "interrupted", ""};
            if (run.progress) run.progress("holes", double(i) / double(traced.size()));
            BorderLoop& loop = loops[i];
            loop.vertices = traced[i].vertices;
            loop.part = traced[i].part;
            loop.shared = traced[i].shared;
            measure_loop(soup, traced[i], loop);
            const bool gap = !outer[i] && is_fault_gap(soup, traced[i], rule, loop);
            loop.kind = outer[i] ? LoopKind::outer : gap ? LoopKind::fault_gap : LoopKind::hole;
        }
        std::sort(loops.begin(), loops.end(), before);
        return loops;
    });
}

std::vector<NamedConstant> hole_constants() {
    return holes::detail::constants.listed();
}

} // namespace terrane
