// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <memory>
#include <utility>

#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/capi/model.h>

namespace terrane::capi::detail {
namespace {

terrane_simplify_options default_simplifying() noexcept {
    const SimplifyOptions o;
    return {sizeof(terrane_simplify_options),
            o.resolution,
            o.max_move,
            o.edge_length,
            o.dissolve ? 1 : 0,
            0};
}

terrane_simplify_report report_of(const SimplifyReport& r) noexcept {
    return {r.max_move,    r.corners,       r.curves,          r.sheets, r.divided,
            r.left.size(), r.blocks.size(), r.vanished.size(), r.rounds, r.attempts};
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;
using terrane::ErrorCode;

terrane_simplified::terrane_simplified(terrane::Simplified made, const terrane_mesh& before) :
    at{before.mesh, std::move(made.report)}, arrangement(std::move(made.exact)),
    mesh(std::move(made.rounded), arrangement.identity),
    block_before(std::move(made.block_before)) {
    surfaces.list = std::move(made.surfaces);
}

terrane_code terrane_simplify_options_init(terrane_simplify_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_simplifying());
}

terrane_code terrane_simplify(const terrane_mesh* mesh, const terrane_simplify_options* options,
                              const terrane_run* run, terrane_simplified** out,
                              terrane_error** error) {
    return produce(out, error, [&] {
        const terrane_mesh& given = needed(mesh, "mesh");
        const auto wanted = options_of(options, default_simplifying());
        if (!(wanted.edge_length >= 0) || !std::isfinite(wanted.edge_length))
            refuse(ErrorCode::bad_option, "is not 0 or positive and finite", "options.edge_length");
        const auto how = run_of(run);
        const auto proof = proven(given, how);
        return std::make_unique<terrane_simplified>(
            must(terrane::simplify(proof,
                                   {.resolution = wanted.resolution,
                                    .max_move = wanted.max_move,
                                    .edge_length = wanted.edge_length,
                                    .dissolve = wanted.dissolve != 0},
                                   how)),
            given);
    });
}

void terrane_simplified_free(terrane_simplified* simplified) {
    release(simplified);
}

const terrane_surfaces* terrane_simplified_surfaces(const terrane_simplified* simplified) {
    return known(simplified) ? &simplified->surfaces : nullptr;
}

const terrane_arrangement* terrane_simplified_arrangement(const terrane_simplified* simplified) {
    return known(simplified) ? &simplified->arrangement : nullptr;
}

const terrane_mesh* terrane_simplified_mesh(const terrane_simplified* simplified) {
    return known(simplified) ? &simplified->mesh : nullptr;
}

terrane_code terrane_simplified_get_report(const terrane_simplified* simplified,
                                           terrane_simplify_report* report, size_t struct_size) {
    return known(simplified) ? give_report(report_of(simplified->at.report), report, struct_size)
                             : TERRANE_BAD_ARGUMENT;
}

const uint32_t* terrane_simplified_block_before(const terrane_simplified* simplified,
                                                size_t* count) {
    return array_of<uint32_t>(known(simplified) ? &simplified->block_before : nullptr, count);
}

const uint32_t* terrane_simplified_kept(const terrane_simplified* simplified, size_t* count) {
    return array_of<uint32_t>(known(simplified) ? &simplified->at.report.kept : nullptr, count);
}

terrane_code terrane_simplified_keeps_resolution(const terrane_simplified* simplified,
                                                 const terrane_improved* improved,
                                                 const terrane_run* run, int32_t* is_shown,
                                                 terrane_error** error) {
    if (is_shown) *is_shown = 0;
    return call(error, [&] {
        const auto& given = needed(simplified, "simplified");
        const auto& after = needed(improved, "improved");
        need_array(is_shown, 1, "is_shown");
        if (&*after.before != &*given.mesh.mesh)
            refuse(ErrorCode::bad_option, "was not made from this simplified mesh", "improved");
        *is_shown =
            terrane::is_within_resolution(given.at, after.improved.mesh, run_of(run)) ? 1 : 0;
    });
}
