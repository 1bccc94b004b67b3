// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/separation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/rounding/detail/separation_faces.hpp>

namespace terrane::rounding::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Positions of a vertex relative to a plane. A part leaves the plane to one side if all corners
// that do not rest on it are above, or all are below.
constexpr std::uint8_t rests = 0, above = 1, below = 2, neither = 3;
constexpr std::uint8_t unknown = 0xff;

/// The sizes of the parts of two faces at their common vertices.
struct Common {
    std::uint32_t first = none; ///< the first of the two faces
    Sizes sizes;
};

/// The vertices of one face by their points, so that each is found at once.
class MarkedFace {
public:
    void mark(const Faces& faces, std::uint32_t slot) {
        if (slot == slot_) return;
        slot_ = slot;
        at_.resize(faces.at.size(), {none, none});
        const Face& f = faces.faces[slot];
        for (std::uint32_t v = f.vertex; v < f.vertex_end; ++v) at_[faces.vertices[v]] = {slot, v};
    }
    [[nodiscard]] std::uint32_t slot() const { return slot_; }
    /// Returns the vertex of the face at a point, or none.
    [[nodiscard]] std::uint32_t find(std::uint32_t point) const {
        return at_[point].face == slot_ ? at_[point].vertex : none;
    }

private:
    std::uint32_t slot_ = none;
    std::vector<VertexOfFace> at_; ///< per point: the face that was marked last there
};

struct Scratch {
    MarkedFace marked;
    std::vector<std::uint8_t> sides;            ///< per vertex of a face
    std::vector<std::uint8_t> beyond;           ///< per vertex: see edges_before, or unknown
    std::vector<std::uint32_t> low;             ///< vertices that are not clearly above or below
    std::vector<std::uint32_t> far;             ///< clusters of vertices clear of the plane
    std::vector<std::uint32_t> left, left_back; ///< entries of Faces::parts without proof
    std::vector<Box> boxes;                     ///< per entry of left_back
};

struct Found {
    std::vector<CandidatePair> pairs;
    std::vector<std::uint32_t> parts;
};

double most_of(std::span<const double> moves) {
    return moves.empty() ? 0 : *std::max_element(moves.begin(), moves.end());
}

/// The interval in which a face meets the line between its plane and another plane.
struct Cut {
    double low = infinity, high = -infinity; ///< outer bounds of the ends
    double least_sine = 1;                   ///< of the angles of crossed edges with the line
    bool is_certain = false;                 ///< the face has points on both sides of the line
    bool is_usable = true;
};

class Prover {
public:
    Prover(const MovedParts& moved, std::span<const CandidatePair> meeting, const Run& run) :
        moved_(moved), meeting_(meeting), move_(most_of(moved.moves)),
        faces_(moved, meeting, move_, run) {}

    [[nodiscard]] Unproven operator()(const Run& run);

private:
    /// A pair of faces, for proving that parts of f are clear of g.
    struct Pair {
        std::uint32_t f_slot, g_slot;
        const Face &f, &g;
        double d; ///< the margin
        Functional height;
        std::array<Functional, 3> beyond;
    };

    [[nodiscard]] double margin(const Face& f, const Face& g) const;
    [[nodiscard]] Pair pair_of(std::uint32_t f_slot, std::uint32_t g_slot) const;
    [[nodiscard]] Cut cut(std::uint32_t f_slot, std::uint32_t g_slot, const Point3& origin,
                          const Point3& line) const;
    void add_restless(const Face& f, std::vector<std::uint32_t>& parts) const;
    void find_common(std::uint32_t g_slot, std::vector<Common>& common) const;
    [[nodiscard]] bool is_clear_as_a_whole(std::uint32_t f_slot, std::uint32_t g_slot,
                                           const Common& common) const;
    [[nodiscard]] std::vector<CandidatePair> find_doubtful(const Run& run) const;
    [[nodiscard]] bool has_few_common() const;
    [[nodiscard]] bool is_affordable(std::span<const CandidatePair> doubtful) const;
    void add_all_parts(std::span<const CandidatePair> doubtful,
                       std::vector<std::uint32_t>& parts) const;
    void cluster_faces(std::span<const CandidatePair> doubtful, const Run& run);
    void test_pair(const CandidatePair& slots, Scratch& scratch, Found& found) const;
    [[nodiscard]] std::uint32_t vertex_of_g(const Pair& pair, std::uint32_t v,
                                            const MarkedFace& marked) const;
    [[nodiscard]] bool is_part_of_g(const Pair& pair, std::uint32_t e) const;
    [[nodiscard]] bool is_clear(const Pair& pair, const Triangle& part,
                                const MarkedFace& marked) const;
    [[nodiscard]] const FaceClusters* clusters_of(const Face& f) const {
        return f.clusters == none ? nullptr : &faces_.clusters[f.clusters];
    }
    bool find_sides(const Pair& pair, Scratch& scratch) const;
    void find_left(const Pair& pair, Scratch& scratch, std::vector<std::uint32_t>& left) const;
    void add_pairs(Scratch& scratch, Found& found) const;

