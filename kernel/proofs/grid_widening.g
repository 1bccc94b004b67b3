# SPDX-License-Identifier: LGPL-3.0-or-later
#
# CellGrid of algorithms/search/detail/grid.cpp: the range of cells that a query visits has the centre of each
# box that overlaps the query's.
#
# The largest coordinate is 1, and the largest box is at most 2 wide. A box that overlaps reaches half of
# its width over its centre: half of the largest one at most, which was rounded (e). The computed centre
# errs by one unit of 2^-52. So does the end of the query's range, unless it is beyond all boxes, where
# all cells up to the last are visited.
# of_size: what the widening has above two units. of_width: what it has above half of the largest box.
# least: grid_size_share 0x2.01p-52

roundings = (1 + r1) * (1 + r2) * (1 + r3);
of_width = 0.5 * (1 + @grid_width_share@) * roundings - 0.5 * (1 + e);
of_size = @grid_size_share@ * roundings - 2b-52;

{ |e| <= 0x1.04p-52 /\ |r1| <= 1b-52 /\ |r2| <= 1b-52 /\ |r3| <= 1b-52
  -> of_width >= 0 /\ of_size >= 0 }
