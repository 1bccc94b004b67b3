// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/dxf.hpp>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Names of layers, which have none of AutoCAD's special characters.
std::vector<std::string> layer_names(std::vector<SurfaceInfo> surfaces) {
    for (SurfaceInfo& surface : surfaces)
        std::ranges::replace_if(
            surface.name,
            [](char c) {
                return std::string_view("<>/\\\":;?*|,='`").find(c) != std::string_view::npos;
            },
            '_');
    return plain_names(surfaces);
}

void append_corner(std::string& out, int corner, const Point3& p) {
    int code = 10 + corner;
    for (const double x : {p.x, p.y, p.z}) {
        out += fmt::format("{}\n", code);
        append_number(out, x);
        out += '\n';
        code += 10;
    }
}

} // namespace

std::string to_dxf(const Mesh& mesh) {
    const auto names = layer_names(mesh.surfaces);
    // In the format of release 12 nothing but entities is needed; layers come into being by their names.
    std::string out = "0\nSECTION\n2\nENTITIES\n";
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        for (const auto s : mesh.surfaces_of[t]) {
            out += fmt::format("0\n3DFACE\n8\n{}\n", names[s]);
            int corner = 0;
            for (const auto v : {a, b, c, c}) append_corner(out, corner++, mesh.vertices[v]);
        }
    }
    return out + "0\nENDSEC\n0\nEOF\n";
}

} // namespace terrane
