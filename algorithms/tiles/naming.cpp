// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names each input vertex by the first one at the same place, divides space into tiles, and sends
// each face to the tiles that its box overlaps.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::tiles::detail {

namespace {

struct HomeVertex {
    Point3 at{};
    std::uint32_t id = 0, unused = 0;
};
struct HomeTriangle {
    std::uint32_t id = 0;
    Triangle corners{};
};
/// A vertex, and the first one at the same place.
struct FirstVertex {
    std::uint32_t id = 0, first = 0;
    Point3 at{}; ///< of the first
};

bool has_area(const Face& f) {
    if (f.corners[0] == f.corners[1] || f.corners[1] == f.corners[2] ||
        f.corners[2] == f.corners[0])
        return false;
    return !collinear(f.at[0], f.at[1], f.at[2]);
}

} // namespace

Box box_of(const std::array<Point3, 3>& at) {
    return terrane::box_of(at, Triangle{0, 1, 2});
}

std::uint32_t owner_of_face(const Tile& b, const Face& face) {
    return owner_of(b.grid, b.splitters, box_of(face.at).low);
}

/// Channel 0: HomeVertex to where its hash points; channel 1: box of these vertices, to all.
void send_home_vertices(const Tile& b, Outbox& out) {
    constexpr double far = HUGE_VAL;
    Box box{{far, far, far}, {-far, -far, -far}};
    std::uint32_t id = home_start(b, b.vertex_total());
    for (const Point3& p : b.home_points) {
        const std::array<double, 3> x{p.x, p.y, p.z};
        for (unsigned k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], x[k]);
            box.high[k] = std::max(box.high[k], x[k]);
        }
        out.put(hash_of(p) % b.count, 0, HomeVertex{p, id++});
    }
    if (!b.home_points.empty()) out.put_to_all(1, box);
}

/// See send_home_vertices.
Status receive_share(Tile& b, Inbox& in, Outbox& out) {
    const std::uint32_t vertices = home_size(b, b.vertex_total()),
                        triangles = home_size(b, b.triangle_total()),
                        first_vertex = home_start(b, b.vertex_total()),
                        first_triangle = home_start(b, b.triangle_total());
    b.home_points.resize(vertices);
    b.home_triangles.resize(triangles);
    b.work.homes = triangles;
    in.take<HomeVertex>(
        0, [&](std::uint32_t, const HomeVertex& v) { b.home_points[v.id - first_vertex] = v.at; });
    in.take<HomeTriangle>(1, [&](std::uint32_t, const HomeTriangle& t) {
        b.home_triangles[t.id - first_triangle] = t.corners;
    });
    send_home_vertices(b, out);
    return Done{};
}

/// Channel 0: FirstVertex home, for vertices that are not the first themselves.
Status find_first_vertices(Tile& b, Inbox& in, Outbox& out) {
    Box box{};
    bool any = false;
    in.take<Box>(1, [&](std::uint32_t, const Box& part) {
        for (unsigned k = 0; k < 3; ++k) {
            box.low[k] = any ? std::min(box.low[k], part.low[k]) : part.low[k];
            box.high[k] = any ? std::max(box.high[k], part.high[k]) : part.high[k];
        }
        any = true;
    });
    b.grid = grid_over(box, b.count);
    const auto vertices = in.all<HomeVertex>(0);
    std::vector<std::uint32_t> order(vertices.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
        if (vertices[i].at != vertices[k].at) return vertices[i].at < vertices[k].at;
        return vertices[i].id < vertices[k].id;
    });
    for (std::size_t k = 1, lead = 0; k < order.size(); ++k) {
        const HomeVertex &first = vertices[order[lead]], &v = vertices[order[k]];
        if (first.at != v.at) {
            lead = k;
            continue;
        }
        out.put(home_of(v.id, b.vertex_total(), b.count), 0, FirstVertex{v.id, first.id, first.at});
    }
    return Done{};
}

/// Channel 0: numbers of the corners of home triangles, to their homes.
Status ask_for_corners(Tile& b, Inbox& in, Outbox& out) {
    const std::uint32_t start = home_start(b, b.vertex_total());
    b.home_first.resize(b.home_points.size());
    for (std::uint32_t k = 0; k < b.home_first.size(); ++k) b.home_first[k] = start + k;
    in.take<FirstVertex>(0, [&](std::uint32_t, const FirstVertex& v) {
        b.home_first[v.id - start] = v.first;
        b.home_points[v.id - start] = v.at;
    });
    std::vector<std::uint32_t> wanted;
    for (const Triangle& t : b.home_triangles) wanted.insert(wanted.end(), t.begin(), t.end());
    sort_unique(wanted);
    for (const std::uint32_t v : wanted) out.put(home_of(v, b.vertex_total(), b.count), 0, v);
    return Done{};
}

