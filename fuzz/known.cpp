// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: an arrangement that takes over what the one before found about triangles that stayed is the
// same as one that does not, down to what later stages take from it. The surfaces are arranged in several
// versions, one after the other; the object for what is known goes through all of them.
#include "property.hpp"

#include "support/differences.hpp"

#include <terrane/algorithms/arrangement/known_triangles.hpp>

#include <algorithm>

namespace terrane::fuzz {

namespace {

using Model = std::vector<Surface>;

void move(Surface& s, const Point3& by) {
    for (Point3& p : s.vertices) p = {p.x + by.x, p.y + by.y, p.z + by.z};
}

/// Returns the vector from the first vertex to another one: on a lattice, points that move by it come to
/// lie on others.
Point3 step_in(const Model& model) {
    const Point3* first = nullptr;
    for (const Surface& s : model)
        for (const Point3& p : s.vertices) {
            if (first == nullptr) first = &p;
            if (*first != p) return {p.x - first->x, p.y - first->y, p.z - first->z};
        }
    return {};
}

/// Adds the first triangle of one surface to another one.
void repeat_triangle(const Surface& of, Surface& in) {
    if (of.triangles.empty()) return;
    const Triangle t = of.triangles.front();
    const auto first = static_cast<std::uint32_t>(in.vertices.size());
    for (const std::uint32_t v : t)
        in.vertices.push_back(Point3(of.vertices[v])); // it may be the same
    in.triangles.push_back({first, first + 1, first + 2});
}

/// Changes surface s in one of several ways, or the order of all.
Model changed(Model model, std::size_t s, unsigned how) {
    Surface& one = model[s];
    auto& triangles = one.triangles;
    switch (how) {
    case 0:
        move(one, step_in(model));
        break;
    case 1:
        if (!triangles.empty()) triangles.erase(triangles.begin());
        break;
    case 2:
        std::ranges::reverse(triangles);
        break;
    case 3: // the same orientation, with another first corner
        for (Triangle& t : triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
        break;
    case 4:
        repeat_triangle(one, model[(s + 1) % model.size()]);
        break;
    case 5:
        std::rotate(model.begin(), model.begin() + static_cast<std::ptrdiff_t>(s), model.end());
        break;
    default:
        if (!one.vertices.empty()) one.vertices.back() = one.vertices.front();
    }
    return model;
}

} // namespace

Soup input(Bytes& bytes) {
    return fuzzing::soup(bytes, 24);
}

std::string flaw(std::span<const Surface> surfaces) {
    const Model first(surfaces.begin(), surfaces.end());
    KnownTriangles known;
    const auto flaw_of = [&](const Model& model) -> std::string {
        const auto with = arrange(model, {}, known), without = arrange(model);
        if (!with) return with.error().message();
        if (!without) return without.error().message();
        return test_support::difference(*with, *without);
    };
    if (auto what = flaw_of(first); !what.empty()) return what;
    for (std::size_t s = 0; s < first.size(); ++s)
        for (unsigned how = 0; how < 7; ++how)
            if (const auto what = flaw_of(changed(first, s, how)); !what.empty())
                return "other " + what + " after change " + std::to_string(how) + " of surface " +
                       std::to_string(s);
    return "";
}

} // namespace terrane::fuzz
