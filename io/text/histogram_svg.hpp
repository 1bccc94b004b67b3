// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace terrane {

/// Counts of values in [0, 1], in classes of equal width.
struct Histogram {
    std::string_view title;
    std::span<const std::size_t> counts; ///< >= 1 class
    double mean = 0;                     ///< marked by a line
};

/// Histograms beside each other as a picture, SVG 1.1; each as high as its largest class.
std::string histogram_svg(std::span<const Histogram> histograms);

} // namespace terrane
