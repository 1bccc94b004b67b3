// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Internal to the verifier: the canonical digest, as digest.hpp defines it, written a second time.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane::verifier {

/// None where a construction of the claim is undefined.
/// Precondition: the claim's indices are in range (rule R1).
std::optional<std::string> digest_of(std::span<const Surface> inputs,
                                     const ArrangementClaim& claim);

} // namespace terrane::verifier
