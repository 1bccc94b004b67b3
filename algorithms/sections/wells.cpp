// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sections/detail/segments.hpp>
#include <terrane/algorithms/sections/sections.hpp>

namespace terrane {

using sections::number_at;
using sections::PathSegment;
using sections::SegmentContact;
using sections::SegmentSearch;
using sections::Share;

namespace {

using Numbers = std::vector<std::uint32_t>;

Error interrupted() {
    return {ErrorCode::interrupted, "stopped on request", ""};
}

Status check_path(const WellPath& path) {
    const auto refused = [&](std::string sentence) {
        return Error{ErrorCode::bad_option, std::move(sentence), "well " + path.name};
    };
    const auto& [name, points, depths] = path;
    if (!std::ranges::all_of(points, is_finite)) return refused("the points of a path are finite");
    if (std::ranges::adjacent_find(points, std::not_equal_to()) == points.end())
        return refused("a path needs two different points");
    if (depths.empty()) return Done{};
    if (depths.size() != points.size()) return refused("needs a depth for each point, or none");
    for (std::size_t i = 0; i < depths.size(); ++i) {
        if (!std::isfinite(depths[i])) return refused("depths are finite");
        if (i > 0 && (points[i] == points[i - 1]) != (depths[i] == depths[i - 1]))
            return refused(
                "the depth is the same at two neighbours if they are one point, and only "
                "then: point " +
                std::to_string(i + 1));
        if (i > 0 && depths[i] < depths[i - 1])
            return refused("depths ascend, but not at point " + std::to_string(i + 1));
    }
    return Done{};
}

/// Returns a path without repeated points, and with depths.
WellPath completed(const WellPath& path) {
    WellPath made{path.name, {path.points[0]}, {path.depths.empty() ? 0 : path.depths[0]}};
    for (std::size_t i = 1; i < path.points.size(); ++i) {
        if (path.points[i] == path.points[i - 1]) continue;
        made.depths.push_back(path.depths.empty()
                                  ? made.depths.back() +
                                        length(minus(path.points[i], path.points[i - 1]))
                                  : path.depths[i]);
        made.points.push_back(path.points[i]);
    }
    return made;
}

/// Walks along one path.
class Walk {
public:
    Walk(const SegmentSearch& search, const Mesh& mesh, WellPath path) :
        search_(search), mesh_(mesh), path_(std::move(path)) {}

    Result<WellLog> operator()(const Run& run) {
        for (std::size_t i = 0; i + 1 < path_.points.size(); ++i) {
            if (run.stop.stop_requested()) return interrupted();
            add_segment(i);
        }
        if (flaw_) return *flaw_;
        return log();
    }

private:
    /// A place at which something begins or ends.
    struct Stop {
        double depth = 0;
        Point3 point;
        Numbers surfaces{}; ///< on which it lies, sorted
    };
    /// The part of the path between a stop and the next.
    struct Piece {
        Numbers blocks, surfaces; ///< sorted

        friend bool operator==(const Piece&, const Piece&) = default;
    };

    void add_segment(std::size_t i) {
        const PathSegment segment{path_.points[i], path_.points[i + 1]};
        const auto contacts = search_.contacts(segment);
        std::vector<Share> shares{Share{}, Share{Exact(1.0), Exact(1.0)}};
        for (const SegmentContact& c : contacts) {
            shares.push_back(c.from);
            shares.push_back(c.to);
        }
        sort_unique(shares);
        std::vector<std::vector<const SegmentContact*>> at(shares.size()), along(shares.size());
        for (const SegmentContact& c : contacts) {
            const auto number = [&](const Share& share) {
                return static_cast<std::size_t>(
                    std::lower_bound(shares.begin(), shares.end(), share) - shares.begin());
            };
            const std::size_t from = number(c.from), to = number(c.to);
            for (std::size_t k = from; k <= to; ++k) at[k].push_back(&c);
            for (std::size_t k = from; k < to; ++k) along[k].push_back(&c);
        }
        for (std::size_t k = 0; k < shares.size(); ++k) {
            if (k > 0 && !along[k - 1].empty())
                pieces_.push_back(piece_upon(along[k - 1]));
            else if (k > 0)
                pieces_.push_back(
                    {{block_of(segment, {&shares[k - 1], &shares[k]}, at[k - 1], at[k])}, {}});
            if (k > 0 || i == 0) stops_.push_back(stop_at(i, shares[k]));
            add_surfaces(at[k], stops_.back().surfaces);
        }
    }

    [[nodiscard]] Stop stop_at(std::size_t i, const Share& share) const {
        const Point3 &a = path_.points[i], &b = path_.points[i + 1];
        return {
            number_at(share, path_.depths[i], path_.depths[i + 1]),
            {number_at(share, a.x, b.x), number_at(share, a.y, b.y), number_at(share, a.z, b.z)}};
    }

