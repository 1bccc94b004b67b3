// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The canonical digest that digest.hpp defines, implemented a second time for the verifier.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/certificate.hpp>

namespace terrane::verifier {

/// Returns the digest of the claim; none if one of its constructions is undefined.
/// Precondition: the indices of the claim are in range (rule R1).
std::optional<std::string> digest_of(std::span<const Surface> inputs,
                                     const ArrangementClaim& claim);

} // namespace terrane::verifier
