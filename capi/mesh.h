// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Meshes of doubles: triangles of several surfaces, their regions, their quality and their
// improvement.
#pragma once

#include <terrane/capi/base.h>
#include <terrane/capi/surfaces.h>

#ifdef __cplusplus
extern "C" {
#endif

/// One mesh of several surfaces. A triangle belongs to several surfaces where these coincide.
typedef struct terrane_mesh terrane_mesh;
/// The regions into which intersection edges divide the surfaces of a mesh.
typedef struct terrane_regions terrane_regions;
/// An improved mesh and its report.
typedef struct terrane_improved terrane_improved;

/// The moves, contacts and losses of rounding.
typedef struct terrane_rounding_report {
    int32_t is_conforming;         ///< 1: by exact check of the doubles
    uint32_t rounds;               ///< number of snapping rounds
    uint64_t naive_contacts;       ///< pairs that meet improperly at the nearest doubles; if it is
                                   ///< 64 or more, there may be more
    double max_move;               ///< no vertex is farther from its exact point; unit of the input
    double surface_deviation;      ///< no point of the mesh is farther from the input triangles
                                   ///< that it is part of, nor the reverse, except for what
                                   ///< vanished
    double max_allowed;            ///< the limit of surface_deviation
    double vanished_length;        ///< points of vanished slivers are at most so much farther from
                                   ///< the rest
    double deviation;              ///< of all points, vanished slivers included, both ways
    uint64_t moved_input_vertices; ///< number of input vertices that moved
    uint64_t merged_vertices;      ///< number of points that were merged with another one
    uint64_t collapsed_triangles;  ///< number of triangles that lost their area
    uint64_t vanished;             ///< number of input triangles without any part left
    int32_t arranged_again;        ///< 1: exact points are those in which moved surfaces cross
    int32_t reserved;              ///< 0
} terrane_rounding_report;

/// A part of a surface that hangs together without crossing an intersection edge.
typedef struct terrane_region {
    uint32_t surface;        ///< the surface that it is part of
    uint32_t first_triangle; ///< the lowest triangle of the region
    uint64_t triangles;      ///< number of triangles
    double area;             ///< in squared units, in floating point
} terrane_region;

/// Distribution of a measure.
typedef struct terrane_spread {
    double min;            ///< the least value
    double mean;           ///< the arithmetic mean
    double max;            ///< the largest value
    double percentiles[5]; ///< the 1st, 5th, 50th, 95th and 99th
} terrane_spread;

/// The quality of triangles; q = 2 r / R of the inscribed and circumscribed circles, 1 for
/// equilateral ones.
typedef struct terrane_quality {
    uint64_t triangles;            ///< number of triangles
    terrane_spread q;              ///< per triangle, 0 to 1
    terrane_spread smallest_angle; ///< per triangle, in degrees
    terrane_spread largest_angle;  ///< per triangle, in degrees
    terrane_spread edge_length;    ///< each edge counted once; unit of the input
    double share_above_08;         ///< share of the triangles with q > 0.8
    uint64_t histogram[20];        ///< number of triangles by q, in classes of 0.05
    uint32_t worst;                ///< the first triangle with the least q, or TERRANE_NONE
    uint32_t reserved;             ///< 0
} terrane_quality;

/// Options of terrane_improve. Lengths are in the unit of the mesh, angles in degrees.
typedef struct terrane_improve_options {
    size_t struct_size;           ///< sizeof(terrane_improve_options)
    double edge_length;           ///< wanted length of edges; 0: each surface keeps about as many
                                  ///< triangles as it has
    const double* edge_length_of; ///< per surface; 0: edge_length; NULL: no exceptions
    size_t edge_length_of_count;  ///< number of surfaces, or 0
    double max_deviation;         ///< no point of a surface moves farther from the original surface
                                  ///< than this; 0: a twentieth of the wanted length
    double curve_length;          ///< wanted length of edges along curves, where that is shorter;
                                  ///< 0: as elsewhere
    double turn;                  ///< asks for shorter edges where a surface is curved, so that
                                  ///< normals turn by about this angle along an edge; not shorter
                                  ///< than an eighth of the wanted length; 0: the same length
                                  ///< everywhere
    double layers_in_gaps;        ///< where surfaces are close, edges are at most as long as their
                                  ///< distance divided by this, at most 1000; 0: distances do not
                                  ///< count
    double smallest;              ///< layers_in_gaps asks for no shorter edges than this; 0: an
                                  ///< eighth of the least wanted length
    double growth;                ///< wanted lengths differ by at most this share of the way
                                  ///< between them
    double crease_angle;          ///< edges at which a surface turns by more than this angle are
                                  ///< kept
    double curve_angle;           ///< vertices at which a curve turns by more than this angle are
                                  ///< kept
    double thickness_share;       ///< where blocks are thin, points deviate by at most this share
                                  ///< of the distance to the next sheet, along the normal
    double least_quality;         ///< no triangle gets worse than the worst before, or than this q
                                  ///< if that is less, at most 1
    double max_volume_change;     ///< improves again, with smaller deviations, around blocks whose
                                  ///< volumes change by more than this percentage, and warns where
                                  ///< that does not help
    double max_triangles;         ///< refuses to begin where more triangles are to be expected
    uint32_t passes;              ///< limits the passes of the four operations, 1 to 100
    uint32_t reserved;            ///< 0
} terrane_improve_options;

/// The changes of an improvement.
typedef struct terrane_improve_report {
    terrane_quality before; ///< of the given mesh
    terrane_quality after;  ///< of the improved mesh
    uint64_t splits;        ///< edges divided
    uint64_t collapses;     ///< edges removed
    uint64_t swaps;         ///< edges exchanged for the other diagonal
    uint64_t moves;         ///< vertices moved, each time counted
    uint64_t held_blocks;   ///< blocks around which bounds were reduced for their volumes
    uint32_t attempts;      ///< times that the mesh was improved from the start
    uint32_t passes;        ///< rounds of the four operations
    int32_t sides_kept;     ///< 1: each part of a surface has the same blocks on its sides as
                            ///< before, exactly
    int32_t reserved;       ///< 0
} terrane_improve_report;

/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_improve_options_init(terrane_improve_options* options,
                                                      size_t struct_size);

/// Makes a mesh of surfaces as they are: nothing is merged. Free it with terrane_mesh_free. Errors:
/// BAD_ARGUMENT, UNSUPPORTED (indices beyond 32 bits), OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_mesh_from_surfaces(const terrane_surfaces* surfaces,
                                                    terrane_mesh** out, terrane_error** error);
