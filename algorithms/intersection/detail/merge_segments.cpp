// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Merges the segments of a pool, or of a triangle with many segments on few lines, line by line:
// (1) equal ends get one name;
// (2) segments of one supporting edge, plane or pool are on one line by name, and lines that turn
//     out to be equal by exact tests are joined;
// (3) on each line, segments that overlap become one, and the other ends become points on it.
// Lines are compared only if they are near each other in doubles. Lines that are equal but were
// not compared are not joined, which costs time and changes nothing else.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/intersection/contacts.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t many_segments = 64;

/// The merged pieces of a range of faces.
struct MergedBlock {
    std::vector<FaceConstraint> pieces;
    std::vector<FaceCrossing> touching; ///< pieces are indices into the block's
    bool is_merged = false;             ///< else the pieces of its faces stay as they are
};

/// A segment to merge. Ends are ranks among the points of the face.
struct RankedSegment {
    std::array<std::uint32_t, 2> ends; ///< ascending
    SupportLine support;
    std::array<std::uint32_t, 3> name; ///< equal only for segments on one line
};

class SegmentMerger {
public:
    SegmentMerger(UpwardWitness upward, const TriangleSoup& soup, const Contacts& contacts) :
        upward_(upward), soup_(soup), contacts_(contacts) {}

    /// Merges the pieces of a triangle in no pool. Returns false if that is not worthwhile.
    bool merge_face(std::span<const FaceConstraint> pieces, MergedBlock& out) {
        if (pieces.size() <= many_segments) return false;
        begin(pieces.front().face);
        for (const FaceConstraint& piece : pieces) {
            add_point(piece.ends[0], piece.place[0]);
            add_point(piece.ends[1], piece.place[1]);
            if (piece.is_inner_segment()) add_segment(piece.ends, piece.support);
        }
        if (segments_.size() <= many_segments || !is_worthwhile()) return false;
        merge(out);
        return true;
    }

    /// Merges the edges of the faces of a pool, and all pieces in them.
    void merge_pool(std::span<const std::uint32_t> faces,
                    std::span<const std::span<const FaceConstraint>> pieces_of_faces,
                    MergedBlock& out) {
        begin(faces.front());
        for (const std::uint32_t f : faces)
            for (std::uint8_t e = 0; e < 3; ++e) {
                const Triangle& t = soup_.triangles[f];
                add_point(t[e], Simplex::face);
                add_segment({t[e], t[(e + 1) % 3]}, {f, e});
            }
        for (const auto& pieces : pieces_of_faces)
            for (const FaceConstraint& piece : pieces) {
                for (const PointIndex end : piece.ends) add_point(end, Simplex::face);
                if (piece.is_inner_segment()) add_segment(piece.ends, piece.support);
            }
        merge(out);
    }

private:
    struct PlacedPoint {
        PointIndex point;
        Simplex place;
    };
    /// Segments on one line: those from first to last of the sorted segments.
    struct NamedLine {
        std::size_t first, last;
        std::array<std::uint32_t, 2> ends; ///< lowest and highest rank
    };

