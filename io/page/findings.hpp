// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The findings that a page lists: each with its kind, a sentence, a place, and a size by which its
// kind is sorted.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/io/page/json.hpp>

namespace terrane::page {

/// One entry of the list.
struct Finding {
    std::string kind;    ///< "improper contact", "leak", ...
    std::string text;    ///< says what it is and which surfaces or blocks take part, but not the
                         ///< size, which stands next to it
    double size = 0;     ///< by which its kind is sorted, the largest first
    std::string measure; ///< what the size is: "length", "area", "volume", "angle", "quality"
    Point3 place{};      ///< to which a click flies
    double extent = 0;   ///< how large a part of the model is worth looking at; unit of the input
};

using Findings = std::vector<Finding>;

/// Improper contacts that rounding left; `mesh` is the rounded one.
void add_contacts(Findings& findings, const Mesh& mesh, const RoundingReport& report,
                  const std::vector<std::string>& labels);
/// Improper contacts, triangles without area and repeated ones of the surfaces as they are.
void add_flaws(Findings& findings, const CheckReport& report, std::span<const Surface> surfaces);
/// The listed flaws of a judged mesh; `surfaces` have its triangles, or those that tetrahedra fill.
void add_flaws(Findings& findings, const MeshJudgement& judged, std::span<const Surface> surfaces);
/// The holes of the surfaces as they are.
Status add_holes(Findings& findings, std::span<const Surface> surfaces, const Run& run);
/// Holes that were filled, and those left open.
void add_fillings(Findings& findings, const FillWork& work);
/// Leaks between blocks, and where surfaces end near others.
void add_leaks(Findings& findings, const Model& model, const std::optional<LeakAdvice>& advice,
               const std::vector<std::string>& labels);
/// Gaps that sealing closed or left open, and blocks that were merged.
void add_seal(Findings& findings, const std::optional<SealReport>& sealed,
              const std::optional<BlockMerge>& merged, const std::vector<std::string>& labels);
/// Blocks that are thin: twice the volume by the area is below a tenth of the median edge length.
void add_thin_blocks(Findings& findings, const Model& model);
/// The 20 triangles with the least q.
void add_worst_triangles(Findings& findings, const Mesh& mesh,
                         const std::vector<std::string>& labels);
/// The 20 tetrahedra of blocks with the least dihedral angle.
void add_worst_tetrahedra(Findings& findings, const TetrahedralMesh& mesh,
                          const std::vector<std::string>& block_names);

/// Returns the list by kind in the order of their first entries, each kind from its largest size
/// on; of a kind at most `most`, and the number of all.
Json json_of(Findings findings, std::size_t most);

} // namespace terrane::page
