// SPDX-License-Identifier: LGPL-3.0-or-later
//
// An arrangement in tiles is that of one process: its triangles, numbers, regions and digest.
#include "support/certified_inputs.hpp"
#include "support/differences.hpp"
#include "support/files.hpp"
#include "support/in_tiles.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/tiles/local_supersteps.hpp>
#include <terrane/algorithms/tiles/pieces.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <stop_token>

namespace {

using namespace terrane;
using namespace terrane::tiles;
using test_support::arranged;
using test_support::joined;
using test_support::waves;

void require_same(const Mesh& found, const Mesh& expected) {
    CHECK(test_support::difference(found, expected) == "");
}

/// Triangles on a small lattice: they overlap, repeat each other, and some have no area.
std::vector<Surface> lattice_soup(unsigned seed) {
    std::mt19937 random(seed);
    const auto coordinate = [&] { return static_cast<double>(random() % 4); };
    std::vector<Surface> surfaces{{"a", Role::unknown, {}, {}}, {"b", Role::unknown, {}, {}}};
    for (Surface& s : surfaces)
        for (std::uint32_t t = 0; t < 12; ++t) {
            for (unsigned i = 0; i < 3; ++i) {
                const double x = coordinate(), y = coordinate();
                s.vertices.push_back({x, y, random() % 3 == 0 ? coordinate() : 0});
            }
            s.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        }
    return surfaces;
}

} // namespace

TEST_CASE("tiles: certified cases have the digest of one process in any number of tiles",
          "[tiles][once]") {
    for (const auto& model : test_support::certified_inputs(300)) {
        CAPTURE(model.name);
        const auto exact = arrange(model.surfaces);
        REQUIRE(exact);
        const auto digest = canonical_digest(model.surfaces, *exact);
        const auto rounded = round_to_doubles(*exact);
        REQUIRE(rounded);
        for (const std::size_t count : {1, 2, 3, 4, 7}) {
            CAPTURE(count);
            const Run run;
            LocalSupersteps tiles({count, {}}, run);
            const auto report = arranged(tiles, model.surfaces);
            CHECK(report.digest == digest);
            if (!report.repair) {
                CHECK(report.intersection_edges == exact->intersection_edges.size());
                CHECK(report.vertices == exact->vertices.size());
                CHECK(report.triangles == exact->triangles.size());
            }
            REQUIRE(report.clean);
            if (rounded->report.naive_contacts > 0) CHECK(report.repair);
            if (rounded->report.arranged_again) CHECK(report.repair->is_moved);
            CHECK(report.regions == rounded->regions.size());
            require_same(joined(tiles, report), rounded->mesh);
        }
    }
}

TEST_CASE("tiles: soups on a lattice, with overlaps, repeated triangles and ones without area",
          "[tiles]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        const auto surfaces = lattice_soup(seed);
        const auto exact = arrange(surfaces);
        REQUIRE(exact);
        for (const std::size_t count : {2, 5}) {
            const Run run;
            LocalSupersteps tiles({count, {}}, run);
            const auto report = arranged(tiles, surfaces);
            CHECK(report.digest == canonical_digest(surfaces, *exact));
            if (!report.clean) continue;
            const auto rounded = round_to_doubles(*exact);
            REQUIRE(rounded);
            require_same(joined(tiles, report), rounded->mesh);
        }
    }
}

TEST_CASE("tiles in files, in threads and in memory do the same", "[tiles]") {
    const auto surfaces = waves(40, 0.0123);
    const test_support::TemporaryFolder folder;
    const Run alone, several{.threads = 2};
    LocalSupersteps in_memory({5, {}}, alone), in_threads({5, {}}, several),
        in_files({5, folder.path()}, alone);
    const auto expected = arranged(in_memory, surfaces);
    const Mesh mesh = joined(in_memory, expected);
    for (Supersteps* tiles :
         {static_cast<Supersteps*>(&in_threads), static_cast<Supersteps*>(&in_files)}) {
        const auto report = arranged(*tiles, surfaces);
        CHECK(report.digest == expected.digest);
        CHECK(report.total.bytes == expected.total.bytes);
        CHECK(report.total.messages == expected.total.messages);
        require_same(joined(*tiles, report), mesh);
    }
}

