// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The boundary of a Boolean operation, by the winding numbers of its operands.
#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include <terrane/algorithms/judge/detail/target.hpp>
#include <terrane/algorithms/selection/windings.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::judging {
namespace {

bool is_inside(std::span<const int> windings, BooleanOperation operation) {
    const auto within = [](int w) { return w != 0; };
    const auto count = std::ranges::count_if(windings, within);
    switch (operation) {
    case BooleanOperation::unite:
        return count > 0;
    case BooleanOperation::intersect:
        return std::cmp_equal(count, windings.size());
    case BooleanOperation::subtract:
        return count == 1 && within(windings[0]);
    case BooleanOperation::exclude:
        return count % 2 == 1;
    }
    return false;
}

/// Returns the operand of each surface. Errors: bad_option.
Result<std::vector<std::uint32_t>> operands_of(const Arrangement& exact,
                                               const JudgeOptions& options) {
    std::vector<std::uint32_t> operands = options.operand_of;
    if (operands.empty())
        for (std::uint32_t s = 0; s < exact.surfaces.size(); ++s) operands.push_back(s);
    if (operands.size() != exact.surfaces.size())
        return Error{ErrorCode::bad_option, "must have an operand for each surface", "operand_of"};
    auto used = operands;
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (!used.empty() && used.back() != used.size() - 1)
        return Error{ErrorCode::bad_option, "must count operands from 0 without gaps",
                     "operand_of"};
    return operands;
}

} // namespace

Result<Target> boundary_of(const Arrangement& exact, const JudgeOptions& options, const Run& run) {
    const auto operands = operands_of(exact, options);
    if (!operands) return operands.error();
    const auto volumes = find_volumes(exact, run);
    if (!volumes) return volumes.error();
    const std::size_t count =
        operands->empty() ? 0 : std::size_t{*std::ranges::max_element(*operands)} + 1;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < count; ++k) names.push_back("operand " + std::to_string(k + 1));
    const auto windings = find_windings(exact, *volumes, {*operands, names});
    if (!windings) return windings.error();
    std::vector<bool> inside;
    Target target{exact, {}, {}, true};
    for (std::size_t v = 0; v < volumes->measures.size(); ++v) {
        inside.push_back(is_inside((*windings)[v], *options.operation));
        if (inside.back()) target.volume += volumes->measures[v];
    }
    for (std::uint32_t t = 0; t < exact.triangles.size(); ++t) {
        const auto [front, behind] = volumes->of_sides[t];
        if (inside[front] == inside[behind]) continue;
        const auto [a, b, c] = exact.triangles[t];
        target.triangles.push_back(inside[behind] ? Triangle{a, b, c} : Triangle{a, c, b});
        target.source.push_back(t);
    }
    return target;
}

} // namespace terrane::judging
