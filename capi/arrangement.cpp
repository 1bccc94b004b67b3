// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/arrangement.h>

#include <memory>
#include <string>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>

using namespace terrane::capi::detail;
using terrane::ErrorCode;

terrane_arrangement::terrane_arrangement(terrane::Arrangement made) :
    exact(std::make_shared<const terrane::Arrangement>(std::move(made))),
    identity(std::make_shared<const char>('a')) {}

const std::vector<terrane::Point3>& terrane_arrangement::vertices() const {
    const std::lock_guard lock(mutex_);
    if (!computed_) {
        std::vector<terrane::Point3> found(exact->vertices.size());
        for (std::size_t v = 0; v < found.size(); ++v)
            found[v] = exact->nearest(terrane::VertexId(static_cast<std::uint32_t>(v)));
        vertices_ = std::move(found);
        computed_ = true;
    }
    return vertices_;
}

namespace terrane::capi::detail {

std::vector<std::uint32_t> boundary_of(const std::uint32_t* boundary, std::size_t boundary_count,
                                       std::size_t count) {
    need_array(boundary, boundary_count, "boundary");
    std::vector<std::uint32_t> numbers(boundary, boundary + boundary_count);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] >= count)
            throw BadArgument{"boundary", "names a surface that does not exist"};
        if (i > 0 && numbers[i] <= numbers[i - 1])
            throw BadArgument{"boundary", "is not ascending"};
    }
    if (numbers.empty()) throw BadArgument{"boundary", "names no surface"};
    return numbers;
}

namespace {

terrane_arrange_options default_arranging() noexcept {
    return {sizeof(terrane_arrange_options), nullptr};
}

terrane_round_options default_rounding() noexcept {
    return {sizeof(terrane_round_options), RoundingOptions{}.max_rounds, 0, -1};
}

std::vector<terrane_surface_cut> effects_of(const VolumeReport& report) {
    std::vector<terrane_surface_cut> effects;
    effects.reserve(report.surfaces.size());
    for (const SurfaceCut& s : report.surfaces)
        effects.push_back({s.area_inside, s.area_outside, s.area_on_boundary, s.open_length,
                           s.pieces, s.open_borders});
    return effects;
}

} // namespace
} // namespace terrane::capi::detail

terrane_code terrane_arrange_options_init(terrane_arrange_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_arranging());
}

terrane_code terrane_round_options_init(terrane_round_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_rounding());
}

terrane_code terrane_arrange(const terrane_surfaces* surfaces,
                             const terrane_arrange_options* options, const terrane_run* run,
                             terrane_arrangement** out, terrane_error** error) {
    return produce(out, error, [&] {
        const auto& list = needed(surfaces, "surfaces").list;
        const auto given = options_of(options, default_arranging());
        terrane::ArrangeOptions wanted;
        if (given.search) {
            const auto search = terrane::search_named(given.search);
            if (!search)
                refuse(ErrorCode::bad_option, "is not a method of search", "options.search");
            wanted.search = *search;
        }
        return std::make_unique<terrane_arrangement>(
            must(terrane::arrange(list, wanted, run_of(run))));
    });
}

void terrane_arrangement_free(terrane_arrangement* arrangement) {
    release(arrangement);
}

terrane_code terrane_arrangement_get_summary(const terrane_arrangement* arrangement,
                                             terrane_arrangement_summary* summary,
                                             size_t struct_size) {
    if (!known(arrangement)) return TERRANE_BAD_ARGUMENT;
    const terrane::Arrangement& a = *arrangement->exact;
    const auto& s = a.statistics;
    return give_report(terrane_arrangement_summary{a.input_corners().size(), s.candidates,
                                                   s.improper_contacts, s.divided,
                                                   s.constructed_points, a.vertices.size(),
                                                   a.triangles.size(), a.intersection_edges.size()},
                       summary, struct_size);
}

const double* terrane_arrangement_vertices(const terrane_arrangement* arrangement,
                                           size_t* vertex_count) {
    const auto* const none =
        array_of<double>(static_cast<std::vector<double>*>(nullptr), vertex_count);
    if (!known(arrangement)) return none;
    return quietly(none, [&] { return array_of<double>(&arrangement->vertices(), vertex_count); });
}

const uint32_t* terrane_arrangement_triangles(const terrane_arrangement* arrangement,
                                              size_t* triangle_count) {
    return array_of<uint32_t>(known(arrangement) ? &arrangement->exact->triangles : nullptr,
                              triangle_count);
}

terrane_code terrane_arrangement_parents(const terrane_arrangement* arrangement,
                                         terrane_lists* lists) {
    return give_lists(known(arrangement) ? &arrangement->exact->parents_of : nullptr, lists);
}

terrane_code terrane_arrangement_surfaces(const terrane_arrangement* arrangement,
                                          terrane_lists* lists) {
    return give_lists(known(arrangement) ? &arrangement->exact->surfaces_of : nullptr, lists);
}

