// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Families of inputs in which everything coincides.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace bench {

/// Makes the member of a family with n as its size.
using MakeMember = std::vector<terrane::Surface> (*)(int n);

struct Family {
    const char* name;
    int n; ///< least size that is measured; the others are 2 n and 4 n
    MakeMember make;
};

/// Returns all families.
std::span<const Family> families();

} // namespace bench
