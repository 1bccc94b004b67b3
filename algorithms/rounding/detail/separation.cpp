// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/separation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/enumerable_thread_specific.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/rounding/detail/separation_faces.hpp>
#include <terrane/algorithms/rounding/detail/separation_pairs.hpp>

namespace terrane::rounding::detail {
namespace {

/// The sizes of the parts of two faces at their common vertices.
struct Common {
    std::uint32_t first = none; ///< the first of the two faces
    Sizes sizes;
};

double most_of(std::span<const double> moves) {
    return moves.empty() ? 0 : *std::max_element(moves.begin(), moves.end());
}

/// The interval in which a face meets the line between its plane and another plane.
struct Cut {
    double low = std::numeric_limits<double>::infinity(); ///< outer bound of one end
    double high = -low;                                   ///< of the other
    double least_sine = 1;   ///< of the angles of crossed edges with the line
    bool is_certain = false; ///< the face has points on both sides of the line
    bool is_usable = true;
};

class Prover {
public:
    Prover(const MovedParts& moved, std::span<const CandidatePair> meeting, const Run& run) :
        moved_(moved), meeting_(meeting), faces_(moved, meeting, most_of(moved.moves), run) {}

    [[nodiscard]] Unproven operator()(const Run& run);
    /// Returns how many pairs are not clear as a whole; 0 if find_common would cost much.
    [[nodiscard]] std::size_t count_doubtful(const Run& run) const {
        return has_few_common() ? find_doubtful(run).size() : 0;
    }

private:
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

    const MovedParts& moved_;
    std::span<const CandidatePair> meeting_;
    Faces faces_;
};

/// Adds the parts of a face that may meet another part of it improperly.
void Prover::add_restless(const Face& f, std::vector<std::uint32_t>& parts) const {
    if (f.part_end - f.part == 1) return;
    const auto calm = [&](std::uint32_t v) {
        return faces_.sizes[v].is_well_conditioned(4 * faces_.move);
    };
    for (std::uint32_t e = f.part; e < f.part_end; ++e) {
        const Triangle& c = faces_.corners[e];
        if (!std::all_of(c.begin(), c.end(), calm)) parts.push_back(faces_.parts[e]);
    }
}

/// Cuts f by the plane of g. An edge between corners on both sides is crossed at one place, which
/// is known as precisely as the heights of the corners. Near a corner that may be on the plane, the
/// line may cross either edge. An edge may lie on the line only if its ends are vertices of both
/// faces.
Cut Prover::cut(std::uint32_t f_slot, std::uint32_t g_slot, const Point3& origin,
                const Point3& line) const {
    const Face &f = faces_.faces[f_slot], &g = faces_.faces[g_slot];
    const Functional height = g.height();
    const double d = faces_.margin(f, g);
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
        return common.sizes.is_well_conditioned(2 * faces_.move / k);
    }
    if (!on_f.is_certain || !on_g.is_certain) return false;
    const double gap = std::max(on_g.low - on_f.high, on_f.low - on_g.high) / 2;
    return gap * s / (1 + 4 / least) > 4 * faces_.move;
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
/// parts, each in doubt with each, would cost more than the size of the mesh warrants. So would faces
/// with few parts that are in doubt with more others than they have parts.
bool Prover::is_affordable(std::span<const CandidatePair> doubtful) const {
    if (doubtful.size() > faces_.parts.size()) return false;
    std::uint64_t sum = 0;
    for (const CandidatePair& p : doubtful)
        if (const std::uint64_t n = faces_.part_count(p.second); n >= many_parts) sum += n;
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
    tbb::enumerable_thread_specific<PairProver> provers(
        [this] { return PairProver(moved_, faces_); });
    const auto blocks =
        for_blocks<Unproven>(doubtful.size(), 64, run, [&](std::size_t first, std::size_t last) {
            PairProver& prover = provers.local();
            Unproven found;
            for (std::size_t i = first; i < last; ++i)
                prover(doubtful[i].first, doubtful[i].second, found);
            return found;
        });
    for (const Unproven& b : blocks) {
        all.pairs.insert(all.pairs.end(), b.pairs.begin(), b.pairs.end());
        all.parts.insert(all.parts.end(), b.parts.begin(), b.parts.end());
    }
    for (const Face& f : faces_.faces) add_restless(f, all.ill_conditioned);
    sort_unique(all.parts);
    sort_unique(all.ill_conditioned);
    return all;
}

/// Tells from a sample of one in 32 whether more pairs are in doubt than there are parts, so that a
/// test of all pairs of parts would follow: see Prover::is_affordable().
bool are_mostly_doubtful(const MovedParts& moved, std::span<const CandidatePair> meeting,
                         const Run& run) {
    constexpr std::size_t every = 32;
    if (meeting.size() <= moved.parts.size()) return false;
    std::vector<CandidatePair> sample;
    for (const CandidatePair& p : meeting)
        if (p.first % every == 0) sample.push_back(p);
    const std::size_t doubtful = Prover(moved, sample, run).count_doubtful(run);
    return doubtful * meeting.size() > sample.size() * moved.parts.size();
}

/// Returns the parts of all faces in pairs, ascending.
std::vector<std::uint32_t> parts_of_pairs(const MovedParts& moved,
                                          std::span<const CandidatePair> meeting) {
    std::vector<bool> is_in_pair(moved.faces.size(), false);
    for (const CandidatePair& p : meeting) is_in_pair[p.first] = is_in_pair[p.second] = true;
    std::vector<std::uint32_t> parts;
    for (std::uint32_t t = 0; t < moved.parts.size(); ++t)
        if (std::ranges::any_of(moved.faces_of[t], [&](std::uint32_t f) { return is_in_pair[f]; }))
            parts.push_back(t);
    return parts;
}

} // namespace

std::vector<bool> ill_conditioned_in_pools(const MovedParts& moved,
                                           const IndexLists<std::uint32_t>& pools) {
    const double move = most_of(moved.moves);
    std::vector<bool> found(moved.parts.size(), false);
    std::vector<Sizes> sizes(moved.points.size()); // of the pool at hand; clear at its end
    for (std::size_t k = 0; k < pools.size(); ++k) {
        const auto pool = pools[k];
        for (const std::uint32_t t : pool) {
            const Triangle& c = moved.parts[t];
            const Sizes own =
                sizes_of_part({moved.points[c[0]], moved.points[c[1]], moved.points[c[2]]}, move);
            for (const std::uint32_t v : c) sizes[v].add(own);
        }
        for (const std::uint32_t t : pool) {
            const Triangle& c = moved.parts[t];
            found[t] = !std::all_of(c.begin(), c.end(), [&](std::uint32_t v) {
                return sizes[v].is_well_conditioned(4 * move);
            });
        }
        for (const std::uint32_t t : pool)
            for (const std::uint32_t v : moved.parts[t]) sizes[v] = {};
    }
    return found;
}

Unproven find_unproven(const MovedParts& moved, std::span<const CandidatePair> meeting,
                       const Run& run) {
    if (are_mostly_doubtful(moved, meeting, run)) {
        const auto parts = parts_of_pairs(moved, meeting);
        return {{}, parts, parts};
    }
    return Prover(moved, meeting, run)(run);
}

} // namespace terrane::rounding::detail
