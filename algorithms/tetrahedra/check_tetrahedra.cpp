// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/diffusion.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// A tetrahedron at a face that lies on a triangle, and its side of that triangle.
struct Neighbour {
    std::uint32_t face = 0, tetrahedron = 0;
    bool in_front = false;
};

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

/// Returns the tetrahedra on the sides of each face that lies on a triangle, not on the box.
std::vector<Neighbour> neighbours_of_faces(const TetrahedralMesh& m) {
    std::vector<std::pair<Triangle, std::uint32_t>> faces;
    for (std::uint32_t f = 0; f < m.faces.size(); ++f)
        if (m.face_triangle[f] != none) faces.emplace_back(sorted(m.faces[f]), f);
    std::sort(faces.begin(), faces.end());
    std::vector<Neighbour> found;
    for (std::uint32_t t = 0; t < m.tetrahedra.size(); ++t)
        for (unsigned apex = 0; apex < 4; ++apex) {
            const auto& corners = m.tetrahedra[t];
            Triangle key{};
            for (unsigned i = 0, k = 0; i < 4; ++i)
                if (i != apex) key[k++] = corners[i];
            key = sorted(key);
            const auto at = std::lower_bound(faces.begin(), faces.end(), std::pair(key, 0U));
            if (at == faces.end() || at->first != key) continue;
            const auto& [a, b, c] = m.faces[at->second];
            const auto& v = m.vertices;
            const Sign side = orient3d(v[a], v[b], v[c], v[corners[apex]]);
            found.push_back({at->second, t, side == Sign::Positive});
        }
    return found;
}

std::uint32_t volume_at(const TetrahedralMesh& m, const Volumes& volumes, const Neighbour& n) {
    return volumes.of_sides[m.face_triangle[n.face]][n.in_front ? 0 : 1];
}

/// Returns six times the volume of the tetrahedron with corners a, b, c and the origin.
Exact six_volumes(const std::vector<Point3>& v, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto vector = [&](std::uint32_t i) {
        return polynomial::Vector<Exact>{Exact(v[i].x), Exact(v[i].y), Exact(v[i].z)};
    };
    return dot(cross(vector(a), vector(b)), vector(c));
}

class Check {
public:
    Check(const TetrahedralMesh& tetrahedra, const Mesh& mesh, const Volumes& volumes) :
        made_(tetrahedra), mesh_(mesh), volumes_(volumes) {}

    TetrahedraReport operator()() {
        check_orientation();
        check_facets();
        check_regions();
        compare_volumes();
        out_.shape = shape_of(made_);
        return std::move(out_);
    }

private:
    template <class... T>
    void violation(fmt::format_string<T...> sentence, T&&... values) {
        out_.violations.push_back(fmt::format(sentence, std::forward<T>(values)...));
    }

    void check_orientation() {
        const auto& v = made_.vertices;
        for (std::size_t t = 0; t < made_.tetrahedra.size(); ++t) {
            const auto& [a, b, c, d] = made_.tetrahedra[t];
            if (orient3d(v[a], v[b], v[c], v[d]) != Sign::Positive)
                violation("tetrahedron {} is inverted or flat", t);
        }
    }

    void check_facets() {
        std::vector<std::vector<std::uint32_t>> faces_of(mesh_.triangles.size());
        for (std::uint32_t f = 0; f < made_.faces.size(); ++f)
            if (made_.face_triangle[f] != none) faces_of[made_.face_triangle[f]].push_back(f);
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            if (!is_union(t, faces_of[t])) violation("triangle {} is no union of faces", t);
    }

    /// Tells whether the faces make up triangle t: whether they are a disk (with Euler
    /// characteristic 1) whose border passes through the corners of t.
    [[nodiscard]] bool is_union(std::uint32_t t, const std::vector<std::uint32_t>& faces) const {
        std::map<Edge, int> edges;
        std::set<std::uint32_t> vertices;
        for (const std::uint32_t f : faces)
            for (unsigned i = 0; i < 3; ++i) {
                const auto ends = std::minmax(made_.faces[f][i], made_.faces[f][(i + 1) % 3]);
                ++edges[{ends.first, ends.second}];
                vertices.insert(made_.faces[f][i]);
            }
        if (faces.empty() || vertices.size() + faces.size() != edges.size() + 1) return false;
        std::map<std::uint32_t, int> on_border; // per vertex: number of border edges
        for (const auto& [edge, count] : edges) {
            if (count > 2) return false;
            if (count == 2) continue;
            for (const std::uint32_t v : edge) ++on_border[v];
        }
        for (const auto& [vertex, count] : on_border)
            if (count != 2) return false;
        const auto has = [&](const Point3& corner) {
            return std::any_of(on_border.begin(), on_border.end(),
                               [&](const auto& at) { return made_.vertices[at.first] == corner; });
        };
        const auto& [a, b, c] = mesh_.triangles[t];
        return has(mesh_.vertices[a]) && has(mesh_.vertices[b]) && has(mesh_.vertices[c]);
    }

