// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/joining/join.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/joining/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/joining/detail/curve.hpp>
#include <terrane/algorithms/reconstruction/joining/disk_mesh.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {

using namespace joining::detail;

namespace {

/// Finds vertices in a loop by their coordinates, so that equal points count as one.
class LoopNames {
public:
    LoopNames(const Surface& surface, std::span<const std::uint32_t> loop) : surface_(surface) {
        for (std::uint32_t i = 0; i < loop.size(); ++i)
            at_.emplace_back(surface.vertices[loop[i]], i);
        std::sort(at_.begin(), at_.end());
    }
    /// Returns the position of the vertex in the loop, if any.
    [[nodiscard]] std::optional<std::uint32_t> operator()(std::uint32_t vertex) const {
        const Point3& p = surface_.vertices[vertex];
        const auto found = std::lower_bound(at_.begin(), at_.end(), std::pair(p, 0U));
        if (found == at_.end() || found->first != p) return std::nullopt;
        return found->second;
    }

private:
    const Surface& surface_;
    std::vector<std::pair<Point3, std::uint32_t>> at_;
};

/// A border as points and normals, with the edges of the surface that are chords of it.
struct Border {
    BorderLine line;
    std::vector<Edge> chords; ///< edges of the surface between positions of the loop that are not
                              ///< adjacent, lower position first; sorted
    double median_edge = 0;
};

Point3 unit(const Point3& a) {
    const double size = length(a);
    return size > 0 ? Point3{a.x / size, a.y / size, a.z / size} : Point3{};
}

/// Computes, for each border edge, the normal of its triangle, oriented so that the surface is on
/// the left of the loop. Collects the chords as well.
Result<std::vector<Point3>> edge_normals(const Surface& surface, const LoopNames& names,
                                         std::size_t n, std::vector<Edge>& chords) {
    std::vector<Point3> normals(n);
    for (const Triangle& t : surface.triangles)
        for (unsigned k = 0; k < 3; ++k) {
            const auto from = names(t[k]), to = names(t[(k + 1) % 3]);
            if (!from || !to) continue;
            const bool along = *to == (*from + 1) % n, against = *from == (*to + 1) % n;
            if (!along && !against) {
                chords.push_back({std::min(*from, *to), std::max(*from, *to)});
                continue;
            }
            const Point3 &a = surface.vertices[t[k]], &b = surface.vertices[t[(k + 1) % 3]],
                         &c = surface.vertices[t[(k + 2) % 3]];
            const Point3 normal = unit(cross(minus(b, a), minus(c, a)));
            normals[along ? *from : *to] = along ? normal : Point3{-normal.x, -normal.y, -normal.z};
        }
    sort_unique(chords);
    for (std::size_t i = 0; i < n; ++i)
        if (normals[i] == Point3{})
            return Error{ErrorCode::bad_option, "the loop has an edge that the surface lacks",
                         "edge " + std::to_string(i) + " of the loop"};
    return normals;
}

Result<Border> border_of(const Surface& surface, const BorderLoop& loop) {
    const std::size_t n = loop.vertices.size();
    if (n < 3) return Error{ErrorCode::bad_option, "a loop needs three vertices", ""};
    for (const std::uint32_t v : loop.vertices)
        if (v >= surface.vertices.size())
            return Error{ErrorCode::bad_index, "the loop names no vertex", std::to_string(v)};
    Border border;
    const LoopNames names(surface, loop.vertices);
    const auto normals = edge_normals(surface, names, n, border.chords);
    if (!normals) return normals.error();
    std::vector<double> lengths;
    for (std::size_t i = 0; i < n; ++i) {
        const Point3 &a = normals.value()[(i + n - 1) % n], &b = normals.value()[i];
        const Point3 normal = unit({a.x + b.x, a.y + b.y, a.z + b.z});
        const Point3& p = surface.vertices[loop.vertices[i]];
        if (normal == Point3{})
            return Error{ErrorCode::not_closed, "the surface is folded back at its border",
                         "vertex " + std::to_string(loop.vertices[i]) + " " + place_text(p)};
        border.line.points.push_back(p);
        border.line.normals.push_back(normal);
        border.line.vertices.push_back(loop.vertices[i]);
        lengths.push_back(length(minus(surface.vertices[loop.vertices[(i + 1) % n]], p)));
    }
    std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(n / 2),
                     lengths.end());
    border.median_edge = lengths[n / 2];
    return border;
}

