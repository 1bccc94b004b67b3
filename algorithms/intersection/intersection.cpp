// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/intersection/intersection.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/kernel/plane_filter.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr Simplex corner(unsigned i) {
    return static_cast<Simplex>(i);
}
constexpr Simplex edge(unsigned i) {
    return static_cast<Simplex>(3 + i);
}
constexpr unsigned next(unsigned i) {
    return i == 2 ? 0 : i + 1;
}

using Signs = std::array<Sign, 3>;

bool all_on_one_side(const Signs& s) {
    return s[0] != Sign::Zero && s[0] == s[1] && s[1] == s[2];
}

bool all_zero(const Signs& s) {
    return s[0] == Sign::Zero && s[1] == Sign::Zero && s[2] == Sign::Zero;
}

bool opposite(Sign a, Sign b) {
    return a * b == Sign::Negative;
}

/// Returns the simplex on which a point lies, given its sides with respect to the three directed
/// edges (positive inside); std::nullopt if it lies outside.
std::optional<Simplex> place_from_sides(const Signs& inside) {
    unsigned zeros = 0, zero = 0, other = 0;
    for (unsigned j = 0; j < 3; ++j) {
        if (inside[j] == Sign::Negative) return std::nullopt;
        if (inside[j] == Sign::Zero) {
            ++zeros;
            zero = j;
        } else {
            other = j;
        }
    }
    if (zeros == 0) return Simplex::face;
    if (zeros == 1) return edge(zero);
    return corner((other + 2) % 3); // opposite to the edge that is not in line with the point
}

/// Two triangles and the predicates evaluated for them so far. Index k is 0 for the first triangle
/// and 1 for the second.
class TrianglePair {
public:
    TrianglePair(std::span<const Point3> points, const Triangle& first, const Triangle& second) :
        points_(points), t_{first, second} {
        for (unsigned i = 0; i < 3; ++i)
            for (unsigned j = 0; j < 3; ++j)
                if (first[i] == second[j]) {
                    shared_[0][i] = corner(j);
                    shared_[1][j] = corner(i);
                    ++shared_count_;
                }
    }

    [[nodiscard]] bool quickly_apart() const;
    /// Returns the contact, if it is improper.
    [[nodiscard]] std::optional<Contact> contact();

private:
    const Point3& at(unsigned k, unsigned i) const { return points_[t_[k][i]]; }
    bool is_shared(unsigned k, unsigned i) const { return shared_[k][i] != Simplex::face; }

    bool quickly_beside_plane(unsigned k) const;
    bool quickly_beside_edge(unsigned k, Axis axis) const;
    Axis likely_axis() const;
    Signs sides(unsigned k) const;
    void set_axis(unsigned k);
    std::optional<Simplex> locate_in_plane(unsigned k, unsigned i);
    std::optional<Simplex> pierce(unsigned k, unsigned i) const;
    [[nodiscard]] bool is_improper();
    void add_corner(unsigned k, unsigned i, Simplex on_other);
    void add_edge_point(unsigned k, unsigned i, Simplex on_other);
    void add(const Construction& how, unsigned k, Simplex on_k, Simplex on_other);
    void cross_planes(unsigned k);
    void overlap_in_plane();
    void collect_pieces(unsigned k);
    bool only_shared_corners() const;

    std::span<const Point3> points_;
    std::array<Triangle, 2> t_;
    // Per corner: the corner of the other triangle that is the same vertex, or `face` for none.
    std::array<std::array<Simplex, 3>, 2> shared_{{{Simplex::face, Simplex::face, Simplex::face},
                                                   {Simplex::face, Simplex::face, Simplex::face}}};
    unsigned shared_count_ = 0;
    std::array<Signs, 2> sides_{}; // sides of the corners of k with respect to the other's plane
    std::array<bool, 2> axis_known_{};
    std::array<Axis, 2> axis_{};
    std::array<Sign, 2> turn_{}; // orientation of triangle k in its projection
    Contact* contact_ = nullptr; ///< at hand, while it is found
};

