// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of improved meshes: the verifier accepts what the producer writes and refutes each
// forgery, whatever limits it states.
#include "support/improved_certificates.hpp"
#include "support/paths.hpp"

#include <cmath>
#include <map>

namespace {

using namespace forged;

/// A wavy horizon and a wall that crosses it and ends inside.
std::vector<File> horizon_and_wall() {
    std::string text;
    const auto add = [&](double x, double y, double z) {
        text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    };
    constexpr int n = 9;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) add(i, j, 0.3 * std::sin(0.9 * i) * std::cos(0.7 * j));
    text += "g horizon\n";
    for (int i = 0; i + 1 < n; ++i)
        for (int j = 0; j + 1 < n; ++j) {
            const int a = i * n + j + 1, b = a + n;
            text += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
                    std::to_string(b + 1) + "\nf " + std::to_string(a) + " " +
                    std::to_string(b + 1) + " " + std::to_string(a + 1) + "\n";
        }
    const std::string wall = "v 3.3 -1 -2\nv 4.1 6.2 -2\nv 4.4 6.4 2\nv 3.6 -1 2\n"
                             "g wall\nf 1 2 3\nf 1 3 4\n";
    return {{"horizon.obj", text}, {"wall.obj", wall}};
}

const Subject& right_improved() {
    static const Subject subject =
        improved_subject(horizon_and_wall(), {.edge_length = 1.1}, {"obj"});
    return subject;
}

Forgery improved(const std::string& name, const std::function<void(Json&)>& change,
                 const std::string& rule) {
    return {name, [change](Json& c) { change(c["improved"]); }, rule};
}

double limit_of(const Json& mesh) {
    return std::stod(mesh["limits"][0].get<std::string>());
}

/// Returns a vertex of the improved mesh on an intersection edge, or one inside a region.
std::size_t vertex_of(const Json& mesh, bool on_curve) {
    std::set<std::size_t> intersections, curves;
    for (const Json& e : mesh["intersection_edges"])
        for (const Json& v : e) intersections.insert(v.get<std::size_t>());
    std::map<std::set<std::size_t>, int> uses;
    for (const Json& t : mesh["triangles"])
        for (std::size_t i = 0; i < 3; ++i)
            ++uses[{t[i].get<std::size_t>(), t[(i + 1) % 3].get<std::size_t>()}];
    for (const auto& [edge, count] : uses)
        if (count != 2) curves.insert(edge.begin(), edge.end());
    if (on_curve) return *std::next(intersections.begin(), 2);
    for (std::size_t v = 0; v < mesh["vertices"].size(); ++v)
        if (!curves.contains(v)) return v;
    return 0;
}

void turn_all(Json& mesh) {
    for (std::size_t t = 0; t < mesh["triangles"].size(); ++t) turn_over(mesh, t);
}

void erase_improved(Json& mesh, std::size_t t) {
    for (const char* list : {"triangles", "surfaces", "regions"}) mesh[list].erase(t);
}

/// Divides a triangle into three by a vertex, and moves that along an axis.
void raise_tent(Json& mesh, std::size_t t, double height) {
    const Json corners = mesh["triangles"][t];
    Json top = Json::array();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double sum = axis == 2 ? 3 * height : 0;
        for (const Json& v : corners)
            sum += std::stod(mesh["vertices"][v.get<std::size_t>()][axis].get<std::string>());
        top.push_back("0");
        shift_number(top.back(), sum / 3);
    }
    const auto v = static_cast<int>(mesh["vertices"].size());
    mesh["vertices"].push_back(top);
    mesh["triangles"][t] = {corners[0], corners[1], v};
    for (const std::size_t i : {1U, 2U}) {
        mesh["triangles"].push_back({corners[i], corners[(i + 1) % 3], v});
        mesh["surfaces"].push_back(mesh["surfaces"][t]);
        mesh["regions"].push_back(mesh["regions"][t]);
    }
}

} // namespace

TEST_CASE("improved certificates: accepted with each format") {
    const Subject subject = improved_subject(horizon_and_wall(), {.edge_length = 0.7},
                                             {"obj", "off", "ply", "vtp", "ts"});
    CHECK(judged(subject) == "");
    const auto parsed = parse_certificate(subject.certificate.dump(), "c");
    REQUIRE(parsed);
    const Verdict verdict = verify_certificate(subject.inputs, parsed.value());
    REQUIRE(verdict.change);
    CHECK(verdict.change->limit == limit_of(subject.certificate["improved"]));
    CHECK(verdict.change->limit <= verdict.change->max_limit);
    CHECK(judged(subject, {.max_change = 1e-6}) == "R26");
}

