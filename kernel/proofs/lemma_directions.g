# SPDX-License-Identifier: LGPL-3.0-or-later
#
# measure() and Face::beyond() of algorithms/rounding/detail/separation_faces.cpp: functional_error bounds
# the error of the height above a face, and of the distance beyond an edge in its plane, for a point at
# the distance 1. See "In doubles" in docs/explanation/separation.md.
#
# The longest edge is 1; ratio is its square over the computed length of the cross product. By
# lemma_sizes.g the cross product errs by at most 13.86 units, so its direction by at most twice that
# over its length: | a/|a| - b/|b| | <= 2 |a - b| / |a|. `relative` is what the lengths of vectors add.
# All errors below are in units and divided by ratio; over is 1 / ratio.
# The unit normal: 27.72 from the cross product, and its coordinates are rounded 4.6 times (a length, a
# quotient, a product).
# of_height: a product of the normal and a difference adds 4.1 by the Cauchy-Schwarz inequality.
# of_beyond: besides, a cross product with an edge adds 3 sqrt(3), as |a_y b_z| + |a_z b_y| <= |a| |b|,
# and its division by the computed length of the edge 5.6.
# of_error: what the code takes, from rounded differences and sums of squares.
# least: lemma_direction_factor 47.4

of_error = @lemma_direction_factor@ * (1 + d1) * (1 + d2) * (1 + d3) * (1 + d4) * (1 + d5) * (1 + d6)
           * (1 + d7) * (1 + e1);
of_height = (27.72 + 8.7 * over) * relative;
of_beyond = (27.72 + 19.6 * over) * relative;

{ over in [0, 1.0002] /\ relative in [1, 1.0001] /\
  |d1| <= 1b-52 /\ |d2| <= 1b-52 /\ |d3| <= 1b-52 /\ |d4| <= 1b-52 /\ |d5| <= 1b-52 /\
  |d6| <= 1b-52 /\ |d7| <= 1b-52 /\ |e1| <= 1b-52
  -> of_error - of_height >= 0 /\ of_error - of_beyond >= 0 }
