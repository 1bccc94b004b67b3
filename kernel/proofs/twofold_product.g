# SPDX-License-Identifier: LGPL-3.0-or-later
#
# operator* of kernel/double_double.hpp, in the rounding mode "to nearest".
#
# Two numbers hold the product of the high parts exactly (fma). The mixed terms M and N are rounded: their
# computed sizes and that of what the fma leaves add up to 1, so the three add up to q, |q| <= 1, and
# mixed is M + N, |mixed| <= 1. terms: both were rounded by 2^-53 of themselves. The product of the low
# parts is added to the bound, as are those of the given errors.
# room: what the code takes for the rounding of the terms and of their sum. kept: what the rounding of the
# bound leaves: no term of it is rounded more than eight times, and normal() multiplies once more.
# least: twofold_product_factor 1.51
# least: twofold_renormalised 0x9.0cp-53

lost = terms + mixed * e3 + (q + mixed * e3) * e4;
eight = (1 + f1) * (1 + f2) * (1 + f3) * (1 + f4) * (1 + f5) * (1 + f6) * (1 + f7) * (1 + f8);
room = @twofold_product_factor@ * 1b-52 * eight * (1 + f9);
kept = (1 + @twofold_renormalised@) * eight * (1 + f9);

{ |terms| <= 0x1.001p-53 /\ |mixed| <= 1 /\ |q| <= 1 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53 /\
  |f1| <= 1b-53 /\ |f2| <= 1b-53 /\ |f3| <= 1b-53 /\ |f4| <= 1b-53 /\ |f5| <= 1b-53 /\
  |f6| <= 1b-53 /\ |f7| <= 1b-53 /\ |f8| <= 1b-53 /\ |f9| <= 1b-53
  -> room - |lost| >= 0 /\ kept >= 1 }
