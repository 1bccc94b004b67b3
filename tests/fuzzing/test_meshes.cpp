// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/fuzzing/meshes.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "hash.hpp"

using namespace terrane::fuzzing;
using fuzzing_test::for_each_string;

namespace {

__extension__ using Wide = __int128;

std::uint64_t hash_of(const Generator& generator) {
    fuzzing_test::Hash hash;
    for_each_string([&](const std::vector<std::uint8_t>& string) {
        Bytes bytes(string.data(), string.size());
        hash.add(generator(bytes));
    });
    return hash.value();
}

Generator at_most(Soup (*generator)(Bytes&, std::size_t), std::size_t most) {
    return [=](Bytes& bytes) { return generator(bytes, most); };
}

/// Returns six times the volume within a closed part.
double six_volumes(const Part& part) {
    double sum = 0;
    for (const Triangle& t : part.triangles) {
        const Point &a = part.points[t[0]], &b = part.points[t[1]], &c = part.points[t[2]];
        sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
               a.z * (b.x * c.y - b.y * c.x);
    }
    return sum;
}

/// Tells whether each directed edge has its opposite as often.
bool is_closed(const Part& part) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : part.triangles)
        for (unsigned i = 0; i < 3; ++i) {
            ++edges[{t[i], t[(i + 1) % 3]}];
            --edges[{t[(i + 1) % 3], t[i]}];
        }
    return std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; });
}

/// Tells whether a point is inside, where no edge is right above it: counts the triangles above.
bool is_inside(const Part& part, const Point& p) {
    bool inside = false;
    for (const Triangle& t : part.triangles) {
        const Point &a = part.points[t[0]], &b = part.points[t[1]], &c = part.points[t[2]];
        const auto side = [&](const Point& from, const Point& to) {
            return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x) > 0;
        };
        if (side(a, b) != side(b, c) || side(b, c) != side(c, a)) continue;
        if (a.z == b.z && b.z == c.z && a.z > p.z) inside = !inside;
    }
    return inside;
}

} // namespace

TEST_CASE("fuzzing: the same bytes give the same mesh in every version") {
    // Never change these numbers: the seeds of others would become other meshes.
    CHECK(hash_of(at_most(soup, 8)) == 0xd812a6816cb75f54U);
    CHECK(hash_of(at_most(soup, 14)) == 0x02253f9d60fb4d19U);
    CHECK(hash_of(at_most(soup, 24)) == 0xef12570014772a3dU);
    CHECK(hash_of(at_most(crowd, 110)) == 0xe9445c36da71102aU);
    CHECK(hash_of(at_most(near_plane, 20)) == 0x650b86ed2e98696eU);
    CHECK(hash_of([](Bytes& bytes) { return solids(bytes, 500).operands; }) == 0x97ec1dfd0c3da272U);
    CHECK(hash_of(at_most(any_mesh, 50)) == 0x6e3dfd8dea8e6b1eU);
}

TEST_CASE(
    "fuzzing: meshes have finite points, indices in range and no more triangles than asked for") {
    for (const auto generator : {soup, crowd, near_plane, any_mesh})
        for_each_string([&](const std::vector<std::uint8_t>& string) {
            Bytes bytes(string.data(), string.size());
            const Soup made = generator(bytes, 24);
            CHECK(triangle_count(made) <= 24);
            for (const Part& part : made) {
                for (const Point& p : part.points) CHECK(std::isfinite(p.x + p.y + p.z));
                for (const Triangle& t : part.triangles)
                    CHECK(*std::max_element(t.begin(), t.end()) < part.points.size());
            }
        });
}

TEST_CASE("fuzzing: a literal mesh is read as it was written, and any bytes are one") {
    const Generator none = [](Bytes&) -> Soup { throw 0; };
    for_each_string([&](const std::vector<std::uint8_t>& string) {
        Bytes bytes(string.data(), string.size());
        const Soup made = soup(bytes, 24);
        const auto text = literal(made);
        REQUIRE(is_literal(text.data(), text.size()));
        const Soup read = mesh_of(text.data(), text.size(), none);
        fuzzing_test::Hash before, after; // == does not tell -0 from 0
        before.add(made);
        after.add(read);
        CHECK(before.value() == after.value());
        auto damaged = text;
        for (std::size_t i = 4; i < damaged.size() && i - 4 < string.size(); ++i)
            damaged[i] = string[i - 4];
        for (const Part& part : mesh_of(damaged.data(), damaged.size(), none)) {
            for (const Point& p : part.points) CHECK(std::isfinite(p.x * 0 + p.y * 0 + p.z * 0));
            for (const Triangle& t : part.triangles)
                CHECK(*std::max_element(t.begin(), t.end()) < part.points.size());
        }
    });
    const std::vector<std::uint8_t> bytes{1, 2, 3};
    CHECK(mesh_of(bytes.data(), bytes.size(), [](Bytes& b) { return Soup(b.byte()); }).size() == 1);
}

