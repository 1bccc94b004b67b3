// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds where the segments inside one triangle cross: points of three planes (or of lines).
#include <algorithm>
#include <numeric>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/intersection/contacts.hpp>
#include <terrane/algorithms/intersection/detail/construction_table.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

using namespace intersection::detail;

namespace {

using Line = std::array<std::uint32_t, 2>;

struct NewCrossing {
    std::uint32_t face;
    std::array<std::uint32_t, 2> pieces;
    Construction how;
};

struct CrossingBlock {
    std::vector<NewCrossing> crossings;
    PredicateCounts predicates;
};

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

/// An inner segment with the data that the tests need.
struct InnerSegment {
    std::uint32_t piece;
    Triangle plane; ///< the supporting triangle, sorted
    Line line{};    ///< the supporting edge, sorted, if is_line
    bool is_line = false;
    std::array<ApproximatePoint, 2> ends{}; ///< in the projection
    std::array<double, 2> low, high;        ///< box of the nearest doubles in the projection; if
                                            ///< two boxes are disjoint, so are the segments
};

/// Whether the point lies on the supporting plane or line by its construction.
bool is_on_by_name(const Construction& how, const InnerSegment& s) {
    const auto in_plane = [&](std::uint32_t v) {
        return std::find(s.plane.begin(), s.plane.end(), v) != s.plane.end();
    };
    const auto carries = [&](std::uint32_t a, std::uint32_t b) {
        return s.is_line ? Line{a, b} == s.line : in_plane(a) && in_plane(b);
    };
    switch (how.kind) {
    case Construction::Kind::input:
        return s.is_line ? how.v[0] == s.line[0] || how.v[0] == s.line[1] : in_plane(how.v[0]);
    case Construction::Kind::line_line:
        return carries(how.v[0], how.v[1]) || carries(how.v[2], how.v[3]);
    case Construction::Kind::line_plane:
        return carries(how.v[0], how.v[1]) ||
               (!s.is_line && Triangle{how.v[2], how.v[3], how.v[4]} == s.plane);
    default:
        return !s.is_line && (Triangle{how.v[0], how.v[1], how.v[2]} == s.plane ||
                              Triangle{how.v[3], how.v[4], how.v[5]} == s.plane ||
                              Triangle{how.v[6], how.v[7], how.v[8]} == s.plane);
    }
}

bool have_common_end(const FaceConstraint& a, const FaceConstraint& b) {
    return a.ends[0] == b.ends[0] || a.ends[0] == b.ends[1] || a.ends[1] == b.ends[0] ||
           a.ends[1] == b.ends[1];
}

/// Finds all crossings in a face by a sweep along an axis of its projection.
class FaceSweep {
public:
    FaceSweep(UpwardWitness upward, const TriangleSoup& soup, const Contacts& contacts,
              const Run& run, std::vector<NewCrossing>& out) :
        upward_(upward),
        soup_(soup), contacts_(contacts), run_(run), out_(out) {}

    /// Tests pieces [first, last), which are those of one face.
    void operator()(std::uint32_t first, std::uint32_t last) {
        collect(first, last);
        if (segments_.size() < 2) return;
        std::sort(segments_.begin(), segments_.end(), [](const auto& a, const auto& b) {
            return std::pair{a.low[0], a.piece} < std::pair{b.low[0], b.piece};
        });
        if (segments_.size() >= many && extent(1) < extent(0)) return sweep_along_second_axis();
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            if (is_stopped(i)) return;
            for (std::size_t j = i + 1;
                 j < segments_.size() && segments_[j].low[0] <= segments_[i].high[0]; ++j)
                test(segments_[i], segments_[j]);
        }
    }

private:
    static constexpr std::size_t many = 64; ///< segments, for which the axis is chosen

    /// A pool has very many segments.
    bool is_stopped(std::size_t i) const { return i % 64 == 63 && run_.stop.stop_requested(); }

    /// Returns the sum of the extents of the segments along an axis, as a multiple of that of them all.
    double extent(unsigned axis) const {
        double low = segments_[0].low[axis], high = segments_[0].high[axis], sum = 0;
        for (const InnerSegment& s : segments_) {
            low = std::min(low, s.low[axis]);
            high = std::max(high, s.high[axis]);
            sum += s.high[axis] - s.low[axis];
        }
        return high > low ? sum / (high - low) : static_cast<double>(segments_.size());
    }

    /// Tests the same pairs in the same order, but finds them faster where most segments run along the
    /// first axis, as those of horizons in a wall.
    void sweep_along_second_axis() {
        std::vector<std::uint32_t> order(segments_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::sort(order, {}, [&](std::uint32_t s) { return segments_[s].low[1]; });
        std::vector<std::array<std::uint32_t, 2>> pairs;
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (is_stopped(i)) return;
            const InnerSegment& a = segments_[order[i]];
            for (std::size_t j = i + 1; j < order.size() && segments_[order[j]].low[1] <= a.high[1];
                 ++j) {
                const auto [first, second] = std::minmax(order[i], order[j]);
                if (segments_[second].low[0] <= segments_[first].high[0])
                    pairs.push_back({first, second});
            }
        }
        std::ranges::sort(pairs);
        for (std::size_t k = 0; k < pairs.size() && !is_stopped(k); ++k)
            test(segments_[pairs[k][0]], segments_[pairs[k][1]]);
    }

    const FaceConstraint& piece(const InnerSegment& s) const { return contacts_.pieces[s.piece]; }

