// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// A point inside a volume (see block_points.hpp).
struct BlockPoint {
    Point3 place;    ///< strictly inside, in the unit of the mesh
    BlockId block{}; ///< number of the block
};

} // namespace terrane
