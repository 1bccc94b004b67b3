// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Simplifies a conforming mesh to a resolution: joins places that are smaller than it, or nearer, as
// a modeller would do it before meshing. Experimental: which of them are joined may change.
//
// It looks for corners nearer than the resolution, short curves, narrow strips between curves, thin
// gaps between surfaces and sharp wedges, and zips them: both sides become one triangle of several
// surfaces. It does not guarantee to find or join any place; see the limits in
// docs/explanation/resolution.md.
//
// Guarantees, each of which is checked at the end:
// (1) The result is an arrangement, and a mesh of doubles that an exact check has shown to be
//     conforming (rounding.hpp).
// (2) No point of a surface is farther than max_move from where the surface was, and no point
//     where it was is farther than that from it, apart from rounding errors of distances. This is
//     shown for all of each triangle, by code that shares nothing with the moves; where it
//     can't be shown, there is an error and no result. Surfaces of which nothing is left do not
//     count; they are listed.
// (3) Each block of the result is matched with the block before, or the outside, that most of it
//     was, by the areas around it; where that can't be told, there is an error and no result. The
//     report lists all blocks of which nothing is left or that are several now, and pairs of blocks
//     and of surfaces that touch only before or only after.
// (4) The report lists each block whose mean thickness, twice its volume by the area around it, was
//     less than the resolution and of which something is left.
// Not checked at the end: vertices in planes of the boundary that are parallel to two axes move only
// along these, apart from rounding errors; other vertices of the boundary are not moved. The number
// of threads is not meant to change the result.
// Cost: that of some arrangements, and of a box search per pass over what changed. Source:
// docs/explanation/resolution.md, which says how it differs from Pellerin et al. (2014) and Anquez
// et al. (2019).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane {

/// Options of simplify(). Lengths are in the unit of the mesh.
struct SimplifyOptions {
    double resolution = 0;      ///< places that are nearer are joined, if they can be; > 0
    double max_move = 0;        ///< no surface goes farther than this; 0: resolution
    double edge_length = 0;     ///< of the triangles that are made first; 0: six resolutions
    bool dissolve = false;      ///< blocks thinner than the resolution, on average, may go
    RoundingOptions rounding{}; ///< of each arrangement
};

/// The resolution of a model.
struct Resolution {
    double length = 0;     ///< see describe(), in the unit of the mesh
    bool dissolve = false; ///< see SimplifyOptions

    /// Describes the options of improvement at a resolution, see Field.
    static void describe(const auto& visit, auto& o) {
        visit(
            Field("resolution", "R",
                  "Experimental. Joins places that are nearer than this first, where it can: "
                  "corners, short curves, narrow strips, thin gaps, sharp wedges. No surface moves "
                  "by more, both steps together",
                  "nothing is joined", {}, true),
            o.length);
        visit(Field("dissolve", "", "Lets blocks go that are thinner than `resolution` on average",
                    "those that stay are listed", {}, true),
              o.dissolve);
    }
};

/// Why a near place was left alone.
enum class LeftReason : std::uint8_t {
    move,     ///< a vertex would have moved by more than max_move
    boundary, ///< a vertex would have left the boundary of the volume of interest
    fold,     ///< a triangle would have turned over
    block,    ///< a block that would have changed is left alone there
    limit,    ///< the number of passes is limited
};

/// Names the reason as reports print it: "would move too far", ...
std::string_view name_of(LeftReason reason);

/// Two places that are nearer than the resolution and were left alone, as the last search found
/// them.
struct LeftAlone {
    LeftReason reason = LeftReason::move; ///< the first that applies
    Point3 place{};                       ///< one of them
    double distance = 0;                  ///< of the other one
};

/// A block that would vanish, fall into several, or become one with another.
struct ChangedBlock {
    std::uint32_t block = 0; ///< number by find_volumes(mesh) of the given mesh; 0: the outside
    double volume = 0;       ///< before, after the triangles were made regular; 0 of the outside
    std::size_t parts = 0;   ///< number of blocks that it became; 0: it vanished
    std::uint32_t into = 0;  ///< block before that it is one with now; itself: with none
};

/// Two blocks, or two surfaces, that touch each other before or after only.
struct ChangedContact {
    std::array<std::uint32_t, 2> between{}; ///< ascending
    bool is_new = false;                    ///< they touch now, and did not before
};

/// The changes of a simplification.
struct SimplifyReport {
    double resolution = 0;              ///< as asked for
    double max_move = 0;                ///< limit of all movements
    std::size_t corners = 0;            ///< joins of two corners
    std::size_t curves = 0;             ///< joins of places of two curves
    std::size_t sheets = 0;             ///< joins of other places of surfaces
    std::size_t divided = 0;            ///< edges divided where surfaces are near
    unsigned rounds = 0;                ///< arrangements of moved surfaces
    unsigned attempts = 0;              ///< attempts, see `kept`
    std::vector<LeftAlone> left{};      ///< found near by the last search, by distance
    std::vector<std::uint32_t> kept{};  ///< blocks before that were thinner than the resolution
                                        ///< and are there still, and those that were left alone
                                        ///< since joining changed them; 0: the outside
    std::vector<ChangedBlock> blocks{}; ///< that did not stay one and the same, by number
    std::vector<ChangedContact> block_contacts{};   ///< by numbers before; 0: the outside
    std::vector<ChangedContact> surface_contacts{}; ///< pairs that have an edge in common
    std::vector<std::uint32_t> vanished{};          ///< surfaces that vanished
    std::vector<Deviation> deviations{};            ///< per surface, measured, both ways
    bool is_shown = false; ///< guarantee (2) is shown for all surfaces that did not vanish
};

/// A simplified mesh.
struct Simplified {
    std::vector<Surface> surfaces{}; ///< the moved surfaces, in the order of the mesh
    Arrangement exact{};             ///< of these
    RoundedMesh rounded{};           ///< in doubles; conforming
    std::vector<std::uint32_t>
        block_before{};      ///< per volume of the mesh: the volume before that most of it was,
                             ///< or UINT32_MAX
    SimplifyReport report{}; ///< joined places, those left alone, and changes
};

/// Simplifies the mesh. Errors: bad_option (the resolution is not positive, not finite, or larger
/// than the model; or guarantee (2) or (3) is not shown for this resolution); nothing_to_do (there is
/// no triangle); improper_contact (no doubles within the allowed distance are a conforming mesh);
/// those of arrange, round_to_doubles, find_volumes; interrupted, out_of_memory.
/// Times: simplify, with the steps glue, arrange, round, volumes and measure.
Result<Simplified> simplify(const ConformingMesh& mesh, const SimplifyOptions& options,
                            const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> simplify_constants();

} // namespace terrane
