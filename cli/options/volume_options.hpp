// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Options that define the volume of interest, the same for all commands.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

struct VolumeOptions {
    std::string box;                 ///< x0,y0,z0,x1,y1,z1; here and below, empty: not given
    std::string rotated_box;         ///< x,y,z,across,along,up,azimuth[,plunge,roll]
    bool corner = false;             ///< x,y,z is a corner of the rotated box, not its centre
    std::string polygon;             ///< x,y,x,y,..., or a file
    std::string between;             ///< z0,z1: bottom and top of the polygon's prism
    std::vector<std::string> within; ///< files of a closed surface
    double extend = 0;               ///< longest extension of horizons that end inside; 0: none

    /// Tells whether a volume of interest is given at all.
    [[nodiscard]] bool wanted() const {
        return !box.empty() || !rotated_box.empty() || !polygon.empty() || !within.empty();
    }
};

void add_volume_options(CLI::App& command, VolumeOptions& options);

/// Tells whether a value of --polygon is the name of a file, as it is no list of numbers.
bool is_polygon_file(const std::string& value);

/// Returns the corners that a value states, x,y,x,y,..., or that the file of this name has. Errors: bad_option,
/// cannot_open, with the option; those of read_outline().
std::vector<Point2> corners_of(const std::string& text, const char* option);

/// Checks, before any work is done, that the options fit together. Errors: bad_option.
void check_volume_options(const VolumeOptions& options);

/// Returns the volume of interest that the options define, if any. Errors: bad_option; those of
/// reading a polygon.
ProjectVolume volume_of(const VolumeOptions& options);

/// Makes its boundary. Precondition: wanted(). Errors: those of the makers (volume_of_interest.hpp) and
/// of reading files; bad_option.
std::vector<Surface> boundary_of(const VolumeOptions& options, Session& session);

/// Reports what the cut left of each surface, and where surfaces end inside.
std::string text_of(const VolumeReport& report, const Inputs& inputs);

/// Reports which borders inside were extended, and which were not.
std::string text_of(std::span<const ExtendedBorder> borders, const Inputs& inputs);

/// Adds "extended": surface, reached, length, place.
void add_statistics(Json& json, std::span<const ExtendedBorder> borders);

/// Adds "volume_of_interest": surfaces (name, area_inside, ...), open_borders.
void add_statistics(Json& json, const VolumeReport& report, const Inputs& inputs);

} // namespace terrane::cli
