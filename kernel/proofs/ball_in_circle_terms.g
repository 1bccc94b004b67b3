# SPDX-License-Identifier: LGPL-3.0-or-later
#
# filtered_in_circle() of kernel/ball_filter.hpp, its second bound, for one of the 12 monomials
# x1 x2 x3 x4 of the polynomial; all are bounded alike, and the sums over monomials keep it.
#
# value: the computed polynomial is the sum of its monomials, each times (1 + e1) ... (1 + e11): four
# differences, a square, the sum of two, a product, a difference of two, a product and two sums.
# terms: the computed sum of their absolute values likewise; all of its summands are positive. Its
# part of the bound is rounded at most 6 times more.
# slopes: the sum of the absolute partial derivatives, each at least its true value times
# (1 + s1) ... (1 + s12); its part of the bound is rounded 6 times more.
# The rest of the monomial with radii, of order 2 and more in e, is e e R; its part of the bound is
# rounded 8 times. The largest difference is 1 there.
# least: ball_terms_factor 11.1
# least: ball_slopes_factor 1.00001
# least: ball_second_order_factor 72.1

value = (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5) * (1 + e6)
        * (1 + e7) * (1 + e8) * (1 + e9) * (1 + e10) * (1 + e11);
terms = (1 + f1) * (1 + f2) * (1 + f3) * (1 + f4) * (1 + f5) * (1 + f6)
        * (1 + f7) * (1 + f8) * (1 + f9) * (1 + f10) * (1 + f11);
slopes = (1 + s1) * (1 + s2) * (1 + s3) * (1 + s4) * (1 + s5) * (1 + s6)
        * (1 + s7) * (1 + s8) * (1 + s9) * (1 + s10) * (1 + s11) * (1 + s12);
last = (1 + g1) * (1 + g2) * (1 + g3) * (1 + g4) * (1 + g5) * (1 + g6);
last8 = (1 + r1) * (1 + r2) * (1 + r3) * (1 + r4) * (1 + r5) * (1 + r6) * (1 + r7) * (1 + r8);

x4e = x4 + e * t4;  x3e = x3 + e * t3;
R34 = t3 * t4;
R234 = x2 * R34 + t2 * (t3 * x4e + x3 * t4);
R = x1 * R234 + t1 * (t2 * x3e * x4e + x2 * (t3 * x4e + x3 * t4));
with = (x1 + e * t1) * (x2 + e * t2) * (x3 + e * t3) * (x4 + e * t4);
linear = t1 * x2 * x3 * x4 + x1 * t2 * x3 * x4 + x1 * x2 * t3 * x4 + x1 * x2 * x3 * t4;
identity = (with - x1 * x2 * x3 * x4 - e * linear) - e * e * R;

{ |e1| <= 1b-52 /\ |e2| <= 1b-52 /\ |e3| <= 1b-52 /\ |e4| <= 1b-52 /\ |e5| <= 1b-52 /\
  |e6| <= 1b-52 /\ |e7| <= 1b-52 /\ |e8| <= 1b-52 /\ |e9| <= 1b-52 /\ |e10| <= 1b-52 /\
  |e11| <= 1b-52 /\
  |f1| <= 1b-52 /\ |f2| <= 1b-52 /\ |f3| <= 1b-52 /\ |f4| <= 1b-52 /\ |f5| <= 1b-52 /\
  |f6| <= 1b-52 /\ |f7| <= 1b-52 /\ |f8| <= 1b-52 /\ |f9| <= 1b-52 /\ |f10| <= 1b-52 /\
  |f11| <= 1b-52 /\
  |s1| <= 1b-52 /\ |s2| <= 1b-52 /\ |s3| <= 1b-52 /\ |s4| <= 1b-52 /\ |s5| <= 1b-52 /\
  |s6| <= 1b-52 /\ |s7| <= 1b-52 /\ |s8| <= 1b-52 /\ |s9| <= 1b-52 /\ |s10| <= 1b-52 /\
  |s11| <= 1b-52 /\ |s12| <= 1b-52 /\
  |g1| <= 1b-52 /\ |g2| <= 1b-52 /\ |g3| <= 1b-52 /\ |g4| <= 1b-52 /\ |g5| <= 1b-52 /\
  |g6| <= 1b-52 /\
  |r1| <= 1b-52 /\ |r2| <= 1b-52 /\ |r3| <= 1b-52 /\ |r4| <= 1b-52 /\ |r5| <= 1b-52 /\
  |r6| <= 1b-52 /\ |r7| <= 1b-52 /\ |r8| <= 1b-52 /\
  |x1| <= 1 /\ |x2| <= 1 /\ |x3| <= 1 /\ |x4| <= 1 /\
  |t1| <= 1 /\ |t2| <= 1 /\ |t3| <= 1 /\ |t4| <= 1 /\ e in [0, @ball_in_circle_widest_rounded@]
  -> |value - 1| - @ball_terms_factor@ * 1b-52 * terms * last <= 0 /\
     @ball_slopes_factor@ * slopes * last >= 1 /\
     12 * |R| - @ball_second_order_factor@ * last8 <= 0 /\ identity in [0, 0] }

identity -> 0;
