// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Pairs of surfaces against CGAL's corefinement in its exact kernel: the same points, the same
// number of triangles, the same area.
#include "../support/effort.hpp"
#include "../support/points.hpp"

#include <terrane/algorithms/arrangement.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <set>

namespace {

using namespace terrane;
using namespace test_support;
namespace pmp = CGAL::Polygon_mesh_processing;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Rational = CGAL::Exact_rational;
using ExactMesh = CGAL::Surface_mesh<Epeck::Point_3>;
using Place = std::array<Rational, 3>;

/// A mesh as exact points and triangles.
struct ExactSurface {
    std::vector<Place> points;
    std::vector<Triangle> triangles;
};

Rational rational(const Exact& e) {
    mpq_t q;
    mpq_init(q);
    e.export_to_mpq_t(q);
    const Rational r(q);
    mpq_clear(q);
    return r;
}

/// n x m squares over [0, n] x [0, m] with heights.
Surface height_field(int n, int m, const std::function<double(int, int)>& height) {
    Surface s;
    for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i) s.vertices.push_back({double(i), double(j), height(i, j)});
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            const auto v = static_cast<std::uint32_t>(j * (n + 1) + i);
            const auto up = v + static_cast<std::uint32_t>(n) + 1;
            s.triangles.push_back({v, v + 1, up});
            s.triangles.push_back({v + 1, up + 1, up});
        }
    return s;
}

enum class Model { two_horizons, horizon_and_fault, integer_heights, integer_fault, shifted };

/// Neither crosses itself: each is a graph over z = 0 or x = 0.
std::array<Surface, 2> random_pair(Random& random, Model model) {
    const bool integers = model == Model::integer_heights || model == Model::integer_fault;
    const auto height = [&](int, int) {
        return integers ? double(random_int(random, -1, 1)) : random_real(random, -0.4, 0.4);
    };
    const int n = random_int(random, 1, 6), m = random_int(random, 1, 6);
    std::array<Surface, 2> pair{height_field(n, m, height), height_field(n, m, height)};
    Surface& second = pair[1];
    if (model == Model::horizon_and_fault || model == Model::integer_fault) {
        const double off = integers ? random_int(random, 0, n) : random_real(random, 0.2, n - 0.2);
        const double down = integers ? random_int(random, 0, n) : random_real(random, 0.2, n - 0.2);
        for (Point3& p : second.vertices) p = {p.z + off, p.y, p.x - down};
    }
    if (model == Model::shifted)
        for (Point3& p : second.vertices) p = {p.x + 0.3, p.y - 0.7, p.z + 0.1};
    return pair;
}

ExactMesh to_cgal(const Surface& s) {
    ExactMesh mesh;
    std::vector<ExactMesh::Vertex_index> v;
    for (const Point3& p : s.vertices) v.push_back(mesh.add_vertex(Epeck::Point_3(p.x, p.y, p.z)));
    for (const Triangle& t : s.triangles) mesh.add_face(v[t[0]], v[t[1]], v[t[2]]);
    return mesh;
}

ExactSurface from_cgal(const ExactMesh& mesh) {
    ExactSurface result;
    for (const auto v : mesh.vertices()) {
        const auto& p = CGAL::exact(mesh.point(v));
        result.points.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto f : mesh.faces()) {
        Triangle t{};
        unsigned i = 0;
        for (const auto v : vertices_around_face(mesh.halfedge(f), mesh))
            t[i++] = static_cast<std::uint32_t>(v);
        result.triangles.push_back(t);
    }
    return result;
}

/// The triangles of one surface.
ExactSurface part_of(const Arrangement& a, std::uint32_t surface) {
    ExactSurface result;
    for (const PointIndex p : a.vertices) {
        const ExactPoint e = a.points.exact(p);
        const Rational w = rational(e.w);
        result.points.push_back({rational(e.x) / w, rational(e.y) / w, rational(e.z) / w});
    }
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
        const auto surfaces = a.surfaces_of[t];
        if (std::find(surfaces.begin(), surfaces.end(), surface) != surfaces.end())
            result.triangles.push_back(a.triangles[t]);
    }
    return result;
}

