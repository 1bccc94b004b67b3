// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/contact_clusters.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>

namespace terrane::rounding::detail {
namespace {

using TrianglePair = std::pair<std::uint32_t, std::uint32_t>; ///< input triangles

/// A direction, and the number of contacts, triangles or edges across it.
struct Direction {
    Point3 normal;
    std::size_t count = 0;
};

/// Of a cluster: its points, and the number of its contacts.
struct Cluster {
    std::vector<std::uint32_t> points{};
    std::size_t contacts = 0;
};

/// Least height of a triangle whose normal counts, in tolerances.
constexpr double least_height = 64;
/// Least distance from a plane of a direction outside of it.
constexpr double least_independence = 0.05;
constexpr std::size_t most_directions = 64;

Point3 scaled(const Point3& v, double factor) {
    return {v.x * factor, v.y * factor, v.z * factor};
}

/// Joins input triangles to clusters, and finds the plane of each.
class Clusters {
public:
    Clusters(std::span<const Triangle> corners, std::span<const Point3> points, double tolerance) :
        corners_(corners), points_(points), tolerance_(tolerance), sets_(corners.size()) {}

    void join(std::span<const TrianglePair> pairs) {
        for (const auto& [p, q] : pairs) {
            in_contact_.insert(in_contact_.end(), {p, q});
            if (touches(p, q)) touched_.push_back(p);
            if (touches(q, p)) touched_.push_back(q);
            if (!are_coplanar(p, q)) continue;
            sets_.join(p, q);
            joined_.emplace_back(p, q);
        }
        sort_unique(in_contact_);
        sort_unique(touched_);
    }

    /// Returns the directions of the planes of all clusters, each once.
    std::vector<Direction> of_planes() {
        std::map<std::uint32_t, Cluster> clusters;
        for (const auto& [p, q] : joined_) {
            Cluster& c = clusters[sets_.find(p)];
            ++c.contacts;
            for (const std::uint32_t t : {p, q})
                c.points.insert(c.points.end(), corners_[t].begin(), corners_[t].end());
        }
        std::vector<Direction> all;
        for (auto& [first, c] : clusters) {
            sort_unique(c.points);
            add_to(all, c);
        }
        return all;
    }

    [[nodiscard]] std::span<const std::uint32_t> in_contact() const { return in_contact_; }
    /// Returns the triangles whose plane has a corner of another one that is in contact.
    [[nodiscard]] std::span<const std::uint32_t> touched() const { return touched_; }

    /// Returns the directions of the planes of these triangles, each once.
    [[nodiscard]] std::vector<Direction>
    of_triangles(std::span<const std::uint32_t> triangles) const {
        std::vector<Direction> all;
        for (const std::uint32_t t : triangles) {
            const auto& c = corners_[t];
            const auto fits = [&](const Point3& n) { return is_flat(c, n, points_[c[0]]); };
            add(all, fits, [&] { return normal_of(c[0], c[1], c[2]); });
        }
        return all;
    }

    /// Returns the directions in a plane that are across edges of triangles in contact, each once.
    [[nodiscard]] std::vector<Direction> across_edges(const Point3& plane) const {
        std::vector<Direction> all;
        for (const std::uint32_t t : in_contact_) {
            const auto& c = corners_[t];
            if (!is_flat(c, plane, points_[c[0]])) continue;
            for (unsigned i = 0; i < 3; ++i) {
                const Point3 edge = minus(points_[c[(i + 1) % 3]], points_[c[i]]);
                if (!(length(edge) > least_height * tolerance_)) continue;
                const Point3 n = cross(plane, edge);
                add(
                    all, [&](const Point3& m) { return std::fabs(dot(m, edge)) <= tolerance_; },
                    [&] { return std::optional(scaled(n, 1 / length(n))); });
            }
        }
        return all;
    }

private:
    /// Counts one for the first direction that fits, or adds one.
    template <class Fits, class Make>
    static void add(std::vector<Direction>& all, const Fits& fits, const Make& make) {
        const auto known = std::find_if(all.begin(), all.end(),
                                        [&](const Direction& d) { return fits(d.normal); });
        if (known != all.end())
            ++known->count;
        else if (all.size() < most_directions)
            if (const std::optional<Point3> fresh = make()) all.push_back({*fresh, 1});
    }

    /// Returns the unit normal of a triangle that is high enough to have one.
    [[nodiscard]] std::optional<Point3> normal_of(std::uint32_t p, std::uint32_t q,
                                                  std::uint32_t r) const {
        const Point3 u = minus(points_[q], points_[p]), v = minus(points_[r], points_[p]);
        const Point3 n = cross(u, v);
        const double area = length(n);
        const double longest = std::max({length(u), length(v), length(minus(u, v))});
        if (!(area > least_height * tolerance_ * longest)) return std::nullopt;
        return scaled(n, 1 / area);
    }

