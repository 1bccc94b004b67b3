// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/clearance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

#include <terrane/algorithms/intersection.hpp>
#include <terrane/algorithms/parallel.hpp>
#include <terrane/algorithms/sets.hpp>
#include <terrane/algorithms/vectors.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t none = UINT32_MAX;
constexpr double unit = std::numeric_limits<double>::epsilon(); // of one operation, in any mode
// Lengths between these have squares, and areas of triangles whose squares, are normal doubles; an
// area, and an altitude, is not below the square of the shortest. Range of a type, no tolerance.
constexpr double longest_length = 0x1p+249, shortest_length = 0x1p-249;
constexpr double smallest_area = shortest_length * shortest_length;

double length(const Point3& a) {
    return std::sqrt(dot(a, a));
}

/// u(p) = normal . (p - origin).
struct Functional {
    Point3 origin, normal;

    [[nodiscard]] double operator()(const Point3& p) const { return dot(normal, minus(p, origin)); }
};

/// What the lemma needs to know of a face and its parts.
struct Face {
    std::array<Point3, 3> corners;
    Functional height;                ///< above its plane
    std::array<Functional, 3> beyond; ///< each edge; of faces that are not apart
    double functional_error = 0; ///< of this and those of the edges, per distance from the face
    double extent = 0;           ///< longest edge of the face
    std::uint32_t part = 0, part_end = 0;     ///< range in Faces::parts
    std::uint32_t vertex = 0, vertex_end = 0; ///< range in Faces::vertices
};

/// The distance beyond edge j of f.
Functional beyond_edge(const Face& f, unsigned j) {
    const Point3 e = minus(f.corners[(j + 1) % 3], f.corners[j]), m = cross(e, f.height.normal);
    const double factor = 1 / length(e);
    return {f.corners[j], {m.x * factor, m.y * factor, m.z * factor}};
}

/// Relative to an edge of length e between points whose differences err by a unit, the altitude
/// and the direction of the normal err by a few: the bounds are several times larger.
Face measure(const std::array<Point3, 3>& c) {
    Face f;
    f.corners = c;
    const Point3 u = minus(c[1], c[0]), v = minus(c[2], c[0]), w = minus(c[2], c[1]),
                 n = cross(u, v);
    const double size = length(n), factor = 1 / size;
    f.height = {c[0], {n.x * factor, n.y * factor, n.z * factor}};
    const double squared = std::max({dot(u, u), dot(v, v), dot(w, w)});
    f.extent = std::sqrt(squared);
    const bool usable = size > smallest_area && f.extent < longest_length;
    f.functional_error =
        usable ? 64 * unit * squared * factor : std::numeric_limits<double>::infinity();
    return f;
}

/// Of the parts of a face at one vertex.
struct Sizes {
    double altitude = std::numeric_limits<double>::infinity(); ///< a: the least
    double longest = 0;                                        ///< l: the longest edge
};

/// No two corners are farther apart.
double extent_bound(const std::array<Point3, 3>& c) {
    const auto [low_x, high_x] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [low_y, high_y] = std::minmax({c[0].y, c[1].y, c[2].y});
    const auto [low_z, high_z] = std::minmax({c[0].z, c[1].z, c[2].z});
    return ((high_x - low_x) + (high_y - low_y) + (high_z - low_z)) * (1 + 0x1p-40);
}

struct Faces {
    std::vector<std::uint32_t> slot_of; ///< per face: index into faces, or none
    std::vector<Face> faces;
    std::vector<std::uint32_t> parts;         ///< by face
    std::vector<std::array<std::uint32_t, 3>> ///< per entry of parts: corners, counted in the
        corners;                              ///< vertices of the face
    std::vector<std::uint32_t> vertices;      ///< by face, each once: points
    std::vector<Point3> places;               ///< of vertices
    std::vector<Sizes> sizes;                 ///< of vertices
};

/// Which vertices are a face's: per point.
struct Stamp {
    std::uint32_t face = none;
    std::uint32_t vertex = 0; ///< index into Faces::vertices
};

// Where a vertex is: a part that leaves a plane to one side is above or below with all corners that
// do not rest on it.
constexpr std::uint8_t rests = 0, above = 1, below = 2, neither = 3;
constexpr std::uint8_t unknown = 0xff;

