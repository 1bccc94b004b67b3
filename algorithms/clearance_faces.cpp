// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/clearance_faces.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <terrane/algorithms/parallel.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/twofold.hpp>

namespace terrane::clearance {
namespace {

std::array<Point3, 3> corners_of(const MovedParts& moved, std::uint32_t face) {
    const Triangle& c = moved.faces[face];
    return {moved.face_points[c[0]], moved.face_points[c[1]], moved.face_points[c[2]]};
}

// Small faces are one cell: looking at all parts takes less than choosing among them.
constexpr std::uint32_t parts_per_cell = 16, least_divided = 256;

std::uint32_t strips_of(const Face& f) {
    const std::uint32_t parts = f.part_end - f.part;
    if (parts < least_divided) return 1;
    return static_cast<std::uint32_t>(std::sqrt(static_cast<double>(parts) / parts_per_cell));
}

Frame frame_of(const Point3& origin, const Point3& normal) {
    const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
    Frame f{origin, z >= x && z >= y ? 2U : x >= y ? 0U : 1U, 0, 0};
    const Point3 n = f.turned(normal);
    f.slope_u = -n.x / n.z;
    f.slope_v = -n.y / n.z;
    return f;
}

/// A part by its centre (times three), in two coordinates of the frame.
struct Centre {
    double u, v;
    std::uint32_t part;
};

Centre centre_of(const MovedParts& moved, std::uint32_t part, const Frame& frame) {
    const Triangle& t = moved.parts[part];
    const Point3 a = frame.turned(moved.points[t[0]]), b = frame.turned(moved.points[t[1]]),
                 c = frame.turned(moved.points[t[2]]);
    return {a.x + b.x + c.x, a.y + b.y + c.y, part};
}

/// Sorts by a coordinate: into as many bins as there are, and then within these.
class CentreSort {
public:
    void operator()(std::span<Centre> all, double Centre::*key) {
        if (all.empty()) return;
        const auto before = [&](const Centre& a, const Centre& b) { return a.*key < b.*key; };
        const auto [low, high] = std::minmax_element(all.begin(), all.end(), before);
        const double least = (*low).*key, bins = static_cast<double>(all.size());
        const double factor = bins / ((*high).*key - least);
        const auto bin_of = [&](const Centre& c) {
            const double bin = (c.*key - least) * factor;
            return bin < bins ? static_cast<std::size_t>(std::max(bin, 0.0)) : all.size() - 1;
        };
        starts_.assign(all.size() + 1, 0);
        for (const Centre& c : all) ++starts_[bin_of(c) + 1];
        if (*std::max_element(starts_.begin(), starts_.end()) > crowd)
            return std::stable_sort(all.begin(), all.end(), before);
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
        copy_.assign(all.begin(), all.end());
        for (const Centre& c : copy_) all[starts_[bin_of(c)]++] = c;
        for (std::size_t k = 1; k < all.size(); ++k) {
            const Centre c = all[k];
            std::size_t to = k;
            for (; to > 0 && before(c, all[to - 1]); --to) all[to] = all[to - 1];
            all[to] = c;
        }
    }

private:
    static constexpr std::uint32_t crowd = 64; ///< in one bin: these are sorted otherwise

