// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The contents of a project, which io/project.hpp reads from a file, or which a program sets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/search/method.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>
#include <terrane/algorithms/structure/block_names.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

namespace terrane {

/// An entry of "surfaces".
struct ProjectSurfaces {
    std::filesystem::path file;         ///< absolute, or relative to the project's folder
    std::vector<std::string> objects{}; ///< names of the objects to read; empty: all
    std::string name{};                 ///< of the only surface; empty: the name in the file
    std::optional<Role> role{};         ///< none: the role in the file
    bool depth = false;                 ///< grids and points: values are depths, positive down
};

/// An axis-aligned box given by two corners.
struct ProjectBox {
    Point3 low;  ///< least coordinates
    Point3 high; ///< largest coordinates
};

/// A vertical prism over a polygon, between two values of z in either order.
struct ProjectPolygon {
    std::vector<Point2> corners;     ///< >= 3
    std::array<double, 2> between{}; ///< z of its two ends
};

/// The volume that the closed surfaces of some files enclose.
struct ProjectWithin {
    std::vector<std::filesystem::path> files; ///< >= 1
};

/// A volume of interest; monostate: there is none.
using ProjectVolume =
    std::variant<std::monostate, ProjectBox, RotatedBox, ProjectPolygon, ProjectWithin>;

/// Filling the holes of a surface, which is the first step.
struct ProjectFill {
    std::string surface{}; ///< name of a surface, or "horizon" for all of that role; empty: all
    FillOptions options{}; ///< smoothing of 0: "auto"
};

/// A horizon of a stack, and its hardness.
struct ProjectLayer {
    std::string surface{};                 ///< its name
    double hardness = 0;                   ///< no unit; more is harder
    std::optional<std::uint32_t> number{}; ///< of the surface, from 0, where names are not unique;
                                           ///< no key of the file
};

/// A stack of horizons, whose vertical order is restored after holes are filled (layers.hpp).
struct ProjectLayers {
    std::vector<ProjectLayer> order{}; ///< from the top down; >= 1
    double min_thickness = 0;          ///< of each layer, along z, unit of the surfaces
};

/// The edge length for a surface or block with this name.
using ProjectSize = std::pair<std::string, double>;

/// Remeshing of the surfaces.
struct ProjectImprove {
    ImproveOptions options{};                  ///< but edge_length_of
    std::vector<ProjectSize> edge_length_of{}; ///< by surface
    Resolution resolution{};                   ///< of length 0: none
};

/// Tetrahedra of the blocks.
struct ProjectTetrahedra {
    TetrahedraOptions options{}; ///< radius_edge_ratio, none: improved_quality with `improve` and
                                 ///< without sizes
    bool move_vertices = true;   ///< whether, with `improve` and `optimise`, vertices of the
                                 ///< improved surfaces may move where tetrahedra are bad
    unsigned refine_bad = 0;     ///< how often, with `improve`, triangles are made smaller where
                                 ///< tetrahedra are bad, and tetrahedra made again
    unsigned order = 1;          ///< in files: 1, or 2 with nodes on edges
    std::vector<ProjectSize> size_of{}; ///< by surface
    std::vector<ProjectSize> size_in{}; ///< by number or name of a block
    std::vector<std::string> split{};   ///< names of surfaces, or "fault" for all with that role
    std::optional<bool> outside{};      ///< whether block 0 is meshed; none: only if there is no
                                        ///< volume of interest
};

/// Project files with `improve` ask for tetrahedra whose ratio of circumradius to shortest edge is
/// at most this, unless they state another bound.
inline constexpr double improved_quality = 1.3;

/// A random field by which a surface moves (gaussian_field.hpp).
struct ProjectField {
    std::string model = "gaussian"; ///< of the variogram: spherical, exponential, gaussian, matern
    double range = 0;               ///< at which covariance has gone to 5 %, 0 for spherical; > 0
    double smoothness = 1.5;        ///< of matern: 1.5 or 2.5
    double azimuth = 0; ///< of the direction of the longest range: degrees from y, clockwise
    double ratio = 1;   ///< range across it / range, in (0, 1]
    std::optional<double> sd{};  ///< standard deviation, unit of the surfaces
    std::filesystem::path map{}; ///< instead of sd: a grid whose values are standard deviations
    bool kriging = false;        ///< instead of sd: what "fill" foresees at new vertices
};

/// How uncertain the place of surfaces is. Each number is a standard deviation of a normal distribution.
struct ProjectUncertainty {
    std::string surface{};               ///< name of one or more surfaces
    std::string group{};                 ///< entries of a group move alike; empty: by the name
    std::optional<ProjectField> field{}; ///< none: no random field
    double shift = 0; ///< of the whole surface, along z or a fault's normal, unit of the surfaces
    double tilt = 0;  ///< of its slopes along x and along y, degrees; not for faults
    double dip = 0;   ///< degrees; for faults
    double slip =
        0; ///< of the throw: horizons above the fault go down by it, unit of the surfaces;
           ///< for faults
    std::optional<double>
        reach{}; ///< distance from the fault at which that has faded to 0; none: it
                 ///< does not fade
};

/// The formats of the files in the folder of results.
struct ProjectOutputs {
    std::vector<std::string> surfaces{}; ///< names for format_named
    std::vector<std::string>
        tetrahedra{};         ///< names for format_named; empty: no tetrahedra are made
    std::string blocks{};     ///< name for format_named; empty: none
    bool certificate = false; ///< whether to write one
    bool gocad = false;       ///< whether to write the model with its blocks for GOCAD
};

/// The stages of building a model, in their order. One that the project does not ask for is left out.
enum class BuildStage : std::uint8_t { preprocess, arrange, improve, blocks, tetrahedra };

/// A project: what to read, what to do, what to write.
struct Project {
    std::string source{};                    ///< the project file, for messages; empty: none
    std::filesystem::path folder{};          ///< of the results; empty: not stated
    std::vector<ProjectSurfaces> surfaces{}; ///< >= 1
    ProjectVolume volume{};                  ///< the volume of interest
    std::string unit{};                      ///< coordinates whose file states their unit are
                                             ///< converted to this one; empty: they stay
    StratigraphicColumn column{};            ///< empty: none
    std::vector<ProjectFill> fill{};         ///< no surface is in two of them
    std::optional<ProjectLayers> layers{};   ///< none: horizons are not put in order
    std::optional<double> tolerance{}; ///< what is nearer is joined before all else, unit of the
                                       ///< surfaces; gaps as wide are sealed unless `seal` or
                                       ///< `seal_of` is given; none: nothing is joined
    std::optional<double> extend{}; ///< limit of the extension of horizons that end in the volume,
                                    ///< unit of the surfaces
    std::optional<double> seal{};   ///< largest width of gaps to close, unit of the surfaces; 0:
                                    ///< "auto", see choose_seal()
    std::vector<ProjectSize> seal_of{}; ///< exceptions from `seal`, by surface, "F1", or pair of
                                        ///< surfaces, "F1/F2"; 0: never close these
    std::optional<double> min_volume{}; ///< smaller blocks are merged with a neighbour, cubic unit;
                                        ///< 0: "auto", see small_volume_for()
    std::optional<double> max_move{};   ///< of surfaces, when exact points become doubles, unit of
                                        ///< the surfaces; none: see RoundingOptions
    std::optional<ProjectImprove> improve{};       ///< none: triangles stay as they are
    ProjectTetrahedra tetrahedra{};                ///< made where outputs.tetrahedra asks for them
    ProjectOutputs outputs{};                      ///< files to write
    std::vector<ProjectUncertainty> uncertainty{}; ///< for ensembles; build() has no use for it
    unsigned threads = 0;                          ///< 0: all cores
    // What follows is no key of the file.
    std::optional<std::vector<std::size_t>> only_holes{}; ///< to fill, by number from 1; none: all
    Search search = Search::automatic; ///< how triangles that may meet are found; no result depends
                                       ///< on it
    unsigned max_rounds = RoundingOptions{}.max_rounds; ///< see RoundingOptions
    /// How meshes are shown to be conforming, and that it is counted what decided each pair of
    /// triangles; no result depends on it.
    PairCheckOptions check{PairCheck::bounds, SIZE_MAX};
    BuildStage last = BuildStage::tetrahedra; ///< later stages are left out
};

/// Returns the place of a key of the project, for messages: "project.json:
/// improve.edge_length_of.F1".
inline std::string place_of_key(const Project& project, const std::string& key) {
    return project.source.empty() ? key : project.source + ": " + key;
}

/// Makes a bad_option error about a key of the project.
inline Error at_key(const Project& project, const std::string& key, std::string sentence) {
    return {ErrorCode::bad_option, std::move(sentence), place_of_key(project, key)};
}

/// Says at which key of the project an error arose.
inline Error at_key(const Project& project, const std::string& key, const Error& error) {
    return {error.code, error.sentence, place_of_key(project, key)};
}

} // namespace terrane
