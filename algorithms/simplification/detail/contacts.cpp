// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/contacts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/simplification/detail/tuning.hpp>
#include <terrane/algorithms/simplification/detail/ways.hpp>

namespace terrane::simplification::detail {
namespace {

using Kind = CurveNetwork::Kind;

Point3 towards(const Point3& a, const Point3& b, double t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

double apart(const Point3& a, const Point3& b) {
    return length(minus(b, a));
}

/// Returns the share of the way from a to b at which the point nearest to p is.
double nearest_on_edge(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 d = minus(b, a);
    const double square = dot(d, d);
    return square > 0 ? std::clamp(dot(minus(p, a), d) / square, 0.0, 1.0) : 0;
}

/// Returns the shares at which two lines are nearest, if both are within their edges.
std::optional<std::array<double, 2>> nearest_within(const Point3& a, const Point3& b,
                                                    const Point3& c, const Point3& d) {
    const Point3 u = minus(b, a), v = minus(d, c), w = minus(a, c);
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const double det = uu * vv - uv * uv;
    if (!(det > 1e-12 * uu * vv)) return std::nullopt;
    const double s = (uv * vw - vv * uw) / det, t = (uu * vw - uv * uw) / det;
    if (!(s > 0 && s < 1 && t > 0 && t < 1)) return std::nullopt;
    return std::array{s, t};
}

Place at_vertex(std::uint32_t v) {
    return {{v, none, none}, {1, 0, 0}, 1};
}

Place on_edge(std::uint32_t a, std::uint32_t b, double at) {
    if (a < b) return {{a, b, none}, {1 - at, at, 0}, 2};
    return {{b, a, none}, {at, 1 - at, 0}, 2};
}

/// The place on an edge, or at its end if it is there.
Place on_closed_edge(std::uint32_t a, std::uint32_t b, double at) {
    return at <= 0 ? at_vertex(a) : at >= 1 ? at_vertex(b) : on_edge(a, b, at);
}

/// The place within a cell, by its weights.
Place in_cell(Triangle c, std::array<double, 3> w) {
    for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)})
        if (c[static_cast<std::size_t>(i)] > c[static_cast<std::size_t>(j)]) {
            std::swap(c[static_cast<std::size_t>(i)], c[static_cast<std::size_t>(j)]);
            std::swap(w[static_cast<std::size_t>(i)], w[static_cast<std::size_t>(j)]);
        }
    return {c, w, 3};
}

/// Searches contacts of one pair of cells, or of a place.
class Finder {
public:
    Finder(const Complex& complex, const CurveNetwork& curves, double resolution) :
        complex_(complex), points_(complex.points()), curves_(curves), resolution_(resolution) {}

    /// Adds the contacts of two cells to `raw`, and cells to `to_divide`. They are not judged yet.
    void examine(std::uint32_t s, std::uint32_t t, std::vector<NearPlaces>& raw,
                 std::vector<std::uint32_t>& to_divide) const {
        const Triangle &a = complex_.cells()[s].corners, &b = complex_.cells()[t].corners;
        if (are_beyond(a, b) || are_beyond(b, a)) return;
        vertices_of(a, b, raw);
        vertices_of(b, a, raw);
        edges_of(a, b, raw);
        const auto common =
            std::count_if(a.begin(), a.end(), [&](std::uint32_t v) { return contains(b, v); });
        if (common == 0 || common == 3) return;
        if (longest_edge(a) <= tuning.longest_edge * resolution_ &&
            longest_edge(b) <= tuning.longest_edge * resolution_)
            return;
        if (are_a_wedge(a, b) || are_a_wedge(b, a)) {
            to_divide.push_back(s);
            to_divide.push_back(t);
        }
    }

    /// Judges a contact by the rules; see the header.
    [[nodiscard]] bool is_contact(NearPlaces& c) const {
        const Ways ways(complex_, curves_);
        c.on_surfaces = is_nearest_on_surfaces(c) && ways.are_far_along_surfaces(c);
        if (c.on_surfaces) return true;
        if (is_corner(c.from) && is_corner(c.to)) return true;
        return is_on_curve(c.from) && is_on_curve(c.to) && is_nearest_on_curves(c) &&
               ways.are_far_along_curves(c);
    }

