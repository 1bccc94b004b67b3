// SPDX-License-Identifier: LGPL-3.0-or-later
//
// GOCAD: triangulated surfaces (.ts) and structural models (.ml).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/block_names.hpp>

namespace terrane {

/// Reads one Surface per TSurf object, in file order, also from groups and models; its TFACE blocks
/// are merged. Other objects (PLine, VSet, Voxet, ...) are skipped.
/// - The z axis points up: if an object has ZPOSITIVE Depth, z becomes -z; the order of the corners
///   is kept.
/// - Units are not converted; objects with different AXIS_UNIT in one file are an error, unless
///   `mixed_units` says that the caller converts them.
/// - A surface has all vertices of its object, in file order; an ATOM is the vertex that it refers
///   to. Ids may have gaps, and may be used before they are defined.
/// - PROPERTIES on vertices become arrays, with ESIZES, UNITS and NO_DATA_VALUES. Numbers that are missing are
///   no values.
/// - The role comes from GEOLOGICAL_TYPE, or from the feature type in a model's list of TFACE.
/// - A surface without a name is called `name`. A header without its } ends at the next keyword.
/// Errors: bad_syntax (also for an object without END and a truncated file), bad_number, bad_index,
/// unsupported, all with "source:line"; nothing_to_do if there is no TSurf or no triangle.
Result<std::vector<Surface>> read_gocad(std::string_view contents, std::string_view source,
                                        std::string_view name, bool mixed_units = false);

/// A connected part of a surface of a model: one TFACE block.
struct ModelPart {
    std::uint32_t id = 0;             ///< number in the file
    std::string feature;              ///< from the file: "fault", "top", "boundary", "none", ...
    SurfaceId surface{};              ///< index into GocadModel::surfaces
    std::uint32_t first_triangle = 0; ///< index of its first triangle in the surface
    std::uint32_t triangle_count = 0; ///< number of its triangles, which are consecutive
};

/// One side of a part.
struct ModelSide {
    std::uint32_t part = 0; ///< index into GocadModel::parts
    bool positive = true;   ///< the sign in the file

    friend bool operator==(const ModelSide&, const ModelSide&) = default;
};

/// A region of a model, bounded by its sides.
struct ModelRegion {
    std::uint32_t id = 0;         ///< number in the file
    std::string name;             ///< "Universe" is the outside
    std::vector<ModelSide> sides; ///< in file order
};

/// A layer of a model: some of its regions.
struct ModelLayer {
    std::string name;                   ///< as in the file
    std::vector<std::uint32_t> regions; ///< ids of its regions, in file order
};

/// A GOCAD Model3d with its surfaces.
struct GocadModel {
    std::string name;                 ///< as in the file
    std::vector<Surface> surfaces;    ///< as read_gocad gives them
    std::vector<ModelPart> parts;     ///< in file order
    std::vector<ModelRegion> regions; ///< in file order, including the outside
    std::vector<ModelLayer> layers;   ///< in file order
};

/// Reads the first Model3d of a file and all its surfaces. Errors: those of read_gocad; bad_syntax
/// if a surface of the model is missing or its number of TFACE blocks differs from the model's
/// list; bad_index if a region names a TFACE that does not exist; nothing_to_do if there is no
/// Model3d.
Result<GocadModel> read_gocad_model(std::string_view contents, std::string_view source,
                                    std::string_view name);

/// Lists the regions of a model but the outside, with the parts that have the region on one side
/// only. A region is of the first layer that names it.
std::vector<StatedBlock> stated_blocks_of(const GocadModel& model);

/// Writes one TSurf per surface, with z up (ZPOSITIVE Elevation) and the vertices that the surface
/// uses, in the order of the mesh. A triangle of several surfaces is written in each of them. Names
/// are quoted where this is needed to read them back. Numbers read back as the same doubles. `values`: per surface,
/// as from carry_values(); those on vertices are written as PROPERTIES. Defined in detail/write.cpp.
std::string to_gocad(const Mesh& mesh, std::span<const SurfaceValues> values = {});

} // namespace terrane
