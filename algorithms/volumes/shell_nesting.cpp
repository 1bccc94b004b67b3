// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/shell_nesting.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/volumes/detail/triangle_boxes.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::volumes {
namespace {

using polynomial::Vector;

/// A line along an axis, given by its point in the projection along that axis.
struct Line {
    ExactPoint exact;       ///< its coordinate along the axis has no meaning
    ApproximatePoint about; ///< the point in the projection, approximately
    std::uint32_t name;     ///< place in the list of all lines
};

/// The intersection of a line with a triangle.
struct Hit {
    std::uint32_t line, triangle;
    Interval height; ///< encloses its coordinate along the axis
};

template <class T>
T coordinate(const Vector<T>& v, unsigned k) {
    return k == 0 ? v.x : k == 1 ? v.y : v.z;
}
template <class W>
Exact coordinate(const polynomial::Coordinates<Exact, W>& p, unsigned k) {
    return k == 0 ? p.x : k == 1 ? p.y : p.z;
}
double coordinate(const Point3& p, unsigned k) {
    return k == 0 ? p.x : k == 1 ? p.y : p.z;
}

/// The lines along one axis, and their intersections with triangles.
class Bundle {
public:
    Bundle(UpwardWitness upward, const TriangleComplex& sheets, Axis axis) :
        upward_(upward), sheets_(sheets), axis_(axis), k_(static_cast<unsigned>(axis)) {}

    /// Adds a line and returns its number in this bundle.
    std::uint32_t add_line_through(std::uint32_t triangle, std::uint32_t name) {
        lines_.push_back(inside(triangle));
        lines_.back().name = name;
        return static_cast<std::uint32_t>(lines_.size() - 1);
    }
    void add_hit(std::uint32_t line, std::uint32_t triangle) {
        hits_.push_back({line, triangle, height(triangle, lines_[line])});
    }

    /// Finds the hits of all lines with triangles in these boxes.
    void find_hits(const TriangleBoxes& boxes, std::vector<LineHit>& out) const {
        for (const Line& line : lines_)
            boxes.descend(along(line), HUGE_VAL, [&](std::uint32_t triangle) {
                if (passes_through(triangle, line)) out.push_back({line.name, triangle});
                return -HUGE_VAL;
            });
    }

    /// Returns the lowest hit of a line with these triangles. Throws std::logic_error if the line hits no triangle.
    [[nodiscard]] Hit lowest_of(std::uint32_t line, std::span<const std::uint32_t> triangles,
                                const TriangleBoxes& boxes) const;
    /// Returns the hit that comes next below another one of the same line, if there is one.
    [[nodiscard]] std::optional<Hit> next_below(const Hit& hit, const TriangleBoxes& boxes) const;
    /// Returns the side of a triangle that faces the positive end of the axis.
    [[nodiscard]] std::uint32_t upper_side(std::uint32_t triangle) const {
        const Triangle& p = sheets_.planes[triangle];
        const Sign s = sheets_.points.orient2d(upward_, axis_, p[0], p[1], p[2]);
        return s == Sign::Positive ? front_of(triangle) : back_of(triangle);
    }

    template <class Join>
    void join(const Join& join, std::uint32_t outside) {
        std::sort(hits_.begin(), hits_.end(), [this](const Hit& a, const Hit& b) {
            if (a.line != b.line) return a.line < b.line;
            return a.triangle != b.triangle && below(a, b);
        });
        for (std::size_t i = 0; i < hits_.size(); ++i) {
            const bool first = i == 0 || hits_[i - 1].line != hits_[i].line;
            const std::uint32_t upper = upper_side(hits_[i].triangle);
            join(opposite(upper), first ? outside : upper_side(hits_[i - 1].triangle));
            if (i + 1 == hits_.size() || hits_[i + 1].line != hits_[i].line) join(upper, outside);
        }
        check_all_hit();
    }

private:
    [[nodiscard]] PointIndex point(std::uint32_t triangle, unsigned corner) const {
        return sheets_.vertices[sheets_.triangles[triangle][corner]];
    }

