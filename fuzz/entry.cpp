// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The entry points of libFuzzer for the targets about surfaces.
#include <terrane/fuzzing/mutate.hpp>

#include "property.hpp"
#include "report.hpp"

TERRANE_FUZZING_MUTATORS(terrane::fuzz::input);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto soup = terrane::fuzzing::mesh_of(data, size, terrane::fuzz::input);
    const auto flaw = terrane::fuzz::flaw(terrane::fuzz::surfaces_of(soup));
    if (!flaw.empty()) terrane::fuzz::fail(flaw + "\n" + terrane::fuzzing::obj_text(soup));
    return 0;
}
