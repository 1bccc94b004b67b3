// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace terrane {

/// Counts the values in [0, 1] by classes of equal width.
struct Histogram {
    std::string_view title;
    std::span<const std::size_t> counts; ///< values in each class; >= 1 class
    double mean = 0;                     ///< of the values; the picture marks it by a line
};

/// Draws histograms side by side as a picture in SVG 1.1. Each is scaled to its largest class.
std::string histogram_svg(std::span<const Histogram> histograms);

} // namespace terrane
