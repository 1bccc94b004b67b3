// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Computes the canonical digest of an arrangement: a hash of its geometry that does not depend on
// numbering, nor on the choice between diagonals that a triangulation may use alike. Indices, the
// order of files, surfaces, triangles and corners, orientation, threads and search method do not
// change it; neither do reflections, exchanges of axes and scalings by powers of two that are
// undone afterwards. Any other point, parent, number of triangles or intersection edge changes it.
//
// Definition. H is SHA-256, its value 32 bytes; lists of hashes are sorted as bytes and joined.
//   number      a reduced fraction in lower-case hexadecimal: "-1f/4"; "/1" is omitted
//   point       H("x y z") of three numbers
//   input       H("input" + list of the points of an input triangle's corners + its surface's name)
//   vertex      H("vertex" + point + list of the inputs of all parents of the triangles at it)
//   parent      H("parent" + input + decimal number of the triangles that name it), for each input
//               triangle that at least one triangle names
//   edge        H("edge" + list of the points of its ends), for each intersection edge
//   degenerate  H("degenerate" + input), for each input triangle without area
//   duplicates  H("duplicates" + list of inputs), for each set of input triangles with the same
//               three points
//   digest      "sha256:" + hexadecimal of H("terrane-digest 1\n" + list of all vertices, parents,
//               edges, degenerate and duplicates)
// The verifier has an implementation of its own (algorithms/verify/detail/digest.hpp).
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Returns the digest of the arrangement of `inputs`. A stop request of the run is ignored. Cost:
/// n log n; half a second for 100 000 triangles.
std::string canonical_digest(std::span<const Surface> inputs, const Arrangement& arrangement,
                             const Run& run = {});

} // namespace terrane
