// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Functions that the readers of meshes share: faces become triangles, and triangles surfaces.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::detail {

/// A face with more than three corners, as a fan round the first one until all vertices are known.
struct Fan {
    std::size_t first, triangles; ///< the first one of the part, and how many
};

/// A surface whose triangles name vertices of a whole file.
struct FilePart {
    std::string name{};
    Role role = Role::unknown;
    std::vector<Triangle> triangles{};
    std::vector<Fan> fans{};            ///< ascending
    std::vector<std::uint32_t> faces{}; ///< per triangle: number of its face in the file
};

/// Appends a face; fewer than three corners make none. `number`: of the face in the file.
inline void append_face(std::span<const std::uint32_t> corners, FilePart& part,
                        std::uint32_t number = 0) {
    if (corners.size() > 3) part.fans.push_back({part.triangles.size(), corners.size() - 2});
    for (std::size_t i = 2; i < corners.size(); ++i) {
        part.triangles.push_back({corners[0], corners[i - 1], corners[i]});
        part.faces.push_back(number);
    }
}

/// Appends the triangles of a strip, all turned the same way.
inline void append_strip(std::span<const std::uint32_t> corners, FilePart& part,
                         std::uint32_t number) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        part.triangles.push_back(i % 2 == 0 ? Triangle{corners[i - 2], corners[i - 1], corners[i]}
                                            : Triangle{corners[i - 1], corners[i - 2], corners[i]});
        part.faces.push_back(number);
    }
}

/// Divides the faces of a part into triangles, and returns the flawed ones.
FlawedFaces divide_faces(std::span<const Point3> vertices, FilePart& part);

/// Returns the arrays of a part: of `arrays`, over all vertices and faces of the file, the values on the vertices that
/// its triangles use (on all if
/// `has_all`), and on its triangles.
std::vector<ValueArray> arrays_of_part(const FilePart& part, std::span<const ValueArray> arrays,
                                       bool has_all = false);

/// Makes a surface of each part that has triangles, with the vertices that they use. `arrays`: over all vertices and
/// faces of the file; `values`: see Surface.
std::vector<Surface> surfaces_of_parts(std::span<const Point3> vertices,
                                       std::vector<FilePart> parts,
                                       const std::vector<std::string>& values = {},
                                       std::span<const ValueArray> arrays = {});

} // namespace terrane::detail
