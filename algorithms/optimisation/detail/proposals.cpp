// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/optimisation/detail/proposals.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/optimisation/detail/constants.hpp>

namespace terrane::optimisation::detail {

bool make(Cells& cells, Change& change, const Demand& demand) {
    for (Point3& p : change.places) p = cells.representable(p);
    if (change.kind == Change::Kind::move)
        return cells.move(change.vertex, change.places[0], demand);
    const auto first = static_cast<std::uint32_t>(cells.points().size());
    const auto count = static_cast<std::uint32_t>(change.places.size());
    for (const Point3& p : change.places) cells.add_vertex(p);
    for (Corners& corners : change.added)
        for (std::uint32_t& v : corners)
            if (none - v < count) v = first + (none - v);
    if (cells.replace(change.old, change.added, demand)) return true;
    for (std::uint32_t i = 0; i < count; ++i) cells.remove_last_vertex();
    return false;
}

bool grows(const Cells& cells, const Change& change) {
    const auto count = static_cast<std::uint32_t>(change.places.size());
    const auto volume_of = [&](const Corners& c) {
        std::array<Point3, 4> p;
        for (unsigned k = 0; k < 4; ++k)
            p[k] = c[k] == change.vertex ? change.places[0]
                   : none - c[k] < count ? change.places[none - c[k]]
                                         : cells.points()[c[k]];
        return dot(minus(p[1], p[0]), cross(minus(p[2], p[0]), minus(p[3], p[0])));
    };
    double before = 0, after = 0;
    for (const std::uint32_t c : change.old) {
        before = std::max(before, cells.volume_of(cells.corners(c)));
        if (change.kind == Change::Kind::move) after = std::max(after, volume_of(cells.corners(c)));
    }
    for (const Corners& c : change.added) after = std::max(after, volume_of(c));
    return after > before;
}

namespace {

/// Tells whether there are more bad cells after a change.
bool makes_more_bad(const Cells& cells, const Change& change) {
    const auto count = static_cast<std::uint32_t>(change.places.size());
    const auto is_bad = [&](const Corners& c) {
        std::array<Point3, 4> p;
        for (unsigned k = 0; k < 4; ++k)
            p[k] = c[k] == change.vertex ? change.places[0]
                   : none - c[k] < count ? change.places[none - c[k]]
                                         : cells.points()[c[k]];
        return quality_of(p[0], p[1], p[2], p[3], {}).value < constants.bad;
    };
    std::ptrdiff_t more = 0;
    for (const std::uint32_t c : change.old) {
        more -= cells.quality(c) < constants.bad ? 1 : 0;
        if (change.kind == Change::Kind::move && cells.counts(c))
            more += is_bad(cells.corners(c)) ? 1 : 0;
    }
    for (const Corners& c : change.added) more += is_bad(c) ? 1 : 0;
    return more > 0;
}

/// Keeps the best change that is permitted.
class Best {
public:
    Best(const Cells& cells, const Permission& permission) :
        cells_(cells), permission_(permission) {}

    void consider(std::optional<Change> change) {
        if (!change || (best && !(change->quality > best->quality))) return;
        if (change->quality < permission_.least_quality) return;
        const bool is_urgent = cells_.least_quality(change->old) < permission_.urgent;
        if (!is_urgent && makes_more_bad(cells_, *change)) return;
        if (permission_.may_grow || !grows(cells_, *change)) best = std::move(change);
    }

    std::optional<Change> best;

private:
    const Cells& cells_;
    const Permission& permission_;
};

} // namespace

Proposal change_for_vertex(const Cells& cells, std::uint32_t v, const Permission& permission) {
    Best best(cells, permission);
    std::size_t effort = 0;
    best.consider(moved(cells, v, cells.star(v), effort));
    return {std::move(best.best), effort};
}

Proposal loosening_at(const Cells& cells, std::uint32_t c, const Permission& permission) {
    Best best(cells, permission);
    std::size_t effort = 0;
    for (const std::uint32_t v : cells.corners(c))
        if (cells.is_free(v)) best.consider(loosened(cells, v, cells.star(v), effort));
    return {std::move(best.best), effort};
}

Proposal change_for_cell(const Cells& cells, std::uint32_t c, const Permission& permission,
                         Depth depth) {
    Best best(cells, permission);
    std::size_t effort = 0;
    constexpr double gain = constants.least_gain;
    for (unsigned i = 0; i < 4; ++i)
        for (unsigned j = i + 1; j < 4; ++j) {
            best.consider(without_edge(cells, c, i, j, gain, effort));
            best.consider(with_fewer_faces(cells, c, i, j, gain, effort));
        }
    for (unsigned k = 0; k < 4; ++k) best.consider(without_face(cells, c, k, gain, effort));
    const Corners& corners = cells.corners(c);
    std::array<std::vector<std::uint32_t>, 4> stars;
    for (unsigned k = 0; k < 4; ++k) {
        if (cells.is_fixed(corners[k])) continue;
        stars[k] = cells.star(corners[k]);
        for (unsigned onto = 0; onto < 4; ++onto)
            if (k != onto)
                best.consider(contracted(cells, corners[k], stars[k], corners[onto], gain, effort));
    }
    if (best.best || depth == Depth::flips) return {std::move(best.best), effort};
    for (unsigned k = 0; k < 4 && !best.best; ++k)
        if (!stars[k].empty()) best.consider(moved(cells, corners[k], stars[k], effort));
    if (best.best || depth == Depth::moves) return {std::move(best.best), effort};
    for (Change& change : insertions(cells, c, gain, effort)) best.consider(std::move(change));
    return {std::move(best.best), effort};
}

} // namespace terrane::optimisation::detail
