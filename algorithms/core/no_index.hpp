// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The index that stands for none.
#pragma once

#include <cstdint>

namespace terrane {

/// Marks an entry that refers to no vertex, triangle, surface or the like.
inline constexpr std::uint32_t no_index = UINT32_MAX;

} // namespace terrane
