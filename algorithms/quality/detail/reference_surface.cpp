// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/reference_surface.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::quality::detail {

Point3 towards(const Point3& a, const Point3& b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}

namespace {

/// Exceeds the rounding error of quotients between 0 and 1, which is a few units in 2^-53. Edges
/// are followed a little too far and heights taken a little too large, never the other way.
constexpr double share_error = 0x1p-26;

constexpr double unit = std::numeric_limits<double>::epsilon();

/// Computes an upper bound (up to rounding) of the distance of p to the segment: the distance to a
/// point that lies on it.
double to_segment(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 d = minus(b, a);
    const double square = dot(d, d);
    const double share = square > 0 ? std::clamp(dot(minus(p, a), d) / square, 0.0, 1.0) : 0;
    return length(minus(p, towards(a, b, share)));
}

} // namespace

double to_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
    double least = std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
    const Point3 n = cross(minus(b, a), minus(c, a));
    const double square = dot(n, n);
    if (!(square > 0)) return least;
    const double share_b = dot(cross(minus(p, a), minus(c, a)), n) / square;
    const double share_c = dot(cross(minus(b, a), minus(p, a)), n) / square;
    if (!(share_b >= 0) || !(share_c >= 0) || !(share_b + share_c <= 1)) return least;
    const Point3 foot{a.x + share_b * (b.x - a.x) + share_c * (c.x - a.x),
                      a.y + share_b * (b.y - a.y) + share_c * (c.y - a.y),
                      a.z + share_b * (b.z - a.z) + share_c * (c.z - a.z)};
    return std::min(least, length(minus(p, foot)));
}

ReferenceSurface::ReferenceSurface(std::span<const Point3> points, const Features& features,
                                   std::span<const double> bound_of) :
    points_(points),
    features_(features), bound_of_(bound_of), facets_(features.triangles.size()) {
    double largest = 0;
    for (std::size_t t = 0; t < features.triangles.size(); ++t) {
        Facet& facet = facets_[t];
        const auto& [i, j, k] = features.triangles[t];
        const Point3 &a = points[i], &b = points[j], &c = points[k];
        const Point3 ab = minus(b, a), ac = minus(c, a);
        facet.corners = {a, b, c};
        facet.normal = cross(ab, ac);
        facet.error = 8 * unit * length(ab) * length(ac);
        // The directions of a frame are perpendicular up to a few units of rounding.
        facet.lean = 4 * facet.error + 64 * unit * length(facet.normal);
        facet.across = features.across[t];
        for (const Axis axis : {Axis::x, Axis::y, Axis::z})
            facet.orientations[static_cast<std::size_t>(axis)] =
                static_cast<std::int8_t>(orient2d(axis, a, b, c));
        for (const std::uint32_t v : features.triangles[t])
            largest = std::max(
                {largest, std::fabs(points[v].x), std::fabs(points[v].y), std::fabs(points[v].z)});
    }
    slack_ = rounding_at(largest);
}

/// Tells whether all corners of triangle t are farther than `gap` from the plane of triangle `of`,
/// on the same side.
bool ReferenceSurface::is_beyond_plane(std::uint32_t t, std::uint32_t of, double gap) const {
    const Facet& plane = facets_[of];
    const double size = length(plane.normal);
    int sum = 0;
    for (const Point3& p : facets_[t].corners) {
        const Point3 d = minus(p, plane.corners[0]);
        const double off = dot(plane.normal, d);
        const double least = size * gap + (3 * plane.error + 16 * unit * size) * length(d);
        sum += off > least ? 1 : off < -least ? -1 : 0;
    }
    return sum == 3 || sum == -3;
}

