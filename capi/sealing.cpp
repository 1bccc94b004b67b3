// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/sealing.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/algorithms/tolerance/tolerance.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>

namespace terrane::capi::detail {
namespace {

terrane_seal_options default_sealing() noexcept {
    return {sizeof(terrane_seal_options), 0, nullptr, 0};
}

SealOptions sealing_of(const terrane_seal_options* given, std::size_t surface_count) {
    const auto o = options_of(given, default_sealing());
    need_array(o.rules, o.rule_count, "options.rules");
    SealOptions options;
    options.distance = o.distance;
    for (std::size_t i = 0; i < o.rule_count; ++i) {
        const terrane_seal_rule& r = o.rules[i];
        const bool any = r.other == TERRANE_NONE;
        if (r.surface >= surface_count || (!any && r.other >= surface_count))
            throw BadArgument{"options.rules", "names a surface that does not exist"};
        options.rules.push_back({SurfaceId(r.surface),
                                 any ? std::nullopt : std::optional(SurfaceId(r.other)),
                                 r.distance});
    }
    return options;
}

std::unique_ptr<terrane_sealed> handle_of(Sealed made) {
    auto sealed = std::make_unique<terrane_sealed>(std::move(made.arrangement));
    sealed->surfaces.list = std::move(made.surfaces);
    sealed->left = made.left;
    for (const SealChange& c : made.changes)
        sealed->changes.push_back({c.kind == SealKind::trimmed ? 1 : 0,
                                   c.surface,
                                   c.length,
                                   c.largest,
                                   {c.place.x, c.place.y, c.place.z},
                                   c.triangles});
    for (const ClosedGap& g : made.closed)
        sealed->closed.push_back(
            {g.from, g.to, g.length, g.width, {g.place.x, g.place.y, g.place.z}});
    for (const OpenGap& g : made.open)
        sealed->open.push_back({g.from,
                                g.to,
                                static_cast<std::int32_t>(g.reason),
                                0,
                                g.edges,
                                g.length,
                                g.width,
                                {g.place.x, g.place.y, g.place.z}});
    return sealed;
}

std::unique_ptr<terrane_extended> handle_of(Extended made) {
    auto extended = std::make_unique<terrane_extended>();
    extended->surfaces.list = std::move(made.surfaces);
    for (const ExtendedBorder& b : made.borders)
        extended->borders.push_back(
            {b.surface, b.reached ? 1 : 0, b.length, {b.place.x, b.place.y, b.place.z}, b.edges});
    return extended;
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_code terrane_seal_options_init(terrane_seal_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_sealing());
}

const char* terrane_open_reason_name(int32_t reason) {
    if (reason < 0 || reason > static_cast<int>(terrane::OpenReason::ends_free)) return "unknown";
    return name_of(static_cast<terrane::OpenReason>(reason)).data();
}

terrane_code terrane_seal(const terrane_surfaces* surfaces, const terrane_seal_options* options,
                          const terrane_run* run, terrane_sealed** out, terrane_error** error) {
    return produce(out, error, [&] {
        auto list = needed(surfaces, "surfaces").list;
        const auto wanted = sealing_of(options, list.size());
        return handle_of(must(terrane::seal(std::move(list), wanted, run_of(run))));
    });
}

void terrane_sealed_free(terrane_sealed* sealed) {
    release(sealed);
}

const terrane_surfaces* terrane_sealed_surfaces(const terrane_sealed* sealed) {
    return known(sealed) ? &sealed->surfaces : nullptr;
}

const terrane_arrangement* terrane_sealed_arrangement(const terrane_sealed* sealed) {
    return known(sealed) ? &sealed->arrangement : nullptr;
}

const terrane_seal_change* terrane_sealed_changes(const terrane_sealed* sealed, size_t* count) {
    return array_of<terrane_seal_change>(known(sealed) ? &sealed->changes : nullptr, count);
}

const terrane_closed_gap* terrane_sealed_closed(const terrane_sealed* sealed, size_t* count) {
    return array_of<terrane_closed_gap>(known(sealed) ? &sealed->closed : nullptr, count);
}

const terrane_open_gap* terrane_sealed_open(const terrane_sealed* sealed, size_t* count) {
    return array_of<terrane_open_gap>(known(sealed) ? &sealed->open : nullptr, count);
}

double terrane_sealed_left(const terrane_sealed* sealed) {
    return known(sealed) ? sealed->left : std::numeric_limits<double>::quiet_NaN();
}

terrane_code terrane_choose_seal(const terrane_arrangement* arrangement,
                                 const terrane_surfaces* surfaces, double edge_length,
                                 const terrane_run* run, double* distance, terrane_error** error) {
    if (distance) *distance = 0;
    return call(error, [&] {
        const auto& exact = *needed(arrangement, "arrangement").exact;
        need_array(distance, 1, "distance");
        if (!(edge_length >= 0) || !std::isfinite(edge_length))
            throw BadArgument{"edge_length", "is not 0 or positive and finite"};
        if (edge_length > 0 && surfaces)
            throw BadArgument{"surfaces", "is not null, but edge_length is given"};
        const double median = edge_length > 0
                                  ? edge_length
                                  : terrane::median_edge_length(needed(surfaces, "surfaces").list);
        const auto choice = must(terrane::choose_seal(exact, median, run_of(run)));
        *distance = choice.distance;
    });
}

terrane_code terrane_join_within(const terrane_surfaces* surfaces, double tolerance,
                                 const terrane_run* run, size_t* left, terrane_surfaces** out,
                                 terrane_error** error) {
    if (left) *left = 0;
    return produce(out, error, [&] {
        auto joined = must(terrane::join_within(needed(surfaces, "surfaces").list,
                                                {.tolerance = tolerance}, run_of(run)));
        auto handle = std::make_unique<terrane_surfaces>();
        handle->list = std::move(joined.surfaces);
        if (left) *left = joined.report.is_refused ? SIZE_MAX : joined.report.left.size();
        return handle;
    });
}

terrane_code terrane_extend_to_boundary(const terrane_surfaces* surfaces, const uint32_t* boundary,
                                        size_t boundary_count, double limit, const terrane_run* run,
                                        terrane_extended** out, terrane_error** error) {
    return produce(out, error, [&] {
        auto list = needed(surfaces, "surfaces").list;
        const auto numbers = boundary_of(boundary, boundary_count, list.size());
        return handle_of(must(terrane::extend_to_boundary(
            std::move(list), numbers, {.limit = limit, .arrange = {}}, run_of(run))));
    });
}

void terrane_extended_free(terrane_extended* extended) {
    release(extended);
}

const terrane_surfaces* terrane_extended_surfaces(const terrane_extended* extended) {
    return known(extended) ? &extended->surfaces : nullptr;
}

const terrane_extended_border* terrane_extended_borders(const terrane_extended* extended,
                                                        size_t* count) {
    return array_of<terrane_extended_border>(known(extended) ? &extended->borders : nullptr, count);
}
