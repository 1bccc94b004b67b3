// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <terrane/algorithms/core/must.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/commands/file_options.hpp>
#include <terrane/cli/options/output_options.hpp>
#include <terrane/cli/session/spelling.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/io/atomic/file_set.hpp>

namespace terrane::cli {
namespace {

constexpr auto description =
    "Terrane: exact conforming meshes of geological surfaces that cross, touch and overlap.";

constexpr auto main_footer =
    R"(Exit status: 0 done; 1 the answer is "no" (findings, or no conforming mesh of doubles); 2 bad
input or usage, cannot read or write, interrupted; 3 internal, out of memory. Where a file is not
written completely, it is not written at all.

Start here:
  terrane report horizons.ts faults.ts -o model.html   (look at it in a browser)
  terrane arrange horizons.ts faults.ts -o model.vtp
  terrane COMMAND --help)";

constexpr auto licence =
    "LGPL-3.0-or-later; tetrahedra are made by another program, terrane-tetgen, which contains\n"
    "TetGen and is under the AGPL-3.0-or-later";

/// Runs a command. Its files and folders appear together at the end, unless it failed.
ExitStatus run_and_publish(const Command& command) {
    check_values(*command.options);
    check_file_options(*command.options);
    FileSet files;
    for (const auto& path : files_to_keep(*command.options)) files.keep(path);
    const ExitStatus status = command.run();
    if (status != ExitStatus::done && status != ExitStatus::negative) return status;
    must(files.publish());
    return status;
}

/// Adds --quiet and --color to a command, unless its output is for programs.
void offer_output_options(CLI::App& command) {
    if (command.get_name() != "completion" && command.get_name() != "manual")
        add_output_options(command);
}

/// Prints what was asked for, --help or --version, or what is wrong with the command line.
ExitStatus tell(const CLI::App& program, const CLI::ParseError& stop) {
    std::ostringstream asked, wrong;
    const bool is_asked = program.exit(stop, asked, wrong) == 0;
    print(stdout, with_headings(without_marks(asked.str())));
    print(stderr, without_marks(wrong.str()));
    return is_asked ? ExitStatus::done : ExitStatus::bad_input;
}

ExitStatus run(int argc, char** argv) {
    CLI::App program(description, "terrane");
    program.set_version_flag("--version", std::string("terrane " TERRANE_VERSION "\n") + licence);
    program.require_subcommand(1);
    program.footer(main_footer);
    const std::array commands{
        // as --help lists them: what people use most comes first
        arrange_command(program), volume_command(program),   tetrahedralize_command(program),
        improve_command(program), build_command(program),    ensemble_command(program),
        info_command(program),    check_command(program),    fill_command(program),
        layer_command(program),   select_command(program),   map_command(program),
        section_command(program), well_command(program),     grid_command(program),
        prisms_command(program),  pillars_command(program),  report_command(program),
        view_command(program),    convert_command(program),  verify_command(program),
        judge_command(program),   minimise_command(program), completion_command(program),
        manual_command(program)};
    for (const Command& command : commands) {
        round_numbers_once(*command.options);
        offer_output_options(*command.options);
    }
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& stop) {
        set_output(output_settings(program));
        const auto wrong =
            stop.get_exit_code() == 0 ? std::nullopt : misspelt(program, {argv, std::size_t(argc)});
        if (wrong) return fail(Error{ErrorCode::bad_option, *wrong, ""});
        return tell(program, stop);
    }
    set_output(output_settings(program));
    for (const Command& command : commands)
        if (command.options->parsed()) return run_and_publish(command);
    return ExitStatus::bad_input;
}

/// Says that memory is short, and needs none for that.
ExitStatus fail_without_memory() {
    std::fputs("terrane: out of memory\n", stderr);
    return ExitStatus::internal;
}

ExitStatus run_guarded(int argc, char** argv) {
    try {
        return finish(run(argc, argv));
    } catch (const Failure& failure) {
        return finish(fail(failure.error));
    } catch (const std::bad_alloc&) {
        return fail_without_memory();
    } catch (const std::length_error&) { // an array beyond the largest possible length
        return fail_without_memory();
    } catch (const std::system_error& refused) { // a thread that could not be started
        return fail({ErrorCode::out_of_memory, refused.what(), "out of resources"});
    } catch (const std::exception& broken) {
        // TBB has no type of its own for a thread that could not be started.
        if (std::string_view(broken.what()).find("pthread_create") != std::string_view::npos)
            return fail({ErrorCode::out_of_memory, broken.what(), "out of resources"});
        return fail({ErrorCode::internal, broken.what(), "internal error"});
    }
}

} // namespace
} // namespace terrane::cli

int main(int argc, char** argv) {
    terrane::cli::occupy_closed_streams();
    std::signal(SIGPIPE, SIG_IGN); // a closed pipe is a write that fails
    std::signal(SIGXFSZ, SIG_IGN); // so is a file beyond the limit of sizes
    terrane::keep_freed_memory();
    terrane::throw_on_gmp_out_of_memory();
    try {
        return static_cast<int>(terrane::cli::run_guarded(argc, argv));
    } catch (const std::bad_alloc&) { // not even the message about another error got memory
        return static_cast<int>(terrane::cli::fail_without_memory());
    }
}
