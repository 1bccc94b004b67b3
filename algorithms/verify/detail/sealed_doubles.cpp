// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_only_kept of sealed.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <terrane/algorithms/verify/detail/sealed.hpp>

namespace terrane::verifier {

namespace {

/// Areas of triangles seen along an axis, and lengths of their sides.
class SeenTriangles {
public:
    explicit SeenTriangles(std::size_t axis) : axis_(axis) {}

    void add(const Vector4& a, const Vector4& b, const Vector4& c) {
        mpq_class area(turn(a, b, c, axis_), mpz_class(a[3] * b[3] * c[3]));
        area.canonicalize();
        twice_area += abs(area);
        length += side(a, b) + side(b, c) + side(c, a);
    }

    mpq_class twice_area = 0;
    mpq_class length = 0; ///< of all sides, or more

private:
    static mpq_class coordinate(const Vector4& point, std::size_t i) {
        mpq_class value(point[i], point[3]);
        value.canonicalize();
        return value;
    }
    [[nodiscard]] mpq_class side(const Vector4& a, const Vector4& b) const {
        mpq_class sum = 0;
        for (std::size_t i = 0; i < 3; ++i)
            if (i != axis_) sum += abs(mpq_class(coordinate(a, i) - coordinate(b, i)));
        return sum;
    }

    std::size_t axis_;
};

} // namespace

void check_only_kept(std::span<const Surface> surfaces, const ArrangementClaim& kept,
                     const RoundedClaim& rounded, const std::vector<bool>& is_cut,
                     Violations& found) {
    if (rounded.max_move) return; // by R14 the triangles are those that were kept
    Violations none;              // R1 holds
    const Inputs inputs = join_inputs(surfaces, none);
    auto all = inputs.vertices;
    all.insert(all.end(), rounded.vertices.begin(), rounded.vertices.end());
    all.push_back({rounded.deviation, 0, 0});
    const auto points = scale_to_integers(all).points;
    const auto input_points = std::span(points).first(inputs.vertices.size());
    const auto of_doubles = std::span(points).subspan(inputs.vertices.size());
    const mpq_class deviation = points.back()[0];
    const auto exact_children = children_of(kept.parents_of, inputs.triangles.size());
    const auto children = children_of(rounded.parents_of, inputs.triangles.size());
    for (std::uint32_t p = 0; p < inputs.triangles.size(); ++p) {
        if (!is_cut[p] || children[p].empty()) continue;
        const auto& [a, b, c] = inputs.triangles[p];
        const std::size_t axis =
            longest_axis(orthogonal(input_points[a], input_points[b], input_points[c]));
        SeenTriangles now(axis), before(axis);
        for (const std::uint32_t t : children[p]) {
            const auto& [i, j, k] = rounded.triangles[t];
            now.add(of_doubles[i], of_doubles[j], of_doubles[k]);
        }
        for (const std::uint32_t t : exact_children[p]) {
            std::array<Vector4, 3> corners;
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = construct(kept.vertices[kept.triangles[t][i]], input_points).value();
            before.add(corners[0], corners[1], corners[2]);
        }
        // Where each point is moved by the deviation, twice the area grows by at most twice the
        // deviation per length, and by that of the corners; triangles can be turned over.
        const mpq_class corners =
            64 * deviation * deviation * mpq_class(children[p].size() + exact_children[p].size());
        const mpq_class slack = 8 * deviation * (now.length + before.length) + corners;
        if (now.twice_area > before.twice_area + slack)
            found.push_back(
                {Rule::R57_only_kept,
                 {p},
                 "the doubles of input triangle " + text(p) + " are larger than its kept part"});
    }
}

} // namespace terrane::verifier
