// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which vertex of a mesh stands for which exact point: step (1) of judge.hpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/judge/detail/target.hpp>

namespace terrane::judging {

/// Finds points in a grid whose cells are about as large as what is looked for.
class PointGrid {
public:
    /// reach: the largest difference of coordinates that for_near() looks for.
    PointGrid(std::span<const Point3> points, std::span<const std::uint32_t> members, double reach);

    /// Calls visit(point) for each member of which no coordinate differs by more than the reach.
    template <class Visit>
    void for_near(const Point3& p, const Visit& visit) const {
        const Key low = key({p.x - reach_, p.y - reach_, p.z - reach_});
        const Key high = key({p.x + reach_, p.y + reach_, p.z + reach_});
        for (auto x = low[0]; x <= high[0]; ++x)
            for (auto y = low[1]; y <= high[1]; ++y)
                for (auto z = low[2]; z <= high[2]; ++z) visit_cell({x, y, z}, p, visit);
    }

private:
    using Key = std::array<std::int64_t, 3>;
    struct Entry {
        std::uint64_t hash;
        std::uint32_t point;
    };

    [[nodiscard]] Key key(const Point3& p) const;
    static std::uint64_t hash(const Key& key);
    template <class Visit>
    void visit_cell(const Key& cell, const Point3& p, const Visit& visit) const {
        const std::uint64_t wanted = hash(cell);
        for (auto e = std::ranges::lower_bound(entries_, wanted, {}, &Entry::hash);
             e != entries_.end() && e->hash == wanted; ++e)
            if (key(points_[e->point]) == cell && is_near(points_[e->point], p)) visit(e->point);
    }
    [[nodiscard]] bool is_near(const Point3& p, const Point3& q) const;

    std::span<const Point3> points_;
    double reach_, size_;
    std::vector<Entry> entries_; ///< by hash, then by point
};

/// The mesh that is judged: its distinct points and triangles. Points nearer than the bound are one.
struct OutputMesh {
    Soup soup;                           ///< triangles that lose their area thereby are left out
    std::vector<std::uint32_t> vertices; ///< the points of triangles, ascending
    std::vector<Edge>
        borders; ///< edges of one triangle, before points were joined; with their ends
                 ///< as they are now

    OutputMesh(Soup merged, double bound);
    /// Returns the number of triangles that have an edge.
    [[nodiscard]] std::size_t triangles_at(std::uint32_t u, std::uint32_t w) const;
    [[nodiscard]] bool has_edge(std::uint32_t u, std::uint32_t w) const {
        return triangles_at(u, w) > 0;
    }

private:
    void join_near(double bound);
};

/// A vertex for each exact point, as far as there is one.
struct Matching {
    std::vector<std::uint32_t> image;    ///< per vertex of the arrangement: the vertex, or no_index
    IndexLists<std::uint32_t> preimages; ///< per point of the soup: vertices of the arrangement
    double largest_move = 0;             ///< of a vertex from its exact point
    Point3 largest_place{};              ///< where that is
};

/// Matches vertices. Of several within the bound, the one at the nearest doubles stands for an exact
/// point, otherwise the one that has most edges of cells, otherwise the nearest.
Matching match_vertices(const Target& target, const Cells& cells, const OutputMesh& output,
                        double bound);

/// The largest difference of two coordinates.
double difference(const Point3& p, const Point3& q);

} // namespace terrane::judging
