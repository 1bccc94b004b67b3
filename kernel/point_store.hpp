// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stores input points and the points constructed from them, and evaluates exact predicates on their
// indices.
//
// append() computes the doubles nearest to each constructed point and marks those that equal the
// exact coordinates. A predicate tries numbers of about 106 bits, which append() keeps, then exact
// homogeneous coordinates, which are computed when first needed and kept. Before, orient3d and any one on
// doubles try intervals. If all points are input points, it calls its namesake in predicates.hpp.
//
// Laws (a test carries each number):
// (1) Each predicate agrees with its namesake in predicates.hpp on input points, and keeps its laws
//     on constructed ones.
// (2) A constructed point lies on its lines and planes: side_of_plane and orient2d give Zero.
// (3) compare orders points in space lexicographically by x, y, z: a strict total order. Two
//     indices compare equal iff their points coincide.
// (4) compare orders the points of a line along it, in one direction or the other.
// (5) nearest returns the double nearest to each exact coordinate, ties to even, and never -0 for
//     constructed points. rounding_errors bounds its distance from the coordinate.
#pragma once

#include <terrane/kernel/config.hpp>

#include <array>
#include <atomic>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <terrane/kernel/assertion.hpp>
#include <terrane/kernel/ball_filter.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/point.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane {

/// Exact homogeneous coordinates, w > 0.
using ExactPoint = polynomial::Coordinates<Exact, Exact>;

/// A box of doubles around a point: low[k] <= coordinate k <= high[k]. The two are equal, or each
/// is the next double below or above the nearest one.
struct Enclosure {
    std::array<double, 3> low, high;
};

/// Points by index: the input points, then the constructed points. See the head of this file.
class PointStore {
public:
    PointStore();
    explicit PointStore(std::vector<Point3> input);
    ~PointStore();
    PointStore(const PointStore& other);
    PointStore& operator=(const PointStore& other);
    PointStore(PointStore&&) noexcept;
    PointStore& operator=(PointStore&&) noexcept;

    [[nodiscard]] std::size_t size() const { return input_.size() + constructed_.size(); }
    [[nodiscard]] std::size_t input_count() const { return input_.size(); }
    [[nodiscard]] bool is_input(PointIndex p) const { return p < input_.size(); }
    [[nodiscard]] const Point3& input(PointIndex p) const {
        TERRANE_ASSERT_DEBUG(is_input(p));
        return input_[p];
    }
    [[nodiscard]] std::span<const Point3> inputs() const { return input_; }

    /// Returns the construction of a point; {input, v[0] = p} for an input point.
    [[nodiscard]] Construction construction(PointIndex p) const;

    /// A function that calls work(first, last) for ranges that partition [0, count), in any order
    /// and possibly in several threads at a time.
    using Share = std::function<void(
        std::size_t count, const std::function<void(std::size_t first, std::size_t last)>& work)>;

    /// Appends constructed points; the first gets index size(). Each construction must be defined
    /// (line and plane not parallel, ...). `share` may distribute the work over threads. No other
    /// thread may use the store meanwhile.
    void append(std::span<const Construction> constructions, const Share& share = {});

    /// Exchanges the constructions of two constructed points that are the same point, with all that
    /// is known of them.
    void exchange(PointIndex p, PointIndex q);

    /// Keeps the listed constructed points (ascending indices) and drops the other constructed
    /// points. The kept points are renumbered from input_count() in the same order.
    void keep_constructed(std::span<const PointIndex> kept);

    /// Returns a box of doubles around the point.
    [[nodiscard]] Enclosure enclosure(PointIndex p) const;
    /// Projects the point along `axis`, for the filters of ball_filter.hpp.
    [[nodiscard]] ApproximatePoint approximate(Axis axis, PointIndex p) const;
    /// Returns the exact coordinates. Those of a constructed point are computed once and cached.
    [[nodiscard]] ExactPoint exact(PointIndex p) const;
    /// Returns the doubles nearest to the point, by law (5).
    [[nodiscard]] const Point3& nearest(PointIndex p) const {
        TERRANE_ASSERT_DEBUG(p < size());
        return is_input(p) ? input_[p] : rounded_[p - input_.size()].nearest;
    }

    /// Bounds the distance of each coordinate of nearest(p) from the exact one; 0 iff they are
    /// known to be equal.
    [[nodiscard]] std::array<double, 3> rounding_errors(PointIndex p) const;

    // Predicates; compare and equal are right in any rounding mode.
    /// Compares one coordinate: x, y, z are 0, 1, 2.
    [[nodiscard]] std::strong_ordering compare(unsigned coordinate, PointIndex p,
                                               PointIndex q) const;
    /// Compares in lexicographic order.
    [[nodiscard]] std::strong_ordering compare(PointIndex p, PointIndex q) const;
    [[nodiscard]] bool equal(PointIndex p, PointIndex q) const;
    [[nodiscard]] Sign orient2d(UpwardWitness upward, Axis axis, PointIndex a, PointIndex b,
                                PointIndex c) const;
    [[nodiscard]] Sign orient3d(UpwardWitness upward, PointIndex a, PointIndex b, PointIndex c,
                                PointIndex d) const;
    [[nodiscard]] Sign in_circle(UpwardWitness upward, Axis axis, PointIndex a, PointIndex b,
                                 PointIndex c, PointIndex d) const;
    /// Returns orient3d(a, b, c, p) for input points a, b, c.
    [[nodiscard]] Sign side_of_plane(UpwardWitness upward, PointIndex a, PointIndex b, PointIndex c,
                                     PointIndex p) const;

private:
    using IntervalPoint = polynomial::Coordinates<Interval, polynomial::One>;
    struct Cache;

    struct Rounded {
        Point3 nearest;
        std::array<bool, 3> is_exact; ///< per coordinate: nearest is the exact one
    };

    [[nodiscard]] bool is_double(PointIndex p, unsigned coordinate) const {
        return is_input(p) || rounded_[p - input_.size()].is_exact[coordinate];
    }
    [[nodiscard]] IntervalPoint interval(PointIndex p) const;
    [[nodiscard]] const ExactPoint& cached_exact(std::size_t k) const;
    [[nodiscard]] ExactPoint make_exact(const Construction& how) const;
    [[nodiscard]] Rounded round(std::size_t k, const Cache& cache) const;
    template <class Polynomial, class... P>
    Sign filtered(UpwardWitness upward, const Polynomial& polynomial, P... points) const;

    std::vector<Point3> input_;
    std::vector<Construction> constructed_;
    std::vector<Rounded> rounded_; ///< of the constructed points
    std::unique_ptr<Cache> cache_; ///< more precise coordinates of the constructed points
};

/// Returns the doubles nearest to the point of one construction on `input`.
Point3 nearest(std::span<const Point3> input, const Construction& how);

} // namespace terrane
