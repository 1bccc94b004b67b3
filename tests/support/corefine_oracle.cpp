// SPDX-License-Identifier: LGPL-3.0-or-later

#include "support/corefine_oracle.hpp"

#include "support/oracle.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <vector>

namespace corefine_oracle {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using terrane::Arrangement;
using terrane::Edge;
using terrane::Surface;
using terrane::Triangle;
using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Rational = CGAL::Exact_rational;
using Spot = std::array<Rational, 3>;
using ExactMesh = CGAL::Surface_mesh<Epeck::Point_3>;

// --- what CGAL asks for

/// With the vertices in use; none where it is no manifold.
template <class Mesh>
std::optional<Mesh> to_cgal(const Surface& s) {
    using Point = typename Mesh::Point;
    Mesh mesh;
    std::map<std::uint32_t, typename Mesh::Vertex_index> number;
    const auto vertex = [&](std::uint32_t v) {
        const auto [at, added] = number.try_emplace(v);
        const auto& p = s.vertices[v];
        if (added) at->second = mesh.add_vertex(Point(p.x, p.y, p.z));
        return at->second;
    };
    for (const Triangle& t : s.triangles) {
        const auto a = vertex(t[0]), b = vertex(t[1]), c = vertex(t[2]);
        if (mesh.add_face(a, b, c) == Mesh::null_face()) return std::nullopt;
    }
    return mesh;
}

/// The first condition that a surface breaks; empty if none. Exact: Epick's predicates.
std::string broken_condition(const Surface& s) {
    if (s.triangles.empty()) return "no triangle";
    const auto mesh = to_cgal<CGAL::Surface_mesh<Epick::Point_3>>(s);
    if (!mesh) return "no manifold";
    for (const auto v : mesh->vertices())
        if (pmp::is_non_manifold_vertex(v, *mesh)) return "no manifold at a vertex";
    for (const auto f : mesh->faces())
        if (pmp::is_degenerate_triangle_face(f, *mesh)) return "triangle without area";
    if (pmp::does_self_intersect(*mesh)) return "crosses itself";
    return "";
}

/// Whether CGAL takes it for the border of a volume. Precondition: no condition is broken.
bool bounds_volume(const Surface& s) {
    const auto mesh = to_cgal<CGAL::Surface_mesh<Epick::Point_3>>(s);
    return CGAL::is_closed(*mesh) && pmp::does_bound_a_volume(*mesh) &&
           pmp::is_outward_oriented(*mesh);
}

// --- exact meshes

/// Points and triangles, each with the input triangle that it is part of.
struct Parts {
    std::vector<Spot> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> parent; ///< counted within the surface
    std::set<std::array<Spot, 2>> intersection_edges;
};

Rational rational(const terrane::Exact& e) {
    mpq_t q;
    mpq_init(q);
    e.export_to_mpq_t(q);
    const Rational r(q);
    mpq_clear(q);
    return r;
}

std::array<Spot, 2> ordered(const Spot& a, const Spot& b) {
    return a < b ? std::array{a, b} : std::array{b, a};
}

using Constrained = ExactMesh::Property_map<ExactMesh::Edge_index, bool>;
using ParentMap = ExactMesh::Property_map<ExactMesh::Face_index, std::uint32_t>;

/// Keeps the parent of each face as CGAL divides it.
struct Tracker : pmp::Corefinement::Default_visitor<ExactMesh> {
    std::map<const ExactMesh*, ParentMap> parents;
    std::uint32_t current = 0;

