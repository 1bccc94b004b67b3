// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading and writing files of any format, which the extension of the file name selects.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/block_names.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// The file formats.
enum class Format {
    gocad,   ///< .ts .ml .gp .mx .gm
    obj,     ///< .obj
    off,     ///< .off
    stl,     ///< .stl (float32)
    ply,     ///< .ply
    vtp,     ///< .vtp
    vtu,     ///< .vtu: tetrahedra; the faces among its cells are read
    msh,     ///< .msh: MSH 4.1; also MSH 2.2 where it is read
    msh22,   ///< written only: MSH 2.2; no extension selects it, only its name
    inp,     ///< .inp, written only: Abaqus
    medit,   ///< .mesh, written only
    poly,    ///< .poly, written only: TetGen, surfaces
    smesh,   ///< .smesh, written only: TetGen, surfaces
    vtk,     ///< .vtk: legacy VTK; written as POLYDATA
    dxf,     ///< .dxf: 3DFACE
    unv,     ///< .unv, written only: universal files of I-DEAS
    exodus,  ///< .exo .e, written only: Exodus II, tetrahedra
    ugi,     ///< .ugi, written only: PFLOTRAN, tetrahedra and the files of regions
    ogs,     ///< written only: OpenGeoSys, VTU files of tetrahedra and of boundaries; by its name
    geos,    ///< written only: GEOS, a .vtm with tetrahedra and fractures; by its name
    pylith,  ///< written only: PyLith, MSH 4.1 of tetrahedra with edges of faults; by its name
    f3grid,  ///< .f3grid, written only: FLAC3D, tetrahedra
    vti,     ///< .vti, written only: a grid, VTK's ImageData
    irap,    ///< .irap .gri .fgr: a grid, text or binary; written as text
    zmap,    ///< .zmap .zycor: a grid
    cps3,    ///< .cps3 .cps, read only: a grid
    esri,    ///< .asc .agr: a grid
    surfer,  ///< .grd: a grid, text or binary; written as text
    xyz,     ///< .xyz .csv .txt .dat .poi .pol, read only: points
    vset,    ///< .vs: points of GOCAD's VSet and PLine; written: the vertices of surfaces
    pline,   ///< .pl: the same points; written: borders of surfaces and intersection curves
    grdecl,  ///< .grdecl, read only: corner-point grids
    sticks,  ///< .sticks, read only: fault sticks
    vts,     ///< .vts, read only: surfaces as structured grids
    landxml, ///< .xml .landxml, read only: LandXML
};

/// Tells whether surfaces can be read from this format.
bool is_read(Format format);

/// Tells whether surfaces, or tetrahedra, can be written in this format.
bool holds_surfaces(Format format);
/// Whether tetrahedra can be written in the format.
bool holds_tetrahedra(Format format);
/// Whether tetrahedra of second order can be written in the format (WriteOptions::order).
bool holds_second_order(Format format);
/// Whether tetrahedra in the format are several files, of which the user names the first.
bool has_several_files(Format format);
/// Tells whether a mesh of tetrahedra whose first file is `first` may have a file `other`. Its files are
/// named STEM_NAME and an extension, where STEM is that of `first`, and NAME is that of a block or a
/// surface.
bool may_be_beside(Format format, const std::filesystem::path& first,
                   const std::filesystem::path& other);
/// Whether the vertices or lines of surfaces, but not their triangles, can be written in the format.
bool holds_outlines(Format format);
/// Whether a grid can be read from the format, and whether one can be written.
bool is_grid(Format format);
bool holds_grids(Format format);

/// Returns the names of the values that a file in this format would not have: on vertices or on triangles the
/// format has none, or not of this shape.
std::vector<std::string> values_left_out(Format format, std::span<const SurfaceValues> values);

/// Returns the format for the extension of a file name, in any case; none if it is unknown.
std::optional<Format> format_of(const std::filesystem::path& path);

/// Does the same for a file that is read: `top.ts.gz`, `top.ts.xz` and `top.ts.zip` are compressed GOCAD files.
std::optional<Format> format_to_read(const std::filesystem::path& path);

/// Returns the format with this name, an extension without its dot: "ts", "ml", "obj", ...
std::optional<Format> format_named(std::string_view name);
/// Returns all names of formats, which are the extensions of their files: "ts", "ml", ...
std::vector<std::string_view> format_names();

/// Reads the surfaces of a file; "-" is standard input and needs a format. The header of the format
/// defines what becomes a surface; a surface without a name is named after the file.
/// Errors: cannot_open, unknown_format, unsupported (also: a format that is only written),
/// nothing_to_do, bad_syntax, bad_number, bad_index, out_of_memory; the place is "file:line", or
/// "file, byte n" in binary files.
Result<std::vector<Surface>> read_surfaces(const std::filesystem::path& path,
                                           std::optional<Format> format = std::nullopt,
                                           const ReadOptions& options = {});

