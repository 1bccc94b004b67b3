// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/joining/detail/curve.hpp>

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::joining::detail {
namespace {

Error not_closed(const BorderLine& border, std::size_t wall, const char* how) {
    return {ErrorCode::not_closed, std::string("the strip along the border ") + how,
            "border vertex " + std::to_string(border.vertices[wall]) + " " +
                place_text(border.points[wall])};
}

/// An edge shared by a strip and the filling; vertices are those of the arrangement.
struct CurveEdge {
    Edge ends{};
    std::uint32_t wall = 0;
    std::array<std::uint32_t, 2> triangles{}; ///< of the filling, on its two sides
};

/// The closed line along a border, oriented like its loop.
struct CurveLine {
    std::vector<std::uint32_t> vertices; ///< of the arrangement; edge k runs from vertex k to k + 1
    std::vector<CurveEdge> edges;
    std::vector<std::uint32_t> corner_at; ///< per border point: index of its corner in `vertices`
    Sign front{}; ///< Positive if the front of the filling is where the normals point
};

/// Finds the line that a strip (surface `strip` of the arrangement) cuts into the filling.
class LineFinder {
public:
    LineFinder(const BorderLine& border, const Arrangement& arrangement, std::uint32_t strip) :
        border_(border), a_(arrangement), strip_(strip),
        filling_(static_cast<std::uint32_t>(arrangement.surfaces.size() - 1)) {}

    Result<CurveLine> operator()() {
        if (const auto done = find_curve(); !done) return done.error();
        if (const auto done = find_line(); !done) return done.error();
        const auto front = direction();
        if (!front) return front.error();
        line_.front = front.value();
        return line_;
    }

private:
    [[nodiscard]] std::size_t walls() const { return border_.points.size(); }
    [[nodiscard]] Error fault(std::size_t wall, const char* how) const {
        return not_closed(border_, wall, how);
    }
    Status find_curve();
    Status find_line();
    Status walk(std::span<const std::uint32_t> edges);
    Status find_corners();
    [[nodiscard]] Result<Sign> direction() const;

    const BorderLine& border_;
    const Arrangement& a_;
    std::uint32_t strip_, filling_;
    std::vector<CurveEdge> curve_;
    CurveLine line_;
};

/// Finds all edges shared by strip and filling, with the wall that each lies on.
Status LineFinder::find_curve() {
    const std::uint32_t first = a_.inputs.first[strip_];
    for (std::uint32_t t = 0; t < a_.triangles.size(); ++t)
        if (const auto list = a_.surfaces_of[t]; list.size() > 1 && list[0] == strip_)
            return fault((a_.parents_of[t][0] - first) / 2, "and the filling overlap in an area");
    for (std::size_t e = 0; e < a_.state->adjacency.edges.size(); ++e) {
        std::vector<std::uint32_t> of_filling, on_walls;
        for (const std::uint32_t t : a_.state->adjacency.triangles_at[e])
            if (a_.surfaces_of[t][0] == filling_)
                of_filling.push_back(t);
            else if (a_.surfaces_of[t][0] == strip_)
                for (const std::uint32_t p : a_.parents_of[t]) on_walls.push_back((p - first) / 2);
        if (of_filling.empty() || on_walls.empty()) continue;
        sort_unique(on_walls);
        if (on_walls.size() > 1)
            return fault(on_walls[0], "meets the filling along a normal or crosses itself there");
        if (of_filling.size() != 2)
            return fault(on_walls[0], "meets the filling where that ends or is no simple sheet");
        curve_.push_back(
            {a_.state->adjacency.edges[e], on_walls[0], {of_filling[0], of_filling[1]}});
    }
    return Done{};
}

/// Finds the connected part of the curve that passes the most walls.
Status LineFinder::find_line() {
    DisjointSets sets(a_.vertices.size());
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
        return fault(static_cast<std::size_t>(missed - best.begin()),
                     "does not cut the filling in one line: it misses it here");
    if (const auto done = walk(*found); !done) return done.error();
    return find_corners();
}

/// Orders the edges of a line.
Status LineFinder::walk(std::span<const std::uint32_t> edges) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> at;
    for (const std::uint32_t e : edges)
        for (const std::uint32_t v : curve_[e].ends) at[v].push_back(e);
    for (const auto& [v, list] : at)
        if (list.size() != 2)
            return fault(curve_[list[0]].wall, "cuts the filling in a line that branches or ends");
    std::uint32_t vertex = curve_[edges[0]].ends[0], edge = edges[0];
    do {
        line_.vertices.push_back(vertex);
        line_.edges.push_back(curve_[edge]);
        const Edge& ends = curve_[edge].ends;
        vertex = ends[0] == vertex ? ends[1] : ends[0];
        const auto& next = at.at(vertex);
        edge = next[0] == edge ? next[1] : next[0];
    } while (edge != edges[0]);
    return Done{};
}

/// Orients the line like the loop and finds the vertices at which it passes from wall to wall.
Status LineFinder::find_corners() {
    const std::size_t n = line_.edges.size();
    const auto wall = [&](std::size_t k) { return line_.edges[k % n].wall; };
    std::size_t forward = 0, backward = 0;
    for (std::size_t k = 0; k < n; ++k) {
        forward += wall(k + 1) == (wall(k) + 1) % walls() ? 1 : 0;
        backward += wall(k) == (wall(k + 1) + 1) % walls() ? 1 : 0;
    }
    if (backward > forward) { // edge k then starts at vertex k + 1
        std::reverse(line_.vertices.begin() + 1, line_.vertices.end());
        std::reverse(line_.edges.begin(), line_.edges.end());
    }
    std::vector<std::optional<std::uint32_t>> corners(walls());
    for (std::size_t k = 0; k < n; ++k) {
        const std::uint32_t here = wall(k + n - 1), next = wall(k);
        if (here == next) continue;
        if (next != (here + 1) % walls() || corners[next])
            return fault(next, "cuts the filling in a line that does not follow the border");
        corners[next] = static_cast<std::uint32_t>(k);
    }
    for (std::size_t i = 0; i < walls(); ++i) {
        if (!corners[i]) return fault(i, "cuts the filling in a line that misses a normal");
        line_.corner_at.push_back(*corners[i]);
    }
    return Done{};
}

/// Determines the orientation of the filling from the sides of its triangles on which the upper
/// ends of the normals lie.
Result<Sign> LineFinder::direction() const {
    std::optional<Sign> common;
    const auto points = a_.state->points.inputs();
    const std::uint32_t first = a_.inputs.first_vertex[strip_];
    for (std::size_t i = 0; i < walls(); ++i)
        for (const std::uint32_t t : line_.edges[line_.corner_at[i]].triangles) {
            const Triangle& c = a_.state->corners[a_.parents_of[t][0]];
            const Point3& top = points[first + 2 * i + 1];
            const Sign side = orient3d(points[c[0]], points[c[1]], points[c[2]], top);
            if (side == Sign::Zero) continue;
            if (common && *common != side)
                return fault(i, "cuts a filling whose front changes sides");
            common = side;
        }
    return common ? Result<Sign>(*common) : fault(0, "lies in the filling");
}

/// Step (4): collects the triangles connected to the inner side of the hole's line.
class InnerPartFinder {
public:
    InnerPartFinder(const Arrangement& arrangement, std::vector<std::optional<CurveLine>> lines) :
        a_(arrangement), filling_(static_cast<std::uint32_t>(arrangement.surfaces.size() - 1)),
        lines_(std::move(lines)) {
        for (std::uint32_t t = 0; t < a_.triangles.size(); ++t)
            if (a_.surfaces_of[t][0] == filling_) {
                of_filling_.push_back(t);
                corners_.push_back(a_.triangles[t]);
            }
    }

    Result<InnerPart> operator()() {
        DisjointSets sets(corners_.size());
        const auto flaws = join_neighbours(sets);
        if (const auto done = spread(sets, flaws); !done) return done.error();
        if (!is_disk_with_holes())
            return Error{ErrorCode::not_closed,
                         "the strip cuts the filling in a line that does not enclose a disk",
                         place_text(point(lines_[0]->vertices[0]))};
        return part();
    }

private:
    /// Triangles (indices into of_filling_) at edges that do not have two triangles of the filling.
    struct Flaws {
        std::vector<std::uint32_t> border, crowded;
    };
    [[nodiscard]] Point3 point(std::uint32_t v) const {
        return a_.state->points.nearest(a_.vertices[v]);
    }
    [[nodiscard]] Flaws join_neighbours(DisjointSets& sets) const;
    Status spread(DisjointSets& sets, const Flaws& flaws);
    [[nodiscard]] bool is_disk_with_holes() const;
    [[nodiscard]] Result<InnerPart> part() const;

    /// Calls visit(index into of_filling_, whether on the left) for the triangles along a line.
    template <class Visit>
    void beside(const CurveLine& line, const Visit& visit) const {
        const std::size_t n = line.edges.size();
        for (std::size_t k = 0; k < n; ++k)
            for (const std::uint32_t t : line.edges[k].triangles) {
                const bool along =
                    runs_along(a_.triangles[t], line.vertices[k], line.vertices[(k + 1) % n]);
                const auto at = std::lower_bound(of_filling_.begin(), of_filling_.end(), t);
                visit(static_cast<std::uint32_t>(at - of_filling_.begin()),
                      along == (line.front == Sign::Positive));
            }
    }

    const Arrangement& a_;
    std::uint32_t filling_;
    std::vector<std::optional<CurveLine>> lines_; ///< per border; nullopt if there is none
    std::vector<std::uint32_t> of_filling_;       ///< triangles of the arrangement, ascending
    std::vector<Triangle> corners_;               ///< of these triangles
    std::vector<std::uint32_t> borders_;          ///< the borders of the inner part
    std::vector<std::uint32_t> inside_;           ///< triangles of the arrangement, ascending
};

/// Joins triangles of the filling across all edges that are not on a line.
InnerPartFinder::Flaws InnerPartFinder::join_neighbours(DisjointSets& sets) const {
    std::vector<Edge> stops;
    for (const auto& line : lines_)
        if (line)
            for (const CurveEdge& e : line->edges) stops.push_back(e.ends);
    std::sort(stops.begin(), stops.end());
    Flaws flaws;
    group_edges(corners_, a_.vertices.size())
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (std::binary_search(stops.begin(), stops.end(), Edge{low, high})) return;
            if (sides.size() == 1) flaws.border.push_back(sides[0].triangle);
            if (sides.size() > 2) flaws.crowded.push_back(sides[0].triangle);
            for (const auto& s : sides) sets.join(sides[0].triangle, s.triangle);
        });
    return flaws;
}

