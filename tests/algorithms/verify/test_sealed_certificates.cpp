// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of surfaces that were sealed or extended: the verifier accepts what the producer writes
// and refutes each forgery.
#include "support/paths.hpp"
#include "support/sealed_certificates.hpp"

#include <charconv>
#include <cmath>

namespace {

using namespace forged;

const Subject& right_sealed() {
    static const Subject subject = sealed_subject(gaping(), {std::nullopt, 0.3, 0});
    return subject;
}

const Subject& right_extended() {
    static const Subject subject = sealed_subject(gaping(), {gaping_box(), 0.3, 2.5});
    return subject;
}

Forgery sealed(const std::string& name, const std::function<void(Json&)>& change,
               const std::string& rule) {
    return {name, [change](Json& c) { change(c["sealed"]); }, rule};
}

Forgery left_out(const std::string& name, const std::function<void(Json&)>& change,
                 const std::string& rule) {
    return {name, change, rule};
}

/// The input triangles of a certificate: those of a surface, given and added.
struct Numbering {
    explicit Numbering(const Json& c) {
        std::size_t s = 0;
        for (const Json& input : c["inputs"])
            for (const Json& surface : input["surfaces"]) {
                if (s == c["sealed"].size()) return;
                given.push_back(next);
                added.push_back(next + surface["triangles"].get<std::size_t>());
                next = added.back() + c["sealed"][s]["extended"].size() +
                       c["sealed"][s]["sealed"].size();
                ++s;
            }
    }
    [[nodiscard]] bool is_added(std::size_t p) const {
        for (std::size_t s = 0; s < given.size(); ++s)
            if (p >= added[s] && p < (s + 1 < given.size() ? given[s + 1] : next)) return true;
        return false;
    }
    std::vector<std::size_t> given, added;
    std::size_t next = 0;
};

/// Tells whether all parents of an exact triangle were added.
bool is_added(const Json& c, const Numbering& numbers, std::size_t t) {
    for (const Json& p : c["exact"]["parents"][t])
        if (!numbers.is_added(p.get<std::size_t>())) return false;
    return true;
}

bool is_dropped(const Json& c, std::size_t t) {
    const Json& dropped = c["cut"]["dropped"];
    return std::find(dropped.begin(), dropped.end(), Json(t)) != dropped.end();
}

/// Returns the exact triangles that were kept or dropped, and are added or given.
std::vector<std::size_t> exact_triangles(const Json& c, bool dropped, bool added) {
    const Numbering numbers(c);
    std::vector<std::size_t> found;
    for (std::size_t t = 0; t < c["exact"]["triangles"].size(); ++t)
        if (is_dropped(c, t) == dropped && is_added(c, numbers, t) == added) found.push_back(t);
    REQUIRE_FALSE(found.empty());
    return found;
}

/// Lists exact triangles as dropped, and takes those with the same numbers out of the doubles, which have
/// the triangles of the exact part.
void drop_exact(Json& c, const std::vector<std::size_t>& more) {
    const std::set<std::size_t> gone(more.begin(), more.end());
    std::set<std::size_t> dropped(c["cut"]["dropped"].begin(), c["cut"]["dropped"].end());
    for (std::size_t t = c["exact"]["triangles"].size(), kept = c["rounded"]["triangles"].size();
         t-- > 0;) {
        if (dropped.contains(t)) continue;
        --kept;
        if (gone.contains(t)) drop_triangle(c["rounded"], kept);
    }
    dropped.insert(gone.begin(), gone.end());
    c["cut"]["dropped"] = dropped;
    drop_unused(c["rounded"]);
    c["outputs"] = Json::array();
}

void set_number(Json& number, double value) {
    char buffer[64];
    number = std::string(buffer, std::to_chars(buffer, buffer + 64, value).ptr);
}

double number_in(const Json& number) {
    return std::stod(number.get<std::string>());
}

/// Returns the number of each vertex of the doubles, by the exact vertex; -1: it was not kept.
std::vector<int> doubles_of_exact(const Json& c) {
    std::vector<int> number(c["exact"]["vertices"].size(), -1);
    for (std::size_t t = 0; t < c["exact"]["triangles"].size(); ++t)
        if (!is_dropped(c, t))
            for (const Json& v : c["exact"]["triangles"][t]) number[v.get<std::size_t>()] = 0;
    int next = 0;
    for (int& n : number)
        if (n == 0) n = next++;
    REQUIRE(static_cast<std::size_t>(next) == c["rounded"]["vertices"].size());
    return number;
}

/// Exchanges the diagonal of two triangles of one input triangle, and says that the doubles have other
/// triangles than the exact part. This is still valid.
Subject with_diagonal(Subject s) {
    Json& mesh = s.certificate["rounded"];
    const Json before = mesh["triangles"];
    std::map<std::set<std::size_t>, std::vector<std::size_t>> at;
    for (std::size_t t = 0; t < before.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            at[{before[t][i].get<std::size_t>(), before[t][(i + 1) % 3].get<std::size_t>()}]
                .push_back(t);
    const auto turn = [&](const Json& a, const Json& b, const Json& c) {
        const auto x = [&](const Json& v, std::size_t i) {
            return number_in(mesh["vertices"][v.get<std::size_t>()][i]);
        };
        return (x(b, 0) - x(a, 0)) * (x(c, 1) - x(a, 1)) -
               (x(b, 1) - x(a, 1)) * (x(c, 0) - x(a, 0));
    };
    for (const auto& [edge, pair] : at) {
        if (pair.size() != 2 || mesh["parents"][pair[0]] != mesh["parents"][pair[1]] ||
            mesh["parents"][pair[0]].size() != 1)
            continue;
        const auto beside = [&ends = edge](const Json& t) {
            for (std::size_t i = 0; i < 3; ++i)
                if (!ends.contains(t[i].get<std::size_t>())) return i;
            return std::size_t{0};
        };
        const Json first = before[pair[0]], second = before[pair[1]];
        const std::size_t i = beside(first), j = beside(second);
        const Json a = first[i], b = first[(i + 1) % 3], c = second[j], d = first[(i + 2) % 3];
        if (!(turn(a, b, c) * turn(a, c, d) > 1e-6)) continue; // not convex, or upright
        mesh["triangles"][pair[0]] = {a, b, c};
        mesh["triangles"][pair[1]] = {a, c, d};
        break;
    }
    REQUIRE(mesh["triangles"] != before);
    mesh["max_move"] = nullptr;
    mesh["deviation"] = "1e-13";
    s.certificate["outputs"] = Json::array();
    s.contents.clear();
    return s;
}

/// Puts what was trimmed back into the doubles.
void put_back(Json& c) {
    auto number = doubles_of_exact(c);
    Json& mesh = c["rounded"];
    int region = 0;
    for (const Json& regions : mesh["regions"])
        for (const Json& r : regions) region = std::max(region, r.get<int>() + 1);
    for (const std::size_t t : exact_triangles(c, true, false)) {
        Json corners = Json::array();
        for (const Json& v : c["exact"]["triangles"][t]) {
            int& n = number[v.get<std::size_t>()];
            if (n < 0) {
                const Json& how = c["exact"]["vertices"][v.get<std::size_t>()];
                REQUIRE(how[0] == "v");
                std::size_t k = how[1].get<std::size_t>();
                n = static_cast<int>(mesh["vertices"].size());
                Json place;
                std::size_t surface = 0;
                for (const Surface& s : right_sealed().surfaces) {
                    if (k < s.vertices.size()) {
                        place = {"", "", ""};
                        const Point3& p = s.vertices[k];
                        set_number(place[0], p.x);
                        set_number(place[1], p.y);
                        set_number(place[2], p.z);
                        break;
                    }
                    k -= s.vertices.size();
                    ++surface;
                }
                mesh["vertices"].push_back(place);
            }
            corners.push_back(n);
        }
        mesh["triangles"].push_back(corners);
        mesh["parents"].push_back(c["exact"]["parents"][t]);
        mesh["regions"].push_back({region});
    }
}

// --- Forgers who arrange by themselves ------------------------------------------------------------

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

std::string judged_widely(const Subject& s) {
    VerifyOptions options;
    options.max_change = 100;
    return judged(s, options);
}

bool has_rule(const std::string& rules, const std::string& rule) {
    return (" " + rules + " ").find(" " + rule + " ") != std::string::npos;
}

} // namespace

TEST_CASE("sealed certificates: accepted", "[sealing]") {
    CHECK(judged(right_sealed()) == "");
    CHECK(right_sealed().certificate["kind"] == "sealed");
    CHECK(judged(right_extended()) == "");
    CHECK(judged(sealed_subject(gaping(), {std::nullopt, 0.3, 0},
                                {"obj", "off", "ply", "vtp", "ts", "stl"})) == "");
    CHECK(judged(sealed_subject(gaping(), {gaping_box(), 0, 2.5})) == "");
    CHECK(judged(sealed_subject(gaping(), {gaping_box(), 0.3, 0})) == "");
    // Nothing to seal.
    const Subject idle = sealed_subject(crossing(), {std::nullopt, 1e-9, 0});
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
    for (const std::string name : {"top", "base", "fault"}) {
        const auto surfaces = read_surfaces(data + name + ".ts");
        REQUIRE(surfaces);
        std::string text;
        std::size_t first = 1;
        for (const Surface& s : surfaces.value()) {
            for (const Point3& p : s.vertices) {
                text += "v";
                for (const double x : {p.x, p.y, p.z}) {
                    Json number;
                    set_number(number, x);
                    text += " " + number.get<std::string>();
                }
                text += "\n";
            }
            text += "g " + s.name + "\n";
            for (const Triangle& t : s.triangles) {
                text += "f";
                for (const std::uint32_t v : t) text += " " + std::to_string(v + first);
                text += "\n";
            }
            first += s.vertices.size();
        }
        files.push_back({name + ".obj", text});
    }
    const Volume box = box_volume({0, 0, -1700}, {2000, 1500, -700});
    CHECK(judged(sealed_subject(files, {box, 20, 60})) == "");
    CHECK(judged(sealed_subject(files, {std::nullopt, 20, 0})) == "");
}

TEST_CASE("sealed certificates: forged lists of what was added", "[sealing]") {
    const auto first_added = [](Json& s) -> Json& { return s[0]["sealed"][0]; };
    check_grown(
        right_sealed(),
        {
            sealed(
                "a limit of nothing", [](Json& s) { s[0]["limit"] = "0"; }, "R26"),
            sealed(
                "half of the limit",
                [](Json& s) { set_number(s[0]["limit"], number_in(s[0]["limit"]) / 2); }, "R26"),
            sealed(
                "nine tenths of the limit",
                [](Json& s) { set_number(s[0]["limit"], number_in(s[0]["limit"]) * 0.9); }, "R26"),
            sealed(
                "nine tenths of the limit of what was trimmed",
                [](Json& s) { set_number(s[1]["limit"], number_in(s[1]["limit"]) * 0.9); }, "R26"),
            sealed(
                "a limit above all that is accepted",
                [](Json& s) { set_number(s[0]["limit"], 1e9); }, "R26"),
            sealed(
                "a large limit of an unchanged surface", [](Json& s) { s[2]["limit"] = "1"; },
                "R26"),
            sealed(
                "a negative limit", [](Json& s) { s[0]["limit"] = "-1"; }, "R53"),
            sealed(
                "a surface is missing", [](Json& s) { s.erase(2); }, "R53"),
            sealed(
                "a surface too many", [](Json& s) { s.push_back(s[2]); }, "R53"),
            sealed(
                "the surfaces exchanged", [](Json& s) { std::swap(s[0], s[1]); }, "R2"),
            sealed(
                "an added triangle is missing", [](Json& s) { s[0]["sealed"].erase(0); }, "R1"),
            sealed(
                "nothing was added", [](Json& s) { s[0]["sealed"] = Json::array(); }, "R1"),
            sealed(
                "an added corner elsewhere", [&](Json& s) { first_added(s)[2][0] = "6"; }, "R6"),
            sealed(
                "an added corner a little aside",
                [&](Json& s) {
                    Json& x = first_added(s)[2][0];
                    set_number(x, std::nextafter(number_in(x), 100));
                },
                "R6"),
            sealed(
                "an added triangle turned over",
                [&](Json& s) { std::swap(first_added(s)[0], first_added(s)[1]); }, "R19"),
            sealed(
                "an added triangle twice",
                [&](Json& s) { s[0]["sealed"].push_back(first_added(s)); }, "R2"),
            sealed(
                "an added triangle of another surface",
                [&](Json& s) {
                    s[1]["sealed"].push_back(s[0]["sealed"].back());
                    s[0]["sealed"].erase(s[0]["sealed"].size() - 1);
                },
                "R6"),
            {"the added triangles are left out", [](Json& c) { c.erase("sealed"); }, "missing"},
            {"a key of a part is left out", [](Json& c) { c["sealed"][0].erase("extended"); },
             "missing"},
            {"as a cut", [](Json& c) { c["kind"] = "cut"; }, "unknown"},
            {"as an arrangement", [](Json& c) { c["kind"] = "arrangement"; }, "unknown"},
        });
}

TEST_CASE("sealed certificates: forged lists of what was left out", "[sealing]") {
    check_grown(
        right_sealed(),
        {
            left_out(
                "what is beyond the fault was kept",
                [](Json& c) { c["cut"]["dropped"] = Json::array(); }, "R55"),
            left_out(
                "one triangle beyond the fault was kept",
                [](Json& c) {
                    const std::size_t t = exact_triangles(c, true, true).front();
                    std::set<std::size_t> dropped(c["cut"]["dropped"].begin(),
                                                  c["cut"]["dropped"].end());
                    dropped.erase(t);
                    c["cut"]["dropped"] = dropped;
                },
                "R26"),
            left_out(
                "a part of what was trimmed was kept",
                [](Json& c) {
                    const std::size_t t = exact_triangles(c, true, false).front();
                    std::set<std::size_t> dropped(c["cut"]["dropped"].begin(),
                                                  c["cut"]["dropped"].end());
                    dropped.erase(t);
                    c["cut"]["dropped"] = dropped;
                },
                "R56"),
            left_out(
                "a given triangle is missing",
                [](Json& c) { drop_exact(c, {exact_triangles(c, false, false).front()}); }, "R56"),
            left_out(
                "a triangle at the border is missing",
                [](Json& c) { drop_exact(c, {exact_triangles(c, false, false).back()}); }, "R56"),
            left_out(
                "a triangle of a strip is missing",
                [](Json& c) {
                    const auto kept = exact_triangles(c, false, true);
                    drop_exact(c, {kept[kept.size() / 2]});
                },
                "R55"),
            left_out(
                "the fault is missing",
                [](Json& c) {
                    const std::size_t first = Numbering(c).given[2];
                    std::vector<std::size_t> gone;
                    for (const std::size_t t : exact_triangles(c, false, false))
                        if (c["exact"]["parents"][t][0] >= first) gone.push_back(t);
                    drop_exact(c, gone);
                },
                "R56"),
            left_out(
                "the list is not sorted",
                [](Json& c) { std::swap(c["cut"]["dropped"][0], c["cut"]["dropped"][1]); }, "R51"),
            left_out(
                "a triangle twice",
                [](Json& c) { c["cut"]["dropped"].push_back(c["cut"]["dropped"].back()); }, "R51"),
            left_out(
                "a triangle that does not exist",
                [](Json& c) { c["cut"]["dropped"].push_back(1000000); }, "R51"),
            left_out(
                "a volume that is none",
                [](Json& c) {
                    c["cut"]["volume"] = {{"shape", "prism"},
                                          {"corners", Json::array()},
                                          {"between", Json::array()},
                                          {"files", 0},
                                          {"boundary", Json::array()}};
                },
                "R50"),
        });
}

TEST_CASE("sealed certificates: forged doubles", "[sealing]") {
    const auto doubles = [](const std::string& name, const std::function<void(Json&)>& change,
                            const std::string& rule) {
        return Forgery{name, [change](Json& c) { change(c["rounded"]); }, rule};
    };
    check_grown(right_sealed(),
                {
                    doubles(
                        "a triangle is missing", [](Json& m) { drop_triangle(m, 7); }, "R12"),
                    doubles(
                        "a vertex moved",
                        [](Json& m) {
                            Json& z = m["vertices"][9][2];
                            set_number(z, number_in(z) + 1e-9);
                        },
                        "R13"),
                    doubles(
                        "turned over", [](Json& m) { turn_over(m, 3); }, "R14"),
                    doubles(
                        "another region", [](Json& m) { m["regions"][3][0] = 77; }, "R16"),
                    {"what was trimmed is there", put_back, "R14"},
                });
    check_grown(with_diagonal(right_sealed()),
                {{"what was trimmed is there, among other triangles", put_back, "R18"}});
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
    seal_grown(other);
    CHECK(judged(other, options) == "R57");
}

TEST_CASE("sealed certificates: what a forger adds is refused", "[sealing]") {
    const auto right = self_made(gaping(), {{0, strip(0, 5.4)}}, keep_left);
    CHECK(judged(right) == "");
    const auto all = [](const Corners&, const std::set<std::uint32_t>&) { return true; };
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
    CHECK(has_rule(rules({{0, strip(0, 5.4)}}, all), "R55"));
    // Half of it: the free side is a diagonal, but nothing is met.
    CHECK(has_rule(rules({{0, {strip(0, 4.95)[0]}}}, keep_left), "R55"));
    // The strip is good, and what was to be trimmed was kept: nothing is wrong with that.
    CHECK(rules({{0, strip(0, 5.4)}}, [&](const Corners& corners, const auto& parents) {
              return not_added(corners, parents);
          }) == "");
}

TEST_CASE("sealed certificates: what is added and left out again widens no bound", "[sealing]") {
    auto triangles = strip(0, 5.4);
    triangles.push_back({Point3{1e12, 0, 0}, Point3{1e12, 1e12, 0}, Point3{1e12, 0, 1e12}});
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
    // The part of the fault below the sheets, a whole one, is too far from the rest.
    const auto below = with([&](const Corners& c, std::uint32_t p, std::uint32_t) {
        return p >= 130 && between(c, 2, -3, 0.55);
    });
    CHECK(has_rule(judged(below), "R26"));
}

TEST_CASE("sealed certificates: forged volumes and extensions", "[sealing]") {
    check_grown(
        right_extended(),
        {
            {"another height", [](Json& c) { c["cut"]["volume"]["between"][1] = "3"; }, "R50"},
            {"another corner", [](Json& c) { c["cut"]["volume"]["corners"][0][0] = "1"; }, "R50"},
            {"no volume", [](Json& c) { c["cut"]["volume"] = nullptr; }, "R1"},
            {"a nameless volume", [](Json& c) { c["cut"]["volume"]["shape"] = ""; }, "shape"},
            {"a side of the box is missing",
             [](Json& c) { c["cut"]["volume"]["boundary"].erase(2); }, "R50"},
            {"all is kept", [](Json& c) { c["cut"]["dropped"] = Json::array(); }, "R51"},
            {"a triangle of the boundary is missing",
             [](Json& c) {
                 const auto kept = exact_triangles(c, false, false);
                 drop_exact(c, {kept.back()});
             },
             "R51"},
            {"a triangle inside is missing",
             [](Json& c) { drop_exact(c, {exact_triangles(c, false, false).front()}); }, "R56"},
            {"nothing that was added was kept inside",
             [](Json& c) {
                 auto kept = exact_triangles(c, false, true);
                 kept.resize(kept.size() / 2);
                 drop_exact(c, kept);
             },
             "R55"},
            sealed(
                "an extension shorter than it is",
                [](Json& s) { set_number(s[0]["limit"], number_in(s[0]["limit"]) * 0.9); }, "R26"),
            sealed(
                "an extended corner elsewhere", [](Json& s) { s[0]["extended"][0][2][0] = "0.25"; },
                "R6"),
            sealed(
                "an extension is left out", [](Json& s) { s[0]["extended"].erase(1); }, "R1"),
        });
}

TEST_CASE("sealed certificates: output files", "[sealing]") {
    const Subject right =
        sealed_subject(gaping(), {gaping_box(), 0.3, 2.5}, {"obj", "ply", "vtp", "ts"});
    REQUIRE(judged(right) == "");
    for (std::size_t i = 0; i < right.contents.size(); ++i) {
        INFO(right.certificate["outputs"][i]["name"]);
        for (const double place : {0.3, 0.5, 0.7}) {
            Subject wrong = right;
            std::string& text = wrong.contents[i];
            const auto digit = text.find_first_of(
                "123456789", static_cast<std::size_t>(static_cast<double>(text.size()) * place));
            REQUIRE(digit != std::string::npos);
            text[digit] = text[digit] == '9' ? '8' : static_cast<char>(text[digit] + 1);
            CHECK(judged(wrong) == "R21");
            seal_grown(wrong); // with its new SHA-256 in the certificate
            CHECK(judged(wrong) == "R21");
        }
    }
}

TEST_CASE("sealed certificates: any digit of an output file counts", "[sealing]") {
    const Subject& right = right_sealed();
    const auto certificate = parse_certificate(right.certificate.dump(), "c");
    REQUIRE(certificate);
    std::size_t count = 0;
    for (std::size_t i = 0; i < right.contents[0].size(); i += 29) {
        std::string text = right.contents[0];
        if (text[i] < '0' || text[i] > '9') continue;
        text[i] = text[i] == '9' ? '8' : static_cast<char>(text[i] + 1);
        auto resealed = certificate.value();
        resealed.outputs[0].sha256 = hexadecimal(sha256(text));
        CHECK_FALSE(verify_output(text, resealed, 0).violations.empty());
        ++count;
    }
    CHECK(count > 20);
}