/// Makes a list of the surfaces of a mesh. A triangle of several surfaces is in each. Free it with
/// terrane_surfaces_free. Errors: BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_mesh_to_surfaces(const terrane_mesh* mesh, terrane_surfaces** out,
                                                  terrane_error** error);
/// Proves by exact predicates that a mesh is conforming, and returns it with its proof. Errors:
/// IMPROPER_CONTACT with the first place where it is not; INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_mesh_prove(const terrane_mesh* mesh, const terrane_run* run,
                                            terrane_mesh** out, terrane_error** error);
/// Frees a mesh. Handles that were made of it stay valid.
TERRANE_API void terrane_mesh_free(terrane_mesh* mesh);
/// Returns 1 if the mesh is proven conforming: two triangles share a vertex, an edge, or nothing.
TERRANE_API int terrane_mesh_is_conforming(const terrane_mesh* mesh);
/// Returns the number of surfaces.
TERRANE_API size_t terrane_mesh_surface_count(const terrane_mesh* mesh);
/// Returns the name of a surface.
TERRANE_API const char* terrane_mesh_surface_name(const terrane_mesh* mesh, size_t surface);
/// Returns the role of a surface.
TERRANE_API terrane_role terrane_mesh_surface_role(const terrane_mesh* mesh, size_t surface);
/// Returns the vertices, 3 numbers each.
TERRANE_API const double* terrane_mesh_vertices(const terrane_mesh* mesh, size_t* vertex_count);
/// Returns the triangles, 3 indices of vertices each.
TERRANE_API const uint32_t* terrane_mesh_triangles(const terrane_mesh* mesh,
                                                   size_t* triangle_count);
