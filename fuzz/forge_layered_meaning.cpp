// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The meaning of layers: their heights at many places, computed as `terrane layer` promises them,
// from the hardest layer to the softest.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "forge_geometry.hpp"
#include "forge_meaning.hpp"

namespace terrane::fuzz {

namespace {

using Corners3 = std::array<Point3, 3>;

/// A triangle over or under a place.
struct Over {
    double height = 0;
    bool faces_up = false;
};

/// Returns twice the area in the projection along z, positive if counterclockwise.
double plan_area(const Point3& a, const Point3& b, const Point3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns the height of a triangle at a place; none where it is not. `near_side` is set if that
/// depends on rounding.
std::optional<Over> over(const Corners3& t, const Point3& place, double width, bool& near_side) {
    const auto [west, east] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [south, north] = std::minmax({t[0].y, t[1].y, t[2].y});
    if (place.x < west - 2 * width || place.x > east + 2 * width || place.y < south - 2 * width ||
        place.y > north + 2 * width)
        return std::nullopt;
    const double whole = plan_area(t[0], t[1], t[2]);
    bool inside = true, close = true;
    double height = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point3 &u = t[(i + 1) % 3], &v = t[(i + 2) % 3];
        const double part = whole < 0 ? -plan_area(place, u, v) : plan_area(place, u, v);
        const double slack = width * (std::hypot(v.x - u.x, v.y - u.y) + width);
        inside = inside && part > 0;
        close = close && part > -slack;
        if (close && part < slack) near_side = true;
        height += t[i].z * part;
    }
    if (!close) near_side = false;
    if (!inside || std::abs(whole) < 1e-30) return std::nullopt;
    return Over{height / std::abs(whole), whole > 0};
}

/// The horizons of a claim, in its order.
struct Horizons {
    std::vector<std::vector<Corners3>> triangles;
    std::vector<std::uint32_t> from_hardest; ///< layers

    Horizons(const Subject& s, const LayeredClaim& claim) {
        for (const CertifiedLayer& layer : claim.order) {
            const Surface& surface = s.surfaces[layer.surface];
            auto& list = triangles.emplace_back();
            for (const Triangle& t : surface.triangles)
                list.push_back(corners(surface.vertices, t));
        }
        from_hardest.resize(claim.order.size());
        std::iota(from_hardest.begin(), from_hardest.end(), 0U);
        std::ranges::stable_sort(from_hardest, [&](std::uint32_t i, std::uint32_t j) {
            return claim.order[i].hardness > claim.order[j].hardness;
        });
    }
};

/// The surfaces over a place: a layer lies on the harder ones that leave no room for it.
struct LayerColumn {
    std::vector<std::optional<Over>> own, right; ///< per layer: its surface; where it must be
    bool near_side = false;                      ///< rounding may decide which
};

LayerColumn column_at(const Horizons& horizons, const Point3& place, double width) {
    LayerColumn column;
    for (const auto& list : horizons.triangles) {
        std::optional<Over> found;
        for (const Corners3& t : list) {
            bool near_side = false;
            if (const auto o = over(t, place, width, near_side)) found = o;
            column.near_side = column.near_side || near_side;
        }
        column.own.push_back(found);
    }
    column.right.resize(column.own.size());
    for (const std::uint32_t i : horizons.from_hardest) { // the others have none yet
        if (!column.own[i]) continue;
        double ceiling = HUGE_VAL, floor = -HUGE_VAL;
        for (std::uint32_t j = 0; j < i; ++j)
            if (column.right[j]) ceiling = std::min(ceiling, column.right[j]->height);
        for (std::uint32_t j = i + 1; j < column.right.size(); ++j)
            if (column.right[j]) floor = std::max(floor, column.right[j]->height);
        Over place_of_layer = *column.own[i];
        double& z = place_of_layer.height;
        z = std::min(ceiling, std::max(floor, z));
        column.right[i] = place_of_layer;
    }
    return column;
}

class LayersJudge {
public:
    LayersJudge(const Subject& s, const LayeredClaim& claim, double accepted) :
        claim_(claim), horizons_(s, claim), accepted_(accepted) {
        for (const Triangle& t : claim.triangles) triangles_.push_back(corners(claim.vertices, t));
        thickness_ = claim.thickness.value_or(0);
        width_ = 1e-8 + 4 * accepted;
        slack_ = 1e-9 + 64 * accepted; // for slopes below 16
    }

