// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Represents errors as values: Result<T> holds a T, or the Error that prevented it. Its functions
// have the names and meanings of those of std::expected (C++23).
#pragma once

#include <cassert>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace terrane {

/// The kinds of errors. Each code has a test that provokes it.
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
    out_of_memory,    ///< not enough memory
    interrupted,      ///< stop requested by the caller
    timed_out,        ///< the caller's time limit has passed
    internal,         ///< an assertion failed: please report
};

/// An error caused by data, as a value.
struct Error {
    ErrorCode code = ErrorCode::internal; ///< the kind of error
    std::string sentence;                 ///< names the flaw, without full stop
    std::string place;                    ///< "basin.ts:1204", "triangle 812", or empty

    /// Returns the place and the sentence: "basin.ts:1204: VRTX needs 3 numbers".
    [[nodiscard]] std::string message() const {
        return place.empty() ? sentence : place + ": " + sentence;
    }
};

template <class T>
class Result;

/// The value of a Status. It carries no data.
struct Done {
    friend constexpr bool operator==(const Done&, const Done&) { return true; }
};
/// Success without a value, or an Error. The functions given to and_then and transform may take no
/// argument.
using Status = Result<Done>;

namespace core::detail {

template <class T>
constexpr bool is_result = false;
template <class T>
constexpr bool is_result<Result<T>> = true;

/// Calls f(value), or f() if the value is Done and f takes no argument.
template <class F, class V>
constexpr decltype(auto) call_with(F&& f, V&& value) {
    if constexpr (std::is_same_v<std::remove_cvref_t<V>, Done> && std::is_invocable_v<F>)
        return std::invoke(std::forward<F>(f));
    else
        return std::invoke(std::forward<F>(f), std::forward<V>(value));
}

template <class F, class V>
using CallResult = std::remove_cvref_t<decltype(call_with(std::declval<F>(), std::declval<V>()))>;

} // namespace core::detail

/// A value, or the error that prevented it.
///
/// (1) operator*, operator-> and value() require ok(); error() requires !ok(). Assertions check it.
///     Without assertions value() and error() throw std::bad_variant_access; * and -> do not check.
/// (2) and_then, or_else, transform and value_or of an rvalue move its value or error.
template <class T>
class [[nodiscard]] Result {
public:
    /// The type of the value.
    // NOLINTNEXTLINE(readability-identifier-naming): the name is the standard's
    using value_type = T;

    /// Converts a value or an error to a Result implicitly.
    /// @{
    constexpr Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}     // NOLINT
    constexpr Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {} // NOLINT
    /// @}

    /// Whether there is a value.
    /// @{
    [[nodiscard]] constexpr bool ok() const noexcept { return state_.index() == 0; }
    [[nodiscard]] constexpr bool has_value() const noexcept { return ok(); }
    constexpr explicit operator bool() const noexcept { return ok(); }
    /// @}

    /// Returns the value; see (1).
    /// @{
    [[nodiscard]] constexpr const T& operator*() const& noexcept { return *held(); }
    [[nodiscard]] constexpr T& operator*() & noexcept { return *held(); }
    [[nodiscard]] constexpr T&& operator*() && noexcept { return std::move(*held()); }
    [[nodiscard]] constexpr const T* operator->() const noexcept { return held(); }
    [[nodiscard]] constexpr T* operator->() noexcept { return held(); }

    [[nodiscard]] constexpr const T& value() const& { return assert(ok()), std::get<0>(state_); }
    [[nodiscard]] constexpr T& value() & { return assert(ok()), std::get<0>(state_); }
    [[nodiscard]] constexpr T&& value() && { return assert(ok()), std::get<0>(std::move(state_)); }
    /// @}
    /// Returns the error; see (1).
    /// @{
    [[nodiscard]] constexpr const Error& error() const& {
        return assert(!ok()), std::get<1>(state_);
    }
    [[nodiscard]] constexpr Error& error() & { return assert(!ok()), std::get<1>(state_); }
    [[nodiscard]] constexpr Error&& error() && {
        return assert(!ok()), std::get<1>(std::move(state_));
    }
    /// @}

    /// Returns the value, or `other` if there is none.
    /// @{
    template <class U>
    [[nodiscard]] constexpr T value_or(U&& other) const& {
        return ok() ? **this : static_cast<T>(std::forward<U>(other));
    }
    template <class U>
    [[nodiscard]] constexpr T value_or(U&& other) && {
        return ok() ? *std::move(*this) : static_cast<T>(std::forward<U>(other));
    }
    /// @}

    /// Returns f(value), which is a Result, or the error.
    /// @{
    template <class F>
    constexpr auto and_then(F&& f) const& {
        return then(*this, std::forward<F>(f));
    }
    template <class F>
    constexpr auto and_then(F&& f) && {
        return then(std::move(*this), std::forward<F>(f));
    }
    /// @}

    /// Returns this value, or f(error), which has the type of this Result.
    /// @{
    template <class F>
    constexpr Result or_else(F&& f) const& {
        return ok() ? *this : Result(std::invoke(std::forward<F>(f), error()));
    }
    template <class F>
    constexpr Result or_else(F&& f) && {
        return ok() ? std::move(*this)
                    : Result(std::invoke(std::forward<F>(f), std::move(*this).error()));
    }
    /// @}

    /// Returns a Result with f(value) (a Status if f returns void), or the error.
    /// @{
    template <class F>
    constexpr auto transform(F&& f) const& {
        return transformed(*this, std::forward<F>(f));
    }
    template <class F>
    constexpr auto transform(F&& f) && {
        return transformed(std::move(*this), std::forward<F>(f));
    }
    /// @}

private:
    [[nodiscard]] constexpr const T* held() const noexcept {
        assert(ok());
        return std::get_if<0>(&state_);
    }
    [[nodiscard]] constexpr T* held() noexcept {
        assert(ok());
        return std::get_if<0>(&state_);
    }

    template <class Self, class F>
    static constexpr auto then(Self&& self, F&& f) {
        using Next = core::detail::CallResult<F, decltype(*std::forward<Self>(self))>;
        static_assert(core::detail::is_result<Next>,
                      "and_then takes a function that returns a Result");
        if (!self.ok()) return Next(std::forward<Self>(self).error());
        return Next(core::detail::call_with(std::forward<F>(f), *std::forward<Self>(self)));
    }

    template <class Self, class F>
    static constexpr auto transformed(Self&& self, F&& f) {
        using Value = core::detail::CallResult<F, decltype(*std::forward<Self>(self))>;
        if constexpr (std::is_void_v<Value>) {
            if (!self.ok()) return Status(std::forward<Self>(self).error());
            core::detail::call_with(std::forward<F>(f), *std::forward<Self>(self));
            return Status(Done{});
        } else {
            if (!self.ok()) return Result<Value>(std::forward<Self>(self).error());
            return Result<Value>(
                core::detail::call_with(std::forward<F>(f), *std::forward<Self>(self)));
        }
    }

    std::variant<T, Error> state_;
};

} // namespace terrane
