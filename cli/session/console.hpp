// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Output to the terminal, and the exit status of the program. The library itself prints nothing.
#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::cli {

enum class ExitStatus {
    done = 0,
    negative = 1,  ///< the answer is "no": findings, or no conforming mesh of doubles
    bad_input = 2, ///< bad input or usage, cannot read or write, interrupted
    internal = 3,  ///< a guarantee did not hold, or out of memory
};

ExitStatus status_of(ErrorCode code);

/// Writes "terrane: basin.ts:1204: VRTX needs 3 numbers" to standard error and returns the exit
/// status for the error.
ExitStatus fail(const Error& error);

/// Writes "terrane: warning: ..." to standard error.
void warn(std::string_view sentence);

/// Calls `tell` when all files of the run have their names, or at once outside a FileSet.
void when_written(std::function<void()> tell);

/// Says a text when all files of the run have their names.
void tell_when_written(std::FILE* stream, std::string text);

/// Says that a file was written, when it has its name; nothing of standard output.
void say_written(std::FILE* stream, const std::string& path);

/// Writes a result of the command. Marks in the text (styles.hpp) become colours where the stream
/// has colours. finish() reports a failure to write.
void print(std::FILE* stream, std::string_view text);

/// Writes what nobody asked for: summaries, and names of files that were written. Nothing with
/// --quiet.
void say(std::FILE* stream, std::string_view text);

/// Returns "terrane: SENTENCE" as a line, marked as an error.
std::string complaint(std::string_view sentence);

/// Gives the numbers of closed standard streams to /dev/null, opened the wrong way round, so that no
/// file of ours gets them and is read or printed to by mistake. Call it before any file is opened.
void occupy_closed_streams();

/// Tells whether standard output can be written to: a caller that has closed it wants no summary.
bool has_standard_output();

/// Returns `status`, or bad_input if standard output did not take all that was printed. Where the
/// caller has closed it only results are missed, no summary.
ExitStatus finish(ExitStatus status);

/// Returns the count with its noun: "1 triangle", "2 triangles".
std::string counted(std::size_t count, std::string_view noun);

/// Returns line(item) of the first items of a list, and says how many more there are.
template <class List, class Line>
std::string listed(const List& list, std::size_t most, const Line& line,
                   const std::string& rest = {}) {
    std::string text;
    for (std::size_t i = 0; i < list.size() && i < most; ++i) text += line(list[i]);
    if (list.size() <= most) return text;
    return text + "  and " + std::to_string(list.size() - most) + " more" + rest + "\n";
}

} // namespace terrane::cli
