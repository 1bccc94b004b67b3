// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of filled surfaces: the verifier accepts what the producer writes and refutes each
// forgery.
#include "support/forged.hpp"
#include "support/paths.hpp"

#include <cmath>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/io/certify.hpp>

namespace {

using namespace forged;

constexpr int side = 12; // vertices along each side of a grid

/// A wavy surface on a grid without the squares that `is_hole` names.
template <class IsHole>
std::string holed_grid(const std::string& name, double z, int first, const IsHole& is_hole) {
    std::string text;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            text += "v " + std::to_string(i) + " " + std::to_string(j) + " " +
                    std::to_string(z + 0.4 * std::sin(0.8 * i) * std::cos(0.6 * j)) + "\n";
    text += "g " + name + "\n";
    for (int i = 0; i + 1 < side; ++i)
        for (int j = 0; j + 1 < side; ++j) {
            if (is_hole(i, j)) continue;
            const int a = first + i * side + j, b = a + side;
            text += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
                    std::to_string(b + 1) + "\nf " + std::to_string(a) + " " +
                    std::to_string(b + 1) + " " + std::to_string(a + 1) + "\n";
        }
    return text;
}

/// Two surfaces, the second with two holes.
std::vector<File> holed() {
    const auto none = [](int, int) { return false; };
    const auto two_holes = [](int i, int j) {
        return (i >= 2 && i < 5 && j >= 2 && j < 5) || (i >= 7 && i < 9 && j >= 6 && j < 10);
    };
    return {{"whole.obj", holed_grid("whole", 10, 1, none)},
            {"holed.obj", holed_grid("holed", 0, 1, two_holes)}};
}

Subject filled_subject(const std::vector<File>& files, const std::vector<std::string>& formats,
                       FillMethod method = FillMethod::kriging) {
    Subject s;
    const auto records = add_inputs(s, files);
    std::vector<FillTask> tasks;
    FillOptions options;
    options.method = method;
    for (std::uint32_t i = 0; i < s.surfaces.size(); ++i) tasks.push_back({SurfaceId(i), options});
    const auto work = fill_surfaces(s.surfaces, tasks);
    REQUIRE(work);
    std::vector<Surface> surfaces;
    std::vector<FilledRecord> filled;
    std::vector<std::int32_t> interpolated;
    std::vector<double> means;
    for (const HoledSurface& surface : work->surfaces) {
        surfaces.push_back(surface.filled);
        filled.push_back({&surface.filled, surface.given_vertices, surface.given_triangles,
                          surface.interpolated, surface.deviation});
        interpolated.insert(interpolated.end(), surface.interpolated.begin(),
                            surface.interpolated.end());
        const auto& error = surface.deviation;
        for (const auto& [a, b, c] : surface.filled.triangles)
            means.push_back((error[a] + error[b] + error[c]) / 3);
    }
    const Mesh mesh = concatenate(surfaces);
    REQUIRE(mesh.triangles.size() >
            s.surfaces[0].triangles.size() + s.surfaces.back().triangles.size());
    std::vector<OutputRecord> outputs;
    for (const std::string& format : formats) {
        WriteOptions written;
        const std::vector<CellArray> cells{{"interpolated", interpolated}, {"deviation", means}};
        if (format == "vtp") written.cells = cells;
        auto text = format_mesh(mesh, format_named(format).value(), written);
        REQUIRE(text);
        outputs.push_back(record_output(text.value(), "out." + format, format, mesh.surfaces));
        s.contents.push_back(std::move(text).value());
    }
    s.certificate = Json::parse(to_filled_certificate(records, s.surfaces, outputs, filled));
    return s;
}

const Subject& right_filled() {
    static const Subject subject = filled_subject(holed(), {"obj"});
    return subject;
}

Forgery filled(const std::string& name, const std::function<void(Json&)>& change,
               const std::string& rule) {
    return {name, [change](Json& c) { change(c["filled"]); }, rule};
}

std::size_t given_triangles() {
    return right_filled().surfaces[0].triangles.size() +
           right_filled().surfaces[1].triangles.size();
}

/// Removes a triangle of the second surface.
void erase_new(Json& f, std::size_t t) {
    f["triangles"].erase(t);
    f["invented"].erase(t);
    f["surfaces"][1]["triangles"] = f["surfaces"][1]["triangles"].get<std::size_t>() - 1;
}

void add_new_triangle(Json& f, const Json& corners) {
    f["triangles"].push_back(corners);
    f["invented"].push_back(1);
    f["surfaces"][1]["triangles"] = f["surfaces"][1]["triangles"].get<std::size_t>() + 1;
}

void add_vertex(Json& f, double x, double y, double z) {
    Json point = Json::array({"", "", ""});
    point[0] = decimal_text(x);
    point[1] = decimal_text(y);
    point[2] = decimal_text(z);
    f["vertices"].push_back(point);
    f["deviation"].push_back("0");
    f["surfaces"][1]["vertices"] = f["surfaces"][1]["vertices"].get<std::size_t>() + 1;
}

/// Adds a tetrahedron's four sides at a place: closed, and connected with nothing.
void add_tetrahedron(Json& f, double z) {
    const auto v = f["vertices"].size();
    for (const auto& [x, y, dz] : {std::array{3.0, 3.0, 0.0}, std::array{4.0, 3.0, 0.0},
                                   std::array{3.0, 4.0, 0.0}, std::array{3.0, 3.0, 1.0}})
        add_vertex(f, x, y, z + dz);
    for (const auto& t :
         {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{2, 0, 3}})
        add_new_triangle(f, {v + static_cast<std::size_t>(t[0]), v + static_cast<std::size_t>(t[1]),
                             v + static_cast<std::size_t>(t[2])});
}

} // namespace

