// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fills and joins holes in surfaces of known shape; checks the error and conformity.
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <stop_token>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/loops.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/reconstruction/joining/join.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Fills and joins the hole; checks that the result is conforming and has no hole left.
Joined fill(const Surface& s, const BorderLoop& hole, const RbfOptions& options = {}) {
    const auto filling = fill_by_rbf(s, hole, options);
    if (!filling) FAIL(filling.error().message());
    CHECK(filling.value().expected_error.size() == filling.value().surface.vertices.size());
    CHECK(!filling.value().exact_border);
    CHECK(!filling.value().report.model.empty());
    CHECK(filling.value().report.data > hole.vertices.size());
    auto joined = join_filling(s, hole, filling.value().surface);
    if (!joined) FAIL(joined.error().message());
    CHECK(check(std::span(&joined.value().surface, 1)).value().clean());
    return std::move(joined).value();
}

/// Computes the root mean square error at the new vertices.
template <class Error>
double rms(const Surface& before, const Surface& after, const Error& error) {
    double sum = 0;
    const std::size_t first = before.vertices.size(), n = after.vertices.size() - first;
    REQUIRE(n > 0);
    for (std::size_t v = first; v < after.vertices.size(); ++v)
        sum += std::pow(error(after.vertices[v]), 2);
    return std::sqrt(sum / static_cast<double>(n));
}

/// Computes heights of the plane that fits the border best, the simplest linear filling.
std::function<double(double, double)> plane_through(const Surface& s, const BorderLoop& hole) {
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, mx = 0, my = 0, mz = 0;
    const auto n = static_cast<double>(hole.vertices.size());
    for (const std::uint32_t v : hole.vertices) {
        mx += s.vertices[v].x / n;
        my += s.vertices[v].y / n;
        mz += s.vertices[v].z / n;
    }
    for (const std::uint32_t v : hole.vertices) {
        const double x = s.vertices[v].x - mx, y = s.vertices[v].y - my, z = s.vertices[v].z - mz;
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xz += x * z;
        yz += y * z;
    }
    const double d = xx * yy - xy * xy, a = (xz * yy - yz * xy) / d, b = (yz * xx - xz * xy) / d;
    return [=](double x, double y) { return mz + a * (x - mx) + b * (y - my); };
}

} // namespace

TEST_CASE("rbf: smooth surfaces are filled many times better than by a plane", "[rbf][once]") {
    struct Case {
        const char* name;
        std::function<double(double, double)> height;
        double times; ///< least ratio of the plane's error to ours
    };
    const std::array known{
        Case{"sinusoid", [](double x, double y) { return 0.5 * std::sin(x) * std::cos(0.7 * y); },
             10},
        Case{"dome",
             [](double x, double y) {
                 return 2 * std::exp(-(std::pow(x - 5, 2) + std::pow(y - 5, 2)) / 12);
             },
             20},
        Case{"sphere",
             [](double x, double y) {
                 return std::sqrt(64 - std::pow(x - 5, 2) - std::pow(y - 5, 2));
             },
             30},
        Case{"saddle", [](double x, double y) { return 0.1 * (x - 5) * (y - 4); }, 100}};
    for (const Case& c : std::span(known).first(std::size_t(cases(int(known.size())))))
        for (const double radius : {0.9, 1.4}) { // 2.5 and 6 % of the area
            CAPTURE(c.name, radius);
            const Surface s =
                punched(sheet(graph(c.height), 0, 0, 10, 10, 36, 36, 0.2), disk(5.2, 4.9, radius));
            const auto hole = holes_of(s).at(0);
            const Joined joined = fill(s, hole, {.most_centres = 400});
            const auto plane = plane_through(s, hole);
            const double ours =
                rms(s, joined.surface, [&](const Point3& p) { return p.z - c.height(p.x, p.y); });
            const double linear = rms(s, joined.surface, [&](const Point3& p) {
                return plane(p.x, p.y) - c.height(p.x, p.y);
            });
            INFO(ours << " against " << linear);
            CHECK(c.times * ours < linear);
        }
}

