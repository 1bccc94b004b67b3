// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/fans.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace terrane::verifier {

namespace {

/// Returns per triangle the corner, other than `but`, that most of these triangles have, or no_number if these are not
/// more than the root of their number. So there are few such corners.
Numbers common_corners(const ExactMesh& mesh, const Numbers& triangles, std::uint32_t but) {
    constexpr std::size_t least = 17; // fewer are tested by pairs
    std::map<std::uint32_t, std::size_t> count;
    for (const std::uint32_t t : triangles)
        for (const std::uint32_t v : mesh.triangles[t]) ++count[v];
    count[but] = 0;
    Numbers common;
    for (const std::uint32_t t : triangles) {
        const std::uint32_t most = std::ranges::max(
            mesh.triangles[t], {}, [&](std::uint32_t v) { return std::pair(count[v], v); });
        const std::size_t n = count[most];
        common.push_back(n >= least && n * n > triangles.size() ? most : no_number);
    }
    return common;
}

Numbers triangles_with_area(const ExactMesh& mesh) {
    Numbers result;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (projection_axis(mesh.planes[t])) result.push_back(t);
    return result;
}

/// Returns where the ray from one point through another leaves the cube of half side 1 around the first.
Box direction(const Vector4& from, const Vector4& to) {
    Vector4 way{0, 0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        way[i] = to[i] * from[3] - from[i] * to[3];
        way[3] = std::max(way[3], mpz_class(abs(way[i])));
    }
    return enclose(way, 1);
}

} // namespace

Fan::Fan(const ExactMesh& mesh, std::uint32_t hub, Numbers triangles) :
    mesh_(mesh), hub_(hub), triangles_(std::move(triangles)),
    ends_(common_corners(mesh, triangles_, hub)) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        boxes.push_back(directions(triangles_[i]));
        if (ends_[i] != no_number)
            half_planes_[half_plane(triangles_[i], ends_[i])].push_back(triangles_[i]);
    }
    Numbers positions(triangles_.size());
    std::iota(positions.begin(), positions.end(), 0U);
    tree_ = BoxTree(std::move(boxes), std::move(positions), ends_);
}

/// Encloses the points of the cube around the hub in the directions of a triangle. The directions of its corners, a
/// and b, are such points. Any other one, p, is c / |c| with a point c of the segment from a to b and the largest
/// coordinate |c|. So p - c is not longer than 1 - |c|, which is at most half of |a - b|.
Box Fan::directions(std::uint32_t triangle) const {
    const Triangle& t = mesh_.triangles[triangle];
    const std::size_t at = static_cast<std::size_t>(std::ranges::find(t, hub_) - t.begin());
    Box box = direction(mesh_.points[hub_], mesh_.points[t[(at + 1) % 3]]);
    extend(box, direction(mesh_.points[hub_], mesh_.points[t[(at + 2) % 3]]));
    double wide = 0;
    for (std::size_t i = 0; i < 3; ++i)
        wide = std::max(wide, std::nextafter(box.high[i] - box.low[i], infinity));
    for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = std::nextafter(box.low[i] - wide / 2, -infinity);
        box.high[i] = std::nextafter(box.high[i] + wide / 2, infinity);
    }
    return box;
}

/// The normals of the planes are turned as if all triangles passed the side from the hub to its end.
Fan::HalfPlane Fan::half_plane(std::uint32_t triangle, std::uint32_t end) const {
    const Triangle& t = mesh_.triangles[triangle];
    const std::size_t at = static_cast<std::size_t>(std::ranges::find(t, hub_) - t.begin());
    Vector4 plane = mesh_.planes[triangle];
    if (t[(at + 1) % 3] != end)
        for (mpz_class& coordinate : plane) coordinate = -coordinate;
    return {end, std::move(plane)};
}

void Fan::add_near(std::uint32_t triangle, Numbers& found) const {
    const auto at = static_cast<std::uint32_t>(std::ranges::lower_bound(triangles_, triangle) -
                                               triangles_.begin());
    for (const std::uint32_t i : tree_.touching_others(at)) found.push_back(triangles_[i]);
    if (ends_[at] == no_number) return;
    const Numbers& others = half_planes_.at(half_plane(triangle, ends_[at]));
    found.insert(found.end(), others.begin(), others.end());
}

ContactSearch::ContactSearch(const ExactMesh& mesh) :
    mesh_(mesh), with_area_(triangles_with_area(mesh)) {
    const Numbers common = common_corners(mesh, with_area_, no_number);
    hubs_.assign(mesh.triangles.size(), no_number);
    std::map<std::uint32_t, Numbers> around;
    for (std::size_t i = 0; i < with_area_.size(); ++i) {
        hubs_[with_area_[i]] = common[i];
        if (common[i] != no_number) around[common[i]];
    }
    for (const std::uint32_t t : with_area_)
        for (const std::uint32_t v : mesh.triangles[t])
            if (const auto hub = around.find(v); hub != around.end()) hub->second.push_back(t);
    for (auto& [hub, triangles] : around) fans_.try_emplace(hub, mesh, hub, std::move(triangles));
    tree_ = BoxTree(boxes_of_triangles(mesh), with_area_, hubs_);
}

Numbers ContactSearch::near(std::uint32_t triangle) const {
    Numbers found = tree_.touching_others(triangle);
    for (const std::uint32_t v : mesh_.triangles[triangle])
        if (const auto fan = fans_.find(v); fan != fans_.end())
            fan->second.add_near(triangle, found);
    make_set(found);
    return found;
}

} // namespace terrane::verifier
