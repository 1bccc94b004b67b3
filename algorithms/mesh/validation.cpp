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

Error bad(std::string sentence, std::string place = "") {
    return {ErrorCode::bad_index, std::move(sentence), std::move(place)};
}

/// Checks lists per triangle or face: they can be walked through, and their values are below `bound`.
Status validate_lists(const IndexLists<std::uint32_t>& lists, const char* name, std::size_t count,
                      std::size_t bound) {
    const auto& offsets = lists.offsets;
    const bool are_lists = !offsets.empty() && offsets.front() == 0 &&
                           offsets.back() == lists.values.size() && std::ranges::is_sorted(offsets);
    if (!are_lists) return bad(std::string(name) + ": the offsets do not divide the values");
    if (lists.size() != count) return bad(std::string(name) + " must have one list per triangle");
    for (std::size_t t = 0; t < count; ++t)
        for (const std::uint32_t v : lists[t])
            if (v >= bound)
                return bad(std::string(name) + " names " + std::to_string(v) + " of " +
                               std::to_string(bound),
                           place_in("", "triangle", t));
    return Done{};
}

/// Checks the surfaces of triangles or faces: each has at least one.
Status validate_surfaces(const IndexLists<std::uint32_t>& surfaces_of, std::size_t count,
                         std::size_t surfaces) {
    if (auto valid = validate_lists(surfaces_of, "surfaces_of", count, surfaces); !valid)
        return valid;
    for (std::size_t t = 0; t < count; ++t)
        if (surfaces_of[t].empty()) return bad("it has no surface", place_in("", "triangle", t));
    return Done{};
}

Status validate_lists(const Mesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    if (auto valid = validate_surfaces(mesh.surfaces_of, count, mesh.surfaces.size()); !valid)
        return valid;
    const std::size_t most_regions = mesh.surfaces_of.values.size();
    if (const auto& of = mesh.regions_of; of.offsets.size() != 1 || !of.values.empty()) {
        if (auto valid = validate_lists(of, "regions_of", count, most_regions); !valid)
            return valid;
        if (of.offsets != mesh.surfaces_of.offsets)
            return bad("regions_of must name one region per surface of a triangle");
    }
    if (const auto& of = mesh.parents_of; of.offsets.size() != 1 || !of.values.empty())
        if (auto valid = validate_lists(of, "parents_of", count, UINT32_MAX); !valid) return valid;
    for (std::size_t e = 0; e < mesh.intersection_edges.size(); ++e)
        if (const auto& [low, high] = mesh.intersection_edges[e];
            low >= high || high >= mesh.vertices.size())
            return bad("it is not two vertices, the lower first",
                       place_in("", "intersection edge", e));
    return Done{};
}

/// Checks that all numbers of an array of cells name one of `count`.
template <class Cells>
Status validate_cells(const Cells& cells, const char* name, std::size_t count) {
    for (std::size_t i = 0; i < cells.size(); ++i)
        for (const std::uint32_t c : cells[i])
            if (c >= count)
                return bad("it names " + std::to_string(c) + " of " + std::to_string(count),
                           place_in("", name, i));
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

Status validate_indices(const Mesh& mesh, const Run& run) {
    if (auto valid = validate_lists(mesh); !valid) return valid;
    return validate(mesh.vertices, mesh.triangles, run);
}

Status validate_indices(const TetrahedralMesh& mesh, const Run& run) {
    const std::size_t faces = mesh.faces.size();
    if (mesh.block_of.size() != mesh.tetrahedra.size() || mesh.face_triangle.size() != faces)
        return bad("there must be one block per tetrahedron, and one triangle per face");
    if (auto valid = validate(mesh.vertices, mesh.faces, run); !valid) return valid;
    if (auto valid = validate_cells(mesh.tetrahedra, "tetrahedron", mesh.vertices.size()); !valid)
        return valid;
    if (auto valid = validate_cells(mesh.twins, "pair of twins", faces); !valid) return valid;
    for (std::size_t t = 0; t < mesh.block_of.size(); ++t)
        if (mesh.block_of[t] >= mesh.block_count)
            return bad("it is in no block", place_in("", "tetrahedron", t));
    return validate_surfaces(mesh.surfaces_of, faces, mesh.surfaces.size());
}

Status validate_mesh(const Mesh& mesh, const Run& run) {
    if (auto valid = validate_lists(mesh); !valid) return valid;
    return validate_areas(mesh.vertices, mesh.triangles, run);
}

} // namespace terrane