    [[nodiscard]] Line inside(std::uint32_t triangle) const;
    [[nodiscard]] Sign turn(PointIndex a, PointIndex b, const Line& line) const;
    [[nodiscard]] bool passes_through(std::uint32_t triangle, const Line& line) const;
    [[nodiscard]] AxisLine along(const Line& line) const {
        return {k_, line.about.radius == 0, line.about.u, line.about.v};
    }
    [[nodiscard]] Interval height(std::uint32_t triangle, const Line& line) const;
    [[nodiscard]] bool below(const Hit& a, const Hit& b) const;

    void check_all_hit() const {
        std::size_t seen = 0;
        for (std::size_t i = 0; i < hits_.size(); ++i)
            seen += i == 0 || hits_[i].line != hits_[i - 1].line ? 1U : 0U;
        if (seen != lines_.size()) throw std::logic_error("a line misses its own triangle");
    }

    [[no_unique_address]] UpwardWitness upward_;
    const TriangleComplex& sheets_;
    Axis axis_;
    unsigned k_;
    std::vector<Line> lines_;
    std::vector<Hit> hits_;
};

/// Returns the line through a point inside the projected triangle: its centroid in doubles if that
/// lies strictly inside, otherwise the exact centroid.
Line Bundle::inside(std::uint32_t triangle) const {
    const unsigned u = (k_ + 1) % 3, v = (k_ + 2) % 3;
    std::array<double, 3> middle{};
    for (unsigned c = 0; c < 3; ++c) {
        const ApproximatePoint p = sheets_.points.approximate(axis_, point(triangle, c));
        middle[u] += p.u / 3;
        middle[v] += p.v / 3;
    }
    Line line{{Exact(middle[0]), Exact(middle[1]), Exact(middle[2]), Exact(1)},
              {middle[u], middle[v], 0},
              triangle};
    const bool finite = std::isfinite(middle[u]) && std::isfinite(middle[v]);
    if (finite && passes_through(triangle, line)) return line;
    const ExactPoint a = sheets_.points.exact(point(triangle, 0)),
                     b = sheets_.points.exact(point(triangle, 1)),
                     c = sheets_.points.exact(point(triangle, 2));
    const auto sum = [&](const Exact& x, const Exact& y, const Exact& z) {
        return x * b.w * c.w + y * c.w * a.w + z * a.w * b.w;
    };
    line.exact = {sum(a.x, b.x, c.x), sum(a.y, b.y, c.y), sum(a.z, b.z, c.z), a.w * b.w * c.w * 3};
    line.about.radius = HUGE_VAL; // the filters decline
    return line;
}

/// Returns Positive iff the shifted line passes to the left of a b in the projection, and Zero only
/// if a and b coincide there. The shift adds (b - a) x (epsilon, epsilon^2).
Sign Bundle::turn(PointIndex a, PointIndex b, const Line& line) const {
    if (const auto quick = filtered_orient2d(sheets_.points.approximate(axis_, a),
                                             sheets_.points.approximate(axis_, b), line.about)) {
        ++predicate_counts().static_filter;
        return *quick;
    }
    ++predicate_counts().exact;
    const ExactPoint p = sheets_.points.exact(a), q = sheets_.points.exact(b);
    const Sign s = exact_sign(polynomial::orient2d(axis_, p, q, line.exact));
    if (s != Sign::Zero) return s;
    const auto d = polynomial::difference(axis_, q, p);
    const Sign first = -exact_sign(d.v);
    return first != Sign::Zero ? first : exact_sign(d.u);
}

bool Bundle::passes_through(std::uint32_t triangle, const Line& line) const {
    const PointIndex a = point(triangle, 0), b = point(triangle, 1), c = point(triangle, 2);
    const Sign s = turn(a, b, line);
    return s != Sign::Zero && turn(b, c, line) == s && turn(c, a, line) == s;
}

Hit Bundle::lowest_of(std::uint32_t line, std::span<const std::uint32_t> triangles,
                      const TriangleBoxes& boxes) const {
    std::optional<Hit> lowest;
    const AxisLine about = along(lines_[line]);
    for (const std::uint32_t triangle : triangles) {
        if (!boxes.is_near(triangle, about) || !passes_through(triangle, lines_[line])) continue;
        const Hit hit{line, triangle, height(triangle, lines_[line])};
        if (!lowest || below(hit, *lowest)) lowest = hit;
    }
    if (!lowest) throw std::logic_error("a line misses its own triangle");
    return *lowest;
}

std::optional<Hit> Bundle::next_below(const Hit& hit, const TriangleBoxes& boxes) const {
    const Line& line = lines_[hit.line];
    std::optional<Hit> best;
    boxes.descend(along(line), hit.height.sup(), [&](std::uint32_t triangle) {
        if (triangle != hit.triangle && passes_through(triangle, line)) {
            const Hit found{hit.line, triangle, height(triangle, line)};
            if (below(found, hit) && (!best || below(*best, found))) best = found;
        }
        return best ? best->height.inf() : -HUGE_VAL;
    });
    return best;
}

/// Encloses the height at which the line meets the plane of a triangle, from n (x - a) = 0.
Interval Bundle::height(std::uint32_t triangle, const Line& line) const {
    const Triangle& plane = sheets_.planes[triangle];
    const auto at = [&](unsigned i) {
        return polynomial::cartesian<Interval>(sheets_.points.input(plane[i]));
    };
    const auto a = at(0);
    const auto n = cross(difference(at(1), a), difference(at(2), a));
    const unsigned u = (k_ + 1) % 3, v = (k_ + 2) % 3;
    const Interval nk = coordinate(n, k_);
    if (line.about.radius != 0 || certain_sign(upward_, nk).value_or(Sign::Zero) == Sign::Zero)
        return {-HUGE_VAL, HUGE_VAL};
    const Point3& p = sheets_.points.input(plane[0]);
    const Interval du = Interval(coordinate(p, u)) - line.about.u,
                   dv = Interval(coordinate(p, v)) - line.about.v;
    return Interval(coordinate(p, k_)) + (coordinate(n, u) * du + coordinate(n, v) * dv) / nk;
}

/// The exact height at which a line meets the plane of a triangle, and its derivatives by the two
/// components of the shift: numerators over a common denominator.
struct ExactHeight {
    std::array<Exact, 3> numerators;
    Exact denominator; ///< > 0

