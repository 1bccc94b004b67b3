// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the volumes of blocks while a mesh is improved, and limits the tolerance of sheets
// around blocks that change too much.
//
// If no point of the border of a block moves by more than d, its volume changes by about d times
// the area of the border at most. So a block keeps its volume up to a share s if d is s times
// volume by area. That is a choice of d, no proof: the volumes of the result are found exactly in
// the end.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/algorithms/quality/detail/working_mesh.hpp>

namespace terrane::quality::detail {

class BlockVolumes {
public:
    /// `sides` has, per sheet, the volume in front of its triangles in `features` and the one
    /// behind them; 0 is the outside. `count` is the number of volumes. Referenced objects must
    /// outlive the object.
    BlockVolumes(const Mesh& mesh, const Features& features,
                 std::vector<std::array<std::uint32_t, 2>> sides, std::size_t count);

    /// Limits the bounds (one per triangle of the input; those of sheets are `bound_of`, if there
    /// are none yet) around blocks whose volumes have changed by more than `share`; they are
    /// reduced to `least` at most. Returns whether one has become smaller. Floating point; cost:
    /// linear.
    bool limit_bounds(const WorkMesh& now, double share, double least,
                      std::span<const double> bound_of, std::vector<double>& bounds);

    /// Counts the blocks around which bounds were limited.
    [[nodiscard]] std::size_t limited() const;

private:
    [[nodiscard]] std::vector<double> sums(std::span<const Point3> points,
                                           std::span<const Triangle> triangles,
                                           std::span<const std::uint32_t> sheet_of) const;

    const Features& features_;
    std::vector<std::array<std::uint32_t, 2>> sides_;
    std::vector<Point3> origin_; ///< per volume: a vertex of its border
    std::vector<double> area_;   ///< per volume: of the sheets with another volume behind
    std::vector<double> before_; ///< per volume: six times its size; the sign of all is the same
    std::vector<double> largest_move_; ///< per volume: the bound around it; 0: not limited
};

} // namespace terrane::quality::detail
