# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Reach and volume of algorithms/tetrahedra/allowance.cpp: sums and products of positive numbers, and square
# roots. No term is rounded more than 64 times.
# least: allowance_room 0x40.8p-52

f2 = (1 + f) * (1 + f);
f4 = f2 * f2;
f8 = f4 * f4;
f16 = f8 * f8;
f32 = f16 * f16;
kept = (1 + @allowance_room@) * f32 * f32;

{ |f| <= 1b-52 -> kept >= 1 }
