// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Options of the program for the described fields of a struct, see Field.
#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/must.hpp>

#include <terrane/cli/options/choices.hpp>

namespace terrane::cli {

/// Returns the option of a field: "--max-deviation".
std::string option_of(const Field& field);

/// Returns what --help says about a field, without its default.
std::string help_of(const Field& field);

/// Adds an option for each described number and truth value of a struct. Those that the command has
/// already stay.
template <class Options>
void add_fields(CLI::App& app, Options& options) {
    Options::describe(
        [&app]<class T>(const Field& field, T& value) {
            const std::string name = option_of(field);
            if (app.get_option_no_throw(name)) return;
            if constexpr (std::is_same_v<T, bool>)
                app.add_flag(name, value, help_of(field));
            else if constexpr (std::is_arithmetic_v<T>)
                add_value(app, name, value, std::string(field.placeholder),
                          help_of(field) +
                              " (default: " + default_of(field, static_cast<double>(value)) + ")");
            else if constexpr (std::is_same_v<T, std::optional<double>>)
                add_value(app, name, value, std::string(field.placeholder),
                          help_of(field) + " (default: " + std::string(field.otherwise) + ")");
        },
        options);
}

/// Returns the number that is given for an option; nothing if it is not given, or is no number.
std::optional<double> number_given(const CLI::App& app, const std::string& option);

/// Refuses numbers of described options that can't be meant, before anything is read.
template <class Options>
void check_fields(const CLI::App& app) {
    std::optional<Error> wrong;
    const Options options{};
    Options::describe(
        [&](const Field& field, const auto&) {
            const std::string name = option_of(field);
            const auto number = wrong ? std::nullopt : number_given(app, name);
            if (auto flaw = number ? flaw_of(field, *number, false) : std::nullopt)
                wrong = Error{ErrorCode::bad_option, *std::move(flaw), name};
        },
        options);
    if (wrong) throw Failure{*std::move(wrong)};
}

} // namespace terrane::cli
