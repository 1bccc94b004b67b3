// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/project.h>

#include <memory>
#include <string>
#include <utility>

#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/project/build.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/project.hpp>
#include <terrane/io/project_inputs.hpp>

namespace terrane::capi::detail {
namespace {

using MadeBuilt = Result<std::unique_ptr<terrane_built>>;

std::unique_ptr<terrane_built> handle_of(Built made) {
    auto built = std::make_unique<terrane_built>(std::move(made.arranged.exact));
    built->surfaces.list = std::move(made.arranged.surfaces);
    built->model = std::make_unique<terrane_model>(std::move(made.model).value());
    built->model->mesh.origin = built->arrangement.identity;
    if (made.filled)
        built->tetrahedra = std::make_unique<terrane_tetrahedra>(*std::move(made.filled));
    return built;
}

MadeBuilt build_of(const Project& project, BuildInput input, const Run& run) {
    auto built = terrane::build(project, std::move(input), run);
    if (!built) return built.error();
    return handle_of(*std::move(built));
}

MadeBuilt build_from_files(const Project& project, const Run& run) {
    auto inputs = read_inputs(project, run);
    if (!inputs) return inputs.error();
    return build_of(project, std::move(inputs->build), run);
}

/// Builds with surfaces of the caller's, one for each entry of the project.
MadeBuilt build_from(Project project, std::vector<Surface> surfaces, const Run& run) {
    if (surfaces.size() != project.surfaces.size())
        return at_key(project, "surfaces",
                      "has " + std::to_string(project.surfaces.size()) + " entries, but " +
                          std::to_string(surfaces.size()) + " surfaces are given");
    if (auto valid = validate(surfaces, run); !valid) return valid.error();
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const ProjectSurfaces& entry = project.surfaces[i];
        if (!entry.name.empty()) surfaces[i].name = entry.name;
        if (entry.role) surfaces[i].role = *entry.role;
    }
    project.surfaces.clear(); // no file is read but that of the volume of interest
    auto inputs = read_inputs(project, run);
    if (!inputs) return inputs.error();
    inputs->build.surfaces = std::move(surfaces);
    return build_of(project, std::move(inputs->build), run);
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_code terrane_build_file(const char* path, const terrane_run* run, terrane_built** out,
                                terrane_error** error) {
    return produce(out, error, [&]() -> MadeBuilt {
        const auto project = terrane::read_project(needed_file(path));
        if (!project) return project.error();
        return build_from_files(*project, run_of(run));
    });
}

terrane_code terrane_build(const char* json, const char* folder, const terrane_surfaces* surfaces,
                           const terrane_run* run, terrane_built** out, terrane_error** error) {
    return produce(out, error, [&]() -> MadeBuilt {
        auto project =
            terrane::parse_project(needed_text(json, "json"), folder ? folder : "", "project");
        if (!project) return project.error();
        if (!surfaces) return build_from_files(*project, run_of(run));
        return build_from(*std::move(project), needed(surfaces, "surfaces").list, run_of(run));
    });
}

void terrane_built_free(terrane_built* built) {
    release(built);
}

const terrane_model* terrane_built_model(const terrane_built* built) {
    return known(built) ? built->model.get() : nullptr;
}

const terrane_tetrahedra* terrane_built_tetrahedra(const terrane_built* built) {
    return known(built) ? built->tetrahedra.get() : nullptr;
}

const terrane_surfaces* terrane_built_surfaces(const terrane_built* built) {
    return known(built) ? &built->surfaces : nullptr;
}

const terrane_arrangement* terrane_built_arrangement(const terrane_built* built) {
    return known(built) ? &built->arrangement : nullptr;
}
