# SPDX-License-Identifier: LGPL-3.0-or-later
#
# PairProver of algorithms/rounding/detail/separation_pairs.cpp: what the computed values of
# functionals show of the true ones. See "In doubles" in docs/explanation/separation.md.
#
# d = margin_factor (move + error), with the error of a functional over the extents of both faces.
# Here move + error is 1, error is e, and d is computed with 5 roundings: two of a sum of extents, a
# product, a sum and a product.
# beyond: a computed value above d is truly above the largest move (statement (3)).
# resting: a computed value of at most d / 2 is truly at most d (statement (4)).
# rising: a computed value above rise_factor d kappa^2 is truly above condition_factor d kappa^2;
# kappa >= 1, in whose square 4 roundings and the two of the product are.
# least: lemma_margin_factor 2.01
# least: lemma_rise_factor 64.6

d = @lemma_margin_factor@ * (1 + r1) * (1 + r2) * (1 + r3) * (1 + r4) * (1 + r5);
most_error = e * (1 + r6) * (1 + r7);
beyond = d - most_error - 1;
resting = d / 2 - most_error;
rise = @lemma_rise_factor@ * d * (1 + k1) * (1 + k2) * (1 + k3) * (1 + k4) * (1 + k5) * (1 + k6);
rising = rise - most_error - @lemma_condition_factor@ * d;

{ e in [0, 1] /\ |r1| <= 1b-52 /\ |r2| <= 1b-52 /\ |r3| <= 1b-52 /\ |r4| <= 1b-52 /\
  |r5| <= 1b-52 /\ |r6| <= 1b-52 /\ |r7| <= 1b-52 /\
  |k1| <= 1b-52 /\ |k2| <= 1b-52 /\ |k3| <= 1b-52 /\
  |k4| <= 1b-52 /\ |k5| <= 1b-52 /\ |k6| <= 1b-52
  -> beyond >= 0 /\ resting >= 0 /\ rising >= 0 }
