// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/layered.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/box_tree.hpp>
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/plan_view.hpp>

namespace terrane::verifier {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Box box_around(std::span<const Point3> points, const Triangle& t) {
    Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const std::uint32_t corner : t) {
        const std::array<double, 3> at{points[corner].x, points[corner].y, points[corner].z};
        for (std::size_t i = 0; i < 3; ++i) {
            box.low[i] = std::min(box.low[i], at[i]);
            box.high[i] = std::max(box.high[i], at[i]);
        }
    }
    return box;
}

Box widened_by(Box box, double by) {
    for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = std::nextafter(box.low[i] - by, -infinity);
        box.high[i] = std::nextafter(box.high[i] + by, infinity);
    }
    return box;
}

Box without_height(Box box) {
    box.low[2] = -infinity;
    box.high[2] = infinity;
    return box;
}

BoxTree tree_of(const std::vector<Box>& boxes) {
    Numbers items(boxes.size());
    std::iota(items.begin(), items.end(), 0U);
    return {boxes, items};
}

/// A triangle, seen from above.
struct Seen {
    std::uint32_t number = 0; ///< in its mesh or its input surface
    UpwardCorners corners{};  ///< counterclockwise in the projection
    bool flipped = false;     ///< the triangle faces down
};

/// Triangles of a surface or a layer that are not upright, with a tree of their projections.
struct Sheet {
    std::vector<Seen> triangles;
    std::vector<Box> boxes; ///< with heights
    BoxTree tree{{}, {}};   ///< of the boxes without heights

    void add(const Seen& seen, const Box& box) {
        triangles.push_back(seen);
        boxes.push_back(box);
    }
    void finish() {
        auto flat = boxes;
        for (Box& box : flat) box = without_height(box);
        tree = tree_of(flat);
    }
};

/// An edge of a sheet in its projection, with the sides on which triangles are: 1 is the left of
/// the direction from the lower to the higher vertex.
using EdgeSides = std::map<Edge, std::vector<int>>;

class LayeredChecker {
public:
    LayeredChecker(std::span<const Surface> surfaces, const LayeredClaim& layered,
                   Violations& found) :
        surfaces_(surfaces),
        layered_(layered), found_(found) {
        std::vector<Point3> all = layered.vertices;
        for (const CertifiedLayer& layer : layered.order) {
            const auto& vertices = surfaces[layer.surface].vertices;
            first_.push_back(static_cast<std::uint32_t>(all.size()));
            all.insert(all.end(), vertices.begin(), vertices.end());
        }
        all.push_back({layered.deviation, 0, 0});
        points_ = scale_to_integers(all).points;
        deviation_ = points_.back()[0];
        width_ = 2 * deviation_;
        reach_ = 4 * layered.deviation;
    }

    void check() {
        if (!find_surfaces()) return;
        find_borders();
        find_layers();
        check_order();
        check_heights();
        for (std::uint32_t i = 0; i < layers_.size(); ++i) check_places(i);
    }

private:
    void report(Rule rule, Numbers elements, std::string sentence) {
        found_.push_back({rule, std::move(elements), std::move(sentence)});
    }

    std::string layer_name(std::uint32_t i) const {
        return "layer " + text(i) + ", " + surfaces_[layered_.order[i].surface].name;
    }

    [[nodiscard]] bool is_harder(std::uint32_t i, std::uint32_t j) const {
        const double a = layered_.order[i].hardness, b = layered_.order[j].hardness;
        return a > b || (a == b && i < j);
    }

    // --- The surfaces, their borders, the layers -------------------------------------------------

    [[nodiscard]] std::optional<Seen> seen(std::uint32_t number, const Triangle& t,
                                           std::uint32_t first) const {
        Seen result{number,
                    {&points_[first + t[0]], &points_[first + t[1]], &points_[first + t[2]]},
                    false};
        const auto corners = upward(result.corners, result.flipped);
        if (!corners) return std::nullopt;
        result.corners = *corners;
        return result;
    }

