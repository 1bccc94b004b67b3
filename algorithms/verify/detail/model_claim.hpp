// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/node.hpp>

namespace terrane::verifier {

/// Reads the key "model" of a certificate of blocks. Throws Malformed.
ModelClaim model_claim(const Node& node);

/// Returns a number as model.json has it; null if it is not finite.
std::string in_json(double number);
/// Returns a string as model.json has it.
std::string in_json(std::string_view text);

} // namespace terrane::verifier
