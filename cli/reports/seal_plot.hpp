// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Draws the widths of gaps, so that a distance for closing them can be chosen.
#pragma once

#include <string>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/cli/options/files.hpp>

namespace terrane::cli {

/// Draws two panels over one logarithmic axis of distances, as a picture in SVG 1.1. Above: the
/// length of all gaps that are not wider, with the natural breaks. Below: for each break the number
/// of blocks, how many of these are small, and the number of triangles that change.
std::string seal_plot(const SealAdvice& advice, const Inputs& inputs);

} // namespace terrane::cli
