// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the borders of a surface as closed loops and classifies them: outer borders, holes, and
// gaps torn by faults.
//
// Which edges are border edges and how they are connected depends on indices and equal points
// alone. The classification uses measures in floating point, by the rules stated with LoopKind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// The kind of a loop of border edges.
enum class LoopKind : std::uint8_t {
    outer, ///< in each part connected across edges, the loop whose bounding box has the longest
           ///< diagonal, if that is at least half of the diagonal of the part (otherwise the part
           ///< is a closed body with holes); and every loop with an edge of more than two triangles
    hole,  ///< all others
    fault_gap, ///< a hole whose opposite sides have a throw, see GapRule
};

/// Decides whether a hole is a fault gap. The surface is extrapolated from both sides to the middle
/// of the hole with the slope it has at the border. The hole is a fault gap if the two
/// extrapolations differ by a throw of at least `slope` times the width of the gap and at least
/// three times the roughness of the border, with the same side up along four fifths of the gap.
struct GapRule {
    double slope = 0.25; ///< throw / width; dimensionless, > 0
};

/// A closed loop of border edges. Lengths are in the unit of the surface.
struct BorderLoop {
    LoopKind kind = LoopKind::hole;        ///< outline, hole or fault gap
    std::vector<std::uint32_t> vertices{}; ///< of the surface, in order, each once, >= 3; the
                                           ///< surface is on the left, seen from its front. Of
                                           ///< equal points, the one with the lowest index
    std::uint32_t part = 0;                ///< connected part of the surface: its lowest triangle
    std::uint32_t shared = 0;              ///< edges of the loop with more than two triangles
    double length = 0;                     ///< total length of its edges
    double area = 0;                       ///< of its largest projection to a plane
    Point3 centre{};                       ///< mean of its edges, weighted by length
    double fault_throw = 0; ///< holes: median distance between the extrapolated sides, along the
                            ///< mean normal of the border
    double width = 0;       ///< holes: median distance between opposite sides
};

/// Finds all borders of a surface: outer ones by decreasing length, then holes and gaps by
/// decreasing area. Equal points count as one vertex; degenerate and repeated triangles are
/// ignored. A border that visits a vertex twice is split there. Edges of more than two triangles
/// cut the surface like borders; loops of such edges only are omitted.
/// Cost: linear, plus at most 256 passes over the edges of each hole.
/// Errors: bad_number, bad_index, interrupted.
Result<std::vector<BorderLoop>> find_border_loops(const Surface& surface, const Run& run = {},
                                                  const GapRule& rule = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> hole_constants();

/// The shapes of variograms, by which kriging fills; the formulas are at Variogram.
enum class VariogramModel : std::uint8_t {
    spherical,
    exponential,
    gaussian,
    power,
    matern,
    thin_plate,
    cubic
};

/// Names the model: "spherical", ...
std::string_view name_of(VariogramModel model);

/// The variogram model of this name ("spherical", ...); none for any other word, such as "auto".
std::optional<VariogramModel> variogram_model_named(std::string_view name);

/// A model that took part in an average, and what it says at the middle of the hole: the new vertex
/// that is farthest from the border.
struct ModelShare {
    std::string model;    ///< the trend, the variogram and its parameters
    double weight = 0;    ///< of its estimates; all are 1 together
    double height = 0;    ///< estimated at that place; NaN: there is no new vertex
    double deviation = 0; ///< standard deviation there, likewise
};

/// Describes a filling and how far it can be trusted. Lengths are in the unit of the surface.
struct FillReport {
    std::size_t data = 0;             ///< points of the surface used as data
    std::size_t interpolated = 0;     ///< vertices that the surface did not have
    double area = 0;                  ///< of the triangles
    double expected_error = 0;        ///< root mean square of Filling::expected_error over the
                                      ///< interpolated vertices; NaN if the method predicts none
    double validated_error = 0;       ///< root mean square error at data that were left out and
                                      ///< predicted from the others; NaN if not computed
    std::string model;                ///< the models, the likeliest first, in a sentence
    std::vector<ModelShare> models{}; ///< of a graph: all that were averaged, the likeliest first
    std::vector<std::array<double, 2>>
        variogram{}; ///< of kriging, without the trend: mean distance, half the mean squared
                     ///< difference of heights; ascending; empty: there is none
    std::vector<std::array<double, 2>> variogram_model{}; ///< the fitted one, likewise
    std::vector<std::array<double, 2>>
        left_out{}; ///< height of a datum, and as the data outside of its block predict it, for
                    ///< validated_error; empty: none were left out. Heights are along z, or, of a
                    ///< surface that is no graph z = f(x, y), along the mean normal of the border
};

} // namespace terrane
