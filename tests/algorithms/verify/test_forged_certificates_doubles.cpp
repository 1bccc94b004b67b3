// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates with a false mesh of doubles: the verifier refutes each, whatever the certificate
// states about distances.
#include "support/forged.hpp"
#include "support/paths.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

namespace {

using namespace forged;

std::vector<File> certified(const std::string& name) {
    std::ifstream in(test_support::source_dir() + "/tests/certified/" + name + "/input.obj");
    const std::string text(std::istreambuf_iterator<char>(in), {});
    REQUIRE_FALSE(text.empty());
    return {{"input.obj", text}};
}

Forgery doubles(const std::string& name, const std::function<void(Json&)>& change,
                const std::string& rule) {
    return {name, [change](Json& c) { change(c["rounded"]); }, rule};
}

void add_to(Json& number, double amount) {
    std::string text = number.get<std::string>();
    double value = std::stod(text) + amount;
    char buffer[64];
    number = std::string(buffer, std::to_chars(buffer, buffer + 64, value).ptr);
}

/// States bounds that would allow almost anything.
void allow(Json& rounded, const std::string& bound) {
    if (!rounded["max_move"].is_null()) rounded["max_move"] = bound;
    rounded["deviation"] = bound;
}

void clear_mesh(Json& r) {
    for (const char* list : {"vertices", "triangles", "parents", "intersection_edges", "regions"})
        r[list] = Json::array();
    r["max_move"] = nullptr;
}

/// Drops all that is left of some input triangles, and lists them as vanished.
void vanish(Json& r, const std::set<int>& inputs) {
    drop_children(r, inputs);
    r["vanished"] = inputs;
    r["max_move"] = nullptr;
}

} // namespace

TEST_CASE("forged certificates: what vanished") {
    check_forgeries(
        subject(with_a_third()),
        {
            doubles(
                "all doubles gone, every input listed",
                [](Json& r) {
                    clear_mesh(r);
                    r["vanished"] = {0, 1, 2, 3};
                },
                "R12"),
            doubles(
                "all doubles gone, every input listed, with a large bound",
                [](Json& r) {
                    clear_mesh(r);
                    r["vanished"] = {0, 1, 2, 3};
                    r["deviation"] = "1e+300";
                },
                "R13"),
            doubles("all doubles gone, none listed", clear_mesh, "R12"),
            doubles(
                "a component gone",
                [](Json& r) {
                    vanish(r, {2, 3});
                },
                "R12"),
            doubles(
                "a component gone, with the largest bound that is accepted",
                [](Json& r) {
                    vanish(r, {2, 3});
                    r["deviation"] = "2e-11";
                },
                "R12"),
            doubles(
                "half of a component gone", [](Json& r) { vanish(r, {3}); }, "R12"),
            doubles(
                "a surface that crosses another gone", [](Json& r) { vanish(r, {1}); }, "R12"),
            doubles(
                "a component gone, and not listed",
                [](Json& r) {
                    vanish(r, {2, 3});
                    r["vanished"] = Json::array();
                },
                "R12"),
            doubles(
                "listed, but there", [](Json& r) { r["vanished"] = {0}; }, "R12"),
            doubles(
                "listed twice",
                [](Json& r) {
                    vanish(r, {3});
                    r["vanished"] = {3, 3};
                },
                "R10"),
            doubles(
                "listed, out of range", [](Json& r) { r["vanished"] = {4}; }, "R10"),
            doubles(
                "listed in another order",
                [](Json& r) {
                    vanish(r, {2, 3});
                    r["vanished"] = {3, 2};
                },
                "R10"),
        });
}

TEST_CASE("forged certificates: bounds that are not believed") {
    const auto move = [](Json& r, std::size_t vertex, double amount, const std::string& bound) {
        add_to(r["vertices"][vertex][2], amount);
        allow(r, bound);
    };
    check_forgeries(
        subject(with_a_third()),
        {
            doubles(
                "a vertex 1e6 away, with a bound of 1e300",
                [&](Json& r) { move(r, 10, 1e6, "1e+300"); }, "R13"),
            doubles(
                "a vertex moved by 3, with a bound of 10", [&](Json& r) { move(r, 10, 3, "10"); },
                "R13"),
            doubles(
                "a vertex moved by 1e-4, with a bound of 1e-3",
                [&](Json& r) { move(r, 10, 1e-4, "0.001"); }, "R13"),
            doubles(
                "a vertex moved by 1e-6, with a bound of 1e-7",
                [&](Json& r) { move(r, 10, 1e-6, "1e-07"); }, "R13"),
            doubles(
                "a vertex moved by 1e-6, with the bounds as they were",
                [](Json& r) { add_to(r["vertices"][10][2], 1e-6); }, "R14"),
            doubles(
                "a vertex moved by one unit in the last place",
                [](Json& r) {
                    const double x = std::stod(r["vertices"][1][0].get<std::string>());
                    add_to(r["vertices"][1][0], std::nextafter(x, 9.0) - x);
                },
                "R14"),
            doubles(
                "a bound of 10 alone", [](Json& r) { r["deviation"] = "10"; }, "R13"),
            doubles(
                "a bound of 1e300 alone", [](Json& r) { allow(r, "1e+300"); }, "R13"),
            doubles(
                "a deviation that is too small", [](Json& r) { r["deviation"] = "1e-18"; }, "R13"),
            doubles(
                "no deviation", [](Json& r) { allow(r, "0"); }, "R13"),
            doubles(
                "a largest move that is too small", [](Json& r) { r["max_move"] = "1e-18"; },
                "R14"),
            doubles(
                "no largest move", [](Json& r) { r["max_move"] = nullptr; }, "R14"),
            doubles(
                "a largest move above the deviation", [](Json& r) { r["max_move"] = "1"; }, "R14"),
            doubles(
                "a negative deviation", [](Json& r) { r["deviation"] = "-1"; }, "R10"),
            doubles(
                "a negative largest move", [](Json& r) { r["max_move"] = "-1e-300"; }, "R10"),
        });
}

