// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/improved.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/extent.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/nearness.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane::verifier {

namespace {

/// Both meshes in exact numbers. The vertices of the improved mesh follow those before.
class ImprovedComparison {
public:
    ImprovedComparison(const LabelledMesh& before, const ImprovedClaim& improved,
                       Violations& found) :
        after_{improved.vertices, improved.triangles, improved.surfaces_of, improved.regions_of,
               improved.intersection_edges},
        found_(found) {
        old_ = find_sheets(before, numbers_);
        new_ = find_sheets(after_, numbers_);
        for (Sheets* sheets : {&old_, &new_}) {
            sheets->triangles.resize(numbers_.sheets.all().size());
            sheets->shapes.resize(numbers_.sheets.all().size());
        }
        offset_ = static_cast<std::uint32_t>(before.vertices.size());
        points_ = before.vertices;
        points_.insert(points_.end(), improved.vertices.begin(), improved.vertices.end());
        auto all = points_;
        for (const double limit : improved.limits) all.push_back({limit, 0, 0});
        auto [exact, scale] = scale_to_integers(all);
        exact_ = std::move(exact);
        scale_ = std::move(scale);
        for (std::size_t s = 0; s < improved.limits.size(); ++s)
            limits_.push_back({improved.limits[s], exact_[points_.size() + s][0]});
        exact_.resize(points_.size());
        rounding_ = rounding_of(points_);
        old_triangles_ = before.triangles;
        new_triangles_ = improved.triangles;
        for (Triangle& t : new_triangles_) t = moved(t);
        surfaces_of_sheet_.resize(numbers_.sheets.all().size());
        for (const auto& [name, sheet] : numbers_.sheets.all()) surfaces_of_sheet_[sheet] = name[0];
    }

    void check() {
        check_sheets();
        check_curves();
        if (!found_.empty()) return; // the rest is between what corresponds
        check_places();
        for (std::uint32_t s = 0; s < old_.triangles.size(); ++s) {
            check_distances_of_sheet(s);
            check_side(s);
        }
        for (const auto& [key, edges] : old_.curves) check_distances_of_curve(key, edges);
    }

private:
    [[nodiscard]] Triangle moved(const Triangle& t) const {
        return {t[0] + offset_, t[1] + offset_, t[2] + offset_};
    }

    void report(Rule rule, Numbers elements, std::string sentence) {
        found_.push_back({rule, std::move(elements), std::move(sentence)});
    }

    // --- R24, R25 --------------------------------------------------------------------------------

    void check_sheets() {
        constexpr Rule rule = Rule::R24_sheets;
        for (std::uint32_t s = 0; s < old_.triangles.size(); ++s) {
            if (old_.triangles[s].empty())
                report(rule, {new_.triangles[s].front()},
                       "improved triangle " + text(new_.triangles[s].front()) +
                           " has surfaces or regions that none had before");
            else if (new_.triangles[s].empty())
                report(rule, {},
                       "nothing is left of the region of triangle " +
                           text(old_.triangles[s].front()));
            else if (old_.shapes[s].characteristic != new_.shapes[s].characteristic ||
                     old_.shapes[s].components != new_.shapes[s].components)
                report(rule, {new_.triangles[s].front()},
                       "the region of improved triangle " + text(new_.triangles[s].front()) +
                           " has other pieces, holes or handles than before");
        }
    }

    void check_curves() {
        constexpr Rule rule = Rule::R25_curves;
        if (new_.intersection_edges != after_.intersection_edges.size())
            report(rule, {}, "an intersection edge is no edge of the improved mesh");
        for (const auto& [key, count] : old_.chains) {
            const auto same = new_.chains.find(key);
            if (same != new_.chains.end() && same->second == count) continue;
            const Triangle& edge = old_.curves.at(key).front();
            report(rule, {},
                   "the curve along vertices " + text(Edge{edge[0], edge[1]}) +
                       " of the mesh before has not been kept");
        }
        for (const auto& [key, count] : old_.points)
            if (!new_.points.contains(key))
                report(rule, {}, "a point where parts of the mesh before touch has not been kept");
        for (const auto& [key, count] : new_.points)
            if (!old_.points.contains(key))
                report(rule, {}, "parts of the mesh touch in a point where none did before");
        for (const auto& [key, count] : new_.chains)
            if (!old_.chains.contains(key)) {
                const Triangle& edge = new_.curves.at(key).front();
                report(rule, {edge[0], edge[1]},
                       "the curve along vertices " + text(Edge{edge[0], edge[1]}) +
                           " was none before, or ended elsewhere");
            }
    }

