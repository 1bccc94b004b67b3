// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A function of the library, to be called again and again while allocations fail.
#pragma once

#include <functional>
#include <new>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/result.hpp>

#include "failing_allocator.hpp"

namespace failing {

/// What came of a call.
struct Answer {
    std::optional<terrane::Error> error{}; ///< it returned this
    bool threw = false;                    ///< it threw std::bad_alloc
    std::string text{};                    ///< it succeeded: describes the result
    long allocations = 0;
};

struct Stage {
    std::string name;
    bool returns_errors = true;  ///< else it may throw std::bad_alloc: it returns no Result
    bool starts_process = false; ///< a call takes milliseconds
    std::function<Answer(long n, Mode mode)> call;
};

template <class T>
constexpr bool is_result = false;
template <class T>
constexpr bool is_result<terrane::Result<T>> = true;

/// Makes a stage of work(prepare()), of which only the call of work counts, and text(result), which
/// describes the result. What is passed by value is to be copied in `prepare`: a copy that gets no
/// memory is the caller's exception.
template <class Prepare, class Work, class Text>
Stage stage_of(std::string name, Prepare prepare, Work work, Text text) {
    using Made = std::invoke_result_t<Work, std::invoke_result_t<Prepare>>;
    const auto call = [prepare, work, text](long n, Mode mode) {
        Answer answer;
        auto argument = prepare();
        arm(n, mode);
        try {
            Made made = work(std::move(argument));
            answer.allocations = disarm();
            if constexpr (is_result<Made>) {
                if (made)
                    answer.text = text(*made);
                else
                    answer.error = made.error();
            } else {
                answer.text = text(made);
            }
        } catch (const std::bad_alloc&) {
            answer.allocations = disarm();
            answer.threw = true;
        }
        return answer;
    };
    return {std::move(name), is_result<Made>, false, call};
}

template <class Work, class Text>
Stage stage(std::string name, Work work, Text text) {
    return stage_of(
        std::move(name), [] { return 0; }, [work](int) { return work(); }, text);
}

std::vector<Stage> stages_of_meshes();
std::vector<Stage> stages_of_models();
std::vector<Stage> stages_of_surfaces();
std::vector<Stage> stages_of_files();
std::vector<Stage> stages_of_outputs();
/// Stages of large models and of many: simplification, tiles, realisations.
std::vector<Stage> stages_of_scale();
/// All of these.
std::vector<Stage> all_stages();
/// Models large enough, and texts nested deeply enough, that a recursion shows in the stack.
std::vector<Stage> large_stages();

/// Calls each stage in a thread with a stack of this many KiB and with all signals blocked, and
/// then with a locale of commas. The results must be the usual ones. Returns the number of flaws.
int call_unusually(const std::vector<Stage>& stages, long stack_kib);

} // namespace failing