/// Reads the surfaces in the contents of a file; `source` is the name of the file, in messages and
/// for surfaces without a name. Any bytes give surfaces or an error, in time and memory linear in
/// their number; points take the time of connect_points in addition. Errors: those of
/// read_surfaces.
Result<std::vector<Surface>> parse_surfaces(std::string_view contents, std::string_view source,
                                            Format format, const ReadOptions& options = {});

/// Reads a grid, with its heights as the file has them: unlike read_surfaces(), it leaves depths alone. Errors: those
/// of read_surfaces(); nothing_to_do for a format of anything else.
Result<Grid> read_grid(const std::filesystem::path& path,
                       std::optional<Format> format = std::nullopt);

/// Reads the tetrahedra of a file with their labels: VTU, legacy VTK and MSH. Errors: those of
/// read_surfaces; nothing_to_do if there is none, also in other formats.
Result<LabelledTetrahedra> read_tetrahedra(const std::filesystem::path& path,
                                           std::optional<Format> format = std::nullopt);

/// Reads the blocks that a file states, by its surfaces in the order of read_surfaces(): those of
/// the first model of a GOCAD file but the outside, "Universe". There are none in other formats, in
/// standard input, and where the model cannot be read. Cost: that of reading a file with a model again.
std::vector<StatedBlock> read_stated_blocks(const std::filesystem::path& path,
                                            std::optional<Format> format = std::nullopt);

/// Appends stated blocks of a file whose surfaces follow `before` others.
void append_stated_blocks(std::vector<StatedBlock> stated, std::size_t before,
                          std::vector<StatedBlock>& all);

/// Options of write_mesh() and write_tetrahedra().
struct WriteOptions {
    std::optional<Format> format{};     ///< none: by the extension; required for "-"
    bool ascii = false;                 ///< STL only: text instead of binary
    bool compress = true;               ///< VTP and VTU only: zlib
    std::span<const CellArray> cells{}; ///< VTP and VTU only: further arrays, one value per cell
    std::span<const BlockPoint> block_points{}; ///< .poly and .smesh only
    /// Tetrahedra, but not .mesh: the name of each block; VTP: names of blocks, for the field
    /// block_name; empty: none
    std::span<const std::string> block_names{};
    /// Values per surface, as from values_on(), in formats that have them: see values_left_out()
    std::span<const SurfaceValues> values{};
    /// Tetrahedra only: 2 puts a node in the middle of each edge (edge_nodes.hpp)
    unsigned order = 1;
};

/// Returns the contents of a file with the mesh in `format`; `options.format` has no effect.
/// Errors: those of write_mesh that do not concern files, with an empty place.
Result<std::string> format_mesh(const Mesh& mesh, Format format, const WriteOptions& options = {});

/// Writes a mesh to a file; if this fails, no file is written. "-" is standard output.
/// Errors: cannot_open, write_failed, unknown_format, unsupported (tetrahedra only), bad_number (a
/// coordinate beyond float32 in STL), bad_option (a cell array of the wrong length), out_of_memory.
Status write_mesh(const Mesh& mesh, const std::filesystem::path& path,
                  const WriteOptions& options = {});

/// Returns the contents of a file with a grid. Errors: those of write_grid() that do not concern files, with an empty
/// place.
Result<std::string> format_grid(const Grid& grid, Format format);

/// Writes a grid to a file; if this fails, no file is written. Rows and columns run along growing coordinates. Errors:
/// cannot_open, write_failed, unknown_format; unsupported (another format; a rotated grid, but in .irap and .vti);
/// bad_number for a value that the format takes for none; bad_option for a grid without steps.
Status write_grid(const Grid& grid, const std::filesystem::path& path,
                  std::optional<Format> format = std::nullopt);

/// Writes tetrahedra in a format that holds them. If this fails, no file is written, also in formats of
/// several files: the others are in the folder of `path`, and their names begin with its stem. Errors: those
/// of write_mesh; unsupported also for an order that the format does not have, and for split nodes
/// where the simulator splits them itself; bad_option for several files on standard output, and for
/// an order other than 1 and 2.
Status write_tetrahedra(const TetrahedralMesh& mesh, const std::filesystem::path& path,
                        const WriteOptions& options = {});

/// Does the same and returns the files that were written, first `path`.
Result<std::vector<std::filesystem::path>> write_tetrahedra_files(const TetrahedralMesh& mesh,
                                                                  const std::filesystem::path& path,
                                                                  const WriteOptions& options = {});

} // namespace terrane