    std::string difference() const {
        if (claim_.thickness && !(thickness_ > 0 && std::isfinite(thickness_)))
            return "the thickness";
        if (auto flaw = areas_flaw(); !flaw.empty()) return flaw;
        for (const Point3& place : places())
            if (auto flaw = flaw_at(place); !flaw.empty()) return flaw;
        return "";
    }

private:
    /// A layer has the area of its surface, in the projection.
    std::string areas_flaw() const {
        std::vector<double> area(claim_.order.size());
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (const std::uint32_t i : claim_.surfaces_of[t])
                area[i] +=
                    std::abs(plan_area(triangles_[t][0], triangles_[t][1], triangles_[t][2])) / 2;
        for (std::size_t i = 0; i < area.size(); ++i) {
            double whole = 0, around = 0;
            for (const Corners3& t : horizons_.triangles[i]) {
                whole += std::abs(plan_area(t[0], t[1], t[2])) / 2;
                around += perimeter(t);
            }
            if (std::abs(whole - area[i]) > 1e-9 * whole + 64 * accepted_ * around)
                return "the area of a layer";
        }
        return "";
    }

    /// Places inside of all triangles, in their middles and near their corners, and on a lattice.
    std::vector<Point3> places() const {
        std::vector<Point3> result;
        const auto add = [&](const Corners3& t) {
            for (const auto& w : {Point3{0.34, 0.31, 0.35}, Point3{0.93, 0.033, 0.037},
                                  Point3{0.033, 0.93, 0.037}, Point3{0.037, 0.033, 0.93}})
                result.push_back({w.x * t[0].x + w.y * t[1].x + w.z * t[2].x,
                                  w.x * t[0].y + w.y * t[1].y + w.z * t[2].y, 0});
        };
        for (const Corners3& t : triangles_) add(t);
        for (const auto& list : horizons_.triangles)
            for (const Corners3& t : list) add(t);
        for (int i = 0; i < 16; ++i)
            for (int j = 0; j < 16; ++j) result.push_back({-1 + 0.3141 * i, -1 + 0.2997 * j, 0});
        return result;
    }

    /// Tells whether a triangle has the height of a surface, moved up, and faces the same side.
    bool faces_as(const Over& own, const Over& o, double moved) const {
        return own.faces_up == o.faces_up && std::abs(own.height + moved - o.height) <= slack_;
    }

    std::string flaw_at(const Point3& place) const {
        const LayerColumn column = column_at(horizons_, place, width_);
        if (column.near_side) return "";
        std::vector<std::size_t> times(column.own.size());
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            bool near_side = false;
            const auto o = over(triangles_[t], place, 1e-12, near_side);
            if (near_side) return "";
            if (!o) continue;
            bool right_side = false;
            for (const std::uint32_t i : claim_.surfaces_of[t]) {
                ++times[i];
                if (!column.right[i]) return "where a layer exists";
                // With a thickness, which height a layer has is not judged.
                if (!(thickness_ > 0) && std::abs(column.right[i]->height - o->height) > slack_)
                    return "the height of a layer";
                right_side = right_side || faces_as(*column.own[i], *o, 0);
            }
            if (thickness_ > 0)
                for (const auto& own : column.own) // moved by multiples of the thickness
                    for (std::size_t steps = 0; own && steps <= column.own.size(); ++steps)
                        right_side = right_side ||
                                     faces_as(*own, *o, thickness_ * static_cast<double>(steps)) ||
                                     faces_as(*own, *o, -thickness_ * static_cast<double>(steps));
            if (!right_side) return "the side of a layer";
        }
        for (std::size_t i = 0; i < times.size(); ++i)
            if (times[i] != (column.own[i] ? 1 : 0)) return "where a layer exists";
        return "";
    }

    const LayeredClaim& claim_;
    Horizons horizons_;
    std::vector<Corners3> triangles_;
    double accepted_ = 0;
    double thickness_ = 0;
    double width_ = 0; ///< of the strips along sides that are left out
    double slack_ = 0; ///< of heights
};

} // namespace

std::string difference_of_layers(const Subject& s, const LayeredClaim& claim, double accepted) {
    if (!is_conforming(claim.vertices, claim.triangles)) return "whether the layers are conforming";
    return LayersJudge(s, claim, accepted).difference();
}

} // namespace terrane::fuzz
