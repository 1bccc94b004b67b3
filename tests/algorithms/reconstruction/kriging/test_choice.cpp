// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"
#include <terrane/algorithms/reconstruction/kriging/detail/direction_doubt.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>
#include <terrane/algorithms/reconstruction/kriging/height_errors.hpp>

using namespace terrane;
using namespace terrane::kriging::detail;
using namespace test_support;

namespace {

constexpr double hole_radius = 60;

/// Points round a hole, those on its border first, and places in it, whose heights are the truth.
struct Ring {
    std::vector<Point3> data;
    std::size_t border = 0;
    std::vector<Point3> places;

    [[nodiscard]] DataAroundHole around() const { return {data, border, hole_radius}; }
};

Ring ring_of(Random& random) {
    Ring ring;
    std::vector<Point3> outer;
    for (double x = -130; x < 131; x += 15)
        for (double y = -130; y < 131; y += 15) {
            const double r = std::hypot(x, y);
            const Point3 p{x + random_real(random, -2, 2), y + random_real(random, -2, 2), 0};
            if (r < hole_radius - 10 && ring.places.size() < 40) ring.places.push_back(p);
            if (r >= hole_radius && r < hole_radius + 12) ring.data.push_back(p);
            if (r >= hole_radius + 12) outer.push_back(p);
        }
    ring.border = ring.data.size();
    ring.data.insert(ring.data.end(), outer.begin(), outer.end());
    return ring;
}

/// Draws a field with exponential covariance at all points.
void draw(Random& random, Ring& ring) {
    std::vector<Point3*> all;
    for (Point3& p : ring.data) all.push_back(&p);
    for (Point3& p : ring.places) all.push_back(&p);
    const auto n = static_cast<Eigen::Index>(all.size());
    Eigen::MatrixXd c(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const Point3 &p = *all[std::size_t(i)], &q = *all[std::size_t(j)];
            c(i, j) = 100 * std::exp(-std::hypot(p.x - q.x, p.y - q.y) / 80);
        }
    std::normal_distribution<double> normal;
    Eigen::VectorXd free(n);
    for (Eigen::Index i = 0; i < n; ++i) free[i] = normal(random);
    const Eigen::VectorXd z = c.llt().matrixL() * free;
    for (Eigen::Index i = 0; i < n; ++i) all[std::size_t(i)]->z = z[i];
}

using MakeHeights = std::function<void(Random&, Ring&)>;

/// Heights of a function, with noise of this standard deviation at the data.
MakeHeights heights(const std::function<double(double, double)>& z, double noise) {
    return [=](Random& random, Ring& ring) {
        std::normal_distribution<double> normal(0, 1);
        for (Point3& p : ring.data) p.z = z(p.x, p.y) + noise * normal(random);
        for (Point3& p : ring.places) p.z = z(p.x, p.y);
    };
}

bool agree(double a, double b) {
    return std::abs(a - b) <= 1e-6 * (std::abs(a) + std::abs(b));
}

} // namespace

