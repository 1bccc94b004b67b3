// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/separation_faces.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/kernel/double_double.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>

namespace terrane::rounding::detail {
namespace {

std::array<Point3, 3> corners_of(const MovedParts& moved, std::uint32_t face) {
    const Triangle& c = moved.faces[face];
    return {moved.face_points[c[0]], moved.face_points[c[1]], moved.face_points[c[2]]};
}

/// Computes the unit normal with higher precision, for faces so thin that differences of doubles
/// lose most of its digits.
void refine(Face& f) {
    const ToNearest mode;
    using namespace polynomial;
    const auto at = [&](unsigned i) { return cartesian<DoubleDouble>(f.corners[i]); };
    const auto n = polynomial::cross(difference(at(1), at(0)), difference(at(2), at(0)));
    const Point3 normal{n.x.value(), n.y.value(), n.z.value()};
    const double size = length(normal), factor = 1 / size;
    const double error =
        4 * (n.x.error() + n.y.error() + n.z.error()) * factor + direction_factor * unit;
    if (!(size > smallest_area && error < f.functional_error)) return;
    f.normal = {normal.x * factor, normal.y * factor, normal.z * factor};
    f.functional_error = error;
}

// Measures a face. Differences of points err by one unit, and the altitude and the direction of the
// normal by a few units, relative to the length of an edge. The bounds are several times larger.
Face measure(const std::array<Point3, 3>& corners) {
    constexpr double thin = 0x1p+20; // longest edge to altitude
    Face f;
    f.corners = corners;
    const Point3 u = minus(corners[1], corners[0]), v = minus(corners[2], corners[0]),
                 w = minus(corners[2], corners[1]), n = cross(u, v);
    const double size = length(n), factor = 1 / size;
    f.normal = {n.x * factor, n.y * factor, n.z * factor};
    const double squared = std::max({dot(u, u), dot(v, v), dot(w, w)});
    f.extent = std::sqrt(squared);
    const bool usable = size > smallest_area && f.extent < longest_length;
    f.functional_error = usable ? direction_factor * unit * squared * factor
                                : std::numeric_limits<double>::infinity();
    if (usable && squared > thin * size) refine(f);
    return f;
}

/// Calls visit(k) for all k below `count`, under the default rounding mode.
template <class Visit>
void for_several(std::size_t count, const Run& run, const Visit& visit) {
    constexpr std::size_t least = 256; // calls per thread
    for_ranges(
        count, run,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) visit(k);
        },
        4, least);
}

/// Computes a ball that contains the points. Its centre is that of their box.
class BallMaker {
public:
    void add(const Point3& p) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    }
    /// The radius has room for the rounding errors of its computation.
    [[nodiscard]] Ball ball() const {
        const Point3 centre{low_.x + (high_.x - low_.x) / 2, low_.y + (high_.y - low_.y) / 2,
                            low_.z + (high_.z - low_.z) / 2};
        const Point3 up = minus(high_, centre), down = minus(centre, low_);
        const Point3 most{std::max(up.x, down.x), std::max(up.y, down.y), std::max(up.z, down.z)};
        return {centre, length(most) * (1 + size_share)};
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    Point3 low_{infinity, infinity, infinity}, high_{-infinity, -infinity, -infinity};
};

/// A grid of squares over a face, seen along the axis that its normal is closest to.
class FaceGrid {
public:
    /// Makes about one cell for each `per_cell` of `count` items.
    FaceGrid(const Face& f, std::size_t count, std::size_t per_cell) {
        const std::array<double, 3> n{std::fabs(f.normal.x), std::fabs(f.normal.y),
                                      std::fabs(f.normal.z)};
        const auto away = static_cast<unsigned>(std::max_element(n.begin(), n.end()) - n.begin());
        std::array<double, 2> size{};
        for (unsigned i = 0; i < 2; ++i) {
            axes_[i] = (away + 1 + i) % 3;
            const auto [low, high] =
                std::minmax({at(f.corners[0], i), at(f.corners[1], i), at(f.corners[2], i)});
            low_[i] = low;
            size[i] = high - low;
        }
        const double wanted = // a face fills half of it
            2 * static_cast<double>(count) / static_cast<double>(per_cell);
        const double side = std::sqrt(size[0] * size[1] / wanted);
        for (unsigned i = 0; i < 2; ++i) {
            per_length_[i] = 0;
            if (!(side > shortest_length && side < longest_length)) continue;
            cells_[i] =
                static_cast<std::uint32_t>(std::clamp(std::ceil(size[i] / side), 1.0, wanted));
            per_length_[i] = cells_[i] / size[i];
        }
    }
    [[nodiscard]] std::size_t size() const { return std::size_t{cells_[0]} * cells_[1]; }
    [[nodiscard]] std::size_t cell(const Point3& p) const {
        return index(p, 1) * cells_[0] + index(p, 0);
    }

private:
    [[nodiscard]] double at(const Point3& p, unsigned i) const {
        return axes_[i] == 0 ? p.x : axes_[i] == 1 ? p.y : p.z;
    }
    [[nodiscard]] std::size_t index(const Point3& p, unsigned i) const {
        const double place = (at(p, i) - low_[i]) * per_length_[i];
        return place > 0 ? static_cast<std::size_t>(std::min(place, cells_[i] - 1.0)) : 0;
    }

