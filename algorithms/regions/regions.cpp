// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/regions/regions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/regions/regions_over.hpp>

namespace terrane {
namespace {

double area_of_corners(const Point3& a, const Point3& b, const Point3& c) {
    const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
    const double wx = c.x - a.x, wy = c.y - a.y, wz = c.z - a.z;
    const double x = uy * wz - uz * wy, y = uz * wx - ux * wz, z = ux * wy - uy * wx;
    const double squared = x * x + y * y + z * z;
    // The limits come from the range of double and are no tolerance: outside of them relevant
    // squares may have underflown or overflown.
    const bool in_range = squared > std::numeric_limits<double>::min() * 0x1p+100 &&
                          squared <= std::numeric_limits<double>::max();
    return 0.5 * (in_range ? std::sqrt(squared) : std::hypot(x, y, z));
}

double area_of(std::span<const Point3> v, const Triangle& t) {
    return measure(2, area_of_corners, v[t[0]], v[t[1]], v[t[2]]);
}

/// Joins triangles across edges. A slot stands for a triangle in one of its surfaces.
class Diffusion {
public:
    Diffusion(std::span<const Triangle> triangles, const IndexLists<std::uint32_t>& surfaces_of,
              std::span<const Edge> stops, const Run& run) :
        triangles_(triangles),
        surfaces_of_(surfaces_of), stops_(stops), run_(run), sets_(surfaces_of.values.size()) {}

    /// Joins triangles across all edges that are not stops, and lists the triangles at the stops.
    void spread(const Adjacency& adjacency) {
        spread_within(adjacency.inner);
        auto stop = stops_.begin();
        for (std::size_t e = 0; e < adjacency.edges.size(); ++e) {
            const auto sides = adjacency.triangles_at[e];
            while (stop != stops_.end() && *stop < adjacency.edges[e]) ++stop;
            if (stop != stops_.end() && *stop == adjacency.edges[e]) {
                at_stop_.push_back(sides);
                edge_of_stop_.push_back(*stop);
            } else if (sides.size() == 2)
                join(sides[0], sides[1]);
        }
    }

    Regions number(std::span<const Point3> vertices) {
        Regions out;
        const auto& surfaces = surfaces_of_;
        const auto& first_slot = sets_.flattened();
        auto order = first_slots(first_slot); // of regions: by surface, then by triangle
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return surfaces.values[a] < surfaces.values[b];
        });
        std::vector<std::uint32_t> number_of(surfaces.values.size());
        for (const std::uint32_t s : order) {
            number_of[s] = static_cast<std::uint32_t>(out.regions.size());
            out.regions.push_back({SurfaceId(surfaces.values[s]), triangle_of(s), 0, 0, {}});
        }
        out.regions_of.offsets = surfaces.offsets;
        auto& region_of = out.regions_of.values;
        region_of.resize(surfaces.values.size());
        for_ranges(region_of.size(), run_, [&](std::size_t first, std::size_t last) {
            for (std::size_t s = first; s < last; ++s) region_of[s] = number_of[first_slot[s]];
        });
        measure(vertices, out);
        find_neighbours(out);
        return out;
    }

private:
    /// Joins triangles across inner edges. Each range of triangles has its own sets, so that
    /// threads do not interfere; edges between two ranges follow afterwards.
    void spread_within(const std::vector<Adjacency::Inner>& inner) {
        const auto crossing = parts_of_ranges<Adjacency::Inner>(
            surfaces_of_.size(), run_,
            [&](std::size_t first, std::size_t last) {
                Adjacency::Inner others;
                const auto join_those_within = [&](const auto& slot) {
                    for (const auto& list : inner)
                        for (const auto& [t, u] : list) {
                            if (t < first || t >= last) continue;
                            if (u >= first && u < last)
                                sets_.join(slot(t), slot(u));
                            else
                                others.push_back({t, u});
                        }
                };
                if (surfaces_of_.values.size() == surfaces_of_.size()) // each triangle has one slot
                    join_those_within([](std::uint32_t t) { return t; });
                else
                    join_those_within([&](std::uint32_t t) { return surfaces_of_.offsets[t]; });
                return others;
            },
            1);
        for (const auto& part : crossing)
            for (const auto& [t, u] : part)
                sets_.join(surfaces_of_.offsets[t], surfaces_of_.offsets[u]);
    }

    [[nodiscard]] std::uint32_t triangle_of(std::uint32_t slot) const {
        const auto& offsets = surfaces_of_.offsets;
        return static_cast<std::uint32_t>(std::upper_bound(offsets.begin(), offsets.end(), slot) -
                                          offsets.begin() - 1);
    }

    /// Consecutive triangles that lie in the same regions, as a part of one of these regions.
    struct Stretch {
        std::uint32_t region;
        std::size_t triangles;
        double area;
    };

