// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/detail/fault_plane.hpp>

#include <cmath>

#include <Eigen/Eigenvalues>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/uncertainty/random_stream.hpp>

namespace terrane::uncertainty::detail {

FaultPlane::FaultPlane(std::span<const Surface> all, std::span<const std::uint32_t> surfaces) {
    constexpr double level = 1e-9; // a normal that rises less is level
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double area = 0;
    for (const std::uint32_t s : surfaces)
        for (const Triangle& t : all[s].triangles) {
            const Point3 &a = all[s].vertices[t[0]], &b = all[s].vertices[t[1]],
                         &c = all[s].vertices[t[2]];
            const Point3 n = cross(minus(b, a), minus(c, a));
            const double size = length(n);
            if (!(size > 0)) continue;
            const Eigen::Vector3d unit(n.x / size, n.y / size, n.z / size);
            squares += size * unit * unit.transpose();
            sum += size * Eigen::Vector3d((a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3,
                                          (a.z + b.z + c.z) / 3);
            area += size;
        }
    if (!(area > 0)) return;
    centre = {sum(0) / area, sum(1) / area, sum(2) / area};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares);
    Eigen::Vector3d n = solver.eigenvectors().col(2);
    const bool is_level = std::fabs(n(2)) < level;
    const double sense = !is_level ? n(2) : std::fabs(n(0)) >= level ? n(0) : n(1);
    if (sense < 0) n = -n;
    normal = {n(0), n(1), n(2)};
    const double across = length_in_plane(n(0), n(1));
    if (across > level) strike = {-n(1) / across, n(0) / across, 0};
}

Point3 FaultPlane::turned(const Point3& p, double turns) const {
    if (turns == 0) return {};
    const double cosine = cos_of_turns(turns), sine = cos_of_turns(turns - 0.25);
    const Point3 across = cross(strike, p);
    const double along = dot(strike, p);
    const auto by = [&](double coordinate, double axis, double moved) {
        return (cosine - 1) * (coordinate - along * axis) + sine * moved;
    };
    return {by(p.x, strike.x, across.x), by(p.y, strike.y, across.y), by(p.z, strike.z, across.z)};
}

} // namespace terrane::uncertainty::detail
