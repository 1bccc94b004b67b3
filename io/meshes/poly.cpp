// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/poly.hpp>

#include <fmt/format.h>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/io/meshes/detail/groups.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

std::string vertex_lines(const std::vector<Point3>& vertices) {
    // The dimension is 3; there are no attributes and no markers.
    auto out = fmt::format("{} 3 0 0\n", vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        append_number(out, std::uint64_t(v + 1));
        out += ' ';
        append_point(out, vertices[v]);
        out += '\n';
    }
    return out;
}

void append_polygon(std::string& out, const Triangle& corners) {
    out += '3';
    for (const auto v : corners) {
        out += ' ';
        append_number(out, std::uint64_t(v) + 1);
    }
}

std::string region_lines(std::span<const BlockPoint> points) {
    auto out = fmt::format("{}\n", points.size());
    for (std::size_t r = 0; r < points.size(); ++r) {
        append_number(out, std::uint64_t(r + 1));
        out += ' ';
        append_point(out, points[r].place);
        out += ' ';
        append_number(out, std::uint64_t(points[r].block));
        out += '\n';
    }
    return out;
}

std::string written(const Mesh& mesh, std::span<const BlockPoint> points, bool short_form) {
    const auto groups = surface_groups(mesh.surfaces_of, mesh.surfaces.size());
    const auto markers = group_tags(groups, mesh.triangles.size());
    auto out = "# markers of facets\n" + tag_comments(groups, mesh.surfaces) + "# points\n" +
               vertex_lines(mesh.vertices);
    out += fmt::format("# facets\n{} 1\n", mesh.triangles.size()); // 1: with markers
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!short_form) out += fmt::format("1 0 {}\n", markers[t]); // one polygon, no hole
        append_polygon(out, mesh.triangles[t]);
        if (short_form) out += fmt::format(" {}", markers[t]);
        out += '\n';
    }
    return out + "# holes\n0\n# regions\n" + region_lines(points);
}

} // namespace

std::string to_poly(const Mesh& mesh, std::span<const BlockPoint> points) {
    const StandardArithmetic guard;
    return written(mesh, points, false);
}

std::string to_smesh(const Mesh& mesh, std::span<const BlockPoint> points) {
    const StandardArithmetic guard;
    return written(mesh, points, true);
}

} // namespace terrane