Signs TrianglePair::sides(unsigned k) const {
    Signs s{};
    for (unsigned i = 0; i < 3; ++i)
        if (!is_shared(k, i)) s[i] = orient3d(at(1 - k, 0), at(1 - k, 1), at(1 - k, 2), at(k, i));
    return s;
}

void TrianglePair::set_axis(unsigned k) {
    if (axis_known_[k]) return;
    axis_known_[k] = true;
    for (const Axis axis : {Axis::z, Axis::x, Axis::y}) {
        axis_[k] = axis;
        turn_[k] = orient2d(axis, at(k, 0), at(k, 1), at(k, 2));
        if (turn_[k] != Sign::Zero) return;
    }
}

/// Locates corner i of triangle k, which lies in the other's plane, on the other triangle.
std::optional<Simplex> TrianglePair::locate_in_plane(unsigned k, unsigned i) {
    if (is_shared(k, i)) return shared_[k][i];
    const unsigned o = 1 - k;
    set_axis(o);
    Signs inside{};
    for (unsigned j = 0; j < 3; ++j) {
        inside[j] = turn_[o] * orient2d(axis_[o], at(o, j), at(o, next(j)), at(k, i));
        if (inside[j] == Sign::Negative) return std::nullopt;
    }
    return place_from_sides(inside);
}

/// Locates the point where edge i of triangle k pierces the other triangle. The ends of the edge
/// lie on opposite sides of the other's plane.
std::optional<Simplex> TrianglePair::pierce(unsigned k, unsigned i) const {
    const unsigned o = 1 - k;
    const Sign up = sides_[k][next(i)];
    Signs inside{};
    for (unsigned j = 0; j < 3; ++j) {
        // Around a line that goes up through a counterclockwise triangle, each edge of the triangle
        // runs counterclockwise.
        inside[j] = up * orient3d(at(k, i), at(k, next(i)), at(o, j), at(o, next(j)));
        if (inside[j] == Sign::Negative) return std::nullopt;
    }
    return place_from_sides(inside);
}

void TrianglePair::add(const Construction& how, unsigned k, Simplex on_k, Simplex on_other) {
    const auto end = contact_->points.begin() + contact_->point_count;
    if (std::any_of(contact_->points.begin(), end, [&](const auto& p) { return p.how == how; }))
        return;
    ContactPoint& point = contact_->points[contact_->point_count++];
    point.how = how;
    point.place[k] = on_k;
    point.place[1 - k] = on_other;
}

void TrianglePair::add_corner(unsigned k, unsigned i, Simplex on_other) {
    Construction how;
    how.v[0] = t_[k][i];
    add(how, k, corner(i), on_other);
}

void TrianglePair::add_edge_point(unsigned k, unsigned i, Simplex on_other) {
    const unsigned o = 1 - k;
    const std::array line{t_[k][i], t_[k][next(i)]};
    if (is_corner(on_other)) {
        Construction how;
        how.v[0] = t_[o][corner_of(on_other)];
        add(how, k, edge(i), on_other);
    } else if (is_edge(on_other)) {
        const unsigned j = edge_of(on_other);
        add(line_line(points_, line, {t_[o][j], t_[o][next(j)]}), k, edge(i), on_other);
    } else {
        add(line_plane(line, t_[o]), k, edge(i), on_other);
    }
}

/// Adds the points in which corners and edges of triangle k meet the other triangle. The triangles
/// are not coplanar.
void TrianglePair::cross_planes(unsigned k) {
    for (unsigned i = 0; i < 3; ++i) {
        if (sides_[k][i] == Sign::Zero) {
            if (const auto place = locate_in_plane(k, i)) add_corner(k, i, *place);
        } else if (opposite(sides_[k][i], sides_[k][next(i)])) {
            if (const auto place = pierce(k, i)) add_edge_point(k, i, *place);
        }
    }
}

