// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Fills the blocks of a mesh with tetrahedra, by TetGen or Gmsh. The library contains neither, as
// their licences (AGPL, GPL) differ: it runs helper programs that do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/optimisation/optimise.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// An axis-aligned box; low < high in each coordinate; unit of the mesh.
struct Box3 {
    Point3 low;  ///< least coordinates
    Point3 high; ///< largest coordinates
};

/// A wanted edge length on and near a surface.
struct SurfaceSize {
    SurfaceId surface{};    ///< index of a surface of the mesh
    double edge_length = 0; ///< wanted, > 0, unit of the mesh
};

/// A wanted edge length in a block. Block 0 is the space between the mesh and the box.
struct BlockSize {
    BlockId block{};        ///< number that find_volumes(mesh) gives to it
    double edge_length = 0; ///< wanted, > 0, unit of the mesh
};

/// The program that makes the tetrahedra.
enum class Mesher : std::uint8_t {
    automatic, ///< TetGen; where it fails, Gmsh, if its helper is there and no size of a block or
               ///< surface is wanted. It has no bound on shapes, but optimises them
    tetgen,    ///< TetGen alone
    gmsh,      ///< Gmsh alone, which never divides a triangle
};

/// Options of tetrahedralize().
struct TetrahedraOptions {
    Mesher mesher = Mesher::automatic; ///< who makes the tetrahedra
    std::optional<Box3> box{};         ///< closes the domain; must contain the mesh strictly inside
    double margin = 0.1;               ///< see describe(); at least 2^-40 of the largest coordinate
    std::optional<double> edge_length{};       ///< see describe()
    std::optional<double> radius_edge_ratio{}; ///< see describe(); none: no bound, or 2 with any
                                               ///< size
    bool split_surfaces = false;        ///< see describe(); needs a ratio. Any size allows it, too
    std::optional<double> max_volume{}; ///< see describe()
    std::vector<BlockSize> block_sizes{};     ///< instead of edge_length and max_volume there
    std::vector<SurfaceSize> surface_sizes{}; ///< where they are less than any other size there
    std::optional<OptimiseOptions> optimise = OptimiseOptions{}; ///< of their shapes; none: as
                                                                 ///< the mesher made them
    double time_limit = 600;             ///< see describe(): a mesher may run forever
    std::filesystem::path helper{};      ///< TetGen's helper program; empty: see find_tetgen_helper
    std::filesystem::path gmsh_helper{}; ///< Gmsh's helper program; empty: see find_gmsh_helper

    /// Describes the options, see Field. Lengths are in the unit of the mesh.
    static void describe(const auto& visit, auto& o) {
        constexpr FieldBounds ratios{1.1, std::numeric_limits<double>::max(), true};
        visit(Field("edge_length", "L", "Wanted length of edges everywhere",
                    "as few tetrahedra as possible", {}, true),
              o.edge_length);
        visit(Field("max_volume", "V", "Largest volume of a tetrahedron", "no limit", {}, true),
              o.max_volume);
        visit(Field("quality", "RATIO", "Largest ratio of circumradius to shortest edge",
                    "no limit", ratios, true),
              o.radius_edge_ratio);
        visit(Field("split_surfaces", "", "Lets triangles of surfaces be divided for `quality`", {},
                    {}, true),
              o.split_surfaces);
        visit(Field("margin", "SHARE",
                    "Without `around`: the bounding box, larger on each side by this share of its "
                    "longest edge",
                    {}, {0, 1e9}),
              o.margin);
        visit(Field("time_limit", "SECONDS",
                    "Time limit in seconds for each of the ways in which a mesher is tried", {}, {},
                    true),
              o.time_limit);
        visit(Field("mesher", "PROGRAM", "tetgen, gmsh, or auto: TetGen, and Gmsh where that fails",
                    "auto", {}, true),
              o.mesher);
        visit(Field("optimise", "", "Improves the shapes of tetrahedra", {}, {}, true), o.optimise);
    }
};

/// Fills a box with tetrahedra such that every triangle of the mesh is a union of faces. `volumes`
/// are those of the mesh.
///
/// (1) Without sizes and split_surfaces, the faces on the mesh are its triangles, undivided,
///     unless TetGen needs more vertices on them. Vertices added on a triangle are rounded to
///     doubles next to it. The bound radius_edge_ratio is then missed at thin triangles, and
///     where surfaces are closer than their triangles are long.
/// (2) The vertices are the used ones of the mesh in its order and bit by bit, then the eight
///     corners of the box, then added ones.
/// (3) For each result it is proven exactly that all tetrahedra have positive volume, that the
///     volumes add up to the box's, and that each face has a tetrahedron on either side or lies on
///     the box. So the tetrahedra fill the box without overlap.
/// (4) Faces come in the order of their triangles and have their winding; faces on the box come
///     last, counterclockwise seen from outside.
/// (5) Regions are the parts into which the mesh divides the box, found by diffusion over the
///     tetrahedra (the paper, section 3: regions one dimension up). They have the numbers of
///     find_volumes(mesh). It is checked at every face that blocks and volumes correspond one to
///     one.
/// (6) The same arguments give the same result, unless one of the ways of asking a mesher runs out
///     of time.
///
/// The mesh must be conforming, as meshers may crash or run forever on another. A mesher runs in a
/// process of its own: nothing is printed, a crash is returned as an error, a stop request ends it
/// at once, and calls from several threads do not disturb each other. If it fails, or (3) does not
/// hold, it is asked again in other ways.
///
/// Errors: improper_contact with the place, bad_index, bad_number, bad_option, nothing_to_do (no
/// triangle and no box), interrupted, timed_out (in all ways), out_of_memory, unsupported (too
/// large for the mesher, or what it can't mesh, with the shortest edge and the sharpest angle),
/// internal; cannot_open if the helper program can't be found or run. An error about the helper has its path as the place.
///
/// Source: TetGen 1.5 (H. Si); Gmsh 4.8 (C. Geuzaine and J.-F. Remacle), its algorithms Delaunay and
/// HXT.
Result<TetrahedralMesh> tetrahedralize(const ConformingMesh& mesh, const Volumes& volumes,
                                       const TetrahedraOptions& options, const Run& run);

