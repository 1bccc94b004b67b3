// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Logs of wells through random models, most of them degenerate, against an oracle in rationals: all triangles are
// clipped by barycentric coordinates, and blocks found by winding numbers.
#include <catch2/catch.hpp>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gmpxx.h>

#include "random_blocks.hpp"

using namespace terrane;
using namespace test_support;

namespace {

RationalPoint plus(const RationalPoint& p, const RationalPoint& q, const mpq_class& by) {
    return {p[0] + by * q[0], p[1] + by * q[1], p[2] + by * q[2]};
}
RationalPoint minus_of(const RationalPoint& p, const RationalPoint& q) {
    return plus(p, q, -1);
}
mpq_class dot_of(const RationalPoint& p, const RationalPoint& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
RationalPoint cross_of(const RationalPoint& p, const RationalPoint& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// The double nearest to a number, of the two next to its truncation and it.
double nearest(const mpq_class& x) {
    if (x == 0) return 0;
    const double d = x.get_d(); // towards 0
    const double further = std::nextafter(d, sgn(x) * HUGE_VAL);
    const mpq_class low = abs(x - mpq_class(d)), high = abs(x - mpq_class(further));
    if (low == high) return std::fmod(std::ldexp(d, 52 - std::ilogb(d)), 2) == 0 ? d : further;
    return low < high ? d : further;
}

struct Clip {
    mpq_class from, to;
    std::uint32_t triangle;
};

/// Clips the segment p + s d, 0 <= s <= 1, by the inequality value + s growth >= 0.
void clip(const mpq_class& value, const mpq_class& growth, Clip& c, bool& is_empty) {
    if (growth == 0) {
        is_empty = is_empty || value < 0;
        return;
    }
    const mpq_class zero = -value / growth;
    if (growth > 0)
        c.from = std::max(c.from, zero);
    else
        c.to = std::min(c.to, zero);
}

std::vector<Clip> clips(const Mesh& mesh, const RationalPoint& p, const RationalPoint& d) {
    std::vector<Clip> all;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<RationalPoint, 3> v;
        for (std::size_t i = 0; i < 3; ++i) v[i] = rational(mesh.vertices[mesh.triangles[t][i]]);
        const RationalPoint n = cross_of(minus_of(v[1], v[0]), minus_of(v[2], v[0]));
        Clip c{0, 1, t};
        bool is_empty = false;
        const mpq_class height = dot_of(n, minus_of(p, v[0])), growth = dot_of(n, d);
        clip(height, growth, c, is_empty);
        clip(-height, -growth, c, is_empty);
        for (std::size_t i = 0; i < 3; ++i) {
            const RationalPoint inwards = cross_of(n, minus_of(v[(i + 1) % 3], v[i]));
            clip(dot_of(inwards, minus_of(p, v[i])), dot_of(inwards, d), c, is_empty);
        }
        if (!is_empty && c.from <= c.to) all.push_back(c);
    }
    return all;
}

using Numbers = std::set<std::uint32_t>;

struct Piece {
    mpq_class from, to; // depths
    RationalPoint entry, exit;
    Numbers blocks, surfaces;
    bool is_known = true; // whether the oracle knows all blocks
};

struct Expected {
    std::vector<Piece> pieces;
    std::vector<Numbers> met; // surfaces, per end of a piece
};

void add_surfaces(const Mesh& mesh, std::uint32_t triangle, Numbers& surfaces) {
    const auto of = mesh.surfaces_of[triangle];
    surfaces.insert(of.begin(), of.end());
}

/// Blocks at points a little off a point in many directions.
Numbers blocks_near(const BlocksByWinding& block_at, const RationalPoint& q) {
    Numbers blocks;
    const mpq_class tiny = 1 / mpq_class("1" + std::string(30, '0'));
    for (int i = 0; i < 6; ++i) {
        const RationalPoint off{(i * 37) % 41 - 20, (i * 23) % 43 - 21, (i * 29) % 47 - 23};
        if (const auto block = block_at(plus(q, off, tiny))) blocks.insert(*block);
    }
    return blocks;
}

Expected expected_log(const SectionModel& model, const WellPath& path) {
    const BlocksByWinding block_at(model);
    Expected made;
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
        const RationalPoint p = rational(path.points[i]);
        if (path.points[i] == path.points[i + 1]) continue;
        const RationalPoint d = minus_of(rational(path.points[i + 1]), p);
        const mpq_class deeper = mpq_class(path.depths[i + 1]) - mpq_class(path.depths[i]);
        const auto all = clips(model.mesh, p, d);
        std::set<mpq_class> stops{0, 1};
        for (const Clip& c : all) stops.insert({c.from, c.to});
        for (auto s = stops.begin(); s != stops.end(); ++s) {
            if (s != stops.begin()) {
                const auto before = std::prev(s);
                Piece piece{mpq_class(path.depths[i]) + *before * deeper,
                            mpq_class(path.depths[i]) + *s * deeper,
                            plus(p, d, *before),
                            plus(p, d, *s),
                            {},
                            {}};
                for (const Clip& c : all)
                    if (c.from <= *before && *s <= c.to)
                        add_surfaces(model.mesh, c.triangle, piece.surfaces);
                const RationalPoint middle = plus(p, d, (*before + *s) / 2);
                if (!piece.surfaces.empty())
                    piece.blocks = blocks_near(block_at, middle);
                else if (const auto block = block_at(middle))
                    piece.blocks = {*block};
                else
                    piece.is_known = false;
                made.pieces.push_back(piece);
            }
            if (s != stops.begin() || made.met.empty()) made.met.emplace_back();
            for (const Clip& c : all)
                if (c.from <= *s && *s <= c.to)
                    add_surfaces(model.mesh, c.triangle, made.met.back());
        }
    }
    return made;
}

struct Counts {
    int wells = 0, intervals = 0, upon = 0, markers = 0, unknown = 0;
};

void compare(const SectionModel& model, const WellPath& path, const WellLog& log, Counts& counts) {
    const Expected expected = expected_log(model, path);
    const auto numbers = [](const std::vector<std::uint32_t>& v) {
        return Numbers(v.begin(), v.end());
    };
    CHECK(log.intervals.front().from == path.depths.front());
    CHECK(log.intervals.back().to == path.depths.back());
    std::vector<const Piece*> first(log.intervals.size()), last(log.intervals.size());
    std::size_t at = 0;
    for (const Piece& piece : expected.pieces) {
        const auto fits = [&](const WellInterval& in) {
            return numbers(in.surfaces) == piece.surfaces &&
                   (!piece.is_known || std::ranges::includes(in.blocks, piece.blocks));
        };
        while (at + 1 < log.intervals.size() && log.intervals[at].to <= nearest(piece.from) &&
               (log.intervals[at].to < nearest(piece.to) || !fits(log.intervals[at])))
            ++at;
        const WellInterval& in = log.intervals[at];
        CHECK(in.from <= nearest(piece.from));
        CHECK(nearest(piece.to) <= in.to);
        CHECK(fits(in));
        if (piece.surfaces.empty()) CHECK(in.blocks.size() == 1);
        counts.unknown += piece.is_known ? 0 : 1;
        counts.upon += piece.surfaces.empty() ? 0 : 1;
        if (first[at] == nullptr) first[at] = &piece;
        last[at] = &piece;
    }
    CHECK(at + 1 == log.intervals.size());
    const auto rounded = [](const RationalPoint& p) {
        return Point3{nearest(p[0]), nearest(p[1]), nearest(p[2])};
    };
    for (std::size_t i = 0; i < log.intervals.size(); ++i) {
        REQUIRE(first[i] != nullptr);
        CHECK(log.intervals[i].from == nearest(first[i]->from));
        CHECK(log.intervals[i].to == nearest(last[i]->to));
        CHECK(log.intervals[i].entry == rounded(first[i]->entry));
        CHECK(log.intervals[i].exit == rounded(last[i]->exit));
    }
    for (std::size_t i = 1; i < log.intervals.size(); ++i) {
        const WellInterval &above = log.intervals[i - 1], &below = log.intervals[i];
        CHECK(above.to == below.from);
        CHECK(above.exit == below.entry);
        CHECK((above.blocks != below.blocks || above.surfaces != below.surfaces));
    }
    std::multiset<std::pair<double, std::uint32_t>> markers, met;
    for (const WellMarker& m : log.markers) markers.insert({m.depth, m.surface});
    for (std::size_t s = 0; s < expected.met.size(); ++s)
        for (const std::uint32_t surface : expected.met[s]) {
            const bool runs_on = s > 0 && s < expected.pieces.size() &&
                                 expected.pieces[s - 1].surfaces.contains(surface) &&
                                 expected.pieces[s].surfaces.contains(surface);
            const mpq_class depth = s == 0 ? expected.pieces[0].from : expected.pieces[s - 1].to;
            if (!runs_on) met.insert({nearest(depth), surface});
        }
    CHECK(markers == met);
    for (const WellMarker& m : log.markers) {
        CHECK(log.intervals[m.before].from <= m.depth);
        CHECK(m.depth <= log.intervals[m.after].to);
        CHECK((m.before == m.after || m.before + 1 == m.after));
    }
    ++counts.wells;
    counts.intervals += static_cast<int>(log.intervals.size());
    counts.markers += static_cast<int>(log.markers.size());
}

/// A path between vertices, lattice points and points in triangles.
WellPath random_path(ModelMaker& maker, const Mesh& mesh) {
    const auto any = [&](std::size_t count) {
        return static_cast<std::size_t>(random_int(maker.random, 0, static_cast<int>(count) - 1));
    };
    const auto point = [&] {
        const Triangle& t = mesh.triangles[any(mesh.triangles.size())];
        const auto corner = [&](std::size_t k) { return mesh.vertices[t[k]]; };
        const auto middle = [](const Point3& p, const Point3& q) {
            return Point3{(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2};
        };
        switch (any(5)) {
        case 0:
            return corner(0);
        case 1:
            return middle(corner(0), corner(1));
        case 2:
            return middle(corner(0), middle(corner(1), corner(2)));
        default:
            return maker.point(half + 1);
        }
    };
    WellPath path{"w", {}, {maker.number(3)}};
    const std::size_t kind = any(4), count = 2 + any(3);
    if (kind == 0) { // along a triangle's edges, and back
        const Triangle& t = mesh.triangles[any(mesh.triangles.size())];
        for (const std::size_t k : {0U, 1U, 2U, 1U}) path.points.push_back(mesh.vertices[t[k]]);
    } else {
        for (std::size_t i = 0; i < count; ++i) path.points.push_back(point());
        if (kind == 1) // vertical
            for (Point3& p : path.points) p = {path.points[0].x, path.points[0].y, p.z};
    }
    for (std::size_t i = 1; i < path.points.size(); ++i)
        path.depths.push_back(path.depths.back() + (path.points[i] == path.points[i - 1]
                                                        ? 0
                                                        : 0.25 + double(any(1000)) / 7));
    return path;
}

bool has_length(const WellPath& path) {
    return std::ranges::adjacent_find(path.points, std::not_equal_to()) != path.points.end();
}

} // namespace

TEST_CASE("wells: random paths against clipped triangles and winding numbers in rationals",
          "[once]") {
    Counts counts;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        ModelMaker maker(seed);
        const auto model = random_model(maker);
        if (!model) continue;
        std::vector<WellPath> paths;
        for (int k = 0; k < 4; ++k)
            if (auto path = random_path(maker, model->mesh); has_length(path))
                paths.push_back(std::move(path));
        const auto logs = log_wells(model->mesh, model->volumes, paths);
        REQUIRE(message_of(logs) == "no error");
        for (std::size_t k = 0; k < paths.size(); ++k) {
            INFO("seed " << seed << ", path " << k);
            compare(*model, paths[k], (*logs)[k], counts);
        }
        Run threads;
        threads.threads = 4;
        const auto again = log_wells(model->mesh, model->volumes, paths, threads);
        REQUIRE(again);
        for (std::size_t k = 0; k < paths.size(); ++k)
            CHECK((*again)[k].intervals.size() == (*logs)[k].intervals.size());
    }
    CHECK(counts.wells > 80);
    CHECK(counts.intervals > 250);
    CHECK(counts.upon > 40);
    CHECK(counts.markers > 250);
    CHECK(counts.unknown < counts.intervals / 20);
}