    [[nodiscard]] double longest_edge(const Triangle& t) const {
        return std::max({apart(points_[t[0]], points_[t[1]]), apart(points_[t[1]], points_[t[2]]),
                         apart(points_[t[2]], points_[t[0]])});
    }

    /// Puts a corner or an edge that is near enough in place of the place itself.
    void simplify(NearPlaces& c) const {
        const Point3 p = place(c.to), x = place(c.from);
        for (const std::uint32_t v : c.from.vertices())
            if (c.from.size > 1 && apart(points_[v], x) < tuning.to_corner * resolution_ &&
                apart(points_[v], p) < resolution_) {
                c.from = at_vertex(v);
                break;
            }
        for (const std::uint32_t v : c.to.vertices())
            if (c.to.size > 1 && apart(points_[v], p) < tuning.to_corner * resolution_ &&
                apart(points_[v], x) < resolution_) {
                c.to = at_vertex(v);
                return;
            }
        if (c.to.size < 3) return;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = c.to.corners[i], b = c.to.corners[(i + 1) % 3];
            const double at = nearest_on_edge(p, points_[a], points_[b]);
            if (at > 0 && at < 1 &&
                apart(towards(points_[a], points_[b], at), p) < tuning.to_edge * resolution_) {
                c.to = on_edge(a, b, at);
                return;
            }
        }
    }

