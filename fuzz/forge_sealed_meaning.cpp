// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The promises of a certificate of sealed surfaces (docs/reference/certificate.md), in floating
// point: only the stated triangles were added, they lead from the border of their surface to where
// it ends on something, what is missing lies beyond such a place, and all of that within the
// limits.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>

#include "forge_geometry.hpp"
#include "forge_meaning.hpp"

namespace terrane::fuzz {

namespace {

using Corners = std::array<Point3, 3>;
using Ids = std::vector<std::uint32_t>;

/// An input triangle as the certificate has it.
struct Input {
    std::uint32_t surface = 0;
    enum class Origin { given, extended, sealed, boundary } origin = Origin::given;
    Corners at{};
};

std::vector<Input> inputs_of(const Subject& s, const Certificate& c) {
    std::vector<Input> inputs;
    const auto surfaces = arranged_surfaces(s, c);
    const std::size_t own = c.sealed->surfaces.size();
    for (std::uint32_t k = 0; k < surfaces.size(); ++k) {
        const std::size_t all = surfaces[k].triangles.size();
        const std::size_t sealed = k < own ? c.sealed->surfaces[k].sealed.size() : 0;
        const std::size_t extended = k < own ? c.sealed->surfaces[k].extended.size() : 0;
        for (std::size_t t = 0; t < all; ++t) {
            auto origin = Input::Origin::given;
            if (k >= own)
                origin = Input::Origin::boundary;
            else if (t >= all - sealed)
                origin = Input::Origin::sealed;
            else if (t >= all - sealed - extended)
                origin = Input::Origin::extended;
            inputs.push_back({k, origin, corners(surfaces[k].vertices, surfaces[k].triangles[t])});
        }
    }
    return inputs;
}

Point3 middle_of(const Corners& t) {
    return {(t[0].x + t[1].x + t[2].x) / 3, (t[0].y + t[1].y + t[2].y) / 3,
            (t[0].z + t[1].z + t[2].z) / 3};
}

/// Tells whether a point is inside of a boundary, by the solid angle under which it is seen.
bool is_inside(const Point3& p, const std::vector<Corners>& boundary) {
    double angle = 0;
    for (const Corners& t : boundary) {
        const Point3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
        const double la = length(a), lb = length(b), lc = length(c);
        angle += 2 * std::atan2(dot(a, cross(b, c)),
                                la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return std::abs(angle) > 6.28;
}

/// The exact part of a certificate: what became of each triangle, and why.
class Sealed {
public:
    Sealed(const Subject& s, const Certificate& c) :
        c_(c), inputs_(inputs_of(s, c)),
        points_(points_of_exact(arranged_surfaces(s, c), c.exact)) {
        std::vector<Corners> boundary;
        for (const Input& input : inputs_)
            if (input.origin == Input::Origin::boundary) boundary.push_back(input.at);
        for (std::uint32_t t = 0; t < c.exact.triangles.size(); ++t) {
            const auto at = corners(points_, c.exact.triangles[t]);
            Part& part = parts_.emplace_back();
            part.is_dropped = std::ranges::count(c.cut->dropped, t) > 0;
            for (const std::uint32_t p : c.exact.parents_of[t]) {
                const Input& input = inputs_[p];
                const bool added = input.origin == Input::Origin::extended ||
                                   input.origin == Input::Origin::sealed;
                part.surfaces.insert(input.surface);
                if (!added) part.given_for.insert(input.surface);
                part.is_boundary = part.is_boundary || input.origin == Input::Origin::boundary;
            }
            part.is_outside =
                !boundary.empty() && !part.is_boundary && !is_inside(middle_of(at), boundary);
            for (std::size_t i = 0; i < 3; ++i) {
                const auto [low, high] =
                    std::minmax(c.exact.triangles[t][i], c.exact.triangles[t][(i + 1) % 3]);
                at_edge_[{low, high}].push_back(t);
            }
        }
    }

    std::string flaw() {
        for (std::uint32_t t = 0; t < parts_.size(); ++t) {
            const Part& part = parts_[t];
            if (part.is_outside && !part.is_dropped) return "what is outside of the volume";
            if (part.is_boundary && part.is_dropped) return "what bounds the volume";
            const Point3 normal = area_vector(corners(points_, c_.exact.triangles[t]));
            const Point3 first = area_vector(inputs_[c_.exact.parents_of[t].front()].at);
            if (dot(normal, first) < -1e-12 * length(first)) return "a side";
        }
        if (is_any_far()) return "a limit";
        if (is_any_apart()) return "an added triangle that does not go on from its surface";
        if (is_any_detached()) return "a triangle added elsewhere than at the border";
        if (ends_free()) return "an added triangle that ends free";
        return trimmed_flaw();
    }

    /// Returns the area of what was kept of each input triangle, and its centroid times that.
    [[nodiscard]] std::vector<std::array<double, 4>> kept_moments() const {
        std::vector<std::array<double, 4>> sums(inputs_.size());
        for (std::uint32_t t = 0; t < parts_.size(); ++t)
            if (!parts_[t].is_dropped)
                for (const std::uint32_t p : c_.exact.parents_of[t])
                    add_moments(sums[p], corners(points_, c_.exact.triangles[t]));
        return sums;
    }

    static void add_moments(std::array<double, 4>& sum, const Corners& t) {
        const double area = length(area_vector(t));
        const Point3 middle = middle_of(t);
        sum[0] += area;
        sum[1] += area * middle.x;
        sum[2] += area * middle.y;
        sum[3] += area * middle.z;
    }

    [[nodiscard]] const std::vector<Input>& inputs() const { return inputs_; }

private:
    struct Part {
        std::set<std::uint32_t> surfaces{}, given_for{};
        bool is_dropped = false, is_outside = false, is_boundary = false;

        [[nodiscard]] bool is_added() const { return given_for.empty(); }
        [[nodiscard]] bool is_strip() const { return is_added() && !is_dropped; }
        [[nodiscard]] bool is_trimmed() const { return !is_added() && is_dropped && !is_outside; }
        [[nodiscard]] bool shares(const Part& other) const {
            return std::ranges::any_of(surfaces,
                                       [&](std::uint32_t s) { return other.surfaces.contains(s); });
        }
    };

    /// Tells whether some point of a triangle is farther from others than a limit: its corners, the
    /// middles of its sides, its centroid.
    static bool is_far(const Corners& t, const std::vector<Corners>& from, double limit) {
        std::vector<Point3> samples{t[0], t[1], t[2], middle_of(t)};
        for (std::size_t i = 0; i < 3; ++i)
            samples.push_back(along(t[i], t[(i + 1) % 3] - t[i], 0.5));
        return std::ranges::any_of(samples, [&](const Point3& p) {
            double nearest = HUGE_VAL;
            for (const Corners& other : from) nearest = std::min(nearest, distance(p, other));
            return nearest > limit * (1 + 1e-9) + 1e-12 * (1 + length(p));
        });
    }

    bool is_any_far() {
        for (std::uint32_t s = 0; s < c_.sealed->surfaces.size(); ++s) {
            std::vector<Corners> given, left;
            for (const Input& input : inputs_)
                if (input.surface == s && input.origin == Input::Origin::given)
                    given.push_back(input.at);
            for (std::uint32_t t = 0; t < parts_.size(); ++t)
                if (parts_[t].given_for.contains(s) && !parts_[t].is_trimmed())
                    left.push_back(corners(points_, c_.exact.triangles[t]));
            const double limit = c_.sealed->surfaces[s].limit;
            for (std::uint32_t t = 0; t < parts_.size(); ++t) {
                const Part& part = parts_[t];
                const auto at = corners(points_, c_.exact.triangles[t]);
                const bool added = part.surfaces.contains(s) && !part.given_for.contains(s);
                if (added && !part.is_dropped && is_far(at, given, limit)) return true;
                if (part.given_for.contains(s) && part.is_trimmed() && is_far(at, left, limit))
                    return true;
            }
        }
        return false;
    }

    /// Returns all triangles that can be reached from some, from neighbour to neighbour within a
    /// surface, over those that `leads` allows.
    std::set<std::uint32_t> reached(Ids from, const std::function<bool(const Part&)>& leads) const {
        std::set<std::uint32_t> seen(from.begin(), from.end());
        while (!from.empty()) {
            const std::uint32_t t = from.back();
            from.pop_back();
            for (std::size_t i = 0; i < 3; ++i) {
                const auto [low, high] =
                    std::minmax(c_.exact.triangles[t][i], c_.exact.triangles[t][(i + 1) % 3]);
                for (const std::uint32_t u : at_edge_.at({low, high}))
                    if (leads(parts_[u]) && parts_[t].shares(parts_[u]) && seen.insert(u).second)
                        from.push_back(u);
            }
        }
        return seen;
    }

    bool is_any_detached() {
        const auto leads = [](const Part& part) {
            return part.is_added() && (!part.is_dropped || part.is_outside);
        };
        Ids at_surface;
        for (const auto& [edge, at] : at_edge_)
            for (const std::uint32_t t : at)
                for (const std::uint32_t u : at)
                    if (leads(parts_[t]) && !parts_[u].is_trimmed() &&
                        std::ranges::any_of(parts_[u].given_for, [&](std::uint32_t s) {
                            return parts_[t].surfaces.contains(s);
                        }))
                        at_surface.push_back(t);
        const auto seen = reached(std::move(at_surface), leads);
        for (std::uint32_t t = 0; t < parts_.size(); ++t)
            if (parts_[t].is_strip() && !seen.contains(t)) return true;
        return false;
    }

    /// Tells whether an added triangle has no side that another one of its surface passes in the
    /// opposite direction.
    bool is_any_apart() const {
        return std::ranges::any_of(inputs_, [&](const Input& added) {
            return added.origin != Input::Origin::given &&
                   added.origin != Input::Origin::boundary &&
                   std::ranges::count_if(
                       added.at, [&](const Point3& p) { return was_there(p, added); }) != 1 &&
                   std::ranges::none_of(inputs_, [&](const Input& other) {
                       if (other.surface != added.surface) return false;
                       for (std::size_t i = 0; i < 9; ++i)
                           if (added.at[i % 3] == other.at[(i / 3 + 1) % 3] &&
                               added.at[(i + 1) % 3] == other.at[i / 3])
                               return true;
                       return false;
                   });
        });
    }

    /// Tells whether the surface had a vertex before a triangle was added.
    [[nodiscard]] bool was_there(const Point3& p, const Input& added) const {
        return std::ranges::any_of(inputs_, [&](const Input& other) {
            return other.surface == added.surface && other.origin < added.origin &&
                   std::ranges::count(other.at, p) > 0;
        });
    }

    /// Tells whether an edge lies on a side, of an added triangle that contains it, from a vertex
    /// that the surface had before.
    [[nodiscard]] bool is_on_side(std::uint32_t t, const Edge& edge) const {
        return std::ranges::any_of(c_.exact.parents_of[t], [&](std::uint32_t p) {
            const Input& input = inputs_[p];
            for (std::size_t i = 0; i < 3; ++i) {
                const Point3 &a = input.at[i], &b = input.at[(i + 1) % 3];
                if (!was_there(a, input) && !was_there(b, input)) continue;
                const double near = 1e-9 * (1e-3 + length(b - a));
                if (distance(points_[edge[0]], a, b) <= near &&
                    distance(points_[edge[1]], a, b) <= near)
                    return true;
            }
            return false;
        });
    }

    bool ends_free() {
        return std::ranges::any_of(at_edge_, [&](const auto& entry) {
            Ids kept;
            for (const std::uint32_t t : entry.second)
                if (!parts_[t].is_dropped) kept.push_back(t);
            return kept.size() == 1 && parts_[kept[0]].is_strip() &&
                   !is_on_side(kept[0], entry.first);
        });
    }

    std::string trimmed_flaw() {
        const auto is_trimmed = [](const Part& part) { return part.is_trimmed(); };
        Ids beside;
        for (const auto& [edge, all] : at_edge_) {
            Ids gone, left;
            for (const std::uint32_t t : all) {
                if (parts_[t].is_trimmed()) gone.push_back(t);
                if (!parts_[t].is_trimmed() && (!parts_[t].is_added() || parts_[t].is_strip()))
                    left.push_back(t);
            }
            if (gone.empty()) continue;
            for (const std::uint32_t t : gone)
                for (const std::uint32_t u : left)
                    if (std::ranges::any_of(parts_[t].given_for, [&](std::uint32_t s) {
                            return parts_[u].given_for.contains(s);
                        }))
                        beside.push_back(t);
            if (left.size() == 1) return "a trimmed triangle that another one ended on";
        }
        const auto seen = reached(std::move(beside), is_trimmed);
        for (std::uint32_t t = 0; t < parts_.size(); ++t)
            if (parts_[t].is_trimmed() && !seen.contains(t))
                return "a part that is missing, with nothing beside it";
        return "";
    }

    const Certificate& c_;
    const std::vector<Input> inputs_;
    const std::vector<Point3> points_;
    std::vector<Part> parts_; ///< per exact triangle
    std::map<Edge, Ids> at_edge_;
};

/// Compares the doubles with what was kept of each input triangle, and with the volume.
std::string doubles_flaw(const Sealed& sealed, const Certificate& c, double accepted) {
    const RoundedClaim& r = *c.rounded;
    if (r.clean != is_conforming(r.vertices, r.triangles))
        return "whether the doubles are conforming";
    const auto right = sealed.kept_moments();
    std::vector<std::array<double, 4>> sums(right.size());
    std::vector<Corners> boundary;
    for (const Input& input : sealed.inputs())
        if (input.origin == Input::Origin::boundary) boundary.push_back(input.at);
    for (std::size_t t = 0; t < r.triangles.size(); ++t) {
        const auto at = corners(r.vertices, r.triangles[t]);
        for (const std::uint32_t p : r.parents_of[t]) {
            Sealed::add_moments(sums[p], at);
            for (const Point3& corner : at)
                if (distance(corner, sealed.inputs()[p].at) >
                    1.001 * accepted + 1e-12 * (1 + length(corner)))
                    return "a corner outside of its parent";
        }
        const bool on_boundary =
            sealed.inputs()[r.parents_of[t].back()].origin == Input::Origin::boundary;
        if (!boundary.empty() && !on_boundary && r.clean && !is_inside(middle_of(at), boundary) &&
            !c.rounded->max_move)
            return "a triangle of doubles outside of the volume";
        if (dot(area_vector(at), area_vector(sealed.inputs()[r.parents_of[t].front()].at)) <
            -8 * accepted * perimeter(at))
            return "a side of the doubles";
    }
    for (std::size_t p = 0; p < right.size(); ++p) {
        const auto& at = sealed.inputs()[p].at;
        const double slack =
            64 * accepted * perimeter(at) + 1e-9 * (length(area_vector(at)) + 1e-9);
        const double size = 1 + length(at[0]) + perimeter(at);
        for (std::size_t i = 0; i < 4; ++i)
            if (std::abs(sums[p][i] - right[p][i]) > (i == 0 ? slack : 4 * size * slack))
                return "the area of an input triangle";
    }
    return "";
}

bool adds_the_same(const SealedClaim& a, const SealedClaim& b) {
    return std::ranges::equal(a.surfaces, b.surfaces, [](const auto& x, const auto& y) {
        return x.extended == y.extended && x.sealed == y.sealed;
    });
}

} // namespace

std::string difference_of_sealed(const Subject& s, const Certificate& changed, double accepted) {
    const Certificate& right = s.certificate;
    if (changed.cut->volume.shape.empty() != right.cut->volume.shape.empty())
        return "whether there is a volume";
    if (!changed.cut->volume.shape.empty())
        if (auto flaw = difference_of_volume(s, changed.cut->volume); !flaw.empty()) return flaw;
    if (changed.sealed->surfaces.size() != right.sealed->surfaces.size())
        return "the number of surfaces";
    const auto surfaces = arranged_surfaces(s, changed);
    const auto again = arrange(surfaces);
    if (!again) return "surfaces that cannot be arranged";
    if (canonical_digest(surfaces, *again) != changed.digest) return "the digest";
    Sealed sealed(s, changed);
    if (auto flaw = sealed.flaw(); !flaw.empty()) return flaw;
    if (!changed.rounded) return changed.outputs.empty() ? "" : "whether there are doubles";
    if (auto flaw = doubles_flaw(sealed, changed, accepted); !flaw.empty()) return flaw;
    const bool same = adds_the_same(*changed.sealed, *right.sealed) &&
                      changed.exact.triangles == right.exact.triangles &&
                      changed.cut->dropped == right.cut->dropped && changed.digest == right.digest;
    return same ? difference_of_doubles(s, *changed.rounded, accepted) : "";
}

} // namespace terrane::fuzz
