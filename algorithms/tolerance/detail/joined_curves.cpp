// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tolerance/detail/joined_curves.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/tolerance/detail/creases.hpp>

namespace terrane::tolerance::detail {
namespace {

Point3 nearest_on(const EdgeEnds& s, const Point3& p) {
    const Point3 d = minus(s[1], s[0]);
    const double square = dot(d, d);
    return along(s[0], square > 0 ? std::clamp(dot(minus(p, s[0]), d) / square, 0.0, 1.0) : 0.0, d);
}

Point3 least_of(const EdgeEnds& s) {
    return {std::min(s[0].x, s[1].x), std::min(s[0].y, s[1].y), std::min(s[0].z, s[1].z)};
}
Point3 most_of(const EdgeEnds& s) {
    return {std::max(s[0].x, s[1].x), std::max(s[0].y, s[1].y), std::max(s[0].z, s[1].z)};
}

/// The curves of the surfaces so far, in the cubes of a grid.
class Curves {
public:
    Curves(double size, double bound) : size_(size), bound_(bound) {}

    void add(const EdgeEnds& s, std::size_t surface) {
        for (const Point3& p : s) points_[cube_of(p)].insert(p);
        if (auto& owners = surfaces_[s]; owners.insert(surface).second && owners.size() == 1)
            for_cubes(least_of(s), most_of(s), 0, [&](const Cube& c) { segments_[c].insert(s); });
    }
    /// Divides a segment; returns the surfaces that have it.
    std::set<std::size_t> divide(const EdgeEnds& s, const Point3& place) {
        std::set<std::size_t> owners = std::move(surfaces_[s]);
        surfaces_.erase(s);
        for_cubes(least_of(s), most_of(s), 0, [&](const Cube& c) { segments_[c].erase(s); });
        for (const std::size_t surface : owners) {
            add(ends_of(s[0], place), surface);
            add(ends_of(place, s[1]), surface);
        }
        return owners;
    }
    [[nodiscard]] std::optional<Point3> nearest_point(const Point3& p) const {
        return nearest(points_, p, [](const Point3& q) { return q; });
    }
    [[nodiscard]] std::optional<EdgeEnds> nearest_edge(const Point3& p) const {
        return nearest(segments_, p, [&](const EdgeEnds& s) { return nearest_on(s, p); });
    }
    /// Returns the points that are near the inside of a segment, ascending from its first end.
    [[nodiscard]] std::vector<Point3> points_along(const EdgeEnds& s) const {
        std::set<Point3> found;
        for_cubes(least_of(s), most_of(s), bound_, [&](const Cube& c) {
            const auto at = points_.find(c);
            if (at == points_.end()) return;
            for (const Point3& p : at->second) {
                const Point3 q = nearest_on(s, p);
                if (distance_between(p, q) < bound_ && distance_between(q, s[0]) >= bound_ &&
                    distance_between(q, s[1]) >= bound_)
                    found.insert(p);
            }
        });
        std::vector<Point3> list(found.begin(), found.end());
        std::ranges::stable_sort(list, {},
                                 [&](const Point3& p) { return distance_between(s[0], p); });
        return list;
    }

private:
    using Cube = std::array<double, 3>; ///< of whole numbers

    [[nodiscard]] Cube cube_of(const Point3& p) const {
        return {std::floor(p.x / size_), std::floor(p.y / size_), std::floor(p.z / size_)};
    }
    template <class Visit>
    void for_cubes(const Point3& low, const Point3& high, double more, const Visit& visit) const {
        const Cube a = cube_of({low.x - more, low.y - more, low.z - more});
        const Cube b = cube_of({high.x + more, high.y + more, high.z + more});
        for (double x = a[0]; x <= b[0]; ++x)
            for (double y = a[1]; y <= b[1]; ++y)
                for (double z = a[2]; z <= b[2]; ++z) visit(Cube{x, y, z});
    }
    /// Returns the nearest one, the least among equals.
    template <class T, class PlaceOf>
    [[nodiscard]] std::optional<T> nearest(const std::map<Cube, std::set<T>>& all, const Point3& p,
                                           const PlaceOf& place_of) const {
        std::optional<std::pair<double, T>> best;
        for_cubes(p, p, bound_, [&](const Cube& c) {
            const auto at = all.find(c);
            if (at == all.end()) return;
            for (const T& one : at->second) {
                const std::pair found(distance_between(p, place_of(one)), one);
                if (found.first < bound_ && (!best || found < *best)) best = found;
            }
        });
        return best ? std::optional(best->second) : std::nullopt;
    }

