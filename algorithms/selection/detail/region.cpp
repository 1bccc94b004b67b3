// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/detail/region.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/selection/detail/sides.hpp>
#include <terrane/algorithms/selection/windings.hpp>
#include <terrane/algorithms/volumes/exact_volumes.hpp>
#include <terrane/algorithms/volumes/radial_sort.hpp>

namespace terrane::selection {
namespace {

constexpr std::array<std::array<const char*, 2>, 3> side_names{
    {{"west", "east of"}, {"south", "north of"}, {"below", "above"}}};

std::vector<std::string> names_of(const Question& question) {
    std::vector<std::string> names;
    for (const auto& operand : question.expression.operands) names.push_back(operand.name);
    return names;
}

std::vector<bool> surfaces_of(const Question& question, std::uint32_t operand) {
    std::vector<bool> is_of(question.solid_of.size());
    for (const std::uint32_t s : question.surfaces_of[operand]) is_of[s] = true;
    return is_of;
}

/// Which solids and hulls hold in each volume.
class Holding {
public:
    Holding(const Arrangement& exact, const Volumes& volumes, const Windings& windings,
            const Question& question) :
        windings_(windings),
        question_(question), hulls_(question.expression.operands.size()) {
        for (const std::uint32_t k : question.hulls) hulls_[k] = hull_of(exact, volumes, k);
    }

    [[nodiscard]] bool operator()(std::uint32_t volume, std::uint32_t operand) const {
        return hulls_[operand].empty() ? question_.is_inside(windings_[volume][operand])
                                       : bool(hulls_[operand][volume]);
    }

private:
    /// Returns per volume whether the surfaces of an operand keep it from the outside.
    [[nodiscard]] std::vector<bool> hull_of(const Arrangement& exact, const Volumes& volumes,
                                            std::uint32_t operand) const {
        const auto is_of = surfaces_of(question_, operand);
        DisjointSets parts(volumes.measures.size());
        for (std::size_t t = 0; t < volumes.of_sides.size(); ++t)
            if (std::ranges::none_of(exact.surfaces_of[t],
                                     [&](std::uint32_t s) { return is_of[s]; }))
                parts.join(volumes.of_sides[t][0], volumes.of_sides[t][1]);
        std::vector<bool> enclosed;
        for (std::uint32_t v = 0; v < volumes.measures.size(); ++v)
            enclosed.push_back(parts.find(v) != 0);
        return enclosed;
    }

    const Windings& windings_;
    const Question& question_;
    std::vector<std::vector<bool>> hulls_; ///< per operand: per volume, or no list
};

/// Lists volumes. Each is a part of its own: a horizon that a fault divides ends on both sides of the fault.
Cells volume_cells(const Volumes& volumes, const SidedSurface& surface) {
    const std::size_t count = volumes.measures.size();
    Cells cells{std::vector<bool>(count), {}, {}, {}};
    for (std::uint32_t t = 0; t < volumes.of_sides.size(); ++t) {
        const auto [front, back] = volumes.of_sides[t];
        if (surface.has(t)) {
            cells.touches.push_back({front, t, surface.at_front(t)});
            cells.touches.push_back({back, t, surface.at_back(t)});
        } else {
            cells.others.push_back({front, t});
            if (front != back) cells.others.push_back({back, t});
        }
    }
    cells.are_volumes = true;
    return cells;
}

/// Triangles of an open surface, and the edges at which they meet others. Parts end where the surface meets another.
class SurfaceParts {
public:
    /// of_surface: triangles of the arrangement, ascending.
    SurfaceParts(const Arrangement& exact, const std::vector<std::uint32_t>& of_surface) :
        exact_(exact), triangles_(of_surface), cell_of_(exact.triangles.size(), no_index),
        planes_(volumes::planes_of(exact)),
        edges_(group_edges(exact.triangles, exact.vertices.size())) {
        for (std::uint32_t c = 0; c < triangles_.size(); ++c) cell_of_[triangles_[c]] = c;
    }

