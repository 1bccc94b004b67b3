# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Turn2d::estimate() of kernel/static_filter_bounds.hpp, derivation (1).
#
# The differences of each coordinate are divided by the larger one: Bu and Cu by U, Bv and Cv by V.
# u and v are the computed sizes; rounding is monotonic, so they are off by one rounding each.
# least: turn2d_factor 8.0001

bu = sub_rel<52>(b_u, a_u);  Bu = b_u - a_u;
bv = sub_rel<52>(b_v, a_v);  Bv = b_v - a_v;
cu = sub_rel<52>(d_u, c_u);  Cu = d_u - c_u;
cv = sub_rel<52>(d_v, c_v);  Cv = d_v - c_v;

p = mul_rel<52>(bu, cv) + h1;
q = mul_rel<52>(bv, cu) + h2;
value = sub_rel<52>(p, q);
exact = Bu * Cv - Bv * Cu;
bound = mul_rel<52>(mul_rel<52>(@turn2d_factor@ * 1b-52, u), v);

{ |Bu| <= 1 /\ |Bv| <= 1 /\ |Cu| <= 1 /\ |Cv| <= 1 /\
  |h1| <= @underflow_of_degree2@ /\ |h2| <= @underflow_of_degree2@ /\
  |u - 1| <= 1b-52 /\ |v - 1| <= 1b-52
  -> |value - exact| - bound <= 0 }

p - Bu * Cv -> (mul_rel<52>(bu, cv) - Bu * Cv) + h1;
q - Bv * Cu -> (mul_rel<52>(bv, cu) - Bv * Cu) + h2;
value - exact -> (value - (p - q)) + ((p - Bu * Cv) - (q - Bv * Cu));
