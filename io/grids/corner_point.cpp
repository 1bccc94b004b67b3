// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/corner_point.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/io/grids/detail/grid_walls.hpp>

namespace terrane {

using namespace grids::detail;

namespace {

/// A place on a pillar.
struct Corner {
    std::size_t pillar = 0;
    double depth = 0;

    friend bool operator==(const Corner&, const Corner&) = default;
};

struct CornerHash {
    std::size_t operator()(const Corner& c) const {
        const auto bits = std::bit_cast<std::uint64_t>(c.depth == 0 ? 0.0 : c.depth);
        const std::uint64_t h = (bits ^ (c.pillar * 0x9E3779B97F4A7C15U)) * 0xBF58476D1CE4E5B9U;
        return h ^ (h >> 31U);
    }
};

/// Knows where corners are. Lines across walls, where edges cross, are numbered after the pillars.
class Places {
public:
    explicit Places(const CornerPointGrid& grid) : grid_(grid) {}

    [[nodiscard]] Point3 of(const Corner& corner) const {
        const double z = corner.depth == 0 ? 0 : -corner.depth;
        if (corner.pillar >= grid_.pillars.size()) {
            const auto& [x, y] = on_lines_.at(corner);
            return {x, y, z};
        }
        const auto& [x0, y0, z0, x1, y1, z1] = grid_.pillars[corner.pillar];
        if (corner.depth == z0 || z0 == z1 || (x0 == x1 && y0 == y1)) return {x0, y0, z};
        if (corner.depth == z1) return {x1, y1, z};
        const double t = (corner.depth - z0) / (z1 - z0);
        return {x0 + t * (x1 - x0), y0 + t * (y1 - y0), z};
    }

    /// Places a corner on a line, at a share of the way from p to q; the first place counts.
    void add(const Corner& corner, const Corner& p, const Corner& q, double share) {
        const Point3 from = of(p), to = of(q);
        on_lines_.try_emplace(
            corner, std::array{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
    }

private:
    const CornerPointGrid& grid_;
    std::unordered_map<Corner, std::array<double, 2>, CornerHash> on_lines_;
};

/// Collects the triangles of one surface.
class Patch {
public:
    Patch(const Places& places, std::string name, Role role) : places_(places) {
        surface_.name = std::move(name);
        surface_.role = role;
    }

    void add(const Corner& a, const Corner& b, const Corner& c) {
        if (a == b || b == c || c == a) return;
        surface_.triangles.push_back({number(a), number(b), number(c)});
    }

    /// Moves the surface to the list unless it is empty.
    void move_to(std::vector<Surface>& surfaces) {
        if (!surface_.triangles.empty()) surfaces.push_back(std::move(surface_));
    }

private:
    std::uint32_t number(const Corner& corner) {
        const auto [at, added] =
            numbers_.try_emplace(corner, static_cast<std::uint32_t>(surface_.vertices.size()));
        if (added) surface_.vertices.push_back(places_.of(corner));
        return at->second;
    }

    const Places& places_;
    Surface surface_;
    std::unordered_map<Corner, std::uint32_t, CornerHash> numbers_;
};

/// Numbers of walls, joined where they hang together.
class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t w) {
        while (parent_[w] != w) w = parent_[w] = parent_[parent_[w]];
        return w;
    }
    void join(std::size_t a, std::size_t b) {
        const auto [first, second] = std::minmax({find(a), find(b)});
        parent_[second] = first;
    }

private:
    std::vector<std::size_t> parent_;
};

/// A wall whose edges cross, and the number of its first line after pillar p.
struct CutWall {
    WallEdges edges;
    std::size_t first_line = 0;
};

class GridSurfaces {
public:
    explicit GridSurfaces(const CornerPointGrid& grid) :
        grid_(grid), cells_(grid), places_(grid), mirrored_(is_mirrored()) {}

