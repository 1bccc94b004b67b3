// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/commands/file_options.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/options/volume_options.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/stages/kept_stages.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/meshes/pvtp.hpp>
#include <terrane/io/project.hpp>

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

/// Options that name surfaces of which others are made, which may take their place.
constexpr std::array<std::string_view, 3> replaced_options{"IN", "--hard", "--soft"};

struct NamedFile {
    std::string option;     ///< "--stats"
    fs::path path;          ///< "-": standard output
    bool replaces = false;  ///< whether it may take the place of surfaces
    bool is_folder = false; ///< whether it is a new folder, which replaces nothing
};

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the name of an option: "--stats", or "IN" if it is known by its place.
std::string name_of(const CLI::Option& option) {
    return option.get_lnames().empty() ? option.get_name(true) : "--" + option.get_lnames()[0];
}

/// Tells whether the values of an option are names of files or folders.
bool names_file(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return type.starts_with("FILE") || type == "OUT" || type == "DIR" || type == "CERT";
}

bool names_file(const CLI::Option& option, const std::string& value) {
    const std::string type = option.get_type_name();
    return names_file(option) ||
           ((type == "POLYGON" || type == "LINE") && is_polygon_file(value)) ||
           (type == "SURFACE" && option.get_lnames()[0] == "by" && fs::exists(value));
}

/// Tells whether a path names the file that is open as this standard stream. The null device does not
/// count, since nothing can be lost in it.
bool is_stream(const fs::path& path, int stream) {
    struct stat named {
    }, open{};
    if (::stat(path.c_str(), &named) != 0 || ::fstat(stream, &open) != 0) return false;
    return named.st_dev == open.st_dev && named.st_ino == open.st_ino &&
           (!S_ISCHR(open.st_mode) || ::isatty(stream) == 1);
}

bool is_standard_output(const fs::path& path) {
    return path == "-" || (has_standard_output() && is_stream(path, STDOUT_FILENO));
}

/// The files and folders that the options of a command name.
struct FilesOfCommand {
    std::vector<NamedFile> inputs;
    std::vector<NamedFile> outputs;
};

FilesOfCommand files_of(const CLI::App& command) {
    FilesOfCommand files;
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = name_of(*option);
        const bool writes = is_among(output_options, name) && command.get_name() != "verify";
        const bool replaces =
            is_among(replacing_options, name) && !option->get_type_name().starts_with("FILE.");
        const bool is_folder = option->get_type_name() == "DIR";
        for (const std::string& value : option->results()) {
            if (value.empty() || !names_file(*option, value)) continue;
            if (!writes) {
                files.inputs.push_back({name, value == "-" ? "/dev/stdin" : value});
                continue;
            }
            files.outputs.push_back({name, value, replaces, is_folder});
            if (fs::path(value).extension() == ".pvtp")
                files.outputs.push_back({name, folder_of_pieces(value), false, true});
        }
    }
    return files;
}

/// Tells whether an output may take the place of an input: surfaces of those that they are made of.
bool may_replace(const NamedFile& out, const NamedFile& in) {
    return out.replaces && is_among(replaced_options, in.option);
}

void check_outputs(const std::vector<NamedFile>& outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const NamedFile& out = outputs[i];
        const bool is_standard = is_standard_output(out.path);
        if (is_standard && !has_standard_output())
            refuse(ErrorCode::cannot_open, "cannot be written: it is closed", "standard output");
        for (std::size_t j = 0; j < i; ++j) {
            if (is_standard && is_standard_output(outputs[j].path))
                refuse("standard output can take only one file, and " + outputs[j].option +
                           " names it, too",
                       out.option);
            if (!is_standard && overlap(out.path, outputs[j].path))
                refuse((are_same(out.path, outputs[j].path)
                            ? "names the same file as "
                            : "names a file in another one, or the folder of it: see ") +
                           outputs[j].option + ": " + out.path.string(),
                       out.option);
        }
    }
}

void check_inputs_stay(const std::vector<NamedFile>& outputs,
                       const std::vector<NamedFile>& inputs) {
    std::error_code failed;
    for (const NamedFile& out : outputs)
        for (const NamedFile& in : inputs)
            if (out.path != "-" && !out.is_folder && !may_replace(out, in) &&
                !fs::is_directory(in.path, failed) && overlap(out.path, in.path))
                refuse("would replace a file that is read: " + out.path.string(), out.option);
}

/// Says what is wrong with a word that could be a number; empty: nothing. Infinity is also what no
/// double holds, such as 1e999.
std::string flaw_of_number(const std::string& word, bool is_whole) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end == word.c_str() || *end != '\0') return {};
    if (!std::isfinite(value)) return "needs a finite number, not ";
    const std::size_t first = word.find_first_not_of("+-");
    if (word.find_first_of("xX") != std::string::npos) return "needs a decimal number, not ";
    if (is_whole && word[first] == '0' && word.size() > first + 1) // CLI11 takes it for octal
        return "needs a number without a zero before it, not ";
    return {};
}

