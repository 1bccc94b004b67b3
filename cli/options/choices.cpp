// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/choices.hpp>

#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

namespace terrane::cli {
namespace {

constexpr std::string_view list_start = "one of:";

std::string list_of(const std::vector<std::string>& words) {
    std::string list(list_start);
    for (const std::string& word : words) list += ' ' + word;
    return list;
}

} // namespace

std::optional<double> parse_number(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [after, failed] = std::from_chars(text.data(), end, number);
    if (failed != std::errc() || after != end || !std::isfinite(number)) return std::nullopt;
    return number;
}

CLI::Validator positive() {
    const auto flaw = [](const std::string& text) -> std::string {
        const auto number = parse_number(text);
        if (number && *number > 0) return {};
        return "needs a number above 0, not " + text;
    };
    return CLI::Validator(flaw, "");
}

CLI::Validator one_of(const std::vector<std::string>& words) {
    return CLI::IsMember(words).description("").name(list_of(words));
}

CLI::Validator listing(const std::vector<std::string>& words) {
    return CLI::IsMember(words, CLI::ignore_case).description("").name(list_of(words));
}

std::vector<std::string> choices_of(CLI::Option& option) {
    for (int i = 0;; ++i) {
        try {
            const std::string name = option.get_validator(i)->get_name();
            if (name.starts_with(list_start))
                return CLI::detail::split_up(name.substr(list_start.size()));
        } catch (const CLI::OptionNotFound&) { // there are no more
            return {};
        }
    }
}

} // namespace terrane::cli
