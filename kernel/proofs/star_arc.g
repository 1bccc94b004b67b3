# SPDX-License-Identifier: LGPL-3.0-or-later
#
# add_arc() of algorithms/search/detail/stars.cpp, in units of 2^-52.
#
# An arc is cut at the directions of sums s a + t b of its ends, s + t = 1. The ends err by 8 (star_direction.g),
# products and sum by 2.2 more; the sum is longer than half of least_middle, which was computed.
# of_cut: the error of a cut, twice that of the sum over its length, and of its coordinates' computation.
# of_arc: an arc of at most a half circle is within the square of its chord over 4 of the chord. The chord's
# ends err by of_cut, so its square over 4 by twice that; the rest is for the rounding of square and box.
# least: star_arc_error 0x3020p-52

of_cut = 2 * 10.2 / (@star_least_middle@ / 2 * middle) + 8;
of_arc = 3 * of_cut + 20;
room = @star_arc_error@ * 1b52 - of_arc;

{ middle in [0.999, 1.001] -> room >= 0 }
