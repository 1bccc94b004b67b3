// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports of `terrane judge`, as text, as lines of JSON, and as a tag.
#pragma once

#include <string>
#include <string_view>

#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// The mesh that was judged.
struct JudgedMesh {
    const Inputs& surfaces; ///< none of a mesh of tetrahedra
    std::string name;
    std::size_t tetrahedra = 0; ///< number of them; 0: triangles
};

/// Says the verdict of each property and lists flaws.
std::string judge_text(const MeshJudgement& judged, const JudgedMesh& mesh);

/// Returns one line per property. A triangle is {"surface": index, "triangle": number within it}, a tetrahedron
/// its number.
std::string judge_json(const MeshJudgement& judged, const JudgedMesh& mesh);

/// Returns the verdict, count and size of each property, by its name.
Json judge_statistics(const MeshJudgement& judged);

/// Returns a line as the scripts of CGAL's robustness benchmarks write it.
std::string tag_line(std::string_view tag);
/// Returns the tag of a judgement: VALID_OUTPUT, ...
std::string_view tag_of(const MeshJudgement& judged);

} // namespace terrane::cli
