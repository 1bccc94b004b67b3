# SPDX-License-Identifier: LGPL-3.0-or-later
#
# filtered_in_circle() of kernel/ball_filter.hpp, its first bound.
#
# The differences of the given doubles are divided by the largest one: Au ... Cv. m is its computed
# size, e twice the radius. The true differences are au = Au + e tau, |tau| <= 1, and so on. Rounding
# errs by at most 128.0001 units (in_circle.g), the radii by e (Ta + Tb + Tc). The computed bound is
#   m^3 (1 + f1) (1 + f2) (rounding_factor 2^-52 m (1 + f3) + radius_factor e (1 + f4)) (1 + f5) (1 + f6).
# uses: in_circle.g in_circle_factor 128.0001
# least: ball_in_circle_radius_factor 48.15
# least: ball_in_circle_rounding_factor 128.01

common = m * m * m * (1 + f1) * (1 + f2) * (1 + f5) * (1 + f6);
first = @ball_in_circle_rounding_factor@ * 1b-52 * m * (1 + f3) * common;
second = @ball_in_circle_radius_factor@ * (1 + f4) * common;

au = Au + e * tau;  av = Av + e * tav;
bu = Bu + e * tbu;  bv = Bv + e * tbv;
cu = Cu + e * tcu;  cv = Cv + e * tcv;
La = Au * Au + Av * Av;  Ma = Bu * Cv - Bv * Cu;
la = au * au + av * av;  ma = bu * cv - bv * cu;
Ua = tau * (au + Au) + tav * (av + Av);
Va = (tbu * cv + Bu * tcv) - (tbv * cu + Bv * tcu);
Ta = Ua * ma + La * Va;
identity_a = (la * ma - La * Ma) - e * Ta;
Lb = Bu * Bu + Bv * Bv;  Mb = Cu * Av - Cv * Au;
lb = bu * bu + bv * bv;  mb = cu * av - cv * au;
Ub = tbu * (bu + Bu) + tbv * (bv + Bv);
Vb = (tcu * av + Cu * tav) - (tcv * au + Cv * tau);
Tb = Ub * mb + Lb * Vb;
identity_b = (lb * mb - Lb * Mb) - e * Tb;
Lc = Cu * Cu + Cv * Cv;  Mc = Au * Bv - Av * Bu;
lc = cu * cu + cv * cv;  mc = au * bv - av * bu;
Uc = tcu * (cu + Cu) + tcv * (cv + Cv);
Vc = (tau * bv + Au * tbv) - (tav * bu + Av * tbu);
Tc = Uc * mc + Lc * Vc;
identity_c = (lc * mc - Lc * Mc) - e * Tc;
T = Ta + Tb + Tc;

{ |Au| <= 1 /\ |Av| <= 1 /\ |Bu| <= 1 /\ |Bv| <= 1 /\ |Cu| <= 1 /\ |Cv| <= 1 /\
  |tau| <= 1 /\ |tav| <= 1 /\ |tbu| <= 1 /\ |tbv| <= 1 /\ |tcu| <= 1 /\ |tcv| <= 1 /\
  |m - 1| <= 1b-52 /\ e in [0, @ball_in_circle_widest_rounded@] /\
  |f1| <= 1b-52 /\ |f2| <= 1b-52 /\ |f3| <= 1b-52 /\ |f4| <= 1b-52 /\ |f5| <= 1b-52 /\
  |f6| <= 1b-52
  -> first >= 0x80.0010p-52 /\ |T| - second <= 0 /\
     identity_a in [0, 0] /\ identity_b in [0, 0] /\ identity_c in [0, 0] }

identity_a -> 0;
identity_b -> 0;
identity_c -> 0;
