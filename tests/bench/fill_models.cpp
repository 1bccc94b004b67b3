// SPDX-License-Identifier: LGPL-3.0-or-later
#include "fill_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include <terrane/algorithms/mesh/triangle_tree.hpp>

#include "support/shapes.hpp"

namespace fill_bench {

using terrane::Point3;
using terrane::Surface;
using terrane::Triangle;

namespace {

constexpr int cells = 60;
using Shape = std::function<Point3(double u, double v)>; ///< maps the unit square
using Inside = std::function<bool(double u, double v)>;

/// Returns the sheet over the unit square with n x n cells, without those in `left_out`.
Surface sheet(int n, const Shape& shape, const Inside& left_out) {
    return test_support::sheet_of(
        n, n, 1, [&](int i, int j) { return !left_out((i + 0.5) / n, (j + 0.5) / n); },
        [&](double i, double j) { return shape(i / n, j / n); });
}

/// Returns an ellipse with lobes off the middle, so that the hole is not a circle.
Inside hole(double share, int variant) {
    const double u0 = 0.5 + 0.04 * std::sin(variant), v0 = 0.5 + 0.04 * std::cos(2.0 * variant);
    const double a = std::sqrt(share / M_PI) * 1.25, b = share / M_PI / a;
    const double turn = 0.7 * variant;
    return [=](double u, double v) {
        const double x = std::cos(turn) * (u - u0) + std::sin(turn) * (v - v0);
        const double y = std::cos(turn) * (v - v0) - std::sin(turn) * (u - u0);
        const double lobes = 1 + 0.12 * std::cos(3 * std::atan2(y, x) + variant);
        return std::hypot(x / a, y / b) < lobes;
    };
}

Shape graph(const std::function<double(double, double)>& z) {
    return [=](double u, double v) { return Point3{1000 * u, 1000 * v, z(u, v)}; };
}

/// Returns a random height for each node, the same at each call.
double noise_at(double u, double v) {
    std::mt19937 random(static_cast<unsigned>(std::lround(u * 240) * 1000 + std::lround(v * 240)));
    return std::normal_distribution<double>(0, 2)(random);
}

/// Returns an overturned fold: three sheets lie above one another along z, with a hinge in the
/// middle.
Shape fold(double lean, double height) {
    const double phase = std::acos(1000 / (4 * M_PI * lean));
    return [=](double u, double v) {
        const double t = 2 * M_PI * (u - 0.5);
        return Point3{1000 * u - lean * std::sin(2 * t + phase), 1000 * v, height * std::sin(t)};
    };
}

/// Makes a model with a hole, whose shape and share of the area change with its number in the list.
Model model(std::string name, const Shape& shape, bool smooth, bool is_graph, std::size_t number) {
    constexpr std::array shares{0.01, 0.02, 0.05, 0.1, 0.2};
    Model m;
    m.share = shares[number % shares.size()];
    m.name = std::move(name);
    m.smooth = smooth;
    m.graph = is_graph;
    if (is_graph && smooth)
        m.height = [=](double x, double y) { return shape(x / 1000, y / 1000).z; };
    m.holed = sheet(cells, shape, hole(m.share, int(number)));
    m.whole = sheet(4 * cells, shape, [](double, double) { return false; });
    return m;
}

} // namespace

std::vector<Model> fold_models() {
    std::vector<Model> list;
    for (const double lean : {100.0, 120.0, 150.0, 180.0, 200.0, 220.0, 240.0})
        for (int k = 0; k < 6; ++k)
            list.push_back(model("fold " + std::to_string(int(lean)),
                                 fold(lean, k % 2 == 0 ? 220 : 150), true, false, list.size()));
    return list;
}

std::vector<Model> models() {
    std::vector<Model> list;
    const auto add = [&](std::string name, const Shape& shape, bool smooth, bool is_graph) {
        list.push_back(model(std::move(name), shape, smooth, is_graph, list.size()));
    };
    for (const double slope : {0.0, 0.2, 1.5})
        add("plane " + std::to_string(slope).substr(0, 3),
            graph([=](double u, double v) { return 1000 * slope * (u + 0.3 * v); }), true, true);
    for (const double waves : {0.5, 1.0, 1.5, 2.0, 3.0})
        add("wave " + std::to_string(waves).substr(0, 3), graph([=](double u, double v) {
                return 50 * std::sin(2 * M_PI * waves * (u + 0.2 * v));
            }),
            true, true);
    for (const double waves : {0.5, 1.0, 1.5, 2.0, 2.5})
        add("crossed waves " + std::to_string(waves).substr(0, 3), graph([=](double u, double v) {
                return 40 * std::sin(2 * M_PI * waves * u) * std::cos(2 * M_PI * waves * 0.8 * v);
            }),
            true, true);
    for (const double width : {0.15, 0.25, 0.35, 0.5})
        add("bell " + std::to_string(width).substr(0, 4), graph([=](double u, double v) {
                return 100 * std::exp(-(std::pow(u - 0.47, 2) + std::pow(v - 0.52, 2)) /
                                      (2 * width * width));
            }),
            true, true);
    for (const double radius : {0.9, 1.2, 2.0})
        add("cap " + std::to_string(radius).substr(0, 3), graph([=](double u, double v) {
                const double square = std::pow(u - 0.5, 2) + std::pow(v - 0.45, 2);
                return 1000 * (std::sqrt(radius * radius - square) - radius);
            }),
            true, true);
    add("saddle", graph([](double u, double v) { return 200 * (u - 0.5) * (v - 0.4); }), true,
        true);
    add("basin", graph([](double u, double v) {
            return 300 * (std::pow(u - 0.6, 2) + 0.4 * std::pow(v - 0.5, 2)) + 100 * u;
        }),
        true, true);
    for (int k = 0; k < 2; ++k)
        add("noise on a wave", graph([](double u, double v) {
                return 50 * std::sin(2 * M_PI * u) + 20 * std::cos(5 * v) + noise_at(u, v);
            }),
            false, true);
    for (const double lean : {120.0, 180.0, 220.0})
        add("fold " + std::to_string(int(lean)), fold(lean, 150), true, false);
    for (const double lift : {30.0, 60.0, 100.0})
        add("throw " + std::to_string(int(lift)), graph([=](double u, double v) {
                const double fade = std::clamp(std::min(v, 1 - v) * 4, 0.0, 1.0);
                return 30 * std::sin(3 * u) + (u > 0.505 ? lift * fade : 0.0);
            }),
            false, true);
    return list;
}

Misfit misfit(const Model& model, const Surface& filled, std::size_t first) {
    const terrane::TriangleTree tree(model.whole.vertices, model.whole.triangles);
    const auto off = [&](const Point3& p) {
        return model.height ? std::abs(p.z - model.height(p.x, p.y)) : tree.distance(p, 1e9);
    };
    Misfit result;
    double squares = 0, total = 0;
    for (auto t = first; t < filled.triangles.size(); ++t) {
        const Triangle& c = filled.triangles[t];
        const Point3 &p = filled.vertices[c[0]], &q = filled.vertices[c[1]],
                     &r = filled.vertices[c[2]];
        const double area = std::abs((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
        const double longest = std::max({std::hypot(q.x - p.x, q.y - p.y, q.z - p.z),
                                         std::hypot(r.x - p.x, r.y - p.y, r.z - p.z),
                                         std::hypot(q.x - r.x, q.y - r.y, q.z - r.z)});
        const int n = std::clamp(int(longest / 12), 1, 30); // samples along an edge
        const double weight = area / (n * (n + 1) / 2.0);
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                const double a = (i + 1.0 / 3) / n, b = (j + 1.0 / 3) / n;
                const auto mix = [&](double Point3::*k) {
                    return (1 - a - b) * p.*k + a * q.*k + b * r.*k;
                };
                const Point3 at{mix(&Point3::x), mix(&Point3::y), mix(&Point3::z)};
                const double d = off(at);
                squares += weight * d * d;
                total += weight;
                result.largest = std::max(result.largest, d);
            }
    }
    result.rms = total > 0 ? std::sqrt(squares / total) : 0;
    double sum = 0;
    const auto old = model.holed.vertices.size();
    for (auto v = old; v < filled.vertices.size(); ++v) {
        const double d = off(filled.vertices[v]);
        sum += d * d;
        result.vertex_largest = std::max(result.vertex_largest, d);
    }
    if (filled.vertices.size() > old)
        result.vertex_rms = std::sqrt(sum / double(filled.vertices.size() - old));
    return result;
}

} // namespace fill_bench
