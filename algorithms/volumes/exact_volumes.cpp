// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/exact_volumes.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

#include <gmpxx.h>

#include <terrane/kernel/double_double.hpp>
#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/polynomials.hpp>

namespace terrane::volumes {
namespace {

// Six times the volume of a body is the sum, over its closed boundary, of the determinants of the
// corners of triangles that have the body behind them, minus that of triangles with the body in
// front of them.

/// Calls add(volume, sign) for the two sides of a triangle that does not dangle. The sign for the
/// outside is reversed, so that its sum is the volume that the outside does not fill.
template <class Add>
void for_sides(const std::array<std::uint32_t, 2>& sides, const Add& add) {
    const auto [front, back] = sides;
    if (front == back) return;
    add(front, front == 0 ? 1 : -1);
    add(back, back == 0 ? -1 : 1);
}

// ---- With about 106 bits -----------------------------------------------------------------------

using TwofoldVector = polynomial::Vector<DoubleDouble>;

TwofoldVector relative_to(const Point3& origin, const TriangleComplex& sheets, PointIndex p) {
    const Construction how = sheets.points.construction(p);
    const auto at = [&](std::uint32_t v) -> const Point3& { return sheets.points.input(v); };
    const Point3& base = at(how.v[0]);
    const auto from = [](double a, double b) { return DoubleDouble(a) - DoubleDouble(b); };
    const TwofoldVector d{from(base.x, origin.x), from(base.y, origin.y), from(base.z, origin.z)};
    if (how.kind == Construction::Kind::input) return d;
    const auto h = polynomial::construct<DoubleDouble>(how, at);
    return {d.x + h.x / h.w, d.y + h.y / h.w, d.z + h.z / h.w};
}

std::vector<TwofoldVector> relative_to(const Point3& origin, const TriangleComplex& sheets) {
    std::vector<TwofoldVector> vectors;
    vectors.reserve(sheets.vertices.size());
    for (const PointIndex p : sheets.vertices) vectors.push_back(relative_to(origin, sheets, p));
    return vectors;
}

/// Returns six times the volume between a triangle and the plane z = 0, below which it counts negative. Over a closed
/// boundary these add up to the determinants, of which each costs three times as much.
DoubleDouble six_volumes_below(const TwofoldVector& a, const TwofoldVector& b,
                               const TwofoldVector& c) {
    return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) * (a.z + b.z + c.z);
}

std::vector<DoubleDouble> quick_sums(const TriangleComplex& sheets, VolumeSides of_sides,
                                     std::size_t count) {
    std::vector<DoubleDouble> sums(count);
    if (sheets.triangles.empty()) return sums;
    const Construction first = sheets.points.construction(sheets.vertices[0]);
    const auto at = relative_to(sheets.points.input(first.v[0]), sheets);
    in_twofold([&] {
        for (std::size_t t = 0; t < sheets.triangles.size(); ++t) {
            const auto [front, back] = of_sides[t];
            if (front == back) continue;
            const auto& [a, b, c] = sheets.triangles[t];
            const DoubleDouble part = six_volumes_below(at[a], at[b], at[c]);
            if (front != 0) sums[front] = sums[front] - part;
            if (back != 0) sums[back] = sums[back] + part;
        }
        for (std::size_t v = 1; v < count; ++v) sums[0] = sums[0] + sums[v];
    });
    return sums;
}

// ---- Exactly -----------------------------------------------------------------------------------

mpq_class rational(const Exact& number) {
    mpq_class q;
    number.export_to_mpq_t(q.get_mpq_t());
    return q;
}

/// Sums in pairs, so that terms of similar size are added and the last few sums dominate the cost.
class PairwiseSum {
public:
    void add(mpq_class term) {
        for (std::size_t n = ++count_; n % 2 == 0; n /= 2) {
            term += open_.back();
            open_.pop_back();
        }
        open_.push_back(std::move(term));
    }
    [[nodiscard]] mpq_class total() const {
        return std::accumulate(open_.rbegin(), open_.rend(), mpq_class());
    }

private:
    std::vector<mpq_class> open_;
    std::size_t count_ = 0;
};

/// Sums up the exact measure of one volume. Triangles of input points are summed without
/// denominators.
class ExactSum {
public:
    void add(const TriangleComplex& sheets, const Triangle& t, int sign) {
        const std::array p{sheets.vertices[t[0]], sheets.vertices[t[1]], sheets.vertices[t[2]]};
        const auto at = [&](unsigned i) { return sheets.points.exact(p[i]); };
        const ExactPoint a = at(0), b = at(1), c = at(2);
        const auto vector = [](const ExactPoint& q) {
            return polynomial::Vector<Exact>{q.x, q.y, q.z};
        };
        const Exact determinant = dot(cross(vector(a), vector(b)), vector(c)) * sign;
        if (std::all_of(p.begin(), p.end(),
                        [&](PointIndex q) { return sheets.points.is_input(q); }))
            of_inputs_ = of_inputs_ + determinant;
        else
            of_constructed_.add(rational(determinant) / rational(a.w * b.w * c.w));
    }
    [[nodiscard]] mpq_class six_volumes() const {
        return rational(of_inputs_) + of_constructed_.total();
    }
    [[nodiscard]] mpq_class volume() const { return six_volumes() / 6; }

private:
    Exact of_inputs_;
    PairwiseSum of_constructed_;
};

/// Returns the sums of the wanted volumes; those of others stay 0.
std::vector<ExactSum> exact_sums(const TriangleComplex& sheets, VolumeSides of_sides,
                                 const std::vector<bool>& wanted) {
    std::vector<ExactSum> sums(wanted.size());
    for (std::size_t t = 0; t < sheets.triangles.size(); ++t)
        for_sides(of_sides[t], [&](std::uint32_t volume, int sign) {
            if (wanted[volume]) sums[volume].add(sheets, sheets.triangles[t], sign);
        });
    return sums;
}

double nearest_double(const mpq_class& q) {
    return nearest_quotient(Exact(q.get_num()), Exact(q.get_den()));
}

} // namespace

