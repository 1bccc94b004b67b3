// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Commands that print what is made from --help: completion scripts and manual pages.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/completion.hpp>
#include <terrane/cli/options/manual.hpp>

namespace terrane::cli {
namespace {

constexpr auto completion_footer =
    R"(The script completes commands, options, the words that options take, and files by the endings that
each option reads or writes. Packages install it. By hand:

  bash: terrane completion bash > ~/.local/share/bash-completion/completions/terrane
  zsh:  terrane completion zsh > FOLDER/_terrane, where FOLDER is in fpath
  fish: terrane completion fish > ~/.config/fish/completions/terrane.fish

Examples:
  source <(terrane completion bash)
  terrane completion zsh > ~/.zfunc/_terrane)";

constexpr auto manual_footer =
    R"(The page has what --help says, in the language of man. Packages install the pages.

Examples:
  terrane manual arrange | man -l -
  terrane manual > terrane.1)";

} // namespace

Command completion_command(CLI::App& program) {
    auto shell = std::make_shared<std::string>();
    auto* app = program.add_subcommand("completion", "Print a script that completes for a shell");
    add_value(*app, "SHELL", *shell, "SHELL", "The shell: bash, zsh, fish")
        ->required()
        ->check(one_of({"bash", "zsh", "fish"}));
    app->footer(completion_footer);
    return {app, [&program, shell] {
                const auto table = command_table(program);
                print(stdout, *shell == "bash"  ? bash_completion(table)
                              : *shell == "zsh" ? zsh_completion(table)
                                                : fish_completion(table));
                return ExitStatus::done;
            }};
}

Command manual_command(CLI::App& program) {
    auto name = std::make_shared<std::string>();
    auto* app = program.add_subcommand("manual", "Print a manual page");
    add_value(*app, "COMMAND", *name, "COMMAND",
              "The command; without it the page of the whole program");
    app->footer(manual_footer);
    std::vector<std::string> names; // of all commands, of which this one is the last
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    app->get_option("COMMAND")->check(one_of(names));
    return {app, [&program, name] {
                const auto table = command_table(program);
                const ManualSettings settings{TERRANE_VERSION, program.get_description(),
                                              program.get_footer()};
                const auto found = std::ranges::find(table, *name, &CommandRow::name);
                print(stdout, found == table.end()
                                  ? manual_of_program(table, settings)
                                  : manual_of_command(*found, "terrane-" + found->name, settings));
                return ExitStatus::done;
            }};
}

} // namespace terrane::cli
