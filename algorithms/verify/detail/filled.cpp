// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/filled.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/contacts.hpp>
#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/extent.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>

namespace terrane::verifier {

namespace {

/// An edge with the triangles that use it from the lower to the higher vertex, and the reverse.
using Uses = std::array<Numbers, 2>;

/// Tells whether a square of a diagonal is larger than another one, by more than those that were
/// compared in doubles can be off.
bool is_clearly_larger(const mpz_class& a, const mpz_class& b) {
    return a > b + (b >> 40);
}

/// A filled surface; its vertices and triangles are counted from 0. `holes` are the numbers of
/// holes in the surfaces before.
class FilledSurface {
public:
    FilledSurface(const Surface& given, const FilledClaim& filled, std::size_t number,
                  std::array<std::size_t, 2> first, std::set<std::uint32_t>& holes,
                  Violations& found) :
        given_(given),
        part_(filled.surfaces[number]), holes_(holes), found_(found),
        vertices_(std::span(filled.vertices).subspan(first[0], part_.vertices)),
        hole_of_(std::span(filled.interpolated).subspan(first[1], part_.triangles)),
        first_triangle_(static_cast<std::uint32_t>(first[1])) {
        const auto offset = static_cast<std::uint32_t>(first[0]);
        for (const Triangle& t : std::span(filled.triangles).subspan(first[1], part_.triangles))
            // An index of another surface becomes too large, or wraps and is too large, too.
            triangles_.push_back({t[0] - offset, t[1] - offset, t[2] - offset});
    }

    void check() {
        if (!keeps_given()) return;
        for (std::uint32_t t = new_from(); t < triangles_.size(); ++t)
            if (!all_below(triangles_[t], vertices_.size())) {
                report(Rule::R28_filled_indices, t, "names a vertex of another surface");
                return;
            }
        merge_vertices();
        find_uses();
        check_edges();
        check_fillings();
        check_contacts();
        check_extent();
    }

private:
    [[nodiscard]] std::uint32_t new_from() const {
        return static_cast<std::uint32_t>(given_.triangles.size());
    }
    void report(Rule rule, std::uint32_t triangle, const std::string& what) {
        const std::uint32_t t = first_triangle_ + triangle;
        found_.push_back({rule, {t}, "triangle " + text(t) + " " + what});
    }

    void report_vertex(Rule rule, std::uint32_t v, const std::string& what) {
        found_.push_back({rule, {v}, "vertex " + text(v) + " of its surface " + what});
    }

    // --- R29 -------------------------------------------------------------------------------------

    [[nodiscard]] bool keeps_given() {
        const bool enough = vertices_.size() >= given_.vertices.size() &&
                            triangles_.size() >= given_.triangles.size();
        if (!enough) {
            found_.push_back(
                {Rule::R29_given, {}, "vertices or triangles of an input are missing"});
            return false;
        }
        for (std::size_t v = 0; v < given_.vertices.size(); ++v)
            if (!same_bits(vertices_[v], given_.vertices[v])) {
                found_.push_back({Rule::R29_given, {}, "a vertex of an input was moved"});
                return false;
            }
        for (std::uint32_t t = 0; t < new_from(); ++t)
            if (triangles_[t] != given_.triangles[t]) {
                report(Rule::R29_given, t, "is not the one of the input");
                return false;
            }
        return true;
    }

    // --- R35 -------------------------------------------------------------------------------------

    /// Names given vertices at one place by the first of them; new ones need places of their own.
    void merge_vertices() {
        std::map<Point3, std::uint32_t> first_at;
        Numbers first_of;
        for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
            first_of.push_back(first_at.try_emplace(vertices_[v], v).first->second);
            if (v >= given_.vertices.size() && first_of[v] != v)
                report_vertex(Rule::R36_embedded, v,
                              "is at the place of vertex " + text(first_of[v]));
        }
        for (Triangle& t : triangles_)
            for (std::uint32_t& corner : t) corner = first_of[corner];
    }

    void find_uses() {
        for (const HalfEdge& side : half_edges(triangles_))
            uses_[side.edge][side.ascends ? 0 : 1].push_back(side.triangle);
        for (const auto& [edge, uses] : uses_) {
            const auto given = [&](const Numbers& way) {
                return std::ranges::count_if(way, [&](auto t) { return t < new_from(); });
            };
            if (given(uses[0]) + given(uses[1]) == 2 && given(uses[0]) != 1) oriented_ = false;
        }
    }

    void check_edges() {
        for (const auto& [edge, uses] : uses_) {
            Numbers all = uses[0];
            all.insert(all.end(), uses[1].begin(), uses[1].end());
            std::ranges::sort(all);
            if (all.back() < new_from()) continue;
            // Where given triangles face different sides, new ones cannot face the side of all.
            const bool any_way = !oriented_ && all.front() < new_from();
            const bool two = all.size() == 2 && (any_way || uses[0].size() == 1);
            if (!two)
                report(Rule::R35_fillings, all.back(),
                       "has an edge, of vertices " + text(edge) +
                           " of its surface, without exactly two triangles that face the same "
                           "side");
        }
    }

