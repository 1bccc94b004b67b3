// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the pairs of triangles that may meet: those whose boxes overlap. All methods find the same
// pairs. Source: the paper, section 2 (structured search, alternating binary trees, mixed search).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/method.hpp>

namespace terrane {

/// A closed axis-aligned box, low <= high. Boxes that touch overlap.
struct Box {
    std::array<double, 3> low, high;

    [[nodiscard]] bool overlaps(const Box& o) const {
        return low[0] <= o.high[0] && o.low[0] <= high[0] && low[1] <= o.high[1] &&
               o.low[1] <= high[1] && low[2] <= o.high[2] && o.low[2] <= high[2];
    }
};

/// Returns the box of a triangle.
inline Box box_of(std::span<const Point3> points, const Triangle& t) {
    const Point3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
            {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

/// A list of boxes, or the boxes of triangles. The latter are computed on each access, which costs
/// less than storing and loading them.
class BoxSource {
public:
    BoxSource(std::span<const Box> boxes) : boxes_(boxes) {}    // NOLINT: a list is a source
    BoxSource(const std::vector<Box>& boxes) : boxes_(boxes) {} // NOLINT: a list is a source
    BoxSource(std::span<const Point3> points, std::span<const Triangle> triangles) :
        points_(points), triangles_(triangles) {}

    [[nodiscard]] std::size_t size() const { return boxes_.size() + triangles_.size(); }
    [[nodiscard]] bool empty() const { return size() == 0; }
    /// Return the points and triangles; empty for a list of boxes.
    [[nodiscard]] std::span<const Point3> points() const { return points_; }
    [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
    [[nodiscard]] Box operator[](std::size_t i) const {
        return triangles_.empty() ? boxes_[i] : box_of(points_, triangles_[i]);
    }
    /// Returns all boxes as a list.
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

/// The group of boxes that are paired with all others.
constexpr std::uint32_t no_group = UINT32_MAX;

/// Tells for each vertex whether it is crowded: a test of all pairs of its triangles could cost more
/// than all else. Empty if no vertex is. Cost: linear.
std::vector<bool> crowded_vertices(std::size_t vertex_count, std::span<const Triangle> triangles);

/// Returns for each box a crowd or no_group; or an empty list. Pairs within one crowd are left out:
/// what they share can be found together. `busy`: some of the boxes that overlap very many others,
/// ascending.
using CrowdFinder = std::function<std::vector<std::uint32_t>(std::span<const std::uint32_t> busy)>;

/// Returns all pairs of overlapping boxes except those within one group; sorted, unique.
/// groups: per box, or empty for no_group throughout. Boxes of one group are known not to meet (or
/// need no test). With Search::bvh, pairs of triangles with a crowded vertex in common are left out
/// if they certainly meet in common corners and the edge between them only; where there are very many pairs, so
/// are pairs that are certainly apart, even after rounding to the nearest doubles. With any method,
/// find_crowds (if any) is called where some boxes overlap very many others, with the same ones. Once a
/// stop is requested, pairs are missing. Search::bvh reports its progress as stage "search".
/// *any_crowded (if any) tells whether pairs with a crowded vertex in common may have been left out.
std::vector<CandidatePair> candidate_pairs(const BoxSource& boxes,
                                           std::span<const std::uint32_t> groups, Search method,
                                           const Run& run = {}, const CrowdFinder& find_crowds = {},
                                           bool* any_crowded = nullptr);

/// Decides whether a pair is kept. Called from several threads, each under an UpwardRounding.
using PairFilter = std::function<bool(const CandidatePair&)>;

/// Returns all pairs of overlapping boxes of which at least one is active, except those within one
/// group, those that the filter (if any) rejects, and those at crowded vertices that candidate_pairs
/// leaves out; with a filter, perhaps triangles that are certainly apart, too; sorted, unique. active: ascending
/// indices of boxes. Cost: one test per box, then that of candidate_pairs for the boxes near active
/// ones; rejected pairs take no memory. Reports its progress as stage "search".
std::vector<CandidatePair> candidate_pairs_of(const BoxSource& boxes,
                                              std::span<const std::uint32_t> active,
                                              std::span<const std::uint32_t> groups = {},
                                              const PairFilter& filter = {}, const Run& run = {});

/// The classes of a PairClassifier are less than this.
constexpr std::size_t pair_classes = 4;

/// Returns the class of a pair. Called from several threads, each under an UpwardRounding.
using PairClassifier = std::function<std::size_t(const CandidatePair&)>;

/// Counts all pairs of overlapping boxes by class; none if there are more than `most`, after about so
/// many. Pairs take no memory. Reports its progress as stage "search".
std::optional<std::array<std::uint64_t, pair_classes>>
count_candidate_pairs(const BoxSource& boxes, const PairClassifier& class_of,
                      std::uint64_t most = UINT64_MAX, const Run& run = {});

/// Returns the method that `automatic` stands for: brute for very few boxes, bvh for others.
/// `terrane_bench_paper` compares the methods on the paper's models. The grid is faster than bvh by
/// a fifth to a third for two uniform surfaces of up to 70 000 triangles that meet everywhere. It
/// is slower for all others: 10 times for localised and 100 times for non-uniform contacts. The
/// choice therefore considers neither the spread of sizes nor the common volume.
Search choose(std::size_t boxes);

/// Returns the method that candidate_pairs uses: choose(boxes) for automatic, else `method`.
Search method_used(Search method, std::size_t boxes);

} // namespace terrane