    void before_subface_creations(ExactMesh::Face_index f, ExactMesh& mesh) {
        const auto of = parents.find(&mesh);
        if (of != parents.end()) current = of->second[f];
    }
    void after_subface_created(ExactMesh::Face_index f, ExactMesh& mesh) {
        const auto of = parents.find(&mesh);
        if (of != parents.end()) of->second[f] = current;
    }
};

Parts parts_of(const ExactMesh& mesh, const ParentMap& parents, const Constrained& is) {
    Parts parts;
    for (const auto v : mesh.vertices()) {
        const auto& p = CGAL::exact(mesh.point(v));
        parts.points.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto f : mesh.faces()) {
        Triangle t{};
        unsigned i = 0;
        for (const auto v : vertices_around_face(mesh.halfedge(f), mesh))
            t[i++] = static_cast<std::uint32_t>(v);
        parts.triangles.push_back(t);
        parts.parent.push_back(parents[f]);
    }
    for (const auto e : mesh.edges())
        if (is[e])
            parts.intersection_edges.insert(
                ordered(parts.points[mesh.vertex(e, 0)], parts.points[mesh.vertex(e, 1)]));
    return parts;
}

std::vector<Spot> spots_of(const Arrangement& a) {
    std::vector<Spot> spots;
    for (const terrane::PointIndex p : a.vertices) {
        const auto e = a.state->points.exact(p);
        const Rational w = rational(e.w);
        spots.push_back({rational(e.x) / w, rational(e.y) / w, rational(e.z) / w});
    }
    return spots;
}

/// Sign of the area projected along the first axis along which the second triangle has one, times
/// the sign of that one: whether two coplanar triangles are oriented alike.
bool alike(const std::array<Spot, 3>& p, const std::array<Spot, 3>& q) {
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned u = (k + 1) % 3, v = (k + 2) % 3;
        const auto area = [&](const std::array<Spot, 3>& t) {
            return Rational((t[1][u] - t[0][u]) * (t[2][v] - t[0][v]) -
                            (t[1][v] - t[0][v]) * (t[2][u] - t[0][u]));
        };
        const Rational of_q = area(q);
        if (of_q != 0) return (area(p) > 0) == (of_q > 0);
    }
    return true;
}

std::array<Spot, 3> corners_of(const Arrangement& a, std::uint32_t input_triangle) {
    std::array<Spot, 3> corners;
    for (unsigned i = 0; i < 3; ++i) {
        const auto& p = a.state->points.input(a.state->corners[input_triangle][i]);
        corners[i] = {Rational(p.x), Rational(p.y), Rational(p.z)};
    }
    return corners;
}

/// What the arrangement makes of one surface, oriented as its parents in that surface.
Parts parts_of(const Arrangement& a, const std::vector<Spot>& spots, std::uint32_t surface) {
    Parts parts;
    parts.points = spots;
    const std::uint32_t first = a.inputs.first[surface], end = a.inputs.first[surface + 1];
    for (std::size_t t = 0; t < a.triangles.size(); ++t)
        for (const std::uint32_t parent : a.parents_of[t]) {
            if (parent < first || parent >= end) continue;
            Triangle part = a.triangles[t];
            if (a.parents_of[t][0] != parent &&
                !alike({spots[part[0]], spots[part[1]], spots[part[2]]}, corners_of(a, parent)))
                std::swap(part[1], part[2]);
            parts.triangles.push_back(part);
            parts.parent.push_back(parent - first);
        }
    for (const Triangle& t : parts.triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const auto ends = std::minmax(t[i], t[(i + 1) % 3]);
            if (std::binary_search(a.intersection_edges.begin(), a.intersection_edges.end(),
                                   Edge{ends.first, ends.second}))
                parts.intersection_edges.insert(ordered(spots[ends.first], spots[ends.second]));
        }
    return parts;
}

// --- the same?

/// Twice the areas projected along each axis, whatever the orientation.
struct Share {
    std::set<Spot> points;
    std::size_t triangles = 0;
    Spot area{};
};

std::map<std::uint32_t, Share> shares(const Parts& parts) {
    std::map<std::uint32_t, Share> all;
    for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
        const Triangle& t = parts.triangles[i];
        Share& share = all[parts.parent[i]];
        ++share.triangles;
        const Spot &a = parts.points[t[0]], &b = parts.points[t[1]], &c = parts.points[t[2]];
        share.points.insert({a, b, c});
        for (unsigned k = 0; k < 3; ++k) {
            const unsigned u = (k + 1) % 3, v = (k + 2) % 3;
            const Rational area = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
            share.area[k] += area < 0 ? Rational(-area) : area;
        }
    }
    return all;
}

