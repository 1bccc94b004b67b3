// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Options with values, and the words that they take. These are kept in the name of a validator of CLI11, where
// completion and manual pages find them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace terrane::cli {

/// Adds an option, or an argument, whose value --help calls `placeholder`.
template <class T>
CLI::Option* add_value(CLI::App& app, const std::string& name, T& value,
                       const std::string& placeholder, const std::string& help) {
    return app.add_option(name, value, help)->type_name(placeholder);
}

/// Reads a finite number that takes up the whole text, in no locale.
std::optional<double> parse_number(std::string_view text);

/// Checks that a value is a finite number above 0.
CLI::Validator positive();

/// Checks that a value is one of the words, and lists them.
CLI::Validator one_of(const std::vector<std::string>& words);

/// Checks that a value is one of the words, in capitals or not, before a transformation that was added before, and
/// lists them.
CLI::Validator listing(const std::vector<std::string>& words);

/// Returns the words that one_of or listing gave to an option; empty if none did.
std::vector<std::string> choices_of(CLI::Option& option);

} // namespace terrane::cli
