// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/project.h>

#include <memory>
#include <utility>

#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/project.hpp>

namespace terrane::capi::detail {
namespace {

std::unique_ptr<terrane_built> handle_of(Built made) {
    auto built = std::make_unique<terrane_built>(std::move(made.arranged.exact));
    built->surfaces.list = std::move(made.arranged.surfaces);
    built->model = std::make_unique<terrane_model>(std::move(made.model).value());
    built->model->mesh.origin = built->arrangement.identity;
    if (made.filled)
        built->tetrahedra = std::make_unique<terrane_tetrahedra>(*std::move(made.filled));
    return built;
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_code terrane_build_file(const char* path, const terrane_run* run, terrane_built** out,
                                terrane_error** error) {
    return produce(out, error, [&] {
        const auto project = must(terrane::read_project(needed_file(path)));
        return handle_of(must(build_model(project, run_of(run))));
    });
}

terrane_code terrane_build(const char* json, const char* folder, const terrane_surfaces* surfaces,
                           const terrane_run* run, terrane_built** out, terrane_error** error) {
    return produce(out, error, [&] {
        auto project = must(
            terrane::parse_project(needed_text(json, "json"), folder ? folder : "", "project"));
        if (!surfaces) return handle_of(must(build_model(project, run_of(run))));
        return handle_of(
            must(build_model(std::move(project), needed(surfaces, "surfaces").list, run_of(run))));
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
