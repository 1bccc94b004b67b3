# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Faces::measure_parts() of algorithms/rounding/detail/separation_faces.cpp: the computed altitude is
# at most the true one, the computed longest edge at least the true one, before the moves are taken
# off or added. See "In doubles" in docs/explanation/separation.md.
#
# The longest edge is 1, A twice the area, which is the altitude then. Each coordinate of the computed
# cross product errs by at most 8.001 units (turn2d.g), and so its length by delta, at most sqrt(3)
# times that: that is the triangle inequality. Its length is computed from a sum of squares (1 + n1)
# (1 + n2) (1 + n3), the longest edge from differences as well.
# The computed altitude is A factor + rest; the last rounding, of what is left without the moves, is
# e4. Both are at most A if factor <= 1 and rest <= 0.
# uses: turn2d.g turn2d_factor 8.0002
# least: lemma_altitude_factor 13.9

cross = sqrt((1 + n1) * (1 + n2) * (1 + n3)) * (1 + n4);
edge = sqrt((1 + d1) * (1 + d1) * (1 + d2) * (1 + d3) * (1 + d4)) * (1 + d5);
factor = cross / edge * (1 + e1) * (1 - @lemma_size_share@) * (1 + e2) * (1 + e3) * (1 + e4);
room = @lemma_altitude_factor@ * 1b-52 * edge * (1 + e5) * (1 + e3) * (1 + e4);
rest = delta * factor - room;
longest = edge * (1 + @lemma_size_share@) * (1 + e6) * (1 + e7);

{ |delta| <= 0xD.DC0p-52 /\
  |n1| <= 1b-52 /\ |n2| <= 1b-52 /\ |n3| <= 1b-52 /\ |n4| <= 1b-52 /\ |d1| <= 1b-52 /\
  |d2| <= 1b-52 /\ |d3| <= 1b-52 /\ |d4| <= 1b-52 /\ |d5| <= 1b-52 /\ |e1| <= 1b-52 /\
  |e2| <= 1b-52 /\ |e3| <= 1b-52 /\ |e4| <= 1b-52 /\ |e5| <= 1b-52 /\ |e6| <= 1b-52 /\
  |e7| <= 1b-52
  -> factor <= 1 /\ rest <= 0 /\ longest >= 1 }
