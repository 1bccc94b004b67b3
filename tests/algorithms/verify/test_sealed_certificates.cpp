// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of surfaces that were sealed or extended: the verifier accepts what the producer
// writes, and refutes what a forger adds to surfaces or leaves out of them.
#include "support/paths.hpp"
#include "support/sealed_certificates.hpp"

namespace {

using namespace forged;

// --- Forgers who arrange by themselves -----------------------------------------------------------

/// Triangles between the border of the short sheet, moved by `from` along x, and x = `to`.
std::vector<Corners> strip(double from, double to) {
    std::vector<Corners> triangles;
    const Surface sheet = input_files(gaping())[0].surfaces[0];
    for (std::size_t j = 0; j < 5; ++j) {
        Point3 a = sheet.vertices[36 + j], b = sheet.vertices[37 + j];
        a.x += from;
        b.x += from;
        const Point3 c{to, a.y, a.z}, d{to, b.y, b.z};
        triangles.push_back({b, a, c});
        triangles.push_back({b, c, d});
    }
    return triangles;
}

bool is_right_of_fault(const Corners& corners) {
    return std::ranges::all_of(corners, [](const Point3& p) { return p.x > 5 - 1e-9; }) &&
           std::ranges::any_of(corners, [](const Point3& p) { return p.x > 5 + 1e-9; });
}

bool keep_left(const Corners& corners, const std::set<std::uint32_t>&) {
    return !is_right_of_fault(corners);
}

bool keep_all(const Corners&, const std::set<std::uint32_t>&) {
    return true;
}

std::string judged_widely(const Subject& s) {
    VerifyOptions options;
    options.max_change = 100;
    return judged(s, options);
}

bool has_rule(const std::string& rules, const std::string& rule) {
    return (" " + rules + " ").find(" " + rule + " ") != std::string::npos;
}

/// A sheet with a slit from its border to its middle, along y = 4, and sheets that end side by side.
std::vector<File> slit_and_neighbours() {
    std::string text;
    const std::array<double, 6> rows{0, 2, 3.95, 4.05, 6, 8};
    for (const double y : rows)
        for (int i = 0; i <= 4; ++i)
            text += "v " + std::to_string(2 * i) + " " + std::to_string(y) + " 0\n";
    text += "g slit\n";
    for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 4; ++i) {
            if (j == 2 && i < 2) continue;
            const int a = 1 + 5 * j + i;
            text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
                    std::to_string(a + 6) + " " + std::to_string(a + 5) + "\n";
        }
    return {{"slit.obj", text},
            {"left.obj", sheet_text("left", -9, -4.1, 2, 0.05)},
            {"right.obj", sheet_text("right", -4, 1, 2.02, 0.052)}};
}

} // namespace

TEST_CASE("sealed certificates: bridges between borders are accepted", "[sealing]") {
    const Subject right = sealed_subject(slit_and_neighbours(), {std::nullopt, 0.2, 0});
    CHECK(right.certificate["sealed"][0]["sealed"].size() >= 4);
    CHECK(right.certificate["sealed"][1]["sealed"].size() +
              right.certificate["sealed"][2]["sealed"].size() >=
          5);
    CHECK(judged_widely(right) == "");
}

TEST_CASE("sealed certificates: bridges are attached to their surface, and face its side",
          "[sealing]") {
    const auto rules = [&](const std::vector<Corners>& added) {
        return judged_widely(self_made(slit_and_neighbours(), {{0, added}}, keep_all));
    };
    const Point3 a{0, 3.95, 0}, b{2, 3.95, 0}, c{0, 4.05, 0}, d{2, 4.05, 0}, e{4, 3.95, 0},
        f{4, 4.05, 0}, half{1, 3.95, 0};
    // All of the slit, its end, and the part at its mouth.
    CHECK(rules({{a, b, c}, {b, d, c}, {b, e, d}, {e, f, d}}) == "");
    CHECK(rules({{b, e, d}, {e, f, d}}) == "");
    CHECK(rules({{a, b, c}, {b, d, c}}) == "");
    // A triangle that touches no edge, or a part of one.
    CHECK(has_rule(rules({{b, c, {1, 4.02, 0}}}), "R54"));
    CHECK(has_rule(rules({{half, b, d}}), "R54"));
    // Triangles that face down, alone or on others that face up.
    CHECK(has_rule(rules({{b, a, c}}), "R54"));
    CHECK(has_rule(rules({{a, b, c}, {d, b, c}}), "R54"));
}

