// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/state.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/triangle_table.hpp>
#include <terrane/algorithms/rounding/detail/closed_parts.hpp>
#include <terrane/algorithms/rounding/detail/collapsed_triangles.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::rounding::detail {
namespace {

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

} // namespace

// The last factor covers the rounding errors, in any mode.
double length_bound(double x, double y, double z) {
    const double most = std::max({x, y, z});
    if (most == 0 || std::isinf(most)) return most; // not 0 / 0 and not inf / inf
    const double u = x / most, v = y / most, w = z / most;
    return most * std::sqrt(u * u + v * v + w * w) * (1 + 0x1p-48);
}

double rounding_bound(const PointStore& points, PointIndex p) {
    const auto errors = points.rounding_errors(p);
    return length_bound(errors[0], errors[1], errors[2]);
}

double distance_bound(const Enclosure& e, const Point3& p) {
    const auto farther = [&](unsigned k, double x) {
        return std::max(std::fabs(e.low[k] - x), std::fabs(e.high[k] - x));
    };
    return length_bound(farther(0, p.x), farther(1, p.y), farther(2, p.z));
}

std::vector<std::uint32_t> RoundingState::dirty_triangles(const Run& run) const {
    const std::vector<unsigned char> flags(is_dirty.begin(), is_dirty.end()); // faster than bits
    return concatenated(parts_of_ranges<std::vector<std::uint32_t>>(
        triangles.size(), run, [&](std::size_t first, std::size_t last) {
            std::vector<std::uint32_t> dirty;
            for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
                const Triangle& c = triangles[t];
                if ((flags[c[0]] | flags[c[1]] | flags[c[2]]) != 0) dirty.push_back(t);
            }
            return dirty;
        }));
}

void RoundingState::search_dirty() {
    was_searched.resize(points.size(), false);
    for (std::size_t v = 0; v < points.size(); ++v)
        if (is_dirty[v]) was_searched[v] = true;
}

bool RoundingState::is_tested(const Triangle& t) const {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return v < was_searched.size() && was_searched[v]; });
}

void RoundingState::only_dirty(std::span<const CandidatePair> improper) {
    is_dirty.assign(points.size(), false);
    for (const CandidatePair& p : improper)
        for (const std::uint32_t t : {p.first, p.second})
            for (const std::uint32_t v : triangles[t]) is_dirty[v] = true;
}

void RoundingState::add_point(const Point3& p, double moved) {
    points.push_back(p);
    move.push_back(moved);
    is_dirty.push_back(true);
    largest_move_ = std::max(largest_move_, moved);
}

void RoundingState::move_point(std::size_t v, const Point3& to) {
    const Point3& from = points[v];
    const double d =
        length_bound(std::fabs(to.x - from.x), std::fabs(to.y - from.y), std::fabs(to.z - from.z));
    points[v] = to;
    move[v] = (move[v] + d) * (1 + 0x1p-52);
    is_dirty[v] = true;
    largest_move_ = std::max(largest_move_, d);
}

void RoundingState::end_round() {
    if (deviation == 0 && largest_move_ == 0)
        for (const double m : move) largest_move_ = std::max(largest_move_, m);
    deviation = (deviation + std::exchange(largest_move_, 0)) * (1 + 0x1p-51);
    gaps = (gaps + std::exchange(largest_gap_, 0)) * (1 + 0x1p-51);
}