    const MovedParts& moved_;
    std::span<const CandidatePair> meeting_;
    double move_; ///< d: the largest move
    Faces faces_;
};

/// Whether a^2 >= 64 d l. Returns false if anything has underflowed.
bool is_well_conditioned(const Sizes& s, double d) {
    return s.altitude > smallest_area &&
           s.altitude * s.altitude >= condition_factor * d * s.longest;
}

/// Adds the parts of a face that may meet another part of it improperly.
void Prover::add_restless(const Face& f, std::vector<std::uint32_t>& parts) const {
    if (f.part_end - f.part == 1) return;
    const auto calm = [&](std::uint32_t v) {
        return is_well_conditioned(faces_.sizes[v], 4 * move_);
    };
    for (std::uint32_t e = f.part; e < f.part_end; ++e) {
        const Triangle& c = faces_.corners[e];
        if (!std::all_of(c.begin(), c.end(), calm)) parts.push_back(faces_.parts[e]);
    }
}

/// Returns the d of statements (3) and (4) for parts of f and the functionals of g, with room for
/// errors in both directions.
double Prover::margin(const Face& f, const Face& g) const {
    return margin_factor * (move_ + (f.extent + g.extent) * g.functional_error);
}

Prover::Pair Prover::pair_of(std::uint32_t f_slot, std::uint32_t g_slot) const {
    const Face &f = faces_.faces[f_slot], &g = faces_.faces[g_slot];
    return {
        f_slot, g_slot, f, g, margin(f, g), g.height(), {g.beyond(0), g.beyond(1), g.beyond(2)}};
}

/// Cuts f by the plane of g. An edge between corners on both sides is crossed at one place, which
/// is known as precisely as the heights of the corners. Near a corner that may be on the plane, the
/// line may cross either edge. An edge may lie on the line only if its ends are vertices of both
/// faces.
Cut Prover::cut(std::uint32_t f_slot, std::uint32_t g_slot, const Point3& origin,
                const Point3& line) const {
    const Face &f = faces_.faces[f_slot], &g = faces_.faces[g_slot];
    const Functional height = g.height();
    const double d = margin(f, g);
    std::array<double, 3> h{}, at{};
    std::array<int, 3> side{};
    for (unsigned i = 0; i < 3; ++i) {
        h[i] = height(f.corners[i]);
        at[i] = dot(minus(f.corners[i], origin), line);
        side[i] = h[i] > d ? 1 : h[i] < -d ? -1 : 0;
    }
    const auto is_common = [&](unsigned i) {
        return f.corner_at[i] != none && faces_.has(g_slot, f.corner_at[i]);
    };
    Cut cut;
    const auto include = [&](double place, double error) {
        cut.low = std::min(cut.low, place - error);
        cut.high = std::max(cut.high, place + error);
    };
    for (unsigned i = 0; i < 3; ++i) {
        const unsigned j = (i + 1) % 3;
        if (side[i] * side[j] > 0) continue;
        if (side[i] == 0 && side[j] == 0) {
            cut.is_usable = cut.is_usable && is_common(i) && is_common(j);
            continue;
        }
        const Point3 e = minus(f.corners[j], f.corners[i]);
        const double size = length(e), rise = std::fabs(h[j] - h[i]);
        cut.least_sine = std::min(cut.least_sine, length(cross(e, line)) / size);
        cut.is_certain = cut.is_certain || side[i] * side[j] < 0;
        include(at[i] + h[i] / (h[i] - h[j]) * (at[j] - at[i]), 4 * size * d / rise);
    }
    return cut;
}

