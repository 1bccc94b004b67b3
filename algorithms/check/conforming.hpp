// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <terrane/algorithms/check/pair_check.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/shared_mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

namespace rounding::detail {
class RoundingProof; // rounding.cpp defines it
}

/// A mesh that exact predicates on its doubles have proven conforming: every two triangles share a
/// vertex, an edge, or nothing; none is degenerate or repeated; no two vertices in use are at one
/// place. Only prove_conforming, round_to_doubles and improve create such meshes. A ConformingMesh
/// can't be changed, so stages that need a conforming mesh accept it without another proof. Copies
/// share the mesh.
class ConformingMesh {
public:
    /// Returns the mesh, without its proof.
    [[nodiscard]] const SharedMesh& mesh() const { return mesh_; }
    /// Returns the mesh.
    [[nodiscard]] const Mesh& operator*() const { return *mesh_; }
    /// Returns a pointer to the mesh, for access to its members.
    [[nodiscard]] const Mesh* operator->() const { return &*mesh_; }
    /// Converts to the mesh.
    operator const Mesh&() const { return *mesh_; } // NOLINT: implicit on purpose
    /// Returns how the pairs of triangles were decided, where the prover was asked to count them.
    [[nodiscard]] const std::optional<PairCounts>& pairs() const { return pairs_; }

private:
    ConformingMesh(const SharedMesh& mesh, const std::optional<PairCounts>& pairs) :
        mesh_(mesh), pairs_(pairs) {}
    friend Result<ConformingMesh> prove_conforming(Mesh mesh,
                                                   std::span<const std::uint32_t> label_of,
                                                   const PairCheckOptions& check, const Run& run);
    friend class rounding::detail::RoundingProof;

    SharedMesh mesh_;
    std::optional<PairCounts> pairs_;
};

/// Checks by exact predicates on the doubles whether triangles form a conforming mesh: every two
/// share a vertex, an edge, or nothing; none is degenerate or repeated; no two vertices in use are
/// at one place. label_of: any number per triangle; connected triangles with equal labels are
/// tested as a whole where possible (injective_patches.hpp).
/// Errors: bad_number, bad_index; improper_contact with the first place where the mesh is not
/// conforming; interrupted. Cost: that of find_injective_patches, then a box search and one test
/// per pair of overlapping boxes that no patch clears.
Status conforming(std::span<const Point3> points, std::span<const Triangle> triangles,
                  std::span<const std::uint32_t> label_of, const Run& run = {});

/// Does the same with options. With PairCheck::full the labels are ignored and each pair of
/// overlapping boxes is tested. Returns the counts if options ask for them.
Result<std::optional<PairCounts>> conforming(std::span<const Point3> points,
                                             std::span<const Triangle> triangles,
                                             std::span<const std::uint32_t> label_of,
                                             const PairCheckOptions& check, const Run& run = {});

/// Proves that a mesh is conforming. Labels, errors and cost are those of conforming().
Result<ConformingMesh> prove_conforming(Mesh mesh, std::span<const std::uint32_t> label_of,
                                        const Run& run = {});

/// Does the same with options.
Result<ConformingMesh> prove_conforming(Mesh mesh, std::span<const std::uint32_t> label_of,
                                        const PairCheckOptions& check, const Run& run = {});

/// Proves that a mesh is conforming, with the first surface of each triangle as its label.
Result<ConformingMesh> prove_conforming(Mesh mesh, const Run& run = {});

} // namespace terrane
