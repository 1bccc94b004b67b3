// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <nanoflann.hpp>

namespace terrane {

/// Points in the form that nanoflann reads.
struct Cloud {
    std::vector<std::array<double, 3>> points;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][axis];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/// Search tree for the nearest points in the plane (2) or in space (3).
template <int dimension>
using CloudTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>,
                                                      Cloud, dimension>;

} // namespace terrane
