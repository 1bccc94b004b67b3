// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/layers/detail/resolver.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <gmpxx.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::layers::detail {

double LayerResolver::area(std::uint32_t t) const {
    return area_between(corner(t, 0), corner(t, 1), corner(t, 2));
}

std::string LayerResolver::place(std::uint32_t t) const {
    return a_.surfaces[a_.surfaces_of[t][0]].name + " " + place_text(corner(t, 0));
}

/// Finds the corners in counterclockwise order, and the boxes, of all triangles of the layers.
Status LayerResolver::prepare() {
    const UpwardRounding upward;
    for (std::uint32_t t = 0; t < a_.triangles.size(); ++t) {
        const auto surfaces = a_.surfaces_of[t];
        if (surfaces[0] == input_.copies.size()) continue; // only a wall
        const Triangle& c = a_.triangles[t];
        const auto seen = seen_along_z(upward, a_.state->points,
                                       {a_.vertices[c[0]], a_.vertices[c[1]], a_.vertices[c[2]]});
        if (!seen)
            return Error{ErrorCode::unsupported, "a layer has an upright triangle: it is no graph",
                         place(t)};
        seen_[t] = *seen;
        Box box{{HUGE_VAL, HUGE_VAL, 0}, {-HUGE_VAL, -HUGE_VAL, 0}};
        for (const PointIndex p : *seen) {
            const Enclosure e = a_.state->points.enclosure(p);
            for (std::size_t k = 0; k < 2; ++k) {
                box.low[k] = std::min(box.low[k], e.low[k]);
                box.high[k] = std::max(box.high[k], e.high[k]);
            }
        }
        boxes_[t] = box;
    }
    for (std::size_t i = 0; i < input_.order.size(); ++i)
        reports_[i].surface = input_.order[i].surface;
    return Done{};
}

