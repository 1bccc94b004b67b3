// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/shared_mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

namespace rounding::detail {
class RoundingProof; // rounding.cpp defines it
}

/// A mesh that was proven conforming, by exact predicates on its doubles: every two triangles share
/// a vertex, an edge, or nothing; none is degenerate or repeated; no two vertices in use are at one
/// place. Only a prover makes such a mesh: prove_conforming, round_to_doubles, improve. It can't be
/// changed, so stages that need a conforming mesh take it without another proof. Copies share it.
class ConformingMesh {
public:
    /// The mesh, without its proof.
    [[nodiscard]] const SharedMesh& mesh() const { return mesh_; }
    /// The mesh.
    [[nodiscard]] const Mesh& operator*() const { return *mesh_; }
    /// A member of the mesh.
    [[nodiscard]] const Mesh* operator->() const { return &*mesh_; }
    /// The mesh.
    operator const Mesh&() const { return *mesh_; } // NOLINT: implicit on purpose

private:
    explicit ConformingMesh(SharedMesh mesh) : mesh_(std::move(mesh)) {}
    friend Result<ConformingMesh>
    prove_conforming(Mesh mesh, std::span<const std::uint32_t> label_of, const Run& run);
    friend class rounding::detail::RoundingProof;

    SharedMesh mesh_;
};

/// Done where each triangle by itself is sound: numbers finite, corners there, an area.
/// Errors: bad_number, bad_index, improper_contact.
Status sound_triangles(std::span<const Point3> points, std::span<const Triangle> triangles);

/// Done where the triangles are a conforming mesh, by exact predicates on the doubles: every two
/// share a vertex, an edge, or nothing; none is degenerate or repeated; no two vertices in use are
/// at one place. label_of: per triangle, any; triangles that hang together and have the same one
/// are tried as a whole, see patches.hpp.
/// Errors: bad_number, bad_index; improper_contact with the first place where it is not;
/// interrupted. Cost: that of find_injective_patches, then a box search and one test per pair of boxes.
Status conforming(std::span<const Point3> points, std::span<const Triangle> triangles,
                  std::span<const std::uint32_t> label_of, const Run& run = {});

/// Proves that a mesh is conforming; labels, errors and cost as above.
Result<ConformingMesh> prove_conforming(Mesh mesh, std::span<const std::uint32_t> label_of,
                                        const Run& run = {});

/// Proves that a mesh is conforming. The labels are the first surfaces of the triangles.
Result<ConformingMesh> prove_conforming(Mesh mesh, const Run& run = {});

} // namespace terrane
