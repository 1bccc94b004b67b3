// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/commands/file_options.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <terrane/cli/session/console.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

/// Options that name files or folders to write; all others of the type FILE name inputs.
constexpr std::array<std::string_view, 15> output_options{
    "--gocad",  "--lines",       "--cells",     "--output",        "OUT",
    "--stats",  "--certificate", "--exact",     "--histogram",     "--map",
    "--points", "--seal-plot",   "--relations", "--juxtaposition", "--report"};

/// Options that write surfaces or tetrahedra, which may take the place of what was read.
constexpr std::array<std::string_view, 2> replacing_options{"--output", "OUT"};

struct NamedFile {
    std::string option; ///< "--stats"
    fs::path path;
};

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Tells whether the value of an option is the name of a file or folder.
bool names_file(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return type.starts_with("FILE") || type == "OUT" || type == "DIR" || type == "CERT";
}

bool are_same(const fs::path& a, const fs::path& b) {
    std::error_code failed;
    if (fs::exists(a, failed) && fs::exists(b, failed))
        return fs::is_regular_file(a, failed) && fs::equivalent(a, b, failed);
    const auto first = fs::weakly_canonical(fs::absolute(followed(a)), failed),
               second = fs::weakly_canonical(fs::absolute(followed(b)), failed);
    return !failed && first == second;
}

/// Tells whether a word means "not a number" or infinity, which no option takes.
bool is_no_number(std::string word) {
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.erase(0, 1);
    return word == "nan" || word == "inf" || word == "infinity" || word.starts_with("nan(");
}

/// Tells whether the value of an option is text that people choose: a name, or a file.
bool is_text(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return names_file(option) || type.find("NAME") != std::string::npos || type == "FORMAT" ||
           type == "PROGRAM" || type == "UNIT";
}

} // namespace

Status check_values(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        const std::string name =
            option->get_lnames().empty() ? option->get_name(true) : "--" + option->get_lnames()[0];
        for (const std::string& value : option->results()) {
            if (value.empty()) return Error{ErrorCode::bad_option, "the value is empty", name};
            if (is_text(*option)) continue;
            for (std::size_t at = 0; at < value.size();) {
                const std::size_t end = std::min(value.find_first_of(",; \t", at), value.size());
                if (is_no_number(value.substr(at, end - at)))
                    return Error{ErrorCode::bad_option, "needs a finite number, not " + value,
                                 name};
                at = end + 1;
            }
        }
    }
    return Done{};
}

Status check_file_options(const CLI::App& command) {
    std::vector<NamedFile> inputs, outputs;
    for (const CLI::Option* option : command.get_options()) {
        if (!names_file(*option)) continue;
        const std::string name =
            option->get_lnames().empty() ? option->get_name(true) : "--" + option->get_lnames()[0];
        const bool writes = is_among(output_options, name) && command.get_name() != "verify";
        for (const std::string& value : option->results()) {
            if (value == "-" && writes && !has_standard_output())
                return Error{ErrorCode::cannot_open, "cannot be written: it is closed",
                             "standard output"};
            if (value != "-" && !value.empty())
                (writes ? outputs : inputs).push_back({name, value});
        }
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const NamedFile& out = outputs[i];
        for (std::size_t j = 0; j < i; ++j)
            if (are_same(out.path, outputs[j].path))
                return Error{ErrorCode::bad_option,
                             "names the same file as " + outputs[j].option + ": " +
                                 out.path.string(),
                             out.option};
        if (is_among(replacing_options, out.option)) continue;
        for (const NamedFile& in : inputs)
            if (are_same(out.path, in.path))
                return Error{ErrorCode::bad_option,
                             "would replace a file that is read: " + out.path.string(), out.option};
    }
    return Done{};
}

} // namespace terrane::cli