void ReferenceSurface::find_isolated(const Run& run) {
    const auto count = static_cast<std::uint32_t>(features_.triangles.size());
    for (Facet& f : facets_) f.isolated = true;
    std::vector<Box> boxes;
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    for (std::uint32_t t = 0; t < count; ++t) {
        Box box = box_of(points_, features_.triangles[t]);
        const double bound = bound_of_[features_.sheet_of[t]] + slack_;
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] -= bound;
            box.high[k] += bound;
        }
        boxes.push_back(box);
    }
    const auto mark = [&](const CandidatePair& p) {
        if (!facets_[p.first].isolated && !facets_[p.second].isolated) return false;
        const double gap = bound_of_[features_.sheet_of[p.first]] +
                           bound_of_[features_.sheet_of[p.second]] + 4 * slack_;
        if (!is_beyond_plane(p.first, p.second, gap) && !is_beyond_plane(p.second, p.first, gap))
            facets_[p.first].isolated = facets_[p.second].isolated = false;
        return false; // pairs need not be kept
    };
    Run one = without_progress(run); // marks are not synchronised
    one.threads = 1;
    candidate_pairs_of(boxes, all, features_.sheet_of, mark, one);
}

ReferenceSurface::Frame ReferenceSurface::frame_of(Axis axis) {
    const Point3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    if (axis == Axis::x) return {y, z, x, axis};
    if (axis == Axis::y) return {z, x, y, axis};
    return {x, y, z, axis};
}

int ReferenceSurface::orientation_of(std::uint32_t t, const Frame& frame) const {
    const Facet& facet = facets_[t];
    if (frame.axis) return facet.orientations[static_cast<std::size_t>(*frame.axis)];
    const double along = dot(facet.normal, frame.w);
    return along > facet.lean ? 1 : along < -facet.lean ? -1 : 0;
}

ReferenceSurface::Frame ReferenceSurface::frame_along(const Point3& normal, const Point3& side) {
    const double size = length(normal), base = length(side);
    Frame frame;
    frame.w = {normal.x / size, normal.y / size, normal.z / size};
    frame.u = {side.x / base, side.y / base, side.z / base};
    frame.v = cross(frame.w, frame.u);
    return frame;
}

void ReferenceSurface::set_measures(Target& target) {
    const Frame& frame = target.frame;
    Target::Measures& m = target.measures;
    for (std::size_t j = 0; j < 3; ++j) {
        const Flat &p = target.corners[j], &q = target.corners[(j + 1) % 3];
        const double u = (q.u - p.u) * target.orientation, v = (q.v - p.v) * target.orientation;
        m.x[j] = u * frame.v.x - v * frame.u.x;
        m.y[j] = u * frame.v.y - v * frame.u.y;
        m.z[j] = u * frame.v.z - v * frame.u.z;
        m.off[j] = u * p.v - v * p.u;
        target.spread =
            std::max(target.spread, std::fabs(m.x[j]) + std::fabs(m.y[j]) + std::fabs(m.z[j]));
        target.radius = std::max(target.radius, std::fabs(p.u) + std::fabs(p.v));
    }
    m.x[3] = frame.w.x - target.slope_u * frame.u.x - target.slope_v * frame.v.x;
    m.y[3] = frame.w.y - target.slope_u * frame.u.y - target.slope_v * frame.v.y;
    m.z[3] = frame.w.z - target.slope_u * frame.u.z - target.slope_v * frame.v.z;
}

