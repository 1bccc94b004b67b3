// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The ways in which meshers are asked, one after the other, until one gives a mesh.
#pragma once

#include <vector>

#include <terrane/algorithms/tetgen/detail/process.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::tetgen::detail {

/// A way of asking a mesher; see TetgenInput.
struct Way {
    Mesher mesher = Mesher::tetgen;
    bool keep_facets = true, improve = true, sort_points = true, parallel_delaunay = false;
    bool embed_all = false;   ///< all triangles are embedded in one block; for Gmsh only
    bool bound_shapes = true; ///< radius_edge_ratio is asked for
};

/// Returns the ways of asking TetGen: first with all it can do, then without its last step, the
/// improvement of shapes, then with facets split. The points are inserted along a curve, TetGen's
/// default, and after that in their own order: version 1.5.0 ends in an assertion with the former
/// for points as regular as those of two overlapping cubes. At last it is asked for no bound on
/// shapes, where it has one and facets are kept: it may never end then.
std::vector<Way> ways_of_tetgen(const TetgenInput& input);

/// Returns the ways of asking Gmsh. Its newer algorithm is faster and better, but knows no facet
/// with the same block on both sides. With all triangles in one block, and no vertices but those
/// that it needs, the other one recovers what it does not as borders of blocks.
std::vector<Way> ways_of_gmsh(const Volumes& volumes);

} // namespace terrane::tetgen::detail