namespace {

/// A collapsed triangle whose line is part of no remaining side.
struct OpenLine {
    Triangle corners;
    double length = 0; ///< of its longest side
};

/// Bounds how far points of the lines are from the mesh. A line with both ends at the mesh is up to
/// half its length away. Lines that are connected at points which are not at the mesh are up to the
/// sum of their lengths away from a point that is. (If there is none, the input triangle has
/// vanished, because its parts stay connected.)
double largest_gap(std::span<const OpenLine> lines, const std::vector<bool>& at_mesh) {
    std::map<std::uint32_t, std::uint32_t> first_at; // point that is not at the mesh: a line there
    DisjointSets sets(lines.size());
    std::vector<bool> ends_free(lines.size(), false);
    for (std::uint32_t l = 0; l < lines.size(); ++l)
        for (const std::uint32_t v : lines[l].corners) {
            if (at_mesh[v]) continue;
            ends_free[l] = true;
            sets.join(l, first_at.try_emplace(v, l).first->second);
        }
    std::map<std::uint32_t, double> sums;
    double largest = 0;
    for (std::uint32_t l = 0; l < lines.size(); ++l)
        if (ends_free[l])
            largest = std::max(largest, sums[sets.find(l)] += lines[l].length * (1 + 0x1p-48));
        else
            largest = std::max(largest, lines[l].length / 2);
    return largest;
}

} // namespace

/// Bounds the gaps that collapsed triangles leave. A collapsed triangle is a line. Points of it are
/// at the mesh if a remaining triangle has this line as an edge, or its halves.
void RoundingState::find_gaps(const std::vector<bool>& gone) {
    std::unordered_set<Side, SideHash>
        lines; // sides of dropped triangles, without those of remaining triangles
    std::vector<bool> concerned(points.size(), false), at_mesh(points.size(), false);
    const auto side = [](const Triangle& t, unsigned i) { return side_of(t, i); };
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (gone[t])
            for (unsigned i = 0; i < 3; ++i) {
                lines.insert(side(triangles[t], i));
                concerned[triangles[t][i]] = true;
            }
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (!gone[t])
            for (unsigned i = 0; i < 3; ++i) {
                at_mesh[triangles[t][i]] = true;
                if (concerned[triangles[t][i]]) lines.erase(side(triangles[t], i));
            }
    const auto length = [&](const Side& l) {
        const Point3 &p = points[l[0]], &q = points[l[1]];
        return length_bound(std::fabs(p.x - q.x), std::fabs(p.y - q.y), std::fabs(p.z - q.z));
    };
    std::vector<OpenLine> open_lines;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (!gone[t]) continue;
        // The longest side spans the line, and so do the two other sides together.
        std::array<double, 3> open{};
        for (unsigned i = 0; i < 3; ++i)
            open[i] = lines.contains(side(triangles[t], i)) ? length(side(triangles[t], i)) : 0;
        unsigned longest = 0;
        for (unsigned i = 1; i < 3; ++i)
            if (length(side(triangles[t], i)) > length(side(triangles[t], longest))) longest = i;
        const double others = std::max(open[(longest + 1) % 3], open[(longest + 2) % 3]);
        const double least = std::min(open[longest], others);
        if (least > 0)
            open_lines.push_back({triangles[t], least});
        else
            for (const std::uint32_t v : triangles[t]) at_mesh[v] = true;
    }
    largest_gap_ = std::max(largest_gap_, largest_gap(open_lines, at_mesh));
}

double RoundingState::total_gaps() const {
    return (gaps + largest_gap_) * (1 + 0x1p-51);
}

