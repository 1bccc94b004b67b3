// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: a reader ends on any bytes with surfaces that can be arranged, or with an error that
// says something.
#include <cstdlib>
#include <string_view>

#include <terrane/algorithms/check.hpp>
#include <terrane/io/files.hpp>

using namespace terrane;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    if (size == 0) return 0;
    constexpr const char* formats[] = {"ts", "ml", "obj", "off", "stl", "ply"};
    const auto format = format_named(formats[bytes[0] % std::size(formats)]);
    if (!format) std::abort();
    const std::string_view contents(reinterpret_cast<const char*>(bytes) + 1, size - 1);
    const auto surfaces = parse_surfaces(contents, "fuzz", *format);
    if (!surfaces) return surfaces.error().sentence.empty() ? std::abort(), 1 : 0;
    if (!validate(surfaces.value())) std::abort();
    return 0;
}