    // --- R39: places -----------------------------------------------------------------------------

    /// Returns twice the sheet of a side, and one more for the back; for sheets whose triangles face
    /// different sides, the number of the front for both.
    [[nodiscard]] std::uint32_t side_of_sheet(const Sheets& sheets, std::uint32_t side) const {
        const std::uint32_t sheet = sheets.sheet_of[side / 2];
        return 2 * sheet + (old_.shapes[sheet].oriented ? side % 2 : 0);
    }

    using Facings = std::vector<std::array<std::uint32_t, 2>>;

    /// Returns how sides of sheets face each other around the edges of curves, each way once.
    [[nodiscard]] std::set<Facings> orders_of(const ExactMesh& mesh, const Sheets& sheets) const {
        const auto all = facing_sides(mesh);
        std::set<Facings> orders;
        for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
            Facings order;
            for (; last < all.size() && all[last].edge == all[first].edge; ++last) {
                order.push_back({side_of_sheet(sheets, all[last].sides[0]),
                                 side_of_sheet(sheets, all[last].sides[1])});
                std::ranges::sort(order.back());
            }
            std::ranges::sort(order);
            if (order.size() != 2 || order[0][0] / 2 != order[1][1] / 2) orders.insert(order);
        }
        return orders;
    }

    /// Returns the blocks beside each sheet: {in front, behind} of its triangles, each pair once.
    [[nodiscard]] std::vector<std::set<Edge>> blocks_beside(const Blocks& blocks,
                                                            const Sheets& sheets) const {
        std::vector<std::set<Edge>> beside(sheets.triangles.size());
        for (std::uint32_t t = 0; t < sheets.sheet_of.size(); ++t) {
            const auto [front, back] = blocks.of_sides(t);
            auto& pairs = beside[sheets.sheet_of[t]];
            pairs.insert({front, back});
            if (!old_.shapes[sheets.sheet_of[t]].oriented) pairs.insert({back, front});
        }
        return beside;
    }

    [[nodiscard]] Extent extent_of(const std::vector<Triangle>& triangles,
                                   const Numbers& which) const {
        Extent extent;
        for (const std::uint32_t t : which)
            for (const std::uint32_t v : triangles[t]) extent.add(exact_[v]);
        return extent;
    }

    /// Checks that no closed sheet has left its place: the boxes around it before and now have points
    /// in common.
    void check_boxes() {
        std::set<std::uint32_t> bordered;
        for (const auto& [label, sheets] : old_.sheets_of_label)
            bordered.insert(sheets.begin(), sheets.end());
        for (std::uint32_t s = 0; s < old_.triangles.size(); ++s) {
            if (bordered.contains(s)) continue;
            const Extent was = extent_of(old_triangles_, old_.triangles[s]);
            const Extent is = extent_of(new_triangles_, new_.triangles[s]);
            for (std::size_t i = 0; i < 3; ++i)
                if (was.high[i] < is.low[i] || is.high[i] < was.low[i]) {
                    report(Rule::R39_beside, {new_.triangles[s].front()},
                           "the region of improved triangle " + text(new_.triangles[s].front()) +
                               " is not where it was");
                    break;
                }
        }
    }

    void check_places() {
        check_boxes();
        const auto before = make_exact_mesh(exact_, scale_, old_triangles_);
        const auto after = make_exact_mesh(exact_, scale_, new_triangles_);
        if (orders_of(before, old_) != orders_of(after, new_))
            report(Rule::R39_beside, {}, "sheets lie around a curve in another order than before");
        const Blocks old = find_blocks(before), now = find_blocks(after);
        const auto ours = blocks_beside(old, old_), theirs = blocks_beside(now, new_);
        std::map<std::uint32_t, std::uint32_t> becomes{{0, 0}}, was{{0, 0}};
        for (std::size_t s = 0; s < ours.size(); ++s)
            if (ours[s].size() == 1 && theirs[s].size() == 1)
                for (const std::size_t side : {0U, 1U}) {
                    becomes.try_emplace((*ours[s].begin())[side], (*theirs[s].begin())[side]);
                    was.try_emplace((*theirs[s].begin())[side], (*ours[s].begin())[side]);
                }
        for (std::uint32_t s = 0; s < ours.size(); ++s)
            if (is_other(ours[s], theirs[s], becomes) || is_other(theirs[s], ours[s], was))
                report(Rule::R39_beside, {new_.triangles[s].front()},
                       "the region of improved triangle " + text(new_.triangles[s].front()) +
                           " is between other blocks than before");
        if (old.count != now.count)
            report(Rule::R39_beside, {},
                   "there are " + text(now.count - 1) + " blocks, not " + text(old.count - 1));
    }

