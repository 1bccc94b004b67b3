// SPDX-License-Identifier: LGPL-3.0-or-later
#include "forge_meaning.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <set>

#include <gmpxx.h>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

#include "forge_geometry.hpp"

namespace terrane::fuzz {

namespace {

/// Returns the surface of each input triangle.
std::vector<std::uint32_t> surface_of_inputs(const Subject& s) {
    std::vector<std::uint32_t> of;
    for (std::uint32_t i = 0; i < s.surfaces.size(); ++i)
        of.insert(of.end(), s.surfaces[i].triangles.size(), i);
    return of;
}

std::vector<SurfaceInfo> infos_of(const Subject& s) {
    std::vector<SurfaceInfo> infos;
    for (const Surface& surface : s.surfaces) infos.push_back({surface.name, surface.role});
    return infos;
}

/// Replaces input triangles by their surfaces; none where one does not exist.
std::optional<IndexLists<std::uint32_t>> surfaces_of(const Subject& s,
                                                     const IndexLists<std::uint32_t>& parents) {
    const auto of = surface_of_inputs(s);
    IndexLists<std::uint32_t> lists;
    for (std::size_t t = 0; t < parents.size(); ++t) {
        std::set<std::uint32_t> surfaces;
        for (const std::uint32_t p : parents[t]) {
            if (p >= of.size()) return std::nullopt;
            surfaces.insert(of[p]);
        }
        lists.push_back(std::vector<std::uint32_t>(surfaces.begin(), surfaces.end()));
    }
    return lists;
}

bool is_sound(const Mesh& mesh) {
    const auto sound = [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](auto v) { return v < mesh.vertices.size(); });
    };
    if (mesh.surfaces_of.size() != mesh.triangles.size()) return false;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto surfaces = mesh.surfaces_of[t];
        if (surfaces.empty() || surfaces.back() >= mesh.surfaces.size()) return false;
        if (!std::ranges::is_sorted(surfaces)) return false;
    }
    const auto finite = [](const Point3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    };
    return std::ranges::all_of(mesh.triangles, sound) && std::ranges::all_of(mesh.vertices, finite);
}

/// Numbers regions by where they first occur.
std::vector<std::uint32_t> canonical(const IndexLists<std::uint32_t>& regions) {
    std::map<std::uint32_t, std::uint32_t> number_of;
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t region : regions.values)
        numbers.push_back(
            number_of.try_emplace(region, static_cast<std::uint32_t>(number_of.size()))
                .first->second);
    return numbers;
}

bool same_bits(const std::vector<Point3>& a, const std::vector<Point3>& b) {
    const auto bits = [](double d) { return std::bit_cast<std::uint64_t>(d); };
    return std::ranges::equal(a, b, [&](const Point3& p, const Point3& q) {
        return bits(p.x) == bits(q.x) && bits(p.y) == bits(q.y) && bits(p.z) == bits(q.z);
    });
}

/// Tells whether two meshes are the same, whatever the input triangles are called.
bool same_mesh(const RoundedClaim& x, const RoundedClaim& y) {
    return same_bits(x.vertices, y.vertices) && x.triangles == y.triangles &&
           x.regions_of.offsets == y.regions_of.offsets &&
           canonical(x.regions_of) == canonical(y.regions_of);
}

bool same_doubles(const RoundedClaim& x, const RoundedClaim& y) {
    return same_mesh(x, y) && x.parents_of == y.parents_of;
}

/// Sums the number of regions of each surface, and the length of all intersection edges.
struct Totals {
    std::vector<std::size_t> regions;
    double length = 0;
};

Totals totals_of(const Subject& s, const RoundedClaim& claim) {
    const auto of = surface_of_inputs(s);
    std::vector<std::set<std::uint32_t>> regions(s.surfaces.size());
    for (std::size_t t = 0; t < claim.triangles.size(); ++t) {
        std::set<std::uint32_t> surfaces;
        for (const std::uint32_t p : claim.parents_of[t]) surfaces.insert(of[p]);
        std::size_t i = 0;
        for (const std::uint32_t surface : surfaces)
            regions[surface].insert(claim.regions_of[t][i++]);
    }
    Totals totals;
    for (const auto& set : regions) totals.regions.push_back(set.size());
    for (const Edge& e : claim.intersection_edges)
        totals.length += length(claim.vertices[e[1]] - claim.vertices[e[0]]);
    return totals;
}

