// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/detail/grid_walls.hpp>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace terrane::grids::detail {
namespace {

using Cell = std::optional<std::uint32_t>; ///< a layer; none: no active cell there

void append_edges(const Cells& cells, const Wall& wall, unsigned side, std::uint32_t nz,
                  std::vector<CellEdge>& edges) {
    if (!wall.columns[side]) return;
    const Column c = *wall.columns[side];
    for (std::uint32_t k = 0; k < nz; ++k) {
        if (!cells.active(c, k)) continue;
        const auto depth = [&](unsigned corner, bool base) {
            return cells.depth(c, k, corner, base);
        };
        const auto [p0, p1] =
            std::minmax({depth(wall.corner_p[side], false), depth(wall.corner_p[side], true)});
        const auto [q0, q1] =
            std::minmax({depth(wall.corner_q[side], false), depth(wall.corner_q[side], true)});
        edges.push_back({p0, q0, k, false, side});
        edges.push_back({p1, q1, k, true, side});
    }
}

/// Returns the numbers of the edges from above, as they meet a line. At one depth a cell ends before
/// the next one begins.
std::vector<std::size_t> order_on(const std::vector<CellEdge>& edges,
                                  const std::vector<double>& depths) {
    std::vector<std::size_t> order(edges.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t e) {
        return std::tuple(depths[e], edges[e].k, edges[e].base, edges[e].side);
    });
    return order;
}

/// Tells what lies between two successive edges.
class StripJudge {
public:
    StripJudge(const CornerPointGrid& grid, const Wall& wall) : cells_(grid), wall_(wall) {
        for (const unsigned side : {0U, 1U})
            for (std::uint32_t k = 0; wall.columns[side] && k < grid.nz && !exists_[side]; ++k)
                exists_[side] = cells_.active(*wall.columns[side], k);
    }

    [[nodiscard]] StripKind kind(const std::array<Cell, 2>& at) const {
        if (!at[0] && !at[1]) return StripKind::none;
        if (at[0] == at[1]) return is_torn(*at[0]) ? StripKind::fault : StripKind::none;
        if (at[0] && at[1]) return StripKind::fault;
        const unsigned other = at[0] ? 1 : 0;
        if (!exists_[other]) return StripKind::side;
        return cells_.active(*wall_.columns[other], *at[1 - other]) ? StripKind::fault
                                                                    : StripKind::side;
    }

    /// Returns the kinds between successive edges in this order.
    [[nodiscard]] std::vector<StripKind> kinds(const std::vector<CellEdge>& edges,
                                               const std::vector<std::size_t>& order) const {
        std::vector<StripKind> kinds;
        std::array<Cell, 2> at;
        for (const std::size_t n : order) {
            const CellEdge& e = edges[n];
            if (!e.base)
                at[e.side] = e.k;
            else if (at[e.side] == e.k)
                at[e.side].reset();
            kinds.push_back(kind(at));
        }
        return kinds;
    }

private:
    /// Tells whether the cells of a layer, active on both sides, have different corners on the wall.
    [[nodiscard]] bool is_torn(std::uint32_t k) const {
        const auto depth = [&](unsigned side, unsigned corner, bool base) {
            return cells_.depth(*wall_.columns.at(side), k, corner, base);
        };
        for (const bool base : {false, true})
            if (depth(0, wall_.corner_p[0], base) != depth(1, wall_.corner_p[1], base) ||
                depth(0, wall_.corner_q[0], base) != depth(1, wall_.corner_q[1], base))
                return true;
        return false;
    }

    Cells cells_;
    const Wall& wall_;
    std::array<bool, 2> exists_{};
};

/// Tells whether two columns have the same cells with the same corners on the wall.
bool continuous(const std::vector<CellEdge>& first, const std::vector<CellEdge>& second) {
    return std::ranges::equal(first, second, [](const CellEdge& a, const CellEdge& b) {
        return a.p == b.p && a.q == b.q && a.k == b.k;
    });
}

/// A place at which an edge of the first column crosses one of the second.
struct Crossing {
    double share = 0; ///< of both edges before it
    std::size_t first = 0, second = 0;
};

std::vector<Crossing> crossings_of(const std::vector<CellEdge>& edges, std::size_t first_count) {
    constexpr std::size_t most_pairs = std::size_t{1} << 24U;
    std::vector<Crossing> crossings;
    if (first_count * (edges.size() - first_count) > most_pairs) return crossings;
    for (std::size_t a = 0; a < first_count; ++a)
        for (std::size_t b = first_count; b < edges.size(); ++b) {
            const double at_p = edges[a].p - edges[b].p, at_q = edges[a].q - edges[b].q;
            if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
                crossings.push_back({at_p / (at_p - at_q), a, b});
        }
    return crossings;
}

