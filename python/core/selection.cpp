// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/selection.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/core/described.hpp>

#include "handles.hpp"
#include "model_handle.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

SelectOptions options_of(const std::string& rule, bool fractions, std::optional<double> max_move) {
    SelectOptions options{.fractions = fractions};
    const auto named = inside_rule_named(rule);
    if (!named) refuse("is no rule: nonzero, positive, odd", "rule=" + rule);
    options.rule = *named;
    options.rounding.max_move = max_move;
    return options;
}

py::tuple tuple_of(Selected made) {
    py::list pieces;
    for (const SelectedPiece& piece : made.pieces)
        pieces.append(py::make_tuple(piece.volume, piece.exact_volume, piece.triangles));
    const py::dict report("pieces"_a = pieces, "cavities"_a = made.cavities,
                          "volume"_a = made.volume, "exact_volume"_a = made.exact_volume,
                          "is_surface"_a = made.is_surface, "regions"_a = made.regions,
                          "rounding"_a = to_dict(made.rounding));
    return py::make_tuple(handle_of(SharedMesh(std::move(made.mesh))),
                          owned(std::move(made.piece_of)), report);
}

py::tuple select_region(const py::sequence& surfaces, const py::str& expression,
                        const std::string& rule, bool fractions, std::optional<double> max_move,
                        const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    return tuple_of(run_stage(
        how, [given, text = from_text(expression), options = options_of(rule, fractions, max_move)](
                 const Run& run) { return select(*given, text, options, run); }));
}

py::tuple select_of_model(const ModelPointer& model, const py::str& expression,
                          const py::sequence& others, const std::string& rule, bool fractions,
                          std::optional<double> max_move, const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(others));
    return tuple_of(
        run_stage(how, [model, given, text = from_text(expression),
                        options = options_of(rule, fractions, max_move)](const Run& run) {
            return select(model->model, text, *given, options, run);
        }));
}

} // namespace

void bind_selection(py::module_& module) {
    module.def("select", &select_region, "surfaces"_a, "expression"_a, "rule"_a, "fractions"_a,
               "max_move"_a, "how"_a);
    module.def("select_of_model", &select_of_model, "model"_a, "expression"_a, "others"_a, "rule"_a,
               "fractions"_a, "max_move"_a, "how"_a);
}

} // namespace terrane::python
