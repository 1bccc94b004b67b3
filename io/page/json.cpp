// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/page/json.hpp>

#include <fmt/format.h>

namespace terrane::page {

std::string counted(std::size_t count, std::string_view noun) {
    constexpr std::string_view vertex = "vertex";
    if (count == 1) return fmt::format("1 {}", noun);
    if (!noun.ends_with(vertex)) return fmt::format("{} {}s", count, noun);
    noun.remove_suffix(vertex.size());
    return fmt::format("{} {}vertices", count, noun);
}

} // namespace terrane::page
