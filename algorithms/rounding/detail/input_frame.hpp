// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Coordinates in which an input can be arranged anew. Nearly coplanar triangles cross each other all
// over, since doubles can't state what they were meant to be. In a frame that can, they are coplanar.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace terrane::rounding::detail {

/// An affine map from places in the frame to the doubles of the input. Statement (4) of
/// docs/explanation/rounding.md says how far surfaces move on the way into a frame and back.
class InputFrame {
public:
    InputFrame() = default;
    InputFrame(const InputFrame&) = default;
    InputFrame& operator=(const InputFrame&) = default;
    InputFrame(InputFrame&&) = default;
    InputFrame& operator=(InputFrame&&) = default;
    virtual ~InputFrame() = default;

    /// Returns the place of one of the input points in the frame.
    [[nodiscard]] virtual Point3 into(const Point3& p) const = 0;
    /// Returns the doubles for a place in the frame. The place of an input point goes to an input
    /// point with the same place.
    [[nodiscard]] virtual Point3 back(const Point3& q) const = 0;
    /// Bounds the distance between an exact place in the frame and back(q), where no coordinate of
    /// q is farther from it than `errors` (in the frame).
    [[nodiscard]] virtual double error_of(const Point3& q,
                                          const std::array<double, 3>& errors) const = 0;

    /// Bounds the distance between one of the input points and its exact place in the frame, and
    /// that between this exact place and where back() takes it.
    [[nodiscard]] double largest_error() const { return largest_error_; }
    /// States it where the input points are in several processes.
    void state_largest_error(double error) { largest_error_ = error; }

protected:
    double largest_error_ = 0;
};

/// Returns the chosen points.
inline std::vector<Point3> chosen_of(std::span<const Point3> points,
                                     const std::vector<bool>& chosen) {
    std::vector<Point3> all;
    for (std::size_t v = 0; v < points.size(); ++v)
        if (chosen[v]) all.push_back(points[v]);
    return all;
}

} // namespace terrane::rounding::detail
