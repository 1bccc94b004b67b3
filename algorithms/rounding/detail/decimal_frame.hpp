// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Coordinates in which points that were written as decimals are exact. 500000.1 is no double, so
// triangles with corners on a decimal lattice are coplanar to the eye only: their doubles cross at
// angles of 1e-9 everywhere, and no binary grid makes them coplanar again. Times 10, they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/detail/input_frame.hpp>

namespace terrane::rounding::detail {

/// Per axis: coordinates that are kept, and that no point passes; ascending.
using KeptPlanes = std::array<std::vector<double>, 3>;

/// Multiplies each axis by a power of ten, and goes back. Statements (3) and (4) of
/// docs/explanation/rounding.md.
///
/// (1) A coordinate within one double of a decimal becomes that decimal times the power, exactly.
///     Any other one becomes the nearest double.
/// (2) The way back is monotone on each axis, and takes what an input coordinate became to an input
///     coordinate that became the same. So what lies between two input coordinates stays there.
/// (3) The powers are positive: orientations, order and parallel planes stay the same.
class DecimalFrame : public InputFrame {
public:
    /// Returns the frame with the least number of digits, per axis, for which all chosen points are
    /// decimals; nothing if they are integers, or no decimals, on all axes. `chosen`: per point;
    /// `kept`: coordinates that go back to themselves even if others became the same.
    static std::optional<DecimalFrame> of(std::span<const Point3> points,
                                          const std::vector<bool>& chosen, const KeptPlanes& kept);
    /// Does the same for the chosen points alone: keep_places() and state_largest_errors() have to follow.
    static std::optional<DecimalFrame> of_chosen(std::span<const Point3> points);

    /// The coordinate that an input coordinate becomes.
    struct Place {
        double in_frame = 0, given = 0;
        bool is_kept = false;
    };
    /// Keeps the places of input coordinates on an axis for the way back.
    void keep_places(unsigned axis, std::vector<Place> places);
    /// Whether coordinates on an axis stay as they are.
    [[nodiscard]] bool is_as_given(unsigned axis) const { return axes_[axis].factor == 1; }
    /// Bounds, per axis, the distances between an input point and what its coordinates became.
    [[nodiscard]] std::array<double, 3> errors_of(const Point3& p) const;
    /// States the largest of these of all input points.
    void state_largest_errors(const std::array<double, 3>& errors);

    [[nodiscard]] Point3 into(const Point3& p) const override;
    [[nodiscard]] Point3 back(const Point3& q) const override;
    [[nodiscard]] double error_of(const Point3& q,
                                  const std::array<double, 3>& errors) const override;

private:
    struct Axis {
        double factor = 1;         ///< a power of ten, exactly
        std::vector<Place> places; ///< ascending in the frame, each once; empty if factor is 1

        [[nodiscard]] double into(double x) const;
        [[nodiscard]] double back(double x) const;
        /// Bounds |x / factor - given|, for the exact quotient.
        [[nodiscard]] double error(double x, double given) const;
    };

    std::array<Axis, 3> axes_;
};

} // namespace terrane::rounding::detail