/// Channel 0: FirstVertex, back.
Status tell_corners(Tile& b, Inbox& in, Outbox& out) {
    const std::uint32_t start = home_start(b, b.vertex_total());
    in.take<std::uint32_t>(0, [&](std::uint32_t from, std::uint32_t v) {
        out.put(from, 0, FirstVertex{v, b.home_first[v - start], b.home_points[v - start]});
    });
    return Done{};
}

/// Channel 0: CellCount, to the first tile; channel 1: the largest coordinate, to all; channel 2:
/// records of triangles without area, to their keepers.
Status weigh_cells(Tile& b, Inbox& in, Outbox& out) {
    auto known = in.all<FirstVertex>(0);
    std::sort(known.begin(), known.end(),
              [](const FirstVertex& u, const FirstVertex& v) { return u.id < v.id; });
    const auto corner = [&](std::uint32_t v) -> const FirstVertex& {
        return *std::lower_bound(known.begin(), known.end(), v,
                                 [](const FirstVertex& u, std::uint32_t id) { return u.id < id; });
    };
    const std::uint32_t first = home_start(b, b.triangle_total());
    std::map<std::pair<std::uint64_t, std::uint32_t>, std::uint32_t> count_of; // place, surface
    b.home_count.assign(b.home_triangles.size(), 1);
    double largest = 0;
    for (std::uint32_t k = 0; k < b.home_triangles.size(); ++k) {
        Face face;
        face.id = first + k;
        for (unsigned i = 0; i < 3; ++i) {
            const FirstVertex& v = corner(b.home_triangles[k][i]);
            face.corners[i] = v.first;
            face.at[i] = v.at;
            largest = std::max({largest, std::fabs(v.at.x), std::fabs(v.at.y), std::fabs(v.at.z)});
        }
        const bool was_flat = std::binary_search(b.home_flat.begin(), b.home_flat.end(), face.id);
        if (has_area(face) && !was_flat) {
            ++count_of[{b.grid.place_of(box_of(face.at).low), surface_of(b, face.id)}];
            b.home_faces.push_back(face);
            continue;
        }
        b.home_degenerate.push_back(face.id);
        b.home_count[k] = 0;
        if (!b.wants_digest) continue;
        Sha256 state;
        state.feed("degenerate");
        state.feed(input_hash(b, face));
        const Hash record = state.finish();
        b.degenerate_records.push_back(record);
    }
    for (const auto& [cell, count] : count_of)
        out.put(0, 0, CellCount{cell.first, cell.second, count});
    out.put_to_all(1, largest);
    return Done{};
}

/// Channel 0: splitters, from the first tile to all.
Status divide_space(Tile& b, Inbox& in, Outbox& out) {
    in.take<double>(1, [&](std::uint32_t, double x) { b.largest = std::max(b.largest, x); });
    if (b.index != 0) return Done{};
    for (const std::uint64_t s : equal_runs(in.all<CellCount>(0), b.count)) out.put_to_all(0, s);
    return Done{};
}

/// Channel 0: Face, to the tiles that its box overlaps; channel 1: home_repeated, to the owners.
Status distribute_faces(Tile& b, Inbox& in, Outbox& out) {
    b.splitters = in.all<std::uint64_t>(0);
    const std::uint32_t first = home_start(b, b.triangle_total());
    b.home_owner.assign(b.home_triangles.size(), b.index);
    auto repeated = b.home_repeated.begin();
    for (const Face& face : b.home_faces) {
        const std::uint32_t owner = b.home_owner[face.id - first] = owner_of_face(b, face);
        while (repeated != b.home_repeated.end() && (*repeated)[0] < face.id) ++repeated;
        if (repeated != b.home_repeated.end() && (*repeated)[0] == face.id)
            out.put(owner, 1, *repeated);
        for (const std::uint32_t to : tiles_of(b.grid, b.splitters, box_of(face.at)))
            out.put(to, 0, face);
    }
    release(b.home_faces);
    return Done{};
}

} // namespace terrane::tiles::detail
