// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

// The filters rely on IEEE arithmetic: every operation rounds according to the rounding mode.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Terrane cannot be compiled with -ffast-math or -ffinite-math-only: its signs would be wrong"
#endif