TEST_CASE("filled certificates: accepted with each format and method") {
    CHECK(judged(filled_subject(holed(), {"obj", "off", "ply", "vtp", "ts"})) == "");
    CHECK(judged(filled_subject(holed(), {"obj"}, FillMethod::rbf)) == "");
    CHECK(right_filled().certificate["filled"]["triangles"].size() > given_triangles() + 20);
}

TEST_CASE("filled certificates: what was given is changed") {
    const std::size_t second = right_filled().surfaces[0].vertices.size();
    check_forgeries(
        right_filled(),
        {
            filled(
                "a given vertex moved by the last digit",
                [=](Json& f) {
                    Json& z = f["vertices"][second + 3][2];
                    z = decimal_text(std::nextafter(number_in(z), 100));
                },
                "R29"),
            filled(
                "a given triangle turned over", [](Json& f) { turn_over(f, 2); }, "R29"),
            filled(
                "a given triangle missing, a new one in its place",
                [](Json& f) {
                    const Json last = f["triangles"].back();
                    erase_new(f, f["triangles"].size() - 1);
                    f["triangles"][given_triangles() - 1] = last;
                },
                "R29"),
            filled(
                "two given triangles exchanged",
                [](Json& f) { std::swap(f["triangles"][0], f["triangles"][1]); }, "R29"),
            filled(
                "all of a surface missing",
                [=](Json& f) {
                    for (std::size_t i = 0; i < second; ++i) {
                        f["vertices"].erase(0);
                        f["deviation"].erase(0);
                    }
                    for (std::size_t i = 0; i < right_filled().surfaces[0].triangles.size(); ++i) {
                        f["triangles"].erase(0);
                        f["invented"].erase(0);
                    }
                    for (Json& t : f["triangles"])
                        for (Json& v : t) v = v.get<std::size_t>() - second;
                    f["surfaces"][0]["vertices"] = 0;
                    f["surfaces"][0]["triangles"] = 0;
                },
                "R29"),
            filled(
                "a given vertex more", [](Json& f) { add_vertex(f, 3.3, 3.3, 3.3); }, "R35"),
        });
}

