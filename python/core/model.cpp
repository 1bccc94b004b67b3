// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/model/model_doubts.hpp>
#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/io/report_members.hpp>
#include <terrane/io/results.hpp>

#include "fields.hpp"
#include "handles.hpp"
#include "model_handle.hpp"
#include "structure.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

ModelPointer model_of(Built& built, bool judges_leaks, const Run& run) {
    Arranged& arranged = built.arranged;
    auto model = std::make_shared<ModelHandle>(ModelHandle{std::move(*built.model)});
    if (judges_leaks && !arranged.sealed && !model->model.borders.empty()) {
        auto judged = must(judge_leaks(arranged, model->model.borders, {}, run));
        model->leaks = std::move(judged);
    }
    model->sealed = std::move(arranged.sealed);
    model->cut = std::move(arranged.cut);
    model->merged = std::move(arranged.merged);
    model->choice = std::move(arranged.choice);
    model->rounding = arranged.rounded.report;
    return model;
}

namespace {

ModelPointer made(std::vector<Surface> surfaces, std::vector<Surface> boundary,
                  const Project& project, const Run& run) {
    auto doubts = find_doubts(surfaces, {.boundary = boundary, .blocks = true});
    auto built = build(project, {std::move(surfaces), std::move(boundary)}, run);
    if (!built && built.error().place.starts_with("seal_of."))
        refuse(built.error().code, built.error().sentence, "seal");
    if (!built) throw Failure{built.error()};
    auto model = model_of(*built, true, run);
    model->exact = std::make_shared<const Arrangement>(std::move(built->arranged.exact));
    model->rounded = built->arranged.rounded.conforming;
    model->column = project.column;
    const bool is_open = std::ranges::any_of(doubts, [](const PlausibilityWarning& w) {
        return w.doubt == Doubt::no_top || w.doubt == Doubt::no_base;
    });
    for (PlausibilityWarning& w : find_model_doubts(model->model, !is_open))
        doubts.push_back(std::move(w));
    model->doubts = std::move(doubts);
    return model;
}

/// Joins what is nearer than the resolution, which a model is then about, and improves the rest.
ImprovedAndMeasured joined_and_improved(ModelHandle& handle, const Resolution& resolution,
                                        const ImproveOptions& options, const Run& run) {
    auto made = must(improve_at_resolution(*handle.rounded, resolution, options, {}, run));
    handle.exact = std::make_shared<const Arrangement>(std::move(made.simplified.exact));
    handle.rounding = made.simplified.rounded.report;
    handle.rounded = made.simplified.rounded.conforming;
    return std::move(made.improved);
}

/// Makes the same model with better triangles. Blocks keep their numbers, and what is known about gaps stays.
ModelPointer improved(const ModelPointer& old, const py::dict& options, const HowToRun& how) {
    if (!old->exact)
        refuse(ErrorCode::unsupported, "a project improves its model itself, by its key improve",
               "");
    const auto improved_as = [old, resolution = options_in<Resolution>(options),
                              o = options_in<ImproveOptions>(options)](const Run& run) {
        ModelHandle handle = *old;
        const auto better = resolution.length > 0
                                ? joined_and_improved(handle, resolution, o, run)
                                : must(improve_and_measure(*old->rounded, o, run));
        handle.model = must(make_model(*handle.exact, *handle.rounded, better.improved, run,
                                       {.column = old->column}));
        return std::make_shared<ModelHandle>(std::move(handle));
    };
    return run_stage(how, improved_as);
}

/// seal: None, a number, "auto", or a dict of these by None, name or pair.
Project project_of(const py::dict& given) {
    const auto wanted = [&](const char* name, const char* automatic) -> std::optional<double> {
        if (given[automatic].cast<bool>()) return 0.0;
        const double value = given[name].cast<double>();
        return value > 0 ? std::optional(value) : std::nullopt;
    };
    Project project;
    project.max_rounds = given["max_rounds"].cast<unsigned>();
    project.max_move = given["max_move"].cast<std::optional<double>>();
    project.seal = wanted("seal", "seal_automatic");
    project.tolerance = given["tolerance"].cast<std::optional<double>>();
    project.extend = given["extend"].cast<double>();
    project.min_volume = wanted("min_volume", "min_volume_automatic");
    for (const auto& [name, distance] : given["seal_of"].cast<py::dict>())
        project.seal_of.emplace_back(from_text(name), distance.cast<double>());
    project.column = to_column(given["column"].cast<py::sequence>());
    return project;
}

ModelPointer make(const py::sequence& surfaces, const py::sequence& boundary,
                  const py::dict& options, const HowToRun& how) {
    auto given = std::make_shared<std::vector<Surface>>(to_surfaces(surfaces));
    auto around = std::make_shared<std::vector<Surface>>(to_surfaces(boundary));
    return run_stage(how, [given, around, project = project_of(options)](const Run& run) {
        return made(std::move(*given), std::move(*around), project, run);
    });
}

/// (separating, all, verdicts, distance)
py::tuple leaks(const ModelHandle& m) {
    const auto all = rows(leaks_of(m.model.borders));
    py::list verdicts;
    if (!m.leaks) return py::make_tuple(py::list(), all, verdicts, 0.0);
    constexpr std::array<const char*, 3> names{"separates", "harmless", "wide"};
    for (const LeakVerdict v : m.leaks->verdicts)
        verdicts.append(names[static_cast<std::size_t>(v)]);
    return py::make_tuple(rows(m.leaks->separating), all, verdicts, m.leaks->distance);
}

py::list borders(const ModelHandle& m) {
    return rows(m.model.borders, &FreeBorder::line, &FreeBorder::surfaces, &FreeBorder::length,
                &FreeBorder::closed);
}

py::list relations(const ModelHandle& m) {
    return rows(find_relations(m.model.mesh, m.model.structure, m.model.borders),
                &SurfaceRelation::from, &SurfaceRelation::to, &SurfaceRelation::kind,
                &SurfaceRelation::length, &SurfaceRelation::least, &SurfaceRelation::largest,
                &SurfaceRelation::place);
}

py::list juxtapositions(const ModelHandle& m) {
    return rows(find_juxtapositions(m.model.structure), &Juxtaposition::surface,
                &Juxtaposition::blocks, &Juxtaposition::area);
}

py::tuple part(const ModelHandle& m, bool of_block, std::uint32_t number) {
    const Model& model = m.model;
    require_below(number,
                  of_block ? model.volumes.measures.size() : model.structure.interfaces.size(),
                  of_block ? "block" : "interface");
    auto made =
        of_block ? block_part(model.mesh, model.volumes, model.structure, BlockId(number))
                 : interface_part(model.mesh, model.volumes, model.structure, InterfaceId(number));
    return py::make_tuple(handle_of(SharedMesh(std::move(made.mesh))),
                          owned(std::move(made.triangles)));
}

void save(const ModelPointer& m, const py::object& folder, const std::string& format,
          const HowToRun& how) {
    const std::filesystem::path to = to_path(folder);
    run_stage(how, [m, to, format](const Run& run) {
        return write_model_folder({m->model, m->sealed, m->leaks}, format, to, run);
    });
}

} // namespace

