// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/spelling.hpp>

#include <algorithm>

#include <terrane/algorithms/core/spelling.hpp>

namespace terrane::cli {
namespace {

std::string suggested(const std::string& sentence, std::string_view word,
                      std::span<const std::string> names, const std::string& dashes) {
    const auto near = nearest_name(word, names);
    return near ? sentence + "; did you mean " + dashes + *near + "?" : sentence;
}

} // namespace

std::optional<std::string> misspelt(const CLI::App& program, std::span<char* const> words) {
    if (words.size() < 2) return std::nullopt;
    const std::string_view first = words[1];
    if (first.starts_with('-')) return std::nullopt;
    const CLI::App* command = nullptr;
    std::vector<std::string> commands;
    for (const CLI::App* app : program.get_subcommands([](const CLI::App*) { return true; })) {
        commands.push_back(app->get_name());
        if (app->get_name() == first) command = app;
    }
    if (!command)
        return suggested("there is no command " + std::string(first), first, commands, "");
    std::vector<std::string> options;
    for (const CLI::Option* option : command->get_options())
        options.insert(options.end(), option->get_lnames().begin(), option->get_lnames().end());
    for (const std::string_view word : words.subspan(2)) {
        if (word == "--") break;
        if (!word.starts_with("--")) continue;
        const auto name =
            word.substr(2, word.find('=') == word.npos ? word.npos : word.find('=') - 2);
        if (std::ranges::find(options, name) != options.end()) continue;
        return suggested(command->get_name() + " has no option --" + std::string(name), name,
                         options, "--");
    }
    return std::nullopt;
}

} // namespace terrane::cli
