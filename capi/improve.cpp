// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <memory>
#include <utility>

#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/fields.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/capi/mesh.h>

namespace terrane::capi::detail {
namespace {

terrane_spread spread_of(const Spread& s) {
    terrane_spread made{s.min, s.mean, s.max, {}};
    std::ranges::copy(s.percentiles, made.percentiles);
    return made;
}

terrane_quality quality_of(const QualityReport& r) {
    terrane_quality made{};
    made.triangles = r.triangles;
    made.q = spread_of(r.q);
    made.smallest_angle = spread_of(r.smallest_angle);
    made.largest_angle = spread_of(r.largest_angle);
    made.edge_length = spread_of(r.edge_length);
    made.share_above_08 = r.share_above_08;
    static_assert(QualityReport::classes == 20);
    std::ranges::copy(r.histogram, made.histogram);
    made.worst = r.worst;
    return made;
}

terrane_improve_report report_of(const ImproveReport& r) {
    terrane_improve_report made{};
    made.before = quality_of(r.before);
    made.after = quality_of(r.after);
    made.splits = r.splits;
    made.collapses = r.collapses;
    made.swaps = r.swaps;
    made.moves = r.moves;
    made.held_blocks = r.held_blocks;
    made.attempts = r.attempts;
    made.passes = r.passes;
    made.sides_kept = r.sides_kept ? 1 : 0;
    return made;
}

terrane_improve_options default_improving() noexcept {
    return struct_of<terrane_improve_options>(ImproveOptions{});
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_improved::terrane_improved(terrane::Improved made, const terrane_mesh& given) :
    improved(std::move(made)), before(given.mesh), mesh(improved.conforming.value()),
    report(report_of(improved.report)) {}

terrane_code terrane_improve_options_init(terrane_improve_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_improving());
}

terrane_code terrane_measure_quality(const terrane_mesh* mesh, const terrane_run* run,
                                     terrane_quality* quality, size_t struct_size,
                                     terrane_error** error) {
    return call(error, [&] {
        const terrane::Mesh& measured = needed(mesh, "mesh").mesh;
        need_array(quality, 1, "quality");
        const auto found = quality_of(
            terrane::measure_quality(measured.vertices, measured.triangles, run_of(run)));
        if (give_report(found, quality, struct_size) != TERRANE_OK)
            throw BadArgument{"struct_size", "is not known to this library"};
    });
}

terrane_code terrane_improve(const terrane_mesh* mesh, const terrane_improve_options* options,
                             const terrane_run* run, terrane_improved** out,
                             terrane_error** error) {
    return produce(out, error, [&] {
        const terrane_mesh& given = needed(mesh, "mesh");
        const auto wanted =
            fields_of<terrane::ImproveOptions>(options_of(options, default_improving()));
        const auto how = run_of(run);
        const auto proof = proven(given, how);
        return std::make_unique<terrane_improved>(must(terrane::improve(proof, wanted, how)),
                                                  given);
    });
}

void terrane_improved_free(terrane_improved* improved) {
    release(improved);
}

const terrane_mesh* terrane_improved_mesh(const terrane_improved* improved) {
    return known(improved) ? &improved->mesh : nullptr;
}

terrane_code terrane_improved_get_report(const terrane_improved* improved,
                                         terrane_improve_report* report, size_t struct_size) {
    return known(improved) ? give_report(improved->report, report, struct_size)
                           : TERRANE_BAD_ARGUMENT;
}

const double* terrane_improved_bounds(const terrane_improved* improved, size_t* surface_count) {
    return array_of<double>(known(improved) ? &improved->improved.report.bound_of : nullptr,
                            surface_count);
}
