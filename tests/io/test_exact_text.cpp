// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/certified_inputs.hpp"
#include "support/files.hpp"

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/exact_text.hpp>

#include <catch2/catch.hpp>

#include <gmpxx.h>

using namespace terrane;

namespace {

std::vector<Surface> pierced_sheet() {
    return {{"top reservoir", Role::horizon, {{0, 0, 0}, {7, 1, 0}, {1, 9, 0}}, {{0, 1, 2}}},
            {"F1", Role::fault, {{2, 1, -3}, {3, 7, -1}, {2.5, 3, 5}}, {{0, 1, 2}}}};
}

ExactText exact_of(std::span<const Surface> surfaces) {
    const auto a = arrange(surfaces);
    REQUIRE(a);
    return to_exact(a.value());
}

Error error_of(const std::string& text) {
    const auto read = read_exact(text, "e.txt");
    REQUIRE_FALSE(read);
    return read.error();
}

} // namespace

TEST_CASE("exact text: as documented") {
    const auto text = to_text(exact_of(pierced_sheet()));
    CHECK(text.starts_with("terrane-exact 1\nsurfaces 2\nhorizon 1 top reservoir\nfault 1 F1\n"
                           "vertices 8\n0 0 0\n7 1 0\n1 9 0\n2 1 -3\n3 7 -1\n5/2 3 5\n"));
    CHECK(text.find("\ntriangles 8\n") != std::string::npos);
    CHECK(text.ends_with("\nintersection_edges 1\n6 7\nend\n"));
}

TEST_CASE("exact text: read as it was written, all models") {
    for (const auto& model : test_support::certified_inputs()) {
        INFO(model.name);
        const auto exact = exact_of(model.surfaces);
        const auto read = read_exact(to_text(exact), "e.txt");
        REQUIRE(read);
        CHECK(read.value() == exact);
    }
}

TEST_CASE("exact text: the fractions are the points: the new ones lie in both planes") {
    const auto exact = exact_of(pierced_sheet());
    REQUIRE(exact.vertices.size() == 8);
    for (std::size_t v = 6; v < 8; ++v) {
        const mpq_class x(exact.vertices[v][0]), y(exact.vertices[v][1]), z(exact.vertices[v][2]);
        CHECK(z == 0);
        // The plane through (2,1,-3) along (1,6,2) and (0.5,2,8) has the normal (44,-7,-1).
        CHECK(44 * (x - 2) - 7 * (y - 1) - (z + 3) == 0);
    }
}

TEST_CASE("exact text: through a file, and threads make no difference") {
    const auto a = arrange(pierced_sheet());
    REQUIRE(a);
    CHECK(to_exact(a.value(), {.threads = 2}) == to_exact(a.value()));
    const test_support::TemporaryFolder folder;
    const auto path = folder / "exact.txt";
    REQUIRE(write_file(path, to_text(to_exact(a.value()))));
    const auto read = read_exact(read_file(path).value(), path.string());
    REQUIRE(read);
    CHECK(read.value() == to_exact(a.value()));
}

TEST_CASE("exact text: what is wrong is refused with its line") {
    const auto right = to_text(exact_of(pierced_sheet()));
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = right;
        text.replace(text.find(from), from.size(), to);
        return text;
    };
    CHECK(error_of("terrane-exact 2\n").place == "e.txt:1");
    CHECK(error_of("").code == ErrorCode::bad_syntax);
    CHECK(error_of(with("surfaces 2", "surfaces two")).place == "e.txt:2");
    CHECK(error_of(with("horizon 1", "sea 1")).place == "e.txt:3");
    for (const char* number :
         {"2.5", "5/1", "05/2", "5/0", "-0", "+5/2", "5/02", "/2", "5/", "x"}) {
        const auto error = error_of(with("\n5/2 3 5\n", "\n" + std::string(number) + " 3 5\n"));
        CHECK(error.code == ErrorCode::bad_number);
        CHECK(error.place == "e.txt:11");
    }
    CHECK(error_of(with("\n6 7\nend", "\n7 6\nend")).code == ErrorCode::bad_index);
    CHECK(error_of(with("\n6 7\nend", "\n6 8\nend")).code == ErrorCode::bad_index);
    CHECK(error_of(with("edges 1\n", "edges 2\n")).code == ErrorCode::bad_syntax);
    for (std::size_t cut = 0; cut + 2 < right.size(); ++cut)
        CHECK_FALSE(read_exact(right.substr(0, cut), "e.txt"));
}
