// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The meaning of a certificate of a volume of interest: the producer makes it again of the boundary
// that is stated.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

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

/// Per list of parents: the area of the exact triangles that are dropped, and their centroids times
/// that.
using DroppedMoments = std::map<std::vector<std::uint32_t>, std::array<double, 4>>;

DroppedMoments dropped_moments(const Subject& s, const Certificate& certificate) {
    const auto points = points_of_exact(arranged_surfaces(s, certificate), certificate.exact);
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

std::string difference_of_volume(const Subject& s, const VolumeClaim& claim) {
    return stated_volume_flaw(s, claim);
}

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
