// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports the findings of the verifier about a certificate as text and as JSON.
#pragma once

#include <string>

#include <terrane/io/judgement/judgement.hpp>

namespace terrane::cli {

/// Says what a valid certificate states, or which rules it breaks.
std::string verdict_text(const Judgement& judged, const std::string& name);
/// The same as JSON.
std::string verdict_json(const Judgement& judged);

} // namespace terrane::cli
