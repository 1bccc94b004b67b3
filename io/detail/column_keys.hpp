// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The keys of a stratigraphic column, in a project and in a file of its own. Defined in
// io/column.cpp.
#pragma once

#include <array>
#include <string_view>

#include <terrane/algorithms/structure/block_names.hpp>
#include <terrane/io/detail/json_reader.hpp>

namespace terrane::detail {

inline constexpr std::array<std::string_view, 4> column_level{"unit", "surface", "age", "contact"};
inline constexpr std::array<std::string_view, 2> unit_contacts{"conformable", "erosive"};

/// Reads the value of the key column.
StratigraphicColumn column_of(JsonReader& in, const Json& json);

} // namespace terrane::detail