    std::vector<std::uint32_t> starts_; ///< per bin
    std::vector<Centre> copy_;
};

/// The distance beyond edge j of f.
Functional beyond_edge(const Face& f, unsigned j) {
    const Point3 e = minus(f.corners[(j + 1) % 3], f.corners[j]), m = cross(e, f.height.normal);
    const double factor = 1 / length(e);
    return {f.corners[j], {m.x * factor, m.y * factor, m.z * factor}};
}

/// The unit normal where a face is so thin that hardly anything is left of it in differences of
/// doubles.
void refine(Face& f) {
    const ToNearest mode;
    using namespace polynomial;
    const auto at = [&](unsigned i) { return cartesian<Twofold>(f.corners[i]); };
    const auto n = polynomial::cross(difference(at(1), at(0)), difference(at(2), at(0)));
    const Point3 normal{n.x.value(), n.y.value(), n.z.value()};
    const double size = length(normal), factor = 1 / size;
    const double error = 4 * (n.x.error() + n.y.error() + n.z.error()) * factor + 64 * unit;
    if (!(size > smallest_area && error < f.functional_error)) return;
    f.height.normal = {normal.x * factor, normal.y * factor, normal.z * factor};
    f.functional_error = error;
}

// Relative to an edge of length e between points whose differences err by a unit, the altitude and
// the direction of the normal err by a few: the bounds are several times larger.
Face measure(const std::array<Point3, 3>& corners) {
    constexpr double thin = 0x1p+20; // longest edge to altitude
    Face f;
    f.corners = corners;
    const Point3 u = minus(corners[1], corners[0]), v = minus(corners[2], corners[0]),
                 w = minus(corners[2], corners[1]), n = cross(u, v);
    const double size = length(n), factor = 1 / size;
    f.height = {corners[0], {n.x * factor, n.y * factor, n.z * factor}};
    const double squared = std::max({dot(u, u), dot(v, v), dot(w, w)});
    f.extent = std::sqrt(squared);
    const bool usable = size > smallest_area && f.extent < longest_length;
    f.functional_error =
        usable ? 64 * unit * squared * factor : std::numeric_limits<double>::infinity();
    if (usable && squared > thin * size) refine(f);
    f.frame = frame_of(corners[0], f.height.normal);
    for (unsigned j = 0; j < 3; ++j) f.beyond[j] = beyond_edge(f, j);
    return f;
}

} // namespace

Measured::Measured(const MovedParts& moved, std::span<const CandidatePair> pairs, const Run& run) :
    slot_of(moved.faces.size(), none) {
    for (const CandidatePair& p : pairs)
        for (const std::uint32_t f : {p.first, p.second}) {
            if (slot_of[f] != none) continue;
            slot_of[f] = static_cast<std::uint32_t>(names.size());
            names.push_back(f);
        }
    faces.resize(names.size());
    constexpr std::size_t least = 256; // for a thread
    for_ranges(
        faces.size(), run,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k)
                faces[k] = measure(corners_of(moved, names[k]));
        },
        4, least);
}

Faces::Faces(const MovedParts& moved, Measured measured, std::span<const CandidatePair> pairs,
             double move, const Run& run) {
    choose(std::move(measured), pairs);
    collect_parts(moved, run);
    sort_into_cells(moved, run);
    number_vertices(moved);
    for_faces(run, [&](Face& f) {
        for (std::uint32_t c = f.cell; c < f.cell_end; ++c) {
            measure_parts(cells[c], move);
            if (f.cell_end - f.cell > 1) enclose(cells[c], f.frame);
        }
    });
}

/// Several at a time, under the default rounding mode.
template <class Visit>
void Faces::for_faces(const Run& run, const Visit& visit) {
    constexpr std::size_t least = 256; // of faces for a thread
    for_ranges(
        faces.size(), run,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t f = first; f < last; ++f) visit(faces[f]);
        },
        4, least);
}