private:
    [[nodiscard]] Point3 place(const Place& p) const {
        return complex_.between(p.vertices(), p.shares()).place;
    }

    [[nodiscard]] bool is_corner(const Place& p) const {
        return p.size == 1 && curves_.kind_of[p.corners[0]] == Kind::corner;
    }
    [[nodiscard]] bool is_on_curve(const Place& p) const {
        return p.size == 1 ? curves_.kind_of[p.corners[0]] != Kind::inner
                           : p.size == 2 && curves_.has(p.corners[0], p.corners[1]);
    }

    /// Tells whether all of b is beyond the resolution on one side of the plane of a.
    [[nodiscard]] bool are_beyond(const Triangle& a, const Triangle& b) const {
        const Point3& o = points_[a[0]];
        const Point3 n = cross(minus(points_[a[1]], o), minus(points_[a[2]], o));
        const double limit = resolution_ * length(n);
        const auto height = [&](std::uint32_t v) { return dot(minus(points_[v], o), n); };
        const double h = height(b[0]), i = height(b[1]), j = height(b[2]);
        return (h > limit && i > limit && j > limit) || (h < -limit && i < -limit && j < -limit);
    }

    /// Tells whether the box of two points is farther from another box than the resolution.
    [[nodiscard]] bool are_apart(const Point3& p, const Point3& q, const Box& box) const {
        for (unsigned k = 0; k < 3; ++k) {
            const double a = coordinate(p, k), b = coordinate(q, k);
            if (std::min(a, b) > box.high[k] + resolution_ ||
                std::max(a, b) < box.low[k] - resolution_)
                return true;
        }
        return false;
    }

    void add(const Place& from, const Place& to, std::vector<NearPlaces>& raw) const {
        const double d = apart(place(from), place(to));
        if (d < resolution_) raw.push_back({d, from, to});
    }

    /// Adds the contacts of the corners of a with b.
    void vertices_of(const Triangle& a, const Triangle& b, std::vector<NearPlaces>& raw) const {
        for (const std::uint32_t v : a) {
            if (contains(b, v)) continue;
            const Point3& x = points_[v];
            if (are_apart(x, x, box_of(points_, b))) continue;
            if (const auto to = nearest_in_cell(x, b);
                !(to.size < 3 && std::all_of(to.vertices().begin(), to.vertices().end(),
                                             [&](std::uint32_t w) { return contains(a, w); })))
                add(at_vertex(v), to, raw);
            if (curves_.kind_of[v] == Kind::inner) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t p = b[i], q = b[(i + 1) % 3];
                if (curves_.has(p, q))
                    add(at_vertex(v),
                        on_closed_edge(p, q, nearest_on_edge(x, points_[p], points_[q])), raw);
                if (curves_.kind_of[v] == Kind::corner && curves_.kind_of[p] == Kind::corner &&
                    v < p)
                    add(at_vertex(v), at_vertex(p), raw);
            }
        }
    }

    /// Adds the contacts of the edges of a with those of b, both within.
    void edges_of(const Triangle& a, const Triangle& b, std::vector<NearPlaces>& raw) const {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const std::uint32_t p = a[i], q = a[(i + 1) % 3], r = b[j], s = b[(j + 1) % 3];
                if (p == r || p == s || q == r || q == s) continue;
                const Point3 &x1 = points_[r], &y1 = points_[s];
                if (are_apart(points_[p], points_[q],
                              {{std::min(x1.x, y1.x), std::min(x1.y, y1.y), std::min(x1.z, y1.z)},
                               {std::max(x1.x, y1.x), std::max(x1.y, y1.y), std::max(x1.z, y1.z)}}))
                    continue;
                const auto at = nearest_within(points_[p], points_[q], points_[r], points_[s]);
                if (!at) continue;
                const Place x = on_edge(p, q, (*at)[0]), y = on_edge(r, s, (*at)[1]);
                add(std::min(p, q) < std::min(r, s) ? x : y,
                    std::min(p, q) < std::min(r, s) ? y : x, raw);
            }
    }

    [[nodiscard]] Place nearest_in_cell(const Point3& x, const Triangle& t) const {
        const Point3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
        const Point3 n = cross(minus(b, a), minus(c, a));
        const double square = dot(n, n);
        const Point3 d = minus(x, a);
        const double v = square > 0 ? dot(cross(d, minus(c, a)), n) / square : -1;
        const double w = square > 0 ? dot(cross(minus(b, a), d), n) / square : -1;
        if (v > 0 && w > 0 && v + w < 1) return in_cell(t, {1 - v - w, v, w});
        double least = std::numeric_limits<double>::infinity();
        Place best;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = t[i], q = t[(i + 1) % 3];
            const double at = nearest_on_edge(x, points_[p], points_[q]);
            const double distance = apart(towards(points_[p], points_[q], at), x);
            if (distance >= least) continue;
            least = distance;
            best = on_closed_edge(p, q, at);
        }
        return best;
    }

    /// Tells whether a surface comes near to b along a, which has corners in common with b: within
    /// the resolution, but not next to it along the surfaces.
    [[nodiscard]] bool are_a_wedge(const Triangle& a, const Triangle& b) const {
        for (const std::uint32_t c : a) {
            if (!contains(b, c)) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t p = a[i], q = a[(i + 1) % 3];
                if (contains(b, p) && contains(b, q)) continue; // not within a
                const Point3 end = p == c   ? points_[q]
                                   : q == c ? points_[p]
                                            : towards(points_[p], points_[q], 0.5);
                const double edge = apart(points_[c], end);
                const double way = std::min(edge, tuning.longest_edge * resolution_);
                if (is_near_along(towards(points_[c], end, way / edge), way, a, b, c)) return true;
            }
        }
        return false;
    }

    [[nodiscard]] bool is_near_along(const Point3& x, double way, const Triangle& a,
                                     const Triangle& b, std::uint32_t c) const {
        NearPlaces near{0, at_vertex(c), nearest_in_cell(x, b)};
        const Point3 p = place(near.to);
        near.distance = apart(x, p);
        if (!(near.distance < resolution_) || near.distance == 0) return false;
        const double along = way + apart(points_[c], p);
        if (along < tuning.far_along * near.distance) return false;
        const auto is_shared = [&](std::uint32_t v) { return contains(a, v); };
        if (std::all_of(near.to.vertices().begin(), near.to.vertices().end(), is_shared))
            return false;
        return is_nearest(x, near.to);
    }

    [[nodiscard]] std::vector<std::uint32_t> cells_at(const Place& p) const {
        if (p.size == 2) return complex_.star(p.corners[0], p.corners[1]);
        if (p.size == 1) {
            const auto star = complex_.star(p.corners[0]);
            return {star.begin(), star.end()};
        }
        return {};
    }

    /// Tells whether no cell around a place leads from there towards x: by the angle, so that cells
    /// may be as narrow as they like.
    [[nodiscard]] bool is_nearest(const Point3& x, const Place& to) const {
        const Point3 p = place(to), way = minus(x, p);
        const double distance = length(way);
        const Point3 towards_x{way.x / distance, way.y / distance, way.z / distance};
        const auto cells = cells_at(to);
        return std::all_of(cells.begin(), cells.end(), [&](std::uint32_t t) {
            const Triangle& c = complex_.cells()[t].corners;
            return (to.size == 2 ? slope_at_edge(c, to, towards_x)
                                 : slope_at_vertex(c, to.corners[0], towards_x)) <= tuning.towards;
        });
    }

    /// Cosine of the angle between a direction and the one in a triangle away from its edge.
    [[nodiscard]] double slope_at_edge(const Triangle& c, const Place& edge,
                                       const Point3& direction) const {
        const Point3& a = points_[edge.corners[0]];
        const Point3 along = minus(points_[edge.corners[1]], a);
        std::uint32_t third = c[0];
        for (const std::uint32_t v : c)
            if (v != edge.corners[0] && v != edge.corners[1]) third = v;
        const Point3 side = minus(points_[third], a);
        const double share = dot(side, along) / dot(along, along);
        const Point3 away{side.x - share * along.x, side.y - share * along.y,
                          side.z - share * along.z};
        const double size = length(away);
        return size > 0 ? dot(away, direction) / size : -1;
    }

    /// Cosine of the least angle between a direction and those in a triangle from its corner v.
    [[nodiscard]] double slope_at_vertex(const Triangle& c, std::uint32_t v,
                                         const Point3& direction) const {
        const std::size_t i = c[0] == v ? 0 : c[1] == v ? 1 : 2;
        const Point3 e = minus(points_[c[(i + 1) % 3]], points_[v]);
        const Point3 f = minus(points_[c[(i + 2) % 3]], points_[v]);
        const Point3 n = cross(e, f);
        const double best = std::max(dot(e, direction) / length(e), dot(f, direction) / length(f));
        const double square = dot(n, n);
        if (!(square > 0)) return best;
        const double height = dot(n, direction) / std::sqrt(square);
        const bool is_within = dot(cross(e, direction), n) > 0 && dot(cross(direction, f), n) > 0;
        return is_within ? std::sqrt(std::max(0.0, 1 - height * height)) : best;
    }

    [[nodiscard]] bool is_nearest_on_surfaces(const NearPlaces& c) const {
        return is_nearest(place(c.from), c.to) && is_nearest(place(c.to), c.from);
    }

    /// The same among curve edges.
    [[nodiscard]] bool is_nearest_on_curves(const NearPlaces& c) const {
        if (c.to.size == 2) return true;
        const Point3 x = place(c.from);
        const std::uint32_t w = c.to.corners[0];
        const auto& ends = curves_.neighbours[w];
        return std::all_of(ends.begin(), ends.end(), [&](std::uint32_t end) {
            const Point3 edge = minus(points_[end], points_[w]), way = minus(x, points_[w]);
            return dot(edge, way) <= tuning.towards * length(edge) * c.distance;
        });
    }

    const Complex& complex_;
    const std::vector<Point3>& points_;
    const CurveNetwork& curves_;
    const double resolution_;
};

