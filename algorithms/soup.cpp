// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/soup.hpp>

#include <algorithm>
#include <bit>

#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

std::uint64_t mix(std::uint64_t h, std::uint64_t v) {
    h = (h ^ v) * 0x9e3779b97f4a7c15u;
    return h ^ (h >> 29);
}

std::uint64_t hash(const Point3& p) {
    const auto bits = [](double d) { return std::bit_cast<std::uint64_t>(d + 0.0); }; // -0 is 0
    std::uint64_t h = mix(mix(mix(0, bits(p.x)), bits(p.y)), bits(p.z));
    return mix(h, h >> 32);
}

std::uint64_t hash(const Triangle& t) {
    const std::uint64_t h = mix(mix(mix(0, t[0]), t[1]), t[2]);
    return mix(h, h >> 32);
}

// Open addressing: find(key) gives the first index that was entered with an equal key.
template <class Key>
class FirstIndex {
public:
    explicit FirstIndex(std::size_t expected) : slots_(std::bit_ceil(2 * expected + 2), none) {}

    template <class KeyOf>
    std::uint32_t enter(const Key& key, std::uint32_t index, const KeyOf& key_of) {
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t s = hash(key) & mask;; s = (s + 1) & mask) {
            if (slots_[s] == none) return slots_[s] = index;
            if (key_of(slots_[s]) == key) return slots_[s];
        }
    }

private:
    std::vector<std::uint32_t> slots_;
};

// Per input vertex, the first one at the same place.
std::vector<std::uint32_t> first_at_same_place(const std::vector<Point3>& points) {
    FirstIndex<Point3> seen(points.size());
    std::vector<std::uint32_t> first(points.size());
    for (std::uint32_t v = 0; v < points.size(); ++v)
        first[v] = seen.enter(points[v], v, [&](std::uint32_t w) { return points[w]; });
    return first;
}

bool has_area(const std::vector<Point3>& points, const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
    return !collinear(points[t[0]], points[t[1]], points[t[2]]);
}

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

// Keeps the distinct triangles of the soup, lists the rest.
void set_duplicates_aside(Soup& soup) {
    FirstIndex<Triangle> seen(soup.triangles.size());
    const auto key = [&](std::uint32_t t) { return sorted(soup.triangles[t]); };
    std::uint32_t kept = 0;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        soup.triangles[kept] = soup.triangles[t];
        soup.input_of[kept] = soup.input_of[t];
        soup.surface_of[kept] = soup.surface_of[t];
        const std::uint32_t first = seen.enter(key(kept), kept, key);
        if (first == kept)
            ++kept;
        else
            soup.duplicates.push_back({soup.input_of[kept], soup.input_of[first]});
    }
    soup.triangles.resize(kept);
    soup.input_of.resize(kept);
    soup.surface_of.resize(kept);
}

} // namespace

Soup merge_surfaces(std::span<const Surface> surfaces) {
    Soup soup;
    std::size_t vertices = 0, triangles = 0;
    for (const Surface& s : surfaces) {
        soup.first_input_vertex.push_back(static_cast<std::uint32_t>(vertices));
        soup.first_input_triangle.push_back(static_cast<std::uint32_t>(triangles));
        vertices += s.vertices.size();
        triangles += s.triangles.size();
    }
    soup.first_input_vertex.push_back(static_cast<std::uint32_t>(vertices));
    soup.first_input_triangle.push_back(static_cast<std::uint32_t>(triangles));
    soup.points.reserve(vertices);
    for (const Surface& s : surfaces)
        soup.points.insert(soup.points.end(), s.vertices.begin(), s.vertices.end());

    const auto first = first_at_same_place(soup.points);
    soup.triangles.reserve(triangles);
    soup.input_corners.reserve(triangles);
    soup.input_of.reserve(triangles);
    soup.surface_of.reserve(triangles);
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        const std::uint32_t base = soup.first_input_vertex[s];
        std::uint32_t input = soup.first_input_triangle[s];
        for (const Triangle& t : surfaces[s].triangles) {
            const Triangle merged{first[base + t[0]], first[base + t[1]], first[base + t[2]]};
            soup.input_corners.push_back(merged);
            if (has_area(soup.points, merged)) {
                soup.triangles.push_back(merged);
                soup.input_of.push_back(input);
                soup.surface_of.push_back(s);
            } else {
                soup.degenerate.push_back(input);
            }
            ++input;
        }
    }
    set_duplicates_aside(soup);
    return soup;
}

std::vector<Box> boxes_of(std::span<const Point3> points, std::span<const Triangle> triangles) {
    std::vector<Box> boxes;
    boxes.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        const Point3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
        boxes.push_back(
            {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
             {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}});
    }
    return boxes;
}

} // namespace terrane
