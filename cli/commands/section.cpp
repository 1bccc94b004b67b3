// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/io/sections/section_text.hpp>

namespace terrane::cli {
namespace {

struct SectionCommand {
    ModelCommand model;
    std::string plane, fence, level, by; ///< one of them, or contours
    double contours = 0;                 ///< step; 0: none
    double exaggeration = 1;
};

constexpr auto section_footer =
    R"(The command arranges the surfaces, cuts them by a volume of interest, rounds them and names the blocks as
`terrane volume` does. Then it cuts the model exactly: polygons of blocks, lines of surfaces.

OUT is a drawing (.svg), a map or table (.geojson, .shp, .dxf, .csv), or the triangles of the section by block in any
format of surfaces (.vtp, .obj, .ts, ...). Coordinates of a drawing are the distance along the section and the height;
those of levels, and of a surface that is seen from above, are x and y.

Where the section lies upon a surface, the block in front counts, on the side of the normal, or the right of a
fence. A section by a surface in the map shows the blocks below, as a geological map does; one by a steep
surface, such as a fault, shows which block touches which.

A section without blocks and lines is not written, and the exit status is 1.

Examples:
  terrane section *.ts --box 0,0,-3000,9000,9000,500 --fence 0,0,4000,5000,9000,9000 -o fence.svg
  terrane section model.ml --plane 4500,4500,0,0,-1,0 -o west-east.svg --exaggeration 5
  terrane section model.ml --level -1000 -o slice.geojson
  terrane section top.ts --contours 50 -o contours.dxf
  terrane section *.ts --by topography -o geological-map.svg)";

/// Returns the numbers of an option. Errors: bad_option.
std::vector<double> numbers_of(const std::string& text, const char* option, const char* wanted) {
    auto numbers = numbers_in(text);
    if (!numbers) refuse("needs numbers: " + std::string(wanted), option);
    return std::move(*numbers);
}

/// Returns the levels at multiples of a step between the heights of a mesh. Errors: bad_option.
std::vector<double> levels_of(const Mesh& mesh, double step) {
    constexpr int most = 10000;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Point3& p : mesh.vertices) {
        low = std::min(low, p.z);
        high = std::max(high, p.z);
    }
    if (!((high - low) / step <= most))
        refuse("makes more than 10000 contours of each surface; take a larger step", "--contours");
    std::vector<double> levels;
    const double first = std::ceil(low / step);
    for (int k = 0; k <= most && (first + k) * step <= high; ++k)
        levels.push_back((first + k) * step);
    if (levels.empty()) refuse("has no multiple between the heights of the surfaces", "--contours");
    return levels;
}

/// Where a section is, as far as no model is needed to know it: what the command states of these.
struct SectionPlace {
    std::vector<double> plane, levels;
    std::vector<std::array<double, 2>> fence;
    std::optional<Surface> by{}; ///< of a file; empty: the surface of the model that has this name
};

/// Returns the surface in a file.
Surface surface_in(const std::string& file, const FileOptions& files) {
    auto read = must(read_surfaces(file, std::nullopt, files.read));
    if (read.size() != 1) refuse("has several surfaces: " + file, "--by");
    return std::move(read[0]);
}

/// Reads the options, and refuses mistakes in them before the model is made. Errors: bad_option; those of reading.
SectionPlace place_in(const SectionCommand& command, ModelRun& run) {
    SectionPlace place;
    if (!command.plane.empty()) {
        place.plane = numbers_of(command.plane, "--plane", "x,y,z,nx,ny,nz");
        if (place.plane.size() != 6) refuse("needs six numbers: x,y,z,nx,ny,nz", "--plane");
    }
    if (!command.fence.empty()) place.fence = corners_of(command.fence, "--fence");
    if (!command.level.empty()) place.levels = numbers_of(command.level, "--level", "z,z,...");
    if (command.by.empty()) return place;
    auto surfaces = run.surfaces();
    surfaces.insert(surfaces.end(), run.boundary().begin(), run.boundary().end());
    const auto infos = infos_of(surfaces);
    const auto labels = unique_labels(infos);
    const auto called = surfaces_called(command.by, infos, labels).size();
    if (called > 1) refuse("names several surfaces: " + command.by, "--by");
    if (called == 1) return place;
    if (!std::filesystem::exists(command.by))
        refuse(not_called("surface", command.by, labels), "--by");
    place.by = surface_in(command.by, run.files());
    run.examine_with(*place.by);
    return place;
}

