// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/console.hpp>

#include <atomic>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <terrane/cli/session/styles.hpp>
#include <terrane/cli/session/terminal.hpp>
#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane::cli {
namespace {

/// Whether something that was asked for was printed to a closed standard output.
std::atomic<bool> is_result_lost = false;

} // namespace

ExitStatus status_of(ErrorCode code) {
    switch (code) {
    case ErrorCode::improper_contact:
    case ErrorCode::not_closed:
        return ExitStatus::negative;
    case ErrorCode::internal:
    case ErrorCode::out_of_memory:
        return ExitStatus::internal;
    default:
        return ExitStatus::bad_input;
    }
}

ExitStatus fail(const Error& error) {
    const bool interrupted = error.code == ErrorCode::interrupted;
    const auto message = interrupted ? "interrupted, nothing written" : error.message();
    print(stderr, complaint(message));
    return status_of(error.code);
}

void warn(std::string_view sentence) {
    print(stderr,
          fmt::format("{} {}\n", doubtful("terrane: warning:"), detail::one_line(sentence)));
}

void when_written(std::function<void()> tell) {
    if (FileSet::current() != nullptr)
        FileSet::current()->then(std::move(tell));
    else
        tell();
}

void tell_when_written(std::FILE* stream, std::string text) {
    when_written([stream, text = std::move(text)] { say(stream, text); });
}

void say_written(std::FILE* stream, const std::string& path) {
    if (path != "-") tell_when_written(stream, "wrote " + detail::one_line(path) + "\n");
}

void print(std::FILE* stream, std::string_view text) {
    if (stream == stdout && !text.empty() && !has_standard_output()) is_result_lost = true;
    write_text(stream, text);
}

void say(std::FILE* stream, std::string_view text) {
    if (!is_quiet()) write_text(stream, text);
}

std::string complaint(std::string_view sentence) {
    return fmt::format("{} {}\n", bad("terrane:"), detail::one_line(sentence));
}

void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) >= 0) continue;
        const int wrong_way = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
        // The lowest free number is that of the stream, as those below are open by now.
        [[maybe_unused]] const int opened = ::open("/dev/null", wrong_way);
    }
}

bool has_standard_output() {
    const int flags = ::fcntl(STDOUT_FILENO, F_GETFL);
    return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

ExitStatus finish(ExitStatus status) {
    if (has_standard_output() ? std::fflush(stdout) == 0 && std::ferror(stdout) == 0
                              : !is_result_lost)
        return status;
    if (status != ExitStatus::done && status != ExitStatus::negative) return status;
    return fail({ErrorCode::write_failed, "not all could be written", "standard output"});
}

std::string counted(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

} // namespace terrane::cli