TEST_CASE("rbf: planes are filled exactly, in any direction", "[rbf]") {
    for (const SheetShape& shape :
         {SheetShape(graph([](double x, double y) { return 0.3 * x - 0.2 * y; })),
          SheetShape([](double u, double v) {
              return Point3{0.1 * u, u - v, v};
          })}) {
        const Surface flat = sheet(shape, 0, 0, 10, 10, 30, 30, 0.2);
        const Point3 middle = shape(5, 5);
        const Surface s = punched(flat, [&](const Point3& p) {
            return std::hypot(p.x - middle.x, p.y - middle.y, p.z - middle.z) < 1.5;
        });
        const Joined joined = fill(s, holes_of(s).at(0), {.most_centres = 200});
        const Point3 o = shape(0, 0), a = shape(1, 0), b = shape(0, 1);
        const Point3 n{(a.y - o.y) * (b.z - o.z) - (a.z - o.z) * (b.y - o.y),
                       (a.z - o.z) * (b.x - o.x) - (a.x - o.x) * (b.z - o.z),
                       (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x)};
        CHECK(rms(s, joined.surface, [&](const Point3& p) {
                  return (n.x * (p.x - o.x) + n.y * (p.y - o.y) + n.z * (p.z - o.z)) /
                         std::hypot(n.x, n.y, n.z);
              }) < 1e-10);
    }
}

TEST_CASE("rbf: a hole in a fold that is no graph is filled", "[rbf]") {
    const SheetShape fold = [](double u, double v) { // turns by 200 degrees
        const double angle = 0.7 * u;
        return Point3{2.5 * std::sin(angle), v, 2.5 * (1 - std::cos(angle))};
    };
    const Surface s = punched(sheet(fold, 0, -4, 5, 4, 50, 40, 0.2), [](const Point3& p) {
        return std::hypot(p.x - 2.5, p.y, p.z - 2.5) < 1;
    });
    const Joined joined = fill(s, holes_of(s).at(0), {.most_centres = 400});
    const double error =
        rms(s, joined.surface, [](const Point3& p) { return std::hypot(p.x, p.z - 2.5) - 2.5; });
    CHECK(error < 0.003);
    // Some triangles of wrong orientation change nothing but the orientation of the filling.
    Surface mixed = s;
    for (std::size_t t = 0; t < mixed.triangles.size(); t += 3)
        std::swap(mixed.triangles[t][1], mixed.triangles[t][2]);
    const auto loops = holes_of(s);
    const auto again = fill_by_rbf(mixed, loops.at(0), {.most_centres = 400});
    REQUIRE(again);
    CHECK(again.value().surface.vertices.size() > 50);
}

/// Builds an overturned fold, three limbs of which overlap along z, with a hole around (u, v).
Surface fold_with_hole(double lean, double height, double u0, double v0, double radius) {
    const double phase = std::acos(1000 / (4 * M_PI * lean));
    Surface s = punched(sheet(graph([](double, double) { return 0.0; }), 0, 0, 1, 1, 60, 60),
                        disk(u0, v0, radius));
    for (Point3& p : s.vertices) {
        const double t = 2 * M_PI * (p.x - 0.5);
        p = {1000 * p.x - lean * std::sin(2 * t + phase), 1000 * p.y, height * std::sin(t)};
    }
    return s;
}

/// Computes the distance from the middle limb in x.
auto from_fold(double lean, double height) {
    return [=](const Point3& p) {
        const double t = std::asin(std::clamp(p.z / height, -1.0, 1.0));
        const double phase = std::acos(1000 / (4 * M_PI * lean));
        return p.x - (500 + 1000 * t / (2 * M_PI) - lean * std::sin(2 * t + phase));
    };
}