/// A triangle that names an input triangle, and whether as its first parent.
struct NamingTriangle {
    std::uint32_t triangle = 0;
    bool first = false;
};

using PartsOfInputs = std::vector<std::vector<NamingTriangle>>; ///< per input triangle

PartsOfInputs parts_of_inputs(const Subject& s, const RoundedClaim& claim) {
    PartsOfInputs parts(surface_of_inputs(s).size());
    for (std::uint32_t t = 0; t < claim.triangles.size(); ++t)
        for (const std::uint32_t p : claim.parents_of[t])
            parts[p].push_back({t, p == claim.parents_of[t].front()});
    return parts;
}

void add_moments(std::array<double, 4>& sum, const std::array<Point3, 3>& t) {
    const double area = length(area_vector(t));
    sum[0] += area;
    for (const Point3& p : t) {
        sum[1] += area * p.x / 3;
        sum[2] += area * p.y / 3;
        sum[3] += area * p.z / 3;
    }
}

/// Sums the areas of triangles, and their centroids times the areas.
std::array<double, 4> moments_of(const RoundedClaim& claim,
                                 const std::vector<NamingTriangle>& parts) {
    std::array<double, 4> sum{};
    for (const NamingTriangle& part : parts)
        add_moments(sum, corners(claim.vertices, claim.triangles[part.triangle]));
    return sum;
}

std::array<double, 4> moments_of_triangle(const std::array<Point3, 3>& t) {
    std::array<double, 4> sum{};
    add_moments(sum, t);
    return sum;
}

/// Compares an input triangle with the triangles that name it: they lie within it and face its
/// side, and their areas are those that `moments` has.
std::string parts_flaw(const std::array<Point3, 3>& whole, const RoundedClaim& claim,
                       const std::vector<NamingTriangle>& parts,
                       const std::array<double, 4>& moments, double accepted) {
    const Point3 normal = area_vector(whole);
    const double area = length(normal), around = perimeter(whole);
    // In doubles the area of a long sliver, and of each of its parts, is off by some 1e-16 of the
    // square of its length; there may be hundreds of parts. The claim does not decide how many.
    const double of_slivers = 1e-13 * around * around;
    const double slack = 8 * accepted * around + 1e-9 * area + of_slivers;
    const double of_plane = 1e-15 * around * around * around / area; // error of distances from it
    for (const auto& [t, first] : parts) {
        const auto part = corners(claim.vertices, claim.triangles[t]);
        if (first && dot(area_vector(part), normal) < -slack * area) return "a side";
        for (const Point3& p : part)
            if (distance(p, whole) > 1.001 * accepted + 1e-12 * (around + length(p)) + of_plane)
                return "a corner outside of its parent";
    }
    const auto sums = moments_of(claim, parts);
    const double size = 1 + length(whole[0]) + around; // for the centroid
    for (std::size_t i = 0; i < 4; ++i)
        if (std::abs(sums[i] - moments[i]) > (i == 0 ? slack : 4 * size * slack))
            return "the area of an input triangle";
    return "";
}

} // namespace

bool has_turned(const ArrangementClaim& a, const ArrangementClaim& b) {
    if (a.vertices != b.vertices) return false;
    const auto from_lowest = [](Triangle t) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        return t;
    };
    std::set<Triangle> known;
    for (const Triangle& t : a.triangles) known.insert(from_lowest(t));
    return std::ranges::any_of(b.triangles, [&](const Triangle& t) {
        return known.contains(from_lowest({t[1], t[0], t[2]}));
    });
}

bool is_conforming(const std::vector<Point3>& vertices, const std::vector<Triangle>& triangles) {
    const std::vector<std::uint32_t> labels(triangles.size());
    return conforming(vertices, triangles, labels).ok();
}

