// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tetrahedra in the blocks of a model, by TetGen or Gmsh, which run as programs of their own.
#pragma once

#include <terrane/capi/base.h>
#include <terrane/capi/model.h>
#include <terrane/capi/surfaces.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A tetrahedral mesh that conforms to the triangles of a model, and the findings of its check.
typedef struct terrane_tetrahedra terrane_tetrahedra;

/// The program that makes tetrahedra.
typedef int32_t terrane_mesher;
enum {
    TERRANE_MESHER_AUTOMATIC =
        0,                     ///< TetGen; where it fails, Gmsh, if no size of a block or surface
                               ///< is wanted
    TERRANE_MESHER_TETGEN = 1, ///< TetGen alone
    TERRANE_MESHER_GMSH = 2    ///< Gmsh alone, which never divides a triangle
};

/// An edge length for a surface or block.
typedef struct terrane_named_size {
    const char* name;   ///< of a surface, or name or number of a block
    double edge_length; ///< > 0, unit of the mesh
} terrane_named_size;

/// Options of terrane_tetrahedralize. Lengths are in the unit of the mesh.
typedef struct terrane_tetrahedra_options {
    size_t struct_size;       ///< sizeof(terrane_tetrahedra_options)
    terrane_mesher mesher;    ///< who makes the tetrahedra
    int32_t split_triangles;  ///< not 0: triangles may be divided for radius_edge_ratio
    int32_t skip_outside;     ///< not 0: the outside gets no tetrahedra
    int32_t has_box;          ///< not 0: `box_low` and `box_high` close the domain
    double box_low[3];        ///< least coordinates, below all of the mesh; 0 without a box
    double box_high[3];       ///< largest coordinates
    double margin;            ///< without a box: share of the longest edge of the bounding
                              ///< box
    double edge_length;       ///< wanted; 0: as few tetrahedra as possible
    double radius_edge_ratio; ///< TetGen's quality bound, >= 1.1; 0: none, or 2 with any
                              ///< size
    double max_volume;        ///< largest volume of a tetrahedron, cubic unit; 0: no limit
    double time_limit;        ///< seconds, > 0, for each way of asking a mesher; default
                              ///< 600
    const terrane_named_size* size_of; ///< by surface
    size_t size_of_count;              ///< number of them
    const terrane_named_size* size_in; ///< by block
    size_t size_in_count;              ///< number of them
    const char* const* split;          ///< names of surfaces whose nodes are duplicated; "fault":
                                       ///< all faults
    size_t split_count;                ///< number of them
    const char* helper;                ///< TetGen's helper program; NULL: it is looked for
    const char* gmsh_helper;           ///< Gmsh's helper program; NULL: it is looked for
    int32_t keep_shapes;               ///< not 0: the shapes that the mesher made are not improved
    int32_t reserved;                  ///< 0
} terrane_tetrahedra_options;

/// The improvement of the shapes that the mesher made. The quality of a tetrahedron is
/// the least sine of its dihedral angles, 0.7 times that of an obtuse one; angles are in degrees.
typedef struct terrane_shape_report {
    double quality_before;       ///< the least one
    double quality_after;        ///< likewise
    double least_angle_before;   ///< dihedral
    double least_angle_after;    ///< likewise
    double largest_angle_before; ///< dihedral
    double largest_angle_after;  ///< likewise
    uint64_t passes;             ///< over all tetrahedra that were worse than wanted
    uint64_t removed_edges;      ///< with 3 and more tetrahedra around them
    uint64_t removed_faces;      ///< number of faces removed
    uint64_t moved;              ///< moves of vertices
    uint64_t contracted;         ///< vertices that joined a neighbour
    uint64_t inserted;           ///< vertices that were added
    uint64_t remeshed;           ///< neighbourhoods where several of these were made at a time
    uint64_t left;               ///< tetrahedra that are still worse than wanted
    uint64_t untried;            ///< of these: not tried again after a neighbour changed
    uint64_t effort;             ///< possible tetrahedra that were measured
    int32_t is_cut_short;        ///< 1: a limit of the effort ended the work
    int32_t reserved;            ///< 0
} terrane_shape_report;

/// The volume of a block and that of its tetrahedra, in cubic units.
typedef struct terrane_block_volume {
    double block;      ///< nearest to the exact volume; [0], the outside: that of its tetrahedra
    double tetrahedra; ///< nearest to the exact sum of their volumes
    double difference; ///< nearest to the exact difference
    double bound;      ///< on the difference; 0 where no triangle of the block is divided
    int32_t is_equal;  ///< 1: the two are exactly equal
    int32_t reserved;  ///< 0
} terrane_block_volume;