/// Collects the triangles connected to the inner side of the hole's line. Other lines that are
/// reached belong to islands. The surface lies on the left of each border, so the part to be filled
/// lies on the right.
Status InnerPartFinder::spread(DisjointSets& sets, const Flaws& flaws) {
    std::vector<bool> reached(corners_.size(), false);
    beside(*lines_[0], [&](std::uint32_t t, bool left) {
        if (!left) reached[sets.find(t)] = true;
    });
    const auto fault = [&](ErrorCode code, const char* what, std::uint32_t t) {
        return Error{code, what, place_text(point(corners_[t][0]))};
    };
    for (const std::uint32_t t : flaws.crowded)
        if (reached[sets.find(t)])
            return fault(ErrorCode::improper_contact, "the filling meets itself inside the hole",
                         t);
    for (const std::uint32_t t : flaws.border)
        if (reached[sets.find(t)])
            return fault(ErrorCode::not_closed, "the filling has a border inside the hole", t);
    for (std::uint32_t b = 0; b < lines_.size(); ++b) {
        if (!lines_[b]) continue;
        std::optional<std::uint32_t> on_left, on_right;
        beside(*lines_[b], [&](std::uint32_t t, bool left) {
            if (reached[sets.find(t)]) (left ? on_left : on_right) = t;
        });
        if (on_left)
            return fault(ErrorCode::not_closed,
                         "the line along the border does not divide the filling", *on_left);
        if (on_right) borders_.push_back(b);
    }
    for (std::uint32_t t = 0; t < corners_.size(); ++t)
        if (reached[sets.find(t)]) inside_.push_back(of_filling_[t]);
    return Done{};
}

