// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/sealing.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/sealing/border_extension.hpp>
#include <terrane/algorithms/sealing/detail/gap_distances.hpp>

namespace terrane {
namespace {

/// The constants that decide where there are breaks.
struct BreakConstants {
    double least_ratio = 3;     ///< of the widths at the ends of a break
    double least_margin = 1.05; ///< of the distance, as a multiple of the widest gap below
    double most_inside = .01;   ///< share of the length of all gaps that a break may hold
};
constexpr BreakConstants break_constants;

/// Returns the least number of the form 1, 2 or 5 times a power of ten in (low, high); their
/// geometric mean if there is none. Precondition: 0 < low < high.
double round_number_between(double low, double high) {
    const double decade = std::pow(10.0, std::floor(std::log10(low)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0})
        if (decade * factor > low && decade * factor < high) return decade * factor;
    return std::sqrt(low) * std::sqrt(high);
}

/// Returns the end of the break that begins behind gap i: the number of the first gap that is not
/// in it.
std::size_t end_of_break(std::span<const SurfaceGap> gaps, std::size_t i, double most) {
    double inside = 0;
    std::size_t end = i + 1;
    while (end < gaps.size() && inside + gaps[end].length <= most) inside += gaps[end++].length;
    return end;
}

} // namespace

Result<std::vector<SurfaceGap>> find_gaps(const Arrangement& arrangement, double widest,
                                          const Run& run) {
    return guarded("for the widths of gaps", "gaps", [&]() -> Result<std::vector<SurfaceGap>> {
        if (!(widest > 0) || !std::isfinite(widest))
            return Error{ErrorCode::bad_option, "the largest width must be positive", "seal"};
        const sealing::detail::GapDistances distances(arrangement,
                                                      sealing::detail::SealDistances(widest));
        std::vector<SurfaceGap> gaps;
        for (const BorderEdge& edge : open_border_edges(arrangement)) {
            if (run.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
            auto gap = distances.gap_at(edge);
            if (auto own = distances.own_gap_at(edge); own && (!gap || own->largest < gap->largest))
                gap = std::move(own);
            if (gap && gap->largest > 0)
                gaps.push_back(
                    {edge.surface, SurfaceId(gap->to), gap->length, gap->largest, gap->place});
        }
        std::sort(gaps.begin(), gaps.end(), [](const SurfaceGap& a, const SurfaceGap& b) {
            return std::tie(a.width, a.from, a.place, a.length) <
                   std::tie(b.width, b.from, b.place, b.length);
        });
        return gaps;
    });
}

std::vector<GapBreak> find_breaks(std::span<const SurfaceGap> gaps, double widest) {
    const StandardArithmetic guard;
    double all = 0;
    for (const SurfaceGap& gap : gaps) all += gap.length;
    std::vector<GapBreak> breaks;
    GapBreak next;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        ++next.gaps;
        next.length += gaps[i].length;
        const std::size_t end = end_of_break(gaps, i, break_constants.most_inside * all);
        const double low = gaps[i].width, high = end < gaps.size() ? gaps[end].width : widest;
        if (!(high >= break_constants.least_ratio * low)) continue;
        next.low = low;
        next.high = high;
        next.distance = round_number_between(break_constants.least_margin * low, high);
        breaks.push_back(next);
        next = {};
        for (++i; i < end; ++i) { // the few gaps inside belong to the next break
            ++next.gaps;
            next.length += gaps[i].length;
        }
        --i;
    }
    return breaks;
}

std::vector<NamedConstant> gap_constants() {
    return {{"least_ratio", break_constants.least_ratio},
            {"least_margin", break_constants.least_margin},
            {"most_inside", break_constants.most_inside}};
}

} // namespace terrane
