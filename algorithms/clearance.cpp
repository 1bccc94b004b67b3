// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/clearance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

#include <terrane/algorithms/clearance_faces.hpp>
#include <terrane/algorithms/intersection.hpp>
#include <terrane/algorithms/parallel.hpp>
#include <terrane/algorithms/sets.hpp>
#include <terrane/algorithms/vectors.hpp>

namespace terrane {
namespace {

using namespace clearance;

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
    std::vector<std::uint8_t> sides;            ///< per corner of a cell
    std::vector<std::uint8_t> beyond;           ///< per corner: see edges_before, or unknown
    std::vector<std::uint32_t> low;             ///< corners that are not clearly above or below
    std::vector<std::uint32_t> doubtful;        ///< entries of Faces::parts
    std::vector<std::uint32_t> left, left_back; ///< entries of Faces::parts without proof
    std::vector<Box> boxes;                     ///< of left_back
};

struct Found {
    std::vector<CandidatePair> pairs;
    std::vector<std::uint32_t> parts;
};

double most_of(std::span<const double> moves) {
    return moves.empty() ? 0 : *std::max_element(moves.begin(), moves.end());
}

class Prover {
public:
    Prover(const MovedParts& moved, std::span<const CandidatePair> meeting, const Run& run) :
        Prover(moved, meeting, Measured(moved, meeting, run), run) {}

    [[nodiscard]] Unclear operator()(const Run& run);

private:
    Prover(const MovedParts& moved, std::span<const CandidatePair> meeting, Measured measured,
           const Run& run) :
        moved_(moved),
        move_(most_of(moved.moves)), meeting_(close_pairs(meeting, measured, run)),
        faces_(moved, std::move(measured), meeting_, move_, run) {}

    /// Parts of f are to be told clear of g.
    struct Pair {
        std::uint32_t f_name, g_name;
        const Face& g;
        double d;                      ///< the margin
        std::span<const Stamp> stamps; ///< of g
        std::span<Stamp> stamps_back;  ///< of f, for the other direction; or none
    };

    [[nodiscard]] std::vector<CandidatePair> close_pairs(std::span<const CandidatePair> meeting,
                                                         const Measured& measured,
                                                         const Run& run) const;
    [[nodiscard]] double margin(double extent, const Face& g) const;
    [[nodiscard]] const Face& face(std::uint32_t f) const {
        return faces_.faces[faces_.slot_of[f]];
    }
    [[nodiscard]] std::span<const Cell> cells_of(const Face& f) const {
        return {faces_.cells.data() + f.cell, faces_.cells.data() + f.cell_end};
    }
    void add_restless(const Face& f, std::vector<std::uint32_t>& parts) const;
    void test_group(std::size_t first, std::size_t last, Scratch& scratch, Found& found) const;
    void stamp(std::uint32_t f, std::vector<Stamp>& stamps) const;
    [[nodiscard]] bool is_apart(const Face& f, const Face& g) const;
    [[nodiscard]] bool is_clear(const Pair& pair, const Cell& cell, std::uint32_t entry) const;
    bool find_sides(const Pair& pair, const Cell& cell, Scratch& scratch) const;
    void find_left(const Pair& pair, const Cell& cell, Scratch& scratch,
                   std::vector<std::uint32_t>& left) const;
    void find_left(const Pair& pair, Scratch& scratch, std::vector<std::uint32_t>& left) const;
    void add_pairs(Scratch& scratch, Found& found) const;

