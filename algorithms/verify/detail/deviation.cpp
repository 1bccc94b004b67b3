// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_distances of rounded_parts.hpp.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <terrane/algorithms/verify/detail/box_tree.hpp>
#include <terrane/algorithms/verify/detail/coverage.hpp>
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>

namespace terrane::verifier {

namespace {

using Triangles = std::vector<Triangle>;

// --- (1) The triangles of the exact part ------------------------------------------------------

Squared largest_move(const RoundedParts& parts, Violations& found) {
    Squared largest;
    for (std::uint32_t v = 0; v < parts.points.size(); ++v) {
        const auto exact = construct(parts.exact.vertices[v], parts.input_points);
        if (!exact || *exact == parts.points[v]) continue;
        Squared move = squared_distance(*exact, parts.points[v]);
        if (!within(move, parts.max_move))
            found.push_back({Rule::R14_moves,
                             {v},
                             "vertex " + text(v) +
                                 " is farther from its exact point than the stated largest move"});
        if (!within(move, parts.deviation))
            found.push_back({Rule::R13_deviation,
                             {v},
                             "vertex " + text(v) +
                                 " is farther from its exact point than the stated deviation"});
        if (largest < move) largest = std::move(move);
    }
    return largest;
}

// --- (2) From the triangles to their parents --------------------------------------------------

/// Returns all pairs {parent, corner of one of its children}, sorted and unique.
std::vector<Edge> parents_and_corners(const RoundedClaim& rounded) {
    std::vector<Edge> pairs;
    for (std::size_t t = 0; t < rounded.triangles.size(); ++t)
        for (const std::uint32_t parent : rounded.parents_of[t])
            for (const std::uint32_t corner : rounded.triangles[t])
                pairs.push_back({parent, corner});
    make_set(pairs);
    return pairs;
}

Squared farthest_from_parents(const RoundedParts& parts, Violations& found) {
    Squared farthest;
    for (const auto& [parent, vertex] : parents_and_corners(parts.rounded)) {
        Squared distance = squared_distance(parts.points[vertex], parts.input_corners(parent));
        if (!within(distance, parts.deviation))
            found.push_back({Rule::R13_deviation,
                             {vertex, parent},
                             "vertex " + text(vertex) + " is farther from input triangle " +
                                 text(parent) + " than the stated deviation"});
        if (farthest < distance) farthest = std::move(distance);
    }
    return farthest;
}

// --- What is near an input triangle -------------------------------------------------------------

/// Finds what is left near an input triangle of which a part has vanished.
class Remains {
public:
    explicit Remains(const RoundedParts& parts) : parts_(parts) {}

    /// Returns the triangles of the mesh whose boxes are within a quarter of the deviation of that
    /// of an input triangle.
    [[nodiscard]] Triangles near(std::uint32_t input) const {
        if (!tree_) tree_ = tree_of_mesh();
        Triangles result;
        for (const std::uint32_t t : tree_->touching(
                 widened_by(box_of(parts_.inputs.vertices, parts_.inputs.triangles[input]),
                            parts_.rounded.deviation / 4)))
            result.push_back(parts_.rounded.triangles[t]);
        return result;
    }

private:
    [[nodiscard]] BoxTree tree_of_mesh() const {
        std::vector<Box> boxes;
        for (const Triangle& t : parts_.rounded.triangles)
            boxes.push_back(box_of(parts_.rounded.vertices, t));
        return BoxTree(std::move(boxes));
    }

