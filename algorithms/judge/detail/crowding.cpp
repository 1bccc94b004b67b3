// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/detail/crowding.hpp>

#include <algorithm>
#include <span>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::judging {
namespace {

class CrowdingFinder {
public:
    CrowdingFinder(const Target& target, const Cells& cells, double bound) :
        target_(target), cells_(cells) {
        found_.reach = 16 * bound;
        for (std::uint32_t x = 0; x < target.exact.vertices.size(); ++x)
            found_.places.push_back(target.exact.nearest(VertexId(x)));
        found_.crowded.assign(places_.size(), false);
        found_.tree = std::make_unique<TriangleTree>(places_, target.triangles);
        found_.area_in_doubt.assign(cells.cells.size(), 0);
    }

    Crowding operator()(std::span<const std::uint32_t> clashing) {
        std::vector<std::uint32_t> corners;
        for (const Triangle& t : target_.triangles)
            corners.insert(corners.end(), t.begin(), t.end());
        const auto triangles_at =
            lists_by_key<std::uint32_t>(places_.size(), corners, [](std::size_t i) {
                return static_cast<std::uint32_t>(i / 3);
            });
        for (std::uint32_t x = 0; x < places_.size(); ++x) {
            if (!triangles_at[x].empty())
                for (const auto& near : found_.tree->within(places_[x], found_.reach))
                    if (std::ranges::count(near.triangle, x) == 0)
                        note(x, triangles_at[x], near.triangle);
            sort_unique(near_x_);
            found_.cells_near.values.insert(found_.cells_near.values.end(), near_x_.begin(),
                                            near_x_.end());
            found_.cells_near.close();
            near_x_.clear();
        }
        for (const std::uint32_t i : clashing) {
            const Triangle& t = target_.triangles[i];
            for (const std::uint32_t x : t) found_.crowded[x] = true;
            add_doubt(t, area(t));
        }
        for (const Triangle& t : target_.triangles) note_thin(t);
        return std::move(found_);
    }

private:
    /// Notes that a triangle is near a vertex of others.
    void note(std::uint32_t x, std::span<const std::uint32_t> at, const Triangle& near) {
        found_.crowded[x] = true;
        for (const std::uint32_t y : near) found_.crowded[y] = true;
        for_cells(near, [&](std::uint32_t cell) { near_x_.push_back(cell); });
        for (const std::uint32_t i : at) {
            const Triangle& t = target_.triangles[i];
            const double area = area_between(t, near);
            add_doubt(t, area);
            add_doubt(near, area);
        }
    }
    void note_thin(const Triangle& t) {
        const auto& [a, b, c] = t;
        auto& crowded = found_.crowded;
        if (is_thin(places_[a], places_[b], places_[c], found_.reach))
            crowded[a] = crowded[b] = crowded[c] = true;
        if (crowded[a] || crowded[b] || crowded[c])
            add_doubt(t, std::min(area(t), found_.reach * perimeter(t)));
    }
    void add_doubt(const Triangle& t, double area) {
        for_cells(t, [&](std::uint32_t cell) { found_.area_in_doubt[cell] += area; });
    }
    /// Visits the cells that have all corners of a triangle.
    template <class Visit>
    void for_cells(const Triangle& t, const Visit& visit) const {
        const auto& at = cells_.at_vertex;
        for (const std::uint32_t c : at[t[0]])
            if (std::ranges::binary_search(at[t[1]], c) && std::ranges::binary_search(at[t[2]], c))
                visit(c);
    }

    /// Bounds the area of either of two triangles that is near the other.
    [[nodiscard]] double area_between(const Triangle& s, const Triangle& t) const {
        const Point3 m = normal(s), n = normal(t);
        const double sine = length(cross(m, n)) / length(m) / length(n);
        const double width = 2 * found_.reach / sine; // of a strip along the line of both planes
        return std::min({area(s), area(t), width * perimeter(s), width * perimeter(t)});
    }
    [[nodiscard]] Point3 normal(const Triangle& t) const {
        return cross(minus(places_[t[1]], places_[t[0]]), minus(places_[t[2]], places_[t[0]]));
    }
    [[nodiscard]] double area(const Triangle& t) const { return length(normal(t)) / 2; }
    [[nodiscard]] double perimeter(const Triangle& t) const {
        const Point3 &a = places_[t[0]], &b = places_[t[1]], &c = places_[t[2]];
        return length(minus(b, a)) + length(minus(c, b)) + length(minus(a, c));
    }

    const Target& target_;
    const Cells& cells_;
    std::vector<std::uint32_t> near_x_; ///< cells near a vertex
    Crowding found_;
    const std::vector<Point3>& places_ = found_.places;
};

} // namespace

bool Crowding::is_near_others(const Point3& p) const {
    const auto near = tree->within(p, reach);
    return std::ranges::any_of(near, [&](const TriangleTree::Near& other) {
        const auto common = std::ranges::count_if(other.triangle, [&](std::uint32_t x) {
            return std::ranges::count(near[0].triangle, x) != 0;
        });
        return common < 2;
    });
}

bool is_thin(const Point3& a, const Point3& b, const Point3& c, double height) {
    const Point3 u = minus(b, a), v = minus(c, a);
    const double longest = std::max({length(u), length(v), length(minus(u, v))});
    return longest < 0x1p250 && length(cross(u, v)) <= height * longest; // the product may overflow
}

Crowding find_crowding(const Target& target, const Cells& cells, double bound,
                       std::span<const std::uint32_t> clashing) {
    return CrowdingFinder(target, cells, bound)(clashing);
}

} // namespace terrane::judging