    Result<std::vector<Surface>> make() {
        cut_walls();
        for (std::uint32_t b = 0; b <= grid_.nz; ++b) add_boundary(b);
        for (Patch& gap : gaps_) gap.move_to(surfaces_);
        add_walls();
        if (surfaces_.empty())
            return Error{ErrorCode::nothing_to_do, "no cell of the grid is active", ""};
        for (Surface& s : surfaces_) {
            s.frame = grid_.frame;
            s.frame.vertical_axis = VerticalAxis::down;
            if (!std::ranges::all_of(s.vertices, [](const Point3& p) { return is_finite(p); }))
                return Error{ErrorCode::bad_number, "a corner of the grid is beyond all doubles",
                             ""};
        }
        return std::move(surfaces_);
    }

private:
    /// Places the corners on the lines of walls whose edges cross.
    void cut_walls() {
        std::size_t next = grid_.pillars.size();
        for (std::size_t w = 0; w < wall_count(grid_); ++w) {
            const Wall wall = wall_at(grid_, w);
            WallEdges on = edges_on(grid_, wall);
            if (on.shares.size() < 3) continue;
            for (std::size_t n = 1; n + 1 < on.shares.size(); ++n)
                for (std::size_t e = 0; e < on.edges.size(); ++e)
                    places_.add({next + n - 1, on.depths[n][e]}, {wall.p, on.edges[e].p},
                                {wall.q, on.edges[e].q}, on.shares[n]);
            const std::size_t lines = on.shares.size() - 2;
            cuts_.emplace(w, CutWall{std::move(on), next});
            next += lines;
        }
    }

    /// Returns the corners within an edge of a cell, from pillar p of the wall to pillar q.
    [[nodiscard]] std::vector<Corner> within(const NamedFace& face, unsigned side, double p,
                                             double q) const {
        std::vector<Corner> corners;
        if (cuts_.empty()) return corners;
        const auto cut = cuts_.find(wall_of(grid_, face));
        if (cut == cuts_.end()) return corners;
        const WallEdges& on = cut->second.edges;
        const auto edge = std::ranges::find_if(
            on.edges, [&](const CellEdge& e) { return e.side == side && e.p == p && e.q == q; });
        if (edge == on.edges.end()) return corners;
        for (std::size_t n = 1; n + 1 < on.shares.size(); ++n)
            corners.push_back({cut->second.first_line + n - 1,
                               on.depths[n][static_cast<std::size_t>(edge - on.edges.begin())]});
        return corners;
    }

