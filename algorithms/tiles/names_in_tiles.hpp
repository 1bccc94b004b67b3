// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names the volumes of a mesh that lies in tiles, by the surfaces that bound them (block_names.hpp,
// (c)).
//
// Guarantee: the names are those that build_structure() gives in the mesh of all pieces together. They
// follow from areas of surfaces at volumes, summed up with errors of 1e-30 of them, so that they do not
// depend on the tiles unless two areas agree to the last digit of a float.
// Cost: a pass over the triangles; the first tile holds an entry for each volume, surface and tile.
#pragma once

#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/tiles/supersteps.hpp>

namespace terrane::tiles {

/// Returns the names of the volumes, in all processes, after find_volumes_in_tiles(); [0] is "outside".
Result<std::vector<std::string>> name_volumes_in_tiles(Supersteps& tiles);

} // namespace terrane::tiles
