// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writes the result of a distributed arrangement as pieces, all of them or none.
#pragma once

#include <filesystem>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/tiles/supersteps.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

namespace terrane {

/// Fails where a .pvtp file and the folder of its pieces can't be made. Errors: cannot_open.
Status check_pvtp(const std::filesystem::path& path);

/// Writes a piece per block into a folder next to `path` (folder_of_pieces), then the file that names them.
/// Both get their names when all pieces are complete. All processes call it, and see the same folder.
/// `has_volumes`: whether volumes were found (volumes_in_tiles.hpp); pieces then tell those on both
/// sides of each triangle. `whole`: if it is not null, it is the piece of the first tile, and those
/// of others are empty.
/// Errors: cannot_open, write_failed, out_of_memory; then nothing is left.
Status write_pvtp(tiles::Supersteps& tiles, const std::filesystem::path& path,
                  bool has_volumes = false, const tiles::TilePiece* whole = nullptr);

} // namespace terrane