TEST_CASE("sealed certificates: what goes on from triangles that face different sides faces these",
          "[sealing]") {
    const File wall{"wall.obj", "v 4.3 -1 -1\nv 4.3 9 -1\nv 4.3 9 1\nv 4.3 -1 1\nf 1 2 3 4\n"};
    const std::string sheet = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 4 8 0\nv 0 8 0\nf 1 2 3 4\n";
    const std::vector<File> folded{{"sheet.obj", sheet + "f 6 5 3 4\n"}, wall},
        even{{"sheet.obj", sheet + "f 4 3 5 6\n"}, wall};
    const Point3 a{4, 0, 0}, b{4, 4, 0}, c{4.3, 0, 0}, d{4.3, 4, 0}, e{4, 8, 0}, f{4.3, 8, 0};
    const auto rules = [](const std::vector<File>& files, const std::vector<Corners>& added) {
        return judged_widely(self_made(files, {{0, added}}, keep_all));
    };
    CHECK(rules(folded, {{b, a, c}, {b, c, d}, {b, e, f}, {b, f, d}}) == "");
    CHECK(rules(even, {{b, a, c}, {b, c, d}, {e, b, f}, {f, b, d}}) == "");
    CHECK(has_rule(rules(folded, {{b, a, c}, {b, c, d}, {e, b, f}, {f, b, d}}), "R54"));
    CHECK(has_rule(rules(even, {{b, a, c}, {b, c, d}, {b, e, f}, {b, f, d}}), "R54"));
    // The sides at the border are right, and what goes on from them is turned over.
    CHECK(has_rule(rules(even, {{b, a, c}, {c, b, d}, {e, b, f}, {f, b, d}}), "R54"));
}

TEST_CASE("sealed certificates: accepted", "[sealing]") {
    CHECK(judged(right_sealed()) == "");
    CHECK(right_sealed().certificate["kind"] == "sealed");
    CHECK(judged(right_extended()) == "");
    CHECK(judged(sealed_subject(gaping(), {std::nullopt, 0.3, 0},
                                {"obj", "off", "ply", "vtp", "ts", "stl"})) == "");
    CHECK(judged(sealed_subject(gaping(), {gaping_box(), 0, 2.5})) == "");
    CHECK(judged(sealed_subject(gaping(), {gaping_box(), 0.3, 0})) == "");
    // Nothing to seal.
    const Subject idle = sealed_subject(crossing_sheets(), {std::nullopt, 1e-9, 0});
    CHECK(judged(idle) == "");
    for (const Json& part : idle.certificate["sealed"]) CHECK(part["limit"] == "0");
}

TEST_CASE("sealed certificates: what was changed", "[sealing]") {
    const Json& c = right_sealed().certificate;
    CHECK_FALSE(c["sealed"][0]["sealed"].empty());
    CHECK(c["sealed"][1]["sealed"].empty());
    CHECK(number_in(c["sealed"][0]["limit"]) == Approx(0.1).epsilon(0.15));
    CHECK(number_in(c["sealed"][1]["limit"]) == Approx(0.15).epsilon(0.15));
    CHECK(number_in(c["sealed"][2]["limit"]) == 0);
    CHECK_FALSE(right_extended().certificate["sealed"][0]["extended"].empty());
    const auto parsed = parse_certificate(c.dump(), "c");
    REQUIRE(parsed);
    const auto verdict = verify_certificate(right_sealed().inputs, parsed.value());
    REQUIRE(verdict.change);
    CHECK(verdict.change->limit == Approx(0.15).epsilon(0.15));
}

TEST_CASE("sealed certificates: other triangles than those of the exact part", "[sealing]") {
    CHECK(judged(with_diagonal(right_sealed())) == "");
    CHECK(judged(with_diagonal(right_extended())) == "");
}

TEST_CASE("sealed certificates: accepted for real surfaces", "[sealing]") {
    const std::string data = test_support::source_dir() + "/docs/data/";
    std::vector<File> files;
    for (const std::string name : {"top", "base", "fault"})
        files.push_back({name + ".obj", obj_in(data + name + ".ts")});
    const Volume box = box_volume({0, 0, -1700}, {2000, 1500, -700});
    const Subject all = sealed_subject(files, {box, 20, 60});
    CHECK(judged(all) == "");
    CHECK(number_in(all.certificate["sealed"][0]["limit"]) > 0);
    CHECK(judged(sealed_subject(files, {std::nullopt, 20, 0})) == "");
}

