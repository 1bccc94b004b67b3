// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/snapped_input.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>

namespace terrane::rounding::detail {
namespace {

/// Returns the number of different points.
std::size_t distinct(std::span<const Point3> points) {
    PointTable table(points.size());
    std::size_t count = 0;
    for (std::uint32_t p = 0; p < points.size(); ++p) count += table.enter(points, p) == p;
    return count;
}

} // namespace

double SnapGrid::reach() const {
    return length_bound(step[0], step[1], step[2]) / 2;
}

// Division and multiplication by a power of two are exact, so a node is its own nearest node.
double SnapGrid::snap(double x, unsigned axis) const {
    const double s = step[axis];
    if (!(s > 0)) return x;
    const auto& planes = kept[axis];
    const auto not_below = std::lower_bound(planes.begin(), planes.end(), x);
    if (not_below != planes.end() && *not_below == x) return x;
    double node = std::nearbyint(x / s) * s;
    if (not_below != planes.end()) node = std::min(node, *not_below);
    if (not_below != planes.begin()) node = std::max(node, not_below[-1]);
    return node;
}

std::optional<SnapGrid> grid_of_digits(std::span<const Point3> points, int digits, double limit,
                                       const KeptPlanes& kept,
                                       const std::array<double, 3>& elsewhere) {
    std::array<double, 3> largest = elsewhere;
    for (const Point3& p : points) {
        largest[0] = std::max(largest[0], std::fabs(p.x));
        largest[1] = std::max(largest[1], std::fabs(p.y));
        largest[2] = std::max(largest[2], std::fabs(p.z));
    }
    for (; digits > 0; --digits) {
        SnapGrid grid;
        for (unsigned k = 0; k < 3; ++k) {
            grid.kept[k] = kept[k];
            if (!(largest[k] > 0)) continue;
            const int ulp = std::ilogb(largest[k]) - 52;
            grid.step[k] = std::ldexp(1.0, std::max(ulp + digits, -1074));
        }
        if (grid.reach() <= limit) return grid;
    }
    return std::nullopt;
}

SnapCells::SnapCells(const SnapGrid& grid, std::span<const Point3> chosen) : grid_(grid) {
    for (const Point3& p : chosen) nodes_.insert(grid_.snap(p));
}

Point3 SnapCells::moved(const Point3& p) const {
    const Point3 node = grid_.snap(p);
    return node != p && nodes_.contains(node) ? node : p;
}

double move_bound(const Point3& from, const Point3& to) {
    return distance_bound({{from.x, from.y, from.z}, {from.x, from.y, from.z}}, to);
}

SnappedInput::SnappedInput(const Arrangement& a) :
    arrangement_(a), chosen_(a.state->points.input_count(), false) {}

bool SnappedInput::choose(std::span<const std::uint32_t> triangles) {
    bool any = false;
    for (const std::uint32_t t : triangles)
        for (const std::uint32_t v : arrangement_.state->corners[t]) {
            any = any || !chosen_[v];
            chosen_[v] = true;
        }
    return any;
}

std::vector<Surface> SnappedInput::surfaces(const SnapGrid& grid) {
    const auto inputs = arrangement_.state->points.inputs();
    const SnapCells cells(grid, chosen_of(inputs, chosen_));
    how_ = {};
    std::vector<Point3> places(inputs.begin(), inputs.end());
    for (Point3& p : places) {
        const Point3 node = cells.moved(p);
        if (node == p) continue;
        ++how_.moved;
        const double d = move_bound(p, node);
        how_.largest = std::max(how_.largest, d);
        double& most = how_.moves[node];
        most = std::max(most, d);
        p = node;
    }
    return surfaces_at(places);
}

/// Statement (4) of docs/explanation/rounding.md has the factor of two: one error of the way into
/// the frame, and one of the way back.
std::vector<Surface> SnappedInput::surfaces(const InputFrame& frame) {
    const auto inputs = arrangement_.state->points.inputs();
    how_ = {};
    how_.largest = 2 * frame.largest_error();
    how_.frame = &frame;
    std::vector<Point3> places(inputs.begin(), inputs.end());
    for (Point3& p : places) {
        const Point3 there = frame.into(p), given = frame.back(there);
        if (given != p) {
            ++how_.moved;
            double& most = how_.moves[there];
            most = std::max(most, move_bound(p, given));
        }
        p = there;
    }
    return surfaces_at(places);
}

std::vector<Surface> SnappedInput::surfaces_at(std::span<const Point3> places) {
    std::vector<Surface> out;
    const InputTriangles& in = arrangement_.inputs;
    for (std::size_t s = 0; s + 1 < in.first.size(); ++s) {
        Surface& surface = out.emplace_back();
        surface.vertices.assign(places.begin() + in.first_vertex[s],
                                places.begin() + in.first_vertex[s + 1]);
    }
    const auto inputs = arrangement_.state->points.inputs();
    how_.merged = distinct(inputs) - distinct(places);
    // Corners are numbered through all surfaces and may name a vertex of an earlier surface with
    // the same coordinates. Each triangle gets corners in its own surface.
    for (std::size_t s = 0; s + 1 < in.first.size(); ++s)
        for (std::uint32_t t = in.first[s]; t < in.first[s + 1]; ++t)
            out[s].triangles.push_back(own_corners(s, corners_of(t), out));
    return out;
}

/// Returns the corners of an input triangle. For a degenerate one it returns the first corner three
/// times, so that the grid cannot give it an area.
Triangle SnappedInput::corners_of(std::uint32_t t) const {
    const Triangle& c = arrangement_.state->corners[t];
    const auto& degenerate = arrangement_.degenerate;
    if (!std::binary_search(degenerate.begin(), degenerate.end(), t)) return c;
    return {c[0], c[0], c[0]};
}

/// Returns the corners as indices into surface s, which gets copies of vertices of other surfaces.
Triangle SnappedInput::own_corners(std::size_t s, Triangle corners,
                                   std::vector<Surface>& surfaces) const {
    const auto& first = arrangement_.inputs.first_vertex;
    for (std::uint32_t& v : corners) {
        if (v >= first[s] && v < first[s + 1]) {
            v -= first[s];
            continue;
        }
        const auto owner = static_cast<std::size_t>(
            std::upper_bound(first.begin(), first.end(), v) - first.begin() - 1);
        surfaces[s].vertices.push_back(surfaces[owner].vertices[v - first[owner]]);
        v = static_cast<std::uint32_t>(surfaces[s].vertices.size() - 1);
    }
    return corners;
}

} // namespace terrane::rounding::detail
