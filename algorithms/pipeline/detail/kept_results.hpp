// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Results of stages as bytes, and the keys under which they are kept. A key is a hash of all that
// decides the result. Any bytes may come: sizes, indices and numbers are checked, a mesh is proven
// again, and tetrahedra are checked as if a mesher had just made them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

namespace terrane::pipeline::detail {

/// Returns the key of the result of improve_and_measure for a mesh.
std::string key_of(const ConformingMesh& mesh, const ImproveOptions& options);

/// Returns the bytes of an improved mesh.
std::string bytes_of(const ImprovedAndMeasured& improved);

/// Takes an improved mesh from bytes and proves that it is conforming. None if the bytes are not
/// those of an improvement of this mesh, or the proof fails. Errors: interrupted, out_of_memory.
Result<std::optional<ImprovedAndMeasured>> improved_from(std::string_view bytes,
                                                         const ConformingMesh& before,
                                                         const ImproveOptions& options,
                                                         const Run& run);

/// Returns the key of the tetrahedra that are made of a model, before nodes are split.
std::string key_of(const Model& model, const TetrahedraRequest& request);

/// Returns the bytes of tetrahedra.
std::string bytes_of(const TetrahedralMesh& mesh);

/// Reads tetrahedra; returns nothing for malformed bytes. It checks the lengths of lists and that numbers are finite.
/// The caller must run check_tetrahedra() before any other use.
std::optional<TetrahedralMesh> tetrahedra_from(std::string_view bytes);

} // namespace terrane::pipeline::detail
