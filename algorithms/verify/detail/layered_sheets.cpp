// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/layered_sheets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <utility>

#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/edges.hpp>

namespace terrane::verifier {

Box without_height(Box box) {
    box.low[2] = -infinity;
    box.high[2] = infinity;
    return box;
}

void Sheet::finish() {
    auto flat = boxes;
    for (Box& box : flat) box = without_height(box);
    tree = BoxTree(std::move(flat));
}

void add_sides(const Seen& t, const Triangle& numbers, EdgeSides& edges) {
    for (const HalfEdge& side : sides_of(numbers))
        edges[side.edge].push_back(side.ascends != t.flipped ? 1 : -1);
}

bool has_both_sides(const std::vector<int>& sides) {
    return sides.size() == 2 && sides[0] != sides[1];
}

LayerSheets::LayerSheets(std::span<const Surface> surfaces_of_inputs, const LayeredClaim& layered) :
    inputs(surfaces_of_inputs), claim(layered), doubles_(layered.vertices) {
    for (const CertifiedLayer& layer : layered.order) {
        const auto& vertices = inputs[layer.surface].vertices;
        first.push_back(static_cast<std::uint32_t>(doubles_.size()));
        doubles_.insert(doubles_.end(), vertices.begin(), vertices.end());
    }
    std::vector<Point3> all = doubles_;
    all.push_back({layered.deviation, layered.thickness.value_or(0), 0});
    ScaledPoints scaled = scale_to_integers(all);
    points = std::move(scaled.points);
    scale = scaled.scale;
    deviation = points.back()[0];
    thickness = points.back()[1];
    width = 2 * deviation;
    reach = 4 * layered.deviation;
}

bool LayerSheets::find(Violations& found) {
    if (!find_surfaces(found)) return false;
    find_borders();
    find_layers();
    return true;
}

std::string LayerSheets::name(std::uint32_t layer) const {
    return "layer " + text(layer) + ", " + inputs[claim.order[layer].surface].name;
}

bool LayerSheets::is_harder(std::uint32_t i, std::uint32_t j) const {
    const double a = claim.order[i].hardness, b = claim.order[j].hardness;
    return a > b || (a == b && i < j);
}

Numbers LayerSheets::borders_near(const Box& box) const {
    return border_tree_.touching(without_height(widened_by(box, reach)));
}

Numbers LayerSheets::near_triangles(std::uint32_t layer, const Box& box) const {
    Numbers near;
    const Box wide = widened_by(box, reach);
    for (const std::uint32_t s : surfaces[layer].tree.touching(without_height(wide)))
        if (touch(surfaces[layer].boxes[s], wide)) near.push_back(s);
    return near;
}

std::optional<std::uint32_t> LayerSheets::near_one(std::uint32_t layer,
                                                   std::span<const Vector4> around,
                                                   const Numbers& candidates) const {
    for (const std::uint32_t s : candidates)
        if (std::ranges::all_of(
                around, [&](const Vector4& p) { return is_near(p, surfaces[layer].triangles[s]); }))
            return s;
    return std::nullopt;
}

bool LayerSheets::is_near(const Vector4& point, const Seen& s) const {
    return within(point, {s.corners[0], s.corners[1], s.corners[2]}, deviation);
}

std::optional<Seen> LayerSheets::seen_of(std::uint32_t number, const Triangle& t,
                                         std::uint32_t first_point) const {
    Seen result{
        number,
        {&points[first_point + t[0]], &points[first_point + t[1]], &points[first_point + t[2]]},
        false};
    const auto corners = upward(result.corners, result.flipped);
    if (!corners) return std::nullopt;
    result.corners = *corners;
    return result;
}

bool LayerSheets::find_surfaces(Violations& found) {
    for (std::uint32_t i = 0; i < claim.order.size(); ++i) {
        const Surface& s = inputs[claim.order[i].surface];
        Sheet& sheet = surfaces.emplace_back();
        for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
            const Triangle& c = s.triangles[t];
            if (const auto from_above = seen_of(t, c, first[i])) {
                sheet.add(*from_above, box_of(s.vertices, c));
            } else if (has_area(c, first[i])) {
                found.push_back(
                    {Rule::R60_layer_lists,
                     {t},
                     "triangle " + text(t) + " of the surface of " + name(i) + " is upright"});
                return false;
            }
        }
        sheet.finish();
    }
    return true;
}

bool LayerSheets::has_area(const Triangle& t, std::uint32_t first_point) const {
    return projection_axis(orthogonal(points[first_point + t[0]], points[first_point + t[1]],
                                      points[first_point + t[2]]))
        .has_value();
}

