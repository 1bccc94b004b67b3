// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The same for libFuzzer, with the bug BUG: what is found is reduced, and the process ends.
#include <cstdio>
#include <cstdlib>

#include <terrane/fuzzing/minimise.hpp>
#include <terrane/fuzzing/mutate.hpp>

#include "flaw.hpp"

TERRANE_FUZZING_MUTATORS(under_test::generate);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using terrane::fuzzing::Soup;
    engine::bug = BUG;
    const Soup soup = terrane::fuzzing::mesh_of(data, size, under_test::generate);
    if (under_test::flaw(soup).empty()) return 0;
    const Soup least = terrane::fuzzing::minimise(
        soup, [](const Soup& changed) { return !under_test::flaw(changed).empty(); });
    std::printf("FOUND: %s\n%s%zu triangles\n", under_test::flaw(least).c_str(),
                obj_text(least).c_str(), triangle_count(least));
    std::fflush(stdout);
    std::abort();
}
