// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Doubles that are near the inputs everywhere, but not connected as the exact part (R37), or the
// same triangles at places where they lie otherwise (R38).
#include "support/forged.hpp"

namespace {

using namespace forged;

const Surface square_sheet{
    "sheet", Role::unknown, {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {100, 100, 0}}, {{0, 1, 2}}};

/// Replaces the mesh of doubles by one of which each triangle has one parent.
void replace(Json& r, const std::vector<Point3>& vertices, const std::vector<Triangle>& triangles,
             const std::vector<int>& parents, const std::vector<int>& regions = {}) {
    r["vertices"] = r["triangles"] = r["parents"] = r["regions"] = Json::array();
    for (const Point3& p : vertices)
        r["vertices"].push_back({decimal_text(p.x), decimal_text(p.y), decimal_text(p.z)});
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        r["triangles"].push_back(triangles[t]);
        r["parents"].push_back(Json::array({parents[t]}));
        r["regions"].push_back(Json::array({regions.empty() ? 0 : regions[t]}));
    }
    r["intersection_edges"] = Json::array();
    r["max_move"] = nullptr;
    r["deviation"] = "5e-11";
}

std::string judged_with(const std::vector<Surface>& surfaces,
                        const std::function<void(Json&)>& change) {
    Subject s = subject({{"in.obj", obj_text(surfaces)}}, {});
    REQUIRE(judged(s) == "");
    change(s.certificate["rounded"]);
    return judged(s);
}

} // namespace

TEST_CASE("images: a triangle may be divided, but not doubled, torn or slit") {
    constexpr double e = 1e-12;
    const auto with = [](const std::vector<Point3>& vertices,
                         const std::vector<Triangle>& triangles,
                         const std::vector<int>& regions = {}) {
        return judged_with({square_sheet}, [&](Json& r) {
            auto all = std::vector<Point3>(square_sheet.vertices.begin(),
                                           square_sheet.vertices.begin() + 3);
            all.insert(all.end(), vertices.begin(), vertices.end());
            replace(r, all, triangles, std::vector<int>(triangles.size(), 0), regions);
        });
    };
    CHECK(with({{20, 20, 0}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) == "");
    CHECK(with({{20, 20, e}, {20, 20, -e}},
               {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 1, 4}, {1, 2, 4}, {2, 0, 4}}) == "R37");
    CHECK(with({{50, 50, 0}}, {{0, 1, 3}, {0, 3, 2}}) == "");
    CHECK(with({{50, 50, -e}, {0, 0, e}, {50, 50, e}}, {{0, 1, 3}, {4, 5, 2}}, {0, 1}) == "R37");
    const std::vector<Triangle> round_a_slit{{0, 1, 3}, {1, 4, 3}, {1, 5, 4}, {1, 2, 5},
                                             {0, 3, 2}, {3, 6, 2}, {6, 5, 2}};
    CHECK(with({{20, 20, 0}, {30, 30, e}, {40, 40, 0}, {30, 30, -e}}, round_a_slit) == "R37");
    std::vector<Triangle> closed = round_a_slit;
    for (Triangle& t : closed)
        for (std::uint32_t& corner : t) corner = corner == 6 ? 4 : corner;
    CHECK(with({{20, 20, 0}, {30, 30, 0}, {40, 40, 0}}, closed) == "");
}

TEST_CASE("images: triangles with a common side stay joined along it") {
    Surface square = square_sheet;
    square.triangles = {{0, 1, 2}, {2, 1, 3}};
    const auto with = [&](double gap) {
        return judged_with({square}, [&](Json& r) {
            std::vector<Point3> vertices = square.vertices;
            vertices.push_back({50, 50, -gap});
            if (gap != 0) vertices.push_back({50, 50, gap});
            const std::uint32_t upper = gap != 0 ? 5 : 4;
            replace(r, vertices, {{0, 1, 4}, {0, 4, 2}, {1, 3, upper}, {3, 2, upper}}, {0, 0, 1, 1},
                    gap != 0 ? std::vector{0, 0, 1, 1} : std::vector{0, 0, 0, 0});
        });
    };
    CHECK(with(0) == "");
    CHECK(with(1e-12) == "R37");
}

