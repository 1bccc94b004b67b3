// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The boundary representation of a model: corners, lines, patches, interfaces and blocks.
#pragma once

#include <terrane/capi/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The boundary representation of a model. terrane_build_structure and terrane_make_model make it.
typedef struct terrane_structure terrane_structure;

/// A chain of edges at which patches meet or end.
typedef struct terrane_model_line {
    int32_t kind;        ///< see terrane_line_kind_name
    uint32_t corners[2]; ///< at its ends; TERRANE_NONE: closed without corner
    int32_t reserved;    ///< 0
    double length;       ///< unit of the mesh
} terrane_model_line;

/// A connected part of an interface.
typedef struct terrane_model_patch {
    uint32_t interface_number; ///< the interface that it is part of
    int32_t reserved;          ///< 0
    double area;               ///< squared unit
} terrane_model_patch;

/// The triangles between the same two volumes that belong to the same surfaces.
typedef struct terrane_model_interface {
    uint32_t volumes[2]; ///< on its sides, the lower first; equal: it dangles
    double area;         ///< squared unit
} terrane_model_interface;

/// A block; [0] is the outside.
typedef struct terrane_model_block {
    double volume; ///< cubic unit: the exact volume of the mesh, rounded to a double; outside: 0
    double area;   ///< of its boundary, squared unit
    double age;    ///< of the base of its unit, as in the column; NaN: none
} terrane_model_block;

/// The lists of a structure, by what there is one list for, and what it holds. All are ascending,
/// except for TERRANE_LINE_VERTICES.
typedef int32_t terrane_structure_list;
enum {
    TERRANE_CORNER_LINES = 0,            ///< per corner: lines that end there; twice if both ends
                                         ///< do
    TERRANE_LINE_VERTICES = 1,           ///< per line: its vertices in order; first = last: closed
    TERRANE_LINE_PATCHES = 2,            ///< per line: patches that meet there
    TERRANE_LINE_SURFACES = 3,           ///< per line: surfaces of the triangles that meet there
    TERRANE_PATCH_TRIANGLES = 4,         ///< per patch: its triangles
    TERRANE_PATCH_LINES = 5,             ///< per patch: lines around it and within it
    TERRANE_INTERFACE_SURFACES = 6,      ///< per interface: surfaces of its triangles
    TERRANE_INTERFACE_PATCHES = 7,       ///< per interface: its patches
    TERRANE_INTERFACE_TRIANGLES = 8,     ///< per interface: its triangles
    TERRANE_BLOCK_SURFACES_ABOVE = 9,    ///< per block: surfaces above it
    TERRANE_BLOCK_SURFACES_BELOW = 10,   ///< per block: surfaces below it
    TERRANE_BLOCK_SURFACES_BESIDE = 11,  ///< per block: surfaces beside it
    TERRANE_BLOCK_INTERFACES = 12,       ///< per block: interfaces around it, without dangling ones
    TERRANE_BLOCK_INNER_INTERFACES = 13, ///< per block: interfaces that dangle in it
    TERRANE_BLOCK_NEIGHBOURS = 14        ///< per block: volumes across its interfaces
};

/// Returns the name of a kind of line: "free border", "boundary line", "cutoff line", "branch
/// line", "intersection curve"; "unknown" for other numbers.
TERRANE_API const char* terrane_line_kind_name(int32_t kind);
/// Frees a structure that terrane_build_structure made.
TERRANE_API void terrane_structure_free(terrane_structure* structure);
/// Returns the vertex of each corner, in lexicographic order of their positions.
TERRANE_API const uint32_t* terrane_structure_corners(const terrane_structure* structure,
                                                      size_t* count);
/// Returns the lines, by their least vertices.
TERRANE_API const terrane_model_line* terrane_structure_lines(const terrane_structure* structure,
                                                              size_t* count);
/// Returns the patches, by their least vertices.
TERRANE_API const terrane_model_patch* terrane_structure_patches(const terrane_structure* structure,
                                                                 size_t* count);
/// Returns the interfaces, by their volumes.
TERRANE_API const terrane_model_interface*
terrane_structure_interfaces(const terrane_structure* structure, size_t* count);
/// Returns the blocks by number, with the outside as the first.
TERRANE_API const terrane_model_block* terrane_structure_blocks(const terrane_structure* structure,
                                                                size_t* count);
/// Returns the name of a block, different for all: "below top, above base, west of F1".
TERRANE_API const char* terrane_structure_block_name(const terrane_structure* structure,
                                                     size_t block);
/// Returns the unit of the stratigraphic column that a block belongs to, or "".
TERRANE_API const char* terrane_structure_block_unit(const terrane_structure* structure,
                                                     size_t block);
/// Gives lists of the structure. Errors: BAD_ARGUMENT, also for a number that is no
/// terrane_structure_list.
TERRANE_API terrane_code terrane_structure_get_lists(const terrane_structure* structure,
                                                     terrane_structure_list which,
                                                     terrane_lists* lists);
/// Returns, per triangle, its patch.
TERRANE_API const uint32_t* terrane_structure_patch_of(const terrane_structure* structure,
                                                       size_t* triangle_count);
/// Returns, per triangle, its interface.
TERRANE_API const uint32_t* terrane_structure_interface_of(const terrane_structure* structure,
                                                           size_t* triangle_count);

#ifdef __cplusplus
}
#endif
