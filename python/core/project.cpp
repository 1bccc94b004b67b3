// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/project/build.hpp>
#include <terrane/algorithms/volumes/block_points.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/atomic_folder.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/gocad/gocad_model.hpp>
#include <terrane/io/model_folder.hpp>
#include <terrane/io/project.hpp>
#include <terrane/io/project_inputs.hpp>

#include "built_handle.hpp"
#include "handles.hpp"
#include "model_handle.hpp"
#include "surfaces.hpp"
#include "tetrahedra_handle.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

/// Writes what the project asks for, under the names that the program gives.
class ResultFolder {
public:
    ResultFolder(const BuiltHandle& built, std::filesystem::path folder, const Run& run) :
        built_(built), folder_(std::move(folder)), run_(run) {}

    Status operator()() {
        auto made = NewFolder::create(folder_);
        if (!made) return made.error();
        const auto& to = made->temporary();
        for (const auto step : {&ResultFolder::write_surfaces, &ResultFolder::write_cells,
                                &ResultFolder::write_blocks})
            if (auto done = (this->*step)(to); !done) return done;
        return made->publish();
    }

private:
    static std::string name(const char* start, const std::string& format) {
        if (format == "msh22") return std::string(start) + "_22.msh";
        if (format == "ogs") return std::string(start) + "_ogs.vtu";
        if (format == "geos") return std::string(start) + "_geos.vtm";
        if (format == "pylith") return std::string(start) + "_pylith.msh";
        return start + ("." + format);
    }

    Status write_surfaces(const std::filesystem::path& to) {
        const Model& model = built_.model->model;
        WriteOptions options;
        options.ascii = true; // binary STL would round the checked coordinates
        std::vector<BlockPoint> points;
        for (const std::string& format : built_.project.outputs.surfaces) {
            options.format = format_named(format);
            if (points.empty() && (format == "poly" || format == "smesh")) {
                auto found = block_points(model.mesh, model.volumes, run_);
                if (!found) return found.error();
                points = std::move(*found);
                options.block_points = points;
            }
            if (auto done = write_mesh(model.mesh, to / name("surfaces", format), options); !done)
                return done;
        }
        return Done{};
    }

    Status write_cells(const std::filesystem::path& to) {
        if (!built_.tetrahedra) return Done{};
        WriteOptions options;
        options.block_names = built_.tetrahedra->block_names;
        options.order = built_.project.tetrahedra.order;
        for (const std::string& format : built_.project.outputs.tetrahedra) {
            options.format = format_named(format);
            if (auto done = write_tetrahedra(built_.tetrahedra->tetrahedra,
                                             to / name("tetrahedra", format), options);
                !done)
                return done;
        }
        return Done{};
    }

    Status write_blocks(const std::filesystem::path& to) {
        const ModelHandle& m = *built_.model;
        if (built_.project.outputs.gocad)
            if (auto done =
                    write_file(to / "model.ml",
                               to_gocad_model(m.model.mesh, m.model.volumes, m.model.structure,
                                              "model", built_.project.unit));
                !done)
                return done;
        if (built_.project.outputs.blocks.empty()) return Done{};
        std::error_code failed;
        std::filesystem::create_directory(to / "model", failed);
        if (failed)
            return Error{ErrorCode::cannot_open, "cannot be made: " + failed.message(),
                         (to / "model").string()};
        return write_model_files({m.model, m.sealed, m.leaks}, built_.project.outputs.blocks,
                                 to / "model", run_);
    }

    const BuiltHandle& built_;
    std::filesystem::path folder_;
    const Run& run_;
};

std::shared_ptr<BuiltHandle> build_text(const py::bytes& text, const py::object& base,
                                        const py::object& source, const HowToRun& how) {
    auto project = value_of(parse_project(std::string(text), to_path(base), from_text(source)));
    if (project.outputs.certificate)
        throw Failure{{ErrorCode::unsupported,
                       "certificates are made by the program: terrane build",
                       from_text(source) + ": outputs.certificate"}};
    return std::make_shared<BuiltHandle>(
        run_stage(how, [project](const Run& run) -> Result<BuiltHandle> {
            auto inputs = read_inputs(project, run);
            if (!inputs) return inputs.error();
            return built_of(project, std::move(inputs->build), true, run);
        }));
}

} // namespace

Result<BuiltHandle> built_of(const Project& project, BuildInput input, bool judges_leaks,
                             const Run& run) {
    auto made = build(project, std::move(input), run);
    if (!made) return made.error();
    BuiltHandle handle{project, std::make_shared<ModelHandle>(ModelHandle{std::move(*made->model)}),
                       nullptr, std::move(made->arranged.surfaces)};
    ModelHandle& m = *handle.model;
    if (judges_leaks && !made->arranged.sealed && !m.model.borders.empty()) {
        auto judged = judge_leaks(made->arranged, m.model.borders, {}, run);
        if (judged) m.leaks = std::move(*judged);
    }
    m.sealed = std::move(made->arranged.sealed);
    m.cut = std::move(made->arranged.cut);
    m.merged = std::move(made->arranged.merged);
    m.choice = std::move(made->arranged.choice);
    m.rounding = made->arranged.rounded.report;
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
                run_stage(how, [b, to](const Run& run) { return ResultFolder(*b, to, run)(); });
            },
            "folder"_a, "how"_a);
    module.def("build", &build_text, "text"_a, "base"_a, "source"_a, "how"_a);
}

} // namespace terrane::python