void Faces::choose(Measured measured, std::span<const CandidatePair> pairs) {
    std::vector<std::uint32_t> slots(measured.faces.size(), none); // per measured face
    for (const CandidatePair& p : pairs)
        for (const std::uint32_t f : {p.first, p.second}) {
            std::uint32_t& slot = slots[measured.slot_of[f]];
            if (slot != none) continue;
            slot = static_cast<std::uint32_t>(faces.size());
            faces.push_back(measured[f]);
        }
    for (std::size_t k = 0; k < slots.size(); ++k) measured.slot_of[measured.names[k]] = slots[k];
    slot_of = std::move(measured.slot_of);
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

/// Strips with equally many parts, cut into cells with equally many. Where a part lies does not
/// matter for the proof.
void Faces::sort_into_cells(const MovedParts& moved, const Run& run) {
    std::uint32_t total = 0;
    for (Face& f : faces) {
        f.cell = total;
        total += strips_of(f) * strips_of(f);
        f.cell_end = total;
    }
    cells.resize(total);
    for_faces(run, [&](Face& f) {
        const std::uint32_t along = strips_of(f), count = f.part_end - f.part;
        for (std::uint32_t c = 0; c < along * along; ++c) {
            const auto at = [&](std::uint64_t cell) {
                return f.part + static_cast<std::uint32_t>(count * cell / (along * along));
            };
            cells[f.cell + c] = {at(c), at(c + 1), 0, 0, {}, {}};
        }
        if (along == 1) return;
        std::vector<Centre> centres;
        centres.reserve(count);
        for (std::uint32_t e = f.part; e < f.part_end; ++e)
            centres.push_back(centre_of(moved, parts[e], f.frame));
        CentreSort sort;
        sort(centres, &Centre::u);
        for (std::uint32_t strip = 0; strip < along; ++strip) {
            const Cell *first = &cells[f.cell + strip * along], *last = first + along - 1;
            sort(std::span(centres).subspan(first->part - f.part, last->part_end - first->part),
                 &Centre::v);
        }
        for (std::uint32_t k = 0; k < count; ++k) parts[f.part + k] = centres[k].part;
    });
}

void Faces::number_vertices(const MovedParts& moved) {
    struct Number {
        std::uint32_t face = none, vertex = 0; ///< the last face that has the point
        std::uint32_t cell = none;             ///< the last cell
        std::uint16_t corner = 0;
    };
    std::vector<Number> numbers(moved.points.size());
    corners.resize(parts.size());
    const auto corner_of = [&](std::uint32_t v, std::uint32_t s, std::uint32_t c) {
        Number& n = numbers[v];
        if (n.cell == c) return n.corner;
        if (n.face != s) {
            n.face = s;
            n.vertex = static_cast<std::uint32_t>(vertices.size());
            vertices.push_back(v);
        }
        n.cell = c;
        n.corner = static_cast<std::uint16_t>(places.size() - cells[c].corner);
        places.push_back(moved.points[v]);
        vertex_at.push_back(n.vertex);
        return n.corner;
    };
    for (std::uint32_t s = 0; s < faces.size(); ++s) {
        Face& f = faces[s];
        f.vertex = static_cast<std::uint32_t>(vertices.size());
        for (std::uint32_t c = f.cell; c < f.cell_end; ++c) {
            cells[c].corner = static_cast<std::uint32_t>(places.size());
            for (std::uint32_t e = cells[c].part; e < cells[c].part_end; ++e)
                for (unsigned i = 0; i < 3; ++i)
                    corners[e][i] = corner_of(moved.parts[parts[e]][i], s, c);
            cells[c].corner_end = static_cast<std::uint32_t>(places.size());
        }
        f.vertex_end = static_cast<std::uint32_t>(vertices.size());
    }
    sizes.resize(vertices.size());
}

void Faces::measure_parts(const Cell& cell, double move) {
    const Point3* place = places.data() + cell.corner;
    for (std::uint32_t e = cell.part; e < cell.part_end; ++e) {
        const auto& c = corners[e];
        const Point3 &p = place[c[0]], &q = place[c[1]], &r = place[c[2]];
        const Point3 u = minus(q, p), v = minus(r, p), w = minus(r, q);
        const double l = std::sqrt(std::max({dot(u, u), dot(v, v), dot(w, w)}));
        const bool usable = l > shortest_length && l < longest_length;
        const double a = usable ? length(cross(u, v)) / l : 0;
        for (const std::uint32_t corner : c) {
            Sizes& at = sizes[vertex_at[cell.corner + corner]];
            at.longest = std::max(at.longest, l * (1 + 0x1p-40) + 2 * move);
            at.altitude = std::min(at.altitude, a * (1 - 0x1p-40) - 64 * unit * l - 4 * move);
        }
    }
}

// The centre is rounded, so half the width is measured from it, with room for its own rounding.
void Faces::enclose(Cell& cell, const Frame& frame) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Point3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    for (std::uint32_t k = cell.corner; k < cell.corner_end; ++k) {
        const Point3 p = frame(places[k]);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const auto middle = [](double a, double b) { return a + (b - a) / 2; };
    const auto farther = [](double a, double b, double m) {
        return std::max(m - a, b - m) * (1 + 0x1p-40);
    };
    Point3& c = cell.centre;
    c = {middle(low.x, high.x), middle(low.y, high.y), middle(low.z, high.z)};
    cell.half = {farther(low.x, high.x, c.x), farther(low.y, high.y, c.y),
                 farther(low.z, high.z, c.z)};
}

} // namespace terrane::clearance
