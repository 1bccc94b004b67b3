// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/fields.hpp>

#include <charconv>
#include <system_error>

namespace terrane::cli {
namespace {

std::string option_named(std::string_view name) {
    std::string all = "--" + std::string(name);
    std::ranges::replace(all, '_', '-');
    return all;
}

} // namespace

std::string option_of(const Field& field) {
    return option_named(field.name);
}

std::string help_of(const Field& field) {
    std::string rest = text_of(field), help;
    for (std::size_t open = rest.find('`'); open != std::string::npos; open = rest.find('`')) {
        const std::size_t close = rest.find('`', open + 1);
        help += rest.substr(0, open) + option_named(rest.substr(open + 1, close - open - 1));
        rest.erase(0, close + 1);
    }
    return help + rest;
}

std::optional<double> number_given(const CLI::App& app, const std::string& option) {
    const CLI::Option* const given = app.get_option_no_throw(option);
    if (!given || given->count() != 1) return std::nullopt;
    const std::string& text = given->results().front();
    const char* const end = text.data() + text.size();
    double number = 0;
    const auto [after, failed] = std::from_chars(text.data(), end, number); // obeys no locale
    if (failed != std::errc() || after != end) return std::nullopt;
    return number;
}

} // namespace terrane::cli
