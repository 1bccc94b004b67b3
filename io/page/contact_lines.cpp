// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/page/contact_lines.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::page {
namespace {

using Corners = std::array<Point3, 3>;
using Polygon = std::vector<Point3>;

constexpr double near_zero = 1e-9;       // of the longest edge: distances that count as none
constexpr double size_of_cross = 0.0025; // of the model's extent: half the length of its arms

Point3 between(const Point3& a, const Point3& b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}

/// Keeps what is at most `margin` in front of a plane, given by a point and its unit normal.
Polygon clipped(const Polygon& polygon, const Point3& at, const Point3& normal, double margin) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double d = dot(minus(p, at), normal), e = dot(minus(q, at), normal);
        if (d <= margin) kept.push_back(p);
        if ((d <= margin) != (e <= margin)) kept.push_back(between(p, q, d / (d - e)));
    }
    return kept;
}

double reach_of(const Corners& t) {
    return std::max(
        {length(minus(t[1], t[0])), length(minus(t[2], t[1])), length(minus(t[0], t[2]))});
}

Point3 unit(const Point3& v) {
    const double size = length(v);
    return size > 0 ? Point3{v.x / size, v.y / size, v.z / size} : Point3{};
}

/// Returns the part of a polygon, a segment or an area, that lies inside a triangle of its plane, or
/// of a plane through it.
Polygon inside(Polygon polygon, const Corners& t, double margin) {
    const Point3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
        const Point3 outwards = unit(cross(minus(t[(k + 1) % 3], t[k]), normal));
        polygon = clipped(polygon, t[k], outwards, margin);
    }
    return polygon;
}

/// Returns the segment in which a triangle meets the plane of another one; empty: nowhere, or along
/// an area.
Polygon in_plane(const Corners& t, const Corners& plane, double margin) {
    const Point3 normal = unit(cross(minus(plane[1], plane[0]), minus(plane[2], plane[0])));
    std::array<double, 3> d{};
    for (std::size_t k = 0; k < 3; ++k) {
        d[k] = dot(minus(t[k], plane[0]), normal);
        if (std::fabs(d[k]) <= margin) d[k] = 0;
    }
    Polygon ends;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t n = (k + 1) % 3;
        if (d[k] == 0) ends.push_back(t[k]);
        if (d[k] * d[n] < 0) ends.push_back(between(t[k], t[n], d[k] / (d[k] - d[n])));
    }
    return ends.size() == 2 ? ends : Polygon();
}

bool is_coplanar(const Corners& t, const Corners& u, double margin) {
    const Point3 normal = unit(cross(minus(u[1], u[0]), minus(u[2], u[0])));
    return std::ranges::all_of(
        t, [&](const Point3& p) { return std::fabs(dot(minus(p, u[0]), normal)) <= margin; });
}

/// Returns the two points that are farthest from each other, of points on a line.
Polygon ends_of(const Polygon& points) {
    Polygon ends;
    double most = -1;
    for (const Point3& p : points)
        for (const Point3& q : points)
            if (const double d = length(minus(q, p)); d > most) {
                most = d;
                ends = {p, q};
            }
    return ends;
}

/// Returns the segment or the area that two triangles share, as far as doubles tell.
Polygon shared(const Corners& t, const Corners& u) {
    const double margin = near_zero * std::max(reach_of(t), reach_of(u));
    if (is_coplanar(t, u, margin)) return inside({t.begin(), t.end()}, u, margin);
    return ends_of(inside(in_plane(t, u, margin), u, margin));
}

class ContactDrawer {
public:
    ContactDrawer(Scene& scene, const Mesh& mesh) : scene_(scene), mesh_(mesh) {
        if (mesh.vertices.empty()) return;
        Point3 low = mesh.vertices.front(), high = low;
        for (const Point3& p : mesh.vertices) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        arm_ = size_of_cross * length(minus(high, low));
        line_ = {"improper contact", {}, 0, scene.segments.size(), 0};
    }

    void operator()(const ImproperContact& contact) {
        const Polygon part = shared(corners(contact.triangles[0]), corners(contact.triangles[1]));
        const std::size_t before = scene_.segments.size();
        for (std::size_t i = 0; i + 1 < part.size(); ++i) add(part[i], part[i + 1]);
        if (part.size() > 2) add(part.back(), part.front());
        if (scene_.segments.size() == before) add_cross(contact.place);
    }

    void finish() {
        line_.count = scene_.segments.size() - line_.first;
        if (line_.count > 0) scene_.lines.push_back(line_);
    }

private:
    [[nodiscard]] Corners corners(std::uint32_t triangle) const {
        const Triangle& t = mesh_.triangles[triangle];
        return {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
    }

    /// Adds a segment unless it is shorter than doubles tell.
    void add(const Point3& a, const Point3& b) {
        const double size = length(minus(b, a));
        if (!(size > near_zero * arm_)) return;
        const auto first = static_cast<std::uint32_t>(scene_.vertices.size());
        scene_.vertices.insert(scene_.vertices.end(), {a, b});
        scene_.segments.push_back({first, first + 1});
        line_.length += size;
    }

    void add_cross(const Point3& p) {
        const double measured = line_.length;
        add({p.x - arm_, p.y, p.z}, {p.x + arm_, p.y, p.z});
        add({p.x, p.y - arm_, p.z}, {p.x, p.y + arm_, p.z});
        add({p.x, p.y, p.z - arm_}, {p.x, p.y, p.z + arm_});
        line_.length = measured; // a point has none
    }

    Scene& scene_;
    const Mesh& mesh_;
    double arm_ = 0;
    SceneLine line_;
};

} // namespace

void add_contact_lines(Scene& scene, const Mesh& mesh, std::span<const ImproperContact> contacts,
                       std::size_t most) {
    ContactDrawer draw(scene, mesh);
    for (const ImproperContact& contact : contacts.first(std::min(most, contacts.size())))
        draw(contact);
    draw.finish();
}

} // namespace terrane::page
