// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The entry point of libFuzzer for the targets about surfaces.
#include "property.hpp"
#include "report.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    terrane::fuzz::Bytes bytes(data, size);
    const auto surfaces = terrane::fuzz::input(bytes);
    const auto flaw = terrane::fuzz::flaw(surfaces);
    if (!flaw.empty()) terrane::fuzz::fail(flaw + "\n" + terrane::fuzz::obj_text(surfaces));
    return 0;
}
