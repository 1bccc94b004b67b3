// SPDX-License-Identifier: LGPL-3.0-or-later
//
// find_nesting of blocks.hpp.
//
// A component divides space into parts, each with one shell as its border. Let r be a point of
// another component, and let w be the winding numbers of shells around it, where a shell is wound
// outward as seen from its part. If r is in a bounded part, w is 1 for its shell and -1 for the
// outermost; else w is 0 for all. The parts that contain a component are nested, as components have
// at most vertices in common; so the innermost belongs to the component that is itself in most
// parts of others.
//
// r is a point inside of a triangle T of its component. For this component itself, r is moved up
// along the ray a little, to a place in front of T or behind it. All rays are moved aside, by e in
// one coordinate and e^2 in the other for an e that is smaller than all else, so that none meets an
// edge. This changes no winding number, as r is on no other triangle.
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>

#include <terrane/algorithms/verify/detail/blocks.hpp>

namespace terrane::verifier {

namespace {

/// A component and its point.
struct Query {
    std::uint32_t triangle = 0; ///< the lowest of the component; the point is inside of it
    Vector4 point;
    Box box{};
};

/// Casts rays along one axis, in its direction.
class Rays {
public:
    Rays(const ExactMesh& mesh, const Shells& shells, std::size_t axis) :
        mesh_(mesh), shells_(shells), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3) {}

    /// Calls visit(query, winding) for each query with the winding numbers that are not 0. Only
    /// `triangles` are looked at.
    template <class Visit>
    void cast(std::vector<Query> queries, std::span<const std::uint32_t> triangles,
              const Visit& visit) {
        std::vector<Target> targets = targets_of(triangles);
        std::sort(queries.begin(), queries.end(),
                  [this](const Query& a, const Query& b) { return a.box.low[u_] < b.box.low[u_]; });
        std::vector<Target> active; // those that may overlap this query or a later one
        auto next = targets.begin();
        for (const Query& query : queries) {
            for (; next != targets.end() && next->box.low[u_] <= query.box.high[u_]; ++next)
                active.push_back(*next);
            std::erase_if(active,
                          [&](const Target& t) { return t.box.high[u_] < query.box.low[u_]; });
            std::map<std::uint32_t, int> winding;
            for (const Target& t : active)
                if (t.box.low[v_] <= query.box.high[v_] && t.box.high[v_] >= query.box.low[v_] &&
                    t.box.high[axis_] >= query.box.low[axis_])
                    pass(query, t.triangle, winding);
            visit(query, winding);
        }
    }

private:
    struct Target {
        std::uint32_t triangle = 0;
        Box box{};
    };

    [[nodiscard]] std::vector<Target> targets_of(std::span<const std::uint32_t> triangles) const {
        std::vector<Target> targets;
        for (const std::uint32_t t : triangles) {
            Target target{t, enclose(mesh_.points[mesh_.triangles[t][0]], mesh_.scale)};
            for (const std::size_t corner : {1U, 2U}) {
                const Box box = enclose(mesh_.points[mesh_.triangles[t][corner]], mesh_.scale);
                for (std::size_t i = 0; i < 3; ++i) {
                    target.box.low[i] = std::min(target.box.low[i], box.low[i]);
                    target.box.high[i] = std::max(target.box.high[i], box.high[i]);
                }
            }
            targets.push_back(target);
        }
        std::sort(targets.begin(), targets.end(), [this](const Target& a, const Target& b) {
            return a.box.low[u_] < b.box.low[u_];
        });
        return targets;
    }

    /// Tells on which side of the projected edge a b the moved point is; 0 if the edge is a point.
    [[nodiscard]] int side_of(const Vector4& a, const Vector4& b, const Vector4& point) const {
        if (const int side = sgn(turn(a, b, point, axis_)); side != 0) return side;
        if (const int v = sgn(mpz_class(b[v_] * a[3] - a[v_] * b[3])); v != 0) return -v;
        return sgn(mpz_class(b[u_] * a[3] - a[u_] * b[3]));
    }

