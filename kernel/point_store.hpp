// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Input points and the points constructed from them, named by index, with exact predicates.
//
// Of a constructed point the nearest doubles are found at once, and which of them are the point's
// very coordinates. A predicate on stored points tries intervals round these, then exact
// homogeneous coordinates, made when first needed and kept. Where all points are input points it is
// the predicate of predicates.hpp.
//
// Laws (a test carries each number):
// (1) Each predicate agrees with its namesake in predicates.hpp on input points, and keeps its laws
//     on constructed ones.
// (2) A constructed point lies on its lines and planes: side_of_plane and orient2d give Zero.
// (3) compare is a strict total order of the points in space, lexicographic in x, y, z; it is equal
//     iff the points are.
// (4) Points on a line are ordered along it by compare, ascending or descending.
// (5) nearest is the double that is nearest to each exact coordinate, ties to even; of constructed
//     points 0 is never -0. rounding_errors bound how far it is from the coordinate.
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
#include <terrane/kernel/construction.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/point.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane {

/// Exact homogeneous coordinates, w > 0.
using ExactPoint = polynomial::Coordinates<Exact, Exact>;

/// Doubles around a point: low[k] <= coordinate k <= high[k], two steps apart or equal.
struct Enclosure {
    std::array<double, 3> low, high;
};

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

    /// How the point is constructed; {input, v[0] = p} for an input point.
    [[nodiscard]] Construction construction(PointIndex p) const;

    /// Calls work(first, last) for ranges that cut up [0, count), maybe several at a time.
    using Share = std::function<void(
        std::size_t count, const std::function<void(std::size_t first, std::size_t last)>& work)>;

    /// Adds constructed points; the first gets index size(). Each construction must be defined
    /// (line and plane not parallel, ...). Not to be called while another thread uses the store.
    /// `share` may have the work done by several threads.
    void append(std::span<const Construction> constructions, const Share& share = {});

    /// Keeps of the constructed points those listed (ascending), in this order.
    void keep_constructed(std::span<const PointIndex> kept);

    [[nodiscard]] Enclosure enclosure(PointIndex p) const;
    /// The point in the projection along `axis`, for the filters of approximate.hpp.
    [[nodiscard]] ApproximatePoint approximate(Axis axis, PointIndex p) const;
    [[nodiscard]] ExactPoint exact(PointIndex p) const;
    [[nodiscard]] const Point3& nearest(PointIndex p) const {
        TERRANE_ASSERT_DEBUG(p < size());
        return is_input(p) ? input_[p] : rounded_[p - input_.size()].nearest;
    }

    /// How far each coordinate of nearest(p) is at most from that of the point; 0: it is the same.
    [[nodiscard]] std::array<double, 3> rounding_errors(PointIndex p) const;

    // Predicates. The caller holds an UpwardRounding.
    [[nodiscard]] std::strong_ordering compare(PointIndex p, PointIndex q) const;
    [[nodiscard]] bool equal(PointIndex p, PointIndex q) const { return compare(p, q) == 0; }
    [[nodiscard]] Sign orient2d(Axis axis, PointIndex a, PointIndex b, PointIndex c) const;
    [[nodiscard]] Sign orient3d(PointIndex a, PointIndex b, PointIndex c, PointIndex d) const;
    [[nodiscard]] Sign in_circle(Axis axis, PointIndex a, PointIndex b, PointIndex c,
                                 PointIndex d) const;
    /// orient3d(a, b, c, p) of input points a, b, c.
    [[nodiscard]] Sign side_of_plane(PointIndex a, PointIndex b, PointIndex c, PointIndex p) const;

private:
    using IntervalPoint = polynomial::Coordinates<Interval, polynomial::One>;
    struct Cache;

    struct Rounded {
        Point3 nearest;
        std::array<bool, 3> is_exact; ///< per coordinate: nearest is the point's own
    };

    [[nodiscard]] bool is_double(PointIndex p, unsigned coordinate) const {
        return is_input(p) || rounded_[p - input_.size()].is_exact[coordinate];
    }
    [[nodiscard]] IntervalPoint interval(PointIndex p) const;
    [[nodiscard]] const ExactPoint& cached_exact(std::size_t k) const;
    [[nodiscard]] ExactPoint make_exact(const Construction& how) const;
    [[nodiscard]] static std::optional<Rounded> round_quickly(std::span<const Point3> input,
                                                              const Construction& how);
    [[nodiscard]] Rounded round(const Construction& how) const;
    template <class Polynomial, class... P>
    Sign filtered(const Polynomial& polynomial, P... points) const;

    std::vector<Point3> input_;
    std::vector<Construction> constructed_;
    std::vector<Rounded> rounded_; ///< of the constructed points
    std::unique_ptr<Cache> cache_; ///< exact coordinates of the constructed points
};

/// The doubles nearest to a single construction's point.
Point3 nearest(std::span<const Point3> input, const Construction& how);

} // namespace terrane
