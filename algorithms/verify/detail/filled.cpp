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
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>

namespace terrane::verifier {

namespace {

/// An edge with the triangles that use it from the lower to the higher vertex, and the reverse.
using Uses = std::array<Numbers, 2>;

/// A filled surface; its vertices and triangles are counted from 0.
class FilledSurface {
public:
    FilledSurface(const Surface& given, const FilledClaim& filled, std::size_t number,
                  std::array<std::size_t, 2> first, Violations& found) :
        given_(given),
        part_(filled.surfaces[number]), found_(found),
        vertices_(std::span(filled.vertices).subspan(first[0], part_.vertices)),
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
        check_rings();
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

    // --- R30 -------------------------------------------------------------------------------------

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
        for (std::uint32_t t = 0; t < triangles_.size(); ++t)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t from = triangles_[t][i], to = triangles_[t][(i + 1) % 3];
                uses_[{std::min(from, to), std::max(from, to)}][from < to ? 0 : 1].push_back(t);
            }
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

    /// A connected filling. Without the corners and edges of its border, the Euler characteristic of
    /// a disc is 1.
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
            for (const std::uint32_t v : triangles_[t])
                if (v >= given_.vertices.size() && seen.insert(v).second) ++filling.characteristic;
        }
        for (const auto& [edge, uses] : uses_) {
            Numbers all = uses[0];
            all.insert(all.end(), uses[1].begin(), uses[1].end());
            const auto [given, added] = std::ranges::minmax(all);
            if (added < new_from()) continue;
            Filling& filling = fillings[joined_.find(added)];
            if (given >= new_from())
                --filling.characteristic;
            else
                ++(uses[0].size() == 1 ? filling.along : filling.against);
        }
        for (const auto& [t, filling] : fillings) {
            if (filling.characteristic != 1)
                report(Rule::R35_fillings, t, "is of a filling that is no disc in one hole");
            if (filling.along == 0)
                report(Rule::R35_fillings, t,
                       "faces another side than all given triangles around its hole");
        }
    }

    /// Checks that the triangles round a new vertex form one ring, and that no ring is closed round
    /// a given one.
    void check_rings() {
        std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> next;
        for (std::uint32_t t = new_from(); t < triangles_.size(); ++t)
            for (std::size_t i = 0; i < 3; ++i)
                next[triangles_[t][i]].try_emplace(triangles_[t][(i + 1) % 3],
                                                   triangles_[t][(i + 2) % 3]);
        for (const auto& [v, fan] : next)
            if (v >= given_.vertices.size() ? !is_ring(fan) : has_ring(fan))
                report_vertex(Rule::R35_fillings, v,
                              "has no single ring of triangles round it, or one too many");
        for (auto v = static_cast<std::uint32_t>(given_.vertices.size()); v < vertices_.size(); ++v)
            if (!next.contains(v)) report_vertex(Rule::R35_fillings, v, "belongs to no triangle");
    }

    /// Returns the number of steps from a place in a fan until it ends or comes back.
    static std::size_t steps_from(const std::map<std::uint32_t, std::uint32_t>& fan,
                                  std::uint32_t start, bool& back) {
        std::size_t steps = 0;
        std::uint32_t at = start;
        for (auto next = fan.find(at); next != fan.end() && steps <= fan.size();
             next = fan.find(at)) {
            at = next->second;
            ++steps;
            if (at == start) break;
        }
        back = at == start;
        return steps;
    }
    static bool is_ring(const std::map<std::uint32_t, std::uint32_t>& fan) {
        bool back = false;
        return steps_from(fan, fan.begin()->first, back) == fan.size() && back;
    }
    static bool has_ring(const std::map<std::uint32_t, std::uint32_t>& fan) {
        return std::ranges::any_of(fan, [&](const auto& step) {
            bool back = false;
            steps_from(fan, step.first, back);
            return back;
        });
    }

    // --- R31 -------------------------------------------------------------------------------------

    void check_contacts() {
        auto [points, scale] = scale_to_integers(vertices_);
        const auto mesh = make_exact_mesh(std::move(points), scale, triangles_);
        for (std::uint32_t t = new_from(); t < triangles_.size(); ++t)
            if (!projection_axis(mesh.planes[t])) report(Rule::R36_embedded, t, "has no area");
        for (const auto& [a, b] : find_improper_pairs_from(mesh, new_from(), most_contacts_listed))
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
        struct Extent {
            bool any = false;
            std::array<mpz_class, 3> low, high;
        };
        std::map<std::uint32_t, Extent> borders;
        for_each_new_corner([&](std::uint32_t t, std::uint32_t v) {
            if (v >= given_.vertices.size()) return;
            Extent& box = borders[joined_.find(t)];
            for (std::size_t i = 0; i < 3; ++i) {
                const mpz_class& at = exact[v][i];
                if (!box.any || at < box.low[i]) box.low[i] = at;
                if (!box.any || at > box.high[i]) box.high[i] = at;
            }
            box.any = true;
        });
        for_each_new_corner([&](std::uint32_t t, std::uint32_t v) {
            const Extent& box = borders[joined_.find(t)];
            for (std::size_t i = 0; i < 3; ++i)
                if (!box.any || exact[v][i] > box.high[i] + exact.back()[0] ||
                    exact[v][i] < box.low[i] - exact.back()[0])
                    report(Rule::R26_limits, t,
                           "is farther from the box around the border of its hole than the limit");
        });
    }

    template <class Visit>
    void for_each_new_corner(const Visit& visit) {
        for (std::uint32_t t = new_from(); t < triangles_.size(); ++t)
            for (const std::uint32_t v : triangles_[t]) visit(t, v);
    }

    const Surface& given_;
    const FilledPart& part_;
    Violations& found_;
    std::span<const Point3> vertices_;
    std::uint32_t first_triangle_;
    std::vector<Triangle> triangles_; ///< indices into vertices_
    bool oriented_ = true;            ///< no two given triangles face different sides at an edge
    std::map<Edge, Uses> uses_;
    JoinedSets joined_{part_.triangles}; ///< of new triangles of the same filling
};

void check_numbers(const FilledClaim& filled, std::size_t surfaces, double accepted,
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
    check_numbers(filled, surfaces.size(), accepted, found);
    if (!found.empty()) return;
    std::array<std::size_t, 2> first{0, 0};
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        FilledSurface(surfaces[s], filled, s, first, found).check();
        check_expected_errors(surfaces[s], filled, s, first, found);
        first[0] += filled.surfaces[s].vertices;
        first[1] += filled.surfaces[s].triangles;
    }
}

} // namespace terrane::verifier