    std::array<unsigned, 2> axes_{};
    std::array<std::uint32_t, 2> cells_{1, 1};
    std::array<double, 2> low_{}, per_length_{};
};

/// Makes a cluster of the indices in [first, last) whose places are in one cell of the grid.
template <class PlaceOf, class AddAll>
PlaceClusters clusters_in(const FaceGrid& grid, std::uint32_t first, std::uint32_t last,
                          const PlaceOf& place_of, const AddAll& add_all) {
    std::vector<std::uint32_t> cells;
    cells.reserve(last - first);
    for (std::uint32_t k = first; k < last; ++k)
        cells.push_back(static_cast<std::uint32_t>(grid.cell(place_of(k))));
    PlaceClusters c;
    c.members = lists_by_key<std::uint32_t>(
        grid.size(), cells, [&](std::size_t i) { return first + static_cast<std::uint32_t>(i); });
    auto& ends = c.members.offsets;
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end()); // empty cells are no clusters
    for (std::size_t i = 0; i < c.members.size(); ++i) {
        BallMaker ball;
        for (const std::uint32_t m : c.members[i]) add_all(m, ball);
        c.balls.push_back(ball.ball());
    }
    return c;
}

} // namespace

Functional Face::beyond(unsigned j) const {
    const Point3 e = minus(corners[(j + 1) % 3], corners[j]), m = cross(e, normal);
    const double factor = 1 / length(e);
    return {corners[j], {m.x * factor, m.y * factor, m.z * factor}};
}

void Sizes::add(const Sizes& other) {
    altitude = std::min(altitude, other.altitude);
    longest = std::max(longest, other.longest);
}

Sizes sizes_of_part(const std::array<Point3, 3>& corners, double move) {
    const auto& [p, q, r] = corners;
    const Point3 u = minus(q, p), v = minus(r, p), w = minus(r, q);
    const double l = std::sqrt(std::max({dot(u, u), dot(v, v), dot(w, w)}));
    const bool usable = l > shortest_length && l < longest_length;
    const double a = usable ? length(cross(u, v)) / l : 0;
    return {a * (1 - size_share) - altitude_factor * unit * l - 4 * move,
            l * (1 + size_share) + 2 * move};
}

Faces::Faces(const MovedParts& moved, std::span<const CandidatePair> pairs, double most_move,
             const Run& run) :
    move(most_move),
    slot_of(moved.faces.size(), none) {
    measure_faces(moved, pairs, run);
    collect_parts(moved, run);
    number_vertices(moved);
    for_several(faces.size(), run, [&](std::size_t f) {
        name_corners(moved, static_cast<std::uint32_t>(f));
        measure_parts(faces[f]);
    });
}

std::uint32_t Faces::find(std::uint32_t face, std::uint32_t point) const {
    const auto there = at[point];
    const auto found = std::lower_bound(
        there.begin(), there.end(), face,
        [](const VertexOfFace& v, std::uint32_t wanted) { return v.face < wanted; });
    return found != there.end() && found->face == face ? found->vertex : none;
}

FaceClusters Faces::clusters_of(const Face& f) const {
    constexpr std::size_t per_cluster = 8;
    const auto place_of_part = [&](std::uint32_t e) { return places[corners[e][0]]; };
    return {clusters_in(
                FaceGrid(f, f.vertex_end - f.vertex, per_cluster), f.vertex, f.vertex_end,
                [&](std::uint32_t v) { return places[v]; },
                [&](std::uint32_t v, BallMaker& ball) { ball.add(places[v]); }),
            clusters_in(FaceGrid(f, f.part_end - f.part, per_cluster), f.part, f.part_end,
                        place_of_part, [&](std::uint32_t e, BallMaker& ball) {
                            for (const std::uint32_t v : corners[e]) ball.add(places[v]);
                        })};
}

