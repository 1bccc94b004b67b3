// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include <terrane/algorithms/division.hpp>
#include <terrane/algorithms/parallel.hpp>
#include <terrane/algorithms/rounding_state.hpp>
#include <terrane/algorithms/soup.hpp>

namespace terrane {
namespace {

/// A power of two per axis; all multiples of it below 2^53 are doubles.
struct SnapGrid {
    std::array<double, 3> step{};

    [[nodiscard]] Point3 snap(const Point3& p) const {
        return {snap(p.x, step[0]), snap(p.y, step[1]), snap(p.z, step[2])};
    }

private:
    // Division and multiplication by a power of two are exact; the cell of a multiple is itself.
    static double snap(double x, double s) { return s > 0 ? std::nearbyint(x / s) * s : x; }
};

/// Cells of round r (from 1), in binary digits of the last place of the largest coordinate. The
/// first round is for single mishaps; after it the grid must be much coarser than the doubles, so
/// that what is divided again has room between them. Measured on touching_ridges_turned: grids of
/// 2^2 to 2^18 multiply the contacts, from 2^20 on they vanish in three or four rounds.
constexpr std::array<int, 8> grid_of_rounds{6, 20, 24, 27, 29, 30, 31, 32};

SnapGrid grid_of_round(std::span<const Point3> points, unsigned round) {
    std::array<double, 3> largest{};
    for (const Point3& p : points) {
        largest[0] = std::max(largest[0], std::fabs(p.x));
        largest[1] = std::max(largest[1], std::fabs(p.y));
        largest[2] = std::max(largest[2], std::fabs(p.z));
    }
    SnapGrid grid;
    for (unsigned k = 0; k < 3; ++k)
        if (largest[k] > 0) {
            const int ulp = std::ilogb(largest[k]) - 52;
            grid.step[k] = std::ldexp(1.0, std::max(ulp + grid_of_rounds[round - 1], -1074));
        }
    return grid;
}

class Rounding {
public:
    Rounding(const Arrangement& a, const RoundingOptions& options, const Run& run) :
        arrangement_(a), options_(options), run_(run) {}

