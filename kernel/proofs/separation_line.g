# SPDX-License-Identifier: LGPL-3.0-or-later
#
# SeparationFilter::is_beyond() of kernel/separation_filter.hpp, law (1), as in separation_plane.g with
# an edge in place of the normal: the length of the edge is a sum of two differences, each rounded.
# uses: turn2d.g turn2d_factor 8.0002
# least: turn2d_factor 8.001
# least: separation_share 4.4409e-16

rounding = @turn2d_factor@ * 1b-52 * (1 + b1) * (1 + b2) * (1 + b3) * (1 + b4) * (1 + f);
factors = (1 + l1) * (1 + l2) * (1 + s) * (1 + r1) * (1 + r2) * (1 + f);
distance = @separation_share@ * factors - @separation_least_distance@;

{ |b1| <= 1b-52 /\ |b2| <= 1b-52 /\ |b3| <= 1b-52 /\ |b4| <= 1b-52 /\ |f| <= 1b-52 /\
  |l1| <= 1b-52 /\ |l2| <= 1b-52 /\ |s| <= 1b-52 /\ |r1| <= 1b-52 /\ |r2| <= 1b-52
  -> rounding >= 0x8.0010p-52 /\ distance >= 0 }
