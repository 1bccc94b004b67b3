// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/io/cell_files.hpp>

namespace terrane::cli {
namespace {

struct GridCommand {
    ModelCommand model;
    std::string step, cells;           ///< one of them; empty: not given
    std::array<std::string, 3> planes; ///< across x, y, z; empty: not given
};

constexpr auto grid_footer =
    R"(The surfaces are arranged, cut by a volume of interest and rounded as `terrane volume` does, and its options and
names of blocks are the same. Each cell gets the block that contains its centre, and the part of the cell that each
block fills. Both are decided exactly: a fraction is the double nearest to the true one. A centre on a surface counts to
the block on the side of greater x; where the surface is parallel to x, of greater y, and then of greater z.

--step has one length, or one for x, y and z: planes between cells are at its multiples, and the grid contains the
model. --cells divides the box around the model. --x, --y and --z list the planes across one axis, ascending.

OUT is
  .vti     VTK image, where the cells are equally large: arrays block, unit, fraction; all shares of blocks in
           share_cell, share_block, share_fraction
  .vtr     the same with any planes
  .grdecl  corner-point grid: ACTNUM, FIPNUM (number of the block), MULTPV (part of the cell in blocks)
  .csv     a row per cell and block in it, with the fraction

Where no block has volume in the grid nothing is written, and the exit status is 1.

Examples:
  terrane grid model.ml --step 50,50,10 -o grid.vti
  terrane grid *.ts --box 0,0,-3000,9000,9000,0 --cells 90,90,60 -o grid.grdecl
  terrane grid model.ml --step 100 --z -3000,-2500,-2200,-2000,-1000,0 -o grid.vtr -o fractions.csv)";

/// Returns the numbers of an option, `count` of them, or one for all. Errors: bad_option.
std::array<double, 3> three_numbers(const std::string& text, const char* option, bool or_one) {
    const auto n = numbers_in(text);
    if (n && n->size() == 3) return {(*n)[0], (*n)[1], (*n)[2]};
    if (n && n->size() == 1 && or_one) return {(*n)[0], (*n)[0], (*n)[0]};
    refuse(or_one ? "needs one number, or three: x,y,z" : "needs three numbers: x,y,z", option);
}

void check_grid(const GridCommand& command) {
    const auto& [x, y, z] = command.planes;
    const bool has_all = !x.empty() && !y.empty() && !z.empty();
    const int given = int{!command.step.empty()} + int{!command.cells.empty()} + int{has_all};
    if (given != 1)
        refuse("give either --step or --cells, or the planes across all axes",
               "--step, --cells, --x, --y, --z");
}

/// Returns the cells that the options ask for. Errors: bad_option; those of cells_with_steps() and cells_by_count().
RectilinearGrid grid_of(const GridCommand& command, const Mesh& mesh) {
    RectilinearGrid grid;
    if (!command.step.empty()) {
        grid = must(cells_with_steps(mesh, three_numbers(command.step, "--step", true)), "--step");
    } else if (!command.cells.empty()) {
        std::array<std::uint32_t, 3> counts{};
        const auto numbers = three_numbers(command.cells, "--cells", false);
        for (std::size_t a = 0; a < 3; ++a) {
            if (!(numbers[a] >= 1) || numbers[a] > 1e9 || numbers[a] != std::floor(numbers[a]))
                refuse("needs whole numbers of at least 1", "--cells");
            counts[a] = static_cast<std::uint32_t>(numbers[a]);
        }
        grid = must(cells_by_count(mesh, counts), "--cells");
    }
    const std::array<std::pair<const char*, std::vector<double>*>, 3> axes{
        {{"--x", &grid.x}, {"--y", &grid.y}, {"--z", &grid.z}}};
    for (std::size_t a = 0; a < 3; ++a) {
        if (command.planes[a].empty()) continue;
        auto numbers = numbers_in(command.planes[a]);
        if (!numbers) refuse("needs numbers with commas between", axes[a].first);
        *axes[a].second = std::move(*numbers);
    }
    return grid;
}

/// A file for the grid.
struct CellOutput {
    std::string path;
    CellFormat format{};
};

std::vector<CellOutput> plan_cell_outputs(const FileOptions& files) {
    FileOptions others = files; // the formats of inputs are checked with those of no output
    others.outputs.clear();
    others.output_format.clear();
    plan_outputs(others, OutputKind::surfaces);
    std::vector<CellOutput> outputs;
    for (const std::string& path : files.outputs) {
        const auto extension = files.output_format.empty()
                                   ? std::filesystem::path(path).extension().string()
                                   : "." + files.output_format;
        const auto format = cell_format(extension);
        if (!format)
            refuse(ErrorCode::unknown_format, "grids of cells are .vti, .vtr, .grdecl or .csv",
                   path);
        check_folder(path);
        outputs.push_back({path, *format});
    }
    if (std::ranges::count(files.outputs, "-") > 1 ||
        (std::ranges::count(files.outputs, "-") == 1 &&
         (files.stats == "-" || files.report == "-")))
        refuse("standard output can take only one file");
    return outputs;
}

/// What a grid has, in numbers.
struct CellCounts {
    std::size_t inside = 0;  ///< cells whose centre is in a block
    std::size_t divided = 0; ///< cells that several blocks share, or a block and the outside
    double volume = 0;       ///< of blocks in the grid
    bool has_blocks = false;
};

CellCounts counts_of(const RectilinearGrid& grid, const BlocksInCells& found) {
    CellCounts counts;
    for (std::size_t c = 0; c < found.block_of.size(); ++c) {
        counts.inside += found.block_of[c] == 0 ? 0 : 1;
        counts.divided += found.first[c + 1] - found.first[c] > 1 ? 1 : 0;
    }
    double part = 0;
    for (std::size_t b = 1; b < found.fractions.size(); ++b) part += found.fractions[b];
    counts.has_blocks = part > 0;
    counts.volume = part * (grid.x.back() - grid.x.front()) * (grid.y.back() - grid.y.front()) *
                    (grid.z.back() - grid.z.front());
    return counts;
}

CellNames cell_names(const ModelRun& run) {
    CellNames names;
    for (const ModelBlock& block : run.built().model->structure.blocks) {
        names.blocks.push_back(block.name);
        names.units.push_back(block.unit);
    }
    names.source = name_of_inputs(run.files());
    names.length_unit = run.inputs().unit;
    return names;
}

ExitStatus fill_grid(const GridCommand& command, Session& session) {
    check_grid(command);
    const auto outputs = plan_cell_outputs(command.model.files);
    auto run = ModelRun::begin(command.model, session);
    run.make();
    if (!run.refused().empty()) return run.end(false);
    const Model& model = *run.built().model;
    const RectilinearGrid grid = grid_of(command, model.mesh);
    const auto found = must(session.timed(
        "cells", [&] { return blocks_in_cells(model.mesh, model.volumes, grid, session.run()); }));
    const CellCounts counts = counts_of(grid, found);
    const auto [nx, ny, nz] = grid.counts();
    say(run.told(),
        fmt::format(
            "grid: {} x {} x {} cells, {} with the centre in a block, {} divided; volume of "
            "blocks {}\n",
            nx, ny, nz, counts.inside, counts.divided,
            run.inputs().quantities().volume(counts.volume)));
    run.statistics()["grid"] = {{"cells", grid.size()},
                                {"inside", counts.inside},
                                {"divided", counts.divided},
                                {"volume", counts.volume}};
    if (!counts.has_blocks) {
        print(stderr, complaint("nothing written: no block has volume in the grid"));
        return run.end(false);
    }
    const CellNames names = cell_names(run);
    for (const CellOutput& output : outputs) {
        session.begin("write", Phase::writing);
        must(write_cells(grid, found, names, output.format, output.path));
        session.end_stage();
        say_written(run.told(), output.path);
    }
    return run.end(true);
}

} // namespace

