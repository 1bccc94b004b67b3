// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/rational.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

Vector4 orthogonal(const Vector4& a, const Vector4& b, const Vector4& c) {
    look_for_stop();
    const auto minor = [&](std::size_t i, std::size_t j) -> mpz_class {
        return b[i] * c[j] - b[j] * c[i];
    };
    const mpz_class xy = minor(0, 1);
    const mpz_class xz = minor(0, 2);
    const mpz_class xw = minor(0, 3);
    const mpz_class yz = minor(1, 2);
    const mpz_class yw = minor(1, 3);
    const mpz_class zw = minor(2, 3);
    return {
        mpz_class(a[1] * zw - a[2] * yw + a[3] * yz), mpz_class(a[2] * xw - a[0] * zw - a[3] * xz),
        mpz_class(a[0] * yw - a[1] * xw + a[3] * xy), mpz_class(a[1] * xz - a[0] * yz - a[2] * xy)};
}

mpz_class dot(const Vector4& plane, const Vector4& point) {
    look_for_stop();
    mpz_class sum = plane[0] * point[0];
    for (std::size_t i = 1; i < 4; ++i) {
        mpz_addmul(sum.get_mpz_t(), plane[i].get_mpz_t(), point[i].get_mpz_t());
    }
    return sum;
}

void make_primitive(Vector4& vector) {
    look_for_stop();
    mpz_class factor = gcd(vector[0], vector[1]);
    factor = gcd(factor, vector[2]);
    factor = gcd(factor, vector[3]);
    if (factor <= 1) return;
    for (mpz_class& number : vector) {
        mpz_divexact(number.get_mpz_t(), number.get_mpz_t(), factor.get_mpz_t());
    }
}

mpz_class turn(const Vector4& a, const Vector4& b, const Vector4& c, std::size_t axis) {
    look_for_stop();
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const mpz_class vw = b[v] * c[3] - b[3] * c[v];
    const mpz_class wu = b[3] * c[u] - b[u] * c[3];
    const mpz_class uv = b[u] * c[v] - b[v] * c[u];
    return a[u] * vw + a[v] * wu + a[3] * uv;
}

std::optional<std::size_t> projection_axis(const Vector4& plane) {
    for (const std::size_t axis : {2U, 0U, 1U}) {
        if (sgn(plane[axis]) != 0) return axis;
    }
    return std::nullopt;
}

namespace {

/// Normalises a multiple of the coordinates of a point; none if the point is at infinity.
std::optional<Vector4> to_point(Vector4 vector) {
    if (sgn(vector[3]) == 0) return std::nullopt;
    make_primitive(vector);
    if (sgn(vector[3]) < 0) {
        for (mpz_class& number : vector) number = -number;
    }
    return vector;
}

/// Returns the point where the line through p and q meets a plane.
std::optional<Vector4> meet(const Vector4& p, const Vector4& q, const Vector4& plane) {
    const mpz_class height_p = dot(plane, p);
    const mpz_class height_q = dot(plane, q);
    Vector4 point;
    for (std::size_t i = 0; i < 4; ++i) point[i] = height_p * q[i] - height_q * p[i];
    return to_point(std::move(point));
}

} // namespace

std::optional<Vector4> construct(const Construction& construction,
                                 std::span<const Vector4> inputs) {
    const auto vertex = [&](std::size_t i) -> const Vector4& { return inputs[construction.v[i]]; };
    const auto plane = [&](std::size_t i) {
        return orthogonal(vertex(i), vertex(i + 1), vertex(i + 2));
    };
    switch (construction.kind) {
    case Construction::Kind::input:
        return vertex(0);
    case Construction::Kind::line_plane:
        return meet(vertex(0), vertex(1), plane(2));
    case Construction::Kind::three_planes:
        return to_point(orthogonal(plane(0), plane(3), plane(6)));
    case Construction::Kind::line_line:
        if (sgn(dot(plane(0), vertex(3))) != 0) return std::nullopt;
        Vector4 direction;
        direction[static_cast<std::size_t>(construction.axis)] = 1;
        return meet(vertex(0), vertex(1), orthogonal(vertex(2), vertex(3), direction));
    }
    return std::nullopt;
}

ScaledPoints scale_to_integers(std::span<const Point3> points) {
    ScaledPoints result;
    for (const Point3& p : points) {
        look_for_stop();
        for (const double d : {p.x, p.y, p.z}) {
            const mpq_class exact(d);
            if (exact.get_den() > result.scale) result.scale = exact.get_den();
        }
    }
    // All denominators are powers of two, so the largest is a multiple of all.
    const auto integer = [&](double d) -> mpz_class {
        return mpq_class(mpq_class(d) * result.scale).get_num();
    };
    result.points.reserve(points.size());
    for (const Point3& p : points) {
        look_for_stop();
        result.points.push_back({integer(p.x), integer(p.y), integer(p.z), mpz_class(1)});
    }
    return result;
}

Vector4 rounded_to_integers(const Vector4& point, const mpz_class& factor) {
    Vector4 result{0, 0, 0, 1};
    for (std::size_t i = 0; i < 3; ++i)
        mpz_fdiv_q(result[i].get_mpz_t(), mpz_class(2 * factor * point[i] + point[3]).get_mpz_t(),
                   mpz_class(2 * point[3]).get_mpz_t());
    return result;
}

mpz_class determinant(const Vector4& a, const Vector4& b, const Vector4& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Box enclose(const Vector4& point, const mpz_class& scale) {
    look_for_stop();
    constexpr double largest = std::numeric_limits<double>::max();
    const mpz_class denominator = point[3] * scale;
    Box box{};
    for (std::size_t i = 0; i < 3; ++i) {
        mpq_class exact(point[i], denominator);
        exact.canonicalize();
        if (abs(exact) > largest) {
            box.low[i] = sgn(exact) < 0 ? -infinity : largest;
            box.high[i] = sgn(exact) < 0 ? -largest : infinity;
            continue;
        }
        const double truncated = exact.get_d(); // towards zero, by less than one step
        box.low[i] = std::nextafter(truncated, -infinity);
        box.high[i] = std::nextafter(truncated, infinity);
    }
    return box;
}

} // namespace terrane::verifier