    const double size_, bound_;
    std::map<Cube, std::set<Point3>> points_;
    std::map<Cube, std::set<EdgeEnds>> segments_;
    std::map<EdgeEnds, std::set<std::size_t>> surfaces_; ///< that have a segment
};

/// A surface whose borders and creases can be divided.
class Creased {
public:
    Creased(Surface& surface) : s_(surface) {
        for (const SurfaceEdge& e : edges_of(surface))
            if (e.is_crease)
                for (const SurfaceEdge::Side& side : e.sides)
                    triangles_[e.ends].push_back(side.triangle);
    }
    [[nodiscard]] std::vector<EdgeEnds> curves() const {
        std::vector<EdgeEnds> list;
        for (const auto& [edge, triangles] : triangles_) list.push_back(edge);
        return list;
    }
    /// Divides an edge, which gets vertices at these places, in the order from its first end.
    void divide(const EdgeEnds& edge, std::span<const Point3> places) {
        const auto first = static_cast<std::uint32_t>(s_.vertices.size());
        s_.vertices.insert(s_.vertices.end(), places.begin(), places.end());
        const auto at = triangles_.extract(edge);
        for (const std::uint32_t t : at.mapped())
            for (unsigned k = 0; k < 3; ++k) {
                const auto [a, b, c] = std::array{s_.triangles[t][k], s_.triangles[t][(k + 1) % 3],
                                                  s_.triangles[t][(k + 2) % 3]};
                if (ends_of(s_.vertices[a], s_.vertices[b]) != edge) continue;
                std::vector<std::uint32_t> chain(places.size());
                std::iota(chain.begin(), chain.end(), first);
                if (s_.vertices[a] != edge[0]) std::ranges::reverse(chain);
                chain.insert(chain.begin(), a);
                chain.push_back(b);
                replace(t, chain, c);
                break;
            }
    }

private:
    /// Replaces a triangle by those between a chain and a vertex.
    void replace(std::uint32_t t, std::span<const std::uint32_t> chain, std::uint32_t apex) {
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            const auto part = i == 0 ? t : static_cast<std::uint32_t>(s_.triangles.size());
            if (i != 0) s_.triangles.emplace_back();
            s_.triangles[part] = {chain[i], chain[i + 1], apex};
            triangles_[between(chain[i], chain[i + 1])].push_back(part);
        }
        const auto last = triangles_.find(between(chain.back(), apex));
        if (last != triangles_.end())
            std::ranges::replace(last->second, t,
                                 static_cast<std::uint32_t>(s_.triangles.size() - 1));
    }
    [[nodiscard]] EdgeEnds between(std::uint32_t a, std::uint32_t b) const {
        return ends_of(s_.vertices[a], s_.vertices[b]);
    }

    Surface& s_;
    std::map<EdgeEnds, std::vector<std::uint32_t>> triangles_; ///< of borders and creases
};

/// Joins the curves of surface after surface to those before.
class CurveJoining {
public:
    explicit CurveJoining(Curves curves) : curves_(std::move(curves)) {}

    /// Returns the number of vertices that moved. The surface must stay where it is.
    std::size_t add(Surface& s) {
        std::map<Point3, Point3> places;
        for (const SurfaceEdge& e : edges_of(s))
            if (e.is_crease)
                for (const Point3& p : e.ends)
                    if (!places.contains(p)) places.emplace(p, place_for(p));
        for (Point3& p : s.vertices)
            if (const auto at = places.find(p); at != places.end()) p = at->second;
        std::erase_if(s.triangles, [&](const Triangle& t) {
            const Point3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
            return a == b || b == c || c == a;
        });
        Creased& creased = surfaces_.emplace_back(s);
        for (const EdgeEnds& edge : creased.curves())
            if (const auto near = curves_.points_along(edge); !near.empty())
                creased.divide(edge, near);
        for (const EdgeEnds& edge : creased.curves()) curves_.add(edge, surfaces_.size() - 1);
        return static_cast<std::size_t>(std::ranges::count_if(
            places, [](const auto& move) { return move.first != move.second; }));
    }

private:
    Point3 place_for(const Point3& p) {
        if (const auto point = curves_.nearest_point(p)) return *point;
        const auto on = curves_.nearest_edge(p);
        if (!on) return p;
        const Point3 place = nearest_on(*on, p);
        if (place != (*on)[0] && place != (*on)[1])
            for (const std::size_t surface : curves_.divide(*on, place))
                surfaces_[surface].divide(*on, std::span(&place, 1));
        return place;
    }

    Curves curves_;
    std::vector<Creased> surfaces_;
};

} // namespace

std::size_t join_curves(std::vector<Surface>& surfaces, double bound) {
    double edges = 0;
    std::size_t count = 0, moved = 0;
    for (const Surface& s : surfaces)
        for (const Triangle& t : s.triangles) {
            edges += distance_between(s.vertices[t[0]], s.vertices[t[1]]);
            ++count;
        }
    if (count == 0) return 0;
    CurveJoining joining(Curves(std::max(2 * bound, edges / static_cast<double>(count)), bound));
    for (Surface& s : surfaces) moved += joining.add(s);
    return moved;
}

} // namespace terrane::tolerance::detail
