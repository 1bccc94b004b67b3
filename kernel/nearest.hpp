// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/kernel/numbers.hpp>

namespace terrane {

/// Returns the double nearest to numerator / denominator, ties to even; denominator != 0. The
/// result is correctly rounded among the denormals as well; overflow gives an infinity.
double nearest_quotient(const Exact& numerator, const Exact& denominator);

} // namespace terrane
