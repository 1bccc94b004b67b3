// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Defines each predicate's polynomial once, as a template over the number type. A point is
// (x, y, z) / w with w > 0. The polynomials are the textbook determinants on coordinate
// differences, so that filters lose little precision far from the origin. Positive factors of w are
// dropped, because only the sign matters.
#pragma once

#include <terrane/kernel/point.hpp>

namespace terrane::polynomial {

/// The weight of a Cartesian point; multiplying by it costs nothing.
struct One {
    friend One operator*(One, One) { return {}; }
    template <class N>
    friend const N& operator*(const N& n, One) {
        return n;
    }
    template <class N>
    friend const N& operator*(One, const N& n) {
        return n;
    }
};

/// Homogeneous coordinates. N is the number type, W the type of the weight (N or One).
template <class N, class W>
struct Coordinates {
    N x, y, z;
    W w;
};

template <class N>
Coordinates<N, One> cartesian(const Point3& p) {
    return {N(p.x), N(p.y), N(p.z), One{}};
}

template <class N>
struct Vector {
    N x, y, z;
};

template <class N>
struct Vector2 {
    N u, v;
};

/// Returns a - b, times the weights of a and b.
template <class N, class V, class W>
Vector<N> difference(const Coordinates<N, V>& a, const Coordinates<N, W>& b) {
    return {a.x * b.w - b.x * a.w, a.y * b.w - b.y * a.w, a.z * b.w - b.z * a.w};
}

/// Returns a - b in the projection that drops `axis`, times the weights of a and b.
template <class N, class V, class W>
Vector2<N> difference(Axis axis, const Coordinates<N, V>& a, const Coordinates<N, W>& b) {
    switch (axis) {
    case Axis::x:
        return {a.y * b.w - b.y * a.w, a.z * b.w - b.z * a.w};
    case Axis::y:
        return {a.z * b.w - b.z * a.w, a.x * b.w - b.x * a.w};
    default:
        return {a.x * b.w - b.x * a.w, a.y * b.w - b.y * a.w};
    }
}

template <class N>
Vector<N> cross(const Vector<N>& a, const Vector<N>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class N>
N dot(const Vector<N>& a, const Vector<N>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class N>
N cross(const Vector2<N>& a, const Vector2<N>& b) {
    return a.u * b.v - a.v * b.u;
}

/// Positive iff direction c d lies to the left of direction a b in the projection.
template <class N, class W>
N turn2d(Axis axis, const Coordinates<N, W>& a, const Coordinates<N, W>& b,
         const Coordinates<N, W>& c, const Coordinates<N, W>& d) {
    return cross(difference(axis, b, a), difference(axis, d, c));
}

/// Positive iff a, b, c turn left in the projection.
template <class N, class A, class B, class C>
N orient2d(Axis axis, const Coordinates<N, A>& a, const Coordinates<N, B>& b,
           const Coordinates<N, C>& c) {
    return cross(difference(axis, b, a), difference(axis, c, a));
}

/// Positive iff d lies on the side of the plane a, b, c from which they appear counterclockwise.
template <class N, class A, class B, class C, class D>
N orient3d(const Coordinates<N, A>& a, const Coordinates<N, B>& b, const Coordinates<N, C>& c,
           const Coordinates<N, D>& d) {
    return dot(cross(difference(b, a), difference(c, a)), difference(d, a));
}

/// Positive iff d lies inside the circle through a, b, c (counterclockwise) in the projection.
template <class N, class W>
N in_circle(Axis axis, const Coordinates<N, W>& a, const Coordinates<N, W>& b,
            const Coordinates<N, W>& c, const Coordinates<N, W>& d) {
    const auto ad = difference(axis, a, d);
    const auto bd = difference(axis, b, d);
    const auto cd = difference(axis, c, d);
    const auto wa = a.w * d.w;
    const auto wb = b.w * d.w;
    const auto wc = c.w * d.w;
    const N la = ad.u * ad.u + ad.v * ad.v;
    const N lb = bd.u * bd.u + bd.v * bd.v;
    const N lc = cd.u * cd.u + cd.v * cd.v;
    // rows (u w, v w, l): each row of the usual determinant times the square of its weight
    return la * (cross(bd, cd) * wb * wc) + lb * (cross(cd, ad) * wc * wa) +
           lc * (cross(ad, bd) * wa * wb);
}

/// The point (x, y, z) / w, relative to the first vertex of a construction.
template <class N>
struct Homogeneous {
    N x, y, z, w; ///< w of any sign, not zero if the construction is defined
};

/// The point d t / w, relative to the first vertex of a construction.
template <class N>
struct OnLine {
    Vector<N> d;
    N t, w;
};

/// Intersects the line p q with the plane through r with normal n; relative to p.
template <class N>
OnLine<N> line_meets_plane(const Coordinates<N, One>& p, const Coordinates<N, One>& q,
                           const Coordinates<N, One>& r, const Vector<N>& n) {
    const auto d = difference(q, p);
    return {d, dot(n, difference(r, p)), dot(n, d)};
}

/// Returns a normal of the plane that contains direction d and is parallel to `axis`.
template <class N>
Vector<N> normal_along(Axis axis, const Vector<N>& d) {
    const N zero(0.0);
    switch (axis) {
    case Axis::x:
        return {zero, d.z, -d.y};
    case Axis::y:
        return {-d.z, zero, d.x};
    default:
        return {d.y, -d.x, zero};
    }
}

/// Intersects three planes, each given by three points; relative to c[0].
template <class N>
Homogeneous<N> planes_meet(const Coordinates<N, One> (&c)[9]) {
    const auto n1 = cross(difference(c[1], c[0]), difference(c[2], c[0]));
    const auto n2 = cross(difference(c[4], c[3]), difference(c[5], c[3]));
    const auto n3 = cross(difference(c[7], c[6]), difference(c[8], c[6]));
    const N r2 = dot(n2, difference(c[3], c[0]));
    const N r3 = dot(n3, difference(c[6], c[0]));
    const auto n31 = cross(n3, n1);
    const auto n12 = cross(n1, n2);
    return {r2 * n31.x + r3 * n12.x, r2 * n31.y + r3 * n12.y, r2 * n31.z + r3 * n12.z,
            dot(n3, n12)};
}

/// Whether the construction intersects a line with a plane (kinds line_plane and line_line).
inline bool is_on_line(const Construction& how) {
    return how.kind == Construction::Kind::line_plane || how.kind == Construction::Kind::line_line;
}

/// Computes the point of a construction for which is_on_line holds. input(i) returns the Point3 of
/// input vertex i.
template <class N, class Input>
OnLine<N> construct_on_line(const Construction& how, const Input& input) {
    const auto at = [&](int i) { return cartesian<N>(input(how.v[static_cast<unsigned>(i)])); };
    const auto r = at(2);
    return line_meets_plane(at(0), at(1), r,
                            how.kind == Construction::Kind::line_plane
                                ? cross(difference(at(3), r), difference(at(4), r))
                                : normal_along(how.axis, difference(at(3), r)));
}

/// Computes a construction's point relative to input(how.v[0]). input(i) returns the Point3 of
/// input vertex i.
template <class N, class Input>
Homogeneous<N> construct(const Construction& how, const Input& input) {
    const auto at = [&](int i) { return cartesian<N>(input(how.v[static_cast<unsigned>(i)])); };
    switch (how.kind) {
    case Construction::Kind::line_plane:
    case Construction::Kind::line_line: {
        const auto [d, t, w] = construct_on_line<N>(how, input);
        return {d.x * t, d.y * t, d.z * t, w};
    }
    case Construction::Kind::three_planes: {
        const Coordinates<N, One> c[9] = {at(0), at(1), at(2), at(3), at(4),
                                          at(5), at(6), at(7), at(8)};
        return planes_meet(c);
    }
    default:
        return {N(0.0), N(0.0), N(0.0), N(1.0)};
    }
}

} // namespace terrane::polynomial