/// Adds the lines through all crossings, or none if they are too many.
void add_lines(WallEdges& wall, const std::vector<Crossing>& crossings) {
    constexpr std::size_t most_lines = 1024;
    std::vector<double> inner;
    for (const Crossing& c : crossings)
        if (c.share > 0 && c.share < 1) inner.push_back(c.share);
    std::ranges::sort(inner);
    inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
    if (inner.size() > most_lines) inner.clear();
    for (const double share : inner) {
        wall.shares.push_back(share);
        std::vector<double>& depths = wall.depths.emplace_back();
        for (const CellEdge& e : wall.edges) depths.push_back(e.p + share * (e.q - e.p));
    }
    for (const Crossing& c : crossings) {
        const auto line = std::ranges::find(wall.shares, c.share);
        if (line == wall.shares.begin() || line == wall.shares.end()) continue;
        std::vector<double>& depths =
            wall.depths[static_cast<std::size_t>(line - wall.shares.begin())];
        depths[c.second] = depths[c.first];
    }
}

} // namespace

std::size_t wall_count(const CornerPointGrid& grid) {
    const std::size_t nx = grid.nx, ny = grid.ny;
    return (nx + 1) * ny + nx * (ny + 1);
}

std::size_t wall_of(const CornerPointGrid& grid, const NamedFace& face) {
    const std::size_t nx = grid.nx, i = face.i, j = face.j;
    return face.across_i ? j * (nx + 1) + i : (nx + 1) * grid.ny + j * nx + i;
}

Wall wall_at(const CornerPointGrid& grid, std::size_t w) {
    const std::size_t across_i = (std::size_t{grid.nx} + 1) * grid.ny;
    const bool along_i = w >= across_i;
    const std::size_t row = along_i ? grid.nx : grid.nx + std::size_t{1};
    const std::size_t index = along_i ? w - across_i : w;
    const auto i = static_cast<std::uint32_t>(index % row);
    const auto j = static_cast<std::uint32_t>(index / row);
    Wall wall;
    wall.p = std::size_t{j} * (std::size_t{grid.nx} + 1) + i;
    if (along_i) {
        wall.q = wall.p + 1;
        if (j > 0) wall.columns[0] = Column{i, j - 1};
        if (j < grid.ny) wall.columns[1] = Column{i, j};
        wall.corner_p = {2, 0};
        wall.corner_q = {3, 1};
    } else {
        wall.q = wall.p + grid.nx + 1;
        if (i > 0) wall.columns[0] = Column{i - 1, j};
        if (i < grid.nx) wall.columns[1] = Column{i, j};
        wall.corner_p = {1, 0};
        wall.corner_q = {3, 2};
    }
    return wall;
}

WallEdges edges_on(const CornerPointGrid& grid, const Wall& wall) {
    const Cells cells(grid);
    WallEdges result;
    std::vector<CellEdge> second;
    append_edges(cells, wall, 0, grid.nz, result.edges);
    append_edges(cells, wall, 1, grid.nz, second);
    if (continuous(result.edges, second)) return {};
    const std::size_t first_count = result.edges.size();
    result.edges.insert(result.edges.end(), second.begin(), second.end());
    std::vector<double> on_p, on_q;
    for (const CellEdge& e : result.edges) {
        on_p.push_back(e.p);
        on_q.push_back(e.q);
    }
    result.shares.push_back(0);
    result.depths.push_back(std::move(on_p));
    add_lines(result, crossings_of(result.edges, first_count));
    result.shares.push_back(1);
    result.depths.push_back(std::move(on_q));
    return result;
}

std::vector<Strip> strips_of(const CornerPointGrid& grid, const Wall& wall, const WallEdges& edges,
                             std::size_t n) {
    const auto &depths_p = edges.depths[n], &depths_q = edges.depths[n + 1];
    const auto on_p = order_on(edges.edges, depths_p), on_q = order_on(edges.edges, depths_q);
    const StripJudge judge(grid, wall);
    const auto kinds_p = judge.kinds(edges.edges, on_p), kinds_q = judge.kinds(edges.edges, on_q);
    std::vector<Strip> strips;
    for (std::size_t i = 0; i + 1 < on_p.size(); ++i) {
        Strip strip;
        strip.p = {depths_p[on_p[i]], depths_p[on_p[i + 1]]};
        strip.q = {depths_q[on_q[i]], depths_q[on_q[i + 1]]};
        for (const auto& [kind, ends] :
             {std::pair(kinds_p[i], strip.p), std::pair(kinds_q[i], strip.q)}) {
            if (ends[0] == ends[1] || kind == StripKind::none) continue;
            if (strip.kind != StripKind::fault) strip.kind = kind;
        }
        if (strip.kind != StripKind::none) strips.push_back(strip);
    }
    return strips;
}

std::vector<double> depths_on_pillar(const CornerPointGrid& grid, std::size_t pillar) {
    const Cells cells(grid);
    const std::size_t row = std::size_t{grid.nx} + 1;
    const std::size_t i = pillar % row, j = pillar / row;
    std::vector<double> depths;
    for (const unsigned corner : {0U, 1U, 2U, 3U}) {
        const std::size_t a = corner % 2, b = corner / 2;
        if (i < a || j < b || i - a >= grid.nx || j - b >= grid.ny) continue;
        const Column c{static_cast<std::uint32_t>(i - a), static_cast<std::uint32_t>(j - b)};
        for (std::uint32_t k = 0; k < grid.nz; ++k)
            if (cells.active(c, k))
                for (const bool base : {false, true})
                    depths.push_back(cells.depth(c, k, corner, base));
    }
    std::ranges::sort(depths);
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
    return depths;
}

} // namespace terrane::grids::detail
