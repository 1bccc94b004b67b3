// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/triangulation/triangulation.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <terrane/algorithms/triangulation/detail/corners.hpp>

namespace terrane {

using namespace triangulation::detail;

void FaceInput::clear() {
    for (auto& e : edge_points) e.clear();
    inner_points.clear();
    segments.clear();
    segment_lines.clear();
    frame = nullptr;
}

std::span<const std::array<PointIndex, 3>>
FaceTriangulation::operator()(const PointStore& points, std::span<const std::uint32_t> rank,
                              const FaceInput& face) {
    divide(points, rank, face);
    result_.clear();
    for (const Cell& c : cells_) {
        std::array<PointIndex, 3> t{points_[c.v[0]], points_[c.v[1]], points_[c.v[2]]};
        if (is_reversed_) std::swap(t[1], t[2]);
        result_.push_back(t);
    }
    return result_;
}

void FaceTriangulation::divide(const PointStore& points, std::span<const std::uint32_t> rank,
                               const FaceInput& face) {
    store_ = &points;
    rank_ = rank;
    axis_ = face.axis;
    frame_ = face.frame;
    segment_edges_.clear();
    start(face);
    is_reversed_ = cells_[0].v[1] != 1;
    insert_edge_points(face);
    insert_inner_points(face);
    order_segments();
    for (std::uint32_t k = 0; k < segment_order_.size() && !face.stop.stop_requested(); ++k)
        insert_segment(segment_order_[k]);
    if (face.stop.stop_requested()) cells_.clear(); // points or segments may be missing
}

// A counting sort orders the triangles by their second corners, and another one, which is stable, by
// their lowest corners. Two triangles never share both corners, because a directed edge belongs to
// one triangle.
std::span<const std::array<PointIndex, 3>> FaceTriangulation::in_order() {
    sort_points();
    const std::size_t count = points_.size();
    by_second_.assign(count + 1, 0);
    by_lowest_.assign(count + 1, 0);
    turned_.clear();
    for (const Cell& cell : cells_) {
        auto [a, b, c] = cell.v;
        if (is_reversed_) std::swap(b, c);
        std::array<Local, 3> t{positions_[a], positions_[b], positions_[c]};
        if (cells_.size() > 1) t = from_lowest(t);
        turned_.push_back(t);
        ++by_second_[t[1] + 1];
        ++by_lowest_[t[0] + 1];
    }
    for (std::size_t p = 1; p < count; ++p) { // now each is where the triangles of p begin
        by_second_[p] += by_second_[p - 1];
        by_lowest_[p] += by_lowest_[p - 1];
    }
    ordered_.resize(turned_.size());
    for (const auto& t : turned_) ordered_[by_second_[t[1]]++] = t;
    result_.resize(ordered_.size());
    for (const auto& [a, b, c] : ordered_)
        result_[by_lowest_[a]++] = {by_rank_[a], by_rank_[b], by_rank_[c]};
    return result_;
}

void FaceTriangulation::sort_points() {
    constexpr std::size_t many = 512; // points for which sorting digit by digit is faster
    sorted_.clear();
    for (Local p = 0; p < points_.size(); ++p) sorted_.push_back({rank_of(p), p});
    if (sorted_.size() < many) {
        std::ranges::sort(sorted_, {}, &Keyed::key);
    } else {
        const std::uint32_t least = std::ranges::min(sorted_, {}, &Keyed::key).key;
        for (Keyed& k : sorted_) k.key -= least; // fewer digits
        sort_by_key(sorted_, scratch_);
    }
    positions_.resize(points_.size());
    by_rank_.clear();
    for (Local k = 0; k < sorted_.size(); ++k) {
        positions_[sorted_[k].position] = k;
        by_rank_.push_back(points_[sorted_[k].position]);
    }
}

// Starts with one cell, whose edges are the border and therefore fixed.
void FaceTriangulation::start(const FaceInput& face) {
    take_points(face);
    name_points();
    find_lines(face);
    cell_of_.assign(points_.size(), 0);
    cells_.clear();
    todo_.clear();
    const bool positive = turn(0, 1, 2) == Sign::Positive;
    Cell cell;
    cell.v = positive ? std::array<Local, 3>{0, 1, 2} : std::array<Local, 3>{0, 2, 1};
    cell.n = {none, none, none};
    cell.fixed = {true, true, true};
    cells_.push_back(cell);
}

void FaceTriangulation::take_points(const FaceInput& face) {
    points_.clear();
    flat_.clear();
    const auto take = [&](PointIndex p) {
        points_.push_back(p);
        flat_.push_back(approximate(p));
    };
    for (const PointIndex p : face.corners) take(p);
    for (const auto& on_edge : face.edge_points)
        for (const PointIndex p : on_edge) take(p);
    order_inner_points(face);
    for (const Inner& i : inner_) {
        points_.push_back(i.point);
        flat_.push_back(i.at);
    }
}

// Sorts inner points into random levels by a hash, coarse levels first. Within a level points are
// in lexicographic order, or in strips if the level is large. This makes walks short and flips few;
// the resulting triangles do not depend on the order.
void FaceTriangulation::order_inner_points(const FaceInput& face) {
    order_.clear();
    for (const PointIndex p : face.inner_points) {
        const std::uint64_t rank = rank_[p], h = (rank + 1) * 0x9e3779b97f4a7c15u;
        const auto level = static_cast<std::uint64_t>(63 - std::countl_zero(h | 1)) / 2;
        order_.emplace_back(level << 32 | rank, p);
    }
    std::sort(order_.begin(), order_.end());
    inner_.clear();
    for (const auto& [key, p] : order_) inner_.push_back({store_->approximate(axis_, p), p});
    const auto level_of = [&](std::size_t k) { return order_[k].first >> 32; };
    for (std::size_t first = 0, last = 0; first < order_.size(); first = last) {
        while (last < order_.size() && level_of(last) == level_of(first)) ++last;
        sort_into_strips(std::span(inner_).subspan(first, last - first));
    }
}

// Sorts the points of a level into strips that run up and down alternately.
void FaceTriangulation::sort_into_strips(std::span<Inner> level) {
    constexpr std::size_t few = 128; // so few points are close to each other without strips
    if (level.size() < few) return;
    std::sort(level.begin(), level.end(), [](const Inner& a, const Inner& b) {
        return std::tie(a.at.u, a.point) < std::tie(b.at.u, b.point);
    });
    const auto strips = static_cast<std::size_t>(std::sqrt(static_cast<double>(level.size())));
    for (std::size_t k = 0; k < strips; ++k) {
        const std::size_t first = level.size() * k / strips, last = level.size() * (k + 1) / strips;
        const auto strip = level.subspan(first, last - first);
        std::sort(strip.begin(), strip.end(), [](const Inner& a, const Inner& b) {
            return std::tie(a.at.v, a.point) < std::tie(b.at.v, b.point);
        });
        if (k % 2 == 1) std::reverse(strip.begin(), strip.end());
    }
}

namespace {

std::size_t hash(PointIndex p) {
    return (p * 0x9e3779b97f4a7c15u) >> 32;
}

} // namespace

void FaceTriangulation::name_points() {
    slots_.assign(std::bit_ceil(2 * points_.size()), none);
    for (Local p = 0; p < points_.size(); ++p) {
        std::size_t s = hash(points_[p]) & (slots_.size() - 1);
        while (slots_[s] != none) s = (s + 1) & (slots_.size() - 1);
        slots_[s] = p;
    }
}

FaceTriangulation::Local FaceTriangulation::local(PointIndex p) const {
    std::size_t s = hash(p) & (slots_.size() - 1);
    while (points_[slots_[s]] != p) s = (s + 1) & (slots_.size() - 1);
    return slots_[s];
}

// Divides the segments into rounds at random, each with twice as many as the one before. A segment
// then crosses few edges of the triangulation, since the rounds before it have divided the face. The
// segments of nested triangles, inserted by size, or of horizons in a wall, by height, would each cross the
// edges between all others.
// A round keeps the order of its segments, so that consecutive ones are close in memory. The
// triangles do not depend on the order. Sources: Shewchuk and Brown (2015) for random insertion;
// Amenta, Choi and Rote (2003) for rounds.
void FaceTriangulation::order_segments() {
    // Measured: with 8, horizons that cross a wall are divided faster than with more, and all else as fast.
    constexpr std::uint32_t few = 8;
    const auto count = static_cast<std::uint32_t>(segments_.size());
    const int rounds = std::bit_width(count / few);
    segment_order_.clear();
    for (int round = rounds; round >= 0; --round)
        for (std::uint32_t s = 0; s < count; ++s) {
            const std::uint32_t random = (s + 1) * 0x9e3779b1u;
            if (std::min(std::countl_zero(random), rounds) == round) segment_order_.push_back(s);
        }
}

// Cuts each edge in its middle, then its halves, and so on: a point then gets few edges, since those
// before it have divided the face. From one end to the other, all would first be joined to a corner.
void FaceTriangulation::insert_edge_points(const FaceInput& face) {
    Local last = 2; // of the points that are no edge points, or on the edges before
    for (Local e = 0; e < 3; ++e) {
        const auto count = static_cast<Local>(face.edge_points[e].size());
        for (Local step = std::bit_floor(count); step > 0; step /= 2)
            for (Local i = step; i <= count; i += 2 * step) {
                const Local before = i == step ? e : last + i - step;
                const Local after = i + step > count ? (e + 1) % 3 : last + i + step;
                split_edge(border_from(is_reversed_ ? after : before), last + i);
                legalise();
            }
        last += count;
    }
}

// Returns the edge of the border that starts at p and has the face on its left.
FaceTriangulation::Side FaceTriangulation::border_from(Local p) const {
    for (Local cell = cell_of_[p];;) {
        const Cell& c = cells_[cell];
        const unsigned right = previous(c.v[0] == p ? 0 : c.v[1] == p ? 1 : 2);
        if (c.n[right] == none) return {cell, right};
        cell = c.n[right];
    }
}

void FaceTriangulation::insert_inner_points(const FaceInput& face) {
    Local near = 0;
    for (auto p = static_cast<Local>(points_.size() - face.inner_points.size()); p < points_.size();
         ++p) {
        if (p % 1024 == 1023 && face.stop.stop_requested()) return;
        const Side s = locate(p, near);
        if (s.i == 3)
            split_cell(s.cell, p);
        else
            split_edge(s, p);
        legalise();
        near = cell_of_[p];
    }
}

// Locates a point by a visibility walk. i == 3: it lies inside the cell; else on its edge i.
FaceTriangulation::Side FaceTriangulation::locate(Local p, Local from) const {
    Local cell = from, before = none;
    for (;;) {
        const Cell& c = cells_[cell];
        unsigned on = 3, out = 3;
        for (unsigned i = 0; i < 3 && out == 3; ++i) {
            if (c.n[i] == before && before != none) continue;
            if (c.n[i] == none) continue; // p lies inside the border
            const Sign s = turn(c.v[next(i)], c.v[previous(i)], p);
            if (s == Sign::Negative) out = i;
            if (s == Sign::Zero) on = i;
        }
        if (out == 3) return {cell, on};
        before = cell;
        cell = c.n[out];
    }
}

/// Lists for each point the lines that carry it by construction: those of segments, and the three
/// edges.
void FaceTriangulation::find_lines(const FaceInput& face) {
    segments_.clear();
    for (const Segment& s : face.segments) segments_.push_back({local(s[0]), local(s[1])});
    // Segments of one line usually are consecutive. A point is then entered once.
    const auto for_all = [&](const auto& enter) {
        for (std::uint32_t e = 0, p = 3; e < 3; ++e) {
            enter(e, e);
            enter((e + 1) % 3, e);
            for (std::size_t k = 0; k < face.edge_points[e].size(); ++k) enter(p++, e);
        }
        for (std::size_t s = 0; s < face.segment_lines.size(); ++s)
            for (const Local p : segments_[s]) enter(p, face.segment_lines[s] + 3);
    };
    line_end_.assign(points_.size(), UINT32_MAX); // here: the last line entered
    first_line_.assign(points_.size() + 1, 0);
    for_all([&](Local p, std::uint32_t line) {
        if (std::exchange(line_end_[p], line) != line) ++first_line_[p + 1];
    });
    std::partial_sum(first_line_.begin(), first_line_.end(), first_line_.begin());
    lines_.resize(first_line_.back());
    line_end_.assign(first_line_.begin(), first_line_.end() - 1);
    for_all([&](Local p, std::uint32_t line) {
        if (line_end_[p] == first_line_[p] || lines_[line_end_[p] - 1] != line)
            lines_[line_end_[p]++] = line;
    });
}

bool FaceTriangulation::on_one_line(Local a, Local b, Local c) const {
    const auto has = [&](Local p, std::uint32_t line) {
        const auto begin = lines_.begin();
        const auto end = begin + first_line_[p + 1];
        return std::find(begin + first_line_[p], end, line) != end;
    };
    for (std::uint32_t l = first_line_[a]; l < first_line_[a + 1]; ++l)
        if (has(b, lines_[l]) && has(c, lines_[l])) return true;
    return false;
}

Sign FaceTriangulation::turn(Local a, Local b, Local c) const {
    if (const auto sign = filtered_orient2d(flat_[a], flat_[b], flat_[c])) {
        ++predicate_counts().static_filter;
        return *sign;
    }
    return certain_turn(a, b, c);
}

Sign FaceTriangulation::certain_turn(Local a, Local b, Local c) const {
    if (on_one_line(a, b, c)) return Sign::Zero;
    if (frame_ != nullptr && std::min({a, b, c}) < 3)
        return exact_sign(
            polynomial::orient2d(axis_, exact(points_[a]), exact(points_[b]), exact(points_[c])));
    return store_->orient2d(upward_, axis_, points_[a], points_[b], points_[c]);
}

Sign FaceTriangulation::in_circle(const Cell& c, Local d) const {
    if (const auto sign =
            filtered_in_circle(flat_[c.v[0]], flat_[c.v[1]], flat_[c.v[2]], flat_[d])) {
        ++predicate_counts().static_filter;
        return *sign;
    }
    return certain_in_circle(c, d);
}

Sign FaceTriangulation::certain_in_circle(const Cell& c, Local d) const {
    if (frame_ != nullptr && std::min({c.v[0], c.v[1], c.v[2], d}) < 3)
        return exact_sign(polynomial::in_circle(axis_, exact(points_[c.v[0]]),
                                                exact(points_[c.v[1]]), exact(points_[c.v[2]]),
                                                exact(points_[d])));
    return store_->in_circle(upward_, axis_, points_[c.v[0]], points_[c.v[1]], points_[c.v[2]],
                             points_[d]);
}

ApproximatePoint FaceTriangulation::approximate(PointIndex p) const {
    if (frame_ == nullptr || !Frame::has(p)) return store_->approximate(axis_, p);
    const unsigned i = p - Frame::corner(0);
    return {frame_->u[i], frame_->v[i], 0};
}

// A corner of the frame gets coordinate 0 along the axis, which no predicate in the projection uses.
ExactPoint FaceTriangulation::exact(PointIndex p) const {
    if (!Frame::has(p)) return store_->exact(p);
    const unsigned i = p - Frame::corner(0);
    const Exact u(frame_->u[i]), v(frame_->v[i]);
    switch (axis_) {
    case Axis::x:
        return {Exact(0), u, v, Exact(1)};
    case Axis::y:
        return {v, Exact(0), u, Exact(1)};
    default:
        return {u, v, Exact(0), Exact(1)};
    }
}

// Corners of the frame come after all points.
std::uint32_t FaceTriangulation::rank_of(Local p) const {
    return frame_ != nullptr && p < 3 ? points_[p] : rank_[points_[p]];
}

unsigned FaceTriangulation::index_in(Local cell, Local neighbour) const {
    const auto& n = cells_[cell].n;
    return n[0] == neighbour ? 0 : n[1] == neighbour ? 1 : 2;
}

void FaceTriangulation::replace_neighbour(Local cell, Local old_cell, Local new_cell) {
    if (cell != none) cells_[cell].n[index_in(cell, old_cell)] = new_cell;
}

void FaceTriangulation::split_cell(Local cell, Local p) {
    const Cell c = cells_[cell];
    const Local b = static_cast<Local>(cells_.size()), d = b + 1;
    const std::array<Local, 3> id{cell, b, d};
    cells_.resize(cells_.size() + 2);
    for (unsigned k = 0; k < 3; ++k) { // cell k keeps the edge opposite to v[k]
        Cell& part = cells_[id[k]];
        part.v = {p, c.v[next(k)], c.v[previous(k)]};
        part.n = {c.n[k], id[next(k)], id[previous(k)]};
        part.fixed = {c.fixed[k], false, false};
        if (k > 0) replace_neighbour(c.n[k], cell, id[k]);
        cell_of_[c.v[next(k)]] = id[k];
        legalise_later({id[k], 0});
    }
    cell_of_[p] = cell;
}

void FaceTriangulation::split_edge(Side s, Local p) {
    const bool fixed = cells_[s.cell].fixed[s.i];
    const Local other = cells_[s.cell].n[s.i];
    const Local fresh = static_cast<Local>(cells_.size()), fresh_other = fresh + 1;
    const unsigned j = other == none ? 0 : index_in(other, s.cell);
    cells_.resize(cells_.size() + (other == none ? 1 : 2));

    // (apex, a, b) becomes (apex, a, p) and (apex, p, b). The cell on the other side, whose edge
    // runs from b to a, is halved likewise.
    const auto halve = [&](Local cell, unsigned i, Local second, Local first_beyond,
                           Local second_beyond) {
        const Cell c = cells_[cell];
        const Local apex = c.v[i], a = c.v[next(i)], b = c.v[previous(i)];
        const Local n_a = c.n[next(i)], n_b = c.n[previous(i)];
        cells_[cell].v = {apex, a, p};
        cells_[cell].n = {first_beyond, second, n_b};
        cells_[cell].fixed = {fixed, false, c.fixed[previous(i)]};
        cells_[second].v = {apex, p, b};
        cells_[second].n = {second_beyond, n_a, cell};
        cells_[second].fixed = {fixed, c.fixed[next(i)], false};
        replace_neighbour(n_a, cell, second);
        cell_of_[apex] = cell_of_[a] = cell_of_[p] = cell;
        cell_of_[b] = second;
        legalise_later({cell, 2});
        legalise_later({second, 1});
    };
    halve(s.cell, s.i, fresh, other == none ? none : fresh_other, other);
    if (other != none) halve(other, j, fresh_other, fresh, s.cell);
}

// Replaces the diagonal s of the quadrilateral of two cells by the other diagonal.
void FaceTriangulation::flip(Side s) {
    const Local t = s.cell, o = cells_[t].n[s.i];
    const unsigned i = s.i, j = index_in(o, t);
    const Cell c = cells_[t], d = cells_[o];
    const Local p = c.v[i], a = c.v[next(i)], b = c.v[previous(i)], q = d.v[j];
    // c = (p, a, b) and d = (q, b, a) become t = (p, a, q) and o = (q, b, p)
    cells_[t].v = {p, a, q};
    cells_[t].n = {d.n[next(j)], o, c.n[previous(i)]};
    cells_[t].fixed = {d.fixed[next(j)], false, c.fixed[previous(i)]};
    cells_[o].v = {q, b, p};
    cells_[o].n = {c.n[next(i)], t, d.n[previous(j)]};
    cells_[o].fixed = {c.fixed[next(i)], false, d.fixed[previous(j)]};
    replace_neighbour(d.n[next(j)], o, t);
    replace_neighbour(c.n[next(i)], t, o);
    cell_of_[p] = cell_of_[a] = t;
    cell_of_[q] = cell_of_[b] = o;
}

// Flips edges until every edge that is not fixed is locally Delaunay (Lawson).
void FaceTriangulation::legalise() {
    while (!todo_.empty()) {
        const Side s = todo_.back();
        todo_.pop_back();
        if (!must_flip(s)) continue;
        const Local t = s.cell, o = cells_[t].n[s.i];
        flip(s);
        for (const Local cell : {t, o})
            for (const unsigned i : {0u, 2u}) legalise_later({cell, i});
    }
}

bool FaceTriangulation::must_flip(Side s) const {
    const Cell& c = cells_[s.cell];
    if (c.fixed[s.i] || c.n[s.i] == none) return false;
    const Cell& o = cells_[c.n[s.i]];
    return in_perturbed_circle(c, o.v[index_in(c.n[s.i], s.cell)]);
}

// Breaks ties as if the point of highest rank were lifted by an infinitesimal amount, the next one
// by an infinitely smaller amount, and so on. The first lift that changes the sign decides.
bool FaceTriangulation::in_perturbed_circle(const Cell& c, Local d) const {
    const Sign s = in_circle(c, d);
    return s == Sign::Zero ? in_perturbed_circle_through(c, d) : s == Sign::Positive;
}

bool FaceTriangulation::in_perturbed_circle_through(const Cell& c, Local d) const {
    std::array<Local, 4> order{c.v[0], c.v[1], c.v[2], d};
    std::sort(order.begin(), order.end(),
              [&](Local a, Local b) { return rank_of(a) > rank_of(b); });
    for (const Local p : order) {
        if (p == d) return false;
        const Sign t = p == c.v[2]   ? turn(c.v[0], c.v[1], d)
                       : p == c.v[1] ? turn(c.v[0], d, c.v[2])
                                     : turn(d, c.v[1], c.v[2]);
        if (t != Sign::Zero) return t == Sign::Positive;
    }
    return false;
}

} // namespace terrane
