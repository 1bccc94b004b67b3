// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces: from arrays and files, closed boundaries, and the exact check of any triangles.
#pragma once

#include <terrane/capi/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A list of triangulated surfaces, numbered from 0.
typedef struct terrane_surfaces terrane_surfaces;
/// The findings of terrane_check.
typedef struct terrane_check_report terrane_check_report;

/// The geological role of a surface. It does not influence the geometry of an arrangement.
typedef int32_t terrane_role;
enum {
    TERRANE_ROLE_UNKNOWN = 0, ///< not stated
    TERRANE_ROLE_HORIZON = 1, ///< a horizon
    TERRANE_ROLE_FAULT = 2,   ///< a fault
    TERRANE_ROLE_BOUNDARY = 3 ///< a part of the boundary of a volume of interest
};

/// How files are read.
typedef struct terrane_read_options {
    size_t struct_size; ///< sizeof(terrane_read_options)
    const char* format; ///< "ts", "obj", ...; NULL: by the extension
    int32_t depth;      ///< not 0: values of grids and points are depths, positive down
    int32_t reserved;   ///< 0
    double max_edge;    ///< points: longest edge, in their unit; 0: twice the median edge
    const char* unit;   ///< unit to which coordinates with a stated unit are converted: "m", "km",
                        ///< "ft", "ftUS", "cm"; NULL: they stay
    const char*
        columns; ///< columns of numbers: those of x, y and z, by number from 1 or by name: "3,4,5"; NULL: as
                 ///< the heading calls them
} terrane_read_options;

/// How files are written.
typedef struct terrane_write_options {
    size_t struct_size; ///< sizeof(terrane_write_options)
    const char* format; ///< "vtp", "obj", ...; NULL: by the extension
    int32_t ascii;      ///< STL: text, where not 0
    int32_t compress;   ///< VTP and VTU: zlib, where not 0; default 1
} terrane_write_options;

/// A box in any direction. Lengths are in the unit of the surfaces, angles in degrees.
typedef struct terrane_rotated_box {
    double place[3];   ///< its centre, or a corner
    double lengths[3]; ///< of its edges, > 0: across, along, up
    double azimuth;    ///< of the edges along: clockwise from y (north)
    double plunge;     ///< of the edges along: downwards
    double roll;       ///< about the edges along: at 90, the edges across point down instead of
                       ///< right
    int32_t is_corner; ///< not 0: place is the corner that is lowest on all three edges
    int32_t reserved;  ///< 0
} terrane_rotated_box;

/// The counts of a check.
typedef struct terrane_check_summary {
    uint64_t surfaces;          ///< number of surfaces
    uint64_t triangles;         ///< number of triangles of all surfaces
    uint64_t vertices;          ///< number of distinct points in use
    uint64_t free_border_edges; ///< edges with one triangle of a surface
    uint64_t components;        ///< components that are connected across edges, whatever the
                                ///< surface
    int32_t is_clean;           ///< 1: no contact, no triangle without area, none repeated in its
                                ///< surface
    int32_t reserved;           ///< 0
} terrane_check_summary;

/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_read_options_init(terrane_read_options* options,
                                                   size_t struct_size);
/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_write_options_init(terrane_write_options* options,
                                                    size_t struct_size);

/// Makes an empty list. Free it with terrane_surfaces_free. Errors: BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_surfaces_new(terrane_surfaces** out, terrane_error** error);
/// Frees a list of surfaces.
TERRANE_API void terrane_surfaces_free(terrane_surfaces* surfaces);
/// Appends a surface from arrays: `vertices` has 3 numbers for each of `vertex_count`, `triangles`
/// 3 indices for each of `triangle_count`. An array may be NULL if its count is 0; `name` may be
/// NULL. Errors: BAD_NUMBER and BAD_INDEX with the vertex or triangle, BAD_ARGUMENT, UNSUPPORTED
/// (indices beyond 32 bits), OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_surfaces_add(terrane_surfaces* surfaces, const char* name,
                                              terrane_role role, const double* vertices,
                                              size_t vertex_count, const uint32_t* triangles,
                                              size_t triangle_count, terrane_error** error);
/// Appends copies of all surfaces of another list. Errors: BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_surfaces_append(terrane_surfaces* surfaces,
                                                 const terrane_surfaces* others,
                                                 terrane_error** error);
/// Appends the surfaces of a file. Errors: those of reading (CANNOT_OPEN, UNKNOWN_FORMAT,
/// BAD_SYNTAX, ...) with "file:line".
TERRANE_API terrane_code terrane_surfaces_read(terrane_surfaces* surfaces, const char* path,
                                               const terrane_read_options* options,
                                               terrane_error** error);
/// Appends the surfaces in the contents of a file of options->format, which must be given; `source`
/// names the file in messages. Errors: those of reading.
TERRANE_API terrane_code terrane_surfaces_parse(terrane_surfaces* surfaces, const void* contents,
                                                size_t size, const char* source,
                                                const terrane_read_options* options,
                                                terrane_error** error);