TEST_CASE("rbf: polynomials in space follow a fold better", "[rbf][once]") {
    const Surface s = fold_with_hole(200, 150, 0.53, 0.5, 0.126);
    const auto hole = holes_of(s).at(0);
    const auto filling = fill_by_rbf(s, hole, {.most_centres = 400});
    REQUIRE(filling);
    CHECK(filling.value().report.model.find("in space") != std::string::npos);
    const double missed = rms(s, fill(s, hole, {.most_centres = 400}).surface, from_fold(200, 150));
    CHECK(missed < 1.2);
    CHECK(2 * missed <
          rms(s, fill(s, hole, {.most_centres = 400, .degree = 1}).surface, from_fold(200, 150)));
}

TEST_CASE("rbf: the level continues over the rim of another limb of the fold", "[rbf]") {
    const Surface s = fold_with_hole(200, 220, 0.47, 0.5, 0.126);
    const auto joined = fill(s, holes_of(s).at(0), {.most_centres = 400});
    CHECK(rms(s, joined.surface, from_fold(200, 220)) < 5);
}

TEST_CASE("rbf: a hinge sharper than the border edges gets smaller triangles", "[rbf][once]") {
    const Surface s = fold_with_hole(220, 150, 0.47, 0.5, 0.126);
    const auto hole = holes_of(s).at(0);
    RbfReport report;
    const auto filling = fill_by_rbf(s, hole, {.most_centres = 400}, {}, &report);
    REQUIRE(filling);
    CHECK(report.size == Approx(12.97).epsilon(0.01)); // half the border's median edge
    CHECK(join_filling(s, hole, filling.value().surface));
    // The number of vertices limits the refinement, too.
    REQUIRE(fill_by_rbf(s, hole, {.most_centres = 400, .most_vertices = 300}, {}, &report));
    CHECK(report.size == Approx(25.9).epsilon(0.01));
}

TEST_CASE("rbf: triangles are as small as the precision of the level warrants", "[rbf]") {
    const auto wavy = [](double x, double y) { return 0.5 * std::sin(x) * std::cos(0.7 * y); };
    const auto missed_by_triangles = [&](const Surface& before, const Surface& after) {
        double sum = 0;
        const std::size_t first = before.triangles.size(), n = after.triangles.size() - first;
        for (std::size_t i = first; i < after.triangles.size(); ++i) {
            Point3 m{0, 0, 0};
            for (const auto v : after.triangles[i]) {
                const Point3& p = after.vertices[v];
                m = {m.x + p.x / 3, m.y + p.y / 3, m.z + p.z / 3};
            }
            sum += std::pow(m.z - wavy(m.x, m.y), 2);
        }
        return std::sqrt(sum / static_cast<double>(n));
    };
    const auto holed = [&](double noise) {
        Surface s = punched(sheet(graph(wavy), 0, 0, 10, 10, 40, 40), disk(5, 5, 0.9));
        std::mt19937 random(7);
        std::normal_distribution<double> off(0, noise);
        if (noise > 0)
            for (Point3& p : s.vertices) p.z += off(random);
        return s;
    };
    const Surface smooth = holed(0);
    const auto hole = holes_of(smooth).at(0);
    const auto filled = fill_and_join_by_rbf(smooth, hole, {});
    const auto coarse = fill_and_join_by_rbf(smooth, hole, {.size = 0.25});
    REQUIRE((filled && coarse));
    const auto& [filling, joined, report] = filled.value();
    const auto points = [](const FilledByRbf& f) { return f.filling.report.interpolated; };
    CHECK(points(*filled) > 3 * points(*coarse));
    CHECK(points(*filled) < 40 * points(*coarse));
    CHECK(3 * missed_by_triangles(smooth, joined.surface) <
          missed_by_triangles(smooth, coarse.value().joined.surface));
    CHECK(check(std::span(&joined.surface, 1)).value().clean());
    // They are not refined where the level is no more precise than large triangles show it, nor
    // beyond the allowed number of vertices.
    const Surface rough = holed(0.02);
    RbfReport other;
    REQUIRE(fill_by_rbf(rough, holes_of(rough).at(0), {}, {}, &other));
    CHECK(other.size > 0.24);
    REQUIRE(fill_by_rbf(smooth, hole, {.most_vertices = 100}, {}, &other));
    CHECK(other.size > 0.24);
}

