// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/optimisation/detail/quality.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/optimisation/detail/constants.hpp>

namespace terrane::optimisation::detail {

namespace {

double square(const Point3& v) {
    return dot(v, v);
}

/// The squares of the lengths of the edges of a tetrahedron (a, b, c, d).
struct Edges {
    double ab = 0, ac = 0, ad = 0, bc = 0, bd = 0, cd = 0;
};

/// The squares of the inward normals of the faces opposite to its corners, of twice their areas,
/// and their products: negative where the angle between two of them is acute.
struct Normals {
    double a = 0, b = 0, c = 0, d = 0;
    double ab = 0, ac = 0, ad = 0, bc = 0, bd = 0, cd = 0;
};

/// The squares of sines are 9 V^2 |edge|^2 / (4 A^2 A'^2) for the volume V and the areas A, A' of
/// the two faces at an edge. Extended by the areas of the other two faces, all six have the
/// denominator `areas`, and the numerators 36 V^2 times these. The cube of the mean ratio is
/// 432 * 36 V^2 over the cube of the sum of all |edge|^2; it is brought to the same denominator.
struct Numerators {
    double sine = 0, value = 0; ///< least of all sines; least of all that counts, with its shares
    double areas = 0;           ///< product of the squares of twice the areas
};

inline Numerators numerators_of(const Edges& e, const Normals& n, double volume,
                                const Measure& measure) {
    constexpr double share = constants.obtuse_share * constants.obtuse_share;
    constexpr double shape_share = 432 * constants.shape_share * constants.shape_share;
    const double ab = e.ab * n.a * n.b, ac = e.ac * n.a * n.c, ad = e.ad * n.a * n.d,
                 bc = e.bc * n.b * n.c, bd = e.bd * n.b * n.d, cd = e.cd * n.c * n.d;
    const auto weighed = [](double number, double product) {
        return product > 0 ? share * number : number;
    };
    const double areas = n.a * n.b * n.c * n.d;
    Numerators least{std::min({ab, ac, ad, bc, bd, cd}),
                     std::min({weighed(ab, n.cd), weighed(ac, n.bd), weighed(ad, n.bc),
                               weighed(bc, n.ad), weighed(bd, n.ac), weighed(cd, n.ab)}),
                     areas};
    if (measure.least < HUGE_VAL) {
        const double sum = e.ab + e.ac + e.ad + e.bc + e.bd + e.cd, ratio = measure.least / volume;
        least.value =
            std::min(least.value, areas * (ratio * ratio + shape_share / (sum * sum * sum)));
    }
    return least;
}

} // namespace

double quality_of_mean_ratio(double ratio, const Measure& measure) {
    return std::hypot(measure.least, constants.shape_share * ratio * std::sqrt(ratio));
}

Quality quality_of(const Point3& a, const Point3& b, const Point3& c, const Point3& d,
                   const Measure& measure) {
    const Point3 ab = minus(b, a), ac = minus(c, a), ad = minus(d, a);
    const Point3 bc = minus(c, b), bd = minus(d, b), cd = minus(d, c);
    const Point3 of_a = cross(bd, bc), of_b = cross(ac, ad), of_c = cross(ad, ab),
                 of_d = cross(ab, ac);
    const Edges e{square(ab), square(ac), square(ad), square(bc), square(bd), square(cd)};
    const Normals n{square(of_a),    square(of_b),    square(of_c),    square(of_d),
                    dot(of_a, of_b), dot(of_a, of_c), dot(of_a, of_d), dot(of_b, of_c),
                    dot(of_b, of_d), dot(of_c, of_d)};
    const double volume = dot(ad, of_d);
    const Numerators least = numerators_of(e, n, volume, measure);
    Quality quality{volume * std::sqrt(least.value / least.areas),
                    volume * std::sqrt(least.sine / least.areas), false};
    // A normal is wrong by less than 2^-50 of the product of two edges, so its length by less than
    // 2^-20 of itself if its square is above 2^-60 of the longest edge's fourth power. The volume
    // is wrong by less than 2^-49 of the product of three edges. Products that underflow are not
    // trusted.
    const double longest = std::max({e.ab, e.ac, e.ad, e.bc, e.bd, e.cd});
    const double volume_error = 0x1p-49 * std::sqrt(e.ab * e.ac * e.ad);
    quality.is_trusted =
        least.areas > 0x1p-900 && least.areas < 0x1p900 && least.sine > 0x1p-900 &&
        std::min({n.a, n.b, n.c, n.d}) > 0x1p-60 * longest * longest &&
        volume_error * std::sqrt(least.sine / least.areas) < constants.least_gain / 10;
    return quality;
}

void FacesAround::add(const Point3& a, const Point3& b, const Point3& c, bool counts) {
    const Point3 ab = minus(b, a), ac = minus(c, a);
    const Point3 normal = cross(ab, ac);
    faces_.push_back({a, b, c, ab, ac, normal, square(ab), square(ac), square(minus(c, b)),
                      square(normal), counts});
}

double FacesAround::square_quality(const Face& face, const Point3& p) const {
    const Point3 ad = minus(p, face.a);
    const double volume = dot(ad, face.normal);
    if (!(volume > 0)) return 0;
    if (!face.counts) return HUGE_VAL;
    const Point3 of_b = cross(face.ac, ad), of_c = cross(ad, face.ab);
    const Edges e{face.square_ab, face.square_ac,           square(ad),
                  face.square_bc, square(minus(p, face.b)), square(minus(p, face.c))};
    Normals n;
    n.b = square(of_b);
    n.c = square(of_c);
    n.d = face.square_area;
    n.bc = dot(of_b, of_c);
    n.bd = dot(of_b, face.normal);
    n.cd = dot(of_c, face.normal);
    // The sum of all four normals is zero.
    n.ab = -(n.b + n.bc + n.bd);
    n.ac = -(n.c + n.bc + n.cd);
    n.ad = -(n.d + n.bd + n.cd);
    n.a = -(n.ab + n.ac + n.ad);
    const Numerators least = numerators_of(e, n, volume, measure_);
    const double result = volume * volume * least.value / least.areas;
    return result > 0 && result < HUGE_VAL ? result : 0;
}

std::optional<double> FacesAround::above(const Point3& p, double enough) {
    double least = HUGE_VAL;
    const double bound = enough * enough;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        ++effort_;
        const double quality = square_quality(faces_[f], p);
        least = std::min(least, quality);
        if (quality > bound) continue;
        std::swap(faces_[f / 2], faces_[f]);
        return std::nullopt;
    }
    return std::sqrt(least);
}

