// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/sealed.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <terrane/algorithms/verify/detail/cut.hpp>
#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>
#include <terrane/algorithms/verify/detail/nearness.hpp>

namespace terrane::verifier {

namespace {

bool is_finite(const Point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// The input triangles of a surface, through all surfaces.
struct OwnTriangles {
    std::uint32_t first = 0;    ///< of the given ones
    std::uint32_t extended = 0; ///< the first of these
    std::uint32_t sealed = 0;   ///< the first of these
    std::uint32_t end = 0;
};

std::uint32_t count_of(std::size_t n) {
    return static_cast<std::uint32_t>(n);
}

double near_double(const mpz_class& number, const mpz_class& scale) {
    return mpq_class(number, scale).get_d();
}

/// The exact part with the names that check_sealed() gives to its triangles.
class Sealing {
public:
    Sealing(const SealedParts& parts, Violations& found) :
        parts_(parts), mesh_(exact_mesh_of(parts.surfaces, parts.exact)),
        at_edge_(triangles_at_edges(parts.exact.triangles)), found_(found) {
        Violations none; // R1 holds
        inputs_ = join_inputs(parts.surfaces, none);
        input_points_ = scale_to_integers(inputs_.vertices).points;
        std::uint32_t first = 0;
        for (std::size_t s = 0; s < parts.files.size(); ++s) {
            const SealedPart& part = parts.sealed.surfaces[s];
            OwnTriangles& own = own_.emplace_back();
            own.first = first;
            own.extended = first + count_of(parts.files[s].triangles.size());
            own.sealed = own.extended + count_of(part.extended.size());
            first = own.end = own.sealed + count_of(part.sealed.size());
        }
        surfaces_of_ = surfaces_of_parents(inputs_.surface_of, parts.exact.parents_of);
        for (std::uint32_t t = 0; t < parts.exact.triangles.size(); ++t) {
            is_given_.push_back(std::ranges::any_of(parts.exact.parents_of[t],
                                                    [&](std::uint32_t p) { return !is_new(p); }));
            is_dropped_.push_back(std::ranges::binary_search(parts.dropped, t));
        }
    }

    void check() {
        check_joined();
        check_attached();
        check_edges();
        check_trimmed();
        if (found_.empty()) check_limits();
    }

private:
    // --- Names -----------------------------------------------------------------------------------

    /// Tells whether an input triangle was added.
    [[nodiscard]] bool is_new(std::uint32_t input) const {
        const std::uint32_t surface = inputs_.surface_of[input];
        return surface < own_.size() && input >= own_[surface].extended;
    }
    [[nodiscard]] bool is_given_for(std::uint32_t t, std::uint32_t surface) const {
        return std::ranges::any_of(parts_.exact.parents_of[t], [&](std::uint32_t p) {
            return inputs_.surface_of[p] == surface && !is_new(p);
        });
    }
    [[nodiscard]] bool is_in(std::uint32_t t, std::uint32_t surface) const {
        return std::ranges::binary_search(surfaces_of_[t], surface);
    }
    [[nodiscard]] bool is_trimmed(std::uint32_t t) const {
        return is_given_[t] && is_dropped_[t] && !parts_.outside[t];
    }
    /// Tells whether a triangle is added and was kept.
    [[nodiscard]] bool is_strip(std::uint32_t t) const { return !is_given_[t] && !is_dropped_[t]; }
    [[nodiscard]] bool share_surface(std::uint32_t t, std::uint32_t u) const {
        return std::ranges::any_of(surfaces_of_[t],
                                   [&](std::uint32_t surface) { return is_in(u, surface); });
    }
    void report(Rule rule, std::uint32_t t, const std::string& what) {
        found_.push_back({rule, {t}, "exact triangle " + text(t) + what});
    }

    // --- R54 -------------------------------------------------------------------------------------

    /// Finds input triangles without area, and those that their surface has already. An added one
    /// must not be a given one of another surface.
    [[nodiscard]] std::vector<bool> find_void() {
        std::vector<bool> is_void(inputs_.triangles.size());
        for (const std::uint32_t p : parts_.exact.degenerate) is_void[p] = true;
        std::map<std::uint32_t, Numbers> same; // as the first one of them
        for (const auto& [p, first] : parts_.exact.duplicates) same[first].push_back(p);
        for (auto& [first, all] : same) {
            std::map<std::uint32_t, std::uint32_t> first_in; // by surface
            all.insert(all.begin(), first);
            for (const std::uint32_t p : all)
                if (!first_in.try_emplace(inputs_.surface_of[p], p).second) is_void[p] = true;
            const auto given = std::ranges::find_if_not(all, [&](auto p) { return is_new(p); });
            for (const std::uint32_t p : all)
                if (is_new(p) && given != all.end() &&
                    inputs_.surface_of[p] != inputs_.surface_of[*given])
                    report_input(p, " was added, but is one of another surface");
        }
        return is_void;
    }
    void report_input(std::uint32_t p, const std::string& what) {
        found_.push_back({Rule::R54_attached, {p}, "input triangle " + text(p) + what});
    }

    void check_joined() {
        const auto is_void = find_void();
        for (const OwnTriangles& own : own_) {
            check_joined(own.first, own.extended, own.sealed, is_void);
            check_joined(own.first, own.sealed, own.end, is_void);
        }
    }

    /// Checks that the triangles from `added` on are joined to those of their surface before them.
    void check_joined(std::uint32_t first, std::uint32_t added, std::uint32_t end,
                      const std::vector<bool>& is_void) {
        if (added == end) return;
        using Side = std::array<Point3, 2>; // in the direction in which a triangle passes it
        std::map<Side, Numbers> before, beside;
        for (std::uint32_t p = first; p < end; ++p)
            for (std::size_t i = 0; i < 3 && !is_void[p]; ++i)
                (p < added ? before : beside)[{corner_of(p, i), corner_of(p, (i + 1) % 3)}]
                    .push_back(p);
        // Where given triangles face different sides, those that are added beside them do, too.
        const bool is_oriented =
            std::ranges::none_of(before, [](const auto& side) { return side.second.size() > 1; });
        JoinedSets sets(end - first);
        Numbers joined;
        for (const auto& [side, list] : beside) {
            const Side back{side[1], side[0]};
            const auto other = beside.find(back), along = before.find(side),
                       against = before.find(back);
            for (const std::uint32_t p : list) sets.join(p - first, list.front() - first);
            if (other != beside.end())
                sets.join(list.front() - first, other->second.front() - first);
            const bool is_border = (along == before.end()) != (against == before.end());
            if (is_border ? against == before.end()
                          : is_oriented && other == beside.end() && list.size() > 1)
                report_input(list.front(), " was added, but faces another side than what it joins");
            else if (is_border && against->second.size() == 1)
                joined.insert(joined.end(), list.begin(), list.end());
        }
        std::set<std::uint32_t> roots;
        std::map<std::uint32_t, std::size_t> sizes;
        for (const std::uint32_t p : joined) roots.insert(sets.find(p - first));
        for (std::uint32_t p = added; p < end; ++p) ++sizes[sets.find(p - first)];
        for (std::uint32_t p = added; p < end; ++p) {
            const std::uint32_t root = sets.find(p - first);
            // The end of a strip is left alone where the strip beside it closed nothing.
            const bool is_end =
                sizes[root] == 1 && std::ranges::count_if(inputs_.triangles[p], [&](auto v) {
                                        return had_before(p, v);
                                    }) == 1;
            if (!is_void[p] && !is_end && !roots.contains(root))
                report_input(p, " was added, but does not go on from the border of its surface");
        }
    }
    [[nodiscard]] const Point3& corner_of(std::uint32_t p, std::size_t i) const {
        return inputs_.vertices[inputs_.triangles[p][i]];
    }

    void check_attached() {
        const auto leads_on = [&](std::uint32_t t) {
            return !is_given_[t] && (!is_dropped_[t] || parts_.outside[t]);
        };
        JoinedSets sets(is_given_.size());
        std::vector<bool> is_anchor(is_given_.size());
        for (const auto& [edge, at] : at_edge_)
            for (const std::uint32_t t : at)
                for (const std::uint32_t u : at) {
                    if (t == u || !leads_on(t)) continue;
                    if (leads_on(u) && share_surface(t, u)) sets.join(t, u);
                    is_anchor[t] =
                        is_anchor[t] ||
                        (!is_trimmed(u) && std::ranges::any_of(surfaces_of_[t], [&](auto surface) {
                            return is_given_for(u, surface);
                        }));
                }
        std::vector<bool> is_attached(is_given_.size());
        for (std::uint32_t t = 0; t < is_anchor.size(); ++t)
            if (is_anchor[t]) is_attached[sets.find(t)] = true;
        for (std::uint32_t t = 0; t < is_given_.size(); ++t)
            if (is_strip(t) && !is_attached[sets.find(t)])
                report(Rule::R54_attached, t, " was added, but is not connected with its surface");
    }

    // --- R55, R56 --------------------------------------------------------------------------------

    /// Checks the edges at which a single triangle is left.
    void check_edges() {
        for (const auto& [edge, at] : at_edge_) {
            if (std::ranges::count_if(at, [&](auto t) { return !is_dropped_[t]; }) != 1) continue;
            const auto left = *std::ranges::find_if(at, [&](auto t) { return !is_dropped_[t]; });
            const auto gone = std::ranges::find_if(at, [&](auto t) { return is_trimmed(t); });
            if (gone != at.end())
                report(Rule::R56_trimmed, *gone, " is missing, so that another one ends free");
            else if (is_strip(left) && !is_on_lateral_side(left, edge))
                report(Rule::R55_ends, left, " was added, and ends free");
        }
    }

    /// Tells whether an edge of an added triangle lies on a side, of an input triangle that contains
    /// it, from a vertex that its surface had before.
    [[nodiscard]] bool is_on_lateral_side(std::uint32_t t, const Edge& edge) {
        const auto axis = projection_axis(mesh_.planes[t]).value();
        for (const std::uint32_t p : parts_.exact.parents_of[t])
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = inputs_.triangles[p][i],
                                    b = inputs_.triangles[p][(i + 1) % 3];
                const auto is_on_line = [&](std::uint32_t v) {
                    return sgn(turn(input_points_[a], input_points_[b], mesh_.points[v], axis)) ==
                           0;
                };
                if (std::ranges::all_of(edge, is_on_line) && (had_before(p, a) || had_before(p, b)))
                    return true;
            }
        return false;
    }
    /// Tells whether a surface had a vertex before an input triangle was added to it.
    [[nodiscard]] bool had_before(std::uint32_t p, std::uint32_t v) {
        const OwnTriangles& own = own_[inputs_.surface_of[p]];
        const std::uint32_t end = p < own.sealed ? own.extended : own.sealed;
        auto& vertices = vertices_before_[{own.first, end}];
        if (vertices.empty())
            for (std::uint32_t t = own.first; t < end; ++t)
                for (std::size_t i = 0; i < 3; ++i) vertices.insert(corner_of(t, i));
        return vertices.contains(inputs_.vertices[v]);
    }

    /// Checks that each trimmed part is connected with what was kept of its surface.
    void check_trimmed() {
        JoinedSets sets(is_given_.size());
        std::vector<bool> is_beside(is_given_.size());
        for (const auto& [edge, at] : at_edge_)
            for (const std::uint32_t t : at)
                for (const std::uint32_t u : at) {
                    if (!is_trimmed(t) || !go_on(t, u)) continue;
                    if (is_trimmed(u))
                        sets.join(t, u);
                    else
                        is_beside[t] = true;
                }
        std::set<std::uint32_t> beside;
        for (std::uint32_t t = 0; t < is_beside.size(); ++t)
            if (is_beside[t]) beside.insert(sets.find(t));
        for (std::uint32_t t = 0; t < is_given_.size(); ++t) {
            if (!is_trimmed(t)) continue;
            if (surfaces_of_[t].back() >= own_.size())
                report(Rule::R51_dropped, t, " is on the boundary, but dropped");
            if (!beside.contains(sets.find(t)))
                report(Rule::R56_trimmed, t, " is missing, and its surface does not go on there");
        }
    }

    /// Tells whether two triangles are given for the same surface.
    [[nodiscard]] bool go_on(std::uint32_t t, std::uint32_t u) const {
        return std::ranges::any_of(surfaces_of_[t], [&](std::uint32_t surface) {
            return is_given_for(t, surface) && is_given_for(u, surface);
        });
    }

    // --- R26 -------------------------------------------------------------------------------------

    /// Makes the points of the inputs, then those of the exact part, taken to integers that are
    /// fine enough for each limit.
    void make_points() {
        mpz_class factor = 1;
        for (const SealedPart& part : parts_.sealed.surfaces)
            while (part.limit > 0 && mpq_class(part.limit) * mpq_class(mesh_.scale * factor) <
                                         mpq_class(mpz_class(1) << 40))
                factor *= 2;
        scale_ = mesh_.scale * factor;
        doubles_ = inputs_.vertices;
        for (const Vector4& point : input_points_)
            exact_.push_back(rounded_to_integers(point, factor));
        for (const Vector4& point : mesh_.points) {
            exact_.push_back(rounded_to_integers(point, factor));
            const Vector4& p = exact_.back();
            doubles_.push_back(
                {near_double(p[0], scale_), near_double(p[1], scale_), near_double(p[2], scale_)});
        }
    }

    [[nodiscard]] Triangle moved(std::uint32_t t) const {
        const std::uint32_t offset = count_of(inputs_.vertices.size());
        const auto& [a, b, c] = parts_.exact.triangles[t];
        return {a + offset, b + offset, c + offset};
    }

    void check_limits() {
        for (std::uint32_t s = 0; s < own_.size(); ++s) {
            Numbers added, trimmed;
            for (std::uint32_t t = 0; t < is_given_.size(); ++t) {
                if (!is_in(t, s)) continue;
                if (!is_given_for(t, s) && !is_dropped_[t]) added.push_back(t);
                if (is_given_for(t, s) && is_trimmed(t)) trimmed.push_back(t);
            }
            if (added.empty() && trimmed.empty()) continue;
            if (exact_.empty()) make_points();
            if (!added.empty())
                check_near(s, added,
                           {inputs_.triangles.begin() + own_[s].first,
                            inputs_.triangles.begin() + own_[s].extended},
                           " was added farther from its surface than the limit");
            if (!trimmed.empty())
                check_near(s, trimmed, not_trimmed(s),
                           " is missing farther from its surface than the limit");
        }
    }

    [[nodiscard]] std::vector<Triangle> not_trimmed(std::uint32_t surface) const {
        std::vector<Triangle> triangles;
        for (std::uint32_t t = 0; t < is_given_.size(); ++t)
            if (is_given_for(t, surface) && !is_trimmed(t)) triangles.push_back(moved(t));
        return triangles;
    }

    void check_near(std::uint32_t surface, const Numbers& changed, std::vector<Triangle> targets,
                    const std::string& otherwise) {
        const double limit = parts_.sealed.surfaces[surface].limit;
        // Points are less than a unit from their integers.
        mpz_class units = mpz_class(mpq_class(limit) * mpq_class(scale_));
        units = units > 2 ? mpz_class(units - 2) : mpz_class(0);
        const Nearness near({doubles_, exact_, rounding_of(doubles_)}, std::move(targets));
        for (const std::uint32_t t : changed)
            if (!near.covers(moved(t), {limit, units})) report(Rule::R26_limits, t, otherwise);
    }

    const SealedParts& parts_;
    const ExactMesh mesh_;
    const EdgeTriangles at_edge_;
    Violations& found_;
    Inputs inputs_;
    std::vector<OwnTriangles> own_;         ///< per surface of the files
    IndexLists<std::uint32_t> surfaces_of_; ///< per exact triangle, as the next two
    std::vector<bool> is_given_, is_dropped_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<Point3>>
        vertices_before_;               ///< by the first input triangle, and the end of them
    std::vector<Vector4> input_points_; ///< in the scale of the mesh
    mpz_class scale_;                   ///< of the next two
    std::vector<Point3> doubles_;
    std::vector<Vector4> exact_;
};

} // namespace

void check_sealed_lists(const SealedClaim& sealed, std::size_t surfaces, double accepted,
                        Violations& found) {
    constexpr Rule rule = Rule::R53_sealed_lists;
    if (sealed.surfaces.size() != surfaces)
        found.push_back({rule, {}, "there is not one sealed part per surface"});
    for (std::uint32_t s = 0; s < sealed.surfaces.size(); ++s) {
        const SealedPart& part = sealed.surfaces[s];
        for (const auto* list : {&part.extended, &part.sealed})
            if (!std::ranges::all_of(
                    *list, [](const auto& t) { return std::ranges::all_of(t, is_finite); }))
                found.push_back(
                    {rule, {s}, "an added coordinate of surface " + text(s) + " is not finite"});
        check_limit(part.limit, s, accepted, rule, found);
    }
}

std::vector<Surface> grown_surfaces(std::span<const Surface> files, const SealedClaim& sealed) {
    std::vector<Surface> surfaces(files.begin(), files.end());
    for (std::size_t s = 0; s < surfaces.size(); ++s)
        for (const auto* list : {&sealed.surfaces[s].extended, &sealed.surfaces[s].sealed})
            for (const auto& corners : *list) {
                const std::uint32_t v = count_of(surfaces[s].vertices.size());
                surfaces[s].vertices.insert(surfaces[s].vertices.end(), corners.begin(),
                                            corners.end());
                surfaces[s].triangles.push_back({v, v + 1, v + 2});
            }
    return surfaces;
}

void check_sealed(const SealedParts& parts, Violations& found) {
    Sealing(parts, found).check();
}

} // namespace terrane::verifier
