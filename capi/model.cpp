// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/model.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/results.hpp>
#include <terrane/io/structure_json.hpp>

using namespace terrane::capi::detail;
using terrane::ErrorCode;

const std::vector<std::string>& terrane_volumes::fractions() const {
    const std::lock_guard lock(mutex_);
    if (!computed_) {
        fractions_ = mesh ? terrane::exact_volumes(**mesh, volumes).measures
                          : terrane::exact_volumes(*arrangement, volumes).measures;
        computed_ = true;
    }
    return fractions_;
}

terrane_model::terrane_model(terrane::Model made) :
    model(std::move(made)), mesh(model.mesh), structure(model.structure) {
    volumes.volumes = model.volumes;
    volumes.mesh = model.mesh;
}

namespace terrane::capi::detail {
namespace {

terrane_model_options default_modelling() noexcept {
    return {sizeof(terrane_model_options), nullptr, 0};
}

/// Returns the column of a caller. Its units begin with their sizes implied: they are of fixed
/// layout.
StratigraphicColumn column_of(const terrane_model_options* given) {
    const auto options = options_of(given, default_modelling());
    need_array(options.column, options.unit_count, "options.column");
    StratigraphicColumn column;
    for (std::size_t i = 0; i < options.unit_count; ++i) {
        const terrane_column_unit& u = options.column[i];
        need_reserved(u, "options.column");
        ColumnUnit unit{
            needed_text(u.name, "options.column.name"), u.surface ? u.surface : "", {}, {}};
        if (!std::isnan(u.age)) unit.age = u.age;
        unit.contact = u.is_erosive != 0 ? UnitContact::erosive : UnitContact::conformable;
        column.push_back(std::move(unit));
    }
    return column;
}

/// Checks that the handles were made from each other.
void check_origins(const terrane_arrangement& arrangement, const terrane_mesh& rounded,
                   const terrane_improved* improved) {
    if (rounded.origin != arrangement.identity)
        refuse(ErrorCode::bad_option, "is not what this arrangement was rounded to", "rounded");
    if (!rounded.proof)
        refuse(ErrorCode::improper_contact, "the rounded mesh is not conforming", "rounded");
    if (improved && &*improved->before != &*rounded.mesh)
        refuse(ErrorCode::bad_option, "was not made from this rounded mesh", "improved");
}

const terrane_volumes& of_mesh(const terrane_volumes* volumes) {
    const terrane_volumes& given = needed(volumes, "volumes");
    if (!given.mesh) throw BadArgument{"volumes", "are those of an arrangement, not of a mesh"};
    return given;
}

} // namespace
} // namespace terrane::capi::detail

terrane_code terrane_model_options_init(terrane_model_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_modelling());
}

terrane_code terrane_find_volumes(const terrane_mesh* mesh, const terrane_run* run,
                                  terrane_volumes** out, terrane_error** error) {
    return produce(out, error, [&] {
        const auto how = run_of(run);
        auto proof = proven(needed(mesh, "mesh"), how);
        auto found = must(terrane::find_volumes(*proof, how));
        auto volumes = std::make_unique<terrane_volumes>();
        volumes->volumes = std::move(found);
        volumes->mesh = std::move(proof);
        return volumes;
    });
}

terrane_code terrane_find_exact_volumes(const terrane_arrangement* arrangement,
                                        const terrane_run* run, terrane_volumes** out,
                                        terrane_error** error) {
    return produce(out, error, [&] {
        const auto& exact = needed(arrangement, "arrangement").exact;
        auto found = must(terrane::find_volumes(*exact, run_of(run)));
        auto volumes = std::make_unique<terrane_volumes>();
        volumes->volumes = std::move(found);
        volumes->arrangement = exact;
        return volumes;
    });
}

void terrane_volumes_free(terrane_volumes* volumes) {
    release(volumes);
}

const uint32_t* terrane_volumes_of_sides(const terrane_volumes* volumes, size_t* triangle_count) {
    return array_of<uint32_t>(known(volumes) ? &volumes->volumes.of_sides : nullptr,
                              triangle_count);
}

const double* terrane_volumes_measures(const terrane_volumes* volumes, size_t* count) {
    return array_of<double>(known(volumes) ? &volumes->volumes.measures : nullptr, count);
}

double terrane_volumes_total(const terrane_volumes* volumes) {
    return known(volumes) ? volumes->volumes.total : 0;
}

