// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Options of improve(), and of a resolution to which surfaces are simplified before.
#pragma once

#include <limits>
#include <vector>

#include <terrane/algorithms/check/pair_check.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// A wanted edge length at a point. It grows with the distance from there, by `growth`.
struct LocalSize {
    Point3 place{};    ///< unit of the mesh
    double length = 0; ///< > 0, unit of the mesh
};

/// Options of improve(). Lengths are in the unit of the mesh, angles in degrees, and
/// max_volume_change in percent. describe() says what each member does.
struct ImproveOptions {
    /// \name Members that describe() describes
    /// @{
    double edge_length = 0;               ///< see describe(), as all members of this group
    std::vector<double> edge_length_of{}; ///< per surface; 0: edge_length; empty: no exceptions
    double max_deviation = 0;
    double curve_length = 0;
    double turn = 0;
    double layers_in_gaps = 0;
    double smallest = 0;
    double growth = 0.3;
    double crease_angle = 50;
    double curve_angle = 45;
    unsigned passes = 6;
    double thickness_share = 0.1;
    double least_quality = 1;
    double max_volume_change = 5;
    double max_triangles = 2e7;
    /// @}
    std::vector<std::vector<LocalSize>>
        refinements{};        ///< lengths wanted near points. Each list in turn makes triangles of
                              ///< the finished mesh smaller near its points, and leaves the others.
                              ///< Each point costs a distance per vertex and pass
    PairCheckOptions check{}; ///< how the improved mesh is checked

    /// Describes the options, see Field. The bound of layers_in_gaps is there since the search for
    /// gaps compares a triangle with the sheets within this many wanted lengths of it: with more
    /// than a thousand, these are all sheets of a model.
    static void describe(const auto& visit, auto& o) {
        constexpr double unlimited = std::numeric_limits<double>::infinity();
        constexpr FieldBounds angle{0, 180}, share{0, 1};
        visit(Field("edge_length", "L", "Wanted length of edges",
                    "each surface keeps about as many triangles as it has", {}, true),
              o.edge_length);
        visit(Field("edge_length_of", "NAME=L", "Wanted length of edges on one surface",
                    "`edge_length`", {}, true),
              o.edge_length_of);
        visit(Field("max_deviation", "D",
                    "No point of a surface moves farther from the original surface than this",
                    "a twentieth of the wanted length", {}, true),
              o.max_deviation);
        visit(Field("curve_length", "L",
                    "Wanted length of edges along curves, where that is shorter", "as elsewhere"),
              o.curve_length);
        visit(
            Field("turn", "DEGREES",
                  "Asks for shorter edges where a surface is curved, so that normals turn by about "
                  "this angle along an edge; not shorter than an eighth of the wanted length",
                  "the same length everywhere", angle),
            o.turn);
        visit(Field("layers_in_gaps", "N",
                    "Where surfaces are close, edges are at most as long as their distance divided "
                    "by this",
                    "distances do not count", {0, 1000}, true),
              o.layers_in_gaps);
        visit(Field("smallest", "L", "`layers_in_gaps` asks for no shorter edges than this",
                    "an eighth of the least wanted length", {}, true),
              o.smallest);
        visit(Field("growth", "G",
                    "Wanted lengths differ by at most this share of the way between them"),
              o.growth);
        visit(Field("crease_angle", "DEGREES",
                    "Edges at which a surface turns by more than this angle are kept", {}, angle),
              o.crease_angle);
        visit(Field("curve_angle", "DEGREES",
                    "Vertices at which a curve turns by more than this angle are kept", {}, angle),
              o.curve_angle);
        visit(Field("passes", "N", "Limits the passes of the four operations", {}, {1, 100, true}),
              o.passes);
        visit(
            Field("thickness_share", "SHARE",
                  "Where blocks are thin, points deviate by at most this share of the distance to "
                  "the next sheet, along the normal"),
            o.thickness_share);
        visit(Field("least_quality", "Q",
                    "No triangle gets worse than the worst before, or than this q if that is less",
                    {}, share),
              o.least_quality);
        visit(
            Field("max_volume_change", "P",
                  "Improves again, with smaller deviations, around blocks whose volumes change by "
                  "more than this percentage, and warns where that does not help",
                  {}, {0, unlimited, true}),
            o.max_volume_change);
        visit(Field("max_triangles", "N",
                    "Refuses to begin where more triangles are to be expected", {}, {0, unlimited}),
              o.max_triangles);
    }
};

/// The resolution of a model.
struct Resolution {
    double length = 0;     ///< see describe(), in the unit of the mesh
    bool dissolve = false; ///< see SimplifyOptions

    /// Describes the options of improvement at a resolution, see Field.
    static void describe(const auto& visit, auto& o) {
        visit(
            Field("resolution", "R",
                  "Experimental. Joins places that are nearer than this first, where it can: "
                  "corners, short curves, narrow strips, thin gaps, sharp wedges. No surface moves "
                  "by more, both steps together",
                  "nothing is joined", {}, true),
            o.length);
        visit(Field("dissolve", "", "Lets blocks go that are thinner than `resolution` on average",
                    "those that stay are listed", {}, true),
              o.dissolve);
    }
};

} // namespace terrane
