// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Keywords of Python for the described fields of a struct of options, see Field.
#pragma once

#include <optional>
#include <type_traits>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <terrane/algorithms/core/fields.hpp>

namespace terrane::python {

/// Types of numbers, truth values, and lists of them.
template <class T>
inline constexpr bool is_value =
    std::is_arithmetic_v<T> || std::is_same_v<T, std::optional<double>> ||
    std::is_same_v<T, std::vector<double>>;

/// Returns options of a dict with their names; those that are missing have their defaults.
template <class Options>
Options options_in(const pybind11::dict& given) {
    Options options;
    Options::describe(
        [&given]<class T>(const Field& field, T& value) {
            if constexpr (is_value<T>) {
                const pybind11::str name(field.name.data(), field.name.size());
                if (given.contains(name)) value = given[name].template cast<T>();
            }
        },
        options);
    return options;
}

/// Appends the described options of a struct to a list.
template <class Options>
void describe_to(pybind11::list& all) {
    const Options options{};
    const auto add = [&all]<class T>(const Field& field, const T& value) {
        pybind11::dict one;
        one["name"] = field.name;
        one["placeholder"] = field.placeholder;
        one["text"] = text_of(field);
        one["in_project"] = field.in_project;
        one["type"] = std::is_same_v<T, bool>     ? "bool"
                      : std::is_same_v<T, double> ? "double"
                      : std::is_integral_v<T>     ? "uint32_t"
                      : is_value<T>               ? "other value"
                                                  : "none";
        if constexpr (std::is_same_v<T, bool>)
            one["default"] = field.otherwise.empty() ? (value ? "true" : "false") : field.otherwise;
        else if constexpr (std::is_arithmetic_v<T>)
            one["default"] = default_of(field, static_cast<double>(value));
        else
            one["default"] = field.otherwise;
        all.append(one);
    };
    Options::describe(add, options);
}

/// Lists the described options of structs.
template <class... Options>
pybind11::list described() {
    pybind11::list all;
    (describe_to<Options>(all), ...);
    return all;
}

} // namespace terrane::python
