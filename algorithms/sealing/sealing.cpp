// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/sealing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sealing/border_extension.hpp>
#include <terrane/algorithms/sealing/detail/bridges.hpp>
#include <terrane/algorithms/sealing/detail/constants.hpp>
#include <terrane/algorithms/sealing/detail/facing_borders.hpp>
#include <terrane/algorithms/sealing/detail/gap_distances.hpp>
#include <terrane/algorithms/sealing/detail/open_gaps.hpp>
#include <terrane/algorithms/sealing/detail/overshoots.hpp>
#include <terrane/algorithms/sealing/detail/seal_distances.hpp>
#include <terrane/algorithms/sealing/extension_faces.hpp>
#include <terrane/algorithms/sealing/known_sealing.hpp>

namespace terrane {

using namespace sealing::detail;

namespace {

using sealing::detail::constants;

std::array<Point3, 2> in_order(const Point3& p, const Point3& q) {
    return {std::min(p, q), std::max(p, q)};
}

Error interrupted() {
    return {ErrorCode::interrupted, "stopped on request", ""};
}

// ---- What is kept

struct Judged {
    std::vector<bool> keep;            ///< per triangle of the arrangement
    std::vector<Overshoot> overshoots; ///< triangles of the arrangement
};

Judged judge(const Arrangement& a, std::span<const ExtensionTriangle> strips,
             const SealDistances& distances) {
    const auto of = strips_by_triangle(a, strips_by_input(a, strips));
    std::vector<bool> keep(a.triangles.size());
    std::vector<std::uint32_t> originals;
    for (std::uint32_t t = 0; t < keep.size(); ++t) {
        keep[t] = of[t] == no_index;
        if (keep[t]) originals.push_back(t);
    }
    Judged judged;
    judged.overshoots = find_overshoots(strips.empty() ? a : restricted(a, keep), distances);
    for (Overshoot& shoot : judged.overshoots)
        for (std::uint32_t& t : shoot.triangles) {
            t = originals[t];
            keep[t] = false;
        }
    judged.keep = strips.empty() ? std::move(keep) : kept_cells(a, strips, std::move(keep));
    return judged;
}

Result<Arrangement> judged_again(Arrangement a, const std::vector<ExtensionTriangle>& strips,
                                 const SealDistances& distances) {
    const Judged judged = judge(a, strips, distances);
    return restricted(std::move(a), judged.keep);
}

// ---- The steps

class Sealing {
public:
    Sealing(std::vector<Surface> surfaces, const SealOptions& options, KnownTriangles& known,
            const Run& run) :
        surfaces_(std::move(surfaces)),
        arrange_(options.arrange), known_(known), distances_(options.distance, options.rules),
        run_(run) {}

    Result<Sealed> operator()() {
        if (auto done = update(); !done) return done.error();
        double share = 0;
        for (const auto make : {&Sealing::bridges, &Sealing::strips_along,
                                &Sealing::strips_to_nearest, &Sealing::strips_to_own}) {
            report(share += 0.2);
            auto fresh = (this->*make)();
            if (fresh.empty()) continue;
            ++sealed_.passes;
            if (auto done = add_useful(std::move(fresh)); !done) return done.error();
            if (run_.stop.stop_requested()) return interrupted();
        }
        finish();
        report(1);
        return std::move(sealed_);
    }

private:
    void report(double share) const {
        if (run_.progress) run_.progress("seal", share);
    }

    [[nodiscard]] std::vector<Surface> with(std::span<const ExtensionTriangle> strips) const {
        auto surfaces = surfaces_;
        append_strips(surfaces, strips);
        return surfaces;
    }

    /// Arranges the surfaces with their strips and decides what is kept.
    Status update() {
        measured_.reset();
        auto a = arrange(with(strips_), arrange_, known_, run_);
        if (!a) return a.error();
        whole_ = std::move(a).value();
        judged_ = judge(whole_, strips_, distances_);
        kept_ = restricted(whole_, judged_.keep);
        if (run_.stop.stop_requested()) return interrupted();
        return Done{};
    }