    /// Counts the triangles of each region and sums up their areas. The last digits of a sum depend
    /// on its order. So stretches end at multiples of a fixed number of triangles and are added one
    /// after the other: the sums do not depend on the number of threads.
    void measure(std::span<const Point3> vertices, Regions& out) const {
        constexpr std::size_t block = 4096;
        const std::size_t count = triangles_.size();
        const auto cut = [&](std::size_t t) {
            return t == count ? t : (t + block - 1) / block * block;
        };
        const auto parts = parts_of_ranges<std::vector<Stretch>>(
            count, run_, [&](std::size_t first, std::size_t last) {
                std::vector<Stretch> part;
                const std::size_t end = std::min(count, cut(last));
                for (std::size_t t = cut(first); t < end;) {
                    const std::size_t block_end = std::min(end, (t / block + 1) * block);
                    const auto regions = out.regions_of[t];
                    const std::size_t start = t;
                    double area = 0;
                    do area += area_of(vertices, triangles_[t]);
                    while (++t < block_end && std::ranges::equal(out.regions_of[t], regions));
                    for (const std::uint32_t r : regions) part.push_back({r, t - start, area});
                }
                return part;
            });
        for (const auto& part : parts)
            for (const Stretch& s : part) {
                out.regions[s.region].triangles += s.triangles;
                out.regions[s.region].area += s.area;
            }
    }

    // Two triangles at an edge that is not a stop lie in the same surfaces.
    void join(std::uint32_t t, std::uint32_t u) {
        const std::uint32_t a = surfaces_of_.offsets[t], b = surfaces_of_.offsets[u];
        const auto n = surfaces_of_[t].size();
        for (std::uint32_t k = 0; k < n; ++k) sets_.join(a + k, b + k);
    }

    /// Returns the slots that are the first of their set, ascending.
    [[nodiscard]] std::vector<std::uint32_t>
    first_slots(const std::vector<std::uint32_t>& first_slot) const {
        return concatenated(parts_of_ranges<std::vector<std::uint32_t>>(
            first_slot.size(), run_, [&](std::size_t first, std::size_t last) {
                std::vector<std::uint32_t> part;
                for (auto s = static_cast<std::uint32_t>(first); s < last; ++s)
                    if (first_slot[s] == s) part.push_back(s);
                return part;
            }));
    }

    /// Lists the regions at a stop, ascending.
    void find_regions_at(std::size_t stop, const Regions& out,
                         std::vector<std::uint32_t>& here) const {
        here.clear();
        for (const std::uint32_t t : at_stop_[stop]) {
            const auto regions = out.regions_of[t];
            here.insert(here.end(), regions.begin(), regions.end());
        }
        sort_unique(here);
    }

    /// Most regions that meet at an edge of a curve where two surfaces cross.
    static constexpr std::size_t few = 4;

    [[nodiscard]] bool is_crowded(std::size_t stop) const {
        std::size_t regions = 0;
        for (const std::uint32_t t : at_stop_[stop]) regions += surfaces_of_[t].size();
        return regions > few;
    }

    /// A stop where more than a few regions meet.
    struct CrowdedStop {
        std::uint32_t stop;
        std::uint32_t before; ///< one that is listed before and shares a vertex, or no_index
    };

    /// Lists the crowded stops along the curves that they form.
    [[nodiscard]] std::vector<CrowdedStop> crowded_stops() const {
        std::vector<std::array<std::uint32_t, 2>> at_vertex; // {vertex, stop}
        for (std::uint32_t e = 0; e < at_stop_.size(); ++e)
            if (is_crowded(e))
                for (const std::uint32_t v : edge_of_stop_[e]) at_vertex.push_back({v, e});
        std::sort(at_vertex.begin(), at_vertex.end());
        std::vector<CrowdedStop> list;
        std::vector<bool> listed(at_stop_.size(), false);
        const auto append = [&](std::uint32_t stop, std::uint32_t before) {
            if (!listed[stop]) list.push_back({stop, before});
            listed[stop] = true;
        };
        std::vector<bool> visited(at_vertex.size(),
                                  false); // entries that are the first of a vertex
        for (const auto& [vertex, stop] : at_vertex) {
            const std::size_t first = list.size();
            append(stop, no_index);
            for (std::size_t k = first; k < list.size(); ++k)
                for (const std::uint32_t v : edge_of_stop_[list[k].stop]) {
                    auto at = std::lower_bound(at_vertex.begin(), at_vertex.end(),
                                               std::array{v, std::uint32_t{0}});
                    const auto entry = static_cast<std::size_t>(at - at_vertex.begin());
                    if (visited[entry]) continue;
                    visited[entry] = true;
                    for (; at != at_vertex.end() && (*at)[0] == v; ++at)
                        append((*at)[1], list[k].stop);
                }
        }
        return list;
    }

    /// A region, and another one that meets it at a stop.
    struct Neighbours {
        std::uint32_t region, other;
    };

