// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/uncertainty/measures.hpp>
#include <terrane/algorithms/uncertainty/realisations.hpp>
#include <terrane/io/page/html.hpp>
#include <terrane/io/project.hpp>
#include <terrane/io/uncertainty_maps.hpp>

#include "built_handle.hpp"
#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

/// A project that is read once for many realisations.
struct EnsembleHandle {
    Realisations realisations;
    std::size_t moved = 0; ///< entries of "uncertainty"
};
using EnsemblePointer = std::shared_ptr<EnsembleHandle>;

EnsembleHandle prepared(Project project, const Run& run) {
    auto maps = must(read_uncertainty_maps(project));
    auto inputs = must(read_inputs(project, run));
    project.outputs.tetrahedra.clear(); // of a thousand models nobody looks at them
    project.outputs.certificate = false;
    const std::size_t moved = project.uncertainty.size();
    auto made = must(Realisations::prepare(std::move(project), std::move(inputs.build), maps, run));
    return EnsembleHandle{std::move(made), moved};
}

EnsemblePointer prepare(const py::bytes& text, const py::object& base, const py::object& source,
                        const HowToRun& how) {
    const auto project = must(parse_project(std::string(text), to_path(base), from_text(source)));
    return std::make_shared<EnsembleHandle>(
        run_stage(how, [project](const Run& run) { return prepared(project, run); }));
}

std::shared_ptr<BuiltHandle> realised(const EnsemblePointer& ensemble, std::uint64_t seed,
                                      std::uint64_t number, const HowToRun& how) {
    return std::make_shared<BuiltHandle>(run_stage(how, [ensemble, seed, number](const Run& run) {
        const Realisations& all = ensemble->realisations;
        return built_of(all.project(), must(all.build(seed, number, run)), false, run);
    }));
}

/// (heights, thicknesses), each (surfaces or volumes, rows, columns)
py::tuple maps_of(const ModelPointer& m, std::array<double, 4> frame,
                  std::array<std::size_t, 2> cells, const HowToRun& how) {
    if (cells[0] == 0 || cells[1] == 0) refuse("there must be cells", "cells");
    const MapGrid grid{frame[0], frame[1], frame[2], frame[3], cells[0], cells[1]};
    auto maps = run_stage(
        how, [m, grid](const Run&) { return column_maps(m->model.mesh, m->model.volumes, grid); });
    const auto shaped = [&](std::vector<double> values) {
        const auto count = static_cast<py::ssize_t>(values.size() / (cells[0] * cells[1]));
        return owned(std::move(values))
            .reshape(
                {count, static_cast<py::ssize_t>(cells[1]), static_cast<py::ssize_t>(cells[0])});
    };
    return py::make_tuple(shaped(std::move(maps.heights)), shaped(std::move(maps.thicknesses)));
}

/// (low, high, middle, [(volume, area, column) above each contact]) of each volume
py::list measures_of(const ModelPointer& m, const std::vector<double>& contacts) {
    return rows(measure_blocks(m->model.mesh, m->model.volumes, contacts), &BlockMeasure::low,
                &BlockMeasure::high, &BlockMeasure::middle, [](const BlockMeasure& b) {
                    return rows(b.above, &PartAbove::volume, &PartAbove::area, &PartAbove::column);
                });
}

} // namespace

void bind_ensemble(py::module_& module) {
    using Handle = EnsembleHandle;
    py::class_<Handle, EnsemblePointer>(module, "Ensemble")
        .def(py::init(&prepare), "text"_a, "base"_a, "source"_a, "how"_a)
        .def_property_readonly("moved", [](const Handle& e) { return e.moved; })
        .def("build", &realised, "seed"_a, "number"_a, "how"_a)
        .def(
            "surfaces",
            [](const Handle& e, std::uint64_t seed, std::uint64_t number) {
                return from_surfaces(e.realisations.input_of(seed, number).surfaces);
            },
            "seed"_a, "number"_a);
    module.def("column_maps", &maps_of, "model"_a, "frame"_a, "cells"_a, "how"_a);
    module.def("content_policy", &page::content_policy, "script"_a, "style"_a);
    module.def("measure_blocks", &measures_of, "model"_a, "contacts"_a);
}

} // namespace terrane::python
