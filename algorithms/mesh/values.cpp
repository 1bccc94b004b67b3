// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/values.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <terrane/algorithms/core/no_index.hpp>

namespace terrane {
namespace {

/// The number that says of an integer of this type that there is no value.
double extreme_of(NumberType type) {
    switch (type) {
    case NumberType::int8:
        return std::numeric_limits<std::int8_t>::lowest();
    case NumberType::uint8:
        return std::numeric_limits<std::uint8_t>::max();
    case NumberType::int16:
        return std::numeric_limits<std::int16_t>::lowest();
    case NumberType::uint16:
        return std::numeric_limits<std::uint16_t>::max();
    case NumberType::uint32:
    case NumberType::uint64: // doubles do not have the highest one
        return std::numeric_limits<std::uint32_t>::max();
    default:
        return std::numeric_limits<std::int32_t>::lowest();
    }
}

void need_no_data(ValueArray& array) {
    if (!array.is_integer() || array.no_data) return;
    if (array.texts.empty()) {
        array.no_data = extreme_of(array.type);
        return;
    }
    const auto empty = std::ranges::find(array.texts, std::string());
    array.no_data = static_cast<double>(empty - array.texts.begin());
    if (empty == array.texts.end()) array.texts.emplace_back();
}

} // namespace

std::string_view name_of(NumberType type) {
    constexpr std::array<std::string_view, 10> names{"float64", "float32", "int8",  "uint8",
                                                     "int16",   "uint16",  "int32", "uint32",
                                                     "int64",   "uint64"};
    return names[static_cast<std::size_t>(type)];
}

std::size_t ValueArray::size() const {
    return std::visit([](const auto& all) { return all.size(); }, numbers) / components;
}

bool has_no_data(const ValueArray& array, std::size_t i) {
    const auto* const real = std::get_if<std::vector<double>>(&array.numbers);
    if (real && std::isnan((*real)[i])) return true;
    if (!array.no_data) return false;
    return (real ? (*real)[i]
                 : static_cast<double>(std::get<std::vector<std::int64_t>>(array.numbers)[i])) ==
           *array.no_data;
}

ValueArray without_data(const ValueArray& array, std::size_t size) {
    ValueArray empty{.name = array.name,
                     .on_triangles = array.on_triangles,
                     .components = array.components,
                     .type = array.type,
                     .unit = array.unit,
                     .no_data = array.no_data,
                     .texts = array.texts};
    const std::size_t count = size * array.components;
    if (array.is_integer()) {
        empty.numbers = std::vector<std::int64_t>();
        need_no_data(empty);
        empty.numbers = std::vector<std::int64_t>(count, static_cast<std::int64_t>(*empty.no_data));
    } else {
        empty.numbers = std::vector<double>(count, array.no_data.value_or(std::nan("")));
    }
    return empty;
}

ValueArray picked(const ValueArray& array, std::span<const std::uint32_t> indices) {
    const bool all = std::ranges::count(indices, no_index) == 0;
    ValueArray out = without_data(array, indices.size());
    if (all) { // nothing needs a number that stands for no value
        out.no_data = array.no_data;
        out.texts = array.texts;
    }
    std::visit(
        [&](auto& to) {
            const auto& from = std::get<std::decay_t<decltype(to)>>(array.numbers);
            const std::size_t n = array.components;
            for (std::size_t i = 0; i < indices.size(); ++i)
                if (indices[i] != no_index)
                    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(n * indices[i]), n,
                                to.begin() + static_cast<std::ptrdiff_t>(n * i));
        },
        out.numbers);
    return out;
}

} // namespace terrane
