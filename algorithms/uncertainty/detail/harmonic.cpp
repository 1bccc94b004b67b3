// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/detail/harmonic.hpp>

#include <algorithm>

#include <terrane/kernel/assertion.hpp>

namespace terrane::uncertainty::detail {
namespace {

using NodeEdges = std::span<const std::array<std::uint32_t, 2>>;

/// Returns per node whether a path leads from it to a known one.
std::vector<bool> reached_from(const std::vector<bool>& known, NodeEdges edges) {
    std::vector<std::vector<std::uint32_t>> neighbours(known.size());
    for (const auto& [a, b] : edges) {
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    }
    std::vector<bool> reached = known;
    std::vector<std::uint32_t> open;
    for (std::uint32_t v = 0; v < known.size(); ++v)
        if (known[v]) open.push_back(v);
    while (!open.empty()) {
        const std::uint32_t v = open.back();
        open.pop_back();
        for (const std::uint32_t next : neighbours[v]) {
            if (reached[next]) continue;
            reached[next] = true;
            open.push_back(next);
        }
    }
    return reached;
}

} // namespace

Harmonic::Harmonic(std::vector<bool> known, NodeEdges edges) {
    const auto reached = reached_from(known, edges);
    std::vector<std::int32_t> number(known.size(), -1);
    for (std::uint32_t v = 0; v < known.size(); ++v) {
        if (known[v] || !reached[v]) continue;
        number[v] = static_cast<std::int32_t>(free_.size());
        free_.push_back(v);
    }
    std::vector<Eigen::Triplet<double>> inner, outer;
    const auto add = [&](std::uint32_t v, std::uint32_t other) {
        if (number[v] < 0) return;
        inner.emplace_back(number[v], number[v], 1);
        if (number[other] >= 0)
            inner.emplace_back(number[v], number[other], -1);
        else
            outer.emplace_back(number[v], static_cast<int>(other), 1);
    };
    for (const auto& [a, b] : edges) {
        add(a, b);
        add(b, a);
    }
    const auto n = static_cast<Eigen::Index>(free_.size());
    Matrix laplacian(n, n);
    laplacian.setFromTriplets(inner.begin(), inner.end());
    to_known_.resize(n, static_cast<Eigen::Index>(known.size()));
    to_known_.setFromTriplets(outer.begin(), outer.end());
    factor_ = std::make_shared<Eigen::SimplicialLDLT<Matrix>>(laplacian);
    // It is irreducibly diagonally dominant: each free node is joined to a known one.
    TERRANE_ASSERT(n == 0 || factor_->info() == Eigen::Success);
}

void Harmonic::extend(std::vector<Point3>& values) const {
    const bool is_still =
        std::all_of(values.begin(), values.end(), [](const Point3& p) { return p == Point3{}; });
    if (free_.empty() || is_still) return;
    Eigen::MatrixXd given(static_cast<Eigen::Index>(values.size()), 3);
    for (std::size_t v = 0; v < values.size(); ++v)
        given.row(static_cast<Eigen::Index>(v)) << values[v].x, values[v].y, values[v].z;
    const Eigen::MatrixXd sums = to_known_ * given;
    const Eigen::MatrixXd found = factor_->solve(sums);
    for (std::size_t i = 0; i < free_.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        values[free_[i]] = {found(row, 0), found(row, 1), found(row, 2)};
    }
}

} // namespace terrane::uncertainty::detail