    /// Tells whether blocks beside a sheet correspond to none beside the same one.
    static bool is_other(const std::set<Edge>& of, const std::set<Edge>& in,
                         const std::map<std::uint32_t, std::uint32_t>& numbers) {
        return std::ranges::any_of(of, [&](const Edge& pair) {
            const auto front = numbers.find(pair[0]), back = numbers.find(pair[1]);
            return front != numbers.end() && back != numbers.end() &&
                   !in.contains({front->second, back->second});
        });
    }

    // --- R26: distances --------------------------------------------------------------------------

    /// Returns the least limit of the surfaces of a sheet.
    [[nodiscard]] const Bound& limit_of(std::uint32_t sheet) const {
        const Bound* least = &limits_[surfaces_of_sheet_[sheet].front()];
        for (const std::uint32_t surface : surfaces_of_sheet_[sheet])
            if (limits_[surface].distance < least->distance) least = &limits_[surface];
        return *least;
    }

    static std::vector<Triangle> selected(const std::vector<Triangle>& triangles,
                                          const Numbers& which) {
        std::vector<Triangle> result;
        for (const std::uint32_t t : which) result.push_back(triangles[t]);
        return result;
    }

    /// Returns the first triangle that is not near enough. One is enough to refuse, and each may
    /// cost as much as all that are near.
    static std::optional<std::uint32_t> first_beyond(const Numbers& which,
                                                     const std::vector<Triangle>& triangles,
                                                     const Nearness& other, const Bound& limit) {
        for (const std::uint32_t t : which)
            if (!other.covers(triangles[t], limit)) return t;
        return std::nullopt;
    }

    void check_distances_of_sheet(std::uint32_t s) {
        const Bound& limit = limit_of(s);
        const PointPairs points{points_, exact_, rounding_};
        const Nearness old(points, selected(old_triangles_, old_.triangles[s]));
        if (const auto t = first_beyond(new_.triangles[s], new_triangles_, old, limit))
            report(Rule::R26_limits, {*t},
                   "improved triangle " + text(*t) +
                       " is farther from the surface before than the limit");
        const Nearness now(points, selected(new_triangles_, new_.triangles[s]));
        if (const auto t = first_beyond(old_.triangles[s], old_triangles_, now, limit))
            report(Rule::R26_limits, {*t},
                   "triangle " + text(*t) +
                       " of the mesh before is farther from the improved one than the limit");
    }

    void check_distances_of_curve(const CurveClass& key, const std::vector<Triangle>& before) {
        const Numbers& sheets = old_.sheets_of_label.at(key[0]);
        const Bound* limit = &limit_of(sheets.front());
        for (const std::uint32_t s : sheets)
            if (limit_of(s).distance < limit->distance) limit = &limit_of(s);
        std::vector<Triangle> after;
        for (const Triangle& edge : new_.curves.at(key)) after.push_back(moved(edge));
        const PointPairs points{points_, exact_, rounding_};
        const Nearness old(points, before), now(points, after);
        const auto far = std::ranges::find_if_not(
            after, [&](const Triangle& edge) { return old.covers(edge, *limit); });
        if (far != after.end()) {
            const Edge edge{(*far)[0] - offset_, (*far)[1] - offset_};
            report(Rule::R25_curves, {edge[0], edge[1]},
                   "the edge of vertices " + text(edge) +
                       " is farther from its curve before than the limit");
        }
        const auto left = std::ranges::find_if_not(
            before, [&](const Triangle& edge) { return now.covers(edge, *limit); });
        if (left != before.end())
            report(Rule::R25_curves, {(*left)[0], (*left)[1]},
                   "the edge of vertices " + text(Edge{(*left)[0], (*left)[1]}) +
                       " of the mesh before is farther from its curve than the limit");
    }