const uint32_t* terrane_arrangement_intersection_edges(const terrane_arrangement* arrangement,
                                                       size_t* count) {
    return array_of<uint32_t>(
        known(arrangement) ? &arrangement->exact->intersection_edges : nullptr, count);
}

const uint32_t* terrane_arrangement_degenerate(const terrane_arrangement* arrangement,
                                               size_t* count) {
    return array_of<uint32_t>(known(arrangement) ? &arrangement->exact->degenerate : nullptr,
                              count);
}

terrane_code terrane_arrangement_coordinate(const terrane_arrangement* arrangement, size_t vertex,
                                            int axis, char* buffer, size_t size, size_t* length,
                                            terrane_error** error) {
    if (length) *length = 0;
    return call(error, [&] {
        const terrane::Arrangement& exact = *needed(arrangement, "arrangement").exact;
        if (axis < 0 || axis > 2) throw BadArgument{"axis", "is not 0, 1 or 2"};
        if (vertex >= exact.vertices.size())
            refuse(ErrorCode::bad_index, "there is no such vertex",
                   "vertex " + std::to_string(vertex));
        const auto texts = exact.coordinates(terrane::VertexId(static_cast<std::uint32_t>(vertex)));
        copy_text(texts[static_cast<std::size_t>(axis)], buffer, size, length);
    });
}

terrane_code terrane_arrangement_digest(const terrane_arrangement* arrangement,
                                        const terrane_surfaces* surfaces, const terrane_run* run,
                                        char* buffer, size_t size, size_t* length,
                                        terrane_error** error) {
    if (length) *length = 0;
    return call(error, [&] {
        const terrane::Arrangement& exact = *needed(arrangement, "arrangement").exact;
        const auto& list = needed(surfaces, "surfaces").list;
        std::size_t vertices = 0, triangles = 0;
        for (const terrane::Surface& s : list) {
            vertices += s.vertices.size();
            triangles += s.triangles.size();
        }
        if (vertices != exact.input_vertices().size() ||
            triangles != exact.input_corners().size() || list.size() != exact.surfaces.size())
            refuse(ErrorCode::bad_option, "these are not the surfaces that were arranged",
                   "surfaces");
        copy_text(terrane::canonical_digest(list, exact, run_of(run)), buffer, size, length);
    });
}

terrane_code terrane_cut_to_volume(const terrane_arrangement* arrangement, const uint32_t* boundary,
                                   size_t boundary_count, const terrane_run* run, terrane_cut** out,
                                   terrane_error** error) {
    return produce(out, error, [&] {
        const terrane::Arrangement& exact = *needed(arrangement, "arrangement").exact;
        const auto numbers = boundary_of(boundary, boundary_count, exact.surfaces.size());
        auto inside = must(terrane::cut_to_volume(exact, numbers, run_of(run)));
        auto cut = std::make_unique<terrane_cut>(std::move(inside.arrangement));
        cut->surfaces = effects_of(inside.report);
        return cut;
    });
}

void terrane_cut_free(terrane_cut* cut) {
    release(cut);
}

const terrane_arrangement* terrane_cut_arrangement(const terrane_cut* cut) {
    return known(cut) ? &cut->arrangement : nullptr;
}

const terrane_surface_cut* terrane_cut_surfaces(const terrane_cut* cut, size_t* surface_count) {
    return array_of<terrane_surface_cut>(known(cut) ? &cut->surfaces : nullptr, surface_count);
}

terrane_code terrane_merge_small_blocks(const terrane_arrangement* arrangement, double least,
                                        const terrane_run* run, terrane_arrangement** out,
                                        size_t* merged, terrane_error** error) {
    if (merged) *merged = 0;
    return produce(out, error, [&] {
        auto made = must(terrane::merge_small_blocks(*needed(arrangement, "arrangement").exact,
                                                     least, run_of(run)));
        if (merged) *merged = made.report.merged.size();
        return std::make_unique<terrane_arrangement>(std::move(made.arrangement));
    });
}

terrane_code terrane_round(const terrane_arrangement* arrangement,
                           const terrane_round_options* options, const terrane_run* run,
                           terrane_mesh** out, terrane_error** error) {
    return produce(out, error, [&] {
        const auto& given = needed(arrangement, "arrangement");
        const auto wanted = options_of(options, default_rounding());
        terrane::RoundingOptions rounding;
        rounding.max_rounds = wanted.max_rounds;
        rounding.max_move = number_or_default(wanted.max_move, "options.max_move");
        if (wanted.full_check != 0) rounding.check.method = terrane::PairCheck::full;
        return std::make_unique<terrane_mesh>(
            must(terrane::round_to_doubles(*given.exact, rounding, run_of(run))), given.identity);
    });
}