double FacesAround::least(const Point3& p) {
    double least = HUGE_VAL;
    effort_ += faces_.size();
    for (const Face& face : faces_) least = std::min(least, square_quality(face, p));
    return std::sqrt(least);
}

std::size_t FacesAround::count_below(const Point3& p, double quality) const {
    std::size_t count = 0;
    for (const Face& face : faces_) count += square_quality(face, p) < quality * quality ? 1 : 0;
    return count;
}

Point3 FacesAround::away_from_nearest(const Point3& p) const {
    Point3 way;
    double least = HUGE_VAL;
    for (const Face& face : faces_)
        for (const Point3& corner : {face.a, face.b, face.c}) {
            const Point3 from = minus(p, corner);
            const double distance = length(from);
            if (!(distance > 0 && distance < least)) continue;
            least = distance;
            way = {from.x / distance, from.y / distance, from.z / distance};
        }
    return way;
}

double FacesAround::farthest(const Point3& p) const {
    double most = 0;
    for (const Face& face : faces_)
        for (const Point3& corner : {face.a, face.b, face.c})
            most = std::max(most, length(minus(corner, p)));
    return most;
}

double FacesAround::nearest(const Point3& p) const {
    double least = HUGE_VAL;
    for (const Face& face : faces_)
        for (const Point3& corner : {face.a, face.b, face.c}) {
            const double distance = length(minus(corner, p));
            if (distance > 0) least = std::min(least, distance);
        }
    return least;
}

} // namespace terrane::optimisation::detail