void check_section(const SectionCommand& command) {
    const int given = int{!command.plane.empty()} + int{!command.fence.empty()} +
                      int{!command.level.empty()} + int{!command.by.empty()} +
                      int{command.contours != 0};
    if (given != 1)
        refuse("one of these must be given", "--plane, --fence, --level, --contours, --by");
}

Result<SectionSurface> surface_of(const SectionCommand& command, const SectionPlace& place,
                                  const Mesh& mesh, const Run& run) {
    if (const auto& n = place.plane; !n.empty())
        return section_plane(mesh, {n[0], n[1], n[2]}, {n[3], n[4], n[5]});
    if (!place.fence.empty()) return section_fence(mesh, place.fence);
    if (!place.levels.empty()) return section_levels(mesh, place.levels);
    if (command.contours != 0) return section_levels(mesh, levels_of(mesh, command.contours));
    if (place.by) return section_along(*place.by, run);
    const auto called = surfaces_called(command.by, mesh.surfaces, unique_labels(mesh.surfaces));
    if (called.empty()) refuse("nothing is left of this surface: " + command.by, "--by");
    return section_along(surface_of_mesh(mesh, called[0]), run);
}

/// Returns a mesh that is as wide as surfaces are.
Mesh mesh_around(const std::vector<Surface>& surfaces) {
    Mesh mesh;
    for (const Surface& s : surfaces)
        for (const Triangle& t : s.triangles)
            for (const std::uint32_t v : t) mesh.vertices.push_back(s.vertices[v]);
    for (std::uint32_t v = 0; v + 2 < mesh.vertices.size(); v += 3)
        mesh.triangles.push_back({v, v + 1, v + 2});
    return mesh;
}

/// Returns the option that says where the section is, and its value.
std::pair<std::string, std::string> place_of(const SectionCommand& command) {
    if (!command.plane.empty()) return {"plane", command.plane};
    if (!command.fence.empty()) return {"fence", command.fence};
    if (!command.level.empty()) return {"level", command.level};
    if (command.contours != 0) return {"contours", fmt::format("{}", command.contours)};
    return {"by", command.by};
}

SectionNames names_of(const SectionCommand& command, const SectionSurface& along,
                      const ModelRun& run) {
    SectionNames names = names_in(*run.built().model);
    const auto [option, value] = place_of(command);
    names.title = fmt::format("{}: {} {}", name_of_inputs(command.model.files), option, value);
    names.length_unit = run.inputs().unit;
    names.exaggeration = command.exaggeration;
    names.shows_heights = command.contours != 0;
    const SectionSheet& sheet = along.sheets[0];
    const bool is_map = sheet.right.z == 0 && sheet.up.z == 0;
    names.shows_behind = !command.by.empty() && is_map;
    names.shows_pairs = !command.by.empty() && !is_map;
    return names;
}

double area_of(const Section& section) {
    double sum = 0;
    for (const SectionPolygon& p : section.polygons) sum += p.area;
    return sum;
}

std::string text_of(const Section& section, const SectionNames& names,
                    const Quantities& quantities) {
    if (names.shows_heights && section.polygons.empty())
        return fmt::format("contours: {}\n", counted(section.lines.size(), "line"));
    std::set<std::uint32_t> blocks, surfaces;
    for (const SectionPolygon& p : section.polygons) blocks.insert(names.shown(p));
    for (const SectionLine& line : section.lines) surfaces.insert(line.surface);
    std::string text = fmt::format(
        "section: {} of {}, area {}; {} of {}\n", counted(section.polygons.size(), "polygon"),
        counted(blocks.size(), "block"), quantities.area(area_of(section)),
        counted(section.lines.size(), "line"), counted(surfaces.size(), "surface"));
    if (section.polygons.empty() && !section.lines.empty())
        text += "The section meets no closed block; a volume of interest, such as --box, closes "
                "blocks.\n";
    return text;
}

/// A file for the section: in a format of sections, or of meshes.
struct SectionOutput {
    std::string path;
    std::optional<SectionFormat> format{};
    std::vector<Output> mesh{}; ///< one, or none
};

