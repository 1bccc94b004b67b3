// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Values on vertices and triangles in files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/values.hpp>

namespace terrane::detail {

/// Tells whether a name is that of normals, or of an array in Terrane's own files, in any case.
/// Such arrays are no values.
bool is_reserved(std::string_view name);

/// Adds an array that a reader has found, unless it has a reserved name, is empty, or does not have one value
/// for each of `count` vertices or triangles. Repeated names get the ending _2, _3, ... Returns whether it did.
bool add_array(ValueArray array, std::size_t count, std::vector<ValueArray>& arrays);

/// Makes texts the values of an array: their indices, of type int32.
void set_texts(std::span<const std::string> texts, ValueArray& array);

/// What Terrane's own files say of each array besides its numbers.
struct ArrayDescriptions {
    std::vector<std::string> names, units;
    std::vector<double> no_data; ///< NaN: none
};

/// Takes the units of arrays and their numbers without value, if it is these that are described, in this order.
void describe_arrays(const ArrayDescriptions& descriptions, std::vector<ValueArray>& arrays);

/// Appends the values of a further piece of a file to arrays on the same elements. Those that are not in both, with
/// the same type, components and texts, are left out and noted.
void append_piece(std::span<const ValueArray> piece, bool on_triangles,
                  std::vector<ValueArray>& arrays, std::vector<std::string>& left_out);

/// Returns arrays over all vertices and triangles of a mesh, in which vertices or triangles without a value have
/// none. Arrays of several surfaces are one if they have the same name, type, components and unit; then a vertex or
/// triangle of more than one of them has the value of the first that has one. Names that are taken get the
/// ending _2, _3, ... `values`: as from carry_values().
std::vector<ValueArray> joined_values(std::size_t vertices, std::span<const Triangle> triangles,
                                      const IndexLists<std::uint32_t>& surfaces_of,
                                      std::span<const SurfaceValues> values);

/// Calls use() with a number of this type.
template <class Use>
auto with_type(NumberType type, const Use& use) {
    switch (type) {
    case NumberType::float32:
        return use(float{});
    case NumberType::int8:
        return use(std::int8_t{});
    case NumberType::uint8:
        return use(std::uint8_t{});
    case NumberType::int16:
        return use(std::int16_t{});
    case NumberType::uint16:
        return use(std::uint16_t{});
    case NumberType::int32:
        return use(std::int32_t{});
    case NumberType::uint32:
        return use(std::uint32_t{});
    case NumberType::int64:
        return use(std::int64_t{});
    case NumberType::uint64:
        return use(std::uint64_t{});
    case NumberType::float64:
        break;
    }
    return use(double{});
}

/// Appends one number of an array, as text. Integers of type uint64 have no sign; texts are written as indices.
void append_value(std::string& out, const ValueArray& array, std::size_t i);

} // namespace terrane::detail
