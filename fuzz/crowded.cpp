// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: that of rounding.cpp, for up to 110 triangles of which very many are in one plane, at one
// line or at one vertex, which the library treats as a whole; and proven bounds decide as tests of
// all pairs do.
#include "property.hpp"

#include "support/soup_laws.hpp"

namespace terrane::fuzz {

Soup input(Bytes& bytes) {
    return fuzzing::crowd(bytes, 110);
}

std::string flaw(std::span<const Surface> input_surfaces) {
    const std::vector<Surface> surfaces(input_surfaces.begin(), input_surfaces.end());
    const auto made = arrange(surfaces);
    if (!made) return made.error().message();
    // Rounding tries many grids where all is within some hundred doubles, and rationals take a second
    // for that many triangles. Larger inputs cost too much for a fuzzer.
    constexpr std::size_t most_in_rationals = 500, most_in_doubles = 1500;
    const std::size_t size = made->triangles.size();
    if (size > most_in_doubles) return "";
    for (const unsigned rounds : {8U, 0U}) {
        const RoundingOptions quick{.max_rounds = rounds},
            slow{.max_rounds = rounds, .check = {PairCheck::full}};
        const auto by_bounds = round_to_doubles(made.value(), quick),
                   by_tests = round_to_doubles(made.value(), slow);
        if (by_bounds.has_value() != by_tests.has_value()) return "a full check fails, or does not";
        if (by_bounds && (by_bounds->report.clean != by_tests->report.clean ||
                          by_bounds->mesh->vertices != by_tests->mesh->vertices ||
                          by_bounds->mesh->triangles != by_tests->mesh->triangles))
            return "a full check changes the mesh";
        if (size > most_in_rationals) continue;
        if (auto what = soup_laws::rounding_flaw(surfaces, made.value(), quick); !what.empty())
            return what + ", with " + std::to_string(rounds) + " rounds";
    }
    return "";
}

} // namespace terrane::fuzz
