// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Named arrays of values on the vertices or triangles of surfaces, as files have them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace terrane {

/// The types of numbers that files distinguish.
enum class NumberType : std::uint8_t {
    float64,
    float32,
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64
};

/// Returns the name of a type: "float64", "int8", ...
std::string_view name_of(NumberType type);

/// A named array with a value on each vertex, or on each triangle, of a surface or mesh.
struct ValueArray {
    std::string name;                      ///< as in the file
    bool on_triangles = false;             ///< otherwise on vertices
    std::uint32_t components = 1;          ///< numbers per value, > 0: 3 for a vector
    NumberType type = NumberType::float64; ///< the type in the file
    /// All components of the first value, then of the next. Floating-point types are doubles, others
    /// integers of 64 bits: of uint64 these have the same bits.
    std::variant<std::vector<double>, std::vector<std::int64_t>> numbers{};
    std::string unit{};               ///< as in the file; empty: not stated
    std::optional<double> no_data{};  ///< the number that stands for no value, as NaN always does
    std::vector<std::string> texts{}; ///< if there are any, the numbers are indices of these

    /// Returns how many values there are.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] bool is_integer() const { return numbers.index() == 1; }

    friend bool operator==(const ValueArray&, const ValueArray&) = default;
};

/// Returns whether a number of all, by its index, stands for no value.
bool has_no_data(const ValueArray& array, std::size_t i);

/// Returns an array like `array` of `size` values, none of which is there. They have its no-data number, or
/// NaN. Integers without one get it: the lowest of their type, the highest if it has no sign; texts an empty text.
ValueArray without_data(const ValueArray& array, std::size_t size);

/// Returns the values with these indices, in their order; for UINT32_MAX, none.
ValueArray picked(const ValueArray& array, std::span<const std::uint32_t> indices);

} // namespace terrane
