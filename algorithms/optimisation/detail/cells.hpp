// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tetrahedra that know their neighbours, and change a few at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/optimisation/detail/constants.hpp>

#include <terrane/algorithms/optimisation/detail/quality.hpp>
#include <terrane/algorithms/optimisation/optimise.hpp>

namespace terrane::optimisation::detail {

using Corners = std::array<std::uint32_t, 4>;

inline constexpr std::uint32_t none = UINT32_MAX;

/// The face opposite to corner k of a positive tetrahedron, such that the corner is on its positive
/// side.
std::array<std::uint32_t, 3> face_opposite(const Corners& cell, unsigned k);

/// Limits that new cells must keep: a quality above that of those that they replace, and no sine
/// below the least one of the whole mesh.
struct Demand {
    double quality = 0;
    double sine = 0;
};

/// Tetrahedra by number. Faces on surfaces and on the box are walls: they stay, and so do their
/// corners.
class Cells {
public:
    /// `outside`: whether cells of block 0 count. Those that don't may have any positive volume.
    explicit Cells(const TetrahedralMesh& mesh, bool outside = true);

    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    [[nodiscard]] bool is_alive(std::uint32_t c) const { return cells_[c][0] != none; }
    [[nodiscard]] const Corners& corners(std::uint32_t c) const { return cells_[c]; }
    /// Tells whether it matters how good a cell is.
    [[nodiscard]] bool counts(std::uint32_t c) const { return outside_ || block_[c] != 0; }
    /// Returns the quality of a cell; infinite if that does not count, or can't be trusted, so that
    /// it stays.
    [[nodiscard]] double quality(std::uint32_t c) const { return quality_[c]; }
    [[nodiscard]] double least_quality(std::span<const std::uint32_t> of) const {
        double least = HUGE_VAL;
        for (const std::uint32_t c : of) least = std::min(least, quality_[c]);
        return least;
    }
    /// Returns the quality above which others may replace cells; see changes.hpp.
    [[nodiscard]] double enough_for(std::span<const std::uint32_t> old, double gain) const {
        return std::max(least_quality(old) + gain, constants.least_gain);
    }
    /// Returns the cell behind the face opposite to corner k; none on the hull.
    [[nodiscard]] std::uint32_t beside(std::uint32_t c, unsigned k) const { return beside_[c][k]; }
    [[nodiscard]] bool is_wall(std::uint32_t c, unsigned k) const {
        return (walls_[c] >> k & 1U) != 0;
    }
    /// Returns the cell behind that face, unless it is a wall.
    [[nodiscard]] std::uint32_t through(std::uint32_t c, unsigned k) const {
        return is_wall(c, k) ? none : beside(c, k);
    }
    [[nodiscard]] const std::vector<Point3>& points() const { return points_; }
    /// Returns a point in the unit of the mesh.
    [[nodiscard]] Point3 place(std::uint32_t v) const;
    /// Tells whether a vertex is on walls: no operation but loosened() moves it.
    [[nodiscard]] bool is_fixed(std::uint32_t v) const { return is_fixed_[v]; }
    /// Lets vertices on walls move.
    void set_free(VertexFreedom freedom) { freedom_ = std::move(freedom); }
    /// Tells whether a vertex is on walls and may move.
    [[nodiscard]] bool is_free(std::uint32_t v) const {
        return v < freedom_.is_free.size() && is_fixed_[v] && freedom_.is_free[v];
    }
    /// Returns the place nearest to p where a vertex on walls may be, or none.
    [[nodiscard]] std::optional<Point3> free_place(std::uint32_t v, const Point3& p) const;

    /// Returns the quality of a cell that may be made; negative if it can't be trusted.
    [[nodiscard]] double quality_of(const Corners& c) const {
        const Quality quality = measure(c);
        return quality.is_trusted ? quality.value : -1;
    }
    [[nodiscard]] Quality measure(const Corners& c) const {
        return detail::quality_of(points_[c[0]], points_[c[1]], points_[c[2]], points_[c[3]],
                                  measure_);
    }
    [[nodiscard]] const Measure& judged_by() const { return measure_; }
    /// Computes the qualities of all cells again, by this measure.
    void judge_by(const Measure& by);
    [[nodiscard]] std::uint32_t block(std::uint32_t c) const { return block_[c]; }
    /// Returns six times the volume, in floating point, in a unit of its own.
    [[nodiscard]] double volume_of(const Corners& c) const;
    /// Returns the cells at a vertex.
    [[nodiscard]] std::vector<std::uint32_t> star(std::uint32_t v) const;