    /// Finds the free parts of the original borders, not those of strips.
    [[nodiscard]] std::vector<BorderEdge> free_edges() const {
        const auto by_input = strips_by_input(kept_, strips_);
        std::vector<bool> is_strip;
        for (const std::uint32_t strip : by_input) is_strip.push_back(strip != no_index);
        return open_border_edges(kept_, std::move(is_strip));
    }

    /// Finds the free parts of the original borders that are near enough to another surface.
    [[nodiscard]] std::vector<Gap> gaps() {
        std::vector<Gap> found;
        for (const BorderEdge& edge : free_edges())
            if (auto gap = measured().gap_at(edge)) found.push_back(std::move(*gap));
        return found;
    }

    /// Returns the distances in what is kept now.
    [[nodiscard]] const GapDistances& measured() {
        if (!measured_) measured_ = std::make_unique<const GapDistances>(kept_, distances_);
        return *measured_;
    }

    /// Lists the ends, in order, of the border edges that already have a strip.
    [[nodiscard]] std::set<std::array<Point3, 2>> edges_with_strip() const {
        std::set<std::array<Point3, 2>> edges;
        for (const ExtensionTriangle& t : strips_)
            if (t.is_base[0] && t.is_base[1]) edges.insert(in_order(t.corners[0], t.corners[1]));
        return edges;
    }

    [[nodiscard]] std::vector<ExtensionTriangle> strips_along() {
        return strips_over(gaps(), Towards::tangent);
    }
    [[nodiscard]] std::vector<ExtensionTriangle> strips_to_nearest() {
        return strips_over(gaps(), Towards::nearest);
    }
    /// Makes strips where a border ends short of another part of its own surface.
    [[nodiscard]] std::vector<ExtensionTriangle> strips_to_own() {
        const FacingBorders borders(kept_, free_edges(), distances_, measured());
        std::vector<Gap> found;
        for (std::uint32_t e = 0; e < borders.edges().size(); ++e)
            if (auto gap = gap_to_own(borders, measured(), e)) found.push_back(std::move(*gap));
        return strips_over(std::move(found), Towards::tangent);
    }
    [[nodiscard]] std::vector<ExtensionTriangle> bridges() {
        auto edges = free_edges();
        const auto done = edges_with_strip();
        std::erase_if(edges, [&](const BorderEdge& e) {
            return done.contains(
                in_order(kept_.state->points.input(e.from), kept_.state->points.input(e.to)));
        });
        const FacingBorders borders(kept_, std::move(edges), distances_, measured());
        auto made = make_bridges(kept_, borders, static_cast<std::uint32_t>(gaps_.size()));
        std::move(made.gaps.begin(), made.gaps.end(), std::back_inserter(gaps_));
        return std::move(made.triangles);
    }

    enum class Towards { tangent, nearest };

    /// Makes strips beyond the edges of gaps: along the tangent plane, or to the nearest points, if
    /// both ends have one.
    [[nodiscard]] std::vector<ExtensionTriangle> strips_over(std::vector<Gap> wanted,
                                                             Towards towards) {
        std::vector<StripEdge> edges;
        const auto done = edges_with_strip();
        for (Gap& gap : wanted) {
            const std::array ends{kept_.state->points.input(gap.edge.from),
                                  kept_.state->points.input(gap.edge.to)};
            if (done.contains(in_order(ends[0], ends[1]))) continue;
            StripEdge& strip = edges.emplace_back();
            strip.edge = gap.edge;
            strip.piece = static_cast<std::uint32_t>(gaps_.size());
            strip.reach = std::max(constants.width_per_gap * gap.largest,
                                   constants.least_width * step_at(ends));
            if (towards == Towards::nearest) {
                const auto a = measured().nearest(ends[0], gap.edge, constants.end_reach),
                           b = measured().nearest(ends[1], gap.edge, constants.end_reach);
                if (a && b) strip.targets = {a->place, b->place};
            }
            gaps_.push_back(std::move(gap));
        }
        auto strips = make_strips(kept_, edges);
        for (const ExtensionTriangle& t : strips)
            gaps_.resize(std::max(gaps_.size(), t.piece + std::size_t{1})); // fans have empty gaps
        return strips;
    }

