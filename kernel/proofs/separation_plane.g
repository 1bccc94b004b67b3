# SPDX-License-Identifier: LGPL-3.0-or-later
#
# SeparationFilter::is_beside() of kernel/separation_filter.hpp, law (1).
#
# The determinant of p exceeds (bound + room) (1 + f): bound as in orient3d.g, for sizes of 1, room the
# computed product of the normal's length and of share times the sum S of the sizes. The true
# determinant, at least the computed one less 46.0001 units, is the product of p's distance and the
# length of the true normal.
# rounding: bound (1 + f) covers the error of the determinant, so the rest is at least room (1 + f).
# error_term: the computed length has a term for the error of the normal, for sums of products of
# sizes 1. The true normal is at most so much longer than the computed one; see turn2d.g.
# factors: the length is rounded 4 times, S once, room twice, and its sum with bound once.
# uses: orient3d.g orient3d_factor 46.0001
# uses: turn2d.g turn2d_factor 8.0002
# least: orient3d_factor 46.001
# least: normal_error_factor 8.001
# least: separation_share 4.4409e-16

rounding = @orient3d_factor@ * 1b-52 * (1 + b1) * (1 + b2) * (1 + b3) * (1 + b4) * (1 + b5)
           * (1 + b6) * (1 + f);
error_term = @normal_error_factor@ * 1b-52 * (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5)
             * (1 + e6);
factors = (1 + l1) * (1 + l2) * (1 + l3) * (1 + l4) * (1 + s) * (1 + r1) * (1 + r2) * (1 + f);
distance = @separation_share@ * factors - @separation_least_distance@;

{ |b1| <= 1b-52 /\ |b2| <= 1b-52 /\ |b3| <= 1b-52 /\ |b4| <= 1b-52 /\ |b5| <= 1b-52 /\
  |b6| <= 1b-52 /\ |f| <= 1b-52 /\
  |e1| <= 1b-52 /\ |e2| <= 1b-52 /\ |e3| <= 1b-52 /\ |e4| <= 1b-52 /\ |e5| <= 1b-52 /\
  |e6| <= 1b-52 /\
  |l1| <= 1b-52 /\ |l2| <= 1b-52 /\ |l3| <= 1b-52 /\ |l4| <= 1b-52 /\ |s| <= 1b-52 /\
  |r1| <= 1b-52 /\ |r2| <= 1b-52
  -> rounding >= 0x2E.0010p-52 /\ error_term >= 0x8.0010p-52 /\ distance >= 0 }
