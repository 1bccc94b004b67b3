// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/optimisation/detail/remeshing.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <terrane/algorithms/optimisation/detail/constants.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

namespace terrane::optimisation::detail {

namespace {

/// Some cells of a mesh as a mesh of their own, whose border stays.
struct Part {
    std::vector<std::uint32_t> cells;    ///< their numbers in the mesh
    std::vector<std::uint32_t> vertices; ///< likewise, sorted
    TetrahedralMesh mesh;
};

/// Collects cells around one, by faces that are no walls. No wall is between two of them.
std::vector<std::uint32_t> cells_around(const Cells& cells, std::uint32_t c) {
    std::vector<std::uint32_t> found{c};
    const auto has = [&](std::uint32_t other) {
        return std::find(found.begin(), found.end(), other) != found.end();
    };
    const auto is_walled = [&](std::uint32_t other) {
        for (unsigned k = 0; k < 4; ++k)
            if (cells.is_wall(other, k) && cells.beside(other, k) != none &&
                has(cells.beside(other, k)))
                return true;
        return false;
    };
    for (std::size_t i = 0; i < found.size(); ++i)
        for (unsigned k = 0; k < 4; ++k) {
            const std::uint32_t next = cells.through(found[i], k);
            if (next == none || has(next) || is_walled(next)) continue;
            if (found.size() == constants.most_in_remeshing) return found;
            found.push_back(next);
        }
    return found;
}

Part part_around(const Cells& cells, std::uint32_t c) {
    Part part{cells_around(cells, c), {}, {}};
    for (const std::uint32_t at : part.cells)
        for (const std::uint32_t v : cells.corners(at)) part.vertices.push_back(v);
    std::sort(part.vertices.begin(), part.vertices.end());
    part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()),
                        part.vertices.end());
    const auto local = [&](std::uint32_t v) {
        return static_cast<std::uint32_t>(
            std::lower_bound(part.vertices.begin(), part.vertices.end(), v) -
            part.vertices.begin());
    };
    TetrahedralMesh& mesh = part.mesh;
    for (const std::uint32_t v : part.vertices) mesh.vertices.push_back(cells.points()[v]);
    for (const std::uint32_t at : part.cells) {
        Corners corners = cells.corners(at);
        for (unsigned k = 0; k < 4; ++k) {
            const std::uint32_t next = cells.through(at, k);
            if (next != none &&
                std::find(part.cells.begin(), part.cells.end(), next) != part.cells.end())
                continue;
            const auto face = face_opposite(corners, k);
            mesh.faces.push_back({local(face[0]), local(face[1]), local(face[2])});
        }
        for (std::uint32_t& v : corners) v = local(v);
        mesh.tetrahedra.push_back(corners);
        mesh.block_of.push_back(0);
    }
    return part;
}

/// Makes changes that are a gain, until there is none or the passes are over.
std::size_t improve(Cells& part, const Permission& permission, double wanted) {
    std::size_t effort = 0;
    std::vector<std::uint32_t> tried;
    for (unsigned pass = 0; pass < constants.remeshing_passes; ++pass) {
        bool any = false;
        for (std::uint32_t c = 0; c < part.size(); ++c) {
            tried.resize(part.size(), none);
            if (!part.is_alive(c) || !(part.quality(c) < wanted)) continue;
            if (tried[c] != none && !part.is_touched(c, tried[c])) continue;
            Proposal proposal = change_for_cell(part, c, permission);
            effort += proposal.effort;
            auto& change = proposal.change;
            const Demand demand{change ? part.least_quality(change->old) : 0,
                                permission.least_sine};
            if (change && make(part, *change, demand))
                any = true;
            else
                tried[c] = part.time();
        }
        if (!any) break;
    }
    return effort;
}

using Sorted = std::array<std::uint32_t, 4>;

