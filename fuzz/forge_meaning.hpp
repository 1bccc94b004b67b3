// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What a certificate that the verifier accepted means, by other ways than those of the verifier:
// the library's own checks, areas and distances in floating point.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/verify.hpp>

#include "forge_subjects.hpp"

namespace terrane::fuzz {

/// Returns the mesh that the output files of a certificate hold; none if its lists make no mesh.
std::optional<Mesh> mesh_of(const Subject& subject, const Certificate& certificate);

/// Returns the tetrahedra of a certificate; none if its lists make none.
std::optional<TetrahedralMesh> tetrahedra_of(const Subject& subject,
                                             const Certificate& certificate);

/// Describes how an accepted certificate differs in meaning from the right one; empty if it does
/// not. `accepted` is the largest deviation that the verifier accepted.
std::string difference_in_meaning(const Subject& subject, const Certificate& changed,
                                  double accepted);

/// Tells whether both certificates name the same mesh (or tetrahedra) for their output files, to
/// the last bit.
bool writes_the_same(const Certificate& a, const Certificate& b);

/// Tells whether a triangle of one part has the vertices of a triangle of the other, but faces the
/// other side. The digest does not know sides.
bool has_turned(const ArrangementClaim& a, const ArrangementClaim& b);

/// Tells whether triangles form a conforming mesh, by the library's own check.
bool is_conforming(const std::vector<Point3>& vertices, const std::vector<Triangle>& triangles);

/// Returns the doubles nearest to the vertices of an accepted exact part of these surfaces.
std::vector<Point3> points_of_exact(const std::vector<Surface>& surfaces,
                                    const ArrangementClaim& exact);

// --- One function per section, which difference_in_meaning calls --------------------------------

std::string difference_of_doubles(const Subject& subject, const RoundedClaim& claim,
                                  double accepted);
std::string difference_of_blocks(const Subject& subject, const Certificate& changed,
                                 double accepted);
std::string difference_of_improved(const Subject& subject, const Certificate& changed);
std::string difference_of_layers(const Subject& subject, const LayeredClaim& claim,
                                 double accepted);
std::string difference_of_cut(const Subject& subject, const Certificate& changed, double accepted);
std::string difference_of_volume(const Subject& subject, const VolumeClaim& claim);
std::string difference_of_sealed(const Subject& subject, const Certificate& changed,
                                 double accepted);
std::string difference_of_filled(const Subject& subject, const FilledClaim& claim);

} // namespace terrane::fuzz
