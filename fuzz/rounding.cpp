// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: the doubles of an arrangement are conforming for the verifier's rationals, or refused;
// moves, deviation, parents, edges and regions are what they are said to be; what is conforming is
// its own arrangement. Also with one round of snapping and with none, which are refused more often.
#include "property.hpp"
#include "shapes.hpp"

#include "support/soup_laws.hpp"

namespace terrane::fuzz {

std::vector<Surface> input(Bytes& bytes) {
    return soup(bytes, 14);
}

std::string flaw(std::span<const Surface> input_surfaces) {
    const std::vector<Surface> surfaces(input_surfaces.begin(), input_surfaces.end());
    const auto made = arrange(surfaces);
    if (!made) return made.error().message();
    for (const unsigned rounds : {8U, 1U, 0U})
        if (auto what = soup_laws::rounding_flaw(surfaces, made.value(), {.max_rounds = rounds});
            !what.empty())
            return what + ", with " + std::to_string(rounds) + " rounds";
    return "";
}

} // namespace terrane::fuzz
