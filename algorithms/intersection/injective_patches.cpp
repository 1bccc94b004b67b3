// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/intersection/injective_patches.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/predicates.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

namespace terrane {
namespace {

constexpr std::array axes{Axis::z, Axis::x, Axis::y};

/// An edge of a patch's border, directed so that the patch lies to its left.
struct BorderEdge {
    std::uint32_t patch;
    std::uint32_t from, to;
};

/// The border of a patch in one projection. It tests whether the border consists of disjoint loops
/// that wind around every point 0 or 1 times in all.
class Border {
public:
    Border(std::span<const Point3> points, Axis axis, std::span<const BorderEdge> edges) :
        points_(points), axis_(axis), edges_(edges) {}

    [[nodiscard]] bool encloses_once() { return link() && !touches_itself() && winds_once(); }

private:
    [[nodiscard]] Sign orient(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return orient2d(axis_, points_[a], points_[b], points_[c]);
    }

    [[nodiscard]] static_filter::Uv at(std::uint32_t v) const {
        return static_filter::project(axis_, points_[v]);
    }

    /// Whether every vertex of the border has one incoming and one outgoing edge. Sets by_from_.
    bool link() {
        by_from_.resize(edges_.size());
        std::vector<std::uint32_t> ends;
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            by_from_[e] = {edges_[e].from, e};
            ends.push_back(edges_[e].to);
        }
        std::sort(by_from_.begin(), by_from_.end());
        std::sort(ends.begin(), ends.end());
        for (std::size_t i = 0; i < ends.size(); ++i)
            if (by_from_[i][0] != ends[i] || (i > 0 && ends[i] == ends[i - 1])) return false;
        return true;
    }

    [[nodiscard]] std::uint32_t next(std::uint32_t edge) const {
        return (*std::lower_bound(by_from_.begin(), by_from_.end(),
                                  std::array{edges_[edge].to, 0u}))[1];
    }

    /// The search gets the edges as triangles without area, as boxes of long edges say little. It leaves out
    /// only edges that are apart.
    bool touches_itself() const {
        std::vector<Point3> starts;
        std::vector<Triangle> edges;
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            const auto from = at(edges_[e].from);
            starts.push_back({from.u, from.v, 0});
            edges.push_back({e, next(e), next(e)});
        }
        for (const CandidatePair& p : candidate_pairs({starts, edges}, {}, Search::automatic))
            if (meet(edges_[p.first], edges_[p.second])) return true;
        return false;
    }

    /// Whether two edges meet beyond a common vertex.
    bool meet(const BorderEdge& e, const BorderEdge& f) const {
        if (e.to == f.from && e.from == f.to) return true;
        if (e.to == f.from) return folds(e.from, e.to, f.to);
        if (f.to == e.from) return folds(f.from, f.to, e.to);
        const Sign a = orient(e.from, e.to, f.from), b = orient(e.from, e.to, f.to);
        if (a == b && a != Sign::Zero) return false;
        const Sign c = orient(f.from, f.to, e.from), d = orient(f.from, f.to, e.to);
        if (c == d && c != Sign::Zero) return false;
        // The edges meet, or they are collinear with overlapping boxes, which counts as meeting.
        return true;
    }

    /// Whether edge b c runs back along edge a b.
    bool folds(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        if (orient(a, b, c) != Sign::Zero) return false;
        const auto p = at(a), q = at(b), r = at(c);
        // a and c on the same side of b, in lexicographic order along their common line
        return (p < q) == (r < q);
    }

