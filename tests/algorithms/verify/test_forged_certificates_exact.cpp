// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates with a false exact part and a right digest of it: the verifier refutes each.
#include "support/forged.hpp"

namespace {

using namespace forged;

/// Three planes through the origin, each of one triangle.
std::vector<File> three_planes() {
    return {{"planes.obj", "v -8 -8 0\nv 9 -7 0\nv 0 11 0\n"
                           "v -8 0 -8\nv 9 0 -7\nv 0 0 11\n"
                           "v 0 -8 -8\nv 0 9 -7\nv 0 0.5 11\n"
                           "g a\nf 1 2 3\ng b\nf 4 5 6\ng c\nf 7 8 9\n"}};
}

/// Changes the exact part only.
Forgery exact(const std::string& name, const std::function<void(Json&)>& change,
              const std::string& rule) {
    return {name, [change](Json& c) { change(c["exact"]); }, rule};
}

/// Changes both parts in the same way.
Forgery both_parts(const std::string& name, const std::function<void(Json&)>& change,
                   const std::string& rule) {
    return {name,
            [change](Json& c) {
                for (const auto& part : both) change(c[part]);
            },
            rule};
}

/// Divides triangle t into three at a new vertex.
void divide_in_middle(Json& part, std::size_t t, const Json& vertex) {
    const auto v = part["vertices"].size();
    part["vertices"].push_back(vertex);
    const Json corners = part["triangles"][t], parents = part["parents"][t];
    for (std::size_t i = 0; i < 3; ++i)
        add_triangle(part, {corners[i], corners[(i + 1) % 3], v}, parents);
    drop_triangle(part, t);
}

} // namespace

TEST_CASE("forged certificates: a spurious vertex, in both parts") {
    // The plane x = 4 of surface d crosses the line from corner 0 to surface c within triangle 0.
    const std::vector<File> files{{"square.obj",
                                   "v 0 0 0\nv 8 0 0\nv 8 8 0\nv 0 8 0\n"
                                   "v 40 10 0\nv 41 10 0\nv 40 11 0\nv 4 20 0\nv 4 21 0\nv 4 20 1\n"
                                   "g a\nf 1 2 3\nf 1 3 4\ng c\nf 5 6 7\ng d\nf 8 9 10\n"}};
    const Subject s = subject(files);
    std::size_t first = 0; // part of input triangle 0
    while (s.certificate["exact"]["parents"][first] != Json{0}) ++first;
    const auto divide = [first](Json& c, const Json& how, const Json& place) {
        divide_in_middle(c["exact"], first, how);
        divide_in_middle(c["rounded"], first, place);
    };
    check_forgeries(s, {{"in the middle of a triangle, by a line that no triangle has",
                         [&](Json& c) {
                             divide(c, {"lp", 0, 4, 7, 8, 9}, {"4", "1", "0"});
                         },
                         "R20"}});
}

TEST_CASE("forged certificates: vertices that the inputs do not force") {
    // The edge 0 2 of the square is common to both triangles; the line 1 3 crosses it in (4, 4).
    const std::vector<File> files{
        {"square.obj", "v 0 0 0\nv 8 0 0\nv 8 8 0\nv 0 8 0\ng a\nf 1 2 3\nf 1 3 4\n"}};
    const auto split_edge = [](Json& part, const Json& vertex) {
        part["vertices"].push_back(vertex);
        part["triangles"] = {{0, 1, 4}, {1, 2, 4}, {0, 4, 3}, {4, 2, 3}};
        part["parents"] = {{0}, {0}, {1}, {1}};
        if (part.contains("regions")) part["regions"] = {{0}, {0}, {0}, {0}};
    };
    check_forgeries(subject(files), {{"in the middle of an edge that two triangles share",
                                      [&](Json& c) {
                                          split_edge(c["exact"], {"ll", 0, 2, 1, 3, "z"});
                                          split_edge(c["rounded"], {"4", "4", "0"});
                                      },
                                      "R20"},
                                     {"in the middle of a free border",
                                      [](Json& c) {
                                          c["exact"]["vertices"].push_back({"lp", 0, 1, 2, 3, 3});
                                          c["exact"]["vertices"][4] = {"v", 1};
                                      },
                                      "R3"}});
}