    const MovedParts& moved_;
    double move_;                        ///< d: the most
    std::vector<CandidatePair> meeting_; ///< the pairs of faces that are not apart as a whole
    Faces faces_;                        ///< of these
};

/// The pairs that are not apart as a whole.
std::vector<CandidatePair> Prover::close_pairs(std::span<const CandidatePair> meeting,
                                               const Measured& measured, const Run& run) const {
    const auto blocks = for_blocks<std::vector<CandidatePair>>(
        meeting.size(), 1024, run, [&](std::size_t first, std::size_t last) {
            std::vector<CandidatePair> close;
            for (const CandidatePair& p : meeting.subspan(first, last - first)) {
                const Face &f = measured[p.second], &g = measured[p.first];
                if (!is_apart(f, g) && !is_apart(g, f)) close.push_back(p);
            }
            return close;
        });
    std::vector<CandidatePair> close;
    for (const auto& block : blocks) close.insert(close.end(), block.begin(), block.end());
    return close;
}

/// a^2 >= 64 d l; also false where anything has underflown.
bool is_calm(const Sizes& s, double d) {
    return s.altitude > smallest_area && s.altitude * s.altitude >= 64 * d * s.longest;
}

/// Parts of it that may meet another one of it improperly.
void Prover::add_restless(const Face& f, std::vector<std::uint32_t>& parts) const {
    if (f.part_end - f.part == 1) return;
    for (const Cell& cell : cells_of(f)) {
        const auto calm = [&](std::uint32_t corner) {
            return is_calm(faces_.sizes[faces_.vertex_at[cell.corner + corner]], 4 * move_);
        };
        for (std::uint32_t e = cell.part; e < cell.part_end; ++e) {
            const auto& c = faces_.corners[e];
            if (!std::all_of(c.begin(), c.end(), calm)) parts.push_back(faces_.parts[e]);
        }
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
bool Prover::is_apart(const Face& f, const Face& g) const {
    const double d = margin(f.extent, g);
    const Point3 &p = f.corners[0], &q = f.corners[1], &r = f.corners[2];
    const double a = g.height(p), b = g.height(q), c = g.height(r);
    if ((a > d && b > d && c > d) || (a < -d && b < -d && c < -d)) return true;
    return std::any_of(g.beyond.begin(), g.beyond.end(),
                       [&](const Functional& u) { return u(p) > d && u(q) > d && u(r) > d; });
}

/// What the other corners must rise to when a part leaves g at a vertex; infinite where g is not
/// calm.
double least_rise(const Sizes& there, double longest, double d) {
    const double l = std::max(there.longest, longest);
    if (!is_calm({there.altitude, l}, d)) return std::numeric_limits<double>::infinity();
    const double ratio = l / there.altitude;
    return 128 * d * ratio * ratio;
}

/// Where a part passes the end of a line on which faces cross, it has corners above and below. So
/// the distance e beyond the edge there is turned round it, into the height h, until two corners
/// are equally far. Corners `before` the edge must all rise by that.
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

/// Case (1) or (2) of the lemma for a part of another face, by any of the functionals.
bool Prover::is_clear(const Pair& pair, const Cell& cell, std::uint32_t entry) const {
    const double d = pair.d;
    std::array<Point3, 3> at;
    std::array<bool, 3> on{}; // it is a vertex of g
    std::array<const Sizes*, 3> there{};
    double longest = std::numeric_limits<double>::infinity();
    for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t corner = cell.corner + faces_.corners[entry][i];
        const std::uint32_t v = faces_.vertex_at[corner];
        const Stamp& s = pair.stamps[faces_.vertices[v]];
        on[i] = s.face == pair.g_name;
        if (on[i]) there[i] = &faces_.sizes[s.vertex];
        at[i] = faces_.places[corner];
        longest = std::min(longest, faces_.sizes[v].longest); // its own is in all three
    }
    double least = d; // what corners off g must rise above
    for (unsigned i = 0; i < 3; ++i)
        if (on[i]) least = std::max(least, least_rise(*there[i], longest, d));
    if (std::isinf(least)) return false;
    const auto leaves = [&](double a, double b, double c) {
        const bool rests_a = on[0] && std::fabs(a) <= d / 2,
                   rests_b = on[1] && std::fabs(b) <= d / 2,
                   rests_c = on[2] && std::fabs(c) <= d / 2;
        return (rests_a || a > least) && (rests_b || b > least) && (rests_c || c > least) &&
               !(rests_a && rests_b && rests_c);
    };
    const Functional& height = pair.g.height;
    const std::array<double, 3> h{height(at[0]), height(at[1]), height(at[2])};
    if (leaves(h[0], h[1], h[2]) || leaves(-h[0], -h[1], -h[2])) return true;
    for (const Functional& u : pair.g.beyond) {
        const std::array<double, 3> e{u(at[0]), u(at[1]), u(at[2])};
        if (leaves(e[0], e[1], e[2])) return true;
        std::array<bool, 3> before{};
        for (unsigned i = 0; i < 3; ++i)
            before[i] = e[i] <= least && !(on[i] && std::fabs(e[i]) <= d / 2);
        if (leaves_turned(e, h, before, least, leaves)) return true;
    }
    return false;
}

/// Where the corners of a cell are: above the plane of g, below it, resting on a vertex of g in it,
/// or neither. True if what rises at all rises enough for whatever rests. Those that rest are
/// entered in stamps_back as vertices of f: no others matter to parts of g.
bool Prover::find_sides(const Pair& pair, const Cell& cell, Scratch& scratch) const {
    const std::uint32_t count = cell.corner_end - cell.corner;
    auto& sides = scratch.sides;
    auto& low = scratch.low;
    sides.resize(count);
    low.resize(count);
    const Point3* place = faces_.places.data() + cell.corner;
    const Functional height = pair.g.height;
    const double d = pair.d;
    double least_lift = std::numeric_limits<double>::infinity(), most_rise = 0;
    std::uint32_t lows = 0; // no branches: they would be foretold badly
    for (std::uint32_t k = 0; k < count; ++k) {
        const double u = height(place[k]), lift = std::fabs(u);
        sides[k] = static_cast<std::uint8_t>(neither - (u > d ? below : 0) - (u < -d ? above : 0));
        least_lift = std::min(least_lift, lift > d ? lift : least_lift);
        low[lows] = k;
        lows += lift > d ? 0 : 1;
    }
    for (std::uint32_t n = 0; n < lows; ++n) {
        const std::uint32_t k = low[n], v = faces_.vertex_at[cell.corner + k];
        const Stamp& s = pair.stamps[faces_.vertices[v]];
        if (s.face != pair.g_name) continue;
        if (!pair.stamps_back.empty()) pair.stamps_back[faces_.vertices[v]] = {pair.f_name, v};
        if (!(std::fabs(height(place[k])) <= d / 2)) continue;
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

/// The parts of a cell that may meet parts of g improperly. Most lie on one side of its plane, or
/// leave it at vertices of both.
void Prover::find_left(const Pair& pair, const Cell& cell, Scratch& scratch,
                       std::vector<std::uint32_t>& left) const {
    const bool all_leave = find_sides(pair, cell, scratch);
    const auto& sides = scratch.sides;
    const auto is_doubtful = [&](const std::array<std::uint16_t, 3>& c) {
        const unsigned i = sides[c[0]], j = sides[c[1]], k = sides[c[2]], together = i | j | k;
        const bool both_sides = together == neither || together == rests;
        const bool any_rests = i == rests || j == rests || k == rests;
        return both_sides | (any_rests & !all_leave);
    };
    auto& doubtful = scratch.doubtful;
    doubtful.resize(cell.part_end - cell.part);
    std::size_t doubts = 0;
    for (std::uint32_t e = cell.part; e < cell.part_end; ++e) {
        doubtful[doubts] = e;
        doubts += is_doubtful(faces_.corners[e]) ? 1 : 0;
    }
    if (doubts == 0) return;
    scratch.beyond.assign(sides.size(), unknown);
    const auto beyond = [&](std::uint32_t corner) {
        std::uint8_t& edges = scratch.beyond[corner];
        if (edges == unknown)
            edges = edges_before(pair.g, faces_.places[cell.corner + corner], pair.d);
        return edges;
    };
    for (std::size_t n = 0; n < doubts; ++n) {
        const auto& [i, j, k] = faces_.corners[doubtful[n]];
        if ((beyond(i) & beyond(j) & beyond(k)) != 0) continue;
        if (!is_clear(pair, cell, doubtful[n])) left.push_back(doubtful[n]);
    }
}

/// Tells cells of f that lie on one side of the plane of g, or beyond one of its edges, as a whole.
class FarCells {
public:
    FarCells(const Face& f, const Face& g, double d) :
        functionals_{FramedFunctional(g.height, f.frame),
                     {g.beyond[0], f.frame},
                     {g.beyond[1], f.frame},
                     {g.beyond[2], f.frame}},
        twice_(2 * d) {}

    // A box is as near to the corners in it as rounding permits, which takes the points a few units
    // of the size of both faces off their places in the frame: twice the margin is room for that.
    [[nodiscard]] bool operator()(const Cell& cell) const {
        const double height = functionals_[0](cell.centre);
        if (std::fabs(height) - spread(functionals_[0], cell) > twice_) return true;
        for (unsigned j = 1; j < 4; ++j)
            if (functionals_[j](cell.centre) - spread(functionals_[j], cell) > twice_) return true;
        return false;
    }

private:
    static double spread(const FramedFunctional& u, const Cell& cell) {
        const Point3 &n = u.factor, &h = cell.half;
        return (std::fabs(n.x) * h.x + std::fabs(n.y) * h.y + std::fabs(n.z) * h.z) * (1 + 0x1p-40);
    }

    std::array<FramedFunctional, 4> functionals_;
    double twice_;
};

/// The same of all f; where it has many parts, most cells are far from g.
void Prover::find_left(const Pair& pair, Scratch& scratch, std::vector<std::uint32_t>& left) const {
    const Face& f = face(pair.f_name);
    left.clear();
    const auto cells = cells_of(f);
    if (cells.size() == 1) return find_left(pair, cells.front(), scratch, left);
    const FarCells is_far(f, pair.g, pair.d);
    for (const Cell& cell : cells)
        if (!is_far(cell)) find_left(pair, cell, scratch, left);
}

/// Few pairs are listed where their boxes overlap; where they are many, the parts of the smaller
/// side.
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

/// Pairs with the same first face.
void Prover::test_group(std::size_t first, std::size_t last, Scratch& scratch, Found& found) const {
    const std::uint32_t g = meeting_[first].first;
    auto& [of_g, of_f] = scratch.stamps;
    of_f.resize(moved_.points.size());
    stamp(g, of_g);
    for (std::size_t i = first; i < last; ++i) {
        const std::uint32_t f = meeting_[i].second;
        find_left({f, g, face(g), margin(face(f).extent, face(g)), of_g, of_f}, scratch,
                  scratch.left);
        if (scratch.left.empty()) continue;
        find_left({g, f, face(f), margin(face(g).extent, face(f)), of_f, {}}, scratch,
                  scratch.left_back);
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
