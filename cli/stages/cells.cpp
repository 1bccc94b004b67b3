// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/cells.hpp>

#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/grids/grdecl.hpp>
#include <terrane/io/grids/grdecl_cells.hpp>

namespace terrane::cli {
namespace {

/// Refuses a grid whose unit is not that of the surfaces, where both are known.
void check_unit(const CellOptions& options, const CornerPointGrid& grid, const Inputs& inputs) {
    const std::string& unit = grid.frame.horizontal_unit;
    if (unit.empty() || inputs.unit.empty() || unit == inputs.unit) return;
    refuse(fmt::format("the grid {} is in {}, but the surfaces are in {}; --unit {} converts "
                       "them",
                       options.grid, unit, inputs.unit, unit),
           "--grid");
}

} // namespace

void add_cells(CLI::App& command, CellOptions& options) {
    add_value(command, "--grid", options.grid, "FILE.grdecl",
              "A corner-point grid, of which --cells says in which block each cell lies");
    add_value(command, "--cells", options.cells, "FILE.grdecl",
              "Write ACTNUM and FIPNUM of the cells of --grid, by the blocks");
}

std::optional<CornerPointGrid> read_grid(const CellOptions& options) {
    if (options.grid.empty() != options.cells.empty())
        refuse("each needs the other one", "--grid, --cells");
    if (options.grid.empty()) return std::optional<CornerPointGrid>();
    check_folder(options.cells);
    const auto contents = must(read_file(options.grid));
    auto grid = must(read_corner_points(contents, options.grid));
    return std::optional(std::move(grid));
}

std::string write_cells(const CellOptions& options, const CornerPointGrid& grid, const Model& model,
                        const Inputs& inputs, Session& session) {
    check_unit(options, grid, inputs);
    session.begin("cells", Phase::computing);
    const auto centres = must(cell_centres(grid), options.grid);
    std::vector<std::size_t> active; // cells
    std::vector<Point3> places;
    for (std::size_t c = 0; c < centres.size(); ++c) {
        if (!grid.active.empty() && grid.active[c] == 0) continue;
        active.push_back(c);
        places.push_back(centres[c]);
    }
    const auto found = must(locate_points(places, model.mesh, model.volumes, session.run()));
    std::vector<std::uint32_t> block_of(centres.size());
    std::size_t inside = 0;
    for (std::size_t i = 0; i < active.size(); ++i) {
        block_of[active[i]] = found[i];
        inside += found[i] == 0 ? 0U : 1U;
    }
    session.end_stage();
    std::vector<std::string> names;
    for (const ModelBlock& block : model.structure.blocks) names.push_back(block.name);
    session.begin("write", Phase::writing);
    must(write_file(options.cells, cells_to_grdecl(block_of, names, options.grid)));
    session.end_stage();
    auto said = fmt::format("cells of {}: {} in blocks, {} outside, {} not active\n", options.grid,
                            inside, active.size() - inside, centres.size() - active.size());
    if (options.cells != "-") said += "wrote " + options.cells + "\n";
    return said;
}

} // namespace terrane::cli