/// Finds the borders of all surfaces. Vertices at one place are one vertex.
void LayerSheets::find_borders() {
    std::map<std::array<Vector4, 2>, bool> unique;
    std::vector<Box> border_boxes;
    const auto add_border = [&](std::uint32_t a, std::uint32_t b) {
        std::array<Vector4, 2> ends{points[a], points[b]};
        for (Vector4& end : ends) end[2] = 0;
        std::ranges::sort(ends);
        if (ends[0] == ends[1] || !unique.try_emplace(ends, true).second) return;
        borders.push_back({place_of(ends[0]), place_of(ends[1])});
        const auto number = static_cast<std::uint32_t>(border_points.size());
        border_points.insert(border_points.end(), ends.begin(), ends.end());
        border_edges.push_back({number, number + 1, number + 1});
        border_boxes.push_back(without_height(box_of(doubles_, {a, b, b})));
    };
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
        const Surface& s = inputs[claim.order[i].surface];
        std::map<Point3, std::uint32_t> first_at;
        Numbers merged;
        for (std::uint32_t v = 0; v < s.vertices.size(); ++v)
            merged.push_back(first_at.try_emplace(s.vertices[v], v).first->second);
        EdgeSides edges;
        std::map<std::array<std::uint32_t, 3>, bool> known; // a repeated triangle counts once
        for (const Seen& t : surfaces[i].triangles) {
            Triangle c = s.triangles[t.number];
            for (std::uint32_t& corner : c) corner = merged[corner];
            auto sorted = c;
            std::ranges::sort(sorted);
            if (known.try_emplace(sorted, true).second) add_sides(t, c, edges);
        }
        for (const auto& [edge, sides] : edges)
            if (!has_both_sides(sides)) add_border(first[i] + edge[0], first[i] + edge[1]);
    }
    border_tree_ = BoxTree(std::move(border_boxes));
}

/// Tells whether a corner is within 2 d of the opposite side in the projection. For most triangles
/// doubles decide: differences, products and their difference are each off by 2^-53 of themselves,
/// so that the area is off by less than 2^-50 of the sum of its two terms.
bool LayerSheets::is_thin(const Seen& t) const {
    const Triangle& n = claim.triangles[t.number];
    const Point3 &a = claim.vertices[n[0]], &b = claim.vertices[n[1]], &c = claim.vertices[n[2]];
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
    const double off = 0x1p-50 * (std::fabs(ux * vy) + std::fabs(uy * vx));
    const double longest =
        std::max({std::hypot(ux, uy), std::hypot(vx, vy), std::hypot(vx - ux, vy - uy)});
    if (std::fabs(ux * vy - uy * vx) - off > 3 * claim.deviation * longest && longest > 0x1p-400)
        return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (is_within(place_of(*t.corners[k]),
                      {place_of(*t.corners[(k + 1) % 3]), place_of(*t.corners[(k + 2) % 3])},
                      width))
            return true;
    return false;
}

EdgeSides LayerSheets::sides_of_layer(std::uint32_t layer) const {
    EdgeSides edges;
    std::map<Edge, Numbers> open; // edges of triangles that face aside, which are not placed yet
    Numbers aside;
    for (std::uint32_t t = 0; t < claim.triangles.size(); ++t) {
        if (!std::ranges::binary_search(claim.surfaces_of[t], layer)) continue;
        if (!aside_[t]) {
            add_sides(*seen[t], claim.triangles[t], edges);
            continue;
        }
        aside.push_back(t);
        for (const HalfEdge& side : sides_of(claim.triangles[t])) open[side.edge].push_back(t);
    }
    std::deque<std::uint32_t> next(aside.begin(), aside.end());
    std::vector<bool> placed(claim.triangles.size(), false);
    const auto place = [&](std::uint32_t t, bool flipped) {
        placed[t] = true;
        add_sides({t, {}, flipped}, claim.triangles[t], edges);
        for (const HalfEdge& side : sides_of(claim.triangles[t]))
            for (const std::uint32_t beside : open[side.edge])
                if (!placed[beside]) next.push_back(beside);
    };
    const auto place_by_neighbours = [&] {
        for (; !next.empty(); next.pop_front()) {
            const std::uint32_t t = next.front();
            int room = 0; // more edges leave room for the one side, or for the other
            bool has_neighbour = false;
            for (const HalfEdge& side : sides_of(claim.triangles[t])) {
                const auto at = edges.find(side.edge);
                if (at == edges.end() || at->second.size() != 1) continue;
                has_neighbour = true;
                room += at->second[0] == (side.ascends ? 1 : -1) ? -1 : 1;
            }
            if (!placed[t] && has_neighbour) place(t, room < 0);
        }
    };
    place_by_neighbours();
    for (const std::uint32_t t : aside)
        if (!placed[t]) {
            place(t, seen[t] && seen[t]->flipped);
            place_by_neighbours();
        }
    return edges;
}

void LayerSheets::find_layers() {
    layers.resize(claim.order.size());
    for (std::uint32_t t = 0; t < claim.triangles.size(); ++t) {
        boxes.push_back(box_of(claim.vertices, claim.triangles[t]));
        seen.push_back(seen_of(t, claim.triangles[t], 0));
        aside_.push_back(!seen[t] || is_thin(*seen[t]));
        if (seen.back())
            for (const std::uint32_t i : claim.surfaces_of[t])
                layers[i].add(*seen.back(), boxes[t]);
    }
    for (Sheet& layer : layers) layer.finish();
}

} // namespace terrane::verifier
