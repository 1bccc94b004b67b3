// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Turns a struct of described options of the library (see Field) into one of C, and back. The one of
// C begins with struct_size; then come the described members in their order: first doubles, and lists as
// a pointer and a count, then numbers of 32 bits. scripts/option_reference.py compares names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/capi/detail/call.hpp>

namespace terrane::capi::detail {

/// Goes through the members of a struct of C.
template <class Byte>
class Members {
public:
    explicit Members(Byte* begin) : at_(begin) {}

    /// Calls visit(field, member) for the members of the options in the order of the struct.
    template <class Options, class Visit>
    void each(Options& options, const Visit& visit) {
        for (const bool is_wide : {true, false})
            std::remove_const_t<Options>::describe(
                [&]<class T>(const Field& field, T& value) {
                    if (std::is_integral_v<T> != is_wide) visit(field, value);
                },
                options);
    }
    template <class T>
    void put(T value) {
        std::memcpy(at_, &value, sizeof(T));
        at_ += sizeof(T);
    }
    template <class T>
    T take() {
        T value;
        std::memcpy(&value, at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }

private:
    Byte* at_;
};

/// Returns the struct of C with the values of options; lists are left out.
template <class Struct, class Options>
Struct struct_of(const Options& options) noexcept {
    static_assert(std::is_trivially_copyable_v<Struct>);
    Struct made{};
    made.struct_size = sizeof(Struct);
    Members members(reinterpret_cast<char*>(&made) + sizeof(std::size_t));
    members.each(options, [&]<class T>(const Field&, const T& value) {
        if constexpr (std::is_same_v<T, double>) {
            members.put(value);
        } else if constexpr (std::is_integral_v<T>) {
            members.put(static_cast<std::uint32_t>(value));
        } else {
            members.template put<const double*>(nullptr);
            members.template put<std::size_t>(0);
        }
    });
    return made;
}

/// Returns the options that a struct of C holds.
template <class Options, class Struct>
Options fields_of(const Struct& given) {
    Options options;
    Members members(reinterpret_cast<const char*>(&given) + sizeof(std::size_t));
    members.each(options, [&]<class T>(const Field& field, T& value) {
        if constexpr (std::is_same_v<T, double>) {
            value = members.template take<double>();
        } else if constexpr (std::is_integral_v<T>) {
            value = static_cast<T>(members.template take<std::uint32_t>());
        } else {
            const auto* const list = members.template take<const double*>();
            const auto count = members.template take<std::size_t>();
            need_array(list, count, field.name.data());
            value.assign(list, list + count);
        }
    });
    return options;
}

} // namespace terrane::capi::detail