/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_tetrahedra_options_init(terrane_tetrahedra_options* options,
                                                         size_t struct_size);

/// Fills the blocks of a model with tetrahedra and checks them exactly; ask
/// terrane_tetrahedra_violation_count before the result is used. Free it with
/// terrane_tetrahedra_free. Errors: CANNOT_OPEN (the helper program), BAD_OPTION, NOTHING_TO_DO,
/// TIMED_OUT, UNSUPPORTED (what the mesher can't mesh), INTERRUPTED, OUT_OF_MEMORY, INTERNAL.
TERRANE_API terrane_code terrane_tetrahedralize(const terrane_model* model,
                                                const terrane_tetrahedra_options* options,
                                                const terrane_run* run, terrane_tetrahedra** out,
                                                terrane_error** error);
/// Frees tetrahedra.
TERRANE_API void terrane_tetrahedra_free(terrane_tetrahedra* tetrahedra);
/// Returns the number of kinds of violations that the check found; 0: the tetrahedra fill the
/// blocks.
TERRANE_API size_t terrane_tetrahedra_violation_count(const terrane_tetrahedra* tetrahedra);
/// Returns a violation in a sentence.
TERRANE_API const char* terrane_tetrahedra_violation(const terrane_tetrahedra* tetrahedra,
                                                     size_t violation);
/// Returns the vertices, 3 numbers each.
TERRANE_API const double* terrane_tetrahedra_vertices(const terrane_tetrahedra* tetrahedra,
                                                      size_t* vertex_count);
/// Returns the tetrahedra, 4 vertices each, positively oriented.
TERRANE_API const uint32_t* terrane_tetrahedra_cells(const terrane_tetrahedra* tetrahedra,
                                                     size_t* count);
/// Returns, per tetrahedron, the number of its block; 0 is the outside.
TERRANE_API const uint32_t* terrane_tetrahedra_block_of(const terrane_tetrahedra* tetrahedra,
                                                        size_t* count);
/// Returns the faces that lie on surfaces and on the box, 3 vertices each.
TERRANE_API const uint32_t* terrane_tetrahedra_faces(const terrane_tetrahedra* tetrahedra,
                                                     size_t* face_count);
/// Returns, per face, the triangle of the model's mesh that it is part of; TERRANE_NONE on the box.
TERRANE_API const uint32_t* terrane_tetrahedra_face_triangle(const terrane_tetrahedra* tetrahedra,
                                                             size_t* face_count);
/// Gives, per face, its surfaces. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_tetrahedra_face_surfaces(const terrane_tetrahedra* tetrahedra,
                                                          terrane_lists* lists);
/// Returns pairs of faces in front of and behind a cut: `count` pairs.
TERRANE_API const uint32_t* terrane_tetrahedra_twins(const terrane_tetrahedra* tetrahedra,
                                                     size_t* count);
/// Returns the number of surfaces; the box, if there is one, is the last.
TERRANE_API size_t terrane_tetrahedra_surface_count(const terrane_tetrahedra* tetrahedra);
/// Returns the name of a surface.
TERRANE_API const char* terrane_tetrahedra_surface_name(const terrane_tetrahedra* tetrahedra,
                                                        size_t surface);
/// Returns the number of blocks, with the outside.
TERRANE_API size_t terrane_tetrahedra_block_count(const terrane_tetrahedra* tetrahedra);
/// Returns the name of a block.
TERRANE_API const char* terrane_tetrahedra_block_name(const terrane_tetrahedra* tetrahedra,
                                                      size_t block);
/// Returns, per block, its volume and that of its tetrahedra.
TERRANE_API const terrane_block_volume*
terrane_tetrahedra_volumes(const terrane_tetrahedra* tetrahedra, size_t* block_count);
/// Returns the program that made the tetrahedra, "TetGen" or "Gmsh".
TERRANE_API const char* terrane_tetrahedra_mesher(const terrane_tetrahedra* tetrahedra);
/// Copies the report about shapes; all is 0 where they were not improved. `struct_size` is
/// sizeof(terrane_shape_report). Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_tetrahedra_shape_report(const terrane_tetrahedra* tetrahedra,
                                                         terrane_shape_report* report,
                                                         size_t struct_size);
/// Writes the tetrahedra as .vtu, .msh, .inp or .mesh, with the names of blocks. Errors: those of
/// writing; BAD_OPTION where the check found violations.
TERRANE_API terrane_code terrane_tetrahedra_write(const terrane_tetrahedra* tetrahedra,
                                                  const char* path,
                                                  const terrane_write_options* options,
                                                  terrane_error** error);

#ifdef __cplusplus
}
#endif