    // --- R27: sides ------------------------------------------------------------------------------

    /// Returns twice the vector area of triangles.
    [[nodiscard]] Vector3 area_of(const std::vector<Triangle>& triangles,
                                  const Numbers& which) const {
        Vector3 sum;
        for (const std::uint32_t t : which) {
            const auto& [a, b, c] = triangles[t];
            const Vector3 area = normal_of({&exact_[a], &exact_[b], &exact_[c]});
            for (std::size_t i = 0; i < 3; ++i) sum[i] += area[i];
        }
        return sum;
    }

    /// Returns six times the volume between triangles and the origin.
    [[nodiscard]] mpz_class volume_of(const std::vector<Triangle>& triangles,
                                      const Numbers& which) const {
        mpz_class sum = 0;
        for (const std::uint32_t t : which) {
            const auto& [a, b, c] = triangles[t];
            sum += determinant(exact_[a], exact_[b], exact_[c]);
        }
        return sum;
    }

    void check_side(std::uint32_t s) {
        if (!old_.shapes[s].oriented) return;
        const std::uint32_t first = new_.triangles[s].front();
        if (!new_.shapes[s].oriented) {
            report(Rule::R27_sides, {first},
                   "triangles of the region of improved triangle " + text(first) +
                       " face different sides");
            return;
        }
        const Vector3 area = area_of(old_triangles_, old_.triangles[s]);
        const bool same = sgn(dot(area, area)) != 0
                              ? sgn(dot(area, area_of(new_triangles_, new_.triangles[s]))) > 0
                              : sgn(volume_of(old_triangles_, old_.triangles[s])) ==
                                    sgn(volume_of(new_triangles_, new_.triangles[s]));
        if (!same)
            report(Rule::R27_sides, {first},
                   "the region of improved triangle " + text(first) + " is turned over");
    }

    LabelledMesh after_;
    Violations& found_;
    SharedNumbers numbers_;
    Sheets old_, new_;
    std::uint32_t offset_ = 0; ///< number of vertices before
    std::vector<Point3> points_;
    std::vector<Vector4> exact_;
    mpz_class scale_;
    double rounding_ = 0;                                 ///< see PointPairs
    std::vector<Bound> limits_;                           ///< per surface
    std::vector<Triangle> old_triangles_, new_triangles_; ///< indices into points_
    std::vector<Numbers> surfaces_of_sheet_;
};

bool has_attributes(const ImprovedClaim& improved, std::size_t surfaces) {
    const std::size_t count = improved.triangles.size();
    if (!well_formed(improved.surfaces_of, count) ||
        improved.surfaces_of.offsets != improved.regions_of.offsets ||
        !well_formed(improved.regions_of, count))
        return false;
    for (std::size_t t = 0; t < count; ++t) {
        const auto list = improved.surfaces_of[t];
        if (list.empty() || !sorted_and_unique(list) || !all_below(list, surfaces)) return false;
    }
    return true;
}

} // namespace

void check_improved_numbers(const ImprovedClaim& improved, std::size_t surfaces, double accepted,
                            Violations& found) {
    constexpr Rule rule = Rule::R22_improved_indices;
    check_finite(improved.vertices, "vertex", rule, found);
    check_corners(improved.triangles, improved.vertices.size(), rule, found);
    check_edge_list(improved.intersection_edges, improved.vertices.size(), rule, found);
    if (!has_attributes(improved, surfaces))
        found.push_back({rule, {}, "a triangle has no surface, or not one region for each"});
    if (improved.limits.size() != surfaces)
        found.push_back({rule, {}, "there is not one limit per surface"});
    for (std::uint32_t s = 0; s < improved.limits.size(); ++s)
        check_limit(improved.limits[s], s, accepted, rule, found);
}

void check_improved(const LabelledMesh& before, const ImprovedClaim& improved, Violations& found) {
    for (Violation& flaw : verify_conforming(improved.vertices, improved.triangles))
        found.push_back(
            {Rule::R23_improved_conforming, std::move(flaw.elements), std::move(flaw.sentence)});
    if (found.empty()) ImprovedComparison(before, improved, found).check();
}

} // namespace terrane::verifier