TEST_CASE("sealed certificates: accepted for models", "[sealing]") {
    struct Model {
        std::string file;
        double seal;
    };
    for (const auto& [name, distance] : std::vector<Model>{{"ringmesh/modelA1.ml", 30},
                                                           {"ringmesh/split_cube.ml", 0.5},
                                                           {"manifold/Havocglass8_left.obj", 0.1},
                                                           {"manifold/Cray_left.obj", 0.1}}) {
        INFO(name);
        const File file{"model.obj", obj_in(test_support::test_data() + "/" + name)};
        CHECK(judged(sealed_subject({file}, {std::nullopt, distance, 0})) == "");
    }
}

TEST_CASE("sealed certificates: accepted where triangles cross at the nearest doubles",
          "[sealing]") {
    // Two triangles each of two faults of arch-platform (tests/data/arch-platform). The finest grid
    // makes three contacts of two; moving the inputs instead made another cell close the gap.
    const std::vector<File> files{
        {"one.obj", "v 2.196632307368127 42.43658330302957 0.02265761566666667\n"
                    "v 2.215281842772147 42.43064935994648 0.023421153666666666\n"
                    "v 2.221524042638781 42.43126587351355 0.023678660666666667\n"
                    "v 2.1950875963328462 42.440924514957295 0.012644030037345363\n"
                    "v 2.1980160357764524 42.440385065586106 0.012644030037345363\n"
                    "v 2.216665571180472 42.43445112250301 0.013407568037345361\ng s20\nf 1 5 4\n"
                    "f 2 3 6\n"},
        {"other.obj",
         "v 2.216460963011923 42.42966396735928 0.023630752333333335\n"
         "v 2.217931290604562 42.42968910116428 0.023630752333333335\n"
         "v 2.219929428102251 42.4297268018718 0.023630752333333335\n"
         "v 2.2174107492234847 42.435050472633435 0.006797051994909115\n"
         "v 2.2188810768161233 42.43507560643843 0.006797051994909115\ng s21\nf 1 2 4\n"
         "f 2 3 5\n"}};
    const Subject s = sealed_subject(files, {std::nullopt, 0.002, 0});
    CHECK(judged(s) == "");
    CHECK_FALSE(s.certificate["sealed"][1]["sealed"].empty());
}

/// A sheet with a notch, and a roof whose ridge is 0.05 below one side of the notch.
std::vector<File> notched() {
    return {{"notched.obj", "v 0 0 0\nv 1 0 0\nv 1 -1 0\nv -1 -1 0\nv -1 1 0\nv 1 1 0\nv 1 0.1 0\n"
                            "g notched\nf 1 3 2\nf 1 4 3\nf 1 5 4\nf 1 6 5\nf 1 7 6\n"},
            {"roof.obj",
             "v -0.5 0 -0.05\nv 1.5 0 -0.05\nv -0.5 0.3 -1\nv 1.5 0.3 -1\nv -0.5 -0.3 -1\n"
             "v 1.5 -0.3 -1\ng roof\nf 1 2 4\nf 1 4 3\nf 2 1 5\nf 2 5 6\n"}};
}

TEST_CASE("sealed certificates: what leads from a border to the same border closes no gap",
          "[sealing]") {
    const Subject s = sealed_subject(notched(), {std::nullopt, 0.06, 0});
    CHECK(judged(s) == "");
    const Json& added = s.certificate["sealed"][0]["sealed"];
    REQUIRE_FALSE(added.empty());
    // The strips lead down to the ridge, not across the notch.
    for (const Json& corners : added)
        CHECK(std::ranges::any_of(corners, [](const Json& p) { return number_in(p[2]) < -0.04; }));
    // A forger who closes the notch instead, by a triangle that faces the other side.
    const std::vector<Corners> across{{Point3{1, 0, 0}, Point3{0, 0, 0}, Point3{1, 0.2, 0}}};
    const auto keep = [](const Corners& corners, const std::set<std::uint32_t>& parents) {
        return *parents.begin() != 5 || std::ranges::all_of(corners, [](const Point3& p) {
            return p.y <= 0.1 * p.x + 1e-12;
        });
    };
    CHECK(judged_widely(self_made(notched(), {{0, across}}, keep)) == "R54");
}

