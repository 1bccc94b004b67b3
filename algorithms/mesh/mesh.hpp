// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Two vertices, the lower index first.
using Edge = std::array<std::uint32_t, 2>;

/// The name and the role of an input surface, which a mesh keeps.
struct SurfaceInfo {
    std::string name;          ///< as in Surface; need not be unique
    Role role = Role::unknown; ///< as in Surface

    friend bool operator==(const SurfaceInfo&, const SurfaceInfo&) = default;
};

/// One mesh of several surfaces with coordinates in doubles, as it is written to files and passed
/// to TetGen. A triangle belongs to several surfaces where these coincide.
struct Mesh {
    std::vector<SurfaceInfo> surfaces;     ///< order of the input
    std::vector<Point3> vertices;          ///< unit of the input
    std::vector<Triangle> triangles;       ///< indices into vertices
    IndexLists<std::uint32_t> surfaces_of; ///< per triangle: indices into surfaces, sorted, >= 1
    IndexLists<std::uint32_t> regions_of;  ///< per triangle, parallel to surfaces_of: region of the
        ///< mesh (numbered through all surfaces); or no list at all
    IndexLists<std::uint32_t>
        parents_of; ///< per triangle: input triangles that contain it, counted
                    ///< through all surfaces, sorted, >= 1; or no list at all
    std::vector<Edge> intersection_edges; ///< sorted, unique
};

/// A tetrahedral mesh that conforms to the triangles of a mesh.
struct TetrahedralMesh {
    std::vector<SurfaceInfo> surfaces; ///< of the mesh it was made from, then "box" last
                                       ///< where a box was added
    std::vector<Point3> vertices;      ///< unit of the input
    std::vector<std::array<std::uint32_t, 4>>
        tetrahedra;                           ///< positively oriented: orient3d(0,1,2,3) > 0
    std::vector<std::uint32_t> block_of;      ///< per tetrahedron: 0 is the outside (touches
                                              ///< the box), then the blocks (volumes.hpp)
    std::vector<Triangle> faces;              ///< faces of tetrahedra that lie on a surface
    std::vector<std::uint32_t> face_triangle; ///< per face: triangle of the mesh it is part of,
                                              ///< or UINT32_MAX on the box
    IndexLists<std::uint32_t> surfaces_of;    ///< per face: indices into surfaces, sorted, >= 1
    std::vector<std::array<std::uint32_t, 2>>
        twins; ///< pairs of faces, in front of and behind a cut (split_nodes.hpp): corner by
               ///< corner at the same place; none: nodes are not split
    std::uint32_t block_count = 0; ///< with the outside
    std::string mesher{};          ///< the program that made it: "TetGen" or "Gmsh"
    std::string failure{};         ///< why another mesher, asked before, made none; or empty
};

/// Tetrahedra as any program may have made them.
struct LabelledTetrahedra {
    std::vector<Point3> vertices;                         ///< unit of the input
    std::vector<std::array<std::uint32_t, 4>> tetrahedra; ///< indices into vertices
    std::vector<std::uint32_t> labels; ///< per tetrahedron: the number of its block; or none at all
};

/// A named array with one value per cell, for the formats that have such arrays (VTP, VTU).
struct CellArray {
    std::string name; ///< "volume", "quality", ...
    std::variant<std::vector<std::int32_t>, std::vector<double>> values; ///< one per cell
};

/// A mesh that nobody can change any more; copies share it. It is used like a pointer, and passed
/// where a const Mesh& is wanted. It is never null.
class SharedMesh {
public:
    /// An empty mesh.
    SharedMesh() : mesh_(std::make_shared<const Mesh>()) {}
    /// Takes a mesh, which nobody can change from then on.
    SharedMesh(Mesh mesh) :
        // NOLINT: implicit on purpose
        mesh_(std::make_shared<const Mesh>(std::move(mesh))) {}
    /// Shares the mesh. There is no move, which would leave a null pointer.
    SharedMesh(const SharedMesh&) = default;
    /// Shares the mesh.
    SharedMesh& operator=(const SharedMesh&) = default;
    ~SharedMesh() = default;

    /// The mesh.
    [[nodiscard]] const Mesh& operator*() const { return *mesh_; }
    /// A member of the mesh.
    [[nodiscard]] const Mesh* operator->() const { return mesh_.get(); }
    /// The mesh.
    operator const Mesh&() const { return *mesh_; } // NOLINT: implicit on purpose

private:
    std::shared_ptr<const Mesh> mesh_;
};

} // namespace terrane