/// The borders of an inner part, one after the other.
struct BorderPoints {
    std::vector<Point3> points;
    std::vector<std::uint32_t> vertices; ///< per point: vertex of the surface
    std::vector<std::uint32_t> next;     ///< per point: the next one in its loop
    std::vector<std::uint32_t> before;   ///< per point: the previous one
    std::vector<Edge> chords;            ///< see Border; positions in this list
};

BorderPoints border_points(std::span<const Border> borders, const InnerPart& part) {
    BorderPoints all;
    for (const std::uint32_t b : part.borders) {
        const BorderLine& line = borders[b].line;
        const auto first = static_cast<std::uint32_t>(all.points.size()),
                   n = static_cast<std::uint32_t>(line.points.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            all.points.push_back(line.points[i]);
            all.vertices.push_back(line.vertices[i]);
            all.next.push_back(first + (i + 1) % n);
            all.before.push_back(first + (i + n - 1) % n);
        }
        for (const Edge& e : borders[b].chords) all.chords.push_back({first + e[0], first + e[1]});
    }
    return all;
}

/// Step (5): builds the rows of triangles between the border and the remaining filling.
class Rows {
public:
    Rows(const BorderPoints& border, const InnerPart& part, double clearance) :
        border_(border), part_(part), clearance_(clearance),
        mesh_(part.points, part.triangles, taken_edges()), movable_(part.points.size(), false) {
        for (std::size_t v = 0; v < part.filling.size(); ++v) movable_[v] = true;
    }

    Result<DiskMesh> operator()(JoinReport& report) {
        for (std::size_t i = 0; i < part_.corners.size(); ++i)
            mesh_.move(part_.corners[i], border_.points[i]);
        if (const auto done = straighten(); !done) return done.error();
        report.given_way = make_room();
        mesh_.improve(near_border());
        return mesh_;
    }

private:
    [[nodiscard]] std::vector<Edge> taken_edges() const {
        std::vector<Edge> taken;
        for (const Edge& e : border_.chords) {
            const std::uint32_t a = part_.corners[e[0]], b = part_.corners[e[1]];
            taken.push_back({std::min(a, b), std::max(a, b)});
        }
        std::sort(taken.begin(), taken.end());
        return taken;
    }

    /// Removes the vertices of the line between border vertices. Removing one may make others
    /// removable; at last, vertices of the filling next to them are removed as well.
    Status straighten() {
        std::vector<std::uint32_t> left = part_.between;
        while (!left.empty()) {
            const std::size_t before = left.size();
            std::erase_if(left, [&](std::uint32_t v) { return mesh_.remove(v); });
            if (left.size() < before) continue;
            bool changed = false;
            for (const std::uint32_t v : left)
                for (const std::uint32_t w : mesh_.neighbours(v))
                    changed = (movable_[w] && mesh_.is_alive(w) && mesh_.remove(w)) || changed;
            if (!changed)
                return Error{ErrorCode::improper_contact,
                             "the filling can't be brought to the border without folding",
                             place_text(part_.points[left[0]])};
        }
        return Done{};
    }

    [[nodiscard]] double median_filling_edge() const {
        std::vector<double> lengths;
        for (const Triangle& t : part_.triangles)
            for (unsigned k = 0; k < 3; ++k)
                if (movable_[t[k]] && movable_[t[(k + 1) % 3]])
                    lengths.push_back(
                        length(minus(part_.points[t[k]], part_.points[t[(k + 1) % 3]])));
        if (lengths.empty()) return std::numeric_limits<double>::infinity();
        const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
        std::nth_element(lengths.begin(), middle, lengths.end());
        return *middle;
    }

    /// Tells whether p is too near to border edge i.
    [[nodiscard]] bool too_near(const Point3& p, std::size_t i, double filling_edge) const {
        const Point3 &a = border_.points[i], &b = border_.points[border_.next[i]];
        const double room = clearance_ * std::min(length(minus(b, a)), filling_edge);
        return distance_to_triangle(p, a, b, b) < room;
    }

