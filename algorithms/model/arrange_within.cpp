// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/arrange_within.hpp>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <string_view>
#include <utility>

namespace terrane {
namespace {

void announce(const Run& run, std::string_view stage) {
    if (run.progress) run.progress(stage, 0);
}

Status extend(std::span<const std::uint32_t> boundary, const ArrangeWithinOptions& options,
              const Run& run, Arranged& arranged) {
    announce(run, "extend");
    auto extended = extend_to_boundary(std::move(arranged.surfaces), boundary,
                                       {options.extend, options.arrange}, run);
    if (!extended) return extended.error();
    arranged.surfaces = std::move(extended->surfaces);
    arranged.extended = std::move(extended->borders);
    return Done{};
}

Result<Arrangement> arrange_or_seal(const ArrangeWithinOptions& options, const Run& run,
                                    Arranged& arranged) {
    if (options.seal == 0) {
        announce(run, "arrange");
        return arrange(arranged.surfaces, options.arrange, run);
    }
    announce(run, "seal");
    auto sealed = seal(std::move(arranged.surfaces), {options.seal, options.arrange}, run);
    if (!sealed) return sealed.error();
    arranged.surfaces = std::move(sealed->surfaces);
    arranged.sealed = SealReport{options.seal, std::move(sealed->changes), sealed->left};
    return std::move(sealed->arrangement);
}

} // namespace

Result<Arranged> arrange_within(std::vector<Surface> surfaces, std::vector<Surface> boundary,
                                const ArrangeWithinOptions& options, const Run& run) {
    std::vector<std::uint32_t> sides(boundary.size()); // indices of the boundary's surfaces
    std::iota(sides.begin(), sides.end(), static_cast<std::uint32_t>(surfaces.size()));
    Arranged arranged;
    arranged.surfaces = std::move(surfaces);
    std::move(boundary.begin(), boundary.end(), std::back_inserter(arranged.surfaces));
    if (options.extend != 0 || options.seal != 0)
        for (std::size_t s = 0; s + sides.size() < arranged.surfaces.size(); ++s)
            arranged.growth.push_back({arranged.surfaces[s].triangles.size()});
    if (options.extend != 0)
        if (auto done = extend(sides, options, run, arranged); !done) return done.error();
    for (std::size_t s = 0; s < arranged.growth.size(); ++s)
        arranged.growth[s].extended = arranged.surfaces[s].triangles.size();
    auto exact = arrange_or_seal(options, run, arranged);
    if (!exact) return exact.error();
    if (sides.empty()) {
        arranged.exact = std::move(*exact);
    } else {
        announce(run, "volume of interest");
        auto cut = cut_to_volume(std::move(*exact), sides, run);
        if (!cut) return cut.error();
        arranged.exact = std::move(cut->arrangement);
        arranged.cut = std::move(cut->report);
    }
    announce(run, "round");
    auto rounded = round_to_doubles(arranged.exact, options.rounding, run);
    if (!rounded) return rounded.error();
    arranged.rounded = std::move(*rounded);
    return arranged;
}

} // namespace terrane
