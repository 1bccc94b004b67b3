// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A mesh of surfaces in pieces, as ParaView reads it: one .vtp file per piece in a folder, and a .pvtp
// file that names them. Points and cells have the arrays GlobalNodeIds and GlobalElementIds, by which
// the pieces become one mesh again.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

namespace terrane {

/// Writes a piece: the file of to_vtp(), and the numbers of its points and cells; with the volumes
/// on both sides of each triangle, if there are any.
std::string to_vtp_piece(const tiles::TilePiece& piece, bool has_volumes = false);

/// Writes the file that names the pieces, by their paths from its folder.
std::string to_pvtp(std::span<const std::string> pieces, bool has_volumes = false);

/// Returns the folder of the pieces of a .pvtp file: next to it, with its name and "_pieces".
std::filesystem::path folder_of_pieces(const std::filesystem::path& path);
/// Returns the name of a piece in that folder.
std::string name_of_piece(const std::filesystem::path& path, std::size_t piece);

/// Reads a .pvtp file and its pieces and joins them to one mesh, which to_vtp() writes as if it had never
/// been in pieces. Lists of several parents or regions become their first one. The names of pieces are
/// data: a piece outside of the folder of the file is refused, also behind a link. Errors: cannot_open,
/// bad_syntax, bad_index, unsupported.
Result<Mesh> read_pvtp(const std::filesystem::path& path);

} // namespace terrane
