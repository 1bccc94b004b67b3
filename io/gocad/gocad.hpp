// SPDX-License-Identifier: LGPL-3.0-or-later
//
// GOCAD: triangulated surfaces (.ts) and structural models (.ml).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// One Surface per TSurf object, in file order; its TFACE blocks in one. Also the TSurf objects in
/// groups and models. Other objects (PLine, VSet, Voxet, ...) are passed over.
/// - z points up: where the object says ZPOSITIVE Depth, z becomes -z (corners keep their order).
/// - Units stay as they are, per axis; objects with different AXIS_UNIT in one file are refused.
/// - All vertices of the object, in file order; an ATOM is the vertex that it refers to. Ids may
///   have gaps, and may be used before they are defined.
/// - Role: from GEOLOGICAL_TYPE, or from the feature type in a model's list of TFACE.
/// - Without a name the surface is called `name`. A header without its } ends at the next keyword.
/// Errors: bad_syntax (also: an object without END, a file cut off), bad_number, bad_index,
/// unsupported, all with "source:line"; nothing_to_do without a TSurf or a triangle.
Result<std::vector<Surface>> read_gocad(std::string_view contents, std::string_view source,
                                        std::string_view name);

/// A connected part of a surface of a model: one TFACE.
struct ModelPart {
    std::uint32_t id = 0;             ///< number in the file
    std::string feature;              ///< as in the file: "fault", "top", "boundary", "none", ...
    std::uint32_t surface = 0;        ///< index into GocadModel::surfaces
    std::uint32_t first_triangle = 0; ///< its triangles in the surface: first ...
    std::uint32_t triangle_count = 0; ///< ... and number
};

/// One side of a part.
struct ModelSide {
    std::uint32_t part = 0; ///< index into GocadModel::parts
    bool positive = true;   ///< the sign in the file

    friend bool operator==(const ModelSide&, const ModelSide&) = default;
};

struct ModelRegion {
    std::uint32_t id = 0;         ///< number in the file
    std::string name;             ///< "Universe" is the outside
    std::vector<ModelSide> sides; ///< order of the file
};

struct ModelLayer {
    std::string name;
    std::vector<std::uint32_t> regions; ///< ids of its regions, order of the file
};

/// A GOCAD Model3d with the surfaces that it is made of.
struct GocadModel {
    std::string name;
    std::vector<Surface> surfaces;    ///< as read_gocad gives them
    std::vector<ModelPart> parts;     ///< order of the file
    std::vector<ModelRegion> regions; ///< order of the file, with the outside
    std::vector<ModelLayer> layers;   ///< order of the file
};

/// Errors: as read_gocad; bad_syntax where a surface of the model is missing or has another number
/// of TFACE blocks than the model lists; bad_index where a region names no TFACE; nothing_to_do
/// without a Model3d.
Result<GocadModel> read_gocad_model(std::string_view contents, std::string_view source,
                                    std::string_view name);

/// One TSurf per surface, z up (ZPOSITIVE Elevation), with the vertices that it uses in the order
/// of the mesh. A triangle of several surfaces is written in each of them. Names are quoted where
/// they would not survive otherwise. Numbers read back as the same doubles.
std::string to_gocad(const Mesh& mesh);

} // namespace terrane
