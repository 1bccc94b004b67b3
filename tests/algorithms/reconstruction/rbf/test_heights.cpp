// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks fits of graphs: kernels, the choice among them, noise, and what must not change them.
#include <terrane/algorithms/reconstruction/rbf/detail/heights.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <stop_token>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "support/loops.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

using namespace terrane;
using namespace terrane::rbf::detail;
using namespace test_support;

namespace {

RbfData data_round_hole(const Surface& s) {
    auto data = collect_data(s, hole_of(s), {}, {});
    if (!data) FAIL(data.error().message());
    return std::move(data).value();
}

HeightFit fitted(const RbfData& data, const RbfOptions& options = {}) {
    RbfReport report;
    const auto axes = graph_axes(data);
    REQUIRE(axes);
    auto fit = fit_heights(data, *axes, options, report, {});
    REQUIRE(fit);
    return std::move(*fit);
}

Surface holed(const std::function<double(double, double)>& height) {
    return punched(sheet(graph(height), 0, 0, 10, 10, 30, 30, 0.2), disk(5, 5, 1.6));
}

/// Gives the vertices heights with exponential covariance, with grooves along y if `groove` is
/// above 1.
void draw(std::mt19937_64& random, Surface& s, double groove = 1) {
    const auto n = static_cast<Eigen::Index>(s.vertices.size());
    Eigen::MatrixXd c(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const Point3 &p = s.vertices[std::size_t(i)], &q = s.vertices[std::size_t(j)];
            c(i, j) = std::exp(-std::hypot(groove * (p.x - q.x), (p.y - q.y) / groove) / 2);
        }
    std::normal_distribution<double> normal;
    Eigen::VectorXd free(n);
    for (double& x : free) x = normal(random);
    const Eigen::VectorXd z = c.llt().matrixL() * (0.3 * free);
    for (Eigen::Index i = 0; i < n; ++i) s.vertices[std::size_t(i)].z = z[i];
}

/// The height of the graph at a place.
double height_at(const HeightFit& fit, double x, double y) {
    const Point3 p{x, y, 0};
    const Point3 g = fit.f.smooth.gradient(p);
    return -fit.f.smooth(p) / g.z;
}

} // namespace

TEST_CASE("rbf: graphs of each kernel interpolate, and gradients agree with differences", "[rbf]") {
    const std::vector<Point3> centres{{0, 0, 1}, {2, 0, 0}, {0, 2, 3}, {2, 2, 1}, {1, 0.7, 2}};
    const std::vector<double> weights{0.3, -0.2, 0.1, 0.4, -0.6}, polynomial{0.2, 0.5, -0.1};
    for (const auto kernel : {RbfKernel::linear, RbfKernel::thin_plate, RbfKernel::cubic}) {
        RbfFunction f;
        REQUIRE(f.set_centres(centres, {}));
        f.set_graph(1, {kernel, weights, polynomial});
        for (const Point3& p : {Point3{0.3, 1.1, 5}, Point3{1.7, 0.4, -2}}) {
            // It is a height: w has the factor 1.
            CHECK(f({p.x, p.y, p.z + 0.5}) == Approx(f(p) + 0.5));
            const double d = 1e-6;
            const Point3 g = f.gradient(p);
            CHECK(g.x == Approx((f({p.x + d, p.y, p.z}) - f({p.x - d, p.y, p.z})) / (2 * d)));
            CHECK(g.y == Approx((f({p.x, p.y + d, p.z}) - f({p.x, p.y - d, p.z})) / (2 * d)));
            CHECK(g.z == Approx(1));
        }
        CHECK(std::isfinite(f(centres[0])));
        CHECK(std::isfinite(f.gradient(centres[0]).x));
    }
}

