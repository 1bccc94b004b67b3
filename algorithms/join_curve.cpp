// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/join_curve.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include <terrane/algorithms/arrangement.hpp>
#include <terrane/algorithms/edges.hpp>
#include <terrane/algorithms/sets.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t strip_surface = 0, filling_surface = 1; ///< order in the arrangement

std::string place_of(const BorderLine& border, std::size_t i) {
    const Point3& p = border.points[i];
    return "border vertex " + std::to_string(border.vertices[i]) + " (" + std::to_string(p.x) +
           ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
}

std::string place_of(const Point3& p) {
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) +
           ")";
}

/// An edge that the strip and the filling share. Vertices are those of the arrangement.
struct CurveEdge {
    Edge ends{};
    std::uint32_t wall = 0;
    std::array<std::uint32_t, 2> triangles{}; ///< of the filling, on its sides
};

/// The closed line round the hole, in the direction of the loop.
struct CurveLine {
    std::vector<std::uint32_t> vertices; ///< of the arrangement; from vertex k to k + 1 runs edge k
    std::vector<std::uint32_t> edges;    ///< indices into the curve's edges
    std::vector<std::uint32_t> corner_at; ///< per border point: where in `vertices` its corner is
};

class InnerPartFinder {
public:
    InnerPartFinder(const BorderLine& border, const Arrangement& arrangement) :
        border_(border), a_(arrangement) {}

    Result<InnerPart> operator()() {
        if (const auto done = find_curve(); !done) return done.error();
        if (const auto done = find_line(); !done) return done.error();
        const auto sign = direction();
        if (!sign) return sign.error();
        if (const auto done = spread(sign.value()); !done) return done.error();
        return part(sign.value());
    }

private:
    [[nodiscard]] bool of_surface(std::uint32_t t, std::uint32_t s) const {
        const auto list = a_.surfaces_of[t];
        return list.size() == 1 && list[0] == s;
    }
    [[nodiscard]] Point3 point(std::uint32_t v) const { return a_.points.nearest(a_.vertices[v]); }
    [[nodiscard]] std::size_t walls() const { return border_.points.size(); }

    Status find_curve();
    Status find_line();
    Status walk(std::span<const std::uint32_t> edges);
    Status find_corners();
    Result<Sign> direction() const;
    Status spread(Sign sign);
    [[nodiscard]] bool is_disk() const;
    Result<InnerPart> part(Sign sign) const;
    [[nodiscard]] Error not_closed(std::size_t wall, const char* how) const {
        return {ErrorCode::not_closed, std::string("the strip along the border ") + how,
                place_of(border_, wall)};
    }

    const BorderLine& border_;
    const Arrangement& a_;
    std::vector<CurveEdge> curve_;
    CurveLine line_;
    std::vector<std::uint32_t> inside_; ///< triangles of the arrangement, ascending
};

/// All edges that strip and filling share, each with the wall it lies on.
Status InnerPartFinder::find_curve() {
    for (std::uint32_t t = 0; t < a_.triangles.size(); ++t)
        if (a_.surfaces_of[t].size() > 1) {
            const std::uint32_t wall = a_.parents_of[t][0] / 2;
            return not_closed(wall, "and the filling overlap in an area");
        }
    for (std::size_t e = 0; e < a_.adjacency.edges.size(); ++e) {
        std::vector<std::uint32_t> of_filling, on_walls;
        for (const std::uint32_t t : a_.adjacency.triangles_at[e])
            if (of_surface(t, filling_surface))
                of_filling.push_back(t);
            else
                for (const std::uint32_t p : a_.parents_of[t]) on_walls.push_back(p / 2);
        if (of_filling.empty() || on_walls.empty()) continue;
        sort_unique(on_walls);
        if (on_walls.size() > 1)
            return not_closed(on_walls[0],
                              "meets the filling along a normal or crosses itself there");
        if (of_filling.size() != 2)
            return not_closed(on_walls[0],
                              "meets the filling where that ends or is no simple sheet");
        curve_.push_back({a_.adjacency.edges[e], on_walls[0], {of_filling[0], of_filling[1]}});
    }
    return Done{};
}

/// The connected part of the curve that passes the most walls: the line round the hole.
Status InnerPartFinder::find_line() {
    Sets sets(a_.vertices.size());
    for (const CurveEdge& e : curve_) sets.join(e.ends[0], e.ends[1]);
    std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
    for (std::uint32_t e = 0; e < curve_.size(); ++e)
        parts[sets.find(curve_[e].ends[0])].push_back(e);
    std::vector<bool> best(walls(), false);
    const std::vector<std::uint32_t>* found = nullptr;
    for (const auto& [name, edges] : parts) {
        std::vector<bool> passed(walls(), false);
        for (const std::uint32_t e : edges) passed[curve_[e].wall] = true;
        if (std::count(passed.begin(), passed.end(), true) >
            std::count(best.begin(), best.end(), true)) {
            best = passed;
            found = &edges;
        }
    }
    const auto missed = std::find(best.begin(), best.end(), false);
    if (missed != best.end())
        return not_closed(static_cast<std::size_t>(missed - best.begin()),
                          "does not cut the filling in one line: it misses it here");
    if (const auto done = walk(*found); !done) return done.error();
    return find_corners();
}

