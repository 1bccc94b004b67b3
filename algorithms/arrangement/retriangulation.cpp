// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/retriangulation.hpp>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <tuple>
#include <utility>

#include <terrane/algorithms/arrangement/detail/pool_covers.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/triangle_table.hpp>
#include <terrane/algorithms/triangulation/triangulation.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

using namespace arrangement::detail;

namespace {

constexpr std::uint32_t no_cover = UINT32_MAX;

/// A part of a divided triangle.
struct Part {
    std::uint32_t face;
    std::array<PointIndex, 3> corners;
    std::uint32_t cover = no_cover; ///< of a part of a pool: the list of triangles that contain it;
                                    ///< face is the first of them
};

/// Parts by face.
struct PartBlock {
    std::vector<Part> parts;
    IndexLists<std::uint32_t> covers;
    PredicateCounts predicates;
};

/// Performs step (e): collects the points and segments of each face and triangulates it.
class Divider {
public:
    Divider(UpwardWitness upward, const TriangleSoup& soup, const Contacts& contacts,
            const PointOrder& order, const Run& run) :
        upward_(upward),
        soup_(soup), contacts_(contacts), order_(order), run_(run), triangulate_(upward) {}

    /// Divides one face or pool, given its pieces and crossings.
    void operator()(std::span<const FaceConstraint> pieces, std::uint32_t first_piece,
                    std::span<const FaceCrossing> crossings, PartBlock& out) {
        face_.clear();
        const std::uint32_t f = pieces.front().face;
        const Triangle& t = soup_.triangles[f];
        face_.corners = t;
        face_.axis = projection_axis(soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]]);
        chains_.assign(pieces.size(), {});
        for (const FaceConstraint& p : pieces)
            for (unsigned e = 0; e < 2; ++e) add_point(p.ends[e], p.place[e]);
        for (const FaceCrossing& c : crossings) {
            const PointIndex p = order_.same_as[c.point];
            face_.inner_points.push_back(p);
            for (const std::uint32_t k : c.pieces) chains_[k - first_piece].push_back(p);
        }
        for (std::size_t k = 0; k < pieces.size(); ++k)
            if (pieces[k].is_inner_segment())
                add_chain(pieces[k], static_cast<std::uint32_t>(k), chains_[k]);
        finish_points();
        const std::uint32_t pool = contacts_.pools.led_by(f);
        if (pool != no_group) return divide_pool(contacts_.pools.faces[pool], out);
        triangulate_.divide(contacts_.points, order_.rank, face_);
        for (const auto& part : triangulate_.in_order()) out.parts.push_back({f, part});
    }

private:
    void divide_pool(std::span<const std::uint32_t> faces, PartBlock& out) {
        const Frame frame = frame_round(contacts_.points, face_.axis, face_.inner_points);
        face_.frame = &frame;
        face_.stop = run_.stop;
        for (unsigned i = 0; i < 3; ++i) face_.corners[i] = Frame::corner(i);
        triangulate_.divide(contacts_.points, order_.rank, face_);
        if (run_.stop.stop_requested()) return;
        const PoolDivision division =
            covers_of_pool(upward_, soup_, faces, contacts_.points, order_, face_, triangulate_);
        const auto first = static_cast<std::uint32_t>(out.covers.size());
        out.covers.append(division.covers);
        for (const PoolPart& part : division.parts)
            out.parts.push_back({part.face, part.corners, first + part.cover});
        face_.stop = {};
    }

    bool by_rank(PointIndex a, PointIndex b) const { return order_.rank[a] < order_.rank[b]; }

    void add_point(PointIndex point, Simplex place) {
        const PointIndex p = order_.same_as[point];
        if (is_edge(place)) face_.edge_points[edge_of(place)].push_back(p);
        if (place == Simplex::face) face_.inner_points.push_back(p);
    }

    void sort_unique(std::vector<PointIndex>& points) const {
        std::sort(points.begin(), points.end(),
                  [&](PointIndex a, PointIndex b) { return by_rank(a, b); });
        points.erase(std::unique(points.begin(), points.end()), points.end());
    }

    void add_chain(const FaceConstraint& piece, std::uint32_t line,
                   std::vector<PointIndex>& chain) {
        for (const PointIndex e : piece.ends) chain.push_back(order_.same_as[e]);
        sort_unique(chain);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            face_.segments.push_back({chain[i], chain[i + 1]});
            face_.segment_lines.push_back(line);
        }
    }

    // Sorts the points. The lexicographic order of points on an edge is their order along it,
    // forwards or backwards.
    void finish_points() {
        for (unsigned e = 0; e < 3; ++e) {
            sort_unique(face_.edge_points[e]);
            if (by_rank(face_.corners[(e + 1) % 3], face_.corners[e]))
                std::reverse(face_.edge_points[e].begin(), face_.edge_points[e].end());
        }
        sort_unique(face_.inner_points);
    }

    [[no_unique_address]] UpwardWitness upward_;
    const TriangleSoup& soup_;
    const Contacts& contacts_;
    const PointOrder& order_;
    const Run& run_;
    FaceInput face_;
    std::vector<std::vector<PointIndex>> chains_;
    FaceTriangulation triangulate_;
};