    /// A connected filling, in which a hole has one number. The characteristic counts its triangles,
    /// the edges between them, and the new vertices that no filling had before: 1 for a disc, and
    /// 2 - 2 g - b for a surface with g handles and b borders, less 1 for each vertex of its inside
    /// that is given, or at which it touches itself or another one. Only a disc has a border and 1.
    struct Filling {
        std::int64_t characteristic = 0;
        std::size_t along = 0, against = 0; ///< edges of the border, by the given triangles there
    };

    /// Checks that each connected filling is a disc, and faces the side of some given triangle at
    /// its border.
    void check_fillings() {
        std::map<std::uint32_t, Filling> fillings;
        std::set<std::uint32_t> seen;
        for (const auto& [edge, uses] : uses_)
            for (const std::uint32_t a : uses[0])
                for (const std::uint32_t b : uses[1])
                    if (a >= new_from() && b >= new_from()) joined_.join(a, b);
        for (std::uint32_t t = new_from(); t < triangles_.size(); ++t) {
            Filling& filling = fillings[joined_.find(t)];
            ++filling.characteristic;
            if (hole_of_[t] != hole_of_[joined_.find(t)])
                report(Rule::R28_filled_indices, t,
                       "has another hole than the rest of its filling");
            for (const std::uint32_t v : triangles_[t])
                if (v >= given_.vertices.size() && seen.insert(v).second) ++filling.characteristic;
        }
        for (const auto& [edge, uses] : uses_) {
            const auto [given, added] = ends_of(uses);
            if (added < new_from()) continue;
            Filling& filling = fillings[joined_.find(added)];
            if (given >= new_from())
                --filling.characteristic;
            else
                ++(uses[0].size() == 1 ? filling.along : filling.against);
        }
        if (seen.size() + given_.vertices.size() != vertices_.size())
            found_.push_back({Rule::R35_fillings, {}, "a new vertex belongs to no triangle"});
        for (const auto& [t, filling] : fillings) {
            if (!holes_.insert(hole_of_[t]).second)
                report(Rule::R28_filled_indices, t, "is of a filling with the hole of another");
            if (filling.characteristic != 1)
                report(Rule::R35_fillings, t, "is of a filling that is no disc in one hole");
            if (filling.along == 0)
                report(Rule::R35_fillings, t,
                       "faces another side than all given triangles around its hole");
        }
    }

    // --- R36 -------------------------------------------------------------------------------------

    void check_contacts() {
        auto [points, scale] = scale_to_integers(vertices_);
        const auto mesh = make_exact_mesh(std::move(points), scale, triangles_);
        for (std::uint32_t t = new_from(); t < triangles_.size(); ++t)
            if (!projection_axis(mesh.planes[t])) report(Rule::R36_embedded, t, "has no area");
        for (const auto& [a, b] : find_improper_pairs(mesh, most_contacts_listed, new_from()))
            report(Rule::R36_embedded, b,
                   "meets triangle " + text(first_triangle_ + a) +
                       " other than in shared corners or edges");
    }

    // --- R26 -------------------------------------------------------------------------------------

    /// Checks the box of each connected filling.
    void check_extent() {
        std::vector<Point3> points(vertices_.begin(), vertices_.end());
        points.push_back({part_.limit, 0, 0});
        const auto exact = scale_to_integers(points).points;
        std::map<std::uint32_t, Extent> borders;
        for_each_new_corner([&](std::uint32_t t, std::uint32_t v) {
            if (v < given_.vertices.size()) borders[joined_.find(t)].add(exact[v]);
        });
        for_each_new_corner([&](std::uint32_t t, std::uint32_t v) {
            if (!borders[joined_.find(t)].has(exact[v], exact.back()[0]))
                report(Rule::R26_limits, t,
                       "is farther from the box around the border of its hole than the limit");
        });
        check_outer_borders(borders, exact);
    }