    /// Tells whether i, j and up form a left-handed system, as the upper ends of the pillars lie.
    [[nodiscard]] bool is_mirrored() const {
        double area = 0;
        for (std::uint32_t j = 0; j < grid_.ny; ++j)
            for (std::uint32_t i = 0; i < grid_.nx; ++i) {
                const auto& a = grid_.pillars[cells_.pillar({i, j}, 0)];
                const auto& b = grid_.pillars[cells_.pillar({i, j}, 1)];
                const auto& d = grid_.pillars[cells_.pillar({i, j}, 2)];
                area += (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
            }
        return area < 0;
    }

    /// Adds the surface between layers b - 1 and b, counted from 0.
    void add_boundary(std::uint32_t b) {
        Patch patch(places_,
                    b == 0         ? "top"
                    : b < grid_.nz ? fmt::format("layer {}", b + 1)
                                   : "base",
                    Role::horizon);
        Patch gap(places_, fmt::format("layer {} base", b), Role::horizon);
        for (std::uint32_t j = 0; j < grid_.ny; ++j)
            for (std::uint32_t i = 0; i < grid_.nx; ++i) {
                const Column c{i, j};
                const bool below = b < grid_.nz && cells_.active(c, b);
                const bool above = b > 0 && cells_.active(c, b - 1);
                if (below) add_face(c, cells_.face(c, b, false), patch);
                if (!above) continue;
                const auto base = cells_.face(c, b - 1, true);
                if (!below)
                    add_face(c, base, patch);
                else if (base != cells_.face(c, b, false))
                    add_face(c, base, gap);
            }
        patch.move_to(surfaces_);
        gaps_.push_back(std::move(gap));
    }

    /// Adds a quadrilateral over a column, with its front up. Its corners in a circle are 0, 1, 3, 2.
    void add_face(Column c, const std::array<double, 4>& depths, Patch& patch) const {
        std::array<Corner, 4> at;
        for (unsigned k = 0; k < 4; ++k) at[k] = {cells_.pillar(c, k), depths[k]};
        const auto south = within({c.i, c.j, false, 0}, 1, depths[0], depths[1]);
        const auto east = within({c.i + 1, c.j, true, 0}, 0, depths[1], depths[3]);
        auto north = within({c.i, c.j + 1, false, 0}, 0, depths[2], depths[3]);
        auto west = within({c.i, c.j, true, 0}, 1, depths[0], depths[2]);
        std::ranges::reverse(north);
        std::ranges::reverse(west);
        if (std::abs(depths[0] - depths[3]) <= std::abs(depths[1] - depths[2])) {
            add_half({at[0], at[1], at[3]}, south, east, patch);
            add_half({at[3], at[2], at[0]}, north, west, patch);
        } else {
            add_half({at[2], at[0], at[1]}, west, south, patch);
            add_half({at[1], at[3], at[2]}, east, north, patch);
        }
    }

    /// Adds a triangle that has further corners on its first and its second edge.
    void add_half(const std::array<Corner, 3>& corners, std::span<const Corner> on_first,
                  std::span<const Corner> on_second, Patch& patch) const {
        const auto add = [&](const Corner& a, const Corner& b, const Corner& c) {
            mirrored_ ? patch.add(a, c, b) : patch.add(a, b, c);
        };
        Corner before = corners[0];
        for (const Corner& next : on_first) add(std::exchange(before, next), next, corners[2]);
        Corner previous = corners[1];
        for (const Corner& next : on_second) add(before, std::exchange(previous, next), next);
        add(before, previous, corners[2]);
    }

    /// Adds the faults and the sides.
    void add_walls() {
        const std::size_t count = wall_count(grid_);
        std::vector<std::uint32_t> fault_of(count, no_index);
        for (const NamedFace& face : grid_.faces) fault_of[wall_of(grid_, face)] = face.fault;
        std::vector<Patch> faults;
        for (const auto& name : grid_.faults) faults.emplace_back(places_, name, Role::fault);
        number_nameless(fault_of, faults);
        Patch sides(places_, "sides", Role::boundary);
        for (std::size_t w = 0; w < count; ++w) {
            const Wall wall = wall_at(grid_, w);
            const WallEdges on = edges_on(grid_, wall);
            if (on.edges.empty()) continue;
            const auto cut = cuts_.find(w);
            for (std::size_t n = 0; n + 1 < on.shares.size(); ++n) {
                const std::size_t line = cut == cuts_.end() ? 0 : cut->second.first_line + n;
                const bool begins = n == 0, ends = n + 2 == on.shares.size();
                const Line p{begins ? wall.p : line - 1, corners_on(wall.p, on, n)};
                const Line q{ends ? wall.q : line, corners_on(wall.q, on, n + 1)};
                for (const Strip& strip : strips_of(grid_, wall, on, n))
                    add_strip(strip, p, q,
                              strip.kind == StripKind::side ? sides : faults[fault_of[w]]);
            }
        }
        for (Patch& fault : faults) fault.move_to(surfaces_);
        sides.move_to(surfaces_);
    }

    /// Numbers the walls with parts of faults that have no name; those that hang together by pillars
    /// get one number.
    void number_nameless(std::vector<std::uint32_t>& fault_of, std::vector<Patch>& faults) const {
        const std::size_t count = fault_of.size();
        Groups groups(count);
        std::vector<std::size_t> wall_on(grid_.pillars.size(), count); // the last one so far
        std::vector<std::size_t> nameless;
        for (std::size_t w = 0; w < count; ++w) {
            const Wall wall = wall_at(grid_, w);
            if (fault_of[w] != no_index || !has_fault(wall)) continue;
            nameless.push_back(w);
            for (const std::size_t pillar : {wall.p, wall.q})
                if (const auto other = std::exchange(wall_on[pillar], w); other != count)
                    groups.join(w, other);
        }
        for (const std::size_t w : nameless) {
            const std::size_t first = groups.find(w); // the first of its group
            if (first == w) {
                fault_of[w] = static_cast<std::uint32_t>(faults.size());
                const auto number = faults.size() - grid_.faults.size() + 1;
                faults.emplace_back(places_, fmt::format("fault {}", number), Role::fault);
            } else {
                fault_of[w] = fault_of[first];
            }
        }
    }

    [[nodiscard]] bool has_fault(const Wall& wall) const {
        const WallEdges on = edges_on(grid_, wall);
        for (std::size_t n = 0; n + 1 < on.shares.size(); ++n)
            for (const Strip& strip : strips_of(grid_, wall, on, n))
                if (strip.kind == StripKind::fault) return true;
        return false;
    }

    /// A pillar or another line across a wall, with the depths of all corners on it, in order.
    struct Line {
        std::size_t number = 0;
        std::vector<double> depths;
    };

    /// Returns the depths of all corners on a line of a wall, in order.
    [[nodiscard]] std::vector<double> corners_on(std::size_t pillar, const WallEdges& on,
                                                 std::size_t n) const {
        if (n == 0 || n + 1 == on.shares.size()) return depths_on_pillar(grid_, pillar);
        auto depths = on.depths[n];
        std::ranges::sort(depths);
        depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
        return depths;
    }

    /// Adds the triangles between two chords.
    static void add_strip(const Strip& strip, const Line& line_p, const Line& line_q,
                          Patch& patch) {
        const auto within = [](std::span<const double> depths, const std::array<double, 2>& ends) {
            const auto first = std::ranges::lower_bound(depths, ends[0]);
            const auto last = std::ranges::upper_bound(depths, ends[1]);
            return std::span(first, last);
        };
        const auto p = within(line_p.depths, strip.p), q = within(line_q.depths, strip.q);
        std::size_t a = 0, b = 0;
        while (a + 1 < p.size() || b + 1 < q.size()) {
            const bool down_p = b + 1 == q.size() || (a + 1 < p.size() && p[a + 1] <= q[b + 1]);
            const Corner next =
                down_p ? Corner{line_p.number, p[a + 1]} : Corner{line_q.number, q[b + 1]};
            patch.add({line_p.number, p[a]}, {line_q.number, q[b]}, next);
            ++(down_p ? a : b);
        }
    }

    const CornerPointGrid& grid_;
    Cells cells_;
    Places places_;
    bool mirrored_;
    std::unordered_map<std::size_t, CutWall> cuts_; ///< by number of the wall
    std::vector<Surface> surfaces_;
    std::vector<Patch> gaps_;
};

} // namespace

Result<std::vector<Surface>> surfaces_of_corner_points(const CornerPointGrid& grid) {
    return GridSurfaces(grid).make();
}

Result<std::vector<Point3>> cell_centres(const CornerPointGrid& grid) {
    const Cells cells(grid);
    const Places places(grid);
    std::vector<Point3> centres;
    centres.reserve(std::size_t{grid.nx} * grid.ny * grid.nz);
    for (std::uint32_t k = 0; k < grid.nz; ++k)
        for (std::uint32_t j = 0; j < grid.ny; ++j)
            for (std::uint32_t i = 0; i < grid.nx; ++i) {
                Point3 mean{0, 0, 0};
                for (unsigned c = 0; c < 8; ++c) {
                    const Point3 p = places.of(
                        {cells.pillar({i, j}, c % 4), cells.depth({i, j}, k, c % 4, c >= 4)});
                    mean = {mean.x + p.x / 8, mean.y + p.y / 8, mean.z + p.z / 8};
                }
                if (!is_finite(mean))
                    return Error{ErrorCode::bad_number,
                                 "a corner of the grid is beyond all doubles", ""};
                centres.push_back(mean);
            }
    return centres;
}

} // namespace terrane