using Part = std::pair<std::vector<NearPlaces>, std::vector<std::uint32_t>>;

auto key_of(const NearPlaces& c) {
    return std::tie(c.from.corners, c.to.corners);
}

/// Keeps the nearest contact of each key. Two pairs of cells may give equal distances with other weights,
/// so these decide too: their order depends on the threads.
void sort_and_unite(std::vector<NearPlaces>& contacts) {
    const auto all_of = [](const NearPlaces& c) {
        return std::tuple(key_of(c), c.distance, std::tie(c.from.weights, c.to.weights),
                          c.on_surfaces);
    };
    std::sort(contacts.begin(), contacts.end(),
              [&](const NearPlaces& a, const NearPlaces& b) { return all_of(a) < all_of(b); });
    contacts.erase(std::unique(contacts.begin(), contacts.end(),
                               [](const NearPlaces& a, const NearPlaces& b) {
                                   return key_of(a) == key_of(b);
                               }),
                   contacts.end());
}

/// Pairs of cells that may be near, at least one of them active.
std::vector<std::array<std::uint32_t, 2>> near_cells(const Complex& complex, double resolution,
                                                     std::span<const std::uint32_t> active,
                                                     const Run& run) {
    std::vector<Box> boxes;
    std::vector<std::uint32_t> cell_of, number_of(complex.cells().size(), none), wanted;
    for (std::uint32_t t = 0; t < complex.cells().size(); ++t) {
        if (!complex.has(t)) continue;
        Box box = box_of(complex.points(), complex.cells()[t].corners);
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] -= resolution / 2;
            box.high[k] += resolution / 2;
        }
        number_of[t] = static_cast<std::uint32_t>(boxes.size());
        boxes.push_back(box);
        cell_of.push_back(t);
    }
    for (const std::uint32_t t : active)
        if (number_of[t] != none) wanted.push_back(number_of[t]);
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const auto& [s, t] : candidate_pairs_of(boxes, wanted, {}, {}, without_progress(run)))
        pairs.push_back({cell_of[s], cell_of[t]});
    return pairs;
}

} // namespace

