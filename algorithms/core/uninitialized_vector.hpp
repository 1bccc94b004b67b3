// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace terrane {

/// Allocator that default-initialises elements instead of zero-filling them. It saves one pass over
/// an array whose elements are all overwritten anyway.
template <class T>
struct UninitializedAllocator : std::allocator<T> {
    // NOLINTBEGIN(readability-identifier-naming): the names are the standard's
    template <class U>
    struct rebind {
        using other = UninitializedAllocator<U>;
    };
    // NOLINTEND(readability-identifier-naming)

    template <class U, class... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) == 0)
            ::new (static_cast<void*>(at)) U;
        else
            ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
};

/// A vector whose resize leaves new elements uninitialised, for types without a default constructor
/// of their own.
template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

} // namespace terrane