TEST_CASE("images: surfaces that meet along more than the deviation still meet") {
    const Surface wall{
        "wall", Role::unknown, {{20, 20, 0}, {40, 20, 0}, {30, 20, 30}}, {{0, 1, 2}}};
    CHECK(judged_with({square_sheet, wall}, [&](Json& r) {
              std::vector<Point3> vertices(square_sheet.vertices.begin(),
                                           square_sheet.vertices.begin() + 3);
              for (Point3 p : wall.vertices) {
                  p.z += 2e-12;
                  vertices.push_back(p);
              }
              replace(r, vertices, {{0, 1, 2}, {3, 4, 5}}, {0, 1}, {0, 1});
          }) == "R37");
    // Surfaces that are in one plane up to what is accepted may part.
    const Surface flat{
        "flat", Role::unknown, {{10, 10, -1e-11}, {40, 10, 1e-11}, {25, 40, 0}}, {{0, 1, 2}}};
    CHECK(judged_with({square_sheet, flat}, [&](Json& r) {
              std::vector<Point3> vertices(square_sheet.vertices.begin(),
                                           square_sheet.vertices.begin() + 3);
              for (Point3 p : flat.vertices) {
                  p.z += 1.1e-11;
                  vertices.push_back(p);
              }
              replace(r, vertices, {{0, 1, 2}, {3, 4, 5}}, {0, 1}, {0, 1});
          }) == "");
}

TEST_CASE("places: a body that is smaller than the deviation keeps its sides") {
    constexpr double e = 1e-7; // up to 9.1e-7 is accepted at a coordinate of 10^6
    const Surface body{
        "body",
        Role::unknown,
        {{0, 0, 0}, {e, 0, 0}, {0, e, 0}, {0, 0, e}, {0, 0, 1e6}, {1, 0, 1e6}, {0, 1, 1e6}},
        {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {4, 5, 6}}};
    const auto with = [&](const std::function<void(Json&)>& change) {
        return judged_with({body}, [&](Json& r) {
            change(r);
            r["max_move"] = r["deviation"] = "9e-07";
        });
    };
    CHECK(with([](Json& r) { shift_number(r["vertices"][1][0], 1e-8); }) == "");
    CHECK(with([](Json& r) { std::swap(r["vertices"][1], r["vertices"][2]); }) == "R38");
}

TEST_CASE("places: another order of triangles around an edge is counted") {
    constexpr double e = 1e-7;
    const Surface book{"book",
                       Role::unknown,
                       {{0, 0, 0}, {0, 0, 1e6}, {1, 0, 0}, {-1, -1, 0}, {-1, 0, 0}, {-1, e, 0}},
                       {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}}};
    const auto measured = [&](double by) {
        Subject s = subject({{"in.obj", obj_text({book})}}, {});
        Json& r = s.certificate["rounded"];
        shift_number(r["vertices"][4][1], by);
        r["max_move"] = r["deviation"] = "9e-07";
        const auto certificate = parse_certificate(s.certificate.dump(), "c");
        REQUIRE(certificate);
        const Verdict verdict = verify_certificate(s.inputs, certificate.value());
        CHECK(verdict.violations.empty());
        return verdict.measured.value();
    };
    CHECK(measured(0.5 * e).same_cells);
    CHECK_FALSE(measured(2 * e).same_cells);
    CHECK(measured(2 * e).differences == Differences{0, 0, 1});
}

