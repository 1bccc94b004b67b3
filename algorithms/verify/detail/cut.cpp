// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/cut.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <terrane/algorithms/verify/detail/contacts.hpp>
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>
#include <terrane/algorithms/verify/detail/rays.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane::verifier {

namespace {

// --- R50: the boundary --------------------------------------------------------------------------

/// The triangles of all surfaces of a boundary; vertices at one place are one vertex.
struct Shell {
    std::vector<Point3> vertices;
    std::vector<Triangle> triangles;
};

Shell joined_shell(const std::vector<Surface>& boundary) {
    Shell shell;
    std::map<Point3, std::uint32_t> number_of;
    for (const Surface& s : boundary)
        for (Triangle t : s.triangles) {
            for (std::uint32_t& corner : t) {
                const auto [at, added] = number_of.try_emplace(
                    s.vertices[corner], static_cast<std::uint32_t>(shell.vertices.size()));
                if (added) shell.vertices.push_back(s.vertices[corner]);
                corner = at->second;
            }
            shell.triangles.push_back(t);
        }
    return shell;
}

/// Tells whether each edge has an even number of triangles; `once`: one in each direction.
bool is_closed(const Shell& shell, bool once) {
    bool closed = true;
    for_each_edge(half_edges(shell.triangles), [&](std::span<const HalfEdge> sides) {
        closed = closed && sides.size() % 2 == 0 &&
                 (!once || (sides.size() == 2 && sides[0].ascends != sides[1].ascends));
    });
    return closed;
}

/// Tells whether a closed shell faces outwards: its volume is positive.
bool faces_outwards(const Shell& shell) {
    const auto points = scale_to_integers(shell.vertices).points;
    mpz_class volume;
    for (const auto& [a, b, c] : shell.triangles)
        volume += determinant(points[a], points[b], points[c]);
    return sgn(volume) > 0;
}

/// Returns what is wrong with a prism, or nothing.
std::string prism_flaw(const VolumeClaim& volume, const Shell& shell) {
    const auto& corners = volume.corners;
    if (corners.size() < 3 || volume.between.size() != 2 ||
        !(volume.between[0] < volume.between[1]))
        return "a prism needs three corners and two heights, the lower first";
    std::map<std::array<double, 2>, std::size_t> number_of;
    for (const auto& corner : corners) number_of.try_emplace(corner, number_of.size());
    const std::size_t count = corners.size();
    if (number_of.size() != count) return "two corners of the polygon are the same";
    if (shell.vertices.size() != 2 * count)
        return "the boundary has not two vertices per corner of the polygon";
    for (const Triangle& t : shell.triangles) {
        std::array<std::size_t, 3> at{};
        std::array<bool, 3> is_high{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Point3& p = shell.vertices[t[i]];
            const auto corner = number_of.find({p.x, p.y});
            if (corner == number_of.end() || (p.z != volume.between[0] && p.z != volume.between[1]))
                return "a vertex of the boundary is no corner of the prism";
            at[i] = corner->second;
            is_high[i] = p.z == volume.between[1];
        }
        const bool is_cap = is_high[0] == is_high[1] && is_high[1] == is_high[2];
        const auto [low, high] = std::minmax({at[0], at[1], at[2]});
        const bool ends = std::ranges::all_of(
            at, [&, a = low, b = high](std::size_t i) { return i == a || i == b; });
        if (!is_cap && !(ends && (high - low == 1 || (low == 0 && high + 1 == count))))
            return "a triangle of the boundary is in no side of the prism";
    }
    return "";
}

/// Numbers the vertices of a box: bit k tells on which end of the edges along direction k they are.
/// The corners were rounded, and so were the sums that they are: each coordinate is off by at most
/// 9 u M, where u = 2^-53 and M is the largest coordinate. So sums of up to three edges at a corner
/// miss the others by at most 54 u M, and the scalar products of edges a and b are at most
/// 128 u M (|a| + |b|), with the errors of the directions.
std::vector<unsigned> corners_of_box(const std::vector<Point3>& corners) {
    double largest = 0;
    for (const Point3& p : corners)
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    auto vertices = corners;
    vertices.push_back({0x1p-47 * largest, 0, 0});
    const auto points = scale_to_integers(vertices).points;
    const mpz_class& slack = points.back()[0];
    const auto is_right = [&](const Vector3& a, const Vector3& b) {
        mpz_class sum = 0;
        for (std::size_t i = 0; i < 3; ++i) sum += abs(a[i]) + abs(b[i]);
        return abs(dot(a, b)) <= 2 * slack * sum;
    };
    const auto numbers_from = [&](const std::array<Vector3, 3>& edges) {
        std::vector<unsigned> number_of(8, 8);
        for (std::size_t v = 0; v < 8; ++v)
            for (unsigned number = 0; number < 8; ++number) {
                bool is_here = true;
                for (std::size_t i = 0; i < 3; ++i) {
                    mpz_class at = points[0][i] - points[v][i];
                    for (std::size_t k = 0; k < 3; ++k)
                        if ((number >> k & 1U) != 0) at += edges[k][i];
                    is_here = is_here && abs(at) <= slack;
                }
                if (is_here) number_of[v] = number;
            }
        return number_of;
    };
    for (std::size_t i = 1; i < 8; ++i)
        for (std::size_t j = i + 1; j < 8; ++j)
            for (std::size_t k = j + 1; k < 8; ++k) {
                const std::array<Vector3, 3> edges{difference(points[i], points[0]),
                                                   difference(points[j], points[0]),
                                                   difference(points[k], points[0])};
                if (!is_right(edges[0], edges[1]) || !is_right(edges[1], edges[2]) ||
                    !is_right(edges[2], edges[0]))
                    continue;
                auto numbers = numbers_from(edges);
                if (std::set(numbers.begin(), numbers.end()).size() == 8 &&
                    std::ranges::max(numbers) < 8)
                    return numbers;
            }
    return {};
}

/// Returns what is wrong with a rotated box, or nothing.
std::string box_flaw(const Shell& shell) {
    if (shell.vertices.size() != 8 || shell.triangles.size() != 12)
        return "a hexahedron needs eight corners and twelve triangles";
    const auto number_of = corners_of_box(shell.vertices);
    if (number_of.empty()) return "the hexahedron has faces that are not at right angles";
    for (const auto& [a, b, c] : shell.triangles)
        if ((number_of[a] & number_of[b] & number_of[c]) == 0 &&
            (number_of[a] | number_of[b] | number_of[c]) == 7)
            return "a triangle of the boundary is in no face of the hexahedron";
    return "";
}

bool is_same(const Surface& a, const Surface& b) {
    return a.triangles == b.triangles && a.vertices.size() == b.vertices.size() &&
           std::ranges::equal(a.vertices, b.vertices,
                              [](const Point3& p, const Point3& q) { return same_bits(p, q); });
}

std::string volume_flaw(const VolumeClaim& volume, std::span<const Surface> files) {
    for (const Surface& s : volume.boundary) {
        for (const Point3& p : s.vertices)
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                return "a coordinate of the boundary is not finite";
        for (const Triangle& t : s.triangles)
            if (!all_below(t, s.vertices.size()))
                return "a triangle of the boundary names a vertex that does not exist";
    }
    const Shell shell = joined_shell(volume.boundary);
    if (shell.triangles.empty()) return "the boundary has no triangles";
    const bool is_prism = volume.shape == "prism";
    if (volume.corners.empty() == is_prism || volume.between.empty() == is_prism ||
        (volume.shape == "surface") == (volume.files == 0))
        return "the volume is described otherwise than its shape needs it";
    if (volume.shape == "surface") {
        if (!std::ranges::equal(volume.boundary, files, is_same))
            return "the boundary is not the surface of the last input files";
        return is_closed(shell, false) ? "" : "the boundary is not closed";
    }
    if (volume.shape == "prism") {
        if (auto flaw = prism_flaw(volume, shell); !flaw.empty()) return flaw;
    } else if (volume.shape != "hexahedron") {
        return "the boundary is no prism, no hexahedron and no surface";
    } else if (auto flaw = box_flaw(shell); !flaw.empty()) {
        return flaw;
    }
    if (!is_closed(shell, true)) return "the boundary is not closed";
    if (!faces_outwards(shell)) return "the boundary faces inwards";
    return verify_conforming(shell.vertices, shell.triangles).empty()
               ? ""
               : "the boundary meets itself improperly";
}

// --- Locations ----------------------------------------------------------------------------------

/// Triangles and what they have to do with a boundary.
struct Located {
    const ExactMesh& mesh;
    std::vector<bool> is_boundary; ///< per triangle: it has a parent in the boundary
    std::vector<bool> is_odd;      ///< per triangle: it has an odd number of these
};

Located located(const ExactMesh& mesh, const IndexLists<std::uint32_t>& parents_of,
                std::size_t first_of_boundary) {
    Located result{mesh, {}, {}};
    for (std::size_t t = 0; t < parents_of.size(); ++t) {
        const auto count = std::ranges::count_if(
            parents_of[t], [&](std::uint32_t p) { return p >= first_of_boundary; });
        result.is_boundary.push_back(count > 0);
        result.is_odd.push_back(count % 2 == 1);
    }
    return result;
}

/// Returns, for each triangle, whether it is inside or on the boundary.
std::vector<bool> find_inside(const Located& located, const EdgeTriangles& at_edge) {
    const auto& triangles = located.mesh.triangles;
    JoinedSets sets(triangles.size());
    for (const auto& [edge, list] : at_edge)
        if (std::ranges::none_of(list, [&](auto t) { return located.is_boundary[t]; }))
            for (const std::uint32_t t : list) sets.join(list.front(), t);
    Numbers odd;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (located.is_odd[t]) odd.push_back(t);
    const Rays rays(located.mesh, odd, 2);
    std::map<std::uint32_t, bool> is_inside;
    std::vector<bool> inside(triangles.size(), true);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (located.is_boundary[t]) continue;
        const auto [at, added] = is_inside.try_emplace(sets.find(t), false);
        if (added) at->second = rays.cast(centroid_of(located.mesh, t)).size() % 2 == 1;
        inside[t] = at->second;
    }
    return inside;
}