/// Step (2): finds the pairs that overlap along z, with their order.
Result<std::vector<LayerResolver::Relation>> LayerResolver::relate(const Set& soft,
                                                                   const Set& hard) const {
    std::vector<Box> boxes;
    std::vector<std::uint32_t> groups;
    for (const std::uint32_t t : soft) {
        boxes.push_back(boxes_[t]);
        groups.push_back(0);
    }
    for (const std::uint32_t t : hard) {
        boxes.push_back(boxes_[t]);
        groups.push_back(1);
    }
    const auto pairs = candidate_pairs(boxes, groups, Search::automatic, without_progress(run_));
    const auto of = [&](std::uint32_t box) {
        return box < soft.size() ? soft[box] : hard[box - soft.size()];
    };
    const auto blocks = for_blocks<std::vector<Relation>>(
        pairs.size(), 4096, run_, [&](UpwardWitness upward, std::size_t first, std::size_t last) {
            std::vector<Relation> found;
            for (std::size_t i = first; i < last; ++i) {
                const std::uint32_t s = of(pairs[i].first), t = of(pairs[i].second);
                if (s != t && !overlap_along_z(upward, a_.state->points, seen_[s], seen_[t]))
                    continue;
                found.push_back(
                    {s, t,
                     s == t ? Sign::Zero
                            : above_along_z(upward, a_.state->points, seen_[s], seen_[t])});
            }
            return found;
        });
    if (run_.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    std::vector<Relation> all;
    for (const auto& b : blocks) all.insert(all.end(), b.begin(), b.end());
    return all;
}

/// Finds the triangles on the wrong side and those that replace them. A triangle with pairs on both
/// sides means that the other layer is overturned.
Result<LayerResolver::Replacement> LayerResolver::classify(const std::vector<Relation>& relations,
                                                           Sign wrong) const {
    Replacement change;
    Set stays, not_taken;
    for (const Relation& r : relations) {
        (r.side == wrong ? change.dropped : stays).push_back(r.first);
        (r.side == wrong ? change.taken : not_taken).push_back(r.second);
    }
    for (Set* set : {&change.dropped, &change.taken, &stays, &not_taken}) sort_unique(*set);
    for (const auto& [one, other] :
         {std::pair(&change.dropped, &stays), std::pair(&change.taken, &not_taken)}) {
        Set both;
        std::set_intersection(one->begin(), one->end(), other->begin(), other->end(),
                              std::back_inserter(both));
        if (both.empty()) continue;
        const bool of_soft = one == &change.dropped;
        const auto pair = std::find_if(relations.begin(), relations.end(), [&](const Relation& r) {
            return (of_soft ? r.first : r.second) == both[0];
        });
        return Error{ErrorCode::unsupported,
                     "a layer is above and below another along one vertical: it is no graph",
                     place(of_soft ? pair->second : pair->first)};
    }
    return change;
}

/// Step (3): replaces the parts of `soft` on the wrong side of the harder layers, which are moved
/// up by `steps`, by these. At each place the first of them that exists there decides.
Result<Set> LayerResolver::replace(const Set& soft, std::span<const std::size_t> harder, int steps,
                                   Side kept, LayerReport* report) {
    Set result, rest = soft;
    for (const std::size_t layer : harder) {
        if (rest.empty()) break;
        const auto hard = resolve({layer, steps});
        if (!hard) return hard.error();
        auto covered = replace_by_one(rest, hard.value(), kept, report);
        if (!covered) return covered.error();
        result.insert(result.end(), covered->replaced.begin(), covered->replaced.end());
        rest = std::move(covered->rest);
    }
    result.insert(result.end(), rest.begin(), rest.end());
    sort_unique(result);
    return result;
}

/// Replaces the parts of `soft` on the wrong side of `hard`. A triangle of the one is as a whole
/// where the other exists, or as a whole where it does not: walls divide both.
Result<LayerResolver::Covered> LayerResolver::replace_by_one(const Set& soft, const Set& hard,
                                                             Side kept, LayerReport* report) {
    const auto related = relate(soft, hard);
    if (!related) return related.error();
    const auto change =
        classify(related.value(), kept == Side::above ? Sign::Negative : Sign::Positive);
    if (!change) return change.error();
    const auto& [dropped, taken] = change.value();
    Set covered;
    for (const Relation& r : related.value()) covered.push_back(r.first);
    sort_unique(covered);
    Covered result;
    std::set_difference(soft.begin(), soft.end(), covered.begin(), covered.end(),
                        std::back_inserter(result.rest));
    std::set_difference(covered.begin(), covered.end(), dropped.begin(), dropped.end(),
                        std::back_inserter(result.replaced));
    result.replaced.insert(result.replaced.end(), taken.begin(), taken.end());
    if (report != nullptr) add_to_report(change.value(), soft, related.value(), *report);
    return result;
}

void LayerResolver::add_to_report(const Replacement& change, const Set& soft,
                                  const std::vector<Relation>& relations,
                                  LayerReport& report) const {
    report.dropped += change.dropped.size();
    report.taken += change.taken.size();
    for (const std::uint32_t t : change.dropped) report.dropped_area += area(t);
    for (const std::uint32_t t : change.taken) report.taken_area += area(t);
    add_steps(change, soft, report);
    add_moves(change, relations, report);
}

/// Counts the connected parts of the dropped triangles, and measures their borders where the harder
/// layer ends.
void LayerResolver::add_steps(const Replacement& change, const Set& soft,
                              LayerReport& report) const {
    std::vector<Triangle> corners;
    for (const std::uint32_t t : soft) corners.push_back(a_.triangles[t]);
    std::vector<bool> gone(soft.size());
    for (std::size_t i = 0; i < soft.size(); ++i)
        gone[i] = std::binary_search(change.dropped.begin(), change.dropped.end(), soft[i]);
    Set taken_vertices;
    for (const std::uint32_t t : change.taken)
        for (const std::uint32_t v : a_.triangles[t]) taken_vertices.push_back(v);
    sort_unique(taken_vertices);
    const auto is_taken = [&](std::uint32_t v) {
        return std::binary_search(taken_vertices.begin(), taken_vertices.end(), v);
    };
    DisjointSets parts(soft.size());
    group_edges(corners, a_.vertices.size())
        .for_each([&](std::uint32_t a, std::uint32_t b, auto sides) {
            bool stays = false, goes = false;
            for (const auto& s : sides) (gone[s.triangle] ? goes : stays) = true;
            if (!stays)
                for (const auto& s : sides) parts.join(sides[0].triangle, s.triangle);
            if (!stays || !goes || (is_taken(a) && is_taken(b))) return;
            const Point3 d = minus(a_.state->points.nearest(a_.vertices[b]),
                                   a_.state->points.nearest(a_.vertices[a]));
            report.step_length += std::hypot(d.x, d.y, d.z);
        });
    for (std::uint32_t i = 0; i < soft.size(); ++i)
        report.parts += gone[i] && parts.find(i) == i ? 1 : 0;
}

/// Returns the height of a point over the plane of a triangle. Where floating point can't tell the
/// triangle from an upright one, exact numbers take over.
double LayerResolver::height_over(std::uint32_t t, PointIndex v) const {
    const Point3 a = corner(t, 0);
    const Point3 ab = minus(corner(t, 1), a), ac = minus(corner(t, 2), a);
    const Point3 n = cross(ab, ac);
    constexpr double upright = 0x1p-20; // of the largest possible area in plan
    if (std::fabs(n.z) > upright * std::hypot(ab.x, ab.y) * std::hypot(ac.x, ac.y))
        return dot(minus(a_.state->points.nearest(v), a), n) / n.z;
    const auto cartesian = [&](PointIndex p) {
        const ExactPoint e = a_.state->points.exact(p);
        std::array<mpq_class, 4> h;
        e.x.export_to_mpq_t(h[0].get_mpq_t());
        e.y.export_to_mpq_t(h[1].get_mpq_t());
        e.z.export_to_mpq_t(h[2].get_mpq_t());
        e.w.export_to_mpq_t(h[3].get_mpq_t());
        for (unsigned k = 0; k < 3; ++k) h[k] /= h[3];
        return h;
    };
    const auto o = cartesian(seen_[t][0]), p = cartesian(seen_[t][1]), q = cartesian(seen_[t][2]);
    std::array<mpq_class, 4> d = cartesian(v);
    std::array<mpq_class, 3> first, second;
    for (unsigned k = 0; k < 3; ++k) {
        first[k] = p[k] - o[k];
        second[k] = q[k] - o[k];
        d[k] -= o[k];
    }
    const auto minor = [&](unsigned i, unsigned j) -> mpq_class {
        return first[i] * second[j] - first[j] * second[i];
    };
    return mpq_class(d[2] + (d[0] * minor(1, 2) + d[1] * minor(2, 0)) / minor(0, 1)).get_d();
}

/// Measures the heights of corners of dropped triangles over those of the others.
void LayerResolver::add_moves(const Replacement& change, const std::vector<Relation>& relations,
                              LayerReport& report) const {
    for (const Relation& r : relations) {
        if (!std::binary_search(change.dropped.begin(), change.dropped.end(), r.first)) continue;
        for (unsigned k = 0; k < 3; ++k) {
            const UpwardRounding upward;
            const PointIndex v = a_.vertices[a_.triangles[r.first][k]];
            bool over = true;
            for (unsigned e = 0; e < 3 && over; ++e)
                over = a_.state->points.orient2d(upward, Axis::z, seen_[r.second][e],
                                                 seen_[r.second][(e + 1) % 3], v) != Sign::Negative;
            if (!over) continue;
            report.largest_move =
                std::max(report.largest_move, std::fabs(height_over(r.second, v)));
        }
    }
}

Result<Set> LayerResolver::resolve(const Copy& copy) {
    if (const auto found = known_.find(copy); found != known_.end()) return found->second;
    const auto which = static_cast<std::uint32_t>(
        std::find(input_.copies.begin(), input_.copies.end(), copy) - input_.copies.begin());
    Set own;
    for (std::uint32_t t = 0; t < a_.triangles.size(); ++t) {
        const auto surfaces = a_.surfaces_of[t];
        if (std::binary_search(surfaces.begin(), surfaces.end(), which)) own.push_back(t);
    }
    LayerReport* report = copy.steps == 0 ? &reports_[copy.layer] : nullptr;
    const auto apply = [&](std::span<const std::size_t> harder, int steps, Side kept) -> Status {
        auto next = replace(own, harder, steps, kept, report);
        if (!next) return next.error();
        own = std::move(next).value();
        return Done{};
    };
    const auto& above = input_.bounds.above[copy.layer];
    const auto& below = input_.bounds.below[copy.layer];
    const int step = input_.has_min_thickness ? 1 : 0;
    if (const auto done = apply(above, copy.steps - step, Side::below); !done) return done.error();
    if (const auto done = apply(below, copy.steps + step, Side::above); !done) return done.error();
    if (input_.has_min_thickness) // where both leave too little room, the upper one decides
        if (const auto done = apply(above, copy.steps, Side::below); !done) return done.error();
    known_.emplace(copy, own);
    return own;
}

} // namespace terrane::layers::detail