    bool find_surfaces() {
        for (std::uint32_t i = 0; i < layered_.order.size(); ++i) {
            const Surface& s = surfaces_[layered_.order[i].surface];
            Sheet& sheet = sheets_.emplace_back();
            for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
                const Triangle& c = s.triangles[t];
                if (const auto from_above = seen(t, c, first_[i])) {
                    sheet.add(*from_above, box_around(s.vertices, c));
                } else if (has_area(c, first_[i])) {
                    report(Rule::R60_layer_lists, {t},
                           "triangle " + text(t) + " of the surface of " + layer_name(i) +
                               " is upright");
                    return false;
                }
            }
            sheet.finish();
        }
        return true;
    }

    [[nodiscard]] bool has_area(const Triangle& t, std::uint32_t first) const {
        return projection_axis(
                   orthogonal(points_[first + t[0]], points_[first + t[1]], points_[first + t[2]]))
            .has_value();
    }

    /// Adds an edge of a triangle whose corners have these numbers.
    static void add_sides(const Seen& t, const Triangle& numbers, EdgeSides& edges) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = numbers[k], b = numbers[(k + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}].push_back((a < b) != t.flipped ? 1 : -1);
        }
    }

    static bool has_both_sides(const std::vector<int>& sides) {
        return sides.size() == 2 && sides[0] != sides[1];
    }

    /// Finds the borders of all surfaces. Vertices at one place are one vertex.
    void find_borders() {
        std::map<std::array<Vector4, 2>, bool> unique;
        for (std::uint32_t i = 0; i < sheets_.size(); ++i) {
            const Surface& s = surfaces_[layered_.order[i].surface];
            std::map<Point3, std::uint32_t> first_at;
            Numbers merged;
            for (std::uint32_t v = 0; v < s.vertices.size(); ++v)
                merged.push_back(first_at.try_emplace(s.vertices[v], v).first->second);
            EdgeSides edges;
            std::map<std::array<std::uint32_t, 3>, bool> known; // a repeated triangle counts once
            for (const Seen& t : sheets_[i].triangles) {
                Triangle c = s.triangles[t.number];
                for (std::uint32_t& corner : c) corner = merged[corner];
                auto sorted = c;
                std::ranges::sort(sorted);
                if (known.try_emplace(sorted, true).second) add_sides(t, c, edges);
            }
            for (const auto& [edge, sides] : edges)
                if (!has_both_sides(sides))
                    add_border(first_[i] + edge[0], first_[i] + edge[1], unique);
        }
        std::vector<Box> boxes = border_boxes_;
        border_tree_ = tree_of(boxes);
    }

    void add_border(std::uint32_t a, std::uint32_t b,
                    std::map<std::array<Vector4, 2>, bool>& unique) {
        std::array<Vector4, 2> ends{points_[a], points_[b]};
        for (Vector4& end : ends) end[2] = 0;
        std::ranges::sort(ends);
        if (ends[0] == ends[1] || !unique.try_emplace(ends, true).second) return;
        borders_.push_back({place_of(ends[0]), place_of(ends[1])});
        const auto number = static_cast<std::uint32_t>(border_points_.size());
        border_points_.insert(border_points_.end(), ends.begin(), ends.end());
        border_edges_.push_back({number, number + 1, number + 1});
        border_boxes_.push_back(without_height(box_around(all_points(), {a, b, b})));
    }

    /// The doubles that points_ was made of.
    [[nodiscard]] std::span<const Point3> all_points() {
        if (doubles_.empty()) {
            doubles_ = layered_.vertices;
            for (const CertifiedLayer& layer : layered_.order) {
                const auto& vertices = surfaces_[layer.surface].vertices;
                doubles_.insert(doubles_.end(), vertices.begin(), vertices.end());
            }
        }
        return doubles_;
    }

    void find_layers() {
        layers_.resize(layered_.order.size());
        for (std::uint32_t t = 0; t < layered_.triangles.size(); ++t) {
            boxes_.push_back(box_around(layered_.vertices, layered_.triangles[t]));
            seen_.push_back(seen(t, layered_.triangles[t], 0));
            if (seen_.back())
                for (const std::uint32_t i : layered_.surfaces_of[t])
                    layers_[i].add(*seen_.back(), boxes_[t]);
        }
        for (Sheet& layer : layers_) layer.finish();
    }

    [[nodiscard]] Numbers borders_near(const Box& box) const {
        return border_tree_.touching(without_height(widened_by(box, reach_)));
    }

    // --- R62: order ------------------------------------------------------------------------------

    void check_order() {
        std::vector<Box> downward = boxes_;
        for (Box& box : downward) box.low[2] = -infinity;
        const BoxTree tree = tree_of(downward);
        for (std::uint32_t s = 0; s < boxes_.size(); ++s) {
            Box above = boxes_[s];
            above.high[2] = infinity;
            for (const std::uint32_t t : tree.touching(above))
                if (s != t && seen_[s] && seen_[t] &&
                    layered_.surfaces_of[s].front() < layered_.surfaces_of[t].back())
                    check_pair(s, t);
            if (found_.size() >= most_contacts_listed) return;
        }
    }

    /// Checks that t, which is lower in the order, is nowhere above s.
    void check_pair(std::uint32_t s, std::uint32_t t) {
        if (are_beside(seen_[s]->corners, seen_[t]->corners)) return;
        const auto polygon = common_part(seen_[s]->corners, seen_[t]->corners);
        if (std::ranges::none_of(polygon, [&](const Place& p) {
                return height_over(seen_[t]->corners, p) > height_over(seen_[s]->corners, p);
            }))
            return;
        for (const std::uint32_t b : borders_near(boxes_[s]))
            if (std::ranges::all_of(
                    polygon, [&](const Place& p) { return is_within(p, borders_[b], width_); }))
                return;
        report(Rule::R62_layer_order, {s, t},
               "triangle " + text(t) + " of " + layer_name(layered_.surfaces_of[t].back()) +
                   " is above triangle " + text(s) + " of " +
                   layer_name(layered_.surfaces_of[s].front()));
    }

    // --- R63, R65: heights and sides -------------------------------------------------------------

    [[nodiscard]] bool is_near(const Vector4& point, const Seen& s) const {
        return within(point, {s.corners[0], s.corners[1], s.corners[2]}, deviation_);
    }

    /// Returns the triangles of the surface of a layer near triangle t of the mesh.
    [[nodiscard]] Numbers near_triangles(std::uint32_t i, std::uint32_t t) const {
        Numbers near;
        const Box box = widened_by(boxes_[t], reach_);
        for (const std::uint32_t s : sheets_[i].tree.touching(without_height(box)))
            if (touch(sheets_[i].boxes[s], box)) near.push_back(s);
        return near;
    }

    /// Tells whether some triangle of the surface of a layer is near all of these points, and sets
    /// its number.
    [[nodiscard]] bool near_one(std::uint32_t i, std::span<const Vector4> points,
                                const Numbers& candidates, std::uint32_t& which) const {
        for (const std::uint32_t s : candidates)
            if (std::ranges::all_of(points, [&](const Vector4& p) {
                    return is_near(p, sheets_[i].triangles[s]);
                })) {
                which = s;
                return true;
            }
        return false;
    }

    void check_heights() {
        for (std::uint32_t t = 0; t < layered_.triangles.size(); ++t) {
            const Triangle& c = layered_.triangles[t];
            const std::array<Vector4, 3> corners{points_[c[0]], points_[c[1]], points_[c[2]]};
            bool on_some = false, same_side = false;
            for (const std::uint32_t i : layered_.surfaces_of[t]) {
                const auto near = near_triangles(i, t);
                std::uint32_t own = 0;
                if (near_one(i, corners, near, own)) {
                    on_some = true;
                    same_side = same_side || !seen_[t] ||
                                sheets_[i].triangles[own].flipped == seen_[t]->flipped;
                } else if (!is_replaced(i, t, near)) {
                    report(Rule::R63_layer_heights, {t},
                           "triangle " + text(t) + " is neither on the surface of " +
                               layer_name(i) + " nor on a harder one on whose wrong side that is");
                    on_some = same_side = true;
                }
            }
            if (!on_some)
                report(Rule::R63_layer_heights, {t}, "triangle " + text(t) + " is on no surface");
            else if (!same_side)
                report(Rule::R65_layer_sides, {t},
                       "triangle " + text(t) + " faces another side than its surface");
        }
    }

    /// Tells whether a triangle replaces all of a layer that it covers, rightly.
    [[nodiscard]] bool is_replaced(std::uint32_t i, std::uint32_t t, const Numbers& near) const {
        bool from_above = false, from_below = false;
        for (const std::uint32_t j : layered_.surfaces_of[t])
            if (j != i && is_harder(j, i)) (j < i ? from_above : from_below) = true;
        if (!from_above && !from_below) return false;
        if (!seen_[t] || (from_above && from_below)) return true;
        const Seen& replacing = *seen_[t];
        for (const std::uint32_t s : sheets_[i].tree.touching(boxes_[t])) {
            const Seen& own = sheets_[i].triangles[s];
            if (are_beside(own.corners, replacing.corners)) continue;
            const auto polygon = common_part(own.corners, replacing.corners);
            const bool right = std::ranges::all_of(polygon, [&](const Place& p) {
                const mpq_class depth =
                    height_over(own.corners, p) - height_over(replacing.corners, p);
                return (from_above ? sgn(depth) >= 0 : sgn(depth) <= 0) ||
                       is_near(point_over(replacing.corners, p), own);
            });
            if (right) continue;
            std::vector<Vector4> points;
            for (const Place& p : polygon) points.push_back(point_over(replacing.corners, p));
            std::uint32_t other = 0;
            if (!near_one(i, points, near, other)) return false;
        }
        return true;
    }

    // --- R64: places -----------------------------------------------------------------------------

    void check_places(std::uint32_t i) {
        check_edges(i);
        for (std::size_t s = 0; s < sheets_[i].triangles.size(); ++s)
            if (!is_under(sheets_[i], s, layers_[i]))
                report(Rule::R64_layer_places, {sheets_[i].triangles[s].number},
                       layer_name(i) + ", does not exist over a part of triangle " +
                           text(sheets_[i].triangles[s].number) + " of its surface");
        for (std::size_t t = 0; t < layers_[i].triangles.size(); ++t)
            if (!is_under(layers_[i], t, sheets_[i]))
                report(Rule::R64_layer_places, {layers_[i].triangles[t].number},
                       "triangle " + text(layers_[i].triangles[t].number) + " of " + layer_name(i) +
                           ", is where its surface does not exist");
    }

    /// Checks that a layer ends at borders of surfaces only.
    void check_edges(std::uint32_t i) {
        EdgeSides edges;
        for (const Seen& t : layers_[i].triangles)
            add_sides(t, layered_.triangles[t.number], edges);
        for (const auto& [edge, sides] : edges) {
            if (has_both_sides(sides)) continue;
            Vector4 from = points_[edge[0]], to = points_[edge[1]];
            from[2] = to[2] = 0;
            std::vector<Triangle> near;
            for (const std::uint32_t b :
                 borders_near(box_around(layered_.vertices, {edge[0], edge[1], edge[1]})))
                near.push_back(border_edges_[b]);
            if (from == to || segment_is_near({&from, &to}, border_points_, near, deviation_))
                continue;
            report(Rule::R64_layer_places, {edge[0], edge[1]},
                   layer_name(i) + ", ends at the edge of vertices " + text(edge) +
                       ", where no surface ends");
        }
    }

    /// Tells whether a triangle of one sheet is under or over triangles of another one, but for
    /// strips along borders.
    [[nodiscard]] bool is_under(const Sheet& sheet, std::size_t t, const Sheet& other) const {
        const UpwardCorners& c = sheet.triangles[t].corners;
        std::vector<SegmentInPlan> near;
        for (const std::uint32_t b : borders_near(sheet.boxes[t])) near.push_back(borders_[b]);
        const auto others = other.tree.touching(sheet.boxes[t]);
        for (const PlacePolygon& cell :
             divided_by({place_of(*c[0]), place_of(*c[1]), place_of(*c[2])}, near)) {
            if (cell.empty()) continue;
            const Place mean = mean_of(cell);
            if (std::ranges::any_of(others, [&](std::uint32_t o) {
                    return contains(other.triangles[o].corners, mean);
                }))
                continue;
            bool thin = false;
            for (std::size_t k = 0; k < cell.size() && !thin; ++k)
                thin = is_within(mean, {cell[k], cell[(k + 1) % cell.size()]}, width_);
            if (!thin) return false;
        }
        return true;
    }

    std::span<const Surface> surfaces_;
    const LayeredClaim& layered_;
    Violations& found_;
    Numbers first_;                         ///< per layer: the first point of its surface
    std::vector<Vector4> points_;           ///< of the mesh, then of the surfaces
    std::vector<Point3> doubles_;           ///< likewise
    mpz_class deviation_, width_;           ///< d, 2 d
    double reach_ = 0;                      ///< more than both
    std::vector<Sheet> sheets_;             ///< per layer: its surface
    std::vector<Sheet> layers_;             ///< per layer: its triangles of the mesh
    std::vector<Box> boxes_;                ///< per triangle of the mesh
    std::vector<std::optional<Seen>> seen_; ///< per triangle of the mesh; none: it is upright
    std::vector<SegmentInPlan> borders_;    ///< of all surfaces
    std::vector<Vector4> border_points_;    ///< their ends, at height 0
    std::vector<Triangle> border_edges_;    ///< indices into these
    std::vector<Box> border_boxes_;
    BoxTree border_tree_{{}, {}};
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
        found.push_back({rule, {}, "the order names no surface, one that is none, or one twice"});
    if (!has_layers(layered))
        found.push_back({rule, {}, "a triangle belongs to no layer, or to one that is none"});
    if (!std::isfinite(layered.deviation) || layered.deviation < 0)
        found.push_back({rule, {}, "the deviation is negative or not finite"});
    else if (layered.deviation > accepted)
        found.push_back(
            {rule, {}, "the stated deviation is larger than the largest that is accepted"});
}

} // namespace

void check_layered(std::span<const Surface> surfaces, const LayeredClaim& layered, double accepted,
                   Violations& found) {
    join_inputs(surfaces, found);
    check_layer_numbers(surfaces, layered, accepted, found);
    if (!found.empty()) return;
    for (Violation& flaw : verify_conforming(layered.vertices, layered.triangles))
        found.push_back({Rule::R61_layer_mesh, std::move(flaw.elements), std::move(flaw.sentence)});
    if (found.empty()) LayeredChecker(surfaces, layered, found).check();
}

} // namespace terrane::verifier
