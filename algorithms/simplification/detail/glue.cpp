// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/glue.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/simplification/detail/contacts.hpp>
#include <terrane/algorithms/simplification/detail/features.hpp>
#include <terrane/algorithms/simplification/detail/folds.hpp>
#include <terrane/algorithms/simplification/detail/tuning.hpp>

namespace terrane::simplification::detail {
namespace {

using Kind = CurveNetwork::Kind;

double way_between(const Point3& a, const Point3& b) {
    return length(minus(b, a));
}

class Gluer {
public:
    Gluer(Complex& complex, const GlueOptions& options, const Run& run) :
        complex_(complex), options_(options), run_(run) {}

    GlueReport operator()() {
        std::vector<std::uint32_t> active(complex_.cells().size());
        std::iota(active.begin(), active.end(), 0U);
        unsigned pass = 0;
        while (!active.empty() && pass++ < tuning.passes && !stopped()) {
            touched_.assign(complex_.points().size(), false);
            curves_ = find_curves(complex_);
            const Found found = find_contacts(complex_, curves_, options_.resolution, active, run_);
            for (const std::uint32_t t : by_length(found.to_divide)) divide(t);
            for (const NearPlaces& c : found.contacts)
                if (!is_touched(c) && !meeting_of(c).second) join(c);
            active = touched_cells();
        }
        report_.is_complete = active.empty();
        list_what_is_left();
        remove_folds(complex_, options_.max_move);
        return std::move(report_);
    }

private:
    [[nodiscard]] bool stopped() const { return run_.stop.stop_requested(); }

    [[nodiscard]] std::array<std::uint32_t, 2> longest_edge(std::uint32_t t) const {
        const Triangle& c = complex_.cells()[t].corners;
        std::array<std::uint32_t, 2> best{};
        double longest = -1;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = std::min(c[i], c[(i + 1) % 3]);
            const std::uint32_t b = std::max(c[i], c[(i + 1) % 3]);
            const double l = way_between(complex_.points()[a], complex_.points()[b]);
            if (l < longest || (l == longest && std::array{a, b} > best)) continue;
            longest = l;
            best = {a, b};
        }
        return best;
    }

    [[nodiscard]] std::vector<std::uint32_t> by_length(std::vector<std::uint32_t> cells) const {
        std::vector<std::pair<double, std::uint32_t>> order;
        for (const std::uint32_t t : cells) {
            const auto [a, b] = longest_edge(t);
            order.emplace_back(-way_between(complex_.points()[a], complex_.points()[b]), t);
        }
        std::sort(order.begin(), order.end());
        std::transform(order.begin(), order.end(), cells.begin(),
                       [](const auto& o) { return o.second; });
        return cells;
    }

    void touch_around(std::uint32_t v) {
        touched_.resize(complex_.points().size(), true);
        for (const std::uint32_t t : complex_.star(v))
            for (const std::uint32_t w : complex_.cells()[t].corners) touched_[w] = true;
        touched_[v] = true;
    }

    [[nodiscard]] bool is_touched(const NearPlaces& c) const {
        const auto one = [&](std::uint32_t v) { return touched_[v]; };
        const auto from = c.from.vertices(), to = c.to.vertices();
        return std::any_of(from.begin(), from.end(), one) || std::any_of(to.begin(), to.end(), one);
    }

    [[nodiscard]] std::vector<std::uint32_t> touched_cells() const {
        std::vector<std::uint32_t> cells;
        for (std::uint32_t t = 0; t < complex_.cells().size(); ++t) {
            const Triangle& c = complex_.cells()[t].corners;
            if (complex_.has(t) && (touched_[c[0]] || touched_[c[1]] || touched_[c[2]]))
                cells.push_back(t);
        }
        return cells;
    }

    void divide(std::uint32_t t) {
        if (!complex_.has(t)) return;
        const auto [a, b] = longest_edge(t);
        if (way_between(complex_.points()[a], complex_.points()[b]) <=
            tuning.longest_edge * options_.resolution)
            return;
        ++report_.divided;
        touch_around(complex_.split_edge(a, b, 0.5));
    }

