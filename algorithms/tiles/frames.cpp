// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/detail/frames.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/kernel/numbers.hpp>

namespace terrane::tiles::detail {

namespace {

/// A place of an input vertex in a frame.
struct HomePlace {
    Point3 place{}, given{};
    std::uint32_t id = 0, unused = 0;
};
/// A point of a tile that asks for its place, and the answer if an input vertex is there.
struct AskedPlace {
    Point3 place{};
    std::uint32_t point = 0, unused = 0;
};
struct ToldPlace {
    Point3 given{};
    std::uint32_t point = 0, unused = 0;
};

/// The new value of a coordinate of an input vertex.
struct HomeCoordinate {
    double in_frame = 0, given = 0;
    std::uint64_t axis = 0;

    friend auto operator<=>(const HomeCoordinate&, const HomeCoordinate&) = default;
};
struct AskedCoordinate {
    double in_frame = 0;
    std::uint64_t axis = 0;

    friend auto operator<=>(const AskedCoordinate&, const AskedCoordinate&) = default;
};

double coordinate(const Point3& p, std::uint64_t axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

void put_places(const Tile& b, const ClusterFrame& frame, std::size_t channel, Outbox& out) {
    std::uint32_t id = home_start(b, b.vertex_total());
    for (const Point3& given : b.home_given) {
        const Point3 place = frame.into(given);
        out.put(hash_of(place) % b.count, channel, HomePlace{place, given, id++});
    }
}

/// Returns the places that came; those of the first vertices are before others at the same place.
std::vector<HomePlace> take_places(std::size_t channel, Inbox& in) {
    auto places = in.all<HomePlace>(channel);
    std::sort(places.begin(), places.end(), [](const HomePlace& p, const HomePlace& q) {
        return p.place != q.place ? p.place < q.place : p.id < q.id;
    });
    return places;
}

/// Takes the doubles of a tile back from a frame that keeps the places near them, in the rounding mode in
/// which round_to_doubles() does it.
void take_back(Tile& b, const InputFrame& frame) {
    for (UsedVertex& v : b.used) v.at = frame.back(v.at);
    const UpwardRounding guard;
    for (std::size_t p = 0; p < b.points.size(); ++p) {
        OwnPoint& point = b.points[p];
        point.bound = frame.error_of(point.nearest, b.point_errors[p]);
        point.nearest = frame.back(point.nearest);
    }
    release(b.point_errors);
}

/// Calls use(place) for the points of a tile, with numbers: the used vertices first.
template <class Use>
void for_each_place(const Tile& b, const Use& use) {
    std::uint32_t number = 0;
    for (const UsedVertex& v : b.used) use(v.at, number++);
    for (const OwnPoint& p : b.points) use(p.nearest, number++);
}

Point3 place_of(const Tile& b, std::uint32_t number) {
    return number < b.used.size() ? b.used[number].at : b.points[number - b.used.size()].nearest;
}

/// Coordinates with one next integer are known to one tile.
std::size_t keeper_of(const Tile& b, std::uint64_t axis, double integer) {
    return ((std::bit_cast<std::uint64_t>(integer + 0.0) ^ axis) * 0x9e3779b97f4a7c15U >> 32) %
           b.count;
}

/// Sends the coordinates of input vertices in channel 2, and those of own points in channel 3.
void ask_for_coordinates(const Tile& b, const DecimalFrame& frame, Outbox& out) {
    std::vector<HomeCoordinate> home;
    std::vector<AskedCoordinate> asked;
    for (unsigned axis = 0; axis < 3; ++axis) {
        if (frame.is_as_given(axis)) continue;
        for (const Point3& p : b.home_given)
            home.push_back({coordinate(frame.into(p), axis), coordinate(p, axis), axis});
        for_each_place(b, [&](const Point3& place, std::uint32_t) {
            asked.push_back({coordinate(place, axis), axis});
        });
    }
    sort_unique(home);
    sort_unique(asked);
    for (const HomeCoordinate& c : home)
        out.put(keeper_of(b, c.axis, std::nearbyint(c.in_frame)), 2, c);
    for (const AskedCoordinate& c : asked) {
        // A neighbour counts only if the way back may round both to the same double.
        const double slack = 16 * std::numeric_limits<double>::epsilon() * std::fabs(c.in_frame);
        const double below = std::nearbyint(c.in_frame - slack),
                     above = std::nearbyint(c.in_frame + slack);
        for (double integer = below; integer <= above;
             integer = std::max(integer + 1, std::nextafter(integer, HUGE_VAL)))
            out.put(keeper_of(b, c.axis, integer), 3, c);
    }
}

/// Tells, in channel 2, the coordinates of input vertices next to those that are asked for.
void tell_coordinates(Inbox& in, Outbox& out) {
    auto known = in.all<HomeCoordinate>(2);
    const auto before = [](const HomeCoordinate& c, const HomeCoordinate& d) {
        return std::pair(c.axis, c.in_frame) < std::pair(d.axis, d.in_frame);
    };
    std::sort(known.begin(), known.end(), [&](const HomeCoordinate& c, const HomeCoordinate& d) {
        return before(c, d) || (!before(d, c) && c.given < d.given);
    });
    in.take<AskedCoordinate>(3, [&](std::uint32_t from, const AskedCoordinate& asked) {
        const auto not_below = std::lower_bound(
            known.begin(), known.end(), HomeCoordinate{asked.in_frame, 0, asked.axis}, before);
        if (not_below != known.end()) out.put(from, 2, *not_below);
        if (not_below == known.begin()) return;
        const auto below = std::lower_bound(known.begin(), not_below, not_below[-1], before);
        out.put(from, 2, *below); // the lowest of those that became the same
    });
}

void take_coordinates(Tile& b, DecimalFrame frame, Inbox& in) {
    std::array<std::vector<DecimalFrame::Place>, 3> places;
    in.take<HomeCoordinate>(2, [&](std::uint32_t, const HomeCoordinate& c) {
        places[c.axis].push_back({c.in_frame, c.given, false});
    });
    for (unsigned axis = 0; axis < 3; ++axis) frame.keep_places(axis, std::move(places[axis]));
    take_back(b, frame);
}

} // namespace

StepsBeside steps_back(const DecimalFrame& frame) {
    return {[&frame](Tile& b, Inbox&, Outbox& out) { ask_for_coordinates(b, frame, out); },
            [](Tile&, Inbox& in, Outbox& out) { tell_coordinates(in, out); },
            [&frame](Tile& b, Inbox& in, Outbox&) { take_coordinates(b, frame, in); }};
}

StepsBeside steps_back(const ClusterFrame& frame) {
    const auto ask = [&frame](Tile& b, Inbox&, Outbox& out) {
        put_places(b, frame, 2, out);
        for_each_place(b, [&](const Point3& place, std::uint32_t number) {
            out.put(hash_of(place) % b.count, 3, AskedPlace{place, number});
        });
    };
    const auto tell = [](Tile&, Inbox& in, Outbox& out) {
        const auto places = take_places(2, in);
        in.take<AskedPlace>(3, [&](std::uint32_t from, const AskedPlace& asked) {
            const auto found = std::lower_bound(
                places.begin(), places.end(), asked.place,
                [](const HomePlace& p, const Point3& place) { return p.place < place; });
            if (found != places.end() && found->place == asked.place)
                out.put(from, 2, ToldPlace{found->given, asked.point});
        });
    };
    const auto take = [&frame](Tile& b, Inbox& in, Outbox&) {
        ClusterFrame near = frame;
        in.take<ToldPlace>(2, [&](std::uint32_t, const ToldPlace& told) {
            near.keep_place(place_of(b, told.point), told.given);
        });
        take_back(b, near);
    };
    return {ask, tell, take};
}

void send_places(const Tile& b, const ClusterFrame& frame, Outbox& out) {
    put_places(b, frame, 0, out);
}

double largest_error_of_places(const ClusterFrame& frame, Inbox& in) {
    const auto places = take_places(0, in);
    double largest = 0;
    for (std::size_t k = 0, lead = 0; k < places.size(); ++k) {
        if (places[lead].place != places[k].place) lead = k;
        const Point3& place = places[k].place;
        largest = std::max({largest, frame.error_of_place(place, places[k].given),
                            frame.error_of_place(place, places[lead].given)});
    }
    return largest;
}

} // namespace terrane::tiles::detail