TEST_CASE("images: an edge that surfaces have in common no more is counted") {
    const Surface floor{"floor", Role::unknown, {{0, 0, 0}, {1e6, 0, 0}, {0, 1e6, 0}}, {{0, 1, 2}}};
    const Surface wall{
        "wall", Role::unknown, {{1000, 1000, 0}, {2000, 1000, 0}, {1000, 1000, 2000}}, {{0, 1, 2}}};
    Subject s = subject({{"in.obj", obj_text({floor, wall})}}, {});
    Json& r = s.certificate["rounded"];
    const Json foot = Json::array({"2000", "1000", "0"});
    const auto at = std::find(r["vertices"].begin(), r["vertices"].end(), foot);
    REQUIRE(at != r["vertices"].end());
    const auto v = at - r["vertices"].begin();
    r["vertices"].push_back({"2000", "1000", decimal_text(1e-7)});
    for (std::size_t t = 0; t < r["triangles"].size(); ++t)
        if (r["parents"][t] == Json::array({1}))
            std::replace(r["triangles"][t].begin(), r["triangles"][t].end(), Json(v),
                         Json(r["vertices"].size() - 1));
    r["intersection_edges"] = Json::array();
    r["max_move"] = nullptr;
    r["deviation"] = "9e-07";
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    REQUIRE(certificate);
    const Verdict verdict = verify_certificate(s.inputs, certificate.value());
    CHECK(verdict.violations.empty());
    CHECK(verdict.measured.value().differences == Differences{1, 0, 0});
}

TEST_CASE("images: a slit that begins at a side is counted") {
    Subject s = subject({{"in.obj", obj_text({square_sheet})}}, {});
    replace(s.certificate["rounded"],
            {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {30, 30, 0}, {0, 0, 1e-12}},
            {{0, 1, 3}, {1, 2, 3}, {2, 4, 3}}, {0, 0, 0});
    const auto certificate = parse_certificate(s.certificate.dump(), "c");
    REQUIRE(certificate);
    const Verdict verdict = verify_certificate(s.inputs, certificate.value());
    CHECK(verdict.violations.empty());
    CHECK(verdict.measured.value().differences == Differences{1, 0, 0});
}

TEST_CASE("images: triangles that part from an end of their common side are counted") {
    Surface square = square_sheet;
    square.triangles = {{0, 1, 2}, {2, 1, 3}};
    const auto measured = [&](double gap) {
        Subject s = subject({{"in.obj", obj_text({square})}}, {});
        std::vector<Point3> vertices = square.vertices;
        vertices.push_back({50, 50, 0});
        if (gap != 0) vertices.push_back({0, 100, gap});
        const std::uint32_t end = gap != 0 ? 5 : 2;
        replace(s.certificate["rounded"], vertices, {{0, 1, 4}, {0, 4, 2}, {1, 3, 4}, {3, end, 4}},
                {0, 0, 1, 1});
        const auto certificate = parse_certificate(s.certificate.dump(), "c");
        REQUIRE(certificate);
        const Verdict verdict = verify_certificate(s.inputs, certificate.value());
        CHECK(verdict.violations.empty());
        return verdict.measured.value().differences;
    };
    CHECK(measured(0) == Differences{});
    CHECK(measured(1e-12) == Differences{1, 0, 0});
}

TEST_CASE("images: a triangle that stands on an edge is counted") {
    Surface square = square_sheet;
    square.triangles = {{0, 1, 2}, {2, 1, 3}};
    const auto measured = [&](const Json& parents, const Point3& tip) {
        Subject s = subject({{"in.obj", obj_text({square})}}, {});
        std::vector<Point3> vertices = square.vertices;
        vertices.push_back(tip);
        Json& r = s.certificate["rounded"];
        const bool at_border = tip.y < 0;
        replace(
            r, vertices,
            {{0, 1, 2}, {2, 1, 3}, {at_border ? 0U : 2U, at_border ? 4U : 1U, at_border ? 1U : 4U}},
            {0, 1, 0}, at_border ? std::vector{0, 0, 0} : std::vector{0, 1, 2});
        r["parents"][2] = parents;
        if (!at_border) r["intersection_edges"].push_back({1, 2});
        const auto certificate = parse_certificate(s.certificate.dump(), "c");
        REQUIRE(certificate);
        const Verdict verdict = verify_certificate(s.inputs, certificate.value());
        CHECK(verdict.violations.empty());
        return verdict.measured.value().differences;
    };
    constexpr double e = 1e-12;
    CHECK(measured({0}, {50, 50, e}) == Differences{0, 1, 0});
    CHECK(measured({0, 1}, {50, 50, e}) == Differences{0, 1, 0});
    // A border that is moved by less than the deviation.
    CHECK(measured({0}, {50, -e, 0}) == Differences{});
}
