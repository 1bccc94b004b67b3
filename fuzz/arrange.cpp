// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: the independent verifier accepts the arrangement; order, reflection, scale, axes,
// search method and threads do not change it.
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
    for (const auto law :
         {soup_laws::arrangement_flaw, soup_laws::metamorphic_flaw, soup_laws::run_flaw})
        if (auto what = law(surfaces, made.value()); !what.empty()) return what;
    return "";
}

} // namespace terrane::fuzz