    /// Checks that in each connected part of the given surface a border stays open that is as large
    /// as those that were closed, unless these are smaller than half of the part.
    void check_outer_borders(const std::map<std::uint32_t, Extent>& closed,
                             std::span<const Vector4> exact) {
        JoinedSets parts(given_.triangles.size()), open(vertices_.size());
        for (const auto& [edge, uses] : uses_) {
            Numbers all = uses[0];
            all.insert(all.end(), uses[1].begin(), uses[1].end());
            if (all.size() == 1) open.join(edge[0], edge[1]);
            std::erase_if(all, [&](std::uint32_t t) { return t >= new_from(); });
            for (const std::uint32_t t : all) parts.join(all.front(), t);
        }
        std::map<std::uint32_t, Extent> whole, largest;      // by part
        std::map<std::array<std::uint32_t, 2>, Extent> left; // by part and border
        std::map<std::uint32_t, std::uint32_t> part_of;      // by filling
        for (const auto& [edge, uses] : uses_)
            for (const std::uint32_t v : edge) {
                const auto [t, u] = ends_of(uses);
                if (t >= new_from()) continue;
                whole[parts.find(t)].add(exact[v]);
                if (u >= new_from()) part_of[joined_.find(u)] = parts.find(t);
                if (t == u) left[{parts.find(t), open.find(v)}].add(exact[v]);
            }
        for (const auto& [key, border] : left)
            if (Extent& most = largest[key[0]]; !most.any || border.size() > most.size())
                most = border;
        for (const auto& [filling, border] : closed) {
            const auto part = part_of.find(filling);
            if (part == part_of.end() ||
                !is_clearly_larger(4 * border.size(), whole[part->second].size()))
                continue;
            const Extent& most = largest[part->second];
            if (!most.any || is_clearly_larger(border.size(), most.size()))
                report(Rule::R35_fillings, filling, "closes the outer border of its surface");
        }
    }
    /// Returns the least and the largest of the triangles at an edge.
    static std::pair<std::uint32_t, std::uint32_t> ends_of(const Uses& uses) {
        std::uint32_t least = UINT32_MAX, largest = 0;
        for (const Numbers& way : uses)
            for (const std::uint32_t t : way) {
                least = std::min(least, t);
                largest = std::max(largest, t);
            }
        return {least, largest};
    }

    template <class Visit>
    void for_each_new_corner(const Visit& visit) {
        for (std::uint32_t t = new_from(); t < triangles_.size(); ++t)
            for (const std::uint32_t v : triangles_[t]) visit(t, v);
    }

    const Surface& given_;
    const FilledPart& part_;
    std::set<std::uint32_t>& holes_;
    Violations& found_;
    std::span<const Point3> vertices_;
    std::span<const std::uint32_t> hole_of_; ///< per triangle
    std::uint32_t first_triangle_;
    std::vector<Triangle> triangles_; ///< indices into vertices_
    bool oriented_ = true;            ///< no two given triangles face different sides at an edge
    std::map<Edge, Uses> uses_;
    JoinedSets joined_{part_.triangles}; ///< of new triangles of the same filling
};

void check_filled_numbers(const FilledClaim& filled, std::size_t surfaces, double accepted,
                          Violations& found) {
    constexpr Rule rule = Rule::R28_filled_indices;
    check_finite(filled.vertices, "vertex", rule, found);
    check_corners(filled.triangles, filled.vertices.size(), rule, found);
    if (filled.surfaces.size() != surfaces)
        found.push_back({rule, {}, "there is not one filled surface per surface"});
    std::uint64_t vertices = 0, triangles = 0;
    for (std::uint32_t s = 0; s < filled.surfaces.size(); ++s) {
        const FilledPart& part = filled.surfaces[s];
        vertices += part.vertices;
        triangles += part.triangles;
        check_limit(part.limit, s, accepted, rule, found);
    }
    if (vertices != filled.vertices.size() || triangles != filled.triangles.size())
        found.push_back({rule, {}, "the filled surfaces do not have all vertices and triangles"});
    if (filled.interpolated.size() != filled.triangles.size() ||
        filled.deviation.size() != filled.vertices.size())
        found.push_back({rule, {}, "there are other numbers of holes or expected errors"});
}

/// Checks the numbers of holes and the expected errors of a surface whose fillings are right.
void check_expected_errors(const Surface& given, const FilledClaim& filled, std::size_t number,
                           std::array<std::size_t, 2> first, Violations& found) {
    constexpr Rule rule = Rule::R28_filled_indices;
    const FilledPart& part = filled.surfaces[number];
    for (std::size_t t = 0; t < part.triangles; ++t)
        if ((filled.interpolated[first[1] + t] == 0) != (t < given.triangles.size()))
            found.push_back({rule,
                             {static_cast<std::uint32_t>(first[1] + t)},
                             "triangle " + text(first[1] + t) +
                                 " is given with the number of a hole, or new without one"});
    for (std::size_t v = 0; v < part.vertices; ++v) {
        const double error = filled.deviation[first[0] + v];
        const bool is_right =
            v < given.vertices.size() ? error == 0 : std::isnan(error) || error >= 0;
        if (is_right && !std::isinf(error)) continue;
        found.push_back({rule,
                         {static_cast<std::uint32_t>(first[0] + v)},
                         "the expected error of vertex " + text(first[0] + v) +
                             " is negative, infinite, or that of a given vertex and not 0"});
    }
}

} // namespace

void check_filled(std::span<const Surface> surfaces, const FilledClaim& filled, double accepted,
                  Violations& found) {
    join_inputs(surfaces, found);
    check_filled_numbers(filled, surfaces.size(), accepted, found);
    if (!found.empty()) return;
    std::array<std::size_t, 2> first{0, 0};
    std::set<std::uint32_t> holes;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        FilledSurface(surfaces[s], filled, s, first, holes, found).check();
        check_expected_errors(surfaces[s], filled, s, first, found);
        first[0] += filled.surfaces[s].vertices;
        first[1] += filled.surfaces[s].triangles;
    }
}

} // namespace terrane::verifier
