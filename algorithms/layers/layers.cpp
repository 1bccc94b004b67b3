// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/layers/layers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/layers/detail/vertical_order.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {

using namespace layers::detail;

namespace {

using Set = std::vector<std::uint32_t>; ///< triangles of the arrangement, ascending

Error bad(const char* what) {
    return {ErrorCode::bad_option, what, ""};
}

/// Layer `layer` of the order, moved up by `steps` times the minimum thickness.
struct Copy {
    std::size_t layer = 0;
    int steps = 0;

    friend auto operator<=>(const Copy&, const Copy&) = default;
};

/// The nearest harder layers of each, in the order from the top down.
struct Bounds {
    std::vector<std::optional<std::size_t>> above, below;
};

Bounds bounds_of(std::span<const Layer> order) {
    const auto harder = [&](std::size_t a, std::size_t b) { // a than b
        return order[a].hardness > order[b].hardness ||
               (order[a].hardness == order[b].hardness && a < b);
    };
    Bounds bounds;
    for (std::size_t i = 0; i < order.size(); ++i) {
        std::optional<std::size_t> above, below;
        for (std::size_t j = i; j-- > 0 && !above;)
            if (harder(j, i)) above = j;
        for (std::size_t j = i + 1; j < order.size() && !below; ++j)
            if (harder(j, i)) below = j;
        bounds.above.push_back(above);
        bounds.below.push_back(below);
    }
    return bounds;
}

/// All copies that the layers are made of, themselves first.
std::vector<Copy> copies_needed(const Bounds& bounds, bool thick) {
    std::vector<Copy> needed;
    std::vector<Copy> open;
    for (std::size_t i = bounds.above.size(); i-- > 0;) open.push_back({i, 0});
    while (!open.empty()) {
        const Copy c = open.back();
        open.pop_back();
        if (std::find(needed.begin(), needed.end(), c) != needed.end()) continue;
        needed.push_back(c);
        const auto& above = bounds.above[c.layer];
        const auto& below = bounds.below[c.layer];
        if (above) open.push_back({*above, c.steps});
        if (thick && above) open.push_back({*above, c.steps - 1});
        if (below) open.push_back({*below, c.steps + (thick ? 1 : 0)});
    }
    return needed;
}

Surface moved_up(Surface s, double by) {
    if (by != 0)
        for (Point3& p : s.vertices) p.z += by;
    return s;
}

/// Upright sheets on all free borders of the layers, from below everything to above it.
Surface walls_on(std::span<const Surface> layers) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::vector<std::array<double, 4>> edges; // x, y, x, y: lower end first
    for (const Surface& s : layers) {
        for (const Point3& p : s.vertices) {
            low = std::min(low, p.z);
            high = std::max(high, p.z);
        }
        const Soup soup = merge_surfaces(std::span(&s, 1));
        soup.edges.for_each([&](std::uint32_t a, std::uint32_t b, auto sides) {
            if (sides.size() != 1) return;
            std::array<double, 2> p{soup.points[a].x, soup.points[a].y},
                q{soup.points[b].x, soup.points[b].y};
            if (q < p) std::swap(p, q);
            edges.push_back({p[0], p[1], q[0], q[1]});
        });
    }
    sort_unique(edges);
    const double room = std::max(high - low, 1.0);
    Surface walls{"walls", Role::unknown, {}, {}};
    for (const auto& e : edges) {
        const auto first = static_cast<std::uint32_t>(walls.vertices.size());
        for (const double z : {low - room, high + room}) {
            walls.vertices.push_back({e[0], e[1], z});
            walls.vertices.push_back({e[2], e[3], z});
        }
        walls.triangles.push_back({first, first + 1, first + 3});
        walls.triangles.push_back({first, first + 3, first + 2});
    }
    return walls;
}

class Stacker {
public:
    Stacker(std::span<const Layer> order, const Bounds& bounds, const std::vector<Copy>& copies,
            bool thick, const Arrangement& a, const Run& run) :
        order_(order),
        bounds_(bounds), copies_(copies), thick_(thick), a_(a), run_(run),
        seen_(a.triangles.size()), boxes_(a.triangles.size()), reports_(order.size()) {}