/// Tells whether the value of an option is text that people choose: a name, or a file.
bool is_text(const CLI::Option& option, const std::string& value) {
    constexpr std::array<std::string_view, 7> texts{"NAME",    "NAME=ROLE", "TEXT",   "FORMAT",
                                                    "PROGRAM", "UNIT",      "ADDRESS"};
    return names_file(option, value) || is_among(texts, option.get_type_name());
}

/// Checks the numbers in a value: all of it, or what is behind the name in NAME=L.
void check_number_words(const CLI::Option& option, const std::string& value) {
    const std::string type = option.get_type_name();
    const bool is_named = type.find('=') != std::string::npos;
    const bool is_whole = type == "N" || type == "LIST";
    for (std::size_t at = is_named ? value.rfind('=') + 1 : 0; at < value.size();) {
        const std::size_t end = std::min(value.find_first_of(",; \t", at), value.size());
        if (const auto flaw = flaw_of_number(value.substr(at, end - at), is_whole); !flaw.empty())
            refuse(flaw + value, name_of(option));
        at = end + 1;
    }
}

/// Returns the text of a number with the digits of its nearest double, where CLI11, which rounds to a long
/// double first, would take another one.
std::string rounded_once(const std::string& text) {
    const auto number = parse_number(text);
    if (!number || static_cast<double>(std::strtold(text.c_str(), nullptr)) == *number) return text;
    return fmt::format("{:.30e}", *number);
}

} // namespace

void round_numbers_once(CLI::App& command) {
    for (CLI::Option* option : command.get_options([](const CLI::Option*) { return true; }))
        if (!is_text(*option, "")) option->transform(rounded_once);
}

void check_values(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& value : option->results()) {
            if (value.empty()) refuse("the value is empty", name_of(*option));
            if (is_text(*option, value)) continue;
            check_number_words(*option, value);
        }
    }
}

void check_file_options(const CLI::App& command) {
    const FilesOfCommand files = files_of(command);
    check_outputs(files.outputs);
    check_inputs_stay(files.outputs, files.inputs);
    for (const NamedFile& out : files.outputs)
        if (!out.is_folder && out.option != "--output") // whose format is checked first
            check_folder(out.path.string());
}

void check_project_files(const CLI::App& command, const Project& project) {
    std::vector<NamedFile> inputs{{"PROJECT", project.source}};
    for (const fs::path& file : named_files(project)) inputs.push_back({"PROJECT", file});
    std::vector<NamedFile> outputs = files_of(command).outputs;
    if (!project.folder.empty() && command.get_option("--output")->empty())
        outputs.push_back({"key folder", project.folder, false, true});
    check_outputs(outputs);
    if (!project.folder.empty() && command.get_option("--resume")->count() > 0)
        outputs.push_back({"--resume", stages_folder(project.folder)});
    check_inputs_stay(outputs, inputs);
    if (FileSet::current() != nullptr)
        for (const NamedFile& in : inputs) FileSet::current()->keep(in.path);
}

void check_files_beside(const CLI::App& command, const std::vector<Output>& outputs) {
    const FilesOfCommand files = files_of(command);
    std::vector<NamedFile> named = files.inputs;
    for (const NamedFile& file : files.outputs) named.push_back(file);
    for (const Output& output : outputs) {
        const auto refused = [&](const fs::path& file, const std::string& option) {
            refuse(fmt::format("{} may be one of the files next to {}, whose names begin with "
                               "{}_",
                               file.string(), output.path, fs::path(output.path).stem().string()),
                   option);
        };
        for (const NamedFile& file : named)
            if (may_be_beside(output.format, output.path, followed(file.path)))
                return refused(file.path, file.option);
        for (const Output& other : outputs) {
            const fs::path path = other.path;
            const auto beside =
                path.parent_path() /
                (path.stem().string() + "_" + (other.format == Format::ugi ? ".ss" : ".vtu"));
            if (&other != &output && may_be_beside(output.format, output.path, beside))
                return refused("a file next to " + other.path, "--output");
        }
    }
}

std::vector<fs::path> files_to_keep(const CLI::App& command) {
    const FilesOfCommand files = files_of(command);
    std::vector<fs::path> kept;
    for (const NamedFile& in : files.inputs)
        if (std::none_of(files.outputs.begin(), files.outputs.end(), [&](const NamedFile& out) {
                return may_replace(out, in) && overlap(out.path, in.path);
            }))
            kept.push_back(in.path);
    return kept;
}

} // namespace terrane::cli
