# SPDX-License-Identifier: LGPL-3.0-or-later
#
# operator/ of kernel/double_double.hpp, in the rounding mode "to nearest".
#
# The true quotient is first + second and the quotient of the remainder, whose bound the products and
# differences carry, by the true divisor b. |b| >= |hi| - |lo| - err. Where the computed difference is
# positive, d = ((X - |lo|) (1 + f2) - err) (1 + f3) <= X (1 + f2) (1 + f3) - |lo| - err, as a factor above 1
# makes a positive number larger, and a factor below 1 does not make it larger; X = |hi| share is rounded.
# of_high: that product over |hi|, which must not exceed 1.
# kept: what the rounding of the bound leaves: the size of the remainder, the sum with its bound, the
# quotient, the product and two sums.
# least: twofold_divisor_factor 1.51
# least: twofold_quotient_factor 3.05

share = 1 - @twofold_divisor_factor@ * 1b-52;
of_high = share * (1 + f1) * (1 + f2) * (1 + f3);
kept = (1 + @twofold_quotient_factor@ * 1b-52) * (1 + f1) * (1 + f2) * (1 + f3) * (1 + f4) * (1 + f5) * (1 + f6);

{ |f1| <= 1b-53 /\ |f2| <= 1b-53 /\ |f3| <= 1b-53 /\ |f4| <= 1b-53 /\ |f5| <= 1b-53 /\
  |f6| <= 1b-53
  -> of_high <= 1 /\ kept >= 1 }
