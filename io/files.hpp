// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Any format, chosen by the extension of the file name.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/io/gocad/gocad.hpp>
#include <terrane/io/grids/grid.hpp>
#include <terrane/io/meshes/cell_array.hpp>
#include <terrane/io/meshes/poly.hpp>

namespace terrane {

enum class Format {
    gocad, ///< .ts .ml .gp .mx
    obj,   ///< .obj
    off,   ///< .off
    stl,   ///< .stl (float32)
    ply,   ///< .ply
    vtp,   ///< .vtp, written only
    vtu,   ///< .vtu, written only: tetrahedra
    msh,   ///< .msh, written only: MSH 4.1
    msh22, ///< by its name only: MSH 2.2
    inp,   ///< .inp, written only: Abaqus
    medit, ///< .mesh, written only
    poly,  ///< .poly, written only: TetGen, surfaces
    smesh, ///< .smesh, written only: the same
    irap,  ///< .irap .gri .fgr, read only: a grid, text or binary
    zmap,  ///< .zmap .zycor, read only: a grid
    cps3,  ///< .cps3 .cps, read only: a grid
    esri,  ///< .asc .agr, read only: a grid
    xyz,   ///< .xyz .csv .txt .dat .poi .pol, read only: points
    vset,  ///< .vs .pl, read only: points of GOCAD's VSet and PLine
};

/// Whether surfaces can be read from it.
bool is_read(Format format);

/// Whether surfaces, or tetrahedra, can be written in it.
bool holds_surfaces(Format format);
bool holds_tetrahedra(Format format);

/// By extension, in any case; none where it is not known.
std::optional<Format> format_of(const std::filesystem::path& path);

/// The format with a name as given by a user: "ts", "ml", "obj", ... (an extension without dot).
std::optional<Format> format_named(std::string_view name);

/// The surfaces of a file; "-" is standard input and needs a format. See the header of the format
/// for what becomes a surface; a nameless one is called after the file.
/// Errors: cannot_open, unknown_format, unsupported (also: a format that is only written),
/// nothing_to_do, bad_syntax, bad_number, bad_index, out_of_memory; the place is "file:line", or
/// "file, byte n" in binary files.
Result<std::vector<Surface>> read_surfaces(const std::filesystem::path& path,
                                           std::optional<Format> format = std::nullopt,
                                           const ReadOptions& options = {});

/// The same for a file's contents; `source` is its name in messages and for nameless surfaces.
/// Total: any bytes give surfaces or an error, in time and memory linear in their number; points
/// take the time of connect_points.
Result<std::vector<Surface>> parse_surfaces(std::string_view contents, std::string_view source,
                                            Format format, const ReadOptions& options = {});

/// A GOCAD model with its parts and regions. Errors: as read_surfaces.
Result<GocadModel> read_model(const std::filesystem::path& path);

struct WriteOptions {
    std::optional<Format> format{};     ///< none: by extension; needed for "-"
    bool ascii = false;                 ///< STL only: text instead of binary
    bool compress = true;               ///< VTP and VTU only: zlib
    std::span<const CellArray> cells{}; ///< VTP and VTU only: further arrays, one value per cell
    std::span<const RegionPoint> regions{}; ///< .poly and .smesh only
    std::span<const std::string>
        region_names{}; ///< MSH and .inp of tetrahedra: what each region is
};

/// Writes the whole file or, where that fails, nothing. "-" is standard output.
/// Errors: cannot_open, write_failed, unknown_format, unsupported (tetrahedra only), bad_number (a
/// coordinate beyond float32 in STL), bad_option (a cell array of the wrong length), out_of_memory.
Status write_mesh(const Mesh& mesh, const std::filesystem::path& path,
                  const WriteOptions& options = {});

/// .vtu, .msh, .inp or .mesh. Errors: as write_mesh.
Status write_tetrahedra(const TetrahedralMesh& mesh, const std::filesystem::path& path,
                        const WriteOptions& options = {});

} // namespace terrane
