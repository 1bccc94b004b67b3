// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/plausibility/plausibility.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/plausibility/detail/examination.hpp>
#include <terrane/algorithms/plausibility/detail/thresholds.hpp>

namespace terrane {

namespace plausibility::detail {

Examination::Examination(std::span<const Surface> examined, const PlausibilityContext& use) :
    surfaces(examined), context(use), labels(unique_labels(infos_of(examined))) {
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        extents.push_back(extent_of(surfaces[s]));
        if (!extents.back().empty()) used.push_back(s);
    }
}

void Examination::warn(Doubt doubt, const std::vector<std::uint32_t>& about, std::string seen,
                       std::string why, std::string answer) {
    PlausibilityWarning& warning = warnings.emplace_back();
    warning.doubt = doubt;
    for (const auto s : about) warning.surfaces.emplace_back(s);
    warning.seen = std::move(seen);
    warning.why = std::move(why);
    warning.answer = std::move(answer);
}

std::string Examination::names(const std::vector<std::uint32_t>& about) const {
    constexpr std::size_t most = 3;
    const std::size_t named = about.size() <= most + 1 ? about.size() : most;
    std::string text;
    for (std::size_t i = 0; i < named; ++i) {
        const bool last = i + 1 == about.size();
        text += (i == 0 ? "" : last ? " and " : ", ") + labels[about[i]];
    }
    return named == about.size() ? text : fmt::format("{} and {} more", text, about.size() - named);
}

namespace {

/// Warnings of one kind that are told one by one; the others are told together.
constexpr std::size_t most_of_a_kind = 20;

/// Makes one of all warnings of a kind that are too many.
std::vector<PlausibilityWarning> summed_up(std::vector<PlausibilityWarning> all) {
    std::vector<PlausibilityWarning> told;
    for (std::size_t i = 0, count = 0, more = 0; i < all.size(); ++i) {
        const bool first = i == 0 || all[i].doubt != all[i - 1].doubt;
        count = first ? 1 : count + 1;
        if (count <= most_of_a_kind + 1) {
            told.push_back(std::move(all[i]));
            more = 1;
            continue;
        }
        PlausibilityWarning& rest = told.back();
        rest.surfaces.insert(rest.surfaces.end(), all[i].surfaces.begin(), all[i].surfaces.end());
        rest.seen = fmt::format("the same is seen in {} more places", ++more);
    }
    for (PlausibilityWarning& warning : told) std::ranges::sort(warning.surfaces);
    return told;
}

} // namespace

} // namespace plausibility::detail

std::string_view name_of(Doubt doubt) {
    switch (doubt) {
    case Doubt::heights_mixed:
        return "heights_mixed";
    case Doubt::depths_unstated:
        return "depths_unstated";
    case Doubt::far_apart:
        return "far_apart";
    case Doubt::units_mixed:
        return "units_mixed";
    case Doubt::systems_mixed:
        return "systems_mixed";
    case Doubt::volume_without_data:
        return "volume_without_data";
    case Doubt::no_top:
        return "no_top";
    case Doubt::no_base:
        return "no_base";
    case Doubt::float32:
        return "float32";
    case Doubt::values_left_out:
        return "values_left_out";
    case Doubt::flawed_faces:
        return "flawed_faces";
    case Doubt::duplicate_surface:
        return "duplicate_surface";
    case Doubt::no_block:
        return "no_block";
    case Doubt::horizons_cross:
        return "horizons_cross";
    }
    return "unknown";
}

std::vector<PlausibilityWarning> find_doubts(std::span<const Surface> surfaces,
                                             const PlausibilityContext& context) {
    const StandardArithmetic guard;
    using namespace plausibility::detail;
    Examination examination(surfaces, context);
    check_heights(examination);
    check_unstated_depths(examination);
    check_distances(examination);
    check_units(examination);
    check_systems(examination);
    check_volume(examination);
    check_top_and_base(examination);
    check_float32(examination);
    check_values(examination);
    check_faces(examination);
    check_duplicates(examination);
    return summed_up(std::move(examination.warnings));
}

std::vector<NamedConstant> plausibility_constants() {
    return plausibility::detail::thresholds.listed();
}

} // namespace terrane
