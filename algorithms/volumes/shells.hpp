// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The shells that bound the volumes of a mesh, for certificates.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// Connected parts of the borders of volumes. Sides of triangles that face each other around an
/// edge are in one shell. Side 2 t is the front of triangle t, side 2 t + 1 its back. Shells are
/// numbered by their first sides.
struct Shells {
    IndexLists<std::uint32_t> sides;   ///< per shell: its sides, ascending, >= 1
    std::vector<std::uint32_t> volume; ///< per shell: the volume that it bounds
    std::vector<std::uint32_t> around; ///< per shell: UINT32_MAX if it bounds its volume from the
                                       ///< outside, or bounds volume 0; else the shell that bounds
                                       ///< its volume from the outside
};

/// Finds the shells. Precondition: the mesh is conforming and has these volumes. Cost: that of the
/// first step of find_volumes, and exact volumes of all shells.
Shells find_shells(const Mesh& mesh, const Volumes& volumes);

} // namespace terrane
