// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges volumes by other methods than those that find them, with integers and rationals of GMP.
//
// - Their number: by Alexander duality the number of volumes, including the outside, is one more
//   than the second Betti number of the triangles: the number of triangles minus the rank of the
//   boundary operator (mod 2).
// - Their sides: on segments in any direction, sides that face each other must bound one volume,
//   and the far end is in the outside.
// - Their measures: sums of prisms over the plane z = 0.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmpxx.h>

#include "support/oracle.hpp"
#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace test_support {

class VolumeOracle {
public:
    explicit VolumeOracle(const terrane::Arrangement& a) : triangles_(a.triangles) {
        std::vector<terrane::Point3> inputs(a.state->points.inputs().begin(),
                                            a.state->points.inputs().end());
        exponent_ = oracle::lowest_exponent(inputs);
        const auto scaled = oracle::points(inputs);
        for (const terrane::PointIndex p : a.vertices)
            points_.push_back(oracle::construct(a.state->points.construction(p), scaled));
        for (const terrane::Triangle& t : triangles_) planes_.push_back(plane_of(t));
    }

    /// Returns the number of volumes without the outside.
    [[nodiscard]] std::size_t block_count() const {
        std::map<std::array<std::uint32_t, 2>, std::size_t> rows;
        std::vector<std::vector<std::size_t>> columns;
        for (const terrane::Triangle& t : triangles_) {
            std::vector<std::size_t> column;
            for (unsigned i = 0; i < 3; ++i) {
                const auto ends = std::minmax(t[i], t[(i + 1) % 3]);
                column.push_back(
                    rows.try_emplace({ends.first, ends.second}, rows.size()).first->second);
            }
            std::sort(column.begin(), column.end());
            columns.push_back(std::move(column));
        }
        return columns.size() - rank(std::move(columns));
    }

    /// Returns the exact volume of each block; [0] is that of all blocks.
    [[nodiscard]] std::vector<mpq_class> measures(const terrane::Volumes& volumes) const {
        std::vector<mpq_class> sums(volumes.measures.size());
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            const auto [front, back] = volumes.of_sides[t];
            const mpq_class prism = prism_under(triangles_[t]);
            sums[back] += prism;
            sums[front] -= prism;
        }
        sums[0] = -sums[0];
        for (mpq_class& s : sums) exponent_ >= 0 ? shift_up(s) : shift_down(s);
        return sums;
    }

    /// Describes a flaw on a random segment from a point inside to one far outside; empty if there
    /// is none.
    template <class Random>
    [[nodiscard]] std::string flaw_on_segment(const terrane::Volumes& volumes,
                                              Random& random) const {
        for (;;) { // until the segment meets no edge
            const auto [from, to] = segment(random);
            std::vector<std::pair<mpq_class, std::size_t>> hits;
            if (!find_hits(from, to, hits)) continue;
            std::sort(hits.begin(), hits.end());
            std::uint32_t here = 0; // from the far end
            for (auto hit = hits.rbegin(); hit != hits.rend(); ++hit) {
                const auto& sides = volumes.of_sides[hit->second];
                const bool front_first = sgn(oracle::value(planes_[hit->second], to)) > 0;
                if (sides[front_first ? 0 : 1] != here)
                    return "triangle " + std::to_string(hit->second) + " has volume " +
                           std::to_string(sides[front_first ? 0 : 1]) + " on a side on " +
                           std::to_string(here);
                here = sides[front_first ? 1 : 0];
            }
            return {};
        }
    }