/// Gives, per triangle, its surfaces, ascending, at least one. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_mesh_surfaces(const terrane_mesh* mesh, terrane_lists* lists);
/// Gives, per triangle, its region in each of its surfaces; no lists where regions are not known.
/// Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_mesh_regions(const terrane_mesh* mesh, terrane_lists* lists);
/// Gives, per triangle, the input triangles that contain it; no lists where they are not known.
/// Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_mesh_parents(const terrane_mesh* mesh, terrane_lists* lists);
/// Returns the edges along which surfaces meet, 2 vertices each, sorted: `count` edges.
TERRANE_API const uint32_t* terrane_mesh_intersection_edges(const terrane_mesh* mesh,
                                                            size_t* count);
/// Copies the report of rounding; all is 0 in a mesh that was not rounded. `struct_size` is
/// sizeof(terrane_rounding_report). Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_mesh_get_rounding(const terrane_mesh* mesh,
                                                   terrane_rounding_report* report,
                                                   size_t struct_size);
/// Returns the pairs of triangles of a rounded mesh that still meet improperly; if they are more
/// than 100 000, there may be more.
TERRANE_API const terrane_contact* terrane_mesh_contacts(const terrane_mesh* mesh, size_t* count);
/// Writes a mesh to a file whose extension, or options->format, selects the format. If it fails, no
/// file is written. Errors: those of writing.
TERRANE_API terrane_code terrane_mesh_write(const terrane_mesh* mesh, const char* path,
                                            const terrane_write_options* options,
                                            terrane_error** error);

/// Finds the regions into which intersection edges divide each surface. Free them with
/// terrane_regions_free. Errors: BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_find_regions(const terrane_mesh* mesh, const terrane_run* run,
                                              terrane_regions** out, terrane_error** error);
/// Frees regions.
TERRANE_API void terrane_regions_free(terrane_regions* regions);
/// Returns the regions, by surface, then by lowest triangle.
TERRANE_API const terrane_region* terrane_regions_array(const terrane_regions* regions,
                                                        size_t* count);
/// Gives, per region, the regions of any surface that share an intersection edge with it. Errors:
/// BAD_ARGUMENT.
TERRANE_API terrane_code terrane_regions_neighbours(const terrane_regions* regions,
                                                    terrane_lists* lists);
/// Gives, per triangle, its region in each of its surfaces. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_regions_of_triangles(const terrane_regions* regions,
                                                      terrane_lists* lists);

/// Measures the quality of all triangles; `struct_size` is sizeof(terrane_quality). Errors:
/// BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_measure_quality(const terrane_mesh* mesh, const terrane_run* run,
                                                 terrane_quality* quality, size_t struct_size,
                                                 terrane_error** error);
/// Improves the triangles of a conforming mesh: better shapes or other sizes, within a proven
/// distance of the original surfaces. A mesh without proof is proven first. Free the result with
/// terrane_improved_free. Errors: IMPROPER_CONTACT, BAD_OPTION, NOTHING_TO_DO, INTERRUPTED,
/// OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_improve(const terrane_mesh* mesh,
                                         const terrane_improve_options* options,
                                         const terrane_run* run, terrane_improved** out,
                                         terrane_error** error);
/// Frees an improved mesh.
TERRANE_API void terrane_improved_free(terrane_improved* improved);
/// Returns the improved mesh, a part of the handle.
TERRANE_API const terrane_mesh* terrane_improved_mesh(const terrane_improved* improved);
/// Copies the report; `struct_size` is sizeof(terrane_improve_report). Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_improved_get_report(const terrane_improved* improved,
                                                     terrane_improve_report* report,
                                                     size_t struct_size);
/// Returns, per surface, an upper bound of its distance from the original surface, proven, in the
/// unit of the mesh.
TERRANE_API const double* terrane_improved_bounds(const terrane_improved* improved,
                                                  size_t* surface_count);

#ifdef __cplusplus
}
#endif