    ExactHeight(const TriangleComplex& sheets, std::uint32_t triangle, unsigned k,
                const ExactPoint& line) {
        const Triangle& plane = sheets.planes[triangle];
        const auto at = [&](unsigned i) {
            return polynomial::cartesian<Exact>(sheets.points.input(plane[i]));
        };
        const auto a = at(0);
        const auto n = cross(difference(at(1), a), difference(at(2), a));
        const unsigned u = (k + 1) % 3, v = (k + 2) % 3;
        const Exact nu = coordinate(n, u), nv = coordinate(n, v);
        const Exact offset = n.x * a.x + n.y * a.y + n.z * a.z;
        numerators = {offset * line.w - nu * coordinate(line, u) - nv * coordinate(line, v), -nu,
                      -nv};
        denominator = coordinate(n, k);
        if (exact_sign(denominator) != Sign::Negative) return;
        denominator = -denominator;
        for (Exact& x : numerators) x = -x;
    }
};

bool Bundle::below(const Hit& a, const Hit& b) const {
    if (a.height.sup() < b.height.inf()) return true;
    if (b.height.sup() < a.height.inf()) return false;
    ++predicate_counts().exact;
    const ExactPoint& line = lines_[a.line].exact;
    const ExactHeight first(sheets_, a.triangle, k_, line), second(sheets_, b.triangle, k_, line);
    for (std::size_t i = 0; i < 3; ++i) {
        const Sign s = exact_sign(first.numerators[i] * second.denominator -
                                  second.numerators[i] * first.denominator);
        if (s != Sign::Zero) return s == Sign::Negative;
    }
    throw std::logic_error("two triangles overlap");
}

/// Returns the axis along which the triangle is projected best.
Axis best_axis(const TriangleComplex& sheets, std::uint32_t triangle) {
    const Triangle& p = sheets.planes[triangle];
    return projection_axis(sheets.points.input(p[0]), sheets.points.input(p[1]),
                           sheets.points.input(p[2]));
}

/// The lines along all axes.
class Bundles {
public:
    Bundles(UpwardWitness upward, const TriangleComplex& sheets,
            std::span<const std::uint32_t> through) :
        bundles_{Bundle(upward, sheets, Axis::x), Bundle(upward, sheets, Axis::y),
                 Bundle(upward, sheets, Axis::z)} {
        for (std::uint32_t i = 0; i < through.size(); ++i) {
            const auto axis = static_cast<std::uint32_t>(best_axis(sheets, through[i]));
            places_.push_back({axis, bundles_[axis].add_line_through(through[i], i)});
        }
    }

