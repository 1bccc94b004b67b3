// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: two triangles meet in the same points as in CGAL's exact kernel, in the stated
// simplices, in either order and for any first corner; and they meet improperly iff the verifier
// finds so.
#include "property.hpp"

#include "support/contact_oracle.hpp"

#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::fuzz {

Soup input(Bytes& bytes) {
    Points points(bytes);
    Soup soup(2);
    for (Part& part : soup)
        add_triangle(part, {points.next(bytes), points.next(bytes), points.next(bytes)});
    return soup;
}

namespace {

/// Joins surfaces into one list of triangles; equal points get the same index.
std::vector<Triangle> merged(std::span<const Surface> surfaces, std::vector<Point3>& points) {
    std::vector<Triangle> triangles;
    for (const Surface& s : surfaces)
        for (Triangle t : s.triangles) {
            for (std::uint32_t& v : t) {
                const Point3& p = s.vertices[v];
                const auto at = std::find(points.begin(), points.end(), p);
                v = static_cast<std::uint32_t>(at - points.begin());
                if (at == points.end()) points.push_back(p);
            }
            triangles.push_back(t);
        }
    return triangles;
}

} // namespace

std::string flaw(std::span<const Surface> surfaces) {
    std::vector<Point3> points;
    const auto triangles = merged(surfaces, points);
    if (triangles.size() != 2) return "";
    const Triangle &s = triangles[0], &t = triangles[1];
    for (const Triangle& each : triangles)
        if (collinear(points[each[0]], points[each[1]], points[each[2]])) return "";
    if (contact_oracle::shared_corners(s, t).size() == 3) return "";
    const auto contact = improper_contact(points, s, t);
    if (contact.has_value() == verify_conforming(points, triangles).empty())
        return contact ? "the verifier finds no contact" : "the verifier finds a contact";
    return contact_oracle::flaw(contact_oracle::Corners(points), s, t, contact);
}

} // namespace terrane::fuzz
