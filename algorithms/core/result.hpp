// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace terrane {

/// What went wrong, by kind. Each code has a test that provokes it.
enum class ErrorCode {
    cannot_open,      ///< file missing, unreadable, or not writable
    bad_syntax,       ///< the file breaks its format
    bad_number,       ///< NaN, infinity, or a number that does not fit
    bad_index,        ///< a triangle names a vertex that does not exist
    unknown_format,   ///< extension not known
    unsupported,      ///< valid, but not something Terrane handles
    nothing_to_do,    ///< no surface, no triangle
    write_failed,     ///< disk full, or the like
    bad_option,       ///< an option's value makes no sense
    improper_contact, ///< triangles meet other than in a shared vertex or edge
    not_closed,       ///< a closed surface was needed
    out_of_memory,
    interrupted, ///< stop requested by the caller
    timed_out,   ///< a limit of time that the caller set is over
    internal,    ///< a promise was broken: please report
};

/// An error caused by data, as a value.
struct Error {
    ErrorCode code = ErrorCode::internal;
    std::string sentence; ///< what is wrong, in a sentence without full stop
    std::string place;    ///< "basin.ts:1204", "triangle 812", or empty

    /// "basin.ts:1204: VRTX needs 3 numbers"
    [[nodiscard]] std::string message() const {
        return place.empty() ? sentence : place + ": " + sentence;
    }
};

/// A value, or the error that kept it from being made.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::move(value)) {}     // NOLINT: implicit on purpose
    Result(Error error) : state_(std::move(error)) {} // NOLINT: implicit on purpose

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    [[nodiscard]] const T& value() const& { return std::get<0>(state_); }
    [[nodiscard]] T& value() & { return std::get<0>(state_); }
    [[nodiscard]] T&& value() && { return std::get<0>(std::move(state_)); }
    [[nodiscard]] const Error& error() const { return std::get<1>(state_); }

private:
    std::variant<T, Error> state_;
};

/// Success without a value.
struct Done {};
using Status = Result<Done>;

} // namespace terrane
