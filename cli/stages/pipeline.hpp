// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What arrange and tetrahedralize share: files to a mesh of doubles, and what is said about it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/options/volume_options.hpp>
#include <terrane/cli/reports/seal_report.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

struct ArrangeSettings {
    Search search = Search::automatic;
    unsigned rounds = RoundingOptions{}.max_rounds;
    VolumeOptions volume; ///< of interest
    double seal = 0;      ///< distance; 0: not at all
};

void add_settings(CLI::App& command, ArrangeSettings& settings);

struct Arranged {
    Arrangement exact; ///< with a volume of interest: restricted to it
    RoundedMesh rounded;
    std::optional<VolumeReport> cut;  ///< with a volume of interest
    std::optional<SealReport> sealed; ///< where asked for, as the next one
    std::optional<std::vector<ExtendedBorder>> extended;
};

/// Adds to `statistics`; to `inputs` the boundary of a volume of interest, and the triangles by
/// which gaps were closed. Errors: those of arrange, cut_to_volume and round_to_doubles.
Result<Arranged> arrange_and_round(Inputs& inputs, const ArrangeSettings& settings,
                                   Session& session, Json& statistics);

/// The same with the boundary of a volume of interest that was made already; none: there is no such
/// volume. Of settings.volume only `extend` counts.
Result<Arranged> arrange_within(Inputs& inputs, std::vector<Surface> boundary,
                                const ArrangeSettings& settings, Session& session,
                                Json& statistics);

/// Surfaces with their triangles, regions and areas; what was set aside; how the rounding went.
std::string summary(const Inputs& inputs, const Arranged& arranged);

/// The pairs of triangles that the rounding left in improper contact, by name; 20 at most.
std::string offending_pairs(const Inputs& inputs, const Arranged& arranged);

/// How many flaws the mesh has once its coordinates are float32, as in binary STL; by exact check.
Result<std::size_t> float32_flaws(const Mesh& mesh, const Run& run);

} // namespace terrane::cli