/// The edges in order, from one to the next.
Status InnerPartFinder::walk(std::span<const std::uint32_t> edges) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> at;
    for (const std::uint32_t e : edges)
        for (const std::uint32_t v : curve_[e].ends) at[v].push_back(e);
    for (const auto& [v, list] : at)
        if (list.size() != 2)
            return not_closed(curve_[list[0]].wall,
                              "cuts the filling in a line that branches or ends");
    std::uint32_t vertex = curve_[edges[0]].ends[0], edge = edges[0];
    do {
        line_.vertices.push_back(vertex);
        line_.edges.push_back(edge);
        const Edge& ends = curve_[edge].ends;
        vertex = ends[0] == vertex ? ends[1] : ends[0];
        const auto& next = at.at(vertex);
        edge = next[0] == edge ? next[1] : next[0];
    } while (edge != edges[0]);
    return Done{};
}

/// Turns the line into the loop's direction and finds where it passes from wall to wall.
Status InnerPartFinder::find_corners() {
    const std::size_t n = line_.edges.size();
    const auto wall = [&](std::size_t k) { return curve_[line_.edges[k % n]].wall; };
    std::size_t forward = 0, backward = 0;
    for (std::size_t k = 0; k < n; ++k) {
        forward += wall(k + 1) == (wall(k) + 1) % walls() ? 1 : 0;
        backward += wall(k) == (wall(k + 1) + 1) % walls() ? 1 : 0;
    }
    if (backward > forward) { // vertex k + 1 comes first on edge k, then
        std::reverse(line_.vertices.begin() + 1, line_.vertices.end());
        std::reverse(line_.edges.begin(), line_.edges.end());
    }
    std::vector<std::optional<std::uint32_t>> corners(walls());
    for (std::size_t k = 0; k < n; ++k) {
        const std::uint32_t here = wall(k + n - 1), next = wall(k);
        if (here == next) continue;
        if (next != (here + 1) % walls() || corners[next])
            return not_closed(next, "cuts the filling in a line that does not follow the border");
        corners[next] = static_cast<std::uint32_t>(k);
    }
    for (std::size_t i = 0; i < walls(); ++i) {
        if (!corners[i]) return not_closed(i, "cuts the filling in a line that misses a normal");
        line_.corner_at.push_back(*corners[i]);
    }
    return Done{};
}

/// Whether the front of the filling is where the normals point, by the sides on which the upper
/// ends of the normals lie.
Result<Sign> InnerPartFinder::direction() const {
    std::optional<Sign> common;
    for (std::size_t i = 0; i < walls(); ++i) {
        const std::size_t edge = line_.edges[line_.corner_at[i]];
        const auto top = static_cast<std::uint32_t>(2 * i + 1);
        for (const std::uint32_t t : curve_[edge].triangles) {
            const Triangle& c = a_.inputs.corners[a_.parents_of[t][0]];
            const auto points = a_.points.inputs();
            const Sign side = orient3d(points[c[0]], points[c[1]], points[c[2]], points[top]);
            // Wound counterclockwise as seen from d where orient3d is Positive.
            if (side == Sign::Zero) continue;
            if (common && *common != side)
                return not_closed(i, "cuts a filling whose front changes sides");
            common = side;
        }
    }
    return common ? Result<Sign>(*common) : not_closed(0, "lies in the filling");
}

/// Step (4): from the triangles on the line's inner side over all edges but the line's.
Status InnerPartFinder::spread(Sign sign) {
    std::vector<std::uint32_t> of_filling;
    for (std::uint32_t t = 0; t < a_.triangles.size(); ++t)
        if (of_surface(t, filling_surface)) of_filling.push_back(t);
    std::vector<Triangle> corners;
    for (const std::uint32_t t : of_filling) corners.push_back(a_.triangles[t]);
    std::vector<Edge> stops;
    std::vector<bool> is_inside(corners.size(), false), is_outside(corners.size(), false);
    const std::size_t n = line_.edges.size();
    for (std::size_t k = 0; k < n; ++k) {
        const CurveEdge& e = curve_[line_.edges[k]];
        stops.push_back(e.ends);
        const std::uint32_t from = line_.vertices[k], to = line_.vertices[(k + 1) % n];
        for (const std::uint32_t t : e.triangles) {
            const auto local = static_cast<std::size_t>(
                std::lower_bound(of_filling.begin(), of_filling.end(), t) - of_filling.begin());
            // The surface lies on the left, so what is inside lies on the right.
            const bool left = runs_along(a_.triangles[t], from, to) == (sign == Sign::Positive);
            (left ? is_outside : is_inside)[local] = true;
        }
    }
    std::sort(stops.begin(), stops.end());
    Sets sets(corners.size());
    std::vector<std::uint32_t> at_border, crowded;
    group_edges(corners, a_.vertices.size())
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (std::binary_search(stops.begin(), stops.end(), Edge{low, high})) return;
            if (sides.size() == 1) at_border.push_back(sides[0].triangle);
            if (sides.size() > 2) crowded.push_back(sides[0].triangle);
            for (const auto& s : sides) sets.join(sides[0].triangle, s.triangle);
        });
    std::vector<bool> reached(corners.size(), false), beyond(corners.size(), false);
    for (std::uint32_t t = 0; t < corners.size(); ++t) {
        if (is_inside[t]) reached[sets.find(t)] = true;
        if (is_outside[t]) beyond[sets.find(t)] = true;
    }
    for (const std::uint32_t t : crowded)
        if (reached[sets.find(t)])
            return Error{ErrorCode::improper_contact, "the filling meets itself inside the hole",
                         place_of(point(corners[t][0]))};
    for (const std::uint32_t t : at_border)
        if (reached[sets.find(t)])
            return Error{ErrorCode::not_closed, "the filling has a border inside the hole",
                         place_of(point(corners[t][0]))};
    for (std::uint32_t t = 0; t < corners.size(); ++t) {
        const std::uint32_t set = sets.find(t);
        if (reached[set] && beyond[set])
            return Error{ErrorCode::not_closed,
                         "the line round the hole does not divide the filling",
                         place_of(point(corners[t][0]))};
        if (reached[set]) inside_.push_back(of_filling[t]);
    }
    return Done{};
}

