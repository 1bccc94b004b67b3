// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/volumes.hpp>

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/invariants.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/work_hook.hpp>
#include <terrane/algorithms/volumes/exact_volumes.hpp>
#include <terrane/algorithms/volumes/mesh_sheets.hpp>
#include <terrane/algorithms/volumes/radial_sort.hpp>
#include <terrane/algorithms/volumes/shell_nesting.hpp>

namespace terrane {

using namespace volumes;

namespace {

/// A side of a triangle: the ranks of its corners, ascending, and whether they are counterclockwise
/// in that order seen from this side.
using SideKey = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, bool>;

SideKey key_of(Triangle ranks, bool is_front) {
    bool even = true;
    for (const auto& [i, j] : {std::pair{0U, 1U}, std::pair{1U, 2U}, std::pair{0U, 1U}})
        if (ranks[i] > ranks[j]) {
            std::swap(ranks[i], ranks[j]);
            even = !even;
        }
    return {ranks[0], ranks[1], ranks[2], even == is_front};
}

/// Step (c): numbers the sets of joined sides.
class Numbering {
public:
    Numbering(const TriangleComplex& sheets, DisjointSets& sides) :
        sheets_(sheets), sides_(sides),
        outside_(2 * static_cast<std::uint32_t>(sheets.triangles.size())) {}

    Volumes operator()() {
        find_least_vertices();
        gather_boundaries_of_tied();
        std::sort(blocks_.begin(), blocks_.end(), [this](std::uint32_t a, std::uint32_t b) {
            if (least_[a] != least_[b]) return before(least_[a], least_[b]);
            return a != b && tied_[slot_[a]] < tied_[slot_[b]];
        });
        return numbered();
    }

private:
    /// The key that tells blocks with the same least vertex apart.
    struct Boundary {
        std::vector<std::uint32_t> vertices{}; ///< ranks, ascending
        SideKey least{no_index, no_index, no_index, true};

        friend bool operator<(const Boundary& a, const Boundary& b) {
            return std::tie(a.vertices, a.least) < std::tie(b.vertices, b.least);
        }
    };

    /// Whether a vertex comes before another one in the lexicographic order.
    [[nodiscard]] bool before(std::uint32_t v, std::uint32_t w) const {
        const PointIndex p = sheets_.vertices[v], q = sheets_.vertices[w];
        // Rounding to nearest keeps the order: doubles that differ decide.
        const double x = sheets_.points.nearest(p).x, other_x = sheets_.points.nearest(q).x;
        return x != other_x ? x < other_x : sheets_.points.compare(p, q) < 0;
    }
    [[nodiscard]] Triangle ranks_of(std::uint32_t triangle) const {
        const auto [a, b, c] = sheets_.triangles[triangle];
        return {rank_[a], rank_[b], rank_[c]};
    }

    void find_least_vertices() {
        const std::uint32_t outside = sides_.find(outside_);
        least_.assign(outside_ + std::size_t{1}, no_index);
        for (std::uint32_t s = 0; s < outside_; ++s) {
            const std::uint32_t set = sides_.find(s);
            if (set == outside) continue;
            if (least_[set] == no_index) blocks_.push_back(set);
            for (const std::uint32_t v : sheets_.triangles[s / 2])
                if (least_[set] == no_index || (v != least_[set] && before(v, least_[set])))
                    least_[set] = v;
        }
    }

    /// Ranks the vertices of blocks that share their least one with others.
    void rank_vertices_of_tied() {
        std::vector<std::uint32_t> order;
        for (std::uint32_t s = 0; s < outside_; ++s)
            if (slot_[sides_.find(s)] != no_index)
                for (const std::uint32_t v : sheets_.triangles[s / 2]) order.push_back(v);
        sort_unique(order);
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t v, std::uint32_t w) { return before(v, w); });
        rank_.assign(sheets_.vertices.size(), no_index);
        for (std::uint32_t r = 0; r < order.size(); ++r) rank_[order[r]] = r;
    }

