// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Makes a mesh of doubles from surfaces. They are extended to the boundary of a volume of interest,
// sealed, arranged, cut, freed of small blocks and rounded; each of the optional steps happens if
// it is asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>
#include <terrane/algorithms/tolerance/tolerance.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

namespace terrane {

// Merges blocks that are too small to matter with their neighbours. Nearly equal surfaces, and gaps
// that were closed, leave slivers of a few cubic metres between them, which no simulation needs and
// for which every mesher pays.
//
// A block is merged by removing its largest interface: the triangles between it and one neighbour
// that belong to the same surfaces. Nothing else changes: no vertex moves, and no triangle is
// added. The smallest block comes first; merged blocks count as one block from then on. The
// outside is a neighbour only of a block that has no other, and no boundary of the model is removed
// there. Cost: that of find_volumes, and sorting.

/// A block that became part of a neighbour.
struct MergedBlock {
    double volume = 0;         ///< cubic unit of the input
    double thickness = 0;      ///< twice its volume, divided by the area of its boundary; unit
    double into = 0;           ///< volume of the neighbour before; infinite: the outside
    double area = 0;           ///< of the triangles that were removed, squared unit
    std::size_t triangles = 0; ///< that were removed
    std::vector<std::uint32_t> surfaces{}; ///< that these belonged to, ascending
    Point3 place{};                        ///< centre of the first of these
};

/// The blocks that became part of others.
struct BlockMerge {
    double least = 0;                  ///< volume below which blocks were merged, cubic unit
    std::vector<MergedBlock> merged{}; ///< from the smallest on
    std::size_t kept = 0; ///< blocks below `least` that have no neighbour to be merged with
};

/// An arrangement without small blocks.
struct WithoutSmallBlocks {
    Arrangement arrangement; ///< restricted to the triangles that are kept
    BlockMerge report;       ///< the merged blocks
};

/// Merges all blocks whose exact volume is below `least`. Errors: bad_option (`least` is not
/// positive and finite), those of find_volumes.
Result<WithoutSmallBlocks> merge_small_blocks(Arrangement arrangement, double least,
                                              const Run& run = {});

/// Returns the median length of the edges of all triangles; 0 if there are none. Each triangle
/// counts for each of its edges.
double median_edge_length(std::span<const Surface> surfaces);

/// Returns the volume below which a block is certainly dirt: that of a cube whose edges are a tenth
/// of the median edge length. A thin layer that goes on for many triangles is larger.
double small_volume_for(std::span<const Surface> surfaces);

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> small_block_constants();

/// Options of arrange_within().
struct ArrangeWithinOptions {
    ArrangeOptions arrange{};   ///< for every arrangement that is made
    RoundingOptions rounding{}; ///< for the final rounding
    double tolerance = 0; ///< surfaces that are nearer are joined first, see join_within(), and
                          ///< gaps as wide are sealed unless `seal` or its rules say
                          ///< otherwise; unit of the input; 0: none
    double seal = 0;      ///< largest width of gaps to close, unit of the input; 0: none
    bool seal_automatic = false; ///< the distance is chosen by choose_seal(); `seal` is ignored
    double extend = 0;     ///< longest extension of horizons that end inside, unit of the input; 0:
                           ///< none
    double min_volume = 0; ///< smaller blocks are merged with neighbours, cubic unit of the input;
                           ///< 0: none
    std::vector<SealRule> seal_rules{}; ///< exceptions from `seal`, see SealOptions
};

/// The distance for sealing that the widths of gaps suggest.
struct SealChoice {
    double edge_length = 0;         ///< median of the surfaces' edges, unit of the input
    double widest = 0;              ///< gaps above it, a share of edge_length, count as meant
    std::vector<GapBreak> breaks{}; ///< of the gaps in the volume of interest, ascending
    double distance = 0;            ///< of the last break; 0: there is none
    std::vector<SurfaceGap> gaps{}; ///< all that were measured, by width
};

/// The gaps that were closed.
struct SealReport {
    double distance = 0;               ///< the option seal
    std::vector<SealRule> rules{};     ///< the option seal_rules
    std::vector<SealChange> changes{}; ///< see Sealed
    std::vector<ClosedGap> closed{};   ///< see Sealed
    std::vector<OpenGap> open{};       ///< see Sealed
    double left = 0;                   ///< see Sealed
};

/// The simplification to a resolution (resolution.hpp).
struct AtResolution {
    SharedMesh before{};     ///< the rounded mesh before
    SimplifyReport report{}; ///< joined places, those left alone, and changes
};

/// Numbers of triangles of a surface. New ones follow the given ones.
struct SurfaceGrowth {
    std::size_t given = 0;    ///< of the input
    std::size_t extended = 0; ///< given and extended
};

/// The arrangement, its rounded mesh, and the reports of all steps.
struct Arranged {
    std::vector<Surface> surfaces; ///< the input with the triangles by which gaps were closed, then
                                   ///< the boundary
    Arrangement exact;             ///< with a volume of interest: restricted to it
    RoundedMesh rounded;           ///< `exact` in doubles, with its report
    std::optional<ToleranceReport> joined;               ///< with a tolerance
    std::optional<VolumeReport> cut;                     ///< with a volume of interest
    std::optional<SealReport> sealed;                    ///< where asked for
    std::optional<SealChoice> choice;                    ///< with seal_automatic
    std::optional<BlockMerge> merged;                    ///< with min_volume
    std::optional<std::vector<ExtendedBorder>> extended; ///< where asked for
    std::optional<AtResolution> simplified; ///< after simplify_to(): surfaces, exact and rounded
                                            ///< are then the simplified ones
    std::vector<SurfaceGrowth> growth;      ///< per surface of the input; with seal or extend
    std::size_t boundary_count = 0;         ///< of the surfaces; they come last
};

/// Arranges and rounds the surfaces. `boundary` is that of a volume of interest; empty: there is
/// none. Errors: those of join_within, extend_to_boundary, seal, arrange, cut_to_volume, merge_small_blocks and
/// round_to_doubles. A mesh that is not conforming is no error: see rounded.report.
Result<Arranged> arrange_within(std::vector<Surface> surfaces, std::vector<Surface> boundary,
                                const ArrangeWithinOptions& options = {}, const Run& run = {});

/// Does the same without rounding: `rounded` stays empty.
Result<Arranged> arrange_exactly_within(std::vector<Surface> surfaces,
                                        std::vector<Surface> boundary,
                                        const ArrangeWithinOptions& options = {},
                                        const Run& run = {});

/// Finds the breaks in the widths of gaps up to a share of the median edge length, after extension
/// and cut, if they are asked for. Cost: that of arranging. Errors: those of arrange_within.
Result<SealChoice> choose_seal(const std::vector<Surface>& surfaces,
                               const std::vector<Surface>& boundary,
                               const ArrangeWithinOptions& options = {}, const Run& run = {});

/// Does the same by an arrangement that was not sealed; `edge_length` is the median of the edges.
Result<SealChoice> choose_seal(const Arrangement& arrangement, double edge_length,
                               const Run& run = {});

/// Lists the constants that decide the choice.
std::vector<NamedConstant> seal_choice_constants();

// Helps to choose the distance within which gaps are closed: lists the widths of gaps by their natural
// breaks, and tries each break.

/// The model that results from one distance.
struct SealTrial {
    double distance = 0;       ///< 0: nothing is sealed
    std::size_t blocks = 0;    ///< that the exact surfaces enclose
    std::size_t small = 0;     ///< of them, below `small_volume`
    std::size_t changes = 0;   ///< parts of borders that were extended or trimmed
    std::size_t triangles = 0; ///< added and removed
    double length = 0;         ///< of the borders that changed, unit of the input
    double left = 0;           ///< of free borders that are as near to another surface still
};

/// The breaks in the widths of gaps, and the models that result from closing them.
struct SealAdvice {
    SealChoice choice;               ///< the breaks, and the distance that is chosen among them
    double small_volume = 0;         ///< see small_volume_for()
    std::vector<SealTrial> trials{}; ///< without sealing first, then for each break
};

/// Finds the breaks and tries each of them; `options.seal` is ignored, but rules hold. The cost is that of
/// arrange_within() for each trial, without rounding. Errors: those of arrange_within.
Result<SealAdvice> advise_seal(const std::vector<Surface>& surfaces,
                               const std::vector<Surface>& boundary,
                               const ArrangeWithinOptions& options = {}, const Run& run = {});

} // namespace terrane