TEST_CASE("kriging: expected errors are calibrated, with noise and without", "[kriging][once]") {
    const auto plane = [](double x, double y) { return 0.1 * x - 0.05 * y; };
    const auto dome = [](double x, double y) {
        return 20 * std::exp(-(std::pow(x - 15, 2) + y * y) / 12'000);
    };
    const std::vector<std::pair<std::string, MakeHeights>> families{
        {"plane, noise", heights(plane, 1)},
        {"dome, noise", heights(dome, 1)},
        {"dome", heights(dome, 0)},
        {"exponential", draw}};
    Random random(31);
    for (const auto& [name, family] : families) {
        double squares = 0, count = 0, within = 0;
        for (int n = 0; n < 6; ++n) {
            Ring ring = ring_of(random);
            family(random, ring);
            auto options = VariogramFitOptions{};
            options.anisotropy = false;
            const auto choice = choose_model(ring.around(), options, {});
            CHECK(choice.determined);
            CHECK(choice.validation.blocks > 3);
            const Kriging kriging(ring.data, choice.variogram, choice.degree);
            const auto estimates = kriging.at(ring.places, {});
            for (std::size_t k = 0; k < estimates.size(); ++k) {
                const double ratio = std::abs(estimates[k].value - ring.places[k].z) /
                                     estimates[k].standard_deviation;
                squares += ratio * ratio;
                within += ratio <= 2 ? 1 : 0;
                ++count;
            }
        }
        CAPTURE(name, std::sqrt(squares / count), within / count);
        CHECK(std::sqrt(squares / count) < 2);
        CHECK(std::sqrt(squares / count) > 0.1);
        CHECK(within / count > 0.8);
    }
}

TEST_CASE("kriging: neither order nor axes, unit or origin decide the model", "[kriging]") {
    Random random(32);
    Ring ring = ring_of(random);
    draw(random, ring);
    REQUIRE(ring.data.size() > constants.most_fitted);
    const auto plain = choose_model(ring.around(), {}, {});
    const auto changed = [&](const auto& change) {
        Ring other = ring;
        for (Point3& p : other.data) p = change(p);
        const auto middle = other.data.begin() + static_cast<std::ptrdiff_t>(other.border);
        std::shuffle(other.data.begin(), middle, random);
        std::shuffle(middle, other.data.end(), random);
        return other;
    };
    const auto check = [&](const Ring& other, double xy, double z) {
        const auto c = choose_model({other.data, other.border, hole_radius * xy}, {}, {});
        CHECK(c.variogram.model == plain.variogram.model);
        CHECK(agree(c.variogram.range, plain.variogram.range * xy));
        CHECK(agree(c.variogram.sill, plain.variogram.sill * z * z));
        CHECK(agree(c.validation.error, plain.validation.error * z));
        CHECK(agree(c.validation.ratio, plain.validation.ratio));
    };
    check(changed([](const Point3& p) { return p; }), 1, 1);
    check(changed([](const Point3& p) { return Point3{-p.y, p.x, p.z}; }), 1, 1);
    check(changed([](const Point3& p) { return Point3{p.x, p.y, -p.z}; }), 1, 1);
    check(changed([](const Point3& p) { return Point3{8 * p.x, 8 * p.y, 4 * p.z}; }), 8, 4);
    check(changed([](const Point3& p) { return Point3{p.x + 5000, p.y - 700, p.z + 40}; }), 1, 1);
}

TEST_CASE("kriging: the order of the data changes no bit of an estimate", "[kriging]") {
    Random random(33);
    Ring ring = ring_of(random);
    draw(random, ring);
    const Variogram v{VariogramModel::matern, 0.1, 90, 300, 1.5, 30, 0.5};
    const auto first = Kriging(ring.data, v).at(ring.places, {});
    std::shuffle(ring.data.begin(), ring.data.end(), random);
    const auto second = Kriging(ring.data, v).at(ring.places, {});
    for (std::size_t k = 0; k < first.size(); ++k) {
        CHECK(first[k].value == second[k].value);
        CHECK(first[k].standard_deviation == second[k].standard_deviation);
    }
}

TEST_CASE("kriging: variances are those of the same weights with less noise", "[kriging]") {
    Random random(36);
    Ring ring = ring_of(random);
    draw(random, ring);
    ring.data.resize(30);
    const Variogram v{VariogramModel::matern, 2, 90, 300, 1.5, 30, 0.5};
    const auto all = System(ring.data, v, 1).standard_deviations(ring.places),
               none = System(ring.data, v, 1).standard_deviations(ring.places, 0);
    for (std::size_t k = 0; k < 5; ++k) {
        double squares = 0; // of the weights of single data
        for (std::size_t i = 0; i < ring.data.size(); ++i) {
            auto unit = ring.data;
            for (Point3& p : unit) p.z = 0;
            unit[i].z = 1;
            const double w = System(unit, v, 1).value(ring.places[k].x, ring.places[k].y);
            squares += w * w;
        }
        CHECK(all[k] * all[k] - none[k] * none[k] == Approx(v.nugget * squares));
    }
}

TEST_CASE("kriging: exact data have less noise than the least that is tried, others have it all",
          "[kriging]") {
    const auto wave = [](double x, double y) {
        return 20 * std::sin(x / 60) * std::cos(y / 70 + 1);
    };
    Random random(37);
    Ring ring = ring_of(random);
    heights(wave, 0)(random, ring);
    CHECK(choose_model(ring.around(), {}, {}).validation.noise_share < 0.5);
    heights(wave, 0.5)(random, ring);
    CHECK(choose_model(ring.around(), {}, {}).validation.noise_share == 1);
}

TEST_CASE("kriging: grooves round a hole need not continue in it", "[kriging]") {
    const auto grooves = [](double x, double y) { return std::sin(x / 9) + 0.002 * x * y / 60; };
    Random random(38);
    Ring ring = ring_of(random);
    heights(grooves, 0.05)(random, ring);
    const auto choice = choose_model(ring.around(), {}, {});
    REQUIRE(choice.plain);
    CHECK(choice.variogram.ratio < 1);
    CHECK(choice.plain->ratio == 1);
    CHECK(choice.doubt > 0);
    CHECK(choice.doubt <= constants.doubt);
    const auto doubts = DirectionDoubt(ring.data, choice, {}).at(ring.places, {});
    CHECK(*std::max_element(doubts.begin(), doubts.end()) > 0);
    auto straight = choice;
    straight.plain.reset();
    for (const double d : DirectionDoubt(ring.data, straight, {}).at(ring.places, {}))
        CHECK(d == 0);
}

TEST_CASE("kriging: heights of any method are judged by the model of the data", "[kriging]") {
    Random random(34);
    Ring ring = ring_of(random);
    heights([](double x, double y) { return 0.1 * x + 0.2 * y; }, 0.5)(random, ring);
    const HeightErrors errors(ring.data, ring.border, hole_radius, {});
    auto off = ring.places;
    for (Point3& p : off) p.z += 100;
    const auto near = errors.at(ring.places, {}), far = errors.at(off, {});
    for (std::size_t k = 0; k < near.size(); ++k) {
        CHECK(near[k] < 3);
        CHECK(far[k] == Approx(100).margin(3));
    }
    // A handful of data cannot tell.
    const HeightErrors blind(std::span(ring.data).first(8), 8, hole_radius, {});
    CHECK(std::isnan(blind.at(ring.places, {})[0]));
}

TEST_CASE("kriging: a stop request ends the search for a model at once", "[kriging]") {
    Random random(35);
    Ring ring = ring_of(random);
    draw(random, ring);
    std::stop_source source;
    int reports = 0;
    Run run;
    run.stop = source.get_token();
    run.progress = [&](std::string_view, double) {
        ++reports;
        source.request_stop();
    };
    choose_model(ring.around(), {}, run);
    CHECK(reports == 1);
    // A stopped factorisation is no system.
    const Variogram v{VariogramModel::exponential, 0, 1, 100};
    CHECK(!System(ring.data, v, 1, run).ready());
    CHECK(System(ring.data, v, 1).ready());
}