/// Tells whether the inner part is connected and has the lines as its only borders: V - E + F = 2 -
/// number of lines.
bool InnerPartFinder::is_disk_with_holes() const {
    std::vector<std::uint32_t> vertices;
    DisjointSets sets(a_.vertices.size());
    for (const std::uint32_t t : inside_)
        for (const std::uint32_t v : a_.triangles[t]) {
            vertices.push_back(v);
            sets.join(a_.triangles[t][0], v);
        }
    sort_unique(vertices);
    std::size_t twice_edges = 3 * inside_.size();
    for (const std::uint32_t b : borders_) twice_edges += lines_[b]->edges.size();
    const bool one = std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) {
        return sets.find(v) == sets.find(vertices[0]);
    });
    return one && 2 * (vertices.size() + inside_.size() + borders_.size()) == twice_edges + 4;
}

Result<InnerPart> InnerPartFinder::part() const {
    const auto first = a_.inputs.first_vertex[filling_];
    std::vector<std::uint32_t> of_lines, used;
    for (const std::uint32_t b : borders_)
        of_lines.insert(of_lines.end(), lines_[b]->vertices.begin(), lines_[b]->vertices.end());
    std::vector<bool> on_line(a_.vertices.size(), false);
    for (const std::uint32_t v : of_lines) on_line[v] = true;
    for (const std::uint32_t t : inside_)
        for (const std::uint32_t v : a_.triangles[t])
            if (!on_line[v]) used.push_back(v);
    sort_unique(used);
    InnerPart part;
    part.borders = borders_;
    std::vector<std::uint32_t> name(a_.vertices.size(), UINT32_MAX);
    const auto add = [&](std::uint32_t v) {
        name[v] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(point(v));
    };
    for (const std::uint32_t v : used) {
        const PointIndex p = a_.vertices[v];
        if (!a_.state->points.is_input(p) || p < first)
            return Error{ErrorCode::improper_contact,
                         "the filling crosses itself, or a strip, inside the hole",
                         place_text(point(v))};
        add(v);
        part.filling.push_back(p - first);
    }
    for (const std::uint32_t v : of_lines) add(v);
    for (const std::uint32_t t : inside_) {
        Triangle c = a_.triangles[t];
        if (lines_[0]->front == Sign::Negative) std::swap(c[1], c[2]);
        part.triangles.push_back({name[c[0]], name[c[1]], name[c[2]]});
    }
    for (const std::uint32_t b : borders_) {
        const CurveLine& line = *lines_[b];
        std::vector<bool> is_corner(line.vertices.size(), false);
        for (const std::uint32_t k : line.corner_at) {
            is_corner[k] = true;
            part.corners.push_back(name[line.vertices[k]]);
        }
        for (std::size_t k = 0; k < line.vertices.size(); ++k)
            if (!is_corner[k]) part.between.push_back(name[line.vertices[k]]);
    }
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

Result<InnerPart> cut_inner_part(std::span<const BorderLine> borders, const Surface& filling,
                                 double half_width, Search search, const Run& run) {
    std::vector<Surface> all;
    for (const BorderLine& border : borders) all.push_back(strip_along(border, half_width));
    all.push_back(filling);
    const auto arrangement = arrange(all, {.search = search}, run);
    if (!arrangement) return arrangement.error();
    std::vector<std::optional<CurveLine>> lines;
    for (std::uint32_t b = 0; b < borders.size(); ++b) {
        auto line = LineFinder(borders[b], arrangement.value(), b)();
        if (!line && b == 0) return line.error();
        lines.push_back(line ? std::optional(std::move(line).value()) : std::nullopt);
    }
    return InnerPartFinder(arrangement.value(), std::move(lines))();
}

} // namespace terrane::joining::detail