TEST_CASE("fuzzing: an OBJ file numbers the points of all parts") {
    Soup two(2);
    for (Part& part : two) add_triangle(part, {{{0, 0, 0}, {1, 0, 0}, {0, 0.1, -0.0}}});
    CHECK(obj_text(two) == "v 0 0 0\nv 1 0 0\nv 0 0.10000000000000001 -0\ng a\nf 1 2 3\n"
                           "v 0 0 0\nv 1 0 0\nv 0 0.10000000000000001 -0\ng b\nf 4 5 6\n");
}

TEST_CASE("fuzzing: solids are closed, oriented outward, and have the volumes that are stated") {
    std::size_t with_holes = 0, nested = 0, touching = 0, apart = 0;
    for_each_string([&](const std::vector<std::uint8_t>& string) {
        Bytes bytes(string.data(), string.size());
        const Solids made = solids(bytes, 500);
        REQUIRE(made.operands.size() == 2);
        CHECK(triangle_count(made.operands) <= 500);
        for (std::size_t i = 0; i < 2; ++i) {
            const Part& part = made.operands[i];
            CHECK(is_closed(part));
            if (made.exact && std::abs(made.exponent) < 300) // else it is beyond doubles
                CHECK(six_volumes(part) == 6 * std::ldexp(made.volumes[i], 3 * made.exponent));
            with_holes += part.triangles.size() / 2 > part.points.size() ? 1 : 0;
            nested += part.triangles.size() == 420 ? 1 : 0;
        }
        touching += made.volumes[3] > 0 ? 1 : 0;
        apart += made.volumes[3] == 0 ? 1 : 0;
        CHECK(made.volumes[2] == made.volumes[0] + made.volumes[1] - made.volumes[3]);
    });
    CHECK(with_holes > 10);
    CHECK(touching > 10);
    CHECK(apart > 10);
}

TEST_CASE("fuzzing: what solids share is what points are in both of") {
    unsigned state = 1;
    for (unsigned i = 0; i < 12; ++i) {
        std::vector<std::uint8_t> string{0}; // the lattice itself
        for (unsigned k = 0; k < 14; ++k) {
            state = state * 75 % 65537;
            string.push_back(static_cast<std::uint8_t>(state));
        }
        string[4] &= 7; // no shear
        Bytes bytes(string.data(), string.size());
        const Solids made = solids(bytes, 1000);
        REQUIRE(made.exact);
        std::array<double, 6> counted{};
        for (int x = -8; x < 18; ++x)
            for (int y = -8; y < 18; ++y)
                for (int z = -8; z < 18; ++z) {
                    const Point p{x + 0.3, y + 0.6, z + 0.5};
                    const bool a = is_inside(made.operands[0], p),
                               b = is_inside(made.operands[1], p);
                    const std::array<bool, 6> in{a, b, a || b, a && b, a && !b, a != b};
                    for (std::size_t k = 0; k < 6; ++k) counted[k] += in[k] ? 1 : 0;
                }
        CHECK(counted == made.volumes);
    }
}

TEST_CASE("fuzzing: nearly coplanar corners are integers of 22 bits times a power of two") {
    std::size_t flat = 0, nearly = 0;
    for_each_string([&](const std::vector<std::uint8_t>& string) {
        Bytes ahead(string.data(), string.size()), bytes = ahead;
        const int exponent = ahead.between(-60, 60);
        std::vector<std::array<std::int64_t, 3>> points;
        for (const Part& part : near_plane(bytes, 10))
            for (const Point& p : part.points) {
                std::array<std::int64_t, 3> integers{};
                unsigned k = 0;
                for (const double x : {p.x, p.y, p.z}) {
                    const double integer = std::ldexp(x, -exponent);
                    REQUIRE(integer == std::round(integer));
                    REQUIRE(std::abs(integer) < 0x1p21);
                    integers[k++] = static_cast<std::int64_t>(integer);
                }
                points.push_back(integers);
            }
        for (std::size_t i = 0; i + 3 < points.size(); i += 3) {
            const auto d = [&](std::size_t j, unsigned k) {
                return static_cast<Wide>(points[i + j][k] - points[i][k]);
            };
            const auto minor = [&](std::size_t j, std::size_t l, unsigned k) {
                return d(j, (k + 1) % 3) * d(l, (k + 2) % 3) -
                       d(j, (k + 2) % 3) * d(l, (k + 1) % 3);
            };
            const Wide six_volume =
                d(1, 0) * minor(2, 3, 0) + d(1, 1) * minor(2, 3, 1) + d(1, 2) * minor(2, 3, 2);
            ++(six_volume == 0 ? flat : nearly);
            // Corners are at most half an integer off the plane: far flatter than random points would be.
            CHECK(std::abs(static_cast<double>(six_volume)) < 0x1p46);
        }
    });
    CHECK(nearly > flat);
}
