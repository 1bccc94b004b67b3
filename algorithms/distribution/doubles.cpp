// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks that the triangles of nearest doubles meet properly. Two triangles without a corner that
// moved do, as the exact ones did. Each pair is tested in the block with the lowest corner of the
// common part of their boxes.
#include <algorithm>
#include <span>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/distribution/detail/edges.hpp>
#include <terrane/algorithms/distribution/detail/steps.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::distribution::detail {

namespace {

struct CountOfFace {
    std::uint32_t face = 0, count = 0;
};
/// Triangles of doubles near this block, with points by name.
struct DoubleSoup {
    std::vector<std::uint32_t> names;
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> dirty; ///< triangles, ascending
};

/// Collects divided faces and those undivided ones whose boxes overlap that of all dirty ones.
DoubleSoup double_soup(const Block& b, const std::vector<DoubleFace>& parts,
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

/// What is in the way of a mesh of doubles.
struct Unclean {
    std::vector<bool> is_in_way; ///< per point of the soup
    std::uint64_t count = 0;

    void add(const Triangle& t) {
        for (const std::uint32_t p : t) is_in_way[p] = true;
    }
};

/// Finds points at the same place, which become one, and triangles without area.
void find_collapsed(DoubleSoup& soup, Unclean& unclean) {
    std::vector<std::uint32_t> first(soup.points.size());
    PointTable places(soup.points.size());
    bool any = false;
    for (std::uint32_t p = 0; p < soup.points.size(); ++p) {
        first[p] = places.enter(soup.points, p);
        if (first[p] == p) continue;
        any = true;
        ++unclean.count;
        unclean.is_in_way[first[p]] = unclean.is_in_way[p] = true;
    }
    for (const std::uint32_t t : soup.dirty) {
        const Triangle& c = soup.triangles[t];
        if (!collinear(soup.points[c[0]], soup.points[c[1]], soup.points[c[2]])) continue;
        ++unclean.count;
        unclean.add(c);
    }
    if (!any) return;
    for (Triangle& t : soup.triangles)
        for (std::uint32_t& p : t) p = first[p];
}

bool have_same_corners(Triangle t, Triangle u) {
    std::sort(t.begin(), t.end());
    std::sort(u.begin(), u.end());
    return t == u;
}

/// Finds the pairs of this block that meet improperly. If something collapsed, that and triangles that
/// have become the same are in the way anyhow.
void find_improper(Block& b, const DoubleSoup& soup, Unclean& unclean, const Run& run) {
    const auto& triangles = soup.triangles;
    auto pairs =
        candidate_pairs_of({soup.points, triangles}, soup.dirty, {}, {}, without_progress(run));
    std::erase_if(pairs, [&](const CandidatePair& p) {
        const Box f = terrane::box_of(soup.points, triangles[p.first]),
                  g = terrane::box_of(soup.points, triangles[p.second]);
        return owner_of(b.grid, b.splitters,
                        {std::max(f.low[0], g.low[0]), std::max(f.low[1], g.low[1]),
                         std::max(f.low[2], g.low[2])}) != b.index;
    });
    b.work.rounded_pairs = pairs.size();
    const bool any_collapsed = unclean.count > 0;
    const auto has_area = [&](const Triangle& t) {
        return !collinear(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
    };
    const auto is_improper = [&](const CandidatePair& p) {
        const Triangle &t = triangles[p.first], &u = triangles[p.second];
        if (any_collapsed && (!has_area(t) || !has_area(u) || have_same_corners(t, u)))
            return false;
        return improper_contact(soup.points, t, u).has_value();
    };
    const auto found = concatenated(parts_of_ranges<std::vector<CandidatePair>>(
        pairs.size(), run, [&](std::size_t first, std::size_t last) {
            std::vector<CandidatePair> improper;
            for (std::size_t k = first; k < last; ++k)
                if (is_improper(pairs[k])) improper.push_back(pairs[k]);
            return improper;
        }));
    unclean.count += found.size();
    for (const CandidatePair& p : found) {
        unclean.add(triangles[p.first]);
        unclean.add(triangles[p.second]);
    }
}

} // namespace

/// Channel 0: BlockVerdict, to all.
Status check_doubles(Block& b, Inbox& in, Outbox& out, const Run& run) {
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
    BlockVerdict verdict;
    DoubleSoup soup = double_soup(b, parts, divided);
    Unclean unclean{std::vector<bool>(soup.points.size(), false)};
    find_collapsed(soup, unclean);
    if (!soup.dirty.empty()) find_improper(b, soup, unclean, run);
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

} // namespace terrane::distribution::detail