/// Tests statements (1) and (2). Sines and directions err by a thousandth at most; factors of two
/// in the conditions cover the consequences.
bool Prover::is_clear_as_a_whole(std::uint32_t f_slot, std::uint32_t g_slot,
                                 const Common& common) const {
    constexpr double least_edge_sine = 0x1p-7;
    const Face &f = faces_.faces[f_slot], &g = faces_.faces[g_slot];
    const Point3 across = cross(f.normal, g.normal);
    const double sine = length(across);
    if (!(sine > least_sine_factor * (f.functional_error + g.functional_error))) return false;
    const Point3 line{across.x / sine, across.y / sine, across.z / sine};
    const Cut on_f = cut(f_slot, g_slot, f.corners[0], line);
    const Cut on_g = cut(g_slot, f_slot, f.corners[0], line);
    const double least = std::min(on_f.least_sine, on_g.least_sine), s = sine / 2;
    if (!on_f.is_usable || !on_g.is_usable || !(least > least_edge_sine)) return false;
    if (common.first == g_slot) {
        const double k = s / (2 + 2 / least);
        return is_well_conditioned(common.sizes, 2 * move_ / k);
    }
    if (!on_f.is_certain || !on_g.is_certain) return false;
    const double gap = std::max(on_g.low - on_f.high, on_f.low - on_g.high) / 2;
    return gap * s / (1 + 4 / least) > 4 * move_;
}

/// Returns the height to which the other corners must rise if a part leaves g at a vertex; infinity
/// if the vertex is not well conditioned.
double least_rise(const Sizes& there, double longest, double d) {
    const double l = std::max(there.longest, longest);
    if (!is_well_conditioned({there.altitude, l}, d)) return infinity;
    const double ratio = l / there.altitude;
    return rise_factor * d * ratio * ratio;
}

/// A part that passes the end of a line on which two faces cross has corners above and below.
/// The functional that measures the distance e beyond the edge is therefore rotated about the edge
/// towards the height h, until two corners have equal values. All corners `before` the edge must
/// rise by more than `least` on the same side.
template <class Leaves>
bool leaves_turned(const std::array<double, 3>& e, const std::array<double, 3>& h,
                   const std::array<bool, 3>& before, double least, const Leaves& leaves) {
    bool up = true, down = true;
    for (unsigned i = 0; i < 3; ++i)
        if (before[i]) {
            up = up && h[i] > least;
            down = down && h[i] < -least;
        }
    for (unsigned i = 0; i < 3 && (up || down); ++i) {
        const unsigned j = (i + 1) % 3;
        const double across = h[j] - h[i], along = e[i] - e[j];
        const double size = std::copysign(std::sqrt(across * across + along * along), across);
        const double c = across / size, s = along / size;
        if (leaves(c * e[0] + s * h[0], c * e[1] + s * h[1], c * e[2] + s * h[2])) return true;
    }
    return false;
}

/// Returns the vertex of g at a vertex of f, or none.
std::uint32_t Prover::vertex_of_g(const Pair& pair, std::uint32_t v,
                                  const MarkedFace& marked) const {
    const std::uint32_t point = faces_.vertices[v];
    return pair.g_slot == marked.slot() ? marked.find(point) : faces_.find(pair.g_slot, point);
}

/// Whether a part of f is one of g, too. Of two parts of g, statement (5) tells.
bool Prover::is_part_of_g(const Pair& pair, std::uint32_t e) const {
    const auto faces = moved_.faces_of[faces_.parts[e]];
    return faces.size() > 1 &&
           std::binary_search(faces.begin(), faces.end(), faces_.names[pair.g_slot]);
}

