// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks that the triangles of nearest doubles meet properly. Two triangles without a corner that
// moved do, as the exact ones did. Each pair is tested in the tile with the lowest corner of the
// common part of their boxes.
#include <algorithm>
#include <array>
#include <atomic>
#include <span>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/tiles/detail/edges.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::tiles::detail {

namespace {

struct CountOfFace {
    std::uint32_t face = 0, count = 0;
};
/// Triangles of doubles near this tile, with points by name.
struct DoubleSoup {
    std::vector<std::uint32_t> names;
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> dirty; ///< triangles, ascending
};

/// Collects divided faces and those undivided ones whose boxes overlap that of all dirty ones.
DoubleSoup double_soup(const Tile& b, const std::vector<DoubleFace>& parts,
                       const std::vector<std::uint32_t>& divided) {
    DoubleSoup soup;
    std::vector<Box> dirty;
    for (const DoubleFace& p : parts)
        if (p.is_dirty != 0) dirty.push_back(box_of(p.at));
    if (dirty.empty()) return soup;
    Box all = dirty.front();
    for (const Box& box : dirty)
        for (unsigned k = 0; k < 3; ++k) {
            all.low[k] = std::min(all.low[k], box.low[k]);
            all.high[k] = std::max(all.high[k], box.high[k]);
        }
    std::vector<std::pair<std::uint32_t, Point3>> points;
    std::vector<std::array<std::uint32_t, 3>> corners;
    const auto add = [&](const std::array<std::uint32_t, 3>& c, const std::array<Point3, 3>& at) {
        if (!all.overlaps(box_of(at))) return;
        for (unsigned i = 0; i < 3; ++i) points.emplace_back(c[i], at[i]);
        corners.push_back(c);
    };
    for (const DoubleFace& p : parts) {
        if (p.is_dirty != 0) soup.dirty.push_back(static_cast<std::uint32_t>(corners.size()));
        add(p.corners, p.at);
    }
    const auto undivided = b.is_in_frame ? std::span<const Face>() : std::span(b.faces);
    for (const Face& f : undivided)
        if (!std::binary_search(divided.begin(), divided.end(), f.id)) add(f.corners, f.at);
    std::sort(points.begin(), points.end(),
              [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [name, at] : points)
        if (soup.names.empty() || soup.names.back() != name) {
            soup.names.push_back(name);
            soup.points.push_back(at);
        }
    for (const auto& c : corners) {
        Triangle& t = soup.triangles.emplace_back();
        for (unsigned i = 0; i < 3; ++i)
            t[i] = static_cast<std::uint32_t>(
                std::lower_bound(soup.names.begin(), soup.names.end(), c[i]) - soup.names.begin());
    }
    return soup;
}

/// The contacts and triangles in the way of a mesh of doubles.
struct Unclean {
    std::vector<bool> is_in_way; ///< per point of the soup
    std::uint64_t count = 0;

    void add(const Triangle& t) {
        for (const std::uint32_t p : t) is_in_way[p] = true;
    }
};

/// Names corners by the first points at their places, and keeps one triangle of each with the same corners.
/// It is dirty if any of them is.
void leave_one_of_each(DoubleSoup& soup, const std::vector<std::uint32_t>& first) {
    struct Named {
        Triangle corners{};
        std::uint32_t triangle = 0;
        auto operator<=>(const Named&) const = default;
    };
    std::vector<Named> all;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        Triangle& c = soup.triangles[t];
        for (std::uint32_t& p : c) p = first[p];
        if (collinear(soup.points[c[0]], soup.points[c[1]], soup.points[c[2]])) continue;
        all.push_back({c, t});
        std::sort(all.back().corners.begin(), all.back().corners.end());
    }
    std::sort(all.begin(), all.end());
    std::vector<Triangle> kept;
    std::vector<std::uint32_t> dirty;
    for (std::size_t k = 0, end = 0; k < all.size(); k = end) {
        bool is_dirty = false;
        for (; end < all.size() && all[end].corners == all[k].corners; ++end)
            is_dirty |= std::binary_search(soup.dirty.begin(), soup.dirty.end(), all[end].triangle);
        if (is_dirty) dirty.push_back(static_cast<std::uint32_t>(kept.size()));
        kept.push_back(soup.triangles[all[k].triangle]);
    }
    soup.triangles = std::move(kept);
    soup.dirty = std::move(dirty);
}

/// Finds points at the same place, which become one, and triangles without area. These, and all but one of
/// the triangles that become the same, are left out from then on: their corners are in the way anyhow.
void set_collapsed_aside(DoubleSoup& soup, Unclean& unclean) {
    std::vector<std::uint32_t> first(soup.points.size());
    PointTable places(soup.points.size());
    for (std::uint32_t p = 0; p < soup.points.size(); ++p) {
        first[p] = places.enter(soup.points, p);
        if (first[p] == p) continue;
        ++unclean.count;
        unclean.is_in_way[first[p]] = unclean.is_in_way[p] = true;
    }
    for (const std::uint32_t t : soup.dirty) {
        const Triangle& c = soup.triangles[t];
        if (!collinear(soup.points[c[0]], soup.points[c[1]], soup.points[c[2]])) continue;
        ++unclean.count;
        unclean.add(c);
    }
    if (unclean.count > 0) leave_one_of_each(soup, first);
}

/// Counts the pairs of this tile that meet improperly. They are not kept, as there can be very many.
void count_improper(Tile& b, const DoubleSoup& soup, Unclean& unclean, const Run& run) {
    const auto& triangles = soup.triangles;
    // Cells are found here, as they depend on the rounding mode, and the test has another one. They never
    // decrease when a coordinate grows.
    std::vector<std::array<std::uint32_t, 3>> lowest;
    for (const Triangle& t : triangles) {
        const Box box = terrane::box_of(soup.points, t);
        lowest.push_back(
            {b.grid.cell(0, box.low[0]), b.grid.cell(1, box.low[1]), b.grid.cell(2, box.low[2])});
    }
    std::atomic<std::uint64_t> tested{0}, improper{0};
    std::vector<std::atomic<bool>> is_in_way(soup.points.size());
    const auto test = [&](const CandidatePair& p) {
        const auto &f = lowest[p.first], &g = lowest[p.second];
        const auto place =
            b.grid.place({std::max(f[0], g[0]), std::max(f[1], g[1]), std::max(f[2], g[2])});
        if (tile_at(b.splitters, place) != b.index) return false;
        tested.fetch_add(1, std::memory_order_relaxed);
        const Triangle &t = triangles[p.first], &u = triangles[p.second];
        if (!improper_contact(soup.points, t, u)) return false;
        improper.fetch_add(1, std::memory_order_relaxed);
        for (const Triangle* c : {&t, &u})
            for (const std::uint32_t v : *c) is_in_way[v].store(true, std::memory_order_relaxed);
        return false;
    };
    (void)candidate_pairs_of({soup.points, triangles}, soup.dirty, {}, test, without_progress(run));
    b.work.rounded_pairs = tested;
    unclean.count += improper;
    for (std::size_t p = 0; p < is_in_way.size(); ++p)
        if (is_in_way[p]) unclean.is_in_way[p] = true;
}

} // namespace