    template <class Range>
    [[nodiscard]] bool is_flat(const Range& points, const Point3& normal,
                               const Point3& origin) const {
        return std::all_of(points.begin(), points.end(), [&](std::uint32_t v) {
            return std::fabs(dot(normal, minus(points_[v], origin))) <= tolerance_;
        });
    }

    /// Tells whether a corner of u that t does not have is in the plane of t.
    [[nodiscard]] bool touches(std::uint32_t t, std::uint32_t u) const {
        const auto& c = corners_[t];
        const auto n = normal_of(c[0], c[1], c[2]);
        return n && std::any_of(corners_[u].begin(), corners_[u].end(), [&](std::uint32_t v) {
                   return std::find(c.begin(), c.end(), v) == c.end() &&
                          is_flat(std::array{v}, *n, points_[c[0]]);
               });
    }

    [[nodiscard]] bool are_coplanar(std::uint32_t t, std::uint32_t u) const {
        const auto of = [&](std::uint32_t i) {
            return normal_of(corners_[i][0], corners_[i][1], corners_[i][2]);
        };
        const auto n = of(t), m = of(u);
        return n && m &&
               (is_flat(corners_[u], *n, points_[corners_[t][0]]) ||
                is_flat(corners_[t], *m, points_[corners_[u][0]]));
    }

    /// Returns the normal of the plane through three points of a cluster that are far apart: the
    /// errors of their doubles turn it least.
    [[nodiscard]] std::optional<Point3> plane_of(std::span<const std::uint32_t> all) const {
        const auto farthest = [&](const auto& distance) {
            return *std::max_element(all.begin(), all.end(), [&](std::uint32_t v, std::uint32_t w) {
                return distance(v) < distance(w);
            });
        };
        const auto from = [&](std::uint32_t v) {
            return [this, v](std::uint32_t w) { return length(minus(points_[w], points_[v])); };
        };
        const std::uint32_t p = farthest(from(all[0])), q = farthest(from(p));
        const Point3 along = minus(points_[q], points_[p]);
        const std::uint32_t r = farthest(
            [&](std::uint32_t v) { return length(cross(along, minus(points_[v], points_[p]))); });
        const auto normal = normal_of(p, q, r);
        return normal && is_flat(all, *normal, points_[p]) ? normal : std::nullopt;
    }

    void add_to(std::vector<Direction>& all, const Cluster& c) const {
        for (Direction& known : all)
            if (is_flat(c.points, known.normal, points_[c.points[0]])) {
                known.count += c.contacts;
                return;
            }
        if (all.size() == most_directions) return;
        if (const auto normal = plane_of(c.points)) all.push_back({*normal, c.contacts});
    }

    std::span<const Triangle> corners_;
    std::span<const Point3> points_;
    const double tolerance_;
    DisjointSets sets_;
    std::vector<TrianglePair> joined_{};
    std::vector<std::uint32_t> in_contact_{}, touched_{}; // ascending
};

/// Tells whether a direction is out of the plane of those that are chosen.
bool is_independent(std::span<const Point3> chosen, const Point3& n) {
    if (chosen.size() == 1) return length(cross(chosen[0], n)) > least_independence;
    if (chosen.size() == 2)
        return std::fabs(dot(cross(chosen[0], chosen[1]), n)) > least_independence;
    return chosen.empty();
}

/// Adds the most frequent directions, until there are three. Returns whether these have most of all counts.
bool choose(std::vector<Point3>& chosen, std::vector<Direction> from) {
    std::stable_sort(from.begin(), from.end(),
                     [](const Direction& d, const Direction& e) { return d.count > e.count; });
    double all = 0, of_chosen = 0;
    for (const Direction& d : from) {
        all += static_cast<double>(d.count);
        if (!is_independent(chosen, d.normal)) continue;
        chosen.push_back(d.normal);
        of_chosen += static_cast<double>(d.count);
    }
    return of_chosen >= rounding_tuning.cluster_share * all;
}

} // namespace

std::vector<Point3> cluster_directions(std::span<const Triangle> corners,
                                       std::span<const Point3> points,
                                       const ParentsInContact& in_contact, double tolerance) {
    Clusters clusters(corners, points, tolerance);
    clusters.join(in_contact.pairs);
    std::vector<Point3> chosen;
    if (!choose(chosen, clusters.of_planes())) return {};
    choose(chosen, clusters.of_triangles(clusters.touched()));
    if (chosen.empty()) return chosen;
    choose(chosen, clusters.of_triangles(clusters.in_contact()));
    choose(chosen, clusters.across_edges(chosen[0]));
    return chosen;
}

double spacing_at(double largest, int digits) {
    if (!(largest > 0)) return std::numeric_limits<double>::min();
    return std::ldexp(1.0, std::max(std::ilogb(largest) - 52, -1074) + digits);
}

double cluster_tolerance(double largest) {
    return rounding_tuning.cluster_spacings * spacing_at(largest);
}

} // namespace terrane::rounding::detail
