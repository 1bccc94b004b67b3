// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/layered.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/layered_sheets.hpp>
#include <terrane/algorithms/verify/detail/plan_view.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane::verifier {

namespace {

class LayeredChecker {
public:
    LayeredChecker(const LayerSheets& sheets, Violations& found) :
        s_(sheets), layered_(sheets.claim), found_(found) {}

    void check() {
        check_order();
        check_heights();
        for (std::uint32_t i = 0; i < s_.layers.size(); ++i) check_places(i);
    }

private:
    void report(Rule rule, Numbers elements, std::string sentence) {
        found_.push_back({rule, std::move(elements), std::move(sentence)});
    }

    // --- R62: order ------------------------------------------------------------------------------

    void check_order() {
        std::vector<Box> downward = s_.boxes;
        for (Box& box : downward) box.low[2] = -infinity;
        const BoxTree tree(std::move(downward));
        for (std::uint32_t s = 0; s < s_.boxes.size(); ++s) {
            Box above = s_.boxes[s];
            above.high[2] = infinity;
            for (const std::uint32_t t : tree.touching(above))
                if (s != t && s_.seen[s] && s_.seen[t] &&
                    layered_.surfaces_of[s].front() <= layered_.surfaces_of[t].back())
                    check_pair(s, t);
            if (found_.size() >= most_contacts_listed) return;
        }
    }

    /// Checks that t, which is of the same layer or lower in the order, is nowhere above s. Rounding
    /// can fold a layer in strips, and one whose surface is above itself is, too.
    void check_pair(std::uint32_t s, std::uint32_t t) {
        if (are_beside(s_.seen[s]->corners, s_.seen[t]->corners)) return;
        const auto polygon = common_part(s_.seen[s]->corners, s_.seen[t]->corners);
        if (std::ranges::none_of(polygon, [&](const Place& p) {
                return height_over(s_.seen[t]->corners, p) > height_over(s_.seen[s]->corners, p);
            }))
            return;
        const std::uint32_t upper = layered_.surfaces_of[s].front(),
                            lower = layered_.surfaces_of[t].back();
        if (is_at_border(polygon, s) ||
            (upper == lower && (is_thin(polygon) || is_above_itself(upper))))
            return;
        report(Rule::R62_layer_order, {s, t},
               "triangle " + text(t) + " of " + s_.name(lower) + " is above triangle " + text(s) +
                   " of " + s_.name(upper));
    }

    /// Tells whether a vertical line meets the surface of a layer twice.
    [[nodiscard]] bool is_above_itself(std::uint32_t layer) {
        const auto [known, is_new] = above_itself_.try_emplace(layer, false);
        const Sheet& surface = s_.surfaces[layer];
        for (std::uint32_t i = 0; i < surface.triangles.size() && is_new && !known->second; ++i)
            known->second =
                std::ranges::any_of(surface.tree.touching_others(i), [&](std::uint32_t j) {
                    const UpwardCorners &a = surface.triangles[i].corners,
                                        &b = surface.triangles[j].corners;
                    return j < i && !are_beside(a, b) && !is_thin(common_part(a, b));
                });
        return known->second;
    }

    /// Tells whether a part of the projection of a triangle of the mesh is within 2 d of a border.
    [[nodiscard]] bool is_at_border(const PlacePolygon& polygon, std::uint32_t t) const {
        return std::ranges::any_of(s_.borders_near(s_.boxes[t]), [&](std::uint32_t b) {
            return std::ranges::all_of(
                polygon, [&](const Place& p) { return is_within(p, s_.borders[b], s_.width); });
        });
    }

    // --- R63, R65: heights and sides -------------------------------------------------------------

    void check_heights() {
        for (std::uint32_t t = 0; t < layered_.triangles.size(); ++t) {
            const Triangle& c = layered_.triangles[t];
            const std::array<Vector4, 3> corners{s_.points[c[0]], s_.points[c[1]], s_.points[c[2]]};
            bool on_some = false, same_side = false;
            for (const std::uint32_t i : layered_.surfaces_of[t]) {
                const auto near = s_.near_triangles(i, s_.boxes[t]);
                if (const auto own = s_.near_one(i, corners, near)) {
                    on_some = true;
                    same_side = same_side || faces_as(t, i, *own);
                } else if (const auto moved = faces_moved(i, t)) {
                    on_some = true;
                    same_side = same_side || *moved;
                } else if (layered_.thickness || !is_replaced(i, t, near)) {
                    report(Rule::R63_layer_heights, {t},
                           "triangle " + text(t) + " is neither on the surface of " + s_.name(i) +
                               " nor on a harder one " +
                               (layered_.thickness ? "moved by a multiple of the thickness"
                                                   : "on whose wrong side that is"));
                    on_some = same_side = true;
                }
            }
            if (!on_some)
                report(Rule::R63_layer_heights, {t}, "triangle " + text(t) + " is on no surface");
            else if (!same_side && !s_.faces_aside(t))
                report(Rule::R65_layer_sides, {t},
                       "triangle " + text(t) + " faces another side than its surface");
        }
    }