    /// Returns the distance of adjacent doubles at the largest coordinate.
    [[nodiscard]] static double step_at(const std::array<Point3, 2>& ends) {
        double largest = std::numeric_limits<double>::min();
        for (const Point3& p : ends)
            largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
        return std::ldexp(1.0, std::ilogb(largest) - 52);
    }

    /// Adds the fresh strips and removes those of which no part closes a gap, until all do.
    Status add_useful(std::vector<ExtensionTriangle> fresh) {
        const std::uint32_t first = std::ranges::min(fresh, {}, &ExtensionTriangle::piece).piece;
        const std::size_t count = strips_.size();
        strips_.insert(strips_.end(), fresh.begin(), fresh.end());
        Arrangement whole = std::move(whole_), kept = std::move(kept_);
        Judged judged = std::move(judged_);
        for (unsigned round = 0; round < constants.most_rounds; ++round) {
            if (auto done = update(); !done) return done;
            if (!drop_useless()) return Done{};
            if (strips_.size() != count ||
                std::ranges::any_of(strips_, [&](const auto& t) { return t.piece >= first; }))
                continue;
            whole_ = std::move(whole); // none was of use: all is as it was
            kept_ = std::move(kept);
            measured_.reset();
            judged_ = std::move(judged);
            return Done{};
        }
        return update();
    }

    /// Removes useless pieces (single triangles would end at a diagonal). Returns whether any was.
    bool drop_useless() {
        const auto by_input = strips_by_input(whole_, strips_);
        const auto of = strips_by_triangle(whole_, by_input);
        std::vector<bool> used(gaps_.size(), false);
        for (std::uint32_t t = 0; t < of.size(); ++t)
            if (of[t] != no_index && judged_.keep[t])
                for (const std::uint32_t p : whole_.parents_of[t])
                    used[strips_[by_input[p]].piece] = true;
        return std::erase_if(strips_, [&](const ExtensionTriangle& t) { return !used[t.piece]; }) >
               0;
    }

    void finish() {
        list_extended();
        list_trimmed();
        list_closed();
        std::sort(sealed_.changes.begin(), sealed_.changes.end(),
                  [](const SealChange& a, const SealChange& b) {
                      return std::tie(a.kind, a.surface, a.place, a.length) <
                             std::tie(b.kind, b.surface, b.place, b.length);
                  });
        list_open();
        sealed_.surfaces = with(strips_);
        sealed_.arrangement = std::move(kept_);
        if (!sealed_.arrangement.state->whole)
            own_state(sealed_.arrangement).restrict_again =
                [strips = strips_, distances = distances_](Arrangement a, const Run&) {
                    return judged_again(std::move(a), strips, distances);
                };
    }

    /// Lists strips; those whose pieces share corners of the border are one change.
    void list_extended() {
        DisjointSets sets(gaps_.size());
        std::map<std::pair<std::uint32_t, Point3>, std::uint32_t> at_corner;
        for (const ExtensionTriangle& t : strips_)
            for (unsigned k = 0; k < 3; ++k) {
                if (!t.is_base[k]) continue;
                const auto [it, is_new] =
                    at_corner.emplace(std::pair(t.surface, t.corners[k]), t.piece);
                if (!is_new) sets.join(it->second, t.piece);
            }
        std::map<std::uint32_t, SealChange> changes;
        std::vector<bool> counted(gaps_.size(), false);
        for (const ExtensionTriangle& t : strips_) {
            SealChange& change = changes[sets.find(t.piece)];
            change.surface = t.surface;
            if (t.is_fan || counted[t.piece]) continue;
            counted[t.piece] = true;
            const Gap& gap = gaps_[t.piece];
            change.length += gap.length;
            if (gap.largest < change.largest) continue;
            change.largest = gap.largest;
            change.place = gap.place;
        }
        const auto of = strips_by_triangle(whole_, strips_by_input(whole_, strips_));
        for (std::uint32_t t = 0; t < of.size(); ++t)
            if (of[t] != no_index && judged_.keep[t])
                ++changes[sets.find(strips_[of[t]].piece)].triangles;
        for (const auto& [set, change] : changes) sealed_.changes.push_back(change);
    }