    /// Lists the neighbours at all stops, both ways. They may be repeated.
    [[nodiscard]] std::vector<Neighbours> neighbours(const Regions& out) const {
        std::vector<Neighbours> list;
        add_neighbours_at_few(out, list);
        add_neighbours_at_crowded(out, list);
        return list;
    }

    /// Along a curve the same few regions meet at each edge. Those that were seen last are skipped.
    void add_neighbours_at_few(const Regions& out, std::vector<Neighbours>& list) const {
        using Few = std::array<std::uint32_t, few>;
        std::array<Few, 1024> seen{}; // by hash
        for (std::size_t e = 0; e < at_stop_.size(); ++e) {
            if (is_crowded(e)) continue;
            Few here{no_index, no_index, no_index, no_index};
            std::size_t count = 0;
            for (const std::uint32_t t : at_stop_[e])
                for (const std::uint32_t r : out.regions_of[t]) here[count++] = r;
            const std::uint32_t hash = ((here[0] * 31 + here[1]) * 31 + here[2]) * 31 + here[3];
            if (std::exchange(seen[hash % seen.size()], here) == here) continue;
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t j = 0; j < count; ++j)
                    if (here[i] != here[j]) list.push_back({here[i], here[j]});
        }
    }

    /// Two edges of a curve that share a vertex have most of their regions in common. Only pairs
    /// with a region that the edge before did not have are listed: listing all pairs at all edges of
    /// a line on which many surfaces meet is cubic.
    void add_neighbours_at_crowded(const Regions& out, std::vector<Neighbours>& list) const {
        std::set<std::vector<std::uint32_t>> seen_first; // of different curves
        std::vector<std::uint32_t> here, before, fresh, old;
        for (const CrowdedStop& stop : crowded_stops()) {
            find_regions_at(stop.stop, out, here);
            before.clear();
            if (stop.before != no_index)
                find_regions_at(stop.before, out, before);
            else if (!seen_first.insert(here).second)
                continue;
            fresh.clear();
            old.clear();
            std::ranges::set_difference(here, before, std::back_inserter(fresh));
            std::ranges::set_intersection(here, before, std::back_inserter(old));
            for (const std::uint32_t r : fresh) {
                for (const std::uint32_t q : fresh)
                    if (q != r) list.push_back({r, q});
                for (const std::uint32_t q : old) {
                    list.push_back({r, q});
                    list.push_back({q, r});
                }
            }
        }
    }

    /// Sorts the neighbours by counting: first by region, then by the other one. As both are
    /// neighbours of each other, a list of others by region is one of regions by other.
    void find_neighbours(Regions& out) const {
        const auto all = neighbours(out);
        std::vector<std::size_t> first(out.regions.size() + 1, 0); // the count of r is at r + 1
        for (const Neighbours& n : all) ++first[n.region + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<std::uint32_t> others(all.size()), ascending(all.size());
        auto next = first;
        for (const Neighbours& n : all) others[next[n.region]++] = n.other;
        next = first;
        for (std::uint32_t r = 0; r < out.regions.size(); ++r)
            for (std::size_t k = first[r]; k < first[r + 1]; ++k) ascending[next[others[k]]++] = r;
        for_ranges(out.regions.size(), run_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t r = begin; r < end; ++r) {
                const std::span list(ascending.data() + first[r], ascending.data() + first[r + 1]);
                const auto last = std::unique(list.begin(), list.end());
                out.regions[r].neighbours.assign(list.begin(), last);
            }
        });
    }

    std::span<const Triangle> triangles_;
    const IndexLists<std::uint32_t>& surfaces_of_;
    std::span<const Edge> stops_;
    const Run& run_;
    DisjointSets sets_;
    IndexLists<std::uint32_t> at_stop_; ///< per stop: its triangles
    std::vector<Edge> edge_of_stop_;
};

} // namespace

Regions find_regions(std::span<const Point3> vertices, std::span<const Triangle> triangles,
                     const IndexLists<std::uint32_t>& surfaces_of, const Adjacency& adjacency,
                     std::span<const Edge> intersection_edges, const Run& run) {
    const StandardArithmetic guard;
    Diffusion diffusion(triangles, surfaces_of, intersection_edges, run);
    diffusion.spread(adjacency);
    return diffusion.number(vertices);
}

Regions find_regions(const Mesh& mesh, const Run& run) {
    const StandardArithmetic guard;
    // Without parents any edge may be an intersection, so none is taken for an inner one.
    const Labels labels = mesh.parents_of.size() == mesh.triangles.size()
                              ? labels_of(mesh.surfaces_of, mesh.parents_of)
                              : Labels(mesh.triangles.size(), no_label);
    const Adjacency adjacency =
        adjacency_of(group_edges(mesh.triangles, mesh.vertices.size(), run), labels);
    return find_regions(mesh.vertices, mesh.triangles, mesh.surfaces_of, adjacency,
                        mesh.intersection_edges, run);
}

} // namespace terrane