    /// Tells whether a triangle of the mesh faces the side of one of a surface. What is upright faces
    /// none, and need not.
    [[nodiscard]] bool faces_as(std::uint32_t t, std::uint32_t layer, std::uint32_t other) const {
        return s_.seen[t] && s_.seen[t]->flipped == s_.surfaces[layer].triangles[other].flipped;
    }

    /// Finds the surfaces of harder layers on which a triangle is once they are moved along z by a
    /// multiple of the minimum thickness, at most one for each layer. Tells whether it faces the
    /// side of one of them; none: there is no such surface, or no thickness.
    [[nodiscard]] std::optional<bool> faces_moved(std::uint32_t i, std::uint32_t t) const {
        std::optional<bool> same_side;
        if (!layered_.thickness) return same_side;
        const int most = static_cast<int>(layered_.order.size());
        const Box around = without_height(widened_by(s_.boxes[t], s_.reach));
        for (std::uint32_t j = 0; j < layered_.order.size(); ++j) {
            if (!s_.is_harder(j, i)) continue;
            for (const std::uint32_t o : s_.surfaces[j].tree.touching(around))
                for (int steps = -most; steps <= most; ++steps)
                    if (is_on_moved(t, j, o, steps))
                        same_side = same_side.value_or(false) || faces_as(t, j, o);
        }
        return same_side;
    }
    [[nodiscard]] bool is_on_moved(std::uint32_t t, std::uint32_t j, std::uint32_t o,
                                   int steps) const {
        Box box = s_.boxes[t];
        for (auto* corner : {&box.low, &box.high}) (*corner)[2] -= steps * *layered_.thickness;
        if (!touch(s_.surfaces[j].boxes[o], widened_by(box, s_.reach))) return false;
        const Triangle& c = layered_.triangles[t];
        std::array<Vector4, 3> corners{s_.points[c[0]], s_.points[c[1]], s_.points[c[2]]};
        for (Vector4& corner : corners) corner[2] -= steps * s_.thickness;
        return s_.near_one(j, corners, {o}).has_value();
    }

    /// Tells whether a triangle replaces all of a layer that it covers, rightly.
    [[nodiscard]] bool is_replaced(std::uint32_t i, std::uint32_t t, const Numbers& near) const {
        bool from_above = false, from_below = false;
        for (const std::uint32_t j : layered_.surfaces_of[t])
            if (j != i && s_.is_harder(j, i)) (j < i ? from_above : from_below) = true;
        if (!from_above && !from_below) return false;
        if (!s_.seen[t] || (from_above && from_below)) return true;
        const Seen& replacing = *s_.seen[t];
        for (const std::uint32_t s : s_.surfaces[i].tree.touching(s_.boxes[t])) {
            const Seen& own = s_.surfaces[i].triangles[s];
            if (are_beside(own.corners, replacing.corners)) continue;
            const auto polygon = common_part(own.corners, replacing.corners);
            const bool right = std::ranges::all_of(polygon, [&](const Place& p) {
                const mpq_class depth =
                    height_over(own.corners, p) - height_over(replacing.corners, p);
                return (from_above ? sgn(depth) >= 0 : sgn(depth) <= 0) ||
                       s_.is_near(point_over(replacing.corners, p), own);
            });
            if (right || is_at_border(polygon, t)) continue;
            std::vector<Vector4> points;
            for (const Place& p : polygon) points.push_back(point_over(replacing.corners, p));
            if (!s_.near_one(i, points, near)) return false;
        }
        return true;
    }

    // --- R64: places -----------------------------------------------------------------------------

    void check_places(std::uint32_t i) {
        check_edges(i);
        for (std::size_t s = 0; s < s_.surfaces[i].triangles.size(); ++s)
            if (!is_under(s_.surfaces[i], s, s_.layers[i]))
                report(Rule::R64_layer_places, {s_.surfaces[i].triangles[s].number},
                       s_.name(i) + ", does not exist over a part of triangle " +
                           text(s_.surfaces[i].triangles[s].number) + " of its surface");
        for (std::size_t t = 0; t < s_.layers[i].triangles.size(); ++t)
            if (!is_under(s_.layers[i], t, s_.surfaces[i]))
                report(Rule::R64_layer_places, {s_.layers[i].triangles[t].number},
                       "triangle " + text(s_.layers[i].triangles[t].number) + " of " + s_.name(i) +
                           ", is where its surface does not exist");
    }

    /// Tells whether the middle of a polygon is within 2 d of its sides.
    [[nodiscard]] bool is_thin(const PlacePolygon& polygon) const {
        const Place mean = mean_of(polygon);
        for (std::size_t k = 0; k < polygon.size(); ++k)
            if (is_within(mean, {polygon[k], polygon[(k + 1) % polygon.size()]}, s_.width))
                return true;
        return false;
    }