Command grid_command(CLI::App& program) {
    auto command = std::make_shared<GridCommand>();
    auto* app = program.add_subcommand("grid", "Fill the cells of a grid with blocks");
    add_inputs(*app, command->model.files);
    add_output(*app, command->model.files, "File for the grid: .vti, .vtr, .grdecl or .csv");
    add_value(*app, "--step", command->step, "DX,DY,DZ",
              "Size of the cells, whose planes are at multiples of it; one number: of all axes");
    add_value(*app, "--cells", command->cells, "NX,NY,NZ",
              "Number of the cells that divide the box around the model");
    add_value(*app, "--x", command->planes[0], "X,X,...", "Planes across x, ascending");
    add_value(*app, "--y", command->planes[1], "Y,Y,...", "Planes across y, ascending");
    add_value(*app, "--z", command->planes[2], "Z,Z,...", "Planes across z, ascending");
    add_naming(*app, command->model);
    add_arranging(*app, command->model);
    add_run(*app, command->model.files);
    command->model.needs_blocks = true;
    command->model.tells_blocks = false;
    command->model.project.last = BuildStage::blocks;
    app->footer(grid_footer);
    return {app, [command] {
                Session session(command->model.files.threads);
                return fill_grid(*command, session);
            }};
}

} // namespace terrane::cli