TEST_CASE("forged certificates: the middle of an intersection segment is no vertex") {
    // The wall at x = 2 crosses the large triangle from (2, 1.5) to (2, 2.5). Between them, the
    // plane y = 2 through three input vertices crosses both, but no input triangle lies in it.
    const std::vector<File> files{{"t.obj", "v -9 2 0\nv 9 -9 0\nv 9 12 0\n"
                                            "v 2 1 -1\nv 2 3 -1\nv 2 2 1\n"
                                            "v 20 2 5\nv 21 2 5\nv 20 3 5\n"
                                            "g a\nf 1 2 3\ng b\nf 4 5 6\ng c\nf 7 8 9\n"}};
    const Subject s = subject(files);
    REQUIRE(s.certificate["exact"]["intersection_edges"].size() == 1);
    const auto split = [](Json& part, const Json& vertex) {
        const Json edge = part["intersection_edges"][0];
        const auto v = part["vertices"].size();
        part["vertices"].push_back(vertex);
        for (std::size_t t = part["triangles"].size(); t-- > 0;) {
            const Json corners = part["triangles"][t], parents = part["parents"][t];
            for (std::size_t i = 0; i < 3; ++i) {
                const Json from = corners[i], to = corners[(i + 1) % 3];
                if (Json::array({std::min(from, to), std::max(from, to)}) != edge) continue;
                add_triangle(part, {from, v, corners[(i + 2) % 3]}, parents);
                add_triangle(part, {v, to, corners[(i + 2) % 3]}, parents);
                drop_triangle(part, t);
            }
        }
        part["intersection_edges"] = {{edge[0], v}, {edge[1], v}};
    };
    check_forgeries(s, {{"divided",
                         [&](Json& c) {
                             split(c["exact"], {"ppp", 0, 1, 2, 3, 4, 5, 0, 5, 6});
                             split(c["rounded"], {"2", "2", "0"});
                         },
                         "R20"}});
}

TEST_CASE("forged certificates: which way triangles face") {
    const Subject s = subject(with_a_third());
    const std::size_t count = s.certificate["exact"]["triangles"].size();
    std::vector<Forgery> forgeries{
        both_parts(
            "all triangles turned over",
            [](Json& p) {
                for (std::size_t t = 0; t < p["triangles"].size(); ++t) turn_over(p, t);
            },
            "R19"),
        both_parts(
            "one surface turned over",
            [](Json& p) {
                for (std::size_t t = 0; t < p["triangles"].size(); ++t)
                    if (p["parents"][t] == Json{1}) turn_over(p, t);
            },
            "R19"),
        {"one triangle of the doubles turned over", [](Json& c) { turn_over(c["rounded"], 0); },
         "R19"},
    };
    for (std::size_t t = 0; t < count; ++t)
        forgeries.push_back(both_parts(
            "triangle " + std::to_string(t) + " turned over", [t](Json& p) { turn_over(p, t); },
            "R19"));
    check_forgeries(s, forgeries);
}

TEST_CASE("forged certificates: elements of the exact part") {
    check_forgeries(
        subject(with_a_third()),
        {
            exact(
                "a triangle dropped", [](Json& p) { drop_triangle(p, 0); }, "R6"),
            both_parts(
                "a triangle dropped in both parts", [](Json& p) { drop_triangle(p, 0); }, "R6"),
            both_parts(
                "a component dropped",
                [](Json& p) {
                    drop_children(p, {2, 3});
                },
                "R6"),
            both_parts(
                "a component dropped, its vertices kept",
                [](Json& p) {
                    for (std::size_t t = p["triangles"].size(); t-- > 0;)
                        if (p["parents"][t][0] >= 2) drop_triangle(p, t);
                },
                "R3"),
            both_parts(
                "everything dropped",
                [](Json& p) {
                    drop_children(p, {0, 1, 2, 3});
                },
                "R6"),
            both_parts(
                "a component said to have no area",
                [](Json& p) {
                    drop_children(p, {2, 3});
                    if (p.contains("degenerate")) p["degenerate"] = {2, 3};
                },
                "R8"),
            both_parts(
                "a triangle said to be a duplicate",
                [](Json& p) {
                    if (p.contains("duplicates")) p["duplicates"] = {{3, 2}};
                },
                "R8"),
            both_parts(
                "a triangle twice",
                [](Json& p) { add_triangle(p, p["triangles"][0], p["parents"][0]); }, "R4"),
            both_parts(
                "a triangle twice, with another corner first",
                [](Json& p) {
                    const Json t = p["triangles"][0];
                    add_triangle(p, {t[1], t[2], t[0]}, p["parents"][0]);
                },
                "R4"),
            both_parts(
                "a triangle of nothing between two surfaces",
                [](Json& p) {
                    add_triangle(p, {0, 3, 6}, {0});
                },
                "R6"),
            both_parts(
                "a bridge to the component apart",
                [](Json& p) {
                    add_triangle(p, {0, 1, p["triangles"].back()[0]}, {0});
                },
                "R6"),
            both_parts(
                "parents of two triangles swapped",
                [](Json& p) { std::swap(p["parents"].front(), p["parents"].back()); }, "R6"),
            both_parts(
                "a parent too many",
                [](Json& p) {
                    p["parents"][0] = {0, 1};
                },
                "R6"),
            both_parts(
                "another parent", [](Json& p) { p["parents"][0] = {1}; }, "R6"),
            both_parts(
                "no intersection edges", [](Json& p) { p["intersection_edges"] = Json::array(); },
                "R7"),
            both_parts(
                "an intersection edge too many",
                [](Json& p) {
                    p["intersection_edges"].insert(p["intersection_edges"].begin(), Json{0, 1});
                },
                "R7"),
            both_parts(
                "an intersection edge the other way round",
                [](Json& p) {
                    p["intersection_edges"][0] = {p["intersection_edges"][0][1],
                                                  p["intersection_edges"][0][0]};
                },
                "R1"),
            exact(
                "a vertex that no triangle has",
                [](Json& p) {
                    p["vertices"].push_back({"lp", 0, 1, 3, 4, 5});
                },
                "R3"),
            exact(
                "a vertex for another point",
                [](Json& p) { p["vertices"][6] = {"lp", 3, 4, 0, 1, 2}; }, "R6"),
            exact(
                "a vertex by a line in the plane",
                [](Json& p) { p["vertices"][6] = {"lp", 0, 1, 0, 1, 2}; }, "R2"),
            exact(
                "a vertex by three planes through a line",
                [](Json& p) { p["vertices"][6] = {"ppp", 0, 1, 2, 0, 1, 3, 0, 1, 4}; }, "R2"),
            exact(
                "two vertices exchanged",
                [](Json& p) { std::swap(p["vertices"][6], p["vertices"][7]); }, "R6"),
            exact(
                "one point with two numbers",
                [](Json& p) {
                    p["vertices"].push_back(p["vertices"][6]);
                    for (Json& v : p["triangles"][5])
                        if (v == 6) v = p["vertices"].size() - 1;
                },
                "R3"),
            exact(
                "two points merged",
                [](Json& p) {
                    for (Json& t : p["triangles"])
                        for (Json& v : t)
                            if (v == 7) v = 6;
                },
                "R6"),
            {"another digest", [](Json& c) { c["exact"]["degenerate"] = {0}; }, "R8"},
            {"the surfaces of an input exchanged with those of another",
             [](Json& c) { std::swap(c["inputs"][0]["surfaces"], c["inputs"][1]["surfaces"]); },
             "R9"},
            {"the name of a surface", [](Json& c) { c["inputs"][0]["surfaces"][0]["name"] = "x"; },
             "R9"},
            {"the role of a surface",
             [](Json& c) { c["inputs"][0]["surfaces"][0]["role"] = "fault"; }, "R9"},
            {"an input left out", [](Json& c) { c["inputs"].erase(2); }, "R9"},
            {"an input twice", [](Json& c) { c["inputs"].push_back(c["inputs"][0]); }, "R9"},
        });
}

