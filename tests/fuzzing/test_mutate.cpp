// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/fuzzing/mutate.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "hash.hpp"

using namespace terrane::fuzzing;
using ByteVector = std::vector<std::uint8_t>;

namespace {

/// Two triangles that are far from each other.
Soup two_triangles(Bytes&) {
    Soup soup(2);
    add_triangle(soup[0], {{{0, 0, 0}, {4, 0, 1}, {0, 4, 2}}});
    add_triangle(soup[1], {{{10, 10, 17}, {13, 11, 12}, {11, 15, 14}}});
    return soup;
}

ByteVector mutated(ByteVector bytes, std::size_t most, unsigned seed, const Generator& generator) {
    const std::size_t size = bytes.size();
    bytes.resize(most);
    const std::size_t made = mutate(bytes.data(), size, most, seed, generator);
    REQUIRE(made <= most);
    bytes.resize(made);
    return bytes;
}

/// Counts of what changes are there for.
struct Seen {
    int onto_vertex = 0, onto_edge = 0, into_plane = 0, by_ulp = 0, fewer = 0, more = 0, turned = 0,
        torn = 0, literal = 0;
};

double six_volumes(const Point& a, const Point& b, const Point& c, const Point& p) {
    const Point u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z},
        w{p.x - a.x, p.y - a.y, p.z - a.z};
    return w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) +
           w.z * (u.x * v.y - u.y * v.x);
}

void look_at_points(const Soup& before, const Soup& after, Seen& seen) {
    const auto& old = before[0].points;
    for (const Point& p : after[1].points) {
        if (std::find(before[1].points.begin(), before[1].points.end(), p) !=
            before[1].points.end())
            continue;
        for (const Point& q : before[1].points) {
            const double off = std::abs(p.x - q.x) + std::abs(p.y - q.y) + std::abs(p.z - q.z);
            if (off < 1e-14) ++seen.by_ulp;
        }
        if (std::find(old.begin(), old.end(), p) != old.end()) {
            ++seen.onto_vertex;
        } else if (six_volumes(old[0], old[1], old[2], p) == 0) {
            const double u = p.x / 4,
                         v = p.y / 4; // old[0] + u (old[1] - old[0]) + v (old[2] - old[0])
            seen.into_plane += u != 0 && v != 0 && u + v != 1 ? 1 : 0;
            if (p == Point{2, 0, 0.5} || p == Point{0, 2, 1} || p == Point{2, 2, 1.5})
                ++seen.onto_edge;
        }
    }
}

} // namespace

TEST_CASE("fuzzing: mutations make degeneracy that bytes would hardly make") {
    Bytes none(nullptr, 0);
    const Soup before = two_triangles(none);
    Seen seen;
    for (unsigned seed = 0; seed < 4000; ++seed) {
        const auto bytes = mutated(literal(before), 4096, seed, two_triangles);
        if (!is_literal(bytes.data(), bytes.size())) continue; // no triangle was left
        ++seen.literal;
        const Soup after = mesh_of(bytes.data(), bytes.size(), two_triangles);
        REQUIRE(after.size() == 2);
        const std::size_t count = triangle_count(after);
        seen.fewer += count < 2 ? 1 : 0;
        seen.more += count > 2 ? 1 : 0;
        if (count == 2 && after[0].points == before[0].points &&
            after[0].triangles != before[0].triangles)
            ++seen.turned;
        seen.torn += after[1].points.size() > 3 ? 1 : 0;
        if (after[1].triangles.size() == 1) look_at_points(before, after, seen);
    }
    CHECK(seen.literal > 3900);
    for (const int times : {seen.onto_vertex, seen.onto_edge, seen.into_plane, seen.by_ulp,
                            seen.fewer, seen.more, seen.turned, seen.torn})
        CHECK(times >= 5);
}

TEST_CASE("fuzzing: a mutation depends on its seed alone, and keeps to the room that it has") {
    const Generator generator = [](Bytes& bytes) { return soup(bytes, 24); };
    std::size_t literals = 0;
    unsigned seed = 0;
    fuzzing_test::for_each_string([&](const ByteVector& string) {
        ++seed;
        const auto once = mutated(string, 300, seed, generator);
        CHECK(once == mutated(string, 300, seed, generator));
        literals += is_literal(once.data(), once.size()) ? 1 : 0;
        auto bytes = once;
        for (unsigned i = 0; i < 8; ++i) bytes = mutated(bytes, 300, seed + i, generator);
        CHECK(mutated(string, 0, seed, generator).empty());
    });
    CHECK(literals > 20);
    CHECK(literals < 350);
}