/// Writes the surfaces as they are: nothing is merged. If it fails, no file is written. Errors:
/// those of writing (CANNOT_OPEN, WRITE_FAILED, UNKNOWN_FORMAT, ...).
TERRANE_API terrane_code terrane_surfaces_write(const terrane_surfaces* surfaces, const char* path,
                                                const terrane_write_options* options,
                                                terrane_error** error);
/// Returns the number of surfaces.
TERRANE_API size_t terrane_surfaces_count(const terrane_surfaces* surfaces);
/// Returns the name of a surface; it need not be unique.
TERRANE_API const char* terrane_surfaces_name(const terrane_surfaces* surfaces, size_t surface);
/// Returns the role of a surface.
TERRANE_API terrane_role terrane_surfaces_role(const terrane_surfaces* surfaces, size_t surface);
/// Changes the name and role of a surface. Errors: BAD_ARGUMENT, BAD_INDEX, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_surfaces_label(terrane_surfaces* surfaces, size_t surface,
                                                const char* name, terrane_role role,
                                                terrane_error** error);
/// Returns the vertices of a surface, 3 numbers each, in the order of the input.
TERRANE_API const double* terrane_surfaces_vertices(const terrane_surfaces* surfaces,
                                                    size_t surface, size_t* vertex_count);
/// Returns the triangles of a surface, 3 indices of its vertices each, in the order of the input.
TERRANE_API const uint32_t* terrane_surfaces_triangles(const terrane_surfaces* surfaces,
                                                       size_t surface, size_t* triangle_count);

/// Returns likely mistakes in surfaces, of which the program warns, as JSON text: an array of
/// objects with the keys of `warnings` in docs/reference/statistics.md. `blocks`: not 0 if closed
/// blocks are wanted without a volume of interest. Free it with terrane_text_free. Errors:
/// BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_surfaces_doubts(const terrane_surfaces* surfaces, int32_t blocks,
                                                 char** text, terrane_error** error);

/// Makes an axis-parallel box from its least and largest coordinates: six surfaces, "boundary top",
/// "boundary bottom", "boundary side 1", ..., with the role boundary. Free them with
/// terrane_surfaces_free. Errors: BAD_OPTION (low is not below high), BAD_NUMBER.
TERRANE_API terrane_code terrane_box_boundary(const double low[3], const double high[3],
                                              terrane_surfaces** out, terrane_error** error);
/// Makes a rotated box likewise. Errors: BAD_OPTION (a length is not positive), BAD_NUMBER,
/// IMPROPER_CONTACT.
TERRANE_API terrane_code terrane_rotated_box_boundary(const terrane_rotated_box* box,
                                                      terrane_surfaces** out,
                                                      terrane_error** error);
/// Makes the prism of a simple polygon between two depths in either order; `corners` has x and y
/// for each. Errors: BAD_OPTION, BAD_NUMBER, IMPROPER_CONTACT (the polygon crosses itself).
TERRANE_API terrane_code terrane_polygon_boundary(const double* corners, size_t corner_count,
                                                  double low, double high, terrane_surfaces** out,
                                                  terrane_error** error);
/// Checks that surfaces are closed together, and returns copies with the role boundary. Errors:
/// NOT_CLOSED, IMPROPER_CONTACT, NOTHING_TO_DO, BAD_NUMBER, BAD_INDEX.
TERRANE_API terrane_code terrane_closed_boundary(const terrane_surfaces* surfaces,
                                                 const terrane_run* run, terrane_surfaces** out,
                                                 terrane_error** error);

/// Checks triangles exactly and lists all that is wrong; they are numbered through all surfaces.
/// Free the report with terrane_check_free. Errors: INTERRUPTED, OUT_OF_MEMORY, UNSUPPORTED.
TERRANE_API terrane_code terrane_check(const terrane_surfaces* surfaces, const terrane_run* run,
                                       terrane_check_report** out, terrane_error** error);
/// Frees a report.
TERRANE_API void terrane_check_free(terrane_check_report* report);
/// Copies the counts of a report; `struct_size` is sizeof(terrane_check_summary). Errors:
/// BAD_ARGUMENT.
TERRANE_API terrane_code terrane_check_get_summary(const terrane_check_report* report,
                                                   terrane_check_summary* summary,
                                                   size_t struct_size);
/// Returns the pairs of distinct triangles with area that meet improperly, sorted.
TERRANE_API const terrane_contact* terrane_check_contacts(const terrane_check_report* report,
                                                          size_t* count);
/// Returns the triangles without area, ascending.
TERRANE_API const uint32_t* terrane_check_degenerate(const terrane_check_report* report,
                                                     size_t* count);
/// Returns pairs of a triangle and the first one of its surface with the same points: `count`
/// pairs.
TERRANE_API const uint32_t* terrane_check_repeated(const terrane_check_report* report,
                                                   size_t* count);
/// Returns such pairs in different surfaces, which are no flaw: `count` pairs.
TERRANE_API const uint32_t* terrane_check_shared(const terrane_check_report* report, size_t* count);
/// Returns the two ends, 6 numbers, of each edge with more than two triangles of one surface:
/// `count` edges.
TERRANE_API const double* terrane_check_non_manifold_edges(const terrane_check_report* report,
                                                           size_t* count);

#ifdef __cplusplus
}
#endif
