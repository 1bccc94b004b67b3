// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/snapped_input.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>

namespace terrane::rounding::detail {

SnapGrid grid_of_digits(std::span<const Point3> points, int digits) {
    std::array<double, 3> largest{};
    for (const Point3& p : points) {
        largest[0] = std::max(largest[0], std::fabs(p.x));
        largest[1] = std::max(largest[1], std::fabs(p.y));
        largest[2] = std::max(largest[2], std::fabs(p.z));
    }
    SnapGrid grid;
    for (unsigned k = 0; k < 3; ++k)
        if (largest[k] > 0) {
            const int ulp = std::ilogb(largest[k]) - 52;
            grid.step[k] = std::ldexp(1.0, std::max(ulp + digits, -1074));
        }
    return grid;
}

SnappedInput::SnappedInput(const Arrangement& a) :
    arrangement_(a), chosen_(a.state->points.input_count(), false) {}

bool SnappedInput::choose(const RoundedMesh& rounded) {
    bool any = false;
    for (const ImproperContact& c : rounded.report.contacts)
        for (const std::uint32_t t : c.triangles)
            for (const std::uint32_t parent : rounded.mesh->parents_of[t])
                for (const std::uint32_t v : arrangement_.state->corners[parent]) {
                    any = any || !chosen_[v];
                    chosen_[v] = true;
                }
    return any;
}

std::vector<Surface> SnappedInput::surfaces(int digits) {
    const auto inputs = arrangement_.state->points.inputs();
    const SnapGrid grid = grid_of_digits(inputs, digits);
    std::unordered_set<Point3, PointHash> cells;
    for (std::size_t v = 0; v < inputs.size(); ++v)
        if (chosen_[v]) cells.insert(grid.snap(inputs[v]));
    std::vector<Surface> out;
    moved_ = 0;
    largest_ = 0;
    const InputTriangles& in = arrangement_.inputs;
    for (std::size_t s = 0; s + 1 < in.first.size(); ++s) {
        Surface& surface = out.emplace_back();
        for (std::uint32_t v = in.first_vertex[s]; v < in.first_vertex[s + 1]; ++v)
            surface.vertices.push_back(snapped(inputs[v], grid, cells));
    }
    std::unordered_set<Point3, PointHash> before, after;
    before.insert(inputs.begin(), inputs.end());
    for (const Surface& surface : out)
        after.insert(surface.vertices.begin(), surface.vertices.end());
    merged_ = before.size() - after.size();
    // Corners are numbered through all surfaces and may name a vertex of an earlier surface with
    // the same coordinates. Each triangle gets corners in its own surface.
    for (std::size_t s = 0; s + 1 < in.first.size(); ++s)
        for (std::uint32_t t = in.first[s]; t < in.first[s + 1]; ++t)
            out[s].triangles.push_back(own_corners(s, corners_of(t), out));
    return out;
}

Point3 SnappedInput::snapped(const Point3& p, const SnapGrid& grid,
                             const std::unordered_set<Point3, PointHash>& cells) {
    const Point3 cell = grid.snap(p);
    if (cell == p || !cells.contains(cell)) return p;
    ++moved_;
    largest_ = std::max(largest_, distance_bound({{p.x, p.y, p.z}, {p.x, p.y, p.z}}, cell));
    return cell;
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