std::optional<ReferenceSurface::Target> ReferenceSurface::target_of(const Corners& triangle,
                                                                    double bound, bool along_axis) {
    const Point3& a = triangle[0];
    const Point3 ab = minus(triangle[1], a), ac = minus(triangle[2], a), n = cross(ab, ac);
    const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
    const double longest =
        std::sqrt(std::max({dot(ab, ab), dot(ac, ac), dot(minus(ac, ab), minus(ac, ab))}));
    const double along = std::max({x, y, z});
    if (!(along > constants.thinnest * longest * longest)) return std::nullopt;
    const Axis axis = z >= x && z >= y ? Axis::z : x >= y ? Axis::x : Axis::y;
    Target target;
    target.frame = along_axis ? frame_of(axis) : frame_along(n, ab);
    target.origin = a;
    const Flat normal = target.frame.flat(n);
    target.orientation = normal.w > 0 ? 1 : -1;
    target.slope_u = along_axis ? -normal.u / normal.w : 0;
    target.slope_v = along_axis ? -normal.v / normal.w : 0;
    const std::array<Flat, 3> whole{Flat{}, target.frame.flat(ab), target.frame.flat(ac)};
    target.middle = {(whole[1].u + whole[2].u) / 3, (whole[1].v + whole[2].v) / 3,
                     (whole[1].w + whole[2].w) / 3};
    const double radius = 2 * longest / 3; // no corner is farther from the centroid
    const double share = std::min(constants.most_shrink, bound / constants.shrink_part / radius);
    for (std::size_t i = 0; i < 3; ++i)
        target.corners[i] = {whole[i].u + share * (target.middle.u - whole[i].u),
                             whole[i].v + share * (target.middle.v - whole[i].v),
                             whole[i].w + share * (target.middle.w - whole[i].w)};
    set_measures(target);
    target.error = 64 * unit * longest * longest / along;
    target.bound = bound - share * radius;
    return target;
}

/// Walks from triangle to triangle, always across an edge that separates it from the goal.
ReferenceSurface::Walk ReferenceSurface::walk(const Frame& frame, const Point3& origin,
                                              const Flat& to, int orientation,
                                              std::uint32_t from) const {
    std::uint32_t t = from, before = none;
    for (unsigned step = 0; step < constants.most_steps; ++step) {
        if (orientation_of(t, frame) != orientation) return {t, false};
        const Facet& facet = facets_[t];
        std::array<Flat, 3> p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = frame.flat(minus(facet.corners[i], origin));
        std::uint32_t next = t;
        bool blocked = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const Flat &a = p[i], &b = p[(i + 1) % 3];
            const double side = (b.u - a.u) * (to.v - a.v) - (b.v - a.v) * (to.u - a.u);
            if (!(side * orientation < 0)) continue;
            const std::uint32_t beyond = facet.across[i];
            if (beyond == none || beyond == before)
                blocked = true;
            else
                next = beyond;
        }
        if (next == t) return {t, !blocked};
        before = t;
        t = next;
    }
    return {t, false};
}

/// Tells whether a triangle is within the target's bound over the whole target. `heights` are those
/// of its corners above the plane of the target.
bool ReferenceSurface::is_near(const Target& target, const Corners& facet,
                               const std::array<double, 3>& heights, double bound) {
    std::array<Flat, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = target.frame.flat(minus(facet[i], target.origin));
    const Flat &a = corners[0], &b = corners[1], &c = corners[2];
    const double area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
    const double size =
        std::max({std::fabs(b.u - a.u), std::fabs(b.v - a.v), std::fabs(c.u - a.u),
                  std::fabs(c.v - a.v), std::fabs(c.u - b.u), std::fabs(c.v - b.v)});
    for (const Flat& p : target.corners) {
        std::array<double, 3> shares{};
        double least = 1;
        for (std::size_t i = 0; i < 3; ++i) {
            const Flat &from = corners[(i + 1) % 3], &to = corners[(i + 2) % 3];
            shares[i] =
                ((to.u - from.u) * (p.v - from.v) - (to.v - from.v) * (p.u - from.u)) / area;
            least = std::min(least, shares[i]);
        }
        const double far = std::max({size, std::fabs(p.u - a.u), std::fabs(p.v - a.v)});
        const double error = 32 * unit * far * far / std::fabs(area);
        if (!(least >= -error)) {
            if (std::isnan(least) || std::isnan(error)) return false;
            continue; // outside
        }
        const double spread = std::max({heights[0], heights[1], heights[2]}) -
                              std::min({heights[0], heights[1], heights[2]});
        const double height =
            shares[0] * heights[0] + shares[1] * heights[1] + shares[2] * heights[2];
        if (!(std::fabs(height) + 3 * error * spread <= bound)) return false;
    }
    return true;
}