Sorted sorted(Corners corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// A change of many cells, and how many more bad ones there are then.
struct Difference {
    Change change;
    std::ptrdiff_t more_bad = 0;

    [[nodiscard]] bool is_better(const Difference& other) const {
        return std::pair(-more_bad, change.quality) >
               std::pair(-other.more_bad, other.change.quality);
    }
};

/// Returns what is different in a part after changes of it, as a change of the mesh.
Difference difference(const Cells& cells, const Part& part, const Cells& after) {
    Difference result{{Change::Kind::remeshing, {}, {}, none, {}, HUGE_VAL}, 0};
    Change& change = result.change;
    std::vector<std::uint32_t> names(part.vertices); // of the vertices of `after`
    for (std::uint32_t v = 0; v < after.points().size(); ++v) {
        const Point3 p = after.place(v);
        if (v < names.size() && p == part.mesh.vertices[v]) continue;
        const auto name = none - static_cast<std::uint32_t>(change.places.size());
        change.places.push_back(p);
        if (v < names.size())
            names[v] = name;
        else
            names.push_back(name);
    }
    std::map<Sorted, std::uint32_t> before;
    for (const std::uint32_t c : part.cells) before.emplace(sorted(cells.corners(c)), c);
    for (std::uint32_t c = 0; c < after.size(); ++c) {
        if (!after.is_alive(c)) continue;
        Corners corners = after.corners(c);
        for (std::uint32_t& v : corners) v = names[v];
        if (before.erase(sorted(corners)) > 0) continue;
        change.added.push_back(corners);
        change.quality = std::min(change.quality, after.quality(c));
        result.more_bad += after.quality(c) < constants.bad ? 1 : 0;
    }
    for (const auto& [corners, c] : before) {
        change.old.push_back(c);
        result.more_bad -= cells.quality(c) < constants.bad ? 1 : 0;
    }
    return result;
}

/// Returns changes of the first cell of a part that need be no gain.
std::vector<Change> first_changes(const Cells& part, std::size_t& effort) {
    std::vector<Change> all;
    const auto add = [&](std::optional<Change> change) {
        if (change) all.push_back(std::move(*change));
    };
    constexpr double any = -2; // any quality will do
    for (unsigned i = 0; i < 4; ++i)
        for (unsigned j = i + 1; j < 4; ++j) {
            add(without_edge(part, 0, i, j, any, effort));
            add(with_fewer_faces(part, 0, i, j, any, effort));
        }
    for (unsigned k = 0; k < 4; ++k) add(without_face(part, 0, k, any, effort));
    for (const std::uint32_t v : part.corners(0)) {
        if (part.is_fixed(v)) continue;
        const auto star = part.star(v);
        for (const std::uint32_t onto : part.corners(0))
            if (onto != v) add(contracted(part, v, star, onto, any, effort));
    }
    for (Change& change : insertions(part, 0, any, effort)) all.push_back(std::move(change));
    return all;
}

} // namespace

bool is_between_walls(const Cells& cells, std::uint32_t c) {
    const Corners& corners = cells.corners(c);
    std::array<Point3, 4> p;
    for (unsigned k = 0; k < 4; ++k) p[k] = cells.points()[corners[k]];
    // The edges 01, 02, 03, 12, 13, 23 are between the faces opposite to these corners.
    constexpr std::array<std::array<unsigned, 2>, 6> faces{
        {{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}};
    const auto angles = dihedral_angles(p);
    for (unsigned e = 0; e < 6; ++e)
        if (angles[e] < 90 && cells.is_wall(c, faces[e][0]) && cells.is_wall(c, faces[e][1]) &&
            std::sin(angles[e] * std::numbers::pi / 180) < cells.quality(c) + constants.least_gain)
            return true;
    return false;
}

Proposal remeshing_at(const Cells& cells, std::uint32_t c, const Permission& permission,
                      double wanted) {
    Proposal proposal;
    if (is_between_walls(cells, c)) return proposal;
    const Part part = part_around(cells, c);
    const Cells start(part.mesh);
    std::optional<Difference> best;
    for (Change& first : first_changes(start, proposal.effort)) {
        Cells trial = start;
        if (!make(trial, first, Demand{0, permission.least_sine})) continue;
        proposal.effort += improve(trial, permission, wanted);
        Difference result = difference(cells, part, trial);
        const Change& change = result.change;
        if (change.old.empty() || change.added.empty() || result.more_bad > 0) continue;
        if (!(change.quality > cells.enough_for(change.old, constants.least_gain))) continue;
        if (best && !result.is_better(*best)) continue;
        if (permission.may_grow || !grows(cells, change)) best = std::move(result);
    }
    if (best) proposal.change = std::move(best->change);
    return proposal;
}

} // namespace terrane::optimisation::detail
