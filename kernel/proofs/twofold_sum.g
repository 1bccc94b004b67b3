# SPDX-License-Identifier: LGPL-3.0-or-later
#
# operator+ and error() of kernel/double_double.hpp, in the rounding mode "to nearest".
#
# Two numbers hold the sum of the high parts exactly (Dekker), and so normal() holds high + low. What is
# lost is lost by adding the low parts: S is the sum of the given ones, R what the high parts leave; their
# sizes are at most low and rest, which add up to 1.
# room: what the code takes for that. kept: what the rounding of the bound leaves of all of it; the errors
# and sizes are added with at most four roundings, and normal() multiplies once more.
# total: error() over the sum that it bounds.
# least: twofold_sum_factor 1.51
# least: twofold_size_factor 1.02

low = 1 - rest;
S = s * low;
R = r * rest;
lost = S * e1 + (R + S * (1 + e1)) * e2;
roundings = (1 + f1) * (1 + f2) * (1 + f3) * (1 + f4) * (1 + f5);
room = @twofold_sum_factor@ * 1b-52 * roundings;
kept = (1 + @twofold_renormalised@) * roundings;
total = (1 + @twofold_size_factor@ * 1b-52) * (1 + f1) * (1 + f2);

{ rest in [0, 1] /\ |s| <= 1 /\ |r| <= 1 /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\
  |f1| <= 1b-53 /\ |f2| <= 1b-53 /\ |f3| <= 1b-53 /\ |f4| <= 1b-53 /\ |f5| <= 1b-53
  -> room - |lost| >= 0 /\ kept >= 1 /\ total >= 1 }