/// Merges equal points into the one with the lowest index. Only a dirty point can have become equal
/// to another. Returns per point whether others were merged into it; nothing if none were merged.
std::vector<bool> RoundingState::merge_points(const Run& run) {
    // This filter saves most look-ups. Its hash is quicker than hash_of(). + 0.0 turns -0 into 0.
    constexpr unsigned bits = 20;
    std::vector<bool> maybe(std::size_t{1} << bits, false);
    const auto slot = [](const Point3& p) {
        const auto word = [](double d) { return std::bit_cast<std::uint64_t>(d + 0.0); };
        return (word(p.x) * 0x9e3779b97f4a7c15u + word(p.y) * 0xc2b2ae3d27d4eb4fu +
                word(p.z) * 0x165667b19e3779f9u) >>
               (64 - bits);
    };
    for (std::uint32_t v = 0; v < points.size(); ++v)
        if (is_dirty[v]) maybe[slot(points[v])] = true;
    const auto candidates = concatenated(parts_of_ranges<std::vector<std::uint32_t>>(
        points.size(), run, [&](std::size_t begin, std::size_t end) {
            std::vector<std::uint32_t> part;
            for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v)
                if (maybe[slot(points[v])]) part.push_back(v);
            return part;
        }));
    PointTable table(candidates.size());
    std::vector<std::uint32_t> name;
    std::vector<bool> joined;
    for (const std::uint32_t v : candidates) {
        const std::uint32_t first = table.enter(points, v);
        if (first == v) continue;
        joined.resize(points.size(), false);
        joined[first] = true;
        is_dirty[first] = true;
        is_merged.resize(points.size(), false);
        is_merged[v] = true;
        if (name.empty()) {
            name.resize(points.size());
            std::iota(name.begin(), name.end(), 0u);
        }
        name[v] = first;
    }
    if (joined.empty()) return joined;
    for (Triangle& t : triangles)
        for (std::uint32_t& v : t) {
            if (name[v] == v) continue;
            move[name[v]] = std::max(move[name[v]], move[v]);
            v = name[v];
        }
    return joined;
}

bool RoundingState::tidy(const Run& run) {
    const std::vector<bool> joined = merge_points(run);
    const auto has_area = [&](const Triangle& t) {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
        return !collinear(points[t[0]], points[t[1]], points[t[2]]);
    };
    found_dirty = dirty_triangles(run);
    const auto lost = concatenated(parts_of_ranges<std::vector<std::uint32_t>>(
        found_dirty.size(), run, [&](std::size_t begin, std::size_t end) {
            std::vector<std::uint32_t> part;
            for (std::size_t k = begin; k < end; ++k)
                if (!has_area(triangles[found_dirty[k]])) part.push_back(found_dirty[k]);
            return part;
        }));
    collapsed += lost.size();
    if (lost.empty() && joined.empty()) return false;
    std::vector<bool> gone(triangles.size(), false), at_lost(points.size(), false);
    for (const std::uint32_t t : lost) {
        gone[t] = true;
        for (const std::uint32_t v : triangles[t]) at_lost[v] = true;
    }
    if (!lost.empty()) find_gaps(gone);
    const CollapsedTriangles lines(points, triangles, lost);
    const auto with_corner = [&](std::span<const std::uint32_t> all, const std::vector<bool>& in) {
        std::vector<std::uint32_t> some;
        for (const std::uint32_t t : all)
            if (std::ranges::any_of(triangles[t], [&](std::uint32_t v) { return in[v]; }))
                some.push_back(t);
        return some;
    };
    // Of two triangles that became equal, one has a corner that took the place of another.
    join_equal(joined.empty() ? std::vector<std::uint32_t>() : with_corner(found_dirty, joined),
               gone);
    if (!lost.empty() && divide_sides(lines)) {
        gone.assign(triangles.size(), false);
        // Of two that are equal now, one is a part, and has a corner of a dropped triangle.
        join_equal(with_corner(dirty_triangles(run), at_lost), gone);
    }
    return true;
}

/// Divides triangles at the points of collapsed triangles inside their sides. These points become
/// dirty, because the corners between which they lie may be. Returns whether it divided any.
bool RoundingState::divide_sides(const CollapsedTriangles& lines) {
    std::size_t inside = 0; // each divides a triangle in two
    std::vector<bool> is_divided(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (const std::size_t count = lines.count_within(triangles[t]); count > 0) {
            inside += count;
            is_divided[t] = true;
        }
    is_torn |= inside > (rounding_tuning.multiplied - 1) * all_triangles();
    if (inside == 0 || is_torn) return false;
    std::vector<Triangle> fresh;
    fresh.reserve(triangles.size() + inside);
    IndexLists<std::uint32_t> faces_of;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const std::size_t first = fresh.size();
        PointsInSides within;
        if (is_divided[t]) within = lines.within(triangles[t]);
        divide_at(triangles[t], within, fresh);
        for (std::size_t k = first; k < fresh.size(); ++k) faces_of.push_back(std::array{t});
        for (const auto& side : within)
            for (const std::uint32_t v : side) is_dirty[v] = true;
    }
    replace_triangles(std::move(fresh), faces_of);
    return true;
}