/// Adds all corners of the common polygon of two coplanar triangles.
void TrianglePair::overlap_in_plane() {
    set_axis(0);
    axis_known_[1] = true;
    axis_[1] = axis_[0];
    turn_[1] = orient2d(axis_[1], at(1, 0), at(1, 1), at(1, 2));
    // inside[k][j][i]: side of corner i of triangle k with respect to edge j of the other triangle
    std::array<std::array<Signs, 3>, 2> inside{};
    for (unsigned k = 0; k < 2; ++k)
        for (unsigned j = 0; j < 3; ++j) {
            const unsigned o = 1 - k;
            for (unsigned i = 0; i < 3; ++i) {
                const bool on_edge = shared_[k][i] == corner(j) || shared_[k][i] == corner(next(j));
                inside[k][j][i] =
                    on_edge ? Sign::Zero
                            : turn_[o] * orient2d(axis_[o], at(o, j), at(o, next(j)), at(k, i));
            }
            if (inside[k][j] == Signs{Sign::Negative, Sign::Negative, Sign::Negative}) return;
        }
    for (unsigned k = 0; k < 2; ++k)
        for (unsigned i = 0; i < 3; ++i)
            if (const auto place =
                    place_from_sides({inside[k][0][i], inside[k][1][i], inside[k][2][i]}))
                add_corner(k, i, *place);
    for (unsigned i = 0; i < 3; ++i)
        for (unsigned j = 0; j < 3; ++j)
            if (opposite(inside[0][j][i], inside[0][j][next(i)]) &&
                opposite(inside[1][i][j], inside[1][i][next(j)]))
                add_edge_point(0, i, edge(j));
}

/// Collects the parts of the other triangle's edges that lie in triangle k, which is coplanar.
void TrianglePair::collect_pieces(unsigned k) {
    for (std::uint8_t j = 0; j < 3; ++j) {
        std::array<std::uint8_t, 2> ends{};
        unsigned found = 0;
        for (std::uint8_t p = 0; p < contact_->point_count && found < 2; ++p)
            if (on_closed_edge(contact_->points[p].place[1 - k], j)) ends[found++] = p;
        if (found == 0) continue;
        if (found == 1) ends[1] = ends[0];
        contact_->pieces[k][contact_->piece_count[k]++] = {ends, j};
    }
}

bool TrianglePair::only_shared_corners() const {
    const auto end = contact_->points.begin() + contact_->point_count;
    return std::all_of(contact_->points.begin(), end, [](const ContactPoint& p) {
        return is_corner(p.place[0]) && is_corner(p.place[1]);
    });
}

/// Whether the static filters alone show that triangle k, except for at most two common corners,
/// lies strictly on one side of the other's plane.
bool TrianglePair::quickly_beside_plane(unsigned k) const {
    const PlaneFilter plane(at(1 - k, 0), at(1 - k, 1), at(1 - k, 2));
    std::optional<Sign> common;
    for (unsigned i = 0; i < 3; ++i) {
        if (is_shared(k, i)) continue;
        const auto s = plane.side(at(k, i));
        if (!s || (common && *common != *s)) return false;
        common = s;
    }
    // The triangles then share only points of the plane: the hull of the common corners.
    return true;
}

/// Whether the static filters alone show that in one projection the other triangle, except for
/// common corners on an edge of triangle k, lies strictly on the outer side of that edge's line.
bool TrianglePair::quickly_beside_edge(unsigned k, Axis axis) const {
    const unsigned o = 1 - k;
    const auto turn = filtered_orient2d(axis, at(k, 0), at(k, 1), at(k, 2));
    if (!turn || *turn == Sign::Zero) return false;
    for (unsigned j = 0; j < 3; ++j) {
        bool beyond = true;
        for (unsigned i = 0; i < 3 && beyond; ++i) {
            if (is_shared(o, i)) {
                beyond = shared_[o][i] != corner((j + 2) % 3);
                continue;
            }
            const auto s = filtered_orient2d(axis, at(k, j), at(k, next(j)), at(o, i));
            beyond = s && *s == -*turn;
        }
        if (beyond) return true;
    }
    return false;
}