    /// Removes vertices of the filling that are too near to the border. Only neighbours of the
    /// border can be; when one is removed, the vertices behind it become neighbours.
    std::size_t make_room() {
        const double filling_edge = median_filling_edge();
        const std::size_t n = part_.corners.size();
        std::size_t gone = 0;
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t i = 0; i < n; ++i)
                for (const std::uint32_t w : mesh_.neighbours(part_.corners[i])) {
                    if (!movable_[w] || !mesh_.is_alive(w)) continue;
                    const Point3& p = mesh_.points()[w];
                    if (!too_near(p, i, filling_edge) &&
                        !too_near(p, border_.before[i], filling_edge))
                        continue;
                    if (!mesh_.remove(w)) continue;
                    changed = true;
                    ++gone;
                }
        }
        return gone;
    }

    [[nodiscard]] std::vector<std::uint32_t> near_border() const {
        std::vector<std::uint32_t> vertices;
        for (const std::uint32_t c : part_.corners)
            for (const std::uint32_t w : mesh_.neighbours(c)) vertices.push_back(w);
        vertices.insert(vertices.end(), part_.corners.begin(), part_.corners.end());
        sort_unique(vertices);
        return vertices;
    }

    const BorderPoints& border_;
    const InnerPart& part_;
    double clearance_;
    DiskMesh mesh_;
    std::vector<bool> movable_; ///< per point: it is a vertex of the filling
};

/// Appends the new triangles to the surface.
Joined append(const Surface& surface, const BorderPoints& border, const InnerPart& part,
              const DiskMesh& mesh) {
    Joined joined;
    joined.surface = surface;
    std::vector<std::uint32_t> name(part.points.size(), UINT32_MAX);
    for (std::size_t i = 0; i < part.corners.size(); ++i)
        name[part.corners[i]] = border.vertices[i];
    for (std::uint32_t v = 0; v < part.filling.size(); ++v) {
        if (!mesh.is_alive(v)) continue;
        name[v] = static_cast<std::uint32_t>(joined.surface.vertices.size());
        joined.surface.vertices.push_back(part.points[v]);
        joined.filling_vertices.push_back(part.filling[v]);
    }
    for (const Triangle& t : mesh.triangles()) {
        const auto& p = mesh.points();
        joined.surface.triangles.push_back({name[t[0]], name[t[1]], name[t[2]]});
        joined.report.area += length(cross(minus(p[t[1]], p[t[0]]), minus(p[t[2]], p[t[0]]))) / 2;
    }
    joined.report.new_vertices = joined.filling_vertices.size();
    joined.report.new_triangles = joined.surface.triangles.size() - surface.triangles.size();
    return joined;
}

/// Checks with exact predicates that no new triangle is degenerate, repeats another one or meets
/// another one improperly.
Status check_new(const Surface& surface, std::size_t old_triangles, const Run& run) {
    const Soup soup = merge_surfaces(std::span(&surface, 1), run);
    const auto place = [&](std::uint32_t t) {
        return place_text(surface.vertices[surface.triangles[t][0]]);
    };
    for (const std::uint32_t t : soup.degenerate)
        if (t >= old_triangles)
            return Error{ErrorCode::improper_contact, "a new triangle has no area", place(t)};
    for (const auto& d : soup.duplicates)
        if (d[0] >= old_triangles)
            return Error{ErrorCode::improper_contact, "a new triangle repeats another",
                         place(d[0])};
    std::vector<std::uint32_t> active;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
        if (soup.input_of[t] >= old_triangles) active.push_back(t);
    const auto pairs =
        candidate_pairs_of({soup.points, soup.triangles}, active, {}, {}, without_progress(run));
    using Found = std::vector<Point3>;
    const auto blocks =
        for_blocks<Found>(pairs.size(), 16384, run, [&](std::size_t a, std::size_t b) {
            Found found;
            for (std::size_t i = a; i < b && found.empty(); ++i) {
                const auto contact = improper_contact(soup.points, soup.triangles[pairs[i].first],
                                                      soup.triangles[pairs[i].second]);
                if (contact)
                    found.push_back(
                        nearest(soup.points, contact->points[contact->point_count - 1U].how));
            }
            return found;
        });
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    for (const Found& found : blocks)
        if (!found.empty())
            return Error{ErrorCode::improper_contact, "a new triangle meets another one improperly",
                         place_text(found[0])};
    return Done{};
}

