// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stages for models that are too large or too uncertain to be built at once: simplification, tiles,
// realisations.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/cells/prisms.hpp>
#include <terrane/algorithms/maps/maps.hpp>
#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/algorithms/selection/selection.hpp>
#include <terrane/algorithms/tiles/local_supersteps.hpp>
#include <terrane/algorithms/tiles/names_in_tiles.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>
#include <terrane/algorithms/tiles/volumes_in_tiles.hpp>
#include <terrane/algorithms/uncertainty/measures.hpp>
#include <terrane/algorithms/uncertainty/realisations.hpp>
#include <terrane/io/cell_files.hpp>
#include <terrane/io/grids/pillar_grid.hpp>
#include <terrane/io/points/well_paths.hpp>
#include <terrane/io/sections/section_text.hpp>
#include <terrane/io/sections/well_text.hpp>

#include "fixture.hpp"
#include "scratch.hpp"
#include "stage.hpp"

namespace failing {
namespace {

using namespace terrane;
using namespace terrane::tiles;

/// Two triangles that end just below a third surface.
const Arranged& nearly_touching() {
    static const Arranged arranged = [] {
        std::vector<Surface> surfaces = Fixture::get().surfaces;
        surfaces.erase(surfaces.begin());
        return needed(arrange_within(std::move(surfaces), {}));
    }();
    return arranged;
}

std::vector<Stage> simplifying() {
    const Arranged& arranged = nearly_touching();
    static const ConformingMesh mesh = arranged.rounded.conforming.value();
    static const Resolution resolution{.length = 0.5, .dissolve = false};
    const ImproveOptions options{.edge_length = 8, .passes = 1};
    std::vector<Stage> stages;
    stages.push_back(stage(
        "simplify", [] { return simplify(mesh, {.resolution = 0.5, .edge_length = 8}); },
        [](const Simplified& made) { return text_of(*made.rounded.mesh); }));
    stages.push_back(stage(
        "improve_at_resolution",
        [options] { return improve_at_resolution(mesh, resolution, options); },
        [](const ImprovedAtResolution& made) { return text_of(*made.improved.improved.mesh); }));
    stages.push_back(stage_of(
        "simplify_to", [&arranged] { return arranged; },
        [options](Arranged given) -> Result<Arranged> {
            ImproveOptions changed = options;
            if (auto done = simplify_to(resolution, changed, {}, given); !done) return done.error();
            return given;
        },
        [](const Arranged& made) { return text_of(*made.rounded.mesh); }));
    return stages;
}

/// A needle one unit in the last place wide, in a sheet, and a wall that cuts its tip off: that has no area
/// when it is rounded.
const std::vector<Surface>& needle() {
    static const double above = 1 + 0x1p-52;
    static const std::vector<Surface> surfaces{
        {"needle", Role::unknown, {{0, 1, 0}, {1, 1, 0}, {0.5, above, 0}}, {{0, 1, 2}}},
        {"sheet",
         Role::unknown,
         {{0, 1, 0}, {0.5, 0, 0}, {1, 1, 0}, {0.5, above, 0}, {0.5, 2, 0}},
         {{0, 1, 2}, {0, 3, 4}, {3, 2, 4}}},
        {"wall", Role::unknown, {{0.1, 0.5, -1}, {0.1, 1.5, -1}, {0.1, 1, 1}}, {{0, 1, 2}}}};
    return surfaces;
}

/// Tiles in memory, or one after the other with files in a folder of their own.
std::unique_ptr<LocalSupersteps> tiles_of(bool spools) {
    static const Run run;
    if (!spools)
        return std::make_unique<LocalSupersteps>(LocalOptions{.tiles = 2, .spool = {}}, run);
    const auto folder = scratch() / "tiles with a long name";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    return std::make_unique<LocalSupersteps>(LocalOptions{.tiles = 2, .spool = folder}, run);
}

Result<TiledReport> arranged_in(Supersteps& tiles, bool digest,
                                const std::vector<Surface>& surfaces = Fixture::get().surfaces) {
    return arrange_in_tiles(tiles,
                            [&surfaces](std::size_t file) -> Result<std::vector<Surface>> {
                                return std::vector<Surface>{surfaces[file]};
                            },
                            {.files = surfaces.size(), .digest = digest});
}

std::vector<Stage> dividing() {
    std::vector<Stage> stages;
    for (const bool spools : {false, true})
        stages.push_back(stage_of(
            spools ? "arrange_in_tiles, files" : "arrange_in_tiles, memory",
            [spools] { return tiles_of(spools); },
            [](const std::unique_ptr<LocalSupersteps>& tiles) { return arranged_in(*tiles, true); },
            [](const TiledReport& report) { return report.digest; }));
    stages.push_back(stage_of(
        "arrange_in_tiles, repair", [] { return tiles_of(false); },
        [](const std::unique_ptr<LocalSupersteps>& tiles) {
            return arranged_in(*tiles, false, needle());
        },
        [](const TiledReport& report) { return shown(report.repair.value().surface_deviation); }));
    stages.push_back(stage_of(
        "repair_in_one_process",
        [] {
            auto tiles = tiles_of(false);
            needed(arranged_in(*tiles, false));
            return tiles;
        },
        [](const std::unique_ptr<LocalSupersteps>& tiles) { return repair_in_one_process(*tiles); },
        [](const RepairedWhole& whole) { return text_of(whole.piece.mesh); }));
    stages.push_back(stage_of(
        "find_volumes_in_tiles",
        [] {
            auto tiles = tiles_of(false);
            needed(arranged_in(*tiles, false));
            return tiles;
        },
        [](const std::unique_ptr<LocalSupersteps>& tiles) { return find_volumes_in_tiles(*tiles); },
        [](const Volumes& volumes) {
            const std::span bytes = std::as_bytes(std::span(volumes.measures));
            return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        }));
    stages.push_back(stage_of(
        "name_volumes_in_tiles",
        [] {
            auto tiles = tiles_of(false);
            needed(arranged_in(*tiles, false));
            needed(find_volumes_in_tiles(*tiles));
            return tiles;
        },
        [](const std::unique_ptr<LocalSupersteps>& tiles) { return name_volumes_in_tiles(*tiles); },
        [](const std::vector<std::string>& names) {
            std::string text;
            for (const std::string& name : names) text += name + "\n";
            return text;
        }));
    for (Stage& s : stages) s.returns_errors = false; // see tiled_arrangement.hpp
    return stages;
}

Project uncertain_project() {
    Project project;
    project.source = "a project with a long name.json";
    project.uncertainty.resize(2);
    project.uncertainty[0].surface = "top";
    ProjectField& field = project.uncertainty[0].field.emplace();
    field.range = 5;
    field.sd = 0.1;
    project.uncertainty[1].surface = "fault";
    project.uncertainty[1].dip = 1;
    return project;
}

std::vector<Stage> drawing() {
    const Fixture& f = Fixture::get();
    static const std::vector<std::optional<Surface>> maps(2);
    const auto given = [&f] {
        return std::pair(uncertain_project(), BuildInput{.surfaces = f.surfaces});
    };
    const auto prepare = [](std::pair<Project, BuildInput> from) {
        return Realisations::prepare(std::move(from.first), std::move(from.second), maps);
    };
    static const Realisations all = needed(prepare(given()));
    std::vector<Stage> stages;
    stages.push_back(
        stage_of("Realisations::prepare", given, prepare,
                 [](const Realisations& made) { return text_of(made.input_of(1, 1).surfaces); }));
    stages.push_back(stage(
        "Realisations::input_of", [] { return all.input_of(7, 3); },
        [](const BuildInput& input) { return text_of(input.surfaces); }));
    stages.push_back(stage(
        "column_maps",
        [&f] {
            return column_maps(*f.mesh, f.volumes,
                               {.x = 0, .y = 0, .width = 2, .height = 2, .columns = 4, .rows = 4});
        },
        [](const ColumnMaps& made) { return shown(made.thicknesses.back()); }));
    stages.push_back(stage(
        "grid_over", [&f] { return grid_over(f.surfaces, 2); },
        [](const Grid& made) { return std::to_string(made.nx); }));
    static const Grid grid = needed(grid_over(f.surfaces, 2));
    stages.push_back(stage(
        "map_surface",
        [&f] {
            const std::span surfaces(f.surfaces);
            return map_surface(surfaces.first(1), MapKind::distance, grid, surfaces.subspan(1));
        },
        [](const SurfaceMap& made) { return std::to_string(made.nodes); }));
    stages.push_back(stage(
        "map_blocks",
        [&f] {
            const BlockId block(1);
            return map_blocks(*f.mesh, f.volumes, std::span(&block, 1), grid);
        },
        [](const Grid& made) { return shown(made.values.back()); }));
    const auto size = [](const RectilinearGrid& made) { return std::to_string(made.size()); };
    stages.push_back(stage(
        "cells_with_steps",
        [&f] {
            return cells_with_steps(*f.mesh, {2, 2, 2});
        },
        size));
    stages.push_back(stage(
        "cells_by_count",
        [&f] {
            return cells_by_count(*f.mesh, {3, 4, 5});
        },
        size));
    static const RectilinearGrid cells = needed(cells_by_count(*f.mesh, {3, 4, 5}));
    stages.push_back(stage(
        "blocks_in_cells", [&f] { return blocks_in_cells(*f.mesh, f.volumes, cells); },
        [](const BlocksInCells& made) { return shown(made.shares.back().fraction); }));
    static const BlocksInCells in_cells = needed(blocks_in_cells(*f.mesh, f.volumes, cells));
    static const CellNames cell_names = [&f] {
        CellNames made{{}, {}, "a model with a long name"};
        for (const ModelBlock& block : f.model.structure.blocks) {
            made.blocks.push_back(block.name);
            made.units.push_back(block.unit);
        }
        return made;
    }();
    for (const std::string extension : {".vti", ".vtr", ".grdecl", ".csv"})
        stages.push_back(
            writing_stage("write_cells, " + extension.substr(1), "cells" + extension, true,
                          [format = *cell_format(extension)](const std::filesystem::path& path) {
                              return write_cells(cells, in_cells, cell_names, format, path);
                          }));
    static const Surface lid{
        "lid", Role::horizon, {{0, 0, 9}, {8, 0, 9}, {8, 8, 8}, {0, 8, 9}}, {{0, 1, 2}, {0, 2, 3}}};
    static const Surface floor{"floor",
                               Role::horizon,
                               {{-1, -1, 0}, {9, -1, 1}, {9, 9, 0}, {-1, 9, 0}},
                               {{0, 1, 2}, {0, 2, 3}}};
    stages.push_back(stage(
        "make_prisms", [] { return make_prisms(lid, floor, {.layers = 40}); },
        [](const PrismMesh& made) { return shown(made.volume); }));
    static const std::vector<Surface> horizons{lid, floor};
    static const PillarOptions pillars{{0, 2, 4, 6}, {0, 3, 6}, {7}};
    stages.push_back(stage(
        "make_pillar_grid", [] { return make_pillar_grid(horizons, pillars); },
        [](const PillarGrid& made) { return std::to_string(made.active); }));
    static constexpr double contact = 4;
    stages.push_back(stage(
        "measure_blocks",
        [&f] { return measure_blocks(*f.mesh, f.volumes, std::span(&contact, 1)); },
        [](const std::vector<BlockMeasure>& made) { return shown(made.back().high); }));
    return stages;
}

std::vector<Stage> logging() {
    static const Fixture& f = Fixture::get();
    static const std::vector<WellPath> paths{
        {"a well with a long name", {{1, 1, 9}, {2, 3, 4}, {1, 1, -9}}},
        {"B", {{-9, 1, 1}, {9, 1, 1}}}};
    static const std::vector<WellStation> stations{{0, 0, 0}, {5, 30, 90}, {9, 40, 90}};
    static const std::string table = "well,x,y,z\nA,1,1,9\nA,1,1,0\n";
    static const std::string las =
        "~V\nVERS. 2.0 :\n~W\nX. 1 :\nY. 1 :\n~P\nEKB. 9 :\n~C\nDEPT.M :\n"
        "INCL. :\nAZIM. :\n~A\n0 0 0\n9 0 0\n";
    std::vector<Stage> stages;
    stages.push_back(stage(
        "log_wells", [] { return log_wells(*f.mesh, f.volumes, paths); },
        [](const std::vector<WellLog>& made) {
            return std::to_string(made.back().intervals.size()) + " " +
                   std::to_string(made.back().markers.size());
        }));
    stages.push_back(stage(
        "surveyed_path",
        [] {
            return surveyed_path("A", {0, 0, 9}, stations);
        },
        [](const WellPath& made) { return std::to_string(made.points.size()); }));
    for (const auto& [name, text] : {std::pair{"table", &table}, std::pair{"las", &las}})
        stages.push_back(stage(
            std::string("read_well_paths, ") + name,
            [text = text] { return read_well_paths(*text, "a file with a long name", "well", {}); },
            [](const WellPaths& made) { return made.paths.back().name; }));
    static const std::vector<WellLog> logs = needed(log_wells(*f.mesh, f.volumes, paths));
    static const SectionNames names = names_in(f.model);
    for (const std::string extension : {".csv", ".las"})
        stages.push_back(writing_stage("write_wells, " + extension.substr(1), "wells" + extension,
                                       true, [extension](const std::filesystem::path& path) {
                                           return write_wells(std::span(logs).first(1), names,
                                                              *well_format(extension), path);
                                       }));
    return stages;
}

std::vector<Stage> sections() {
    static const Fixture& f = Fixture::get();
    const auto text = [](const SectionSurface& made) {
        return made.surface.name + " " + std::to_string(made.sheets.size());
    };
    static const std::vector<std::array<double, 2>> line{{0, 0}, {4, 2}, {8, 0}};
    static const std::vector<double> heights{2, 4};
    static const SectionSurface fence = needed(section_fence(*f.mesh, line));
    std::vector<Stage> stages;
    stages.push_back(stage(
        "section_plane",
        [] {
            return section_plane(*f.mesh, {1, 1, 1}, {1, 0, 1});
        },
        text));
    stages.push_back(stage(
        "section_levels", [] { return section_levels(*f.mesh, heights); }, text));
    stages.push_back(stage(
        "section_fence", [] { return section_fence(*f.mesh, line); }, text));
    stages.push_back(stage(
        "section_along", [] { return section_along(f.surfaces[0]); }, text));
    stages.push_back(stage(
        "cut_section", [] { return cut_section(*f.mesh, f.volumes, fence); },
        [](const Section& made) {
            return std::to_string(made.polygons.size()) + " " + std::to_string(made.lines.size());
        }));
    stages.push_back(stage(
        "select, blocks", [] { return select(f.model, "block(1) | volume > 1"); },
        [](const Selected& made) { return std::to_string(made.mesh.triangles.size()); }));
    static const Section section = needed(cut_section(*f.mesh, f.volumes, fence));
    static const SectionNames names = names_in(f.model);
    for (const std::string extension : {".svg", ".geojson", ".dxf", ".csv", ".shp"}) {
        const auto format = *section_format(extension);
        if (!section_files(section, names, format)) continue; // without shapelib
        stages.push_back(writing_stage("write_section, " + extension.substr(1),
                                       "section" + extension, true,
                                       [format](const std::filesystem::path& path) {
                                           return write_section(section, names, format, path);
                                       }));
    }
    return stages;
}

} // namespace

std::vector<Stage> stages_of_scale() {
    std::vector<Stage> stages;
    for (const auto& part : {simplifying(), dividing(), drawing(), sections(), logging()})
        stages.insert(stages.end(), part.begin(), part.end());
    return stages;
}

} // namespace failing