struct Scratch {
    std::array<std::vector<Stamp>, 2> stamps;
    std::vector<std::uint8_t> sides;            ///< per vertex of a face
    std::vector<std::uint8_t> beyond;           ///< per vertex: see edges_before, or unknown
    std::vector<std::uint32_t> left, left_back; ///< entries of Faces::parts without proof
};

struct Found {
    std::vector<CandidatePair> pairs;
    std::vector<std::uint32_t> parts;
};

class Prover {
public:
    Prover(const MovedParts& moved, std::span<const CandidatePair> meeting, const Run& run) :
        moved_(moved) {
        for (const double m : moved.moves) move_ = std::max(move_, m);
        choose_faces(meeting, run);
        collect_parts(run);
        number_vertices();
        for_faces(run, [this](Face& f) { measure_parts(f); });
    }

    [[nodiscard]] Unclear operator()(const Run& run);

private:
    [[nodiscard]] std::array<Point3, 3> corners_of(std::uint32_t f) const {
        const Triangle& c = moved_.faces[f];
        return {moved_.face_points[c[0]], moved_.face_points[c[1]], moved_.face_points[c[2]]};
    }
    [[nodiscard]] std::vector<CandidatePair>
    close_pairs(std::span<const CandidatePair> meeting) const;
    template <class Visit>
    void for_faces(const Run& run, const Visit& visit);
    void choose_faces(std::span<const CandidatePair> meeting, const Run& run);
    [[nodiscard]] double margin(double extent, const Face& g) const;
    void collect_parts(const Run& run);
    void number_vertices();
    void measure_parts(Face& f);
    [[nodiscard]] const Face& face(std::uint32_t f) const {
        return faces_.faces[faces_.slot_of[f]];
    }
    void add_restless(const Face& f, std::vector<std::uint32_t>& parts) const;
    void test_group(std::size_t first, std::size_t last, Scratch& scratch, Found& found) const;
    void stamp(std::uint32_t f, std::vector<Stamp>& stamps) const;
    [[nodiscard]] bool is_apart(const std::array<Point3, 3>& f, double extent, const Face& g) const;
    [[nodiscard]] bool is_clear(const Face& f, std::uint32_t entry, std::uint32_t g,
                                std::span<const Stamp> stamps, double d) const;
    [[nodiscard]] bool find_sides(const Face& f, const Face& g, double d,
                                  std::span<const Stamp> stamps, std::uint32_t g_name,
                                  std::vector<std::uint8_t>& sides) const;
    void find_left(std::uint32_t f, std::uint32_t g, std::span<const Stamp> stamps,
                   Scratch& scratch, std::vector<std::uint32_t>& left) const;
    void add_pairs(const Scratch& scratch, Found& found) const;

    const MovedParts& moved_;
    double move_ = 0;                    ///< d: the most
    std::vector<CandidatePair> meeting_; ///< the pairs of faces that are not apart as a whole
    Faces faces_;                        ///< of these
};

/// The pairs that are not apart as a whole.
std::vector<CandidatePair> Prover::close_pairs(std::span<const CandidatePair> meeting) const {
    std::vector<CandidatePair> close;
    Face g;
    std::uint32_t measured = none;
    for (const CandidatePair& p : meeting) {
        if (p.first != measured) {
            measured = p.first;
            g = measure(corners_of(p.first));
        }
        const auto f = corners_of(p.second);
        if (is_apart(f, extent_bound(f), g)) continue;
        if (!is_apart(g.corners, g.extent, measure(f))) close.push_back(p);
    }
    return close;
}

/// Several at a time, under the default rounding mode.
template <class Visit>
void Prover::for_faces(const Run& run, const Visit& visit) {
    constexpr std::size_t least = 256; // of faces for a thread
    for_ranges(
        faces_.faces.size(), run,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t f = first; f < last; ++f) visit(faces_.faces[f]);
        },
        4, least);
}

void Prover::choose_faces(std::span<const CandidatePair> meeting, const Run& run) {
    const auto blocks = for_blocks<std::vector<CandidatePair>>(
        meeting.size(), 1024, run, [&](std::size_t first, std::size_t last) {
            return close_pairs(meeting.subspan(first, last - first));
        });
    for (const auto& block : blocks) meeting_.insert(meeting_.end(), block.begin(), block.end());
    faces_.slot_of.assign(moved_.faces.size(), none);
    std::vector<std::uint32_t> names;
    for (const CandidatePair& p : meeting_)
        for (const std::uint32_t f : {p.first, p.second}) {
            if (faces_.slot_of[f] != none) continue;
            faces_.slot_of[f] = static_cast<std::uint32_t>(names.size());
            names.push_back(f);
        }
    faces_.faces.resize(names.size());
    for_faces(run, [&](Face& f) {
        f = measure(corners_of(names[static_cast<std::size_t>(&f - faces_.faces.data())]));
        for (unsigned j = 0; j < 3; ++j) f.beyond[j] = beyond_edge(f, j);
    });
}