std::string difference(const Parts& ours, const Parts& theirs, bool with_edges) {
    const auto a = shares(ours), b = shares(theirs);
    if (a.size() != b.size()) return "the number of input triangles that are left";
    for (auto i = a.begin(), j = b.begin(); i != a.end(); ++i, ++j) {
        const std::string of = " of input triangle " + std::to_string(i->first);
        if (i->first != j->first) return "input triangles that are left";
        if (i->second.points != j->second.points) return "the points" + of;
        if (i->second.triangles != j->second.triangles) return "the number of parts" + of;
        if (i->second.area != j->second.area) return "the area" + of;
    }
    if (with_edges && ours.intersection_edges != theirs.intersection_edges)
        return "intersection edges";
    return "";
}

// --- volumes

/// Six times the volume that triangles bound, seen from the origin.
Rational volume(const Spot& a, const Spot& b, const Spot& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Rational volume(const ExactMesh& mesh) {
    Rational sum = 0;
    for (const auto f : mesh.faces()) {
        std::array<Spot, 3> corners;
        unsigned i = 0;
        for (const auto v : vertices_around_face(mesh.halfedge(f), mesh)) {
            const auto& p = CGAL::exact(mesh.point(v));
            corners[i++] = {p.x(), p.y(), p.z()};
        }
        sum += volume(corners[0], corners[1], corners[2]);
    }
    return sum;
}

int side(const Spot& a, const Spot& b, const Spot& c, const Spot& p) {
    Spot u, v, w;
    for (unsigned k = 0; k < 3; ++k) u[k] = a[k] - p[k], v[k] = b[k] - p[k], w[k] = c[k] - p[k];
    const Rational d = volume(u, v, w);
    return (d > 0) - (d < 0);
}

/// By a ray from p; none where it meets an edge. p is not on the surface.
std::optional<bool> is_inside(const Spot& p, const Surface& s, const Spot& towards) {
    bool inside = false;
    for (const Triangle& t : s.triangles) {
        std::array<Spot, 3> c;
        for (unsigned i = 0; i < 3; ++i) {
            const auto& v = s.vertices[t[i]];
            c[i] = {Rational(v.x), Rational(v.y), Rational(v.z)};
        }
        const int here = side(c[0], c[1], c[2], p), there = side(c[0], c[1], c[2], towards);
        if (here == 0 && there == 0) continue; // in its plane, and so past it: edges tell
        bool left = false, right = false, on = false;
        for (unsigned i = 0; i < 3; ++i) {
            const int turn = side(p, towards, c[i], c[(i + 1) % 3]);
            left = left || turn > 0;
            right = right || turn < 0;
            on = on || turn == 0;
        }
        if (left && right) continue; // the line passes it by
        if (on) return std::nullopt;
        // `towards` is beyond everything, so the triangle is crossed iff it lies between.
        if (here * there < 0) inside = !inside;
    }
    return inside;
}

bool is_inside(const Spot& p, const Surface& s) {
    Rational size = 1;
    for (const auto& v : s.vertices)
        for (const double d : {v.x, v.y, v.z}) size += d < 0 ? Rational(-d) : Rational(d);
    for (unsigned k = 0; k < 3; ++k) size += p[k] < 0 ? Rational(-p[k]) : p[k];
    for (int i = 1;; ++i) {
        const Spot towards{p[0] + size * 4 * (97 + i * i), p[1] + size * (13 + 7 * i),
                           p[2] + size * (5 + i * i * i)};
        if (const auto answer = is_inside(p, s, towards)) return *answer;
    }
}

/// Per triangle, a number for all that can be reached over edges that are no intersections.
std::vector<std::size_t> patches_of(const Parts& parts) {
    std::vector<std::size_t> patch(parts.triangles.size());
    for (std::size_t t = 0; t < patch.size(); ++t) patch[t] = t;
    std::map<std::array<std::uint32_t, 2>, std::vector<std::size_t>> at;
    for (std::size_t t = 0; t < patch.size(); ++t)
        for (unsigned i = 0; i < 3; ++i) {
            const auto ends = std::minmax(parts.triangles[t][i], parts.triangles[t][(i + 1) % 3]);
            const auto edge = ordered(parts.points[ends.first], parts.points[ends.second]);
            if (parts.intersection_edges.count(edge) == 0)
                at[{ends.first, ends.second}].push_back(t);
        }
    for (const auto& [edge, sides] : at)
        for (const std::size_t t : sides)
            if (patch[t] != patch[sides[0]])
                std::replace(patch.begin(), patch.end(), std::size_t{patch[t]},
                             std::size_t{patch[sides[0]]});
    return patch;
}

enum class Side { inside, outside, same, opposite }; ///< of the other one, or parts of both

Triangle turned(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

Triangle reversed(const Triangle& t) {
    return turned({t[0], t[2], t[1]});
}

/// Where the parts of one closed surface lie with respect to the other.
std::vector<Side> sides_of(const Parts& parts, const Surface& other, const Parts& others) {
    std::set<Triangle> shared;
    for (const Triangle& t : others.triangles) shared.insert(turned(t));
    std::map<std::size_t, Side> known; // by patch
    const auto patch = patches_of(parts);
    std::vector<Side> sides;
    for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
        const Triangle& t = parts.triangles[i];
        if (shared.count(turned(t)) != 0) {
            sides.push_back(Side::same);
        } else if (shared.count(reversed(t)) != 0) {
            sides.push_back(Side::opposite);
        } else {
            if (known.count(patch[i]) == 0) {
                Spot centre;
                for (unsigned k = 0; k < 3; ++k)
                    centre[k] =
                        (parts.points[t[0]][k] + parts.points[t[1]][k] + parts.points[t[2]][k]) / 3;
                known[patch[i]] = is_inside(centre, other) ? Side::inside : Side::outside;
            }
            sides.push_back(known[patch[i]]);
        }
    }
    return sides;
}

/// The border of a Boolean of two closed surfaces, put together from their parts.
struct Border {
    std::vector<Triangle> triangles;

    void add(const Parts& parts, const std::vector<Side>& sides, Side wanted, bool reverse) {
        for (std::size_t i = 0; i < sides.size(); ++i)
            if (sides[i] == wanted)
                triangles.push_back(reverse ? reversed(parts.triangles[i])
                                            : turned(parts.triangles[i]));
    }
    /// Two triangles at each edge. Vertices in which it touches itself are not looked for.
    [[nodiscard]] bool is_manifold() const {
        std::map<Edge, int> at;
        for (const Triangle& t : triangles)
            for (unsigned i = 0; i < 3; ++i) {
                const auto ends = std::minmax(t[i], t[(i + 1) % 3]);
                ++at[{ends.first, ends.second}];
            }
        return std::all_of(at.begin(), at.end(), [](const auto& edge) { return edge.second == 2; });
    }
    [[nodiscard]] Rational six_volumes(const std::vector<Spot>& points) const {
        Rational sum = 0;
        for (const Triangle& t : triangles) sum += volume(points[t[0]], points[t[1]], points[t[2]]);
        return sum;
    }
};

using Borders = std::array<Border, 4>; ///< by pmp::Corefinement::Boolean_operation_type

/// Union, intersection, and the two differences.
Borders booleans(std::span<const Surface> pair, const std::array<Parts, 2>& ours) {
    static_assert(pmp::Corefinement::UNION == 0 && pmp::Corefinement::INTERSECTION == 1 &&
                  pmp::Corefinement::TM1_MINUS_TM2 == 2 && pmp::Corefinement::TM2_MINUS_TM1 == 3);
    const std::array sides{sides_of(ours[0], pair[1], ours[1]),
                           sides_of(ours[1], pair[0], ours[0])};
    Borders all;
    for (unsigned k = 0; k < 2; ++k) {
        all[0].add(ours[k], sides[k], Side::outside, false);
        all[1].add(ours[k], sides[k], Side::inside, false);
        all[2 + k].add(ours[k], sides[k], Side::outside, false);
        all[2 + k].add(ours[1 - k], sides[1 - k], Side::inside, true);
        all[2 + k].add(ours[k], sides[k], Side::opposite, false);
    }
    all[0].add(ours[0], sides[0], Side::same, false);
    all[1].add(ours[0], sides[0], Side::same, false);
    return all;
}

// --- the comparison

/// CGAL's side of it.
struct Refined {
    std::array<Parts, 2> parts;
    std::array<std::optional<Rational>, 4> six; ///< volumes times six of the Booleans asked for;
                                                ///< none where CGAL says it is no manifold
};

class Corefinement {
    [[nodiscard]] auto parameters() const {
        return CGAL::parameters::throw_on_self_intersection(true).visitor(tracker_);
    }

public:
    explicit Corefinement(std::span<const Surface> pair) {
        for (unsigned k = 0; k < 2; ++k) {
            mesh_[k] = *to_cgal<ExactMesh>(pair[k]);
            is_[k] = mesh_[k].add_property_map<ExactMesh::Edge_index, bool>("e:is", false).first;
            auto parent =
                mesh_[k].add_property_map<ExactMesh::Face_index, std::uint32_t>("f:of").first;
            for (const auto f : mesh_[k].faces()) parent[f] = static_cast<std::uint32_t>(f);
            tracker_.parents.emplace(&mesh_[k], parent);
        }
    }
    Corefinement(const Corefinement&) = delete;
    Corefinement& operator=(const Corefinement&) = delete;

    /// Corefinement, and the Booleans that are wanted. Throws what CGAL throws.
    Refined run(const std::array<bool, 4>& wanted) {
        Refined result;
        if (std::count(wanted.begin(), wanted.end(), true) != 0)
            booleans(wanted, result);
        else
            pmp::corefine(mesh_[0], mesh_[1], parameters().edge_is_constrained_map(is_[0]),
                          CGAL::parameters::edge_is_constrained_map(is_[1]));
        for (unsigned k = 0; k < 2; ++k)
            result.parts[k] = parts_of(mesh_[k], tracker_.parents.at(&mesh_[k]), is_[k]);
        return result;
    }

private:
    void booleans(const std::array<bool, 4>& wanted, Refined& result) {
        std::array<ExactMesh, 4> made;
        std::array<boost::optional<ExactMesh*>, 4> asked;
        for (unsigned i = 0; i < 4; ++i)
            if (wanted[i]) asked[i] = &made[i];
        const auto possible = pmp::corefine_and_compute_boolean_operations(
            mesh_[0], mesh_[1], asked, parameters().edge_is_constrained_map(is_[0]),
            CGAL::parameters::edge_is_constrained_map(is_[1]));
        for (unsigned i = 0; i < 4; ++i)
            if (wanted[i] && possible[i]) result.six[i] = volume(made[i]);
    }

    std::array<ExactMesh, 2> mesh_;
    std::array<Constrained, 2> is_;
    Tracker tracker_;
};

std::string volume_flaw(const Borders& ours, const std::vector<Spot>& points,
                        const Refined& theirs) {
    constexpr std::array names{"union", "intersection", "first minus second", "second minus first"};
    for (unsigned i = 0; i < 4; ++i)
        if (theirs.six[i] && *theirs.six[i] != ours[i].six_volumes(points))
            return std::string("the volume of the ") + names[i];
    return "";
}

/// Parts of both surfaces: they overlap in their planes.
bool overlap(const Arrangement& a) {
    return a.surfaces_of.values.size() != a.surfaces_of.size();
}

} // namespace