TEST_CASE("fuzzing: libFuzzer's own mutations are for bytes of a generator") {
    const ByteMutator mark = [](std::uint8_t* data, std::size_t, std::size_t) -> std::size_t {
        data[0] = 77;
        return 1;
    };
    unsigned marked = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        ByteVector bytes(4096);
        if (mutate(bytes.data(), 4, bytes.size(), seed, two_triangles, mark) == 1) {
            CHECK(bytes[0] == 77);
            ++marked;
        }
    }
    CHECK(marked > 20);
    CHECK(marked < 80);
}

TEST_CASE("fuzzing: a crossing has triangles of both meshes, and keeps to its room") {
    const Generator generator = [](Bytes& bytes) { return soup(bytes, 24); };
    Soup far(1);
    add_triangle(far[0], {{{100, 0, 0}, {101, 0, 0}, {100, 1, 0}}});
    Bytes none(nullptr, 0);
    const auto a = literal(two_triangles(none)), b = literal(far);
    unsigned both = 0, joined = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        ByteVector out(4096);
        out.resize(cross_over(a, b, out.data(), out.size(), seed, generator));
        const Soup made = mesh_of(out.data(), out.size(), generator);
        CHECK(triangle_count(made) <= 3);
        both += triangle_count(made) == 3 ? 1 : 0;
        for (const Part& part : made)
            for (const Point& p : part.points)
                joined += std::count(part.points.begin(), part.points.end(), p) > 1 ? 1 : 0;
        ByteVector small(100);
        CHECK(cross_over(a, b, small.data(), small.size(), seed, generator) <= small.size());
    }
    CHECK(both > 20);
    CHECK(joined > 10);
}

TEST_CASE("fuzzing: a flaw is found without coverage, and again with the same seed") {
    const Generator generator = [](Bytes& bytes) { return soup(bytes, 8); };
    const auto repeated = [](const Soup& soup) -> std::string {
        for (const Part& part : soup)
            for (const Triangle& t : part.triangles)
                if (std::count(part.triangles.begin(), part.triangles.end(), t) > 1)
                    return "a triangle with the same indices is there twice";
        return "";
    };
    const Finding found = find_flaw(generator, repeated, 100'000, 1);
    REQUIRE(found.flaw == "a triangle with the same indices is there twice");
    CHECK(!repeated(found.soup).empty());
    const Finding again = find_flaw(generator, repeated, 100'000, 1);
    CHECK(again.tried == found.tried);
    CHECK(again.soup == found.soup);
    const Finding none = find_flaw(
        generator, [](const Soup&) { return std::string(); }, 50, 1);
    CHECK(none.flaw.empty());
    CHECK(none.soup.empty());
    CHECK(none.tried == 50);
}

namespace {
Soup small_soup(Bytes& bytes) {
    return soup(bytes, 8);
}
} // namespace

TERRANE_FUZZING_MUTATORS(small_soup);

TEST_CASE("fuzzing: the functions that libFuzzer and AFL++ call") {
    ByteVector bytes(2000, 3);
    const std::size_t size = LLVMFuzzerCustomMutator(bytes.data(), 40, bytes.size(), 7);
    CHECK(size <= bytes.size());
    ByteVector other(2000);
    CHECK(LLVMFuzzerCustomCrossOver(bytes.data(), size, bytes.data(), 40, other.data(),
                                    other.size(), 7) <= other.size());
    void* state = afl_custom_init(nullptr, 5);
    bool literally = false;
    for (unsigned i = 0; i < 40; ++i) {
        std::uint8_t* out = nullptr;
        const std::size_t made =
            afl_custom_fuzz(state, bytes.data(), size, &out, other.data(), 50, 1000);
        REQUIRE(out != nullptr);
        CHECK(made <= 1000);
        literally = literally || is_literal(out, made);
    }
    CHECK(literally);
    afl_custom_deinit(state);
}