TEST_CASE("forged certificates: elements of the doubles") {
    check_forgeries(
        subject(with_a_third()),
        {
            doubles(
                "a triangle dropped",
                [](Json& r) {
                    drop_triangle(r, 0);
                    r["max_move"] = nullptr;
                },
                "R18"),
            doubles(
                "a triangle dropped, the largest move kept", [](Json& r) { drop_triangle(r, 0); },
                "R14"),
            doubles(
                "a triangle dropped at the border, with the largest bound",
                [](Json& r) {
                    drop_triangle(r, r["triangles"].size() - 1);
                    r["max_move"] = nullptr;
                    r["deviation"] = "2e-05";
                },
                "R12"),
            doubles(
                "vertices merged", [](Json& r) { r["vertices"][7] = r["vertices"][6]; }, "R11"),
            doubles(
                "vertices exchanged",
                [](Json& r) { std::swap(r["vertices"][0], r["vertices"][1]); }, "R13"),
            doubles(
                "a vertex that no triangle has",
                [](Json& r) {
                    r["vertices"].push_back({"1", "2", "3"});
                },
                "R11"),
            doubles(
                "a triangle twice",
                [](Json& r) { add_triangle(r, r["triangles"][0], r["parents"][0]); }, "R11"),
            doubles(
                "a triangle without area",
                [](Json& r) { r["triangles"][0][0] = r["triangles"][0][1]; }, "R11"),
            doubles(
                "a bridge to a component apart",
                [](Json& r) {
                    add_triangle(r, {0, 1, r["triangles"].back()[0]}, {0});
                },
                "R13"),
            doubles(
                "all coordinates exchanged",
                [](Json& r) {
                    for (Json& p : r["vertices"]) std::swap(p[0], p[1]);
                },
                "R13"),
            doubles(
                "all moved",
                [](Json& r) {
                    for (Json& p : r["vertices"]) add_to(p[2], 1);
                },
                "R13"),
            doubles(
                "parents exchanged",
                [](Json& r) { std::swap(r["parents"].front(), r["parents"].back()); }, "R13"),
            doubles(
                "a parent too many",
                [](Json& r) {
                    r["parents"][0] = {0, 1};
                },
                "R13"),
            doubles(
                "a parent out of range", [](Json& r) { r["parents"][0] = {4}; }, "R10"),
            doubles(
                "no parent", [](Json& r) { r["parents"][0] = Json::array(); }, "R10"),
            doubles(
                "a corner out of range", [](Json& r) { r["triangles"][0][0] = 12; }, "R10"),
            doubles(
                "said not to be conforming", [](Json& r) { r["clean"] = false; }, "R11"),
            doubles(
                "no intersection edge", [](Json& r) { r["intersection_edges"] = Json::array(); },
                "R15"),
            doubles(
                "an intersection edge too many",
                [](Json& r) {
                    r["intersection_edges"].insert(r["intersection_edges"].begin(), Json{0, 1});
                },
                "R15"),
            {"no mesh, but a file of it", [](Json& c) { c["rounded"] = nullptr; }, "R21"},
            {"undivided doubles",
             [](Json& c) {
                 Json& r = c["rounded"];
                 r["triangles"] = {{0, 1, 2}, {3, 4, 5}};
                 r["parents"] = {{0}, {1}};
                 r["regions"] = {{0}, {1}};
                 r["vanished"] = {2, 3};
                 r["max_move"] = nullptr;
                 drop_unused(r);
             },
             "R11"},
        });
}

