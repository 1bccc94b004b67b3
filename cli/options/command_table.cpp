// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/command_table.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <string_view>

#include <terrane/cli/options/choices.hpp>
#include <terrane/io/files.hpp>

namespace terrane::cli {
namespace {

using Words = std::vector<std::string>;

/// Returns the names of the formats that fit; a name is the ending of a file, too.
Words formats(bool (*fits)(Format)) {
    Words words;
    for (const std::string_view name : format_names())
        if (fits(*format_named(name))) words.emplace_back(name);
    return words;
}

bool is_written(Format format) {
    return holds_surfaces(format) || holds_outlines(format);
}

bool is_read_or_written(Format format) {
    return is_read(format) || is_written(format);
}

/// Files that an option names whose placeholder does not tell their ending.
struct FileRule {
    std::string_view name;  ///< of the option or position
    std::string_view owner; ///< the command; empty: any
    std::function<Words()> endings;
};

const std::array<FileRule, 10>& file_rules() {
    const auto read = [] { return formats(is_read); };
    const auto written = [] { return formats(is_written); };
    static const std::array<FileRule, 10> rules{{
        {"IN", "", read},
        {"MESH", "", read},
        {"--within", "", read},
        {"--hard", "", read},
        {"--soft", "", read},
        {"--output", "tetrahedralize", [] { return formats(holds_tetrahedra); }},
        {"--output", "verify", [] { return formats(is_read_or_written); }},
        {"--output", "", written},
        {"OUT", "", written},
        {"--certificate", "", [] { return Words{"json"}; }},
    }};
    return rules;
}

Words endings_of(const CLI::Option& option, const std::string& command) {
    const std::string type = option.get_type_name();
    if (const auto dot = type.find('.'); dot != std::string::npos) return {type.substr(dot + 1)};
    if (type == "CERT") return {"json"};
    const std::string name =
        option.get_lnames().empty() ? option.get_name(true) : "--" + option.get_lnames()[0];
    for (const FileRule& rule : file_rules())
        if (rule.name == name && (rule.owner.empty() || rule.owner == command))
            return rule.endings();
    return {}; // any file
}

/// Returns the formats that an option takes by name.
Words formats_of(const CLI::Option& option) {
    const auto& name = option.get_lnames().at(0);
    return formats(name == "input-format"    ? is_read
                   : name == "output-format" ? is_written
                                             : is_read_or_written);
}

void set_kind(CLI::Option& option, const std::string& command, OptionRow& row) {
    const std::string type = option.get_type_name();
    row.words = choices_of(option);
    if (option.get_type_size() == 0) {
        row.kind = ValueKind::none;
    } else if (!row.words.empty()) {
        row.kind = ValueKind::choice;
    } else if (type == "FORMAT") {
        row.kind = ValueKind::choice;
        row.words = formats_of(option);
    } else if (type == "DIR") {
        row.kind = ValueKind::folder;
    } else if (type.starts_with("FILE") || type == "OUT" || type == "CERT" || type == "POLYGON") {
        row.kind = ValueKind::file;
        row.words = endings_of(option, command);
    } else {
        row.kind = ValueKind::text;
    }
}

OptionRow row_of(CLI::Option& option, const std::string& command) {
    OptionRow row;
    if (option.get_positional()) row.position = option.get_name(true);
    for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
    row.description = option.get_description();
    row.group = option.get_group();
    row.required = option.get_required();
    row.repeated = option.get_expected_max() > 1 || option.get_items_expected_max() > 1;
    set_kind(option, command, row);
    if (row.kind != ValueKind::none) row.placeholder = option.get_type_name();
    return row;
}

std::vector<CLI::App*> commands_of(const CLI::App& app) {
    std::vector<CLI::App*> all;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        all.push_back(const_cast<CLI::App*>(command)); // for its options, which are not changed
    return all;
}

CommandRow row_of(CLI::App& command) {
    CommandRow row{command.get_name(), command.get_description(), command.get_footer(), {}};
    for (CLI::Option* option : command.get_options())
        row.options.push_back(row_of(*option, command.get_name()));
    return row;
}

std::vector<OptionRow> rows_with(const CommandRow& command, bool positional) {
    std::vector<OptionRow> rows;
    std::ranges::copy_if(command.options, std::back_inserter(rows), [&](const OptionRow& option) {
        return option.position.empty() != positional;
    });
    return rows;
}

} // namespace

std::vector<CommandRow> command_table(const CLI::App& program) {
    std::vector<CommandRow> table;
    for (CLI::App* command : commands_of(program)) table.push_back(row_of(*command));
    return table;
}

std::vector<OptionRow> positionals_of(const CommandRow& command) {
    return rows_with(command, true);
}

std::vector<OptionRow> options_of(const CommandRow& command) {
    return rows_with(command, false);
}

} // namespace terrane::cli
