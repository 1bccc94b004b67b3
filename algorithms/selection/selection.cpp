// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/selection.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/selection/detail/oriented.hpp>
#include <terrane/algorithms/selection/detail/region.hpp>
#include <terrane/algorithms/selection/parsed.hpp>
#include <terrane/algorithms/volumes/exact_volumes.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

using selection::oriented;
using selection::Question;
using selection::question_of;
using selection::region_in;
using selection::SelectedRegion;
using selection::turn_as_open;

namespace {

constexpr std::array<std::string_view, 3> rule_names{"nonzero", "positive", "odd"};

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
        operands.push_back(question.names(s) ? surfaces[s]
                                             : Surface{surfaces[s].name, surfaces[s].role, {}, {}});
    return operands;
}

/// Counts parents through all surfaces, not only through those of the expression.
void count_through_all(std::span<const Surface> surfaces, const Question& question,
                       const InputTriangles& counted, Mesh& mesh) {
    std::vector<std::uint32_t> left_out{0}; // per surface: triangles of those before that are
    for (std::size_t s = 0; s < surfaces.size(); ++s)
        left_out.push_back(
            left_out.back() +
            (!question.names(s) ? static_cast<std::uint32_t>(surfaces[s].triangles.size()) : 0));
    for (std::uint32_t& p : mesh.parents_of.values)
        p += left_out[counted.surface_of(InputTriangleId(p))];
}

/// Rounds the boundary and turns its triangles outwards.
Status round_boundary(const SelectedRegion& region, const SelectOptions& options, const Run& run,
                      Selected& made) {
    auto rounded = round_to_doubles(region.boundary, options.rounding, run);
    if (!rounded && rounded.error().code == ErrorCode::nothing_to_do) {
        made.rounding.clean = true; // all of it was too thin for doubles
        return Done{};
    }
    if (!rounded) return rounded.error();
    if (made.is_surface) {
        made.mesh = rounded->mesh;
        turn_as_open(region, made.mesh);
        made.regions = rounded->regions.size();
        made.rounding = std::move(rounded->report);
        return Done{};
    }
    auto turned = oriented(*rounded, region, run);
    if (!turned) return turned.error();
    made.rounding = std::move(rounded->report);
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
    auto region = region_in(std::move(*exact), question, timer.inside());
    if (!region) return region.error();
    made.is_surface = !region->open.empty();
    if (!made.is_surface) measure(*region, options.fractions, made);
    made.cavities = region->cavities;
    if (region->boundary.triangles.empty())
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
        auto parsed = parse_expression(expression);
        if (!parsed) return parsed.error();
        return select_parsed(surfaces, std::move(*parsed), options, run);
    });
}

Result<Selected> select_parsed(std::span<const Surface> surfaces, Expression expression,
                               const SelectOptions& options, const Run& run) {
    return guarded("for the selection", "select", [&]() -> Result<Selected> {
        if (const auto valid = validate(surfaces); !valid) return valid.error();
        const auto question = question_of(surfaces, std::move(expression), options.rule);
        if (!question) return question.error();
        return selected(surfaces, *question, options, run);
    });
}

} // namespace terrane
