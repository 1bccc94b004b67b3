// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests how the library handles helpers that break the protocol, and how the helper handles
// requests that make no sense.
#include <terrane/algorithms/tetgen/detail/process.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/tetgen/tetrahedra.hpp>

#include "support/impostor.hpp"

using namespace terrane;
using namespace impostor;

namespace {

Mesh square() {
    Mesh mesh{.surfaces = {{"sheet", Role::unknown}},
              .vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
              .triangles = {{0, 1, 2}, {0, 2, 3}},
              .surfaces_of = {},
              .regions_of = {},
              .parents_of = {},
              .intersection_edges = {}};
    for (int t = 0; t < 2; ++t) mesh.surfaces_of.push_back(std::array{0U});
    return mesh;
}

} // namespace

TEST_CASE("TetGen's helper: a reply that is as it should be is taken", "[tetrahedra][helper]") {
    const TetgenOutput truth = true_output();
    TetgenInput input = cube_input();
    const Impostor parrot(reply_of(truth), input);
    input.helper = parrot.path();
    const auto output = run_mesher(input, {});
    INFO((output ? "" : output.error().message()));
    REQUIRE(output);
    CHECK(output.value().points == truth.points);
    CHECK(output.value().tetrahedra == truth.tetrahedra);
    CHECK(output.value().faces == truth.faces);
    CHECK(output.value().face_facet == truth.face_facet);
}

TEST_CASE("TetGen's helper: a reply cut short is an error wherever it is cut",
          "[tetrahedra][helper]") {
    const std::string reply = reply_of(true_output());
    for (const std::size_t length : {std::size_t{0}, std::size_t{1}, sizeof(ReplyHeader) - 1,
                                     sizeof(ReplyHeader), reply.size() / 2, reply.size() - 1}) {
        INFO(length);
        const Impostor brief(reply.substr(0, length), cube_input());
        const Error error = brief.fails();
        CHECK(error.code == ErrorCode::internal);
        if (length == 0) CHECK(error.message() == "TetGen gave up");
        if (length > 0) CHECK(contains(error.sentence, "did not end as it should"));
    }
    const Error longer = Impostor(reply + "x", cube_input()).fails();
    CHECK(longer.code == ErrorCode::internal);
    CHECK(contains(longer.sentence, "says more than it should"));
}

TEST_CASE("TetGen's helper: garbage, other versions and giant lengths are refused at once",
          "[tetrahedra][helper]") {
    const auto error_of = [](const ReplyHeader& header) {
        return Impostor(bytes_of(header), cube_input(), "exec sleep 3600").fails();
    };
    const Error garbage = Impostor(std::string(1000, 'x'), cube_input(), "exec sleep 3600").fails();
    CHECK(garbage.code == ErrorCode::internal);
    CHECK(contains(garbage.sentence, "another language"));
    CHECK_FALSE(garbage.place.empty());
    ReplyHeader header;
    header.version = protocol_version + 1;
    CHECK(error_of(header).code == ErrorCode::unsupported);
    CHECK(contains(error_of(header).sentence, "another version"));
    for (const auto length : {&ReplyHeader::points, &ReplyHeader::tetrahedra, &ReplyHeader::faces})
        for (const std::uint64_t many :
             {most_items + 1, std::uint64_t{1} << 62U, ~std::uint64_t{0}}) {
            header = {};
            header.*length = many;
            const Error error = error_of(header);
            CHECK(error.code == ErrorCode::internal);
            CHECK(contains(error.sentence, "more than it can count"));
        }
    // The largest allowed number is announced, but no item comes: this must not cost memory either.
    header = {};
    header.points = most_items;
    const Error missing = Impostor(bytes_of(header), cube_input()).fails();
    CHECK(missing.code == ErrorCode::internal);
}

TEST_CASE("TetGen's helper: each status is its error", "[tetrahedra][helper]") {
    struct Expected {
        std::int32_t status;
        ErrorCode code;
    };
    for (const auto& [status, code] :
         {Expected{1, ErrorCode::out_of_memory}, Expected{2, ErrorCode::internal},
          Expected{3, ErrorCode::unsupported}, Expected{4, ErrorCode::unsupported},
          Expected{5, ErrorCode::unsupported}, Expected{10, ErrorCode::internal},
          Expected{unknown_exception, ErrorCode::internal},
          Expected{bad_request, ErrorCode::internal},
          Expected{other_version, ErrorCode::unsupported}, Expected{-7, ErrorCode::internal}}) {
        INFO(status);
        ReplyHeader header;
        header.status = status;
        const Impostor refusing(bytes_of(header), cube_input());
        CHECK(refusing.fails().code == code);
    }
}