TEST_CASE("improved certificates: accepted for real surfaces") {
    for (const std::string name : {"manifold/Havocglass8_left.obj", "manifold/Cray_left.obj"}) {
        INFO(name);
        const std::string text = text_in(test_support::source_dir() + "/tests/data/" + name);
        CHECK(judged(improved_subject({{"input.obj", text}}, {})) == "");
    }
}

TEST_CASE("improved certificates: forged meshes") {
    check_forgeries(
        right_improved(),
        {
            improved(
                "a triangle is missing", [](Json& m) { erase_improved(m, 3); }, "R25"),
            improved(
                "all triangles of a surface are missing",
                [](Json& m) {
                    for (std::size_t t = m["triangles"].size(); t-- > 0;)
                        if (m["surfaces"][t] == Json({1})) erase_improved(m, t);
                },
                "R23"),
            improved(
                "a triangle twice",
                [](Json& m) {
                    for (const char* list : {"triangles", "surfaces", "regions"})
                        m[list].push_back(m[list][0]);
                },
                "R23"),
            improved(
                "a triangle is turned over", [](Json& m) { turn_over(m, 5); }, "R27"),
            improved("all triangles are turned over", turn_all, "R27"),
            improved(
                "a tent higher than the limit",
                [](Json& m) { raise_tent(m, 4, 1.5 * limit_of(m)); }, "R26"),
            improved(
                "a vertex moved out of the limit",
                [](Json& m) {
                    shift_number(m["vertices"][vertex_of(m, false)][2], 2 * limit_of(m));
                },
                "R26"),
            improved(
                "a vertex far away",
                [](Json& m) { shift_number(m["vertices"][vertex_of(m, false)][2], 1e6); }, "R26"),
            improved(
                "a vertex far away, with a limit as large",
                [](Json& m) {
                    shift_number(m["vertices"][vertex_of(m, false)][2], 1e6);
                    for (Json& limit : m["limits"]) limit = "1e+300";
                },
                "R26"),
            improved(
                "a vertex of a curve moved",
                [](Json& m) {
                    shift_number(m["vertices"][vertex_of(m, true)][0], 3 * limit_of(m));
                },
                "R25"),
            improved(
                "a vertex that no triangle has",
                [](Json& m) {
                    m["vertices"].push_back({"0", "0", "50"});
                },
                "R23"),
            improved(
                "another surface for a triangle",
                [](Json& m) { m["surfaces"][0] = Json({1 - m["surfaces"][0][0].get<int>()}); },
                "R24"),
            improved(
                "two regions exchanged",
                [](Json& m) {
                    const Json first = m["regions"][0];
                    for (Json& r : m["regions"])
                        if (r != first && r[0].get<int>() < 2) {
                            r = first;
                            break;
                        }
                },
                "R25"),
        });
}

TEST_CASE("improved certificates: forged lists and limits") {
    check_forgeries(
        right_improved(),
        {
            improved(
                "smaller limits",
                [](Json& m) {
                    for (Json& limit : m["limits"]) limit = "0.001";
                },
                "R26"),
            improved(
                "a negative limit", [](Json& m) { m["limits"][0] = "-1"; }, "R22"),
            improved(
                "a limit is missing", [](Json& m) { m["limits"].erase(0); }, "R22"),
            improved(
                "limits larger than what is accepted",
                [](Json& m) {
                    for (Json& limit : m["limits"]) limit = "100";
                },
                "R26"),
            improved(
                "an intersection edge is not listed",
                [](Json& m) { m["intersection_edges"].erase(0); }, "R25"),
            improved(
                "no intersection edge is listed",
                [](Json& m) { m["intersection_edges"] = Json::array(); }, "R25"),
            improved(
                "another edge is listed",
                [](Json& m) {
                    const auto n = m["vertices"].size();
                    m["intersection_edges"].push_back({n - 2, n - 1});
                },
                "R25"),
            improved(
                "a corner out of range",
                [](Json& m) { m["triangles"][0][0] = m["vertices"].size(); }, "R22"),
            improved(
                "a region is missing", [](Json& m) { m["regions"][0] = Json::array(); }, "R22"),
            improved(
                "a surface that does not exist", [](Json& m) { m["surfaces"][0] = Json({7}); },
                "R22"),
            {"the mesh before is missing", [](Json& c) { c["rounded"] = nullptr; }, "R23"},
            {"the mesh before was moved towards the improved one",
             [](Json& c) { shift_number(c["rounded"]["vertices"][40][2], 0.01); }, "R14"},
            {"the improved mesh as that before",
             [](Json& c) {
                 for (const char* list : {"vertices", "triangles", "intersection_edges", "regions"})
                     c["improved"][list] = c["rounded"][list];
                 c["improved"]["surfaces"] = c["improved"]["regions"];
             },
             "R21"},
        });
}

