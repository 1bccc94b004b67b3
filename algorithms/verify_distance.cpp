// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify_distance.hpp>

#include <cstddef>

namespace terrane::verifier {

namespace {

using Vector3 = std::array<mpz_class, 3>;

Vector3 difference(const Vector4& a, const Vector4& b) {
    return {mpz_class(a[0] - b[0]), mpz_class(a[1] - b[1]), mpz_class(a[2] - b[2])};
}

Vector3 cross(const Vector3& a, const Vector3& b) {
    return {mpz_class(a[1] * b[2] - a[2] * b[1]), mpz_class(a[2] * b[0] - a[0] * b[2]),
            mpz_class(a[0] * b[1] - a[1] * b[0])};
}

mpz_class dot(const Vector3& a, const Vector3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether numerator^2 / squared_length <= bound^2.
bool ratio_within(const mpz_class& squared, const mpz_class& squared_length,
                  const mpz_class& bound) {
    return squared <= bound * bound * squared_length;
}

/// Whether a point at `from_start` of the start of a segment is within the bound of the segment.
bool within_segment(const Vector3& from_start, const Vector3& along, const mpz_class& bound) {
    const mpz_class place = dot(from_start, along);
    const mpz_class length = dot(along, along);
    if (sgn(place) <= 0) return dot(from_start, from_start) <= bound * bound;
    if (place >= length) {
        const Vector3 from_end{mpz_class(from_start[0] - along[0]),
                               mpz_class(from_start[1] - along[1]),
                               mpz_class(from_start[2] - along[2])};
        return dot(from_end, from_end) <= bound * bound;
    }
    const Vector3 area = cross(from_start, along);
    return ratio_within(dot(area, area), length, bound);
}

} // namespace

bool within(const Vector4& a, const Vector4& b, const mpz_class& bound) {
    mpz_class squared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const mpz_class d = a[i] * b[3] - b[i] * a[3];
        squared += d * d;
    }
    const mpz_class limit = bound * a[3] * b[3];
    return squared <= limit * limit;
}

bool within(const Vector4& point, const std::array<const Vector4*, 3>& triangle,
            const mpz_class& bound) {
    const Vector3 side = difference(*triangle[1], *triangle[0]);
    const Vector3 other = difference(*triangle[2], *triangle[0]);
    const Vector3 normal = cross(side, other);
    const mpz_class height = dot(normal, difference(point, *triangle[0]));
    if (!ratio_within(height * height, dot(normal, normal), bound)) return false;
    bool above = true; // the triangle, seen along its normal
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector4& start = *triangle[i];
        const Vector3 along = difference(*triangle[(i + 1) % 3], start);
        const Vector3 from_start = difference(point, start);
        if (sgn(dot(normal, cross(along, from_start))) >= 0) continue;
        above = false;
        if (within_segment(from_start, along, bound)) return true;
    }
    return above;
}

} // namespace terrane::verifier
