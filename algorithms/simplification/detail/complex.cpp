// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/complex.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::simplification::detail {
namespace {

bool have_same_corners(const Triangle& a, const Triangle& b) {
    return contains(a, b[0]) && contains(a, b[1]) && contains(a, b[2]);
}

/// Tells whether b runs the other way round the same corners than a.
bool runs_other_way(const Triangle& a, const Triangle& b) {
    for (std::size_t i = 0; i < 3; ++i)
        if (a[i] == b[0]) return a[(i + 1) % 3] != b[1];
    return false;
}

Point3 plus(const Point3& p, double share, const Point3& q) {
    return {p.x + share * q.x, p.y + share * q.y, p.z + share * q.z};
}

} // namespace

double Past::reach(const Point3& place) const {
    const auto farther = [](double x, double from, double to) {
        return std::max(std::fabs(x - from), std::fabs(x - to));
    };
    return slack + length({farther(place.x, low.x, high.x), farther(place.y, low.y, high.y),
                           farther(place.z, low.z, high.z)});
}

void Past::unite(const Past& other) {
    low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y),
           std::min(low.z, other.low.z)};
    high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y),
            std::max(high.z, other.high.z)};
    slack = std::max(slack, other.slack);
}

void Past::add(double share, const Past& other) {
    low = plus(low, share, other.low);
    high = plus(high, share, other.high);
    slack += share * other.slack;
}

Complex::Complex(std::vector<Point3> points, std::vector<Past> past, const std::vector<Cell>& cells,
                 std::span<const SurfaceInfo> surfaces) :
    points_(std::move(points)),
    past_(std::move(past)), freedom_(points_.size()), star_(points_.size()) {
    for (const Cell& cell : cells)
        if (!cell.layers.empty()) add_cell(cell.corners, cell.layers);
    find_freedom(surfaces);
}

void Complex::find_freedom(std::span<const SurfaceInfo> surfaces) {
    for (const Cell& cell : cells_) {
        if (std::none_of(cell.layers.begin(), cell.layers.end(), [&](const CellLayer& l) {
                return surfaces[l.surface].role == Role::boundary;
            }))
            continue;
        const Triangle& c = cell.corners;
        unsigned planes = 0;
        for (unsigned axis = 0; axis < 3; ++axis)
            if (coordinate(points_[c[0]], axis) == coordinate(points_[c[1]], axis) &&
                coordinate(points_[c[0]], axis) == coordinate(points_[c[2]], axis))
                planes |= 1U << axis;
        for (const std::uint32_t v : c) {
            freedom_[v].fixed_axes |= planes;
            freedom_[v].is_pinned = freedom_[v].is_pinned || planes == 0;
        }
    }
}

std::vector<std::uint32_t> Complex::star(std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> cells;
    for (const std::uint32_t t : star_[a])
        if (contains(cells_[t].corners, b)) cells.push_back(t);
    std::sort(cells.begin(), cells.end());
    return cells;
}

void Complex::unite(Cell& cell, const Triangle& corners, const std::vector<CellLayer>& layers) {
    const bool is_turned = runs_other_way(cell.corners, corners);
    for (CellLayer layer : layers) {
        layer.is_turned = layer.is_turned != is_turned;
        const auto at = std::lower_bound(
            cell.layers.begin(), cell.layers.end(), layer.surface,
            [](const CellLayer& l, std::uint32_t surface) { return l.surface < surface; });
        if (at != cell.layers.end() && at->surface == layer.surface)
            at->is_folded = at->is_folded == layer.is_folded; // even + even, odd + odd: even
        else
            cell.layers.insert(at, layer);
    }
}

void Complex::add_cell(const Triangle& corners, const std::vector<CellLayer>& layers) {
    for (const std::uint32_t t : star_[corners[0]])
        if (have_same_corners(cells_[t].corners, corners)) return unite(cells_[t], corners, layers);
    const auto number = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back({corners, layers});
    for (const std::uint32_t v : corners) star_[v].push_back(number);
}

void Complex::remove_cell(std::uint32_t cell) {
    for (const std::uint32_t v : cells_[cell].corners) std::erase(star_[v], cell);
    cells_[cell].layers.clear();
}

void Complex::remove_layer(std::uint32_t cell, std::uint32_t surface) {
    auto& layers = cells_[cell].layers;
    if (layers.size() == 1 && layers.front().surface == surface) return remove_cell(cell);
    std::erase_if(layers, [&](const CellLayer& l) { return l.surface == surface; });
}

PlacedVertex Complex::between(std::span<const std::uint32_t> corners,
                              std::span<const double> weights) const {
    PlacedVertex v{{}, {}, {7, true}};
    const Point3& first = points_[corners[0]];
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point3& q = points_[corners[i]];
        const double w = weights[i];
        v.place = plus(v.place, w, q);
        v.past.add(w, past_[corners[i]]);
        const Freedom& other = freedom_[corners[i]];
        v.freedom.is_pinned = v.freedom.is_pinned && other.is_pinned;
        for (unsigned axis = 0; axis < 3; ++axis)
            if (!other.is_fixed(axis) || coordinate(q, axis) != coordinate(first, axis))
                v.freedom.fixed_axes &= ~(1U << axis);
    }
    if (corners.size() == 1) {
        v.place = first;
        v.past = past_[corners[0]];
    }
    if (v.freedom.is_fixed(0)) v.place.x = first.x;
    if (v.freedom.is_fixed(1)) v.place.y = first.y;
    if (v.freedom.is_fixed(2)) v.place.z = first.z;
    return v;
}

std::uint32_t Complex::add_vertex(std::span<const std::uint32_t> corners,
                                  std::span<const double> weights) {
    const PlacedVertex v = between(corners, weights);
    points_.push_back(v.place);
    past_.push_back(v.past);
    freedom_.push_back(v.freedom);
    star_.emplace_back();
    return static_cast<std::uint32_t>(points_.size() - 1);
}

std::uint32_t Complex::split_edge(std::uint32_t a, std::uint32_t b, double at) {
    const auto cells = star(a, b);
    const std::uint32_t m = add_vertex(std::array{a, b}, std::array{1 - at, at});
    for (const std::uint32_t t : cells) {
        const Cell cell = cells_[t];
        remove_cell(t);
        for (const std::uint32_t old : {a, b}) {
            Triangle half = cell.corners;
            std::replace(half.begin(), half.end(), old, m);
            add_cell(half, cell.layers);
        }
    }
    return m;
}

std::uint32_t Complex::split_cell(std::uint32_t cell, const std::array<double, 3>& weights) {
    const Cell old = cells_[cell];
    const std::uint32_t m = add_vertex(old.corners, weights);
    remove_cell(cell);
    for (const std::uint32_t corner : old.corners) {
        Triangle part = old.corners;
        std::replace(part.begin(), part.end(), corner, m);
        add_cell(part, old.layers);
    }
    return m;
}

void Complex::merge(std::uint32_t v, std::uint32_t w, const Point3& place) {
    auto cells = star_[v];
    std::sort(cells.begin(), cells.end());
    for (const std::uint32_t t : cells) {
        const Cell cell = cells_[t];
        remove_cell(t);
        if (contains(cell.corners, w)) continue;
        Triangle corners = cell.corners;
        std::replace(corners.begin(), corners.end(), v, w);
        add_cell(corners, cell.layers);
    }
    freedom_[w].fixed_axes |= freedom_[v].fixed_axes;
    freedom_[w].is_pinned = freedom_[w].is_pinned || freedom_[v].is_pinned;
    past_[w].unite(past_[v]);
    points_[w] = place;
}

} // namespace terrane::simplification::detail
