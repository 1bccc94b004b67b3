// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cfenv>

namespace terrane {

/// Sets the floating-point environment that a program starts with (rounding to nearest, denormals
/// kept, no traps) for its lifetime, in this thread, and gives back the caller's. Public functions
/// whose results depend on it begin with one, so that a caller's mode changes no bit of them.
/// for_ranges() and the like pass it on to their threads. Cost: 50 nanoseconds.
class StandardArithmetic {
public:
    StandardArithmetic() {
        std::fegetenv(&before_);
        std::fesetenv(FE_DFL_ENV);
    }
    ~StandardArithmetic() { std::fesetenv(&before_); }
    StandardArithmetic(const StandardArithmetic&) = delete;
    StandardArithmetic& operator=(const StandardArithmetic&) = delete;

private:
    std::fenv_t before_{};
};

} // namespace terrane