    /// Returns the number of changes so far.
    [[nodiscard]] std::uint32_t time() const { return time_; }
    /// Returns the number of the last change that made the cell or moved a corner of it.
    [[nodiscard]] std::uint32_t changed(std::uint32_t c) const { return changed_[c]; }
    /// Returns the number of the last change of a cell at a vertex.
    [[nodiscard]] std::uint32_t touched(std::uint32_t v) const { return touched_[v]; }
    /// Tells whether anything at a cell has changed since then.
    [[nodiscard]] bool is_touched(std::uint32_t c, std::uint32_t since) const {
        return std::any_of(cells_[c].begin(), cells_[c].end(),
                           [&](std::uint32_t v) { return touched_[v] > since; });
    }

    /// Returns the nearest point that the mesh can have: doubles near zero lose digits in its unit.
    [[nodiscard]] Point3 representable(const Point3& p) const;
    std::uint32_t add_vertex(const Point3& p);
    /// Takes back the last added vertex, which no cell has.
    void remove_last_vertex();

    /// Replaces cells by others of the same block that fill the same space, if each of these is as
    /// good as demanded and has a positive volume, exactly, they match each other and those around
    /// them, and all walls between old ones are faces of new ones. Returns whether it did.
    bool replace(std::span<const std::uint32_t> old, std::span<const Corners> added,
                 const Demand& demand);
    /// Moves a vertex that is free or not fixed, if all cells at it that count are as good as demanded
    /// then, and all stay positive, exactly. Returns whether it did.
    bool move(std::uint32_t v, const Point3& to, const Demand& demand);

    /// Writes the cells back, without vertices that none has any more.
    void write(TetrahedralMesh& mesh) const;

private:
    struct Face;
    struct Fit;

    void match_all();
    [[nodiscard]] bool is_positive(const Corners& c) const;
    [[nodiscard]] bool meets(const Corners& c, const Demand& demand) const;
    [[nodiscard]] static Face face_of(const Corners& c, std::uint32_t cell, unsigned k);
    void connect(const Face& one, const Face& other);
    /// Sets the hull of old cells and the walls between them.
    void collect_old(std::span<const std::uint32_t> old, Fit& fit) const;
    /// Returns how new cells fit; none if they do not.
    [[nodiscard]] std::optional<Fit> fit(std::span<const std::uint32_t> old,
                                         std::span<const Corners> added) const;
    /// Frees the numbers of old cells and returns numbers for `count` new ones.
    std::vector<std::uint32_t> renew(std::span<const std::uint32_t> old, std::size_t count);
    void add_cell();
    void set_wall(const Face& face);
    void touch(std::uint32_t c);
    void store(std::uint32_t c, const Corners& corners, std::uint32_t block);

    bool outside_; ///< whether cells of block 0 count
    int exponent_; ///< points are those of the mesh times 2^-exponent
    std::vector<Point3> points_;
    std::vector<bool> is_fixed_;
    VertexFreedom freedom_;              ///< of the vertices of the mesh that was given
    std::vector<std::uint32_t> cell_of_; ///< per vertex: one of its cells
    std::vector<Corners> cells_;         ///< none: free
    std::vector<Corners> beside_;
    std::vector<std::uint8_t> walls_; ///< per cell: bit k for the face opposite to corner k
    std::vector<std::uint32_t> block_;
    Measure measure_; ///< by which qualities are computed
    std::vector<double> quality_;
    std::uint32_t time_ = 0;
    std::vector<std::uint32_t> changed_; ///< per cell
    std::vector<std::uint32_t> touched_; ///< per vertex
    std::vector<std::uint32_t> free_;    ///< numbers of cells that are gone
};

} // namespace terrane::optimisation::detail
