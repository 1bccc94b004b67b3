// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A complex of triangles that can be divided and glued, for simplification.
//
// Cells are triangles of one or more surfaces. Edges and cells are divided at points, and vertices
// are merged; cells that lose a corner go, and cells with the same corners become one of all their
// surfaces. Nothing here decides whether that is wanted.
//
// Law: each point of the mesh from which the complex was made corresponds to one of the complex,
// affinely in each part, and moved() bounds their distance: linearly interpolated over a cell it
// bounds the distance at each of its points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::simplification::detail {

constexpr std::uint32_t none = UINT32_MAX;

/// A surface of a cell.
struct CellLayer {
    std::uint32_t surface = 0;
    std::uint32_t origin = 0; ///< triangle of the given mesh of which it is the image, or a part
    bool is_turned = false;   ///< the corners of the cell run the other way round
    bool is_folded = false;   ///< an even number of images of this surface lie here on each other
};

/// A triangle of the complex.
struct Cell {
    Triangle corners{};
    std::vector<CellLayer> layers{}; ///< by surface, ascending; empty: the cell is gone
};

/// The freedom of a vertex. Coordinates in which the boundary of a volume of interest lies stay as
/// they are, so that its planes and edges stay planar and straight.
struct Freedom {
    unsigned fixed_axes = 0; ///< bit k: coordinate k stays
    bool is_pinned = false;  ///< on an oblique part of the boundary: it does not move at all

    [[nodiscard]] bool is_fixed(unsigned axis) const { return (fixed_axes >> axis & 1U) != 0; }
};

inline double coordinate(const Point3& p, unsigned axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// Where the points were that a vertex stands for: at most `slack` away from a box.
struct Past {
    Point3 low{}, high{};
    double slack = 0;

    /// Bounds the distance from a place to these points.
    [[nodiscard]] double reach(const Point3& place) const;
    /// Returns the place from which the farthest of these points is least far.
    [[nodiscard]] Point3 middle() const {
        return {low.x / 2 + high.x / 2, low.y / 2 + high.y / 2, low.z / 2 + high.z / 2};
    }
    /// Stands for the points of another vertex, too.
    void unite(const Past& other);
    /// Adds a share of where another vertex was: for points between vertices, whose shares add up to 1.
    void add(double share, const Past& other);
};

/// A vertex, or one that a division would make.
struct PlacedVertex {
    Point3 place{};
    Past past{};
    Freedom freedom{};
};

class Complex {
public:
    /// Makes a complex. `past`: per vertex. `surfaces`: for the roles, since the boundary keeps its planes. Cells without layers are left out.
    Complex(std::vector<Point3> points, std::vector<Past> past, const std::vector<Cell>& cells,
            std::span<const SurfaceInfo> surfaces);

    [[nodiscard]] const std::vector<Point3>& points() const { return points_; }
    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
    [[nodiscard]] bool has(std::uint32_t cell) const { return !cells_[cell].layers.empty(); }
    /// The cells at a vertex, in no order that means anything but the same in each run.
    [[nodiscard]] std::span<const std::uint32_t> star(std::uint32_t v) const { return star_[v]; }
    /// The cells at an edge, ascending.
    [[nodiscard]] std::vector<std::uint32_t> star(std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] double moved(std::uint32_t v) const { return past_[v].reach(points_[v]); }
    [[nodiscard]] const Past& past(std::uint32_t v) const { return past_[v]; }
    [[nodiscard]] const Freedom& freedom(std::uint32_t v) const { return freedom_[v]; }
    /// The vertex that divides an edge or a cell with these weights of its corners; with one
    /// corner, that vertex.
    [[nodiscard]] PlacedVertex between(std::span<const std::uint32_t> corners,
                                       std::span<const double> weights) const;

    /// Divides all cells at an edge by a new vertex, at share `at` of the way from a to b. Returns
    /// the vertex.
    std::uint32_t split_edge(std::uint32_t a, std::uint32_t b, double at);
    /// Divides a cell by a new vertex with these weights of its corners. Returns the vertex.
    std::uint32_t split_cell(std::uint32_t cell, const std::array<double, 3>& weights);
    /// Merges v into w, which goes to `place` and stands for the points of both.
    void merge(std::uint32_t v, std::uint32_t w, const Point3& place);
    /// Takes a surface from a cell; a cell without surfaces goes.
    void remove_layer(std::uint32_t cell, std::uint32_t surface);

private:
    void add_cell(const Triangle& corners, const std::vector<CellLayer>& layers);
    void remove_cell(std::uint32_t cell);
    void unite(Cell& cell, const Triangle& corners, const std::vector<CellLayer>& layers);
    std::uint32_t add_vertex(std::span<const std::uint32_t> corners,
                             std::span<const double> weights);
    void find_freedom(std::span<const SurfaceInfo> surfaces);

    std::vector<Point3> points_;
    std::vector<Past> past_;
    std::vector<Freedom> freedom_;
    std::vector<Cell> cells_;
    std::vector<std::vector<std::uint32_t>> star_; ///< per vertex: its cells
};

inline bool contains(const Triangle& t, std::uint32_t v) {
    return t[0] == v || t[1] == v || t[2] == v;
}

} // namespace terrane::simplification::detail
