// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Allocation functions that fail on request, in place of operator new and of GMP's functions.
#pragma once

namespace failing {

/// Which allocations fail after arm(n).
enum class Mode {
    once, ///< the n-th alone, as where an array is too large
    from, ///< the n-th and all that follow it, as where memory is used up
};

/// Makes GMP allocate with functions of this file.
void take_over_gmp();

/// Makes allocations fail, counted from 0 in all threads; n < 0: none fails, but all are counted.
void arm(long n, Mode mode);

/// Lets all allocations succeed; returns how many were asked for since arm().
long disarm();

/// Number of blocks that operator new has given and that were not given back.
long living();

} // namespace failing