void Prover::collect_parts(const Run& run) {
    struct Entry {
        std::uint32_t slot, part;
    };
    const auto entries = concatenated(parts_of_ranges<std::vector<Entry>>(
        moved_.faces_of.size(), run, [&](std::size_t first, std::size_t last) {
            std::vector<Entry> found;
            for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
                for (const std::uint32_t f : moved_.faces_of[t])
                    if (const std::uint32_t s = faces_.slot_of[f]; s != none)
                        found.push_back({s, t});
            return found;
        }));
    for (const Entry& e : entries) ++faces_.faces[e.slot].part_end;
    std::uint32_t total = 0;
    for (Face& f : faces_.faces) {
        f.part = total;
        total += std::exchange(f.part_end, total);
    }
    faces_.parts.resize(total);
    for (const Entry& e : entries) faces_.parts[faces_.faces[e.slot].part_end++] = e.part;
}

void Prover::number_vertices() {
    std::vector<std::uint32_t> last(moved_.points.size(), none), number(moved_.points.size());
    faces_.corners.resize(faces_.parts.size());
    for (std::uint32_t s = 0; s < faces_.faces.size(); ++s) {
        Face& f = faces_.faces[s];
        f.vertex = static_cast<std::uint32_t>(faces_.vertices.size());
        for (std::uint32_t e = f.part; e < f.part_end; ++e)
            for (unsigned i = 0; i < 3; ++i) {
                const std::uint32_t v = moved_.parts[faces_.parts[e]][i];
                if (last[v] != s) {
                    last[v] = s;
                    number[v] = static_cast<std::uint32_t>(faces_.vertices.size()) - f.vertex;
                    faces_.vertices.push_back(v);
                    faces_.places.push_back(moved_.points[v]);
                }
                faces_.corners[e][i] = number[v];
            }
        f.vertex_end = static_cast<std::uint32_t>(faces_.vertices.size());
    }
    faces_.sizes.resize(faces_.vertices.size());
}

void Prover::measure_parts(Face& f) {
    for (std::uint32_t e = f.part; e < f.part_end; ++e) {
        const auto& c = faces_.corners[e];
        const Point3* place = faces_.places.data() + f.vertex;
        const Point3 &p = place[c[0]], &q = place[c[1]], &r = place[c[2]];
        const Point3 u = minus(q, p), v = minus(r, p), w = minus(r, q);
        const double l = std::sqrt(std::max({dot(u, u), dot(v, v), dot(w, w)}));
        const bool usable = l > shortest_length && l < longest_length;
        const double a = usable ? length(cross(u, v)) / l : 0;
        for (const std::uint32_t corner : c) {
            Sizes& at = faces_.sizes[f.vertex + corner];
            at.longest = std::max(at.longest, l * (1 + 0x1p-40) + 2 * move_);
            at.altitude = std::min(at.altitude, a * (1 - 0x1p-40) - 64 * unit * l - 4 * move_);
        }
    }
}

/// a^2 >= 64 d l; also false where anything has underflown.
bool is_calm(const Sizes& s, double d) {
    return s.altitude > smallest_area && s.altitude * s.altitude >= 64 * d * s.longest;
}

/// Parts of it that may meet another one of it improperly.
void Prover::add_restless(const Face& f, std::vector<std::uint32_t>& parts) const {
    if (f.part_end - f.part == 1) return;
    const auto calm = [&](std::uint32_t v) {
        return is_calm(faces_.sizes[f.vertex + v], 4 * move_);
    };
    for (std::uint32_t e = f.part; e < f.part_end; ++e) {
        const auto& c = faces_.corners[e];
        if (!std::all_of(c.begin(), c.end(), calm)) parts.push_back(faces_.parts[e]);
    }
}

void Prover::stamp(std::uint32_t f, std::vector<Stamp>& stamps) const {
    stamps.resize(moved_.points.size());
    for (std::uint32_t v = face(f).vertex; v < face(f).vertex_end; ++v)
        stamps[faces_.vertices[v]] = {f, v};
}

