// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What a certificate of a volume of interest means: the producer makes it again of the boundary
// that is stated.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <gmpxx.h>

#include "forge_geometry.hpp"
#include "forge_meaning.hpp"

namespace terrane::fuzz {

namespace {

// --- The volume ---------------------------------------------------------------------------------

bool same_surface(const Surface& a, const Surface& b) {
    return a.vertices == b.vertices && a.triangles == b.triangles;
}

double signed_volume(const std::vector<Surface>& boundary) {
    double sum = 0;
    const Point3 origin = boundary.front().vertices.front();
    for (const Surface& s : boundary)
        for (const Triangle& t : s.triangles) {
            const auto c = corners(s.vertices, t);
            sum += dot(c[0] - origin, cross(c[1] - origin, c[2] - origin)) / 6;
        }
    return sum;
}

std::set<std::array<double, 3>> corners_of(const std::vector<Surface>& boundary) {
    std::set<std::array<double, 3>> result;
    for (const Surface& s : boundary)
        for (const Triangle& t : s.triangles)
            for (const std::uint32_t v : t)
                result.insert({s.vertices[v].x, s.vertices[v].y, s.vertices[v].z});
    return result;
}

/// Tells whether the boundary is that of the prism over the polygon, or another volume that faces
/// outwards.
std::string stated_volume_flaw(const Subject& s, const VolumeClaim& claim) {
    if (claim.shape == "surface")
        return claim.files == 1 && s.files.size() == 2 &&
                       std::ranges::equal(claim.boundary, s.files[1].surfaces, same_surface)
                   ? ""
                   : "the surface of the volume";
    const double volume = signed_volume(claim.boundary);
    if (!(volume > 0)) return "the side of the boundary";
    const auto found = corners_of(claim.boundary);
    if (claim.shape == "hexahedron") return found.size() == 8 ? "" : "the corners of the volume";
    const auto& polygon = claim.corners;
    if (claim.shape != "prism" || polygon.empty() || claim.between.size() != 2) return "the shape";
    double twice = 0;
    std::set<std::array<double, 3>> right;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        twice += p[0] * q[1] - p[1] * q[0];
        for (const double z : claim.between) right.insert({p[0], p[1], z});
    }
    if (right != found) return "the corners of the volume";
    const double stated = std::abs(twice) / 2 * (claim.between[1] - claim.between[0]);
    return std::abs(stated - volume) <= 1e-9 * volume ? "" : "the polygon of the volume";
}

// --- What is outside ----------------------------------------------------------------------------

using Exact3 = std::array<mpq_class, 3>;

Exact3 exact_point(const Point3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}
Exact3 minus(const Exact3& a, const Exact3& b) {
    return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
Exact3 exact_cross(const Exact3& a, const Exact3& b) {
    return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
            mpq_class(a[0] * b[1] - a[1] * b[0])};
}
mpq_class exact_dot(const Exact3& a, const Exact3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns where the line through p and q meets the plane through a with this normal.
Exact3 on_plane(const Exact3& p, const Exact3& q, const Exact3& a, const Exact3& normal) {
    const Exact3 along_line = minus(q, p);
    const mpq_class share = exact_dot(normal, minus(a, p)) / exact_dot(normal, along_line);
    Exact3 result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = p[i] + share * along_line[i];
    return result;
}

Exact3 constructed(const Construction& how, const std::vector<Point3>& inputs) {
    const auto v = [&](std::size_t i) { return exact_point(inputs[how.v[i]]); };
    const auto normal = [&](std::size_t i) {
        return exact_cross(minus(v(i + 1), v(i)), minus(v(i + 2), v(i)));
    };
    switch (how.kind) {
    case Construction::Kind::input:
        return v(0);
    case Construction::Kind::line_plane:
        return on_plane(v(0), v(1), v(2), normal(2));
    case Construction::Kind::line_line: {
        Exact3 axis;
        axis[static_cast<std::size_t>(how.axis)] = 1;
        return on_plane(v(0), v(1), v(2), exact_cross(minus(v(3), v(2)), axis));
    }
    default: { // the planes n_k p = d_k meet in sum d_k (n_k+1 x n_k+2) / det
        const std::array<Exact3, 3> n{normal(0), normal(3), normal(6)};
        const mpq_class determinant = exact_dot(n[0], exact_cross(n[1], n[2]));
        Exact3 result;
        for (std::size_t k = 0; k < 3; ++k) {
            const mpq_class d = exact_dot(n[k], v(3 * k)) / determinant;
            const Exact3 other = exact_cross(n[(k + 1) % 3], n[(k + 2) % 3]);
            for (std::size_t i = 0; i < 3; ++i) result[i] += d * other[i];
        }
        return result;
    }
    }
}

/// Per list of parents: the area of the exact triangles that are dropped, and their centroids times
/// that.
using DroppedMoments = std::map<std::vector<std::uint32_t>, std::array<double, 4>>;

DroppedMoments dropped_moments(const Subject& s, const Certificate& certificate) {
    std::vector<Point3> inputs;
    for (const Surface& surface : arranged_surfaces(s, certificate))
        inputs.insert(inputs.end(), surface.vertices.begin(), surface.vertices.end());
    std::vector<Point3> points;
    for (const Construction& how : certificate.exact.vertices) {
        const Exact3 p = constructed(how, inputs);
        points.push_back({p[0].get_d(), p[1].get_d(), p[2].get_d()});
    }
    DroppedMoments moments;
    for (const std::uint32_t t : certificate.cut->dropped) {
        const auto parents = certificate.exact.parents_of[t];
        auto& sum = moments[{parents.begin(), parents.end()}];
        const auto c = corners(points, certificate.exact.triangles[t]);
        const double area = length(area_vector(c));
        sum[0] += area;
        for (const Point3& p : c) {
            sum[1] += area * p.x;
            sum[2] += area * p.y;
            sum[3] += area * p.z;
        }
    }
    return moments;
}

bool are_close(const DroppedMoments& a, const DroppedMoments& b) {
    return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
        if (x.first != y.first) return false;
        for (std::size_t i = 0; i < 4; ++i)
            if (std::abs(x.second[i] - y.second[i]) > 1e-9 * (1 + std::abs(x.second[i])))
                return false;
        return true;
    });
}

} // namespace

std::string difference_of_cut(const Subject& s, const Certificate& changed, double accepted) {
    const VolumeClaim& volume = changed.cut->volume;
    if (auto flaw = stated_volume_flaw(s, volume); !flaw.empty()) return flaw;
    // A certificate of another volume may be true, too.
    std::optional<Subject> again;
    if (!std::ranges::equal(volume.boundary, s.certificate.cut->volume.boundary, same_surface)) {
        again = cut_again(s, volume.boundary);
        if (!again) return "a boundary that the producer refuses";
    }
    const Subject& right = again ? *again : s;
    if (right.certificate.digest != changed.digest) return "the digest";
    if (has_turned(right.certificate.exact, changed.exact)) return "a side";
    if (!are_close(dropped_moments(s, changed), dropped_moments(s, right.certificate)))
        return "what is outside";
    if (!changed.rounded) return changed.outputs.empty() ? "" : "whether there are doubles";
    return difference_of_doubles(right, *changed.rounded, accepted);
}

} // namespace terrane::fuzz
