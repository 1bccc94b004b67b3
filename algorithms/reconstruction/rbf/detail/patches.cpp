// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/patches.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Dense>

#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>

namespace terrane::rbf::detail {
namespace {

/// Wendland's function (1 - r)^4 (4 r + 1): 1 at 0, 0 from 1 on, twice differentiable.
double weight(double r) {
    if (r >= 1) return 0;
    const double s = (1 - r) * (1 - r);
    return s * s * (4 * r + 1);
}

double coordinate(const Point3& p, int axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

Point3 least(const Point3& a, const Point3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Point3 greatest(const Point3& a, const Point3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

} // namespace

RbfPatches::RbfPatches(std::span<const Point3> points, std::span<const double> values) {
    if (points.empty()) return;
    Values data{points, values, std::vector<std::uint32_t>(points.size())};
    std::iota(data.order.begin(), data.order.end(), 0U);
    build(data, 0, static_cast<std::uint32_t>(points.size()));
    for (Patch& patch : patches_) fit(data, patch);
    bound_balls();
}

std::uint32_t RbfPatches::build(Values& data, std::uint32_t first, std::uint32_t last) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    Node node;
    node.first = first;
    node.last = last;
    node.low = node.high = data.points[data.order[first]];
    for (std::uint32_t i = first; i < last; ++i) {
        node.low = least(node.low, data.points[data.order[i]]);
        node.high = greatest(node.high, data.points[data.order[i]]);
    }
    nodes_.push_back(node);
    const Point3 extent = minus(node.high, node.low);
    if (last - first <= constants.most_in_cell) {
        Patch patch;
        patch.centre = {node.low.x + extent.x / 2, node.low.y + extent.y / 2,
                        node.low.z + extent.z / 2};
        patch.radius = constants.ball_ratio * length(extent) / 2;
        nodes_[index].patch = static_cast<std::uint32_t>(patches_.size());
        patches_.push_back(std::move(patch));
        return index;
    }
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const std::uint32_t middle = first + (last - first) / 2;
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const double x = coordinate(data.points[a], axis), y = coordinate(data.points[b], axis);
        return x < y || (x == y && a < b); // a total order makes the result independent of the sort
    };
    std::sort(data.order.begin() + first, data.order.begin() + last, before);
    const std::uint32_t left = build(data, first, middle), right = build(data, middle, last);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
}

std::vector<std::uint32_t> RbfPatches::points_in(const Values& data, const Point3& centre,
                                                 double radius) const {
    std::vector<std::uint32_t> found, open{0};
    while (!open.empty()) {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        if (distance_to_box(centre, node.low, node.high) > radius) continue;
        if (node.left != 0) {
            open.push_back(node.left);
            open.push_back(node.right);
            continue;
        }
        for (std::uint32_t i = node.first; i < node.last; ++i)
            if (length(minus(data.points[data.order[i]], centre)) <= radius)
                found.push_back(data.order[i]);
    }
    return found;
}

void RbfPatches::fit(const Values& data, Patch& patch) const {
    const auto inside = points_in(data, patch.centre, patch.radius);
    const auto n = static_cast<Eigen::Index>(inside.size());
    for (const std::uint32_t i : inside) patch.points.push_back(data.points[i]);
    if (n < 2) {
        patch.weights.assign(inside.size(), 0);
        if (n == 1) patch.constant = data.values[inside[0]];
        if (!(patch.radius > 0))
            patch.radius = 1e-300; // a single point: its value there and
                                   // nowhere else
        return;
    }
    Eigen::MatrixXd system = Eigen::MatrixXd::Ones(n + 1, n + 1);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
    system(n, n) = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        right[i] = data.values[inside[k]];
        for (Eigen::Index j = 0; j < n; ++j)
            system(i, j) =
                length(minus(patch.points[k], patch.points[static_cast<std::size_t>(j)])) /
                patch.radius;
    }
    const Eigen::VectorXd solved = system.partialPivLu().solve(right);
    patch.constant = solved[n];
    for (Eigen::Index i = 0; i < n; ++i) patch.weights.push_back(solved[i] / patch.radius);
}

/// Computes the bounding boxes of balls bottom-up; children come after their parents.
void RbfPatches::bound_balls() {
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.left != 0) {
            node.ball_low = least(nodes_[node.left].ball_low, nodes_[node.right].ball_low);
            node.ball_high = greatest(nodes_[node.left].ball_high, nodes_[node.right].ball_high);
            continue;
        }
        const Patch& patch = patches_[node.patch];
        const Point3& c = patch.centre;
        const double r = patch.radius;
        node.ball_low = {c.x - r, c.y - r, c.z - r};
        node.ball_high = {c.x + r, c.y + r, c.z + r};
    }
}

double RbfPatches::operator()(const Point3& p) const {
    if (nodes_.empty()) return 0;
    double sum = 0, weights = 0;
    std::array<std::uint32_t, 128> open{}; // deeper than any tree of bisections
    std::size_t count = 1;
    while (count > 0) {
        const Node& node = nodes_[open[--count]];
        if (distance_to_box(p, node.ball_low, node.ball_high) > 0) continue;
        if (node.left != 0) {
            open[count++] = node.right;
            open[count++] = node.left;
            continue;
        }
        const Patch& patch = patches_[node.patch];
        const double w = weight(length(minus(p, patch.centre)) / patch.radius);
        if (!(w > 0)) continue;
        double value = patch.constant;
        for (std::size_t i = 0; i < patch.points.size(); ++i) {
            const Point3 d = minus(p, patch.points[i]);
            value += patch.weights[i] * std::sqrt(dot(d, d));
        }
        sum += w * value;
        weights += w;
    }
    return sum / std::max(weights, weight(1 / constants.ball_ratio));
}

} // namespace terrane::rbf::detail