TEST_CASE("wells: models far from the origin") {
    Counts counts;
    for (std::uint64_t seed = 300; seed < 312; ++seed) {
        ModelMaker maker(seed);
        auto surfaces = maker.model();
        for (Surface& s : surfaces)
            for (Point3& p : s.vertices) p = {p.x + 500000, p.y + 5.25e6, p.z - 1234.5};
        const auto made =
            arrange_within(surfaces, *box_boundary({500000 - half, 5.25e6 - half, -1234.5 - half},
                                                   {500000 + half, 5.25e6 + half, -1234.5 + half}));
        REQUIRE(message_of(made) == "no error");
        if (!made->rounded.report.clean) continue;
        SectionModel model{*made->rounded.mesh, {}};
        model.volumes = *find_volumes(model.mesh);
        for (int k = 0; k < 4; ++k) {
            auto path = random_path(maker, model.mesh);
            for (Point3& p : path.points) // those on the lattice of the model at the origin
                if (p.x < 1000) p = {p.x + 500000, p.y + 5.25e6, p.z - 1234.5};
            if (!has_length(path)) continue;
            for (std::size_t i = 1; i < path.points.size(); ++i)
                path.depths[i] =
                    path.depths[i - 1] + (path.points[i] == path.points[i - 1] ? 0 : 1);
            const auto logs = log_wells(model.mesh, model.volumes, std::array{path});
            REQUIRE(message_of(logs) == "no error");
            INFO("seed " << seed << ", path " << k);
            compare(model, path, (*logs)[0], counts);
        }
    }
    CHECK(counts.wells > 25);
    CHECK(counts.upon > 8);
}