    const RoundedParts& parts_;
    mutable std::optional<BoxTree> tree_; ///< of the mesh; made for the first one that asks
};

// --- (3) From an input triangle to the triangles that name it ---------------------------------

bool sides_are_near(const RoundedParts& parts, std::uint32_t input, const Triangles& triangles) {
    const auto corners = parts.input_corners(input);
    const NearTriangles near(parts.points, triangles, parts.quarter);
    return near.reach(*corners[0], *corners[1]) && near.reach(*corners[1], *corners[2]) &&
           near.reach(*corners[2], *corners[0]);
}

/// Tells whether the sides of an input triangle are near the mesh. Where the deviation is large, one
/// triangle is near all of it.
bool is_near_mesh(const RoundedParts& parts, std::uint32_t input, const Remains& remains) {
    const Triangles triangles = remains.near(input);
    const auto corners = parts.input_corners(input);
    const auto is_near_all = [&](const Triangle& t) {
        const std::array at{&parts.points[t[0]], &parts.points[t[1]], &parts.points[t[2]]};
        return std::ranges::all_of(
            corners, [&](const Vector4* corner) { return within(*corner, at, parts.quarter); });
    };
    return std::ranges::any_of(triangles, is_near_all) || sides_are_near(parts, input, triangles);
}

bool is_unchanged(const RoundedParts& parts, std::uint32_t input) {
    const auto children = parts.children[input];
    if (children.size() != 1) return false;
    const auto value = [](const auto& corners) {
        std::array<Vector4, 3> points{*corners[0], *corners[1], *corners[2]};
        std::sort(points.begin(), points.end());
        return points;
    };
    return value(parts.corners(children[0])) == value(parts.input_corners(input));
}

/// Judges an input triangle that has children. Returns whether a part of it has vanished, so that
/// only what is left of others is near its sides.
bool check_covered(const RoundedParts& parts, std::uint32_t input, const Remains& remains,
                   Violations& found) {
    Triangles triangles;
    for (const std::uint32_t child : parts.children[input])
        triangles.push_back(parts.rounded.triangles[child]);
    const Coverage coverage(parts.input_corners(input), parts.points, parts.quarter);
    if (!coverage.holds(Coverage::Facing(coverage, triangles))) {
        found.push_back({Rule::R18_coverage,
                         {input},
                         "the parts of input triangle " + text(input) + " leave a hole"});
        return false;
    }
    if (sides_are_near(parts, input, triangles)) return false;
    if (is_near_mesh(parts, input, remains)) return true;
    found.push_back({Rule::R18_coverage,
                     {input},
                     "the parts of input triangle " + text(input) + " do not reach its border"});
    return false;
}

// --- (3) for input triangles of which a part was left out ---------------------------------------

/// The kept part of an input triangle, with points taken to integers.
struct KeptRegion {
    std::vector<Vector4> points;
    Triangles triangles; ///< indices into points
    std::vector<Edge> edges;
    Triangles borders; ///< edges {a, b, b} of one triangle
};

KeptRegion kept_region(const RoundedParts& parts, std::uint32_t input) {
    KeptRegion region;
    std::map<std::uint32_t, std::uint32_t> number_of;
    std::map<Edge, int> uses;
    for (const std::uint32_t t : parts.exact_children[input]) {
        Triangle corners = parts.exact.triangles[t];
        for (std::uint32_t& corner : corners) {
            const auto [at, added] =
                number_of.try_emplace(corner, static_cast<std::uint32_t>(region.points.size()));
            if (added)
                region.points.push_back(rounded_to_integers(
                    construct(parts.exact.vertices[corner], parts.input_points).value()));
            corner = at->second;
        }
        region.triangles.push_back(corners);
        for (const HalfEdge& side : sides_of(corners)) ++uses[side.edge];
    }
    for (const auto& [edge, count] : uses) {
        if (region.points[edge[0]] == region.points[edge[1]]) continue;
        region.edges.push_back(edge);
        if (count == 1) region.borders.push_back({edge[0], edge[1], edge[1]});
    }
    return region;
}

/// Tells whether all edges of a region are near triangles, or covered by the children.
bool edges_are_near(const RoundedParts& parts, const KeptRegion& region, const Coverage& coverage,
                    const Coverage::Facing& children, const Triangles& triangles) {
    const NearTriangles near(parts.points, triangles, parts.quarter);
    return std::ranges::all_of(region.edges, [&](const Edge& e) {
        const Vector4 &a = region.points[e[0]], &b = region.points[e[1]];
        return near.reach(a, b) || coverage.reaches(a, b, children);
    });
}

bool is_thin(const KeptRegion& region, const mpz_class& width) {
    return std::ranges::all_of(region.triangles, [&](const Triangle& t) {
        const Squared height =
            squared_height({&region.points[t[0]], &region.points[t[1]], &region.points[t[2]]});
        return sgn(height.below) == 0 || within(height, width);
    });
}

/// Judges an input triangle of which a part was left out. Returns whether a part of what was kept
/// has vanished.
bool check_cut(const RoundedParts& parts, std::uint32_t input, const Remains& remains,
               Violations& found) {
    const KeptRegion region = kept_region(parts, input);
    Triangles triangles;
    for (const std::uint32_t child : parts.children[input])
        triangles.push_back(parts.rounded.triangles[child]);
    const Coverage coverage(parts.input_corners(input), parts.points, parts.quarter,
                            {region.points, region.triangles, region.borders});
    const Coverage::Facing facing(coverage, triangles);
    const bool is_covered =
        triangles.empty() ? is_thin(region, mpz_class(2 * parts.quarter)) : coverage.holds(facing);
    if (is_covered && edges_are_near(parts, region, coverage, facing, triangles)) return false;
    if (is_covered && edges_are_near(parts, region, coverage, facing, remains.near(input)))
        return true;
    found.push_back({triangles.empty() ? Rule::R12_rounded_parents : Rule::R18_coverage,
                     {input},
                     "a part of input triangle " + text(input) +
                         ", which was kept, is missing in the doubles"});
    return false;
}

// --- (4) Vanished input triangles -------------------------------------------------------------

void check_vanished(const RoundedParts& parts, std::uint32_t input, const Remains& remains,
                    Violations& found) {
    const bool thin =
        within(squared_height(parts.input_corners(input)), mpz_class(2 * parts.quarter));
    if (thin && is_near_mesh(parts, input, remains)) return;
    found.push_back({Rule::R12_rounded_parents,
                     {input},
                     "nothing is left of input triangle " + text(input) +
                         (thin ? ", nor near it of the mesh"
                               : ", which is not as thin as the stated deviation")});
}

} // namespace

Distances check_distances(const RoundedParts& parts, Violations& found) {
    if (parts.same_triangles) return {root_above(largest_move(parts, found), parts.scale), {}};
    Squared farthest = farthest_from_parents(parts, found);
    const Remains remains(parts);
    Distances result;
    bool all_unchanged = true;
    for (std::uint32_t input = 0; input < parts.inputs.triangles.size(); ++input) {
        if (parts.set_aside.first_of[input] != input ||
            std::ranges::binary_search(parts.set_aside.degenerate, input) ||
            parts.exact_children[input].empty() || is_unchanged(parts, input))
            continue;
        all_unchanged = false;
        const bool is_cut = !parts.is_cut.empty() && parts.is_cut[input];
        if (!is_cut && parts.children[input].empty())
            check_vanished(parts, input, remains, found);
        else if (is_cut ? check_cut(parts, input, remains, found)
                        : check_covered(parts, input, remains, found))
            result.partly_vanished.push_back(input);
    }
    // (5/2 c)^2, and more than the integers moved points
    const mpz_class root = 5 * parts.quarter + (parts.is_cut.empty() ? 0 : 8);
    const Squared proven{mpz_class(root * root), 4};
    if (!all_unchanged && farthest < proven) farthest = proven;
    result.deviation = root_above(farthest, parts.scale);
    return result;
}

} // namespace terrane::verifier