TEST_CASE("rbf: rough data get the kernel h, smooth ones h^3, and planes no noise", "[rbf]") {
    std::mt19937_64 random(4);
    Surface rough = holed([](double, double) { return 0.0; });
    draw(random, rough);
    CHECK(fitted(data_round_hole(rough)).kernel == RbfKernel::linear);
    const auto wave = [](double x, double y) { return std::sin(0.7 * x) * std::cos(0.5 * y); };
    const auto smooth = fitted(data_round_hole(holed(wave)));
    CHECK(smooth.kernel == RbfKernel::cubic);
    CHECK(smooth.noise < 1e-3);
    CHECK(height_at(smooth, 5.2, 4.9) == Approx(wave(5.2, 4.9)).margin(0.01));
    const auto plane = [](double x, double y) { return 0.3 * x - 0.2 * y + 7; };
    const auto flat = fitted(data_round_hole(holed(plane)));
    CHECK(flat.noise == 0);
    CHECK(height_at(flat, 5.2, 4.9) == Approx(plane(5.2, 4.9)).margin(1e-9));
}

TEST_CASE("rbf: noise is measured, and stays out of the graph", "[rbf]") {
    std::mt19937_64 random(5);
    std::normal_distribution<double> off(0, 0.05);
    const auto wave = [](double x, double y) { return std::sin(0.5 * x) + 0.1 * y; };
    const auto data =
        data_round_hole(holed([&](double x, double y) { return wave(x, y) + off(random); }));
    auto fit = fitted(data);
    CHECK(fit.noise == Approx(0.05).epsilon(0.2));
    CHECK(fit.validated > 0.03);
    CHECK(height_at(fit, 5.2, 4.9) == Approx(wave(5.2, 4.9)).margin(0.05));
    RbfReport noted;
    interpolate_noise(fit, data, {}, noted, {}); // which meets the data themselves
    CHECK(fit.f.rest.size() > 0);
    CHECK(noted.missed > 0.05);
    CHECK(noted.largest_error < 1e-9);
    // A wanted error is met.
    RbfOptions options;
    options.smoothing = 0.08;
    RbfReport report;
    const auto smooth = fit_heights(data, *graph_axes(data), options, report, {});
    REQUIRE(smooth);
    CHECK(report.rms_error == Approx(0.08).epsilon(0.1));
    CHECK(report.freedom > 3);
    CHECK(report.freedom < double(report.centres) / 2);
}

TEST_CASE("rbf: neither order, winding, axes, unit nor origin change a graph", "[rbf]") {
    std::mt19937_64 random(6);
    Surface s = holed([](double, double) { return 0.0; });
    draw(random, s);
    RbfOptions options;
    options.most_centres = 250; // fewer than there are data
    const auto plain = fitted(data_round_hole(s), options);
    const auto check = [&](const auto& change, double unit) {
        Surface other = s;
        for (Point3& p : other.vertices) p = change(p);
        std::vector<std::uint32_t> order(other.vertices.size());
        std::iota(order.begin(), order.end(), 0U);
        std::shuffle(order.begin(), order.end(), random);
        Surface mixed = other;
        for (std::size_t v = 0; v < order.size(); ++v) mixed.vertices[order[v]] = other.vertices[v];
        for (Triangle& t : mixed.triangles) t = {order[t[1]], order[t[0]], order[t[2]]};
        std::shuffle(mixed.triangles.begin(), mixed.triangles.end(), random);
        const auto fit = fitted(data_round_hole(mixed), options);
        CHECK(fit.kernel == plain.kernel);
        for (const double x : {4.2, 5.0, 5.9}) {
            const Point3 before{x, 5.3, height_at(plain, x, 5.3)}, after = change(before);
            CHECK(height_at(fit, after.x, after.y) == Approx(after.z).margin(1e-6 * unit));
        }
    };
    check([](const Point3& p) { return p; }, 1);
    check([](const Point3& p) { return Point3{-p.y, p.x, p.z}; }, 1);
    check([](const Point3& p) { return Point3{p.x, p.y, -p.z}; }, 1);
    check([](const Point3& p) { return Point3{8 * p.x, 8 * p.y, 8 * p.z}; }, 8);
    check([](const Point3& p) { return Point3{p.x + 5000, p.y - 700, p.z + 40}; }, 1);
}

