// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/weights.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "support/points.hpp"
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>

using namespace terrane;
using namespace terrane::kriging::detail;
using namespace test_support;

namespace {

constexpr double spacing = 10;

/// Returns a lattice of n x n points.
std::vector<Point3> lattice(int n, const std::function<double(double, double)>& z) {
    std::vector<Point3> points;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double x = spacing * i, y = spacing * j;
            points.push_back({x, y, z(x, y)});
        }
    return points;
}

/// Weighs models of data without any hole: no block is left out.
std::vector<WeighedModel> models_of(const std::vector<Point3>& data,
                                    const KrigingOptions& options) {
    const auto average = weigh_models({data, data.size(), 1e9}, options, {});
    CHECK(average.blocks == 0);
    return average.models;
}

double likelihood_of(const Likelihood& likelihood, const WeighedModel& model) {
    for (const Likely& l : likelihood.at(model.variogram))
        if (l.degree == model.degree) return l.likelihood;
    return -HUGE_VAL;
}

double smooth(double x, double y) {
    return std::sin(x / 21) * std::cos(y / 27) + std::sin((x + 2 * y) / 35);
}

} // namespace

TEST_CASE("kriging: logarithms of likelihoods are halved", "[kriging]") {
    Random random(51);
    std::normal_distribution<double> normal;
    const auto data =
        lattice(9, [&](double x, double y) { return smooth(x, y) + 0.3 * normal(random); });
    const Likelihood likelihood(data); // of so few data, all
    const auto models = models_of(data, {.anisotropy = false});
    REQUIRE(models.size() > 2);
    const double best = likelihood_of(likelihood, models[0]);
    for (const WeighedModel& m : models)
        if (m.weight > 0 && m.variogram.sill > 0)
            CHECK(std::log(m.weight / models[0].weight) ==
                  Approx((likelihood_of(likelihood, m) - best) / 2).margin(1e-6));
}

TEST_CASE("kriging: models that weigh less than a hundredth have no say", "[kriging]") {
    Random random(53);
    std::normal_distribution<double> normal;
    const auto noise = lattice(9, [&](double, double) { return normal(random); });
    int above = 0, below = 0;
    for (int k = 0; k < 20; ++k) {
        auto data = noise;
        for (Point3& p : data) p.z += (0.9 + 0.03 * k) * smooth(p.x, p.y);
        // The likeliest of many ranges, and of noise alone.
        const Likelihood likelihood(data);
        std::array<double, 3> best{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (const Likely& l : likelihood.of_noise()) best[2] = std::max(best[2], l.likelihood);
        for (double range = 3 * spacing; range < 2 * likelihood.extent(); range *= 1.1)
            for (const bool twice : {false, true})
                for (const Likely& l :
                     likelihood.at({VariogramModel::matern, 0, 1, range, twice ? 2.5 : 1.5}))
                    best[twice] = std::max(best[twice], l.likelihood);
        double sum = 0;
        for (const double b : best) sum += std::exp((b - best[2]) / 2);
        const bool is_noise_kept = std::ranges::any_of(
            models_of(data, {.model = VariogramModel::matern, .anisotropy = false}),
            [](const WeighedModel& m) { return m.variogram.sill == 0; });
        above += 1 / sum > 0.0125 && 1 / sum < 0.04 ? 1 : 0;
        below += 1 / sum < 0.008 && 1 / sum > 0.0025 ? 1 : 0;
        if (1 / sum > 0.0125) CHECK(is_noise_kept);
        if (1 / sum < 0.008) CHECK(!is_noise_kept);
    }
    CHECK(above > 0);
    CHECK(below > 0);
}

TEST_CASE("kriging: the range of a smooth surface is the likeliest one within 1.5 percent",
          "[kriging]") {
    for (const double scale : {1.0, 1.1, 1.25, 1.4}) {
        const auto data =
            lattice(9, [&](double x, double y) { return smooth(x / scale, y / scale); });
        const Likelihood likelihood(data);
        WeighedModel model = models_of(data, {.model = VariogramModel::gaussian})[0];
        const double found = model.variogram.range;
        double best = -HUGE_VAL, likeliest = 0;
        for (double part = 0.9; part < 1.1; part += 0.001) {
            model.variogram.range = found * part;
            const double l = likelihood_of(likelihood, model);
            if (l > best) likeliest = model.variogram.range;
            best = std::max(best, l);
        }
        CHECK(found == Approx(likeliest).epsilon(0.015));
    }
}

TEST_CASE("kriging: a range is no less than three distances of neighbours", "[kriging]") {
    Random random(52);
    std::normal_distribution<double> normal;
    for (const int n : {9, 9, 9, 9, 20}) {
        const auto data = lattice(n, [&](double, double) { return normal(random); });
        for (const WeighedModel& m : models_of(data, {.model = VariogramModel::exponential}))
            if (m.variogram.sill > 0) CHECK(m.variogram.range > 2.999 * spacing);
    }
}

TEST_CASE("kriging: a rim of half a radius is left out", "[kriging]") {
    constexpr double radius = 40;
    // A foot that begins outside of a hole and is flat farther away.
    const auto ratio_for = [&](double begin) {
        std::vector<Point3> border, others;
        for (const Point3& p : lattice(24, [](double, double) { return 0.0; })) {
            const double x = p.x - 115, y = p.y - 115, r = std::hypot(x, y);
            const double rise = std::max(0.0, begin * radius - r);
            const Point3 q{x, y, 0.01 * rise * rise + 0.01 * std::sin(x) * std::cos(y)};
            if (r >= radius) (r < radius + spacing ? border : others).push_back(q);
        }
        const auto on_border = border.size();
        border.insert(border.end(), others.begin(), others.end());
        return weigh_models({border, on_border, radius}, {}, {}).rim_ratio;
    };
    CHECK(ratio_for(1.45) > 5); // a wider rim would be missed by less, but for data that are flat
    CHECK(ratio_for(1.8) > 5);  // a narrow one, too, since the foot goes on outside of it
}
