// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/maps/maps.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/maps/grid_frame.hpp>
#include <terrane/algorithms/maps/verticals.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr double most_nodes = 1e9;

constexpr std::array<std::pair<std::string_view, MapKind>, 6> kinds{{
    {"height", MapKind::height},
    {"depth", MapKind::depth},
    {"dip", MapKind::dip},
    {"azimuth", MapKind::azimuth},
    {"thickness", MapKind::thickness},
    {"distance", MapKind::distance},
}};

bool needs_other(MapKind kind) {
    return kind == MapKind::thickness || kind == MapKind::distance;
}

/// Says what is wrong with a grid whose nodes are to get values.
Status check_nodes(const Grid& grid) {
    for (const double number : {grid.x, grid.y, grid.dx, grid.dy, grid.rotation})
        if (!std::isfinite(number))
            return Error{ErrorCode::bad_option, "a number of the grid is not finite", "grid"};
    if (grid.dx == 0 || grid.dy == 0 || grid.nx == 0 || grid.ny == 0)
        return Error{ErrorCode::bad_option, "the grid has no steps or no nodes", "grid"};
    if (double(grid.nx) * grid.ny > most_nodes)
        return Error{ErrorCode::bad_option, "the grid has more than 10^9 nodes", "grid"};
    return Done{};
}

Grid without_values(const Grid& grid, double value) {
    Grid result{grid.name, grid.x, grid.y, grid.nx, grid.ny, grid.dx, grid.dy, grid.rotation, {}};
    result.values.assign(std::size_t{grid.nx} * grid.ny, value);
    return result;
}

/// The nodes of a grid, by triangles.
class NodesOfGrid {
public:
    explicit NodesOfGrid(const Grid& grid) : frame_(grid), nx_(grid.nx), ny_(grid.ny) {}

    template <class Visit>
    void operator()(const std::array<Point3, 3>& corners, const Visit& visit) const {
        std::array<Point3, 3> at;
        for (std::size_t k = 0; k < 3; ++k) at[k] = frame_.steps(corners[k].x, corners[k].y);
        const auto columns = range(std::minmax({at[0].x, at[1].x, at[2].x}), nx_);
        const auto rows = range(std::minmax({at[0].y, at[1].y, at[2].y}), ny_);
        for (std::size_t j = rows[0]; j < rows[1]; ++j)
            for (std::size_t i = columns[0]; i < columns[1]; ++i)
                visit(j * nx_ + i, frame_.node(double(i), double(j)));
    }

private:
    /// Returns the first and one past the last node between; steps are rounded, so that there is one more on
    /// either side.
    static std::array<std::size_t, 2> range(std::pair<double, double> between, std::size_t count) {
        const double low = std::ceil(between.first) - 1, high = std::floor(between.second) + 2;
        return {low > 0 ? static_cast<std::size_t>(std::min(low, double(count)))
                        : 0, // NaN: all nodes
                high < double(count) ? static_cast<std::size_t>(std::max(high, 0.0)) : count};
    }

    GridFrame frame_;
    std::size_t nx_, ny_;
};

/// The highest points of surfaces on the verticals through the nodes of a grid.
struct HighestPoints {
    std::vector<double> z;               ///< per node; NaN: none
    std::vector<std::uint32_t> triangle; ///< per node, of the surface; or no_index
    std::vector<std::uint32_t> surface;  ///< per node; or no_index
    std::vector<bool> several;           ///< per node: whether there is a lower point, too

    explicit HighestPoints(std::size_t nodes) :
        z(nodes, no_value), triangle(nodes, no_index), surface(nodes, no_index), several(nodes) {}
};

std::array<Point3, 3> corners_of(const Surface& surface, std::size_t t) {
    const auto& [i, j, k] = surface.triangles[t];
    return {surface.vertices[i], surface.vertices[j], surface.vertices[k]};
}

