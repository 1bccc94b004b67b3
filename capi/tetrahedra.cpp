// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/tetrahedra.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/files.hpp>

namespace terrane::capi::detail {
namespace {

terrane_tetrahedra_options default_meshing() noexcept {
    const TetrahedraOptions defaults;
    terrane_tetrahedra_options o{};
    o.struct_size = sizeof(terrane_tetrahedra_options);
    o.margin = defaults.margin;
    o.time_limit = defaults.time_limit;
    return o;
}

std::string place_of(const char* list, std::size_t index) {
    return std::string("options.") + list + "[" + std::to_string(index) + "]";
}

std::vector<NamedSize> sizes_of(const terrane_named_size* given, std::size_t count,
                                const char* list) {
    need_array(given, count, list);
    std::vector<NamedSize> sizes;
    for (std::size_t i = 0; i < count; ++i)
        sizes.push_back({{needed_text(given[i].name, "options: name of a size"), place_of(list, i)},
                         given[i].edge_length});
    return sizes;
}

/// Returns a wish that 0 stands for none of.
std::optional<double> wish(double value) {
    return value == 0 ? std::nullopt : std::optional(value);
}

TetrahedraOptions meshing_of(const terrane_tetrahedra_options& o) {
    if (o.mesher < TERRANE_MESHER_AUTOMATIC || o.mesher > TERRANE_MESHER_GMSH)
        throw BadArgument{"options.mesher", "is not a mesher"};
    TetrahedraOptions options;
    options.mesher = static_cast<Mesher>(o.mesher);
    options.split_surfaces = o.split_triangles != 0;
    const auto is_0 = [](double c) { return c == 0; };
    if (o.has_box == 0 && !(std::all_of(std::begin(o.box_low), std::end(o.box_low), is_0) &&
                            std::all_of(std::begin(o.box_high), std::end(o.box_high), is_0)))
        throw BadArgument{"options.box_low", "is not 0, but has_box is"};
    if (o.has_box != 0)
        options.box = Box3{{o.box_low[0], o.box_low[1], o.box_low[2]},
                           {o.box_high[0], o.box_high[1], o.box_high[2]}};
    options.margin = o.margin;
    options.edge_length = wish(o.edge_length);
    options.radius_edge_ratio = wish(o.radius_edge_ratio);
    options.max_volume = wish(o.max_volume);
    options.time_limit = o.time_limit;
    if (o.keep_shapes != 0) options.optimise.reset();
    if (o.helper) options.helper = o.helper;
    if (o.gmsh_helper) options.gmsh_helper = o.gmsh_helper;
    return options;
}

terrane_shape_report report_of(const OptimiseReport& r) noexcept {
    return {r.before.quality,
            r.after.quality,
            r.before.least_angle,
            r.after.least_angle,
            r.before.largest_angle,
            r.after.largest_angle,
            r.passes,
            r.removed_edges,
            r.removed_faces,
            r.moved,
            r.contracted,
            r.inserted,
            r.remeshed,
            r.left,
            r.untried,
            r.effort,
            r.is_cut_short ? 1 : 0,
            0};
}

TetrahedraRequest request_of(const terrane_tetrahedra_options* given) {
    const auto o = options_of(given, default_meshing());
    TetrahedraRequest request;
    request.options = meshing_of(o);
    request.size_of = sizes_of(o.size_of, o.size_of_count, "size_of");
    request.size_in = sizes_of(o.size_in, o.size_in_count, "size_in");
    need_array(o.split, o.split_count, "options.split");
    for (std::size_t i = 0; i < o.split_count; ++i)
        request.split.push_back({needed_text(o.split[i], "options.split"), place_of("split", i)});
    request.outside = o.skip_outside == 0;
    return request;
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;
using terrane::ErrorCode;

terrane_tetrahedra::terrane_tetrahedra(terrane::FilledBlocks made) : filled(std::move(made)) {
    for (const terrane::TetrahedraViolation& v : filled.report.violations)
        violations.push_back(terrane::message(v));
    for (const terrane::BlockVolume& v : filled.report.volumes)
        volumes.push_back({v.block, v.tetrahedra, v.difference, v.bound, v.equal ? 1 : 0, 0});
}

terrane_code terrane_tetrahedra_options_init(terrane_tetrahedra_options* options,
                                             size_t struct_size) {
    return init_options(options, struct_size, default_meshing());
}

terrane_code terrane_tetrahedralize(const terrane_model* model,
                                    const terrane_tetrahedra_options* options,
                                    const terrane_run* run, terrane_tetrahedra** out,
                                    terrane_error** error) {
    return produce(out, error, [&] {
        const terrane::Model& given = needed(model, "model").model;
        return std::make_unique<terrane_tetrahedra>(
            must(terrane::fill_blocks(given, request_of(options), run_of(run))));
    });
}

void terrane_tetrahedra_free(terrane_tetrahedra* tetrahedra) {
    release(tetrahedra);
}

size_t terrane_tetrahedra_violation_count(const terrane_tetrahedra* tetrahedra) {
    return known(tetrahedra) ? tetrahedra->violations.size() : 0;
}

const char* terrane_tetrahedra_violation(const terrane_tetrahedra* tetrahedra, size_t violation) {
    return violation < terrane_tetrahedra_violation_count(tetrahedra)
               ? tetrahedra->violations[violation].c_str()
               : nullptr;
}

const double* terrane_tetrahedra_vertices(const terrane_tetrahedra* tetrahedra,
                                          size_t* vertex_count) {
    return array_of<double>(known(tetrahedra) ? &tetrahedra->filled.tetrahedra.vertices : nullptr,
                            vertex_count);
}

const uint32_t* terrane_tetrahedra_cells(const terrane_tetrahedra* tetrahedra, size_t* count) {
    return array_of<uint32_t>(
        known(tetrahedra) ? &tetrahedra->filled.tetrahedra.tetrahedra : nullptr, count);
}

const uint32_t* terrane_tetrahedra_block_of(const terrane_tetrahedra* tetrahedra, size_t* count) {
    return array_of<uint32_t>(known(tetrahedra) ? &tetrahedra->filled.tetrahedra.block_of : nullptr,
                              count);
}

const uint32_t* terrane_tetrahedra_faces(const terrane_tetrahedra* tetrahedra, size_t* face_count) {
    return array_of<uint32_t>(known(tetrahedra) ? &tetrahedra->filled.tetrahedra.faces : nullptr,
                              face_count);
}

const uint32_t* terrane_tetrahedra_face_triangle(const terrane_tetrahedra* tetrahedra,
                                                 size_t* face_count) {
    return array_of<uint32_t>(
        known(tetrahedra) ? &tetrahedra->filled.tetrahedra.face_triangle : nullptr, face_count);
}

terrane_code terrane_tetrahedra_face_surfaces(const terrane_tetrahedra* tetrahedra,
                                              terrane_lists* lists) {
    return give_lists(known(tetrahedra) ? &tetrahedra->filled.tetrahedra.surfaces_of : nullptr,
                      lists);
}

const uint32_t* terrane_tetrahedra_twins(const terrane_tetrahedra* tetrahedra, size_t* count) {
    return array_of<uint32_t>(known(tetrahedra) ? &tetrahedra->filled.tetrahedra.twins : nullptr,
                              count);
}

size_t terrane_tetrahedra_surface_count(const terrane_tetrahedra* tetrahedra) {
    return known(tetrahedra) ? tetrahedra->filled.tetrahedra.surfaces.size() : 0;
}

const char* terrane_tetrahedra_surface_name(const terrane_tetrahedra* tetrahedra, size_t surface) {
    return surface < terrane_tetrahedra_surface_count(tetrahedra)
               ? tetrahedra->filled.tetrahedra.surfaces[surface].name.c_str()
               : nullptr;
}

size_t terrane_tetrahedra_block_count(const terrane_tetrahedra* tetrahedra) {
    return known(tetrahedra) ? tetrahedra->filled.tetrahedra.block_count : 0;
}

const char* terrane_tetrahedra_block_name(const terrane_tetrahedra* tetrahedra, size_t block) {
    if (!known(tetrahedra) || block >= tetrahedra->filled.block_names.size()) return nullptr;
    return tetrahedra->filled.block_names[block].c_str();
}

const terrane_block_volume* terrane_tetrahedra_volumes(const terrane_tetrahedra* tetrahedra,
                                                       size_t* block_count) {
    return array_of<terrane_block_volume>(known(tetrahedra) ? &tetrahedra->volumes : nullptr,
                                          block_count);
}

terrane_code terrane_tetrahedra_shape_report(const terrane_tetrahedra* tetrahedra,
                                             terrane_shape_report* report, size_t struct_size) {
    if (!known(tetrahedra)) return TERRANE_BAD_ARGUMENT;
    const auto& found = tetrahedra->filled.optimised;
    return give_report(found ? report_of(*found) : terrane_shape_report{}, report, struct_size);
}

const char* terrane_tetrahedra_mesher(const terrane_tetrahedra* tetrahedra) {
    return known(tetrahedra) ? tetrahedra->filled.tetrahedra.mesher.c_str() : nullptr;
}

terrane_code terrane_tetrahedra_write(const terrane_tetrahedra* tetrahedra, const char* path,
                                      const terrane_write_options* options, terrane_error** error) {
    return call(error, [&] {
        const terrane_tetrahedra& given = needed(tetrahedra, "tetrahedra");
        auto writing = writing_of(options);
        const char* const file = needed_file(path);
        if (!given.violations.empty())
            refuse(ErrorCode::bad_option, "the check found violations: " + given.violations[0],
                   "tetrahedra");
        writing.block_names = given.filled.block_names;
        must(terrane::write_tetrahedra(given.filled.tetrahedra, file, writing));
    });
}
