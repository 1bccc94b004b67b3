// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// Tells whether an error has nothing to do with the input, so that another way fails as well, and
/// its caller is to know it.
inline bool is_external(ErrorCode code) {
    return code == ErrorCode::interrupted || code == ErrorCode::out_of_memory;
}

} // namespace terrane
