// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The canonical digest of an arrangement: a hash of its geometry, not of how it is numbered or of
// which diagonal a triangulation took where both would do. Indices, the order of files, surfaces,
// triangles and corners, orientation, threads and search method leave it as it is, and so do
// reflections, exchanged axes and powers of two once they are undone; any other point, parent,
// number of triangles or intersection edge changes it.
//
// Definition. H is SHA-256, its value 32 bytes; lists of hashes are sorted as bytes and joined.
//   number      a reduced fraction in lower-case hexadecimal: "-1f/4"; "/1" is left out
//   point       H("x y z"), of three numbers
//   input       H("input" + list of the points of an input triangle's corners + its surface's name)
//   vertex      H("vertex" + point + list of the inputs of all parents of the triangles at it)
//   parent      H("parent" + input + decimal number of the triangles that name it), if there are
//   any edge        H("edge" + list of the points of its ends); of each intersection edge
//   degenerate  H("degenerate" + input); of each input triangle without area
//   duplicates  H("duplicates" + list of inputs); once per three points, of all input triangles
//               that have them, where there are several
//   digest      "sha256:" + hexadecimal of H("terrane-digest 1\n" + list of all vertices, parents,
//               edges, degenerate and duplicates)
// The verifier has another implementation of this definition (verify_digest.hpp).
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Of the arrangement of these surfaces. Cost: n log n; half a second for 100 000 triangles.
std::string canonical_digest(std::span<const Surface> inputs, const Arrangement& arrangement,
                             const Run& run = {});

} // namespace terrane
