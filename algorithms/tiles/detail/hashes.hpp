// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::tiles::detail {

/// Returns the hash of a point, of its coordinates as reduced hexadecimal fractions.
Hash hash_of_coordinates(const std::array<std::string, 3>& xyz);
/// Returns the hash of an input vertex.
Hash hash_of_input(const Point3& p);
/// Returns H(tag + sorted list + tail).
Hash tagged_hash(std::string_view tag, std::vector<Hash> list, std::string_view tail = {});

} // namespace terrane::tiles::detail