TEST_CASE("rbf: four holes of one horizon are filled (the paper's Figure 22)", "[rbf][once]") {
    const auto wavy = [](double x, double y) { return 0.3 * std::sin(x) * std::cos(0.7 * y); };
    Surface s = sheet(graph(wavy), 0, 0, 20, 20, 60, 60, 0.2);
    for (const auto& hole : {disk(5, 5, 1.4), disk(14, 4, 1.1), disk(6, 14, 1.8)})
        s = punched(s, hole);
    s = punched(s, [](const Point3& p) {
        return std::fabs(p.y - 13 - 0.5 * std::sin(p.x)) < 0.6 && p.x > 12 && p.x < 16;
    });
    REQUIRE(holes_of(s).size() == 4);
    const Surface before = s;
    for (auto holes = holes_of(s); !holes.empty(); holes = holes_of(s))
        s = fill(s, holes.front(), {.most_centres = 300}).surface;
    CHECK(rms(before, s, [&](const Point3& p) { return p.z - wavy(p.x, p.y); }) < 0.02);
    CHECK(find_border_loops(s).value().size() == 1);
    CHECK(std::equal(before.vertices.begin(), before.vertices.end(), s.vertices.begin()));
    CHECK(std::equal(before.triangles.begin(), before.triangles.end(), s.triangles.begin()));
}

TEST_CASE("rbf: an island in a hole serves as data and is joined", "[rbf]") {
    // Only the island shows the bump in the middle of the hole.
    const auto bump = [](double x, double y) {
        return 1.5 * std::exp(-(std::pow(x - 5, 2) + std::pow(y - 5, 2)) / 2);
    };
    const Surface s = punched(sheet(graph(bump), 0, 0, 10, 10, 50, 50, 0.2), [](const Point3& p) {
        return disk(5, 5, 2.2)(p) && !disk(5, 5, 0.7)(p);
    });
    const auto loops = find_border_loops(s);
    const auto filling = fill_by_rbf(s, holes_of(s).at(0), {.loops = loops.value()});
    REQUIRE(filling);
    const auto joined =
        join_filling(s, holes_of(s).at(0), filling.value().surface, {.loops = loops.value()});
    if (!joined) FAIL(joined.error().message());
    CHECK(joined.value().report.islands == 1);
    CHECK(find_border_loops(joined.value().surface).value().size() == 1);
    CHECK(check(std::span(&joined.value().surface, 1)).value().clean());
    CHECK(rms(s, joined.value().surface, [&](const Point3& p) { return p.z - bump(p.x, p.y); }) <
          0.03);
}

TEST_CASE("rbf: the rest interpolates rough data and more data than centres", "[rbf]") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> rough(-0.02, 0.02);
    Surface s =
        sheet(graph([&](double x, double y) { return std::sin(x) + 0.3 * y + rough(random); }), 0,
              0, 10, 10, 90, 90);
    s = punched(s, disk(5, 5, 2));
    const auto hole = holes_of(s).at(0);
    RbfReport report;
    const auto filling = fill_by_rbf(s, hole, {.reach = 3, .most_centres = 200}, {}, &report);
    REQUIRE(filling);
    CHECK(report.data > 5000);
    CHECK(report.centres <= 200);
    CHECK(report.missed > 0.01);
    CHECK(report.largest_error < 1e-10);
    CHECK(report.rms_error <= report.largest_error);
    CHECK(filling.value().report.validated_error > 0.005);
    CHECK(filling.value().report.validated_error < 0.2);
    const auto joined = join_filling(s, hole, filling.value().surface);
    REQUIRE(joined);
    CHECK(check(std::span(&joined.value().surface, 1)).value().clean());
    CHECK(joined.value().report.largest_step < 0.04);
}