/// The pieces and crossings of one face.
struct FaceRange {
    std::uint32_t piece, piece_end, crossing, crossing_end;
};

std::vector<FaceRange> faces_with_contacts(const Contacts& contacts) {
    std::vector<FaceRange> faces;
    const auto count = [](const auto& v) { return static_cast<std::uint32_t>(v.size()); };
    for (std::uint32_t p = 0, c = 0; p < count(contacts.pieces);) {
        FaceRange r{p, p, c, c};
        const std::uint32_t f = contacts.pieces[p].face;
        while (r.piece_end < count(contacts.pieces) && contacts.pieces[r.piece_end].face == f)
            ++r.piece_end;
        while (r.crossing_end < count(contacts.crossings) &&
               contacts.crossings[r.crossing_end].face == f)
            ++r.crossing_end;
        faces.push_back(r);
        p = r.piece_end;
        c = r.crossing_end;
    }
    return faces;
}

/// Starts each part of a pool with its lowest corner, except a triangle that is undivided, and sorts
/// all parts by face and corners, as FaceTriangulation::in_order does.
void put_pooled_in_order(const TriangleSoup& soup, const PointOrder& order,
                         std::vector<Part>& parts) {
    const auto rank = [&](PointIndex p) { return order.rank[p]; };
    for (Part& p : parts) {
        const Triangle& whole = soup.triangles[p.face];
        if (std::is_permutation(whole.begin(), whole.end(), p.corners.begin())) continue;
        std::rotate(p.corners.begin(), std::ranges::min_element(p.corners, {}, rank),
                    p.corners.end());
    }
    const auto key = [&](const Part& p) {
        return std::tuple(p.face, rank(p.corners[0]), rank(p.corners[1]), rank(p.corners[2]));
    };
    std::ranges::sort(parts, {}, key);
}

