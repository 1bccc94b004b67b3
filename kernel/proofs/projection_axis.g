# SPDX-License-Identifier: LGPL-3.0-or-later
#
# static_projection_axis() of kernel/predicates.cpp: x > y + bound for the computed minors shows that
# the true ones compare likewise.
#
# The differences are divided by the largest one; m is its computed size. Each minor errs by at most
# turn2d_factor: x by ex, y by ey (turn2d.g; the sizes are at most 1, and no bound is rounded here).
# Since x is at least the computed sum, the true difference is at least gap.
# uses: turn2d.g turn2d_factor 8.0002
# least: projection_axis_factor 18.002

q = mul_rel<52>(by, cx);
y = sub_rel<52>(p, q);
bound = mul_rel<52>(mul_rel<52>(@projection_axis_factor@ * 1b-52, m), m);
sum = add_rel<52>(y, bound);
gap = (sum - (y + bound)) + bound - ex - ey;

{ y in [0, 2.0001] /\ |ex| <= 0x8.0010p-52 /\ |ey| <= 0x8.0010p-52 /\ |m - 1| <= 1b-52
  -> gap >= 0 }
