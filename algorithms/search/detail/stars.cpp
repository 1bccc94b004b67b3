// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/detail/stars.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <terrane/algorithms/search/detail/bvh_join.hpp>
#include <terrane/algorithms/search/detail/vectors.hpp>

namespace terrane {
namespace {

/// Least number of triangles at a crowded vertex. Fewer cost at most half as many tests each.
constexpr std::uint32_t crowd = 128;

} // namespace

// Counts end at a crowd. So each fits into a byte, and more of them fit into the cache.
std::vector<bool> crowded_vertices(std::size_t vertex_count, std::span<const Triangle> triangles) {
    std::vector<std::uint8_t> counts(vertex_count, 0);
    for (const Triangle& t : triangles)
        for (const std::uint32_t v : t)
            counts[v] = static_cast<std::uint8_t>(counts[v] + (counts[v] < crowd ? 1 : 0));
    std::vector<bool> crowded;
    if (std::ranges::find(counts, crowd) == counts.end()) return crowded;
    crowded.resize(vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v) crowded[v] = counts[v] == crowd;
    return crowded;
}

namespace search {
namespace {

using Pairs = std::vector<CandidatePair>;

constexpr Box everywhere{{-2, -2, -2}, {2, 2, 2}};

/// Returns the direction from one point to another as a unit vector, each coordinate with an error of at most
/// 8 units of 2^-52 of itself (star_direction.g); nothing where the difference overflows.
std::optional<Vector> direction(const Point3& from, const Point3& to) {
    Vector d{to.x - from.x, to.y - from.y, to.z - from.z};
    const double most = std::max({std::fabs(d[0]), std::fabs(d[1]), std::fabs(d[2])});
    if (!std::isfinite(most) || most == 0) return std::nullopt;
    for (double& x : d) x /= most;
    const double length = std::sqrt(dot(d, d));
    for (double& x : d) x /= length;
    return d;
}

Box box_round(const Vector& a, const Vector& b, double width) {
    Box box{};
    for (unsigned k = 0; k < 3; ++k) {
        box.low.at(k) = std::min(a.at(k), b.at(k)) - width;
        box.high.at(k) = std::max(a.at(k), b.at(k)) + width;
    }
    return box;
}

/// Adds boxes that contain the arc from a to b. Long arcs are cut into short ones, since an arc
/// bulges over its chord by the square of half its length.
void add_arc(const Vector& a, const Vector& b, std::vector<Box>& boxes) {
    constexpr double longest = 0.25;
    const Vector across = sum(1, b, -1, a), middle = sum(1, a, 1, b);
    if (dot(middle, middle) < least_middle * least_middle) {
        boxes.push_back(everywhere);
        return;
    }
    const double angle =
        2 * std::atan2(std::sqrt(dot(across, across)), std::sqrt(dot(middle, middle)));
    const auto pieces = static_cast<unsigned>(angle / longest) + 1;
    Vector from = a;
    for (unsigned k = 1; k <= pieces; ++k) {
        const double share = static_cast<double>(k) / pieces;
        Vector to = k == pieces ? b : sum(1 - share, a, share, b);
        const double length = std::sqrt(dot(to, to));
        for (double& x : to) x /= length;
        const Vector chord = sum(1, to, -1, from);
        boxes.push_back(box_round(from, to, dot(chord, chord) / 4 + arc_error));
        from = to;
    }
}

/// Returns a box round the direction from the line through v along `axis` to a point, across it.
Box box_across(const Point3& v, const Vector& axis, const Point3& to) {
    const auto along = direction(v, to);
    if (!along) return everywhere;
    Vector across = sum(1, *along, -dot(*along, axis), axis);
    const double sine = std::sqrt(dot(across, across));
    if (!(sine > 4 * across_error)) return everywhere;
    for (double& x : across) x /= sine;
    return box_round(across, across, across_error / sine);
}

/// Searches the triangles of one star.
class StarSearch {
public:
    StarSearch(const BoxSource& source, std::uint32_t vertex,
               std::span<const std::uint32_t> members, std::span<const std::uint32_t> groups,
               const Run& run) :
        source_(source),
        vertex_(vertex), members_(members), groups_(groups), run_(run) {}

    Pairs operator()() {
        find_spokes();
        search_arcs();
        for (const auto& fan : fans_) search_fan(fan);
        std::sort(found_.begin(), found_.end());
        found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
        return std::move(found_);
    }

private:
    /// An edge at the vertex that very many triangles share, and those that are searched with it.
    struct Fan {
        std::uint32_t other;
        std::vector<std::uint32_t> members; ///< indices into members_
    };

    [[nodiscard]] const Point3& at(std::uint32_t v) const { return source_.points()[v]; }
    [[nodiscard]] std::array<std::uint32_t, 2> others(std::uint32_t member) const {
        const Triangle& t = source_.triangles()[members_[member]];
        if (t[0] == vertex_) return {t[1], t[2]};
        return t[1] == vertex_ ? std::array{t[2], t[0]} : std::array{t[0], t[1]};
    }

    /// Finds the crowded edges, and assigns to each the triangles that have no more crowded one.
    void find_spokes() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> ends; // other vertex, member
        for (std::uint32_t m = 0; m < members_.size(); ++m)
            for (const std::uint32_t v : others(m)) ends.emplace_back(v, m);
        std::sort(ends.begin(), ends.end());
        fan_of_.assign(members_.size(), no_group);
        std::vector<std::uint32_t> sizes(members_.size(), 0);
        for (std::size_t i = 0, end = 0; i < ends.size(); i = end) {
            while (end < ends.size() && ends[end].first == ends[i].first) ++end;
            const auto size = static_cast<std::uint32_t>(end - i);
            if (size < crowd) continue;
            const auto fan = static_cast<std::uint32_t>(fans_.size());
            fans_.push_back({ends[i].first, {}});
            for (std::size_t k = i; k < end; ++k) {
                const std::uint32_t m = ends[k].second;
                if (size > sizes[m]) fan_of_[m] = fan;
                sizes[m] = std::max(sizes[m], size);
            }
        }
        for (std::uint32_t m = 0; m < members_.size(); ++m)
            if (fan_of_[m] != no_group) fans_[fan_of_[m]].members.push_back(m);
    }

