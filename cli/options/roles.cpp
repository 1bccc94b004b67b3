// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/roles.hpp>

#include <charconv>
#include <map>
#include <system_error>

#include <terrane/algorithms/mesh/labels.hpp>

namespace terrane::cli {
namespace {

void set_role(const std::string& text, Inputs& inputs) {
    static const std::map<std::string, Role> roles{
        {"horizon", Role::horizon}, {"fault", Role::fault}, {"boundary", Role::boundary}};
    const auto at = text.rfind('=');
    const auto role = at == std::string::npos ? roles.end() : roles.find(text.substr(at + 1));
    if (role == roles.end())
        refuse("needs NAME=ROLE, with horizon, fault or boundary: " + text, "--role");
    const std::string name = text.substr(0, at);
    bool found = false;
    for (std::size_t s = 0; s < inputs.surfaces.size(); ++s) {
        if (inputs.surfaces[s].name != name && inputs.labels[s] != name) continue;
        inputs.surfaces[s].role = role->second;
        found = true;
    }
    if (found) return;
    refuse(not_called("surface", name, inputs.labels), "--role");
}

} // namespace

void add_roles(CLI::App& command, std::vector<std::string>& roles) {
    add_value(command, "--role", roles, "NAME=ROLE",
              "What a surface is: horizon, fault or boundary; may be repeated")
        ->allow_extra_args(false);
}

void set_roles(const std::vector<std::string>& roles, Inputs& inputs) {
    for (const std::string& role : roles) set_role(role, inputs);
}

std::optional<ProjectSize> parse_named_length(std::string_view text) {
    const auto at = text.rfind('=');
    if (at == std::string_view::npos || at == 0) return std::nullopt;
    const auto length = parse_number(text.substr(at + 1));
    if (!length) return std::nullopt;
    return ProjectSize(text.substr(0, at), *length);
}

ProjectSize positive_named_length(std::string_view text, const char* option) {
    const auto named = parse_named_length(text);
    if (!named || !(named->second > 0))
        refuse("needs NAME=L, with a positive length: " + std::string(text), option);
    return *named;
}

std::optional<std::vector<double>> numbers_in(std::string_view text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        if (at != end && *at == '+') ++at;
        const auto [after, failed] = std::from_chars(at, end, numbers.emplace_back());
        if (failed != std::errc()) return std::nullopt;
        if (after == end) return numbers;
        if (*after != ',') return std::nullopt;
        at = after + 1;
    }
}

} // namespace terrane::cli
