// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <string>
#include <utility>

#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/io/atomic/atomic_folder.hpp>
#include <terrane/io/project.hpp>
#include <terrane/io/results.hpp>

#include "built_handle.hpp"
#include "handles.hpp"
#include "model_handle.hpp"
#include "surfaces.hpp"
#include "tetrahedra_handle.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

/// Writes what the project asks for, as the program does.
void write_folder(BuiltHandle& built, const std::filesystem::path& folder, const Run& run) {
    auto made = must(NewFolder::create(folder));
    const ModelHandle& m = *built.model;
    const Results results{built.project, m.model, built.tetrahedra.get(),
                          m.sealed,      m.leaks, built.read.unit};
    must(write_results(results, made.temporary(), run));
    if (built.certified)
        must(write_certificates(results, built.read, *built.certified, made.temporary(), run));
    must(made.publish());
}

std::shared_ptr<BuiltHandle> build_text(const py::bytes& text, const py::object& base,
                                        const py::object& source, const HowToRun& how) {
    auto project = must(parse_project(std::string(text), to_path(base), from_text(source)));
    must(check_certifiable(project));
    return std::make_shared<BuiltHandle>(run_stage(how, [project](const Run& run) {
        auto inputs = must(read_inputs(project, run));
        auto made = must(build(project, std::move(inputs.build), run));
        BuiltHandle built = built_of(project, std::move(made), true, run);
        built.read = std::move(inputs);
        return built;
    }));
}

} // namespace

BuiltHandle built_of(const Project& project, Built made, bool judges_leaks, const Run& run) {
    auto model = model_of(made, judges_leaks, run);
    BuiltHandle handle{project, std::move(model), nullptr, std::move(made.arranged.surfaces)};
    if (project.outputs.certificate) {
        made.arranged.surfaces = handle.surfaces;
        handle.certified = std::make_shared<Arranged>(std::move(made.arranged));
    }
    if (made.filled) handle.tetrahedra = std::make_shared<FilledBlocks>(std::move(*made.filled));
    return handle;
}

void bind_project(py::module_& module) {
    using Pointer = std::shared_ptr<BuiltHandle>;
    py::class_<BuiltHandle, Pointer>(module, "Built")
        .def_property_readonly("model", [](const BuiltHandle& b) { return b.model; })
        .def_property_readonly("tetrahedra", [](const BuiltHandle& b) { return b.tetrahedra; })
        .def_property_readonly("surfaces",
                               [](const BuiltHandle& b) { return from_surfaces(b.surfaces); })
        .def_property_readonly(
            "folder", [](const BuiltHandle& b) { return to_text(b.project.folder.string()); })
        .def(
            "save",
            [](const Pointer& b, const py::object& folder, const HowToRun& how) {
                const std::filesystem::path to = to_path(folder);
                run_stage(how, [b, to](const Run& run) { return write_folder(*b, to, run); });
            },
            "folder"_a, "how"_a);
    module.def("build", &build_text, "text"_a, "base"_a, "source"_a, "how"_a);
}

} // namespace terrane::python
