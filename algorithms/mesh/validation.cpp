// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/validation.hpp>

#include <algorithm>
#include <string>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

std::string place_in(const std::string& owner, const char* what, std::size_t k) {
    return owner + what + " " + std::to_string(k);
}

/// The first of [0, count) for which it does not hold, or count.
template <class Holds>
std::size_t first_without(const Holds& holds, std::size_t count, const Run& run) {
    const auto firsts =
        parts_of_ranges<std::size_t>(count, run, [&](std::size_t begin, std::size_t end) {
            while (begin < end && holds(begin)) ++begin;
            return begin < end ? begin : count;
        });
    return *std::min_element(firsts.begin(), firsts.end());
}

/// `owner` stands before the place of an error: "surface top, " or nothing.
Status validate_part(std::span<const Point3> points, std::span<const Triangle> triangles,
                     const std::string& owner, const Run& run) {
    const auto finite = [&](std::size_t v) { return is_finite(points[v]); };
    if (const auto v = first_without(finite, points.size(), run); v < points.size())
        return Error{ErrorCode::bad_number, "a coordinate is not finite",
                     place_in(owner, "vertex", v)};
    const auto has_corners = [&](std::size_t t) {
        const Triangle& c = triangles[t];
        return std::max({c[0], c[1], c[2]}) < points.size();
    };
    if (const auto t = first_without(has_corners, triangles.size(), run); t < triangles.size())
        return Error{ErrorCode::bad_index, "a corner names no vertex",
                     place_in(owner, "triangle", t)};
    return Done{};
}

Status validate_lists(const Mesh& mesh) {
    const auto bad = [](std::string sentence, std::string place) {
        return Error{ErrorCode::bad_index, std::move(sentence), std::move(place)};
    };
    const std::size_t count = mesh.triangles.size();
    if (mesh.surfaces_of.size() != count)
        return bad("surfaces_of must have one list per triangle", "");
    if (mesh.regions_of.size() != 0 && mesh.regions_of.size() != count)
        return bad("regions_of must have one list per triangle, or none", "");
    for (std::size_t t = 0; t < count; ++t) {
        if (mesh.surfaces_of[t].empty())
            return bad("it has no surface", place_in("", "triangle", t));
        for (const std::uint32_t s : mesh.surfaces_of[t])
            if (s >= mesh.surfaces.size())
                return bad("there is no surface " + std::to_string(s), place_in("", "triangle", t));
    }
    return Done{};
}

} // namespace

Status validate(std::span<const Surface> surfaces, const Run& run) {
    std::size_t vertices = 0, triangles = 0;
    for (const Surface& s : surfaces) {
        vertices += s.vertices.size();
        triangles += s.triangles.size();
        if (auto valid = validate_part(s.vertices, s.triangles, "surface " + s.name + ", ", run);
            !valid)
            return valid;
    }
    if (vertices >= UINT32_MAX / 2 || triangles >= UINT32_MAX / 4)
        return Error{ErrorCode::unsupported, "more than 2^30 triangles or 2^31 vertices", ""};
    return Done{};
}

Status validate(std::span<const Point3> points, std::span<const Triangle> triangles,
                const Run& run) {
    return validate_part(points, triangles, "", run);
}

Status validate_areas(std::span<const Point3> points, std::span<const Triangle> triangles,
                      const Run& run) {
    if (auto valid = validate(points, triangles, run); !valid) return valid;
    const auto has_area = [&](std::size_t t) {
        const auto& [a, b, c] = triangles[t];
        return !collinear(points[a], points[b], points[c]);
    };
    if (const auto t = first_without(has_area, triangles.size(), run); t < triangles.size())
        return Error{ErrorCode::improper_contact, "it has no area", place_in("", "triangle", t)};
    return Done{};
}

Status validate_mesh(const Mesh& mesh, const Run& run) {
    if (auto valid = validate_lists(mesh); !valid) return valid;
    return validate_areas(mesh.vertices, mesh.triangles, run);
}

} // namespace terrane