/// Tests statements (3) and (4) for a part of f with all functionals.
bool Prover::is_clear(const Pair& pair, const Triangle& part, const MarkedFace& marked) const {
    const double d = pair.d;
    std::array<Point3, 3> at;
    std::array<bool, 3> on{}; // whether the corner is a vertex of g
    std::array<std::uint32_t, 3> there{};
    double longest = infinity;
    for (unsigned i = 0; i < 3; ++i) {
        there[i] = vertex_of_g(pair, part[i], marked);
        on[i] = there[i] != none;
        at[i] = faces_.places[part[i]];
        longest = std::min(longest, faces_.sizes[part[i]].longest); // >= the part's longest edge
    }
    double least = d; // corners off g must rise above this height
    for (unsigned i = 0; i < 3; ++i)
        if (on[i]) least = std::max(least, least_rise(faces_.sizes[there[i]], longest, d));
    if (std::isinf(least)) return false;
    const auto leaves = [&](double a, double b, double c) {
        const bool rests_a = on[0] && std::fabs(a) <= d / 2,
                   rests_b = on[1] && std::fabs(b) <= d / 2,
                   rests_c = on[2] && std::fabs(c) <= d / 2;
        return (rests_a || a > least) && (rests_b || b > least) && (rests_c || c > least) &&
               !(rests_a && rests_b && rests_c);
    };
    const Functional& height = pair.height;
    const std::array<double, 3> h{height(at[0]), height(at[1]), height(at[2])};
    if (leaves(h[0], h[1], h[2]) || leaves(-h[0], -h[1], -h[2])) return true;
    for (const Functional& u : pair.beyond) {
        const std::array<double, 3> e{u(at[0]), u(at[1]), u(at[2])};
        if (leaves(e[0], e[1], e[2])) return true;
        std::array<bool, 3> before{};
        for (unsigned i = 0; i < 3; ++i)
            before[i] = e[i] <= least && !(on[i] && std::fabs(e[i]) <= d / 2);
        if (leaves_turned(e, h, before, least, leaves)) return true;
    }
    return false;
}

/// Whether a ball is so far from a plane that the computed heights of its points exceed d. They and
/// that of the centre err by less than d / 16: see margin.
bool is_far(const Ball& ball, double lift, double d) {
    return lift - ball.radius > 2 * d;
}

/// Classifies the vertices of f: above the plane of g, below it, resting on a vertex of g, or
/// neither. Those of clusters that are far from the plane stay unknown. Returns true if every
/// vertex that rises rises enough for all vertices that rest.
bool Prover::find_sides(const Pair& pair, Scratch& scratch) const {
    const std::uint32_t first = pair.f.vertex, count = pair.f.vertex_end - first;
    auto& sides = scratch.sides;
    auto& low = scratch.low;
    low.resize(count);
    const Point3* place = faces_.places.data() + first;
    const Functional height = pair.height;
    const double d = pair.d;
    double least_lift = infinity, most_rise = 0;
    std::uint32_t lows = 0;
    const auto classify = [&](std::uint32_t k) { // avoids branches, which would be mispredicted
        const double u = height(place[k]), lift = std::fabs(u);
        sides[k] = static_cast<std::uint8_t>(neither - (u > d ? below : 0) - (u < -d ? above : 0));
        least_lift = std::min(least_lift, lift > d ? lift : least_lift);
        low[lows] = k;
        lows += lift > d ? 0 : 1;
    };
    const FaceClusters* const clusters = clusters_of(pair.f);
    scratch.far.clear();
    if (clusters == nullptr) {
        sides.resize(count);
        for (std::uint32_t k = 0; k < count; ++k) classify(k);
    } else {
        sides.assign(count, unknown);
        const auto& [members, balls] = clusters->vertices;
        for (std::uint32_t c = 0; c < balls.size(); ++c) {
            if (is_far(balls[c], std::fabs(height(balls[c].centre)), d))
                scratch.far.push_back(c);
            else
                for (const std::uint32_t v : members[c]) classify(v - first);
        }
    }
    for (std::uint32_t n = 0; n < lows; ++n) {
        const std::uint32_t k = low[n];
        const std::uint32_t there = vertex_of_g(pair, first + k, scratch.marked);
        if (there == none || !(std::fabs(height(place[k])) <= d / 2)) continue;
        sides[k] = rests;
        most_rise = std::max(most_rise,
                             least_rise(faces_.sizes[there], faces_.sizes[first + k].longest, d));
    }
    if (!(least_lift > most_rise)) return false;
    for (const std::uint32_t c : scratch.far) {
        const Ball& ball = clusters->vertices.balls[c];
        if (std::fabs(height(ball.centre)) - ball.radius - d > most_rise) continue;
        for (const std::uint32_t v : clusters->vertices.members[c])
            if (!(std::fabs(height(faces_.places[v])) > most_rise)) return false;
    }
    return true;
}

/// Returns one bit for each edge of g, set if p lies beyond the edge by more than d.
std::uint8_t edges_before(const std::array<Functional, 3>& beyond, const Point3& p, double d) {
    unsigned edges = 0;
    for (unsigned j = 0; j < 3; ++j)
        if (beyond[j](p) > d) edges |= 1u << j;
    return static_cast<std::uint8_t>(edges);
}