    void collect(std::uint32_t first, std::uint32_t last) {
        segments_.clear();
        face_ = contacts_.pieces[first].face;
        for (std::uint32_t p = first; p < last; ++p)
            if (contacts_.pieces[p].is_inner_segment()) segments_.push_back(describe(p));
        if (segments_.size() < 2) return;
        const Triangle& t = soup_.triangles[face_];
        axis_ = projection_axis(soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]]);
        for (InnerSegment& s : segments_) set_box(s);
    }

    InnerSegment describe(std::uint32_t p) const {
        const SupportLine& support = contacts_.pieces[p].support;
        const Triangle& t = soup_.triangles[support.other];
        InnerSegment s{};
        s.piece = p;
        s.plane = sorted(t);
        s.is_line = !support.is_plane();
        if (s.is_line) {
            s.line = {t[support.edge], t[(support.edge + 1) % 3]};
            std::sort(s.line.begin(), s.line.end());
        }
        return s;
    }

    void set_box(InnerSegment& s) const {
        for (unsigned i = 0; i < 2; ++i)
            s.ends[i] = contacts_.points.approximate(axis_, piece(s).ends[i]);
        const auto [a, b] = s.ends;
        s.low = {std::min(a.u, b.u), std::min(a.v, b.v)};
        s.high = {std::max(a.u, b.u), std::max(a.v, b.v)};
    }

    Sign side(const InnerSegment& s, PointIndex p) const {
        const PointStore& store = contacts_.points;
        if (is_on_by_name(store.construction(p), s)) return Sign::Zero;
        if (s.is_line) return store.orient2d(upward_, axis_, s.line[0], s.line[1], p);
        return store.side_of_plane(upward_, s.plane[0], s.plane[1], s.plane[2], p);
    }

    /// Whether the ends of the other segment lie strictly on both sides of the line of s.
    bool separates(const InnerSegment& s, const InnerSegment& of) const {
        const auto quick_a = filtered_orient2d(s.ends[0], s.ends[1], of.ends[0]);
        const auto quick_b = filtered_orient2d(s.ends[0], s.ends[1], of.ends[1]);
        if (quick_a && quick_b) return *quick_a != *quick_b;
        const Sign a = side(s, piece(of).ends[0]);
        return a != Sign::Zero && side(s, piece(of).ends[1]) == -a;
    }

    void test(const InnerSegment& a, const InnerSegment& b) {
        if (a.high[1] < b.low[1] || b.high[1] < a.low[1]) return;
        // Segments with a common end cross nowhere else. Most are successive segments of a curve,
        // which are nearly collinear.
        if (have_common_end(piece(a), piece(b))) return;
        if (!separates(a, b) || !separates(b, a)) return;
        out_.push_back(
            {face_, {std::min(a.piece, b.piece), std::max(a.piece, b.piece)}, crossing(a, b)});
    }

    Construction crossing(const InnerSegment& a, const InnerSegment& b) const {
        if (a.is_line && b.is_line) return line_line(soup_.points, a.line, b.line);
        if (a.is_line) return line_plane(a.line, b.plane);
        if (b.is_line) return line_plane(b.line, a.plane);
        return three_planes(soup_.triangles[face_], a.plane, b.plane);
    }

    [[no_unique_address]] UpwardWitness upward_;
    const TriangleSoup& soup_;
    const Contacts& contacts_;
    const Run& run_;
    std::vector<NewCrossing>& out_;
    std::vector<InnerSegment> segments_;
    std::uint32_t face_ = 0;
    Axis axis_ = Axis::z;
};

} // namespace

void find_crossings(const TriangleSoup& soup, Contacts& contacts, const Run& run) {
    std::vector<std::uint32_t> starts; // per face: its first piece
    for (std::uint32_t p = 0; p < contacts.pieces.size(); ++p)
        if (p == 0 || contacts.pieces[p].face != contacts.pieces[p - 1].face) starts.push_back(p);
    const std::size_t faces = starts.size();
    starts.push_back(static_cast<std::uint32_t>(contacts.pieces.size()));

    const auto blocks = for_blocks<CrossingBlock>(
        faces, 64, run, [&](UpwardWitness upward, std::size_t first, std::size_t last) {
            CrossingBlock block;
            const PredicateCounts before = predicate_counts();
            FaceSweep sweep(upward, soup, contacts, run, block.crossings);
            for (std::size_t f = first; f < last; ++f) sweep(starts[f], starts[f + 1]);
            block.predicates = predicate_counts() - before;
            return block;
        });

    std::size_t count = 0;
    for (const CrossingBlock& block : blocks) {
        contacts.predicates += block.predicates;
        count += block.crossings.size();
    }
    if (count == 0) return; // those of merged segments are in the order of faces
    // Contacts have already constructed some of the crossings (two edges of coplanar triangles).
    ConstructionTable table(static_cast<PointIndex>(soup.points.size()));
    table.reserve(contacts.points.size() - soup.points.size() +
                  count / 3); // most are on three faces
    for (PointIndex p = static_cast<PointIndex>(soup.points.size()); p < contacts.points.size();
         ++p)
        table.enter(contacts.points.construction(p));
    const std::size_t known = table.constructions().size();
    const bool any_merged = !contacts.crossings.empty();
    contacts.crossings.reserve(contacts.crossings.size() + count);
    for (const CrossingBlock& block : blocks)
        for (const NewCrossing& c : block.crossings)
            contacts.crossings.push_back({c.face, c.pieces, table.enter(c.how)});
    if (any_merged)
        std::stable_sort(
            contacts.crossings.begin(), contacts.crossings.end(),
            [](const FaceCrossing& a, const FaceCrossing& b) { return a.face < b.face; });
    contacts.points.append(table.constructions().subspan(known), sharing(run));
}

} // namespace terrane