    Status prepare();
    /// The layer's triangles once harder ones have had their say. Reports are of those not moved.
    Result<Set> resolve(const Copy& copy);
    [[nodiscard]] std::vector<LayerReport> reports() const { return reports_; }

private:
    enum class Side : std::uint8_t { above, below };
    /// Pairs of triangles, one of each set, that overlap along z, with the side of the first.
    struct Relation {
        std::uint32_t first, second;
        Sign side;
    };

    Result<std::vector<Relation>> relate(const Set& soft, const Set& hard) const;
    Result<Set> replace(const Set& soft, const Set& hard, Side kept, LayerReport* report);
    Status note(LayerReport& report, const Set& dropped, const Set& taken, const Set& soft,
                const std::vector<Relation>& relations) const;
    [[nodiscard]] Point3 corner(std::uint32_t t, unsigned k) const {
        return a_.state->points.nearest(a_.vertices[a_.triangles[t][k]]);
    }
    [[nodiscard]] double area(std::uint32_t t) const {
        const Point3 n =
            cross(minus(corner(t, 1), corner(t, 0)), minus(corner(t, 2), corner(t, 0)));
        return std::hypot(n.x, n.y, n.z) / 2;
    }
    [[nodiscard]] std::string place(std::uint32_t t) const {
        const Point3 p = corner(t, 0);
        return a_.surfaces[a_.surfaces_of[t][0]].name + " (" + std::to_string(p.x) + ", " +
               std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
    }

    std::span<const Layer> order_;
    const Bounds& bounds_;
    const std::vector<Copy>& copies_;
    bool thick_;
    const Arrangement& a_;
    const Run& run_;
    std::vector<UprightTriangle> seen_; ///< per triangle; of the layers only
    std::vector<Box> boxes_;            ///< per triangle, flat
    std::map<Copy, Set> known_;
    std::vector<LayerReport> reports_;
};

