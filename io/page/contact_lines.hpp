// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Improper contacts as lines of a page, for view only: they are computed in floating point.
#pragma once

#include <cstddef>
#include <span>

#include <terrane/algorithms/intersection/contact_kind.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/io/page/scene.hpp>

namespace terrane::page {

/// Adds lines of the kind "improper contact" to the scene of a mesh, for the first `most` contacts
/// of its triangles: where two triangles meet along a segment, this segment; where they overlap, the
/// border of their common part; else a small cross.
void add_contact_lines(Scene& scene, const Mesh& mesh, std::span<const ImproperContact> contacts,
                       std::size_t most = 100'000);

} // namespace terrane::page
