# SPDX-License-Identifier: LGPL-3.0-or-later
#
# direction() and box_across() of algorithms/search/detail/stars.cpp.
#
# unit: a coordinate of the computed direction over the true one. It was rounded as a difference, by the
# largest one and by the length. The square of the length is a sum of positive terms, each rounded by w:
# twice as often, as a square, and twice in the sum. Squares that underflow add 2^-1072 to a number above 1/4.
# In units of 2^-52, for directions a and x of length 1, of which the code has a (1 + da) and x (1 + dx):
# of_dot: the error of their product p over the sum of |a_i x_i|, which is at most 1.
# of_across: that of a coordinate of a - p x, in its parts.
# widening: boxes have across_error over the computed sine. A coordinate of the direction across errs by
# of_across and by the error of the sine, sqrt(3) times as much at most, over the computed sine; the quotient
# and the box are rounded, which adds 8 units as the sine is at most 1.
# least: star_across_error 0x7c.1p-52

w = (1 + a1) * (1 + a1) * (1 + b1) * (1 + b1) * (1 + c1) * (1 + s1) * (1 + s2);
unit = (1 + a2) * (1 + b2) * (1 + d) / (sqrt(w) * (1 + r));
of_dot = ((1 + da) * (1 + dx) * (1 + c1) * (1 + s1) * (1 + s2) - 1) * 1b52;
of_across = a * (da + s1 + da * s1) - p * x * ((1 + dx) * (1 + c1) * (1 + s1) - 1)
            - 1b-52 * dot * x * (1 + dx) * (1 + c1) * (1 + s1);
identity = (a * (1 + da) - (p + 1b-52 * dot) * x * (1 + dx) * (1 + c1)) * (1 + s1) - (a - p * x) - of_across;
widening = @star_across_error@ * 1b52 * (1 + d);

{ |a1| <= 1b-52 /\ |a2| <= 1b-52 /\ |b1| <= 1b-52 /\ |b2| <= 1b-52 /\ |c1| <= 1b-52 /\ |s1| <= 1b-52 /\
  |s2| <= 1b-52 /\ |d| <= 1b-52 /\ |r| <= 1b-52 /\ |da| <= 8b-52 /\ |dx| <= 8b-52 /\
  |a| <= 1 /\ |x| <= 1 /\ |p| <= 1 /\ |dot| <= 20
  -> |unit - 1| <= 8b-52 /\ |of_dot| <= 20 /\ |of_across| <= 42b-52 /\ widening >= 124 /\
     identity in [0, 0] }

identity -> 0;