/// Drops the triangles that are gone. Of equal triangles it keeps the first, which gets the parents
/// of all.
void RoundingState::join_equal(std::span<const std::uint32_t> dirty, std::vector<bool>& gone) {
    std::unordered_map<Triangle, std::uint32_t, TriangleHash> seen; // by sorted corners
    seen.reserve(dirty.size());
    std::map<std::uint32_t, std::vector<std::uint32_t>> extra;
    for (const std::uint32_t t : dirty) {
        if (gone[t]) continue;
        const auto [it, fresh] = seen.emplace(sorted(triangles[t]), t);
        if (fresh) continue;
        gone[t] = true;
        auto& list = extra[it->second];
        list.insert(list.end(), parents_of[t].begin(), parents_of[t].end());
    }
    IndexLists<std::uint32_t> parents;
    parents.offsets.reserve(parents_of.offsets.size());
    parents.values.reserve(parents_of.values.size());
    std::size_t kept = 0;
    auto more = extra.begin();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (gone[t]) continue;
        if (!origins.empty()) origins[kept] = origins[t];
        triangles[kept++] = triangles[t];
        if (more == extra.end() || more->first != t) {
            parents.push_back(parents_of[t]);
            continue;
        }
        auto& list = more++->second;
        list.insert(list.end(), parents_of[t].begin(), parents_of[t].end());
        sort_unique(list);
        parents.push_back(list);
    }
    triangles.resize(kept);
    if (!origins.empty()) origins.resize(kept);
    parents_of = std::move(parents);
}

void RoundingState::open_closed_parts(double moved) {
    constexpr std::size_t least = 4; // the faces of a tetrahedron
    const auto parts = parts_of_inputs(parents_of);
    std::map<std::uint32_t, std::set<std::uint32_t>> taken; // from parents, per triangle
    for (std::uint32_t p = 0; p < parts.size(); ++p)
        if (parts[p].size() >= least)
            for (const std::uint32_t t : superfluous_parts(triangles, parents_of, parts[p]))
                taken[t].insert(p);
    if (taken.empty()) return;
    IndexLists<std::uint32_t> left;
    std::vector<bool> gone(triangles.size(), false);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto from = taken.find(t);
        for (const std::uint32_t p : parents_of[t])
            if (from == taken.end() || !from->second.contains(p)) left.values.push_back(p);
        left.close();
        gone[t] = left[t].empty();
    }
    parents_of = std::move(left);
    join_equal({}, gone);
    largest_gap_ = std::max(largest_gap_, moved);
}

void RoundingState::replace_triangles(std::vector<Triangle> fresh,
                                      const IndexLists<std::uint32_t>& faces_of) {
    IndexLists<std::uint32_t> parents;
    parents.offsets.reserve(fresh.size() + 1);
    parents.values.reserve(parents_of.values.size());
    std::vector<std::uint32_t> list, fresh_origins;
    for (std::size_t t = 0; t < fresh.size(); ++t) {
        if (!origins.empty()) fresh_origins.push_back(origins[faces_of[t][0]]);
        list.clear();
        for (const std::uint32_t f : faces_of[t])
            list.insert(list.end(), parents_of[f].begin(), parents_of[f].end());
        if (faces_of[t].size() > 1) sort_unique(list);
        parents.push_back(list);
    }
    triangles = std::move(fresh);
    origins = std::move(fresh_origins);
    parents_of = std::move(parents);
}

std::size_t RoundingState::merged() const {
    return static_cast<std::size_t>(std::count(is_merged.begin(), is_merged.end(), true));
}

void RoundingState::drop_unused_points() {
    const VertexRenumbering numbers(used_vertices(points.size(), triangles));
    numbers.compact(points);
    numbers.rename(triangles);
}

} // namespace terrane::rounding::detail