    [[nodiscard]] std::vector<LineHit> hits(const TriangleBoxes& boxes) const {
        std::vector<LineHit> found;
        for (const Bundle& bundle : bundles_) bundle.find_hits(boxes, found);
        return found;
    }

    /// Returns the bundle of a line; its number there is line_in_bundle().
    [[nodiscard]] const Bundle& bundle_of(std::uint32_t line) const {
        return bundles_[places_[line][0]];
    }
    [[nodiscard]] std::uint32_t line_in_bundle(std::uint32_t line) const {
        return places_[line][1];
    }

    template <class Join>
    void join_along(std::span<const LineHit> hits, const Join& join, std::uint32_t outside) {
        for (const LineHit& h : hits) {
            const auto [axis, line] = places_[h.line];
            bundles_[axis].add_hit(line, h.triangle);
        }
        for (Bundle& bundle : bundles_) bundle.join(join, outside);
    }

private:
    std::array<Bundle, 3> bundles_;
    std::vector<std::array<std::uint32_t, 2>>
        places_; ///< per line: its bundle, and its place there
};

/// Joins the outer shells of all components with those on the same volume. Components are gathered in
/// groups whose outer shells are known to be on one volume. A group is settled when these are joined with
/// the outside, or with the shell of the component around that volume.
class Nesting {
public:
    Nesting(const TriangleComplex& sheets, DisjointSets& sides) :
        sheets_(sheets), sides_(sides), shells_(sides), component_of_(sheets.triangles.size()) {
        find_components();
    }

    void operator()() {
        if (through_.empty()) return;
        const UpwardRounding guard;
        const Bundles bundles(guard, sheets_, through_);
        TriangleBoxes boxes(sheets_, count());
        if (through_.size() > 1) boxes.build_tree();
        DisjointSets groups(through_.size());
        std::vector<bool> settled(through_.size(), false); // by a component of the group
        for (auto open = own_; open.size() > 0; open = unsettled(groups, settled)) {
            std::vector<Start> starts;
            for (std::size_t g = 0; g < open.size(); ++g) {
                const std::uint32_t line = groups.find(component_of_[open[g].front()]);
                const Bundle& bundle = bundles.bundle_of(line);
                starts.push_back({&bundle, line,
                                  bundle.lowest_of(bundles.line_in_bundle(line), open[g], boxes)});
            }
            if (outer_.empty()) find_outer(starts);
            for (const Start& start : starts) step(start, boxes, groups, settled);
        }
    }

private:
    [[nodiscard]] std::uint32_t count() const {
        return static_cast<std::uint32_t>(sheets_.triangles.size());
    }
    /// Where the way down from a group begins.
    struct Start {
        const Bundle* bundle;
        std::uint32_t line; ///< that of a component of the group
        Hit lowest;         ///< of the group with that line
    };

