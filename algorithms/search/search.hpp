// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which triangles may meet: pairs of boxes that overlap. All methods give the same pairs.
// Source: the paper, section 2 (structured search, alternating binary trees, mixed search).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/method.hpp>

namespace terrane {

/// Axis-aligned and closed: boxes that touch overlap. low <= high.
struct Box {
    std::array<double, 3> low, high;

    [[nodiscard]] bool overlaps(const Box& o) const {
        return low[0] <= o.high[0] && o.low[0] <= high[0] && low[1] <= o.high[1] &&
               o.low[1] <= high[1] && low[2] <= o.high[2] && o.low[2] <= high[2];
    }
};

/// The box of a triangle.
inline Box box_of(std::span<const Point3> points, const Triangle& t) {
    const Point3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
            {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

/// A list of boxes, or those of triangles: made anew each time, which costs less than to store and
/// to load them.
class BoxSource {
public:
    BoxSource(std::span<const Box> boxes) : boxes_(boxes) {}    // NOLINT: a list is a source
    BoxSource(const std::vector<Box>& boxes) : boxes_(boxes) {} // NOLINT: a list is a source
    BoxSource(std::span<const Point3> points, std::span<const Triangle> triangles) :
        points_(points), triangles_(triangles) {}

    [[nodiscard]] std::size_t size() const { return boxes_.size() + triangles_.size(); }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] Box operator[](std::size_t i) const {
        return triangles_.empty() ? boxes_[i] : box_of(points_, triangles_[i]);
    }
    [[nodiscard]] std::vector<Box> listed() const {
        std::vector<Box> all;
        all.reserve(size());
        for (std::size_t i = 0; i < size(); ++i) all.push_back((*this)[i]);
        return all;
    }

private:
    std::span<const Box> boxes_;
    std::span<const Point3> points_;
    std::span<const Triangle> triangles_;
};

/// Two indices of boxes, first < second.
struct CandidatePair {
    std::uint32_t first, second;

    friend auto operator<=>(const CandidatePair&, const CandidatePair&) = default;
};

/// A box whose group is this is paired with all others.
constexpr std::uint32_t no_group = UINT32_MAX;

/// All pairs of overlapping boxes except those within one group; sorted, unique.
/// groups: per box, or empty for none. Boxes of one group are known not to meet (or need no test).
std::vector<CandidatePair> candidate_pairs(const BoxSource& boxes,
                                           std::span<const std::uint32_t> groups, Search method,
                                           const Run& run = {});

/// Whether a pair is kept. Called from several threads, each under an UpwardRounding.
using PairFilter = std::function<bool(const CandidatePair&)>;

/// All pairs of overlapping boxes of which at least one is active, except those within one group
/// and those that the filter (if any) does not keep; sorted, unique. active: ascending indices of
/// boxes. Cost: a glance at each box, then as candidate_pairs for those near active ones; pairs
/// that the filter drops take no memory.
std::vector<CandidatePair> candidate_pairs_of(const BoxSource& boxes,
                                              std::span<const std::uint32_t> active,
                                              std::span<const std::uint32_t> groups = {},
                                              const PairFilter& filter = {}, const Run& run = {});

/// What `automatic` stands for: brute for so few boxes that nothing need be built, else the hierarchy.
/// (Measured on the paper's models, see `terrane bench paper`: the grid is faster by a fifth to a
/// third for two uniform surfaces of up to 70 000 triangles that meet everywhere, slower on all
/// others, 10 times for localised and 100 times for non-uniform ones. So neither the spread of
/// sizes nor the common volume need be looked at.)
Search choose(std::size_t boxes);

} // namespace terrane