    void gather_boundaries_of_tied() {
        std::vector<std::uint32_t> sharing(sheets_.vertices.size(),
                                           0); // number of blocks per least vertex
        for (const std::uint32_t b : blocks_) ++sharing[least_[b]];
        slot_.assign(least_.size(), no_index);
        for (const std::uint32_t b : blocks_) {
            if (sharing[least_[b]] == 1) continue;
            slot_[b] = static_cast<std::uint32_t>(tied_.size());
            tied_.emplace_back();
        }
        if (tied_.empty()) return;
        rank_vertices_of_tied();
        for (std::uint32_t s = 0; s < outside_; ++s) {
            const std::uint32_t slot = slot_[sides_.find(s)];
            if (slot == no_index) continue;
            const Triangle r = ranks_of(s / 2);
            Boundary& b = tied_[slot];
            b.vertices.insert(b.vertices.end(), r.begin(), r.end());
            b.least = std::min(b.least, key_of(r, s % 2 == 0));
        }
        for (Boundary& b : tied_) {
            std::sort(b.vertices.begin(), b.vertices.end());
            b.vertices.erase(std::unique(b.vertices.begin(), b.vertices.end()), b.vertices.end());
        }
    }

    Volumes numbered() {
        auto& number = least_; // reused, as it is no longer needed
        number[sides_.find(outside_)] = 0;
        for (std::uint32_t b = 0; b < blocks_.size(); ++b) number[blocks_[b]] = b + 1;
        Volumes volumes;
        volumes.of_sides.reserve(sheets_.triangles.size());
        for (std::uint32_t t = 0; t < sheets_.triangles.size(); ++t)
            volumes.of_sides.push_back(
                {number[sides_.find(front_of(t))], number[sides_.find(back_of(t))]});
        volumes.measures.assign(blocks_.size() + 1, 0);
        return volumes;
    }

    const TriangleComplex& sheets_;
    DisjointSets& sides_;
    const std::uint32_t outside_;       ///< its element of sides_
    std::vector<std::uint32_t> rank_;   ///< per vertex of tied blocks: its place in their order
    std::vector<std::uint32_t> least_;  ///< per set: its least vertex
    std::vector<std::uint32_t> blocks_; ///< the sets that are blocks
    std::vector<std::uint32_t> slot_;   ///< per set: index into tied_, or none
    std::vector<Boundary> tied_;
};

Error interrupted() {
    return {ErrorCode::interrupted, "stopped on request", ""};
}

/// What is wanted of volumes: their sides, with numbers by position, with measures.
enum class Wanted : std::uint8_t { sides, numbers, measures };

/// Numbers volumes by their first triangles.
Volumes numbered_by_triangles(const TriangleComplex& sheets, DisjointSets& sides) {
    const auto outside = 2 * static_cast<std::uint32_t>(sheets.triangles.size());
    const auto& set_of = sides.flattened();
    std::vector<std::uint32_t> number(outside + std::size_t{1}, no_index);
    number[set_of[outside]] = 0;
    Volumes volumes;
    volumes.of_sides.reserve(sheets.triangles.size());
    std::uint32_t count = 1;
    const auto number_of = [&](std::uint32_t side) {
        auto& own = number[set_of[side]];
        return own = own == no_index ? count++ : own;
    };
    for (std::uint32_t t = 0; t < sheets.triangles.size(); ++t) {
        const std::uint32_t front = number_of(front_of(t));
        volumes.of_sides.push_back({front, number_of(back_of(t))});
    }
    volumes.measures.assign(count, 0);
    return volumes;
}

/// Finds volumes; their measures are 0 unless wanted. join_edges(sides): joins sides round edges.
template <class JoinEdges>
Result<Volumes> find(const TriangleComplex& sheets, const JoinEdges& join_edges, Wanted wanted,
                     const Run& run) {
    const auto report = [&](double share) {
        if (run.progress) run.progress("volumes", share);
        return !run.stop.stop_requested();
    };
    if (!report(0)) return interrupted();
    StageTimer step(run, "shells");
    DisjointSets sides(2 * sheets.triangles.size() + 1);
    join_edges(sides);
    if (!report(0.3)) return interrupted();
    step.next("nesting");
    join_nested(sheets, sides);
    if (!report(0.5)) return interrupted();
    step.next("numbers");
    Volumes volumes =
        wanted == Wanted::sides ? numbered_by_triangles(sheets, sides) : Numbering(sheets, sides)();
    if (!report(0.7)) return interrupted();
    if (wanted == Wanted::measures) {
        step.next("measures");
        volumes.measures = measure_volumes(sheets, volumes.of_sides, volumes.measures.size());
        volumes.total = std::exchange(volumes.measures[0], Volumes().measures[0]);
    }
    step.stop();
    TERRANE_ASSERT(volumes.of_sides.size() == sheets.triangles.size());
    TERRANE_ASSERT_PARANOID(corners_below(volumes.of_sides, volumes.measures.size()));
    if (std::any_of(volumes.measures.begin(), volumes.measures.end(),
                    [](double v) { return v < 0; }))
        throw std::logic_error("a volume is negative");
    report(1);
    return volumes;
}

