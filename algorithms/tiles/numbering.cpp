// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds equal constructed points of different tiles and numbers all points. A constructed point is
// compared where the nearest double of its x belongs: points with equal x are in one tile, so their
// exact order is found there, and the order of the tiles is that of the points.
#include <algorithm>
#include <numeric>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/intersection/renamed_construction.hpp>
#include <terrane/algorithms/tiles/detail/soup_of_faces.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::tiles::detail {

namespace {

/// A constructed point, with the coordinates of the vertices that its construction names.
struct PointToOrder {
    Construction how{};
    std::uint32_t number = 0, unused = 0; ///< in its tile
    std::array<Point3, 9> at{};
};
struct NumberedPoint {
    std::uint32_t point = 0;  ///< in its tile
    std::uint32_t number = 0; ///< within the tile that orders it
    std::uint32_t shared = 0;
};
struct NumberedVertex {
    std::uint32_t id = 0, number = 0, shared = 0;
};
struct Counts {
    std::uint32_t used = 0, constructed = 0;
};

/// Lists the input vertices of own triangles, each once.
std::vector<UsedVertex> used_vertices(const Tile& b) {
    std::vector<UsedVertex> used;
    const auto use = [&](const Face& f, unsigned i) {
        used.push_back({f.corners[i], 0, 0, 0, f.at[i]});
    };
    for (const Face& f : b.faces) {
        if (owner_of_face(b, f) != b.index) continue;
        if (std::binary_search(b.touched.begin(), b.touched.end(), f.id)) continue;
        for (unsigned i = 0; i < 3; ++i) use(f, i);
    }
    std::vector<std::uint32_t> in_parts;
    for (const Part& p : b.parts)
        for (const std::uint32_t c : p.corners)
            if (c < b.vertex_total()) in_parts.push_back(c);
    sort_unique(in_parts);
    for (const Face& f : b.geometry)
        for (unsigned i = 0; i < 3; ++i)
            if (std::binary_search(in_parts.begin(), in_parts.end(), f.corners[i])) use(f, i);
    const auto lower = [](const UsedVertex& u, const UsedVertex& v) { return u.id < v.id; };
    std::sort(used.begin(), used.end(), lower);
    const auto same = [](const UsedVertex& u, const UsedVertex& v) { return u.id == v.id; };
    used.erase(std::unique(used.begin(), used.end(), same), used.end());
    used.shrink_to_fit();
    return used;
}

/// Makes a store of points that other tiles sent.
PointStore store_of(const std::vector<PointToOrder>& points) {
    std::vector<std::pair<std::uint32_t, Point3>> vertices;
    for (const PointToOrder& p : points)
        for (unsigned k = 0; k < vertices_of(p.how); ++k)
            vertices.emplace_back(p.how.v[k], p.at[k]);
    const auto lower = [](const auto& u, const auto& v) { return u.first < v.first; };
    std::sort(vertices.begin(), vertices.end(), lower);
    const auto same = [](const auto& u, const auto& v) { return u.first == v.first; };
    vertices.erase(std::unique(vertices.begin(), vertices.end(), same), vertices.end());
    std::vector<Point3> inputs;
    for (const auto& [name, at] : vertices) inputs.push_back(at);
    std::vector<Construction> constructions;
    for (const PointToOrder& p : points) {
        Construction how = p.how;
        for (unsigned k = 0; k < vertices_of(how); ++k)
            how.v[k] =
                static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(),
                                                            std::pair(how.v[k], Point3{}), lower) -
                                           vertices.begin());
        constructions.push_back(how);
    }
    PointStore store(std::move(inputs));
    store.append(constructions);
    return store;
}

} // namespace

/// Channel 0: splitters of x, from the first tile to all.
Status split_points(Tile& b, Inbox& in, Outbox& out) {
    if (b.index != 0) return Done{};
    auto samples = in.all<double>(0);
    std::sort(samples.begin(), samples.end());
    for (std::size_t k = 1; k < b.count && !samples.empty(); ++k)
        out.put_to_all(0, samples[samples.size() * k / b.count]);
    return Done{};
}

/// Channel 0: PointToOrder, to the tile that orders it; channel 1: numbers of input vertices in
/// use, to their homes.
Status send_points(Tile& b, Inbox& in, Outbox& out) {
    b.point_splitters = in.all<double>(0);
    const SoupOfFaces soup = soup_of(b.geometry);
    for (std::uint32_t p = 0; p < b.points.size(); ++p) {
        PointToOrder record;
        record.how = b.constructions[p];
        record.number = p;
        for (unsigned k = 0; k < vertices_of(record.how); ++k)
            record.at[k] = soup.points[soup.point_named(record.how.v[k])];
        const auto& splitters = b.point_splitters;
        const auto to = static_cast<std::size_t>(
            std::upper_bound(splitters.begin(), splitters.end(), b.points[p].nearest.x) -
            splitters.begin());
        out.put(to, 0, record);
    }
    b.used = used_vertices(b);
    for (const UsedVertex& v : b.used) out.put(home_of(v.id, b.vertex_total(), b.count), 1, v.id);
    release(b.constructions);
    release(b.geometry);
    return Done{};
}

