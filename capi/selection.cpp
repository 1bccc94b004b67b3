// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/selection.hpp>

#include <limits>
#include <memory>
#include <utility>

#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/capi/selection.h>

namespace terrane::capi::detail {
namespace {

static_assert(TERRANE_INSIDE_NONZERO == int(InsideRule::nonzero) &&
              TERRANE_INSIDE_POSITIVE == int(InsideRule::positive) &&
              TERRANE_INSIDE_ODD == int(InsideRule::odd));

terrane_select_options default_selecting() noexcept {
    return {sizeof(terrane_select_options), -1, TERRANE_INSIDE_NONZERO, 0};
}

SelectOptions selecting_of(const terrane_select_options* given) {
    const auto c = options_of(given, default_selecting());
    if (c.rule < TERRANE_INSIDE_NONZERO || c.rule > TERRANE_INSIDE_ODD)
        throw BadArgument{"options.rule", "is no rule"};
    SelectOptions options{.rule = static_cast<InsideRule>(c.rule), .fractions = c.fractions != 0};
    options.rounding.max_move = number_or_default(c.max_move, "options.max_move");
    return options;
}

/// Returns the mesh as a rounded one, with the report of rounding.
RoundedMesh rounded_of(const Selected& made) {
    return {SharedMesh(made.mesh), {}, {}, made.rounding};
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_selected::terrane_selected(terrane::Selected made) :
    selected(std::move(made)), mesh(rounded_of(selected), nullptr) {
    for (const terrane::SelectedPiece& p : selected.pieces)
        pieces.push_back({p.volume, p.triangles});
}

terrane_code terrane_select_options_init(terrane_select_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_selecting());
}

terrane_code terrane_select(const terrane_surfaces* surfaces, const char* expression,
                            const terrane_select_options* options, const terrane_run* run,
                            terrane_selected** out, terrane_error** error) {
    return produce(out, error, [&] {
        const auto& list = needed(surfaces, "surfaces").list;
        const char* const text = needed_text(expression, "expression");
        return std::make_unique<terrane_selected>(
            must(terrane::select(list, text, selecting_of(options), run_of(run))));
    });
}

void terrane_selected_free(terrane_selected* selected) {
    release(selected);
}

const terrane_mesh* terrane_selected_mesh(const terrane_selected* selected) {
    return known(selected) ? &selected->mesh : nullptr;
}

int terrane_selected_is_surface(const terrane_selected* selected) {
    return known(selected) && selected->selected.is_surface ? 1 : 0;
}

const terrane_selected_piece* terrane_selected_pieces(const terrane_selected* selected,
                                                      size_t* count) {
    return array_of<terrane_selected_piece>(known(selected) ? &selected->pieces : nullptr, count);
}

const uint32_t* terrane_selected_piece_of(const terrane_selected* selected, size_t* count) {
    return array_of<uint32_t>(known(selected) ? &selected->selected.piece_of : nullptr, count);
}

size_t terrane_selected_cavities(const terrane_selected* selected) {
    return known(selected) ? selected->selected.cavities : 0;
}

double terrane_selected_volume(const terrane_selected* selected) {
    return known(selected) ? selected->selected.volume : std::numeric_limits<double>::quiet_NaN();
}

const char* terrane_selected_exact_volume(const terrane_selected* selected, uint32_t piece) {
    if (!known(selected)) return nullptr;
    const terrane::Selected& made = selected->selected;
    if (piece == TERRANE_NONE) return made.exact_volume.c_str();
    return piece < made.pieces.size() ? made.pieces[piece].exact_volume.c_str() : nullptr;
}
