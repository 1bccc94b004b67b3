// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/parts.hpp>

#include <algorithm>

#include <terrane/algorithms/mesh/values.hpp>
#include <terrane/algorithms/triangulation/face.hpp>

namespace terrane::detail {

FlawedFaces divide_faces(std::span<const Point3> vertices, FilePart& part) {
    FlawedFaces flawed;
    if (part.fans.empty()) return flawed;
    std::vector<Triangle> divided;
    std::vector<std::uint32_t> faces;
    divided.reserve(part.triangles.size());
    faces.reserve(part.triangles.size());
    std::vector<std::uint32_t> corners;
    std::size_t done = 0;
    const auto keep_until = [&](std::size_t end) {
        for (; done < end; ++done) {
            divided.push_back(part.triangles[done]);
            faces.push_back(part.faces[done]);
        }
    };
    for (const Fan& fan : part.fans) {
        keep_until(fan.first);
        done += fan.triangles;
        corners.assign(part.triangles[fan.first].begin(), part.triangles[fan.first].end());
        for (std::size_t t = 1; t < fan.triangles; ++t)
            corners.push_back(part.triangles[fan.first + t][2]);
        const FaceFlaw flaw = append_face(vertices, corners, divided);
        faces.resize(divided.size(), part.faces[fan.first]);
        if (flaw == FaceFlaw::none) continue;
        if (flawed.crossing + flawed.bent == 0) flawed.first = vertices[corners[0]];
        ++(flaw == FaceFlaw::crosses ? flawed.crossing : flawed.bent);
    }
    keep_until(part.triangles.size());
    part.triangles = std::move(divided);
    part.faces = std::move(faces);
    part.fans.clear();
    return flawed;
}

std::vector<ValueArray> arrays_of_part(const FilePart& part, std::span<const ValueArray> arrays,
                                       bool has_all) {
    std::vector<ValueArray> own;
    if (arrays.empty()) return own;
    std::vector<std::uint32_t> used;
    for (const Triangle& t : part.triangles) used.insert(used.end(), t.begin(), t.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const ValueArray& array : arrays)
        own.push_back(array.on_triangles ? picked(array, part.faces)
                      : has_all          ? array
                                         : picked(array, used));
    return own;
}

std::vector<Surface> surfaces_of_parts(std::span<const Point3> vertices,
                                       std::vector<FilePart> parts,
                                       const std::vector<std::string>& values,
                                       std::span<const ValueArray> arrays) {
    std::vector<Surface> surfaces;
    Submesh subset(vertices);
    for (FilePart& part : parts) {
        if (part.triangles.empty()) continue;
        Surface& surface = surfaces.emplace_back();
        surface.flawed_faces = divide_faces(vertices, part);
        surface.arrays = arrays_of_part(part, arrays);
        surface.name = std::move(part.name);
        surface.role = part.role;
        surface.values = values;
        surface.triangles = std::move(part.triangles);
        surface.vertices = subset.cut(surface.triangles);
    }
    return surfaces;
}

} // namespace terrane::detail
