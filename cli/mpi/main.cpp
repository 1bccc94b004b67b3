// SPDX-License-Identifier: LGPL-3.0-or-later
//
// terrane-mpi: one arrangement on many machines. Each process runs this program; the first one speaks.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <mpi.h>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>
#include <terrane/cli/mpi/agreement.hpp>
#include <terrane/cli/mpi/mpi_supersteps.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/command_table.hpp>
#include <terrane/cli/options/manual.hpp>
#include <terrane/cli/options/output_options.hpp>
#include <terrane/cli/reports/tile_report.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/cli/session/terminal.hpp>
#include <terrane/cli/stages/tile_volumes.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/meshes/pvtp.hpp>
#include <terrane/io/meshes/pvtp_output.hpp>

namespace terrane::cli {
namespace {

using namespace tiles;

struct MpiCommand {
    std::vector<std::string> inputs;
    std::string output, stats;
    bool digest = false, volumes = false;
};

constexpr auto mpi_footer =
    R"(Space is divided into as many tiles as there are processes. The result is that of terrane arrange, for any
number of them: terrane convert OUT.pvtp OUT.vtp writes the same bytes. All processes must see the same files.

The command terrane-mpi manual prints the manual page.

Exit status: as that of terrane.

Examples:
  mpirun -n 4 terrane-mpi arrange horizons.ts faults.ts -o model.pvtp)";

/// Checks in the first process, before any work, that the output can be written.
Status check_command(const MpiCommand& command, MpiSupersteps& tiles) {
    return tiles.visit([&](Tile& b) -> Status {
        if (b.index != 0) return Done{};
        if (std::filesystem::path(command.output).extension() != ".pvtp")
            return Error{ErrorCode::unknown_format, "the output must be a .pvtp file",
                         command.output};
        for (const std::string& input : command.inputs)
            if (input == "-")
                return Error{ErrorCode::bad_option,
                             "several processes cannot share standard input; name files", "-"};
        for (const std::filesystem::path& output :
             {std::filesystem::path(command.output), folder_of_pieces(command.output)})
            if (!command.stats.empty() && overlap(command.stats, output))
                return Error{ErrorCode::bad_option,
                             "names the same file as --output: " + command.stats, "--stats"};
        for (const std::string& input : command.inputs)
            if (!command.stats.empty() && overlap(command.stats, input))
                return Error{ErrorCode::bad_option,
                             "would replace a file that is read: " + command.stats, "--stats"};
        return check_pvtp(command.output);
    });
}

Result<ExitStatus> arrange_files(const MpiCommand& command, MpiSupersteps& tiles, const Run& run) {
    if (auto sound = check_command(command, tiles); !sound) return sound.error();
    if (auto same = check_same_files(command.inputs); !same) return same.error();
    const auto read = [&](std::size_t file) { return read_surfaces(command.inputs[file]); };
    const TiledOptions options{command.inputs.size(), command.digest};
    auto report = arrange_in_tiles(tiles, read, options, run);
    if (!report) return report.error();
    RepairedWhole whole;
    if (!report->clean) {
        auto repaired = repair_in_one_process(tiles, run);
        if (!repaired) return repaired.error();
        whole = std::move(*repaired);
        if (!whole.report.clean) {
            if (tiles.is_first())
                print(stderr, complaint("nothing written: no conforming mesh of doubles was found; "
                                        "terrane arrange names the pairs in the way"));
            return ExitStatus::negative;
        }
    }
    if (command.volumes)
        if (auto found = find_tile_volumes(tiles, *report, whole.piece); !found)
            return found.error();
    const auto written =
        write_pvtp(tiles, command.output, command.volumes, report->clean ? nullptr : &whole.piece);
    if (!written) return written.error();
    if (!tiles.is_first()) return ExitStatus::done;
    const RoundingReport* repaired = report->clean ? nullptr : &whole.report;
    const std::size_t count = tiles.tiles();
    say(stdout, tile_text(*report, repaired,
                          std::to_string(count) + (count == 1 ? " process" : " processes")) +
                    "wrote " + command.output + "\n");
    if (command.stats.empty()) return ExitStatus::done;
    const auto stats =
        write_file(command.stats, tile_json(*report, repaired, count).dump(2) + "\n");
    if (!stats) return stats.error();
    return ExitStatus::done;
}

/// Declares the command line; parsing it sets `command`.
void declare(CLI::App& program, MpiCommand& command) {
    program.name("terrane-mpi");
    program.description(
        "Terrane: exact conforming meshes of geological surfaces, on many machines.");
    program.set_version_flag("--version", "terrane " TERRANE_VERSION);
    program.require_subcommand(1);
    program.footer(mpi_footer);
    auto* arrange = program.add_subcommand(
        "arrange", "Make one conforming mesh of surfaces that cross, in pieces");
    arrange->footer(mpi_footer);
    add_value(*arrange, "IN", command.inputs, "FILE", "Files with surfaces")->required();
    add_value(*arrange, "-o,--output", command.output, "OUT.pvtp", "File that names the pieces")
        ->required();
    arrange->add_flag("--digest", command.digest, "Say the digest of the exact result");
    arrange->add_flag("--volumes", command.volumes,
                      "Find the volumes that the surfaces enclose, and tell those on both sides of "
                      "each triangle");
    add_value(*arrange, "--stats", command.stats, "FILE.json",
              "Write counts of work and messages as JSON");
    add_output_options(*arrange);
}

/// Prints the manual page.
ExitStatus print_manual() {
    CLI::App program;
    MpiCommand command;
    declare(program, command);
    print(stdout, manual_of_command(command_table(program).front(), program.get_name(),
                                    {TERRANE_VERSION, program.get_description(),
                                     program.get_footer(), program.get_name()}));
    return finish(ExitStatus::done);
}

bool is_manual(std::span<char* const> words) {
    return words.size() == 2 && std::string_view(words[1]) == "manual";
}

/// Tells whether a launcher started this process, and perhaps others, which wait until all have started MPI.
bool is_launched() {
    return std::getenv("PMIX_RANK") != nullptr || std::getenv("PMI_RANK") != nullptr;
}

ExitStatus run_command(int argc, char** argv) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const std::span words(argv, static_cast<std::size_t>(argc));
    const auto same = check_same_command(words.subspan(1));
    if (!same) return rank == 0 ? fail(same.error()) : status_of(same.error().code);
    if (is_manual(words)) return rank == 0 ? print_manual() : ExitStatus::done;
    CLI::App program;
    MpiCommand command;
    declare(program, command);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& stop) {
        std::ostringstream asked, wrong;
        const bool is_asked = program.exit(stop, asked, wrong) == 0;
        if (rank == 0) {
            std::fputs(asked.str().c_str(), stdout);
            std::fputs(wrong.str().c_str(), stderr);
        }
        return is_asked ? ExitStatus::done : ExitStatus::bad_input;
    }
    set_output(output_settings(program));
    Session session(1);
    MpiSupersteps tiles(session.run());
    const auto status = arrange_files(command, tiles, session.run());
    if (status) return rank == 0 ? finish(*status) : *status;
    return rank == 0 ? fail(status.error()) : status_of(status.error().code);
}

} // namespace
} // namespace terrane::cli

int main(int argc, char** argv) {
    using namespace terrane::cli;
    occupy_closed_streams();
    std::signal(SIGPIPE, SIG_IGN); // a closed pipe is a write that fails
    std::signal(SIGXFSZ, SIG_IGN); // so is a file beyond the limit of sizes
    terrane::keep_freed_memory();
    terrane::throw_on_gmp_out_of_memory();
    if (is_manual({argv, std::size_t(argc)}) && !is_launched())
        return static_cast<int>(print_manual());
    int threads = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
    try {
        const ExitStatus status = run_command(argc, argv);
        MPI_Finalize();
        return static_cast<int>(status);
    } catch (const std::exception& broken) {
        // The others wait for a message from this process, so they are ended.
        std::fprintf(stderr, "terrane-mpi: %s\n", broken.what());
        MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitStatus::internal));
    }
    return static_cast<int>(ExitStatus::internal);
}
