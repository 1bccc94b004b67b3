// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_places of rounded_parts.hpp.
#include <algorithm>
#include <set>

#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/rounded_parts.hpp>

namespace terrane::verifier {

std::size_t check_places(const ExactMesh& exact, const ExactMesh& doubles, Violations& found) {
    const auto before = facing_sides(exact), after = facing_sides(doubles);
    std::set<Edge> turned;
    for (std::size_t i = 0; i < before.size(); ++i)
        if (before[i] != after[i]) turned.insert(before[i].edge);
    const Shells shells = find_shells(exact), there = find_shells(doubles);
    const Nesting nesting = find_nesting(exact, shells), nested = find_nesting(doubles, there);
    // Returns the same shell of the doubles, or none if it has other sides.
    const auto same = [&](std::uint32_t s) {
        const std::uint32_t t = s == no_number ? s : there.of_side[shells.sides_of[s].front()];
        return t == no_number || there.sides_of[t] == shells.sides_of[s] ? t : no_number;
    };
    for (std::uint32_t s = 0; s < shells.sides_of.size(); ++s) {
        const std::uint32_t t = same(s), around = nesting.around[s];
        if (t == no_number || (around != no_number && same(around) == no_number)) continue;
        if (nesting.outermost[s] == nested.outermost[t] && same(around) == nested.around[t])
            continue;
        const std::uint32_t triangle = shells.sides_of[s].front() / 2;
        found.push_back(
            {Rule::R38_places,
             {triangle},
             "triangle " + text(triangle) +
                 " bounds another block, or from another side, than in the exact part"});
    }
    return turned.size();
}

} // namespace terrane::verifier
