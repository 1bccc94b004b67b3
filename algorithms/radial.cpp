// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/radial.hpp>

#include <algorithm>
#include <stdexcept>

namespace terrane {
namespace {

using Side = EdgeSides::Side;

bool have_common_value(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (a[i] == b[j]) return true;
        a[i] < b[j] ? ++i : ++j;
    }
    return false;
}

/// Directions of triangles away from one edge, compared by angle.
class Directions {
public:
    Directions(const Sheets& sheets, const Side& reference) :
        sheets_(sheets), reference_(reference) {}

    /// Strictly smaller angle, counted from the reference in [0, 2 pi).
    [[nodiscard]] bool before(const Side& p, const Side& q) const {
        if (p.triangle == q.triangle) return false;
        const int a = sector(p), b = sector(q);
        if (a != b) return a < b;
        if (const Sign s = turn(p, q); s != Sign::Zero) return s == Sign::Positive;
        throw std::logic_error("two triangles overlap");
    }

private:
    /// The reference is 0; less than half a turn from it 1; half a turn 2; more 3.
    [[nodiscard]] int sector(const Side& q) const {
        if (q.triangle == reference_.triangle) return 0;
        const Sign s = turn(reference_, q);
        return s == Sign::Positive ? 1 : s == Sign::Zero ? 2 : 3;
    }

    /// Positive iff q is less than half a turn ahead of p; Zero iff it is opposite.
    [[nodiscard]] Sign turn(const Side& p, const Side& q) const {
        if (sheets_.parents != nullptr &&
            have_common_value((*sheets_.parents)[p.triangle], (*sheets_.parents)[q.triangle]))
            return Sign::Zero;
        const std::uint32_t apex = sheets_.triangles[q.triangle][(q.corner + 2) % 3];
        const Sign side = side_of(sheets_, p.triangle, apex);
        return runs_upward(p) ? side : -side;
    }

    /// Whether the triangle runs along the edge from its lower vertex to its higher one.
    [[nodiscard]] bool runs_upward(const Side& s) const {
        return sheets_.triangles[s.triangle][s.corner] != s.high;
    }

    const Sheets& sheets_;
    const Side reference_;
};

/// The side of the triangle that faces growing angles.
std::uint32_t ahead(const Sheets& sheets, const Side& s) {
    const bool upward = sheets.triangles[s.triangle][s.corner] != s.high;
    return upward ? front_of(s.triangle) : back_of(s.triangle);
}

} // namespace

void sort_round_edge(const Sheets& sheets, std::span<Side> sides) {
    if (sides.size() < 3) return;
    const Directions directions(sheets, sides[0]);
    std::sort(sides.begin(), sides.end(),
              [&](const Side& p, const Side& q) { return directions.before(p, q); });
}

void join_round_edges(const Sheets& sheets, Sets& sides) {
    const UpwardRounding guard;
    std::vector<Side> round;
    sheets.edges.for_each([&](std::uint32_t, std::uint32_t, std::span<const Side> at_edge) {
        round.assign(at_edge.begin(), at_edge.end());
        sort_round_edge(sheets, round);
        for (std::size_t i = 0; i < round.size(); ++i) {
            const Side& next = round[(i + 1) % round.size()];
            sides.join(ahead(sheets, round[i]), opposite(ahead(sheets, next)));
        }
    });
}

} // namespace terrane
