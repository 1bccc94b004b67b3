// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/rays.hpp>

namespace terrane::verifier {

Rays::Rays(const ExactMesh& mesh, const Numbers& triangles, std::size_t axis) :
    mesh_(mesh), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3) {
    if (!triangles.empty()) tree_ = BoxTree(boxes_of_triangles(mesh), triangles);
}

/// Tells on which side of a projected edge a moved point is; 0 if the edge is a point.
int Rays::side_of(const Vector4& a, const Vector4& b, const Vector4& point) const {
    if (const int side = sgn(turn(a, b, point, axis_)); side != 0) return side;
    if (const int v = sgn(mpz_class(b[v_] * a[3] - a[v_] * b[3])); v != 0) return -v;
    return sgn(mpz_class(b[u_] * a[3] - a[u_] * b[3]));
}

std::vector<Passed> Rays::cast(const Vector4& point) const {
    Box box = enclose(point, mesh_.scale);
    box.high[axis_] = infinity;
    std::vector<Passed> passed;
    for (const std::uint32_t t : tree_.touching(box)) {
        const auto& [i, j, k] = mesh_.triangles[t];
        const Vector4 &a = mesh_.points[i], &b = mesh_.points[j], &c = mesh_.points[k];
        const int side = side_of(a, b, point);
        if (side == 0 || side_of(b, c, point) != side || side_of(c, a, point) != side) continue;
        // The normal of the plane has this sign along the axis.
        if (sgn(dot(mesh_.planes[t], point)) * side < 0) passed.push_back({t, side});
    }
    return passed;
}

} // namespace terrane::verifier
