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

/// Returns the integers nearest to the coordinates of a point, multiplied by a factor.
Vector4 rounded_point(const Vector4& point, const mpz_class& factor) {
    Vector4 result{0, 0, 0, 1};
    for (std::size_t i = 0; i < 3; ++i)
        mpz_fdiv_q(result[i].get_mpz_t(), mpz_class(2 * factor * point[i] + point[3]).get_mpz_t(),
                   mpz_class(2 * point[3]).get_mpz_t());
    return result;
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
        for (std::uint32_t t = 0; t < parts.exact.triangles.size(); ++t) {
            Numbers surfaces;
            bool is_given = false;
            for (const std::uint32_t p : parts.exact.parents_of[t]) {
                surfaces.push_back(inputs_.surface_of[p]);
                is_given = is_given || !is_new(p);
            }
            surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
            surfaces_of_.push_back(std::move(surfaces));
            is_given_.push_back(is_given);
            is_dropped_.push_back(std::ranges::binary_search(parts.dropped, t));
        }
    }

    void check() {
        check_attached();
        check_ends();
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

    /// Tells whether exactly one given triangle of the surface is at an edge, and is not trimmed.
    [[nodiscard]] bool is_border(const Numbers& at, std::uint32_t surface) const {
        std::size_t given = 0, trimmed = 0;
        for (const std::uint32_t t : at) {
            if (!is_given_for(t, surface)) continue;
            ++given;
            trimmed += is_trimmed(t) ? 1 : 0;
        }
        return given == 1 && trimmed == 0;
    }

    void check_attached() {
        const auto leads_on = [&](std::uint32_t t) {
            return !is_given_[t] && (!is_dropped_[t] || parts_.outside[t]);
        };
        JoinedSets sets(is_given_.size());
        std::vector<bool> is_anchor(is_given_.size());
        for (const auto& [edge, at] : at_edge_)
            for (const std::uint32_t t : at) {
                if (!leads_on(t)) continue;
                for (const std::uint32_t u : at)
                    if (u != t && leads_on(u) && share_surface(t, u)) sets.join(t, u);
                for (const std::uint32_t surface : surfaces_of_[t])
                    if (is_border(at, surface)) is_anchor[t] = true;
            }
        std::vector<bool> is_attached(is_given_.size());
        for (std::uint32_t t = 0; t < is_anchor.size(); ++t)
            if (is_anchor[t]) is_attached[sets.find(t)] = true;
        for (std::uint32_t t = 0; t < is_given_.size(); ++t)
            if (is_strip(t) && !is_attached[sets.find(t)])
                report(Rule::R54_attached, t,
                       " was added, but is not attached along the border of its surface");
    }

    // --- R55 -------------------------------------------------------------------------------------

    /// Returns the vertices on which added triangles of a surface were built.
    [[nodiscard]] const std::set<Point3>& base_of(std::uint32_t surface, bool sealed) const {
        auto& bases = bases_[{surface, sealed}];
        if (!bases.empty()) return bases;
        const OwnTriangles& own = own_[surface];
        for (std::uint32_t p = own.first; p < (sealed ? own.sealed : own.extended); ++p)
            for (const std::uint32_t v : inputs_.triangles[p]) bases.insert(inputs_.vertices[v]);
        return bases;
    }

    /// Tells whether two points are ends of an edge of what added triangles were built on.
    [[nodiscard]] bool is_edge_of_base(std::uint32_t surface, bool sealed, const Point3& a,
                                       const Point3& b) const {
        const OwnTriangles& own = own_[surface];
        for (std::uint32_t p = own.first; p < (sealed ? own.sealed : own.extended); ++p) {
            std::size_t ends = 0;
            for (const std::uint32_t v : inputs_.triangles[p])
                ends += inputs_.vertices[v] == a || inputs_.vertices[v] == b ? 1 : 0;
            if (ends > 1) return true;
        }
        return false;
    }

    /// Tells whether a side of an added triangle is lateral: it leads from a vertex of the border
    /// away from it, or to another one without being an edge.
    [[nodiscard]] bool is_lateral(std::uint32_t surface, bool sealed, const Point3& a,
                                  const Point3& b) const {
        const auto& base = base_of(surface, sealed);
        const bool from = base.contains(a), to = base.contains(b);
        return from != to || (from && to && !is_edge_of_base(surface, sealed, a, b));
    }

    /// Tells whether an edge of a triangle lies on a side of an added triangle that contains it, or
    /// on a lateral one of these sides.
    [[nodiscard]] bool is_on_side(std::uint32_t t, const Edge& edge, bool lateral) {
        const auto axis = projection_axis(mesh_.planes[t]).value();
        for (const std::uint32_t p : parts_.exact.parents_of[t]) {
            const std::uint32_t surface = inputs_.surface_of[p];
            const Triangle& corners = inputs_.triangles[p];
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
                if (is_on_line(a, b, edge, axis) &&
                    (!lateral || is_lateral(surface, p >= own_[surface].sealed, inputs_.vertices[a],
                                            inputs_.vertices[b])))
                    return true;
            }
        }
        return false;
    }

    /// Tells whether an edge of a triangle lies on the line through two vertices of inputs.
    [[nodiscard]] bool is_on_line(std::uint32_t a, std::uint32_t b, const Edge& edge,
                                  std::size_t axis) const {
        return std::ranges::all_of(edge, [&](std::uint32_t v) {
            return sgn(turn(input_points_[a], input_points_[b], mesh_.points[v], axis)) == 0;
        });
    }

    /// Tells whether an added triangle meets a kept one at an edge that it does not continue: one
    /// of another surface, a given one of its own that does not end there, or an added one by which
    /// it was cut.
    [[nodiscard]] bool meets(std::uint32_t strip, std::uint32_t t, const Edge& edge,
                             const Numbers& at) {
        if (t == strip || is_dropped_[t]) return false;
        if (is_strip(t) && share_surface(strip, t))
            return !is_on_side(strip, edge, false) && !is_on_side(t, edge, false) &&
                   parts_.exact.parents_of[strip].front() != parts_.exact.parents_of[t].front();
        return std::ranges::any_of(surfaces_of_[strip], [&](std::uint32_t surface) {
            return !is_given_for(t, surface) || !is_border(at, surface);
        });
    }

    /// Marks added triangles that join two parts of the border of their surface: one has a side
    /// along the border, and its opposite corner is an end of another edge along which the added
    /// triangles that are connected with it, as `sets` says, lie at the border.
    void mark_joining(JoinedSets& sets, std::vector<bool>& is_closing) {
        struct Attached {
            std::uint32_t triangle, opposite; ///< an exact triangle, a vertex of the inputs
        };
        std::vector<Attached> all;
        std::map<std::uint32_t, std::vector<std::uint32_t>> ends; // of edges at the border, by set
        for (const auto& [edge, at] : at_edge_)
            for (const std::uint32_t t : at) {
                if (!is_strip(t)) continue;
                const auto axis = projection_axis(mesh_.planes[t]).value();
                for (const std::uint32_t p : parts_.exact.parents_of[t]) {
                    if (!is_border(at, inputs_.surface_of[p])) continue;
                    const Triangle& corners = inputs_.triangles[p];
                    for (std::size_t i = 0; i < 3; ++i) {
                        if (!is_on_line(corners[i], corners[(i + 1) % 3], edge, axis)) continue;
                        all.push_back({t, corners[(i + 2) % 3]});
                        auto& list = ends[sets.find(t)];
                        list.insert(list.end(), edge.begin(), edge.end());
                    }
                }
            }
        for (const Attached& a : all)
            if (std::ranges::any_of(ends[sets.find(a.triangle)], [&](std::uint32_t v) {
                    return are_equal(mesh_.points[v], input_points_[a.opposite]);
                }))
                is_closing[a.triangle] = true;
    }
    /// Tells whether two points are the same.
    static bool are_equal(const Vector4& p, const Vector4& q) {
        for (std::size_t i = 0; i < 3; ++i)
            if (p[i] * q[3] != q[i] * p[3]) return false;
        return true;
    }

    void check_ends() {
        JoinedSets sets(is_given_.size());
        std::vector<bool> is_closing(is_given_.size());
        for (const auto& [edge, at] : at_edge_) {
            const auto kept = std::ranges::count_if(at, [&](auto t) { return !is_dropped_[t]; });
            for (const std::uint32_t t : at) {
                if (!is_strip(t)) continue;
                if (kept == 1 && !is_on_side(t, edge, true))
                    report(Rule::R55_ends, t, " was added, and ends free");
                for (const std::uint32_t u : at) {
                    if (u != t && is_strip(u) && share_surface(t, u)) sets.join(t, u);
                    if (meets(t, u, edge, at)) is_closing[t] = true;
                }
            }
        }
        mark_joining(sets, is_closing);
        std::set<std::uint32_t> closing;
        for (std::uint32_t t = 0; t < is_closing.size(); ++t)
            if (is_closing[t]) closing.insert(sets.find(t));
        for (std::uint32_t t = 0; t < is_given_.size(); ++t)
            if (is_strip(t) && !closing.contains(sets.find(t)))
                report(Rule::R55_ends, t, " was added, and meets nothing");
    }

    // --- R56 -------------------------------------------------------------------------------------

    void check_trimmed() {
        JoinedSets sets(is_given_.size());
        std::vector<bool> is_beside(is_given_.size());
        for (const auto& [edge, at] : at_edge_) {
            if (std::ranges::none_of(at, [&](auto t) { return is_trimmed(t); })) continue;
            check_trimmed_at(at, sets, is_beside);
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

    void check_trimmed_at(const Numbers& all, JoinedSets& sets, std::vector<bool>& is_beside) {
        Numbers at;
        for (const std::uint32_t t : all)
            if (is_given_[t] || is_strip(t)) at.push_back(t);
        const auto left = static_cast<std::size_t>(
            std::ranges::count_if(at, [&](auto t) { return !is_trimmed(t); }));
        for (const std::uint32_t t : at)
            for (const std::uint32_t u : at)
                if (is_trimmed(t) && !is_trimmed(u) && go_on(t, u)) is_beside[t] = true;
        const std::uint32_t gone =
            *std::ranges::find_if(at, [&](std::uint32_t t) { return is_trimmed(t); });
        if (at.size() == 2 && surfaces_of_[at[0]] == surfaces_of_[at[1]]) {
            if (left == 0)
                sets.join(at[0], at[1]);
            else
                report(Rule::R56_trimmed, gone,
                       " is missing, but not the rest of its part of the surface");
        } else if (at.size() > 1 && left == 1) {
            report(Rule::R56_trimmed, gone, " is missing, so that another one ends free");
        }
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
        for (const Vector4& point : input_points_) exact_.push_back(rounded_point(point, factor));
        for (const Vector4& point : mesh_.points) {
            exact_.push_back(rounded_point(point, factor));
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
    std::vector<OwnTriangles> own_;    ///< per surface of the files
    std::vector<Numbers> surfaces_of_; ///< per exact triangle, as the next two
    std::vector<bool> is_given_, is_dropped_;
    mutable std::map<std::pair<std::uint32_t, bool>, std::set<Point3>> bases_;
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