/// Finds the parts of f that may meet parts of g improperly. Most parts lie on one side of the
/// plane of g, or leave it at common vertices.
void Prover::find_left(const Pair& pair, Scratch& scratch, std::vector<std::uint32_t>& left) const {
    left.clear();
    const bool all_leave = find_sides(pair, scratch);
    const std::uint32_t first = pair.f.vertex;
    auto& sides = scratch.sides;
    const auto side = [&](std::uint32_t v) -> unsigned {
        std::uint8_t& s = sides[v - first];
        if (s == unknown) s = pair.height(faces_.places[v]) > 0 ? above : below;
        return s;
    };
    const auto is_doubtful = [&](const Triangle& c) {
        const unsigned i = side(c[0]), j = side(c[1]), k = side(c[2]);
        const unsigned together = i | j | k;
        const bool both_sides = together == neither || together == rests;
        const bool any_rests = i == rests || j == rests || k == rests;
        return both_sides || (any_rests && !all_leave);
    };
    scratch.beyond.assign(sides.size(), unknown);
    const auto beyond = [&](std::uint32_t v) {
        std::uint8_t& edges = scratch.beyond[v - first];
        if (edges == unknown) edges = edges_before(pair.beyond, faces_.places[v], pair.d);
        return edges;
    };
    const auto test = [&](std::uint32_t e) {
        const Triangle& c = faces_.corners[e];
        if (is_doubtful(c) && (beyond(c[0]) & beyond(c[1]) & beyond(c[2])) == 0 &&
            !is_part_of_g(pair, e) && !is_clear(pair, c, scratch.marked))
            left.push_back(e);
    };
    const FaceClusters* const clusters = clusters_of(pair.f);
    if (clusters == nullptr) {
        for (std::uint32_t e = pair.f.part; e < pair.f.part_end; ++e) test(e);
        return;
    }
    const auto& [members, balls] = clusters->parts;
    for (std::size_t c = 0; c < balls.size(); ++c)
        if (!is_far(balls[c], std::fabs(pair.height(balls[c].centre)), pair.d))
            for (const std::uint32_t e : members[c]) test(e);
}

/// Adds the pairs whose boxes overlap if they are few; else the parts of the face with fewer parts
/// left.
void Prover::add_pairs(Scratch& scratch, Found& found) const {
    const auto &f = scratch.left, &g = scratch.left_back;
    if (f.empty() || g.empty()) return;
    constexpr std::size_t few = 4096;
    if (f.size() * g.size() > few) {
        for (const std::uint32_t e : f.size() < g.size() ? f : g)
            found.parts.push_back(faces_.parts[e]);
        return;
    }
    const BoxSource boxes(moved_.points, moved_.parts);
    scratch.boxes.clear();
    for (const std::uint32_t h : g) scratch.boxes.push_back(boxes[faces_.parts[h]]);
    for (const std::uint32_t e : f) {
        const std::uint32_t a = faces_.parts[e];
        const Box box = boxes[a];
        for (std::size_t k = 0; k < g.size(); ++k) {
            const std::uint32_t b = faces_.parts[g[k]];
            if (box.overlaps(scratch.boxes[k]) && a != b)
                found.pairs.push_back({std::min(a, b), std::max(a, b)});
        }
    }
}

/// Computes the sizes of the parts of g and of each other face at their common vertices.
void Prover::find_common(std::uint32_t g_slot, std::vector<Common>& common) const {
    common.resize(faces_.faces.size());
    const Face& g = faces_.faces[g_slot];
    for (std::uint32_t v = g.vertex; v < g.vertex_end; ++v)
        for (const VertexOfFace& other : faces_.at[faces_.vertices[v]]) {
            Common& c = common[other.face];
            if (c.first != g_slot) c = {g_slot, {}};
            c.sizes.add(faces_.sizes[v]);
            c.sizes.add(faces_.sizes[other.vertex]);
        }
}

/// Returns the pairs that are not clear as a whole, as indices into Faces::faces.
std::vector<CandidatePair> Prover::find_doubtful(const Run& run) const {
    std::vector<std::size_t> groups; // the first pair of each with the same first face, and the end
    for (std::size_t i = 0; i < meeting_.size(); ++i)
        if (i == 0 || meeting_[i].first != meeting_[i - 1].first) groups.push_back(i);
    groups.push_back(meeting_.size());
    tbb::enumerable_thread_specific<std::vector<Common>> scratch;
    return concatenated(for_blocks<std::vector<CandidatePair>>(
        groups.size() - 1, 16, run, [&](std::size_t first, std::size_t last) {
            std::vector<CandidatePair> doubtful;
            std::vector<Common>& common = scratch.local();
            for (std::size_t n = first; n < last; ++n) {
                const std::uint32_t g = faces_.slot_of[meeting_[groups[n]].first];
                find_common(g, common);
                for (std::size_t i = groups[n]; i < groups[n + 1]; ++i) {
                    const std::uint32_t f = faces_.slot_of[meeting_[i].second];
                    if (!is_clear_as_a_whole(f, g, common[f])) doubtful.push_back({g, f});
                }
            }
            return doubtful;
        }));
}