terrane_code terrane_volumes_exact(const terrane_volumes* volumes, size_t volume, char* buffer,
                                   size_t size, size_t* length, terrane_error** error) {
    if (length) *length = 0;
    return call(error, [&] {
        const terrane_volumes& given = needed(volumes, "volumes");
        if (volume == 0 || volume >= given.volumes.measures.size())
            refuse(ErrorCode::bad_index, "there is no such block",
                   "block " + std::to_string(volume));
        copy_text(given.fractions().at(volume), buffer, size, length);
    });
}

terrane_code terrane_locate_points(const terrane_volumes* volumes, const double* points,
                                   size_t point_count, const terrane_run* run, uint32_t* blocks,
                                   terrane_error** error) {
    return call(error, [&] {
        const terrane_volumes& given = of_mesh(volumes);
        need_array(points, point_count, "points");
        need_array(blocks, point_count, "blocks");
        const auto places = points_of(points, point_count);
        for (std::size_t i = 0; i < places.size(); ++i)
            if (!terrane::is_finite(places[i]))
                refuse(ErrorCode::bad_number, "a coordinate is not finite",
                       "point " + std::to_string(i));
        const auto found =
            must(terrane::locate_points(places, **given.mesh, given.volumes, run_of(run)));
        if (point_count > 0) std::memcpy(blocks, found.data(), point_count * sizeof(uint32_t));
    });
}

terrane_code terrane_build_structure(const terrane_volumes* volumes, terrane_structure** out,
                                     terrane_error** error) {
    return produce(out, error, [&] {
        const terrane_volumes& given = of_mesh(volumes);
        return std::make_unique<terrane_structure>(
            terrane::build_structure(**given.mesh, given.volumes));
    });
}

terrane_code terrane_make_model(const terrane_arrangement* arrangement, const terrane_mesh* rounded,
                                const terrane_improved* improved,
                                const terrane_model_options* options, const terrane_run* run,
                                terrane_model** out, terrane_error** error) {
    return produce(out, error, [&] {
        const auto& exact = needed(arrangement, "arrangement");
        const auto& mesh = needed(rounded, "rounded");
        const auto* better = improved ? &needed(improved, "improved") : nullptr;
        check_origins(exact, mesh, better);
        const terrane::BlockNaming naming{column_of(options), {}};
        must(terrane::check_column(naming.column));
        must(terrane::check_column(naming.column, exact.exact->surfaces));
        return std::make_unique<terrane_model>(
            must(better ? terrane::make_model(*exact.exact, *mesh.proof, better->improved,
                                              run_of(run), naming)
                        : terrane::make_model(*exact.exact, *mesh.proof, run_of(run), naming)));
    });
}

void terrane_model_free(terrane_model* model) {
    release(model);
}

const terrane_mesh* terrane_model_mesh(const terrane_model* model) {
    return known(model) ? &model->mesh : nullptr;
}

const terrane_volumes* terrane_model_volumes(const terrane_model* model) {
    return known(model) ? &model->volumes : nullptr;
}

const terrane_structure* terrane_model_structure(const terrane_model* model) {
    return known(model) ? &model->structure : nullptr;
}

const double* terrane_model_exact_volumes(const terrane_model* model, size_t* count) {
    return array_of<double>(known(model) ? &model->model.exact_volumes : nullptr, count);
}

double terrane_model_total_volume(const terrane_model* model) {
    return known(model) ? model->model.total_volume : 0;
}

size_t terrane_model_lost(const terrane_model* model) {
    return known(model) ? model->model.lost : 0;
}

size_t terrane_model_made(const terrane_model* model) {
    return known(model) ? model->model.made : 0;
}

terrane_code terrane_model_to_json(const terrane_model* model, char** text, terrane_error** error) {
    if (text) *text = nullptr;
    return call(error, [&] {
        const terrane::Model& m = needed(model, "model").model;
        need_array(text, 1, "text");
        *text = text_for_caller(terrane::to_json(
            m.mesh, m.structure, terrane::extras_of({m, std::nullopt, std::nullopt})));
    });
}

terrane_code terrane_model_write(const terrane_model* model, const char* folder,
                                 const char* part_format, const terrane_run* run,
                                 terrane_error** error) {
    return call(error, [&] {
        const terrane::Model& m = needed(model, "model").model;
        must(terrane::write_model_folder({m, std::nullopt, std::nullopt},
                                         part_format ? part_format : terrane::automatic_parts,
                                         needed_text(folder, "folder"), run_of(run)));
    });
}

void terrane_text_free(char* text) {
    std::free(text);
}
