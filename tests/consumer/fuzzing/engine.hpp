// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A small engine under test: it cleans triangles, finds those that cross, open and turned edges, volumes and winding
// numbers, with exact signs. planted() plants one of its bugs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <vector>

#include <gmpxx.h>

namespace engine {

inline int bug = 0; ///< the number of the planted bug; 0: none
/// In this engine, bugs are chosen while it runs; a macro of the same name could do so when it is compiled.
inline bool planted(int number) {
    return bug == number;
}

using Point = std::array<double, 3>;
using Triangle = std::array<unsigned, 3>;
struct Mesh {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
};
using Corners = std::array<Point, 3>;
using Edge = std::pair<unsigned, unsigned>;
using Pairs = std::set<std::pair<unsigned, unsigned>>;

/// The determinant of the rows b - a, c - a, d - a.
template <class Number>
Number determinant(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto row = [&](const Point& p) {
        return std::array<Number, 3>{Number(p[0]) - Number(a[0]), Number(p[1]) - Number(a[1]),
                                     Number(p[2]) - Number(a[2])};
    };
    const auto u = row(b), v = row(c), w = row(d);
    return Number(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                  u[2] * (v[0] * w[1] - v[1] * w[0]));
}

/// The sign of the determinant: on which side of the plane through a, b, c the point d is.
inline int side(const Point& a, const Point& b, const Point& c, const Point& d) {
    const double fast = determinant<double>(a, b, c, d);
    if (planted(1)) return fast > 0 ? 1 : fast < 0 ? -1 : 0; // without exact numbers
    if (planted(2) && std::abs(fast) < 1e-9) return 0;       // a tolerance
    double size = 0;
    for (unsigned k = 0; k < 3; ++k)
        size =
            std::max({size, std::abs(b[k] - a[k]), std::abs(c[k] - a[k]), std::abs(d[k] - a[k])});
    if (size > 1e-90 && size < 1e90 && std::abs(fast) > 1e-14 * size * size * size)
        return fast > 0 ? 1 : -1;
    return sgn(determinant<mpq_class>(a, b, c, d));
}

/// The orientation of a, b, c seen along an axis.
inline int turn(const Point& a, const Point& b, const Point& c, unsigned axis) {
    const unsigned x = (axis + 1) % 3, y = (axis + 2) % 3;
    const mpq_class ax(a[x]), ay(a[y]);
    const mpq_class value = (mpq_class(b[x]) - ax) * (mpq_class(c[y]) - ay) -
                            (mpq_class(b[y]) - ay) * (mpq_class(c[x]) - ax);
    return sgn(value);
}

inline bool collinear(const Point& a, const Point& b, const Point& c) {
    return turn(a, b, c, 0) == 0 && turn(a, b, c, 1) == 0 && turn(a, b, c, 2) == 0;
}

inline unsigned axis_of(const Corners& t) {
    return turn(t[0], t[1], t[2], 0) != 0 ? 0 : turn(t[0], t[1], t[2], 1) != 0 ? 1 : 2;
}

/// Tells whether a point in the plane of a triangle is in it, or on its border.
inline bool contains(const Corners& t, const Point& p) {
    const unsigned axis = axis_of(t);
    const int a = turn(t[0], t[1], p, axis), b = turn(t[1], t[2], p, axis),
              c = turn(t[2], t[0], p, axis);
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

/// Tells whether segments in one plane meet.
inline bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d,
                          unsigned axis) {
    const int ac = turn(a, b, c, axis), ad = turn(a, b, d, axis), ca = turn(c, d, a, axis),
              cb = turn(c, d, b, axis);
    const auto between = [&](const Point& p, const Point& q, const Point& r) {
        for (unsigned k = 0; k < 3; ++k)
            if (k != axis && (r[k] < std::min(p[k], q[k]) || r[k] > std::max(p[k], q[k])))
                return false;
        return true;
    };
    if (ac * ad < 0 && ca * cb < 0) return true;
    return (ac == 0 && between(a, b, c)) || (ad == 0 && between(a, b, d)) ||
           (ca == 0 && between(c, d, a)) || (cb == 0 && between(c, d, b));
}

inline bool meets(const Point& p, const Point& q, const Corners& t) {
    const int sp = side(t[0], t[1], t[2], p), sq = side(t[0], t[1], t[2], q);
    if (sp * sq > 0) return false;
    if (planted(12) && sp * sq == 0 && sp != sq) return false; // a touch with an end
    if (sp == 0 && sq == 0) {
        if (planted(10)) return false; // coplanar ones
        const unsigned axis = axis_of(t);
        for (unsigned i = 0; i < 3; ++i)
            if (segments_meet(p, q, t[i], t[(i + 1) % 3], axis)) return true;
        return !planted(11) && contains(t, p); // a triangle within another one
    }
    const int a = side(p, q, t[0], t[1]), b = side(p, q, t[1], t[2]), c = side(p, q, t[2], t[0]);
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

inline Corners corners_of(const Mesh& mesh, const Triangle& t) {
    return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

/// Tells whether two triangles meet elsewhere than in common corners and edges.
inline bool cross(const Mesh& mesh, Triangle s, Triangle t) {
    unsigned common = 0;
    for (unsigned i = 0; i < 3; ++i) // common corners first
        if (const auto at = std::find(t.begin() + common, t.end(), s[i]); at != t.end()) {
            std::swap(*at, t[common]);
            std::swap(s[i], s[common++]);
        }
    const Corners a = corners_of(mesh, s), b = corners_of(mesh, t);
    if (common == 1 && planted(13)) return false;
    if (common == 1) return meets(a[1], a[2], b) || meets(b[1], b[2], a);
    if (common == 2) {
        if (planted(14) || side(a[0], a[1], a[2], b[2]) != 0) return false;
        const unsigned axis = axis_of(a);
        return turn(a[0], a[1], a[2], axis) == turn(a[0], a[1], b[2], axis);
    }
    for (unsigned i = 0; i < 3; ++i)
        if (meets(a[i], a[(i + 1) % 3], b) || meets(b[i], b[(i + 1) % 3], a)) return true;
    return false;
}

/// Returns the triangles that cross, of a clean mesh.
inline Pairs crossings(const Mesh& mesh) {
    const auto boxes_meet = [&](const Triangle& s, const Triangle& t) {
        for (unsigned k = 0; k < 3; ++k) {
            const auto range = [&](const Triangle& of) {
                return std::minmax(
                    {mesh.points[of[0]][k], mesh.points[of[1]][k], mesh.points[of[2]][k]});
            };
            const auto a = range(s), b = range(t);
            if (a.second < b.first || b.second < a.first) return false;
            if (planted(8) && (a.second == b.first || b.second == a.first)) return false;
        }
        return true;
    };
    Pairs pairs;
    const auto& t = mesh.triangles;
    for (unsigned i = 0; i < t.size(); ++i)
        for (unsigned j = i + 1; j < t.size() && !(planted(9) && j > i + 4); ++j)
            if (boxes_meet(t[i], t[j]) && cross(mesh, t[i], t[j])) pairs.insert({i, j});
    return pairs;
}

inline bool has_area(const Corners& t) {
    if (planted(5)) return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    if (planted(6)) {
        double square = 0;
        for (unsigned k = 0; k < 3; ++k) {
            const unsigned x = (k + 1) % 3, y = (k + 2) % 3;
            const double n = (t[1][x] - t[0][x]) * (t[2][y] - t[0][y]) -
                             (t[1][y] - t[0][y]) * (t[2][x] - t[0][x]);
            square += n * n;
        }
        if (square < 1e-18) return false;
    }
    return !collinear(t[0], t[1], t[2]);
}

/// Makes equal points one; leaves out triangles without area and repeated ones.
inline Mesh clean(const Mesh& soup) {
    Mesh mesh;
    std::map<std::array<unsigned char, 24>, unsigned> index;
    const auto welded = [&](Point p) {
        if (planted(4)) // nearly equal ones
            for (unsigned v = 0; v < mesh.points.size(); ++v)
                if (std::abs(mesh.points[v][0] - p[0]) + std::abs(mesh.points[v][1] - p[1]) +
                        std::abs(mesh.points[v][2] - p[2]) <
                    1e-9)
                    return v;
        if (!planted(3))
            for (double& x : p) x += 0.0; // -0 is 0
        std::array<unsigned char, 24> bits{};
        std::memcpy(bits.data(), p.data(), bits.size());
        const auto [at, is_new] = index.try_emplace(bits, unsigned(mesh.points.size()));
        if (is_new) mesh.points.push_back(p);
        return at->second;
    };
    std::set<Triangle> seen;
    for (const Triangle& t : soup.triangles) {
        if (!has_area(corners_of(soup, t))) continue;
        const Triangle corners{welded(soup.points[t[0]]), welded(soup.points[t[1]]),
                               welded(soup.points[t[2]])};
        Triangle key = corners;
        if (planted(7)) // turned ones
            std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
        else
            std::sort(key.begin(), key.end());
        if (seen.insert(key).second) mesh.triangles.push_back(corners);
    }
    return mesh;
}

/// Counts the edges with an odd number of triangles, and those whose triangles run the same way.
inline std::pair<std::size_t, std::size_t> open_and_turned(const Mesh& mesh) {
    std::map<Edge, std::pair<int, int>>
        edges; // number of triangles, those that run along minus the others
    for (const Triangle& t : mesh.triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const unsigned a = t[i], b = t[(i + 1) % 3];
            auto& [count, sum] = edges[{std::min(a, b), std::max(a, b)}];
            ++count;
            sum += a < b ? 1 : -1;
        }
    std::pair<std::size_t, std::size_t> found;
    for (const auto& [edge, of_edge] : edges) {
        const auto [count, sum] = of_edge;
        found.first += planted(15) ? count == 1 : count % 2 == 1;
        found.second += sum != 0 && (planted(16) ? count == 2 : count % 2 == 0);
    }
    return found;
}

/// Returns six times the volume within a closed mesh.
inline double six_volumes(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        const double part =
            determinant<double>({0, 0, 0}, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
        sum += planted(17) ? std::abs(part) : part;
    }
    return sum;
}

/// Returns how often a closed mesh goes round a point that is not on it, by the triangles above it.
inline int winding_number(const Mesh& mesh, const Point& p) {
    int sum = 0;
    for (const Triangle& t : mesh.triangles) {
        int round = 0; // how often the triangle's border goes round the point, seen from above
        for (unsigned i = 0; i < 3; ++i) {
            const Point &a = mesh.points[t[i]], &b = mesh.points[t[(i + 1) % 3]];
            const bool from = a[1] <= p[1], to = planted(18) ? b[1] < p[1] : b[1] <= p[1];
            if (from && !to && turn(a, b, p, 2) > 0) ++round;
            if (!from && to && turn(a, b, p, 2) < 0) --round;
        }
        const Corners c = corners_of(mesh, t);
        if (round != 0 && side(c[0], c[1], c[2], p) * round < 0) sum += round;
    }
    return sum;
}

} // namespace engine