    /// Checks that a layer ends at borders of surfaces only.
    void check_edges(std::uint32_t i) {
        const EdgeSides edges = s_.sides_of_layer(i);
        for (const auto& [edge, sides] : edges) {
            if (has_both_sides(sides)) continue;
            Vector4 from = s_.points[edge[0]], to = s_.points[edge[1]];
            from[2] = to[2] = 0;
            std::vector<Triangle> near;
            for (const std::uint32_t b :
                 s_.borders_near(box_of(layered_.vertices, {edge[0], edge[1], edge[1]})))
                near.push_back(s_.border_edges[b]);
            if (from == to || NearTriangles(s_.border_points, near, s_.deviation).reach(from, to))
                continue;
            report(Rule::R64_layer_places, {edge[0], edge[1]},
                   s_.name(i) + ", ends at the edge of vertices " + text(edge) +
                       ", where no surface ends");
        }
    }

    /// Tells whether a triangle of one sheet is under or over triangles of another one, but for
    /// strips along borders.
    [[nodiscard]] bool is_under(const Sheet& sheet, std::size_t t, const Sheet& other) const {
        const UpwardCorners& c = sheet.triangles[t].corners;
        std::vector<SegmentInPlan> near;
        for (const std::uint32_t b : s_.borders_near(sheet.boxes[t])) near.push_back(s_.borders[b]);
        const auto others = other.tree.touching(sheet.boxes[t]);
        for (const PlacePolygon& cell :
             divided_by({place_of(*c[0]), place_of(*c[1]), place_of(*c[2])}, near)) {
            if (cell.empty()) continue;
            const Place mean = mean_of(cell);
            if (std::ranges::any_of(others, [&](std::uint32_t o) {
                    return contains(other.triangles[o].corners, mean);
                }))
                continue;
            if (!is_thin(cell)) return false;
        }
        return true;
    }

    const LayerSheets& s_;
    const LayeredClaim& layered_;
    Violations& found_;
    std::map<std::uint32_t, bool> above_itself_; ///< by layer, once it was asked for
};

bool has_order(const LayeredClaim& layered, std::size_t surfaces) {
    Numbers named;
    for (const CertifiedLayer& layer : layered.order) named.push_back(layer.surface);
    std::ranges::sort(named);
    return !named.empty() && sorted_and_unique(std::span<const std::uint32_t>(named)) &&
           all_below(named, surfaces) && std::ranges::all_of(layered.order, [](const auto& layer) {
               return std::isfinite(layer.hardness);
           });
}

bool has_layers(const LayeredClaim& layered) {
    const std::size_t count = layered.triangles.size();
    if (!well_formed(layered.surfaces_of, count)) return false;
    for (const IndexLists<std::uint32_t>* lists : {&layered.regions_of, &layered.parents_of})
        if (lists->size() != 0 && !well_formed(*lists, count)) return false;
    for (std::size_t t = 0; t < count; ++t) {
        const auto list = layered.surfaces_of[t];
        if (list.empty() || !sorted_and_unique(list) || !all_below(list, layered.order.size()))
            return false;
        if (layered.regions_of.size() != 0 && layered.regions_of[t].size() != list.size())
            return false;
        if (layered.parents_of.size() != 0 && layered.parents_of[t].empty()) return false;
    }
    return true;
}

void check_layer_numbers(std::span<const Surface> surfaces, const LayeredClaim& layered,
                         double accepted, Violations& found) {
    constexpr Rule rule = Rule::R60_layer_lists;
    check_finite(layered.vertices, "vertex", rule, found);
    check_corners(layered.triangles, layered.vertices.size(), rule, found);
    if (!has_order(layered, surfaces.size()))
        found.push_back({rule, {}, "the order names no surface, an unknown one, or one twice"});
    if (!has_layers(layered))
        found.push_back({rule, {}, "a triangle belongs to no layer, or to an unknown one"});
    if (!std::isfinite(layered.deviation) || layered.deviation < 0)
        found.push_back({rule, {}, "the deviation is negative or not finite"});
    else if (layered.deviation > accepted)
        found.push_back(
            {rule, {}, "the stated deviation is larger than the largest that is accepted"});
    if (layered.thickness && !(std::isfinite(*layered.thickness) && *layered.thickness > 0))
        found.push_back({rule, {}, "the thickness is not positive or not finite"});
}

} // namespace

void check_layered(std::span<const Surface> surfaces, const LayeredClaim& layered, double accepted,
                   Violations& found) {
    join_inputs(surfaces, found);
    check_layer_numbers(surfaces, layered, accepted, found);
    if (!found.empty()) return;
    for (Violation& flaw : verify_conforming(layered.vertices, layered.triangles))
        found.push_back({Rule::R61_layer_mesh, std::move(flaw.elements), std::move(flaw.sentence)});
    if (!found.empty()) return;
    LayerSheets sheets(surfaces, layered);
    if (sheets.find(found)) LayeredChecker(sheets, found).check();
}

} // namespace terrane::verifier
