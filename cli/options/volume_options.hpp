// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The volume of interest, as it is named on the command line: the same options for all commands.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/volume_of_interest/extension.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

struct VolumeOptions {
    std::string box;                 ///< x0,y0,z0,x1,y1,z1; empty: none, as all that follow
    std::string rotated_box;         ///< x,y,z,across,along,up,azimuth[,plunge,roll]
    bool corner = false;             ///< x,y,z is a corner of it, not its centre
    std::string polygon;             ///< x,y,x,y,..., or a file
    std::string between;             ///< z0,z1, of the polygon
    std::vector<std::string> within; ///< files of a closed surface
    double extend = 0;               ///< limit for horizons that end inside; 0: not at all

    /// Whether there is a volume of interest at all.
    [[nodiscard]] bool wanted() const {
        return !box.empty() || !rotated_box.empty() || !polygon.empty() || !within.empty();
    }
};

void add_volume_options(CLI::App& command, VolumeOptions& options);

/// What makes no sense together, found before any work is done.
Status check_volume_options(const VolumeOptions& options);

/// The boundary that the options name. Precondition: wanted(). Errors: those of the makers
/// (boundary_surfaces.hpp), of reading files, bad_option.
Result<std::vector<Surface>> boundary_of(const VolumeOptions& options, Session& session);

/// What the cut left of each surface, and where surfaces end inside.
std::string text_of(const VolumeReport& report, const Inputs& inputs);

/// Which borders inside were extended, and which not.
std::string text_of(std::span<const ExtendedBorder> borders, const Inputs& inputs);

/// extended: surface, reached, length, place.
void add_statistics(Json& json, std::span<const ExtendedBorder> borders);

/// volume_of_interest: surfaces (name, area_inside, ...), open_borders.
void add_statistics(Json& json, const VolumeReport& report, const Inputs& inputs);

} // namespace terrane::cli
