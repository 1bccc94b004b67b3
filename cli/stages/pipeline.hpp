// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What arrange and tetrahedralize share: files to a mesh of doubles, and what is said about it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/options/volume_options.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

struct ArrangeSettings {
    Search search = Search::automatic;
    unsigned rounds = RoundingOptions{}.max_rounds;
    VolumeOptions volume; ///< of interest
    double seal = 0;      ///< distance; 0: not at all
};

void add_settings(CLI::App& command, ArrangeSettings& settings);

/// Arranges and rounds the surfaces of `inputs`, which move to the result. Adds to `statistics`, and
/// to `inputs` the names of the boundary's surfaces. Errors: those of arrange, cut_to_volume and round_to_doubles.
Result<Arranged> arrange_and_round(Inputs& inputs, const ArrangeSettings& settings,
                                   Session& session, Json& statistics);

/// Adds what was done to `statistics`.
void add_statistics(Json& statistics, const Arranged& arranged, Search asked, const Inputs& inputs);

/// Surfaces with their triangles, regions and areas; what was set aside; how the rounding went.
std::string summary(const Inputs& inputs, const Arranged& arranged);

/// The pairs of triangles that the rounding left in improper contact, by name; 20 at most.
std::string offending_pairs(const Inputs& inputs, const Arranged& arranged);

/// How many flaws the mesh has once its coordinates are float32, as in binary STL; by exact check.
Result<std::size_t> float32_flaws(const Mesh& mesh, const Run& run);

} // namespace terrane::cli
