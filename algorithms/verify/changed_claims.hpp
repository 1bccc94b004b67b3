// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The claims of certificates about surfaces that were changed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// The claims of a certificate about a mesh that was improved.
struct ImprovedClaim {
    std::vector<Point3> vertices;          ///< unit of the input
    std::vector<Triangle> triangles;       ///< indices into vertices
    IndexLists<std::uint32_t> surfaces_of; ///< per triangle: surfaces of the inputs, sorted, >= 1
    IndexLists<std::uint32_t> regions_of;  ///< per triangle: its region in each of these surfaces,
                                           ///< numbered as in the mesh before
    std::vector<Edge> intersection_edges;  ///< sorted, unique
    std::vector<double> limits; ///< per surface: no point of it is farther from the same region in
                                ///< the other mesh, unit of the input
};

/// A surface whose holes were filled.
struct FilledPart {
    std::uint32_t vertices = 0;  ///< number of its vertices, given and new
    std::uint32_t triangles = 0; ///< number of its triangles, given and new
    double limit = 0; ///< no filling reaches farther out of the box around the border of its hole,
                      ///< unit of the input
};

/// The claims of a certificate about surfaces whose holes were filled.
struct FilledClaim {
    std::vector<Point3> vertices;     ///< of all surfaces in order; of each first the given ones
    std::vector<Triangle> triangles;  ///< likewise; indices into vertices
    std::vector<FilledPart> surfaces; ///< order of the inputs
    std::vector<std::uint32_t>
        interpolated; ///< per triangle: the number of its hole; 0: it was given
    std::vector<double>
        deviation; ///< per vertex: its expected error, unit of the input; NaN: unknown
};

/// A horizon of a stack.
struct CertifiedLayer {
    std::uint32_t surface = 0; ///< of the inputs
    double hardness = 0;       ///< larger is harder; of equals the upper one counts as harder
};

/// The claims of a certificate about horizons that were put in order.
struct LayeredClaim {
    std::vector<Point3> vertices;          ///< unit of the input
    std::vector<Triangle> triangles;       ///< indices into vertices
    IndexLists<std::uint32_t> surfaces_of; ///< per triangle: its layers, positions in the order,
                                           ///< sorted, >= 1
    IndexLists<std::uint32_t> regions_of;  ///< per triangle: what the files say; or no lists
    IndexLists<std::uint32_t> parents_of;  ///< likewise
    std::vector<CertifiedLayer> order;     ///< from the top down
    double deviation = 0; ///< no triangle is farther from where it must be, unit of the input
    std::optional<double> thickness; ///< least distance along z from harder layers, unit of the
                                     ///< input; > 0; none: layers may touch
};

/// The volume of interest by which surfaces were cut.
struct VolumeClaim {
    std::string shape; ///< "prism": upright, over a polygon; "hexahedron": with eight corners;
                       ///< "surface": of the last input files
    std::vector<std::array<double, 2>> corners; ///< of a prism: its polygon, in order
    std::vector<double> between;                ///< of a prism: its two heights, the lower first
    std::uint32_t files = 0;       ///< of a surface: the number of input files that hold it
    std::vector<Surface> boundary; ///< the surfaces that bound the volume together
};

/// The claims of a certificate about the parts that were left out of an arrangement.
struct CutClaim {
    VolumeClaim
        volume; ///< what was cut out; without a boundary: nothing was, as surfaces were only
                ///< sealed
    std::vector<std::uint32_t> dropped; ///< triangles of the exact part that were left out, sorted
};

/// The triangles that were added to a surface. Its triangles, given, then extended, then sealed, have the numbers
/// of input triangles, with three vertices of their own each.
struct SealedPart {
    double limit = 0; ///< the surface as given and as kept are nowhere farther apart, unit of the
                      ///< input
    std::vector<std::array<Point3, 3>>
        extended;                              ///< triangles that go on to the boundary of a volume
    std::vector<std::array<Point3, 3>> sealed; ///< triangles that close gaps
};

/// The claims of a certificate about surfaces that were sealed or extended.
struct SealedClaim {
    std::vector<SealedPart> surfaces; ///< order of the inputs, without the boundary of a volume
};

} // namespace terrane
