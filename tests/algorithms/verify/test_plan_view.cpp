// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the verifier's view in plan with rational arithmetic. Half of the points are on a line
// through two others or next to it, where doubles do not decide the sides.
#include <terrane/algorithms/verify/detail/plan_view.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace terrane::verifier {
namespace {

/// Points with coordinates of a given number of bits; half of them are next to the line through two
/// others, or on it.
class NearLines {
public:
    NearLines(std::uint64_t seed, unsigned bits) :
        random_(seed), numbers_(gmp_randinit_default), bits_(bits) {
        numbers_.seed(static_cast<unsigned long>(seed));
    }

    Vector4 point() {
        return {mpz_class(numbers_.get_z_bits(bits_)), mpz_class(numbers_.get_z_bits(bits_)),
                mpz_class(numbers_.get_z_bits(bits_)), 1};
    }

    /// Returns a point at most one unit off the line through a and b.
    Vector4 beside(const Vector4& a, const Vector4& b) {
        Vector4 p;
        const int share = at_most(3) - 1;
        for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + share * (b[k] - a[k]) + at_most(2) - 1;
        p[3] = 1;
        return p;
    }

    int at_most(int n) { return std::uniform_int_distribution<int>(0, n)(random_); }

    /// Returns points of which half are off the line through the two before.
    template <std::size_t N>
    std::array<Vector4, N> some() {
        std::array<Vector4, N> p;
        for (std::size_t k = 0; k < N; ++k)
            p[k] = k >= 2 && at_most(1) == 0 ? beside(p[k - 2], p[k - 1]) : point();
        return p;
    }

private:
    std::mt19937_64 random_;
    gmp_randclass numbers_;
    unsigned bits_;
};

using SeenTriangle = std::optional<UpwardCorners>;

std::pair<SeenTriangle, SeenTriangle> two_triangles(std::span<const Vector4> p) {
    bool flipped = false;
    return {upward({&p[0], &p[1], &p[2]}, flipped), upward({&p[3], &p[4], &p[5]}, flipped)};
}

int side(const Vector4& a, const Vector4& b, const Vector4& p) {
    const mpz_class one = (b[0] - a[0]) * (p[1] - a[1]), other = (b[1] - a[1]) * (p[0] - a[0]);
    return cmp(one, other);
}

bool divides(const UpwardCorners& s, const UpwardCorners& t) {
    for (std::size_t i = 0; i < 3; ++i)
        if (std::ranges::all_of(
                t, [&](const Vector4* p) { return side(*s[i], *s[(i + 1) % 3], *p) <= 0; }))
            return true;
    return false;
}

mpq_class doubled_area(const PlacePolygon& polygon) {
    mpq_class sum = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Place &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        sum += p.x * q.y - p.y * q.x;
    }
    return sum;
}

TEST_CASE("plan view: points are in triangles, and triangles overlap, where rationals say so",
          "[verify]") {
    for (const unsigned bits : {4U, 30U, 52U, 60U, 190U, 210U, 1100U}) {
        NearLines points(bits, bits);
        for (int run = 0; run < 300; ++run) {
            const auto p = points.some<7>();
            const auto [s, t] = two_triangles(p);
            if (!s || !t) continue;
            bool inside = true;
            for (std::size_t i = 0; i < 3; ++i)
                inside = inside && side(*(*s)[i], *(*s)[(i + 1) % 3], p[6]) >= 0;
            CHECK(contains(*s, place_of(p[6])) == inside);
            const bool apart = divides(*s, *t) || divides(*t, *s);
            CHECK(are_beside(*s, *t) == apart);
            CHECK((doubled_area(common_part(*s, *t)) == 0) == apart);
        }
    }
}

/// Tells whether a segment has a point in the interior of a polygon, by rationals only.
bool is_inside(const SegmentInPlan& s, const PlacePolygon& polygon) {
    mpq_class from = 0, to = 1;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Place &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const mpq_class u = turn(p, q, s[0]), v = turn(p, q, s[1]);
        if (u <= 0 && v <= 0) return false;
        if (u < 0) from = std::max(from, mpq_class(u / (u - v)));
        if (v < 0) to = std::min(to, mpq_class(u / (u - v)));
    }
    return from < to;
}

TEST_CASE("plan view: segments divide a triangle into parts that none of them passes through",
          "[verify]") {
    for (const unsigned bits : {4U, 30U, 52U, 190U, 210U, 1100U}) {
        NearLines points(bits, bits);
        std::size_t divided = 0;
        for (int run = 0; run < 60; ++run) {
            const auto p = points.some<9>();
            bool flipped = false;
            const auto t = upward({&p[0], &p[1], &p[2]}, flipped);
            const auto is_point = [&](std::size_t k) {
                return p[k][0] == p[k + 1][0] && p[k][1] == p[k + 1][1];
            };
            if (!t || is_point(3) || is_point(5) || is_point(7)) continue;
            const PlacePolygon whole{place_of(*(*t)[0]), place_of(*(*t)[1]), place_of(*(*t)[2])};
            const std::array<SegmentInPlan, 3> segments{{{place_of(p[3]), place_of(p[4])},
                                                         {place_of(p[5]), place_of(p[6])},
                                                         {place_of(p[7]), place_of(p[8])}}};
            const auto parts = divided_by(whole, segments);
            mpq_class area = 0;
            for (const PlacePolygon& part : parts) {
                CHECK(doubled_area(part) >= 0);
                area += doubled_area(part);
                for (const SegmentInPlan& s : segments) CHECK_FALSE(is_inside(s, part));
            }
            CHECK(area == doubled_area(whole));
            if (parts.size() > 1) ++divided;
        }
        CHECK(divided > 10);
    }
}

} // namespace
} // namespace terrane::verifier
