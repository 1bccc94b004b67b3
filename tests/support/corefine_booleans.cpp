// SPDX-License-Identifier: LGPL-3.0-or-later

#include "support/corefine_booleans.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace corefine_oracle {

using terrane::Edge;
using terrane::Surface;
using terrane::Triangle;

std::array<Spot, 2> ordered(const Spot& a, const Spot& b) {
    return a < b ? std::array{a, b} : std::array{b, a};
}

Rational volume(const Spot& a, const Spot& b, const Spot& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

namespace {

int side(const Spot& a, const Spot& b, const Spot& c, const Spot& p) {
    Spot u, v, w;
    for (unsigned k = 0; k < 3; ++k) u[k] = a[k] - p[k], v[k] = b[k] - p[k], w[k] = c[k] - p[k];
    const Rational d = volume(u, v, w);
    return (d > 0) - (d < 0);
}

/// Tells whether p is inside a closed surface that does not contain it, by a segment from p to a
/// point far outside; none if the segment meets an edge.
std::optional<bool> is_inside(const Spot& p, const Surface& s, const Spot& towards) {
    bool inside = false;
    for (const Triangle& t : s.triangles) {
        std::array<Spot, 3> c;
        for (unsigned i = 0; i < 3; ++i) {
            const auto& v = s.vertices[t[i]];
            c[i] = {Rational(v.x), Rational(v.y), Rational(v.z)};
        }
        const int here = side(c[0], c[1], c[2], p), there = side(c[0], c[1], c[2], towards);
        if (here == 0 && there == 0) continue; // the segment is in its plane; its neighbours decide
        bool left = false, right = false, on = false;
        for (unsigned i = 0; i < 3; ++i) {
            const int turn = side(p, towards, c[i], c[(i + 1) % 3]);
            left = left || turn > 0;
            right = right || turn < 0;
            on = on || turn == 0;
        }
        if (left && right) continue; // the line misses the triangle
        if (on) return std::nullopt;
        // `towards` is beyond everything, so the triangle is crossed iff it lies between.
        if (here * there < 0) inside = !inside;
    }
    return inside;
}

bool is_inside(const Spot& p, const Surface& s) {
    Rational size = 1;
    for (const auto& v : s.vertices)
        for (const double d : {v.x, v.y, v.z}) size += d < 0 ? Rational(-d) : Rational(d);
    for (unsigned k = 0; k < 3; ++k) size += p[k] < 0 ? Rational(-p[k]) : p[k];
    for (int i = 1;; ++i) {
        const Spot towards{p[0] + size * 4 * (97 + i * i), p[1] + size * (13 + 7 * i),
                           p[2] + size * (5 + i * i * i)};
        if (const auto answer = is_inside(p, s, towards)) return *answer;
    }
}

/// Numbers the parts so that those connected across edges that are not intersection edges are
/// equal.
std::vector<std::size_t> patches_of(const Parts& parts) {
    std::vector<std::size_t> patch(parts.triangles.size());
    for (std::size_t t = 0; t < patch.size(); ++t) patch[t] = t;
    std::map<std::array<std::uint32_t, 2>, std::vector<std::size_t>> at;
    for (std::size_t t = 0; t < patch.size(); ++t)
        for (unsigned i = 0; i < 3; ++i) {
            const auto ends = std::minmax(parts.triangles[t][i], parts.triangles[t][(i + 1) % 3]);
            const auto edge = ordered(parts.points[ends.first], parts.points[ends.second]);
            if (parts.intersection_edges.count(edge) == 0)
                at[{ends.first, ends.second}].push_back(t);
        }
    for (const auto& [edge, sides] : at)
        for (const std::size_t t : sides)
            if (patch[t] != patch[sides[0]])
                std::replace(patch.begin(), patch.end(), std::size_t{patch[t]},
                             std::size_t{patch[sides[0]]});
    return patch;
}

/// The position of a part: inside or outside of the other surface, or a part of both, with the same
/// or the opposite orientation.
enum class Side { inside, outside, same, opposite };

Triangle turned(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

Triangle reversed(const Triangle& t) {
    return turned({t[0], t[2], t[1]});
}

/// Returns the positions of the parts of one closed surface with respect to the other.
std::vector<Side> sides_of(const Parts& parts, const Surface& other, const Parts& others) {
    std::set<Triangle> shared;
    for (const Triangle& t : others.triangles) shared.insert(turned(t));
    std::map<std::size_t, Side> known; // by patch
    const auto patch = patches_of(parts);
    std::vector<Side> sides;
    for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
        const Triangle& t = parts.triangles[i];
        if (shared.count(turned(t)) != 0) {
            sides.push_back(Side::same);
        } else if (shared.count(reversed(t)) != 0) {
            sides.push_back(Side::opposite);
        } else {
            if (known.count(patch[i]) == 0) {
                Spot centre;
                for (unsigned k = 0; k < 3; ++k)
                    centre[k] =
                        (parts.points[t[0]][k] + parts.points[t[1]][k] + parts.points[t[2]][k]) / 3;
                known[patch[i]] = is_inside(centre, other) ? Side::inside : Side::outside;
            }
            sides.push_back(known[patch[i]]);
        }
    }
    return sides;
}

/// Adds the parts that are on the wanted side, reversed if `reverse` is set.
void add(Border& border, const Parts& parts, const std::vector<Side>& sides, Side wanted,
         bool reverse) {
    for (std::size_t i = 0; i < sides.size(); ++i)
        if (sides[i] == wanted)
            border.triangles.push_back(reverse ? reversed(parts.triangles[i])
                                               : turned(parts.triangles[i]));
}

} // namespace

bool Border::is_manifold() const {
    std::map<Edge, int> at;
    for (const Triangle& t : triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const auto ends = std::minmax(t[i], t[(i + 1) % 3]);
            ++at[{ends.first, ends.second}];
        }
    return std::all_of(at.begin(), at.end(), [](const auto& edge) { return edge.second == 2; });
}

Rational Border::six_volumes(const std::vector<Spot>& points) const {
    Rational sum = 0;
    for (const Triangle& t : triangles) sum += volume(points[t[0]], points[t[1]], points[t[2]]);
    return sum;
}

Borders booleans(std::span<const Surface> pair, const std::array<Parts, 2>& ours) {
    const std::array sides{sides_of(ours[0], pair[1], ours[1]),
                           sides_of(ours[1], pair[0], ours[0])};
    Borders all;
    for (unsigned k = 0; k < 2; ++k) {
        add(all[0], ours[k], sides[k], Side::outside, false);
        add(all[1], ours[k], sides[k], Side::inside, false);
        add(all[2 + k], ours[k], sides[k], Side::outside, false);
        add(all[2 + k], ours[1 - k], sides[1 - k], Side::inside, true);
        add(all[2 + k], ours[k], sides[k], Side::opposite, false);
    }
    add(all[0], ours[0], sides[0], Side::same, false);
    add(all[1], ours[0], sides[0], Side::same, false);
    return all;
}

} // namespace corefine_oracle
