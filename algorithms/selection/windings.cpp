// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/windings.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <limits>
#include <optional>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

/// A change of the winding number of one operand.
struct Step {
    std::uint32_t operand;
    int by;
};

/// Returns per triangle how winding numbers change from its front to its back.
IndexLists<Step> steps_of(const Arrangement& exact, const Operands& operands) {
    IndexLists<Step> steps;
    std::vector<Step> own;
    const PointStore& points = exact.state->points;
    for (std::uint32_t t = 0; t < exact.triangles.size(); ++t) {
        const auto parents = exact.parents_of[t];
        const auto operand_of = [&](std::uint32_t parent) {
            return operands.of_surface[exact.inputs.surface_of(InputTriangleId(parent))];
        };
        if (parents.size() == 1) {
            const std::uint32_t k = operand_of(parents[0]);
            if (k != no_index) steps.values.push_back({k, 1});
            steps.close();
            continue;
        }
        own.clear();
        const Triangle& p = exact.input_corners()[parents[0]];
        const Axis axis =
            projection_axis(points.input(p[0]), points.input(p[1]), points.input(p[2]));
        const Sign front =
            turn_of(exact, parents[0], axis); // the triangle is wound as its first parent
        for (const std::uint32_t parent : parents) {
            const std::uint32_t k = operand_of(parent);
            if (k == no_index) continue;
            const int by = turn_of(exact, parent, axis) == front ? 1 : -1;
            const auto at = std::ranges::find(own, k, &Step::operand);
            if (at == own.end())
                own.push_back({k, by});
            else
                at->by += by;
        }
        steps.push_back(own);
    }
    return steps;
}

/// Calls visit(low, high, is_open) for the edges at which the triangles of an operand do not cancel out; is_open:
/// whether their number is odd.
template <class Visit>
void for_unbalanced(const Arrangement& exact, const IndexLists<Step>& steps, std::uint32_t operand,
                    const Visit& visit) {
    const EdgeSides edges = group_edges(exact.triangles, exact.vertices.size());
    edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
        int sum = 0, count = 0;
        for (const auto& side : sides)
            for (const Step& step : steps[side.triangle]) {
                if (step.operand != operand) continue;
                sum += runs_along(exact.triangles[side.triangle], low, high) ? step.by : -step.by;
                count += std::abs(step.by);
            }
        if (sum != 0) visit(low, high, count % 2 == 1);
    });
}

/// Says why an operand bounds no solid, by the edges at which its triangles do not cancel out.
Error not_closed(const Arrangement& exact, const IndexLists<Step>& steps, std::uint32_t operand,
                 const std::string& name) {
    std::size_t open = 0, turned = 0;
    std::optional<Point3> first_open, first_turned;
    for_unbalanced(exact, steps, operand, [&](std::uint32_t low, std::uint32_t high, bool is_open) {
        const Point3 place = std::min(exact.nearest(VertexId(low)), exact.nearest(VertexId(high)));
        ++(is_open ? open : turned);
        auto& first = is_open ? first_open : first_turned;
        first = first ? std::min(*first, place) : place;
    });
    const auto edges_of = [](std::size_t n) {
        return std::to_string(n) + (n == 1 ? " edge" : " edges");
    };
    std::string sentence = "bounds no solid: ";
    if (open > 0)
        sentence +=
            "it is not closed along " + edges_of(open) + ", first at " + place_text(*first_open);
    if (turned > 0)
        sentence += std::string(open > 0 ? ", and " : "") + "triangles face different ways at " +
                    edges_of(turned) + ", first at " + place_text(*first_turned);
    return {ErrorCode::not_closed, sentence, name};
}

/// Spreads winding numbers from the outside over all volumes.
class Spreading {
public:
    Spreading(const Volumes& volumes, const IndexLists<Step>& steps, std::size_t operands) :
        volumes_(volumes), steps_(steps), windings_(volumes.measures.size(), operands),
        known_(volumes.measures.size()) {
        known_[0] = true;
        reach();
    }

    /// Returns an operand whose number would depend on the way, or no_index.
    [[nodiscard]] std::uint32_t inconsistent() const {
        for (std::uint32_t t = 0; t < steps_.size(); ++t) {
            const auto [front, behind] = volumes_.of_sides[t];
            const auto before = windings_[front], after = windings_[behind];
            const auto change = [&](std::uint32_t k) {
                const auto own = steps_[t];
                const auto at = std::ranges::find(own, k, &Step::operand);
                return at == own.end() ? 0 : at->by;
            };
            for (std::uint32_t k = 0; k < before.size(); ++k)
                if (after[k] - before[k] != change(k)) return k;
        }
        return no_index;
    }
    [[nodiscard]] Windings found() && { return std::move(windings_); }

private:
    void reach() {
        std::vector<std::uint32_t> keys, triangles;
        std::array<std::uint32_t, 2> last{}; // neighbouring triangles mostly follow each other
        for (std::uint32_t t = 0; t < steps_.size(); ++t) {
            const auto& sides = volumes_.of_sides[t];
            if (volumes_.dangles(t) || sides == last) continue;
            last = sides;
            for (const std::uint32_t volume : sides) {
                keys.push_back(volume);
                triangles.push_back(t);
            }
        }
        const auto around = lists_by_key<std::uint32_t>(
            known_.size(), keys, [&](std::size_t i) { return triangles[i]; });
        std::vector<std::uint32_t> open{0};
        while (!open.empty()) {
            const std::uint32_t volume = open.back();
            open.pop_back();
            for (const std::uint32_t t : around[volume]) cross(t, volume, open);
        }
    }

    void cross(std::uint32_t t, std::uint32_t volume, std::vector<std::uint32_t>& open) {
        const auto [front, behind] = volumes_.of_sides[t];
        const std::uint32_t other = volume == front ? behind : front;
        if (known_[other]) return;
        known_[other] = true;
        std::ranges::copy(windings_[volume], windings_[other].begin());
        for (const Step& step : steps_[t])
            windings_[other][step.operand] += volume == front ? step.by : -step.by;
        open.push_back(other);
    }

    const Volumes& volumes_;
    const IndexLists<Step>& steps_;
    Windings windings_;
    std::vector<bool> known_;
};

} // namespace

Sign turn_of(const Arrangement& exact, std::uint32_t input, Axis axis) {
    const Triangle& c = exact.input_corners()[input];
    const PointStore& points = exact.state->points;
    return orient2d(axis, points.input(c[0]), points.input(c[1]), points.input(c[2]));
}

Result<Windings> find_windings(const Arrangement& exact, const Volumes& volumes,
                               const Operands& operands) {
    const auto steps = steps_of(exact, operands);
    Spreading spreading(volumes, steps, operands.names.size());
    if (const std::uint32_t k = spreading.inconsistent(); k != no_index)
        return not_closed(exact, steps, k, operands.names[k]);
    return std::move(spreading).found();
}

bool is_open(const Arrangement& exact, const Operands& operands, std::uint32_t operand) {
    bool found = false;
    for_unbalanced(exact, steps_of(exact, operands), operand,
                   [&](std::uint32_t, std::uint32_t, bool is_open) { found = found || is_open; });
    return found;
}

} // namespace terrane