std::size_t first_triangle(std::span<const Surface> surfaces, std::size_t boundary_count) {
    std::size_t first = 0;
    for (const Surface& s : surfaces.first(surfaces.size() - boundary_count))
        first += s.triangles.size();
    return first;
}

} // namespace

void check_volume(const VolumeClaim& volume, std::span<const Surface> files, Violations& found) {
    if (auto flaw = volume_flaw(volume, files); !flaw.empty())
        found.push_back({Rule::R50_volume, {}, std::move(flaw)});
}

ExactMesh exact_mesh_of(std::span<const Surface> surfaces, const ArrangementClaim& exact) {
    Violations found;
    const Inputs inputs = join_inputs(surfaces, found);
    const auto [input_points, scale] = scale_to_integers(inputs.vertices);
    std::vector<Vector4> points;
    for (const Construction& how : exact.vertices)
        points.push_back(construct(how, input_points).value());
    return make_exact_mesh(std::move(points), scale, exact.triangles);
}

std::vector<bool> find_outside(std::span<const Surface> surfaces, std::size_t boundary_count,
                               const ArrangementClaim& exact) {
    if (boundary_count == 0) return std::vector<bool>(exact.triangles.size(), false);
    const auto mesh = exact_mesh_of(surfaces, exact);
    auto outside =
        find_inside(located(mesh, exact.parents_of, first_triangle(surfaces, boundary_count)),
                    triangles_at_edges(exact.triangles));
    outside.flip();
    return outside;
}

