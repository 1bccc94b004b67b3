// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Triangles that may vanish: an input triangle that is thinner than half the stated deviation, and
// whose sides are within a quarter of it of the mesh. Certificates from which a triangle was
// removed are judged on both sides of each bound.
#include "support/forged.hpp"

namespace {

using namespace forged;

/// A needle next to a sheet, which meets nothing.
struct Needle {
    double height = 2e-6; ///< above the sheet
    double width = 4e-6;  ///< at its end
    double end = 5;       ///< the sheet reaches to 8, less 1.5 there
    std::string rest{};   ///< further faces of the sheet's surface
};

/// Returns the certificate of a sheet and a needle, without a file of the mesh.
Subject with_needle(const Needle& n) {
    const Surface sheet{"sheet", Role::unknown, {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 1, 2}}};
    const Surface needle{
        "needle",
        Role::unknown,
        {{1, 1.5, n.height}, {n.end, 1.5, n.height}, {n.end, 1.5 + n.width, n.height}},
        {{0, 1, 2}}};
    return subject({{"in.obj", obj_text({sheet, needle})}}, {});
}

/// Removes what is left of an input triangle, and lists it as vanished.
void remove(Subject& s, int input, double deviation) {
    Json& r = s.certificate["rounded"];
    drop_children(r, {input});
    r["vanished"] = {input};
    r["max_move"] = nullptr;
    r["deviation"] = decimal_text(deviation);
    seal(s);
}

std::string judged_without(const Needle& needle, double deviation,
                           const VerifyOptions& options = {.max_deviation = 1.07e-5}) {
    Subject s = with_needle(needle);
    REQUIRE(judged(s) == "");
    remove(s, 1, deviation);
    return judged(s, options);
}

} // namespace

TEST_CASE("verify_certificate: a needle may vanish that is thin and beside the mesh") {
    constexpr double deviation = 1e-5; // a quarter of it is 2.5e-6
    CHECK(judged_without({}, deviation).empty());
    CHECK(judged_without({.height = 2.49e-6}, deviation).empty());
    CHECK(judged_without({.height = -2.49e-6}, deviation).empty());
    CHECK(judged_without({.width = 4.99e-6}, deviation).empty());
    CHECK(judged_without({.end = 6.4}, deviation).empty());
}

TEST_CASE("verify_certificate: no triangle may vanish that is not thin, or not beside the mesh") {
    constexpr double deviation = 1e-5;
    CHECK(judged_without({.height = 2.51e-6}, deviation) == "R12");
    CHECK(judged_without({.height = -1e-3}, deviation) == "R12");
    CHECK(judged_without({.width = 5.01e-6}, deviation) == "R12");
    CHECK(judged_without({.width = 1}, deviation) == "R12");
    CHECK(judged_without({.end = 6.6}, deviation) == "R12"); // its tip is beyond the sheet
    CHECK(judged_without({.end = 100}, deviation) == "R12");
    // The stated deviation decides, up to the accepted one.
    CHECK(judged_without({}, 7e-6) == "R12");
    CHECK(judged_without({}, 2e-5) == "R13");
    CHECK(judged_without({}, 2e-5, {.max_deviation = 2e-5}).empty());
    CHECK(judged_without({.height = 6e-6}, 2e-5, {.max_deviation = 2e-5}) == "R12");
}

TEST_CASE(
    "verify_certificate: a needle far from the mesh may vanish where its distance is stated") {
    // The tip is 6 from the sheet.
    const Needle far{.height = 6};
    CHECK(judged_without(far, 23, {.max_deviation = 30.0}) == "R12");
    CHECK(judged_without(far, 25, {.max_deviation = 30.0}).empty());
    CHECK(judged_without(far, 25) == "R13");
}

TEST_CASE("verify_certificate: nothing may vanish if nothing is left") {
    Subject s = with_needle({});
    Json& r = s.certificate["rounded"];
    for (const char* list : {"vertices", "triangles", "parents", "intersection_edges", "regions"})
        r[list] = Json::array();
    r["vanished"] = {0, 1};
    r["max_move"] = nullptr;
    r["deviation"] = "1e+300";
    CHECK(judged(s, {.max_deviation = 1e300}) == "R12");
}
