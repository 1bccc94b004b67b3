// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: the tetrahedra of a conforming mesh fill the box exactly, and the faces that name a
// triangle have its area; or a failure of TetGen, in its child process, is reported. A mesh that is
// not conforming is refused with the right error.
#include "property.hpp"

#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace terrane::fuzz {

Soup input(Bytes& bytes) {
    return fuzzing::soup(bytes, 8);
}

namespace {

using Rational = CGAL::Exact_rational;
using Vector = std::array<Rational, 3>;

Vector between(const Point3& from, const Point3& to) {
    return {Rational(to.x) - Rational(from.x), Rational(to.y) - Rational(from.y),
            Rational(to.z) - Rational(from.z)};
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Rational six_volumes(const std::vector<Point3>& p, const std::array<std::uint32_t, 4>& t) {
    const Vector n = cross(between(p[t[0]], p[t[1]]), between(p[t[0]], p[t[2]]));
    const Vector d = between(p[t[0]], p[t[3]]);
    return n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
}

Vector normal(const std::vector<Point3>& p, const Triangle& t) {
    return cross(between(p[t[0]], p[t[1]]), between(p[t[0]], p[t[2]]));
}

/// Compares the volume of the tetrahedra with that of the box of all vertices, to which the corners
/// of the box belong.
std::string volume_flaw(const TetrahedralMesh& mesh) {
    Rational sum = 0;
    for (const auto& t : mesh.tetrahedra) {
        const Rational six = six_volumes(mesh.vertices, t);
        if (six <= 0) return "a tetrahedron without volume, or turned inside out";
        sum += six;
    }
    Point3 low = mesh.vertices[0], high = low;
    for (const Point3& p : mesh.vertices) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vector size = between(low, high);
    return sum == 6 * size[0] * size[1] * size[2] ? "" : "the volumes do not add up to the box";
}

/// Compares faces with triangles: an undivided one equals its triangle; the normals of parts, whose
/// new corners are rounded, add up to that of the triangle but for rounding.
std::string faces_flaw(const Mesh& mesh, const TetrahedralMesh& made) {
    std::map<std::uint32_t, Vector> sums;
    std::map<std::uint32_t, std::size_t> parts;
    for (std::size_t f = 0; f < made.faces.size(); ++f) {
        const std::uint32_t t = made.face_triangle[f];
        if (t == UINT32_MAX) continue;
        if (t >= mesh.triangles.size()) return "a face of a triangle that does not exist";
        const Vector n = normal(made.vertices, made.faces[f]);
        for (unsigned k = 0; k < 3; ++k) sums[t][k] += n[k];
        ++parts[t];
    }
    if (sums.size() != mesh.triangles.size()) return "a triangle without a face";
    Rational largest = 0;
    for (const Point3& p : made.vertices)
        for (const double c : {p.x, p.y, p.z}) largest = std::max(largest, Rational(std::fabs(c)));
    const Rational rounding = largest * largest * Rational(0x1p-44);
    for (const auto& [t, sum] : sums) {
        const Vector whole = normal(mesh.vertices, mesh.triangles[t]);
        if (parts[t] == 1 && sum != whole) return "a face is not the triangle that it names";
        for (unsigned k = 0; k < 3; ++k)
            if (abs(sum[k] - whole[k]) > rounding) return "parts of a triangle do not add up to it";
    }
    return "";
}

} // namespace

std::string flaw(std::span<const Surface> surfaces) {
    const auto arranged = arrange(surfaces);
    if (!arranged) return arranged.error().message();
    const auto rounded = round_to_doubles(arranged.value());
    if (!rounded) // what is constructed may be beyond the largest double
        return rounded.error().code == ErrorCode::bad_number ? "" : rounded.error().message();
    if (rounded.value().mesh->triangles.empty()) return "";
    const Mesh& mesh = rounded.value().mesh;
    const auto made = tetrahedralize(mesh, {.time_limit = 1}, {}); // TetGen may loop for ever
    if (!rounded.value().report.clean)
        return !made && made.error().code == ErrorCode::improper_contact
                   ? ""
                   : "a mesh that is not conforming is not refused as such";
    if (!made) {
        const Error& error = made.error();
        const bool without_helper = error.code == ErrorCode::cannot_open; // nothing was looked at
        const bool by_tetgen = error.sentence.find("TetGen") != std::string::npos;
        const bool allowed = error.code == ErrorCode::unsupported ||
                             error.code == ErrorCode::bad_number || by_tetgen;
        return allowed && !without_helper ? "" : error.message();
    }
    if (!std::equal(mesh.vertices.begin(), mesh.vertices.end(), made.value().vertices.begin()))
        return "a vertex of the mesh was moved";
    if (auto what = volume_flaw(made.value()); !what.empty()) return what;
    return faces_flaw(mesh, made.value());
}

} // namespace terrane::fuzz