    void begin(std::uint32_t face) {
        face_ = face;
        points_.clear();
        segments_.clear();
        const Triangle& t = soup_.triangles[face];
        axis_ = projection_axis(soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]]);
    }

    void add_point(PointIndex p, Simplex place) { points_.push_back({p, place}); }

    void add_segment(std::array<PointIndex, 2> ends, SupportLine support) {
        const Triangle& t = soup_.triangles[support.other];
        std::array<std::uint32_t, 3> name{0, support.other, 0};
        if (!support.is_plane()) {
            const auto [low, high] = std::minmax(t[support.edge], t[(support.edge + 1) % 3]);
            name = {1, low, high};
        } else if (!contacts_.pools.of.empty() && contacts_.pools.of[support.other] != no_group) {
            name = {2, contacts_.pools.of[support.other], 0};
        }
        segments_.push_back({ends, support, name});
    }

    /// Whether there are far fewer ends or lines than segments, as where many planes pass through
    /// one line or many triangles lie in one plane.
    [[nodiscard]] bool is_worthwhile() const {
        std::vector<std::array<std::uint32_t, 3>> names;
        std::vector<std::uint32_t> ends;
        for (const RankedSegment& s : segments_) {
            names.push_back(s.name);
            ends.insert(ends.end(), s.ends.begin(), s.ends.end());
        }
        sort_unique(names);
        sort_unique(ends);
        return 2 * std::min(names.size(), ends.size()) <= segments_.size();
    }

    void merge(MergedBlock& out) {
        rank_points();
        std::sort(segments_.begin(), segments_.end(), [](const auto& a, const auto& b) {
            return std::pair{a.name, a.ends} < std::pair{b.name, b.ends};
        });
        name_lines();
        join_lines();
        write(out);
    }

    // (1)
    void rank_points() {
        const PointStore& store = contacts_.points;
        std::sort(points_.begin(), points_.end(),
                  [](const PlacedPoint& a, const PlacedPoint& b) { return a.point < b.point; });
        const auto same = [](const PlacedPoint& a, const PlacedPoint& b) {
            return a.point == b.point;
        };
        points_.erase(std::unique(points_.begin(), points_.end(), same), points_.end());
        std::vector<PointIndex> names;
        for (const PlacedPoint& p : points_) names.push_back(p.point);
        std::vector<std::uint32_t> order(points_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            const auto by_place = store.compare(names[a], names[b]);
            return by_place != 0 ? by_place < 0 : a < b; // of equal points the first stands for all
        });
        std::vector<std::uint32_t> rank_of(order.size());
        std::vector<PlacedPoint> ranked;
        for (const std::uint32_t k : order) {
            if (ranked.empty() || !store.equal(ranked.back().point, names[k]))
                ranked.push_back(points_[k]);
            rank_of[k] = static_cast<std::uint32_t>(ranked.size() - 1);
        }
        const auto rank = [&](PointIndex p) {
            return rank_of[static_cast<std::size_t>(
                std::lower_bound(names.begin(), names.end(), p) - names.begin())];
        };
        for (RankedSegment& s : segments_) {
            s.ends = {rank(s.ends[0]), rank(s.ends[1])};
            if (s.ends[1] < s.ends[0]) std::swap(s.ends[0], s.ends[1]);
        }
        points_ = std::move(ranked);
    }

    void name_lines() {
        lines_.clear();
        for (std::size_t k = 0; k < segments_.size(); ++k) {
            const auto& [low, high] = segments_[k].ends;
            if (k == 0 || segments_[k].name != segments_[k - 1].name)
                lines_.push_back({k, k, {low, high}});
            NamedLine& line = lines_.back();
            line.last = k + 1;
            line.ends = {std::min(line.ends[0], low), std::max(line.ends[1], high)};
        }
    }

    [[nodiscard]] Sign turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const PointStore& store = contacts_.points;
        const PointIndex p = points_[a].point, q = points_[b].point, r = points_[c].point;
        if (p == r || q == r) return Sign::Zero;
        const auto quick = filtered_orient2d(
            store.approximate(axis_, p), store.approximate(axis_, q), store.approximate(axis_, r));
        return quick ? *quick : store.orient2d(upward_, axis_, p, q, r);
    }

    [[nodiscard]] bool are_one_line(const NamedLine& a, const NamedLine& b) const {
        return turn(a.ends[0], a.ends[1], b.ends[0]) == Sign::Zero &&
               turn(a.ends[0], a.ends[1], b.ends[1]) == Sign::Zero;
    }

    /// The box of all points in the projection.
    struct Extent {
        double u = 0, v = 0, size = 1; ///< centre and size

        Extent(const PointStore& store, Axis axis, std::span<const PlacedPoint> points) {
            auto at = store.approximate(axis, points.front().point);
            std::array low{at.u, at.v}, high = low;
            for (const PlacedPoint& p : points) {
                at = store.approximate(axis, p.point);
                low = {std::min(low[0], at.u), std::min(low[1], at.v)};
                high = {std::max(high[0], at.u), std::max(high[1], at.v)};
            }
            u = low[0] / 2 + high[0] / 2;
            v = low[1] / 2 + high[1] / 2;
            size = std::max(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2);
        }
    };

    /// Returns a cell of lines with nearly the same direction and distance from the centre.
    [[nodiscard]] std::array<std::int64_t, 3> cell_of(const NamedLine& line,
                                                      const Extent& extent) const {
        constexpr double cells = 0x1p20;
        const PointStore& store = contacts_.points;
        const auto a = store.approximate(axis_, points_[line.ends[0]].point);
        const auto b = store.approximate(axis_, points_[line.ends[1]].point);
        double du = (b.u - a.u) / extent.size, dv = (b.v - a.v) / extent.size;
        const bool steep = std::fabs(dv) > std::fabs(du);
        if (steep) std::swap(du, dv);
        const double slope = dv / du;
        double s = (a.u - extent.u) / extent.size, t = (a.v - extent.v) / extent.size;
        if (steep) std::swap(s, t);
        const double offset = t - s * slope;
        if (!(std::fabs(slope) <= 2 && std::fabs(offset) <= 8)) return {2, 0, 0};
        return {steep ? 1 : 0, static_cast<std::int64_t>(std::floor(slope * cells)),
                static_cast<std::int64_t>(std::floor(offset * cells))};
    }

    // (2) Lines in the same or neighbouring cells are compared, but only with the first line of
    // each set there, and with a few sets. Where lines have a slope of about 1 in either direction,
    // some equal ones are in cells that are not compared.
    void join_lines() {
        DisjointSets sets(lines_.size());
        const Extent extent(contacts_.points, axis_, points_);
        const auto hash = [](const std::array<std::int64_t, 3>& c) {
            const auto h = static_cast<std::uint64_t>(c[1]) * 0x9e3779b97f4a7c15u ^
                           static_cast<std::uint64_t>(c[2]);
            return static_cast<std::size_t>((h * 0x9e3779b97f4a7c15u >> 7) +
                                            static_cast<std::uint64_t>(c[0]));
        };
        std::unordered_map<std::array<std::int64_t, 3>, std::vector<std::uint32_t>, decltype(hash)>
            near(lines_.size(), hash);
        constexpr std::size_t few = 16;
        for (std::uint32_t k = 0; k < lines_.size(); ++k) {
            const auto cell = cell_of(lines_[k], extent);
            bool joined = false;
            for (std::int64_t i = -1; i <= 1 && !joined; ++i)
                for (std::int64_t j = -1; j <= 1 && !joined; ++j) {
                    const auto found = near.find({cell[0], cell[1] + i, cell[2] + j});
                    if (found == near.end()) continue;
                    for (const std::uint32_t other : found->second) {
                        joined = are_one_line(lines_[other], lines_[k]);
                        if (joined) sets.join(other, k);
                        if (joined) break;
                    }
                }
            auto& here = near[cell];
            if (!joined && here.size() < few) here.push_back(k);
        }
        line_of_ = sets.flattened();
    }

    // (3)
    void write(MergedBlock& out) {
        std::vector<std::vector<std::uint32_t>> groups(lines_.size());
        for (std::uint32_t k = 0; k < lines_.size(); ++k) groups[line_of_[k]].push_back(k);
        is_written_.assign(points_.size(), false);
        for (const auto& group : groups)
            if (!group.empty()) write_line(group, out);
        for (std::uint32_t p = 0; p < points_.size(); ++p)
            if (!is_written_[p]) out.pieces.push_back(piece({p, p}, {face_}));
    }

    void write_line(const std::vector<std::uint32_t>& group, MergedBlock& out) {
        on_line_.clear();
        for (const std::uint32_t k : group)
            on_line_.insert(on_line_.end(),
                            segments_.begin() + static_cast<std::ptrdiff_t>(lines_[k].first),
                            segments_.begin() + static_cast<std::ptrdiff_t>(lines_[k].last));
        // An edge names crossings by polynomials of lower degree than a plane does.
        const SupportLine support =
            std::min_element(on_line_.begin(), on_line_.end(), [](const auto& a, const auto& b) {
                return std::tuple{a.support.is_plane(), a.support.other, a.support.edge} <
                       std::tuple{b.support.is_plane(), b.support.other, b.support.edge};
            })->support;
        std::sort(on_line_.begin(), on_line_.end(),
                  [](const auto& a, const auto& b) { return a.ends < b.ends; });
        for (std::size_t first = 0, last = 0; first < on_line_.size(); first = last) {
            auto [low, high] = on_line_[first].ends;
            while (last < on_line_.size() && on_line_[last].ends[0] <= high)
                high = std::max(high, on_line_[last++].ends[1]);
            write_union({low, high}, support, std::span(on_line_).subspan(first, last - first),
                        out);
        }
    }

    void write_union(std::array<std::uint32_t, 2> ends, SupportLine support,
                     std::span<const RankedSegment> parts, MergedBlock& out) {
        const auto index = static_cast<std::uint32_t>(out.pieces.size());
        out.pieces.push_back(piece(ends, support));
        inside_.clear();
        for (const RankedSegment& s : parts)
            for (const std::uint32_t p : s.ends) {
                is_written_[p] = true;
                if (p != ends[0] && p != ends[1]) inside_.push_back(p);
            }
        sort_unique(inside_);
        for (const std::uint32_t p : inside_)
            out.touching.push_back({face_, {index, index}, points_[p].point});
    }

    [[nodiscard]] FaceConstraint piece(std::array<std::uint32_t, 2> ends,
                                       SupportLine support) const {
        const PlacedPoint &a = points_[ends[0]], &b = points_[ends[1]];
        return {face_, support, {a.place, b.place}, {a.point, b.point}};
    }

    [[no_unique_address]] UpwardWitness upward_;
    const TriangleSoup& soup_;
    const Contacts& contacts_;
    std::uint32_t face_ = 0;
    Axis axis_ = Axis::z;
    std::vector<PlacedPoint> points_; ///< by rank
    std::vector<RankedSegment> segments_;
    std::vector<NamedLine> lines_;
    std::vector<std::uint32_t> line_of_; ///< per line: the one that it equals
    std::vector<RankedSegment> on_line_;
    std::vector<std::uint32_t> inside_;
    std::vector<bool> is_written_; ///< per point: whether it is on a merged segment
};

} // namespace

