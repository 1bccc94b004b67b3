// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Holes of surfaces and their fillings; stacks of hard and soft horizons.
#pragma once

#include <terrane/capi/base.h>
#include <terrane/capi/mesh.h>
#include <terrane/capi/surfaces.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The holes of surfaces, and the surfaces with those filled that were to be.
typedef struct terrane_holes terrane_holes;
/// A stack of horizons.
typedef struct terrane_layered terrane_layered;

/// How the holes of one surface are filled. Lengths in the unit of the surface.
/// terrane_fill_task_init gives defaults.
typedef struct terrane_fill_task {
    size_t struct_size;    ///< sizeof(terrane_fill_task); the same in all tasks of a call
    uint32_t surface;      ///< number of the surface; no two tasks have the same
    int32_t use_rbf;       ///< 0: kriging, for z = f(x, y); not 0: radial basis functions, for any
                           ///< surface
    const char* variogram; ///< model of kriging: "spherical", ...; NULL or "auto": all but
                           ///< spherical count
    double max_area;       ///< larger holes stay open; squared unit; default: infinite
    double mesh_size;      ///< edge length of the filling; 0: the median edge of the hole's border
    double gap_slope;      ///< throw / width from which a hole counts as a fault gap
    double smoothing;      ///< radial basis functions: root mean square misfit to the data; NaN:
                           ///< none; 0: automatic
    uint32_t rings;        ///< least number of rings of data of kriging
    int32_t is_isotropic;  ///< not 0: the variogram is the same in all directions
    int32_t bridge_faults; ///< not 0: fault gaps are filled, too
    int32_t reserved;      ///< 0
} terrane_fill_task;

/// A hole. Lengths are in the unit of the surface.
typedef struct terrane_hole {
    uint32_t surface;       ///< number of the surface
    int32_t is_fault_gap;   ///< 1: its sides have a throw, as a fault tears it
    int32_t is_filled;      ///< 1: it was filled
    int32_t reserved;       ///< 0
    double length;          ///< of its border
    double area;            ///< of the largest projection of its border to a plane
    double centre[3];       ///< mean of its edges
    double fault_throw;     ///< median distance between the extrapolated sides
    double width;           ///< median distance between opposite sides
    double filled_area;     ///< of the new triangles; 0: not filled
    double expected_error;  ///< root mean square over the new vertices; NaN: not known
    double validated_error; ///< root mean square at data that were left out; NaN: not known
} terrane_hole;

/// A horizon of a stack. Of two horizons of equal hardness, the upper one counts as harder.
typedef struct terrane_layer {
    uint32_t surface; ///< number of the surface
    int32_t reserved; ///< 0
    double hardness;  ///< no unit; larger is harder; finite
} terrane_layer;

/// Options of terrane_stack_layers.
typedef struct terrane_layer_options {
    size_t struct_size;   ///< sizeof(terrane_layer_options)
    double min_thickness; ///< of each layer, along z, unit of the surfaces; >= 0
    double max_move;      ///< as in terrane_round_options
    uint32_t max_rounds;  ///< of snapping; default 8
    uint32_t reserved;    ///< 0
} terrane_layer_options;

/// The effect of stacking on one horizon. Areas are true areas, in squared units.
typedef struct terrane_layer_report {
    uint32_t surface;    ///< number of the surface
    uint32_t reserved;   ///< 0
    uint64_t dropped;    ///< triangles of the arrangement that it lost
    uint64_t taken;      ///< triangles of harder horizons that it got instead
    double dropped_area; ///< of `dropped`
    double taken_area;   ///< of `taken`
    double largest_move; ///< along z, to the harder horizon
    double step_length;  ///< length of borders where a harder horizon ends
} terrane_layer_report;

/// Gives a task the defaults and this surface. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_fill_task_init(terrane_fill_task* task, size_t struct_size,
                                                uint32_t surface);
/// Gives options their defaults. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_layer_options_init(terrane_layer_options* options,
                                                    size_t struct_size);

