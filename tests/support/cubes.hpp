// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Cubes of tetrahedra, and what tests of optimise() measure of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <gmpxx.h>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/kernel/predicates.hpp>

namespace test_support {

using namespace terrane;

using Cell = std::array<std::uint32_t, 4>;

/// n^3 cubes of six tetrahedra each. Vertices inside of a block are displaced at random by up to
/// `disorder` edges, as long as no tetrahedron is inverted. The plane z = wall divides the cubes
/// into blocks 1 and 2; none if it is 0.
class Cubes {
public:
    Cubes(int n, int wall, double disorder, std::uint64_t seed) : n_(n), wall_(wall) {
        for (int k = 0; k <= n; ++k)
            for (int j = 0; j <= n; ++j)
                for (int i = 0; i <= n; ++i)
                    mesh.vertices.push_back({double(i), double(j), double(k)});
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) add_cube(i, j, k);
        mesh.block_count = 3;
        mesh.surfaces = {{"wall", Role::horizon}, {"box", Role::boundary}};
        add_faces();
        displace(disorder, seed);
    }

    TetrahedralMesh mesh;

private:
    [[nodiscard]] std::uint32_t at(int i, int j, int k) const {
        return static_cast<std::uint32_t>((k * (n_ + 1) + j) * (n_ + 1) + i);
    }

    void add_cube(int i, int j, int k) {
        std::array<int, 3> order{0, 1, 2};
        do { // a path along the axes, in each order
            std::array<int, 3> p{i, j, k};
            Cell cell{at(i, j, k)};
            for (std::size_t s = 0; s < 3; ++s) {
                ++p[static_cast<std::size_t>(order[s])];
                cell[s + 1] = at(p[0], p[1], p[2]);
            }
            const auto& v = mesh.vertices;
            if (orient3d(v[cell[0]], v[cell[1]], v[cell[2]], v[cell[3]]) != Sign::Positive)
                std::swap(cell[2], cell[3]);
            mesh.tetrahedra.push_back(cell);
            mesh.block_of.push_back(wall_ > 0 && k >= wall_ ? 2 : 1);
        } while (std::next_permutation(order.begin(), order.end()));
    }

    void add_faces() {
        std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> beside;
        for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
            for (unsigned k = 0; k < 4; ++k) {
                const Cell& c = mesh.tetrahedra[t];
                std::array<std::uint32_t, 3> face{c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]};
                std::sort(face.begin(), face.end());
                beside[face].push_back(mesh.block_of[t]);
            }
        for (const auto& [face, blocks] : beside) {
            const bool inside = blocks.size() == 2;
            if (inside && blocks[0] == blocks[1]) continue;
            mesh.faces.push_back({face[0], face[1], face[2]});
            mesh.face_triangle.push_back(inside ? 0 : UINT32_MAX);
            mesh.surfaces_of.push_back(std::array<std::uint32_t, 1>{inside ? 0U : 1U});
        }
    }

    void displace(double disorder, std::uint64_t seed) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> by(-disorder, disorder);
        std::vector<bool> fixed(mesh.vertices.size(), false);
        for (const Triangle& f : mesh.faces)
            for (const std::uint32_t v : f) fixed[v] = true;
        for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
            if (fixed[v]) continue;
            const Point3 before = mesh.vertices[v];
            mesh.vertices[v] = {before.x + by(random), before.y + by(random),
                                before.z + by(random)};
            const auto& p = mesh.vertices;
            for (const Cell& c : mesh.tetrahedra)
                if (std::find(c.begin(), c.end(), v) != c.end() &&
                    orient3d(p[c[0]], p[c[1]], p[c[2]], p[c[3]]) != Sign::Positive)
                    mesh.vertices[v] = before;
        }
    }

    int n_, wall_;
};

inline std::array<Point3, 4> corners_of(const TetrahedralMesh& mesh, const Cell& c) {
    return {mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]], mesh.vertices[c[3]]};
}

/// Sines of the worst dihedral angles, by the angles that are reported, ascending.
inline std::vector<double> sines(const TetrahedralMesh& mesh) {
    std::vector<double> all;
    for (const Cell& c : mesh.tetrahedra) {
        double least = 1;
        for (const double degrees : dihedral_angles(corners_of(mesh, c)))
            least = std::min(least, std::sin(degrees * std::numbers::pi / 180));
        all.push_back(least);
    }
    std::sort(all.begin(), all.end());
    return all;
}

/// The qualities as optimise.hpp defines them, by the angles that are reported, ascending.
inline std::vector<double> qualities(const TetrahedralMesh& mesh) {
    std::vector<double> all;
    for (const Cell& c : mesh.tetrahedra) {
        double least = 1;
        for (const double degrees : dihedral_angles(corners_of(mesh, c)))
            least = std::min(least,
                             std::sin(degrees * std::numbers::pi / 180) * (degrees > 90 ? 0.7 : 1));
        all.push_back(least);
    }
    std::sort(all.begin(), all.end());
    return all;
}

inline double least_quality(const TetrahedralMesh& mesh) {
    return qualities(mesh)[0];
}

inline mpq_class six_volumes(const TetrahedralMesh& mesh, std::uint32_t block) {
    mpq_class sum = 0;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
        if (mesh.block_of[t] != block) continue;
        const auto p = corners_of(mesh, mesh.tetrahedra[t]);
        std::array<std::array<mpq_class, 3>, 3> e;
        for (std::size_t k = 0; k < 3; ++k)
            e[k] = {mpq_class(p[k + 1].x) - p[0].x, mpq_class(p[k + 1].y) - p[0].y,
                    mpq_class(p[k + 1].z) - p[0].z};
        sum += e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
               e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
               e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    }
    return sum;
}

} // namespace test_support
