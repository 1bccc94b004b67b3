# SPDX-License-Identifier: LGPL-3.0-or-later
#
# ClusterFrame::error_between() of algorithms/rounding/detail/cluster_frame.cpp, in any rounding mode.
#
# The sizes of the terms and of the difference from the origin add up to 1, which is computed with at most
# seven roundings. A term was rounded twice, as a sum and as a product, and the difference once; the two
# sums and the last difference of terms are rounded once each.
# lost: all that in units of 2^-52; what higher powers add is below .001. room: what the code takes.
# kept: what a factor leaves of the errors of the coordinates, sums of products, and of the length of sums.
# least: frame_error_factor 5.04

lost = 2 + 1 + 1 + 1 + 0.001;
seven = (1 + f1) * (1 + f2) * (1 + f3) * (1 + f4) * (1 + f5) * (1 + f6) * (1 + f7);
room = @frame_error_factor@ * seven * (1 + f8) - lost;
kept = (1 + @frame_error_factor@ * 1b-52) * (1 + f1) * (1 + f2) * (1 + f3) * (1 + f4) * (1 + f5);

{ |f1| <= 1b-52 /\ |f2| <= 1b-52 /\ |f3| <= 1b-52 /\ |f4| <= 1b-52 /\ |f5| <= 1b-52 /\
  |f6| <= 1b-52 /\ |f7| <= 1b-52 /\ |f8| <= 1b-52
  -> room >= 0 /\ kept >= 1 }
