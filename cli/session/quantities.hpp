// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lengths, areas, volumes and places with their units, where the unit of the coordinates is known.
#pragma once

#include <string>
#include <utility>

#include <terrane/algorithms/core/figure.hpp>

namespace terrane::cli {

/// Writes figures with a unit. From 10 km on, 0.1 square kilometres and 0.1 cubic kilometres,
/// metres become kilometres. Without a unit the number stands alone.
class Quantities {
public:
    /// `extent` is the model's size, or 0 where it is not known.
    explicit Quantities(std::string unit, double extent = 0) :
        unit_(std::move(unit)), extent_(extent) {}

    /// `digits` are significant ones.
    [[nodiscard]] std::string length(double value, int digits = 4) const;
    /// Writes two lengths in one unit: "7 to 8 m".
    [[nodiscard]] std::string lengths(double from, double to, int digits) const;
    [[nodiscard]] std::string area(double value, int digits = 4) const;
    [[nodiscard]] std::string volume(double value, int digits = 6) const;
    [[nodiscard]] std::string place(const Point3& place) const {
        return place_text(place, extent_);
    }

private:
    [[nodiscard]] std::string with_unit(double value, int digits, int dimension) const;

    std::string unit_;  ///< of length
    double extent_ = 0; ///< of the model
};

} // namespace terrane::cli
