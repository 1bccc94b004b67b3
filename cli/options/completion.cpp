// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/completion.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace terrane::cli {
namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : std::string(between)) + word;
    return text;
}

std::string replaced(std::string text, std::string_view what, std::string_view with) {
    for (std::size_t at = text.find(what); at != std::string::npos;
         at = text.find(what, at + with.size()))
        text.replace(at, what.size(), with);
    return text;
}

/// Returns a text that a shell reads as one word, in single quotes.
std::string quoted(const std::string& text) {
    return "'" + replaced(text, "'", "'\\''") + "'";
}

/// Returns one row for all positional arguments: what any of them takes.
OptionRow any_position(const CommandRow& command) {
    OptionRow any;
    for (const OptionRow& position : positionals_of(command)) {
        any.kind = position.kind;
        for (const std::string& word : position.words)
            if (std::ranges::find(any.words, word) == any.words.end()) any.words.push_back(word);
    }
    return any;
}

std::vector<std::string> names_of(std::span<const CommandRow> commands) {
    std::vector<std::string> names;
    for (const CommandRow& command : commands) names.push_back(command.name);
    return names;
}

// --- bash ----------------------------------------------------------------------------------------

constexpr auto bash_start = R"(# bash completion of terrane, printed by `terrane completion bash`

# Offers words that begin as the current one.
_terrane_words() {
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}

# Offers folders, and files with one of the endings in $1, in any case; all files without endings.
_terrane_files() {
    local name ending
    mapfile -t COMPREPLY < <(compgen -d -- "$cur")
    while IFS= read -r name; do
        if [[ -z $1 ]]; then COMPREPLY+=("$name"); fi
        for ending in $1; do
            if [[ ${name,,} == *".$ending" ]]; then COMPREPLY+=("$name"); fi
        done
    done < <(compgen -f -- "$cur")
    compopt -o filenames 2>/dev/null
}

_terrane() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} command= i
    COMPREPLY=()
    if [[ $cur == '=' ]]; then # --search=grid comes as three words
        cur=
    elif [[ $prev == '=' && COMP_CWORD -ge 2 ]]; then
        prev=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    if [[ $cur == [\"\']* ]]; then cur=${cur:1}; fi
    for ((i = 1; i < COMP_CWORD; ++i)); do
        if [[ ${COMP_WORDS[i]} != -* ]]; then
            command=${COMP_WORDS[i]}
            break
        fi
    done
    case "$command $prev" in
)";

/// Returns the call that offers the values of an option or position.
std::string bash_values(const OptionRow& option) {
    switch (option.kind) {
    case ValueKind::choice:
        return "_terrane_words '" + joined(option.words, " ") + "'";
    case ValueKind::file:
        return "_terrane_files '" + joined(option.words, " ") + "'";
    case ValueKind::folder:
        return R"(mapfile -t COMPREPLY < <(compgen -d -- "$cur"); compopt -o filenames 2>/dev/null)";
    default:
        return ":"; // nothing can be offered
    }
}

std::string bash_options(const CommandRow& command) {
    std::vector<std::string> names;
    for (const OptionRow& option : options_of(command))
        names.insert(names.end(), option.names.begin(), option.names.end());
    return joined(names, " ");
}

} // namespace

std::string bash_completion(std::span<const CommandRow> commands) {
    std::string script = bash_start;
    for (const CommandRow& command : commands)
        for (const OptionRow& option : options_of(command)) {
            if (option.kind == ValueKind::none) continue;
            std::vector<std::string> patterns;
            for (const std::string& name : option.names)
                patterns.push_back(fmt::format("'{} {}'", command.name, name));
            script += fmt::format("    {}) {}; return ;;\n", joined(patterns, " | "),
                                  bash_values(option));
        }
    script += "    esac\n    case $command in\n";
    script += fmt::format("    '') _terrane_words '{} --help --version' ;;\n",
                          joined(names_of(commands), " "));
    for (const CommandRow& command : commands)
        script += fmt::format(
            "    {})\n        if [[ $cur == -* ]]; then\n            _terrane_words '{}'\n"
            "        else\n            {}\n        fi\n        ;;\n",
            command.name, bash_options(command), bash_values(any_position(command)));
    return script + "    esac\n}\n\ncomplete -F _terrane terrane\n";
}

// --- zsh -----------------------------------------------------------------------------------------

namespace {

/// Returns the part of a specification of _arguments that offers the values.
std::string zsh_values(const OptionRow& option) {
    const std::string message =
        replaced(replaced(option.placeholder, ":", "\\:"), "[", "\\["); // "NAME=L"
    switch (option.kind) {
    case ValueKind::none:
        return "";
    case ValueKind::choice:
        return fmt::format(":{}:({})", message, joined(option.words, " "));
    case ValueKind::folder:
        return fmt::format(":{}:_files -/", message);
    case ValueKind::file:
        if (option.words.empty()) return fmt::format(":{}:_files", message);
        return fmt::format(":{}:_files -g \"*.(#i)({})(-.)\"", message, joined(option.words, "|"));
    case ValueKind::text:
        break;
    }
    return fmt::format(":{}: ", message);
}

/// Returns the specifications of an option, one for each of its names.
std::string zsh_option(const OptionRow& option) {
    std::string said = option.description;
    for (const char* const special : {"\\", "[", "]", ":"})
        said = replaced(said, special, std::string("\\") + special);
    std::string text;
    for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        const char* const joint = option.kind == ValueKind::none ? "" : is_long ? "=" : "+";
        text +=
            fmt::format("            {} \\\n",
                        quoted(fmt::format("*{}{}[{}]{}", name, joint, said, zsh_values(option))));
    }
    return text;
}

} // namespace

