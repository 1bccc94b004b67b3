// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A mesh into files: what the commands that write a conforming mesh of surfaces share.
#pragma once

#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

/// Binary STL holds other numbers than those that were verified: they are checked as well. Warns
/// where they are not conforming.
Result<bool> stl_is_conforming(const Mesh& mesh, const FileOptions& files,
                               const std::vector<Output>& outputs, Session& session);

/// What `outputs` get, in their order. `clean`: the mesh is conforming; else there are no blocks to
/// speak of in TetGen's formats.
Status write_outputs(const Mesh& mesh, bool clean, const FileOptions& files,
                     const std::vector<Output>& outputs, Session& session);

} // namespace terrane::cli
