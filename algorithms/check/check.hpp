// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Diagnoses triangulated surfaces exactly. It repairs nothing and lists all flaws. Cost: one box
// search, and one exact test per pair of overlapping boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/contact_kind.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// The result of check(). Triangles are numbered through all surfaces, in order.
struct CheckReport {
    std::size_t surfaces = 0;                           ///< number of surfaces
    std::size_t triangles = 0;                          ///< number of triangles of all surfaces
    std::size_t vertices = 0;                           ///< number of distinct points in use
    std::vector<std::uint32_t> first_triangle;          ///< per surface, and the total at the end
    std::vector<ImproperContact> contacts;              ///< of distinct triangles with area; sorted
    std::vector<std::uint32_t> degenerate;              ///< triangles without area, ascending
    std::vector<std::array<std::uint32_t, 2>> repeated; ///< {triangle, first with the same points},
                                                        ///< both in one surface
    std::vector<std::array<std::uint32_t, 2>> shared;   ///< likewise in different surfaces: no flaw
    std::vector<std::array<Point3, 2>> non_manifold_edges; ///< with more than two triangles of one
                                                           ///< surface: no flaw by itself
    std::size_t free_border_edges = 0;                     ///< edges with one triangle of a surface
    std::size_t components = 0; ///< number of components that are connected across edges, whatever
                                ///< the surface

    /// Whether the surfaces are conforming: no improper contact, no degenerate and no repeated
    /// triangle.
    [[nodiscard]] bool clean() const {
        return contacts.empty() && degenerate.empty() && repeated.empty();
    }
};

/// Checks surfaces. Errors: bad_number, bad_index, unsupported (indices beyond 32 bits),
/// interrupted, out_of_memory, internal.
Result<CheckReport> check(std::span<const Surface> surfaces, const Run& run = {});

// How a mesh is shown to be conforming: what decides each pair of its triangles.
//
// Laws of counts (a test carries each number):
// (1) The five counts add up to n (n - 1) / 2 for n triangles.
// (2) Without `apart` they add up to the pairs of triangles whose boxes overlap.
// (3) With PairCheck::full, in_patches, separated and unmoved are 0.

/// Which pairs of triangles are tested by exact predicates.
enum class PairCheck : std::uint8_t {
    bounds, ///< those that no proven bound clears
    full,   ///< all whose boxes overlap
};

/// "bounds" or "full".
std::string_view name_of(PairCheck method);

/// Options of all that proves a mesh conforming. The verdict depends on none of them.
struct PairCheckOptions {
    PairCheck method = PairCheck::bounds; ///< which pairs are tested
    /// Largest mesh, in triangles, for which the report counts what decided each pair. Counting takes
    /// one more box search, which proven bounds spare otherwise: for many narrow triangles as long as
    /// all else.
    std::size_t count_up_to = 0;
    /// Pairs with overlapping boxes are not counted if there are more than this for each triangle: of
    /// long triangles side by side nearly all boxes overlap.
    std::uint64_t most_per_triangle = UINT64_MAX;

    /// Returns the largest number of pairs that is counted for a mesh of this size; 0: none.
    [[nodiscard]] constexpr std::uint64_t most_counted(std::size_t triangles) const {
        if (triangles > count_up_to || triangles == 0) return 0;
        return most_per_triangle > UINT64_MAX / triangles ? UINT64_MAX
                                                          : most_per_triangle * triangles;
    }
};

/// How many pairs of triangles of a mesh were decided in which way.
struct PairCounts {
    std::uint64_t tested = 0;     ///< by exact predicates on the two triangles
    std::uint64_t in_patches = 0; ///< by injective patches
    std::uint64_t separated = 0;  ///< by separation
    std::uint64_t unmoved = 0;    ///< by the exact arrangement
    std::uint64_t apart = 0;      ///< their boxes do not overlap

    friend bool operator==(const PairCounts&, const PairCounts&) = default;
};

namespace rounding::detail {
class RoundingProof; // round_to_doubles.cpp defines it
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
