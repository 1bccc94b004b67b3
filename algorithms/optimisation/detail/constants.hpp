// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of optimise() that decide its result and are not options.
#pragma once

#include <cstddef>

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::optimisation::detail {

/// Qualities are least sines of dihedral angles. None of these constants affects the guarantees.
struct OptimiseConstants : Constants {
    /// First step of a vertex, as a share of the distance to its nearest neighbour. Larger: places
    /// farther away are found, more tries.
    double first_step = add("first_step", 0.5);
    /// How often steps are halved. Larger: places are found more exactly.
    unsigned step_halvings = add("step_halvings", 6);
    /// A change must raise the least quality by this. Larger: fewer changes that hardly matter.
    double least_gain = add("least_gain", 5e-3);
    /// Edges with more tetrahedra around them are not removed: the work grows with the cube.
    std::size_t most_around_edge = add("most_around_edge", 10);
    /// The sine of an obtuse angle counts this share, so that 166 degrees are as bad as 9.8 degrees.
    /// Less: the greatest angles become better, the least ones worse.
    double obtuse_share = add("obtuse_share", 0.7);
    /// The mean ratio to the power of 3/2 counts this much where shapes count, too, so that a mean
    /// ratio of 0.2 is as bad as an angle of 12.4 degrees. Less: shapes become better, angles worse.
    double shape_share = add("shape_share", 1.4);
    /// Vertices on walls with much room move where mean ratios are below that, too.
    double least_ratio = add("least_ratio", 0.2);
    /// They move until mean ratios are that good. Larger: surfaces move farther.
    double ratio_enough = add("ratio_enough", 0.22);
    /// All vertices around a tetrahedron move for its sake if its quality is below this share of
    /// the wanted one. Larger: better, more work.
    double relaxed = add("relaxed", 0.5);
    /// Sine of ten degrees: a vertex is not inserted if there are more tetrahedra below it then.
    double bad = add("bad", 0.17364817766693033);
    /// Vertices on walls that are free move until tetrahedra are that good: the sine of 12 degrees.
    /// Larger: surfaces move farther.
    double loose_enough = add("loose_enough", 0.20791169081775934);
    /// Largest step of such a vertex, as a share of the distance to its farthest neighbour: the
    /// nearest one may be the one that is too near. Larger: surfaces move farther.
    double largest_step = add("largest_step", 0.25);
    /// First step, as a share of the largest one.
    double first_small_step = add("first_small_step", 1.0 / 128);
    /// Passes in which vertices on walls move, at most.
    unsigned loosening_passes = add("loosening_passes", 20);
    /// Vertices on walls with little room move only if all around them is better than this, 0.7 times
    /// the sine of 172 degrees. Where no place is that good, they stay.
    double least_loose = add("least_loose", 0.09742116720671);
    /// Where a tetrahedron is worse than this, the sine of 3 degrees, vertices on walls with much room may
    /// move so that more are bad, if none is as bad.
    double urgent = add("urgent", 0.052335956242943834);
    /// Moving vertices on walls has an effort of its own, as much as all before divided by this.
    std::size_t loose_part = add("loose_part", 4);
    /// Steps of a size that such a vertex makes, at most, before larger ones are tried.
    unsigned steps_of_a_size = add("steps_of_a_size", 4);
    /// Cavities of inserted vertices have no more tetrahedra. Larger: more is tried.
    std::size_t most_in_cavity = add("most_in_cavity", 32);
    /// Cells of which a copy is made to look for several changes at a time. Larger: more is found
    /// for the worst cells, and it takes longer.
    std::size_t most_in_remeshing = add("most_in_remeshing", 100);
    /// Passes over such a copy, at most.
    unsigned remeshing_passes = add("remeshing_passes", 4);
    /// This many tetrahedra may be measured in all, or effort_per_good times the surplus of good
    /// ones over bad ones, whichever is more. Larger: meshes of bad surfaces take longer, and a
    /// little more is found.
    std::size_t least_effort = add("least_effort", 150'000'000);
    /// Where fewer may be measured for each tetrahedron that is worse than wanted, changes that take
    /// little are looked for everywhere before others are.
    std::size_t effort_per_bad = add("effort_per_bad", 2000);
    /// See least_effort.
    std::size_t effort_per_good = add("effort_per_good", 4000);
    /// Tetrahedra that may be measured for each cell of the mesh, and for each change that is made.
    /// Larger: hopeless meshes take longer, and a little more is found.
    std::size_t effort_per_cell = add("effort_per_cell", 1000);
    std::size_t effort_per_change = add("effort_per_change", 2000);
    /// Changes are proposed for this many cells or vertices at a time. Larger: more of them come
    /// too late, after another change next to them; fewer: less for each thread.
    std::size_t batch = add("batch", 64);
};
inline constexpr OptimiseConstants constants{};

} // namespace terrane::optimisation::detail
