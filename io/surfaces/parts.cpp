// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/parts.hpp>

#include <terrane/algorithms/triangulation/face.hpp>

namespace terrane::detail {

FlawedFaces divide_faces(std::span<const Point3> vertices, FilePart& part) {
    FlawedFaces flawed;
    if (part.fans.empty()) return flawed;
    std::vector<Triangle> divided;
    divided.reserve(part.triangles.size());
    std::vector<std::uint32_t> corners;
    std::size_t done = 0;
    const auto keep_until = [&](std::size_t end) {
        for (; done < end; ++done) divided.push_back(part.triangles[done]);
    };
    for (const Fan& fan : part.fans) {
        keep_until(fan.first);
        done += fan.triangles;
        corners.assign(part.triangles[fan.first].begin(), part.triangles[fan.first].end());
        for (std::size_t t = 1; t < fan.triangles; ++t)
            corners.push_back(part.triangles[fan.first + t][2]);
        const FaceFlaw flaw = append_face(vertices, corners, divided);
        if (flaw == FaceFlaw::none) continue;
        if (flawed.crossing + flawed.bent == 0) flawed.first = vertices[corners[0]];
        ++(flaw == FaceFlaw::crosses ? flawed.crossing : flawed.bent);
    }
    keep_until(part.triangles.size());
    part.triangles = std::move(divided);
    part.fans.clear();
    return flawed;
}

} // namespace terrane::detail
