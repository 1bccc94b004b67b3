// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/detail/pool_covers.hpp>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <terrane/kernel/predicates.hpp>

namespace terrane::arrangement::detail {
namespace {

using Local = FaceTriangulation::Local;
using Cell = FaceTriangulation::Cell;
constexpr std::uint32_t no_number = UINT32_MAX;

std::uint64_t edge_key(Local a, Local b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// Walks over the triangulation from the frame inwards. The triangles that contain a part change
/// only where the walk crosses their edges.
class PoolCovers {
public:
    PoolCovers(UpwardWitness upward, const TriangleSoup& soup, std::span<const std::uint32_t> faces,
               const PointStore& store, const PointOrder& order, const FaceInput& input,
               const FaceTriangulation& triangulation) :
        upward_(upward),
        soup_(soup), faces_(faces), store_(store), order_(order), input_(input),
        cells_(triangulation.cells()), points_(triangulation.points()),
        segment_edges_(triangulation.segment_edges()) {}

    PoolDivision operator()() {
        list_edges();
        list_ups();
        list_toggles();
        walk();
        if (input_.stop.stop_requested()) return {};
        write_parts();
        return std::move(out_);
    }

private:
    /// An edge of a line as seen from its lower end.
    struct Up {
        Local low, high;
        std::uint32_t line, edge;
    };
    /// A cell still to be reached across an edge.
    struct Entry {
        Local cell;
        std::uint32_t cover, edge;
    };

    [[nodiscard]] std::uint32_t rank(Local p) const { return order_.rank[points_[p]]; }

    [[nodiscard]] std::uint32_t edge_between(Local a, Local b) const {
        const auto at = std::lower_bound(edges_.begin(), edges_.end(), edge_key(a, b));
        if (at == edges_.end() || *at != edge_key(a, b)) return no_number;
        return static_cast<std::uint32_t>(at - edges_.begin());
    }

    void list_edges() {
        edges_.reserve(segment_edges_.size());
        for (const auto& s : segment_edges_) edges_.push_back(edge_key(s.ends[0], s.ends[1]));
        std::sort(edges_.begin(), edges_.end());
        edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    }

    void list_ups() {
        for (const auto& s : segment_edges_) {
            auto [low, high] = s.ends;
            if (rank(high) < rank(low)) std::swap(low, high);
            ups_.push_back({low, high, input_.segment_lines[s.segment], edge_between(low, high)});
        }
        std::sort(ups_.begin(), ups_.end(), [](const Up& a, const Up& b) {
            return std::pair{a.low, a.line} < std::pair{b.low, b.line};
        });
        first_up_.assign(points_.size() + 1, 0);
        for (const Up& up : ups_) ++first_up_[up.low + 1];
        for (std::size_t p = 0; p < points_.size(); ++p) first_up_[p + 1] += first_up_[p];
    }

    [[nodiscard]] std::span<const Up> ups(Local p) const {
        return std::span(ups_).subspan(first_up_[p], first_up_[p + 1] - first_up_[p]);
    }

    /// Returns the edge from p towards `end`, which is higher, on this line if that has one.
    [[nodiscard]] const Up& up_towards(Local p, Local end, std::uint32_t line) const {
        const auto at_p = ups(p);
        const auto found =
            std::lower_bound(at_p.begin(), at_p.end(), line,
                             [](const Up& u, std::uint32_t l) { return u.line < l; });
        if (found != at_p.end() && found->line == line) return *found;
        for (const Up& up : at_p)
            if (up.high == end || is_towards(p, up.high, end)) return up;
        throw std::logic_error("an edge of a pool is not on its segments");
    }

    /// Whether b is on the line through a and c, where b and c are both higher than a.
    [[nodiscard]] bool is_towards(Local a, Local b, Local c) const {
        const auto at = [&](Local p) { return store_.approximate(input_.axis, points_[p]); };
        const auto quick = filtered_orient2d(at(a), at(b), at(c));
        if (quick) return *quick == Sign::Zero;
        return store_.orient2d(upward_, input_.axis, points_[a], points_[b], points_[c]) ==
               Sign::Zero;
    }

    void list_toggles() {
        std::vector<std::pair<PointIndex, Local>> names;
        for (Local p = 3; p < points_.size(); ++p) names.emplace_back(points_[p], p);
        std::sort(names.begin(), names.end());
        const auto local = [&](PointIndex p) {
            const std::pair<PointIndex, Local> key{order_.same_as[p], 0};
            return std::lower_bound(names.begin(), names.end(), key)->second;
        };
        std::vector<std::array<std::uint32_t, 2>> toggles; // edge, face
        for (const std::uint32_t f : faces_)
            for (unsigned e = 0; e < 3; ++e) {
                const Triangle& t = soup_.triangles[f];
                Local p = local(t[e]), end = local(t[(e + 1) % 3]);
                if (rank(end) < rank(p)) std::swap(p, end);
                for (std::uint32_t line = no_number; p != end;) {
                    const Up& up = up_towards(p, end, line);
                    toggles.push_back({up.edge, f});
                    line = up.line;
                    p = up.high;
                }
            }
        std::sort(toggles.begin(), toggles.end());
        auto next = toggles.begin();
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            for (; next != toggles.end() && (*next)[0] == e; ++next)
                toggles_.values.push_back((*next)[1]);
            toggles_.close();
        }
    }

    void walk() {
        cover_of_.assign(cells_.size(), no_number);
        const auto at_frame = [](const Cell& c) { return std::min({c.v[0], c.v[1], c.v[2]}) < 3; };
        const auto start = std::find_if(cells_.begin(), cells_.end(), at_frame);
        out_.covers.close(); // outside, nothing contains a part
        flood(static_cast<Local>(start - cells_.begin()), 0);
        std::vector<std::uint32_t> cover;
        while (!entries_.empty() && !input_.stop.stop_requested()) {
            const Entry entry = entries_.back();
            entries_.pop_back();
            if (cover_of_[entry.cell] != no_number) continue;
            const auto before = out_.covers[entry.cover];
            const auto toggled = toggles_[entry.edge];
            cover.clear();
            std::set_symmetric_difference(before.begin(), before.end(), toggled.begin(),
                                          toggled.end(), std::back_inserter(cover));
            const auto fresh = static_cast<std::uint32_t>(out_.covers.size());
            out_.covers.push_back(cover);
            flood(entry.cell, fresh);
        }
    }

    /// Visits all cells that no edge of a triangle of the pool separates from this one.
    void flood(Local cell, std::uint32_t cover) {
        cover_of_[cell] = cover;
        todo_.assign(1, cell);
        while (!todo_.empty()) {
            const Cell& c = cells_[todo_.back()];
            todo_.pop_back();
            for (unsigned i = 0; i < 3; ++i) {
                const Local beyond = c.n[i];
                if (beyond == FaceTriangulation::none || cover_of_[beyond] != no_number) continue;
                const std::uint32_t edge =
                    c.fixed[i] ? edge_between(c.v[(i + 1) % 3], c.v[(i + 2) % 3]) : no_number;
                if (edge != no_number && !toggles_[edge].empty()) {
                    entries_.push_back({beyond, cover, edge});
                    continue;
                }
                cover_of_[beyond] = cover;
                todo_.push_back(beyond);
            }
        }
    }

    void write_parts() {
        for (Local k = 0; k < cells_.size(); ++k) {
            const auto cover = out_.covers[cover_of_[k]];
            if (cover.empty()) continue;
            const Triangle& t = soup_.triangles[cover.front()];
            const auto& v = cells_[k].v;
            std::array<PointIndex, 3> corners{points_[v[0]], points_[v[1]], points_[v[2]]};
            if (orient2d(input_.axis, soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]]) ==
                Sign::Negative)
                std::swap(corners[1], corners[2]);
            if (std::is_permutation(t.begin(), t.end(), corners.begin())) corners = t;
            out_.parts.push_back({cover.front(), cover_of_[k], corners});
        }
        std::stable_sort(out_.parts.begin(), out_.parts.end(),
                         [](const PoolPart& a, const PoolPart& b) { return a.face < b.face; });
    }