    /// Finds the pairs with different fans, or none, whose arcs may meet.
    void search_arcs() {
        std::vector<Box> boxes;
        std::vector<std::uint32_t> member_of, crowds, first_of; // the last per member
        for (std::uint32_t m = 0; m < members_.size(); ++m) {
            first_of.push_back(static_cast<std::uint32_t>(boxes.size()));
            const auto [v, w] = others(m);
            const auto a = direction(at(vertex_), at(v)), b = direction(at(vertex_), at(w));
            if (a && b)
                add_arc(*a, *b, boxes);
            else
                boxes.push_back(everywhere);
            member_of.resize(boxes.size(), m);
            crowds.resize(boxes.size(), fan_of_[m]);
        }
        // The boxes of two arcs can overlap in many pairs. The first of these stands for all.
        const auto is_first = [&](const CandidatePair& pair) {
            const std::uint32_t a = member_of[pair.first], b = member_of[pair.second];
            if (a == b) return false;
            const std::uint32_t end = b + 1 < first_of.size()
                                          ? first_of[b + 1]
                                          : static_cast<std::uint32_t>(boxes.size());
            for (std::uint32_t i = first_of[a]; i <= pair.first; ++i) {
                const std::uint32_t last = i < pair.first ? end : pair.second;
                for (std::uint32_t j = first_of[b]; j < last; ++j)
                    if (boxes[i].overlaps(boxes[j])) return false;
            }
            return true;
        };
        add(pairs_of_crowds(boxes, groups_of(member_of), crowds, is_first, run_), member_of);
    }

    /// Finds the pairs of one fan that may lie in one half-plane.
    void search_fan(const Fan& fan) {
        const auto axis = direction(at(vertex_), at(fan.other));
        std::vector<Box> boxes;
        for (const std::uint32_t m : fan.members) {
            const auto [v, w] = others(m);
            const std::uint32_t tip = v == fan.other ? w : v;
            boxes.push_back(axis ? box_across(at(vertex_), *axis, at(tip)) : everywhere);
        }
        add(pairs_of_crowds(boxes, groups_of(fan.members), {}, {}, run_), fan.members);
    }

    [[nodiscard]] std::vector<std::uint32_t>
    groups_of(const std::vector<std::uint32_t>& members) const {
        std::vector<std::uint32_t> groups;
        if (groups_.empty()) return groups;
        groups.reserve(members.size());
        for (const std::uint32_t m : members) groups.push_back(groups_[members_[m]]);
        return groups;
    }

    void add(const Pairs& pairs, const std::vector<std::uint32_t>& member_of) {
        for (const CandidatePair& p : pairs) {
            const auto [i, j] = std::minmax(member_of[p.first], member_of[p.second]);
            if (i != j) found_.push_back({members_[i], members_[j]});
        }
    }

    const BoxSource& source_;
    std::uint32_t vertex_;
    std::span<const std::uint32_t> members_;
    std::span<const std::uint32_t> groups_;
    const Run& run_;
    std::vector<Fan> fans_;
    std::vector<std::uint32_t> fan_of_; ///< per member, or no_group
    Pairs found_;
};

} // namespace

Stars find_stars(const BoxSource& source, std::span<const std::uint32_t> chosen) {
    Stars stars;
    const auto triangles = source.triangles();
    std::vector<Triangle> part; // if not all are chosen
    if (chosen.size() < triangles.size())
        for (const std::uint32_t t : chosen) part.push_back(triangles[t]);
    if (triangles.empty() || chosen.size() < crowd) return stars;
    const auto crowded = crowded_vertices(
        source.points().size(), part.empty() ? triangles : std::span<const Triangle>(part));
    if (crowded.empty()) return stars;
    std::vector<std::uint32_t> degrees(crowded.size(), 0), star_of(crowded.size(), no_group);
    for (const std::uint32_t t : chosen)
        for (const std::uint32_t v : triangles[t]) degrees[v] += crowded[v] ? 1U : 0U;
    std::vector<std::vector<std::uint32_t>> members;
    stars.of.assign(triangles.size(), no_group);
    for (const std::uint32_t t : chosen) {
        const Triangle& c = triangles[t];
        const std::uint32_t best = *std::max_element(c.begin(), c.end(), [&](auto v, auto w) {
            return std::pair{degrees[v], w} < std::pair{degrees[w], v};
        });
        if (degrees[best] == 0) continue;
        if (star_of[best] == no_group) {
            star_of[best] = static_cast<std::uint32_t>(members.size());
            stars.vertices.push_back(best);
            members.emplace_back();
        }
        stars.of[t] = star_of[best];
        members[star_of[best]].push_back(t);
    }
    for (const auto& list : members) stars.triangles.push_back(list);
    return stars;
}

std::vector<CandidatePair> pairs_of_star(const BoxSource& source, const Stars& stars,
                                         std::size_t star, std::span<const std::uint32_t> groups,
                                         const Run& run) {
    return StarSearch(source, stars.vertices[star], stars.triangles[star], groups, run)();
}

} // namespace search
} // namespace terrane
