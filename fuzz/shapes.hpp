// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Points and pieces of surfaces from a fuzzer's bytes: on small integer lattices, so that
// degeneracy is common, some off by an ulp; then scaled and shifted as a whole.
#pragma once

#include <array>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

#include "bytes.hpp"

namespace terrane::fuzz {

/// What happens to all points of an input. Each step may round: what was on a plane is nearly so.
class Frame {
public:
    explicit Frame(Bytes& bytes);
    [[nodiscard]] Point3 operator()(Point3 p) const;
    /// No rotation, no decimal fractions, no shift: lattice points stay in their planes.
    [[nodiscard]] bool exact() const { return step_ == 1 && !turned_ && shift_ == Point3{}; }

private:
    double step_ = 1;
    bool turned_ = false;
    Point3 shift_;
    int exponent_ = 0;
};

/// Points that come back more often than chance would have it.
class Points {
public:
    explicit Points(Bytes& bytes) : frame_(bytes), range_(1 + static_cast<int>(bytes.below(4))) {}

    /// An earlier point, or a new one.
    Point3 next(Bytes& bytes);
    /// A point of the lattice as it is in the frame.
    [[nodiscard]] Point3 placed(const Point3& p) const { return frame_(p); }
    [[nodiscard]] int range() const { return range_; }

private:
    Frame frame_;
    int range_;
    std::vector<Point3> earlier_;
};

/// Each appends to a surface, in vertices of its own.
void add_triangle(Surface& surface, const std::array<Point3, 3>& corners);
/// Triangles that have an edge in common.
void add_fan(Surface& surface, Points& points, Bytes& bytes);
/// A height field, n x m squares, along any axis; with holes where asked for.
void add_sheet(Surface& surface, const Points& points, Bytes& bytes, bool holes);
/// Closed; outward where the corners are in general position.
void add_tetrahedron(Surface& surface, const std::array<Point3, 4>& corners);
void add_double_pyramid(Surface& surface, const std::array<Point3, 5>& corners);
void add_box(Surface& surface, const Points& points, Bytes& bytes);

/// One to four surfaces of at most so many triangles in all: single triangles, fans, sheets, closed
/// pieces, copies of what came before.
std::vector<Surface> soup(Bytes& bytes, std::size_t most);

} // namespace terrane::fuzz
