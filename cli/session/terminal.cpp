// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/terminal.hpp>

#include <chrono>
#include <cstdlib>
#include <mutex>
#include <string>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <terrane/cli/session/styles.hpp>
#include <terrane/cli/session/text_width.hpp>

namespace terrane::cli {
namespace {

constexpr std::string_view clear_sequence = "\r\033[K";

/// How long output waits for other output. A thread that writes to a stopped terminal must not keep
/// the program from ending.
constexpr std::chrono::milliseconds longest_wait{300};

struct TerminalState {
    OutputSettings settings;
    std::timed_mutex mutex; ///< guards the streams, and what follows
    std::string line;       ///< the progress line that is shown; empty: none
};

TerminalState& terminal() {
    static TerminalState state;
    return state;
}

/// Tells whether the stream is a terminal that knows escape sequences.
bool is_capable(std::FILE* stream) {
    const char* const kind = std::getenv("TERM");
    return isatty(fileno(stream)) == 1 && kind != nullptr && *kind != '\0' &&
           std::string_view(kind) != "dumb";
}

bool is_set(const char* variable) {
    const char* const value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

std::size_t columns_of_terminal() {
    constexpr std::size_t usual = 80;
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual;
    return size.ws_col;
}

/// Tells whether the shell has put the program into the background, where it must not draw.
bool is_in_background() {
    const pid_t foreground = tcgetpgrp(STDERR_FILENO);
    return foreground >= 0 && foreground != getpgrp();
}

void write_raw(std::FILE* stream, std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stream);
}

/// The caller holds the mutex.
void erase_line() {
    if (terminal().line.empty()) return;
    write_raw(stderr, clear_sequence);
    std::fflush(stderr);
    terminal().line.clear();
}

} // namespace

void set_output(const OutputSettings& settings) {
    terminal().settings = settings;
}

bool is_quiet() {
    return terminal().settings.quiet;
}

bool has_colours(std::FILE* stream) {
    switch (terminal().settings.colours) {
    case Colours::always:
        return true;
    case Colours::never:
        return false;
    case Colours::automatic:
        break;
    }
    return is_capable(stream) && !is_set("NO_COLOR");
}

bool shows_progress() {
    return !is_quiet() && is_capable(stderr);
}

void draw_progress(std::string_view text) {
    const std::unique_lock lock(terminal().mutex, std::try_to_lock);
    if (!lock || is_in_background()) return;
    const std::string cut(cut_to(text, columns_of_terminal() - 1)); // the last column would wrap
    if (cut == terminal().line) return;
    write_raw(stderr, fmt::format("{}{}", clear_sequence, cut));
    std::fflush(stderr);
    terminal().line = cut;
}

void clear_progress() {
    const std::unique_lock lock(terminal().mutex, longest_wait);
    if (lock) erase_line();
}

void write_text(std::FILE* stream, std::string_view text) {
    const std::unique_lock lock(terminal().mutex, longest_wait);
    if (lock) erase_line();
    if (is_plain(text)) // which also needs no memory
        write_raw(stream, text);
    else
        write_raw(stream, rendered(text, has_colours(stream)));
    if (shows_progress()) std::fflush(stream); // before the next progress line
}

} // namespace terrane::cli