    Result<RoundedMesh> operator()() {
        to_nearest();
        if (const auto finite = all_finite(); !finite) return finite.error();
        auto pairs = contacts();
        out_.report.naive_contacts = pairs.size();
        unsigned& round = out_.report.rounds;
        while (!pairs.empty() && round < std::min<std::size_t>(options_.max_rounds, grid_of_rounds.size()) && !run_.stop.stop_requested()) {
            ++round;
            snap_round(pairs, grid_of_round(state_.points, round));
            pairs = contacts();
 if(getenv("DBG")) fprintf(stderr,"round %u: %zu pairs, %zu triangles, %zu points\n", round, pairs.size(), state_.triangles.size(), state_.points.size());
        }
        if (run_.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        finish(pairs);
        return std::move(out_);
    }

private:
    void to_nearest();
    Status all_finite() const;
    std::vector<CandidatePair> contacts();
    void snap_round(std::span<const CandidatePair> pairs, const SnapGrid& grid);
    void snap_corners(std::span<const CandidatePair> pairs, const SnapGrid& grid);
    void divide_again();
    void finish(std::span<const CandidatePair> pairs);
    void report_moves();
    void report_vanished();

    const Arrangement& arrangement_;
    const RoundingOptions& options_;
    const Run& run_;
    RoundingState state_;
    bool changed_ = false; ///< the triangles are no longer those of the arrangement
    RoundedMesh out_;
};

void Rounding::to_nearest() {
    const Arrangement& a = arrangement_;
    state_.triangles = a.triangles;
    state_.parents_of = a.parents_of;
    state_.points.resize(a.vertices.size());
    state_.move.assign(a.vertices.size(), 0);
    state_.is_dirty.assign(a.vertices.size(), false);
    const auto first_constructed = static_cast<std::size_t>(
        std::lower_bound(a.vertices.begin(), a.vertices.end(), a.points.input_count()) -
        a.vertices.begin());
    for (std::size_t v = 0; v < first_constructed; ++v)
        state_.points[v] = a.points.input(a.vertices[v]);
    state_.input_vertices = first_constructed;
    struct Nothing {};
    const std::size_t constructed = a.vertices.size() - first_constructed;
    for_blocks<Nothing>(constructed, 1024, run_, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            const std::size_t v = first_constructed + k;
            state_.points[v] = a.points.nearest(a.vertices[v]);
            state_.move[v] = distance_bound(a.points.enclosure(a.vertices[v]), state_.points[v]);
        }
        return Nothing{};
    });
    for (std::size_t v = first_constructed; v < a.vertices.size(); ++v)
        state_.is_dirty[v] = state_.move[v] > 0;
    state_.end_round();
    changed_ = state_.tidy();
}

Status Rounding::all_finite() const {
    for (const Point3& p : state_.points)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return Error{ErrorCode::bad_number, "a constructed point is beyond the largest double",
                         ""};
    return Done{};
}

/// The pairs that meet improperly. Two triangles without a dirty corner never do.
std::vector<CandidatePair> Rounding::contacts() {
    const auto dirty = state_.dirty_triangles();
    if (dirty.empty()) return {};
    const auto boxes = boxes_of(state_.points, state_.triangles);
    return improper_pairs(state_.points, state_.triangles, candidate_pairs_of(boxes, dirty), run_);
}

void Rounding::snap_round(std::span<const CandidatePair> pairs, const SnapGrid& grid) {
    changed_ = true;
    snap_corners(pairs, grid);
    state_.tidy();
    divide_again();
    state_.end_round();
    state_.tidy();
}

void Rounding::snap_corners(std::span<const CandidatePair> pairs, const SnapGrid& grid) {
    std::vector<std::uint32_t> corners;
    for (const CandidatePair& p : pairs)
        for (const std::uint32_t t : {p.first, p.second})
            corners.insert(corners.end(), state_.triangles[t].begin(), state_.triangles[t].end());
    std::vector<Point3> cells;
    for (const std::uint32_t v : corners) cells.push_back(grid.snap(state_.points[v]));
    state_.move_into(cells, [&](const Point3& p) { return grid.snap(p); });
}

/// What still crosses is divided, exactly; the new points go to the nearest doubles, which are much
/// finer than the grid: so most of them stay clear of each other.
void Rounding::divide_again() {
    const auto pairs = contacts();
    if (pairs.empty()) return;
    Division division = divide({state_.points, state_.triangles}, pairs, run_);
    if (run_.stop.stop_requested()) return;
    const auto first_new = static_cast<std::uint32_t>(state_.points.size());
    std::vector<std::uint32_t> name_of(division.points.size());
    for (const PointIndex p : division.ascending) {
        name_of[p] = static_cast<std::uint32_t>(state_.points.size());
        const Point3 near = division.points.nearest(p);
        state_.add_point(near, distance_bound(division.points.enclosure(p), near));
    }
    for (Triangle& t : division.triangles)
        for (std::uint32_t& v : t)
            if (v >= first_new) v = name_of[v];
    state_.replace_triangles(std::move(division.triangles), division.faces_of);
}

void Rounding::report_moves() {
    RoundingReport& r = out_.report;
    r.deviation = state_.deviation;
    for (std::size_t v = 0; v < state_.points.size(); ++v) {
        const double m = state_.move[v];
        r.max_move = std::max(r.max_move, m);
        const double decade = m > 0 ? std::floor(std::log10(m)) + 24 : 0;
        ++r.moves[static_cast<std::size_t>(m > 0 ? std::clamp(decade, 1.0, 31.0) : 0)];
        if (v < state_.input_vertices && m > 0) ++r.moved_input_vertices;
    }
    r.merged_vertices = state_.merged;
    r.collapsed_triangles = state_.collapsed;
}

void Rounding::report_vanished() {
    if (!changed_) return;
    std::vector<bool> present(arrangement_.inputs.first.back(), false);
    for (const std::uint32_t p : state_.parents_of.values) present[p] = true;
    for (const std::uint32_t p : arrangement_.parents_of.values)
        if (!present[p]) out_.report.vanished.push_back(p);
    auto& v = out_.report.vanished;
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
}

void Rounding::finish(std::span<const CandidatePair> pairs) {
    out_.report.clean = pairs.empty();
    report_moves();
    report_vanished();
    if (changed_) state_.drop_unused_points();
    for (const CandidatePair& p : pairs) {
        const auto contact =
            improper_contact(state_.points, state_.triangles[p.first], state_.triangles[p.second]);
        out_.report.contacts.push_back(
            {{p.first, p.second},
             kind_of(*contact),
             nearest(state_.points, contact->points[contact->point_count - 1u].how)});
    }
    Mesh& mesh = out_.mesh;
    mesh.surfaces = arrangement_.surfaces;
    mesh.vertices = std::move(state_.points);
    mesh.triangles = std::move(state_.triangles);
    mesh.parents_of = std::move(state_.parents_of);
    EdgeSides made;
    if (changed_) made = group_edges(mesh.triangles, mesh.vertices.size());
    const EdgeSides& edges = changed_ ? made : arrangement_.edges;
    mesh.surfaces_of = changed_ ? surfaces_of_parents(arrangement_.inputs, mesh.parents_of)
                                : arrangement_.surfaces_of;
    mesh.intersection_edges =
        changed_ ? find_intersection_edges(edges, arrangement_.inputs, mesh.parents_of)
                 : arrangement_.intersection_edges;
    auto regions = find_regions(mesh.vertices, mesh.triangles, mesh.surfaces_of, edges,
                                mesh.intersection_edges);
    mesh.regions_of = std::move(regions.regions_of);
    out_.regions = std::move(regions.regions);
}

} // namespace

Result<RoundedMesh> round_to_doubles(const Arrangement& arrangement,
                                     const RoundingOptions& options, const Run& run) {
    try {
        return Rounding(arrangement, options, run)();
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::out_of_memory, "not enough memory for the rounding", ""};
    } catch (const std::logic_error& broken) {
        return Error{ErrorCode::internal, broken.what(), "rounding"};
    }
}

} // namespace terrane