    /// Adds what the ray does to the winding numbers where it passes through a triangle.
    void pass(const Query& query, std::uint32_t triangle, std::map<std::uint32_t, int>& winding) {
        const auto& [i, j, k] = mesh_.triangles[triangle];
        const Vector4 &a = mesh_.points[i], &b = mesh_.points[j], &c = mesh_.points[k];
        const int side = side_of(a, b, query.point);
        if (side == 0 || side_of(b, c, query.point) != side || side_of(c, a, query.point) != side)
            return;
        // The normal of the plane has this sign along the axis.
        const int height = sgn(dot(mesh_.planes[triangle], query.point));
        if (triangle == query.triangle || height * side >= 0) return; // not above
        winding[shells_.of_side[2 * triangle + 1]] += side; // the ray leaves what is behind
        winding[shells_.of_side[2 * triangle]] -= side;
    }

    const ExactMesh& mesh_;
    const Shells& shells_;
    const std::size_t axis_, u_, v_;
};

/// Collects what the rays say.
class Locator {
public:
    Locator(const ExactMesh& mesh, const Shells& shells) :
        mesh_(mesh), shells_(shells), around_(shells.sides_of.size()) {
        nesting_.outermost.assign(shells.sides_of.size(), false);
        nesting_.around.assign(shells.sides_of.size(), no_number);
    }

    Nesting operator()() {
        cast_all();
        for (std::uint32_t s = 0; s < around_.size(); ++s) {
            std::size_t deepest = 0;
            for (const std::uint32_t candidate : around_[s])
                if (const std::size_t depth = depth_of(candidate) + 1; depth > deepest) {
                    deepest = depth;
                    nesting_.around[s] = candidate;
                }
        }
        return std::move(nesting_);
    }

private:
    /// The number of components around the one of a shell.
    [[nodiscard]] std::size_t depth_of(std::uint32_t shell) const {
        return around_[outermost_of_.at(shells_.component_of[shell])].size();
    }

    void cast_all() {
        std::map<std::uint32_t, std::size_t> shell_count; // per component
        for (const std::uint32_t c : shells_.component_of) ++shell_count[c];
        Numbers closed; // triangles of components with bounded parts
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            if (shell_count.at(shells_.component_of[shells_.of_side[2 * t]]) > 1)
                closed.push_back(t);
        std::array<std::vector<Query>, 3> queries; // per axis
        for (const auto& [triangle, count] : shell_count) {
            const Vector4 point = centroid_of(mesh_, triangle);
            queries[projection_axis(mesh_.planes[triangle]).value_or(2)].push_back(
                {triangle, point, enclose(point, mesh_.scale)});
        }
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (!queries[axis].empty())
                Rays(mesh_, shells_, axis)
                    .cast(std::move(queries[axis]), closed,
                          [this](const Query& q, const auto& winding) { take(q, winding); });
    }

    void take(const Query& query, const std::map<std::uint32_t, int>& winding) {
        // The moved point is in front of its triangle if the normal points up.
        const int up = sgn(mesh_.planes[query.triangle]
                                       [projection_axis(mesh_.planes[query.triangle]).value_or(2)]);
        std::uint32_t outermost = shells_.of_side[2 * query.triangle + (up > 0 ? 0 : 1)];
        Numbers around;
        for (const auto& [shell, number] : winding) {
            const bool own = shells_.component_of[shell] == query.triangle;
            if (own && number < 0) outermost = shell;
            if (!own && number > 0) around.push_back(shell);
        }
        nesting_.outermost[outermost] = true;
        outermost_of_[query.triangle] = outermost;
        around_[outermost] = std::move(around);
    }

    const ExactMesh& mesh_;
    const Shells& shells_;
    std::vector<Numbers> around_;                         ///< per outermost shell: all around it
    std::map<std::uint32_t, std::uint32_t> outermost_of_; ///< per component
    Nesting nesting_;
};

} // namespace

Nesting find_nesting(const ExactMesh& mesh, const Shells& shells) {
    return Locator(mesh, shells)();
}

} // namespace terrane::verifier
