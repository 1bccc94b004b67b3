// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of remeshing that decide its result and are not options of improve().
#pragma once

#include <array>
#include <cstddef>

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::quality::detail {

/// Shapes are q of quality.hpp, from 0 (degenerate) to 1 (equilateral). None of these constants
/// affects the guarantees of improve(): each change is proven whatever they are.
struct RemeshConstants : Constants {
    /// Edges longer than this multiple of their target length are split. 4/3 and 4/5
    /// (Botsch and Kobbelt 2004) keep a split edge from being collapsed again. Larger:
    /// edges vary more in length.
    double split_ratio = add("split_ratio", 4.0 / 3);
    /// Edges shorter than this multiple of their target length are collapsed. Larger: fewer
    /// short edges, more work.
    double collapse_ratio = add("collapse_ratio", 4.0 / 5);
    /// Least q that a collapse may leave where triangles were better. Larger: fewer
    /// collapses, better triangles at first.
    double least_shape = add("least_shape", 0.3);
    /// Triangles of smaller q are improved one by one at the end. Larger: more time there.
    double bad_shape = add("bad_shape", 0.5);
    /// Tolerance of curves, as a share of that of their sheets, so that triangles at a
    /// curve have room for their own deviation. Larger: fewer vertices on curves.
    double curve_tolerance = add("curve_tolerance", 1.0 / 3);
    /// Share of the sum of 1 / q by which a move must reduce it, so that the passes
    /// converge. Larger: fewer moves.
    double least_gain = add("least_gain", 1e-2);
    /// Pseudo-random displacement of vertices in regular grids, in target lengths. Larger:
    /// more disorder than smoothing removes.
    double jitter = add("jitter", 0.2);
    /// Vertices are displaced where all triangles have a smaller q; just above 0.83, that
    /// of half a square.
    double jitter_below_shape = add("jitter_below_shape", 0.86);
    /// Cosine of the angle between an added triangle and the mean of those it replaces.
    /// Larger: changes are rejected more often at creases.
    double least_normal_cosine = add("least_normal_cosine", 0.2);
    /// Least cosine of the angles that swaps for valences may create: 110 degrees. Larger:
    /// fewer such swaps.
    double least_valence_cosine = add("least_valence_cosine", -0.35);
    /// Gain in the cosine of the largest angle for which an edge is swapped; prevents
    /// endless swaps of equal angles.
    double least_cosine_gain = add("least_cosine_gain", 1e-6);
    /// Least displacement of a vertex along its curve, as a share of the distance of its
    /// neighbours.
    double least_slide = add("least_slide", 0.05);
    /// Least target length where a surface is curved, as a share of the target length
    /// elsewhere. Smaller: more triangles at sharp bends.
    double curvature_floor = add("curvature_floor", 0.125);
    /// Triangles that may decide the normal of a surface at a vertex. Larger: curvature is measured
    /// over the wanted length on finer meshes.
    unsigned turn_triangles = add("turn_triangles", 256);
    /// Turns are measured over this many triangles, but not beyond the wanted length. Larger: bends
    /// of few triangles count less.
    double turn_reach = add("turn_reach", 1);
    /// Least cosine of the angle between two triangles between which a block counts as thin: 30
    /// degrees. Larger: blocks are thin in fewer places, and triangles near intersections become
    /// better.
    double thin_cosine = add("thin_cosine", 0.866);
    /// The thickness of a block is the largest one within this many target lengths. Larger:
    /// triangles near intersections become better, blocks that end in wedges change more.
    double thin_reach = add("thin_reach", 1);
    /// Triangles that may decide about the thickness at a triangle.
    unsigned thin_triangles = add("thin_triangles", 256);
    /// Default of max_deviation, in target lengths. Larger: coarser representation of
    /// curved surfaces.
    double default_tolerance = add("default_tolerance", 0.05);
    /// Least height of a triangle, in longest edges, for which its normal is used: rounding
    /// may take that of thinner ones. Omitting thin triangles can only enlarge a proven
    /// bound.
    double thinnest = add("thinnest", 1e-6);
    /// Least tolerance that is accepted, in rounding errors of a distance.
    double least_bound = add("least_bound", 1e3);
    /// Patches are found anew when more than one in this many triangles has left them. Larger:
    /// cheaper checks, more regrouping.
    unsigned regroup_part = add("regroup_part", 20);
    /// Another pass is made if the last one changed more than one in this many triangles. Larger:
    /// more passes.
    unsigned pass_part = add("pass_part", 10);
    /// Another sweep of swaps is made if the last one swapped at least one edge per this many
    /// triangles. Larger: more sweeps.
    unsigned sweep_part = add("sweep_part", 100);
    /// Swaps and collapses follow a round of splits if it split at least one edge per this many
    /// triangles. Larger: fewer slivers are halved, more work.
    unsigned cleanup_part = add("cleanup_part", 20);
    /// Number of passes with displacements.
    unsigned jitter_passes = add("jitter_passes", 2);
    /// Rounds that improve single triangles.
    unsigned finish_rounds = add("finish_rounds", 2);
    /// Changes that are made for the worst triangle of all at the end, one after the other. Larger:
    /// a better worst triangle.
    unsigned worst_rounds = add("worst_rounds", 200);
    /// Rounds that improve all triangles that are worse than the result may be.
    unsigned bad_rounds = add("bad_rounds", 10);
    /// Attempts with more and more strict triangles before all are. Larger: wanted lengths in more
    /// places, more time.
    unsigned strict_attempts = add("strict_attempts", 2);
    /// Attempts with smaller bounds around blocks whose volumes have changed too much. Larger:
    /// fewer such blocks, more time.
    unsigned volume_attempts = add("volume_attempts", 3);
    /// Input triangles up to this many target lengths from a bad triangle become strict.
    double strict_lengths = add("strict_lengths", 2);
    /// All input triangles become strict when more than one in this many triangles is bad.
    unsigned strict_part = add("strict_part", 20);
    /// Rounds of splitting in a pass; a round halves an edge at most once.
    unsigned split_rounds = add("split_rounds", 32);
    /// Rounds of swapping in a pass.
    unsigned swap_rounds = add("swap_rounds", 6);
    /// Largest number of changes that are checked at once. Larger: better use of threads,
    /// more repeated checks.
    std::size_t window_size = add("window_size", 256);
    /// Triangles that a walk on the original surface may pass.
    unsigned most_steps = add("most_steps", 256);
    /// Triangles that may cover one part of a triangle. Larger: proofs for much coarser
    /// meshes.
    unsigned most_covered = add("most_covered", 2048);
    /// Parts into which a triangle may be divided in a proof of its deviation.
    unsigned most_parts = add("most_parts", 48);
    /// The same in bounds_back(), which has to prove every triangle.
    unsigned most_parts_back = add("most_parts_back", 16384);
    /// Largest multiple of the bound that bounds_back() tries.
    double most_factor_back = add("most_factor_back", 8);
    /// Shares of the way that smoothing draws a vertex, tried one after the other.
    std::array<double, 2> smoothing_shares =
        add<double>({"smoothing_shares_1", "smoothing_shares_2"}, {2, 1});
    /// Share of the way to the centre of the neighbours that is tried after these.
    double centring_share = add("centring_share", 0.5);
    /// Share of the way to the middle of its neighbours on a curve that a vertex slides if it
    /// may not slide the whole way.
    double slide_share = add("slide_share", 0.5);
    /// First step of the search for better positions, in target lengths.
    double search_step = add("search_step", 0.25);
    /// Steps of this search, each half of the one before.
    unsigned search_halvings = add("search_halvings", 4);
    /// Directions of this search in the tangent plane.
    unsigned search_directions = add("search_directions", 8);
    /// Edges that a collapse at a bad triangle may leave, in target lengths.
    double bad_collapse_ratio = add("bad_collapse_ratio", 2);
    /// A proof of the deviation shrinks triangles towards their centroid: a corner moves by at
    /// most the bound divided by this.
    double shrink_part = add("shrink_part", 4);
    /// Largest such move, as a share of the way.
    double most_shrink = add("most_shrink", 0.25);
    /// Parts of triangles whose edges are shorter than the bound divided by this are not
    /// divided again.
    double least_part = add("least_part", 4);
    /// In bounds_back(), a part of a radius above this multiple of the bound may be proven as a
    /// whole.
    double coarse_part_back = add("coarse_part_back", 4);
    /// Edges that a collapse along a curve may leave, in target lengths.
    double curve_collapse_ratio = add("curve_collapse_ratio", 2);
    /// Least q of triangles that are not strict, unless the result may have smaller ones. Larger:
    /// good triangles are divided less, as their parts are worse at first.
    double least_quality = add("least_quality", 1e-3);
    /// Share by which rounding may reduce q of a triangle that is divided into similar ones.
    double quality_rounding = add("quality_rounding", 1e-12);
    /// Share by which q of a bad triangle must grow at least. Larger: fewer changes.
    double least_growth = add("least_growth", 1e-9);
    /// Ratio of an edge to its wanted length below which all edges are equally short: orders of
    /// magnitude become classes.
    double least_length_ratio = add("least_length_ratio", 1e-70);
};

inline constexpr RemeshConstants constants{};

} // namespace terrane::quality::detail