StratigraphicColumn to_column(const py::sequence& units) {
    StratigraphicColumn column;
    for (const py::handle item : units) {
        const auto unit = item.cast<py::tuple>();
        ColumnUnit made{from_text(unit[0]), from_text(unit[1])};
        if (!unit[2].is_none()) made.age = unit[2].cast<double>();
        if (unit[3].cast<bool>()) made.contact = UnitContact::erosive;
        column.push_back(std::move(made));
    }
    return column;
}

void bind_model(py::module_& module) {
    py::class_<ModelHandle, ModelPointer> bound(module, "Model");
    using M = ModelHandle;
    bound.def_property_readonly("mesh", [](const M& m) { return handle_of(m.model.mesh); })
        .def_property_readonly(
            "volumes", [](const M& m) { return std::make_shared<Volumes>(m.model.volumes); })
        .def_property_readonly("structure", [](const M& m) { return to_dict(m.model.structure); })
        .def_property_readonly("block_count", [](const M& m) { return m.model.block_count(); })
        .def_property_readonly("lost", [](const M& m) { return m.model.lost; })
        .def_property_readonly("made", [](const M& m) { return m.model.made; })
        .def_property_readonly("leaks", &leaks)
        .def_property_readonly("borders", &borders)
        .def_property_readonly("doubts", [](const M& m) { return to_list(m.doubts); })
        .def_property_readonly("relations", &relations)
        .def_property_readonly("juxtapositions", &juxtapositions)
        .def_property_readonly("rounding",
                               [](const M& m) -> py::object {
                                   if (!m.rounding) return py::none();
                                   return to_dict(*m.rounding);
                               })
        .def_property_readonly("sealed",
                               [](const M& m) -> py::object {
                                   if (!m.sealed) return py::none();
                                   return to_dict(*m.sealed);
                               })
        .def("part", &part, "of_block"_a, "number"_a)
        .def("save", &save, "folder"_a, "format"_a, "how"_a);
    bound.def_property_readonly("total_volume", [](const M& m) { return m.model.total_volume; });
    arrays_of(bound, &M::model).add("exact_volumes", &Model::exact_volumes);
    module.def("improve_model", &improved, "model"_a, "options"_a, "how"_a);
    module.def("model", &make, "surfaces"_a, "boundary"_a, "options"_a, "how"_a);
}

} // namespace terrane::python