TEST_CASE("forged certificates: regions") {
    check_forgeries(
        subject(with_a_third()),
        {
            doubles(
                "all in one",
                [](Json& r) {
                    for (Json& region : r["regions"]) region = {0};
                },
                "R16"),
            doubles(
                "one divided", [](Json& r) { r["regions"][0] = {77}; }, "R16"),
            doubles(
                "each triangle for itself",
                [](Json& r) {
                    for (std::size_t t = 0; t < r["regions"].size(); ++t) r["regions"][t] = {t};
                },
                "R16"),
            doubles(
                "none", [](Json& r) { r["regions"] = Json::array(); }, "R16"),
            doubles(
                "two of a triangle",
                [](Json& r) {
                    r["regions"][0] = {0, 0};
                },
                "R16"),
            doubles(
                "none of a triangle", [](Json& r) { r["regions"][0] = Json::array(); }, "R16"),
            doubles(
                "exchanged between triangles",
                [](Json& r) { std::swap(r["regions"].front(), r["regions"].back()); }, "R16"),
        });
}

TEST_CASE("forged certificates: doubles that were snapped") {
    const Subject s = subject(certified("turned_half")); // other triangles than the exact part
    REQUIRE(s.certificate["rounded"]["max_move"].is_null());
    check_forgeries(s, {
                           doubles(
                               "all turned over",
                               [](Json& r) {
                                   for (std::size_t t = 0; t < r["triangles"].size(); ++t)
                                       turn_over(r, t);
                               },
                               "R19"),
                           doubles(
                               "one turned over", [](Json& r) { turn_over(r, 3); }, "R19"),
                           doubles(
                               "a triangle dropped", [](Json& r) { drop_triangle(r, 3); }, "R18"),
                           doubles(
                               "a largest move", [](Json& r) { r["max_move"] = "1e-300"; }, "R14"),
                           doubles(
                               "a vertex moved by 1e-3, with the largest bound",
                               [](Json& r) {
                                   add_to(r["vertices"][5][0], 1e-3);
                                   r["deviation"] = "1e-06";
                               },
                               "R13"),
                           doubles(
                               "a deviation that is too small",
                               [](Json& r) { r["deviation"] = "1e-15"; }, "R13"),
                           doubles(
                               "everything gone and listed",
                               [&](Json& r) {
                                   std::set<int> all;
                                   for (const Json& parents : r["parents"])
                                       for (const Json& p : parents) all.insert(p.get<int>());
                                   clear_mesh(r);
                                   r["vanished"] = all;
                               },
                               "R12"),
                           doubles(
                               "an input triangle gone",
                               [](Json& r) {
                                   const int gone = r["parents"][0][0].get<int>();
                                   vanish(r, {gone});
                               },
                               "R12"),
                       });
}

TEST_CASE("verify_certificate: the tip of a needle that vanished is near what the needle meets") {
    const Subject s = subject(certified("needle_tip"));
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    REQUIRE(certificate);
    const auto verdict = verify_certificate(s.inputs, certificate.value());
    CHECK(verdict.violations.empty());
    REQUIRE(verdict.measured);
    CHECK(verdict.measured->vanished == 0);
    CHECK(verdict.measured->partly_vanished == 1);
    // Without the sheet next to it, the tip would be missing.
    Subject alone = s;
    Json& r = alone.certificate["rounded"];
    drop_children(r, {1, 2, 3});
    r["vanished"] = {1, 2, 3};
    seal(alone);
    const auto rules = judged(alone);
    CHECK(rules.find("R12") != std::string::npos);
    CHECK(rules.find("R18") != std::string::npos);
}

TEST_CASE("verify_certificate: the largest deviation that is accepted") {
    const Subject s = subject(pierced());
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    REQUIRE(certificate);
    const auto verdict = verify_certificate(s.inputs, certificate.value());
    REQUIRE(verdict.violations.empty());
    REQUIRE(verdict.measured);
    const Measured& m = *verdict.measured;
    CHECK(m.deviation > 0);
    CHECK(m.deviation <= certificate->rounded->deviation);
    CHECK(m.vanished == 0);
    CHECK(m.max_deviation == 9 * 0x1p-40);
    CHECK(judged(s, {.max_deviation = certificate->rounded->deviation}) == "");
    CHECK(judged(s, {.max_deviation = 0x1p-100}) == "R13");
    CHECK(judged(s, {.max_deviation = 0.0}) == "R13");
}

TEST_CASE("verify_certificate: far from the origin, the doubles' own precision is accepted") {
    const std::vector<File> files{
        {"far.obj", "v 1e15 0 0\nv 1000000000000010 1 0\nv 1000000000000001 12 0\n"
                    "v 1000000000000002 1 -3\nv 1000000000000003 8 -1\nv 1000000000000002.5 3 5\n"
                    "g a\nf 1 2 3\ng b\nf 4 5 6\n"}};
    const Subject s = subject(files);
    CHECK(judged(s) == "");
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    const auto verdict = verify_certificate(s.inputs, certificate.value());
    REQUIRE(verdict.measured);
    CHECK(verdict.measured->max_deviation == 1000000000000010 * 0x1p-40);
}
