// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Errors as exceptions, for the borders of the library alone: the program and the interfaces of C and Python catch
// them where their calls end.
#pragma once

#include <string>
#include <utility>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// An error on its way to the border. It never leaves that.
struct Failure {
    Error error;
};

/// Returns the value, or throws the error.
template <class T>
T must(Result<T> result) {
    if (!result) throw Failure{std::move(result).error()};
    return std::move(result).value();
}

/// The same, with another place in the error.
template <class T>
T must(Result<T> result, const std::string& place) {
    if (!result) throw Failure{{result.error().code, result.error().sentence, place}};
    return std::move(result).value();
}

/// Throws an error; without a code, that about an option.
/// @{
[[noreturn]] inline void refuse(ErrorCode code, std::string sentence, std::string place) {
    throw Failure{{code, std::move(sentence), std::move(place)}};
}
[[noreturn]] inline void refuse(std::string sentence, std::string place = {}) {
    refuse(ErrorCode::bad_option, std::move(sentence), std::move(place));
}
/// @}

} // namespace terrane