/// Processes one triangle of the covering.
ReferenceSurface::Cover ReferenceSurface::visit(const Target& target, std::uint32_t t,
                                                Search& search) const {
    if (orientation_of(t, target.frame) != target.orientation) return Cover::open;
    const Facet& facet = facets_[t];
    const double bound = std::min(target.bound, height_bound(t));
    const Target::Measures& m = target.measures;
    std::array<std::array<double, 4>, 3> measured{}; // per corner: how far inside of each edge, and
                                                     // the height
    std::array<double, 3> heights{};
    double size = 0;
    bool all_near = true;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point3 d = minus(facet.corners[i], target.origin);
        for (std::size_t k = 0; k < 4; ++k)
            measured[i][k] = m.x[k] * d.x + m.y[k] * d.y + m.z[k] * d.z - m.off[k];
        const double away = std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z);
        heights[i] = measured[i][3] + std::copysign(target.error * away, measured[i][3]);
        all_near = all_near && std::fabs(heights[i]) <= bound;
        size = std::max(size, away);
    }
    // From here on, upper bounds of how far inside each corner lies.
    const double error = 64 * unit * target.spread * (size + target.radius);
    std::array<unsigned, 3> beyond_edges{}; // per corner: a bit for each edge that it is outside of
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            measured[i][j] += error;
            beyond_edges[i] |= static_cast<unsigned>(measured[i][j] < 0) << j;
        }
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = (i + 1) % 3;
        if ((beyond_edges[i] & beyond_edges[k]) != 0) continue;
        double low = 0, high = 1;
        const bool ends_inside = beyond_edges[i] == 0 || beyond_edges[k] == 0;
        if (!(all_near && ends_inside) && (beyond_edges[i] | beyond_edges[k]) != 0)
            for (std::size_t j = 0; j < 3; ++j) {
                const double from = measured[i][j], to = measured[k][j];
                if (from < 0 && to >= 0) low = std::max(low, from / (from - to));
                if (to < 0 && from >= 0) high = std::min(high, from / (from - to));
            }
        if (low > high + share_error) continue;
        const std::uint32_t beyond = facet.across[i];
        if (beyond == none) return Cover::open;
        if (search.seen_[beyond] != search.number_) {
            search.seen_[beyond] = search.number_;
            search.front_.push_back(beyond);
        }
        if (all_near) continue;
        const double rise = heights[k] - heights[i];
        const double most = bound - 2 * share_error * std::fabs(rise);
        if (!(std::fabs(heights[i] + low * rise) <= most) ||
            !(std::fabs(heights[i] + high * rise) <= most))
            return Cover::far;
    }
    return all_near || is_near(target, facet.corners, heights, bound) ? Cover::near : Cover::far;
}

ReferenceSurface::Cover ReferenceSurface::covered(const Target& target, std::uint32_t start,
                                                  Search& search) const {
    ++search.number_;
    if (search.number_ == 0) { // overflow
        std::fill(search.seen_.begin(), search.seen_.end(), 0);
        ++search.number_;
    }
    search.front_.assign(1, start);
    search.seen_[start] = search.number_;
    for (unsigned count = 0; !search.front_.empty(); ++count) {
        if (count == constants.most_covered) return Cover::open;
        const std::uint32_t t = search.front_.back();
        search.front_.pop_back();
        search.all_isolated_ = search.all_isolated_ && facets_[t].isolated;
        const Cover cover = visit(target, t, search);
        if (cover != Cover::near) return cover;
    }
    return Cover::near;
}

bool ReferenceSurface::near_one(const Corners& triangle, std::uint32_t t, double bound) const {
    const Corners& of = facets_[t].corners;
    const Point3& n = facets_[t].normal;
    const double height = height_bound(t), size = length(n);
    return std::all_of(triangle.begin(), triangle.end(), [&](const Point3& p) {
        const double away = to_triangle(p, of[0], of[1], of[2]);
        return away <= bound &&
               (away <= height || std::fabs(dot(n, minus(p, of[0]))) <= size * height);
    });
}

