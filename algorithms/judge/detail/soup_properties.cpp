// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/detail/soup_properties.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/judge/detail/matching.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>

namespace terrane::judging {
namespace {

/// Returns a corner of an input triangle.
Point3 corner(std::span<const Surface> soup, const CheckReport& checked, std::uint32_t t) {
    const auto& first = checked.first_triangle;
    const auto s = static_cast<std::size_t>(std::ranges::upper_bound(first, t) - first.begin()) - 1;
    return soup[s].vertices[soup[s].triangles[t - first[s]][0]];
}

class SoupJudge {
public:
    SoupJudge(const OutputMesh& mesh, std::size_t most) :
        closed("closed", most), manifold("manifold", most), oriented("oriented", most),
        tetgen("tetgen", most), mesh_(mesh), points_(mesh.soup.points) {}

    void look() {
        mesh_.soup.edges.for_each([this](std::uint32_t low, std::uint32_t high, auto sides) {
            look_at_edge(low, high, sides);
        });
        look_at_vertices();
        look_for_near_points();
    }

    Flaws closed, manifold, oriented, tetgen;
    double sharpest = 180; ///< degrees

private:
    using Sides = std::span<const EdgeSides::Side>;

    [[nodiscard]] std::uint32_t number(const EdgeSides::Side& s) const {
        return mesh_.soup.input_of[s.triangle];
    }

    void look_at_edge(std::uint32_t low, std::uint32_t high, Sides sides) {
        const Point3 &p = points_[low], &q = points_[high];
        const Point3 middle{p.x / 2 + q.x / 2, p.y / 2 + q.y / 2, p.z / 2 + q.z / 2};
        std::vector<std::uint32_t> all;
        int sum = 0;
        for (const auto& s : sides) {
            all.push_back(number(s));
            sum += runs_along(mesh_.soup.triangles[s.triangle], low, high) ? 1 : -1;
        }
        if (sides.size() % 2 == 1)
            closed.add({"an edge with an odd number of triangles", middle, all});
        if (sides.size() > 2) manifold.add({"an edge with more than two triangles", middle, all});
        if (sides.size() % 2 == 0 && sum != 0)
            oriented.add({"neighbours run the same way along their edge", middle, all});
        look_at_angles(low, high, sides, middle);
    }

    void look_at_angles(std::uint32_t low, std::uint32_t high, Sides sides, const Point3& middle) {
        std::vector<std::pair<double, std::uint32_t>> angles;
        for (const auto& s : sides) angles.emplace_back(angle(low, high, sides[0], s), number(s));
        std::ranges::sort(angles);
        for (std::size_t i = 0; angles.size() > 1 && i < angles.size(); ++i) {
            const auto& next = angles[(i + 1) % angles.size()];
            const double between =
                next.first - angles[i].first + (i + 1 == angles.size() ? 360 : 0);
            sharpest = std::min(sharpest, between);
            if (between < 0.1) // TetGen takes such facets for overlapping ones
                tetgen.add({"two triangles enclose " + figure(between) + " degrees",
                            middle,
                            {angles[i].second, next.second},
                            between});
        }
    }

    /// Returns the angle from one triangle to another one round an edge, in degrees from 0 to 360.
    [[nodiscard]] double angle(std::uint32_t low, std::uint32_t high, const EdgeSides::Side& from,
                               const EdgeSides::Side& to) const {
        if (from.triangle == to.triangle) return 0;
        const auto minus = [](const Point3& a, const Point3& b) {
            return Point3{a.x - b.x, a.y - b.y, a.z - b.z};
        };
        const auto dot = [](const Point3& a, const Point3& b) {
            return a.x * b.x + a.y * b.y + a.z * b.z;
        };
        const auto cross = [](const Point3& a, const Point3& b) {
            return Point3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
        };
        const Point3 axis = minus(points_[high], points_[low]);
        const auto across = [&](const EdgeSides::Side& s) {
            const Triangle& t = mesh_.soup.triangles[s.triangle];
            const auto third =
                std::ranges::find_if(t, [&](std::uint32_t v) { return v != low && v != high; });
            return cross(axis, minus(points_[*third], points_[low]));
        };
        const Point3 u = across(from), v = across(to);
        const double turn =
            std::atan2(dot(cross(u, v), axis) / std::sqrt(dot(axis, axis)), dot(u, v));
        return (turn < 0 ? turn + 2 * std::numbers::pi : turn) * 180 / std::numbers::pi;
    }