TEST_CASE("filled certificates: forged fillings") {
    check_forgeries(
        right_filled(),
        {
            filled(
                "a new triangle is missing", [](Json& f) { erase_new(f, given_triangles() + 4); },
                "R35"),
            filled(
                "a new triangle twice", [](Json& f) { add_new_triangle(f, f["triangles"].back()); },
                "R35"),
            filled(
                "a new triangle turned over", [](Json& f) { turn_over(f, given_triangles() + 1); },
                "R35"),
            filled(
                "all new triangles turned over",
                [](Json& f) {
                    for (std::size_t t = given_triangles(); t < f["triangles"].size(); ++t)
                        turn_over(f, t);
                },
                "R35"),
            filled(
                "a triangle over given ones",
                [=](Json& f) {
                    const std::size_t v = right_filled().surfaces[0].vertices.size();
                    add_new_triangle(f, {v, v + 1, v + side});
                },
                "R35"),
            filled(
                "a closed body that is connected with nothing",
                [](Json& f) { add_tetrahedron(f, 5); }, "R26"),
            filled(
                "a closed body that crosses the surface", [](Json& f) { add_tetrahedron(f, -0.5); },
                "R36"),
            filled(
                "a new vertex far away",
                [](Json& f) { f["vertices"].back()[2] = decimal_text(1e6); }, "R26"),
            filled(
                "a new vertex far away, with a limit as large",
                [](Json& f) {
                    f["vertices"].back()[2] = decimal_text(1e6);
                    f["surfaces"][1]["limit"] = "1e+300";
                },
                "R26"),
            filled(
                "a new vertex pushed through given triangles",
                [](Json& f) {
                    f["vertices"].back()[0] = "10.5";
                    f["vertices"].back()[1] = "0.5";
                    f["vertices"].back()[2] = "0";
                },
                "R36"),
            filled(
                "a new vertex at the place of another",
                [](Json& f) { f["vertices"].back() = *(f["vertices"].end() - 2); }, "R36"),
            filled(
                "a smaller limit", [](Json& f) { shift_number(f["vertices"].back()[2], 2); },
                "R26"),
        });
}

TEST_CASE("filled certificates: a filling is a disc, and faces a side of the border of its hole") {
    // Square rings above each other; the upper one faces down.
    Surface rings{"rings", Role::unknown, {}, {}};
    for (const double z : {0.0, 1.0})
        for (const auto& [low, high] : {std::pair{0.0, 3.0}, {1.0, 2.0}})
            for (const auto& [x, y] : {std::pair{low, low}, {high, low}, {high, high}, {low, high}})
                rings.vertices.push_back({x, y, z});
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t n = (k + 1) % 4;
        for (const Triangle& t : {Triangle{k, n, 4 + n}, Triangle{k, 4 + n, 4 + k},
                                  Triangle{8 + k, 12 + n, 8 + n}, Triangle{8 + k, 12 + k, 12 + n}})
            rings.triangles.push_back(t);
    }
    const auto judged_with = [](Surface surface, const std::vector<Triangle>& added,
                                const std::vector<std::int32_t>& holes = {},
                                const std::vector<Point3>& vertices = {}) {
        Subject s;
        const auto records = add_inputs(s, {{"in.obj", obj_text({surface})}});
        const std::size_t given = surface.triangles.size(), points = surface.vertices.size();
        surface.triangles.insert(surface.triangles.end(), added.begin(), added.end());
        surface.vertices.insert(surface.vertices.end(), vertices.begin(), vertices.end());
        std::vector<std::int32_t> interpolated(given, 0);
        interpolated.insert(interpolated.end(), holes.begin(), holes.end());
        interpolated.resize(surface.triangles.size(), 1);
        const std::vector<double> deviation(surface.vertices.size(), 0);
        s.certificate = Json::parse(to_filled_certificate(
            records, s.surfaces, {},
            std::vector<FilledRecord>{{&surface, points, given, interpolated, deviation}}));
        return judged(s);
    };
    const std::vector<Triangle> two_fillings{{4, 5, 6}, {4, 6, 7}, {12, 14, 13}, {12, 15, 14}};
    CHECK(judged_with(rings, two_fillings, {1, 1, 2, 2}) == "");
    CHECK(judged_with(rings, two_fillings, {7, 7, 3, 3}) == "");
    CHECK(judged_with(rings, two_fillings, {1, 1, 1, 1}) == "R28");
    CHECK(judged_with(rings, two_fillings, {1, 2, 3, 3}) == "R28");
    // The border around a ring instead of the hole in it, or both.
    std::vector<Triangle> cone;
    for (std::uint32_t k = 0; k < 4; ++k) cone.push_back({(k + 1) % 4, k, 16});
    CHECK(judged_with(rings, cone, {}, {{1.5, 1.5, -0.1}}) == "R35");
    cone.insert(cone.end(), {{4, 5, 6}, {4, 6, 7}});
    CHECK(judged_with(rings, cone, {1, 1, 1, 1, 2, 2}, {{1.5, 1.5, -0.1}}) == "R35");
    std::vector<Triangle> tube;
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t n = (k + 1) % 4;
        tube.push_back({4 + k, 4 + n, 12 + n});
        tube.push_back({4 + k, 12 + n, 12 + k});
    }
    CHECK(judged_with(rings, tube) == "R35");
    Surface mixed = rings; // a triangle of the upper ring faces up
    std::swap(mixed.triangles[2][0], mixed.triangles[2][1]);
    CHECK(judged_with(mixed, {{4, 5, 6}, {4, 6, 7}}) == "");
    CHECK(judged_with(mixed, {{4, 6, 5}, {4, 7, 6}}) == "R35");
}

