// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/sections/detail/parts.hpp>
#include <terrane/kernel/numbers.hpp>

namespace terrane::sections {
namespace {

/// Joins edges, which are sorted, to lines that end where other than two edges meet.
class Joining {
public:
    explicit Joining(std::span<const Trace> traces) : traces_(traces), used_(traces.size()) {
        for (std::uint32_t i = 0; i < traces.size(); ++i)
            for (const std::uint32_t v : traces[i].edge) ends_.push_back({v, i});
        std::sort(ends_.begin(), ends_.end());
    }

    void append_to(std::vector<SectionLine>& lines) {
        for (const auto& [vertex, trace] : ends_)
            if (around(vertex).size() != 2) follow(vertex, trace, lines);
        for (const auto& [vertex, trace] : ends_) follow(vertex, trace, lines); // closed ones
    }

private:
    using End = std::array<std::uint32_t, 2>; ///< vertex, trace

    [[nodiscard]] std::span<const End> around(std::uint32_t vertex) const {
        const auto first = std::lower_bound(ends_.begin(), ends_.end(), End{vertex, 0});
        auto last = first;
        while (last != ends_.end() && (*last)[0] == vertex) ++last;
        return {first, last};
    }

    void follow(std::uint32_t vertex, std::uint32_t trace, std::vector<SectionLine>& lines) {
        if (used_[trace]) return;
        SectionLine line{SurfaceId(traces_[trace].surface), {vertex}};
        while (!used_[trace]) {
            used_[trace] = true;
            const Edge& edge = traces_[trace].edge;
            vertex = edge[edge[0] == vertex ? 1 : 0];
            line.vertices.push_back(vertex);
            const auto here = around(vertex);
            if (here.size() == 2) trace = here[here[0][1] == trace ? 1 : 0][1];
        }
        lines.push_back(std::move(line));
    }

    std::span<const Trace> traces_; ///< of one surface
    std::vector<bool> used_;        ///< per trace
    std::vector<End> ends_;         ///< sorted
};

/// The vertices at which rings or lines bend, begin, end or meet.
class Corners {
public:
    Corners(const Cut& cut, std::span<const CutRegion> regions) :
        exact_(cut.exact), is_corner_(cut.exact.vertices.size(), true) {
        std::vector<Trace> drawn = cut.traces; // borders as well, of no surface
        const auto add = [&](std::uint32_t v, std::uint32_t w) {
            drawn.push_back({no_index, {std::min(v, w), std::max(v, w)}});
        };
        for (const CutRegion& region : regions)
            for (const auto& ring : region.rings)
                for (std::size_t i = 0; i < ring.size(); ++i)
                    add(ring[i], ring[(i + 1) % ring.size()]);
        sort_unique(drawn);
        for (const Trace& t : drawn)
            for (const unsigned end : {0U, 1U})
                ends_.push_back({t.edge[end], t.edge[1 - end], t.surface});
        std::sort(ends_.begin(), ends_.end());
        find();
    }

    [[nodiscard]] bool operator()(std::uint32_t vertex) const { return is_corner_[vertex]; }

private:
    using End = std::array<std::uint32_t, 3>; ///< vertex, the other one, surface

    void find() {
        const UpwardRounding upward;
        for (std::size_t i = 0, end = 0; i < ends_.size(); i = end) {
            while (end < ends_.size() && ends_[end][0] == ends_[i][0]) ++end;
            const auto here = std::span(ends_).subspan(i, end - i);
            const std::size_t half = here.size() / 2; // two edges of the same surfaces?
            bool same = here.size() % 2 == 0 && here[0][1] != here[half][1];
            for (std::size_t k = 0; same && k < half; ++k)
                same = here[k][1] == here[0][1] && here[half + k][1] == here[half][1] &&
                       here[k][2] == here[half + k][2];
            if (same) is_corner_[here[0][0]] = bends(upward, here[0][1], here[0][0], here[half][1]);
        }
    }

    [[nodiscard]] bool bends(UpwardWitness upward, std::uint32_t a, std::uint32_t b,
                             std::uint32_t c) const {
        const auto& v = exact_.vertices;
        return std::ranges::any_of(std::array{Axis::x, Axis::y, Axis::z}, [&](Axis axis) {
            return exact_.state->points.orient2d(upward, axis, v[a], v[b], v[c]) != Sign::Zero;
        });
    }

    const Arrangement& exact_;
    std::vector<bool> is_corner_; ///< per vertex
    std::vector<End> ends_;       ///< sorted
};

} // namespace

std::vector<SectionLine> find_lines(const Cut& cut) {
    std::vector<SectionLine> lines;
    const auto& all = cut.traces;
    for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
        while (end < all.size() && all[end].surface == all[i].surface) ++end;
        Joining(std::span(all).subspan(i, end - i)).append_to(lines);
    }
    return lines;
}

void straighten(const Cut& cut, std::vector<CutRegion>& regions, std::vector<SectionLine>& lines) {
    const Corners is_corner(cut, regions);
    for (CutRegion& region : regions)
        for (auto& ring : region.rings)
            std::erase_if(ring, [&](std::uint32_t v) { return !is_corner(v); });
    for (SectionLine& line : lines) {
        auto& v = line.vertices;
        const bool is_closed = v.front() == v.back();
        if (is_closed) v.pop_back();
        std::erase_if(v, [&](std::uint32_t w) { return !is_corner(w); });
        if (is_closed) v.push_back(v.front());
    }
}

} // namespace terrane::sections
