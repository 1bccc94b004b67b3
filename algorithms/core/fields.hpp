// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Describes the fields of a struct of options, once. Options of the program, keys of project files,
// keywords of Python, members of C structs, the checks of values and the reference come from it.
// Constants that decide a result and are not options are named, too.
//
// A struct takes part by a static function describe(visit, options), which calls visit(Field, member)
// for its members in their order; `options` is one of them, and may be constant.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace terrane {

/// The values that a number may have.
struct FieldBounds {
    double least = 0;                                 ///< a lower bound
    double most = std::numeric_limits<double>::max(); ///< an upper bound; infinity: none
    bool may_be_least = false;                        ///< whether `least` is allowed
};

/// Describes a member of a struct of options.
struct Field {
    std::string_view name;        ///< as the struct declares it
    std::string_view placeholder; ///< stands for its value: "L" a length, "DEGREES" an angle
    std::string_view sentence;    ///< what it does, without full stop; options are in backticks
    std::string_view otherwise{}; ///< what 0, the default, stands for; empty: 0 has no meaning
    FieldBounds bounds{};         ///< of values other than such a 0
    bool in_project = false;      ///< whether project files have it

    constexpr Field(std::string_view own_name, std::string_view own_placeholder,
                    std::string_view own_sentence, std::string_view own_otherwise = {},
                    FieldBounds own_bounds = {}, bool is_in_project = false) :
        name(own_name),
        placeholder(own_placeholder), sentence(own_sentence), otherwise(own_otherwise),
        bounds(own_bounds), in_project(is_in_project) {}
};

/// Returns the flaw of a value, "must be at most 3"; nothing for a good one. `may_be_0`: the 0
/// that stands for `otherwise` is allowed.
std::optional<std::string> flaw_of(const Field& field, double value, bool may_be_0 = true);

/// Returns the sentence with the bounds that a reader can't guess: "..., at most 1000".
std::string text_of(const Field& field);

/// Returns what holds without the option: its default, or what that stands for.
std::string default_of(const Field& field, double value);

/// Returns "edge_length must be positive" for the first number that its bounds do not allow.
template <class Options>
std::optional<std::string> flaw_of_fields(const Options& options) {
    std::optional<std::string> flaw;
    Options::describe(
        [&flaw]<class T>(const Field& field, const T& value) {
            if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
                if (!flaw)
                    if (auto found = flaw_of(field, static_cast<double>(value)))
                        flaw = std::string(field.name) + " " + *found;
        },
        options);
    return flaw;
}

/// A constant that decides the result of a stage and is not an option.
struct NamedConstant {
    std::string_view name; ///< as its stage declares it
    double value = 0;      ///< in the unit that its stage states
};

} // namespace terrane