std::set<Place> points_in_use(const ExactSurface& mesh) {
    std::set<Place> all;
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) all.insert(mesh.points[v]);
    return all;
}

/// Twice the sum of the areas projected along an axis, whatever the orientation.
Rational projected_area(const ExactSurface& mesh, unsigned axis) {
    const unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
    Rational sum = 0;
    for (const Triangle& t : mesh.triangles) {
        const Place &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
        const Rational area = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
        sum += area < 0 ? Rational(-area) : area;
    }
    return sum;
}

/// Edges in the relative interior of which both surfaces meet, by CGAL's account.
std::size_t constrained(const ExactMesh& mesh,
                        const ExactMesh::Property_map<ExactMesh::Edge_index, bool>& is) {
    std::size_t count = 0;
    for (const auto e : mesh.edges()) count += is[e];
    return count;
}

struct Refined {
    std::array<ExactSurface, 2> meshes;
    std::array<std::size_t, 2> constrained{};
};

/// None where CGAL declines.
std::optional<Refined> corefined(const std::array<Surface, 2>& pair) {
    std::array<ExactMesh, 2> meshes{to_cgal(pair[0]), to_cgal(pair[1])};
    std::array<ExactMesh::Property_map<ExactMesh::Edge_index, bool>, 2> is;
    for (unsigned k = 0; k < 2; ++k)
        is[k] = meshes[k].add_property_map<ExactMesh::Edge_index, bool>("e:is", false).first;
    try {
        pmp::corefine(
            meshes[0], meshes[1],
            CGAL::parameters::throw_on_self_intersection(true).edge_is_constrained_map(is[0]),
            CGAL::parameters::edge_is_constrained_map(is[1]));
    } catch (const pmp::Corefinement::Self_intersection_exception&) {
        return std::nullopt;
    }
    return Refined{{from_cgal(meshes[0]), from_cgal(meshes[1])},
                   {constrained(meshes[0], is[0]), constrained(meshes[1], is[1])}};
}

/// Sides of the surface's triangles that are intersection edges, each edge once.
std::size_t intersection_edges(const Arrangement& a, const ExactSurface& part) {
    std::set<Edge> found;
    for (const Triangle& t : part.triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
            const Edge e{low, high};
            if (std::binary_search(a.intersection_edges.begin(), a.intersection_edges.end(), e))
                found.insert(e);
        }
    return found.size();
}

/// Number of crossing edges; 0 where CGAL declines.
std::size_t compare(const std::array<Surface, 2>& pair, bool vertical, bool coplanar_parts) {
    const auto refined = corefined(pair);
    if (!refined) return 0;
    const auto arranged = arrange(pair);
    REQUIRE(arranged);
    const Arrangement& a = arranged.value();
    for (std::uint32_t k = 0; k < 2; ++k) {
        const ExactSurface ours = part_of(a, k);
        const ExactSurface& theirs = refined->meshes[k];
        REQUIRE(points_in_use(ours) == points_in_use(theirs));
        REQUIRE(ours.triangles.size() == theirs.triangles.size());
        const unsigned axis = k == 1 && vertical ? 0 : 2;
        REQUIRE(projected_area(ours, axis) == projected_area(theirs, axis));
        if (!coplanar_parts) REQUIRE(intersection_edges(a, ours) == refined->constrained[k]);
    }
    return refined->constrained[0];
}

} // namespace

TEST_CASE("pairs of surfaces: the points, triangles and areas of CGAL's corefinement") {
    Random random(91);
    int crossing = 0;
    for (const Model model : {Model::two_horizons, Model::horizon_and_fault, Model::integer_heights,
                              Model::integer_fault, Model::shifted})
        for (int i = 0; i < cases(160); ++i) {
            const auto pair = random_pair(random, model);
            const bool vertical =
                model == Model::horizon_and_fault || model == Model::integer_fault;
            const bool integers = model == Model::integer_heights || model == Model::integer_fault;
            INFO("model " << static_cast<int>(model) << ", pair " << i);
            crossing += compare(pair, vertical, integers) > 0;
        }
    CHECK(crossing >= cases(600));
}
