# SPDX-License-Identifier: LGPL-3.0-or-later
#
# filtered_orient2d() of kernel/ball_filter.hpp, for points within a radius.
#
# The differences are divided by the largest one, M; m is its computed size, e twice the radius. Each
# true difference is a difference of the given doubles plus e t, |t| <= 1. Rounding errs by at most
# 8.0001 units (turn2d.g, as all sizes are at most 1), the radii by e T. The computed bound is
#   ((turn2d_factor 2^-52 m (1 + f1) + radius_factor e (1 + f2)) (1 + f3)) m (1 + f4).
# Its first part is at least the rounding error, its second part at least e |T|.
# uses: turn2d.g turn2d_factor 8.0002
# least: ball_turn2d_radius_factor 4.2501
# least: turn2d_factor 8.0003

first = @turn2d_factor@ * 1b-52 * m * (1 + f1) * (1 + f3) * m * (1 + f4);
second = @ball_turn2d_radius_factor@ * (1 + f2) * (1 + f3) * m * (1 + f4);

Given = Bu * Cv - Bv * Cu;
True = (Bu + e * t1) * (Cv + e * t2) - (Bv + e * t3) * (Cu + e * t4);
T = (t1 * (Cv + e * t2) + Bu * t2) - (t3 * (Cu + e * t4) + Bv * t4);
identity = (True - Given) - e * T;

{ |Bu| <= 1 /\ |Bv| <= 1 /\ |Cu| <= 1 /\ |Cv| <= 1 /\
  |t1| <= 1 /\ |t2| <= 1 /\ |t3| <= 1 /\ |t4| <= 1 /\
  |m - 1| <= 1b-52 /\ e in [0, @ball_turn2d_widest_rounded@] /\
  |f1| <= 1b-52 /\ |f2| <= 1b-52 /\ |f3| <= 1b-52 /\ |f4| <= 1b-52
  -> first >= 0x8.0010p-52 /\ |T| - second <= 0 /\ identity in [0, 0] }

identity -> 0;
