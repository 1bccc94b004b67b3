// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/labels.hpp>
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
Status write_folder(BuiltHandle& built, const std::filesystem::path& folder, const Run& run) {
    auto made = NewFolder::create(folder);
    if (!made) return made.error();
    const ModelHandle& m = *built.model;
    const Results results{built.project, m.model, built.tetrahedra.get(),
                          m.sealed,      m.leaks, built.read.unit};
    if (auto done = write_results(results, made->temporary(), run); !done) return done.error();
    if (built.certified)
        if (auto done =
                write_certificates(results, built.read, *built.certified, made->temporary(), run);
            !done)
            return done.error();
    return made->publish();
}

std::shared_ptr<BuiltHandle> build_text(const py::bytes& text, const py::object& base,
                                        const py::object& source, const HowToRun& how) {
    auto project = value_of(parse_project(std::string(text), to_path(base), from_text(source)));
    if (const auto possible = check_certifiable(project); !possible)
        throw Failure{possible.error()};
    return std::make_shared<BuiltHandle>(
        run_stage(how, [project](const Run& run) -> Result<BuiltHandle> {
            auto inputs = read_inputs(project, run);
            if (!inputs) return inputs.error();
            auto built =
                built_of(project, build(project, std::move(inputs->build), run), true, run);
            if (built) built->read = *std::move(inputs);
            return built;
        }));
}

} // namespace

Result<BuiltHandle> built_of(const Project& project, Result<Built> made, bool judges_leaks,
                             const Run& run) {
    if (!made) return made.error();
    auto model = model_of(*made, judges_leaks, run);
    if (!model) return model.error();
    BuiltHandle handle{project, *std::move(model), nullptr, std::move(made->arranged.surfaces)};
    if (project.outputs.certificate) {
        made->arranged.surfaces = handle.surfaces;
        handle.certified = std::make_shared<Arranged>(std::move(made->arranged));
    }
    if (made->filled) handle.tetrahedra = std::make_shared<FilledBlocks>(std::move(*made->filled));
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
