// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/detail/comparison.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/judge/detail/crowding.hpp>
#include <terrane/algorithms/judge/detail/placing.hpp>
#include <terrane/algorithms/judge/detail/separation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

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

class Comparer {
public:
    Comparer(const Target& target, const OutputMesh& output, const Bound& by, std::size_t most) :
        target_(target), output_(output), points_(output.soup.points), bound_(by.reach),
        found_(most), cells_(find_cells(target)),
        crowding_(find_crowding(target, cells_, bound_, by.clashing)),
        matching_(match_vertices(target, cells_, output, bound_)),
        separation_(target, cells_, output, matching_, bound_),
        placing_(place(target, cells_, crowding_, output, matching_, separation_, bound_)) {}

    Comparison operator()() {
        found_.largest_move = matching_.largest_move;
        note_free_moves();
        find_torn();
        find_missing_points();
        find_missing_curves();
        find_extra_triangles();
        find_repeated();
        compare_chains();
        find_turned();
        note_placed();
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

    [[nodiscard]] bool is_crowded(std::uint32_t v) const {
        const auto exact = matching_.preimages[v];
        return exact.empty() ? crowding_.is_near_others(points_[v])
                             : std::ranges::any_of(
                                   exact, [this](std::uint32_t x) { return crowding_.crowded[x]; });
    }
    /// Whether rounding may have made a triangle, or turned it over: a corner is where parts are near each
    /// other, and it is thin, or no larger than the area in doubt there.
    [[nodiscard]] bool is_doubtful(std::uint32_t t, double area_in_doubt) const {
        const Triangle& k = output_.soup.triangles[t];
        return std::ranges::any_of(k, [this](std::uint32_t v) { return is_crowded(v); }) &&
               (area(t) <= area_in_doubt ||
                is_thin(points_[k[0]], points_[k[1]], points_[k[2]], crowding_.reach));
    }
    /// Finds edges of one triangle where the exact regions have no border.
    void find_torn() {
        std::vector<Edge> exact;
        for (const auto& [low, high] : cells_.borders) {
            auto path = separation_.image(low, high);
            if (path.empty()) path = separation_.image(high, low);
            for (std::size_t i = 0; i + 1 < path.size(); ++i)
                exact.push_back({std::min(path[i], path[i + 1]), std::max(path[i], path[i + 1])});
        }
        sort_unique(exact);
        for (const Edge& e : output_.borders) {
            if (std::ranges::binary_search(exact, e)) continue;
            const PropertyFlaw flaw{
                "a border where the exact regions have none", middle({0, e[0], e[1], 1}), {}, 0};
            const bool in_doubt = is_crowded(e[0]) || is_crowded(e[1]);
            found_.topology.add(flaw, in_doubt);
            // It has several triangles once points are joined: they are torn within the bound.
            if (output_.triangles_at(e[0], e[1]) > 1) found_.welded.add(flaw, in_doubt);
        }
    }

    void find_missing_points() {
        for (const std::uint32_t x : separation_.missing())
            found_.vertices.add({"no vertex is at a corner of the exact regions", nearest(x)},
                                crowding_.crowded[x]);
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
                                   length(minus(nearest(low), nearest(high)))},
                                  crowding_.crowded[low] || crowding_.crowded[high]);
        }
    }
    /// Whether the mesh leaves out both ends of an edge, as points of a longer straight one.
    [[nodiscard]] bool is_bridged(std::uint32_t low, std::uint32_t high) const {
        const auto& missing = separation_.missing();
        return matching_.image[low] == no_index && matching_.image[high] == no_index &&
               !std::ranges::binary_search(missing, low) &&
               !std::ranges::binary_search(missing, high);
    }

    /// Whether the area of a triangle may be in doubt as well: not if that of all others is used up.
    [[nodiscard]] bool takes_doubt(std::uint32_t t) {
        if (!is_doubtful(t, most_moved_ - moved_area_)) return false;
        moved_area_ = std::min(moved_area_ + area(t), most_moved_); // slivers may be long
        return true;
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
                 area(t)},
                takes_doubt(t)); // rounding joins near parts to triangles in neither
        }
        // What is left of the doubt may be that of triangles in a region that may not be theirs.
        std::vector<std::uint32_t> unsure;
        for (const std::uint32_t t : placing_.unsure)
            if (placing_.cell_of[t] != no_index && area(t) <= most_moved_ - moved_area_ &&
                takes_doubt(t))
                unsure.push_back(t);
        for (const std::uint32_t t : unsure)
            crowding_.area_in_doubt[placing_.cell_of[t]] += area(t);
    }

    /// Finds triangles that are there more often than there are inputs at their place.
    void find_repeated() {
        std::map<std::uint32_t, std::uint32_t> times;
        for (const auto& [t, first] : output_.soup.duplicates) {
            const auto at = std::ranges::lower_bound(output_.soup.input_of, first);
            if (at == output_.soup.input_of.end() || *at != first) continue; // it has no area
            const auto cell =
                placing_.cell_of[static_cast<std::size_t>(at - output_.soup.input_of.begin())];
            if (cell == no_index || ++times[first] < cells_.cells[cell].parents) continue;
            const auto kept = static_cast<std::uint32_t>(at - output_.soup.input_of.begin());
            found_.extra_area += area(kept);
            found_.coverage.add(
                {"a triangle covers its place again", middle(kept), {t, first}, area(kept)},
                is_doubtful(kept, crowding_.area_in_doubt[cell]));
        }
    }

    /// A part of a cell that another one near it may have instead.
    struct Exchange {
        double net, by_rounding;
        PropertyFlaw flaw;
    };

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
        std::vector<std::span<const ChainEdge>> differences(cells_.cells.size());
        for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
            while (end < edges.size() && edges[end].cell == edges[i].cell) ++end;
            differences[edges[i].cell] = std::span(edges).subspan(i, end - i);
        }
        std::vector<Exchange> exchanged;
        const auto lacking = lacking_corners();
        const auto covered = covered_areas();
        for (std::uint32_t c = 0; c < differences.size(); ++c)
            if (lacking[c])
                report_unknown(c, *lacking[c], covered[c]);
            else if (!differences[c].empty())
                report_difference(differences[c], exchanged);
        settle(exchanged);
    }

    /// Returns, of cells whose boundaries are known in part, a corner without a vertex: one that must have
    /// one, if there is such a corner.
    [[nodiscard]] std::vector<std::optional<std::uint32_t>> lacking_corners() const {
        std::vector<std::optional<std::uint32_t>> corners(cells_.cells.size());
        for (const std::uint32_t x : separation_.missing())
            for (const std::uint32_t c : cells_.at_vertex[x])
                if (!corners[c] || crowding_.crowded[*corners[c]]) corners[c] = x;
        return corners;
    }
    [[nodiscard]] std::vector<double> covered_areas() const {
        std::vector<double> areas(cells_.cells.size());
        for (std::uint32_t t = 0; t < output_.soup.triangles.size(); ++t)
            if (const auto c = placing_.cell_of[t]; c != no_index) areas[c] += area(t);
        return areas;
    }

    void report_unknown(std::uint32_t c, std::uint32_t corner, double covered) {
        const Cell& cell = cells_.cells[c];
        const Triangle& k = target_.triangles[cell.triangle];
        const Point3& at = nearest(k[0]);
        found_.topology.add({"a region lacks a corner", at}, crowding_.crowded[corner]);
        add_area(c, cell.area - covered, length(minus(nearest(k[0]), nearest(k[1]))), at);
    }
    /// Adds an area that is missing, or too much if it is negative, unless rounding may make it; or to `exchanged`.
    void add_area(std::uint32_t c, double net, double perimeter, const Point3& at,
                  std::vector<Exchange>* exchanged = nullptr) {
        const double by_rounding = 2 * bound_ * perimeter;
        if (std::abs(net) <= by_rounding) return;
        (net > 0 ? found_.missing_area : found_.extra_area) += std::abs(net);
        const char* const what = net > 0
                                     ? "a part of a region is not covered"
                                     : "a region is covered more than once, or beyond its boundary";
        const PropertyFlaw flaw{what, at, {}, std::abs(net)};
        const bool in_doubt =
            std::abs(net) <= by_rounding + crowding_.area_in_doubt[c] + (net > 0 ? moved_area_ : 0);
        if (exchanged && !in_doubt)
            exchanged->push_back({net, by_rounding, flaw});
        else
            found_.coverage.add(flaw, in_doubt);
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

    /// Adds the flaws of parts. What is missing may be what is too much elsewhere, if there is as much of both.
    void settle(const std::vector<Exchange>& parts) {
        double net = 0, by_rounding = 0;
        for (const Exchange& part : parts) {
            net += part.net;
            by_rounding += part.by_rounding;
        }
        for (const Exchange& part : parts)
            found_.coverage.add(part.flaw, std::abs(net) <= by_rounding);
    }

    void report_difference(std::span<const ChainEdge> edges, std::vector<Exchange>& exchanged) {
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
        const bool in_doubt = begins_crowded(edges);
        found_.topology.add({"the triangles in a region do not meet along its boundary",
                             middle(edges[0]),
                             {},
                             perimeter},
                            in_doubt);
        add_area(edges[0].cell, net, perimeter, middle(edges[0]), in_doubt ? &exchanged : nullptr);
    }

    /// Whether each connected part of a difference has a crowded vertex.
    [[nodiscard]] bool begins_crowded(std::span<const ChainEdge> edges) const {
        std::vector<std::uint32_t> vertices;
        for (const ChainEdge& e : edges) vertices.insert(vertices.end(), {e.low, e.high});
        sort_unique(vertices);
        const auto number = [&](std::uint32_t v) {
            return static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, v) -
                                              vertices.begin());
        };
        DisjointSets parts(vertices.size());
        for (const ChainEdge& e : edges) parts.join(number(e.low), number(e.high));
        std::vector<bool> crowded(vertices.size());
        for (std::uint32_t i = 0; i < vertices.size(); ++i)
            if (is_crowded(vertices[i])) crowded[parts.find(i)] = true;
        return std::ranges::all_of(
            edges, [&](const ChainEdge& e) { return crowded[parts.find(number(e.low))]; });
    }

    void find_turned() {
        for (std::uint32_t t = 0; t < output_.soup.triangles.size(); ++t) {
            const auto cell = placing_.cell_of[t];
            if (cell == no_index || placing_.facing[t] > 0 || cells_.cells[cell].either) continue;
            found_.orientation.add({"a triangle faces the other way", middle(t), {number(t)}, 0},
                                   is_doubtful(t, crowding_.area_in_doubt[cell]));
        }
    }

    /// Records the largest move among vertices that share no triangle with a crowded vertex.
    void note_free_moves() {
        std::vector<bool> is_free(matching_.image.size(), true);
        for (const Triangle& t : target_.triangles)
            if (std::ranges::any_of(t, [this](std::uint32_t x) { return crowding_.crowded[x]; }))
                for (const std::uint32_t x : t) is_free[x] = false;
        for (std::uint32_t x = 0; x < is_free.size(); ++x)
            if (is_free[x] && matching_.image[x] != no_index)
                found_.largest_free_move = std::max(
                    found_.largest_free_move, difference(nearest(x), points_[matching_.image[x]]));
    }

    void note_placed() {
        found_.placed.resize(output_.soup.first_input_triangle.back());
        for (std::uint32_t t = 0; t < output_.soup.triangles.size(); ++t)
            if (const auto c = placing_.cell_of[t]; c != no_index)
                found_.placed[number(t)] = {cells_.cells[c].triangle, placing_.facing[t]};
    }

    const Target& target_;
    const OutputMesh& output_;
    const std::vector<Point3>& points_;
    double bound_;
    Comparison found_;
    Cells cells_;
    Crowding crowding_;
    double most_moved_ =
        std::accumulate(crowding_.area_in_doubt.begin(), crowding_.area_in_doubt.end(), 0.0);
    double moved_area_ = 0; ///< of triangles that rounding may have moved out of their cells
    Matching matching_;
    Separation separation_;
    Placing placing_;
};