std::vector<SectionOutput> plan_section_outputs(const FileOptions& files) {
    std::vector<SectionOutput> outputs;
    FileOptions meshes = files;
    meshes.outputs.clear();
    for (const std::string& path : files.outputs) {
        if (path == "-" && files.output_format.empty() && !format_named(files.format))
            refuse("the format must be given: --output-format FORMAT", "standard output");
        const auto extension = files.output_format.empty()
                                   ? std::filesystem::path(path).extension().string()
                                   : "." + files.output_format;
        outputs.push_back({path, section_format(extension)});
        if (outputs.back().format)
            check_folder(path);
        else
            meshes.outputs.push_back(path);
    }
    if (std::ranges::count(files.outputs, "-") > 1 ||
        (std::ranges::count(files.outputs, "-") == 1 &&
         (files.stats == "-" || files.report == "-")))
        refuse("standard output can take only one file");
    const auto planned = plan_outputs(meshes, OutputKind::surfaces);
    auto next = planned.begin();
    for (SectionOutput& output : outputs)
        if (!output.format) output.mesh = {*next++};
    return outputs;
}

void write_output(const Section& section, const SectionNames& names, const SectionOutput& output,
                  const ModelRun& run, Session& session) {
    if (!output.format) {
        if (section.triangles.empty())
            refuse("the section has no polygon, and this format has no lines", output.path);
        write_output(section_mesh(section, names), output.mesh[0], {.ascii = run.files().ascii},
                     session);
        return say_written(run.told(), output.path);
    }
    session.begin("write", Phase::writing);
    const auto paths = must(write_section(section, names, *output.format, output.path));
    session.end_stage();
    for (const auto& path : paths) say_written(run.told(), path.string());
}

ExitStatus draw_section(const SectionCommand& command, Session& session) {
    check_section(command);
    const auto outputs = plan_section_outputs(command.model.files);
    auto run = ModelRun::begin(command.model, session);
    const SectionPlace place = place_in(command, run);
    const auto at = [&](Error error) {
        if (error.place == "section") error.place = "--" + place_of(command).first;
        return Failure{error};
    };
    if (command.contours == 0 &&
        (command.by.empty() || place.by)) { // a mistake shows before the work
        const auto tried = surface_of(command, place, mesh_around(run.surfaces()), session.run());
        if (!tried && tried.error().code == ErrorCode::bad_option) throw at(tried.error());
    }
    run.make();
    if (!run.refused().empty()) return run.end(false);
    const Model& model = *run.built().model;
    const auto along = surface_of(command, place, model.mesh, session.run());
    if (!along) throw at(along.error());
    const auto section = session.timed(
        "section", [&] { return cut_section(model.mesh, model.volumes, *along, session.run()); });
    if (!section) throw at(section.error());
    const SectionNames names = names_of(command, *along, run);
    say(run.told(), text_of(*section, names, run.inputs().quantities()));
    run.statistics()["section"] = {{"polygons", section->polygons.size()},
                                   {"lines", section->lines.size()},
                                   {"area", area_of(*section)}};
    const bool is_empty = section->polygons.empty() && section->lines.empty();
    if (is_empty) print(stderr, complaint("nothing written: the section does not meet the model"));
    if (!is_empty)
        for (const SectionOutput& output : outputs)
            write_output(*section, names, output, run, session);
    return run.end(!is_empty);
}

} // namespace

Command section_command(CLI::App& program) {
    auto command = std::make_shared<SectionCommand>();
    auto* app = program.add_subcommand("section", "Draw sections, slices, contours and maps");
    add_inputs(*app, command->model.files);
    add_output(*app, command->model.files, "File for the section; - is standard output");
    add_value(*app, "--plane", command->plane, "X,Y,Z,NX,NY,NZ",
              "Cut by the plane through a point across a normal, seen from where this points");
    add_value(*app, "--fence", command->fence, "LINE",
              "Cut by vertical panels along a line in the map: x,y,x,y,..., or a file with x and y "
              "on each line");
    add_value(*app, "--level", command->level, "Z,...",
              "Cut by horizontal planes at these heights");
    add_value(*app, "--contours", command->contours, "STEP",
              "Cut by horizontal planes at all multiples of a step")
        ->check(positive());
    add_value(*app, "--by", command->by, "SURFACE",
              "Cut by a surface, such as the topography: its name, or a file with it alone");
    add_value(*app, "--exaggeration", command->exaggeration, "F",
              "Stretch drawings vertically (default: 1)")
        ->check(positive());
    add_naming(*app, command->model);
    add_arranging(*app, command->model);
    add_run(*app, command->model.files);
    command->model.tells_blocks = false;
    command->model.project.last = BuildStage::blocks;
    app->footer(section_footer);
    return {app, [command] {
                Session session(command->model.files.threads);
                return draw_section(*command, session);
            }};
}

} // namespace terrane::cli