std::vector<double> measure_volumes(const TriangleComplex& sheets, VolumeSides of_sides,
                                    std::size_t count) {
    const auto sums = quick_sums(sheets, of_sides, count);
    std::vector<double> measures(count, 0);
    std::vector<bool> in_doubt(count, false);
    for (std::size_t v = 0; v < count; ++v) {
        const auto nearest = (sums[v] / DoubleDouble(6)).nearest();
        in_doubt[v] = !nearest.has_value();
        measures[v] = nearest.value_or(0);
    }
    if (std::none_of(in_doubt.begin(), in_doubt.end(), [](bool b) { return b; })) return measures;
    const auto exact = exact_sums(sheets, of_sides, in_doubt);
    for (std::size_t v = 0; v < count; ++v)
        if (in_doubt[v]) measures[v] = nearest_double(exact[v].volume());
    return measures;
}

std::vector<std::string> partial_measures(const TriangleComplex& sheets, VolumeSides of_sides,
                                          std::size_t count) {
    std::vector<std::string> texts;
    for (const ExactSum& sum : exact_sums(sheets, of_sides, std::vector<bool>(count, true)))
        texts.push_back(sum.six_volumes().get_str(16));
    return texts;
}

double measure_of_parts(std::span<const std::string> parts) {
    mpq_class sum;
    for (const std::string& part : parts) sum += mpq_class(part, 16);
    return sum == 0 ? 0 : nearest_double(sum / 6);
}

std::vector<std::string> exact_measures(const TriangleComplex& sheets, VolumeSides of_sides,
                                        std::size_t count, int base) {
    std::vector<std::string> texts;
    for (const ExactSum& sum : exact_sums(sheets, of_sides, std::vector<bool>(count, true)))
        texts.push_back(sum.volume().get_str(base));
    return texts;
}

} // namespace terrane::volumes
