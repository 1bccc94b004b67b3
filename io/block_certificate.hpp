// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of blocks, and of tetrahedra that fill them. They have the sections of a certificate
// of an arrangement (certificate.hpp), with the kind "volumes" or "tetrahedra", and these:
//
//   "blocks": {
//     "exact": 3,                    number of blocks of the exact arrangement, 1, 2, ...; blocks
//                                    that rounding made have the numbers after these
//     "shells": [[s, ...]],          per shell its sides, ascending, in the order of their first
//                                    sides; 2 t is the front of triangle t of "rounded", 2 t + 1
//                                    its back
//     "block_of_shell": [b, ...],    the block that a shell bounds; 0 is the outside
//     "around": [s, ...],            the shell that bounds the same block from the outside; null if
//                                    it is this one, and for the outside
//     "volumes": ["125/6", ...],     exact volumes in the mesh of doubles, by number; [0] is that
//                                    of all blocks
//     "names": ["outside", ...] },   what files call the blocks, by number
//   "model": {                       of the kind "volumes": what model.json says that does not follow
//                                    from the mesh and its blocks; null for what it does not say
//     "blocks": [{ "unit": null, "age": null, "volume": "20.5", "above": [s], "below": [], "beside": [] }],
//     "gaps": [[{ "surface": s, "length": "1", "least": "0.5", "largest": "1", "place": ["0", "0", "1"] }]],
//                                    per free border
//     "leaks": [{ "from": s, "to": s, "borders": 1, "length": "1", "least": "0.5", "largest": "1",
//                 "place": ["0", "0", "1"], "separates": null }],
//     "seal": null }
//   "tetrahedra": {
//     "box": true,                   they fill a box, with the outside
//     "vertices": [["0.5", "-1e-3", "7"]],  the nodes
//     "tetrahedra": [[a, b, c, d]],  d is in front of a b c
//     "blocks": [b, ...],            per tetrahedron
//     "faces": [[a, b, c]],          those on triangles, and on the box
//     "triangles": [t, ...],         per face: the triangle that it is on; null on the box
//     "twins": [[f, g]] }            pairs of faces in front of a cut and behind it
#pragma once

#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/structure_json.hpp>

namespace terrane {

/// The blocks of a rounded mesh, by reference.
struct CertifiedBlocks {
    const Model& model;       ///< of the mesh
    StructureExtras extras{}; ///< what else its model.json says; of the kind "volumes" only
};

/// Returns the text of a certificate of blocks. Precondition: there is a rounded mesh, and it is
/// conforming; the outputs are the files of a folder with it. Cost: that of find_shells and of
/// exact_volumes.
std::string to_certificate(const Certified& certified, const CertifiedBlocks& blocks,
                           const Run& run = {});

/// Returns the text of a certificate of tetrahedra in these blocks, which the outputs hold.
std::string to_certificate(const Certified& certified, const CertifiedBlocks& blocks,
                           const TetrahedralMesh& tetrahedra, const Run& run = {});

} // namespace terrane
