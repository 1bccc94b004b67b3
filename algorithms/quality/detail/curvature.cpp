// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/curvature.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>

namespace terrane::quality::detail {
namespace {

/// The shape of a sheet around one of its vertices.
struct Surroundings {
    std::uint32_t sheet = none;
    Point3 normal{}; ///< sum of the cross products of the triangles
    Point3 centre{}; ///< their centre
};

class TurnFinder {
public:
    TurnFinder(const Mesh& mesh, const Features& features, std::span<const double> reach) :
        mesh_(mesh), features_(features), reach_(reach), star_(mesh.vertices.size()),
        around_(mesh.vertices.size()), seen_(features.triangles.size(), 0) {
        for (std::uint32_t t = 0; t < features.triangles.size(); ++t)
            for (const std::uint32_t v : features.triangles[t]) star_[v].push_back(t);
    }

    std::vector<double> operator()() {
        for (std::uint32_t v = 0; v < star_.size(); ++v)
            for (const std::uint32_t t : star_[v])
                if (find(v, features_.sheet_of[t]) == nullptr) {
                    collect(v, features_.sheet_of[t]);
                    around_[v].push_back(surroundings(features_.sheet_of[t]));
                }
        std::vector<double> turns(star_.size(), 0);
        for (std::uint32_t v = 0; v < star_.size(); ++v)
            for (const Surroundings& here : around_[v]) {
                collect(v, here.sheet);
                turns[v] = std::max(turns[v], largest_turn(v, here));
            }
        return turns;
    }

private:
    [[nodiscard]] const Surroundings* find(std::uint32_t v, std::uint32_t sheet) const {
        const auto at = std::find_if(around_[v].begin(), around_[v].end(),
                                     [&](const Surroundings& s) { return s.sheet == sheet; });
        return at == around_[v].end() ? nullptr : &*at;
    }

    [[nodiscard]] double distance(std::uint32_t v, std::uint32_t u) const {
        return length(minus(mesh_.vertices[u], mesh_.vertices[v]));
    }

    /// Collects the triangles of the sheet at v and those reached from there that have a corner
    /// within half of the reach.
    void collect(std::uint32_t v, std::uint32_t sheet) {
        ++number_;
        near_.clear();
        const auto add = [&](std::uint32_t t) {
            if (t == none || seen_[t] == number_) return;
            seen_[t] = number_;
            near_.push_back(t);
        };
        for (const std::uint32_t t : star_[v])
            if (features_.sheet_of[t] == sheet) add(t);
        for (std::size_t k = 0; k < near_.size() && near_.size() < constants.turn_triangles; ++k) {
            const Triangle& c = features_.triangles[near_[k]];
            for (std::size_t i = 0; i < 3; ++i)
                if (2 * std::min(distance(v, c[i]), distance(v, c[(i + 1) % 3])) < reach_[v])
                    add(features_.across[near_[k]][i]);
        }
    }

    [[nodiscard]] Surroundings surroundings(std::uint32_t sheet) const {
        Surroundings s{sheet, {}, {}};
        double whole = 0;
        for (const std::uint32_t t : near_) {
            const auto& [i, j, k] = features_.triangles[t];
            const Point3 &a = mesh_.vertices[i], &b = mesh_.vertices[j], &c = mesh_.vertices[k];
            const Point3 n = cross(minus(b, a), minus(c, a));
            const double weight = length(n);
            s.normal = {s.normal.x + n.x, s.normal.y + n.y, s.normal.z + n.z};
            s.centre = {s.centre.x + weight * (a.x + b.x + c.x) / 3,
                        s.centre.y + weight * (a.y + b.y + c.y) / 3,
                        s.centre.z + weight * (a.z + b.z + c.z) / 3};
            whole += weight;
        }
        if (whole > 0) s.centre = {s.centre.x / whole, s.centre.y / whole, s.centre.z / whole};
        return s;
    }

    /// Compares v with the corners of the collected triangles that are at least half of the reach
    /// away; if none is, with the farthest.
    [[nodiscard]] double largest_turn(std::uint32_t v, const Surroundings& here) const {
        double farthest = 0, largest = 0;
        for (const std::uint32_t t : near_)
            for (const std::uint32_t u : features_.triangles[t])
                farthest = std::max(farthest, distance(v, u));
        const double least = std::min(farthest, reach_[v] / 2);
        for (const std::uint32_t t : near_)
            for (const std::uint32_t u : features_.triangles[t]) {
                if (u == v || distance(v, u) < least) continue;
                const Surroundings* const there = find(u, here.sheet);
                const double way = length(minus(there->centre, here.centre));
                if (!(way > least / 4)) continue; // both have almost the same triangles
                const double angle = std::atan2(length(cross(here.normal, there->normal)),
                                                dot(here.normal, there->normal));
                largest = std::max(largest, angle / way);
            }
        return largest;
    }

    const Mesh& mesh_;
    const Features& features_;
    std::span<const double> reach_;
    std::vector<std::vector<std::uint32_t>> star_;  ///< per vertex: its triangles
    std::vector<std::vector<Surroundings>> around_; ///< per vertex: one for each of its sheets
    std::vector<std::uint32_t> seen_;               ///< per triangle: the last collection with it
    std::vector<std::uint32_t> near_;               ///< the triangles collected last
    std::uint32_t number_ = 0;
};

} // namespace

std::vector<double> turns_per_length(const Mesh& mesh, const Features& features,
                                     std::span<const double> reach) {
    return TurnFinder(mesh, features, reach)();
}

} // namespace terrane::quality::detail
