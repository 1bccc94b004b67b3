// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A target about surfaces is two functions; the fuzzer (entry.cpp) and the minimiser call them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

#include "bytes.hpp"

namespace terrane::fuzz {

/// What the bytes stand for. Finite coordinates, indices in range.
std::vector<Surface> input(Bytes& bytes);

/// What is wrong, in a sentence; empty where the property holds or says nothing of such surfaces.
std::string flaw(std::span<const Surface> surfaces);

} // namespace terrane::fuzz
