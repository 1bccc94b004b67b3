// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Simplifies a conforming mesh to a resolution: what is smaller than it, or nearer, becomes one, as
// a modeller would do it before meshing.
//
// Corners nearer than the resolution are joined, short curves collapse, narrow strips between
// curves and thin gaps between surfaces are zipped: both sides become one triangle of several
// surfaces. Where two surfaces meet at less than 20 degrees, they become one up to where they are
// the resolution apart. Parts of one smooth surface are never joined for being near along it.
//
// Guarantees:
// (1) The result is an arrangement, and a mesh of doubles that an exact check has shown to be
//     conforming (rounding.hpp).
// (2) No point of a surface is farther than max_move from where the surface was, and no point
//     where it was is farther than that from it: shown for all of each triangle after the fact, by
//     code that shares nothing with what moved it, apart from rounding errors of distances. Surfaces of which nothing
//     is left are listed.
// (3) Planes of the boundary of a volume of interest that are parallel to two axes stay planes, its
//     edges there stay straight and its corners stay: vertices there move only along it. On other parts of the
//     boundary they do not move.
// (4) No block is lost or made and no two become one, unless the report lists it. Blocks thinner
//     than the resolution are left as they are with all around them, or zipped where asked for.
// (5) What is nearer than the resolution still is listed, with the reason.
// (6) The result depends neither on the number of threads nor on the order of vertices and
//     triangles.
// Cost: that of some arrangements, and of a box search per pass over what changed; near surfaces
// have triangles of about twice the resolution then. Source: docs/explanation/resolution.md, which says
// how it differs from Pellerin et al. (2014) and Anquez et al. (2019).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/conforming.hpp>
#include <terrane/algorithms/core/named_constant.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/quality/deviation.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane {

/// Options of simplify(). Lengths are in the unit of the mesh.
struct SimplifyOptions {
    double resolution = 0;      ///< what is nearer becomes one; > 0
    double max_move = 0;        ///< no surface goes farther than this; 0: resolution
    double edge_length = 0;     ///< of the triangles that are made first; 0: six resolutions
    bool dissolve = false;      ///< blocks thinner than the resolution are zipped
    RoundingOptions rounding{}; ///< of each arrangement
};

/// Why what is near was left alone.
enum class LeftReason : std::uint8_t {
    move,     ///< a vertex would have moved by more than max_move
    boundary, ///< a vertex would have left the boundary of the volume of interest
    fold,     ///< a triangle would have turned over
    block,    ///< a block, which is thinner than the resolution, would have changed
    limit,    ///< the number of passes is limited
};

/// Names the reason as reports print it: "would move too far", ...
std::string_view name_of(LeftReason reason);

/// Two places that are nearer than the resolution and were left alone.
struct LeftAlone {
    LeftReason reason = LeftReason::move; ///< the first that applies
    Point3 place{};                       ///< one of them
    double distance = 0;                  ///< of the other one
};

/// A block of which nothing would be left, or that would become several, or one with another.
struct ChangedBlock {
    std::uint32_t block = 0; ///< number by find_volumes(mesh) before
    double volume = 0;       ///< before, cubic unit
    std::size_t parts = 0;   ///< blocks that it is now; 0: it is gone
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
    std::size_t corners = 0;            ///< times that two corners were joined
    std::size_t curves = 0;             ///< that places of two curves were
    std::size_t sheets = 0;             ///< that other places of surfaces were
    std::size_t divided = 0;            ///< edges divided where surfaces are near
    unsigned rounds = 0;                ///< arrangements of moved surfaces
    unsigned attempts = 0;              ///< times that it began, see `kept`
    std::vector<LeftAlone> left{};      ///< what is near still, by distance
    std::vector<std::uint32_t> kept{};  ///< blocks before, thinner than the resolution or narrow
                                        ///< in between, that were left alone
    std::vector<ChangedBlock> blocks{}; ///< that did not stay one and the same, by number
    std::vector<ChangedContact> block_contacts{};   ///< by numbers before; 0: the outside
    std::vector<ChangedContact> surface_contacts{}; ///< pairs that have an edge in common
    std::vector<std::uint32_t> vanished{};          ///< surfaces of which nothing is left
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
    SimplifyReport report{}; ///< what was joined, left alone, and changed
};

/// Simplifies the mesh. Errors: bad_option (the resolution is not positive, not finite, or larger
/// than the model); nothing_to_do (there is no triangle); improper_contact (no doubles within the allowed distance are a
/// conforming mesh); those of arrange, round_to_doubles, find_volumes; interrupted, out_of_memory.
/// Times: simplify, with the steps glue, arrange, round, volumes and measure.
Result<Simplified> simplify(const ConformingMesh& mesh, const SimplifyOptions& options,
                            const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> simplify_constants();

} // namespace terrane
