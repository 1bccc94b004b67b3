// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sections/sections.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <terrane/io/cell_files.hpp>

#include "handles.hpp"
#include "model_handle.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

using AxisPlanes = std::array<std::vector<double>, 3>;

/// The grid by steps, or by counts, or neither; and planes across some axes, in place of those.
struct CellsWanted {
    std::vector<double> steps{};
    std::vector<std::uint32_t> counts{};
    AxisPlanes planes{};
};

RectilinearGrid cells_wanted(const CellsWanted& wanted, const Mesh& mesh) {
    RectilinearGrid grid;
    if (const auto& s = wanted.steps; !s.empty())
        grid = must(cells_with_steps(mesh, {s[0], s[1], s[2]}), "step");
    if (const auto& n = wanted.counts; !n.empty())
        grid = must(cells_by_count(mesh, {n[0], n[1], n[2]}), "cells");
    const std::array<std::vector<double>*, 3> axes{&grid.x, &grid.y, &grid.z};
    for (std::size_t a = 0; a < 3; ++a)
        if (!wanted.planes[a].empty()) *axes[a] = wanted.planes[a];
    return grid;
}

py::dict dict_of_cells(RectilinearGrid grid, const BlocksInCells& found, const Model& model) {
    std::vector<std::uint32_t> centres(found.block_of.begin(), found.block_of.end());
    std::vector<std::int64_t> cells;
    std::vector<std::uint32_t> blocks;
    std::vector<double> fractions;
    for (std::size_t c = 0; c < found.block_of.size(); ++c)
        for (std::size_t s = found.first[c]; s < found.first[c + 1]; ++s) {
            cells.push_back(static_cast<std::int64_t>(c));
            blocks.push_back(found.shares[s].block);
            fractions.push_back(found.shares[s].fraction);
        }
    py::list names;
    for (const ModelBlock& block : model.structure.blocks)
        names.append(py::make_tuple(to_text(block.name), to_text(block.unit)));
    return py::dict("x"_a = owned(std::move(grid.x)), "y"_a = owned(std::move(grid.y)),
                    "z"_a = owned(std::move(grid.z)), "centres"_a = owned(std::move(centres)),
                    "cells"_a = owned(std::move(cells)), "blocks"_a = owned(std::move(blocks)),
                    "fractions"_a = owned(std::move(fractions)), "names"_a = names);
}

py::dict cells_of_model(const ModelPointer& model, const py::dict& given, const HowToRun& how) {
    CellsWanted wanted{given["steps"].cast<std::vector<double>>(),
                       given["counts"].cast<std::vector<std::uint32_t>>(),
                       given["planes"].cast<AxisPlanes>()};
    auto made = run_stage(how, [model, wanted](const Run& run) {
        RectilinearGrid grid = cells_wanted(wanted, model->model.mesh);
        auto found = must(blocks_in_cells(model->model.mesh, model->model.volumes, grid, run));
        return std::pair(std::move(grid), std::move(found));
    });
    return dict_of_cells(std::move(made.first), made.second, model->model);
}

/// Refuses arrays that do not belong together, as a changed pickle may have.
BlocksInCells to_blocks_in_cells(const py::dict& given, const RectilinearGrid& grid,
                                 std::size_t names) {
    const auto centres = copied<std::uint32_t>(given["centres"].cast<py::array>());
    const auto cells = copied<std::int64_t>(given["cells"].cast<py::array>());
    const auto blocks = copied<std::uint32_t>(given["blocks"].cast<py::array>());
    const auto fractions = copied<double>(given["fractions"].cast<py::array>());
    const bool fits = grid.x.size() > 1 && grid.y.size() > 1 && grid.z.size() > 1 &&
                      centres.size() == grid.size() && blocks.size() == cells.size() &&
                      fractions.size() == cells.size() &&
                      std::is_sorted(cells.begin(), cells.end());
    if (!fits) refuse(ErrorCode::bad_index, "the arrays of the grid do not belong together", "");
    BlocksInCells found;
    for (const std::uint32_t block : centres) {
        require_below(block, names, "block");
        found.block_of.emplace_back(block);
    }
    found.first.assign(centres.size() + 1, 0);
    for (std::size_t s = 0; s < cells.size(); ++s) {
        require_below(blocks[s], names, "block");
        if (cells[s] < 0 || std::uint64_t(cells[s]) >= centres.size())
            refuse(ErrorCode::bad_index, "the arrays of the grid do not belong together", "");
        ++found.first[std::size_t(cells[s]) + 1];
        found.shares.push_back({BlockId(blocks[s]), fractions[s]});
    }
    for (std::size_t c = 0; c < centres.size(); ++c) found.first[c + 1] += found.first[c];
    return found;
}

void save_cells(const py::dict& given, const py::object& file, const HowToRun& how) {
    const auto path = to_path(file);
    const auto format = cell_format(path.extension().string());
    if (!format)
        refuse(ErrorCode::unknown_format, "grids of cells are .vti, .vtr, .grdecl or .csv",
               path.string());
    const auto planes = [&](const char* axis) {
        return copied<double>(given[axis].cast<py::array>());
    };
    const RectilinearGrid grid{planes("x"), planes("y"), planes("z")};
    CellNames names;
    for (const py::handle one : given["names"]) {
        const auto values = one.cast<py::tuple>();
        names.blocks.push_back(from_text(values[0]));
        names.units.push_back(from_text(values[1]));
    }
    names.source = "a model";
    const auto found = to_blocks_in_cells(given, grid, names.blocks.size());
    run_stage(how, [=](const Run&) { return write_cells(grid, found, names, *format, path); });
}

} // namespace

void bind_cells(py::module_& module) {
    module.def("cells", &cells_of_model, "model"_a, "wanted"_a, "how"_a);
    module.def("save_cells", &save_cells, "cells"_a, "path"_a, "how"_a);
}

} // namespace terrane::python