Outcome compare(std::span<const Surface> pair, const Arrangement& a) {
    Outcome outcome;
    for (const Surface& s : pair)
        if (outcome.skipped.empty()) outcome.skipped = broken_condition(s);
    if (!outcome.skipped.empty()) return outcome;
    const auto spots = spots_of(a);
    const std::array ours{parts_of(a, spots, 0), parts_of(a, spots, 1)};
    std::array<bool, 4> wanted{};
    Borders borders;
    outcome.with_volumes = bounds_volume(pair[0]) && bounds_volume(pair[1]);
    if (outcome.with_volumes) borders = booleans(pair, ours);
    for (unsigned i = 0; i < 4; ++i) wanted[i] = outcome.with_volumes && borders[i].is_manifold();
    Refined theirs;
    try {
        theirs = Corefinement(pair).run(wanted);
    } catch (const pmp::Corefinement::Self_intersection_exception&) {
        outcome.skipped = "CGAL: self-intersection";
        return outcome;
    }
    for (unsigned k = 0; k < 2 && outcome.flaw.empty(); ++k)
        outcome.flaw = difference(ours[k], theirs.parts[k], !overlap(a));
    if (outcome.flaw.empty()) outcome.flaw = volume_flaw(borders, spots, theirs);
    outcome.crossing = theirs.parts[0].intersection_edges.size();
    return outcome;
}

} // namespace corefine_oracle