TEST_CASE("forged certificates: undivided where surfaces cross") {
    check_forgeries(subject(pierced()), {both_parts(
                                            "as if the surfaces did not cross",
                                            [](Json& p) {
                                                p["triangles"] = {{0, 1, 2}, {3, 4, 5}};
                                                p["parents"] = {{0}, {1}};
                                                if (p.contains("regions"))
                                                    p["regions"] = {{0}, {1}};
                                                drop_unused(p);
                                            },
                                            "R5")});
    const Subject s = subject(three_planes());
    REQUIRE(judged(s) == "");
}

TEST_CASE("forged certificates: coplanar surfaces") {
    const auto without_parent = [](Json& p, int parent) {
        for (Json& parents : p["parents"])
            if (parents.size() > 1)
                parents.erase(std::remove(parents.begin(), parents.end(), Json(parent)),
                              parents.end());
    };
    check_forgeries(
        subject(overlapping()),
        {
            both_parts(
                "the overlap belongs to one surface only", [&](Json& p) { without_parent(p, 0); },
                "R6"),
            both_parts(
                "a duplicate names nothing", [&](Json& p) { without_parent(p, 3); }, "R6"),
            both_parts(
                "a degenerate triangle is a parent",
                [](Json& p) {
                    p["parents"][0] = {0, 1};
                },
                "R6"),
            exact(
                "degenerate triangle not listed", [](Json& p) { p["degenerate"] = Json::array(); },
                "R8"),
            exact(
                "duplicate not listed", [](Json& p) { p["duplicates"] = Json::array(); }, "R8"),
            exact(
                "first and duplicate exchanged",
                [](Json& p) {
                    p["duplicates"] = {{2, 3}};
                },
                "R8"),
        });
}

TEST_CASE("forged certificates: true statements under other numbers stay valid") {
    const Subject right = subject(with_a_third());
    Subject same = right;
    Json& exact = same.certificate["exact"]; // the vertices of the exact part in reverse order
    const auto count = exact["vertices"].size();
    std::reverse(exact["vertices"].begin(), exact["vertices"].end());
    for (const char* list : {"triangles", "intersection_edges"})
        for (Json& item : exact[list])
            for (Json& v : item) v = count - 1 - v.get<std::size_t>();
    for (Json& edge : exact["intersection_edges"]) std::sort(edge.begin(), edge.end());
    std::sort(exact["intersection_edges"].begin(), exact["intersection_edges"].end());
    same.certificate["rounded"]["max_move"] = nullptr; // its triangles have other numbers now
    Json& deviation = same.certificate["rounded"]["deviation"];
    deviation = "1e-13";
    seal(same);
    CHECK(same.certificate["digest"] == right.certificate["digest"]);
    CHECK(judged(same) == "");
}