    /// Numbers the components by their lowest triangles.
    void find_components() {
        DisjointSets joined =
            sides_; // in addition, the front and the back of a triangle are joined
        for (std::uint32_t t = 0; t < count(); ++t) joined.join(front_of(t), back_of(t));
        for (std::uint32_t t = 0; t < count(); ++t) {
            const std::uint32_t first = joined.find(front_of(t)) / 2;
            if (first == t) {
                component_of_[t] = static_cast<std::uint32_t>(through_.size());
                through_.push_back(t);
            } else {
                component_of_[t] = component_of_[first];
            }
        }
        std::vector<std::uint32_t> all(through_.size());
        std::iota(all.begin(), all.end(), 0U);
        own_ = gathered(all);
    }

    /// Lists the triangles of each group; group_of[c] is that of a component, or no_index.
    [[nodiscard]] IndexLists<std::uint32_t>
    gathered(const std::vector<std::uint32_t>& group_of) const {
        std::vector<std::uint32_t> triangles, groups;
        for (std::uint32_t t = 0; t < count(); ++t) {
            const std::uint32_t group = group_of[component_of_[t]];
            if (group == no_index) continue;
            triangles.push_back(t);
            groups.push_back(group);
        }
        const auto all = lists_by_key<std::uint32_t>(through_.size(), groups,
                                                     [&](std::size_t i) { return triangles[i]; });
        IndexLists<std::uint32_t> lists;
        for (std::size_t g = 0; g < all.size(); ++g)
            if (!all[g].empty()) lists.push_back(all[g]);
        return lists;
    }
    [[nodiscard]] IndexLists<std::uint32_t> unsettled(DisjointSets& groups,
                                                      const std::vector<bool>& settled) const {
        std::vector<bool> is_settled(through_.size(), false);
        for (std::uint32_t c = 0; c < through_.size(); ++c)
            if (settled[c]) is_settled[groups.find(c)] = true;
        std::vector<std::uint32_t> group_of;
        for (std::uint32_t c = 0; c < through_.size(); ++c)
            group_of.push_back(is_settled[groups.find(c)] ? no_index : groups.find(c));
        return gathered(group_of);
    }

    void find_outer(const std::vector<Start>& starts) {
        for (const Start& s : starts)
            outer_.push_back(shells_.find(opposite(s.bundle->upper_side(s.lowest.triangle))));
    }

    /// Joins a group with what is next below it.
    void step(const Start& start, const TriangleBoxes& boxes, DisjointSets& groups,
              std::vector<bool>& settled) {
        const auto next = start.bundle->next_below(start.lowest, boxes);
        const std::uint32_t upper = next ? start.bundle->upper_side(next->triangle) : 2 * count();
        sides_.join(opposite(start.bundle->upper_side(start.lowest.triangle)), upper);
        if (next && shells_.find(upper) == outer_[component_of_[next->triangle]])
            groups.join(start.line, component_of_[next->triangle]);
        else
            settled[start.line] = true;
    }

    const TriangleComplex& sheets_;
    DisjointSets& sides_;
    DisjointSets shells_;                     ///< as they were before any were joined
    std::vector<std::uint32_t> component_of_; ///< per triangle
    std::vector<std::uint32_t> through_;      ///< per component: its lowest triangle
    IndexLists<std::uint32_t> own_;           ///< per component: its triangles
    std::vector<std::uint32_t> outer_;        ///< per component: its outer shell
};

} // namespace

std::vector<LineHit> find_line_hits(const TriangleComplex& sheets,
                                    std::span<const std::uint32_t> through, std::uint32_t count) {
    const UpwardRounding guard;
    TriangleBoxes boxes(sheets, count);
    boxes.build_tree();
    return Bundles(guard, sheets, through).hits(boxes);
}

void join_along_lines(const TriangleComplex& sheets, std::span<const std::uint32_t> through,
                      std::span<const LineHit> hits,
                      const std::function<void(std::uint32_t, std::uint32_t)>& join) {
    const UpwardRounding guard;
    Bundles(guard, sheets, through)
        .join_along(hits, join, 2 * static_cast<std::uint32_t>(sheets.triangles.size()));
}

void join_nested(const TriangleComplex& sheets, DisjointSets& sides) {
    Nesting(sheets, sides)();
}

} // namespace terrane::volumes