TEST_CASE("improved certificates: bodies stay in each other, and parts touch nowhere else") {
    std::vector<Surface> bodies;
    for (const auto& [low, size] : {std::pair{0.0, 12.0}, {2.0, 1.0}, {3.4, 1.0}, {300.0, 6.0}})
        bodies.push_back({"body",
                          Role::unknown,
                          {{low, low, low},
                           {low + size, low, low},
                           {low, low + size, low},
                           {low, low, low + size}},
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
    const Subject right = improved_subject({{"bodies.obj", obj_text(bodies)}}, {});
    const auto inner_moved = [](double by) {
        return [by](Json& m) {
            for (Json& p : m["vertices"])
                if (number_in(p[0]) >= 2 && number_in(p[0]) <= 3 && number_in(p[1]) >= 2)
                    shift_number(p[0], by);
            for (Json& limit : m["limits"]) limit = "20";
        };
    };
    // The boxes around it before and after have points in common.
    const auto just_outside = [](Json& m) {
        for (Json& p : m["vertices"]) {
            double sum = 0;
            for (const Json& x : p) sum += number_in(x);
            if (std::all_of(p.begin(), p.end(), [](const Json& x) { return number_in(x) > 3.3; }) &&
                sum < 11.5)
                for (Json& x : p) shift_number(x, 0.9);
        }
        for (Json& limit : m["limits"]) limit = "20";
    };
    const auto touching = [](Json& m) {
        std::map<std::vector<double>, std::size_t> at;
        for (std::size_t v = 0; v < m["vertices"].size(); ++v) {
            const Json& p = m["vertices"][v];
            at[{number_in(p[0]), number_in(p[1]), number_in(p[2])}] = v;
        }
        for (Json& t : m["triangles"])
            for (Json& corner : t)
                if (corner == at.at({2, 2, 2})) corner = at.at({0, 0, 0});
        drop_unused(m);
        for (Json& limit : m["limits"]) limit = "20";
    };
    const auto exchanged = [](Json& m) {
        for (Json& p : m["vertices"])
            if (const double x = number_in(p[0]); x >= 300) shift_number(p[0], 13);
        for (Json& limit : m["limits"]) limit = "20";
    };
    check_forgeries(right, {improved("the inner body is outside", inner_moved(9), "R39"),
                            improved("a body has just left the one around it", just_outside, "R39"),
                            improved("the body apart is elsewhere", exchanged, "R39"),
                            improved("the inner body touches the outer one", touching, "R25")});
    Subject moved = right;
    inner_moved(0.25)(moved.certificate["improved"]);
    seal(moved);
    CHECK(judged(moved).find("R39") == std::string::npos);
}

TEST_CASE("improved certificates: bodies that touch in a point keep it") {
    const Surface left{"left",
                       Role::unknown,
                       {{0, 0, 0}, {12, 0, 0}, {0, 12, 0}, {0, 0, 12}},
                       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
        right{"right",
              Role::unknown,
              {{12, 0, 0}, {18, 0, 0}, {12, 6, 0}, {12, 0, 6}},
              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    const Subject touching = improved_subject({{"bodies.obj", obj_text({left, right})}}, {});
    const auto parted = [](Json& m) {
        const Json point = Json::array({"12", "0", "0"});
        const auto at = std::find(m["vertices"].begin(), m["vertices"].end(), point);
        REQUIRE(at != m["vertices"].end());
        const Json v = at - m["vertices"].begin(), apart = m["vertices"].size();
        m["vertices"].push_back({"12.0625", "0", "0"});
        for (std::size_t t = 0; t < m["triangles"].size(); ++t)
            if (m["surfaces"][t] == Json::array({1}))
                std::replace(m["triangles"][t].begin(), m["triangles"][t].end(), v, apart);
        for (Json& limit : m["limits"]) limit = "0.125";
    };
    check_forgeries(touching, {improved("they do not touch", parted, "R25")});
}

TEST_CASE("improved certificates: an output file with one digit changed") {
    check_changed_digits(right_improved(), first_vertex);
}
