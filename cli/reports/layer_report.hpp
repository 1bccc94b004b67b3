// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports on horizons that were put in order.
#pragma once

#include <string>

#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Reports what was replaced and, where that is so, that the stack is conforming and in order.
std::string text_of(const Inputs& inputs, const Layered& layered);

/// Reports the number of pairs in improper contact, else the number of those out of order, and the
/// first place; empty if the stack is conforming and in order.
std::string flaws_text(const Layered& layered);

/// Adds the key layers, one entry per layer, with the constants of the rounding.
void add_statistics(Json& json, const Inputs& inputs, const Layered& layered);

} // namespace terrane::cli