private:
    using Int = mpz_class;

    /// Returns the plane of a triangle, which is positive where orient3d is.
    [[nodiscard]] oracle::Row4 plane_of(const terrane::Triangle& t) const {
        const auto row = [&](std::uint32_t v) {
            const oracle::Point& p = points_[v];
            return oracle::Row4{p.x, p.y, p.z, p.w};
        };
        const auto a = row(t[0]), b = row(t[1]), c = row(t[2]);
        const auto minor = [&](int i, int j, int k) {
            return oracle::determinant(oracle::Row3{a[i], a[j], a[k]}, {b[i], b[j], b[k]},
                                       {c[i], c[j], c[k]});
        };
        return {minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2)};
    }

    static std::size_t rank(std::vector<std::vector<std::size_t>> columns) {
        std::map<std::size_t, std::vector<std::size_t>> with_lowest; // reduced, by their lowest row
        for (auto& column : columns) {
            while (!column.empty()) {
                const auto pivot = with_lowest.find(column.back());
                if (pivot == with_lowest.end()) break;
                std::vector<std::size_t> sum;
                std::set_symmetric_difference(column.begin(), column.end(), pivot->second.begin(),
                                              pivot->second.end(), std::back_inserter(sum));
                column = std::move(sum);
            }
            if (!column.empty()) with_lowest.emplace(column.back(), column);
        }
        return with_lowest.size();
    }

    [[nodiscard]] mpq_class coordinate(std::uint32_t v, int k) const {
        const oracle::Point& p = points_[v];
        mpq_class q(k == 0 ? p.x : k == 1 ? p.y : p.z, p.w);
        q.canonicalize();
        return q;
    }

    /// Returns the signed volume between a triangle and the plane z = 0: the projected area times
    /// the mean height.
    [[nodiscard]] mpq_class prism_under(const terrane::Triangle& t) const {
        std::array<std::array<mpq_class, 3>, 3> p;
        for (unsigned i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) p[i][static_cast<unsigned>(k)] = coordinate(t[i], k);
        const mpq_class area =
            (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        return area * (p[0][2] + p[1][2] + p[2][2]) / 6;
    }

    void shift_up(mpq_class& q) const { q <<= static_cast<mp_bitcnt_t>(3 * exponent_); }
    void shift_down(mpq_class& q) const { q >>= static_cast<mp_bitcnt_t>(-3 * exponent_); }

    /// Returns a segment from a point among the points to one far outside.
    template <class Random>
    std::array<oracle::Point, 2> segment(Random& random) const {
        const auto pick = [&](long most) {
            return Int(std::uniform_int_distribution<long>(-most, most)(random));
        };
        Int reach = 1;
        for (const oracle::Point& p : points_)
            for (const Int* c : {&p.x, &p.y, &p.z}) reach = std::max(reach, Int(abs(*c) / p.w + 1));
        const auto& at =
            points_[std::uniform_int_distribution<std::size_t>(0, points_.size() - 1)(random)];
        const Int w = 1000003;
        oracle::Point from{at.x * w + reach * at.w * pick(200000),
                           at.y * w + reach * at.w * pick(200000),
                           at.z * w + reach * at.w * pick(200000), at.w * w};
        oracle::Point to{reach * (pick(3) * 10 + pick(100000)),
                         reach * 5000011 * (pick(1) < 0 ? -1 : 1), reach * pick(5000011), 1};
        return {from, to};
    }

    /// Finds the hits of a segment, by parameters along it; returns false if it touches an edge or
    /// starts on a triangle.
    bool find_hits(const oracle::Point& from, const oracle::Point& to,
                   std::vector<std::pair<mpq_class, std::size_t>>& hits) const {
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            const Int p = oracle::value(planes_[t], from), q = oracle::value(planes_[t], to);
            if (sgn(p) == 0 || sgn(q) == 0) return false;
            if (sgn(p) == sgn(q)) continue;
            std::array<terrane::Sign, 3> turns{};
            for (unsigned i = 0; i < 3; ++i)
                turns[i] = oracle::orient3d(from, to, points_[triangles_[t][i]],
                                            points_[triangles_[t][(i + 1) % 3]]);
            if (std::count(turns.begin(), turns.end(), terrane::Sign::Zero) > 0) return false;
            if (turns[0] != turns[1] || turns[1] != turns[2]) continue;
            // Values are weighted by the w of their points.
            mpq_class near(p, from.w), far(q, to.w);
            near.canonicalize();
            far.canonicalize();
            hits.emplace_back(near / (near - far), t);
        }
        return true;
    }

    std::vector<terrane::Triangle> triangles_;
    std::vector<oracle::Point> points_;
    std::vector<oracle::Row4> planes_; ///< per triangle
    int exponent_ = 0;                 ///< points_ are scaled by 2^-exponent_
};

} // namespace test_support
