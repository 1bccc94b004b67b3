// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A model consists of a conforming mesh, its blocks and its structure. Blocks have the numbers of
// the exact arrangement, so that rounding, which may lose thin blocks, changes no number: every
// stage and every file uses the same number for a block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/structure/block_names.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// A mesh with its blocks.
struct Model {
    ConformingMesh mesh;                 ///< rounded, and improved if that was asked for
    std::vector<double> exact_volumes{}; ///< per block by number, in cubic units: the double
                                         ///< nearest to its volume in the arrangement; [0] is
                                         ///< infinite: the outside has no end
    double total_volume = 0;             ///< of all blocks together, likewise
    Volumes volumes{}; ///< of the mesh, by the numbers of the exact blocks. A block too thin for
                       ///< doubles has no triangle; blocks that rounding made come last
    std::vector<std::uint32_t> number_of{}; ///< per volume as find_volumes(mesh) counts: its number
    Structure structure{};                  ///< by the same numbers
    std::vector<FreeBorder> borders{};      ///< where surfaces end
    std::size_t lost = 0;                   ///< exact blocks that the mesh lacks
    std::size_t made = 0;                   ///< blocks of the mesh that match no exact one

    /// Returns the number of exact blocks, without the outside.
    [[nodiscard]] std::size_t block_count() const { return exact_volumes.size() - 1; }
};

/// The names of blocks that people gave.
struct BlockNaming {
    StratigraphicColumn column{};      ///< empty: none
    std::vector<StatedBlock> stated{}; ///< that files state, by the surfaces of the arrangement
};

/// Finds the volumes of the arrangement and of its rounded mesh, matches them, builds the structure
/// and names the blocks. Precondition: `rounded` was made from `exact`. Cost: that of find_volumes, twice, and
/// of sorting. Errors: those of find_volumes, interrupted.
Result<Model> make_model(const Arrangement& exact, const ConformingMesh& rounded,
                         const Run& run = {}, const BlockNaming& naming = {});

/// Makes the model of an improved mesh. Precondition: `exact` was rounded, and the result improved.
/// Blocks keep the numbers of the exact ones; exact_volumes are those of the improved mesh, except
/// for blocks that rounding lost. If report.sides_kept is false, blocks can't be matched: they have
/// the numbers of find_volumes(mesh), and stated blocks do not name them. Cost: that of find_volumes, once. Errors: those of
/// find_volumes, interrupted.
Result<Model> make_model(const Arrangement& exact, const ConformingMesh& rounded,
                         const Improved& improved, const Run& run = {},
                         const BlockNaming& naming = {});

/// Returns the volumes of the mesh by the numbers of find_volumes(mesh), without finding them
/// again.
Volumes volumes_as_found(const Model& model);

// Finds the leaks that matter: the gaps that join blocks.
//
// The model is made once more with all gaps closed up to the last natural break in their widths
// (choose_seal()), without blocks that are certainly dirt (small_volume_for()). A gap separates
// blocks if a triangle of the strip that closes it has different volumes on its sides: opening this
// gap alone joins the two. That is decided exactly. The other gaps up to the break are harmless by
// the same criterion: tips, borders that reach beyond another surface, gaps next to others that stay
// open. Not seen are gaps that are wider than the break, and those that sealing can't close. Where two gaps lead between the same blocks, both are found.
// Cost: that of seal() and find_volumes().

/// The effect of closing a leak.
enum class LeakVerdict : std::uint8_t {
    separates, ///< it separates blocks
    harmless,  ///< it separates none
    wide,      ///< unknown: the gap is wider than those that were closed
};

/// The leaks of a model, judged.
struct LeakAdvice {
    double distance = 0;               ///< up to which gaps were closed; 0: there is no break
    std::vector<Leak> separating{};    ///< gaps that separate blocks, one entry for each pair of
                                       ///< surfaces, the longest first; decade is 0, borders
                                       ///< counts edges, which lengths count as a whole
    std::vector<LeakVerdict> verdicts; ///< per entry of leaks_of(borders)
};

/// Judges the leaks of an arrangement that was not sealed, whose model has these free borders;
/// `options` are those of the arrangement. Errors: those of arrange_within; bad_option if it was
/// sealed.
Result<LeakAdvice> judge_leaks(const Arranged& arranged, std::span<const FreeBorder> borders,
                               const ArrangeWithinOptions& options = {}, const Run& run = {});

} // namespace terrane
