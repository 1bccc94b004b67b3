// SPDX-License-Identifier: LGPL-3.0-or-later

#include "support/corefine_oracle.hpp"

#include "support/corefine_booleans.hpp"
#include "support/oracle.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
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
using ExactMesh = CGAL::Surface_mesh<Epeck::Point_3>;

// --- the conditions of CGAL

/// Converts a surface, without unused vertices; none if it is not a manifold.
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

/// Names the first condition of CGAL that a surface violates; empty if none. The predicates of
/// Epick make this exact.
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

/// Tells whether a surface is the border of a volume for CGAL. Precondition: no condition is
/// violated.
bool bounds_volume(const Surface& s) {
    const auto mesh = to_cgal<CGAL::Surface_mesh<Epick::Point_3>>(s);
    return CGAL::is_closed(*mesh) && pmp::does_bound_a_volume(*mesh) &&
           pmp::is_outward_oriented(*mesh);
}

// --- exact meshes

Rational rational(const terrane::Exact& e) {
    mpq_t q;
    mpq_init(q);
    e.export_to_mpq_t(q);
    const Rational r(q);
    mpq_clear(q);
    return r;
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

/// Tells whether two coplanar triangles are oriented alike: whether their areas have equal signs
/// when projected along the first axis along which the second one has an area.
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

/// Returns the parts of one surface in the arrangement, oriented like their parents in the surface.
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

// --- comparison of parts

/// The parts of one input triangle; `area` is twice their unsigned areas projected along each axis.
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

// --- the comparison

static_assert(pmp::Corefinement::UNION == 0 && pmp::Corefinement::INTERSECTION == 1 &&
              pmp::Corefinement::TM1_MINUS_TM2 == 2 && pmp::Corefinement::TM2_MINUS_TM1 == 3);

Rational mesh_volume(const ExactMesh& mesh) {
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

Surface to_surface(const ExactMesh& mesh) {
    Surface s{"", terrane::Role::unknown, {}, {}};
    std::map<ExactMesh::Vertex_index, std::uint32_t> number;
    for (const auto v : mesh.vertices()) {
        number[v] = static_cast<std::uint32_t>(s.vertices.size());
        const auto& p = CGAL::exact(mesh.point(v));
        s.vertices.push_back(
            {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    }
    for (const auto f : mesh.faces()) {
        Triangle t{};
        unsigned i = 0;
        for (const auto v : vertices_around_face(mesh.halfedge(f), mesh)) t[i++] = number[v];
        s.triangles.push_back(t);
    }
    return s;
}

/// The result of CGAL.
struct Refined {
    std::array<Parts, 2> parts;
    std::array<std::optional<Rational>, 4> six; ///< six times the volumes of the wanted Booleans;
                                                ///< none if CGAL finds them not manifold
    MadeByCgal made;
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

    /// Computes the corefinement and the wanted Booleans. Throws the exceptions of CGAL.
    Refined run(const std::array<bool, 4>& wanted) {
        Refined result;
        if (std::count(wanted.begin(), wanted.end(), true) != 0)
            booleans(wanted, result);
        else
            pmp::corefine(mesh_[0], mesh_[1], parameters().edge_is_constrained_map(is_[0]),
                          CGAL::parameters::edge_is_constrained_map(is_[1]));
        for (unsigned k = 0; k < 2; ++k)
            result.parts[k] = parts_of(mesh_[k], tracker_.parents.at(&mesh_[k]), is_[k]);
        for (const ExactMesh& mesh : mesh_) result.made.corefined.push_back(to_surface(mesh));
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
            if (wanted[i] && possible[i]) {
                result.six[i] = mesh_volume(made[i]);
                result.made.booleans[i] = to_surface(made[i]);
            }
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

/// Tells whether some part belongs to both surfaces, so that they overlap in their planes.
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

std::optional<MadeByCgal> made_by_cgal(std::span<const Surface> pair) {
    for (const Surface& s : pair)
        if (!broken_condition(s).empty()) return std::nullopt;
    const bool solid = bounds_volume(pair[0]) && bounds_volume(pair[1]);
    try {
        return Corefinement(pair).run({solid, solid, solid, solid}).made;
    } catch (const pmp::Corefinement::Self_intersection_exception&) {
        return std::nullopt;
    }
}

} // namespace corefine_oracle
