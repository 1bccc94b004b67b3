// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/average.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
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
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>

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

Ring ring_of(Random& random, double half = 130) {
    Ring ring;
    std::vector<Point3> outer;
    for (double x = -half; x < half + 1; x += 15)
        for (double y = -half; y < half + 1; y += 15) {
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

/// Draws a field with exponential covariance at all points. `ratio`: of the range along y to that
/// along x.
void draw_with(Random& random, Ring& ring, double ratio) {
    std::vector<Point3*> all;
    for (Point3& p : ring.data) all.push_back(&p);
    for (Point3& p : ring.places) all.push_back(&p);
    const auto n = static_cast<Eigen::Index>(all.size());
    Eigen::MatrixXd c(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const Point3 &p = *all[std::size_t(i)], &q = *all[std::size_t(j)];
            c(i, j) = 100 * std::exp(-std::hypot(p.x - q.x, (p.y - q.y) / ratio) / 80);
        }
    std::normal_distribution<double> normal;
    Eigen::VectorXd free(n);
    for (Eigen::Index i = 0; i < n; ++i) free[i] = normal(random);
    const Eigen::VectorXd z = c.llt().matrixL() * free;
    for (Eigen::Index i = 0; i < n; ++i) all[std::size_t(i)]->z = z[i];
}

void draw(Random& random, Ring& ring) {
    draw_with(random, ring, 1);
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

KnownHeights estimates(const Ring& ring, const KrigingOptions& options = {}) {
    const auto average = weigh_models(ring.around(), options, {});
    return AveragedHeights(ring.around(), average, {}).at(ring.places, {});
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
            const auto known = estimates(ring);
            for (std::size_t k = 0; k < ring.places.size(); ++k) {
                const double ratio =
                    std::abs(known.heights[k] - ring.places[k].z) / known.expected[k];
                squares += ratio * ratio;
                within += ratio <= 2 ? 1 : 0;
                ++count;
            }
        }
        CAPTURE(name, std::sqrt(squares / count), within / count);
        CHECK(std::sqrt(squares / count) < 2);
        if (name != "dome") CHECK(std::sqrt(squares / count) > 0.1); // it is nearly gaussian
        CHECK(within / count > 0.8);
    }
}

TEST_CASE("kriging: models share the weight, and what parts them is expected as an error",
          "[kriging]") {
    Random random(32);
    Ring ring = ring_of(random);
    draw(random, ring);
    const auto average = weigh_models(ring.around(), {}, {});
    REQUIRE(average.models.size() > 2);
    CHECK(average.models.size() <= 12);
    CHECK(average.blocks > 3);
    CHECK(average.blocks <= 16);
    CHECK(average.factor > 0.4);
    double sum = 0;
    for (const WeighedModel& m : average.models) {
        sum += m.weight;
        CHECK(description(m).find("trend of degree") == 0);
    }
    CHECK(sum == Approx(1));
    // The estimate is the weighted mean, and its variance has a part between the models.
    const AveragedHeights averaged(ring.around(), average, {});
    const Point3& place = ring.places[7];
    double mean = 0, variance = 0;
    const auto shares = averaged.shares_at(place);
    REQUIRE(shares.size() == average.models.size());
    for (const ModelShare& s : shares) mean += s.weight * s.height;
    for (const ModelShare& s : shares)
        variance += s.weight * (s.deviation * s.deviation + std::pow(s.height - mean, 2));
    const auto known = averaged.at(std::span(&place, 1), {});
    CHECK(known.heights[0] == Approx(mean));
    CHECK(known.expected[0] == Approx(average.factor * std::sqrt(variance)));
}

TEST_CASE("kriging: expected errors grow where data that are left out are missed by more",
          "[kriging]") {
    const auto factor = [](const ModelAverage& average) {
        const auto trusted = [](double ratio, double blocks) {
            const double n = std::min(blocks, 8.0); // and the models' own opinion counts for two
            return (n * ratio * ratio + 2) / (n + 2);
        };
        return std::sqrt(std::max(trusted(average.ratio, double(average.blocks)),
                                  std::pow(trusted(average.rim_ratio, 100), 2)));
    };
    // A step next to the hole is as likely for many models; its blocks are missed by more.
    Random random(39);
    Ring ring = ring_of(random);
    heights([](double x, double) { return 20 * std::tanh((x + 75) / 8); }, 0)(random, ring);
    const auto step = weigh_models(ring.around(), {}, {});
    CHECK(step.ratio > 0);
    CHECK(step.factor == Approx(factor(step)));
    CHECK(step.left_out.size() > 20);
    // Only the rim of the hole shows that a peak begins.
    heights([](double x, double y) { return 60 * std::exp(-(x * x + y * y) / (2 * 30 * 30)); },
            0.05)(random, ring);
    const auto peak = weigh_models(ring.around(), {}, {});
    CHECK(peak.rim_ratio > 2);
    CHECK(peak.factor > peak.rim_ratio);
    CHECK(peak.factor == Approx(factor(peak)));
}

TEST_CASE("kriging: data far away help models that hold there, and no others", "[kriging]") {
    const auto smooth = [](double x, double y) { return 9 * std::sin(x / 40) * std::cos(y / 50); };
    const auto cliff = [&](double x, double y) { return smooth(x, y) + (x > 105 ? 30 : 0); };
    Random random(44);
    Ring ring = ring_of(random);
    const auto is_near = [](const Point3& p) { return std::hypot(p.x, p.y) < 100; };
    const auto first_far = std::stable_partition(
        ring.data.begin() + static_cast<std::ptrdiff_t>(ring.border), ring.data.end(), is_near);
    const auto near = static_cast<std::size_t>(first_far - ring.data.begin());
    ModelAverage average;
    average.models = {{{VariogramModel::gaussian, 1e-7, 20, 130}, 0, 1}};
    const auto found = [&](bool all) {
        const std::span<const Point3> data(ring.data);
        const AveragedHeights heights(
            {all ? data : data.first(near), ring.border, hole_radius, near}, average, {});
        return heights.at(ring.places, {}).heights;
    };
    const auto missed = [&](bool all) {
        const auto known = found(all);
        double squares = 0;
        for (std::size_t k = 0; k < ring.places.size(); ++k)
            squares += std::pow(known[k] - smooth(ring.places[k].x, ring.places[k].y), 2);
        return std::sqrt(squares / static_cast<double>(ring.places.size()));
    };
    heights(smooth, 0)(random, ring);
    CHECK(missed(true) < 0.5 * missed(false));
    heights(cliff, 0)(random, ring);
    CHECK(missed(true) == Approx(missed(false)));
    // Of a draw of the model itself the squares are what it expects; of twice the heights, four times.
    draw(random, ring);
    average.models = {{{VariogramModel::exponential, 0, 100, 240}, 0, 1}};
    CHECK(found(true) != found(false));
    for (Point3& p : ring.data) p.z *= 2;
    CHECK(found(true) == found(false));
    // A cliff far away is seen by those who search for models, too.
    heights([](double x, double y) { return x - y / 3 + (x > 105 ? 30 : 0); }, 0)(random, ring);
    const auto models = [&](std::size_t count) {
        return weigh_models({std::span(ring.data).first(count), ring.border, hole_radius, near}, {},
                            {})
            .models;
    };
    CHECK(models(near)[0].variogram.sill == 0); // a trend, and no more
    CHECK(models(ring.data.size())[0].variogram.sill > 0);
}

TEST_CASE("kriging: planes and paraboloids are known to rounding", "[kriging]") {
    Random random(40);
    for (const auto& z : std::vector<std::function<double(double, double)>>{
             [](double, double) { return 7.0; }, [](double x, double y) { return 3 + 0.2 * x - y; },
             [](double x, double y) { return 0.01 * x * x - 0.02 * x * y + y; }}) {
        Ring ring = ring_of(random);
        heights(z, 0)(random, ring);
        const auto known = estimates(ring);
        for (std::size_t k = 0; k < ring.places.size(); ++k) {
            CHECK(known.heights[k] == Approx(ring.places[k].z).margin(1e-9));
            CHECK(known.expected[k] < 1e-6);
        }
    }
}

TEST_CASE("kriging: a paraboloid with noise is extrapolated as one, a dome is not", "[kriging]") {
    Random random(41);
    double missed = 0;
    for (int n = 0; n < 4; ++n) {
        Ring ring = ring_of(random);
        heights([](double x, double y) { return 0.004 * (x * x + y * y); }, 1)(random, ring);
        const auto known = estimates(ring);
        for (std::size_t k = 0; k < ring.places.size(); ++k)
            missed = std::max(missed, std::abs(known.heights[k] - ring.places[k].z));
    }
    CHECK(missed < 3);
}

TEST_CASE("kriging: neither order nor axes, unit or origin decide the models", "[kriging]") {
    Random random(32);
    Ring ring = ring_of(random);
    draw(random, ring);
    const auto plain = weigh_models(ring.around(), {}, {});
    const auto changed = [&](const auto& change) {
        Ring other = ring;
        for (Point3& p : other.data) p = change(p);
        const auto middle = other.data.begin() + static_cast<std::ptrdiff_t>(other.border);
        std::shuffle(other.data.begin(), middle, random);
        std::shuffle(middle, other.data.end(), random);
        return other;
    };
    const auto check = [&](const Ring& other, double xy, double z) {
        const auto c = weigh_models({other.data, other.border, hole_radius * xy}, {}, {});
        REQUIRE(c.models.size() == plain.models.size());
        const Variogram &a = c.models[0].variogram, &b = plain.models[0].variogram;
        CHECK(a.model == b.model);
        CHECK(agree(a.range, b.range * xy));
        CHECK(agree(c.models[0].weight, plain.models[0].weight));
        CHECK(agree(c.error, plain.error * z));
        CHECK(agree(c.ratio, plain.ratio));
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
    ModelAverage average;
    average.models = {{{VariogramModel::matern, 0.1, 90, 300, 1.5, 30, 0.5}, 1, 0.7},
                      {{VariogramModel::thin_plate, 0.1, 9, 300}, 1, 0.3}};
    const auto first = AveragedHeights(ring.around(), average, {}).at(ring.places, {});
    std::shuffle(ring.data.begin(), ring.data.end(), random);
    const auto second = AveragedHeights(ring.around(), average, {}).at(ring.places, {});
    CHECK(first.heights == second.heights);
    CHECK(first.expected == second.expected);
}

TEST_CASE("kriging: grooves are followed, and other models are not silenced", "[kriging]") {
    const auto grooves = [](double x, double y) { return std::sin(x / 25) + 0.0005 * x * y / 60; };
    Random random(38);
    Ring ring = ring_of(random);
    heights(grooves, 0.02)(random, ring);
    const auto turned = [](const ModelAverage& average) {
        double weight = 0;
        for (const WeighedModel& m : average.models)
            if (m.variogram.ratio < 1) weight += m.weight;
        return weight;
    };
    CHECK(turned(weigh_models(ring.around(), {}, {})) > 0.5);
    CHECK(turned(weigh_models(ring.around(), {.anisotropy = false}, {})) == 0);
    // A field whose range is less than half as long across is met as if that were known.
    double weight = 0, own = 0, least = 0;
    for (int n = 0; n < 6; ++n) {
        draw_with(random, ring, 0.4);
        const auto average = weigh_models(ring.around(), {}, {});
        const auto known = AveragedHeights(ring.around(), average, {}).at(ring.places, {});
        const System optimum(ring.data, {VariogramModel::exponential, 0, 100, 240, 1, 0, 0.4}, 0);
        const auto best = optimum.at(ring.places, false);
        for (std::size_t k = 0; k < ring.places.size(); ++k) {
            own += std::pow(known.heights[k] - ring.places[k].z, 2);
            least += std::pow(best[k].value - ring.places[k].z, 2);
        }
        weight += turned(average) / 6;
    }
    CAPTURE(own / least);
    CHECK(weight > 0.5);
    CHECK(own < 1.1 * least);
}

TEST_CASE("kriging: all of the border of a long hole is left out, part by part", "[kriging]") {
    std::vector<Point3> border, others;
    Random random(45);
    for (double x = -100; x < 501; x += 10)
        for (double y = -100; y < 131; y += 10) {
            const bool is_inside = x > 0 && x < 400 && y > 0 && y < 30;
            const bool is_on_border = x >= 0 && x <= 400 && y >= 0 && y <= 30;
            if (!is_inside)
                (is_on_border ? border : others).push_back({x, y, random_real(random, 0, 1)});
        }
    const auto on_border = border.size();
    std::vector<Point3> data = border;
    data.insert(data.end(), others.begin(), others.end());
    const auto average =
        weigh_models({data, on_border, std::sqrt(400 * 30 / M_PI), on_border}, {}, {});
    for (const Point3& p : border)
        CHECK(std::any_of(average.left_out.begin(), average.left_out.end(),
                          [&](const auto& left) { return left[0] == p.z; }));
}

TEST_CASE("kriging: weighing models takes as long as a few systems of equations",
          "[kriging][once]") {
    Random random(46);
    Ring ring = ring_of(random, 210);
    REQUIRE(ring.data.size() > 700);
    draw(random, ring);
    const auto seconds = [](const auto& work) {
        const auto start = std::clock();
        work();
        return double(std::clock() - start) / CLOCKS_PER_SEC;
    };
    const double one = seconds([&] {
        const Variogram v{VariogramModel::exponential, 0, 100, 240};
        CHECK(System(ring.data, v, 1).ready());
    });
    const double all = seconds([&] { weigh_models(ring.around(), {}, {}); });
    CAPTURE(one, all);
    CHECK(all < 15 * one);
}

TEST_CASE("kriging: expected errors of many places are those of few, or little more", "[kriging]") {
    Random random(47);
    Ring ring = ring_of(random, 210);
    draw(random, ring);
    ModelAverage average;
    average.models = {{{VariogramModel::exponential, 1, 100, 240}, 0, 0.5},
                      {{VariogramModel::matern, 1, 100, 300, 1.5}, 1, 0.5}};
    const AveragedHeights heights(ring.around(), average, {});
    const auto few = heights.at(ring.places, {});
    std::vector<Point3> places;
    while (places.size() < 2000)
        places.insert(places.end(), ring.places.begin(), ring.places.end());
    const auto many = heights.at(places, {});
    for (std::size_t k = 0; k < ring.places.size(); ++k) {
        CHECK(many.heights[k] == few.heights[k]);
        CHECK(many.expected[k] > few.expected[k]);
        CHECK(many.expected[k] < 1.3 * few.expected[k]);
    }
}

TEST_CASE("kriging: only models that are wanted take part", "[kriging]") {
    Random random(42);
    Ring ring = ring_of(random);
    draw(random, ring);
    const auto models = [&](const KrigingOptions& options) {
        std::vector<VariogramModel> found;
        for (const WeighedModel& m : weigh_models(ring.around(), options, {}).models)
            if (m.variogram.sill > 0) found.push_back(m.variogram.model);
        REQUIRE(!found.empty());
        return found;
    };
    using enum VariogramModel;
    for (const auto model : {spherical, exponential, matern, gaussian, power})
        for (const auto found : models({.model = model})) CHECK(found == model);
    for (const WeighedModel& m : weigh_models(ring.around(), {.noise = 3.0}, {}).models)
        CHECK(m.variogram.nugget == 9);
}

TEST_CASE("kriging: with few data no expected error is told", "[kriging]") {
    Random random(34);
    Ring ring = ring_of(random);
    draw(random, ring);
    const DataAroundHole few{std::span(ring.data).first(19), 8, hole_radius};
    const auto average = weigh_models(few, {}, {});
    CHECK(average.unknown == "too few data");
    const DataAroundHole enough{std::span(ring.data).first(20), 8, hole_radius};
    CHECK(weigh_models(enough, {}, {}).unknown.empty());
    const auto known = AveragedHeights(few, average, {}).at(ring.places, {});
    for (const double e : known.expected) CHECK(std::isnan(e));
    for (const double z : known.heights) CHECK(std::isfinite(z));
}

TEST_CASE("kriging: the expected error of equal heights is no less than their rounding",
          "[kriging]") {
    Random random(36);
    Ring ring = ring_of(random);
    for (const double height : {0.0, 7.0}) {
        for (Point3& p : ring.data) p.z = height;
        const auto average = weigh_models(ring.around(), {}, {});
        CHECK(average.unknown.empty() == (height != 0));
        const auto known = AveragedHeights(ring.around(), average, {}).at(ring.places, {});
        for (const double e : known.expected)
            CHECK((height == 0 ? std::isnan(e) : e >= std::nextafter(7.0, 8) - 7));
        for (const double z : known.heights) CHECK(z == height);
    }
}

TEST_CASE("kriging: next to long borders the filling meets data that are not taken", "[kriging]") {
    const auto wave = [](double x, double y) { return std::sin(x / 3) + y / 10; };
    std::vector<Point3> data;
    constexpr int around = 1400;
    for (const double radius : {100.0, 101.0})
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * M_PI * i / around, x = radius * std::cos(angle),
                         y = radius * std::sin(angle);
            data.push_back({x, y, wave(x, y)});
        }
    ModelAverage average;
    average.models = {{{VariogramModel::exponential, 0, 1, 60}, 1, 1}};
    const AveragedHeights heights({data, around, 100}, average, {});
    double missed = 0;
    std::vector<Point3> places(data.begin(), data.begin() + around);
    const auto known = heights.at(places, {});
    for (std::size_t i = 0; i < places.size(); ++i)
        missed = std::max(missed, std::abs(known.heights[i] - places[i].z));
    CHECK(missed < 1e-6);
    // Noise is not carried on.
    average.models[0].variogram.nugget = 1e6;
    CHECK(std::abs(AveragedHeights({data, around, 100}, average, {}).at(places, {}).heights[0] -
                   places[0].z) > 1e-3);
}

TEST_CASE("kriging: a stop request ends the search for models at once", "[kriging]") {
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
    weigh_models(ring.around(), {}, run);
    CHECK(reports == 1);
    // A stopped factorisation is no system.
    const Variogram v{VariogramModel::exponential, 0, 1, 100};
    CHECK(!System(ring.data, v, 1, run).ready());
    CHECK(System(ring.data, v, 1).ready());
}
