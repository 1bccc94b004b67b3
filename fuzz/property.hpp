// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A target about surfaces consists of two functions, which the fuzzer (entry.cpp) and the minimiser
// call.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

#include "bytes.hpp"

namespace terrane::fuzz {

/// Returns the surfaces that the bytes stand for, with finite coordinates and indices in range.
std::vector<Surface> input(Bytes& bytes);

/// Describes how the property is violated; empty if it holds, or does not apply to such surfaces.
std::string flaw(std::span<const Surface> surfaces);

} // namespace terrane::fuzz