    /// Finds vertices whose triangles are not one fan, joined across edges.
    void look_at_vertices() {
        const auto& triangles = mesh_.soup.triangles;
        DisjointSets corners(3 * triangles.size());
        const auto corner_at = [&](std::uint32_t t, std::uint32_t v) {
            const auto k = std::ranges::find(triangles[t], v) - triangles[t].begin();
            return 3 * t + static_cast<std::uint32_t>(k);
        };
        mesh_.soup.edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            for (const auto& s : sides)
                for (const std::uint32_t v : {low, high})
                    corners.join(corner_at(sides[0].triangle, v), corner_at(s.triangle, v));
        });
        std::vector<std::uint32_t> fans(points_.size());
        for (std::uint32_t c = 0; c < 3 * triangles.size(); ++c)
            fans[triangles[c / 3][c % 3]] += corners.find(c) == c;
        for (std::uint32_t v = 0; v < fans.size(); ++v)
            if (fans[v] > 1) manifold.add({"a vertex where parts meet in a point", points_[v]});
    }

    /// Finds points that TetGen takes for one.
    void look_for_near_points() {
        if (mesh_.vertices.empty()) return;
        Point3 low = points_[mesh_.vertices[0]], high = low;
        for (const std::uint32_t v : mesh_.vertices) {
            const Point3& p = points_[v];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        constexpr double tetgen_default = 1e-8; // of its option -T, in diagonals
        const double reach =
            tetgen_default * std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
        const PointGrid grid(points_, mesh_.vertices, reach);
        for (const std::uint32_t v : mesh_.vertices)
            grid.for_near(points_[v], [&](std::uint32_t w) {
                if (w <= v) return;
                const double d = difference(points_[v], points_[w]);
                tetgen.add({"two points are " + figure(d) + " apart", points_[v], {}, d});
            });
    }

    const OutputMesh& mesh_;
    const std::vector<Point3>& points_;
};

} // namespace

void add_checked(const CheckReport& checked, std::span<const Surface> soup, std::size_t most_flaws,
                 std::vector<JudgedProperty>& properties) {
    Flaws conforming("conforming", most_flaws), distinct("distinct", most_flaws);
    for (const ImproperContact& c : checked.contacts)
        conforming.add({"two triangles meet improperly: " + std::string(name_of(c.kind)),
                        c.place,
                        {c.triangles.begin(), c.triangles.end()}});
    for (const std::uint32_t t : checked.degenerate)
        distinct.add({"a triangle has no area", corner(soup, checked, t), {t}});
    for (const auto& [t, first] : checked.repeated)
        distinct.add({"a triangle repeats another one", corner(soup, checked, t), {t, first}});
    properties.push_back(conforming.said(
        counted_as(conforming.count(), "pair of triangles meets", "pairs of triangles meet") +
        " improperly"));
    properties.push_back(distinct.said(std::to_string(checked.degenerate.size()) +
                                       " without area, " + std::to_string(checked.repeated.size()) +
                                       " repeated"));
}

void add_points_twice(std::span<const Surface> soup, Flaws& welded) {
    for (const Surface& s : soup) {
        const auto used = used_vertices(s.vertices.size(), s.triangles);
        std::vector<Point3> places;
        for (std::size_t v = 0; v < used.size(); ++v)
            if (used[v]) places.push_back(s.vertices[v]);
        std::ranges::sort(places);
        for (auto p = places.begin(); p != places.end();) {
            const auto end =
                std::find_if(p, places.end(), [&](const Point3& q) { return !(q == *p); });
            if (end - p > 1) welded.add({"a point is there more than once", *p});
            p = end;
        }
    }
}

MeshJudgement soup_judgement(std::span<const Surface> soup, const CheckReport& checked,
                             std::size_t most_flaws, const Run& run) {
    const OutputMesh mesh(merge_surfaces(soup, run), 0);
    MeshJudgement judgement;
    add_checked(checked, soup, most_flaws, judgement.properties);
    Flaws welded("welded", most_flaws);
    add_points_twice(soup, welded);
    SoupJudge judge(mesh, most_flaws);
    for (const auto* p : {&judgement.properties[0], &judgement.properties[1]})
        for (const PropertyFlaw& flaw : p->flaws) judge.tetgen.add(flaw);
    judge.look();
    const auto put = [&](Flaws& flaws, std::string_view one, std::string_view many) {
        judgement.properties.push_back(flaws.said(counted_as(flaws.count(), one, many)));
    };
    put(welded, "point twice", "points twice");
    put(judge.closed, "edge open", "edges open");
    put(judge.manifold, "edge or vertex not manifold", "edges and vertices not manifold");
    put(judge.oriented, "edge with neighbours that face different ways",
        "edges with neighbours that face different ways");
    judgement.properties.push_back(
        judge.tetgen.said(counted_as(judge.tetgen.count(), "reason", "reasons") +
                              " to refuse; sharpest angle " + figure(judge.sharpest) + " degrees",
                          judge.sharpest));
    return judgement;
}

} // namespace terrane::judging