    [[nodiscard]] Kind kind_of(const Place& p) const {
        if (p.size == 1) return curves_.kind_of[p.corners[0]];
        return p.size == 2 && curves_.has(p.corners[0], p.corners[1]) ? Kind::curve : Kind::inner;
    }

    [[nodiscard]] PlacedVertex vertex_at(const Place& p) const {
        return complex_.between(p.vertices(), p.shares());
    }

    /// Puts the coordinates that either place may not change into `place`. Fails if they differ.
    [[nodiscard]] static bool obeys(const PlacedVertex& v, const PlacedVertex& w, Point3& place) {
        if (v.freedom.is_pinned && w.freedom.is_pinned) return v.place == w.place;
        double* const at[] = {&place.x, &place.y, &place.z}; // NOLINT: one for each axis
        for (unsigned axis = 0; axis < 3; ++axis) {
            const bool first = v.freedom.is_fixed(axis), second = w.freedom.is_fixed(axis);
            if (first && second && coordinate(v.place, axis) != coordinate(w.place, axis))
                return false;
            if (first) *at[axis] = coordinate(v.place, axis);
            if (second) *at[axis] = coordinate(w.place, axis);
        }
        return (!v.freedom.is_pinned || place == v.place) &&
               (!w.freedom.is_pinned || place == w.place);
    }

    /// Returns the places to try, the best one first.
    [[nodiscard]] std::array<Point3, 3> choices(const NearPlaces& c, const PlacedVertex& v,
                                                const PlacedVertex& w) const {
        const Point3 &p = v.place, &q = w.place;
        // Between where the points of both were, not between where they have come to: then both
        // sides move alike, and as little as they can.
        Past past = v.past;
        past.unite(w.past);
        const Point3 middle = past.middle();
        const Kind a = kind_of(c.from), b = kind_of(c.to);
        const bool first_stays = v.freedom.is_pinned || (!w.freedom.is_pinned && a < b);
        const bool second_stays = w.freedom.is_pinned || (!v.freedom.is_pinned && b < a);
        if (first_stays) return {p, middle, q};
        if (second_stays) return {q, middle, p};
        return {middle, p < q ? p : q, p < q ? q : p};
    }

    /// Finds where the places of a contact meet, or why they do not.
    [[nodiscard]] std::pair<Point3, std::optional<LeftReason>>
    meeting_of(const NearPlaces& c) const {
        if (is_locked(c)) return {{}, LeftReason::block};
        for (const Place* p : {&c.from, &c.to})
            if (p->size == 1 && p->corners[0] < joined_.size() &&
                joined_[p->corners[0]] >= tuning.joins)
                return {{}, LeftReason::limit};
        const PlacedVertex v = vertex_at(c.from), w = vertex_at(c.to);
        std::optional<LeftReason> reason;
        for (Point3 place : choices(c, v, w)) {
            if (!obeys(v, w, place)) {
                if (!reason) reason = LeftReason::boundary;
                continue;
            }
            Past past = v.past;
            past.unite(w.past);
            if (past.reach(place) > options_.max_move) {
                reason = reason.value_or(LeftReason::move);
                continue;
            }
            if (turns_over(c.from, c.to, v.place, place) ||
                turns_over(c.to, c.from, w.place, place)) {
                reason = reason.value_or(LeftReason::fold);
                continue;
            }
            return {place, std::nullopt};
        }
        return {{}, reason};
    }

    /// Tells whether a triangle at a place would turn over if that went from `before` to `after`.
    [[nodiscard]] bool turns_over(const Place& place, const Place& other, const Point3& before,
                                  const Point3& after) const {
        for (const std::uint32_t t : complex_.star(place.corners[0])) {
            const Triangle& c = complex_.cells()[t].corners;
            const auto has = [&](std::uint32_t v) { return contains(c, v); };
            const auto at = place.vertices(), to = other.vertices();
            if (!std::all_of(at.begin(), at.end(), has)) continue;
            if (std::all_of(to.begin(), to.end(), has)) continue; // it goes
            for (const std::uint32_t moving : at)
                if (is_turned(c, moving, before, after)) return true;
        }
        return false;
    }

