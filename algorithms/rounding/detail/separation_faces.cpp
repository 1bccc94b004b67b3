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

Faces::Faces(const MovedParts& moved, std::span<const CandidatePair> pairs, double move,
             const Run& run) :
    slot_of(moved.faces.size(), none) {
    measure_faces(moved, pairs, run);
    collect_parts(moved, run);
    number_vertices(moved);
    for_several(faces.size(), run, [&](std::size_t f) {
        name_corners(moved, static_cast<std::uint32_t>(f));
        measure_parts(faces[f], move);
    });
}

std::uint32_t Faces::find(std::uint32_t face, std::uint32_t point) const {
    std::uint32_t v = last_at[point];
    while (v != none && face_at[v] > face) v = before[v];
    return v != none && face_at[v] == face ? v : none;
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
    last_at.assign(moved.points.size(), none);
    corners.resize(parts.size());
    const std::size_t most = parts.size() + 2 * faces.size(); // the parts of a face form a disk
    vertices.reserve(most);
    places.reserve(most);
    face_at.reserve(most);
    before.reserve(most);
    for (std::uint32_t s = 0; s < faces.size(); ++s) {
        Face& f = faces[s];
        f.vertex = static_cast<std::uint32_t>(vertices.size());
        for (std::uint32_t e = f.part; e < f.part_end; ++e)
            for (unsigned i = 0; i < 3; ++i) {
                const std::uint32_t point = moved.parts[parts[e]][i];
                std::uint32_t& last = last_at[point];
                if (last == none || last < f.vertex) {
                    before.push_back(last);
                    last = static_cast<std::uint32_t>(vertices.size());
                    vertices.push_back(point);
                    face_at.push_back(s);
                    places.push_back(moved.points[point]);
                }
                corners[e][i] = last;
            }
        f.vertex_end = static_cast<std::uint32_t>(vertices.size());
    }
    sizes.resize(vertices.size());
}

void Faces::name_corners(const MovedParts& moved, std::uint32_t face) {
    Face& f = faces[face];
    const Triangle& corners_of_face = moved.faces[names[face]];
    for (std::uint32_t v = f.vertex; v < f.vertex_end; ++v)
        for (unsigned i = 0; i < 3; ++i)
            if (moved.names[vertices[v]] == corners_of_face[i]) f.corner_at[i] = v;
}

void Faces::measure_parts(const Face& face, double move) {
    for (std::uint32_t e = face.part; e < face.part_end; ++e) {
        const Triangle& c = corners[e];
        const Point3 &p = places[c[0]], &q = places[c[1]], &r = places[c[2]];
        const Point3 u = minus(q, p), v = minus(r, p), w = minus(r, q);
        const double l = std::sqrt(std::max({dot(u, u), dot(v, v), dot(w, w)}));
        const bool usable = l > shortest_length && l < longest_length;
        const double a = usable ? length(cross(u, v)) / l : 0;
        const Sizes own{a * (1 - size_share) - altitude_factor * unit * l - 4 * move,
                        l * (1 + size_share) + 2 * move};
        for (const std::uint32_t corner : c) sizes[corner].add(own);
    }
}

} // namespace terrane::rounding::detail
