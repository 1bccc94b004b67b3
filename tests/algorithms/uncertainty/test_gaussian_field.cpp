// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests random fields against the covariance that users are promised, by the formulas of the reference.
#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <terrane/algorithms/uncertainty/gaussian_field.hpp>

using namespace terrane;

namespace {

struct Promise {
    VariogramModel model;
    double exponent;
    double half, whole; ///< correlation at half of the range, and at the range
};

/// The correlations of values at three places, and moments of the first, over many fields.
struct Seen {
    double half = 0, whole = 0, squares = 0, fourth = 0;
};

Seen seen(const Variogram& v, const Point3& from, const Point3& direction, int fields,
          std::size_t waves) {
    Seen all;
    for (int i = 0; i < fields; ++i) {
        const GaussianField field(v, RandomStream("field " + std::to_string(i)), waves);
        const auto at = [&](double share) {
            const double h = share * v.range;
            return field.at(
                {from.x + h * direction.x, from.y + h * direction.y, from.z + h * direction.z});
        };
        const double a = at(0);
        all.half += a * at(0.5) / fields;
        all.whole += a * at(1) / fields;
        all.squares += a * a / fields;
        all.fourth += a * a * a * a / fields;
    }
    return all;
}

} // namespace

TEST_CASE("gaussian field: each model has its covariance in the map and in space",
          "[uncertainty][once]") {
    const std::vector<Promise> promises{
        {VariogramModel::spherical, 0, 0.3125, 0},
        {VariogramModel::exponential, 0, 0.22313, 0.049787},
        {VariogramModel::gaussian, 0, 0.47237, 0.049787},
        {VariogramModel::matern, 1.5, 0.31455, 0.05},
        {VariogramModel::matern, 2.5, 0.35657, 0.05},
    };
    const int fields = 20000;
    const double bound = 5 * std::sqrt(2.0 / fields); // of a mean of products, at most
    for (const Promise& p : promises) {
        Variogram v;
        v.model = p.model;
        v.range = 700;
        v.exponent = p.exponent;
        CAPTURE(static_cast<int>(p.model), p.exponent);
        for (const Point3 direction : {Point3{0.6, 0.8, 0}, {0, 0, 1}, {-0.48, 0.6, 0.64}}) {
            const Seen s = seen(v, {431000, 4100000, -1500}, direction, fields, 8);
            CHECK(std::fabs(s.half - p.half) < bound);
            CHECK(std::fabs(s.whole - p.whole) < bound);
            CHECK(std::fabs(s.squares - 1) < bound);
        }
    }
}

TEST_CASE("gaussian field: a value is normal even with one wave", "[uncertainty]") {
    Variogram v;
    v.model = VariogramModel::gaussian;
    v.range = 3;
    const int fields = 50000;
    const Seen s = seen(v, {1, 2, 3}, {1, 0, 0}, fields, 1);
    CHECK(std::fabs(s.squares - 1) < 5 * std::sqrt(2.0 / fields));
    CHECK(std::fabs(s.fourth - 3) < 5 * std::sqrt(96.0 / fields));
}

TEST_CASE("gaussian field: the range is shorter across the main direction", "[uncertainty]") {
    Variogram v;
    v.model = VariogramModel::gaussian;
    v.range = 10;
    v.angle = 30;
    v.ratio = 0.5;
    const int fields = 20000;
    const double bound = 5 * std::sqrt(2.0 / fields), root = std::sqrt(0.75);
    CHECK(std::fabs(seen(v, {}, {root, 0.5, 0}, fields, 8).half - 0.47237) < bound);
    CHECK(std::fabs(seen(v, {}, {-0.5, root, 0}, fields, 8).half - 0.049787) < bound);
}

TEST_CASE("gaussian field: with the waves of realisations, one field already has the covariance",
          "[uncertainty][once]") {
    // Law (3): the covariance for given frequencies, from the mean over many places of one field's kind,
    // is within five times sqrt(1 / (2 M)) of the stated one. Phases and amplitudes are averaged over.
    Variogram v;
    v.model = VariogramModel::exponential;
    v.range = 1;
    double squares = 0, products = 0;
    int n = 0;
    const GaussianField field(v, RandomStream("one"));
    for (int i = 0; i < 400; ++i)
        for (int j = 0; j < 400; ++j, ++n) {
            const Point3 p{i * 1.7, j * 1.3, 0};
            const double a = field.at(p);
            squares += a * a;
            products += a * field.at({p.x + 0.5, p.y, 0});
        }
    CHECK(std::fabs(squares / n - 1) < 0.25); // the mean of 512 squared amplitudes
    CHECK(std::fabs(products / squares - 0.22313) < 5 * std::sqrt(1.0 / (2 * field_waves)));
}