    /// Returns how often all loops except that of v wind around v. None of them contains v.
    int winding(std::uint32_t v, const std::vector<std::uint32_t>& loop_of) const {
        const double y = at(v).v;
        int sum = 0;
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            if (loop_of[e] == loop_at_v_) continue;
            const bool from_above = at(edges_[e].from).v > y, to_above = at(edges_[e].to).v > y;
            if (from_above == to_above) continue;
            const Sign side = orient(edges_[e].from, edges_[e].to, v);
            if (to_above && side == Sign::Positive) ++sum;
            if (from_above && side == Sign::Negative) --sum;
        }
        return sum;
    }

    /// Whether the winding numbers of all loops add up to 1 on the left of each edge.
    bool winds_once() {
        constexpr std::uint32_t none = UINT32_MAX;
        std::vector<std::uint32_t> loop_of(edges_.size(), none);
        std::vector<std::uint32_t> lowest; // per loop, the edge that starts at its lowest vertex
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            if (loop_of[e] != none) continue;
            const auto loop = static_cast<std::uint32_t>(lowest.size());
            lowest.push_back(e);
            for (std::uint32_t f = e; loop_of[f] == none; f = next(f)) {
                loop_of[f] = loop;
                if (at(edges_[f].from) < at(edges_[lowest[loop]].from)) lowest[loop] = f;
            }
        }
        if (lowest.size() > most_loops) return false;
        std::vector<std::uint32_t> before(edges_.size());
        for (std::uint32_t e = 0; e < edges_.size(); ++e) before[next(e)] = e;
        for (std::uint32_t loop = 0; loop < lowest.size(); ++loop) {
            const BorderEdge& out = edges_[lowest[loop]];
            const Sign turn = orient(edges_[before[lowest[loop]]].from, out.from, out.to);
            if (turn == Sign::Zero) return false; // collinear at the lowest vertex: a fold
            loop_at_v_ = loop;
            const int others = winding(out.from, loop_of);
            if (others != (turn == Sign::Positive ? 0 : 1)) return false;
        }
        return true;
    }

    static constexpr std::size_t most_loops = 1000; // the test costs loops times edges

    std::span<const Point3> points_;
    Axis axis_;
    std::span<const BorderEdge> edges_;
    std::vector<std::array<std::uint32_t, 2>> by_from_; ///< {from, edge}, sorted
    std::uint32_t loop_at_v_ = 0;
};

class Prover {
public:
    Prover(std::span<const Point3> points, std::span<const Triangle> triangles,
           std::span<const std::uint32_t> surface_of, const EdgeSides& edges, const Run& run,
           std::span<const Sign> turns) :
        points_(points),
        triangles_(triangles), surface_of_(surface_of), edges_(edges), run_(run),
        known_turns_(turns), group_(triangles.size(), no_group) {}

    InjectivePatches operator()() {
        // Whole surfaces come first: the proof does not require that a patch is connected.
        patch_of_ = surface_of_;
        count_surfaces();
        proven_.assign(size_of_.size(), std::nullopt);
        prove();
        size_of_.clear();
        if (is_done()) return {std::move(group_), std::move(axis_), std::move(turn_)};
        label_.assign(surface_of_.begin(), surface_of_.end());
        find_components();
        prove();
        // The remaining components are split where the axis of the longest normal changes.
        bool any = false;
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            if (group_[t] != no_group) continue;
            label_[t] = 3 * surface_of_[t] + longest_axis(triangles_[t]);
            any = true;
        }
        if (any) {
            find_components();
            prove();
        }
        return {std::move(group_), std::move(axis_), std::move(turn_)};
    }

