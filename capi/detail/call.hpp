// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The border between C and C++: exceptions and errors become codes, and arguments are checked.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/must.hpp>
#include <terrane/capi/base.h>
#include <terrane/kernel/point.hpp>

namespace terrane::capi::detail {

/// A mistake of the caller. It is thrown within a call and never leaves it.
struct BadArgument {
    const char* argument; ///< its name
    const char* sentence; ///< names the flaw
};

/// Hands an error to the caller, where it is wanted, and returns its code. Where memory does not
/// suffice for it, the error is about that.
terrane_code report(const Error& failure, terrane_error** error) noexcept;
terrane_code report(const BadArgument& bad, terrane_error** error) noexcept;

/// Runs the work of a function, which may throw errors, and returns the code of its outcome.
template <class Work>
terrane_code call(terrane_error** error, const Work& work) noexcept {
    if (error) *error = nullptr;
    try {
        const Status done = guarded("for this call", "C interface", [&]() -> Status {
            work();
            return Done{};
        });
        return done ? TERRANE_OK : report(done.error(), error);
    } catch (const Failure& failure) {
        return report(failure.error, error);
    } catch (const BadArgument& bad) {
        return report(bad, error);
    } catch (...) {
        return report(Error{ErrorCode::internal, "unknown exception", ""}, error);
    }
}

/// Runs work that makes a handle or throws an error, and hands the handle out.
template <class Handle, class Work>
terrane_code produce(Handle** out, terrane_error** error, const Work& work) noexcept {
    if (out) *out = nullptr;
    return call(error, [&] {
        if (!out) throw BadArgument{"out", "is null"};
        std::unique_ptr<Handle> made = work();
        made->is_whole = true;
        *out = made.release();
    });
}

/// Runs a function that must not fail but may lack memory; returns `otherwise` then.
template <class T, class Work>
T quietly(T otherwise, const Work& work) noexcept {
    try {
        return work();
    } catch (...) {
        return otherwise;
    }
}

/// Returns the handle if it is one of this type, else nullptr. All handles begin with their type.
template <class Handle>
Handle* known(Handle* handle) noexcept {
    return handle && handle->kind == Handle::own_kind ? handle : nullptr;
}

/// Frees a handle of this type, unless it is part of another one.
template <class Handle>
void release(Handle* handle) noexcept {
    if (known(handle) && handle->is_whole) delete handle;
}

/// Returns a handle that must be there.
template <class Handle>
Handle& needed(Handle* handle, const char* argument) {
    if (!handle) throw BadArgument{argument, "is null"};
    if (!known(handle)) throw BadArgument{argument, "is no handle of this type"};
    return *handle;
}

/// Returns a copy that terrane_text_free frees.
inline char* text_for_caller(const std::string& text) {
    auto* const copy = static_cast<char*>(std::malloc(text.size() + 1));
    if (!copy) throw std::bad_alloc();
    std::memcpy(copy, text.c_str(), text.size() + 1);
    return copy;
}

/// Checks an array that may be null only if it is empty.
inline void need_array(const void* array, std::size_t count, const char* argument) {
    if (!array && count > 0) throw BadArgument{argument, "is null, but its count is not 0"};
}

/// Returns a text that must be there.
inline const char* needed_text(const char* text, const char* argument) {
    if (!text) throw BadArgument{argument, "is null"};
    return text;
}

/// Returns the name of a file. "-", which the library takes for standard input or output, is none:
/// those belong to the program.
inline const char* needed_file(const char* path) {
    if (std::string_view(needed_text(path, "path")) == "-")
        throw BadArgument{"path", "is no file, but a standard stream"};
    return path;
}

/// Returns an option for which a negative number stands for the library's choice.
inline std::optional<double> number_or_default(double given, const char* argument) {
    if (std::isnan(given)) throw BadArgument{argument, "is not a number"};
    return given < 0 ? std::nullopt : std::optional(given);
}

/// Gives a C array of triples as points; the array need not be aligned.
std::vector<Point3> points_of(const double* numbers, std::size_t count);

/// Returns a read-only array, for getters; none if `values` is null.
template <class T, class V>
const T* array_of(const std::vector<V>* values, std::size_t* count) noexcept {
    static_assert(sizeof(V) % sizeof(T) == 0);
    if (count) *count = values ? values->size() : 0;
    return values ? reinterpret_cast<const T*>(values->data()) : nullptr;
}

/// Writes lists to *lists; without any if `found` is null.
terrane_code give_lists(const IndexLists<std::uint32_t>* found, terrane_lists* lists) noexcept;

/// Copies a text into a buffer, cut short where it is too small, and says how long it is.
void copy_text(std::string_view text, char* buffer, std::size_t size, std::size_t* length);

/// Refuses a struct of a caller whose member `reserved` is not 0, so that it can get a meaning.
template <class Struct>
void need_reserved(const Struct& given, const char* argument) {
    if constexpr (requires { given.reserved; })
        if (given.reserved != 0)
            throw BadArgument{argument, "has a member \"reserved\" that is not 0"};
}

/// Gives options their defaults. `size` is what the caller's compiler knows of them.
template <class Options>
terrane_code init_options(Options* options, std::size_t size, Options defaults) noexcept {
    if (!options || size < sizeof(std::size_t) || size > sizeof(Options))
        return TERRANE_BAD_ARGUMENT;
    defaults.struct_size = size;
    std::memcpy(options, &defaults, size);
    return TERRANE_OK;
}

/// Returns the options of a caller, whose struct may be shorter than this library's: what it lacks
/// has its default.
template <class Options>
Options options_of(const Options* options, Options defaults) {
    if (!options) return defaults;
    const std::size_t size = options->struct_size;
    if (size < sizeof(std::size_t) || size > sizeof(Options))
        throw BadArgument{"options", "has a struct_size that this library does not know"};
    std::memcpy(&defaults, options, size);
    need_reserved(defaults, "options");
    return defaults;
}

/// Copies a report into the caller's struct, which may be shorter than this library's.
template <class Report>
terrane_code give_report(const Report& found, Report* report, std::size_t size) noexcept {
    if (!report || size == 0 || size > sizeof(Report)) return TERRANE_BAD_ARGUMENT;
    std::memcpy(report, &found, size);
    return TERRANE_OK;
}

} // namespace terrane::capi::detail