/// Connected, with the line as its only border: a disk iff V - E + F = 1.
bool InnerPartFinder::is_disk() const {
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t t : inside_)
        for (const std::uint32_t v : a_.triangles[t]) vertices.push_back(v);
    sort_unique(vertices);
    const std::size_t twice_edges = 3 * inside_.size() + line_.edges.size();
    Sets sets(a_.vertices.size());
    for (const std::uint32_t t : inside_)
        for (const std::uint32_t v : a_.triangles[t]) sets.join(a_.triangles[t][0], v);
    const bool one = std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) {
        return sets.find(v) == sets.find(vertices[0]);
    });
    return one && 2 * (vertices.size() + inside_.size()) == twice_edges + 2;
}

Result<InnerPart> InnerPartFinder::part(Sign sign) const {
    if (!is_disk()) return not_closed(0, "cuts the filling in a line that does not enclose a disk");
    const auto first = a_.inputs.first_vertex[filling_surface];
    std::vector<std::uint32_t> of_line = line_.vertices, used;
    std::sort(of_line.begin(), of_line.end());
    for (const std::uint32_t t : inside_)
        for (const std::uint32_t v : a_.triangles[t])
            if (!std::binary_search(of_line.begin(), of_line.end(), v)) used.push_back(v);
    sort_unique(used);
    InnerPart part;
    std::vector<std::uint32_t> name(a_.vertices.size(), UINT32_MAX);
    const auto add = [&](std::uint32_t v) {
        name[v] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(point(v));
    };
    for (const std::uint32_t v : used) {
        const PointIndex p = a_.vertices[v];
        if (!a_.points.is_input(p) || p < first)
            return Error{ErrorCode::improper_contact,
                         "the filling crosses itself, or the strip, inside the hole",
                         place_of(point(v))};
        add(v);
        part.filling.push_back(p - first);
    }
    for (const std::uint32_t v : line_.vertices) add(v);
    for (const std::uint32_t t : inside_) {
        Triangle c = a_.triangles[t];
        if (sign == Sign::Negative) std::swap(c[1], c[2]);
        part.triangles.push_back({name[c[0]], name[c[1]], name[c[2]]});
    }
    std::vector<bool> is_corner(line_.vertices.size(), false);
    for (const std::uint32_t k : line_.corner_at) {
        is_corner[k] = true;
        part.corners.push_back(name[line_.vertices[k]]);
    }
    for (std::size_t k = 0; k < line_.vertices.size(); ++k)
        if (!is_corner[k]) part.between.push_back(name[line_.vertices[k]]);
    return part;
}

} // namespace

Surface strip_along(const BorderLine& border, double half_width) {
    Surface strip{"strip", Role::unknown, {}, {}};
    const auto n = static_cast<std::uint32_t>(border.points.size());
    for (std::size_t i = 0; i < n; ++i) {
        const Point3 &p = border.points[i], &u = border.normals[i];
        for (const double d : {-half_width, half_width})
            strip.vertices.push_back({p.x + d * u.x, p.y + d * u.y, p.z + d * u.z});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        strip.triangles.push_back({2 * i, 2 * j, 2 * j + 1});
        strip.triangles.push_back({2 * i, 2 * j + 1, 2 * i + 1});
    }
    return strip;
}

Result<InnerPart> cut_inner_part(const BorderLine& border, const Surface& filling,
                                 double half_width, Search search, const Run& run) {
    const std::array<Surface, 2> both{strip_along(border, half_width), filling};
    const auto arrangement = arrange(both, {.search = search}, run);
    if (!arrangement) return arrangement.error();
    return InnerPartFinder(border, arrangement.value())();
}

} // namespace terrane