    [[nodiscard]] bool is_turned(const Triangle& c, std::uint32_t moving, const Point3& before,
                                 const Point3& after) const {
        std::array<Point3, 3> p{}, q{};
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = c[i] == moving ? before : complex_.points()[c[i]];
            q[i] = c[i] == moving ? after : p[i];
        }
        const Point3 m = cross(minus(p[1], p[0]), minus(p[2], p[0]));
        const Point3 n = cross(minus(q[1], q[0]), minus(q[2], q[0]));
        const double longest =
            std::max({way_between(p[0], p[1]), way_between(p[1], p[2]), way_between(p[2], p[0])});
        if (length(m) < tuning.narrow * options_.resolution * longest) return false;
        return dot(m, n) < tuning.fold_cosine * length(m) * length(n);
    }

    /// Tells whether both places are at a locked block.
    [[nodiscard]] bool is_locked(const NearPlaces& c) const {
        if (options_.locked.empty()) return false;
        const auto from = locked_blocks(c.from), to = locked_blocks(c.to);
        return std::any_of(from.begin(), from.end(), [&](std::uint32_t b) {
            return std::find(to.begin(), to.end(), b) != to.end();
        });
    }

    [[nodiscard]] std::vector<std::uint32_t> locked_blocks(const Place& place) const {
        std::vector<std::uint32_t> blocks;
        for (const std::uint32_t v : place.vertices())
            for (const std::uint32_t t : complex_.star(v))
                for (const CellLayer& layer : complex_.cells()[t].layers)
                    for (const std::uint32_t b : options_.sides_of[layer.origin])
                        if (options_.locked[b]) blocks.push_back(b);
        return blocks;
    }

    std::uint32_t made_vertex(const Place& p) {
        if (p.size == 1) return p.corners[0];
        if (p.size == 2) return complex_.split_edge(p.corners[0], p.corners[1], p.weights[1]);
        for (const std::uint32_t t : complex_.star(p.corners[0])) {
            const Triangle& c = complex_.cells()[t].corners;
            if (!contains(c, p.corners[1]) || !contains(c, p.corners[2])) continue;
            std::array<double, 3> weights{};
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    if (c[i] == p.corners[j]) weights[i] = p.weights[j];
            return complex_.split_cell(t, weights);
        }
        return none;
    }

    void join(const NearPlaces& c) {
        const Point3 meeting = meeting_of(c).first;
        const Kind a = kind_of(c.from), b = kind_of(c.to);
        const bool both_corners = a == Kind::corner && b == Kind::corner;
        ++(both_corners                           ? report_.corners
           : a != Kind::inner && b != Kind::inner ? report_.curves
                                                  : report_.sheets);
        const std::uint32_t v = made_vertex(c.from), w = made_vertex(c.to);
        touch_around(v);
        touch_around(w);
        complex_.merge(std::max(v, w), std::min(v, w), meeting);
        touch_around(std::min(v, w));
        joined_.resize(complex_.points().size());
        joined_[std::min(v, w)] += 1 + joined_[std::max(v, w)];
    }

    /// Lists the contacts that remain.
    void list_what_is_left() {
        if (stopped()) return;
        std::vector<std::uint32_t> all(complex_.cells().size());
        std::iota(all.begin(), all.end(), 0U);
        curves_ = find_curves(complex_);
        for (const NearPlaces& c :
             find_contacts(complex_, curves_, options_.resolution, all, run_).contacts)
            report_.left.push_back({meeting_of(c).second.value_or(LeftReason::limit),
                                    vertex_at(c.from).place, c.distance});
    }

    Complex& complex_;
    const GlueOptions& options_;
    const Run& run_;
    CurveNetwork curves_;
    std::vector<bool> touched_;    ///< per vertex: changed in this pass
    std::vector<unsigned> joined_; ///< per vertex: times that it was joined with another
    GlueReport report_;
};

} // namespace

GlueReport glue(Complex& complex, const GlueOptions& options, const Run& run) {
    return Gluer(complex, options, run)();
}

} // namespace terrane::simplification::detail