    /// Lists the triangles, and which of them a surface divides.
    [[nodiscard]] Cells cells(const SidedSurface& surface) const {
        Cells cells{std::vector<bool>(triangles_.size()), {}, {}, {}};
        for (std::uint32_t c = 0; c < triangles_.size(); ++c)
            if (!surface.has(triangles_[c])) cells.others.push_back({c, triangles_[c]});
        const UpwardRounding guard;
        const volumes::TriangleComplex sheets{
            exact_.state->points, exact_.vertices, exact_.triangles, edges_, planes_,
            &exact_.parents_of};
        std::vector<EdgeSides::Side> round;
        edges_.for_each([&](std::uint32_t low, std::uint32_t, auto at_edge) {
            const auto is_own = [&](const auto& s) { return cell_of_[s.triangle] != no_index; };
            if (std::ranges::none_of(at_edge, is_own)) return;
            if (std::ranges::none_of(at_edge,
                                     [&](const auto& s) { return surface.has(s.triangle); })) {
                if (std::ranges::all_of(at_edge, is_own)) join(at_edge, cells);
                return;
            }
            round.assign(at_edge.begin(), at_edge.end());
            volumes::sort_round_edge(guard, sheets, low, round);
            std::erase_if(round,
                          [&](const auto& s) { return !is_own(s) && !surface.has(s.triangle); });
            if (round.size() < 3 &&
                !surface.has(round.back().triangle) != !surface.has(round.front().triangle))
                return; // both end here, so that this does not tell the side
            volumes::join_round_edge(sheets, low, round, [&](std::uint32_t a, std::uint32_t b) {
                touch(a, b, surface, cells);
                touch(b, a, surface, cells);
            });
        });
        return cells;
    }

private:
    void join(std::span<const EdgeSides::Side> at_edge, Cells& cells) const {
        std::uint32_t last = no_index;
        for (const auto& side : at_edge) {
            const std::uint32_t c = cell_of_[side.triangle];
            if (last != no_index) cells.joined.push_back({last, c});
            last = c;
        }
    }

    /// Notes on which side of the surface a triangle is, if the two sides that face each other are of these.
    void touch(std::uint32_t own, std::uint32_t other, const SidedSurface& surface,
               Cells& cells) const {
        const std::uint32_t c = cell_of_[own / 2], t = other / 2;
        if (c == no_index || surface.has(own / 2) || !surface.has(t)) return;
        const bool is_front = other == volumes::front_of(t);
        cells.touches.push_back({c, t, is_front ? surface.at_front(t) : surface.at_back(t)});
    }

