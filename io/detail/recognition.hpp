// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tells from its first lines what a text file holds.
#pragma once

#include <optional>
#include <string_view>

#include <terrane/io/files.hpp>

namespace terrane::detail {

/// Returns the format of a grid (ZMAP+, CPS-3, Irap, ESRI, Surfer) or GOCAD file by its first lines; nothing for
/// any other text. Columns of numbers never begin so, and to read one of these as columns of
/// numbers would make points of its header.
std::optional<Format> format_seen_in(std::string_view contents);

} // namespace terrane::detail