namespace {

/// The pieces [first, last) of a face in no pool, or a pool, whose pieces are elsewhere.
struct MergeJob {
    std::uint32_t face, first, last;
    std::uint32_t pool;
    std::uint32_t block; ///< index of its result, or no_group if it is kept as it is
};

/// Lists the faces with pieces and the pools in the order of faces. `range_of` becomes per face in
/// a pool the range of its pieces. Returns no job if there is nothing to merge.
std::vector<MergeJob> merge_jobs(const TriangleSoup& soup, const Contacts& contacts,
                                 std::vector<std::array<std::uint32_t, 2>>& range_of) {
    const PlanePools& pools = contacts.pools;
    const bool has_pools = !pools.of.empty();
    if (has_pools) range_of.assign(soup.triangles.size(), {0, 0});
    const auto count = static_cast<std::uint32_t>(contacts.pieces.size());
    std::vector<MergeJob> jobs;
    std::uint32_t blocks = 0;
    for (std::uint32_t first = 0, last = 0; first < count; first = last) {
        const std::uint32_t face = contacts.pieces[first].face;
        while (last < count && contacts.pieces[last].face == face) ++last;
        const bool is_busy = last - first > many_segments;
        if (has_pools && pools.of[face] != no_group)
            range_of[face] = {first, last};
        else
            jobs.push_back({face, first, last, no_group, is_busy ? blocks++ : no_group});
    }
    for (std::uint32_t k = 0; k < pools.faces.size(); ++k)
        jobs.push_back({pools.faces[k].front(), 0, 0, k, blocks++});
    if (blocks == 0) return {};
    std::sort(jobs.begin(), jobs.end(),
              [](const MergeJob& a, const MergeJob& b) { return a.face < b.face; });
    return jobs;
}

/// Takes the merged pieces, and those of jobs that were not merged.
void take_merged(std::span<const MergeJob> jobs, std::span<const MergedBlock> blocks,
                 Contacts& contacts) {
    std::vector<FaceConstraint> merged;
    const auto pieces = std::span(std::as_const(contacts.pieces));
    for (const MergeJob& job : jobs) {
        const auto start = static_cast<std::uint32_t>(merged.size());
        if (job.block == no_group || !blocks[job.block].is_merged) {
            const auto kept = pieces.subspan(job.first, job.last - job.first);
            merged.insert(merged.end(), kept.begin(), kept.end());
            continue;
        }
        const MergedBlock& block = blocks[job.block];
        merged.insert(merged.end(), block.pieces.begin(), block.pieces.end());
        for (FaceCrossing c : block.touching) {
            for (std::uint32_t& piece : c.pieces) piece += start;
            contacts.crossings.push_back(c);
        }
    }
    contacts.pieces = std::move(merged);
}

} // namespace

