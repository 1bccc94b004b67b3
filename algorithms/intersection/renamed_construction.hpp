// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include <terrane/kernel/point.hpp>

namespace terrane {

/// Returns the number of entries of v that a construction uses.
constexpr unsigned vertices_of(const Construction& how) {
    switch (how.kind) {
    case Construction::Kind::input:
        return 1;
    case Construction::Kind::line_plane:
        return 5;
    case Construction::Kind::line_line:
        return 4;
    default:
        return 9;
    }
}

/// Returns a construction on vertices with other names. names: per old name; it stays canonical
/// if the new ones are in the same order.
inline Construction renamed(Construction how, std::span<const std::uint32_t> names) {
    for (std::uint32_t& v : std::span(how.v).first(vertices_of(how))) v = names[v];
    return how;
}

} // namespace terrane
