# SPDX-License-Identifier: LGPL-3.0-or-later
#
# static_in_circle() of kernel/predicates.cpp, derivation (3) of kernel/static_filter_bounds.hpp.
#
# The differences are divided by the largest one; m is its computed size.
# least: in_circle_factor 128.0001

au = sub_rel<52>(a_u, d_u);  Au = a_u - d_u;
av = sub_rel<52>(a_v, d_v);  Av = a_v - d_v;
bu = sub_rel<52>(b_u, d_u);  Bu = b_u - d_u;
bv = sub_rel<52>(b_v, d_v);  Bv = b_v - d_v;
cu = sub_rel<52>(c_u, d_u);  Cu = c_u - d_u;
cv = sub_rel<52>(c_v, d_v);  Cv = c_v - d_v;

auu = mul_rel<52>(au, au) + h1;  avv = mul_rel<52>(av, av) + h2;
la = add_rel<52>(auu, avv);  La = Au * Au + Av * Av;
bc = mul_rel<52>(bu, cv) + h3;  cb = mul_rel<52>(bv, cu) + h4;
ma = sub_rel<52>(bc, cb);  Ma = Bu * Cv - Bv * Cu;
ta = mul_rel<52>(la, ma) + h5;
buu = mul_rel<52>(bu, bu) + h6;  bvv = mul_rel<52>(bv, bv) + h7;
lb = add_rel<52>(buu, bvv);  Lb = Bu * Bu + Bv * Bv;
ca = mul_rel<52>(cu, av) + h8;  ac = mul_rel<52>(cv, au) + h9;
mb = sub_rel<52>(ca, ac);  Mb = Cu * Av - Cv * Au;
tb = mul_rel<52>(lb, mb) + h10;
cuu = mul_rel<52>(cu, cu) + h11;  cvv = mul_rel<52>(cv, cv) + h12;
lc = add_rel<52>(cuu, cvv);  Lc = Cu * Cu + Cv * Cv;
ab = mul_rel<52>(au, bv) + h13;  ba = mul_rel<52>(av, bu) + h14;
mc = sub_rel<52>(ab, ba);  Mc = Au * Bv - Av * Bu;
tc = mul_rel<52>(lc, mc) + h15;
tab = add_rel<52>(ta, tb);
value = add_rel<52>(tab, tc);
exact = La * Ma + Lb * Mb + Lc * Mc;
mm = mul_rel<52>(m, m);
bound = mul_rel<52>(mul_rel<52>(@in_circle_factor@ * 1b-52, mm), mm);

{ |Au| <= 1 /\ |Av| <= 1 /\ |Bu| <= 1 /\ |Bv| <= 1 /\ |Cu| <= 1 /\ |Cv| <= 1 /\
  |h1| <= @underflow_of_degree4@ /\ |h2| <= @underflow_of_degree4@ /\
  |h3| <= @underflow_of_degree4@ /\ |h4| <= @underflow_of_degree4@ /\
  |h5| <= @underflow_of_degree4@ /\ |h6| <= @underflow_of_degree4@ /\
  |h7| <= @underflow_of_degree4@ /\ |h8| <= @underflow_of_degree4@ /\
  |h9| <= @underflow_of_degree4@ /\ |h10| <= @underflow_of_degree4@ /\
  |h11| <= @underflow_of_degree4@ /\ |h12| <= @underflow_of_degree4@ /\
  |h13| <= @underflow_of_degree4@ /\ |h14| <= @underflow_of_degree4@ /\
  |h15| <= @underflow_of_degree4@ /\
  |m - 1| <= 1b-52
  -> |value - exact| - bound <= 0 }

auu - Au * Au -> (mul_rel<52>(au, au) - Au * Au) + h1;
avv - Av * Av -> (mul_rel<52>(av, av) - Av * Av) + h2;
la - La -> (la - (auu + avv)) + ((auu - Au * Au) + (avv - Av * Av));
bc - Bu * Cv -> (mul_rel<52>(bu, cv) - Bu * Cv) + h3;
cb - Bv * Cu -> (mul_rel<52>(bv, cu) - Bv * Cu) + h4;
ma - Ma -> (ma - (bc - cb)) + ((bc - Bu * Cv) - (cb - Bv * Cu));
ta - La * Ma -> (mul_rel<52>(la, ma) - la * ma) + ((la - La) * ma + La * (ma - Ma)) + h5;
buu - Bu * Bu -> (mul_rel<52>(bu, bu) - Bu * Bu) + h6;
bvv - Bv * Bv -> (mul_rel<52>(bv, bv) - Bv * Bv) + h7;
lb - Lb -> (lb - (buu + bvv)) + ((buu - Bu * Bu) + (bvv - Bv * Bv));
ca - Cu * Av -> (mul_rel<52>(cu, av) - Cu * Av) + h8;
ac - Cv * Au -> (mul_rel<52>(cv, au) - Cv * Au) + h9;
mb - Mb -> (mb - (ca - ac)) + ((ca - Cu * Av) - (ac - Cv * Au));
tb - Lb * Mb -> (mul_rel<52>(lb, mb) - lb * mb) + ((lb - Lb) * mb + Lb * (mb - Mb)) + h10;
cuu - Cu * Cu -> (mul_rel<52>(cu, cu) - Cu * Cu) + h11;
cvv - Cv * Cv -> (mul_rel<52>(cv, cv) - Cv * Cv) + h12;
lc - Lc -> (lc - (cuu + cvv)) + ((cuu - Cu * Cu) + (cvv - Cv * Cv));
ab - Au * Bv -> (mul_rel<52>(au, bv) - Au * Bv) + h13;
ba - Av * Bu -> (mul_rel<52>(av, bu) - Av * Bu) + h14;
mc - Mc -> (mc - (ab - ba)) + ((ab - Au * Bv) - (ba - Av * Bu));
tc - Lc * Mc -> (mul_rel<52>(lc, mc) - lc * mc) + ((lc - Lc) * mc + Lc * (mc - Mc)) + h15;
value - exact -> (value - (tab + tc)) + ((tab - (ta + tb))
                 + ((ta - La * Ma) + (tb - Lb * Mb) + (tc - Lc * Mc)));