TEST_CASE("tiles balance, and each pair is decided once", "[tiles]") {
    const auto surfaces = waves(100, 0.0123);
    const Run run;
    LocalSupersteps one({1, {}}, run), eight({8, {}}, run);
    const auto whole = arranged(one, surfaces), parts = arranged(eight, surfaces);
    CHECK(parts.total.improper == whole.total.improper);
    CHECK(parts.total.owned == whole.total.owned);
    CHECK(parts.total.divided == whole.total.divided);
    CHECK(static_cast<double>(parts.largest.owned) <=
          1.25 * static_cast<double>(whole.total.owned) / 8);
}

TEST_CASE("tiles: an error of one tile is that of the whole", "[tiles]") {
    const Run run;
    LocalSupersteps tiles({3, {}}, run);
    const auto read = [](std::size_t file) -> Result<std::vector<Surface>> {
        if (file == 1) return Error{ErrorCode::cannot_open, "it is not there", "b.ts"};
        return std::vector<Surface>{{"a", Role::unknown, {{0, 0, 0}}, {}}};
    };
    const auto report = arrange_in_tiles(tiles, read, {3, false});
    REQUIRE_FALSE(report);
    CHECK(report.error().code == ErrorCode::cannot_open);
    CHECK(report.error().place == "b.ts");
}

TEST_CASE("tiles: a lack of memory in one tile ends the arrangement", "[tiles]") {
    const Run run;
    LocalSupersteps tiles({2, {}}, run);
    const auto read = [](std::size_t) -> Result<std::vector<Surface>> { throw std::bad_alloc(); };
    const auto report = arrange_in_tiles(tiles, read, {1, false});
    REQUIRE_FALSE(report);
    CHECK(report.error().code == ErrorCode::out_of_memory);
}

TEST_CASE("tiles: what the first tile can't gather is repaired in one process", "[tiles]") {
    std::size_t left = 0, moved = 0;
    for (const auto& model : test_support::certified_inputs(300)) {
        const auto rounded = round_to_doubles(*arrange(model.surfaces));
        REQUIRE(rounded);
        CAPTURE(model.name);
        for (const std::size_t count : {3, 20}) {
            const Run run;
            LocalSupersteps tiles({count, {}}, run);
            const auto report = arranged(tiles, model.surfaces, 1);
            if (report.clean) continue;
            const auto whole = repair_in_one_process(tiles);
            REQUIRE(whole);
            require_same(whole->piece.mesh, rounded->mesh);
            ++left;
            moved += rounded->report.arranged_again ? 1 : 0;
        }
    }
    CHECK(left > moved);
    CHECK(moved > 0);
}

TEST_CASE("tiles: pieces that do not fit together are refused", "[tiles]") {
    const auto surfaces = waves(4, 0.1);
    const Run run;
    LocalSupersteps tiles({2, {}}, run);
    const auto report = arranged(tiles, surfaces);
    std::vector<TilePiece> pieces;
    REQUIRE(tiles.visit([&](Tile& b) -> Status {
        pieces.push_back(piece_of(b));
        return Done{};
    }));
    const auto join = [&](std::size_t vertices, std::size_t triangles,
                          const std::vector<TilePiece>& all) -> Status {
        PieceJoiner joiner(vertices, triangles);
        for (const TilePiece& piece : all)
            if (auto added = joiner.add(piece); !added) return added;
        auto mesh = std::move(joiner).finish();
        if (!mesh) return mesh.error();
        return Done{};
    };
    CHECK(join(report.vertices, report.triangles, pieces));
    CHECK_FALSE(join(report.vertices, report.triangles, {pieces[0]}));
    CHECK_FALSE(join(report.vertices, report.triangles, {pieces[0], pieces[1], pieces[1]}));
    CHECK_FALSE(join(report.vertices - 1, report.triangles, pieces));
    auto moved = pieces;
    for (Point3& p : moved[1].mesh.vertices) p.x += 1;
    CHECK_FALSE(join(report.vertices, report.triangles, moved));
    auto short_lists = pieces;
    short_lists[0].triangle_ids.pop_back();
    CHECK_FALSE(join(report.vertices, report.triangles, short_lists));
    auto wild = pieces;
    wild[0].mesh.triangles[0][1] = UINT32_MAX;
    CHECK_FALSE(join(report.vertices, report.triangles, wild));
}

