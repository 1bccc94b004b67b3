// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Looks for mistakes in what people pass: files that are valid, but do not fit together.
//
// Guarantee: surfaces are only looked at. Every warning rests on coordinates or on what the files
// state; the rules and their thresholds are in docs/explanation/plausibility.md. Cost: linear in
// the number of vertices and triangles, and n log n to compare surfaces with each other.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// The kinds of warnings. name_of() gives their names in statistics.
enum class Doubt : std::uint8_t {
    heights_mixed,   ///< heights of some surfaces look like depths, those of others do not
    depths_unstated, ///< a column of depths, or a grid among files of depths, is read as heights
    far_apart,       ///< a surface is far away from all others
    units_mixed,     ///< files state different units, or one for x and y and another for z
    systems_mixed,   ///< files state different coordinate systems, or degrees meet lengths
    volume_without_data, ///< no surface reaches into the volume of interest
    no_top,              ///< no surface can close the model at its top
    no_base,             ///< no surface can close the model at its base
    float32,             ///< coordinates were stored with 24 bits, too few for their size
    values_left_out,     ///< files have values on points or triangles that are not read
    flawed_faces,        ///< faces with more than three corners cross themselves or are not flat
    duplicate_surface,   ///< two surfaces have the same triangles
    no_block,            ///< blocks were wanted, but surfaces enclose none
    horizons_cross,      ///< two horizons run through each other
};

/// Returns the name of a doubt as written to statistics, such as "heights_mixed".
std::string_view name_of(Doubt doubt);

/// A mistake that the surfaces suggest.
struct PlausibilityWarning {
    Doubt doubt{};                   ///< the kind of mistake
    std::vector<SurfaceId> surfaces; ///< those concerned, in order; may be empty
    std::string seen;                ///< the finding, with names and numbers
    std::string why;                 ///< the consequence of the mistake
    std::string answer;              ///< the option that answers it

    /// Returns the three as sentences.
    [[nodiscard]] std::string message() const { return seen + ". " + why + ". " + answer; }
};

/// The use that the surfaces are checked for.
struct PlausibilityContext {
    std::span<const Surface> boundary{}; ///< boundary of the volume of interest; empty: none
    bool blocks = false;                 ///< whether blocks are wanted, which must be closed
};

/// Returns warnings in the order of Doubt.
std::vector<PlausibilityWarning> find_doubts(std::span<const Surface> surfaces,
                                             const PlausibilityContext& context = {});

/// Returns the thresholds of find_doubts.
std::vector<NamedConstant> plausibility_constants();

} // namespace terrane
