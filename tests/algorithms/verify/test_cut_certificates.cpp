// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of volumes of interest: the verifier accepts what the producer writes and refutes
// each forgery.
#include "support/cut_certificates.hpp"
#include "support/paths.hpp"

#include <cmath>
#include <map>

namespace {

using namespace forged;

const Subject& right_cut() {
    static const Subject subject = cut_subject(crossing_sheets(), the_box());
    return subject;
}

double cut_coordinate(const Json& mesh, const Json& vertex, std::size_t axis) {
    return number_in(mesh["vertices"][vertex.get<std::size_t>()][axis]);
}

std::size_t boundary_triangles() {
    return 12;
}

std::size_t own_triangles() {
    std::size_t count = 0;
    for (const Surface& s : right_cut().surfaces) count += s.triangles.size();
    return count - boundary_triangles();
}

/// Returns a triangle of the doubles with one parent that is no side of the box.
std::size_t inner_triangle(const Json& rounded) {
    for (std::size_t t = 0; t < rounded["triangles"].size(); ++t)
        if (rounded["parents"][t].size() == 1 && rounded["parents"][t][0] < own_triangles() - 2)
            return t;
    FAIL("there is no such triangle");
    return 0;
}

/// Returns an edge of a horizon that no other surface meets, by its two triangles.
std::array<std::size_t, 2> inner_pair(const Json& rounded) {
    std::map<std::set<std::size_t>, std::vector<std::size_t>> triangles_at;
    for (std::size_t t = 0; t < rounded["triangles"].size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            triangles_at[{rounded["triangles"][t][i].get<std::size_t>(),
                          rounded["triangles"][t][(i + 1) % 3].get<std::size_t>()}]
                .push_back(t);
    for (const auto& [edge, pair] : triangles_at)
        if (pair.size() == 2 && rounded["parents"][pair[0]] == rounded["parents"][pair[1]] &&
            rounded["parents"][pair[0]].size() == 1 &&
            rounded["parents"][pair[0]][0] < own_triangles())
            return {pair[0], pair[1]};
    FAIL("there is no such edge");
    return {0, 0};
}

double turn_of(const Json& mesh, const Json& a, const Json& b, const Json& c) {
    const auto x = [&](const Json& v) { return cut_coordinate(mesh, v, 0); };
    const auto y = [&](const Json& v) { return cut_coordinate(mesh, v, 1); };
    return (x(b) - x(a)) * (y(c) - y(a)) - (y(b) - y(a)) * (x(c) - x(a));
}

/// Exchanges the diagonal of two triangles of one input triangle, and says that the mesh has other
/// triangles than the exact part. This is still valid.
Subject with_other_diagonal(Subject s) {
    Json& mesh = s.certificate["rounded"];
    std::map<std::set<std::size_t>, std::vector<std::size_t>> triangles_at;
    for (std::size_t t = 0; t < mesh["triangles"].size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            triangles_at[{mesh["triangles"][t][i].get<std::size_t>(),
                          mesh["triangles"][t][(i + 1) % 3].get<std::size_t>()}]
                .push_back(t);
    for (const auto& [edge, pair] : triangles_at) {
        if (pair.size() != 2 || mesh["parents"][pair[0]] != mesh["parents"][pair[1]] ||
            mesh["parents"][pair[0]].size() != 1 ||
            mesh["parents"][pair[0]][0] >= own_triangles() - 2)
            continue;
        Json first = mesh["triangles"][pair[0]], second = mesh["triangles"][pair[1]];
        const auto beside = [&ends = edge](const Json& t) {
            for (std::size_t i = 0; i < 3; ++i)
                if (!ends.contains(t[i].get<std::size_t>())) return i;
            return std::size_t{0};
        };
        const std::size_t i = beside(first), j = beside(second);
        const Json a = first[i], b = first[(i + 1) % 3], c = second[j], d = first[(i + 2) % 3];
        const double abc = turn_of(mesh, a, b, c), acd = turn_of(mesh, a, c, d);
        if (!(abc * acd > 1e-6)) continue; // not convex
        mesh["triangles"][pair[0]] = {a, b, c};
        mesh["triangles"][pair[1]] = {a, c, d};
        break;
    }
    REQUIRE(mesh["triangles"] != right_cut().certificate["rounded"]["triangles"]);
    mesh["max_move"] = nullptr;
    mesh["deviation"] = "1e-13";
    s.certificate["outputs"] = Json::array();
    s.contents.clear();
    return s;
}

/// Turns the boundary over, and the triangles of both parts that are on it.
void turn_volume_over(Json& c) {
    for (Json& side : c["cut"]["volume"]["boundary"])
        for (std::size_t t = 0; t < side["triangles"].size(); ++t) turn_over(side, t);
    for (const std::string& name : both)
        for (std::size_t t = 0; t < c[name]["triangles"].size(); ++t)
            if (c[name]["parents"][t][0] >= own_triangles()) turn_over(c[name], t);
}

Forgery cut(const std::string& name, const std::function<void(Json&)>& change,
            const std::string& rule) {
    return {name, [change](Json& c) { change(c["cut"]); }, rule};
}

Forgery cut_doubles(const std::string& name, const std::function<void(Json&)>& change,
                    const std::string& rule) {
    return {name, [change](Json& c) { change(c["rounded"]); }, rule};
}

} // namespace

TEST_CASE("cut certificates: accepted with each shape and format", "[volume_of_interest]") {
    CHECK(judged(cut_subject(crossing_sheets(), the_box(), {"obj", "off", "ply", "vtp", "ts"})) ==
          "");
    CHECK(judged(cut_subject({crossing_sheets().back()}, the_box(), {"stl"})) == ""); // in float32
    CHECK(judged(cut_subject(crossing_sheets(), the_prism())) == "");
    CHECK(judged(cut_subject(crossing_sheets(),
                             rotated_volume({{5, 5, 0.5}, false, {5, 4, 3}, 20, 5, 3}))) == "");
    CHECK(judged(cut_subject(crossing_sheets(), file_volume(octahedron()))) == "");
    // A box around all, and one that nothing meets.
    CHECK(judged(cut_subject(crossing_sheets(), box_volume({-5, -5, -9}, {20, 20, 9}))) == "");
    CHECK(judged(cut_subject(crossing_sheets(), box_volume({30, 30, 30}, {31, 31, 31}))) == "");
}

TEST_CASE("cut certificates: accepted for real surfaces", "[volume_of_interest]") {
    const std::string source = test_support::source_dir();
    const std::vector<File> horizons{{"top.obj", obj_in(source + "/docs/data/top.ts")},
                                     {"base.obj", obj_in(source + "/docs/data/base.ts")},
                                     {"fault.obj", obj_in(source + "/docs/data/fault.ts")}};
    CHECK(judged(cut_subject(horizons, box_volume({0, 0, -1700}, {2000, 1500, -700}))) == "");
    CHECK(judged(cut_subject(
              horizons, file_volume({"body.obj", obj_in(source + "/docs/data/body.ts")}))) == "");
    for (const std::string name : {"manifold/Havocglass8_left.obj", "manifold/Cray_left.obj"}) {
        INFO(name);
        const File file{"input.obj", text_in(source + "/tests/data/" + name)};
        Point3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
        for (const InputFile& input : input_files({file}))
            for (const Surface& s : input.surfaces)
                for (const Point3& p : s.vertices) {
                    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
                }
        const auto between = [&](double share) {
            return Point3{low.x + share * (high.x - low.x), low.y + share * (high.y - low.y),
                          low.z + share * (high.z - low.z)};
        };
        CHECK(judged(cut_subject({file}, box_volume(between(0.21), between(0.77)))) == "");
    }
}

TEST_CASE("cut certificates: other triangles than those of the exact part are accepted",
          "[volume_of_interest]") {
    CHECK(judged(with_other_diagonal(right_cut())) == "");
}

TEST_CASE("cut certificates: forged volumes", "[volume_of_interest]") {
    check_forgeries(
        right_cut(),
        {
            cut(
                "a larger box", [](Json& c) { c["volume"]["between"][1] = "3"; }, "R50"),
            cut(
                "a corner elsewhere", [](Json& c) { c["volume"]["corners"][0][0] = "1"; }, "R50"),
            cut(
                "a larger box with its boundary",
                [](Json& c) {
                    c["volume"]["between"][1] = "2.5";
                    for (Json& s : c["volume"]["boundary"])
                        for (Json& v : s["vertices"])
                            if (v[2] == "2.4") v[2] = "2.5";
                },
                "R6"),
            cut(
                "corners in another order",
                [](Json& c) { std::swap(c["volume"]["corners"][0], c["volume"]["corners"][1]); },
                "R50"),
            cut(
                "a corner more",
                [](Json& c) {
                    c["volume"]["corners"].push_back({"0.9", "5"});
                },
                "R50"),
            cut(
                "a corner twice",
                [](Json& c) { c["volume"]["corners"].push_back(c["volume"]["corners"][0]); },
                "R50"),
            cut(
                "heights exchanged",
                [](Json& c) { std::swap(c["volume"]["between"][0], c["volume"]["between"][1]); },
                "R50"),
            cut(
                "one side is missing", [](Json& c) { c["volume"]["boundary"].erase(2); }, "R50"),
            cut(
                "a triangle of a side is missing",
                [](Json& c) { c["volume"]["boundary"][0]["triangles"].erase(0); }, "R50"),
            cut(
                "a triangle of a side is turned over",
                [](Json& c) { turn_over(c["volume"]["boundary"][0], 0); }, "R50"),
            cut(
                "a vertex of a side that is none",
                [](Json& c) { c["volume"]["boundary"][1]["vertices"][0][2] = "0"; }, "R50"),
            cut(
                "a corner of a side out of range",
                [](Json& c) { c["volume"]["boundary"][1]["triangles"][0][0] = 99; }, "R50"),
            cut(
                "another shape", [](Json& c) { c["volume"]["shape"] = "surface"; }, "R50"),
            cut(
                "an unknown shape", [](Json& c) { c["volume"]["shape"] = "sphere"; }, "R50"),
            cut(
                "said to be in the last file",
                [](Json& c) {
                    c["volume"]["shape"] = "surface";
                    c["volume"]["corners"] = Json::array();
                    c["volume"]["between"] = Json::array();
                    c["volume"]["files"] = 1;
                },
                "R50"),
            cut(
                "no boundary at all", [](Json& c) { c["volume"]["boundary"] = Json::array(); },
                "R50"),
            {"turned over, with all triangles on it", turn_volume_over, "R50"},
            {"the volume is left out", [](Json& c) { c["cut"].erase("volume"); }, "missing"},
            {"as an arrangement", [](Json& c) { c["kind"] = "arrangement"; }, "unknown"},
        });
}

TEST_CASE("cut certificates: forged rotated boxes", "[volume_of_interest]") {
    const Subject right =
        cut_subject(crossing_sheets(), rotated_volume({{5, 5, 0.5}, false, {5, 4, 3}, 20, 5, 3}));
    check_forgeries(
        right,
        {{"turned over, with all triangles on it", turn_volume_over, "R50"},
         cut(
             "a polygon that the boundary is not over",
             [](Json& c) {
                 c["volume"]["shape"] = "prism";
                 c["volume"]["corners"] = Json::array();
                 for (const auto& [x, y] : {std::array{"0", "0"}, {"9", "0"}, {"9", "9"}})
                     c["volume"]["corners"].push_back(Json::array({x, y}));
                 c["volume"]["between"] = Json::array({"-9", "9"});
             },
             "R50"),
         cut(
             "two bodies with eight corners together",
             [](Json& c) {
                 Json& sides = c["volume"]["boundary"];
                 sides = Json::array({sides[0]});
                 sides[0]["vertices"] = Json::array();
                 sides[0]["triangles"] = Json::array();
                 for (const int x : {0, 5})
                     for (const auto& [dx, dy, dz] :
                          {std::array{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
                         sides[0]["vertices"].push_back(
                             {std::to_string(x + dx), std::to_string(dy), std::to_string(dz)});
                 for (const int v : {0, 4})
                     for (const auto& [i, j, k] :
                          {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
                         sides[0]["triangles"].push_back({v + i, v + j, v + k});
             },
             "R50")});
}

TEST_CASE("cut certificates: forged lists of what is outside", "[volume_of_interest]") {
    check_forgeries(
        right_cut(),
        {
            cut(
                "a triangle outside is kept", [](Json& c) { c["dropped"].erase(3); }, "R51"),
            cut(
                "all is kept", [](Json& c) { c["dropped"] = Json::array(); }, "R51"),
            cut(
                "all is dropped",
                [](Json& c) {
                    const std::size_t all = right_cut().certificate["exact"]["triangles"].size();
                    c["dropped"] = Json::array();
                    for (std::size_t t = 0; t < all; ++t) c["dropped"].push_back(t);
                },
                "R51"),
            cut(
                "a triangle inside is dropped",
                [](Json& c) {
                    std::set<int> dropped(c["dropped"].begin(), c["dropped"].end());
                    for (int t = 0; dropped.insert(t).second == false; ++t) {
                    }
                    c["dropped"] = dropped;
                },
                "R51"),
            cut(
                "the list is not sorted",
                [](Json& c) { std::swap(c["dropped"][0], c["dropped"][1]); }, "R51"),
            cut(
                "a triangle twice", [](Json& c) { c["dropped"].push_back(c["dropped"].back()); },
                "R51"),
            cut(
                "a triangle that does not exist", [](Json& c) { c["dropped"].push_back(1000000); },
                "R51"),
            {"what is outside is missing in the exact part",
             [](Json& c) {
                 const Json dropped = c["cut"]["dropped"];
                 for (std::size_t i = dropped.size(); i-- > 0;)
                     drop_triangle(c["exact"], dropped[i].get<std::size_t>());
                 drop_unused(c["exact"]);
                 c["cut"]["dropped"] = Json::array();
             },
             "R6"},
        });
}

/// Drops the parts of the first 72 input triangles, and lists these triangles as vanished.
void hide_first_surface(Json& m) {
    std::set<int> inputs;
    for (int t = 0; t < 72; ++t) inputs.insert(t);
    std::set<int> vanished;
    for (const Json& parents : m["parents"])
        for (const Json& p : parents)
            if (p < 72) vanished.insert(p.get<int>());
    drop_children(m, inputs);
    m["vanished"] = vanished;
}

/// Returns forgeries of the doubles, whether these have the triangles of the exact part or others.
std::vector<Forgery> forged_doubles() {
    return {
        cut_doubles(
            "a triangle inside is missing", [](Json& m) { drop_triangle(m, inner_triangle(m)); },
            "R12"),
        cut_doubles(
            "two triangles are missing",
            [](Json& m) {
                const auto [a, b] = inner_pair(m);
                drop_triangle(m, std::max(a, b));
                drop_triangle(m, std::min(a, b));
            },
            "R12"),
        cut_doubles(
            "a triangle of the boundary is missing",
            [](Json& m) { drop_triangle(m, m["triangles"].size() - 1); }, "R18"),
        cut_doubles(
            "a vertex moved",
            [](Json& m) {
                Json& x = m["vertices"][m["triangles"][inner_triangle(m)][0].get<std::size_t>()][2];
                shift_number(x, 1e-9);
            },
            "R13"),
        cut_doubles(
            "a triangle outside is added",
            [](Json& m) {
                const auto v = static_cast<int>(m["vertices"].size());
                m["vertices"].push_back({"0", "0", "0"});
                m["vertices"].push_back({"0.1", "0", "0"});
                m["vertices"].push_back({"0", "0.1", "0"});
                add_triangle(m, {v, v + 1, v + 2}, {0});
            },
            "R13"),
        cut_doubles(
            "a triangle turned over", [](Json& m) { turn_over(m, inner_triangle(m)); }, "R19"),
        cut_doubles("all of a surface is missing, and listed as vanished", hide_first_surface,
                    "R12"),
        cut_doubles(
            "regions are exchanged", [](Json& m) { m["regions"][inner_triangle(m)][0] = 99; },
            "R16"),
        cut_doubles(
            "an intersection edge is missing", [](Json& m) { m["intersection_edges"].erase(0); },
            "R15"),
        cut_doubles(
            "a larger deviation than what is accepted", [](Json& m) { m["deviation"] = "1"; },
            "R13"),
        cut_doubles(
            "said not to be conforming", [](Json& m) { m["clean"] = false; }, "R11"),
        cut_doubles(
            "a triangle names another parent",
            [](Json& m) { m["parents"][inner_triangle(m)][0] = 60; }, "R13"),
    };
}

TEST_CASE("cut certificates: forged doubles", "[volume_of_interest]") {
    check_forgeries(right_cut(), forged_doubles());
    check_forgeries(right_cut(),
                    {cut_doubles(
                         "a smaller largest move", [](Json& m) { m["max_move"] = "0"; }, "R14"),
                     cut_doubles(
                         "a smaller deviation",
                         [](Json& m) {
                             m["max_move"] = "0";
                             m["deviation"] = "0";
                         },
                         "R13"),
                     {"another hash of an input",
                      [](Json& c) { c["inputs"][1]["sha256"] = std::string(64, '0'); }, "R9"},
                     {"the names of two surfaces exchanged",
                      [](Json& c) {
                          std::swap(c["inputs"][0]["surfaces"][0]["name"],
                                    c["inputs"][1]["surfaces"][0]["name"]);
                      },
                      "R9"}});
}

TEST_CASE("cut certificates: forged doubles with other triangles", "[volume_of_interest]") {
    const Subject right = with_other_diagonal(right_cut());
    check_forgeries(right, forged_doubles());
    check_forgeries(
        right,
        {cut_doubles(
             "a triangle that continues an input triangle outside",
             [](Json& m) {
                 // The part of the first input triangle with a part inside that is outside.
                 const Surface& s = right_cut().surfaces[0];
                 const auto v = static_cast<int>(m["vertices"].size());
                 int input = -1;
                 for (std::size_t t = 0; t < s.triangles.size() && input < 0; ++t) {
                     bool is_outside = true, has_parts = false;
                     for (const std::uint32_t corner : s.triangles[t])
                         is_outside = is_outside || s.vertices[corner].x < 0.9;
                     for (const Json& parents : m["parents"])
                         has_parts = has_parts || parents[0] == static_cast<int>(t);
                     if (is_outside && has_parts && s.vertices[s.triangles[t][0]].x < 0.9)
                         input = static_cast<int>(t);
                 }
                 REQUIRE(input >= 0);
                 const auto& corners = s.triangles[static_cast<std::size_t>(input)];
                 const Point3 &a = s.vertices[corners[0]], &b = s.vertices[corners[1]],
                              &c = s.vertices[corners[2]];
                 for (const auto& [k, l] : {std::pair(0.0, 0.0), {0.05, 0.0}, {0.0, 0.05}}) {
                     Json point = Json::array({"", "", ""});
                     point[0] = decimal_text(a.x + k * (b.x - a.x) + l * (c.x - a.x));
                     point[1] = decimal_text(a.y + k * (b.y - a.y) + l * (c.y - a.y));
                     point[2] = decimal_text(a.z + k * (b.z - a.z) + l * (c.z - a.z));
                     m["vertices"].push_back(point);
                 }
                 add_triangle(m, {v, v + 1, v + 2}, {input});
                 m["regions"].back() = {999};
             },
             "R18"),
         cut_doubles(
             "the largest move is stated", [](Json& m) { m["max_move"] = "1e-15"; }, "R14")});
}

TEST_CASE("cut certificates: surfaces of files", "[volume_of_interest]") {
    const Subject right = cut_subject(crossing_sheets(), file_volume(octahedron()));
    check_forgeries(
        right,
        {cut(
             "a vertex of the boundary moved by a little",
             [](Json& c) { c["volume"]["boundary"][0]["vertices"][0][2] = "0.2000001"; }, "R50"),
         cut(
             "the boundary wound the other way",
             [](Json& c) {
                 for (std::size_t t = 0; t < 8; ++t) turn_over(c["volume"]["boundary"][0], t);
             },
             "R50"),
         cut(
             "said to be no file", [](Json& c) { c["volume"]["files"] = 0; }, "R50"),
         cut(
             "said to be all files", [](Json& c) { c["volume"]["files"] = 4; }, "R50"),
         cut(
             "said to be more files than there are", [](Json& c) { c["volume"]["files"] = 5; },
             "fewer"),
         {"another file", [](Json& c) { c["inputs"][3]["sha256"] = std::string(64, '0'); }, "R9"}});
}

TEST_CASE("cut certificates: output files", "[volume_of_interest]") {
    const Subject right = cut_subject(crossing_sheets(), the_box(), {"obj", "ply", "vtp", "ts"});
    check_changed_digits(right, middle_of);
    Subject wrong = right;
    wrong.certificate["outputs"][0]["surfaces"].erase(8);
    CHECK(judged(wrong) == "R21");
}