/// d of the lemma for parts of a face of an extent, and the functionals of g, with room for errors
/// in both directions.
double Prover::margin(double extent, const Face& g) const {
    return 4 * (move_ + (extent + g.extent) * g.functional_error);
}

/// The whole of f lies beyond g.
bool Prover::is_apart(const std::array<Point3, 3>& f, double extent, const Face& g) const {
    const double d = margin(extent, g);
    const double a = g.height(f[0]), b = g.height(f[1]), c = g.height(f[2]);
    if ((a > d && b > d && c > d) || (a < -d && b < -d && c < -d)) return true;
    for (unsigned j = 0; j < 3; ++j) {
        const Functional u = beyond_edge(g, j);
        if (u(f[0]) > d && u(f[1]) > d && u(f[2]) > d) return true;
    }
    return false;
}

/// What the other corners must rise to when a part leaves g at a vertex; infinite where g is not
/// calm.
double least_rise(const Sizes& there, double longest, double d) {
    const double l = std::max(there.longest, longest);
    if (!is_calm({there.altitude, l}, d)) return std::numeric_limits<double>::infinity();
    const double ratio = l / there.altitude;
    return 128 * d * ratio * ratio;
}

/// Case (1) or (2) of the lemma for a part of another face, by any of the functionals.
bool Prover::is_clear(const Face& f, std::uint32_t entry, std::uint32_t g,
                      std::span<const Stamp> stamps, double d) const {
    std::array<Point3, 3> at;
    std::array<bool, 3> on{}; // it is a vertex of g
    std::array<const Sizes*, 3> there{};
    double longest = std::numeric_limits<double>::infinity();
    for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t v = f.vertex + faces_.corners[entry][i];
        const Stamp& s = stamps[faces_.vertices[v]];
        on[i] = s.face == g;
        if (on[i]) there[i] = &faces_.sizes[s.vertex];
        at[i] = faces_.places[v];
        longest = std::min(longest, faces_.sizes[v].longest); // its own is in all three
    }
    double least = d; // what corners off g must rise above
    for (unsigned i = 0; i < 3; ++i)
        if (on[i]) least = std::max(least, least_rise(*there[i], longest, d));
    const auto leaves = [&](double a, double b, double c) {
        const bool rests_a = on[0] && std::fabs(a) <= d / 2,
                   rests_b = on[1] && std::fabs(b) <= d / 2,
                   rests_c = on[2] && std::fabs(c) <= d / 2;
        return (rests_a || a > least) && (rests_b || b > least) && (rests_c || c > least) &&
               !(rests_a && rests_b && rests_c);
    };
    const Face& other = face(g);
    const double a = other.height(at[0]), b = other.height(at[1]), c = other.height(at[2]);
    if (leaves(a, b, c) || leaves(-a, -b, -c)) return true;
    for (const Functional& u : other.beyond)
        if (leaves(u(at[0]), u(at[1]), u(at[2]))) return true;
    return false;
}

/// Where the vertices of f are: above the plane of g, below it, resting on a vertex of g in it, or
/// neither. True if what rises at all rises enough for whatever rests.
bool Prover::find_sides(const Face& f, const Face& g, double d, std::span<const Stamp> stamps,
                        std::uint32_t g_name, std::vector<std::uint8_t>& sides) const {
    sides.resize(f.vertex_end - f.vertex);
    const Point3* place = faces_.places.data() + f.vertex;
    const Functional height = g.height;
    double least_lift = std::numeric_limits<double>::infinity(), most_rise = 0;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const double u = height(place[k]), lift = std::fabs(u);
        sides[k] = static_cast<std::uint8_t>(neither - (u > d ? below : 0) - (u < -d ? above : 0));
        if (lift > d) {
            least_lift = std::min(least_lift, lift);
            continue;
        }
        const auto v = f.vertex + static_cast<std::uint32_t>(k);
        const Stamp& s = stamps[faces_.vertices[v]];
        if (s.face != g_name || !(lift <= d / 2)) continue;
        sides[k] = rests;
        const double rise = least_rise(faces_.sizes[s.vertex], faces_.sizes[v].longest, d);
        most_rise = std::max(most_rise, rise);
    }
    return least_lift > most_rise;
}

/// The edges of g beyond which p lies by more than d: a bit for each.
std::uint8_t edges_before(const Face& g, const Point3& p, double d) {
    unsigned edges = 0;
    for (unsigned j = 0; j < 3; ++j)
        if (g.beyond[j](p) > d) edges |= 1u << j;
    return static_cast<std::uint8_t>(edges);
}