void merge_segments(const TriangleSoup& soup, Contacts& contacts, const Run& run) {
    std::vector<std::array<std::uint32_t, 2>> range_of;
    const auto jobs = merge_jobs(soup, contacts, range_of);
    std::vector<MergeJob> busy;
    for (const MergeJob& job : jobs)
        if (job.block != no_group) busy.push_back(job);
    if (busy.empty()) return;
    const auto pieces = std::span(std::as_const(contacts.pieces));
    auto results = for_blocks<MergedBlock>(
        busy.size(), 1, run, [&](UpwardWitness upward, std::size_t j, std::size_t) {
            MergedBlock block;
            const MergeJob& job = busy[j];
            SegmentMerger merger(upward, soup, contacts);
            if (job.pool == no_group) {
                block.is_merged =
                    merger.merge_face(pieces.subspan(job.first, job.last - job.first), block);
                return block;
            }
            std::vector<std::span<const FaceConstraint>> of_faces;
            for (const std::uint32_t f : contacts.pools.faces[job.pool])
                of_faces.push_back(pieces.subspan(range_of[f][0], range_of[f][1] - range_of[f][0]));
            merger.merge_pool(contacts.pools.faces[job.pool], of_faces, block);
            block.is_merged = true;
            return block;
        });
    std::vector<MergedBlock> blocks(busy.size()); // by number of block
    bool any = false;
    for (std::size_t j = 0; j < busy.size(); ++j) {
        any |= results[j].is_merged;
        blocks[busy[j].block] = std::move(results[j]);
    }
    if (any) take_merged(jobs, blocks, contacts);
}

} // namespace terrane
