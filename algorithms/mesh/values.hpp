// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Returns whether a number of all, by its index, stands for no value.
bool has_no_data(const ValueArray& array, std::size_t i);

/// Returns an array like `array` of `size` values, none of which is there. They have its no-data number, or
/// NaN. Integers without one get it: the lowest of their type, the highest if it has no sign; texts an empty text.
ValueArray without_data(const ValueArray& array, std::size_t size);

/// Returns the values with these indices, in their order; for UINT32_MAX, none.
ValueArray picked(const ValueArray& array, std::span<const std::uint32_t> indices);

} // namespace terrane
