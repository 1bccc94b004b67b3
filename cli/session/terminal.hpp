// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The output of the program: colours, silence, and the progress line, which other output
// never runs into. There is one terminal per process, so its state is the process's, too.
#pragma once

#include <cstdio>
#include <string_view>

namespace terrane::cli {

enum class Colours {
    automatic, ///< on a terminal that has colours, unless NO_COLOR is set
    always,
    never,
};

struct OutputSettings {
    Colours colours = Colours::automatic;
    bool quiet = false; ///< neither summaries nor progress
};

/// Sets what holds from now on. Call it before other threads are started.
void set_output(const OutputSettings& settings);
[[nodiscard]] bool is_quiet();
[[nodiscard]] bool has_colours(std::FILE* stream);

/// Tells whether progress is shown: standard error is a terminal that can clear a line, and --quiet
/// is not given.
[[nodiscard]] bool shows_progress();

/// Replaces the progress line on standard error. It does nothing while other output is being
/// written, or while the program is not in the foreground.
void draw_progress(std::string_view text);
void clear_progress();

/// Writes text, clear of the progress line.
void write_text(std::FILE* stream, std::string_view text);

} // namespace terrane::cli