/// Returns the triangles of a target, ascending, at corners of such as meet improperly or have no area at the
/// nearest doubles, so that these corners have to move.
Result<std::vector<std::uint32_t>> clashing_triangles(const Target& target, const Run& run) {
    Surface rounded{"", Role::unknown, {}, target.triangles};
    for (std::uint32_t x = 0; x < target.exact.vertices.size(); ++x)
        rounded.vertices.push_back(target.exact.nearest(VertexId(x)));
    const auto checked = check(std::span(&rounded, 1), run);
    if (!checked) return checked.error();
    std::vector<std::uint32_t> clashing = checked->degenerate;
    for (const ImproperContact& c : checked->contacts)
        clashing.insert(clashing.end(), c.triangles.begin(), c.triangles.end());
    for (const auto& pair : checked->repeated)
        clashing.insert(clashing.end(), pair.begin(), pair.end());
    std::vector<bool> moves(rounded.vertices.size());
    for (const std::uint32_t t : clashing)
        for (const std::uint32_t x : target.triangles[t]) moves[x] = true;
    clashing.clear();
    for (std::uint32_t t = 0; t < target.triangles.size(); ++t)
        if (std::ranges::any_of(target.triangles[t], [&](std::uint32_t x) { return moves[x]; }))
            clashing.push_back(t);
    return clashing;
}

} // namespace

