// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/layers/order_check.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <gmpxx.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

using Corners = std::array<Point3, 3>;

/// A place in the plane, in rationals.
struct Place {
    mpq_class x, y;
};

Place place_of(const Point3& p) {
    return {p.x, p.y};
}

mpq_class turn(const Place& a, const Place& b, const Place& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns the corners counterclockwise in the projection, or nothing for an upright triangle.
std::optional<Corners> seen_from_above(const Mesh& mesh, std::uint32_t triangle) {
    const Triangle& t = mesh.triangles[triangle];
    Corners c{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const Sign side = orient2d(Axis::z, c[0], c[1], c[2]);
    if (side == Sign::Zero) return std::nullopt;
    if (side == Sign::Negative) std::swap(c[1], c[2]);
    return c;
}

/// Tells whether the line of an edge of s separates the projections.
bool separates(const Corners& s, const Corners& t) {
    for (unsigned i = 0; i < 3; ++i) {
        const auto is_outside = [&](const Point3& p) {
            return orient2d(Axis::z, s[i], s[(i + 1) % 3], p) != Sign::Positive;
        };
        if (std::all_of(t.begin(), t.end(), is_outside)) return true;
    }
    return false;
}

/// Clips the projection of s by that of t.
std::vector<Place> common_polygon(const Corners& s, const Corners& t) {
    std::vector<Place> polygon{place_of(s[0]), place_of(s[1]), place_of(s[2])};
    for (unsigned i = 0; i < 3; ++i) {
        const Place a = place_of(t[i]), b = place_of(t[(i + 1) % 3]);
        std::vector<Place> kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Place &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
            const mpq_class u = turn(a, b, p), v = turn(a, b, q);
            if (u >= 0) kept.push_back(p);
            if (u * v < 0) {
                const mpq_class share = u / (u - v);
                kept.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
            }
        }
        polygon = std::move(kept);
    }
    return polygon;
}

mpq_class height(const Corners& t, const Place& p) {
    const Place a = place_of(t[0]), b = place_of(t[1]), c = place_of(t[2]);
    return (turn(b, c, p) * t[0].z + turn(c, a, p) * t[1].z + turn(a, b, p) * t[2].z) /
           turn(a, b, c);
}

/// Where a triangle of the upper layer is below one of the lower layer.
struct Below {
    std::vector<Place> polygon; ///< all places that the triangles have in common
    double depth = 0;           ///< the largest
    Point3 place{};             ///< of the largest depth
};

/// Returns by how much s comes to lie below t at most, and where; nothing if it is nowhere below.
std::optional<Below> below(const Corners& s, const Corners& t) {
    if (std::min({s[0].z, s[1].z, s[2].z}) >= std::max({t[0].z, t[1].z, t[2].z}))
        return std::nullopt;
    if (separates(s, t) || separates(t, s)) return std::nullopt;
    mpq_class deepest = 0;
    Below found{common_polygon(s, t), 0, {}};
    for (const Place& p : found.polygon) {
        const mpq_class z = height(s, p), depth = height(t, p) - z;
        if (depth <= deepest) continue;
        deepest = depth;
        found.depth = depth.get_d();
        found.place = {p.x.get_d(), p.y.get_d(), z.get_d()};
    }
    return deepest > 0 ? std::optional(std::move(found)) : std::nullopt;
}

/// Tells whether p is within the distance whose square is given of the segment a b.
bool is_near(const Place& p, const Place& a, const Place& b, const mpq_class& squared) {
    const mpq_class dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
    mpq_class share =
        length == 0 ? mpq_class(0) : mpq_class(((p.x - a.x) * dx + (p.y - a.y) * dy) / length);
    if (share < 0) share = 0;
    if (share > 1) share = 1;
    const mpq_class u = p.x - a.x - share * dx, v = p.y - a.y - share * dy;
    return u * u + v * v <= squared;
}

/// The triangles and border edges of each layer, and the range of all heights.
struct Layers {
    std::vector<std::vector<std::uint32_t>> triangles;
    std::vector<std::vector<Edge>> borders;
    double low = 0, high = 0;
};

/// Tells whether the whole polygon is within `width` of one border edge. A segment is convex, so
/// the corners decide.
bool is_beside(const std::vector<Place>& polygon, const Mesh& mesh, std::span<const Edge> borders,
               double width) {
    double x0 = HUGE_VAL, x1 = -x0, y0 = x0, y1 = x1;
    for (const Place& p : polygon) {
        x0 = std::min(x0, p.x.get_d());
        x1 = std::max(x1, p.x.get_d());
        y0 = std::min(y0, p.y.get_d());
        y1 = std::max(y1, p.y.get_d());
    }
    const double room = 4 * width; // more than the width and the rounding of these limits
    const mpq_class squared = mpq_class(width) * mpq_class(width);
    return std::any_of(borders.begin(), borders.end(), [&](const Edge& e) {
        const Point3 &a = mesh.vertices[e[0]], &b = mesh.vertices[e[1]];
        if (std::max(a.x, b.x) + room < x1 || std::min(a.x, b.x) - room > x0 ||
            std::max(a.y, b.y) + room < y1 || std::min(a.y, b.y) - room > y0)
            return false;
        return std::all_of(polygon.begin(), polygon.end(), [&](const Place& p) {
            return is_near(p, place_of(a), place_of(b), squared);
        });
    });
}

std::vector<Edge> borders_of(const Mesh& mesh, std::span<const std::uint32_t> layer) {
    std::vector<Edge> edges, borders;
    for (const std::uint32_t t : layer)
        for (unsigned i = 0; i < 3; ++i) {
            const auto [a, b] = std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]);
            edges.push_back({a, b});
        }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i)
        if ((i == 0 || edges[i - 1] != edges[i]) &&
            (i + 1 == edges.size() || edges[i + 1] != edges[i]))
            borders.push_back(edges[i]);
    return borders;
}

