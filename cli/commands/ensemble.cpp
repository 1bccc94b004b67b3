// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Ensembles are computed by the Python package, as the engines that they may run on, Dask and MPI, are
// Python's. The program checks the options, and then becomes the interpreter: signals, output and the status
// are those of one process.
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/terminal.hpp>
#include <terrane/io/project.hpp>

namespace terrane::cli {
namespace {

namespace fs = std::filesystem;

struct EnsembleCommand {
    std::string project, folder;
    std::uint64_t realisations = 500, seed = 1, grid = 50, retries = 2;
    unsigned threads = 1;
    std::vector<double> contacts;
    std::optional<std::uint64_t> only, workers;
    std::optional<std::string> engine, scheduler;
    CLI::App* app = nullptr; ///< knows which options were given
};

constexpr auto ensemble_footer =
    R"(The key "uncertainty" of the project says how surfaces move: docs/reference/project.md has its keys.
Each realisation moves them at random, is built as `terrane build` builds the project, without
tetrahedra, and is measured; it depends on the project, the seed and its number alone. Blocks are
matched by what bounds them. All results go to one new folder:

  blocks.csv         one row per realisation and block: volume, area, thickness, ...
  percentiles.csv    P90, P50 and P10 of each measure; P90 is exceeded with a probability of 90 %
  realisations.csv   status, leaks and triangle quality of each
  interfaces.csv     areas between blocks; juxtaposition.csv: how probable each contact is
  maps/              probability of each block; mean and standard deviation of each surface's z
  ensemble.h5        tables and maps as HDF5, with python3-h5py
  ensemble.json      what the report states
  report.html        plots and maps
  failures/          of each realisation that can't be built: reason, surfaces, and a project

Finished realisations are kept in DIR.realisations until the folder is there: after an interrupt the
same command goes on from them. It runs Python with the package terrane, and with
python3-distributed for --scheduler; TERRANE_PYTHON names another interpreter. The status is 1
where a realisation failed.

Whoever reaches a Dask scheduler without TLS runs programs as you: docs/how-to/ensemble.md says how
keys are made.

Examples:
  terrane ensemble project.json -o run --realisations 1000
  terrane ensemble project.json -o run --contact -2950 --workers 8
  terrane ensemble project.json -o run --scheduler tls://cluster:8786
  terrane ensemble project.json -o one --only 17
  mpirun -n 16 terrane ensemble project.json -o run --engine mpi)";

/// Runs main() of the package, or says what is missing.
constexpr const char* start_script = R"(
import sys
sys.path[:] = filter(None, sys.path)  # no module comes from the current folder
import os, signal
def stop(number, frame):
    sys.stderr.write("terrane: interrupted\n")
    sys.stderr.flush()
    os._exit(2)
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    if signal.getsignal(number) != signal.SIG_IGN:
        signal.signal(number, stop)
signal.pthread_sigmask(signal.SIG_SETMASK, ())
try:
    from terrane._ensemble_command import main
except ImportError as missing:
    what = {"numpy": "python3-numpy"}.get(missing.name, "python3-terrane")
    sys.stderr.write("terrane: ensembles need the Python package terrane, and %s has none that works (%s): "
                     "install %s, or name an interpreter by TERRANE_PYTHON\n" % (sys.executable, missing, what))
    sys.exit(2)
sys.exit(main(sys.argv[1:]))
)";

/// Returns folders near the program that may have the package: that of a build, and that of an installation.
std::vector<fs::path> package_places() {
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    if (failed) return {};
    const fs::path prefix = program.parent_path().parent_path();
    std::vector<fs::path> found;
    for (const fs::path& folder : {prefix / "python", prefix / TERRANE_PYTHON_FOLDER})
        if (fs::exists(folder / "terrane" / "_ensemble_command.py", failed))
            found.push_back(folder);
    return found;
}

/// Puts these folders first where Python looks for packages.
void set_python_path() {
    std::string path;
    for (const fs::path& folder : package_places()) path += folder.string() + ":";
    if (const char* const old = std::getenv("PYTHONPATH")) path += old;
    while (path.ends_with(':')) path.pop_back();
    if (!path.empty() && setenv("PYTHONPATH", path.c_str(), 1) != 0)
        refuse(ErrorCode::out_of_memory, "there is not enough memory", "");
}

