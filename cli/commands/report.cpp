// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {
namespace {

constexpr auto report_footer =
    R"(Arranges the surfaces and finds the blocks as `terrane volume` does, and writes nothing but one
HTML file: the model to turn and to cut, its blocks and surfaces, what is wrong and where, plots and
tables. It opens in any browser, from disk, and asks no network for anything.

Where no conforming mesh of doubles was found, the page shows the contacts in the way, and the exit
status is 1. --report of the other commands writes the page of what they make.

Examples:
  terrane report horizons.ts faults.ts -o model.html
  terrane report model.ml -o model.html --box 0,0,-3000,10000,10000,500)";

constexpr auto view_footer =
    R"(Makes the page of `terrane report` in a new folder for temporary files and opens it; a page that is
there already, FILE.html, is opened as it is. The environment variable BROWSER names the programs
that may open it, with colons between them and %s for the page; otherwise xdg-open does. The folder
stays, as the browser reads it later.

Examples:
  terrane view horizons.ts faults.ts
  terrane view model.html)";

ExitStatus report_files(const ModelCommand& command, Session& session) {
    plan_outputs(command.files, OutputKind::surfaces);
    auto run = ModelRun::begin(command, session);
    must(run.page().add_holes(run.surfaces(), session.run()));
    run.make();
    return run.end(run.refused().empty());
}

/// Returns the parts of a text between separators.
std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

/// Starts a command, in which %s stands for the page, and does not wait for it. Without %s the page is its last word.
/// Returns why it did not start, or 0.
int start(const std::string& command, const std::string& page) {
    std::vector<std::string> words = split(command, ' ');
    std::erase_if(words, [](const std::string& word) { return word.empty() || word == "&"; });
    if (words.empty()) return ENOENT;
    if (command.find("%s") == command.npos) words.emplace_back("%s");
    std::vector<char*> pointers;
    for (std::string& word : words) {
        for (std::size_t at = 0; (at = word.find("%s", at)) != word.npos; at += page.size())
            word.replace(at, 2, page);
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    pid_t child = 0;
    return ::posix_spawnp(&child, pointers.front(), nullptr, nullptr, pointers.data(), environ);
}

/// Opens a page by the first command of BROWSER that starts. Colons separate commands, as Python and xdg-open have it.
void open_page(const std::string& path) {
    const char* const named = std::getenv("BROWSER");
    const std::string commands = named != nullptr && *named != '\0' ? named : "xdg-open";
    int failed = ENOENT;
    for (const std::string& command : split(commands, ':'))
        if ((failed = start(command, path)) == 0) return;
    refuse(ErrorCode::cannot_open,
           fmt::format("{} cannot open it ({}); set BROWSER, or open the page by hand", commands,
                       std::strerror(failed)),
           path);
}

bool is_page(const std::string& path) {
    return std::filesystem::path(path).extension() == ".html";
}

/// Makes a folder for a page, and returns the path of the page in it.
std::string temporary_page(const FileOptions& files) {
    std::error_code failed;
    std::string folder = std::filesystem::temp_directory_path(failed) / "terrane-view-XXXXXX";
    if (failed || ::mkdtemp(folder.data()) == nullptr)
        refuse(ErrorCode::cannot_open, "no folder can be made here", folder);
    const auto stem = std::filesystem::path(files.inputs.front()).stem().string();
    return folder + "/" + (stem.empty() || stem == "-" ? "report" : stem) + ".html";
}

ExitStatus view_files(ModelCommand& command) {
    const auto& inputs = command.files.inputs;
    if (inputs.size() == 1 && is_page(inputs.front())) {
        must(read_file(inputs.front()));
        open_page(inputs.front());
        return ExitStatus::done;
    }
    const auto page = command.files.report = temporary_page(command.files);
    Session session(command.files.threads);
    try {
        const ExitStatus status = report_files(command, session);
        when_written([page] {
            try {
                open_page(page);
            } catch (const Failure& failure) {
                warn(failure.error.message());
            }
        });
        return status;
    } catch (const Failure&) {
        std::filesystem::remove(std::filesystem::path(page).parent_path());
        throw;
    }
}

/// Adds the options that `report` and `view` share.
void add_model_options(CLI::App& app, ModelCommand& command) {
    add_inputs(app, command.files);
    command.files.app = &app;
    add_naming(app, command);
    add_arranging(app, command);
    command.project.last = BuildStage::blocks;
    add_threads(app, command.files);
    add_stats(app, command.files);
}

} // namespace

Command view_command(CLI::App& program) {
    auto command = std::make_shared<ModelCommand>();
    auto* app = program.add_subcommand("view", "Look at surfaces, or at a report, in a browser");
    add_model_options(*app, *command);
    app->footer(view_footer);
    return {app, [command] { return view_files(*command); }};
}

Command report_command(CLI::App& program) {
    auto command = std::make_shared<ModelCommand>();
    auto* app = program.add_subcommand("report", "Show a model and its flaws in a page");
    add_model_options(*app, *command);
    add_value(*app, "-o,--output", command->files.report, "FILE.html",
              "The page; - is standard output")
        ->required();
    app->footer(report_footer);
    return {app, [command] {
                Session session(command->files.threads);
                return report_files(*command, session);
            }};
}

} // namespace terrane::cli
