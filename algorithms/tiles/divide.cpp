// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Divides the faces that a tile owns and that meet others improperly, by the retriangulation of
// arrange(). All faces that meet an own face are here, so its contacts and their crossings are known.
// Of the others, which another tile owns, some contacts are missing: their parts are dropped.
#include <algorithm>
#include <cmath>

#include <terrane/algorithms/arrangement/retriangulation.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/intersection/pencils.hpp>
#include <terrane/algorithms/intersection/renamed_construction.hpp>
#include <terrane/algorithms/tiles/detail/hashes.hpp>
#include <terrane/algorithms/tiles/detail/soup_of_faces.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>
#include <terrane/kernel/fraction.hpp>

namespace terrane::tiles::detail {

namespace {

/// The faces of a list of pairs, each once, by number.
std::vector<Face> faces_of_pairs(const std::vector<MeetingFaces>& pairs) {
    std::vector<Face> faces;
    faces.reserve(2 * pairs.size());
    for (const MeetingFaces& p : pairs) {
        faces.push_back(p.first);
        faces.push_back(p.second);
    }
    const auto lower = [](const Face& f, const Face& g) { return f.id < g.id; };
    std::sort(faces.begin(), faces.end(), lower);
    const auto same = [](const Face& f, const Face& g) { return f.id == g.id; };
    faces.erase(std::unique(faces.begin(), faces.end(), same), faces.end());
    return faces;
}

/// Returns an upper bound of a distance with these coordinates.
double length_of(const std::array<double, 3>& errors) {
    return std::hypot(errors[0], errors[1], errors[2]) * (1 + 0x1p-50);
}

/// Takes the parts of own faces over, and the points that they have.
class PartCollector {
public:
    PartCollector(Tile& b, const SoupOfFaces& soup, const Retriangulation& division,
                  const std::vector<bool>& is_own) :
        b_(b),
        soup_(soup), division_(division), is_own_(is_own),
        number_of_(division.points.size(), unknown) {}

    void operator()() {
        std::vector<std::uint32_t> own;
        for (std::size_t t = 0; t < division_.triangles.size(); ++t) {
            own.clear();
            for (const std::uint32_t f : division_.faces_of[t])
                if (is_own_[f]) own.push_back(soup_.ids[f]);
            if (own.empty()) continue;
            Part part{soup_.ids[division_.faces_of[t][0]], {}};
            for (unsigned i = 0; i < 3; ++i) part.corners[i] = name(division_.triangles[t][i]);
            b_.parts.push_back(part);
            b_.own_faces_of.push_back(own);
        }
    }

private:
    static constexpr std::uint32_t unknown = UINT32_MAX;

    /// Returns the name of a point, and takes a constructed one over.
    std::uint32_t name(PointIndex p) {
        const PointStore& store = division_.points;
        if (store.is_input(p)) return soup_.names[p];
        if (number_of_[p] == unknown) {
            number_of_[p] = static_cast<std::uint32_t>(b_.points.size());
            OwnPoint point;
            point.nearest = store.nearest(p);
            const auto errors = store.rounding_errors(p);
            point.bound = length_of(errors);
            if (b_.is_in_frame) b_.point_errors.push_back(errors);
            if (b_.wants_digest) point.hash = hash_of_coordinates(fractions(store, p, 16));
            b_.points.push_back(point);
            b_.constructions.push_back(renamed(store.construction(p), soup_.names));
        }
        return b_.vertex_total() + number_of_[p];
    }

    Tile& b_;
    const SoupOfFaces& soup_;
    const Retriangulation& division_;
    const std::vector<bool>& is_own_;
    std::vector<std::uint32_t> number_of_; ///< per point of the division
};

} // namespace

/// Channel 0: x of some of the constructed points, to the first tile.
Status divide_own_faces(Tile& b, Inbox& in, Outbox& out, const Run& run) {
    in.take<std::uint32_t>(1, [&](std::uint32_t, std::uint32_t repeated) {
        b.home_count[repeated - home_start(b, b.triangle_total())] = 0;
    });
    const auto pairs = in.all<MeetingFaces>(0);
    b.geometry = faces_of_pairs(pairs);
    const SoupOfFaces soup = soup_of(b.geometry);
    std::vector<bool> is_own;
    for (const Face& f : b.geometry) {
        is_own.push_back(owner_of_face(b, f) == b.index);
        if (is_own.back()) b.touched.push_back(f.id);
    }
    std::vector<CandidatePair> candidates;
    for (const MeetingFaces& p : pairs) {
        const std::uint32_t f = soup.face_with(p.first.id), g = soup.face_with(p.second.id);
        candidates.push_back({f, g});
        if (p.overlap == 0) continue;
        if (is_own[f]) b.overlapped.push_back(p.first.id);
        if (is_own[g]) b.overlapped.push_back(p.second.id);
    }
    sort_unique(b.overlapped);
    sort_unique(candidates);
    const Retriangulation division =
        retriangulate(soup.points, soup.triangles, candidates, {}, run);
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    PartCollector(b, soup, division, is_own)();
    b.work.divided = b.touched.size();
    b.work.constructed = b.points.size();
    const PredicateCounts& used = division.statistics.predicates;
    b.work.predicates += used.static_filter + used.interval + used.exact;
    constexpr std::size_t most_samples = 256;
    const std::size_t stride = b.points.size() / most_samples + 1;
    for (std::size_t p = 0; p < b.points.size(); p += stride) out.put(0, 0, b.points[p].nearest.x);
    return Done{};
}

} // namespace terrane::tiles::detail