private:
    /// Returns the number of the axis along which the normal is longest, up to rounding. It is only
    /// a guess at a projection that may succeed.
    [[nodiscard]] std::uint32_t longest_axis(const Triangle& t) const {
        const Point3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const double wx = c.x - a.x, wy = c.y - a.y, wz = c.z - a.z;
        const double x = std::fabs(uy * wz - uz * wy), y = std::fabs(uz * wx - ux * wz),
                     z = std::fabs(ux * wy - uy * wx);
        return z >= x && z >= y ? 0 : x >= y ? 1 : 2;
    }

    static constexpr unsigned char positive = 1, negative = 2;

    [[nodiscard]] bool is_open(const EdgeSides::Side& s) const {
        return group_[s.triangle] == no_group;
    }

    [[nodiscard]] bool is_done() const {
        if (std::all_of(proven_.begin(), proven_.end(), [](const auto& p) { return !!p; }))
            return true;
        return std::find(group_.begin(), group_.end(), no_group) == group_.end();
    }

    /// Counts the triangles per surface. Triangles of one surface usually are consecutive.
    void count_surfaces() {
        const auto parts = parts_of_ranges<std::vector<std::size_t>>(
            surface_of_.size(), run_, [&](std::size_t first, std::size_t last) {
                std::vector<std::size_t> sizes;
                for (std::size_t t = first; t < last;) {
                    const std::uint32_t surface = surface_of_[t];
                    const std::size_t start = t;
                    while (t < last && surface_of_[t] == surface) ++t;
                    if (surface >= sizes.size()) sizes.resize(surface + std::size_t{1}, 0);
                    sizes[surface] += t - start;
                }
                return sizes;
            });
        for (const auto& sizes : parts) {
            size_of_.resize(std::max(size_of_.size(), sizes.size()), 0);
            for (std::size_t s = 0; s < sizes.size(); ++s) size_of_[s] += sizes[s];
        }
    }

    /// Tries the patches of patch_of_ in all projections.
    void prove() {
        for (const Axis axis : axes) {
            if (std::all_of(proven_.begin(), proven_.end(), [](const auto& p) { return !!p; }))
                break;
            find_turns(axis);
            sum_borders();
            try_axis(axis);
        }
        std::vector<std::uint32_t> number(proven_.size(), no_group);
        for (std::size_t p = 0; p < proven_.size(); ++p) {
            if (!proven_[p]) continue;
            number[p] = static_cast<std::uint32_t>(axis_.size());
            axis_.push_back(*proven_[p]);
        }
        // Notes the orientations in each group, one bit for each. Most triangles find their bit
        // set.
        std::vector<unsigned char> seen(axis_.size(), 0);
        for_ranges(triangles_.size(), run_, [&](std::size_t first, std::size_t last) {
            for (std::size_t t = first; t < last; ++t) {
                if (group_[t] != no_group) continue;
                const std::uint32_t group = group_[t] = number[patch_of_[t]];
                if (group == no_group) continue;
                const std::atomic_ref of_group(seen[group]);
                const unsigned char bit = turns_[t] == Sign::Positive ? positive : negative;
                if ((of_group.load(std::memory_order_relaxed) & bit) == 0) of_group |= bit;
            }
        });
        for (std::size_t g = turn_.size(); g < axis_.size(); ++g)
            turn_.push_back(seen[g] == positive   ? Sign::Positive
                            : seen[g] == negative ? Sign::Negative
                                                  : Sign::Zero);
    }

    /// Computes the orientation of each open triangle in the projection. A patch with a degenerate
    /// triangle is unusable.
    void find_turns(Axis axis) {
        turns_.resize(triangles_.size()); // entries of patches that are not tried are not read
        usable_.assign(proven_.size(), true);
        const bool is_known = axis == Axis::z && !known_turns_.empty();
        const auto flat = parts_of_ranges<std::vector<std::uint32_t>>(
            triangles_.size(), run_, [&](std::size_t first, std::size_t last) {
                std::vector<std::uint32_t> unusable;
                for (std::size_t t = first; t < last; ++t) {
                    if (group_[t] != no_group || proven_[patch_of_[t]]) continue;
                    const Triangle& c = triangles_[t];
                    turns_[t] = is_known
                                    ? known_turns_[t]
                                    : orient2d(axis, points_[c[0]], points_[c[1]], points_[c[2]]);
                    if (turns_[t] == Sign::Zero) unusable.push_back(patch_of_[t]);
                }
                return unusable;
            });
        for (const auto& part : flat)
            for (const std::uint32_t patch : part) usable_[patch] = false;
    }

    /// Makes patches of the triangles without a group: components connected across edges between
    /// triangles with equal labels.
    void find_components() {
        DisjointSets sets(triangles_.size());
        edges_.for_each([&](std::uint32_t, std::uint32_t, auto sides) {
            for (std::size_t i = 1; i < sides.size(); ++i)
                if (label_[sides[i].triangle] == label_[sides[i - 1].triangle] &&
                    is_open(sides[i]) && is_open(sides[i - 1]))
                    sets.join(sides[i].triangle, sides[i - 1].triangle);
        });
        component_of_.resize(triangles_.size());
        std::uint32_t patches = 0;
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            if (group_[t] != no_group) continue;
            const std::uint32_t root = sets.find(t);
            component_of_[t] = root == t ? patches++ : component_of_[root];
        }
        patch_of_ = component_of_;
        proven_.assign(patches, std::nullopt);
    }

    struct BorderPart {
        std::vector<BorderEdge> edges;
        std::vector<std::uint32_t> unusable; ///< patches
    };

    /// Computes the borders of the open patches: the sum of their triangles' boundaries, all
    /// counterclockwise.
    void sum_borders() {
        const auto parts = parts_of_ranges<BorderPart>(
            edges_.starts.size() - 1, run_, [&](std::size_t first, std::size_t last) {
                BorderPart part;
                edges_.for_each(first, last,
                                [&](std::uint32_t low, std::uint32_t high, auto sides) {
                                    if (!cancel(low, high, sides))
                                        sum_sides(low, high, sides, part);
                                });
                return part;
            });
        border_.clear();
        for (const BorderPart& part : parts) {
            border_.insert(border_.end(), part.edges.begin(), part.edges.end());
            for (const std::uint32_t patch : part.unusable) usable_[patch] = false;
        }
    }

    /// Whether an edge has two sides of one patch that run against each other, as most edges have.
    [[nodiscard]] bool cancel(std::uint32_t low, std::uint32_t high,
                              std::span<const EdgeSides::Side> sides) const {
        if (sides.size() != 2) return false;
        const std::uint32_t t = sides[0].triangle, u = sides[1].triangle;
        if (!is_open(sides[0]) || !is_open(sides[1]) || patch_of_[t] != patch_of_[u]) return false;
        const bool along =
            runs_along(triangles_[t], low, high) == runs_along(triangles_[u], low, high);
        return along ? turns_[t] == -turns_[u] : turns_[t] == turns_[u];
    }

    void sum_sides(std::uint32_t low, std::uint32_t high, std::span<const EdgeSides::Side> sides,
                   BorderPart& part) const {
        const bool plain = sides.size() == 2 && is_open(sides[0]) && is_open(sides[1]) &&
                           patch_of_[sides[0].triangle] == patch_of_[sides[1].triangle];
        for (std::size_t i = 0; i < (plain ? 1 : sides.size()); ++i) {
            if (!is_open(sides[i])) continue;
            const std::uint32_t patch = patch_of_[sides[i].triangle];
            if (proven_[patch] || !usable_[patch]) continue;
            bool is_first = true;
            for (std::size_t j = 0; j < i; ++j)
                if (is_open(sides[j]) && patch_of_[sides[j].triangle] == patch) is_first = false;
            if (is_first) sum_edge(low, high, sides.subspan(i), patch, part);
        }
    }

    void sum_edge(std::uint32_t low, std::uint32_t high, std::span<const EdgeSides::Side> sides,
                  std::uint32_t patch, BorderPart& part) const {
        int sum = 0;
        for (const auto& s : sides) {
            if (!is_open(s) || patch_of_[s.triangle] != patch) continue;
            const int along = runs_along(triangles_[s.triangle], low, high) ? 1 : -1;
            sum += along * static_cast<int>(turns_[s.triangle]);
        }
        if (sum == 1) part.edges.push_back({patch, low, high});
        if (sum == -1) part.edges.push_back({patch, high, low});
        if (std::abs(sum) > 1) part.unusable.push_back(patch);
    }

    /// Whether more than half of the sides of a surface's triangles are border. Trying the surface
    /// as a whole is then not worthwhile, and each of its pieces is proven quickly.
    [[nodiscard]] bool is_scattered(std::uint32_t patch, std::size_t border) const {
        constexpr std::size_t few = 64; // triangles
        return !size_of_.empty() && size_of_[patch] > few && 2 * border > 3 * size_of_[patch];
    }

    void try_axis(Axis axis) {
        std::stable_sort(border_.begin(), border_.end(),
                         [](const auto& a, const auto& b) { return a.patch < b.patch; });
        std::vector<std::span<const BorderEdge>> borders;
        for (std::size_t i = 0, end = 0; i < border_.size(); i = end) {
            const std::uint32_t patch = border_[i].patch;
            while (end < border_.size() && border_[end].patch == patch) ++end;
            if (usable_[patch] && !is_scattered(patch, end - i))
                borders.emplace_back(border_.data() + i, end - i);
        }
        const auto try_range = [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k)
                if (Border(points_, axis, borders[k]).encloses_once())
                    proven_[borders[k].front().patch] = axis;
        };
        for_ranges(borders.size(), run_, try_range, 4, 1);
    }

    std::span<const Point3> points_;
    std::span<const Triangle> triangles_;
    std::span<const std::uint32_t> surface_of_;
    const EdgeSides& edges_;
    const Run& run_;
    std::span<const Sign> known_turns_;       ///< per triangle, along z; or empty
    std::vector<std::uint32_t> label_;        ///< per triangle; equal within a patch
    std::vector<std::uint32_t> group_;        ///< the result
    std::vector<Axis> axis_;                  ///< per group
    std::vector<Sign> turn_;                  ///< per group: that of all its triangles, or Zero
    UninitializedVector<Sign> turns_;         ///< per triangle, in the projection being tried
    std::span<const std::uint32_t> patch_of_; ///< per triangle without a group
    std::vector<std::uint32_t> component_of_; ///< storage of patch_of_ after whole surfaces
    std::vector<std::optional<Axis>> proven_; ///< per patch
    std::vector<std::size_t> size_of_;        ///< per surface, while they are tried as a whole
    std::vector<bool> usable_;                ///< per patch, in the projection being tried
    std::vector<BorderEdge> border_;          ///< borders in the projection being tried
};

} // namespace

