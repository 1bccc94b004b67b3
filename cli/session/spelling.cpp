// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/spelling.hpp>

#include <algorithm>
#include <utility>

namespace terrane::cli {
namespace {

/// Returns the number of changes that make one word of the other (restricted Damerau-Levenshtein).
std::size_t changes_between(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> least(a.size() + 1,
                                                std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                least[i][j] = i + j;
                continue;
            }
            least[i][j] = std::min({least[i - 1][j] + 1, least[i][j - 1] + 1,
                                    least[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (exchanged) least[i][j] = std::min(least[i][j], least[i - 2][j - 2] + 1);
        }
    return least[a.size()][b.size()];
}

std::string suggested(const std::string& sentence, std::string_view word,
                      std::span<const std::string> names, const std::string& dashes) {
    const auto near = nearest_name(word, names);
    return near ? sentence + "; did you mean " + dashes + *near + "?" : sentence;
}

} // namespace

std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names) {
    const std::size_t most = std::min<std::size_t>(2, word.size() / 3);
    std::optional<std::string> nearest;
    std::size_t least = most + 1;
    for (const std::string& name : names) {
        const auto changes = changes_between(word, name);
        if (changes >= least) continue;
        least = changes;
        nearest = name;
    }
    return nearest;
}

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