    [[no_unique_address]] UpwardWitness upward_;
    const TriangleSoup& soup_;
    std::span<const std::uint32_t> faces_;
    const PointStore& store_;
    const PointOrder& order_;
    const FaceInput& input_;
    std::span<const Cell> cells_;
    std::span<const PointIndex> points_;
    std::span<const FaceTriangulation::SegmentEdge> segment_edges_;
    std::vector<std::uint64_t> edges_;    ///< keys of the edges on segments, sorted
    std::vector<Up> ups_;                 ///< by lower end and line
    std::vector<std::uint32_t> first_up_; ///< per point, and the end
    IndexLists<std::uint32_t> toggles_;   ///< per edge: faces whose border contains it, ascending
    std::vector<std::uint32_t> cover_of_; ///< per cell
    std::vector<Entry> entries_;
    std::vector<Local> todo_;
    PoolDivision out_;
};

} // namespace

// The triangle is 16 times as large as the box, which leaves room for the roundings of its corners.
Frame frame_round(const PointStore& points, Axis axis, std::span<const PointIndex> inside) {
    auto p = points.approximate(axis, inside.front());
    std::array low{p.u, p.v}, high = low;
    for (const PointIndex i : inside) {
        p = points.approximate(axis, i);
        low = {std::min(low[0], p.u), std::min(low[1], p.v)};
        high = {std::max(high[0], p.u), std::max(high[1], p.v)};
    }
    const double u = low[0] + (high[0] - low[0]) / 2, v = low[1] + (high[1] - low[1]) / 2;
    const double size = std::max(high[0] - low[0], high[1] - low[1]);
    return {{u - 16 * size, u + 16 * size, u}, {v - 8 * size, v - 8 * size, v + 24 * size}};
}

PoolDivision covers_of_pool(UpwardWitness upward, const TriangleSoup& soup,
                            std::span<const std::uint32_t> faces, const PointStore& points,
                            const PointOrder& order, const FaceInput& input,
                            const FaceTriangulation& triangulation) {
    return PoolCovers(upward, soup, faces, points, order, input, triangulation)();
}

} // namespace terrane::arrangement::detail
