// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs stages of the library for Python.
//
// (1) The stage runs in a thread that is kept for stages, without the GIL. The calling thread waits, and every 50 ms looks
//     for signals and calls the progress callback, so that a KeyboardInterrupt stops a stage of any length.
// (2) An exception of a signal handler or of the callback requests a stop. A stage that has not ended after
//     0.8 s more is left to end by itself, and the exception is raised. So the work must own what it uses, and
//     hold no object of Python.
// (3) The GIL is taken again at one place, which threads do not pass any more once the interpreter ends.
// (4) Errors of the library become terrane.Error, except that lack of memory becomes a MemoryError.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

#include <terrane/algorithms/core/must.hpp>
#include <terrane/algorithms/core/run.hpp>

namespace terrane::python {

namespace py = pybind11;

/// How a stage runs: the keyword arguments threads and progress.
struct HowToRun {
    unsigned threads = 1;
    py::object progress = py::none(); ///< callable (stage: str, share: float), or None
};

/// Calls the work in a thread as (1) to (3) say. The GIL is held.
void run_watched(const HowToRun& how, std::function<void(const Run&)> work);

/// Stops all stages and waits for them, those that were left by (2) among them; at the end of the interpreter.
void end_stages();

/// Runs a stage, `work(const Run&)`, and returns what it returns; the value, if that is a Result.
template <class Work>
auto run_stage(const HowToRun& how, Work work) {
    using Made = decltype(work(std::declval<const Run&>()));
    const auto shared = std::make_shared<Work>(std::move(work));
    if constexpr (std::is_void_v<Made>) {
        run_watched(how, [shared](const Run& run) { (*shared)(run); });
    } else {
        const auto made = std::make_shared<std::optional<Made>>();
        run_watched(how, [made, shared](const Run& run) { made->emplace((*shared)(run)); });
        if constexpr (core::detail::is_result<Made>)
            return must(std::move(made->value()));
        else
            return std::move(made->value());
    }
}

/// Registers the translation of (4).
void translate_errors();

} // namespace terrane::python