    const Arrangement& exact_;
    const std::vector<std::uint32_t>& triangles_;
    std::vector<std::uint32_t> cell_of_; ///< per triangle of the arrangement, or no_index
    std::vector<Triangle> planes_;
    EdgeSides edges_;
};

/// Finds the side of each cell where the answer depends on it, and with it the answers. list(surface): the cells;
/// lies_on(surface, cell): whether a cell lies on the surface, which counts as its lower side.
template <class List, class LiesOn>
Result<std::vector<bool>> answers_in(const Arrangement& exact, const Question& question,
                                     const Answers& answers, std::size_t count, const List& list,
                                     const LiesOn& lies_on) {
    std::vector<unsigned> low(count, 0);
    for (std::size_t j = 0; j < question.sided.size(); ++j) {
        const auto& operand = question.expression.operands[question.sided[j]];
        const auto is_of = surfaces_of(question, question.sided[j]);
        const SidedSurface surface(exact, is_of, operand.axis);
        Cells cells = list(surface);
        for (std::size_t c = 0; c < count; ++c)
            if (lies_on(surface, c))
                low[c] |= 1U << j;
            else
                cells.asked[c] = answers.depends(c, j);
        const auto& [below, above] = side_names[static_cast<std::size_t>(operand.axis)];
        const auto found = low_cells(exact, surface, cells, {operand.name, below, above});
        if (!found) return found.error();
        for (std::size_t c = 0; c < count; ++c)
            if ((*found)[c]) low[c] |= 1U << j;
    }
    std::vector<bool> in;
    for (std::size_t c = 0; c < count; ++c) in.push_back(answers.answer(c, low[c]));
    return in;
}

/// Numbers the parts of the region and counts its cavities. Parts are joined through triangles with the
/// region on both sides.
std::vector<std::uint32_t> number_pieces(const Volumes& volumes, const std::vector<bool>& inside,
                                         SelectedRegion& region) {
    DisjointSets parts(inside.size());
    for (const auto& [front, behind] : volumes.of_sides)
        if (inside[front] == inside[behind]) parts.join(front, behind);
    std::vector<std::uint32_t> piece(inside.size(), 0);
    for (std::uint32_t v = 1; v < inside.size(); ++v) {
        const std::uint32_t first = parts.find(v); // the lowest of its part
        if (inside[v])
            piece[v] = first == v ? ++region.pieces : piece[first];
        else if (first == v)
            ++region.cavities;
    }
    return piece;
}

/// Restricts an arrangement to the boundary of a region of space.
Result<SelectedRegion> solid_in(Arrangement exact, const Volumes& volumes, const Windings& windings,
                                const Question& question) {
    const std::size_t count = volumes.measures.size();
    const Answers answers(question, count, Holding(exact, volumes, windings, question));
    const auto inside = answers_in(
        exact, question, answers, count,
        [&](const SidedSurface& surface) { return volume_cells(volumes, surface); },
        [](const SidedSurface&, std::size_t) { return false; });
    if (!inside) return inside.error();
    SelectedRegion region;
    const auto piece = number_pieces(volumes, *inside, region);
    std::vector<bool> keep(exact.triangles.size());
    for (std::size_t t = 0; t < keep.size(); ++t) {
        const auto [front, behind] = volumes.of_sides[t];
        keep[t] = (*inside)[front] != (*inside)[behind];
        if (keep[t]) region.of_sides.push_back({piece[front], piece[behind]});
    }
    region.boundary = restricted(std::move(exact), keep);
    return region;
}

/// Restricts an arrangement to the part of an open surface that is selected. A triangle of it is inside of a solid
/// if points on one of its sides are.
Result<SelectedRegion> surface_in(Arrangement exact, const Volumes& volumes,
                                  const Windings& windings, const Question& question,
                                  std::uint32_t open, const Error& otherwise) {
    const Holding holding(exact, volumes, windings, question);
    const auto is_inside = [&](std::uint32_t v, std::uint32_t k) {
        return k != open && holding(v, k);
    };
    const Answers without(question, volumes.measures.size(), is_inside);
    for (std::size_t v = 0; v < volumes.measures.size(); ++v)
        if (without.may_be(v)) return otherwise; // space is asked for, not only the surface
    std::vector<std::uint32_t> own;
    const auto is_of = surfaces_of(question, open);
    for (std::uint32_t t = 0; t < exact.triangles.size(); ++t)
        if (std::ranges::any_of(exact.surfaces_of[t], [&](std::uint32_t s) { return is_of[s]; }))
            own.push_back(t);
    const Answers answers(question, own.size(), [&](std::uint32_t c, std::uint32_t k) {
        const auto [front, behind] = volumes.of_sides[own[c]];
        return k == open || is_inside(front, k) || is_inside(behind, k);
    });
    const SurfaceParts parts(exact, own);
    const auto chosen = answers_in(
        exact, question, answers, own.size(),
        [&](const SidedSurface& surface) { return parts.cells(surface); },
        [&](const SidedSurface& surface, std::size_t c) { return surface.has(own[c]); });
    if (!chosen) return chosen.error();
    std::vector<bool> keep(exact.triangles.size());
    for (std::size_t c = 0; c < own.size(); ++c) keep[own[c]] = (*chosen)[c];
    SelectedRegion region;
    region.open = is_of;
    region.boundary = restricted(std::move(exact), keep);
    return region;
}

Result<SelectedRegion> region_once(Arrangement exact, const Question& question, const Run& run) {
    const auto volumes = volumes::find_unmeasured(exact, run);
    if (!volumes) return volumes.error();
    const auto names = names_of(question);
    const Operands operands{question.solid_of, names};
    const auto windings = find_windings(exact, *volumes, operands);
    if (windings) return solid_in(std::move(exact), *volumes, *windings, question);
    const std::uint32_t open = question.may_be_open();
    if (open == no_index || !is_open(exact, operands, open)) return windings.error();
    auto others = question.solid_of;
    std::ranges::replace(others, open, no_index);
    const auto of_others = find_windings(exact, *volumes, {others, names});
    if (!of_others) return of_others.error();
    return surface_in(std::move(exact), *volumes, *of_others, question, open, windings.error());
}

} // namespace

Result<SelectedRegion> region_in(Arrangement exact, const Question& question, const Run& run) {
    auto region = region_once(std::move(exact), question, run);
    if (!region || region->boundary.state->whole) return region;
    ExactState& state = own_state(region->boundary);
    state.measures = false;
    state.restrict_again = [question](Arrangement moved, const Run& inner) -> Result<Arrangement> {
        auto again = region_once(std::move(moved), question, inner);
        if (!again) return again.error();
        return std::move(again->boundary);
    };
    return region;
}

} // namespace terrane::selection
