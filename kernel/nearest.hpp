// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/kernel/numbers.hpp>

namespace terrane {

/// The double nearest to numerator / denominator, ties to even; denominator != 0. Correctly rounded
/// also among the denormals; beyond the largest double an infinity.
double nearest_quotient(const Exact& numerator, const Exact& denominator);

} // namespace terrane
