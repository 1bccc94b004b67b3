// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges a mesh by its inputs, whatever program made it, without a certificate.
//
// What the mesh should be is computed: the exact arrangement of the inputs, or the boundary of a
// Boolean operation in it. Its flat regions, the edges between them and their corners are looked for in
// the mesh. A mesh may divide a flat region into other triangles, and its vertices may be rounded.
// (1) A vertex of the mesh stands for an exact point if no coordinate differs by more than a bound.
//     Vertices nearer than the bound are one.
// (2) Triangles that no edge of a region separates are one patch; it is in the region that has all of
//     its vertices.
// (3) A region is covered once if the oriented boundaries of its triangles, each turned to the front by
//     an exact predicate on the exact points, add up to its own boundary: the winding number of that
//     sum is 1 inside, 0 outside, and no triangle adds less than 1 where it lies.
// The verdicts are exact but for the bound of (1). Cost: arrange(), check(), and O(n log n).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// Operations on solids, the operands. A point is inside an operand if its winding number is not 0.
enum class BooleanOperation : std::uint8_t {
    unite,     ///< inside any
    intersect, ///< inside all
    subtract,  ///< inside the first and no other
    exclude,   ///< inside an odd number
};

/// "union", "intersection", "difference" or "symmetric-difference".
std::string_view name_of(BooleanOperation operation);
/// Returns the operation of a name.
std::optional<BooleanOperation> operation_named(std::string_view name);

/// Options of judge().
struct JudgeOptions {
    double spacings = 16; ///< bound for rounded points, in spacings of doubles at the largest
                          ///< coordinate of the inputs
    std::size_t most_flaws = 10; ///< flaws with a place that are listed for each property
    std::optional<BooleanOperation> operation{}; ///< what the mesh is; none: the arrangement
    std::vector<std::uint32_t>
        operand_of{}; ///< per input surface: its operand, counted from 0; empty:
                      ///< each is one
};

/// What was found about a property.
enum class PropertyVerdict : std::uint8_t { holds, fails, not_judged };

/// "holds", "fails" or "not judged".
std::string_view name_of(PropertyVerdict verdict);

/// A place where a property fails.
struct PropertyFlaw {
    std::string sentence;                   ///< what is wrong
    Point3 place;                           ///< in the unit of the inputs
    std::vector<std::uint32_t> triangles{}; ///< of the output, counted through all of its surfaces
    double size = 0; ///< area, distance or angle that the sentence names; or 0
};

/// A property of a mesh.
struct JudgedProperty {
    std::string name; ///< see judge() and judge_soup()
    PropertyVerdict verdict = PropertyVerdict::holds;
    std::string sentence;            ///< what was found
    std::size_t count = 0;           ///< number of flaws
    double size = 0;                 ///< largest move, sum of areas, ... as the sentence says
    std::vector<PropertyFlaw> flaws; ///< the first of them
};

/// All properties.
struct MeshJudgement {
    std::vector<JudgedProperty> properties;

    /// Whether all that was judged holds.
    [[nodiscard]] bool holds() const;
    /// Whether each property was judged.
    [[nodiscard]] bool complete() const;
    /// Returns what fails, for a test's message: a line per property, and one for the first place of each;
    /// empty if all that was judged holds.
    [[nodiscard]] std::string failures() const;
    /// Returns a property; nullptr if there is none of this name.
    [[nodiscard]] const JudgedProperty* find(std::string_view name) const;
};

/// Judges the triangles of `output` by those of `inputs`:
/// - conforming: two triangles share a vertex, an edge, or nothing;
/// - distinct: no triangle is without area, or repeats another one of its surface;
/// - welded: no point is there twice in a surface, nor torn into points within the bound;
/// - vertices: each corner of a region is a vertex, not farther away than the bound;
/// - curves: each exact intersection curve is there, as edges;
/// - coverage: each region is covered once, and nothing else is;
/// - topology: triangles meet as the regions do, without cracks;
/// - orientation: triangles face as one of the inputs that they lie in; of solids, outwards;
/// - volume (of operations): that of the exact solid, within the bound times the area.
/// Errors: bad_number, bad_index, unsupported, bad_option (operand_of); not_closed if an operand bounds
/// no solid; interrupted, out_of_memory, internal.
Result<MeshJudgement> judge(std::span<const Surface> output, std::span<const Surface> inputs,
                            const JudgeOptions& options = {}, const Run& run = {});

/// Judges tetrahedra by the surfaces that they fill; where they reach beyond these on all sides, by the box round
/// all tetrahedra as well:
/// - positive: no tetrahedron is without volume, and all are wound the same way;
/// - conforming: two tetrahedra share a corner, an edge, a face, or nothing;
/// - welded: nodes are torn nowhere but at surfaces;
/// - vertices, curves, coverage, topology: as above, of the faces of tetrahedra on the surfaces;
/// - labels (if there are any): all tetrahedra of a block have one, which no other block has;
/// - volume: that of each block is the exact one, within the bound times its area.
/// In flaws, tetrahedra stand for triangles. Errors: as above; bad_option (operation).
Result<MeshJudgement> judge(const LabelledTetrahedra& output, std::span<const Surface> inputs,
                            const JudgeOptions& options = {}, const Run& run = {});

/// Judges triangles alone: conforming and distinct as above, welded (no point is there twice), closed
/// (an even number of triangles at each edge), manifold (two at most, and one fan at each vertex),
/// oriented (neighbours run oppositely along their edge), tetgen (TetGen accepts them as facets: they
/// are conforming, no two points are nearer than its tolerance, and no two triangles at an edge enclose
/// less than 0.1 degrees). Errors: as above.
Result<MeshJudgement> judge_soup(std::span<const Surface> soup, const JudgeOptions& options = {},
                                 const Run& run = {});

} // namespace terrane
