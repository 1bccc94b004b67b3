// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Project files: the whole chain from surfaces to tetrahedra in one JSON file. What may be in it is
// stated in project.schema.json, beside this file; a test holds the two against each other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/volume_of_interest/boundary_surfaces.hpp>
#include <terrane/io/files.hpp>

namespace terrane {

/// An entry of "surfaces".
struct ProjectSurfaces {
    std::filesystem::path file;
    std::vector<std::string> objects{}; ///< those of the file to take; empty: all
    std::string name{};                 ///< of the only surface; empty: as in the file
    std::optional<Role> role{};         ///< none: as in the file
    bool depth = false;                 ///< grids and points: heights are positive down
};

/// Axis-aligned, by two corners.
struct ProjectBox {
    Point3 low, high;
};

/// Between two depths, in either order.
struct ProjectPolygon {
    std::vector<Point2> corners; ///< >= 3
    std::array<double, 2> between{};
};

/// What closed surfaces enclose.
struct ProjectWithin {
    std::vector<std::filesystem::path> files;
};

/// Holes of a surface that are filled before all else (holes.hpp, fill_kriging.hpp, rbf.hpp).
struct ProjectFill {
    std::string surface{};             ///< or "horizon": all with that role
    std::string method = "kriging";    ///< or "rbf"
    std::string model = "auto";        ///< of the variogram
    std::optional<double> max_area{};  ///< larger holes stay open
    std::optional<double> mesh_size{}; ///< none: as the border's edges
    std::optional<double> gap_slope{}; ///< none: as GapRule has it
    bool bridge_faults = false;        ///< gaps that a fault has torn, too
    std::optional<double> smoothing{}; ///< root mean square by which rbf may miss data; 0: "auto"
};

/// A horizon of a stack, and how hard it is.
struct ProjectLayer {
    std::string surface{};
    double hardness = 0;
};

/// Horizons that are put in order, after holes are filled (layers.hpp).
struct ProjectLayers {
    std::vector<ProjectLayer> order{}; ///< from the top down, >= 1
    double min_thickness = 0;          ///< along z
};

/// An edge length for a name.
using ProjectSize = std::pair<std::string, double>;

/// Better triangles (improve.hpp).
struct ProjectImprove {
    std::optional<double> edge_length{};       ///< none: as many triangles as there are
    std::optional<double> max_deviation{};     ///< none: a twentieth of the length
    std::vector<ProjectSize> edge_length_of{}; ///< by surface
};

struct ProjectTetrahedra {
    std::optional<double> edge_length{}, quality{}, max_volume{};
    double time_limit = 600;            ///< seconds, > 0
    std::vector<ProjectSize> size_of{}; ///< by surface
    std::vector<ProjectSize> size_in{}; ///< by block: its number or its name
    std::vector<std::string> split{};   ///< surfaces, or "fault" for all with that role
    std::optional<bool> outside{};      ///< whether region 0 gets tetrahedra, too; none: unless
                                        ///< there is a volume of interest
};

/// Formats of what is written to the folder.
struct ProjectOutputs {
    std::vector<std::string> surfaces{};   ///< as format_named knows them
    std::vector<std::string> tetrahedra{}; ///< likewise; empty: none are made
    std::string blocks{};                  ///< "vtp", "obj"; empty: none
    bool certificate = false;
};

struct Project {
    std::filesystem::path folder{};          ///< for the results; empty: not stated
    std::vector<ProjectSurfaces> surfaces{}; ///< >= 1
    std::variant<std::monostate, ProjectBox, RotatedBox, ProjectPolygon, ProjectWithin> volume{};
    std::vector<ProjectFill> fill{}; ///< no surface in two of them
    std::optional<ProjectLayers> layers{};
    std::optional<double> extend{}; ///< limit for horizons that end inside the volume
    std::optional<double> seal{};   ///< distance of gaps that are closed
    std::optional<ProjectImprove> improve{};
    ProjectTetrahedra tetrahedra{};
    ProjectOutputs outputs{};
    unsigned threads = 0; ///< 0: all cores
};

/// Paths are made relative to `base`, the folder of the project file, where they are not absolute;
/// `source` names it in messages. Files are not looked at.
/// Errors: bad_syntax with "source:line"; bad_option with "source: surfaces[2].role" and what was
/// expected there: a key that is missing, unknown (with the one that was meant, most likely) or
/// there twice, a value of the wrong type, out of range, or none of those to choose from.
Result<Project> parse_project(std::string_view text, const std::filesystem::path& base,
                              std::string_view source);

/// The same of a file. Errors: cannot_open, and as above.
Result<Project> read_project(const std::filesystem::path& path);

/// All keys that parse_project knows, as "surfaces[].role", sorted.
std::vector<std::string> project_keys();

} // namespace terrane
