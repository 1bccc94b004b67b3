// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/selection.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/selection/detail/oriented.hpp>
#include <terrane/algorithms/selection/expression.hpp>
#include <terrane/algorithms/selection/windings.hpp>
#include <terrane/algorithms/volumes/exact_volumes.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

using selection::BoundaryFacets;
using selection::oriented;
using selection::SelectedRegion;

namespace {

constexpr std::array<std::string_view, 3> rule_names{"nonzero", "positive", "odd"};

bool is_inside(int winding, InsideRule rule) {
    switch (rule) {
    case InsideRule::positive:
        return winding > 0;
    case InsideRule::odd:
        return winding % 2 != 0;
    default:
        return winding != 0;
    }
}

/// What is asked for: an expression whose operands are surfaces.
struct Question {
    Expression expression;
    std::vector<std::uint32_t> operand_of; ///< per surface: its operand, or no_index
    InsideRule rule = InsideRule::nonzero;
};

/// Reads the expression, and finds the surfaces that it names. Errors: bad_option.
Result<Question> question_of(std::span<const Surface> surfaces, std::string_view text,
                             InsideRule rule) {
    auto expression = parse_expression(text);
    if (!expression) return expression.error();
    const auto infos = infos_of(surfaces);
    const auto labels = unique_labels(infos);
    Question question{std::move(*expression), std::vector<std::uint32_t>(surfaces.size(), no_index),
                      rule};
    for (std::uint32_t k = 0; k < question.expression.operands.size(); ++k) {
        const std::string& name = question.expression.operands[k];
        const auto called = surfaces_called(name, infos, labels);
        if (called.empty())
            return Error{ErrorCode::bad_option, not_called("surface", name, labels), "expression"};
        for (const std::uint32_t s : called) {
            if (question.operand_of[s] != no_index)
                return Error{ErrorCode::bad_option,
                             "names one surface in two ways, \"" +
                                 question.expression.operands[question.operand_of[s]] +
                                 "\" and \"" + name + "\"",
                             "expression"};
            question.operand_of[s] = k;
        }
    }
    if (question.expression.value([](std::uint32_t) { return false; }))
        return Error{ErrorCode::bad_option,
                     "the region has no end: all that is outside of the surfaces is in it",
                     "expression"};
    return question;
}

/// Tells for each volume whether it is in the region. Errors: not_closed.
Result<std::vector<bool>> volumes_inside(const Arrangement& exact, const Volumes& volumes,
                                         const Question& question) {
    const auto windings =
        find_windings(exact, volumes, {question.operand_of, question.expression.operands});
    if (!windings) return windings.error();
    std::vector<bool> inside;
    for (std::size_t v = 0; v < volumes.measures.size(); ++v)
        inside.push_back(question.expression.value(
            [&](std::uint32_t k) { return is_inside((*windings)[v][k], question.rule); }));
    return inside;
}

/// Numbers the parts of the region and counts its cavities. Parts are joined through triangles with the
/// region on both sides.
std::vector<std::uint32_t> number_pieces(const Volumes& volumes, const std::vector<bool>& inside,
                                         SelectedRegion& region) {
    DisjointSets parts(inside.size());
    for (const auto& [front, behind] : volumes.of_sides)
        if (inside[front] == inside[behind]) parts.join(front, behind);
    std::vector<std::uint32_t> piece(inside.size(), 0);
    for (std::uint32_t v = 1; v < inside.size(); ++v) {
        const std::uint32_t first = parts.find(v); // the lowest of its part
        if (inside[v])
            piece[v] = first == v ? ++region.pieces : piece[first];
        else if (first == v)
            ++region.cavities;
    }
    return piece;
}

/// Restricts an arrangement to the boundary of the region.
Result<SelectedRegion> region_in(Arrangement exact, const Question& question, const Run& run) {
    const auto volumes = volumes::find_unmeasured(exact, run);
    if (!volumes) return volumes.error();
    const auto inside = volumes_inside(exact, *volumes, question);
    if (!inside) return inside.error();
    SelectedRegion region;
    const auto piece = number_pieces(*volumes, *inside, region);
    std::vector<bool> keep(exact.triangles.size());
    for (std::size_t t = 0; t < keep.size(); ++t) {
        const auto [front, behind] = volumes->of_sides[t];
        keep[t] = (*inside)[front] != (*inside)[behind];
        if (keep[t]) region.of_sides.push_back({piece[front], piece[behind]});
    }
    region.boundary = restricted(std::move(exact), keep);
    return region;
}

/// Does the same so that rounding, if it moves the surfaces, selects the same region of them again.
Result<SelectedRegion> repeatable_region(Arrangement exact, const Question& question,
                                         const Run& run) {
    auto region = region_in(std::move(exact), question, run);
    if (!region || region->boundary.state->whole) return region;
    ExactState& state = own_state(region->boundary);
    state.measures = false;
    state.restrict_again = [question](Arrangement moved, const Run& inner) -> Result<Arrangement> {
        auto again = region_in(std::move(moved), question, inner);
        if (!again) return again.error();
        return std::move(again->boundary);
    };
    return region;
}

void measure(const SelectedRegion& region, bool fractions, Selected& made) {
    Volumes volumes{region.of_sides, volumes::measure_volumes(region.boundary, region.of_sides,
                                                              region.pieces + std::size_t{1})};
    made.volume = volumes.measures[0];
    for (std::uint32_t p = 0; p < region.pieces; ++p)
        made.pieces.push_back({volumes.measures[p + std::size_t{1}]});
    if (!fractions) return;
    auto exact = exact_volumes(region.boundary, volumes);
    made.exact_volume = std::move(exact.total);
    for (std::uint32_t p = 0; p < region.pieces; ++p)
        made.pieces[p].exact_volume = std::move(exact.measures[p + std::size_t{1}]);
}

/// Returns the surfaces of the expression; the others without triangles, so that all keep their numbers.
std::vector<Surface> surfaces_of(std::span<const Surface> surfaces, const Question& question) {
    std::vector<Surface> operands;
    for (std::size_t s = 0; s < surfaces.size(); ++s)
        operands.push_back(question.operand_of[s] != no_index
                               ? surfaces[s]
                               : Surface{surfaces[s].name, surfaces[s].role, {}, {}});
    return operands;
}

/// Counts parents through all surfaces, not only through those of the expression.
void count_through_all(std::span<const Surface> surfaces, const Question& question,
                       const InputTriangles& counted, Mesh& mesh) {
    std::vector<std::uint32_t> left_out{0}; // per surface: triangles of those before that are
    for (std::size_t s = 0; s < surfaces.size(); ++s)
        left_out.push_back(left_out.back() +
                           (question.operand_of[s] == no_index
                                ? static_cast<std::uint32_t>(surfaces[s].triangles.size())
                                : 0));
    for (std::uint32_t& p : mesh.parents_of.values)
        p += left_out[counted.surface_of(InputTriangleId(p))];
}

/// Rounds the boundary and turns its triangles outwards.
Status round_boundary(const SelectedRegion& region, const SelectOptions& options, const Run& run,
                      Selected& made) {
    const BoundaryFacets facets(region);
    auto rounded = round_to_doubles(region.boundary, options.rounding, run);
    if (!rounded && rounded.error().code == ErrorCode::nothing_to_do) {
        made.rounding.clean = true; // all of it was too thin for doubles
        return Done{};
    }
    if (!rounded) return rounded.error();
    made.rounding = std::move(rounded->report);
    auto turned = oriented(*rounded->mesh, facets, run);
    if (!turned) return turned.error();
    made.mesh = std::move(turned->mesh);
    made.piece_of = std::move(turned->piece_of);
    for (const std::uint32_t p : made.piece_of) ++made.pieces[p].triangles;
    return Done{};
}

Result<Selected> selected(std::span<const Surface> surfaces, const Question& question,
                          const SelectOptions& options, const Run& run) {
    StageTimer timer(run, "select");
    auto exact = arrange(surfaces_of(surfaces, question), options.arrange, timer.inside());
    if (!exact) return exact.error();
    Selected made;
    made.arrangement = exact->statistics;
    const InputTriangles counted = exact->inputs;
    auto region = repeatable_region(std::move(*exact), question, timer.inside());
    if (!region) return region.error();
    measure(*region, options.fractions, made);
    made.cavities = region->cavities;
    if (region->of_sides.empty())
        made.rounding.clean = true;
    else if (auto done = round_boundary(*region, options, timer.inside(), made); !done)
        return done.error();
    made.mesh.surfaces = infos_of(surfaces);
    count_through_all(surfaces, question, counted, made.mesh);
    return made;
}

} // namespace

std::string_view name_of(InsideRule rule) {
    return rule_names[static_cast<std::size_t>(rule)];
}

std::optional<InsideRule> inside_rule_named(std::string_view name) {
    const auto found = std::ranges::find(rule_names, name);
    if (found == rule_names.end()) return std::nullopt;
    return static_cast<InsideRule>(found - rule_names.begin());
}

Mesh Selected::piece(std::uint32_t number) const {
    std::vector<bool> keep;
    for (const std::uint32_t p : piece_of) keep.push_back(p == number);
    return selection::part_of(mesh, keep);
}

Result<Selected> select(std::span<const Surface> surfaces, std::string_view expression,
                        const SelectOptions& options, const Run& run) {
    return guarded("for the selection", "select", [&]() -> Result<Selected> {
        if (const auto valid = validate(surfaces); !valid) return valid.error();
        const auto question = question_of(surfaces, expression, options.rule);
        if (!question) return question.error();
        return selected(surfaces, *question, options, run);
    });
}

} // namespace terrane
