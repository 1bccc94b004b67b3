// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants that make room for rounding errors where separation*.cpp evaluate the statements of
// docs/explanation/separation.md. kernel/proofs/lemma_*.g are proofs that Gappa checks with these
// numbers.
#pragma once

namespace terrane::rounding::detail {

/// (1) A unit normal, and so the distance from a plane or beyond an edge in it, errs by at most
/// direction_factor units times the square of the longest edge over twice the area.
constexpr double direction_factor = 64;
/// (2) An altitude errs by at most altitude_factor units of the longest edge and size_share of
/// itself, a length by size_share of itself.
constexpr double altitude_factor = 64, size_share = 0x1p-40;
/// (3) The margin d of the statements is margin_factor times the sum of the largest move and the
/// largest error of a functional.
constexpr double margin_factor = 4;
/// (4) A vertex is well conditioned where a^2 >= condition_factor d l; the computed heights of
/// statement (4) must be twice as large as the true ones.
constexpr double condition_factor = 64, rise_factor = 128;
/// (5) The sine of the angle between planes must exceed least_sine_factor times the errors of their
/// normals: it then errs by a hundredth of itself at most. Its angle with edges must have a sine above
/// least_edge_sine.
constexpr double least_sine_factor = 1024, least_edge_sine = 0x1p-7;
/// (6) The place of a point in space errs by at most frame_error_factor units of the terms of its
/// coordinates in the frame of a cluster, and of their sizes.
constexpr double frame_error_factor = 8;

} // namespace terrane::rounding::detail