TEST_CASE("rbf: kernels are stretched along grooves, whatever their direction", "[rbf]") {
    std::mt19937_64 random(10);
    Surface s = holed([](double, double) { return 0.0; });
    draw(random, s, 3);
    Surface turned = s;
    for (Point3& p : turned.vertices) p = {-p.y, p.x, p.z};
    const auto plain = fitted(data_round_hole(s)), other = fitted(data_round_hole(turned));
    CHECK(plain.kriging->anisotropy()[1] < 0.5);
    CHECK(other.kriging->anisotropy()[1] == plain.kriging->anisotropy()[1]);
    for (const double x : {4.2, 5.0, 5.9})
        CHECK(height_at(other, -5.3, x) == Approx(height_at(plain, x, 5.3)).margin(1e-6));
}

TEST_CASE("rbf: a steep sheet is a graph along its own normal, a cliff none", "[rbf]") {
    const SheetShape wall = [](double u, double v) { return Point3{0.1 * std::sin(v), u, v}; };
    const Surface s = punched(sheet(wall, 0, 0, 10, 10, 30, 30, 0.2),
                              [](const Point3& p) { return std::hypot(p.y - 5, p.z - 5) < 1.6; });
    const auto data = data_round_hole(s);
    const auto axes = graph_axes(data);
    REQUIRE(axes);
    CHECK(std::fabs((*axes)[2].x) > 0.9);
    auto folded = data;
    folded.points.push_back(folded.points[40]);
    folded.points.back().x += 1;
    folded.distances.push_back(folded.distances[40]);
    RbfReport report;
    CHECK(fit_heights(data, *axes, {}, report, {}));
    CHECK(!fit_heights(folded, *axes, {}, report, {}));
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    CHECK(!fit_heights(data, *axes, {}, report, run));
}

TEST_CASE("rbf: estimates and variances of a graph agree with the whole kriging system", "[rbf]") {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> somewhere(-1, 1);
    std::vector<Point3> data, places;
    for (int i = 0; i < 40; ++i)
        data.push_back({somewhere(random), somewhere(random), somewhere(random)});
    for (int i = 0; i < 70; ++i) places.push_back({somewhere(random), somewhere(random), 0});
    for (const double nugget : {0.0, 0.3}) {
        HeightSystem system(data, RbfKernel::linear, 1);
        REQUIRE(system.determined());
        REQUIRE(system.factorise(nugget, {}));
        const auto values = system.values(places), deviations = system.deviations(places, 1, {});
        // The same in Lagrange's form, with covariance -h.
        Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(43, 43);
        Eigen::VectorXd z(40);
        const auto distance = [](const Point3& p, const Point3& q) {
            return std::hypot(p.x - q.x, p.y - q.y);
        };
        for (int i = 0; i < 40; ++i) {
            const Point3& p = data[std::size_t(i)];
            for (int j = 0; j < 40; ++j)
                whole(i, j) = -distance(p, data[std::size_t(j)]) + (i == j ? nugget : 0);
            whole.row(i).tail(3) << 1, p.x, p.y;
            whole.col(i).tail(3) << 1, p.x, p.y;
            z[i] = p.z;
        }
        const auto solver = whole.fullPivLu();
        for (std::size_t k = 0; k < places.size(); ++k) {
            Eigen::VectorXd right(43);
            for (int i = 0; i < 40; ++i) right[i] = -distance(places[k], data[std::size_t(i)]);
            right.tail(3) << 1, places[k].x, places[k].y;
            const Eigen::VectorXd solved = solver.solve(right);
            CHECK(values[k] == Approx(solved.head(40).dot(z)).margin(1e-9));
            CHECK(deviations[k] == Approx(std::sqrt(-solved.dot(right))).epsilon(1e-6));
        }
    }
}
