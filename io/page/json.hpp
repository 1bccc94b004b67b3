// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <terrane/io/text/json.hpp>

namespace terrane::page {

using Json = terrane::detail::Json;

/// Returns the count with its noun: "1 edge", "2 edges", "3 new vertices".
std::string counted(std::size_t count, std::string_view noun);

} // namespace terrane::page