PartBlock divide_faces(const TriangleSoup& soup, const Contacts& contacts, const PointOrder& order,
                       const Run& run, RetriangulationStatistics& statistics) {
    const std::vector<FaceRange> faces = faces_with_contacts(contacts);
    statistics.divided = faces.size();
    for (std::size_t k = 0; k < contacts.pools.faces.size(); ++k)
        statistics.divided += contacts.pools.faces[k].size() - 1;
    const std::span pieces(contacts.pieces);
    const std::span crossings(contacts.crossings);
    const auto divide = [&](UpwardWitness upward, std::span<const FaceRange> some) {
        PartBlock block;
        const PredicateCounts before = predicate_counts();
        Divider retriangulate(upward, soup, contacts, order, run);
        for (const FaceRange& r : some)
            retriangulate(pieces.subspan(r.piece, r.piece_end - r.piece), r.piece,
                          crossings.subspan(r.crossing, r.crossing_end - r.crossing), block);
        block.predicates = predicate_counts() - before;
        return block;
    };
    constexpr std::size_t wave = 16384; // faces between two reports of the progress
    std::vector<PartBlock> blocks;
    for (std::size_t start = 0; start < faces.size(); start += wave) {
        const auto some = std::span(faces).subspan(start, std::min(wave, faces.size() - start));
        auto found = for_blocks<PartBlock>(
            some.size(), 64, run, [&](UpwardWitness upward, std::size_t first, std::size_t last) {
                return divide(upward, some.subspan(first, last - first));
            });
        std::ranges::move(found, std::back_inserter(blocks));
        report_part(run, "triangulate", 0, 1, start + some.size(), faces.size());
    }
    PartBlock all;
    std::size_t count = 0;
    for (const PartBlock& b : blocks) count += b.parts.size();
    all.parts.reserve(count);
    for (const PartBlock& b : blocks) {
        const auto start = all.parts.size();
        const auto first = static_cast<std::uint32_t>(all.covers.size());
        all.parts.insert(all.parts.end(), b.parts.begin(), b.parts.end());
        statistics.predicates += b.predicates;
        if (b.covers.size() == 0) continue;
        all.covers.append(b.covers);
        for (std::size_t k = start; k < all.parts.size(); ++k)
            if (all.parts[k].cover != no_cover) all.parts[k].cover += first;
    }
    // The parts of a pool belong to several faces.
    if (all.covers.size() > 0) put_pooled_in_order(soup, order, all.parts);
    return all;
}

/// Performs step (f): merges undivided triangles and parts into one list of unique triangles.
class Stitcher {
public:
    Stitcher(const TriangleSoup& soup, const Contacts& contacts, const PartBlock& parts,
             const Run& run, Retriangulation& out) :
        soup_(soup),
        contacts_(contacts), parts_(parts.parts), covers_(parts.covers), run_(run), out_(out) {}

    void operator()() {
        collect_repeated();
        out_.unchanged_as.resize(soup_.triangles.size());
        // Parts that may be repeated require one thread.
        const std::size_t count = soup_.triangles.size();
        if (any_overlapped_)
            blocks_.push_back(stitch(0, count));
        else
            blocks_ = parts_of_ranges<Block>(
                count, run_,
                [&](std::size_t first, std::size_t last) { return stitch(first, last); }, 1);
        out_.triangles = std::move(blocks_.front().triangles);
        out_.faces_of = std::move(blocks_.front().faces_of);
        for (std::size_t b = 1; b < blocks_.size(); ++b) append(blocks_[b]);
    }

private:
    /// The triangles of a range of the soup.
    struct Block {
        std::uint32_t start; ///< number of triangles before the range
        std::vector<Triangle> triangles;
        IndexLists<std::uint32_t> faces_of; ///< offsets count from the first triangle of the soup

        [[nodiscard]] std::uint32_t next() const {
            return start + static_cast<std::uint32_t>(triangles.size());
        }
    };

    /// Numbers distinct triangles from 0 in the order of their first occurrence.
    static std::vector<std::uint32_t> numbers_of(std::span<const Triangle> triangles) {
        TriangleTable table(triangles.size());
        std::vector<std::uint32_t> numbers(triangles.size());
        std::uint32_t next = 0;
        for (std::uint32_t k = 0; k < triangles.size(); ++k) {
            const std::uint32_t first = table.enter(triangles, k);
            numbers[k] = first == k ? next++ : numbers[first];
        }
        return numbers;
    }

    static Triangle sorted(Triangle c) {
        std::sort(c.begin(), c.end());
        return c;
    }