/// Corners counterclockwise, and boxes, of all triangles of the layers.
Status Stacker::prepare() {
    const UpwardRounding guard;
    for (std::uint32_t t = 0; t < a_.triangles.size(); ++t) {
        const auto surfaces = a_.surfaces_of[t];
        if (surfaces[0] == copies_.size()) continue; // of walls alone
        const Triangle& c = a_.triangles[t];
        const auto seen = seen_along_z(a_.state->points,
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
    for (std::size_t i = 0; i < order_.size(); ++i) reports_[i].surface = order_[i].surface;
    return Done{};
}

/// Step (2).
Result<std::vector<Stacker::Relation>> Stacker::relate(const Set& soft, const Set& hard) const {
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
    const auto pairs = candidate_pairs(boxes, groups, Search::automatic, run_);
    const auto of = [&](std::uint32_t box) {
        return box < soft.size() ? soft[box] : hard[box - soft.size()];
    };
    const auto blocks = for_blocks<std::vector<Relation>>(
        pairs.size(), 4096, run_, [&](std::size_t first, std::size_t last) {
            std::vector<Relation> found;
            for (std::size_t i = first; i < last; ++i) {
                const std::uint32_t s = of(pairs[i].first), t = of(pairs[i].second);
                if (s != t && !overlap_along_z(a_.state->points, seen_[s], seen_[t])) continue;
                found.push_back(
                    {s, t,
                     s == t ? Sign::Zero : above_along_z(a_.state->points, seen_[s], seen_[t])});
            }
            return found;
        });
    if (run_.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    std::vector<Relation> all;
    for (const auto& b : blocks) all.insert(all.end(), b.begin(), b.end());
    return all;
}

/// Step (3): `soft` with what is on the wrong side of `hard` replaced by `hard`.
Result<Set> Stacker::replace(const Set& soft, const Set& hard, Side kept, LayerReport* report) {
    const auto related = relate(soft, hard);
    if (!related) return related.error();
    const Sign wrong = kept == Side::above ? Sign::Negative : Sign::Positive;
    Set dropped, taken, stays, not_taken;
    for (const Relation& r : related.value()) {
        (r.side == wrong ? dropped : stays).push_back(r.first);
        (r.side == wrong ? taken : not_taken).push_back(r.second);
    }
    for (Set* set : {&dropped, &taken, &stays, &not_taken}) sort_unique(*set);
    for (const auto& [one, other] : {std::pair(&dropped, &stays), std::pair(&taken, &not_taken)}) {
        Set both;
        std::set_intersection(one->begin(), one->end(), other->begin(), other->end(),
                              std::back_inserter(both));
        if (both.empty()) continue;
        // One triangle is on both sides of a layer: it is that layer that is overturned.
        const bool of_soft = one == &dropped;
        const auto pair =
            std::find_if(related.value().begin(), related.value().end(), [&](const Relation& r) {
                return (of_soft ? r.first : r.second) == both[0];
            });
        return Error{ErrorCode::unsupported,
                     "a layer is above and below another along one vertical: it is no graph",
                     place(of_soft ? pair->second : pair->first)};
    }
    Set result;
    std::set_difference(soft.begin(), soft.end(), dropped.begin(), dropped.end(),
                        std::back_inserter(result));
    result.insert(result.end(), taken.begin(), taken.end());
    sort_unique(result);
    if (report != nullptr)
        if (const auto done = note(*report, dropped, taken, soft, related.value()); !done)
            return done.error();
    return result;
}

/// Adds up what was replaced.
Status Stacker::note(LayerReport& report, const Set& dropped, const Set& taken, const Set& soft,
                     const std::vector<Relation>& relations) const {
    report.dropped += dropped.size();
    report.taken += taken.size();
    for (const std::uint32_t t : dropped) report.dropped_area += area(t);
    for (const std::uint32_t t : taken) report.taken_area += area(t);
    std::vector<Triangle> corners;
    for (const std::uint32_t t : soft) corners.push_back(a_.triangles[t]);
    std::vector<bool> gone(soft.size());
    for (std::size_t i = 0; i < soft.size(); ++i)
        gone[i] = std::binary_search(dropped.begin(), dropped.end(), soft[i]);
    Set taken_vertices;
    for (const std::uint32_t t : taken)
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
    for (const Relation& r : relations) {
        if (!std::binary_search(dropped.begin(), dropped.end(), r.first)) continue;
        // Heights at corners of the one over the plane of the other, in floating point.
        const Point3 p = corner(r.second, 0);
        const Point3 n = cross(minus(corner(r.second, 1), p), minus(corner(r.second, 2), p));
        for (unsigned k = 0; k < 3; ++k) {
            const UpwardRounding guard;
            const PointIndex v = a_.vertices[a_.triangles[r.first][k]];
            bool over = true;
            for (unsigned e = 0; e < 3 && over; ++e)
                over = a_.state->points.orient2d(Axis::z, seen_[r.second][e],
                                                 seen_[r.second][(e + 1) % 3], v) != Sign::Negative;
            if (!over) continue;
            const double height = dot(minus(corner(r.first, k), p), n) / n.z;
            report.largest_move = std::max(report.largest_move, std::fabs(height));
        }
    }
    return Done{};
}

Result<Set> Stacker::resolve(const Copy& copy) {
    if (const auto found = known_.find(copy); found != known_.end()) return found->second;
    const auto which = static_cast<std::uint32_t>(std::find(copies_.begin(), copies_.end(), copy) -
                                                  copies_.begin());
    Set own;
    for (std::uint32_t t = 0; t < a_.triangles.size(); ++t) {
        const auto surfaces = a_.surfaces_of[t];
        if (std::binary_search(surfaces.begin(), surfaces.end(), which)) own.push_back(t);
    }
    LayerReport* report = copy.steps == 0 ? &reports_[copy.layer] : nullptr;
    const auto apply = [&](const std::optional<std::size_t>& layer, int steps,
                           Side kept) -> Status {
        if (!layer) return Done{};
        const auto hard = resolve({*layer, steps});
        if (!hard) return hard.error();
        auto next = replace(own, hard.value(), kept, report);
        if (!next) return next.error();
        own = std::move(next).value();
        return Done{};
    };
    const auto& above = bounds_.above[copy.layer];
    const auto& below = bounds_.below[copy.layer];
    const int step = thick_ ? 1 : 0;
    if (const auto done = apply(above, copy.steps - step, Side::below); !done) return done.error();
    if (const auto done = apply(below, copy.steps + step, Side::above); !done) return done.error();
    if (thick_) // where both leave too little room
        if (const auto done = apply(above, copy.steps, Side::below); !done) return done.error();
    known_.emplace(copy, own);
    return own;
}

/// Which input triangles are used as a whole, so that none of their divisions need stay: walls, and
/// surfaces that were dropped, leave many.
class WholeTriangles {
public:
    WholeTriangles(const Arrangement& a, std::span<const Set> layers) : a_(a) {
        find_parts();
        for (const Set& layer : layers) strike_partly_used(layer);
        strike_divided(layers);
    }
    /// The input triangle instead of which the part stands; none where it stays itself.
    [[nodiscard]] std::optional<std::uint32_t> operator()(std::uint32_t part) const {
        const std::uint32_t t = whole_of_[part];
        return t != UINT32_MAX && is_whole_[t] ? std::optional(t) : std::nullopt;
    }

private:
    /// Per part the one input triangle it is of (of duplicates the first), if it is one.
    void find_parts() {
        whole_of_.assign(a_.triangles.size(), UINT32_MAX);
        parts_.assign(a_.state->corners.size(), {});
        is_whole_.assign(a_.state->corners.size(), true);
        for (std::uint32_t t = 0; t < a_.triangles.size(); ++t) {
            Set parents;
            for (const std::uint32_t p : a_.parents_of[t])
                parents.push_back(a_.inputs.first_same(p));
            sort_unique(parents);
            if (parents.size() == 1) whole_of_[t] = parents[0];
            for (const std::uint32_t p : parents) {
                parts_[p].push_back(t);
                if (parents.size() > 1) is_whole_[p] = false;
            }
        }
    }

    void strike_partly_used(const Set& layer) {
        std::vector<std::size_t> used(parts_.size(), 0);
        for (const std::uint32_t t : layer)
            if (whole_of_[t] != UINT32_MAX) ++used[whole_of_[t]];
        for (std::size_t p = 0; p < parts_.size(); ++p)
            if (used[p] > 0 && used[p] < parts_[p].size()) is_whole_[p] = false;
    }

    /// A triangle with a point on it that is a corner of parts beside it stays divided, too.
    void strike_divided(std::span<const Set> layers) {
        Set used;
        for (const Set& layer : layers) used.insert(used.end(), layer.begin(), layer.end());
        sort_unique(used);
        std::vector<bool> needed(a_.vertices.size(), false);
        for (bool changed = true; changed;) {
            changed = false;
            for (const std::uint32_t t : used)
                if (!(*this)(t))
                    for (const std::uint32_t v : a_.triangles[t]) needed[v] = true;
            for (const std::uint32_t t : used) {
                const auto whole = (*this)(t);
                if (!whole) continue;
                const Triangle& corners = a_.state->corners[*whole];
                for (const std::uint32_t v : a_.triangles[t]) {
                    const bool own =
                        std::find(corners.begin(), corners.end(), a_.vertices[v]) != corners.end();
                    if (own || !needed[v]) continue;
                    is_whole_[*whole] = false;
                    changed = true;
                }
            }
        }
    }

    const Arrangement& a_;
    Set whole_of_;               ///< per triangle of the arrangement
    std::vector<Set> parts_;     ///< per input triangle
    std::vector<bool> is_whole_; ///< per input triangle
};

/// A layer's triangles as a surface, points to the nearest doubles.
Surface surface_of(const Arrangement& a, const Set& triangles, const WholeTriangles& whole,
                   const Surface& original) {
    Surface s{original.name, original.role, {}, {}};
    std::map<PointIndex, std::uint32_t> name;
    const auto add = [&](const std::array<PointIndex, 3>& corners) {
        Triangle named{};
        for (unsigned k = 0; k < 3; ++k) {
            const auto [at, added] =
                name.try_emplace(corners[k], static_cast<std::uint32_t>(s.vertices.size()));
            if (added) s.vertices.push_back(a.state->points.nearest(corners[k]));
            named[k] = at->second;
        }
        s.triangles.push_back(named);
    };
    Set wholes;
    for (const std::uint32_t t : triangles) {
        const Triangle& c = a.triangles[t];
        if (const auto as = whole(t))
            wholes.push_back(*as);
        else
            add({a.vertices[c[0]], a.vertices[c[1]], a.vertices[c[2]]});
    }
    sort_unique(wholes);
    for (const std::uint32_t t : wholes) add(a.state->corners[t]);
    return s;
}

Status validate_order(std::span<const Surface> surfaces, std::span<const Layer> order,
                      const LayerOptions& options) {
    if (const auto valid = validate(surfaces); !valid) return valid.error();
    if (order.empty()) return Error{ErrorCode::nothing_to_do, "no layers", ""};
    std::vector<std::uint32_t> named;
    for (const Layer& l : order) {
        if (l.surface >= surfaces.size()) return bad("a layer names no surface");
        if (!std::isfinite(l.hardness)) return bad("a hardness is not finite");
        named.push_back(l.surface);
    }
    sort_unique(named);
    if (named.size() != order.size()) return bad("a surface is in the order twice");
    if (!(options.min_thickness >= 0) || !std::isfinite(options.min_thickness))
        return bad("the minimum thickness is a length");
    return Done{};
}

Result<Layered> stack_valid(std::span<const Surface> surfaces, std::span<const Layer> order,
                            const LayerOptions& options, const Run& run) {
    const auto progress = [&](double share) {
        if (run.progress) run.progress("layers", share);
    };
    const bool thick = options.min_thickness > 0;
    const Bounds bounds = bounds_of(order);
    const auto copies = copies_needed(bounds, thick);
    std::vector<Surface> all;
    for (const Copy& c : copies)
        all.push_back(moved_up(surfaces[order[c.layer].surface], c.steps * options.min_thickness));
    all.push_back(walls_on(all));
    const auto arrangement = arrange(all, {}, run);
    if (!arrangement) return arrangement.error();
    progress(0.4);
    Stacker stacker(order, bounds, copies, thick, arrangement.value(), run);
    if (const auto done = stacker.prepare(); !done) return done.error();
    std::vector<Set> sets;
    for (std::size_t i = 0; i < order.size(); ++i) {
        auto set = stacker.resolve({i, 0});
        if (!set) return set.error();
        sets.push_back(std::move(set).value());
        progress(0.4 + 0.3 * static_cast<double>(i + 1) / static_cast<double>(order.size()));
    }
    const WholeTriangles whole(arrangement.value(), sets);
    std::vector<Surface> stacked;
    for (std::size_t i = 0; i < order.size(); ++i)
        stacked.push_back(
            surface_of(arrangement.value(), sets[i], whole, surfaces[order[i].surface]));
    const auto exact = arrange(stacked, {}, run);
    if (!exact) return exact.error();
    auto rounded = round_to_doubles(exact.value(), {.max_rounds = options.max_rounds}, run);
    if (!rounded) return rounded.error();
    progress(1);
    return Layered{std::move(rounded).value(), stacker.reports()};
}

} // namespace

Result<Layered> stack_layers(std::span<const Surface> surfaces, std::span<const Layer> order,
                             const LayerOptions& options, const Run& run) {
    if (const auto good = validate_order(surfaces, order, options); !good) return good.error();
    return guarded("for the layers", "layers",
                   [&] { return stack_valid(surfaces, order, options, run); });
}

Result<Layered> harden(const Surface& hard, const Surface& soft, Keep keep,
                       const LayerOptions& options, const Run& run) {
    const std::array<Surface, 2> both{hard, soft};
    std::array<Layer, 2> order{Layer{1, 0}, Layer{0, 1}}; // the soft one on top
    if (keep == Keep::lower) std::swap(order[0], order[1]);
    return stack_layers(both, order, options, run);
}

} // namespace terrane