/// Chooses the axis of the projection. Any axis is correct; a long normal separates more.
Axis TrianglePair::likely_axis() const {
    const Point3 &a = at(0, 0), &b = at(0, 1), &c = at(0, 2);
    const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
    const double wx = c.x - a.x, wy = c.y - a.y, wz = c.z - a.z;
    const double x = std::fabs(uy * wz - uz * wy), y = std::fabs(uz * wx - ux * wz);
    const double z = std::fabs(ux * wy - uy * wx);
    return z >= x && z >= y ? Axis::z : x >= y ? Axis::x : Axis::y;
}

/// Whether the static filters alone show that the triangles share only the hull of their common
/// corners.
bool TrianglePair::quickly_apart() const {
    if (quickly_beside_plane(0) || quickly_beside_plane(1)) return true;
    const Axis axis = likely_axis();
    return quickly_beside_edge(0, axis) || quickly_beside_edge(1, axis);
}

bool TrianglePair::is_improper() {
    sides_[0] = sides(0);
    if (all_on_one_side(sides_[0])) return false;
    if (shared_count_ == 2 && !all_zero(sides_[0])) return false;
    if (all_zero(sides_[0])) {
        contact_->coplanar = true;
        overlap_in_plane();
        if (only_shared_corners() && contact_->point_count < 3) return false;
        contact_->overlap = contact_->point_count > 2; // all points are extreme points
        collect_pieces(0);
        collect_pieces(1);
        return true;
    }
    sides_[1] = sides(1);
    if (all_on_one_side(sides_[1])) return false;
    cross_planes(0);
    cross_planes(1);
    if (only_shared_corners()) return false;
    ContactPiece piece;
    piece.ends = {0, static_cast<std::uint8_t>(contact_->point_count - 1)};
    contact_->piece_count = {1, 1};
    contact_->pieces[0][0] = contact_->pieces[1][0] = piece;
    return true;
}

std::optional<Contact> TrianglePair::contact() {
    std::optional<Contact> found(std::in_place);
    contact_ = &*found;
    if (!is_improper()) found.reset();
    return found;
}

} // namespace

// A Contact is large: most pairs are apart, and make none.
std::optional<Contact> improper_contact(std::span<const Point3> points, const Triangle& first,
                                        const Triangle& second, Filters filters) {
    TrianglePair pair(points, first, second);
    if (filters == Filters::all && pair.quickly_apart()) return std::nullopt;
    return pair.contact();
}

Construction line_plane(std::array<std::uint32_t, 2> line, Triangle plane) {
    std::sort(line.begin(), line.end());
    std::sort(plane.begin(), plane.end());
    Construction how;
    how.kind = Construction::Kind::line_plane;
    how.v = {line[0], line[1], plane[0], plane[1], plane[2]};
    return how;
}

Construction three_planes(Triangle first, Triangle second, Triangle third) {
    std::array planes{first, second, third};
    for (Triangle& plane : planes) std::sort(plane.begin(), plane.end());
    std::sort(planes.begin(), planes.end());
    Construction how;
    how.kind = Construction::Kind::three_planes;
    for (unsigned i = 0; i < 9; ++i) how.v[i] = planes[i / 3][i % 3];
    return how;
}

Construction line_line(std::span<const Point3> points, std::array<std::uint32_t, 2> first,
                       std::array<std::uint32_t, 2> second) {
    std::sort(first.begin(), first.end());
    std::sort(second.begin(), second.end());
    if (second < first) std::swap(first, second);
    Construction how;
    how.kind = Construction::Kind::line_line;
    how.v = {first[0], first[1], second[0], second[1]};
    for (const Axis axis : {Axis::z, Axis::x, Axis::y}) {
        how.axis = axis;
        if (turn2d(axis, points[first[0]], points[first[1]], points[second[0]],
                   points[second[1]]) != Sign::Zero)
            break;
    }
    return how;
}

} // namespace terrane