    /// Visits all parts in the order of the soup. An undivided triangle is its own part, and it may
    /// be a part of another triangle as well.
    template <class Visit>
    void for_each_part(std::size_t first, std::size_t last, const Visit& visit) const {
        const auto before = [](const Part& p, std::size_t face) { return p.face < face; };
        auto p = std::lower_bound(parts_.begin(), parts_.end(), first, before);
        for (auto f = static_cast<std::uint32_t>(first); f < last; ++f) {
            const bool is_whole = (p == parts_.end() || p->face != f) && !is_pooled(f);
            if (is_whole) visit(Part{f, soup_.triangles[f]});
            for (; p != parts_.end() && p->face == f; ++p) visit(*p);
        }
    }

    /// Whether the parts of this triangle are listed under the first triangles that contain them.
    [[nodiscard]] bool is_pooled(std::uint32_t f) const {
        return !contacts_.pools.of.empty() && contacts_.pools.of[f] != no_group;
    }

    /// Lists the faces of each part that may be repeated. Only triangles with a coplanar overlap can
    /// share a part with another triangle.
    void collect_repeated() {
        any_overlapped_ = std::find(contacts_.overlapped.begin(), contacts_.overlapped.end(),
                                    true) != contacts_.overlapped.end();
        const bool any_in_faces = any_overlapped_;
        any_overlapped_ |= !contacts_.pools.of.empty();
        if (!any_in_faces) return;
        std::vector<Triangle> corners;
        std::vector<std::uint32_t> faces;
        for_each_part(0, soup_.triangles.size(), [&](const Part& p) {
            if (!contacts_.overlapped[p.face]) return;
            corners.push_back(sorted(p.corners));
            faces.push_back(p.face);
        });
        number_of_ = numbers_of(corners);
        const std::uint32_t distinct =
            number_of_.empty() ? 0 : *std::max_element(number_of_.begin(), number_of_.end()) + 1;
        faces_of_ = lists_by_key<std::uint32_t>(distinct, number_of_,
                                                [&](std::size_t k) { return faces[k]; });
    }

    /// Returns the number of triangles that result from the faces before this one, if no part is
    /// repeated.
    std::uint32_t triangles_before(std::size_t face) const {
        if (face == 0) return 0;
        std::size_t count = face;
        for (std::size_t k = 0; k < parts_.size() && parts_[k].face < face; ++k)
            if (k == 0 || parts_[k].face != parts_[k - 1].face) --count;
        const auto before = [](const Part& p, std::size_t f) { return p.face < f; };
        count += static_cast<std::size_t>(
            std::lower_bound(parts_.begin(), parts_.end(), face, before) - parts_.begin());
        return static_cast<std::uint32_t>(count);
    }

    Block stitch(std::size_t first, std::size_t last) {
        Block block{triangles_before(first), {}, {}};
        block.faces_of.offsets.front() = block.start;
        const std::size_t share = first == 0 ? soup_.triangles.size() : last - first;
        const std::size_t expected = share + parts_.size();
        block.triangles.reserve(expected);
        block.faces_of.values.reserve(expected);
        block.faces_of.offsets.reserve(expected + 1);
        if (any_overlapped_) {
            std::fill(out_.unchanged_as.begin() + static_cast<std::ptrdiff_t>(first),
                      out_.unchanged_as.begin() + static_cast<std::ptrdiff_t>(last), none);
            for_each_part(first, last, [&](const Part& part) { add_part(part, block); });
            return block;
        }
        const auto before = [](const Part& p, std::size_t face) { return p.face < face; };
        auto p = std::lower_bound(parts_.begin(), parts_.end(), first, before);
        for (std::size_t f = first; f < last;) {
            const std::size_t divided =
                p == parts_.end() ? last : std::min<std::size_t>(last, p->face);
            add_whole(f, divided, block);
            if (divided == last) break; // its parts, if any, belong to the next range
            out_.unchanged_as[divided] = none;
            for (; p != parts_.end() && p->face == divided; ++p) add_part(*p, block);
            f = divided + 1;
        }
        return block;
    }