TEST_CASE("sealed certificates: a hole must stay open", "[sealing]") {
    const std::vector<File> files{
        {"plate.obj", "v 0 0 0\nv 9 0 1\nv 0 9 2\ng plate\nf 1 2 3\n"},
        {"tube.obj", "v 1 1 -3\nv 2 1 -3\nv 2 2 -3\nv 1 2 -3\nv 1 1 3\nv 2 1 3\nv 2 2 3\nv 1 2 3\n"
                     "g tube\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\n"
                     "f 4 5 8\n"}};
    const auto hole = self_made(files, {}, [](const Corners& corners, const auto& parents) {
        return *parents.begin() != 0 || std::ranges::any_of(corners, [](const Point3& p) {
            return p.x < 0.99 || p.x > 2.01 || p.y < 0.99 || p.y > 2.01;
        });
    });
    REQUIRE_FALSE(hole.certificate["cut"]["dropped"].empty());
    VerifyOptions options;
    options.max_change = 2;
    CHECK(judged(hole, options) == "");
    Subject other = with_diagonal(hole);
    CHECK(judged(other, options) == "");
    put_back(other.certificate);
    number_regions(other.certificate["rounded"], other.surfaces);
    seal_grown(other);
    CHECK(judged(other, options) == "R57");
}

TEST_CASE("sealed certificates: what a forger adds is refused", "[sealing]") {
    const auto right = self_made(gaping(), {{0, strip(0, 5.4)}}, keep_left);
    CHECK(judged(right) == "");
    const auto not_added = [](const Corners& corners, const std::set<std::uint32_t>& parents) {
        return !is_right_of_fault(corners) || *parents.begin() < 60 || *parents.begin() >= 70;
    };
    const auto rules = [&](const std::map<std::size_t, std::vector<Corners>>& added,
                           const auto& keep) {
        return judged_widely(self_made(gaping(), added, keep));
    };
    // Beside the border.
    CHECK(has_rule(rules({{0, strip(0.03, 5.4)}}, keep_left), "R54"));
    // At the border of another surface.
    CHECK(has_rule(rules({{1, strip(0, 5.4)}}, keep_left), "R54"));
    CHECK(has_rule(rules({{2, strip(0, 5.4)}}, keep_left), "R54"));
    // In the middle of its surface: a wall below an inner line of edges, down to nothing.
    std::vector<Corners> wall;
    const Surface sheet = input_files(gaping())[0].surfaces[0];
    for (std::size_t j = 0; j < 5; ++j) {
        const Point3 &a = sheet.vertices[18 + j], &b = sheet.vertices[19 + j];
        wall.push_back({b, a, {a.x, a.y, a.z + 4}});
        wall.push_back({b, {a.x, a.y, a.z + 4}, {b.x, b.y, b.z + 4}});
    }
    const auto below = [](const Corners& corners, const std::set<std::uint32_t>& parents) {
        const bool is_wall = *parents.begin() >= 60 && *parents.rbegin() < 70;
        const double top = std::max({corners[0].z, corners[1].z, corners[2].z});
        return is_wall ? top < 2.4 : !is_right_of_fault(corners) || *parents.begin() < 60;
    };
    CHECK(has_rule(rules({{0, wall}}, below), "R54"));
    // It ends before the fault, goes on beyond it, or is all that was asked for and more.
    CHECK(has_rule(rules({{0, strip(0, 4.95)}}, keep_left), "R55"));
    CHECK(has_rule(rules({{0, strip(0, 5.4)}}, keep_all), "R55"));
    // It faces the other side.
    auto turned = strip(0, 5.4);
    for (Corners& corners : turned) std::swap(corners[0], corners[1]);
    CHECK(has_rule(rules({{0, turned}}, keep_left), "R54"));
    // A triangle more that nothing is kept of, which cuts the surfaces; it is connected with nothing.
    auto more = strip(0, 5.4);
    more.push_back({Point3{2, 3, -1}, Point3{3, 3, 4}, Point3{2, 5, 4}});
    CHECK(has_rule(rules({{0, more}},
                         [](const Corners& corners, const std::set<std::uint32_t>& parents) {
                             return *parents.begin() != 70 && keep_left(corners, parents);
                         }),
                   "R54"));
    // A triangle of the fault.
    const Corners of_fault{Point3{5, -1, -3}, Point3{5, 11, -3}, Point3{5, 11, 5}};
    CHECK(has_rule(rules({{0, {of_fault}}}, keep_all), "R54"));
    // The strip is good, and what was to be trimmed was kept: nothing is wrong with that.
    CHECK(rules({{0, strip(0, 5.4)}}, [&](const Corners& corners, const auto& parents) {
              return not_added(corners, parents);
          }) == "");
}