bool ReferenceSurface::contains_part(const Corners& triangle, Containment& containment,
                                     double bound, unsigned& budget, Search& search) const {
    if (budget == 0) return false;
    --budget;
    for (const bool along_axis : {false, true}) {
        const auto target = target_of(triangle, bound, along_axis);
        if (!target) break;
        const Walk way = walk(target->frame, target->origin, target->middle, target->orientation,
                              containment.hint);
        containment.hint = way.end;
        if (!way.arrived) continue;
        search.all_isolated_ = true;
        const Cover cover = covered(*target, way.end, search);
        if (cover == Cover::near) {
            containment.isolated = containment.isolated && search.all_isolated_;
            return true;
        }
        if (cover == Cover::far) return false;
    }
    if (near_one(triangle, containment.hint, bound)) {
        containment.isolated = containment.isolated && facets_[containment.hint].isolated;
        return true;
    }
    const std::array<double, 3> lengths{length(minus(triangle[1], triangle[0])),
                                        length(minus(triangle[2], triangle[1])),
                                        length(minus(triangle[0], triangle[2]))};
    const auto i = static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) -
                                            lengths.begin());
    if (lengths[i] < bound / constants.least_part) return false;
    const Point3 &a = triangle[i], &b = triangle[(i + 1) % 3], &c = triangle[(i + 2) % 3];
    const Point3 middle = towards(a, b, 0.5);
    const std::uint32_t hint = containment.hint;
    if (!contains_part({a, middle, c}, containment, bound, budget, search)) return false;
    Containment other{hint, containment.isolated};
    const bool is_contained = contains_part({middle, b, c}, other, bound, budget, search);
    containment.isolated = other.isolated;
    return is_contained;
}

std::optional<ReferenceSurface::Containment>
ReferenceSurface::contains_within_tolerance(const Corners& triangle, std::uint32_t hint,
                                            Search& search) const {
    search.seen_.resize(facets_.size(), 0);
    unsigned budget = constants.most_parts;
    Containment containment{hint, true};
    const double bound = bound_of_[features_.sheet_of[hint]] - slack_;
    if (!contains_part(triangle, containment, bound, budget, search)) return std::nullopt;
    return containment;
}

Point3 nearest_in_box(const Point3& p, std::span<const Point3> points) {
    Point3 nearest = p;
    for (double Point3::*const c : {&Point3::x, &Point3::y, &Point3::z}) {
        const auto [low, high] = std::ranges::minmax(points, {}, c);
        nearest.*c = std::clamp(p.*c, low.*c, high.*c);
    }
    return nearest;
}

std::optional<ReferenceSurface::Place>
ReferenceSurface::above(const Point3& p, const Point3& normal, std::uint32_t hint) const {
    const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
    const Axis axis = z >= x && z >= y ? Axis::z : x >= y ? Axis::x : Axis::y;
    const Frame frame = frame_of(axis);
    const int orientation = orientation_of(hint, frame);
    if (orientation == 0) return std::nullopt;
    const Walk way = walk(frame, p, {}, orientation, hint);
    if (!way.arrived) return std::nullopt;
    const Corners& corners = facets_[way.end].corners;
    const std::array<Flat, 3> c{frame.flat(minus(corners[0], p)), frame.flat(minus(corners[1], p)),
                                frame.flat(minus(corners[2], p))};
    std::array<double, 3> shares{};
    double sum = 0;
    for (std::size_t e = 0; e < 3; ++e) {
        const Flat &a = c[(e + 1) % 3], &b = c[(e + 2) % 3];
        shares[e] = std::max(0.0, (a.u * b.v - a.v * b.u) * orientation);
        sum += shares[e];
    }
    if (!(sum > 0)) return std::nullopt;
    const double height = (shares[0] * c[0].w + shares[1] * c[1].w + shares[2] * c[2].w) / sum;
    Point3 place = p;
    (axis == Axis::x ? place.x : axis == Axis::y ? place.y : place.z) += height;
    return Place{nearest_in_box(place, corners), way.end};
}

} // namespace terrane::quality::detail