    void add_surfaces(std::span<const SegmentContact* const> contacts, Numbers& surfaces) const {
        for (const SegmentContact* c : contacts) {
            const auto of = mesh_.surfaces_of[c->triangle];
            surfaces.insert(surfaces.end(), of.begin(), of.end());
        }
        sort_unique(surfaces);
    }

    [[nodiscard]] Piece piece_upon(std::span<const SegmentContact* const> contacts) const {
        Piece piece;
        add_surfaces(contacts, piece.surfaces);
        for (const SegmentContact* c : contacts)
            for (const Sign side : {Sign::Positive, Sign::Negative})
                piece.blocks.push_back(search_.block(c->triangle, side));
        sort_unique(piece.blocks);
        return piece;
    }

    /// Returns the block of a part of a segment that lies on no triangle, by a triangle that it crosses at an end, or
    /// by the piece before.
    std::uint32_t block_of(const PathSegment& segment, std::array<const Share*, 2> ends,
                           std::span<const SegmentContact* const> at_first,
                           std::span<const SegmentContact* const> at_second) {
        const auto crossed = [&](std::span<const SegmentContact* const> at,
                                 Sign SegmentContact::*side) -> std::optional<std::uint32_t> {
            if (at.size() != 1 || !at[0]->crosses || at[0]->*side == Sign::Zero)
                return std::nullopt;
            return search_.block(at[0]->triangle, at[0]->*side);
        };
        auto first = crossed(at_first, &SegmentContact::second);
        const auto second = crossed(at_second, &SegmentContact::first);
        if (at_first.empty() && !pieces_.empty()) first = pieces_.back().blocks[0];
        if (first && second && *first != *second && !flaw_)
            flaw_ = Error{ErrorCode::improper_contact,
                          "the mesh is not conforming, or the volumes are not its",
                          "triangle " + std::to_string(at_second[0]->triangle)};
        if (first || second) return first ? *first : *second;
        return search_.block_between(segment, *ends[0], *ends[1]);
    }

    [[nodiscard]] WellLog log() const {
        WellLog made{path_.name, {}, {}};
        std::vector<std::uint32_t> interval_of; // per piece
        for (std::size_t p = 0; p < pieces_.size(); ++p) {
            const Piece& piece = pieces_[p];
            if (p == 0 || piece != pieces_[p - 1])
                made.intervals.push_back(
                    {stops_[p].depth, 0, stops_[p].point, {}, piece.blocks, piece.surfaces});
            made.intervals.back().to = stops_[p + 1].depth;
            made.intervals.back().exit = stops_[p + 1].point;
            interval_of.push_back(static_cast<std::uint32_t>(made.intervals.size() - 1));
        }
        for (std::size_t s = 0; s < stops_.size(); ++s) {
            const bool has_both = s > 0 && s < pieces_.size();
            Numbers kept, met; // surfaces in which the path runs on, and the others
            if (has_both)
                std::ranges::set_intersection(pieces_[s - 1].surfaces, pieces_[s].surfaces,
                                              std::back_inserter(kept));
            std::ranges::set_difference(stops_[s].surfaces, kept, std::back_inserter(met));
            for (const std::uint32_t surface : met)
                made.markers.push_back({stops_[s].depth, stops_[s].point, SurfaceId(surface),
                                        interval_of[s > 0 ? s - 1 : 0],
                                        interval_of[s < pieces_.size() ? s : s - 1]});
        }
        return made;
    }

    const SegmentSearch& search_;
    const Mesh& mesh_;
    WellPath path_;
    std::vector<Stop> stops_;   ///< pieces + 1
    std::vector<Piece> pieces_; ///< >= 1
    std::optional<Error> flaw_;
};

} // namespace

Result<std::vector<WellLog>> log_wells(const Mesh& mesh, const Volumes& volumes,
                                       std::span<const WellPath> paths, const Run& run) {
    return guarded("for the wells", "log_wells", [&]() -> Result<std::vector<WellLog>> {
        if (const auto valid = validate_indices(mesh, run); !valid) return valid.error();
        if (!volumes.of_sides.empty() && volumes.of_sides.size() != mesh.triangles.size())
            return Error{ErrorCode::improper_contact, "the volumes are not those of the mesh", ""};
        for (const WellPath& path : paths)
            if (const auto sound = check_path(path); !sound) return sound.error();
        const StageTimer timer(run, "wells");
        const SegmentSearch search(mesh, volumes);
        std::vector<WellLog> logs(paths.size());
        std::vector<std::optional<Error>> flaws(paths.size());
        for_ranges(
            paths.size(), run,
            [&](std::size_t first, std::size_t last) {
                for (std::size_t w = first; w < last; ++w) {
                    auto log = Walk(search, mesh, completed(paths[w]))(run);
                    if (log)
                        logs[w] = std::move(*log);
                    else
                        flaws[w] = log.error();
                }
            },
            4, 1);
        for (const auto& flaw : flaws)
            if (flaw) return *flaw;
        return logs;
    });
}

} // namespace terrane
