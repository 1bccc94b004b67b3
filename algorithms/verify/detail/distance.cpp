// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/distance.hpp>

#include <cstddef>

namespace terrane::verifier {

Vector3 difference(const Vector4& a, const Vector4& b) {
    return {mpz_class(a[0] - a[3] * b[0]), mpz_class(a[1] - a[3] * b[1]),
            mpz_class(a[2] - a[3] * b[2])};
}

Vector3 cross(const Vector3& a, const Vector3& b) {
    return {mpz_class(a[1] * b[2] - a[2] * b[1]), mpz_class(a[2] * b[0] - a[0] * b[2]),
            mpz_class(a[0] * b[1] - a[1] * b[0])};
}

mpz_class dot(const Vector3& a, const Vector3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool within(const Vector4& a, const Vector4& b, const mpz_class& bound) {
    mpz_class squared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const mpz_class d = a[i] * b[3] - b[i] * a[3];
        squared += d * d;
    }
    const mpz_class limit = bound * a[3] * b[3];
    return squared <= limit * limit;
}

bool within_of_segment(const Vector4& point, const Vector4& start, const Vector4& end,
                       const mpz_class& bound) {
    const Vector3 along = difference(end, start);
    const Vector3 from_start = difference(point, start); // times w, like all compared terms
    const mpz_class limit = bound * point[3];
    const mpz_class place = dot(from_start, along);
    if (sgn(place) <= 0) return dot(from_start, from_start) <= limit * limit;
    if (place >= point[3] * dot(along, along)) {
        const Vector3 from_end = difference(point, end);
        return dot(from_end, from_end) <= limit * limit;
    }
    const Vector3 area = cross(from_start, along);
    return dot(area, area) <= limit * limit * dot(along, along);
}

bool within(const Vector4& point, const std::array<const Vector4*, 3>& triangle,
            const mpz_class& bound) {
    const Vector3 normal =
        cross(difference(*triangle[1], *triangle[0]), difference(*triangle[2], *triangle[0]));
    const mpz_class height = dot(normal, difference(point, *triangle[0]));
    const mpz_class limit = bound * point[3];
    if (height * height > limit * limit * dot(normal, normal)) return false;
    bool above = true; // whether the point projects into the triangle along its normal
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector4& start = *triangle[i];
        const Vector4& end = *triangle[(i + 1) % 3];
        if (sgn(dot(normal, cross(difference(end, start), difference(point, start)))) >= 0)
            continue;
        above = false; // outside of this side: the nearest point is on one of these sides
        if (within_of_segment(point, start, end, bound)) return true;
    }
    return above;
}

} // namespace terrane::verifier
