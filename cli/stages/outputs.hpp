// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Output of a conforming mesh of surfaces, shared by the commands that write one.
#pragma once

#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/cli/stages/model_run.hpp>

namespace terrane::cli {

/// The verdict about a mesh that binary STL cannot hold.
inline constexpr const char* not_conforming_in_stl =
    "In float32, all that binary STL holds, the mesh is not conforming.";

/// Checks the float32 coordinates that binary STL would hold, which are not the doubles that were
/// verified. Warns and returns false if the mesh is not conforming with them.
bool stl_is_conforming(const Mesh& mesh, const FileOptions& files,
                       const std::vector<Output>& outputs, Session& session);

/// Writes the mesh of a run, with the values of its surfaces, to `outputs`, in their order. `clean`: the mesh is
/// conforming; without that, files in TetGen's formats get no points inside blocks.
void write_outputs(const Mesh& mesh, bool clean, const ModelRun& run,
                   const std::vector<Output>& outputs, Session& session);

} // namespace terrane::cli