TEST_CASE("filled certificates: VTP files with other expected errors") {
    const Subject right = filled_subject(holed(), {"vtp"});
    check_forgeries(right, {
                               filled(
                                   "an expected error of one new vertex",
                                   [](Json& f) { shift_number(f["deviation"].back(), 1); }, "R21"),
                               filled(
                                   "an unknown expected error",
                                   [](Json& f) { f["deviation"].back() = nullptr; }, "R21"),
                               filled(
                                   "another number of a hole",
                                   [](Json& f) {
                                       const Json last = f["invented"].back();
                                       for (Json& number : f["invented"])
                                           if (number == last) number = 77;
                                   },
                                   "R21"),
                           });
}

TEST_CASE("filled certificates: forged numbers") {
    check_forgeries(
        right_filled(),
        {
            filled(
                "a corner out of range",
                [](Json& f) { f["triangles"].back()[0] = f["vertices"].size(); }, "R28"),
            filled(
                "a corner of another surface", [](Json& f) { f["triangles"].back()[0] = 0; },
                "R28"),
            filled(
                "a surface is missing", [](Json& f) { f["surfaces"].erase(0); }, "R28"),
            filled(
                "a given triangle in a hole", [](Json& f) { f["invented"][0] = 1; }, "R28"),
            filled(
                "a new triangle in no hole", [](Json& f) { f["invented"].back() = 0; }, "R28"),
            filled(
                "a new triangle in another hole",
                [](Json& f) { f["invented"].back() = f["invented"].back().get<int>() + 1; }, "R28"),
            filled(
                "a triangle without a number of a hole",
                [](Json& f) { f["invented"].erase(f["invented"].size() - 1); }, "R28"),
            filled(
                "an expected error of a given vertex", [](Json& f) { f["deviation"][0] = "1"; },
                "R28"),
            filled(
                "a given vertex of unknown error", [](Json& f) { f["deviation"][0] = nullptr; },
                "R28"),
            filled(
                "a negative expected error", [](Json& f) { f["deviation"].back() = "-1"; }, "R28"),
            filled(
                "an expected error too many", [](Json& f) { f["deviation"].push_back("0"); },
                "R28"),
            filled(
                "another number of vertices", [](Json& f) { f["surfaces"][0]["vertices"] = 143; },
                "R28"),
            filled(
                "a negative limit", [](Json& f) { f["surfaces"][0]["limit"] = "-1"; }, "R28"),
            filled(
                "a limit larger than what is accepted",
                [](Json& f) { f["surfaces"][0]["limit"] = "1000"; }, "R26"),
            {"another hash of an input",
             [](Json& c) { c["inputs"][1]["sha256"] = std::string(64, '0'); }, "R9"},
            {"as the arrangement", [](Json& c) { c["kind"] = "arrangement"; }, "missing"},
        });
}

TEST_CASE("filled certificates: an output file with one digit changed") {
    check_changed_digits(right_filled(), first_vertex);
}
