// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Points of the verifier, in homogeneous integers.
#pragma once

#include <terrane/algorithms/verify/detail/rational.hpp>

namespace verify_points {

using namespace terrane::verifier;

inline Vector4 point(int x, int y, int z, int w = 1) {
    return {x, y, z, w};
}

} // namespace verify_points
