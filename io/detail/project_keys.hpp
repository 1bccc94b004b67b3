// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The keys of each object of a project file, and the values to choose from. project.schema.json
// states the same.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace terrane::detail {

inline constexpr std::array<std::string_view, 19> project_level{
    "format",    "folder",     "threads", "surfaces",           "unit",
    "column",    "fill",       "layers",  "volume_of_interest", "extend",
    "tolerance", "seal",       "seal_of", "min_volume",         "max_move",
    "improve",   "tetrahedra", "outputs", "uncertainty"};
inline constexpr std::array<std::string_view, 5> surfaces_level{"file", "objects", "name", "role",
                                                                "depth"};
inline constexpr std::array<std::string_view, 4> own_fill_level{"surface", "method", "model",
                                                                "smoothing"};
inline constexpr std::array<std::string_view, 2> layers_level{"order", "min_thickness"};
inline constexpr std::array<std::string_view, 2> layer_level{"surface", "hardness"};
inline constexpr std::array<std::string_view, 4> volume_level{"box", "rotated_box", "polygon",
                                                              "within"};
inline constexpr std::array<std::string_view, 2> box_level{"low", "high"};
inline constexpr std::array<std::string_view, 6> rotated_level{"centre",  "corner", "lengths",
                                                               "azimuth", "plunge", "roll"};
inline constexpr std::array<std::string_view, 2> polygon_level{"corners", "between"};
inline constexpr std::array<std::string_view, 7> own_tetrahedra_level{
    "size_of", "size_in", "split", "outside", "refine_bad", "order", "move_vertices"};
inline constexpr unsigned most_rounds = 20; ///< of tetrahedra.refine_bad
inline constexpr std::array<std::string_view, 3> meshers{"auto", "tetgen", "gmsh"};
inline constexpr std::array<std::string_view, 5> outputs_level{"surfaces", "tetrahedra", "blocks",
                                                               "certificate", "gocad"};

inline constexpr std::array<std::string_view, 8> uncertainty_level{
    "surface", "group", "field", "shift", "tilt", "dip", "throw", "throw_reach"};
inline constexpr std::array<std::string_view, 7> field_level{
    "model", "range", "smoothness", "azimuth", "ratio", "sd", "map"};
inline constexpr std::array<std::string_view, 4> covariance_models{"spherical", "exponential",
                                                                   "gaussian", "matern"};
inline constexpr std::array<double, 2> smoothnesses{1.5, 2.5};

inline constexpr std::array<std::string_view, 5> units{"m", "km", "cm", "ft", "ftUS"};
inline constexpr std::array<std::string_view, 3> roles{"horizon", "fault", "boundary"};
inline constexpr std::array<std::string_view, 2> fill_methods{"kriging", "rbf"};
inline constexpr std::array<std::string_view, 6> variogram_models{
    "auto", "spherical", "exponential", "gaussian", "matern", "power"};
inline constexpr std::array<std::string_view, 13> block_formats{
    "auto", "vtp",   "obj", "ts",   "ply",  "off",  "stl",
    "msh",  "msh22", "inp", "mesh", "poly", "smesh"};
inline constexpr auto surface_formats = std::span(block_formats).subspan<1>();
inline constexpr std::array<std::string_view, 12> tetrahedra_formats{
    "vtu", "msh", "msh22", "inp", "mesh", "exo", "ugi", "ogs", "geos", "pylith", "unv", "f3grid"};
inline constexpr std::array<std::string_view, 1> formats{"terrane-project 1"};

inline constexpr double most_threads = 1024;

} // namespace terrane::detail