    void list_trimmed() {
        for (const Overshoot& shoot : judged_.overshoots)
            sealed_.changes.push_back({SealKind::trimmed, shoot.surface, shoot.length,
                                       shoot.largest, shoot.place, shoot.triangles.size()});
    }

    void list_open() {
        sealed_.open =
            list_open_gaps(FacingBorders(kept_, free_edges(), distances_, measured()), measured());
        for (const OpenGap& gap : sealed_.open)
            if (gap.reason != OpenReason::partly_farther) sealed_.left += gap.length;
    }

    void list_closed() {
        const auto by_input = strips_by_input(whole_, strips_);
        std::map<std::uint32_t, ClosedGap> closed; // by piece
        for (std::uint32_t i = 0; i < by_input.size(); ++i) {
            if (by_input[i] == no_index) continue;
            const ExtensionTriangle& t = strips_[by_input[i]];
            if (t.is_fan) continue;
            const Gap& gap = gaps_[t.piece];
            ClosedGap& entry = closed[t.piece];
            entry.from = SurfaceId(t.surface);
            entry.to = SurfaceId(gap.to);
            entry.length = gap.length;
            entry.width = gap.largest;
            entry.place = gap.place;
            entry.triangles.push_back(i);
        }
        for (auto& [piece, gap] : closed) sealed_.closed.push_back(std::move(gap));
        std::ranges::stable_sort(sealed_.closed, {}, [](const ClosedGap& gap) {
            return std::tuple(gap.from, gap.to, gap.place);
        });
    }

    const std::vector<Surface> surfaces_; ///< those of the input
    const ArrangeOptions arrange_;
    KnownTriangles& known_; ///< of the surfaces, which all arrangements have in common
    const SealDistances distances_;
    const Run& run_;
    std::vector<ExtensionTriangle> strips_;
    std::vector<Gap> gaps_;                        ///< per piece of all strips ever made
    Arrangement whole_;                            ///< arrangement of the surfaces with strips_
    Judged judged_;                                ///< of whole_
    Arrangement kept_;                             ///< of whole_
    std::unique_ptr<const GapDistances> measured_; ///< in kept_; null until it is asked for
    Sealed sealed_;
};

} // namespace

std::string_view name_of(OpenReason reason) {
    switch (reason) {
    case OpenReason::small_angle:
        return "small_angle";
    case OpenReason::ends_beside:
        return "ends_beside";
    case OpenReason::partly_farther:
        return "partly_farther";
    case OpenReason::ends_free:
        return "ends_free";
    }
    return {};
}

namespace {

Status check_distances(std::size_t surfaces, const SealOptions& options) {
    const auto refused = [](const char* sentence) {
        return Error{ErrorCode::bad_option, sentence, "seal"};
    };
    double largest = options.distance;
    for (const SealRule& rule : options.rules) {
        if (rule.surface >= surfaces || (rule.other && *rule.other >= surfaces))
            return refused("a rule is about a surface that is not there");
        if (!(rule.distance >= 0) || !std::isfinite(rule.distance))
            return refused("the distance of a rule must be a number, at least 0");
        largest = std::max(largest, rule.distance);
    }
    if (!(options.distance >= 0) || !std::isfinite(options.distance) || !(largest > 0))
        return refused("the distance must be positive");
    return Done{};
}

} // namespace

Result<Sealed> seal(std::vector<Surface> surfaces, const SealOptions& options, const Run& run) {
    KnownTriangles known;
    return seal(std::move(surfaces), options, known, run);
}

Result<Sealed> seal(std::vector<Surface> surfaces, const SealOptions& options,
                    KnownTriangles& known, const Run& run) {
    return guarded("for sealing", "sealing", [&]() -> Result<Sealed> {
        if (const auto sound = check_distances(surfaces.size(), options); !sound)
            return sound.error();
        const StageTimer timer(run, "seal");
        const Run inner = timer.inside();
        return Sealing(std::move(surfaces), options, known, inner)();
    });
}

std::vector<NamedConstant> seal_constants() {
    auto all = sealing::detail::constants.listed();
    all.push_back({"least_mitre_cosine", strip_constants.least_mitre_cosine});
    all.push_back({"beyond_targets", strip_constants.beyond_targets});
    return all;
}

} // namespace terrane