/// Channel 0: TileVerdict, to all.
Status check_doubles(Tile& b, Inbox& in, Outbox& out, const Run& run) {
    const std::uint32_t first = home_start(b, b.triangle_total());
    in.take<CountOfFace>(
        0, [&](std::uint32_t, const CountOfFace& c) { b.home_count[c.face - first] = c.count; });
    if (b.is_in_frame) { // from here on there are the doubles alone
        b.grid = b.given_grid;
        b.splitters = b.given_splitters;
    }
    const auto parts = in.all<DoubleFace>(1);
    auto divided = in.all<std::uint32_t>(2);
    sort_unique(divided);
    keep_records(b, in, 3);
    TileVerdict verdict;
    DoubleSoup soup = double_soup(b, parts, divided);
    Unclean unclean{std::vector<bool>(soup.points.size(), false)};
    set_collapsed_aside(soup, unclean);
    if (!soup.dirty.empty()) count_improper(b, soup, unclean, run);
    verdict.unclean = unclean.count;
    for (std::size_t p = 0; p < soup.points.size(); ++p)
        if (unclean.is_in_way[p]) b.unclean_points.push_back({soup.names[p], 0, soup.points[p]});
    for (const OwnPoint& p : b.points) verdict.deviation = std::max(verdict.deviation, p.bound);
    for (const std::uint32_t c : b.home_count) verdict.triangles += c;
    out.put_to_all(0, verdict);
    release(b.faces);
    release(b.parts);
    b.own_faces_of = {};
    release(b.touched);
    release(b.overlapped);
    return Done{};
}

} // namespace terrane::tiles::detail