    void check_regions() {
        const auto diffused = regions_of_tetrahedra(made_);
        std::map<std::uint32_t, std::uint32_t> region_of,
            diffused_of; // must be inverse to each other
        for (std::size_t t = 0; t < diffused.size(); ++t) {
            const std::uint32_t region = made_.region_of[t];
            const bool same = region_of.try_emplace(diffused[t], region).first->second == region;
            const bool one =
                diffused_of.try_emplace(region, diffused[t]).first->second == diffused[t];
            if (same && one) continue;
            violation("tetrahedron {} is in region {}, which diffusion does not confirm", t,
                      region);
            return;
        }
        for (const Neighbour& n : neighbours_of_faces(made_))
            if (made_.region_of[n.tetrahedron] != volume_at(made_, volumes_, n))
                violation("tetrahedron {} is in region {}, at triangle {} where volume {} is",
                          n.tetrahedron, made_.region_of[n.tetrahedron],
                          made_.face_triangle[n.face], volume_at(made_, volumes_, n));
        if (region_of.size() != volumes_.measures.size())
            violation("{} regions, but {} volumes with the outside", region_of.size(),
                      volumes_.measures.size());
    }

    /// Returns the largest distance of a corner of a face from its triangle.
    [[nodiscard]] double distance_from_triangle(std::size_t face) const {
        const auto& [a, b, c] = mesh_.triangles[made_.face_triangle[face]];
        double most = 0;
        for (const std::uint32_t v : made_.faces[face])
            most = std::max(most, distance_to_triangle(made_.vertices[v], mesh_.vertices[a],
                                                       mesh_.vertices[b], mesh_.vertices[c]));
        return most;
    }

    [[nodiscard]] double area_of(std::size_t face) const {
        const auto& [i, j, k] = made_.faces[face];
        const Point3 &a = made_.vertices[i], &b = made_.vertices[j], &c = made_.vertices[k];
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const double wx = c.x - a.x, wy = c.y - a.y, wz = c.z - a.z;
        return std::hypot(uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx) / 2;
    }

    void compare_volumes() {
        const std::size_t count = volumes_.measures.size();
        std::vector<Exact> of_blocks(count), of_tetrahedra(count);
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh_.triangles[t];
            const Exact six = six_volumes(mesh_.vertices, a, b, c);
            const auto [front, back] = volumes_.of_sides[t];
            of_blocks[back] += six;
            of_blocks[front] -= six;
        }
        for (std::size_t t = 0; t < made_.tetrahedra.size(); ++t) {
            if (made_.region_of[t] >= count) continue; // was reported already
            const auto& [a, b, c, d] = made_.tetrahedra[t];
            const auto& v = made_.vertices;
            of_tetrahedra[made_.region_of[t]] += six_volumes(v, b, c, d) - six_volumes(v, a, c, d) +
                                                 six_volumes(v, a, b, d) - six_volumes(v, a, b, c);
        }
        std::vector<double> area(count);
        double distance = 0;
        for (std::size_t f = 0; f < made_.faces.size(); ++f) {
            if (made_.face_triangle[f] == none) continue;
            distance = std::max(distance, distance_from_triangle(f));
            for (const std::uint32_t v : volumes_.of_sides[made_.face_triangle[f]])
                area[v] += area_of(f);
        }
        for (std::size_t v = 0; v < count; ++v) {
            const Exact difference = of_tetrahedra[v] - of_blocks[v];
            RegionVolume& region = out_.volumes.emplace_back();
            region.block = nearest_quotient(of_blocks[v], Exact(6));
            region.tetrahedra = nearest_quotient(of_tetrahedra[v], Exact(6));
            region.difference = nearest_quotient(difference, Exact(6));
            region.bound = 2 * distance * area[v];
            region.equal = exact_sign(difference) == Sign::Zero;
            if (v > 0 && std::fabs(region.difference) > region.bound)
                violation("block {} has volume {}, its tetrahedra {}", v, region.block,
                          region.tetrahedra);
        }
    }

    const TetrahedralMesh& made_;
    const Mesh& mesh_;
    const Volumes& volumes_;
    TetrahedraReport out_;
};

} // namespace

TetrahedraReport check_tetrahedra(const TetrahedralMesh& tetrahedra, const Mesh& mesh,
                                  const Volumes& volumes) {
    return Check(tetrahedra, mesh, volumes)();
}

Status adopt_volume_numbers(const Volumes& volumes, TetrahedralMesh& tetrahedra) {
    std::vector<std::uint32_t> volume_of(tetrahedra.region_count, none);
    volume_of[0] = 0; // region 0 touches the box, and so does the outside
    std::vector<std::uint32_t> region_of(volumes.measures.size(), none);
    region_of[0] = 0;
    for (const Neighbour& n : neighbours_of_faces(tetrahedra)) {
        const std::uint32_t region = tetrahedra.region_of[n.tetrahedron];
        const std::uint32_t volume = volume_at(tetrahedra, volumes, n);
        if (volume_of[region] == none) volume_of[region] = volume;
        if (region_of[volume] == none) region_of[volume] = region;
        if (volume_of[region] != volume || region_of[volume] != region)
            return Error{
                ErrorCode::internal,
                fmt::format("region {} of the tetrahedra is not volume {}", region, volume),
                fmt::format("triangle {}", tetrahedra.face_triangle[n.face])};
    }
    if (std::count(volume_of.begin(), volume_of.end(), none) > 0 ||
        std::count(region_of.begin(), region_of.end(), none) > 0)
        return Error{
            ErrorCode::internal,
            fmt::format("{} regions of tetrahedra, {} volumes", volume_of.size(), region_of.size()),
            ""};
    for (std::uint32_t& region : tetrahedra.region_of) region = volume_of[region];
    return Done{};
}

} // namespace terrane