std::string zsh_completion(std::span<const CommandRow> commands) {
    std::string script = "#compdef terrane\n# zsh completion of terrane, printed by `terrane "
                         "completion zsh`\n\n_terrane() {\n    local -a commands\n"
                         "    commands=(\n";
    for (const CommandRow& command : commands)
        script += fmt::format(
            "        {}\n", quoted(command.name + ":" + replaced(command.description, ":", "\\:")));
    script +=
        "    )\n    if (( CURRENT == 2 )); then\n"
        "        _describe -t commands command commands\n"
        "        _arguments '--help[Print what terrane does]' '--version[Print the version]'\n"
        "        return\n    fi\n    local command=$words[2]\n    shift words\n"
        "    (( CURRENT-- ))\n    case $command in\n";
    for (const CommandRow& command : commands) {
        script += fmt::format("    {})\n        _arguments -s -S \\\n", command.name);
        for (const OptionRow& option : options_of(command)) script += zsh_option(option);
        for (const OptionRow& position : positionals_of(command))
            script += fmt::format("            {} \\\n",
                                  quoted((position.repeated ? "*" : "") + zsh_values(position)));
        script += "        ;;\n";
    }
    script = replaced(script, " \\\n        ;;\n", "\n        ;;\n");
    return script + "    esac\n}\n\nif [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n"
                    "    _terrane \"$@\"\nelse\n    compdef _terrane terrane\nfi\n";
}

// --- fish ----------------------------------------------------------------------------------------

namespace {

std::string fish_quoted(const std::string& text) {
    return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

/// Returns the arguments of `complete` that offer the values.
std::string fish_values(const OptionRow& option) {
    switch (option.kind) {
    case ValueKind::choice:
        return " -x -a " + fish_quoted(joined(option.words, " "));
    case ValueKind::folder:
        return " -x -a '(__fish_complete_directories)'";
    case ValueKind::file:
        if (option.words.empty()) return " -r -F";
        return " -x -a " + fish_quoted("(__terrane_files " + joined(option.words, " ") + ")");
    case ValueKind::text:
        return " -x";
    case ValueKind::none:
        break;
    }
    return "";
}

constexpr auto fish_start = R"(# fish completion of terrane, printed by `terrane completion fish`

# Folders, and files with one of these endings, in any case.
function __terrane_files
    set -l word (commandline -ct | string replace -r '^--?[a-z-]+=' '')
    __fish_complete_directories $word ''
    complete -C "'' $word" | string match -r -i '^.*\.(?:'(string join '|' $argv)')$'
end

complete -c terrane -f
complete -c terrane -n __fish_use_subcommand -l help -d 'Print what terrane does'
complete -c terrane -n __fish_use_subcommand -l version -d 'Print the version'
)";

} // namespace

std::string fish_completion(std::span<const CommandRow> commands) {
    std::string script = fish_start;
    for (const CommandRow& command : commands)
        script += fmt::format("complete -c terrane -n __fish_use_subcommand -a {} -d {}\n",
                              command.name, fish_quoted(command.description));
    for (const CommandRow& command : commands) {
        const std::string line =
            fmt::format("complete -c terrane -n '__fish_seen_subcommand_from {}'", command.name);
        for (const OptionRow& option : options_of(command)) {
            script += line;
            for (const std::string& name : option.names)
                script +=
                    name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            script += fish_values(option) + " -d " + fish_quoted(option.description) + "\n";
        }
        script += line + replaced(fish_values(any_position(command)), " -x -a", " -a") + "\n";
    }
    return script;
}

} // namespace terrane::cli