TEST_CASE("rbf: data that were left out are told with what the others predict", "[rbf][once]") {
    const auto of_pairs = [](const FillReport& report) {
        REQUIRE(report.left_out.size() > 20);
        double squares = 0;
        for (const auto& [given, predicted] : report.left_out)
            squares += (given - predicted) * (given - predicted);
        return std::sqrt(squares / static_cast<double>(report.left_out.size()));
    };
    Surface s = punched(sheet(graph([](double x, double y) { return 700 + 0.1 * std::sin(x) * y; }),
                              0, 0, 10, 10, 40, 40),
                        disk(5, 5, 1.5));
    for (const bool turned : {false, true}) { // heights are those of the file, whatever faces up
        if (turned)
            for (Triangle& t : s.triangles) std::swap(t[0], t[1]);
        const auto filled = fill_and_join_by_rbf(s, holes_of(s).at(0));
        REQUIRE(filled);
        const FillReport& report = filled->filling.report;
        CHECK(of_pairs(report) == Approx(report.validated_error).epsilon(1e-9));
        CHECK(report.validated_error > 1e-6);
        for (const auto& [given, predicted] : report.left_out)
            CHECK(std::ranges::any_of(
                s.vertices, [z = given](const Point3& p) { return std::fabs(p.z - z) < 1e-9; }));
    }
    const Surface fold = fold_with_hole(400, 500, 0.5, 0.5, 0.1);
    const auto filling = fill_by_rbf(fold, holes_of(fold).at(0), {.most_centres = 300});
    REQUIRE(filling);
    CHECK(of_pairs(filling->report) == Approx(filling->report.validated_error).epsilon(1e-9));
}

TEST_CASE("rbf: the result does not depend on the number of threads", "[rbf]") {
    const Surface s = punched(
        sheet(graph([](double x, double y) { return std::sin(x + y); }), 0, 0, 10, 10, 30, 30, 0.2),
        disk(5, 5, 1.5));
    const auto hole = holes_of(s).at(0);
    const RbfOptions options{.most_centres = 100};
    const auto one = fill_by_rbf(s, hole, options),
               three = fill_by_rbf(s, hole, options, {.threads = 3});
    REQUIRE(one);
    REQUIRE(three);
    CHECK(one.value().surface.vertices == three.value().surface.vertices);
    CHECK(one.value().surface.triangles == three.value().surface.triangles);
}

TEST_CASE("rbf: invalid options and loops are refused, and a stop request is obeyed", "[rbf]") {
    const Surface s =
        punched(sheet(graph([](double x, double) { return std::sin(x); }), 0, 0, 10, 10, 20, 20),
                disk(5, 5, 2));
    const auto hole = holes_of(s).at(0);
    for (const RbfOptions& wrong :
         {RbfOptions{.reach = -1}, RbfOptions{.most_centres = 3}, RbfOptions{.most_centres = 5000},
          RbfOptions{.size = -2}, RbfOptions{.most_vertices = 0}, RbfOptions{.degree = 9},
          RbfOptions{.smoothing = -1.0}, RbfOptions{.smoothing = std::nan("")}}) {
        const auto filling = fill_by_rbf(s, hole, wrong);
        REQUIRE(!filling);
        CHECK(filling.error().code == ErrorCode::bad_option);
    }
    BorderLoop none = hole;
    none.vertices = {0, 1};
    CHECK(fill_by_rbf(s, none).error().code == ErrorCode::bad_option);
    none.vertices = {0, 1, 1U << 30U};
    CHECK(fill_by_rbf(s, none).error().code == ErrorCode::bad_index);
    none.vertices = {0, 1, 2, 1};
    CHECK(fill_by_rbf(s, none).error().code == ErrorCode::bad_option);
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    CHECK(fill_by_rbf(s, hole, {}, run).error().code == ErrorCode::interrupted);
}
