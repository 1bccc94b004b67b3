// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Volumes of blocks within boxes by another method than the engine's: signed tetrahedra from one point to the
// boundary, each divided at the planes of the box, in rationals.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gmpxx.h>

#include <terrane/algorithms/sections/sections.hpp>

#include "support/winding_oracle.hpp"

namespace test_support {

using RationalTetrahedron = std::array<RationalPoint, 4>;

inline mpq_class six_volumes(const RationalTetrahedron& t) {
    const auto from = [&](std::size_t k) {
        return RationalPoint{t[k][0] - t[0][0], t[k][1] - t[0][1], t[k][2] - t[0][2]};
    };
    return determinant(from(1), from(2), from(3));
}

/// Returns what is left of a tetrahedron where side * (coordinate - at) >= 0, as tetrahedra.
inline std::vector<RationalTetrahedron> left_of(const RationalTetrahedron& t, std::size_t axis,
                                                const mpq_class& at, int side) {
    std::vector<RationalPoint> in, out;
    for (const RationalPoint& p : t) (side * (p[axis] - at) >= 0 ? in : out).push_back(p);
    const auto between = [&](const RationalPoint& p, const RationalPoint& q) {
        const mpq_class share = (at - p[axis]) / (q[axis] - p[axis]);
        RationalPoint m;
        for (std::size_t a = 0; a < 3; ++a) m[a] = p[a] + share * (q[a] - p[a]);
        return m;
    };
    const auto prism = [](const RationalPoint& a, const RationalPoint& b, const RationalPoint& c,
                          const RationalPoint& d, const RationalPoint& e, const RationalPoint& f) {
        return std::vector<RationalTetrahedron>{{a, b, c, d}, {b, c, d, e}, {c, d, e, f}};
    };
    switch (in.size()) {
    case 0:
        return {};
    case 1:
        return {{in[0], between(in[0], out[0]), between(in[0], out[1]), between(in[0], out[2])}};
    case 2:
        return prism(in[0], between(in[0], out[0]), between(in[0], out[1]), in[1],
                     between(in[1], out[0]), between(in[1], out[1]));
    case 3:
        return prism(in[0], in[1], in[2], between(in[0], out[0]), between(in[1], out[0]),
                     between(in[2], out[0]));
    default:
        return {t};
    }
}

/// Returns six times the volume of a tetrahedron within a box, which is not negative.
inline mpq_class six_volumes_within(const RationalTetrahedron& t,
                                    const std::array<std::array<mpq_class, 2>, 3>& box) {
    std::vector<RationalTetrahedron> parts{t};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t end = 0; end < 2; ++end) {
            std::vector<RationalTetrahedron> left;
            for (const auto& part : parts)
                for (const auto& piece : left_of(part, axis, box[axis][end], end == 0 ? 1 : -1))
                    if (six_volumes(piece) != 0) left.push_back(piece);
            parts = std::move(left);
        }
    mpq_class sum;
    for (const auto& part : parts) sum += abs(six_volumes(part));
    return sum;
}

/// Returns the volume of each block within a cell, in units of the cell; [0] is that of the outside.
inline std::vector<mpq_class> fractions_by_tetrahedra(const terrane::Mesh& mesh,
                                                      const terrane::Volumes& volumes,
                                                      const terrane::RectilinearGrid& grid,
                                                      std::size_t cell) {
    const auto [nx, ny, nz] = grid.counts();
    const auto ends = [](const std::vector<double>& planes, std::size_t i) {
        return std::array{mpq_class(planes[i]), mpq_class(planes[i + 1])};
    };
    const std::array box{ends(grid.x, cell % nx), ends(grid.y, cell / nx % ny),
                         ends(grid.z, cell / nx / ny)};
    const RationalPoint apex{box[0][0], box[1][1], box[2][0]};
    std::vector<mpq_class> sums(volumes.measures.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (volumes.dangles(t)) continue;
        RationalTetrahedron tetrahedron{apex};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& p = mesh.vertices[mesh.triangles[t][k]];
            tetrahedron[k + 1] = {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
        }
        const int side = sgn(six_volumes(tetrahedron));
        if (side == 0) continue;
        const mpq_class part = six_volumes_within(tetrahedron, box) * side;
        sums[volumes.of_sides[t][1]] += part;
        sums[volumes.of_sides[t][0]] -= part;
    }
    const mpq_class size =
        (box[0][1] - box[0][0]) * (box[1][1] - box[1][0]) * (box[2][1] - box[2][0]);
    for (mpq_class& sum : sums) sum /= 6 * size;
    sums[0] += 1;
    return sums;
}

} // namespace test_support
