// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names the constants of a stage for reports.
#pragma once

#include <string_view>

namespace terrane {

/// A constant that decides the result of a stage and is not an option.
struct NamedConstant {
    std::string_view name; ///< as its stage declares it
    double value = 0;      ///< in the unit that its stage states
};

} // namespace terrane
