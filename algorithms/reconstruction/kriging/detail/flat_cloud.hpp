// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <nanoflann.hpp>

namespace terrane::kriging::detail {

/// Points of the plane in the form that nanoflann reads.
struct FlatCloud {
    std::vector<std::array<double, 2>> points;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][axis];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/// Search tree for the nearest points.
using FlatTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, FlatCloud>, FlatCloud,
                                        2>;

} // namespace terrane::kriging::detail