/// The parts of f that may meet parts of g improperly. Most lie on one side of its plane, or leave
/// it at vertices of both.
void Prover::find_left(std::uint32_t f_name, std::uint32_t g_name, std::span<const Stamp> stamps,
                       Scratch& scratch, std::vector<std::uint32_t>& left) const {
    const Face &f = face(f_name), &g = face(g_name);
    const double d = margin(f.extent, g);
    auto& sides = scratch.sides;
    const bool all_leave = find_sides(f, g, d, stamps, g_name, sides);
    scratch.beyond.assign(sides.size(), unknown);
    const auto beyond = [&](std::uint32_t v) {
        std::uint8_t& edges = scratch.beyond[v];
        if (edges == unknown) edges = edges_before(g, faces_.places[f.vertex + v], d);
        return edges;
    };
    left.clear();
    for (std::uint32_t e = f.part; e < f.part_end; ++e) {
        const auto& [i, j, k] = faces_.corners[e];
        const auto together = sides[i] | sides[j] | sides[k];
        if (together == above || together == below) {
            const bool any_rests = sides[i] == rests || sides[j] == rests || sides[k] == rests;
            if (all_leave || !any_rests) continue;
        }
        if ((beyond(i) & beyond(j) & beyond(k)) != 0) continue;
        if (!is_clear(f, e, g_name, stamps, d)) left.push_back(e);
    }
}

/// Few pairs are listed where their boxes overlap; where they are many, the parts of the smaller
/// side.
void Prover::add_pairs(const Scratch& scratch, Found& found) const {
    const auto &f = scratch.left, &g = scratch.left_back;
    if (f.empty() || g.empty()) return;
    constexpr std::size_t few = 4096;
    if (f.size() * g.size() > few) {
        for (const std::uint32_t e : f.size() < g.size() ? f : g)
            found.parts.push_back(faces_.parts[e]);
        return;
    }
    const BoxSource boxes(moved_.points, moved_.parts);
    for (const std::uint32_t e : f) {
        const std::uint32_t a = faces_.parts[e];
        const Box box = boxes[a];
        for (const std::uint32_t h : g) {
            const std::uint32_t b = faces_.parts[h];
            if (a != b && box.overlaps(boxes[b]))
                found.pairs.push_back({std::min(a, b), std::max(a, b)});
        }
    }
}

/// Pairs with the same first face.
void Prover::test_group(std::size_t first, std::size_t last, Scratch& scratch, Found& found) const {
    const std::uint32_t g = meeting_[first].first;
    stamp(g, scratch.stamps[0]);
    for (std::size_t i = first; i < last; ++i) {
        const std::uint32_t f = meeting_[i].second;
        find_left(f, g, scratch.stamps[0], scratch, scratch.left);
        if (scratch.left.empty()) continue;
        stamp(f, scratch.stamps[1]);
        find_left(g, f, scratch.stamps[1], scratch, scratch.left_back);
        add_pairs(scratch, found);
    }
}

Unclear Prover::operator()(const Run& run) {
    std::vector<std::size_t> groups; // first pairs, and the end
    for (std::size_t i = 0; i < meeting_.size(); ++i)
        if (i == 0 || meeting_[i].first != meeting_[i - 1].first) groups.push_back(i);
    groups.push_back(meeting_.size());
    tbb::enumerable_thread_specific<Scratch> scratch;
    const auto blocks =
        for_blocks<Found>(groups.size() - 1, 16, run, [&](std::size_t first, std::size_t last) {
            Found found;
            for (std::size_t i = first; i < last; ++i)
                test_group(groups[i], groups[i + 1], scratch.local(), found);
            return found;
        });
    Unclear all;
    for (const Found& b : blocks) {
        all.pairs.insert(all.pairs.end(), b.pairs.begin(), b.pairs.end());
        all.parts.insert(all.parts.end(), b.parts.begin(), b.parts.end());
    }
    for (const Face& f : faces_.faces) add_restless(f, all.restless);
    sort_unique(all.pairs);
    sort_unique(all.parts);
    sort_unique(all.restless);
    return all;
}

} // namespace

Unclear find_unclear(const MovedParts& moved, std::span<const CandidatePair> meeting,
                     const Run& run) {
    return Prover(moved, meeting, run)(run);
}

} // namespace terrane