std::vector<std::string> arguments_of(const EnsembleCommand& c, const std::string& python) {
    std::vector<std::string> all{python, "-c", start_script};
    const auto add = [&](const char* name, const std::string& value) {
        all.push_back(fmt::format("--{}={}", name, value)); // a value may begin with -
    };
    add("version-of-program", TERRANE_VERSION);
    if (!c.folder.empty()) add("output", c.folder);
    add("realisations", std::to_string(c.realisations));
    add("seed", std::to_string(c.seed));
    for (const double contact : c.contacts) add("contact", fmt::format("{}", contact));
    add("grid", std::to_string(c.grid));
    if (c.only) add("only", std::to_string(*c.only));
    if (c.engine) add("engine", *c.engine);
    if (c.workers) add("workers", std::to_string(*c.workers));
    if (c.scheduler) add("scheduler", *c.scheduler);
    add("retries", std::to_string(c.retries));
    add("threads", std::to_string(c.threads));
    if (is_quiet()) all.emplace_back("--quiet");
    if (has_colours(stderr)) all.emplace_back("--colours");
    all.emplace_back("--");
    all.push_back(c.project);
    return all;
}

/// Checks before the interpreter starts what needs none.
void check_ensemble(const EnsembleCommand& command) {
    const auto project = must(read_project(command.project));
    if (project.uncertainty.empty())
        refuse("is missing: it says how the surfaces move", command.project + ": uncertainty");
    if (command.folder.empty() && project.folder.empty())
        refuse("the key folder is missing, and there is no -o", command.project);
    for (const char* const other : {"--realisations", "--contact", "--grid", "--engine",
                                    "--workers", "--scheduler", "--retries"})
        if (command.only && command.app->count(other) > 0)
            refuse("is for all versions, not for --only", other);
}

/// Becomes the interpreter; returns only if there is none. The session blocks interrupts in this thread, so that they
/// wait until the script can answer them.
ExitStatus run_ensemble(const EnsembleCommand& command) {
    {
        Session session(1);
        check_ensemble(command);
    }
    set_python_path();
    const char* const named = std::getenv("TERRANE_PYTHON");
    std::string python = named != nullptr && *named != '\0' ? named : TERRANE_PYTHON_PROGRAM;
    if (named == nullptr && access(python.c_str(), X_OK) != 0) python = "python3";
    auto words = arguments_of(command, python);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    std::fflush(nullptr);
    execvp(python.c_str(), pointers.data());
    return fail(
        {ErrorCode::cannot_open,
         fmt::format("cannot be run: {}; ensembles need Python 3, as TERRANE_PYTHON names it",
                     std::strerror(errno)),
         python});
}

} // namespace

Command ensemble_command(CLI::App& program) {
    constexpr std::uint64_t most = 10'000'000, most_workers = 4096, most_cells = 10'000;
    constexpr unsigned most_threads = 1024;
    auto command = std::make_shared<EnsembleCommand>();
    auto* app =
        program.add_subcommand("ensemble", "Many versions of a model whose surfaces are uncertain");
    const auto number = [&](const char* name, auto& value, const char* help, std::uint64_t least,
                            std::uint64_t largest) {
        add_value(*app, name, value, "N", help)->check(CLI::Range(least, largest).description(""));
    };
    add_value(*app, "PROJECT", command->project, "FILE.json",
              "What to read and to build, and what is uncertain")
        ->required();
    add_value(*app, "-o,--output", command->folder, "DIR",
              "Folder for the results, made by the program (default: as the project says)");
    number("--realisations", command->realisations, "How many versions (default: 500)", 1, most);
    number("--seed", command->seed, "Other seeds give other versions (default: 1)", 0, INT64_MAX);
    add_value(*app, "--contact", command->contacts, "Z",
              "z of a contact, above which volumes and columns are measured; repeated")
        ->allow_extra_args(false);
    number("--grid", command->grid, "Cells of maps along the longer side (default: 50)", 1,
           most_cells);
    number("--only", command->only,
           "Make this version alone: its surfaces, and a project that builds them", 0, most);
    add_value(*app, "--engine", command->engine, "NAME",
              "What computes: processes, mpi, serial (default: processes)")
        ->check(one_of({"processes", "mpi", "serial"}));
    number("--workers", command->workers, "How many processes (default: as many as cores)", 1,
           most_workers);
    add_value(*app, "--scheduler", command->scheduler, "ADDRESS",
              "Address of a Dask scheduler whose workers compute instead");
    number("--retries", command->retries,
           "How often a version is tried again after its worker was lost (default: 2)", 0, 1000);
    add_value(*app, "--threads", command->threads, "N", "Threads of each worker (default: 1)")
        ->check(CLI::Range(1U, most_threads).description(""));
    command->app = app;
    app->footer(ensemble_footer);
    return {app, [command] { return run_ensemble(*command); }};
}

} // namespace terrane::cli