/// Channel 0: Counts, to all.
Status order_constructed(Tile& b, Inbox& in, Outbox& out) {
    std::vector<PointToOrder> points;
    in.take<PointToOrder>(0, [&](std::uint32_t from, const PointToOrder& p) {
        points.push_back(p);
        b.requests.push_back({from, p.number, 0});
    });
    const PointStore store = store_of(points);
    const auto first = static_cast<PointIndex>(store.input_count());
    std::vector<PointIndex> order(points.size());
    std::iota(order.begin(), order.end(), first);
    std::sort(order.begin(), order.end(), [&](PointIndex p, PointIndex q) {
        const double x = store.nearest(p).x, y = store.nearest(q).x;
        return x != y ? x < y : store.compare(p, q) < 0;
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (k > 0 && !store.equal(order[k - 1], order[k])) ++b.ordered;
        b.requests[order[k] - first][2] = b.ordered;
    }
    if (!order.empty()) ++b.ordered;
    in.take<std::uint32_t>(1, [&](std::uint32_t from, std::uint32_t v) {
        b.used_here.push_back({v, from});
    });
    std::sort(b.used_here.begin(), b.used_here.end());
    std::uint32_t distinct = 0;
    for (std::size_t k = 0; k < b.used_here.size(); ++k)
        distinct += k == 0 || b.used_here[k][0] != b.used_here[k - 1][0];
    out.put_to_all(0, Counts{distinct, b.ordered});
    return Done{};
}

/// Channel 0: NumberedPoint, back; channel 1: NumberedVertex, back.
Status number_points(Tile& b, Inbox& in, Outbox& out) {
    std::uint32_t used_before = 0, constructed_before = 0;
    in.take<Counts>(0, [&](std::uint32_t from, const Counts& c) {
        if (from < b.index) {
            used_before += c.used;
            constructed_before += c.constructed;
        }
        b.used_total += c.used;
        b.constructed_total += c.constructed;
    });
    std::vector<std::uint32_t> users(b.ordered, UINT32_MAX);
    std::vector<bool> shared(b.ordered, false);
    for (const auto& [from, point, place] : b.requests) {
        if (users[place] != UINT32_MAX && users[place] != from) shared[place] = true;
        users[place] = from;
    }
    for (const auto& [from, point, place] : b.requests)
        out.put(from, 0, NumberedPoint{point, constructed_before + place, shared[place] ? 1U : 0U});
    for (std::size_t k = 0, end = 0; k < b.used_here.size(); k = end, ++used_before) {
        while (end < b.used_here.size() && b.used_here[end][0] == b.used_here[k][0]) ++end;
        for (std::size_t i = k; i < end; ++i)
            out.put(b.used_here[i][1], 1,
                    NumberedVertex{b.used_here[i][0], used_before, end - k > 1 ? 1U : 0U});
    }
    release(b.requests);
    release(b.used_here);
    return Done{};
}

/// Notes the numbers of points. Channel 0: parts of faces that overlap others, to where a hash of
/// their corners points (settling.cpp).
Status receive_numbers(Tile& b, Inbox& in, Outbox& out) {
    in.take<NumberedPoint>(0, [&](std::uint32_t, const NumberedPoint& p) {
        b.points[p.point].number = p.number;
        b.points[p.point].shared = p.shared;
    });
    in.take<NumberedVertex>(1, [&](std::uint32_t, const NumberedVertex& v) {
        const auto at =
            std::lower_bound(b.used.begin(), b.used.end(), v.id,
                             [](const UsedVertex& u, std::uint32_t id) { return u.id < id; });
        at->number = v.number;
        at->shared = v.shared;
    });
    const std::uint32_t inputs = b.vertex_total();
    if (b.constructed_total > UINT32_MAX - inputs)
        return Error{ErrorCode::unsupported, "there are more than 4294967295 points", ""};
    for (Part& part : b.parts)
        for (std::uint32_t& c : part.corners)
            if (c >= inputs) c = inputs + b.points[c - inputs].number;
    // From now on, points ascend by their numbers. Equal ones of one tile are one already.
    std::sort(b.points.begin(), b.points.end(),
              [](const OwnPoint& p, const OwnPoint& q) { return p.number < q.number; });
    send_overlapping_parts(b, out);
    return Done{};
}

} // namespace terrane::tiles::detail
