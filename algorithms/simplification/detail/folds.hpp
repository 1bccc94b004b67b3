// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/simplification/detail/complex.hpp>

namespace terrane::simplification::detail {

/// Removes the parts in which a surface lies folded on itself, an even number of times, and which
/// stick out from the rest of it by no more than vertices may still move. They are the rest of
/// strips between curves that became one.
void remove_folds(Complex& complex, double max_move);

} // namespace terrane::simplification::detail
