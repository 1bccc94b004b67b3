// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Defines the functions of FaceTriangulation that insert segments into a triangulation of the
// points. Source: Sloan (1993).
#include <terrane/algorithms/triangulation/triangulation.hpp>

#include <terrane/algorithms/triangulation/detail/corners.hpp>

namespace terrane {

using namespace triangulation::detail;

void FaceTriangulation::fix(Side s) {
    cells_[s.cell].fixed[s.i] = true;
    const Local o = cells_[s.cell].n[s.i];
    if (o != none) cells_[o].fixed[index_in(o, s.cell)] = true;
}

// Inserts a segment vertex by vertex, because it may pass through other points.
void FaceTriangulation::insert_segment(std::uint32_t segment) {
    auto [u, v] = segments_[segment];
    while (u != v) {
        Local reached = none;
        if (!advance(u, v, reached)) remove_crossed(u, reached);
        if (frame_ != nullptr) segment_edges_.push_back({segment, {u, reached}});
        u = reached;
    }
}

// Searches the cells around u for the segment to v. Returns true if the edge from u to `reached`,
// which is part of the segment, exists already; false if the edges now in crossed_ lie between u
// and `reached`.
bool FaceTriangulation::advance(Local u, Local v, Local& reached) {
    // The search visits the cells counterclockwise, and from the border on clockwise, for the one
    // whose corner at u contains the direction to v.
    const auto corner = [&](Local cell) {
        const auto& w = cells_[cell].v;
        return w[0] == u ? 0u : w[1] == u ? 1u : 2u;
    };
    const Local begin = cell_of_[u];
    bool clockwise = false;
    for (Local cell = begin;;) {
        const unsigned k = corner(cell);
        const Cell& c = cells_[cell];
        const Local a = c.v[next(k)], b = c.v[previous(k)];
        if (a == v || b == v) {
            reached = v;
            fix({cell, a == v ? previous(k) : next(k)});
            return true;
        }
        const Sign right = turn(u, a, v), left = turn(u, v, b);
        // The angle of the corner is less than a straight angle. If both signs are >= 0, v lies
        // within it, or one of its sides points towards v.
        if (right == Sign::Zero && left == Sign::Positive) {
            reached = a;
            fix({cell, previous(k)});
            return true;
        }
        if (left == Sign::Zero && right == Sign::Positive) {
            reached = b;
            fix({cell, next(k)});
            return true;
        }
        if (right == Sign::Positive && left == Sign::Positive) {
            collect_crossed(u, v, {cell, k}, reached);
            return false;
        }
        Local onward = clockwise ? c.n[previous(k)] : c.n[next(k)];
        if (onward == none && !clockwise) {
            clockwise = true;
            const unsigned b0 = corner(begin);
            onward = cells_[begin].n[previous(b0)];
        }
        if (onward == none) throw std::logic_error("a segment leaves its triangle");
        cell = onward;
    }
}

// Walks from u towards v across edges until a vertex lies on the segment, and returns it in
// `reached`.
void FaceTriangulation::collect_crossed(Local u, Local v, Side first, Local& reached) {
    crossed_.clear();
    Side s = first;
    for (;;) {
        const Cell& c = cells_[s.cell];
        if (c.fixed[s.i]) throw std::logic_error("two segments of a triangle cross");
        crossed_.push_back({c.v[next(s.i)], c.v[previous(s.i)]}); // right end, left end
        const Local o = c.n[s.i];
        const unsigned j = index_in(o, s.cell);
        const Local apex = cells_[o].v[j];
        if (apex == v) {
            reached = v;
            return;
        }
        const Sign side = turn(u, v, apex);
        if (side == Sign::Zero) {
            reached = apex;
            return;
        }
        // In o = (apex, left end, right end) the walk continues across the edge through which the
        // segment leaves the cell.
        s = {o, side == Sign::Positive ? next(j) : previous(j)};
    }
}

bool FaceTriangulation::is_convex(Side s) const {
    const Cell& c = cells_[s.cell];
    const Local o = c.n[s.i];
    const Local p = c.v[s.i], a = c.v[next(s.i)], b = c.v[previous(s.i)];
    const Local q = cells_[o].v[index_in(o, s.cell)];
    return turn(p, a, q) == Sign::Positive && turn(q, b, p) == Sign::Positive;
}

// Flips crossed edges until none crosses the segment (Sloan), then restores the Delaunay property
// around the new edges.
void FaceTriangulation::remove_crossed(Local u, Local v) {
    const auto side_of = [&](const std::array<Local, 2>& e) {
        // Finds a cell that has both ends; e[0] lies to the right of the segment, seen from u.
        Local cell = cell_of_[e[0]];
        const Local begin = cell;
        bool clockwise = false;
        for (;;) {
            const auto& w = cells_[cell].v;
            const unsigned k = w[0] == e[0] ? 0u : w[1] == e[0] ? 1u : 2u;
            if (w[next(k)] == e[1]) return Side{cell, previous(k)};
            if (w[previous(k)] == e[1]) return Side{cell, next(k)};
            Local onward = clockwise ? cells_[cell].n[previous(k)] : cells_[cell].n[next(k)];
            if (onward == none) {
                clockwise = true;
                const auto& first = cells_[begin].v;
                const unsigned f = first[0] == e[0] ? 0u : first[1] == e[0] ? 1u : 2u;
                onward = cells_[begin].n[previous(f)];
            }
            cell = onward;
        }
    };
    std::vector<std::array<Local, 2>> made;
    std::size_t head = 0;
    while (head < crossed_.size()) {
        const auto e = crossed_[head++];
        const Side s = side_of(e);
        if (!is_convex(s)) {
            crossed_.push_back(e);
            continue;
        }
        flip(s);
        const Local p = cells_[s.cell].v[0], q = cells_[s.cell].v[2];
        const bool reaches = p == u || p == v || q == u || q == v;
        if (reaches || turn(u, v, p) * turn(u, v, q) == Sign::Positive) {
            made.push_back({p, q});
        } else {
            const bool p_left = turn(u, v, p) == Sign::Positive;
            crossed_.push_back(p_left ? std::array{q, p} : std::array{p, q});
        }
    }
    for (const auto& e : made) {
        const Side s = side_of(e);
        const bool is_segment = (e[0] == u && e[1] == v) || (e[0] == v && e[1] == u);
        if (is_segment)
            fix(s);
        else
            legalise_later(s);
    }
    legalise();
}

} // namespace terrane
