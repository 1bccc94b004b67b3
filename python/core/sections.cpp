// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sections/sections.hpp>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/sections/section_text.hpp>

#include "handles.hpp"
#include "model_handle.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

using Corners = std::vector<std::array<double, 2>>;

/// Where a section is: one of these.
struct Where {
    std::vector<double> plane{}, levels{};
    Corners fence{};
    std::string name{}; ///< of a surface of the model
    std::vector<Surface> by{};
};

Where where_of(const py::dict& given) {
    Where where;
    if (given.contains("plane")) where.plane = given["plane"].cast<std::vector<double>>();
    if (given.contains("levels")) where.levels = given["levels"].cast<std::vector<double>>();
    if (given.contains("fence"))
        where.fence = copied<std::array<double, 2>>(given["fence"].cast<py::array>());
    if (given.contains("name")) where.name = from_text(given["name"]);
    if (given.contains("by")) where.by = to_surfaces(given["by"].cast<py::sequence>());
    return where;
}

Surface surface_called(const std::string& name, const Mesh& mesh) {
    const auto labels = unique_labels(mesh.surfaces);
    const auto called = surfaces_called(name, mesh.surfaces, labels);
    if (called.empty()) refuse(not_called("surface", name, labels), "by");
    if (called.size() > 1) refuse("names several surfaces: " + name, "by");
    return surface_of_mesh(mesh, called[0]);
}

SectionSurface surface_of(const Where& where, const Mesh& mesh, const Run& run) {
    const auto& p = where.plane;
    if (!p.empty()) return must(section_plane(mesh, {p[0], p[1], p[2]}, {p[3], p[4], p[5]}));
    if (!where.fence.empty()) return must(section_fence(mesh, where.fence));
    if (!where.by.empty()) return must(section_along(where.by[0], run));
    if (!where.name.empty()) return must(section_along(surface_called(where.name, mesh), run));
    return must(section_levels(mesh, where.levels));
}

/// shows: whether a drawing shows the block behind, and pairs of blocks.
py::dict dict_of_section(Section section, const Model& model, std::array<bool, 2> shows) {
    py::list polygons, lines, blocks;
    for (SectionPolygon& p : section.polygons) {
        py::list rings;
        for (auto& ring : p.rings) rings.append(owned(std::move(ring)));
        polygons.append(
            py::make_tuple(std::uint32_t(p.block), std::uint32_t(p.behind), rings, p.area));
    }
    for (SectionLine& line : section.lines)
        lines.append(py::make_tuple(std::uint32_t(line.surface), owned(std::move(line.vertices))));
    for (const ModelBlock& block : model.structure.blocks)
        blocks.append(py::make_tuple(to_text(block.name), to_text(block.unit)));
    auto surfaces = model.mesh.mesh()->surfaces;
    const auto labels = unique_labels(surfaces);
    for (std::size_t s = 0; s < labels.size(); ++s) surfaces[s].name = labels[s];
    return py::dict("vertices"_a = owned(std::move(section.vertices)),
                    "flat"_a = owned(std::move(section.flat)), "polygons"_a = polygons,
                    "lines"_a = lines, "triangles"_a = owned(std::move(section.triangles)),
                    "polygon_of"_a = owned(std::move(section.polygon_of)), "blocks"_a = blocks,
                    "surfaces"_a = python::to_list(surfaces), "shows_behind"_a = shows[0],
                    "shows_pairs"_a = shows[1]);
}

py::dict section_of(const ModelPointer& model, const py::dict& given, const HowToRun& how) {
    auto made = run_stage(how, [model, where = where_of(given)](const Run& run) {
        const Mesh& mesh = model->model.mesh;
        const SectionSurface along = surface_of(where, mesh, run);
        const SectionSheet& sheet = along.sheets[0];
        const bool by = !where.by.empty() || !where.name.empty();
        const bool map = sheet.right.z == 0 && sheet.up.z == 0;
        return std::pair(must(cut_section(mesh, model->model.volumes, along, run)),
                         std::array{by && map, by && !map});
    });
    return dict_of_section(std::move(made.first), model->model, made.second);
}

