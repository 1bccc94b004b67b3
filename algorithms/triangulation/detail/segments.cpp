// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Defines the functions of FaceTriangulation that insert segments into a triangulation of the
// points: the cells that a segment crosses are removed, and the polygons on its two sides are
// triangulated by a Graham scan, which takes linear time as all their points see the segment.
// Source: Avis and Toussaint (1982).
#include <terrane/algorithms/triangulation/triangulation.hpp>

#include <algorithm>
#include <stdexcept>

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
        if (!advance(u, v, reached)) replace_crossed();
        if (frame_ != nullptr) segment_edges_.push_back({segment, {u, reached}});
        u = reached;
    }
}

// Searches the cells around u for the segment to v. Returns true if the edge from u to `reached`,
// which is part of the segment, exists already; false if the cells now in crossed_ lie between u
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
            cross(u, v, {cell, k}, reached);
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

FaceTriangulation::Rim FaceTriangulation::rim_at(Side s) const {
    const Cell& c = cells_[s.cell];
    const Local beyond = c.n[s.i];
    return {{beyond, beyond == none ? 0 : index_in(beyond, s.cell)}, c.fixed[s.i]};
}

// Walks from u towards v across edges until a vertex lies on the segment, and returns it in
// `reached`. Lists the cells on the way and their outer edges on both sides.
void FaceTriangulation::cross(Local u, Local v, Side first, Local& reached) {
    const auto extend = [&](Polygon& polygon, Side s, Local to) {
        polygon.rims.push_back(rim_at(s));
        polygon.points.push_back(to);
    };
    const Cell& c = cells_[first.cell];
    for (Polygon* polygon : {&left_, &right_}) polygon->start(u);
    extend(left_, {first.cell, next(first.i)}, c.v[previous(first.i)]);
    extend(right_, {first.cell, previous(first.i)}, c.v[next(first.i)]);
    crossed_.assign(1, first.cell);
    for (Side s = first;;) {
        if (cells_[s.cell].fixed[s.i]) throw std::logic_error("two segments of a triangle cross");
        const Local o = cells_[s.cell].n[s.i];
        const unsigned j = index_in(o, s.cell);
        const Local apex = cells_[o].v[j];
        const Sign side = apex == v ? Sign::Zero : turn(u, v, apex);
        crossed_.push_back(o);
        // In o = (apex, left end, right end) the walk continues across the edge through which the
        // segment leaves the cell.
        if (side != Sign::Negative) extend(left_, {o, previous(j)}, apex);
        if (side != Sign::Positive) extend(right_, {o, next(j)}, apex);
        if (side == Sign::Zero) {
            reached = apex;
            return;
        }
        s = {o, side == Sign::Positive ? next(j) : previous(j)};
    }
}

// Makes new cells of the crossed ones, which meet along the segment and are Delaunay apart from it.
void FaceTriangulation::replace_crossed() {
    constexpr Local removed = none - 1;
    for (const Local cell : crossed_) cells_[cell].v[0] = removed;
    // Both sides of an edge may have been crossed. Its two new cells then find each other by its ends.
    for (Polygon* polygon : {&left_, &right_})
        for (Rim& rim : polygon->rims)
            if (rim.beyond.cell != none && cells_[rim.beyond.cell].v[0] == removed)
                rim.is_slit = true;
    std::ranges::reverse(left_.points); // so that the polygon lies to the left of its edges, too
    std::ranges::reverse(left_.rims);
    slits_.clear();
    const Side left = fill(left_), right = fill(right_);
    join(left, {right, true});
    legalise();
}

// Divides a polygon with the last edge from its last point to its first, which it sees from all of
// its edges. Returns the side of the new cell at that edge.
FaceTriangulation::Side FaceTriangulation::fill(Polygon& polygon) {
    auto& [points, rims] = polygon;
    std::size_t top = 0; // points up to this one are a stack, with their rims between them
    for (std::size_t k = 1; k < points.size(); ++k) {
        Rim rim = rims[k - 1];
        for (; top > 0 && turn(points[top - 1], points[top], points[k]) == Sign::Positive; --top) {
            const Local cell = crossed_.back();
            crossed_.pop_back();
            cells_[cell].v = {points[top - 1], points[top], points[k]};
            for (const Local p : cells_[cell].v) cell_of_[p] = cell;
            join({cell, 0}, rim);
            join({cell, 2}, rims[top - 1]);
            rim = {{cell, 1}, false};
            legalise_later(rim.beyond);
        }
        points[++top] = points[k];
        rims[top - 1] = rim;
    }
    if (top != 1) throw std::logic_error("a segment is not seen from all that it crosses");
    return rims[0].beyond;
}

// Makes two cells neighbours: that of s, and the one beyond the rim.
void FaceTriangulation::join(Side s, Rim rim) {
    Cell& c = cells_[s.cell];
    if (rim.is_slit) {
        const std::array ends{c.v[next(s.i)], c.v[previous(s.i)]};
        const auto mate = std::ranges::find(slits_, std::array{ends[1], ends[0]}, &Slit::ends);
        rim.is_slit = false;
        rim.beyond = {none, 0};
        if (mate == slits_.end()) {
            slits_.push_back({ends, s});
        } else {
            rim.beyond = mate->side;
            *mate = slits_.back();
            slits_.pop_back();
            legalise_later(s);
        }
    }
    c.n[s.i] = rim.beyond.cell;
    c.fixed[s.i] = rim.fixed;
    if (rim.beyond.cell == none) return;
    cells_[rim.beyond.cell].n[rim.beyond.i] = s.cell;
    cells_[rim.beyond.cell].fixed[rim.beyond.i] = rim.fixed;
}

} // namespace terrane
