// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/sections/section_text.hpp>

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/sections/section_shapes.hpp>
#include <terrane/io/text/json.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/utf8.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr std::array<std::pair<std::string_view, SectionFormat>, 5> formats{
    {{".svg", SectionFormat::svg},
     {".geojson", SectionFormat::geojson},
     {".dxf", SectionFormat::dxf},
     {".csv", SectionFormat::csv},
     {".shp", SectionFormat::shp}}};

Json position(const Section& section, std::uint32_t v, bool map) {
    const auto& [along, up] = section.flat[v];
    return map ? Json::array({along, up, section.vertices[v].z}) : Json::array({along, up});
}

Json positions(const Section& section, std::span<const std::uint32_t> vertices, bool map) {
    Json list = Json::array();
    for (const std::uint32_t v : vertices) list.push_back(position(section, v, map));
    return list;
}

Json feature(std::string_view type, Json coordinates, Json properties) {
    return Json({{"type", "Feature"},
                 {"geometry", Json({{"type", type}, {"coordinates", std::move(coordinates)}})},
                 {"properties", std::move(properties)}});
}

/// Layers of DXF: of all blocks, then of all surfaces.
std::vector<std::string> layers_of(const SectionNames& names) {
    std::vector<SurfaceInfo> all;
    for (const std::string& block : names.blocks) all.push_back({block});
    all.insert(all.end(), names.surfaces.begin(), names.surfaces.end());
    for (SurfaceInfo& one : all)
        std::ranges::replace_if(
            one.name,
            [](char c) {
                return std::string_view("<>/\\\":;?*|,='`").find(c) != std::string_view::npos;
            },
            '_');
    return plain_names(all);
}

/// Appends a 3-D polyline. A closed one does not repeat its first vertex.
void append_polyline(std::string& out, const Section& section, const std::string& layer,
                     std::span<const std::uint32_t> vertices, bool closed) {
    out += fmt::format("0\nPOLYLINE\n8\n{}\n66\n1\n70\n{}\n10\n0\n20\n0\n30\n0\n", layer,
                       closed ? 9 : 8);
    for (const std::uint32_t v : vertices) {
        const Point3& p = section.vertices[v];
        out += fmt::format("0\nVERTEX\n8\n{}\n70\n32\n10\n", layer);
        append_number(out, p.x);
        out += "\n20\n";
        append_number(out, p.y);
        out += "\n30\n";
        append_number(out, p.z);
        out += '\n';
    }
    out += "0\nSEQEND\n";
}

} // namespace

SectionNames names_in(const Model& model) {
    SectionNames names;
    for (const ModelBlock& block : model.structure.blocks) {
        names.blocks.push_back(block.name);
        names.units.push_back(block.unit);
    }
    names.surfaces = model.mesh.mesh()->surfaces;
    const auto labels = unique_labels(names.surfaces);
    for (std::size_t s = 0; s < labels.size(); ++s) names.surfaces[s].name = labels[s];
    return names;
}

std::optional<SectionFormat> section_format(std::string_view extension) {
    for (const auto& [name, format] : formats)
        if (same_ignoring_case(extension, name)) return format;
    return std::nullopt;
}

bool is_map(const Section& section) {
    for (std::size_t v = 0; v < section.vertices.size(); ++v)
        if (section.flat[v] != std::array{section.vertices[v].x, section.vertices[v].y})
            return false;
    return true;
}

Result<std::vector<SectionFile>> section_files(const Section& section, const SectionNames& given,
                                               SectionFormat format) {
    using Files = std::vector<SectionFile>;
    SectionNames names = given;
    for (std::string& block : names.blocks) block = as_utf8(block);
    for (std::string& unit : names.units) unit = as_utf8(unit);
    for (SurfaceInfo& surface : names.surfaces) surface.name = as_utf8(surface.name);
    switch (format) {
    case SectionFormat::geojson:
        return Files{{".geojson", section_geojson(section, names)}};
    case SectionFormat::dxf:
        return Files{{".dxf", section_dxf(section, names)}};
    case SectionFormat::csv:
        return Files{{".csv", section_csv(section, names)}};
    case SectionFormat::shp:
        return section_shapes(section, names);
    default:
        return Files{{".svg", section_svg(section, names)}};
    }
}

