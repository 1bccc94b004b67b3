// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/soup.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <optional>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

// Finds for each input vertex the first vertex at the same place. Points are divided into classes
// by a hash, with eight times as many classes as points. Most points are alone in their class; only
// the others are compared.
class Places {
public:
    /// Computes the classes of the vertices of all surfaces, which are `count` in number.
    Places(std::span<const Surface> surfaces, std::size_t count, const Run& run) : run_(run) {
        const auto shift = 64 - static_cast<unsigned>(std::bit_width(8 * count + 64));
        words_ = (std::size_t{1} << (64 - shift)) / 64;
        class_of_.resize(count);
        std::uint32_t* classes = class_of_.data();
        for (const Surface& s : surfaces) {
            for_ranges(s.vertices.size(), run, [&](std::size_t begin, std::size_t end) {
                for (std::size_t v = begin; v < end; ++v)
                    classes[v] = static_cast<std::uint32_t>(hash_of(s.vertices[v]) >> shift);
            });
            classes += s.vertices.size();
        }
    }

    /// Returns the first vertex at the place of each vertex. `points` are the vertices of all
    /// surfaces.
    [[nodiscard]] std::vector<std::uint32_t> first_at_same(const std::vector<Point3>& points) {
        find_shared_classes();
        std::vector<std::uint32_t> first(points.size());
        const auto others = concatenated(parts_of_ranges<std::vector<std::uint32_t>>(
            points.size(), run_, [&](std::size_t begin, std::size_t end) {
                std::vector<std::uint32_t> part;
                for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
                    first[v] = v;
                    const std::uint32_t c = class_of_[v];
                    if ((shared_[c / 64] >> (c % 64) & 1) != 0) part.push_back(v);
                }
                return part;
            }));
        name_first(points, others, first);
        return first;
    }

private:
    // Each thread handles classes of its own; points at one place have one class.
    void name_first(const std::vector<Point3>& points, const std::vector<std::uint32_t>& others,
                    std::vector<std::uint32_t>& first) {
        constexpr std::size_t few = least_range; // points
        const std::size_t shares =
            std::clamp<std::size_t>(others.size() / few, 1, std::max(run_.threads, 1U));
        for_ranges(
            shares, run_,
            [&](std::size_t begin, std::size_t end) {
                for (std::size_t share = begin; share < end; ++share) {
                    PointTable seen(others.size());
                    for (const std::uint32_t v : others)
                        if (class_of_[v] % shares == share) first[v] = seen.enter(points, v);
                }
            },
            1, 1);
    }

    // Marks the classes with several points. Each thread reads all points and handles the classes
    // of its own range of words.
    void find_shared_classes() {
        std::vector<std::uint64_t> taken(words_, 0);
        shared_.assign(words_, 0);
        for_ranges(
            words_, run_,
            [&](std::size_t first, std::size_t last) {
                for (const std::uint32_t c : class_of_) {
                    const std::size_t word = c / 64;
                    if (word < first || word >= last) continue;
                    const std::uint64_t bit = std::uint64_t{1} << (c % 64);
                    shared_[word] |= taken[word] & bit;
                    taken[word] |= bit;
                }
            },
            1);
    }

    const Run& run_;
    std::size_t words_ = 0;
    UninitializedVector<std::uint32_t> class_of_; ///< per point
    std::vector<std::uint64_t> shared_;           ///< a bit per class: 1 if it has several points
};

Sign turn_of(const std::vector<Point3>& points, const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return Sign::Zero;
    return orient2d(Axis::z, points[t[0]], points[t[1]], points[t[2]]);
}

bool has_area(const std::vector<Point3>& points, const Triangle& t, Sign turn) {
    if (turn != Sign::Zero) return true;
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
    return !collinear(points[t[0]], points[t[1]], points[t[2]]);
}

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

// Whether two triangles may have the same corners, with the vertex of these sides as the lowest.
// Two edges at that vertex then have both triangles. In most cases the sides alone exclude this.
bool may_repeat(std::span<const EdgeSides::Side> of_low) {
    constexpr std::size_t few = 16;
    if (of_low.size() < 4) return false;
    if (of_low.size() > few) return true;
    std::array<std::uint64_t, few / 2> pairs{};
    std::size_t count = 0;
    for (std::size_t i = 0; i + 1 < of_low.size(); ++i) {
        if (of_low[i].high != of_low[i + 1].high) continue;
        if (i + 2 < of_low.size() && of_low[i + 2].high == of_low[i].high) return true;
        const std::uint64_t pair = std::uint64_t{of_low[i].triangle} << 32 | of_low[i + 1].triangle;
        for (std::size_t k = 0; k < count; ++k)
            if (pairs[k] == pair) return true;
        pairs[count++] = pair;
        ++i;
    }
    return false;
}

// Returns the triangles that have the same corners as an earlier one, each with the first of these.
// Such triangles share the edge of their two lower vertices.
Pairs repeated_triangles(const Soup& soup, std::size_t first_vertex, std::size_t last_vertex) {
    Pairs repeated, by_third;
    const auto add = [&](std::uint32_t low, std::uint32_t high, auto sides) {
        if (sides.size() < 2) return;
        by_third.clear();
        for (const auto& s : sides) {
            const Triangle& t = soup.triangles[s.triangle];
            const std::uint32_t third = t[0] ^ t[1] ^ t[2] ^ low ^ high;
            if (third > high) by_third.push_back({third, s.triangle});
        }
        if (by_third.size() < 2) return;
        std::sort(by_third.begin(), by_third.end());
        for (std::size_t i = 1, lead = 0; i < by_third.size(); ++i)
            if (by_third[i][0] != by_third[lead][0])
                lead = i;
            else
                repeated.push_back({by_third[i][1], by_third[lead][1]});
    };
    const auto& starts = soup.edges.starts;
    for (std::size_t v = first_vertex; v < last_vertex; ++v)
        if (may_repeat(std::span(soup.edges.sides).subspan(starts[v], starts[v + 1] - starts[v])))
            soup.edges.for_each(v, v + 1, add);
    return repeated;
}

