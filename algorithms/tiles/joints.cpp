// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/detail/joints.hpp>

#include <algorithm>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/tiles/detail/over_tiles.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>

namespace terrane::tiles {

using namespace detail;

namespace {

/// An input triangle, or an input vertex, to one who asked for it.
struct AskedTriangle {
    std::uint32_t id = 0;
    Triangle corners{};
};
struct AskedVertex {
    std::uint32_t id = 0, first = 0; ///< the first vertex at its place
    Point3 at{};
};

/// A vertex of a surface.
struct SurfaceVertex {
    std::uint32_t name = 0, surface = 0;
    Point3 at{};

    friend bool operator<(const SurfaceVertex& v, const SurfaceVertex& w) {
        return std::pair(v.name, v.surface) < std::pair(w.name, w.surface);
    }
    friend bool operator==(const SurfaceVertex& v, const SurfaceVertex& w) {
        return v.name == w.name && v.surface == w.surface;
    }
};

struct SentMeeting {
    std::uint32_t first = 0, second = 0;
    Box box{};
};

void add_meeting(Meetings& all, const SentMeeting& m) {
    const auto [known, is_new] = all.try_emplace({m.first, m.second}, m.box);
    for (unsigned k = 0; k < 3; ++k) {
        known->second.low[k] = std::min(known->second.low[k], m.box.low[k]);
        known->second.high[k] = std::max(known->second.high[k], m.box.high[k]);
    }
}

/// Channel 0: SurfaceVertex; those of several tiles to where all that is at the vertex comes together.
Status send_vertices(Tile& b, Inbox&, Outbox& out) {
    std::vector<SurfaceVertex> all;
    for (std::size_t t = 0; t < b.triangles.size(); ++t)
        for (const std::uint32_t v : b.triangles[t])
            for (const std::uint32_t s : b.surfaces_of[t]) all.push_back({v, s, {}});
    sort_unique(all);
    for (std::size_t k = 0, end = 0; k < all.size(); k = end) {
        while (end < all.size() && all[end].name == all[k].name) ++end;
        const bool is_elsewhere = is_shared(b, all[k].name);
        if (end - k < 2 && !is_elsewhere) continue;
        for (std::size_t i = k; i < end; ++i) {
            all[i].at = doubles_of(b, all[i].name);
            out.put(is_elsewhere ? all[i].name % b.count : b.index, 0, all[i]);
        }
    }
    return Done{};
}

/// Channel 0: SentMeeting, to the first tile.
Status send_meetings(Tile&, Inbox& in, Outbox& out) {
    auto all = in.all<SurfaceVertex>(0);
    sort_unique(all);
    Meetings meetings;
    for (std::size_t k = 0, end = 0; k < all.size(); k = end)
        for (; end < all.size() && all[end].name == all[k].name; ++end)
            for (std::size_t i = k; i < end; ++i) {
                const Point3& p = all[k].at;
                add_meeting(meetings,
                            {all[i].surface, all[end].surface, {{p.x, p.y, p.z}, {p.x, p.y, p.z}}});
            }
    for (const auto& [pair, box] : meetings)
        out.put(0, 0, SentMeeting{pair.first, pair.second, box});
    return Done{};
}

} // namespace

Status detail::find_corners(Supersteps& tiles, const std::vector<std::uint32_t>& triangles,
                            GivenCorners& corners) {
    std::vector<AskedTriangle> found;
    const Step ask = [&](Tile& b, Inbox&, Outbox& out) -> Status {
        if (b.index == 0)
            for (const std::uint32_t t : triangles)
                if (!corners.contains(t)) out.put(home_of(t, b.triangle_total(), b.count), 0, t);
        return Done{};
    };
    const Step tell = [](Tile& b, Inbox& in, Outbox& out) -> Status {
        const std::uint32_t first = home_start(b, b.triangle_total());
        in.take<std::uint32_t>(0, [&](std::uint32_t from, std::uint32_t t) {
            out.put(from, 0, AskedTriangle{t, b.home_triangles[t - first]});
        });
        return Done{};
    };
    const Step ask_for_vertices = [&](Tile& b, Inbox& in, Outbox& out) -> Status {
        if (b.index != 0) return Done{};
        found = in.all<AskedTriangle>(0);
        std::vector<std::uint32_t> vertices;
        for (const AskedTriangle& t : found)
            vertices.insert(vertices.end(), t.corners.begin(), t.corners.end());
        sort_unique(vertices);
        for (const std::uint32_t v : vertices) out.put(home_of(v, b.vertex_total(), b.count), 0, v);
        return Done{};
    };
    const Step tell_vertices = [](Tile& b, Inbox& in, Outbox& out) -> Status {
        const std::uint32_t first = home_start(b, b.vertex_total());
        in.take<std::uint32_t>(0, [&](std::uint32_t from, std::uint32_t v) {
            out.put(from, 0,
                    AskedVertex{v, (b.is_moved ? b.home_given_first : b.home_first)[v - first],
                                (b.is_moved ? b.home_given : b.home_points)[v - first]});
        });
        return Done{};
    };
    const Step take = [&](Tile& b, Inbox& in, Outbox&) -> Status {
        if (b.index != 0) return Done{};
        std::map<std::uint32_t, GivenCorner> vertices;
        in.take<AskedVertex>(0, [&](std::uint32_t, const AskedVertex& v) {
            vertices[v.id] = {v.first, 0, v.at};
        });
        for (const AskedTriangle& t : found)
            for (unsigned i = 0; i < 3; ++i) corners[t.id][i] = vertices.at(t.corners[i]);
        return Done{};
    };
    for (const Step* step : {&ask, &tell, &ask_for_vertices, &tell_vertices, &take})
        if (auto done = tiles.step("joints", *step); !done) return done;
    return Done{};
}

Result<Meetings> detail::find_meetings(Supersteps& tiles) {
    std::vector<SentMeeting> sent;
    const Step take = [&](Tile& b, Inbox& in, Outbox&) -> Status {
        if (b.index == 0) sent = in.all<SentMeeting>(0);
        return Done{};
    };
    for (const Step& step : {Step(send_vertices), Step(send_meetings), take})
        if (auto done = tiles.step("joints", step); !done) return done.error();
    if (auto told = tell_all(tiles, sent); !told) return told.error();
    Meetings all;
    for (const SentMeeting& m : sent) add_meeting(all, m);
    return all;
}

bool detail::may_be_parted(const Meetings& before, const Meetings& after, double deviation) {
    return std::ranges::any_of(before, [&](const auto& meeting) {
        const auto& [low, high] = meeting.second;
        return !after.contains(meeting.first) &&
               move_bound({low[0], low[1], low[2]}, {high[0], high[1], high[2]}) >
                   stated_deviations * deviation;
    });
}

} // namespace terrane::tiles
