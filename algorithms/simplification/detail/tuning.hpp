// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of simplification that decide its result and are not options of simplify().
#pragma once

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::simplification::detail {

/// None of these constants affects the guarantees of simplify().
struct Tuning : Constants {
    /// Cosine of the angle by which two cells of a sheet may turn; more is a crease (50 degrees, as
    /// in improve()).
    double crease_cosine = add("crease_cosine", 0.642787609686539);
    /// Places are near in space but far along the surfaces if the way along the surfaces is longer
    /// than this multiple of their distance: the cotangent of half of 20 degrees, so that wedges of
    /// less than 20 degrees are closed. Larger: only sharper ones are.
    double far_along = add("far_along", 5.671281819617709);
    /// Cosine of the least angle between the way to a place and the surfaces around it, there. A
    /// place is nearest if that is 90 degrees or more; less, 60 degrees, lets surfaces slant.
    double towards = add("towards", 0.5);
    /// A contact within a triangle that is nearer to a corner than this share of the resolution is
    /// one with the corner. Larger: fewer short edges, more movement.
    double to_corner = add("to_corner", 0.3);
    /// The same for edges.
    double to_edge = add("to_edge", 0.2);
    /// Edges longer than this multiple of the resolution are divided where surfaces are near.
    /// Larger: fewer triangles, less exact limits of the zipped part.
    double longest_edge = add("longest_edge", 3);
    /// A triangle may turn by a larger angle than that of this cosine only if it is narrower than
    /// `narrow` times the resolution.
    double fold_cosine = add("fold_cosine", 0);
    double narrow = add("narrow", 0.01);
    /// Places nearer than this share of the resolution, none of them a vertex, are left to the
    /// arrangement, which makes a curve of them. A vertex is joined even so: the arrangement would
    /// leave a sliver between it and the edge or the cell.
    double crossing = add("crossing", 1e-3);
    /// Edges of the triangles that are made first, in resolutions, unless a length is asked for.
    double edge_length = add("edge_length", 6);
    /// Share of the allowed movement that making regular triangles may take.
    double regular_share = add("regular_share", 0.125);
    /// Parts of blocks are dissolved that are thinner than this share of the resolution, on average.
    double part_share = add("part_share", 0.25);
    /// Times that a vertex is joined with others at most, so that passes end.
    unsigned joins = add("joins", 12);
    /// Passes over the complex, each of which glues the nearest contacts.
    unsigned passes = add("passes", 100);
    /// Arrangements of the moved surfaces.
    unsigned rounds = add("rounds", 5);
    /// Times that all is done again, with more blocks left alone.
    unsigned attempts = add("attempts", 6);
};

inline constexpr Tuning tuning{};

} // namespace terrane::simplification::detail