std::optional<Mesh> mesh_of(const Subject& s, const Certificate& c) {
    Mesh mesh;
    mesh.surfaces = c.outputs.empty() ? infos_of(s) : c.outputs[0].surfaces;
    if (mesh.surfaces.size() != (c.layered() ? c.layered()->order.size() : s.surfaces.size()))
        return std::nullopt;
    if (c.layered()) {
        mesh.vertices = c.layered()->vertices;
        mesh.triangles = c.layered()->triangles;
        mesh.surfaces_of = c.layered()->surfaces_of;
    } else if (c.improved()) {
        mesh.vertices = c.improved()->vertices;
        mesh.triangles = c.improved()->triangles;
        mesh.surfaces_of = c.improved()->surfaces_of;
    } else if (c.filled()) {
        mesh.vertices = c.filled()->vertices;
        mesh.triangles = c.filled()->triangles;
        for (std::uint32_t i = 0; i < c.filled()->surfaces.size(); ++i)
            for (std::uint32_t t = 0;
                 t < c.filled()->surfaces[i].triangles && mesh.surfaces_of.size() < 1000; ++t)
                mesh.surfaces_of.push_back(std::array{i});
    } else if (c.rounded) {
        mesh.vertices = c.rounded->vertices;
        mesh.triangles = c.rounded->triangles;
        Subject stated;
        stated.surfaces = arranged_surfaces(s, c);
        auto surfaces = surfaces_of(stated, c.rounded->parents_of);
        if (!surfaces) return std::nullopt;
        mesh.surfaces_of = std::move(*surfaces);
    }
    return is_sound(mesh) ? std::optional(mesh) : std::nullopt;
}

std::optional<TetrahedralMesh> tetrahedra_of(const Subject& s, const Certificate& c) {
    if (!c.tetrahedra() || !c.blocks() || !c.rounded) return std::nullopt;
    const TetrahedraClaim& claim = *c.tetrahedra();
    const auto of_triangles = surfaces_of(s, c.rounded->parents_of);
    if (!of_triangles || claim.triangle_of.size() != claim.faces.size() ||
        claim.block_of.size() != claim.tetrahedra.size())
        return std::nullopt;
    TetrahedralMesh mesh{infos_of(s),
                         claim.vertices,
                         claim.tetrahedra,
                         claim.block_of,
                         claim.faces,
                         claim.triangle_of,
                         {},
                         claim.twins,
                         static_cast<std::uint32_t>(c.blocks()->volumes.size())};
    const std::array box{static_cast<std::uint32_t>(mesh.surfaces.size())};
    if (claim.box) mesh.surfaces.push_back({"box", Role::boundary});
    for (const std::uint32_t t : claim.triangle_of) {
        if (t == no_index && !claim.box) return std::nullopt;
        if (t != no_index && t >= of_triangles->size()) return std::nullopt;
        if (t == no_index)
            mesh.surfaces_of.push_back(box);
        else
            mesh.surfaces_of.push_back((*of_triangles)[t]);
    }
    const auto in_range = [&](const auto& cell) {
        return std::ranges::all_of(cell, [&](auto v) { return v < mesh.vertices.size(); });
    };
    const auto sound =
        std::ranges::all_of(mesh.tetrahedra, in_range) &&
        std::ranges::all_of(mesh.faces, in_range) &&
        std::ranges::all_of(mesh.block_of, [&](auto b) { return b < mesh.block_count; }) &&
        std::ranges::all_of(mesh.twins, [&](const auto& twins) {
            return twins[0] < mesh.faces.size() && twins[1] < mesh.faces.size();
        });
    return sound ? std::optional(mesh) : std::nullopt;
}

bool writes_the_same(const Certificate& a, const Certificate& b) {
    if (a.rounded.has_value() != b.rounded.has_value()) return false;
    // Files with tetrahedra, and those with an improved mesh, do not hold the mesh before.
    const bool has_doubles = a.rounded && !a.tetrahedra() && !a.improved();
    if (has_doubles && a.sealed && !same_mesh(*a.rounded, *b.rounded)) return false;
    // Triangles that were added to a surface and left out again change the numbers of input
    // triangles.
    if (has_doubles && !a.sealed && !same_doubles(*a.rounded, *b.rounded)) return false;
    if (a.tetrahedra()) {
        const TetrahedraClaim &x = *a.tetrahedra(), &y = *b.tetrahedra();
        if (!same_bits(x.vertices, y.vertices) || x.tetrahedra != y.tetrahedra ||
            x.block_of != y.block_of || x.faces != y.faces || x.triangle_of != y.triangle_of)
            return false;
    }
    if (a.improved() && (!same_bits(a.improved()->vertices, b.improved()->vertices) ||
                         a.improved()->triangles != b.improved()->triangles ||
                         a.improved()->surfaces_of != b.improved()->surfaces_of))
        return false;
    if (a.layered() && (!same_bits(a.layered()->vertices, b.layered()->vertices) ||
                        a.layered()->triangles != b.layered()->triangles ||
                        a.layered()->surfaces_of != b.layered()->surfaces_of))
        return false;
    return !a.filled() || (same_bits(a.filled()->vertices, b.filled()->vertices) &&
                           a.filled()->triangles == b.filled()->triangles);
}

