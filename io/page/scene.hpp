// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The scene that a page draws: triangles in parts that belong to the same surfaces and blocks,
// lines, and tetrahedra.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/io/page/arrays.hpp>

namespace terrane::page {

/// Triangles of the same surfaces between the same two blocks.
struct ScenePart {
    std::vector<std::uint32_t> surfaces{}; ///< ascending, >= 1
    std::optional<std::array<std::uint32_t, 2>>
        blocks{};          ///< in front of all its triangles, and behind; none: not known
    std::size_t first = 0; ///< triangle of the scene
    std::size_t count = 0; ///< number of triangles
    double area = 0;       ///< squared unit
    bool filled = false;   ///< the triangles were interpolated to fill holes
};

/// A line, or all lines of one kind.
struct SceneLine {
    std::string kind{};                    ///< as name_of(LineKind) says it
    std::vector<std::uint32_t> surfaces{}; ///< that meet or end here; empty: not known
    double length = 0;                     ///< unit of the mesh
    std::size_t first = 0;                 ///< segment of the scene
    std::size_t count = 0;                 ///< number of segments
};

/// All that is drawn.
struct Scene {
    std::vector<Point3> vertices{};    ///< unit of the input
    std::vector<Triangle> triangles{}; ///< by part
    std::vector<ScenePart> parts{};
    std::vector<SceneLine> lines{};
    std::vector<Edge> segments{}; ///< by line
    std::vector<Point3> nodes{};  ///< of the tetrahedra
    std::vector<std::array<std::uint32_t, 4>> tetrahedra{};
    std::vector<std::uint32_t> block_of{}; ///< per tetrahedron: its block
    std::size_t given = 0;                 ///< triangles before decimation
    std::size_t left_out = 0;              ///< tetrahedra that are not drawn as there are too many
    double cell = 0; ///< edge of the cells of decimation; 0: every triangle is drawn
};

/// Makes the scene of a mesh: one part for each set of surfaces. Lines are its intersection edges
/// and its free borders.
Scene scene_of(const Mesh& mesh);

/// Makes the scene of a model: one part for each interface, lines as in its structure.
Scene scene_of(const Model& model);

/// Adds the tetrahedra of blocks, without those of block 0; of more than `most` none.
void add_tetrahedra(Scene& scene, const TetrahedralMesh& mesh, std::size_t most);

/// Joins the vertices in each cell of a grid, the finest of those tried that leaves at most `most`
/// triangles. For view only: surfaces may cross afterwards. Cost: linear, for each grid.
void decimate(Scene& scene, std::size_t most);

/// Stores the scene. Returns the keys parts, lines, view and arrays.
Json packed(Scene scene, Arrays& arrays);

} // namespace terrane::page