Layers layers_of(const Mesh& mesh) {
    Layers layers;
    layers.triangles.resize(mesh.surfaces.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t s : mesh.surfaces_of[t]) layers.triangles[s].push_back(t);
    for (const auto& layer : layers.triangles) layers.borders.push_back(borders_of(mesh, layer));
    for (const Point3& p : mesh.vertices) {
        layers.low = std::min(layers.low, p.z);
        layers.high = std::max(layers.high, p.z);
    }
    return layers;
}

/// Finds what is out of order between a layer and those that are lower in the order. The box of
/// each triangle of the upper layer reaches up to the highest point of all, that of the others down
/// to the lowest, so that exactly the pairs that may be out of order overlap.
Result<std::vector<OutOfOrder>> below_of(const Mesh& mesh, const Layers& layers,
                                         std::uint32_t upper, double step_width, const Run& run) {
    std::vector<Box> boxes;
    std::vector<std::uint32_t> groups, triangle_of, layer_of;
    for (std::uint32_t layer = upper; layer < layers.triangles.size(); ++layer)
        for (const std::uint32_t t : layers.triangles[layer]) {
            Box box = box_of(mesh.vertices, mesh.triangles[t]);
            (layer == upper ? box.high[2] : box.low[2]) = layer == upper ? layers.high : layers.low;
            boxes.push_back(box);
            groups.push_back(layer == upper ? 0 : 1);
            triangle_of.push_back(t);
            layer_of.push_back(layer);
        }
    const auto pairs = candidate_pairs(boxes, groups, Search::automatic, without_progress(run));
    const auto blocks = for_blocks<std::vector<OutOfOrder>>(
        pairs.size(), 1024, run, [&](std::size_t first, std::size_t last) {
            std::vector<OutOfOrder> found;
            for (std::size_t i = first; i < last; ++i) {
                const auto [a, b] = pairs[i];
                if (triangle_of[a] == triangle_of[b]) continue;
                const auto s = seen_from_above(mesh, triangle_of[a]),
                           t = seen_from_above(mesh, triangle_of[b]);
                if (!s || !t) continue;
                const std::uint32_t lower = layer_of[b];
                const auto wrong = below(*s, *t);
                if (!wrong || is_beside(wrong->polygon, mesh, layers.borders[upper], step_width) ||
                    is_beside(wrong->polygon, mesh, layers.borders[lower], step_width))
                    continue;
                found.push_back(
                    {upper, lower, {triangle_of[a], triangle_of[b]}, wrong->place, wrong->depth});
            }
            return found;
        });
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    std::vector<OutOfOrder> all;
    for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
    return all;
}

} // namespace

Result<std::vector<OutOfOrder>> find_out_of_order(const Mesh& mesh, double step_width,
                                                  const Run& run) {
    return guarded("for the order of layers", "layers", [&]() -> Result<std::vector<OutOfOrder>> {
        const Layers layers = layers_of(mesh);
        std::vector<OutOfOrder> all;
        for (std::uint32_t upper = 0; upper + 1 < layers.triangles.size(); ++upper) {
            const auto found = below_of(mesh, layers, upper, step_width, run);
            if (!found) return found.error();
            all.insert(all.end(), found->begin(), found->end());
        }
        std::sort(all.begin(), all.end(), [](const OutOfOrder& a, const OutOfOrder& b) {
            return std::tie(a.upper, a.lower, a.triangles) <
                   std::tie(b.upper, b.lower, b.triangles);
        });
        return all;
    });
}

} // namespace terrane
