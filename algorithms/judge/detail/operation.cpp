// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The boundary of a Boolean operation: winding numbers are spread from the outside, where all are 0,
// over the volumes of the arrangement of the operands.
#include <algorithm>
#include <ranges>
#include <utility>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/judge/detail/target.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::judging {
namespace {

using Windings = std::vector<int>; ///< per operand

bool is_inside(const Windings& windings, BooleanOperation operation) {
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

class Spreading {
public:
    Spreading(const Arrangement& exact, const Volumes& volumes,
              const std::vector<std::uint32_t>& operand_of, std::size_t operands) :
        exact_(exact),
        volumes_(volumes), operand_of_(operand_of), operands_(operands),
        windings_(volumes.measures.size()) {}

    /// Returns the winding numbers of each volume.
    Result<std::vector<Windings>> operator()() {
        std::vector<std::uint32_t> keys, triangles;
        for (std::uint32_t t = 0; t < exact_.triangles.size(); ++t)
            for (const std::uint32_t volume : volumes_.of_sides[t]) {
                keys.push_back(volume);
                triangles.push_back(t);
            }
        const auto around = lists_by_key<std::uint32_t>(
            windings_.size(), keys, [&](std::size_t i) { return triangles[i]; });
        windings_[0].assign(operands_, 0);
        std::vector<std::uint32_t> open{0};
        while (!open.empty()) {
            const std::uint32_t volume = open.back();
            open.pop_back();
            for (const std::uint32_t t : around[volume])
                if (const std::uint32_t wrong = cross(t, volume, open); wrong != no_index)
                    return Error{ErrorCode::not_closed,
                                 "bounds no solid: it is not closed, or its triangles face "
                                 "different ways",
                                 "operand " + std::to_string(wrong + 1)};
        }
        return std::move(windings_);
    }

private:
    /// Steps from a volume over a triangle. Returns an operand whose winding number would depend on the
    /// way, or no_index.
    std::uint32_t cross(std::uint32_t t, std::uint32_t volume, std::vector<std::uint32_t>& open) {
        const auto [front, behind] = volumes_.of_sides[t];
        const Windings change = steps(t); // from front to behind
        const std::uint32_t other = volume == front ? behind : front;
        const int direction = volume == front ? 1 : -1;
        Windings next = windings_[volume];
        for (std::size_t k = 0; k < operands_; ++k) next[k] += direction * change[k];
        if (windings_[other].empty()) {
            windings_[other] = std::move(next);
            open.push_back(other);
            return no_index;
        }
        const auto differs = std::ranges::mismatch(windings_[other], next);
        return differs.in1 == windings_[other].end()
                   ? no_index
                   : static_cast<std::uint32_t>(differs.in1 - windings_[other].begin());
    }

    [[nodiscard]] Windings steps(std::uint32_t t) const {
        Windings change(operands_, 0);
        const auto parents = exact_.parents_of[t];
        const Triangle& p = exact_.input_corners()[parents[0]];
        const PointStore& points = exact_.state->points;
        const Axis axis =
            projection_axis(points.input(p[0]), points.input(p[1]), points.input(p[2]));
        const Sign own =
            turn_of(exact_, parents[0], axis); // the triangle is wound as its first parent
        for (const std::uint32_t parent : parents)
            change[operand_of_[exact_.inputs.surface_of(InputTriangleId(parent))]] +=
                turn_of(exact_, parent, axis) == own ? 1 : -1;
        return change;
    }

    const Arrangement& exact_;
    const Volumes& volumes_;
    const std::vector<std::uint32_t>& operand_of_;
    std::size_t operands_;
    std::vector<Windings> windings_;
};

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
    const auto windings = Spreading(exact, *volumes, *operands, count)();
    if (!windings) return windings.error();
    std::vector<bool> inside;
    Target target{exact, {}, {}, true};
    for (std::size_t v = 0; v < windings->size(); ++v) {
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