TEST_CASE("TetGen's helper: forged numbers never become tetrahedra", "[tetrahedra][helper]") {
    // The domain of square() in a box: TetGen's true output, then the output with one number
    // changed.
    const Mesh mesh = square();
    const Box3 box{{-1, -1, -1}, {2, 2, 2}};
    TetgenInput input;
    input.points = mesh.vertices;
    for (unsigned k = 0; k < 8; ++k)
        input.points.push_back({k & 1U ? 2.0 : -1, k & 2U ? 2.0 : -1, k & 4U ? 2.0 : -1});
    for (Point3& p : input.points) p = {p.x / 4, p.y / 4, p.z / 4}; // coordinates are at most 1
    for (const Triangle& t : mesh.triangles) input.facets.push_back(t);
    for (const auto& side : std::array<std::array<std::uint32_t, 4>, 6>{{{4, 8, 10, 6},
                                                                         {5, 7, 11, 9},
                                                                         {4, 5, 9, 8},
                                                                         {6, 10, 11, 7},
                                                                         {4, 6, 7, 5},
                                                                         {8, 9, 11, 10}}})
        input.facets.push_back(side);
    input.helper = find_tetgen_helper().value();
    const auto truth = run_mesher(input, {});
    REQUIRE(truth);
    const auto outcome = [&](const TetgenOutput& output) {
        const Impostor forger(reply_of(output), input);
        return tetrahedralize(mesh, {.mesher = Mesher::tetgen, .box = box, .helper = forger.path()},
                              {});
    };
    const auto control = outcome(truth.value());
    INFO((control ? "" : control.error().message()));
    REQUIRE(control); // so that each failure below is due to its one change

    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<TetgenOutput> forged(9, truth.value());
    forged[0].points[0].x = nan;
    forged[1].points.push_back({nan, 0, 0});
    forged[2].points.push_back({0, -std::numeric_limits<double>::infinity(), 0});
    forged[3].points.resize(11);
    forged[4].tetrahedra[0][0] = 4'000'000'000U;
    forged[5].faces[0][1] = static_cast<std::uint32_t>(forged[5].points.size());
    forged[6].face_facet[0] = 1'000'000;
    forged[7].tetrahedra.clear();
    std::swap(forged[8].tetrahedra[0], forged[8].tetrahedra[1]);
    forged[8].tetrahedra[1] = forged[8].tetrahedra[0];
    for (std::size_t i = 0; i < forged.size(); ++i) {
        INFO(i);
        CHECK_FALSE(outcome(forged[i]));
    }
}

TEST_CASE("TetGen's helper: one that is broken is asked once, one whose TetGen fails in all ways",
          "[tetrahedra][helper]") {
    const auto starts_of = [](const std::string& lines, ErrorCode code) {
        const Impostor impostor("echo >>\"${0%/*}/starts\"\n" + lines);
        const auto made =
            tetrahedralize(square(), {.mesher = Mesher::tetgen, .helper = impostor.path()}, {});
        REQUIRE_FALSE(made);
        CHECK(made.error().code == code);
        std::ifstream starts(impostor.path().parent_path() / "starts");
        return std::count(std::istreambuf_iterator<char>(starts), {}, '\n');
    };
    CHECK(starts_of("printf %0100d 0", ErrorCode::internal) == 1);
    CHECK(starts_of("echo broken >&2; exit 127", ErrorCode::cannot_open) == 1);
    CHECK(starts_of("kill -KILL $$", ErrorCode::out_of_memory) == 1);
    CHECK(starts_of("kill -SEGV $$", ErrorCode::unsupported) == 8);
}

TEST_CASE("TetGen's helper: where it never ends with a bound on shapes, it is asked without",
          "[tetrahedra][helper]") {
    // The first start never ends; the next is the helper.
    const Impostor slow("echo >>\"${0%/*}/starts\"\n"
                        "[ \"$(wc -l <\"${0%/*}/starts\")\" -gt 1 ] || exec sleep 3600\nexec '" +
                        find_tetgen_helper().value().string() + "' \"$@\"");
    const auto made = tetrahedralize(square(),
                                     {.mesher = Mesher::tetgen,
                                      .radius_edge_ratio = 2,
                                      .time_limit = 20, // of which the bound has a tenth
                                      .helper = slow.path()},
                                     {});
    INFO((made ? "" : made.error().message()));
    REQUIRE(made);
    CHECK(contains(made->failure, "gave no result in its time, so it was asked without"));
    std::ifstream starts(slow.path().parent_path() / "starts");
    CHECK(std::count(std::istreambuf_iterator<char>(starts), {}, '\n') == 2);
}

TEST_CASE("TetGen's helper: it refuses requests that make no sense", "[tetrahedra][helper]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<TetgenInput> bad(7, cube_input());
    bad[0].points[3].y = nan;
    bad[1].facets.values[5] = 8;
    bad[2].facets.offsets[2] = 1000;
    bad[3].facets.offsets = {0, 2, 24};
    bad[4].max_volume = nan;
    bad[5].max_areas = {1, 2};
    bad[6].blocks.push_back({{0.5, nan, 0.5}, 1});
    for (std::size_t i = 0; i < bad.size(); ++i) {
        INFO(i);
        bad[i].helper = find_tetgen_helper().value();
        const auto output = run_mesher(bad[i], {});
        REQUIRE_FALSE(output);
        CHECK(output.error().code == ErrorCode::internal);
        CHECK(contains(output.error().sentence, "did not understand"));
    }
}