TEST_CASE("tiles: after a stop no further tile is visited", "[tiles]") {
    const test_support::TemporaryFolder folder;
    for (const std::filesystem::path& spool : {std::filesystem::path(), folder.path()}) {
        std::stop_source source;
        Run run;
        run.stop = source.get_token();
        LocalSupersteps tiles({3, spool}, run);
        REQUIRE(tiles.visit([](Tile&) { return Done{}; }));
        unsigned visited = 0;
        const auto done = tiles.visit([&](Tile&) -> Status {
            ++visited;
            source.request_stop();
            return Done{};
        });
        REQUIRE_FALSE(done);
        CHECK(done.error().code == ErrorCode::interrupted);
        CHECK_FALSE(tiles.relay([&](Tile&, Bytes) {
            ++visited;
            return Bytes{};
        }));
        CHECK_FALSE(tiles.step("any", [&](Tile&, Inbox&, Outbox&) -> Status {
            ++visited;
            return Done{};
        }));
        CHECK(visited == 1);
    }
}

TEST_CASE("tiles: what is on the disk has no name, and few files are open", "[tiles]") {
    const test_support::TemporaryFolder folder;
    const std::filesystem::path open_files("/proc/self/fd");
    const std::size_t before = test_support::entries(open_files);
    const Run run;
    {
        constexpr std::uint32_t count = 600;
        LocalSupersteps tiles({count, folder.path()}, run);
        const auto send = [&](Tile& b, Inbox&, Outbox& out) -> Status {
            b.names.assign(b.index, 'x');
            for (const std::uint32_t to : {b.index, count - 1 - b.index})
                out.put(to, b.index % channels, b.index);
            CHECK(test_support::entries(folder.path()) == 0);
            CHECK(test_support::entries(open_files) <= before + 3);
            return Done{};
        };
        std::size_t received = 0;
        const auto receive = [&](Tile& b, Inbox& in, Outbox&) -> Status {
            CHECK(b.names.size() == b.index);
            for (std::size_t c = 0; c < channels; ++c)
                in.take<std::uint32_t>(c, [&](std::uint32_t from, std::uint32_t sent) {
                    CHECK(from == sent);
                    CHECK((from == b.index || from == count - 1 - b.index));
                    ++received;
                });
            return Done{};
        };
        for (std::size_t round = 0; round < 2; ++round) {
            REQUIRE(tiles.step("send", send));
            REQUIRE(tiles.step("receive", receive));
        }
        CHECK(received == 4 * count);
    }
    CHECK(test_support::entries(open_files) == before);
}

TEST_CASE("tiles: without a folder for what is on the disk, no step is done", "[tiles]") {
    const test_support::TemporaryFolder folder;
    const Run run;
    LocalSupersteps tiles({2, folder / "missing"}, run);
    bool visited = false;
    const auto visit = [&](Tile&) -> Status {
        visited = true;
        return Done{};
    };
    const auto done = tiles.visit(visit);
    REQUIRE_FALSE(done);
    CHECK(done.error().code == ErrorCode::cannot_open);
    CHECK(done.error().place == (folder / "missing").string());
    CHECK_FALSE(tiles.step("any", [&](Tile& b, Inbox&, Outbox&) { return visit(b); }));
    CHECK_FALSE(visited);
}