// Returns for each triangle the first one with the same corners; nothing if all differ.
std::vector<std::uint32_t> first_with_same_corners(const Soup& soup, const Run& run) {
    const auto parts = parts_of_ranges<Pairs>(
        soup.edges.starts.size() - 1, run,
        [&](std::size_t first, std::size_t last) { return repeated_triangles(soup, first, last); });
    std::vector<std::uint32_t> first;
    if (std::all_of(parts.begin(), parts.end(), [](const Pairs& p) { return p.empty(); }))
        return first;
    first.resize(soup.triangles.size());
    std::iota(first.begin(), first.end(), 0u);
    for (const Pairs& part : parts)
        for (const auto& [triangle, lead] : part) first[triangle] = lead;
    return first;
}

void name_corners(Soup& soup, std::span<const Surface> surfaces,
                  const std::vector<std::uint32_t>& first, const Run& run) {
    soup.input_corners.resize(soup.first_input_triangle.back());
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const auto& triangles = surfaces[s].triangles;
        const std::uint32_t* const of = first.data() + soup.first_input_vertex[s];
        Triangle* const corners = soup.input_corners.data() + soup.first_input_triangle[s];
        for_ranges(triangles.size(), run, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) {
                const Triangle& c = triangles[t];
                corners[t] = {of[c[0]], of[c[1]], of[c[2]]};
            }
        });
    }
}

// Takes the input triangles with an area and lists the others.
void take_triangles(Soup& soup, const Run& run) {
    UninitializedVector<Sign> turns; // per input triangle
    turns.resize(soup.input_corners.size());
    soup.degenerate = concatenated(parts_of_ranges<std::vector<std::uint32_t>>(
        soup.input_corners.size(), run, [&](std::size_t begin, std::size_t end) {
            std::vector<std::uint32_t> part;
            for (auto t = static_cast<std::uint32_t>(begin); t < end; ++t) {
                turns[t] = turn_of(soup.points, soup.input_corners[t]);
                if (!has_area(soup.points, soup.input_corners[t], turns[t])) part.push_back(t);
            }
            return part;
        }));
    const std::size_t inputs = soup.input_corners.size();
    soup.triangles.resize(inputs - soup.degenerate.size());
    soup.input_of.resize(soup.triangles.size());
    soup.surface_of.resize(soup.triangles.size());
    soup.turns.resize(soup.triangles.size());
    for_ranges(inputs, run, [&](std::size_t begin, std::size_t end) {
        auto next = std::lower_bound(soup.degenerate.begin(), soup.degenerate.end(), begin);
        const auto& starts = soup.first_input_triangle;
        auto s = static_cast<std::uint32_t>(std::upper_bound(starts.begin(), starts.end(), begin) -
                                            starts.begin() - 1);
        std::size_t to = begin - static_cast<std::size_t>(next - soup.degenerate.begin());
        for (auto t = static_cast<std::uint32_t>(begin); t < end; ++t) {
            while (t >= starts[s + 1]) ++s;
            if (next != soup.degenerate.end() && *next == t) {
                ++next;
                continue;
            }
            soup.triangles[to] = soup.input_corners[t];
            soup.turns[to] = turns[t];
            soup.input_of[to] = t;
            soup.surface_of[to++] = s;
        }
    });
}

} // namespace

Soup merge_with_repeated(std::span<const Surface> surfaces, const Run& run) {
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
    std::optional<Places> places;
    both(
        run,
        [&] {
            soup.points.reserve(vertices);
            for (const Surface& s : surfaces)
                soup.points.insert(soup.points.end(), s.vertices.begin(), s.vertices.end());
        },
        [&] { places.emplace(surfaces, vertices, run); });
    const auto first = places->first_at_same(soup.points);
    places.reset();
    name_corners(soup, surfaces, first, run);
    take_triangles(soup, run);
    return soup;
}

bool set_repeated_aside(Soup& soup, const Run& run) {
    const auto first = first_with_same_corners(soup, run);
    if (first.empty()) return false;
    std::uint32_t kept = 0;
    const auto input_of = soup.input_of;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (first[t] != t) {
            soup.duplicates.push_back({input_of[t], input_of[first[t]]});
            continue;
        }
        soup.triangles[kept] = soup.triangles[t];
        soup.input_of[kept] = soup.input_of[t];
        soup.turns[kept] = soup.turns[t];
        soup.surface_of[kept++] = soup.surface_of[t];
    }
    soup.triangles.resize(kept);
    soup.input_of.resize(kept);
    soup.surface_of.resize(kept);
    soup.turns.resize(kept);
    soup.edges = group_edges(soup.triangles, soup.points.size(), run);
    return true;
}

Soup merge_surfaces(std::span<const Surface> surfaces, const Run& run) {
    Soup soup = merge_with_repeated(surfaces, run);
    soup.edges = group_edges(soup.triangles, soup.points.size(), run);
    set_repeated_aside(soup, run);
    return soup;
}

std::vector<Box> boxes_of(std::span<const Point3> points, std::span<const Triangle> triangles) {
    return BoxSource(points, triangles).listed();
}

} // namespace terrane
