// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>

#include <terrane/algorithms/optimisation/detail/changes.hpp>
#include <terrane/algorithms/optimisation/detail/constants.hpp>
#include <terrane/algorithms/optimisation/detail/position.hpp>

namespace terrane::optimisation::detail {

namespace {

/// A cavity that grows around a point.
class Cavity {
public:
    Cavity(const Cells& cells, std::uint32_t first, const Point3& p) : cells_(cells), p_(p) {
        add(first);
    }

    /// Grows through the worst face, step by step, and goes back to where the worst face was best.
    void grow() {
        double best = worst().quality;
        std::size_t kept = members_.size();
        while (members_.size() < constants.most_in_cavity) {
            const Side side = worst();
            const std::uint32_t next = cells_.through(side.cell, side.k);
            if (next == none || has(next)) break;
            add(next);
            const double quality = worst().quality;
            if (quality <= best) continue;
            best = quality;
            kept = members_.size();
        }
        const std::vector<std::uint32_t> all(members_.begin(),
                                             members_.begin() + static_cast<std::ptrdiff_t>(kept));
        members_.clear();
        sides_.clear();
        for (const std::uint32_t c : all) add(c);
    }

    [[nodiscard]] const std::vector<std::uint32_t>& members() const { return members_; }
    /// Returns how many tetrahedra were measured.
    [[nodiscard]] std::size_t effort() const { return effort_; }
    [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> faces() const {
        std::vector<std::array<std::uint32_t, 3>> all;
        for (const Side& s : sides_) all.push_back(face_opposite(cells_.corners(s.cell), s.k));
        return all;
    }

private:
    /// A face of the cavity's hull.
    struct Side {
        std::uint32_t cell = none;
        unsigned k = 0;
        double quality = 0; ///< of the tetrahedron between it and the point
    };

    [[nodiscard]] bool has(std::uint32_t c) const {
        return std::find(members_.begin(), members_.end(), c) != members_.end();
    }

    [[nodiscard]] const Side& worst() const {
        return *std::min_element(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
            return a.quality < b.quality;
        });
    }

    void add(std::uint32_t c) {
        for (unsigned k = 0; k < 4; ++k) {
            const std::uint32_t next = cells_.through(c, k);
            if (next != none && has(next)) {
                sides_.erase(std::remove_if(sides_.begin(), sides_.end(),
                                            [&](const Side& s) {
                                                return s.cell == next &&
                                                       cells_.through(s.cell, s.k) == c;
                                            }),
                             sides_.end());
                continue;
            }
            const auto f = face_opposite(cells_.corners(c), k);
            const auto& points = cells_.points();
            ++effort_;
            const Quality quality =
                quality_of(points[f[0]], points[f[1]], points[f[2]], p_, cells_.judged_by());
            sides_.push_back({c, k, quality.is_trusted ? quality.value : -1});
        }
        members_.push_back(c);
    }

    const Cells& cells_;
    Point3 p_;
    std::vector<std::uint32_t> members_;
    std::vector<Side> sides_;
    std::size_t effort_ = 0;
};

Point3 mean_of(const Cells& cells, std::uint32_t c) {
    Point3 mean;
    for (const std::uint32_t v : cells.corners(c)) {
        const Point3& p = cells.points()[v];
        mean = {mean.x + p.x / 4, mean.y + p.y / 4, mean.z + p.z / 4};
    }
    return mean;
}

FacesAround faces_of(const Cells& cells, const std::vector<std::array<std::uint32_t, 3>>& all) {
    FacesAround faces(cells.judged_by());
    for (const auto& [a, b, c] : all)
        faces.add(cells.points()[a], cells.points()[b], cells.points()[c]);
    return faces;
}

/// Inserts a vertex that starts at p.
std::optional<Change> inserted_at(const Cells& cells, std::uint32_t c, const Point3& p, double gain,
                                  std::size_t& effort) {
    Cavity cavity(cells, c, p);
    cavity.grow();
    const auto hull = cavity.faces();
    FacesAround faces = faces_of(cells, hull);
    const Position best = best_position(faces, p);
    effort += cavity.effort() + faces.effort();
    if (!(best.quality > cells.enough_for(cavity.members(), gain))) return std::nullopt;
    std::size_t bad_before = 0;
    for (const std::uint32_t old : cavity.members())
        bad_before += cells.quality(old) < constants.bad ? 1 : 0;
    if (gain > 0 && faces.count_below(best.at, constants.bad) > bad_before) return std::nullopt;
    Change change{Change::Kind::insertion, cavity.members(), {}, none, {best.at}, best.quality};
    for (const auto& f : hull) change.added.push_back({f[0], f[1], f[2], none});
    return change;
}

/// The faces around a vertex, opposite to it in the cells of its star.
FacesAround faces_around(const Cells& cells, std::uint32_t v,
                         const std::vector<std::uint32_t>& star) {
    FacesAround faces(cells.judged_by());
    for (const std::uint32_t c : star) {
        const Corners& corners = cells.corners(c);
        const auto at = std::find(corners.begin(), corners.end(), v) - corners.begin();
        const auto [a, b, d] = face_opposite(corners, static_cast<unsigned>(at));
        faces.add(cells.points()[a], cells.points()[b], cells.points()[d], cells.counts(c));
    }
    return faces;
}

/// The change that moves a vertex, if it is a gain.
std::optional<Change> moved_to(const Cells& cells, std::uint32_t v,
                               const std::vector<std::uint32_t>& star, const Position& best,
                               const FacesAround& faces, std::size_t& effort) {
    effort += faces.effort();
    if (!(best.quality > cells.enough_for(star, constants.least_gain))) return std::nullopt;
    return Change{Change::Kind::move, star, {}, v, {best.at}, best.quality};
}

} // namespace

std::optional<Change> moved(const Cells& cells, std::uint32_t v,
                            const std::vector<std::uint32_t>& star, std::size_t& effort) {
    FacesAround faces = faces_around(cells, v, star);
    const Position best = best_position(faces, cells.points()[v]);
    return moved_to(cells, v, star, best, faces, effort);
}

std::optional<Change> loosened(const Cells& cells, std::uint32_t v,
                               const std::vector<std::uint32_t>& star, std::size_t& effort) {
    if (!cells.is_free(v)) return std::nullopt;
    FacesAround faces = faces_around(cells, v, star);
    const Measure& measure = cells.judged_by();
    const double enough = measure.least < HUGE_VAL
                              ? quality_of_mean_ratio(constants.ratio_enough, measure)
                              : constants.loose_enough;
    const Position best = near_position(faces, cells.points()[v], enough,
                                        [&](const Point3& p) { return cells.free_place(v, p); });
    return moved_to(cells, v, star, best, faces, effort);
}

std::vector<Change> insertions(const Cells& cells, std::uint32_t c, double gain,
                               std::size_t& effort) {
    std::vector<Change> all;
    const auto from = [&](const Point3& p) {
        if (auto change = inserted_at(cells, c, p, gain, effort)) all.push_back(std::move(*change));
    };
    const Point3 own = mean_of(cells, c);
    from(own);
    for (unsigned k = 0; k < 4; ++k) {
        const std::uint32_t next = cells.through(c, k);
        if (next == none) continue;
        const Point3 other = mean_of(cells, next);
        from({(own.x + other.x) / 2, (own.y + other.y) / 2, (own.z + other.z) / 2});
    }
    return all;
}

} // namespace terrane::optimisation::detail