Result<MeshJudgement>
judge_with_doubt(const Target& target, Bound bound, const Run& run,
                 const std::function<Result<Judged>(const Bound&)>& judge_by) {
    constexpr double step = 4, most = 64; // of 16 spacings 1024, which surfaces may move by
    auto found = judge_by(bound);
    if (!found) return found.error();
    MeshJudgement judgement{std::move(found->properties)};
    if (judgement.holds()) return judgement;
    auto clashing = clashing_triangles(target, run);
    if (!clashing) return clashing.error();
    bound.clashing = std::move(*clashing);
    const double allowed = bound.bound;
    for (double times = 1; times <= most && times * allowed <= bound.widest; times *= step) {
        if (times > 1) bound.bound = bound.reach = times * allowed;
        const auto wider = judge_by(bound);
        if (!wider) return wider.error();
        const bool moved = wider->largest_move > allowed && wider->largest_free_move <= allowed;
        if ((times > 1 && !moved) || !MeshJudgement{wider->properties}.holds()) continue;
        for (JudgedProperty& p : judgement.properties)
            if (p.verdict == PropertyVerdict::fails) p.verdict = PropertyVerdict::not_judged;
        return judgement;
    }
    return judgement;
}

void add_compared(Comparison& found, double bound, Judged& judged) {
    judged.largest_move = found.largest_move;
    judged.largest_free_move = found.largest_free_move;
    auto& properties = judged.properties;
    const auto count = [](const Flaws& f, std::string_view one, std::string_view many) {
        return counted_as(f.count(), one, many);
    };
    properties.push_back(
        found.welded.said(count(found.welded, "point twice or torn", "points twice or torn")));
    properties.push_back(found.vertices.said(
        count(found.vertices, "point", "points") + " missing; the others moved by " +
            figure(found.largest_move) + " at most, of " + figure(bound) + " allowed",
        found.largest_move));
    properties.push_back(
        found.curves.said(count(found.curves, "edge", "edges") + " of curves missing"));
    properties.push_back(found.coverage.said("area missing " + figure(found.missing_area) +
                                                 ", too much " + figure(found.extra_area),
                                             found.missing_area + found.extra_area));
    properties.push_back(found.topology.said(count(found.topology, "difference", "differences")));
    properties.push_back(
        found.orientation.said(count(found.orientation, "triangle turned", "triangles turned")));
}

Comparison compare(const Target& target, const OutputMesh& output, const Bound& bound,
                   std::size_t most_flaws) {
    return Comparer(target, output, bound, most_flaws)();
}

} // namespace terrane::judging