/// Takes the sum of all blocks out of the place of the outside.
ExactVolumes with_total(std::vector<std::string> measures) {
    std::string total = std::exchange(measures[0], {});
    return {std::move(measures), std::move(total)};
}

Result<Volumes> find_in(const Arrangement& a, Wanted wanted, const Run& run) {
    return guarded("for the volumes", "volumes", [&]() -> Result<Volumes> {
        detail::announce_work("find exact volumes", {}, a.triangles);
        const auto planes = planes_of(a);
        const EdgeSides edges; // the adjacency has them
        const TriangleComplex sheets{a.state->points, a.vertices, a.triangles,
                                     edges,           planes,     &a.parents_of};
        return find(
            sheets,
            [&](DisjointSets& sides) { join_round_edges(sheets, a.state->adjacency, sides); },
            wanted, run);
    });
}

Result<Volumes> find_in(const Mesh& mesh, Wanted wanted, const Run& run) {
    return guarded("for the volumes", "volumes", [&]() -> Result<Volumes> {
        if (auto valid = validate(mesh.vertices, mesh.triangles, run); !valid) return valid.error();
        detail::announce_work("find volumes", mesh.vertices, mesh.triangles);
        const MeshSheets mesh_sheets(mesh.vertices, mesh.triangles, run);
        const TriangleComplex sheets = mesh_sheets.view();
        return find(
            sheets, [&](DisjointSets& sides) { join_round_edges(sheets, sides); }, wanted, run);
    });
}

} // namespace

std::vector<Triangle> volumes::planes_of(const Arrangement& a) {
    std::vector<Triangle> planes;
    planes.reserve(a.triangles.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t)
        planes.push_back(a.state->corners[a.parents_of[t][0]]);
    return planes;
}

Result<Volumes> find_volumes(const Arrangement& a, const Run& run) {
    return find_in(a, Wanted::measures, run);
}

Result<Volumes> find_volumes(const Mesh& mesh, const Run& run) {
    return find_in(mesh, Wanted::measures, run);
}

Result<Volumes> volumes::find_unmeasured(const Arrangement& a, const Run& run) {
    return find_in(a, Wanted::numbers, run);
}

Result<Volumes> volumes::find_sides(const Mesh& mesh, const Run& run) {
    return find_in(mesh, Wanted::sides, run);
}

std::vector<double> volumes::measure_volumes(const Arrangement& a, VolumeSides of_sides,
                                             std::size_t count) {
    const auto planes = planes_of(a);
    const EdgeSides edges; // measures need none
    return measure_volumes({a.state->points, a.vertices, a.triangles, edges, planes, &a.parents_of},
                           of_sides, count);
}

ExactVolumes exact_volumes(const Arrangement& a, const Volumes& volumes, int base) {
    const StandardArithmetic guard;
    const auto planes = planes_of(a);
    const EdgeSides edges; // measures need none
    return with_total(
        exact_measures({a.state->points, a.vertices, a.triangles, edges, planes, &a.parents_of},
                       volumes.of_sides, volumes.measures.size(), base));
}

ExactVolumes exact_volumes(const Mesh& mesh, const Volumes& volumes, int base) {
    const StandardArithmetic guard;
    return with_total(exact_measures(MeshSheets(mesh.vertices, mesh.triangles).view(),
                                     volumes.of_sides, volumes.measures.size(), base));
}

} // namespace terrane
