// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: the mesh that an arrangement is rounded to is accepted; without one of its triangles, with
// one moved off or with one twice, it is not.
#include "property.hpp"

#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

#include <algorithm>
#include <cmath>

namespace terrane::fuzz {

Soup input(Bytes& bytes) {
    return fuzzing::soup(bytes, 14);
}

namespace {

/// Names the properties that fail.
std::string failing(const Result<MeshJudgement>& found) {
    if (!found) return found.error().message();
    std::string names;
    for (const JudgedProperty& p : found->properties)
        if (p.verdict == PropertyVerdict::fails) names += " " + p.name;
    return names;
}
/// Damage may be in doubt where the exact result has parts thinner than the bound.
bool is_accepted(const Surface& mesh, std::span<const Surface> inputs) {
    const auto found = judge(std::span(&mesh, 1), inputs);
    return found && found->holds() && found->complete();
}

double size_of(const Surface& mesh) {
    double size = 1;
    for (const Point3& p : mesh.vertices)
        size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return size;
}

/// Whether a triangle is thinner than four times the default bound: without it points are where they may be.
bool is_thin(const Surface& mesh, const Triangle& corners) {
    const Point3 &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]],
                 &c = mesh.vertices[corners[2]];
    const double longest =
        std::max({length(minus(b, a)), length(minus(c, b)), length(minus(a, c))});
    return length(cross(minus(b, a), minus(c, a))) <= 0x1p-46 * size_of(mesh) * longest;
}

/// Names a damage to a triangle that is not found.
std::string overlooked(const Surface& mesh, std::size_t t, std::span<const Surface> inputs) {
    if (is_thin(mesh, mesh.triangles[t])) return "";
    Surface s = mesh;
    s.triangles.erase(s.triangles.begin() + static_cast<std::ptrdiff_t>(t));
    if (is_accepted(s, inputs)) return "a triangle that is missing";
    s = mesh;
    s.triangles.push_back(s.triangles[t]);
    if (is_accepted(s, inputs)) return "a triangle that is there twice";
    s = mesh;
    const double size = size_of(mesh);
    for (std::uint32_t& v : s.triangles[t]) {
        const Point3 p = s.vertices[v];
        v = static_cast<std::uint32_t>(s.vertices.size());
        s.vertices.push_back({p.x, p.y + size / 1024, p.z - size / 512});
    }
    return is_accepted(s, inputs) ? "a triangle that is moved" : "";
}

} // namespace

std::string flaw(std::span<const Surface> surfaces) {
    const auto exact = arrange(surfaces);
    if (!exact) return exact.error().message();
    const auto made = round_to_doubles(*exact);
    if (!made || !made->report.clean) return "";
    const Surface mesh{"", Role::unknown, made->mesh->vertices, made->mesh->triangles};
    const auto found = judge(std::span(&mesh, 1), surfaces);
    if (!found && found.error().code == ErrorCode::unsupported)
        return ""; // too large, or too small
    if (const auto names = failing(found);
        !names.empty()) // known, and rare: heaps where surfaces had to move
        return made->report.naive_contacts > 0 ? "" : "a good mesh is refused:" + names;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 1 + mesh.triangles.size() / 4)
        if (const auto what = overlooked(mesh, t, surfaces); !what.empty())
            return "it overlooks " + what;
    return "";
}

} // namespace terrane::fuzz
