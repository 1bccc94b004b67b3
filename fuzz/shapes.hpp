// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Points and pieces of surfaces from the bytes of a fuzzer. They are on small integer lattices, so
// that degeneracy is common, some of them off by an ulp; then they are scaled and shifted together.
#pragma once

#include <array>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

#include "bytes.hpp"

namespace terrane::fuzz {

/// The transformation of all points of an input. Its steps may round, so that coplanar points
/// become nearly coplanar.
class Frame {
public:
    explicit Frame(Bytes& bytes);
    [[nodiscard]] Point3 operator()(Point3 p) const;
    /// Tells whether lattice points stay in their planes: there is no rotation, no decimal fraction
    /// and no shift.
    [[nodiscard]] bool exact() const { return step_ == 1 && !turned_ && shift_ == Point3{}; }

private:
    double step_ = 1;
    bool turned_ = false;
    Point3 shift_;
    int exponent_ = 0;
};

/// Makes points, which are repeated more often than by chance.
class Points {
public:
    explicit Points(Bytes& bytes) : frame_(bytes), range_(1 + static_cast<int>(bytes.below(4))) {}

    /// Returns an earlier point, or a new one.
    Point3 next(Bytes& bytes);
    /// Returns a transformed point of the lattice.
    [[nodiscard]] Point3 placed(const Point3& p) const { return frame_(p); }
    [[nodiscard]] int range() const { return range_; }

private:
    Frame frame_;
    int range_;
    std::vector<Point3> earlier_;
};

/// Appends a triangle; this and the following functions append vertices of their own.
void add_triangle(Surface& surface, const std::array<Point3, 3>& corners);
/// Appends triangles with a common edge.
void add_fan(Surface& surface, Points& points, Bytes& bytes);
/// Appends a height field of n x m squares along any axis, with holes if requested.
void add_sheet(Surface& surface, const Points& points, Bytes& bytes, bool holes);
/// Appends a closed tetrahedron, oriented outward if its corners are in general position.
void add_tetrahedron(Surface& surface, const std::array<Point3, 4>& corners);
void add_double_pyramid(Surface& surface, const std::array<Point3, 5>& corners);
void add_box(Surface& surface, const Points& points, Bytes& bytes);

/// Returns one to four surfaces with at most `most` triangles in all: single triangles, fans,
/// sheets, closed pieces, and copies of earlier pieces.
std::vector<Surface> soup(Bytes& bytes, std::size_t most);

} // namespace terrane::fuzz