/// The steps per part of a face beyond which tests of all pairs of parts cost less.
constexpr std::uint64_t most_per_part = 256;

/// Whether vertices are common to so few faces that find_common costs little.
bool Prover::has_few_common() const {
    std::uint64_t sum = 0;
    for (std::size_t p = 0; p < faces_.at.size(); ++p)
        sum += std::uint64_t{faces_.at[p].size()} * faces_.at[p].size();
    return sum <= most_per_part * faces_.parts.size();
}

/// Whether the parts of the faces are few enough for a test of each pair. Many faces with many
/// parts, each in doubt with each, would cost more than the size of the mesh warrants.
bool Prover::is_affordable(std::span<const CandidatePair> doubtful) const {
    constexpr std::uint64_t few_parts = 128;
    std::uint64_t sum = 0;
    for (const CandidatePair& p : doubtful)
        if (const std::uint64_t n = faces_.part_count(p.second); n > few_parts) sum += n;
    return sum <= most_per_part * faces_.parts.size();
}

/// Adds the parts of the second faces.
void Prover::add_all_parts(std::span<const CandidatePair> doubtful,
                           std::vector<std::uint32_t>& parts) const {
    std::vector<bool> added(faces_.faces.size(), false);
    for (const CandidatePair& p : doubtful) {
        if (added[p.second]) continue;
        added[p.second] = true;
        const Face& f = faces_.faces[p.second];
        parts.insert(parts.end(), faces_.parts.begin() + f.part, faces_.parts.begin() + f.part_end);
    }
}

/// Clusters the faces of many pairs, where that pays.
void Prover::cluster_faces(std::span<const CandidatePair> doubtful, const Run& run) {
    constexpr std::uint32_t many_pairs = 8;
    std::vector<std::uint32_t> pairs(faces_.faces.size(), 0), slots;
    for (const CandidatePair& p : doubtful)
        for (const std::uint32_t s : {p.first, p.second})
            if (++pairs[s] == many_pairs) slots.push_back(s);
    faces_.cluster(slots, run);
}

void Prover::test_pair(const CandidatePair& slots, Scratch& scratch, Found& found) const {
    const auto [g, f] = slots;
    scratch.marked.mark(faces_, g);
    find_left(pair_of(f, g), scratch, scratch.left);
    if (scratch.left.empty()) return;
    find_left(pair_of(g, f), scratch, scratch.left_back);
    add_pairs(scratch, found);
}

Unproven Prover::operator()(const Run& run) {
    Unproven all;
    std::vector<CandidatePair> doubtful;
    if (has_few_common())
        doubtful = find_doubtful(run);
    else
        all.parts = faces_.parts;
    if (!is_affordable(doubtful)) {
        add_all_parts(doubtful, all.parts);
        doubtful.clear();
    }
    cluster_faces(doubtful, run);
    tbb::enumerable_thread_specific<Scratch> scratch;
    const auto blocks =
        for_blocks<Found>(doubtful.size(), 64, run, [&](std::size_t first, std::size_t last) {
            Found found;
            for (std::size_t i = first; i < last; ++i)
                test_pair(doubtful[i], scratch.local(), found);
            return found;
        });
    for (const Found& b : blocks) {
        all.pairs.insert(all.pairs.end(), b.pairs.begin(), b.pairs.end());
        all.parts.insert(all.parts.end(), b.parts.begin(), b.parts.end());
    }
    for (const Face& f : faces_.faces) add_restless(f, all.ill_conditioned);
    sort_unique(all.pairs);
    sort_unique(all.parts);
    sort_unique(all.ill_conditioned);
    return all;
}

} // namespace

Unproven find_unproven(const MovedParts& moved, std::span<const CandidatePair> meeting,
                       const Run& run) {
    return Prover(moved, meeting, run)(run);
}

} // namespace terrane::rounding::detail
