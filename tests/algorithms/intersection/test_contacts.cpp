// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the order of the points of an arrangement with the comparison of each pair of points.
#include "support/point_store_cases.hpp"

#include <terrane/algorithms/intersection/contacts.hpp>

#include <catch2/catch.hpp>

#include <limits>

namespace {

using namespace terrane;
using namespace point_store_cases;

/// Contacts that use all points of a store, with a piece in each triangle whose corners are three
/// consecutive input points.
struct Used {
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    Contacts contacts;

    Used(std::vector<Point3> input, PointStore store) : points(std::move(input)) {
        const auto count = static_cast<std::uint32_t>(points.size());
        for (std::uint32_t v = 0; v < count; ++v) {
            triangles.push_back({v, (v + 1) % count, (v + 2) % count});
            contacts.pieces.push_back({v, {0}, {Simplex::corner0, Simplex::corner0}, {v, v}});
        }
        contacts.points = std::move(store);
    }

    [[nodiscard]] PointOrder order(unsigned threads) const {
        return order_points({points, triangles}, contacts, {.threads = threads});
    }
};

void check_order(const Used& used) {
    const PointOrder order = used.order(1);
    const PointStore& store = used.contacts.points;
    const auto count = static_cast<PointIndex>(store.size());
    bool ok = true;
    for (PointIndex a = 0; a < count; ++a)
        for (PointIndex b = 0; b < count; ++b) {
            const auto sign = store.compare(a, b);
            const auto by_rank = order.rank[a] <=> order.rank[b];
            ok = ok && (sign < 0) == (by_rank < 0) && (sign > 0) == (by_rank > 0);
            ok = ok && (order.same_as[a] == order.same_as[b]) == (sign == 0);
            // The first of equal input points represents them and all points equal to it.
            if (sign == 0 && store.is_input(b)) ok = ok && order.same_as[a] <= b;
        }
    REQUIRE(ok);
    for (std::size_t i = 0; i < order.ascending.size(); ++i) {
        const PointIndex p = order.ascending[i];
        CHECK((!store.is_input(p) && order.same_as[p] == p));
        if (i > 0) CHECK((store.compare(order.ascending[i - 1], p) < 0));
    }
    const PointOrder same = used.order(3);
    CHECK(same.rank == order.rank);
    CHECK(same.same_as == order.same_as);
    CHECK(same.ascending == order.ascending);
}

} // namespace

TEST_CASE("points are ordered as they compare, input and constructed ones") {
    Random random(2110);
    for (int round = 0; round < cases(20); ++round)
        for (const Family family : all_families) {
            CAPTURE(family);
            const auto input = points_of(random, family, 12);
            Twins t = twins_of(input);
            for (int i = 0; i < 40; ++i) append(t, random_construction(random, input.size()));
            check_order({input, std::move(t.store)});
        }
}

TEST_CASE("points are ordered as they compare, however x is spread") {
    Random random(2111);
    constexpr double most = std::numeric_limits<double>::max();
    constexpr double least = std::numeric_limits<double>::denorm_min();
    const std::vector<std::vector<double>> spreads{
        {7.5},                                     // all on one plane
        {-most, most},                             // whose difference overflows
        {-most, -1, 0, least, 1, most},            // all but two in the same place
        {0, least, 2 * least, 3 * least},          // of a length whose inverse overflows
        {1, 1 + 0x1p-52, 1 + 0x1p-51, 1 + 0x1p-50} // neighbours
    };
    for (const auto& spread : spreads) {
        std::vector<Point3> input;
        for (int i = 0; i < 150; ++i) {
            const auto k = static_cast<std::size_t>(random_int(random, 0, 1000)) % spread.size();
            input.push_back({spread[k], static_cast<double>(random_int(random, -3, 3)),
                             static_cast<double>(random_int(random, -3, 3))});
        }
        check_order({input, PointStore(input)});
    }
    std::vector<Point3> clustered;
    for (int i = 0; i < cases(3000); ++i)
        clustered.push_back({i % 7 == 0 ? random_real(random, -1, 1) : random_real(random, 0, 1e-9),
                             random_real(random, -1, 1), 0});
    check_order({clustered, PointStore(clustered)});
}
