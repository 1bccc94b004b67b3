// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Shows at compile time that nothing which needs upward rounding can be called without a guard. The
// positive assertions show that only the guard is missing in the negative ones.
#include <type_traits>

#include <terrane/algorithms/triangulation/triangulation.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {
namespace {

template <class... Guard>
concept orients = requires(const PointStore& points, Guard&... guard) {
    points.orient2d(guard..., Axis::z, 0U, 1U, 2U);
    points.orient3d(guard..., 0U, 1U, 2U, 3U);
    points.in_circle(guard..., Axis::z, 0U, 1U, 2U, 3U);
    points.side_of_plane(guard..., 0U, 1U, 2U, 3U);
};
static_assert(orients<UpwardRounding> && orients<UpwardWitness>);
static_assert(!orients<> && !orients<ToNearest> && !orients<int>);

template <class... Guard>
concept judges_intervals = requires(const Interval& number, Guard&... guard) {
    certain_sign(guard..., number);
};
static_assert(judges_intervals<UpwardRounding>);
static_assert(!judges_intervals<> && !judges_intervals<ToNearest>);

static_assert(std::is_constructible_v<FaceTriangulation, const UpwardRounding&>);
static_assert(!std::is_default_constructible_v<FaceTriangulation>);

// Nobody but a guard makes a witness, and no guard that is gone at once.
static_assert(std::is_convertible_v<const UpwardRounding&, UpwardWitness>);
static_assert(!std::is_convertible_v<UpwardRounding, UpwardWitness>);
static_assert(!std::is_default_constructible_v<UpwardWitness>);
static_assert(!std::is_constructible_v<UpwardWitness, int>);
static_assert(!std::is_copy_constructible_v<UpwardRounding>);

} // namespace
} // namespace terrane