/// Proves that the mesh is conforming, finds its volumes, and fills it as above.
Result<TetrahedralMesh> tetrahedralize(const Mesh& mesh, const TetrahedraOptions& options,
                                       const Run& run);

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> tetrahedra_constants();

// Fills the blocks of a model with tetrahedra, by sizes and cuts that are given by name, and checks
// them. Regions have the numbers of the model's blocks.

/// The name of a surface or block as the user gave it.
struct GivenName {
    std::string name;  ///< name of a surface, or name or number of a block
    std::string place; ///< where the user gave it, for errors: "--size-of", "tetrahedra.split[0]"
};

/// An edge length for a surface or block.
struct NamedSize {
    GivenName of;           ///< surface or block that gets it
    double edge_length = 0; ///< unit of the mesh
};

/// The options of fill_blocks.
struct TetrahedraRequest {
    TetrahedraOptions options{};      ///< without sizes of blocks and surfaces
    std::vector<NamedSize> size_of{}; ///< by surface
    std::vector<NamedSize> size_in{}; ///< by block: its number or its name
    std::vector<GivenName> split{};   ///< surfaces, or "fault": all with that role
    bool outside = true;              ///< whether block 0 gets tetrahedra, too
};

/// The tetrahedra of a model.
struct FilledBlocks {
    TetrahedralMesh tetrahedra;                ///< blocks by the numbers of the blocks
    TetrahedraReport report;                   ///< likewise; with the outside, before splitting
    std::vector<std::string> block_names;      ///< names of the blocks, by block
    std::size_t added_nodes = 0;               ///< number of nodes that splitting added
    std::optional<OptimiseReport> optimised{}; ///< the improvement; none: options said so, or the
                                               ///< checks found violations before
};

/// Fills the blocks with tetrahedra, improves these, checks them against mesh and volumes, and
/// splits nodes. If the checks find violations, nodes are not split. Errors: bad_option, with its place, for a name
/// that does not exist; nothing_to_do if there is no block and the outside is not wanted; those of
/// tetrahedralize and split_nodes; interrupted.
Result<FilledBlocks> fill_blocks(const Model& model, const TetrahedraRequest& request,
                                 const Run& run = {});

/// Makes the tetrahedra alone, which is what takes time: with the outside, blocks by the numbers
/// of find_volumes(mesh), nothing improved or split. Errors: bad_option, those of tetrahedralize.
Result<TetrahedralMesh> make_tetrahedra(const Model& model, const TetrahedraRequest& request,
                                        const Run& run = {});

/// Improves tetrahedra that make_tetrahedra made of the same model, as fill_blocks() does, with
/// the freedom of vertices and the steps, angles and shapes, of `steps`. None, and nothing is changed, if
/// the checks find violations before, or the options ask for nothing. Errors: bad_option, those of
/// optimise().
Result<std::optional<OptimiseReport>>
improve_tetrahedra(const Model& model, const TetrahedraRequest& request,
                   const OptimiseOptions& steps, TetrahedralMesh& made, const Run& run = {});

/// Checks and improves tetrahedra that make_tetrahedra made of the same model, now or earlier,
/// checks what became of them, and splits nodes.
/// Nothing of them is trusted. Errors: those of fill_blocks that are left.
Result<FilledBlocks> fill_blocks(const Model& model, const TetrahedraRequest& request,
                                 TetrahedralMesh made, const Run& run = {});

// Finds the helper programs terrane-tetgen and terrane-gmsh, which alone are linked with TetGen and
// Gmsh.

/// Returns the path of the helper program. It is `given` unless that is empty; else what the
/// environment variable TERRANE_TETGEN names, if it is set and not empty; else the first of these
/// that exists: terrane-tetgen in the folder of the running program, in ../libexec/terrane/ from
/// there, in ../libexec/terrane/ and ../../libexec/terrane/ from the folder of the shared library
/// that contains Terrane, if one does, and in the folder where Terrane was to be installed when it
/// was built.
///
/// Errors: cannot_open, with the places that were looked at.
Result<std::filesystem::path> find_tetgen_helper(const std::filesystem::path& given = {});

/// Returns the path of Gmsh's helper program, which is found in the same way: terrane-gmsh, and the
/// environment variable TERRANE_GMSH.
Result<std::filesystem::path> find_gmsh_helper(const std::filesystem::path& given = {});

} // namespace terrane