    /// Adds the undivided triangles [first, last), none of which is overlapped.
    void add_whole(std::size_t first, std::size_t last, Block& block) {
        const auto whole = soup_.triangles.subspan(first, last - first);
        const std::uint32_t start = block.next();
        block.triangles.insert(block.triangles.end(), whole.begin(), whole.end());
        for (std::size_t f = first; f < last; ++f) {
            out_.unchanged_as[f] = start + static_cast<std::uint32_t>(f - first);
            block.faces_of.values.push_back(static_cast<std::uint32_t>(f));
            block.faces_of.offsets.push_back(out_.unchanged_as[f] + 1); // each has one face
        }
    }

    void add_part(const Part& part, Block& block) {
        const std::span<const std::uint32_t> alone(&part.face, 1);
        const auto faces = contacts_.overlapped[part.face] ? faces_of_[number_of_[next_repeated_++]]
                           : part.cover != no_cover        ? covers_[part.cover]
                                                           : alone;
        if (faces.front() != part.face) return;
        const Triangle& whole = soup_.triangles[part.face];
        const bool is_whole = part.corners[0] == whole[0] && part.corners[1] == whole[1] &&
                              part.corners[2] == whole[2];
        if (faces.size() == 1 && is_whole) out_.unchanged_as[part.face] = block.next();
        block.triangles.push_back(part.corners);
        for (const std::uint32_t f : faces) block.faces_of.values.push_back(f);
        block.faces_of.offsets.push_back(block.start +
                                         static_cast<std::uint32_t>(block.faces_of.values.size()));
    }

    void append(const Block& block) {
        const auto add = [](auto& to, const auto& from, std::ptrdiff_t first) {
            to.insert(to.end(), from.begin() + first, from.end());
        };
        both(
            run_, [&] { add(out_.triangles, block.triangles, 0); },
            [&] {
                add(out_.faces_of.values, block.faces_of.values, 0);
                add(out_.faces_of.offsets, block.faces_of.offsets, 1);
            });
    }

    static constexpr std::uint32_t none = UINT32_MAX;

    const TriangleSoup& soup_;
    const Contacts& contacts_;
    std::span<const Part> parts_;
    const IndexLists<std::uint32_t>& covers_;
    const Run& run_;
    Retriangulation& out_;
    std::vector<Block> blocks_;
    // Parts that may be repeated, in the order of the soup:
    std::vector<std::uint32_t> number_of_; ///< equal for equal parts
    std::size_t next_repeated_ = 0;        ///< the next one to be stitched
    IndexLists<std::uint32_t> faces_of_;   ///< per number: the faces, ascending
    bool any_overlapped_ = false;
};

} // namespace

Retriangulation retriangulate(std::vector<Point3> points, std::span<const Triangle> triangles,
                              std::span<const CandidatePair> candidates, const Pencils& pencils,
                              const Run& run, TestedPairs* tested) {
    StageTimer step(run, "intersect");
    Retriangulation out;
    const TriangleSoup soup{points, triangles}; // moving the vector does not move the points
    constexpr std::string_view stage = "retriangulate";
    Contacts contacts = find_contacts(soup, std::move(points), candidates, pencils,
                                      part_of_stage(run, stage, 0, 0.4), tested);
    if (run.stop.stop_requested()) return out;
    merge_segments(soup, contacts, run);
    if (run.stop.stop_requested()) return out; // the pieces may be unfinished
    find_crossings(soup, contacts, run);
    if (run.stop.stop_requested()) return out;
    PointOrder order = order_points(soup, contacts, run);
    out.statistics.improper_contacts = contacts.improper;
    out.statistics.predicates += contacts.predicates;

    step.next("triangulate");
    const auto parts =
        divide_faces(soup, contacts, order, part_of_stage(run, stage, 0.6, 0.9), out.statistics);
    if (run.stop.stop_requested()) return out;

    step.next("stitch");
    Stitcher(soup, contacts, parts, run, out)();
    out.points = std::move(contacts.points);
    out.ascending = std::move(order.ascending);
    out.near = std::move(contacts.near);
    out.pools = std::move(contacts.pools.of);
    return out;
}

} // namespace terrane
