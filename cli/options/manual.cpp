// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/manual.hpp>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace terrane::cli {
namespace {

/// Returns a line as man shows it literally: no request, no escape, and plain ASCII hyphens.
std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else if (c == '^')
            result += "\\(ha";
        else if (c == '~')
            result += "\\(ti";
        else if (c == '`')
            result += "\\(ga";
        else if (c == '\'')
            result += "\\(aq";
        else
            result += c;
    }
    return result.starts_with('.') ? "\\&" + result : result;
}

std::string upper(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return result;
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// Turns the prose below the options into man: paragraphs, indented lines as they are, and sections
/// of the headings "Examples:" and "Exit status: ...".
std::string prose(std::string_view text) {
    constexpr std::string_view exit_status = "Exit status: ";
    std::string page;
    bool literal = false, after_heading = false;
    bool paragraph = false; // whether one is to begin
    for (std::string_view line : lines_of(text)) {
        const bool indented = line.starts_with("  ");
        if (literal && !indented) page += ".EE\n.RE\n";
        if (indented && !literal) page += after_heading ? ".RS 2\n.EX\n" : ".PP\n.RS 2\n.EX\n";
        if (literal && !indented) paragraph = true;
        literal = indented;
        after_heading = false;
        if (line.empty()) {
            paragraph = true;
            continue;
        }
        if (!indented && line.ends_with(':') && line.find(' ') == std::string_view::npos) {
            page += ".SH " + upper(line.substr(0, line.size() - 1)) + "\n";
            paragraph = false;
            after_heading = true;
            continue;
        }
        if (line.starts_with(exit_status)) {
            page += ".SH EXIT STATUS\n";
            line.remove_prefix(exit_status.size());
            paragraph = false;
        }
        if (paragraph && !indented) page += ".PP\n";
        paragraph = false;
        page += escaped(indented ? line.substr(2) : line) + "\n";
    }
    return literal ? page + ".EE\n.RE\n" : page;
}

std::string header(const std::string& name, const ManualSettings& settings) {
    return fmt::format(".\\\" SPDX-License-Identifier: LGPL-3.0-or-later\n.\\\" Made from --help.\n"
                       ".TH {} 1 \"\" \"terrane {}\" \"Terrane\"\n",
                       escaped(upper(name)), settings.version);
}

/// Returns a sentence as the name of a page has it: without a capital letter and a full stop.
std::string as_name(std::string text) {
    if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0)
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    if (text.ends_with('.')) text.pop_back();
    return escaped(text);
}

/// Returns ".TP", the names of an option in bold and its value in italics, and what it means.
std::string entry(const OptionRow& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", escaped(name));
    const std::string value = option.placeholder.empty() || option.placeholder == option.position
                                  ? ""
                                  : fmt::format(" \\fI{}\\fR", escaped(option.placeholder));
    const auto position =
        option.position.empty() ? "" : fmt::format("\\fI{}\\fR", escaped(option.position));
    return fmt::format(".TP\n{}{}{}\n{}.\n", position, names, value, escaped(option.description));
}

std::string synopsis(const CommandRow& command, const ManualSettings& settings) {
    std::string text = fmt::format(".B {} {}\n[\\fIOPTION\\fR]...", escaped(settings.program),
                                   escaped(command.name));
    for (const OptionRow& option : options_of(command))
        if (option.required)
            text += fmt::format(" \\fB{}\\fR \\fI{}\\fR", escaped(option.names.front()),
                                escaped(option.placeholder));
    for (const OptionRow& position : positionals_of(command)) {
        const auto name =
            fmt::format("\\fI{}\\fR{}", escaped(position.position), position.repeated ? "..." : "");
        text += position.required ? " " + name : " [" + name + "]";
    }
    return text + "\n";
}

constexpr auto environment = R"(.SH ENVIRONMENT
.TP
.B NO_COLOR
If it is set and not empty, nothing is coloured, unless
.B \-\-color always
is given.
.TP
.B TERRANE_TETGEN\fR, \fBTERRANE_GMSH
Paths of the helper programs that make tetrahedra, if they are not found.
)";

} // namespace

std::string manual_of_program(std::span<const CommandRow> commands,
                              const ManualSettings& settings) {
    const auto colon = settings.description.find(": ");
    auto page = header("terrane", settings) + ".SH NAME\nterrane \\- " +
                as_name(settings.description.substr(colon + 2)) +
                "\n.SH SYNOPSIS\n.B terrane\n\\fICOMMAND\\fR [\\fIOPTION\\fR]... "
                "[\\fIFILE\\fR]...\n.SH DESCRIPTION\n" +
                escaped(settings.description) +
                "\n.PP\nEach command has a page of its own.\n.SH COMMANDS\n";
    std::string pages;
    for (const CommandRow& command : commands) {
        page +=
            fmt::format(".TP\n.B {}\n{}.\n", escaped(command.name), escaped(command.description));
        pages += fmt::format(".BR terrane\\-{} (1){}\n", escaped(command.name),
                             &command == &commands.back() ? "" : ",");
    }
    return page + environment + prose(settings.footer) + ".SH SEE ALSO\n" + pages;
}

std::string manual_of_command(const CommandRow& command, const std::string& name,
                              const ManualSettings& settings) {
    const auto examples = command.footer.find("Examples:\n");
    const auto text = std::string_view(command.footer).substr(0, examples);
    const auto status = std::min(text.find("Exit status: "), text.size());
    auto page = header(name, settings) +
                fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}.SH DESCRIPTION\n", escaped(name),
                            as_name(command.description), synopsis(command, settings));
    page += status == 0 ? escaped(command.description) + ".\n" : prose(text.substr(0, status));
    std::string group;
    page += ".SH OPTIONS\n";
    for (const OptionRow& position : positionals_of(command)) page += entry(position);
    for (const OptionRow& option : options_of(command)) {
        if (option.group != "Options" && option.group != group)
            page += fmt::format(".SS {}\n", escaped(option.group));
        group = option.group;
        page += entry(option);
    }
    page += prose(text.substr(status));
    if (examples != std::string::npos)
        page += prose(std::string_view(command.footer).substr(examples));
    return page + ".SH SEE ALSO\n.BR terrane (1)\n";
}

} // namespace terrane::cli