Section to_section(const py::dict& given) {
    Section section{copied<Point3>(given["vertices"].cast<py::array>()),
                    copied<std::array<double, 2>>(given["flat"].cast<py::array>()),
                    {},
                    {},
                    copied<Triangle>(given["triangles"].cast<py::array>()),
                    copied<std::uint32_t>(given["polygon_of"].cast<py::array>())};
    for (const py::handle one : given["polygons"]) {
        const auto values = one.cast<py::tuple>();
        SectionPolygon p{BlockId(values[0].cast<std::uint32_t>()),
                         BlockId(values[1].cast<std::uint32_t>()),
                         {},
                         values[3].cast<double>()};
        for (const py::handle ring : values[2])
            p.rings.push_back(copied<std::uint32_t>(ring.cast<py::array>()));
        section.polygons.push_back(std::move(p));
    }
    for (const py::handle one : given["lines"]) {
        const auto values = one.cast<py::tuple>();
        section.lines.push_back({SurfaceId(values[0].cast<std::uint32_t>()),
                                 copied<std::uint32_t>(values[1].cast<py::array>())});
    }
    return section;
}

SectionNames to_names(const py::dict& given) {
    SectionNames names;
    for (const py::handle one : given["blocks"]) {
        const auto values = one.cast<py::tuple>();
        names.blocks.push_back(from_text(values[0]));
        names.units.push_back(from_text(values[1]));
    }
    names.surfaces = to_infos(given["surfaces"].cast<py::sequence>());
    names.shows_behind = given["shows_behind"].cast<bool>();
    names.shows_pairs = given["shows_pairs"].cast<bool>();
    return names;
}

/// Refuses a section whose indices name nothing, as a changed pickle may have.
void require_indices(const Section& section, const SectionNames& names) {
    const std::size_t vertices = section.vertices.size();
    if (section.flat.size() != vertices || section.polygon_of.size() != section.triangles.size())
        refuse(ErrorCode::bad_index, "the arrays of the section do not belong together", "");
    const auto require = [&](std::span<const std::uint32_t> all, std::size_t least) {
        if (all.size() < least) refuse(ErrorCode::bad_index, "a part has no vertices", "");
        for (const std::uint32_t v : all) require_below(v, vertices, "vertex");
    };
    for (const SectionPolygon& p : section.polygons) {
        require_below(p.block, names.blocks.size(), "block");
        require_below(p.behind, names.blocks.size(), "block");
        for (const auto& ring : p.rings) require(ring, 3);
    }
    for (const SectionLine& line : section.lines) {
        require_below(line.surface, names.surfaces.size(), "surface");
        require(line.vertices, 2);
    }
    for (const Triangle& t : section.triangles) require(t, 3);
    for (const std::uint32_t p : section.polygon_of)
        require_below(p, section.polygons.size(), "polygon");
}

/// Writes a file; False if its extension is that of no format of sections.
bool save_section(const py::dict& given, const py::object& file, const py::str& title,
                  double exaggeration) {
    const auto path = to_path(file);
    const auto format = section_format(path.extension().string());
    if (!format) return false;
    SectionNames names = to_names(given);
    names.title = from_text(title);
    names.exaggeration = exaggeration;
    const Section section = to_section(given);
    require_indices(section, names);
    must(write_section(section, names, *format, path));
    return true;
}

MeshPointer mesh_of_section(const py::dict& given) {
    const Section section = to_section(given);
    const SectionNames names = to_names(given);
    require_indices(section, names);
    return handle_of(SharedMesh(section_mesh(section, names)));
}

} // namespace

void bind_sections(py::module_& module) {
    module.def("section", &section_of, "model"_a, "where"_a, "how"_a);
    module.def("save_section", &save_section, "section"_a, "path"_a, "title"_a, "exaggeration"_a);
    module.def("section_mesh", &mesh_of_section, "section"_a);
}

} // namespace terrane::python