Found find_contacts(const Complex& complex, const CurveNetwork& curves, double resolution,
                    std::span<const std::uint32_t> active, const Run& run) {
    const auto pairs = near_cells(complex, resolution, active, run);
    const StandardArithmetic guard;
    const Finder finder(complex, curves, resolution);
    Found found;
    for (auto& [contacts, cells] :
         parts_of_ranges<Part>(pairs.size(), run, [&](std::size_t first, std::size_t last) {
             Part part;
             for (std::size_t i = first; i < last; ++i)
                 finder.examine(pairs[i][0], pairs[i][1], part.first, part.second);
             sort_and_unite(part.first);
             return part;
         })) {
        found.contacts.insert(found.contacts.end(), contacts.begin(), contacts.end());
        found.to_divide.insert(found.to_divide.end(), cells.begin(), cells.end());
    }
    sort_and_unite(found.contacts);
    auto& contacts = found.contacts;
    std::vector<char> good(contacts.size());
    for_ranges(
        contacts.size(), run,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) good[i] = finder.is_contact(contacts[i]);
        },
        16, 256);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i)
        if (good[i] != 0) contacts[kept++] = contacts[i];
    contacts.resize(kept);
    const auto is_long = [&](std::uint32_t t) {
        return finder.longest_edge(complex.cells()[t].corners) > tuning.longest_edge * resolution;
    };
    for (const NearPlaces& c : contacts) {
        if (!c.on_surfaces) continue;
        for (const Place* place : {&c.from, &c.to})
            for (const std::uint32_t t : complex.star(place->corners[0]))
                if (std::all_of(
                        place->vertices().begin(), place->vertices().end(),
                        [&](std::uint32_t v) { return contains(complex.cells()[t].corners, v); }))
                    found.to_divide.push_back(t);
    }
    for (NearPlaces& c : contacts) finder.simplify(c);
    std::erase_if(contacts, [&](const NearPlaces& c) {
        const auto to = c.to.vertices(), from = c.from.vertices();
        const bool have_common = std::any_of(from.begin(), from.end(), [&](std::uint32_t v) {
            return std::find(to.begin(), to.end(), v) != to.end();
        });
        const bool is_crossing =
            c.from.size > 1 && c.to.size > 1 && c.distance < tuning.crossing * resolution;
        return have_common || is_crossing;
    });
    sort_and_unite(contacts);
    std::sort(contacts.begin(), contacts.end(), [](const NearPlaces& a, const NearPlaces& b) {
        return std::tuple(a.distance, key_of(a)) < std::tuple(b.distance, key_of(b));
    });
    auto& cells = found.to_divide;
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    std::erase_if(cells, [&](std::uint32_t t) { return !is_long(t); });
    return found;
}

} // namespace terrane::simplification::detail