void Faces::cluster(std::span<const std::uint32_t> slots, const Run& run) {
    std::vector<std::uint32_t> large;
    for (const std::uint32_t s : slots) {
        if (part_count(s) < many_parts) continue;
        faces[s].clusters = static_cast<std::uint32_t>(large.size());
        large.push_back(s);
    }
    clusters.resize(large.size());
    for_several(large.size(), run,
                [&](std::size_t k) { clusters[k] = clusters_of(faces[large[k]]); });
}

void Faces::measure_faces(const MovedParts& moved, std::span<const CandidatePair> pairs,
                          const Run& run) {
    for (const CandidatePair& p : pairs)
        for (const std::uint32_t f : {p.first, p.second}) {
            if (slot_of[f] != none) continue;
            slot_of[f] = static_cast<std::uint32_t>(names.size());
            names.push_back(f);
        }
    faces.resize(names.size());
    for_several(faces.size(), run,
                [&](std::size_t k) { faces[k] = measure(corners_of(moved, names[k])); });
}

void Faces::collect_parts(const MovedParts& moved, const Run& run) {
    struct Entry {
        std::uint32_t slot, part;
    };
    const auto entries = concatenated(parts_of_ranges<std::vector<Entry>>(
        moved.faces_of.size(), run, [&](std::size_t first, std::size_t last) {
            std::vector<Entry> found;
            for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
                for (const std::uint32_t f : moved.faces_of[t])
                    if (const std::uint32_t s = slot_of[f]; s != none) found.push_back({s, t});
            return found;
        }));
    for (const Entry& e : entries) ++faces[e.slot].part_end;
    std::uint32_t total = 0;
    for (Face& f : faces) {
        f.part = total;
        total += std::exchange(f.part_end, total);
    }
    parts.resize(total);
    for (const Entry& e : entries) parts[faces[e.slot].part_end++] = e.part;
}

void Faces::number_vertices(const MovedParts& moved) {
    std::vector<std::uint32_t> last_at(moved.points.size(), none); // the last vertex at each point
    corners.resize(parts.size());
    const std::size_t most = parts.size() + 2 * faces.size(); // the parts of a face form a disk
    vertices.reserve(most);
    places.reserve(most);
    for (Face& f : faces) {
        f.vertex = static_cast<std::uint32_t>(vertices.size());
        for (std::uint32_t e = f.part; e < f.part_end; ++e)
            for (unsigned i = 0; i < 3; ++i) {
                const std::uint32_t point = moved.parts[parts[e]][i];
                std::uint32_t& last = last_at[point];
                if (last == none || last < f.vertex) {
                    last = static_cast<std::uint32_t>(vertices.size());
                    vertices.push_back(point);
                    places.push_back(moved.points[point]);
                }
                corners[e][i] = last;
            }
        f.vertex_end = static_cast<std::uint32_t>(vertices.size());
    }
    sizes.resize(vertices.size());
    list_vertices(moved.points.size());
}

void Faces::list_vertices(std::size_t points) {
    at = lists_by_key<VertexOfFace>(points, vertices,
                                    [&, f = std::uint32_t{0}](std::size_t v) mutable {
                                        while (v >= faces[f].vertex_end) ++f;
                                        return VertexOfFace{f, static_cast<std::uint32_t>(v)};
                                    });
}

void Faces::name_corners(const MovedParts& moved, std::uint32_t face) {
    Face& f = faces[face];
    const Triangle& corners_of_face = moved.faces[names[face]];
    for (std::uint32_t v = f.vertex; v < f.vertex_end; ++v)
        for (unsigned i = 0; i < 3; ++i)
            if (moved.names[vertices[v]] == corners_of_face[i]) f.corner_at[i] = v;
}

void Faces::measure_parts(const Face& face) {
    for (std::uint32_t e = face.part; e < face.part_end; ++e) {
        const Triangle& c = corners[e];
        const Sizes own = sizes_of_part({places[c[0]], places[c[1]], places[c[2]]}, move);
        for (const std::uint32_t corner : c) sizes[corner].add(own);
    }
}

} // namespace terrane::rounding::detail
