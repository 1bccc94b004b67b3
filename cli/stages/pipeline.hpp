// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Makes a rounded mesh from input files and reports on it: shared by the commands that arrange.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/options/volume_options.hpp>
#include <terrane/cli/reports/pair_report.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

struct ArrangeSettings {
    Search search = Search::automatic;
    unsigned rounds = RoundingOptions{}.max_rounds;
    std::optional<double> max_move;     ///< of surfaces, in rounding; none: the default
    PairCheckOptions check = few_pairs; ///< how the mesh is checked
    VolumeOptions volume;               ///< volume of interest
    double seal = 0;                    ///< distance within which gaps are sealed; 0: not at all
    bool seal_automatic = false;        ///< the distance is chosen by the widths of the gaps
    std::vector<NamedLength> seal_of;   ///< other distances, by surface or pair of surfaces
    double min_volume = 0;              ///< smaller blocks are merged; 0: none
    bool min_volume_automatic = false;  ///< the volume is chosen by the edge lengths
    bool blocks = false; ///< whether blocks are wanted, so that surfaces should close some
};

void add_settings(CLI::App& command, ArrangeSettings& settings);

/// Returns the options of arrange_within() that the settings stand for. Errors: bad_option for a
/// name that no surface has. Precondition: the surfaces of `inputs` were not moved from.
Result<ArrangeWithinOptions> options_within(const ArrangeSettings& settings, const Inputs& inputs);

/// Checks before any work is done that a certificate of the wished settings can be made.
/// Errors: bad_option.
Status check_certifiable(const ArrangeSettings& settings);

/// Arranges and rounds the surfaces of `inputs`, which are moved into the result. Adds to
/// `statistics`, and to `inputs` the names of the boundary's surfaces. Errors: those of arrange,
/// cut_to_volume and round_to_doubles.
Result<Arranged> arrange_and_round(Inputs& inputs, const ArrangeSettings& settings,
                                   Session& session, Json& statistics);

/// Adds counts and times of all steps to `statistics`.
void add_statistics(Json& statistics, const Arranged& arranged, const Inputs& inputs);

/// Reports the surfaces with their triangles, regions and areas, the triangles set aside, and the
/// rounding.
std::string summary(const Inputs& inputs, const Arranged& arranged);

/// Lists the pairs of triangles that the rounding left in improper contact, by name; 20 at most.
std::string offending_pairs(const Inputs& inputs, const Arranged& arranged);

/// Counts the flaws that an exact check finds once the coordinates are float32, as in binary STL.
Result<std::size_t> float32_flaws(const Mesh& mesh, const Run& run);

} // namespace terrane::cli
