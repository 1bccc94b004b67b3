// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/arrange_within.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/model/known_arrange_within.hpp>
#include <terrane/algorithms/sealing/known_sealing.hpp>
#include <terrane/algorithms/volume_of_interest/known_extension.hpp>

namespace terrane {
namespace {

void announce(const Run& run, std::string_view stage) {
    if (run.progress) run.progress(stage, 0);
}

Status extend(std::span<const std::uint32_t> boundary, const ArrangeWithinOptions& options,
              KnownTriangles& known, const Run& run, Arranged& arranged) {
    announce(run, "extend");
    auto extended = extend_to_boundary(std::move(arranged.surfaces), boundary,
                                       {options.extend, options.arrange}, known, run);
    if (!extended) return extended.error();
    arranged.surfaces = std::move(extended->surfaces);
    arranged.extended = std::move(extended->borders);
    return Done{};
}

/// Tells whether gaps of any surface are closed.
bool seals(const ArrangeWithinOptions& options) {
    return options.seal != 0 || std::ranges::any_of(options.seal_rules, [](const SealRule& r) {
               return r.distance > 0;
           });
}

/// Joins what is nearer than the tolerance.
Status join(const ArrangeWithinOptions& options, const Run& run, std::vector<Surface>& surfaces,
            Arranged& arranged) {
    announce(run, "tolerance");
    auto joined = join_within(std::move(surfaces),
                              {options.tolerance, options.arrange, options.rounding}, run);
    if (!joined) return joined.error();
    surfaces = std::move(joined->surfaces);
    arranged.joined = std::move(joined->report);
    return Done{};
}

Result<Arrangement> arrange_or_seal(const ArrangeWithinOptions& options, KnownTriangles* known,
                                    const Run& run, Arranged& arranged) {
    if (!seals(options)) {
        announce(run, "arrange");
        return known != nullptr ? arrange(arranged.surfaces, options.arrange, *known, run)
                                : arrange(arranged.surfaces, options.arrange, run);
    }
    announce(run, "seal");
    auto sealed = seal(std::move(arranged.surfaces),
                       {options.seal, options.arrange, options.seal_rules}, *known, run);
    if (!sealed) return sealed.error();
    arranged.surfaces = std::move(sealed->surfaces);
    arranged.sealed = SealReport{.distance = options.seal,
                                 .rules = options.seal_rules,
                                 .changes = std::move(sealed->changes),
                                 .closed = std::move(sealed->closed),
                                 .open = std::move(sealed->open),
                                 .left = sealed->left};
    return std::move(sealed->arrangement);
}

/// Removes what is outside of the volume of interest, then small blocks.
Status restrict_to(std::span<const std::uint32_t> sides, const ArrangeWithinOptions& options,
                   const Run& run, Arranged& arranged) {
    if (!sides.empty()) {
        announce(run, "volume of interest");
        auto cut = cut_to_volume(std::move(arranged.exact), sides, run);
        if (!cut) return cut.error();
        arranged.exact = std::move(cut->arrangement);
        arranged.cut = std::move(cut->report);
    }
    if (options.min_volume != 0) {
        announce(run, "small blocks");
        auto without = merge_small_blocks(std::move(arranged.exact), options.min_volume, run);
        if (!without) return without.error();
        arranged.exact = std::move(without->arrangement);
        arranged.merged = std::move(without->report);
    }
    return Done{};
}

/// Gaps wider than this share of the median edge length count as meant: a modeller who picks a
/// surface at points so far apart does not place its border more exactly.
constexpr double widest_gap = 0.2;
/// Gaps are measured up to this multiple of the widest one, so that a break just below that is
/// seen.
constexpr double break_beyond = 4;

Result<Arranged> arrange_exactly(std::vector<Surface> surfaces, std::vector<Surface> boundary,
                                 ArrangeWithinOptions options, KnownTriangles* known,
                                 const Run& run);

/// Does what choose_seal() does.
Result<SealChoice> seal_chosen(const std::vector<Surface>& surfaces,
                               const std::vector<Surface>& boundary,
                               const ArrangeWithinOptions& options, KnownTriangles* known,
                               const Run& run) {
    return guarded("for the widths of gaps", "seal", [&]() -> Result<SealChoice> {
        ArrangeWithinOptions unsealed = options;
        unsealed.tolerance = unsealed.seal = unsealed.min_volume = 0;
        unsealed.seal_automatic = false;
        unsealed.seal_rules.clear();
        const double edge_length = median_edge_length(surfaces);
        if (!(edge_length > 0)) return SealChoice{};
        const auto arranged = arrange_exactly(surfaces, boundary, unsealed, known, run);
        if (!arranged) return arranged.error();
        return choose_seal(arranged->exact, edge_length, run);
    });
}

Result<Arranged> arrange_exactly(std::vector<Surface> surfaces, std::vector<Surface> boundary,
                                 ArrangeWithinOptions options, KnownTriangles* known,
                                 const Run& run) {
    return guarded("for the arrangement", "arrange", [&]() -> Result<Arranged> {
        Arranged arranged;
        if (options.tolerance != 0) {
            if (auto done = join(options, run, surfaces, arranged); !done) return done.error();
            if (!seals(options) && !options.seal_automatic) options.seal = options.tolerance;
        }
        KnownTriangles own; // of the surfaces, which all arrangements below have in common
        const bool arranges_again = options.seal_automatic || options.extend != 0 || seals(options);
        if (arranges_again && known == nullptr) known = &own;
        if (options.seal_automatic) {
            auto choice = seal_chosen(surfaces, boundary, options, known, run);
            if (!choice) return choice.error();
            options.seal = choice->distance;
            arranged.choice = std::move(*choice);
        }
        std::vector<std::uint32_t> sides(boundary.size()); // indices of the boundary's surfaces
        std::iota(sides.begin(), sides.end(), static_cast<std::uint32_t>(surfaces.size()));
        arranged.boundary_count = boundary.size();
        arranged.surfaces = std::move(surfaces);
        std::move(boundary.begin(), boundary.end(), std::back_inserter(arranged.surfaces));
        if (options.extend != 0 || seals(options))
            for (std::size_t s = 0; s + sides.size() < arranged.surfaces.size(); ++s)
                arranged.growth.push_back({arranged.surfaces[s].triangles.size()});
        if (options.extend != 0)
            if (auto done = extend(sides, options, *known, run, arranged); !done)
                return done.error();
        for (std::size_t s = 0; s < arranged.growth.size(); ++s)
            arranged.growth[s].extended = arranged.surfaces[s].triangles.size();
        auto exact = arrange_or_seal(options, known, run, arranged);
        if (!exact) return exact.error();
        arranged.exact = std::move(*exact);
        if (auto done = restrict_to(sides, options, run, arranged); !done) return done.error();
        return arranged;
    });
}

Result<Arranged> arranged_and_rounded(std::vector<Surface> surfaces, std::vector<Surface> boundary,
                                      const ArrangeWithinOptions& options, KnownTriangles* known,
                                      const Run& run) {
    return guarded("for the arrangement", "arrange", [&]() -> Result<Arranged> {
        auto arranged =
            arrange_exactly(std::move(surfaces), std::move(boundary), options, known, run);
        if (!arranged) return arranged;
        announce(run, "round");
        auto rounded = round_to_doubles(arranged->exact, options.rounding, run);
        if (!rounded) return rounded.error();
        arranged->rounded = std::move(*rounded);
        return arranged;
    });
}

} // namespace

Result<SealChoice> choose_seal(const std::vector<Surface>& surfaces,
                               const std::vector<Surface>& boundary,
                               const ArrangeWithinOptions& options, const Run& run) {
    return seal_chosen(surfaces, boundary, options, nullptr, run);
}

Result<SealChoice> choose_seal(const Arrangement& arrangement, double edge_length, const Run& run) {
    return guarded("for the widths of gaps", "seal", [&]() -> Result<SealChoice> {
        SealChoice choice{.edge_length = edge_length, .widest = widest_gap * edge_length};
        auto gaps = find_gaps(arrangement, break_beyond * choice.widest, run);
        if (!gaps) return gaps.error();
        choice.breaks = find_breaks(*gaps, break_beyond * choice.widest);
        std::erase_if(choice.breaks, [&](const GapBreak& b) { return b.low > choice.widest; });
        if (!choice.breaks.empty()) choice.distance = choice.breaks.back().distance;
        choice.gaps = std::move(*gaps);
        return choice;
    });
}

std::vector<NamedConstant> seal_choice_constants() {
    auto constants = gap_constants();
    constants.push_back({"widest_gap", widest_gap});
    constants.push_back({"break_beyond", break_beyond});
    return constants;
}

Result<Arranged> arrange_exactly_within(std::vector<Surface> surfaces,
                                        std::vector<Surface> boundary,
                                        const ArrangeWithinOptions& options, const Run& run) {
    return arrange_exactly(std::move(surfaces), std::move(boundary), options, nullptr, run);
}

Result<Arranged> arrange_within(std::vector<Surface> surfaces, std::vector<Surface> boundary,
                                const ArrangeWithinOptions& options, const Run& run) {
    return arranged_and_rounded(std::move(surfaces), std::move(boundary), options, nullptr, run);
}

Result<Arranged> arrange_within(std::vector<Surface> surfaces, std::vector<Surface> boundary,
                                const ArrangeWithinOptions& options, KnownTriangles& known,
                                const Run& run) {
    return arranged_and_rounded(std::move(surfaces), std::move(boundary), options, &known, run);
}

} // namespace terrane
