// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/detail/map_values.hpp>

#include <cmath>

namespace terrane::uncertainty::detail {
namespace {

std::vector<Point3> flattened(std::vector<Point3> points) {
    for (Point3& p : points) p.z = 0;
    return points;
}

} // namespace

MapValues::MapValues(const Surface& map) :
    map_(map), flat_(flattened(map.vertices)), tree_(flat_, map.triangles) {}

double MapValues::at(double x, double y) const {
    const auto near = tree_.nearest({x, y, 0}, HUGE_VAL);
    if (!near) return 0;
    const auto& [i, j, k] = near->triangle;
    const Point3 &a = flat_[i], &b = flat_[j], &c = flat_[k], &p = near->place;
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) return map_.vertices[i].z;
    const double to_b = ((p.x - a.x) * (c.y - a.y) - (c.x - a.x) * (p.y - a.y)) / area;
    const double to_c = ((b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y)) / area;
    return (1 - to_b - to_c) * map_.vertices[i].z + to_b * map_.vertices[j].z +
           to_c * map_.vertices[k].z;
}

} // namespace terrane::uncertainty::detail