Result<std::vector<std::filesystem::path>> write_section(const Section& section,
                                                         const SectionNames& names,
                                                         SectionFormat format,
                                                         const std::filesystem::path& path) {
    using Paths = std::vector<std::filesystem::path>;
    return guard_memory("", [&]() -> Result<Paths> {
        const auto files = section_files(section, names, format);
        if (!files) return files.error();
        if (files->size() > 1 && path == "-")
            return Error{ErrorCode::bad_option,
                         "in this format a section is several files: name the first",
                         "standard output"};
        std::optional<FileSet> together;
        if (files->size() > 1 && !FileSet::current()) together.emplace();
        Paths paths;
        for (const SectionFile& file : *files) {
            paths.push_back(files->size() == 1
                                ? path
                                : path.parent_path() / (path.stem().string() + file.ending));
            if (auto written = write_file(paths.back(), file.contents); !written)
                return written.error();
        }
        if (together)
            if (auto published = together->publish(); !published) return published.error();
        return paths;
    });
}

std::string section_geojson(const Section& section, const SectionNames& names) {
    const bool map = is_map(section);
    Json features = Json::array();
    for (const SectionPolygon& polygon : section.polygons) {
        Json rings = Json::array();
        for (std::vector<std::uint32_t> ring : polygon.rings) {
            ring.push_back(ring.front());
            rings.push_back(positions(section, ring, map));
        }
        features.push_back(feature("Polygon", std::move(rings),
                                   Json({{"block", names.blocks[polygon.block]},
                                         {"behind", names.blocks[polygon.behind]},
                                         {"unit", names.units[names.shown(polygon)]},
                                         {"area", polygon.area}})));
    }
    for (const SectionLine& line : section.lines)
        features.push_back(feature(
            "LineString", positions(section, line.vertices, map),
            Json({{"surface", names.surfaces[line.surface].name},
                  {"role",
                   role_names[static_cast<std::size_t>(names.surfaces[line.surface].role)]}})));
    return Json({{"type", "FeatureCollection"}, {"features", std::move(features)}}).dump() + '\n';
}

std::string section_dxf(const Section& section, const SectionNames& names) {
    const auto layers = layers_of(names);
    std::string out = "0\nSECTION\n2\nENTITIES\n";
    for (const SectionPolygon& polygon : section.polygons)
        for (const auto& ring : polygon.rings)
            append_polyline(out, section, layers[names.shown(polygon)], ring, true);
    for (const SectionLine& line : section.lines) {
        std::span<const std::uint32_t> vertices(line.vertices);
        const bool closed = vertices.front() == vertices.back();
        if (closed) vertices = vertices.first(vertices.size() - 1);
        append_polyline(out, section, layers[names.blocks.size() + line.surface], vertices, closed);
    }
    return out + "0\nENDSEC\n0\nEOF\n";
}

std::string section_csv(const Section& section, const SectionNames& names) {
    std::string out = "part,kind,block,behind,unit,surface,x,y,z,along,up\n";
    std::size_t part = 0;
    const auto rows = [&](const std::string& of, std::span<const std::uint32_t> vertices) {
        for (const std::uint32_t v : vertices) {
            out += fmt::format("{},{},", part, of);
            const Point3& p = section.vertices[v];
            const auto& [along, up] = section.flat[v];
            for (const double x : {p.x, p.y, p.z, along, up}) {
                append_number(out, x);
                out += ',';
            }
            out.back() = '\n';
        }
    };
    for (const SectionPolygon& polygon : section.polygons) {
        ++part;
        std::string_view kind = "outer";
        for (std::vector<std::uint32_t> ring : polygon.rings) {
            ring.push_back(ring.front());
            rows(fmt::format("{},{},{},{},", kind, detail::csv_field(names.blocks[polygon.block]),
                             detail::csv_field(names.blocks[polygon.behind]),
                             detail::csv_field(names.units[names.shown(polygon)])),
                 ring);
            kind = "hole";
        }
    }
    for (const SectionLine& line : section.lines) {
        ++part;
        rows("line,,,," + detail::csv_field(names.surfaces[line.surface].name), line.vertices);
    }
    return out;
}

Mesh section_mesh(const Section& section, const SectionNames& names) {
    Mesh mesh;
    for (const std::string& block : names.blocks) mesh.surfaces.push_back({block});
    mesh.vertices = section.vertices;
    mesh.triangles = section.triangles;
    for (const std::uint32_t polygon : section.polygon_of) {
        const std::uint32_t block = names.shown(section.polygons[polygon]);
        mesh.surfaces_of.push_back(std::span(&block, 1));
    }
    const VertexRenumbering numbers(used_vertices(mesh.vertices.size(), mesh.triangles));
    numbers.compact(mesh.vertices);
    numbers.rename(mesh.triangles);
    return mesh;
}

} // namespace terrane