TEST_CASE("sealed certificates: the end of a strip is alone, at one vertex of its surface",
          "[sealing]") {
    const Point3 corner{0, 0, 0}, other{4.9, 0, 0}, a{-1, 3, -4}, b{-3, 1, -4}, c{-3, -2, -4};
    const auto rules = [](const std::vector<Corners>& ends) {
        auto added = strip(0, 5.4);
        added.insert(added.end(), ends.begin(), ends.end());
        return judged_widely(self_made(
            gaping(), {{0, added}},
            [&](const Corners& corners, const std::set<std::uint32_t>& parents) {
                const bool is_end = *parents.begin() >= 70 && *parents.begin() < 70 + ends.size();
                return !is_end && keep_left(corners, parents);
            }));
    };
    CHECK(rules({{corner, a, b}}) == "");
    CHECK(rules({{Point3{-0.5, 0, 0}, a, b}}) == "R54");
    CHECK(rules({{corner, other, c}}) == "R54");
    CHECK(rules({{corner, a, b}, {corner, b, c}}) == "R54");
}

TEST_CASE("sealed certificates: what is added and left out again widens no bound", "[sealing]") {
    auto triangles = strip(0, 5.4);
    const Corners end = triangles.back();
    triangles.push_back({end[2], end[1], Point3{1e12, 0, 1e12}});
    const auto near = self_made(gaping(), {{0, strip(0, 5.4)}}, keep_left);
    const auto far = self_made(gaping(), {{0, triangles}}, keep_left);
    const auto accepted = [](const Subject& s) {
        const auto certificate = parse_certificate(s.certificate.dump(), "c");
        REQUIRE(certificate);
        const auto verdict = verify_certificate(s.inputs, certificate.value());
        CHECK(verdict.violations.empty());
        REQUIRE(verdict.measured);
        REQUIRE(verdict.change);
        return std::array{verdict.measured->max_deviation, verdict.change->max_limit};
    };
    CHECK(accepted(near) == accepted(far));
}

TEST_CASE("sealed certificates: what a forger leaves out is refused", "[sealing]") {
    // Input triangles: 60 of the short sheet and 10 more, 60 of the long one, two of the fault.
    const std::map<std::size_t, std::vector<Corners>> added{{0, strip(0, 5.4)}};
    const auto with = [&](const auto& is_left_out) {
        return self_made(gaping(), added,
                         [&](const Corners& corners, const std::set<std::uint32_t>& parents) {
                             return keep_left(corners, parents) &&
                                    !is_left_out(corners, *parents.begin(), *parents.rbegin());
                         });
    };
    const auto between = [](const Corners& corners, std::size_t axis, double low, double high) {
        return std::ranges::all_of(corners, [&](const Point3& p) {
            const std::array<double, 3> at{p.x, p.y, p.z};
            return at[axis] > low - 1e-9 && at[axis] < high + 1e-9;
        });
    };
    CHECK(judged(with([](const auto&...) { return false; })) == "");
    // One cell of the long sheet; its end along the fault; half of it.
    CHECK(has_rule(
        judged_widely(with([](const Corners&, std::uint32_t p, std::uint32_t) { return p == 90; })),
        "R56"));
    CHECK(has_rule(judged_widely(with([&](const Corners& c, std::uint32_t p, std::uint32_t) {
                       return p >= 70 && p < 130 && between(c, 0, 4.2, 5);
                   })),
                   "R56"));
    CHECK(has_rule(judged_widely(with([&](const Corners& c, std::uint32_t p, std::uint32_t) {
                       return p >= 70 && p < 130 && between(c, 1, 0, 4);
                   })),
                   "R56"));
    // All of the strip: then nothing was added.
    CHECK(judged(with([](const Corners&, std::uint32_t p, std::uint32_t q) {
              return p >= 60 && q <= 69;
          })) == "");
    // The part of the strip from the border to a wall before the fault; the rest was kept.
    auto files = gaping();
    files.push_back({"wall.obj", "v 4.95 -1 -3\nv 4.95 11 -3\nv 4.95 11 5\nv 4.95 -1 5\ng wall\n"
                                 "f 1 2 3\nf 1 3 4\n"});
    CHECK(judged_widely(self_made(
              files, added, [&](const Corners& corners, const std::set<std::uint32_t>& parents) {
                  const bool is_strip = *parents.begin() >= 60 && *parents.rbegin() < 70;
                  return !is_strip || between(corners, 0, 4.95, 5);
              })) == "R54");
    // The part of the fault below the sheets, a whole one, is too far from the rest.
    const auto below = with([&](const Corners& c, std::uint32_t p, std::uint32_t) {
        return p >= 130 && between(c, 2, -3, 0.55);
    });
    CHECK(has_rule(judged(below), "R26"));
}
