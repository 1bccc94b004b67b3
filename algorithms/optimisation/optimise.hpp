// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Makes the shapes of tetrahedra better, inside of blocks only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Where vertices on surfaces may be.
struct VertexFreedom {
    std::vector<bool> is_free{}; ///< per vertex of the mesh; vertices on no surface are always free
    /// Returns the place nearest to p, about, where vertex v may be; none where it does not know one.
    /// Called by several threads at a time.
    std::function<std::optional<Point3>(std::uint32_t v, const Point3& p)> place{};
    /// false: a vertex moves only if all tetrahedra around it then have a quality above the sine of
    /// 5.6 degrees. true: it moves for each gain and for mean ratios below 0.2, and one tetrahedron
    /// with an angle below 3 degrees may be replaced by several bad ones.
    bool is_wide = false;
};

/// Options of optimise().
struct OptimiseOptions {
    double wanted_angle = 18; ///< degrees, in (0, 60): tetrahedra whose dihedral angles are all
                              ///< between it and 180 degrees less it are left alone
    unsigned max_passes = 6;  ///< most passes over all others for angles, and for shapes
    bool outside = true;  ///< whether block 0 is improved, too; not needed if it is dropped later
    bool may_grow = true; ///< whether a new tetrahedron may be larger than all that it replaces:
                          ///< false where their volumes are bounded
    /// Most tetrahedra to measure, apart from those of the last 64 proposals; 0: 150 000 000 or, if
    /// that is more, 4000 for each good tetrahedron in excess of the bad ones.
    std::size_t max_effort = 0;
    VertexFreedom freedom{}; ///< how vertices on surfaces may move where tetrahedra are bad; empty:
                             ///< they stay
    bool angles = true; ///< whether angles are improved, before vertices on surfaces move; false
                        ///< if a call before has done it: only what changes is tried again
    bool shapes = true; ///< whether mean ratios are improved, after that
};

/// The worst shapes among some tetrahedra.
struct WorstShapes {
    double quality = 0;       ///< least sine of a dihedral angle, 0.7 times that of an obtuse one
    double least_angle = 0;   ///< dihedral, degrees
    double largest_angle = 0; ///< dihedral, degrees
};

/// The numbers of changes, and the worst shapes before and after.
struct OptimiseReport {
    WorstShapes before; ///< of the blocks that are improved
    WorstShapes after;  ///< likewise
    std::size_t passes = 0;
    std::size_t removed_edges = 0; ///< edges removed, with 3 and more tetrahedra around them
    std::size_t removed_faces = 0; ///< faces removed
    std::size_t moved = 0;         ///< moves of vertices
    std::size_t loosened = 0;      ///< of these: moves of vertices on surfaces
    std::size_t contracted = 0;    ///< vertices that joined a neighbour
    std::size_t inserted = 0;      ///< vertices that were added
    std::size_t remeshed = 0;  ///< neighbourhoods of bad tetrahedra in which several of these were
                               ///< made at a time
    std::size_t left = 0;      ///< tetrahedra that are still worse than wanted
    std::size_t untried = 0;   ///< of these: tetrahedra not tried since a neighbour changed, as
                               ///< passes or effort came to an end
    std::size_t effort = 0;    ///< tetrahedra that were measured, or looked at around an edge
    bool is_cut_short = false; ///< max_effort ended the work
};

/// Improves tetrahedra by removing edges and faces, moving, contracting and inserting vertices.
///
/// The quality of a tetrahedron is the least sine of its dihedral angles, where that of an obtuse
/// angle counts 0.7 times.
///
/// (1) Faces on surfaces and on the box stay, and so do their vertices, bit by bit, in their order.
///     Where bad tetrahedra are left then, of a quality below the sine of 10 degrees, vertices on
///     surfaces move as options.freedom lets them; faces keep their corners. Tetrahedra of a block
///     that is not improved need only keep a positive volume then.
/// (2) Each tetrahedron has a positive volume, by exact predicates; blocks fill what they did.
/// (3) A change is made only if the least quality of the tetrahedra that it makes is larger than
///     that of those that it replaces. So the sorted vector of qualities grows with each change,
///     and the worst tetrahedron never gets worse. No sine of a dihedral angle becomes less than
///     the least one before.
///     The last passes raise the mean ratio of needles with good angles. There, the quality is the
///     smaller one of that above and of q = sqrt(L^2 + 1.96 r^3) for a mean ratio r, where L is the
///     sine of 10 degrees, or the least quality before if that is more. Since q > L, these passes make no
///     angle that is worse than L. Vertices on surfaces with much room move there where r is below 0.2.
/// (4) Where qualities can't be computed reliably in doubles, tetrahedra stay as they are.
/// (5) The same mesh gives the same result, with any number of threads.
///
/// Cost: each tetrahedron that is worse than wanted is tried again only after a neighbour changed.
/// Work ends early where it has little success: 1000 possible tetrahedra are measured for each one
/// of the mesh, and 2000 for each change that is made. In all, max_effort are, which takes a tenth to
/// a quarter of a microsecond each. Where that does not suffice for all, changes that take little
/// are looked for everywhere before others are.
///
/// Precondition: tetrahedra as tetrahedralize() makes them, without twins. Errors: bad_option
/// (also where freedom is given for some vertices only), bad_index, interrupted, out_of_memory.
///
/// Source: Klingner and Shewchuk 2007, Aggressive tetrahedral mesh improvement; the choice of new
/// tetrahedra around a removed edge is Klincsek's (1980).
Result<OptimiseReport> optimise(TetrahedralMesh& mesh, const OptimiseOptions& options = {},
                                const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> optimise_constants();

} // namespace terrane
