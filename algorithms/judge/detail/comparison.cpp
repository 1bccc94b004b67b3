// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/detail/comparison.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/judge/detail/placing.hpp>
#include <terrane/algorithms/judge/detail/separation.hpp>

namespace terrane::judging {

Comparison::Comparison(std::size_t most) :
    welded("welded", most), vertices("vertices", most), curves("curves", most),
    coverage("coverage", most), topology("topology", most), orientation("orientation", most) {}

namespace {

/// An edge of the difference between the boundary of a cell and that of the triangles in it: so many
/// times more from low to high than back.
struct ChainEdge {
    std::uint32_t cell, low, high;
    int count;
};

/// Adds up equal edges; what cancels is left out.
std::vector<ChainEdge> summed(std::vector<ChainEdge> edges) {
    const auto key = [](const ChainEdge& e) { return std::array{e.cell, e.low, e.high}; };
    std::ranges::sort(edges, {}, key);
    std::vector<ChainEdge> sums;
    for (const ChainEdge& e : edges) {
        if (!sums.empty() && key(sums.back()) == key(e))
            sums.back().count += e.count;
        else
            sums.push_back(e);
    }
    std::erase_if(sums, [](const ChainEdge& e) { return e.count == 0; });
    return sums;
}

ChainEdge chain_edge(std::uint32_t cell, std::uint32_t from, std::uint32_t to, int count) {
    return from < to ? ChainEdge{cell, from, to, count} : ChainEdge{cell, to, from, -count};
}

Point3 cross(const Point3& u, const Point3& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
double dot(const Point3& u, const Point3& v) {
    return u.x * v.x + u.y * v.y + u.z * v.z;
}
Point3 minus(const Point3& p, const Point3& q) {
    return {p.x - q.x, p.y - q.y, p.z - q.z};
}
double length(const Point3& v) {
    return std::hypot(v.x, v.y, v.z);
}

class Comparer {
public:
    Comparer(const Target& target, const OutputMesh& output, double bound, std::size_t most) :
        target_(target), output_(output), points_(output.soup.points), bound_(bound), found_(most),
        cells_(find_cells(target)), matching_(match_vertices(target, cells_, output, bound)),
        separation_(target, cells_, output, matching_, bound),
        placing_(place(target, cells_, output, matching_, separation_, bound)) {}

    Comparison operator()() {
        found_.largest_move = matching_.largest_move;
        find_torn();
        find_missing_points();
        find_missing_curves();
        find_extra_triangles();
        find_repeated();
        compare_chains();
        find_pinched();
        find_turned();
        return std::move(found_);
    }

private:
    [[nodiscard]] const Point3& nearest(std::uint32_t x) const {
        return target_.exact.nearest(VertexId(x));
    }
    [[nodiscard]] std::uint32_t number(std::uint32_t t) const { return output_.soup.input_of[t]; }
    [[nodiscard]] double area(std::uint32_t t) const {
        const auto [a, b, c] = output_.soup.triangles[t];
        return length(cross(minus(points_[b], points_[a]), minus(points_[c], points_[a]))) / 2;
    }
    [[nodiscard]] Point3 middle(std::uint32_t t) const {
        const auto [a, b, c] = output_.soup.triangles[t];
        return {points_[a].x / 3 + points_[b].x / 3 + points_[c].x / 3,
                points_[a].y / 3 + points_[b].y / 3 + points_[c].y / 3,
                points_[a].z / 3 + points_[b].z / 3 + points_[c].z / 3};
    }
    [[nodiscard]] Point3 middle(const ChainEdge& e) const {
        const Point3 &p = points_[e.low], &q = points_[e.high];
        return {p.x / 2 + q.x / 2, p.y / 2 + q.y / 2, p.z / 2 + q.z / 2};
    }

    /// Finds vertices within the bound of one that stands for an exact point, which stand for none.
    void find_torn() {
        std::vector<std::uint32_t> own, others;
        for (const std::uint32_t v : output_.vertices)
            (matching_.preimages[v].empty() ? own : others).push_back(v);
        const PointGrid grid(points_, others, bound_);
        for (const std::uint32_t v : own) {
            bool near = false;
            grid.for_near(points_[v], [&](std::uint32_t) { near = true; });
            if (near)
                found_.welded.add(
                    {"a second point stands within the bound of another", points_[v]});
        }
    }

    void find_missing_points() {
        for (const std::uint32_t x : separation_.missing())
            found_.vertices.add({"no vertex is at a corner of the exact regions", nearest(x)});
    }

    void find_missing_curves() {
        for (const auto& [low, high] : cells_.curves) {
            auto edge = separation_.image(low, high);
            if (edge.empty()) edge = separation_.image(high, low);
            const bool is_there = edge.empty() ? is_bridged(low, high) : separation_.has_path(edge);
            if (!is_there)
                found_.curves.add({"no edge follows an exact intersection curve",
                                   {nearest(low).x / 2 + nearest(high).x / 2,
                                    nearest(low).y / 2 + nearest(high).y / 2,
                                    nearest(low).z / 2 + nearest(high).z / 2},
                                   {},
                                   length(minus(nearest(low), nearest(high)))});
        }
    }
    /// Whether the mesh leaves out both ends of an edge, as points of a longer straight one.
    [[nodiscard]] bool is_bridged(std::uint32_t low, std::uint32_t high) const {
        const auto& missing = separation_.missing();
        return matching_.image[low] == no_index && matching_.image[high] == no_index &&
               !std::ranges::binary_search(missing, low) &&
               !std::ranges::binary_search(missing, high);
    }

    void find_extra_triangles() {
        std::vector<bool> is_off(output_.soup.triangles.size());
        for (const std::uint32_t t : placing_.off) is_off[t] = true;
        for (std::uint32_t t = 0; t < is_off.size(); ++t) {
            if (placing_.cell_of[t] != no_index) continue;
            found_.extra_area += area(t);
            found_.coverage.add(
                {is_off[t] ? "a triangle lies off the surfaces" : "a triangle is in no region",
                 middle(t),
                 {number(t)},
                 area(t)});
        }
    }

    /// Finds triangles that are there more often than there are inputs at their place.
    void find_repeated() {
        std::map<std::uint32_t, std::uint32_t> times;
        for (const auto& [t, first] : output_.soup.duplicates) {
            const auto at = std::ranges::lower_bound(output_.soup.input_of, first);
            const auto cell =
                placing_.cell_of[static_cast<std::size_t>(at - output_.soup.input_of.begin())];
            if (cell == no_index || ++times[first] < cells_.cells[cell].parents) continue;
            const auto kept = static_cast<std::uint32_t>(at - output_.soup.input_of.begin());
            found_.extra_area += area(kept);
            found_.coverage.add(
                {"a triangle covers its place again", middle(kept), {t, first}, area(kept)});
        }
    }

    void compare_chains() {
        std::vector<ChainEdge> edges;
        for (const CellEdge& e : separation_.boundary())
            edges.push_back(chain_edge(e.cell, e.from, e.to, 1));
        for (std::uint32_t t = 0; t < output_.soup.triangles.size(); ++t) {
            if (placing_.cell_of[t] == no_index) continue;
            const Triangle& k = output_.soup.triangles[t];
            for (unsigned i = 0; i < 3; ++i)
                edges.push_back(
                    chain_edge(placing_.cell_of[t], k[i], k[(i + 1) % 3], -placing_.facing[t]));
        }
        edges = summed(divided(summed(std::move(edges))));
        for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
            while (end < edges.size() && edges[end].cell == edges[i].cell) ++end;
            report_difference(std::span(edges).subspan(i, end - i));
        }
        report_absent_cells(edges);
    }

    /// Divides edges at the vertices that they pass along edges of cells.
    [[nodiscard]] std::vector<ChainEdge> divided(const std::vector<ChainEdge>& edges) const {
        std::vector<ChainEdge> parts;
        for (const ChainEdge& e : edges) {
            const auto path = separation_.straight_path(e.low, e.high);
            if (path.size() < 3) {
                parts.push_back(e);
                continue;
            }
            for (std::size_t i = 0; i + 1 < path.size(); ++i)
                parts.push_back(chain_edge(e.cell, path[i], path[i + 1], e.count));
        }
        return parts;
    }

    void report_difference(std::span<const ChainEdge> edges) {
        const Cell& cell = cells_.cells[edges[0].cell];
        const Point3& origin = points_[edges[0].low];
        Point3 sum{};
        double perimeter = 0;
        for (const ChainEdge& e : edges) {
            const Point3 part =
                cross(minus(points_[e.low], origin), minus(points_[e.high], origin));
            sum = {sum.x + e.count * part.x, sum.y + e.count * part.y, sum.z + e.count * part.z};
            perimeter += std::abs(e.count) * length(minus(points_[e.low], points_[e.high]));
        }
        const double net = dot(sum, cell.normal) / 2;
        found_.topology.add({"the triangles in a region do not meet along its boundary",
                             middle(edges[0]),
                             {},
                             perimeter});
        if (std::abs(net) <= 2 * bound_ * perimeter) return;
        (net > 0 ? found_.missing_area : found_.extra_area) += std::abs(net);
        found_.coverage.add({net > 0 ? "a part of a region is not covered"
                                     : "a region is covered more than once, or beyond its boundary",
                             middle(edges[0]),
                             {},
                             std::abs(net)});
    }

    /// Reports cells without triangles whose boundary the mesh lacks, so that no difference shows them.
    void report_absent_cells(const std::vector<ChainEdge>& differences) {
        std::vector<bool> known(cells_.cells.size());
        for (const ChainEdge& e : differences) known[e.cell] = true;
        for (const std::uint32_t c : placing_.cell_of)
            if (c != no_index) known[c] = true;
        for (const CellEdge& e : separation_.boundary())
            known[e.cell] = true; // it vanished: no edges
        std::vector<bool> vanished(cells_.cells.size(), true);
        for (const CellEdge& e : cells_.boundary)
            if (separation_.image(e.from, e.to).empty()) vanished[e.cell] = false;
        for (std::uint32_t c = 0; c < known.size(); ++c) {
            if (known[c] || vanished[c]) continue;
            const Cell& cell = cells_.cells[c];
            found_.missing_area += cell.area;
            const Point3& at = nearest(target_.triangles[cell.triangle][0]);
            found_.coverage.add({"a region is not there", at, {}, cell.area});
            found_.topology.add({"a region is not there", at, {}, cell.area});
        }
    }

    /// Finds vertices that stand for exact points which no edges between these join.
    void find_pinched() {
        std::map<std::uint32_t, std::uint32_t> place; // exact points that share a vertex
        std::vector<std::uint32_t> points;
        for (const std::uint32_t v : output_.vertices)
            if (const auto all = matching_.preimages[v]; all.size() > 1) {
                for (const std::uint32_t x : all) place.emplace(x, place.size());
                points.push_back(v);
            }
        if (points.empty()) return;
        found_.merged = true;
        DisjointSets sets(place.size());
        for (const Triangle& t : target_.triangles)
            for (unsigned i = 0; i < 3; ++i) {
                const std::uint32_t x = t[i], y = t[(i + 1) % 3];
                if (matching_.image[x] == no_index || matching_.image[x] != matching_.image[y])
                    continue;
                sets.join(place.at(x), place.at(y));
            }
        for (const std::uint32_t v : points) {
            const auto all = matching_.preimages[v];
            if (!std::ranges::all_of(all, [&](std::uint32_t x) {
                    return sets.find(place.at(x)) == sets.find(place.at(all[0]));
                }))
                found_.topology.add({"a vertex joins exact points that are apart", points_[v]});
        }
    }

    void find_turned() {
        for (std::uint32_t t = 0; t < output_.soup.triangles.size(); ++t) {
            const auto cell = placing_.cell_of[t];
            if (cell == no_index || placing_.facing[t] > 0 || cells_.cells[cell].either) continue;
            found_.orientation.add({"a triangle faces the other way", middle(t), {number(t)}, 0});
        }
    }

    const Target& target_;
    const OutputMesh& output_;
    const std::vector<Point3>& points_;
    double bound_;
    Comparison found_;
    Cells cells_;
    Matching matching_;
    Separation separation_;
    Placing placing_;
};

} // namespace

Comparison compare(const Target& target, const OutputMesh& output, double bound,
                   std::size_t most_flaws) {
    return Comparer(target, output, bound, most_flaws)();
}

} // namespace terrane::judging
