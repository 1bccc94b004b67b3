// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lengths, areas and volumes with their units, where the unit of the coordinates is known.
#pragma once

#include <string>
#include <utility>

namespace terrane::cli {

/// Writes a number with `digits` significant digits: an infinite one as "> 1.8e308", NaN as "?".
std::string figure(double value, int digits);

/// Writes numbers with a unit. From 10 km on, 0.1 square kilometres and 0.1 cubic kilometres,
/// metres become kilometres. Without a unit the number stands alone.
class Quantities {
public:
    explicit Quantities(std::string unit) : unit_(std::move(unit)) {}

    /// `digits` are significant ones.
    [[nodiscard]] std::string length(double value, int digits = 4) const;
    /// Writes two lengths in one unit: "7 to 8 m".
    [[nodiscard]] std::string lengths(double from, double to, int digits) const;
    [[nodiscard]] std::string area(double value, int digits = 4) const;
    [[nodiscard]] std::string volume(double value, int digits) const;

private:
    [[nodiscard]] std::string with_unit(double value, int digits, int dimension) const;

    std::string unit_; ///< of length
};

} // namespace terrane::cli