void check_dropped(const std::vector<bool>& outside, const Numbers& dropped, bool inside_too,
                   Violations& found) {
    for (std::uint32_t t = 0; t < outside.size(); ++t) {
        const bool is_dropped = std::ranges::binary_search(dropped, t);
        if (is_dropped == outside[t] || (is_dropped && inside_too)) continue;
        found.push_back({Rule::R51_dropped,
                         {t},
                         "exact triangle " + text(t) +
                             (is_dropped ? " is inside or on the boundary, but dropped"
                                         : " is outside, but not dropped")});
    }
}

void check_inside(std::span<const Surface> surfaces, std::size_t boundary_count,
                  const RoundedClaim& rounded, Violations& found) {
    auto [points, scale] = scale_to_integers(rounded.vertices);
    const auto mesh = make_exact_mesh(std::move(points), scale, rounded.triangles);
    const Located all = located(mesh, rounded.parents_of, first_triangle(surfaces, boundary_count));
    const auto at_edge = triangles_at_edges(rounded.triangles);
    for (const auto& [edge, list] : at_edge)
        if (std::ranges::count_if(list, [&](auto t) { return all.is_odd[t]; }) % 2 == 1) {
            found.push_back(
                {Rule::R52_inside,
                 {},
                 "the boundary in doubles is not closed at the edge of vertices " + text(edge)});
            return;
        }
    const auto inside = find_inside(all, at_edge);
    for (std::uint32_t t = 0; t < inside.size(); ++t)
        if (!inside[t])
            found.push_back({Rule::R52_inside, {t}, "triangle " + text(t) + " is outside"});
}

ArrangementClaim without(const ArrangementClaim& exact, const Numbers& dropped) {
    ArrangementClaim kept;
    std::vector<std::uint32_t> number_of(exact.vertices.size(), no_number);
    for (std::uint32_t t = 0; t < exact.triangles.size(); ++t) {
        if (std::ranges::binary_search(dropped, t)) continue;
        kept.triangles.push_back(exact.triangles[t]);
        kept.parents_of.push_back(exact.parents_of[t]);
        for (const std::uint32_t v : exact.triangles[t]) number_of[v] = 0;
    }
    for (std::uint32_t v = 0; v < number_of.size(); ++v) {
        if (number_of[v] == no_number) continue;
        number_of[v] = static_cast<std::uint32_t>(kept.vertices.size());
        kept.vertices.push_back(exact.vertices[v]);
    }
    for (Triangle& t : kept.triangles)
        for (std::uint32_t& corner : t) corner = number_of[corner];
    kept.degenerate = exact.degenerate;
    kept.duplicates = exact.duplicates;
    return kept;
}

} // namespace terrane::verifier
