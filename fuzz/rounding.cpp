// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: the rounded mesh of an arrangement is conforming by the rationals of the verifier, or
// is refused; its moves, deviation, parents, edges and regions are as stated; a conforming mesh is
// its own arrangement. This holds for one round of snapping and for none as well, where meshes are
// refused more often.
#include "property.hpp"

#include "support/soup_laws.hpp"

namespace terrane::fuzz {

Soup input(Bytes& bytes) {
    return fuzzing::soup(bytes, 14);
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
