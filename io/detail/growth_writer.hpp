// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writes the claims of certificates about surfaces that were sealed or extended.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/detail/certificate_writer.hpp>

namespace terrane::detail {

/// Bounds, for each surface that can have grown, the distance between what was given and what was
/// kept, both ways: of kept triangles that were added to it from the given ones, and of given
/// triangles that were trimmed from those that were not. `dropped` are the triangles of the whole
/// that were left out. A bound exceeds the distance by a sixteenth at most, so that it can be shown
/// with little work. Errors: those of locate(); internal, where nothing is left of a trimmed
/// surface.
Result<std::vector<double>> growth_limits(const Arrangement& whole,
                                          const std::vector<std::uint32_t>& dropped,
                                          const CutRecord& record, const Run& run);

/// Writes the value of the key "sealed".
void write_growth(CertificateWriter& out, std::span<const Surface> surfaces,
                  std::span<const SurfaceGrowth> growth, std::span<const double> limits);

} // namespace terrane::detail