std::string difference_of_doubles(const Subject& s, const RoundedClaim& claim, double accepted) {
    const RoundedClaim& right = *s.certificate.rounded;
    const auto surfaces = surfaces_of(s, claim.parents_of);
    if (!surfaces) return "a parent that does not exist";
    if (claim.clean != is_conforming(claim.vertices, claim.triangles))
        return "whether the doubles are conforming";
    const auto parts = parts_of_inputs(s, claim), right_parts = parts_of_inputs(s, right);
    std::size_t input = 0;
    for (const Surface& surface : s.surfaces)
        for (const Triangle& t : surface.triangles) {
            const auto whole = corners(surface.vertices, t);
            // Of a triangle that was cut, the rest is left.
            const auto moments = s.certificate.cut ? moments_of(right, right_parts[input])
                                                   : moments_of_triangle(whole);
            if (auto flaw = parts_flaw(whole, claim, parts[input], moments, accepted);
                !flaw.empty())
                return flaw;
            ++input;
        }
    const Totals was = totals_of(s, right), is = totals_of(s, claim);
    if (was.regions != is.regions && right.vanished == claim.vanished) return "the regions";
    if (std::abs(was.length - is.length) >
        1e-9 * was.length + 16 * accepted * static_cast<double>(claim.triangles.size() + 4))
        return "the length of the intersection edges";
    return "";
}

std::string difference_of_blocks(const Subject& s, const Certificate& changed, double accepted) {
    const BlocksClaim &right = *s.certificate.blocks(), &claim = *changed.blocks();
    if (claim.exact != right.exact || claim.volumes.size() != right.volumes.size())
        return "the number of blocks";
    if (same_doubles(*s.certificate.rounded, *changed.rounded) &&
        (claim.shells != right.shells || claim.block_of_shell != right.block_of_shell ||
         claim.around != right.around || claim.volumes != right.volumes))
        return "the blocks";
    double area = 0;
    for (const Triangle& t : changed.rounded->triangles)
        area += length(area_vector(corners(changed.rounded->vertices, t)));
    for (std::size_t b = 0; b < claim.volumes.size(); ++b) {
        const double was = mpq_class(right.volumes[b]).get_d();
        if (std::abs(mpq_class(claim.volumes[b]).get_d() - was) >
            4 * accepted * area + 1e-12 * std::abs(was))
            return "the volume of a block";
    }
    return "";
}

namespace {

std::string difference_of_tetrahedra(const Subject& s, const Certificate& changed) {
    if (!same_doubles(*s.certificate.rounded, *changed.rounded)) return "";
    const auto mesh = tetrahedra_of(s, changed);
    if (!mesh) return "lists that make no tetrahedra";
    // The check is about tetrahedra before nodes are split; twins are compared.
    const auto report = check_tetrahedra(*mesh, *s.mesh, s.volumes);
    for (const TetrahedraViolation& v : report.violations) return message(v);
    return "";
}

} // namespace

std::string difference_in_meaning(const Subject& s, const Certificate& changed, double accepted) {
    if (changed.filled()) return difference_of_filled(s, *changed.filled());
    if (changed.layered()) return difference_of_layers(s, *changed.layered(), accepted);
    if (changed.sealed) return difference_of_sealed(s, changed, accepted);
    if (changed.cut) return difference_of_cut(s, changed, accepted);
    const Certificate& right = s.certificate;
    if (right.digest != changed.digest) return "the digest";
    if (has_turned(right.exact, changed.exact)) return "a side";
    if (right.rounded.has_value() != changed.rounded.has_value())
        return right.kind() == CertificateKind::arrangement && changed.outputs.empty()
                   ? ""
                   : "whether there are doubles";
    if (!right.rounded) return "";
    std::string what = difference_of_doubles(s, *changed.rounded, accepted);
    if (what.empty() && changed.blocks()) what = difference_of_blocks(s, changed, accepted);
    if (what.empty() && changed.tetrahedra()) what = difference_of_tetrahedra(s, changed);
    if (what.empty() && changed.improved()) what = difference_of_improved(s, changed);
    return what;
}

} // namespace terrane::fuzz
