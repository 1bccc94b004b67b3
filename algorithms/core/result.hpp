// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Errors as values: Result<T> is a T, or the Error that kept it from being made. Its functions are
// those of std::expected (C++23) and mean the same.
#pragma once

#include <cassert>
#include <functional>
#include <string>
#include <type_traits>
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
    ErrorCode code = ErrorCode::internal; ///< what went wrong, by kind
    std::string sentence;                 ///< what is wrong, in a sentence without full stop
    std::string place;                    ///< "basin.ts:1204", "triangle 812", or empty

    /// "basin.ts:1204: VRTX needs 3 numbers"
    [[nodiscard]] std::string message() const {
        return place.empty() ? sentence : place + ": " + sentence;
    }
};

template <class T>
class Result;

/// The value of a Status: success has none of its own.
struct Done {
    friend constexpr bool operator==(const Done&, const Done&) { return true; }
};
/// Success without a value, or an Error. What and_then and transform call may take no argument.
using Status = Result<Done>;

namespace core::detail {

template <class T>
constexpr bool is_result = false;
template <class T>
constexpr bool is_result<Result<T>> = true;

/// Calls f(value); f() where the value is Done and f takes nothing.
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

/// A value, or the error that kept it from being made.
///
/// (1) operator*, operator-> and value() need ok(), error() needs !ok(): an assertion checks it.
///     Without assertions value() and error() throw std::bad_variant_access; * and -> do not check.
/// (2) and_then, or_else, transform and value_or of an rvalue move what it holds.
template <class T>
class [[nodiscard]] Result {
public:
    /// The type of the value.
    // NOLINTNEXTLINE(readability-identifier-naming): the name is the standard's
    using value_type = T;

    /// A value or an error becomes a Result without a cast.
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

    /// The value; see (1).
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
    /// The error; see (1).
    /// @{
    [[nodiscard]] constexpr const Error& error() const& {
        return assert(!ok()), std::get<1>(state_);
    }
    [[nodiscard]] constexpr Error& error() & { return assert(!ok()), std::get<1>(state_); }
    [[nodiscard]] constexpr Error&& error() && {
        return assert(!ok()), std::get<1>(std::move(state_));
    }
    /// @}

    /// The value, or `other` where there is none.
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

    /// f(value), itself a Result; or the error.
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

    /// This value; or f(error), which is of the same type.
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

    /// A Result of f(value), a Status where f returns nothing; or the error.
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
