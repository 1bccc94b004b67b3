// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/output_options.hpp>

#include <terrane/cli/options/choices.hpp>

namespace terrane::cli {
namespace {

constexpr const char* quiet_option = "--quiet";
constexpr const char* colour_option = "--color";

} // namespace

void add_output_options(CLI::App& command) {
    command.add_flag(quiet_option)
        ->description("No summary and no progress; warnings and errors stay")
        ->disable_flag_override(); // --quiet=false
    command.add_option(colour_option)
        ->description("Colours: auto, on terminals without NO_COLOR; always; never (default: auto)")
        ->check(one_of({"auto", "always", "never"}))
        ->type_name("WHEN");
}

OutputSettings output_settings(const CLI::App& program) {
    OutputSettings settings;
    for (const CLI::App* command : program.get_subcommands()) {
        if (const auto* quiet = command->get_option_no_throw(quiet_option))
            settings.quiet |= quiet->count() > 0;
        const auto* colours = command->get_option_no_throw(colour_option);
        if (colours == nullptr || colours->count() == 0) continue;
        const std::string& word = colours->results().back();
        settings.colours = word == "always"  ? Colours::always
                           : word == "never" ? Colours::never
                                             : Colours::automatic;
    }
    return settings;
}

} // namespace terrane::cli