InjectivePatches find_injective_patches(std::span<const Point3> points,
                                        std::span<const Triangle> triangles,
                                        std::span<const std::uint32_t> surface_of,
                                        const EdgeSides& edges, const Run& run,
                                        std::span<const Sign> turns) {
    auto patches = Prover(points, triangles, surface_of, edges, run, turns)();
    number_by_first_triangle(patches);
    return patches;
}

void number_by_first_triangle(InjectivePatches& patches) {
    std::vector<std::uint32_t> number(patches.axis.size(), no_group);
    std::vector<Axis> axis;
    std::vector<Sign> turn;
    for (std::uint32_t& p : patches.of) {
        if (p == no_group) continue;
        if (number[p] == no_group) {
            number[p] = static_cast<std::uint32_t>(axis.size());
            axis.push_back(patches.axis[p]);
            turn.push_back(patches.turn[p]);
        }
        p = number[p];
    }
    patches.axis = std::move(axis);
    patches.turn = std::move(turn);
}

std::vector<bool> recheck_injective_patches(
    std::span<const Point3> points, std::span<const Triangle> triangles, const Adjacency& adjacency,
    std::span<const std::uint32_t> moved, const std::vector<bool>& is_moved,
    const std::function<Sign(std::uint32_t, Axis)>& turn, const InjectivePatches& patches) {
    std::vector<bool> holds(patches.axis.size(), true), moved_border(patches.axis.size(), false);
    const auto turn_before = [&](std::uint32_t t, std::uint32_t p) {
        return patches.turn[p] != Sign::Zero ? patches.turn[p] : turn(t, patches.axis[p]);
    };
    const auto turn_after = [&](std::uint32_t t, std::uint32_t p) {
        const Triangle& c = triangles[t];
        return orient2d(patches.axis[p], points[c[0]], points[c[1]], points[c[2]]);
    };
    for (const std::uint32_t t : moved) {
        const std::uint32_t p = patches.of[t];
        if (p != no_group && holds[p] && turn_after(t, p) != turn_before(t, p)) holds[p] = false;
    }
    std::vector<BorderEdge> border;
    // Inner edges (adjacency.inner) lie within one patch, so all border edges are among the others.
    for (std::size_t e = 0; e < adjacency.edges.size(); ++e) {
        const auto [low, high] = adjacency.edges[e];
        const auto sides = adjacency.triangles_at[e];
        for (const std::uint32_t t : sides) {
            const std::uint32_t p = patches.of[t];
            if (p == no_group) continue;
            const auto same = std::count_if(sides.begin(), sides.end(),
                                            [&](std::uint32_t u) { return patches.of[u] == p; });
            if (same > 2) holds[p] = false;
            if (same != 1) continue;
            if (is_moved[low] || is_moved[high]) moved_border[p] = true;
            const bool along = runs_along(triangles[t], low, high);
            const bool positive = turn_before(t, p) == Sign::Positive;
            if (along == positive)
                border.push_back({p, low, high});
            else
                border.push_back({p, high, low});
        }
    }
    std::stable_sort(border.begin(), border.end(),
                     [](const auto& a, const auto& b) { return a.patch < b.patch; });
    for (std::size_t i = 0, end = 0; i < border.size(); i = end) {
        const std::uint32_t p = border[i].patch;
        while (end < border.size() && border[end].patch == p) ++end;
        if (holds[p] && moved_border[p])
            holds[p] = Border(points, patches.axis[p], std::span(border.data() + i, end - i))
                           .encloses_once();
    }
    return holds;
}

} // namespace terrane