HighestPoints highest_points(std::span<const Surface> surfaces, const Grid& grid) {
    const NodesOfGrid nodes(grid);
    HighestPoints found(std::size_t{grid.nx} * grid.ny);
    for (std::uint32_t s = 0; s < surfaces.size(); ++s)
        for (std::uint32_t t = 0; t < surfaces[s].triangles.size(); ++t) {
            const auto corners = corners_of(surfaces[s], t);
            const Sign turn = orient2d(Axis::z, corners[0], corners[1], corners[2]);
            if (turn == Sign::Zero) continue;
            nodes(corners, [&](std::size_t node, const Point3& p) {
                if (!meets(corners, turn, p)) return;
                const VerticalHeight height(corners, p);
                if (found.triangle[node] != no_index) {
                    const VerticalHeight highest(
                        corners_of(surfaces[found.surface[node]], found.triangle[node]), p);
                    const Sign order = height.compare(highest);
                    if (order != Sign::Zero) found.several[node] = true;
                    if (order != Sign::Positive) return;
                }
                found.z[node] = height.z();
                found.surface[node] = s;
                found.triangle[node] = t;
            });
        }
    return found;
}

/// Returns the dip and the azimuth of a triangle, in degrees.
std::array<double, 2> dip_and_azimuth(const std::array<Point3, 3>& t) {
    constexpr double degrees = 180 / std::numbers::pi;
    const auto [x, y] = fall_of(t);
    if (x == 0 && y == 0) return {0, no_value};
    const double azimuth = std::atan2(x, y) * degrees;
    return {std::atan(std::hypot(x, y)) * degrees, azimuth < 0 ? azimuth + 360 : azimuth + 0.0};
}

/// Makes values out of the highest points.
class MapMaker {
public:
    MapMaker(std::span<const Surface> surfaces, std::span<const Surface> to, const Run& run,
             SurfaceMap& map) :
        surfaces_(surfaces),
        to_(to), run_(run), map_(map), at_(highest_points(surfaces, map.grid)) {}

    Status make(MapKind kind) {
        auto& values = map_.grid.values;
        if (kind == MapKind::distance) {
            add_distances();
        } else if (kind == MapKind::thickness) {
            const auto other = highest_points(to_, map_.grid);
            for (std::size_t k = 0; k < values.size(); ++k) {
                values[k] = at_.z[k] - other.z[k];
                if (other.several[k]) at_.several[k] = true;
            }
        } else {
            for (std::size_t k = 0; k < values.size(); ++k) values[k] = value_at(k, kind);
        }
        if (run_.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        for (std::size_t k = 0; k < values.size(); ++k) {
            map_.nodes += std::isnan(values[k]) ? 0 : 1;
            map_.sheets += at_.several[k] ? 1 : 0;
        }
        return Done{};
    }

private:
    double value_at(std::size_t k, MapKind kind) {
        const double z = at_.z[k];
        if (std::isnan(z) || kind == MapKind::height) return z;
        if (kind == MapKind::depth) return 0 - z;
        const std::array triangle{at_.surface[k], at_.triangle[k]};
        if (triangle != seen_)
            angles_ = dip_and_azimuth(corners_of(surfaces_[triangle[0]], triangle[1]));
        seen_ = triangle;
        return angles_[kind == MapKind::dip ? 0 : 1];
    }

    void add_distances() {
        std::vector<Point3> points;
        std::vector<Triangle> triangles;
        for (const Surface& s : to_) {
            const auto first = static_cast<std::uint32_t>(points.size());
            points.insert(points.end(), s.vertices.begin(), s.vertices.end());
            for (const auto& [i, j, k] : s.triangles)
                triangles.push_back({first + i, first + j, first + k});
        }
        if (triangles.empty()) return;
        const TriangleTree tree(points, std::move(triangles));
        const GridFrame frame(map_.grid);
        const std::size_t nx = map_.grid.nx;
        for_ranges(map_.grid.values.size(), run_, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last && !run_.stop.stop_requested(); ++k)
                if (!std::isnan(at_.z[k])) {
                    const std::size_t row = k / nx, column = k % nx;
                    map_.grid.values[k] =
                        tree.distance(frame.node(double(column), double(row), at_.z[k]), HUGE_VAL);
                }
        });
    }

    std::span<const Surface> surfaces_, to_;
    const Run& run_;
    SurfaceMap& map_;
    HighestPoints at_;
    std::array<std::uint32_t, 2> seen_{no_index, no_index}; ///< surface and triangle of angles_
    std::array<double, 2> angles_{};                        ///< dip and azimuth
};

} // namespace

