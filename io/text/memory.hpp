// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::detail {

/// Returns the result of step(), or the error out_of_memory at `place` if step() ran out of memory.
template <class Step>
auto guard_memory(std::string place, const Step& step) -> decltype(step()) {
    constexpr auto code = ErrorCode::out_of_memory;
    try {
        return step();
    } catch (const std::bad_alloc&) {
        return Error{code, "there is not enough memory", std::move(place)};
    } catch (const std::length_error&) {
        return Error{code, "there is not enough memory", std::move(place)};
    }
}

} // namespace terrane::detail
