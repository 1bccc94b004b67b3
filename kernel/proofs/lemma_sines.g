# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Prover::is_clear_as_a_whole() of algorithms/rounding/detail/separation.cpp, statements (1) and (2) of
# docs/explanation/separation.md.
#
# errors: those of both normals, divided by the computed sine of the angle between their planes; share
# is what least_sine_factor allows of it. Each is at least direction_factor units, so that the
# rounding of the cross product of the normals adds a twentieth of them at most.
# sine: the true sine over the computed one, of which the code takes half.
# slant: the direction of the line in which the planes meet errs by twice the error of the cross
# product over its length.
# edge: a true sine of the angle between this line and an edge over the computed one, which is above
# least_edge_sine and errs by slant and by 16 units from its own computation.
# cotangent: the code takes 2 / least, where the cotangents are below the inverse of the true sine.
# least: lemma_least_sine_factor 538

errors = share / @lemma_least_sine_factor@;
sine = 1 - 1.05 * errors;
slant = 2.1 * errors;
edge = 1 - (slant + 16 * 1b-52) / @lemma_least_edge_sine@;
cotangent = 2 * edge;

{ share in [0, 1] -> sine >= 0.5 /\ edge >= 0.5 /\ cotangent >= 1 }