std::string_view name_of(MapKind kind) {
    return kinds[static_cast<std::size_t>(kind)].first;
}

std::optional<MapKind> map_kind_named(std::string_view name) {
    for (const auto& [known, kind] : kinds)
        if (name == known) return kind;
    return std::nullopt;
}

Result<Grid> grid_over(std::span<const Surface> surfaces, double step) {
    const StandardArithmetic guard;
    if (!(step > 0 && std::isfinite(step)))
        return Error{ErrorCode::bad_option, "must be a length above 0", "step"};
    std::array<double, 4> box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Surface& s : surfaces)
        for (const Triangle& t : s.triangles)
            for (const std::uint32_t v : t) {
                if (v >= s.vertices.size())
                    return Error{ErrorCode::bad_index, "a triangle names no vertex", s.name};
                const Point3& p = s.vertices[v];
                box = {std::min(box[0], p.x), std::min(box[1], p.y), std::max(box[2], p.x),
                       std::max(box[3], p.y)};
            }
    const double west = std::ceil(box[0] / step), east = std::floor(box[2] / step);
    const double south = std::ceil(box[1] / step), north = std::floor(box[3] / step);
    if (!(east >= west && north >= south))
        return Error{ErrorCode::nothing_to_do, "no node of the grid is within the map", "step"};
    if ((east - west + 1) * (north - south + 1) > most_nodes)
        return Error{ErrorCode::bad_option, "would make more than 10^9 nodes", "step"};
    return Grid{"",
                west * step,
                south * step,
                static_cast<std::uint32_t>(east - west + 1),
                static_cast<std::uint32_t>(north - south + 1),
                step,
                step,
                0,
                {}};
}

Result<SurfaceMap> map_surface(std::span<const Surface> surfaces, MapKind kind, const Grid& grid,
                               std::span<const Surface> to, const Run& run) {
    return guarded("for the map", "map", [&]() -> Result<SurfaceMap> {
        if (const auto status = check_nodes(grid); !status) return status.error();
        if (needs_other(kind) == to.empty())
            return Error{ErrorCode::bad_option,
                         std::string(name_of(kind)) +
                             (to.empty() ? " needs a second surface" : " is of one surface"),
                         "to"};
        for (const auto& checked : {surfaces, to})
            if (const auto status = validate(checked, run); !status) return status.error();
        SurfaceMap map{without_values(grid, no_value)};
        if (const auto status = MapMaker(surfaces, to, run, map).make(kind); !status)
            return status.error();
        return map;
    });
}

Result<Grid> map_blocks(const Mesh& mesh, const Volumes& volumes, std::span<const BlockId> blocks,
                        const Grid& grid) {
    return guarded("for the map", "map", [&]() -> Result<Grid> {
        if (const auto status = check_nodes(grid); !status) return status.error();
        std::vector<bool> wanted(volumes.measures.size());
        for (const BlockId block : blocks) {
            if (block == 0 || block >= wanted.size())
                return Error{ErrorCode::bad_option, "there is no such block", "blocks"};
            wanted[block] = true;
        }
        Grid result = without_values(grid, 0);
        const auto crossings = vertical_crossings(mesh, volumes, NodesOfGrid(grid));
        for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
            const auto &low = crossings[i], &high = crossings[i + 1];
            if (low.node == high.node && wanted[low.above])
                result.values[low.node] += high.z - low.z;
        }
        return result;
    });
}

} // namespace terrane
