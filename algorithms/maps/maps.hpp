// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Maps: numbers at the nodes of a regular grid, measured along the vertical through each node. Which triangles a
// vertical meets is decided exactly: a triangle contains its edges and corners, so that nodes on these are
// ordinary, also on the border of a surface. Triangles that are vertical are not met. Heights differ
// from exact ones by at most 2^-45 of the greatest height of a corner of the triangle; at a vertex the height is that
// of the vertex. Which of two points on a vertical is higher is decided exactly.
// Cost: linear in the triangles, and in the nodes that their boxes in the map contain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// Values over a regular grid, which may be rotated by an angle r. Node (i, j) is at
/// (x, y) + i dx (cos r, sin r) + j dy (-sin r, cos r).
struct Grid {
    std::string name;           ///< of the surface
    double x = 0;               ///< position of node (0, 0)
    double y = 0;               ///< position of node (0, 0)
    std::uint32_t nx = 0;       ///< nodes along i, >= 1
    std::uint32_t ny = 0;       ///< nodes along j, >= 1
    double dx = 0;              ///< step along i, not 0
    double dy = 0;              ///< step along j, not 0; < 0: rows run down the y axis (y flip)
    double rotation = 0;        ///< degrees, counterclockwise from x
    std::vector<double> values; ///< nx ny values; node (i, j) at j nx + i; NaN: no value
};

/// Returns a grid without values: the nodes at multiples of `step` in the map of the surfaces.
/// Errors: bad_option if the step is not positive or more than 10^9 nodes would result;
/// nothing_to_do if there is no node.
Result<Grid> grid_over(std::span<const Surface> surfaces, double step);

/// The numbers of a map.
enum class MapKind : std::uint8_t {
    height, ///< z of the surface
    depth,  ///< -z
    dip,    ///< angle between the surface and the horizontal, degrees from 0 to 90
    azimuth, ///< direction in which the surface dips, degrees clockwise from y; none where it is level
    thickness, ///< height of the surface above another one along the vertical; < 0: below it
    distance,  ///< from the surface to the nearest point of another one in space: true thickness
};

/// "height", "depth", ...
std::string_view name_of(MapKind kind);
/// Returns the kind of a name.
std::optional<MapKind> map_kind_named(std::string_view name);

/// A map of a surface.
struct SurfaceMap {
    Grid grid;             ///< the grid that was asked for, with values; NaN: no value
    std::size_t nodes = 0; ///< those with a value
    std::size_t sheets =
        0; ///< nodes where the vertical meets a surface more than once, as at an overthrust
};

/// Maps surfaces, which count as one, at the nodes of a grid. Where the vertical meets them more than once, the
/// highest point counts; where two triangles meet there, one of them says the dip. `to`: the other surfaces of
/// thickness and distance. The values of `grid` have no effect.
/// Errors: bad_option for a grid without steps, and for `to` where it is missing or has no use; those of validate();
/// interrupted.
Result<SurfaceMap> map_surface(std::span<const Surface> surfaces, MapKind kind, const Grid& grid,
                               std::span<const Surface> to = {}, const Run& run = {});

/// Maps the thickness of blocks: the length of each vertical within them, 0 where it meets none. A vertical through
/// an edge counts as moved a little to greater x, and less to greater y; where it leaves the model so, to smaller x,
/// or to smaller y. `volumes` are those of the mesh.
/// Errors: bad_option for a grid without steps, and for blocks that are not there.
Result<Grid> map_blocks(const Mesh& mesh, const Volumes& volumes, std::span<const BlockId> blocks,
                        const Grid& grid);

} // namespace terrane