/// Runs all steps for one width of the strip. `borders` are that of the hole, then those of
/// possible islands.
Result<Joined> join_with(const Surface& surface, std::span<const Border> borders,
                         const Surface& filling, double strip, const JoinOptions& options,
                         const Run& run) {
    std::vector<BorderLine> lines;
    for (const Border& b : borders) lines.push_back(b.line);
    const auto part = cut_inner_part(lines, filling, strip, options.search, run);
    if (!part) return part.error();
    const BorderPoints border = border_points(borders, part.value());
    JoinReport report;
    const auto mesh = Rows(border, part.value(), options.clearance)(report);
    if (!mesh) return mesh.error();
    Joined joined = append(surface, border, part.value(), mesh.value());
    joined.report.strip = strip;
    joined.report.given_way = report.given_way;
    joined.report.islands = part.value().borders.size() - 1;
    joined.report.curve_vertices = part.value().corners.size() + part.value().between.size();
    joined.report.inside_triangles = part.value().triangles.size();
    for (std::size_t i = 0; i < border.points.size(); ++i)
        joined.report.largest_step =
            std::max(joined.report.largest_step,
                     length(minus(part.value().points[part.value().corners[i]], border.points[i])));
    if (const auto good = check_new(joined.surface, surface.triangles.size(), run); !good)
        return good.error();
    return joined;
}

/// Lists the widths to try. The curve is one line only if the strip is wide enough to reach the
/// filling and too narrow to reach anything else.
std::vector<double> widths(const Border& border, const JoinOptions& options) {
    if (options.strip > 0) return {options.strip};
    const double half = border.median_edge / 2;
    std::vector<double> all;
    for (const double width : joining::detail::constants.strips) all.push_back(width * half);
    return all;
}

/// Finds outer borders of other parts whose boxes overlap that of the loop, enlarged by its longest
/// side, as an island need not be as flat as the border. Those that the filling does not pass
/// through turn out not to be islands.
std::vector<BorderLoop> islands_near(const Surface& surface, const BorderLoop& loop,
                                     std::span<const BorderLoop> loops) {
    const auto box = [&](const BorderLoop& l) {
        Box b{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
        for (const std::uint32_t v : l.vertices) {
            const Point3& p = surface.vertices[v];
            const std::array<double, 3> x{p.x, p.y, p.z};
            for (std::size_t k = 0; k < 3; ++k) {
                b.low[k] = std::min(b.low[k], x[k]);
                b.high[k] = std::max(b.high[k], x[k]);
            }
        }
        return b;
    };
    Box around = box(loop);
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, around.high[k] - around.low[k]);
    for (std::size_t k = 0; k < 3; ++k) {
        around.low[k] -= longest;
        around.high[k] += longest;
    }
    std::vector<BorderLoop> islands;
    for (const BorderLoop& l : loops) {
        const bool valid = std::all_of(l.vertices.begin(), l.vertices.end(), [&](std::uint32_t v) {
            return v < surface.vertices.size();
        });
        if (valid && l.kind == LoopKind::outer && l.part != loop.part && around.overlaps(box(l)))
            islands.push_back(l);
    }
    return islands;
}

Result<Joined> join_valid(const Surface& surface, const BorderLoop& loop, const Surface& filling,
                          const JoinOptions& options, const Run& run) {
    const auto border = border_of(surface, loop);
    if (!border) return border.error();
    std::vector<Border> borders{border.value()};
    for (const BorderLoop& other : islands_near(surface, loop, options.loops)) {
        auto island = border_of(surface, other);
        if (!island) return island.error();
        borders.push_back(std::move(island).value());
    }
    std::optional<Error> first;
    const auto tries = widths(border.value(), options);
    for (std::size_t i = 0; i < tries.size(); ++i) {
        if (run.progress)
            run.progress("join", static_cast<double>(i) / static_cast<double>(tries.size()));
        auto joined = join_with(surface, borders, filling, tries[i], options, run);
        if (joined) return joined;
        const ErrorCode code = joined.error().code;
        if (code != ErrorCode::not_closed && code != ErrorCode::improper_contact)
            return joined.error();
        if (!first) first = joined.error();
    }
    return *first;
}

} // namespace

Result<Joined> join_filling(const Surface& surface, const BorderLoop& loop, const Surface& filling,
                            const JoinOptions& options, const Run& run) {
    return guarded("to join the filling", "join", [&]() -> Result<Joined> {
        const std::array<Surface, 2> both{surface, filling};
        if (const auto valid = validate(both); !valid) return valid.error();
        if (!(options.strip >= 0) || !std::isfinite(options.strip))
            return Error{ErrorCode::bad_option, "the width of the strip is no length", ""};
        if (!(options.clearance >= 0 && options.clearance < 1))
            return Error{ErrorCode::bad_option, "clearance is a share, from 0 to less than 1", ""};
        return join_valid(surface, loop, filling, options, run);
    });
}

std::vector<NamedConstant> join_constants() {
    return joining::detail::constants.listed();
}

} // namespace terrane