/// Finds the holes of the surfaces that tasks name, and fills none. Free them with
/// terrane_holes_free. Errors: BAD_INDEX, BAD_OPTION (a surface twice, an unknown variogram),
/// INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_find_holes(const terrane_surfaces* surfaces,
                                            const terrane_fill_task* tasks, size_t task_count,
                                            const terrane_run* run, terrane_holes** out,
                                            terrane_error** error);
/// Finds the holes, fills those that the tasks want filled, and checks the new triangles exactly. A
/// hole that can't be filled stays open; terrane_holes_refusal says why. Errors: as
/// terrane_find_holes; IMPROPER_CONTACT where new triangles meet others of their surface
/// improperly.
TERRANE_API terrane_code terrane_fill(const terrane_surfaces* surfaces,
                                      const terrane_fill_task* tasks, size_t task_count,
                                      const terrane_run* run, terrane_holes** out,
                                      terrane_error** error);
/// Frees holes and the surfaces that they are part of.
TERRANE_API void terrane_holes_free(terrane_holes* holes);
/// Returns the holes, by task, then by decreasing area.
TERRANE_API const terrane_hole* terrane_holes_array(const terrane_holes* holes, size_t* count);
/// Gives, per hole, the vertices of its border in order, of the surface as given. Errors:
/// BAD_ARGUMENT.
TERRANE_API terrane_code terrane_holes_borders(const terrane_holes* holes, terrane_lists* lists);
/// Returns why a hole was not filled, or "".
TERRANE_API const char* terrane_holes_refusal(const terrane_holes* holes, size_t hole);
/// Returns the model that filled a hole and its parameters, in a sentence, or "".
TERRANE_API const char* terrane_holes_model(const terrane_holes* holes, size_t hole);
/// Returns the surfaces with their fillings, one per task: what was given, then what is new; a part
/// of the handle.
TERRANE_API const terrane_surfaces* terrane_holes_surfaces(const terrane_holes* holes);
/// Returns, per vertex of the surface of a task, its expected error: 0 for given ones, NaN where it
/// is not known.
TERRANE_API const double* terrane_holes_expected_errors(const terrane_holes* holes, size_t task,
                                                        size_t* vertex_count);
/// Returns, per triangle of the surface of a task, the number of the hole that it fills, from 1; 0:
/// it was given.
TERRANE_API const int32_t* terrane_holes_of_triangles(const terrane_holes* holes, size_t task,
                                                      size_t* triangle_count);

/// Stacks horizons, given from the top down: where a soft one is on the wrong side of a harder one,
/// it is replaced by triangles of the harder one. Ask terrane_layered_is_stack before the result is
/// used. Free it with terrane_layered_free. Errors: BAD_OPTION, BAD_INDEX, NOTHING_TO_DO,
/// UNSUPPORTED (a horizon that is no graph), INTERRUPTED, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_stack_layers(const terrane_surfaces* surfaces,
                                              const terrane_layer* layers, size_t layer_count,
                                              const terrane_layer_options* options,
                                              const terrane_run* run, terrane_layered** out,
                                              terrane_error** error);
/// Frees a stack.
TERRANE_API void terrane_layered_free(terrane_layered* layered);
/// Returns 1 if the doubles are a conforming mesh of layers in their order, by exact checks.
TERRANE_API int terrane_layered_is_stack(const terrane_layered* layered);
/// Returns the mesh, whose surfaces are the layers from the top down; a part of the handle.
TERRANE_API const terrane_mesh* terrane_layered_mesh(const terrane_layered* layered);
/// Returns the effect on each layer, from the top down.
TERRANE_API const terrane_layer_report* terrane_layered_reports(const terrane_layered* layered,
                                                                size_t* count);
/// Returns the width of the strips along steps over which the order is not claimed, in the unit of
/// the surfaces.
TERRANE_API double terrane_layered_step_width(const terrane_layered* layered);

#ifdef __cplusplus
}
#endif
