// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Repairs few doubles that are in the way. The triangles near them are gathered in the first tile, which
// asks for more until it knows all that the repair depends on, and tells all tiles what has changed.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/rounding/repaired_part.hpp>
#include <terrane/algorithms/search/box_cover.hpp>
#include <terrane/algorithms/tiles/detail/edges.hpp>
#include <terrane/algorithms/tiles/detail/joints.hpp>
#include <terrane/algorithms/tiles/detail/over_tiles.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

namespace terrane::tiles {

using namespace detail;

namespace {

/// A point, to one who may not know it.
struct GatheredPoint {
    std::uint32_t name = 0;
    std::uint32_t number = 0; ///< among all vertices before the repair
    Point3 at{};
    double bound = 0; ///< of its distance from its exact place
};

/// A triangle of the result; its parents follow in a channel of their own.
struct GatheredTriangle {
    std::uint32_t id = 0, parents = 0;
    std::array<GatheredPoint, 3> corners{};
};

/// A parent of a triangle.
struct ParentOfTriangle {
    std::uint32_t id = 0;
    std::uint32_t first = 0; ///< the first input triangle with the same corners
};

/// The data of a tile besides the triangles that it sends.
struct Remainder {
    std::uint64_t triangles = 0;
    std::array<double, 3> largest{}; ///< absolute coordinate of their corners, per axis
};

/// A triangle that is in the place of another one, or, with no corners, the triangle that is replaced.
struct ChangedTriangle {
    std::uint32_t id = 0; ///< of the triangle that is replaced
    std::array<std::uint32_t, 3> corners{no_index, no_index, no_index};
    std::uint32_t parents = 0; ///< number of them

    [[nodiscard]] bool is_replaced() const { return corners[0] == no_index; }
};

Status send_unclean(Tile& b, Inbox&, Outbox& out) {
    for (const UncleanPoint& p : b.unclean_points) out.put(0, 0, p);
    return Done{};
}

GatheredPoint gathered_point(const Tile& b, std::uint32_t name) {
    return {name, vertex_number(b, name), doubles_of(b, name), bound_of(b, name)};
}

/// Channel 0: GatheredTriangle, for each that overlaps one of the boxes that came; channel 1:
/// ParentOfTriangle; channel 2: Remainder.
Status send_near(Tile& b, Inbox& in, Outbox& out) {
    const BoxCover asked(in.all<Box>(0));
    Remainder rest;
    for (std::uint32_t t = 0; t < b.triangles.size(); ++t) {
        const Box box = box_of({doubles_of(b, b.triangles[t][0]), doubles_of(b, b.triangles[t][1]),
                                doubles_of(b, b.triangles[t][2])});
        if (!asked.overlaps(box, b.work.near_boxes)) {
            ++rest.triangles;
            for (unsigned k = 0; k < 3; ++k)
                rest.largest[k] =
                    std::max({rest.largest[k], std::fabs(box.low[k]), std::fabs(box.high[k])});
            continue;
        }
        GatheredTriangle g{b.ids[t], static_cast<std::uint32_t>(b.parents_of[t].size()), {}};
        for (unsigned i = 0; i < 3; ++i) g.corners[i] = gathered_point(b, b.triangles[t][i]);
        out.put(0, 0, g);
        for (const std::uint32_t p : b.parents_of[t])
            out.put(0, 1, ParentOfTriangle{p, first_same(b, p)});
    }
    out.put(0, 2, rest);
    return Done{};
}

/// The triangles that the first tile has gathered, and their repair.
class Gathering {
public:
    Gathering(const TiledReport& report, const RepairInput& input) :
        report_(report), input_(input) {}

    /// Takes the unclean points. Channel 0: Box, to all.
    void begin(Inbox& in, Outbox& out) {
        in.take<UncleanPoint>(0, [&](std::uint32_t, const UncleanPoint& p) {
            unclean_.push_back(p.name);
            covered_.push_back({{p.at.x, p.at.y, p.at.z}, {p.at.x, p.at.y, p.at.z}});
        });
        sort_unique(unclean_);
        covered_ = united(std::move(covered_));
        send_boxes(out);
    }

    /// Takes triangles and repairs them. Sends boxes as above if something is missing.
    void advance(Tile& b, Inbox& in, Outbox& out, const Run& run) {
        take(in);
        is_waiting_ = false;
        has_all_ = triangles_.size() <= input_.most_gathered;
        if (!has_all_) return;
        repaired_ = repair_part(part(b), run);
        b.work.near_boxes += repaired_.compared;
        is_waiting_ = !repaired_.missing.empty();
        if (!is_waiting_) return;
        covered_.insert(covered_.end(), repaired_.missing.begin(), repaired_.missing.end());
        covered_ = united(std::move(covered_));
        send_boxes(out);
    }

    /// Sends what has changed, unless that may change joints: channel 0: GatheredPoint, those that moved, are
    /// new or are corners of changed triangles; channel 1: names of points that are gone; channel 2:
    /// ChangedTriangle; channel 3: ParentOfTriangle.
    void end(const Tile& b, const GivenCorners& corners, Outbox& out) {
        const PartOfDoubles before = part(b);
        std::map<std::uint32_t, Triangle> names;
        for (const auto& [id, c] : corners) names[id] = {c[0].id, c[1].id, c[2].id};
        repaired_.clean = !may_change_joints(before.triangles, before.parents_of,
                                             repaired_.triangles, repaired_.parents_of, names);
        has_all_ = repaired_.clean; // otherwise other attempts come first
        if (repaired_.clean) tell(b, out);
    }

    [[nodiscard]] bool is_waiting() const { return is_waiting_; }
    [[nodiscard]] bool has_all() const { return has_all_; }
    [[nodiscard]] RepairedPart& repaired() { return repaired_; }
    [[nodiscard]] std::size_t triangles() const { return triangles_.size(); }
    [[nodiscard]] std::vector<std::uint32_t> parents() const {
        std::vector<std::uint32_t> all;
        for (const ParentOfTriangle& p : parents_) all.push_back(p.id);
        sort_unique(all);
        return all;
    }

private:
    struct Gathered {
        GatheredTriangle triangle;
        std::size_t parents_at; ///< where its parents begin
    };

    void send_boxes(Outbox& out) const {
        for (const Box& box : covered_) out.put_to_all(0, box);
    }
    void take(Inbox& in);
    [[nodiscard]] PartOfDoubles part(const Tile& b) const;
    [[nodiscard]] std::uint32_t place_of(std::uint32_t name) const;
    [[nodiscard]] std::span<const ParentOfTriangle> parents_of(const Gathered& g) const {
        return std::span(parents_).subspan(g.parents_at, g.triangle.parents);
    }
    [[nodiscard]] bool is_unchanged(std::size_t old, std::size_t fresh) const;
    void tell(const Tile& b, Outbox& out) const;

    const TiledReport& report_;
    const RepairInput& input_;
    std::vector<std::uint32_t> unclean_; ///< names, ascending
    std::vector<Box> covered_;
    bool is_waiting_ = true, has_all_ = false;
    std::vector<Gathered> triangles_; ///< by id
    std::vector<ParentOfTriangle> parents_;
    std::vector<GatheredPoint> points_; ///< by name
    Remainder rest_;
    RepairedPart repaired_;
};

void Gathering::take(Inbox& in) {
    triangles_.clear();
    points_.clear();
    std::size_t parents_at = 0;
    in.take<GatheredTriangle>(0, [&](std::uint32_t, const GatheredTriangle& g) {
        triangles_.push_back({g, parents_at});
        parents_at += g.parents;
        points_.insert(points_.end(), g.corners.begin(), g.corners.end());
    });
    parents_ = in.all<ParentOfTriangle>(1);
    rest_ = {};
    in.take<Remainder>(2, [&](std::uint32_t, const Remainder& r) {
        rest_.triangles += r.triangles;
        for (unsigned k = 0; k < 3; ++k)
            rest_.largest[k] = std::max(rest_.largest[k], r.largest[k]);
    });
    std::sort(triangles_.begin(), triangles_.end(),
              [](const Gathered& g, const Gathered& h) { return g.triangle.id < h.triangle.id; });
    std::sort(points_.begin(), points_.end(),
              [](const auto& p, const auto& q) { return p.name < q.name; });
    const auto same = [](const auto& p, const auto& q) { return p.name == q.name; };
    points_.erase(std::unique(points_.begin(), points_.end(), same), points_.end());
}

std::uint32_t Gathering::place_of(std::uint32_t name) const {
    const auto found = std::lower_bound(points_.begin(), points_.end(), name,
                                        [](const auto& p, std::uint32_t n) { return p.name < n; });
    return static_cast<std::uint32_t>(found - points_.begin());
}

PartOfDoubles Gathering::part(const Tile& b) const {
    PartOfDoubles part;
    for (const GatheredPoint& p : points_) {
        part.input_vertices += p.name < b.vertex_total() ? 1 : 0;
        part.points.push_back(p.at);
        part.moves.push_back(p.bound);
    }
    std::vector<std::uint32_t> parents;
    for (const Gathered& g : triangles_) {
        Triangle& t = part.triangles.emplace_back();
        for (unsigned i = 0; i < 3; ++i) t[i] = place_of(g.triangle.corners[i].name);
        parents.clear();
        for (const ParentOfTriangle& p : parents_of(g)) parents.push_back(p.id);
        part.parents_of.push_back(parents);
    }
    for (const std::uint32_t name : unclean_) part.unclean.push_back(place_of(name));
    part.covered = covered_;
    part.triangles_elsewhere = rest_.triangles;
    part.largest_elsewhere = rest_.largest;
    part.largest_move = report_.deviation;
    part.limit = report_.limit;
    part.is_moved = input_.is_moved;
    part.used = input_.used;
    return part;
}

bool Gathering::is_unchanged(std::size_t old, std::size_t fresh) const {
    const Gathered& g = triangles_[old];
    for (unsigned i = 0; i < 3; ++i)
        if (repaired_.triangles[fresh][i] >= points_.size() ||
            points_[repaired_.triangles[fresh][i]].name != g.triangle.corners[i].name)
            return false;
    return std::ranges::equal(parents_of(g), repaired_.parents_of[fresh], {},
                              &ParentOfTriangle::id);
}

void Gathering::tell(const Tile& b, Outbox& out) const {
    std::vector<bool> is_used(repaired_.points.size(), false), is_told = is_used;
    for (const Triangle& t : repaired_.triangles)
        for (const std::uint32_t v : t) is_used[v] = true;
    std::vector<std::uint32_t> names(repaired_.points.size());
    std::uint32_t next = b.vertex_total() + b.constructed_total;
    for (std::size_t v = 0; v < names.size(); ++v) {
        const bool is_new = v >= points_.size();
        if (is_new) names[v] = is_used[v] ? next++ : no_index;
        if (!is_new) names[v] = points_[v].name;
        if (!is_used[v] && !is_new) out.put_to_all(1, names[v]);
        is_told[v] = is_used[v] && (is_new || repaired_.points[v] != points_[v].at ||
                                    repaired_.moves[v] != points_[v].bound);
    }
    std::map<std::uint32_t, std::uint32_t> first_of; // per parent
    for (const ParentOfTriangle& p : parents_) first_of[p.id] = p.first;
    for (std::size_t old = 0, begin = 0, end = 0; old < triangles_.size(); ++old, begin = end) {
        while (end < repaired_.origins.size() && repaired_.origins[end] == old) ++end;
        if (end == begin + 1 && is_unchanged(old, begin)) continue;
        const std::uint32_t id = triangles_[old].triangle.id;
        out.put_to_all(2, ChangedTriangle{.id = id});
        for (std::size_t fresh = begin; fresh < end; ++fresh) {
            const Triangle& t = repaired_.triangles[fresh];
            const auto parents = repaired_.parents_of[fresh];
            out.put_to_all(2, ChangedTriangle{id,
                                              {names[t[0]], names[t[1]], names[t[2]]},
                                              static_cast<std::uint32_t>(parents.size())});
            for (const std::uint32_t p : parents)
                out.put_to_all(3, ParentOfTriangle{p, first_of.at(p)});
            for (const std::uint32_t v : t) is_told[v] = true;
        }
    }
    for (std::size_t v = 0; v < names.size(); ++v)
        if (is_told[v])
            out.put_to_all(0, GatheredPoint{names[v],
                                            v < points_.size()
                                                ? points_[v].number
                                                : b.used_total + (names[v] - b.vertex_total()),
                                            repaired_.points[v], repaired_.moves[v]});
}

/// Puts changed triangles in the place of those that they replace, and numbers all anew.
class Replacement {
public:
    Replacement(Tile& b, Inbox& in) :
        b_(b), changed_(in.all<ChangedTriangle>(2)), parents_(in.all<ParentOfTriangle>(3)) {}

    void operator()() {
        const auto triangles = std::exchange(b_.triangles, {});
        const auto face_of = std::exchange(b_.face_of, {});
        const auto ids = std::exchange(b_.ids, {});
        const auto parents_of = std::exchange(b_.parents_of, {});
        const auto surfaces_of = std::exchange(b_.surfaces_of, {});
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            pass(ids[t]);
            if (next_ == changed_.size() || changed_[next_].id != ids[t]) {
                add(triangles[t], face_of[t], ids[t] + shift_, parents_of[t], surfaces_of[t]);
                continue;
            }
            std::uint32_t id = ids[t] + shift_;
            for (step(); next_ < changed_.size() && changed_[next_].id == ids[t]; step())
                add_changed(face_of[t], id++);
        }
        pass(no_index);
        b_.result_triangles += std::int64_t{static_cast<std::int32_t>(shift_)};
        sort_unique(b_.repeated);
    }

private:
    /// Goes on to the first change of a triangle with this number or a higher one.
    void pass(std::uint32_t id) {
        while (next_ < changed_.size() && changed_[next_].id < id) step();
    }
    void step() {
        shift_ += changed_[next_].is_replaced() ? UINT32_MAX : 1U; // UINT32_MAX is -1
        parents_at_ += changed_[next_++].parents;
    }
    void add(const Triangle& t, std::uint32_t face, std::uint32_t id,
             std::span<const std::uint32_t> parents, std::span<const std::uint32_t> surfaces) {
        b_.triangles.push_back(t);
        b_.face_of.push_back(face);
        b_.ids.push_back(id);
        b_.parents_of.push_back(parents);
        b_.surfaces_of.push_back(surfaces);
    }
    void add_changed(std::uint32_t face, std::uint32_t id) {
        const ChangedTriangle& c = changed_[next_];
        std::vector<std::uint32_t> parents, surfaces;
        for (const ParentOfTriangle& p : std::span(parents_).subspan(parents_at_, c.parents)) {
            parents.push_back(p.id);
            surfaces.push_back(surface_of(b_, p.id));
            if (p.first != p.id) b_.repeated.push_back({p.id, p.first});
        }
        sort_unique(surfaces);
        add(c.corners, face, id, parents, surfaces);
    }

    Tile& b_;
    const std::vector<ChangedTriangle> changed_;
    const std::vector<ParentOfTriangle> parents_;
    std::size_t next_ = 0, parents_at_ = 0;
    std::uint32_t shift_ = 0; ///< new triangles before the next change less replaced ones
};

/// Merges records into a list that is sorted by a member.
template <class Record, class Key>
void merge_sorted(std::vector<Record>& list, const std::vector<Record>& more, Key key) {
    const auto middle = static_cast<std::ptrdiff_t>(list.size());
    list.insert(list.end(), more.begin(), more.end());
    std::inplace_merge(list.begin(), list.begin() + middle, list.end(),
                       [&](const Record& r, const Record& s) { return r.*key < s.*key; });
}

/// Updates the points that this tile has, and adds those that its triangles have now. All of them count
/// as shared, in all tiles.
void take_points(Tile& b, const std::vector<GatheredPoint>& points) {
    std::vector<std::uint32_t> names;
    for (const Triangle& t : b.triangles) names.insert(names.end(), t.begin(), t.end());
    sort_unique(names);
    std::vector<UsedVertex> used;
    std::vector<OwnPoint> constructed;
    for (const GatheredPoint& p : points) {
        const bool has = std::binary_search(names.begin(), names.end(), p.name);
        if (p.name < b.vertex_total()) {
            const auto at = std::ranges::lower_bound(b.used, p.name, {}, &UsedVertex::id);
            if (at != b.used.end() && at->id == p.name) {
                at->at = p.at;
                at->shared = 1;
            } else if (has) {
                used.push_back({p.name, p.number, 1, 0, p.at});
            }
            continue;
        }
        const std::uint32_t number = p.name - b.vertex_total();
        const auto at = std::ranges::lower_bound(b.points, number, {}, &OwnPoint::number);
        if (at != b.points.end() && at->number == number) {
            at->nearest = p.at;
            at->bound = p.bound;
            at->shared = 1;
        } else if (has) {
            constructed.push_back({p.at, p.bound, number, 1, {}});
        }
    }
    merge_sorted(b.used, used, &UsedVertex::id);
    merge_sorted(b.points, constructed, &OwnPoint::number);
}

/// Takes what has changed, and begins to find edges and regions anew.
Status take_changes(Tile& b, Inbox& in, Outbox& out, double max_move) {
    const auto points = in.all<GatheredPoint>(0);
    b.removed = in.all<std::uint32_t>(1);
    const std::uint32_t first_new = b.vertex_total() + b.constructed_total;
    b.added = static_cast<std::uint32_t>(
        std::ranges::count_if(points, [&](const auto& p) { return p.name >= first_new; }));
    Replacement(b, in)();
    take_points(b, points);
    b.unclean = 0;
    release(b.unclean_points);
    b.deviation = max_move;
    b.edges = 0;
    b.wants_digest = false; // it is that of the exact triangles
    send_sides(b, out);
    return Done{};
}

/// The outcome that all processes learn from the first tile.
struct Outcome {
    bool is_waiting = false, has_all = false, is_clean = false;
    double max_move = 0;
    RepairInTiles summary;
};

Result<Outcome> outcome_of(Supersteps& tiles, Gathering& gathering) {
    return over_tiles<Outcome>(tiles, [&](Tile& b, Outcome& outcome) {
        if (b.index != 0) return;
        const RepairedPart& r = gathering.repaired();
        outcome = {gathering.is_waiting(),
                   gathering.has_all(),
                   r.clean,
                   r.max_move,
                   {r.naive_contacts, gathering.triangles(), r.rounds, r.surface_deviation}};
    });
}

/// Lets the first tile gather triangles until it knows what changes, or that it can't repair them.
/// in_contact: gets their parents then, in the process of the first tile.
Result<Outcome> gather_and_repair(Supersteps& tiles, const TiledReport& report,
                                  const RepairInput& input, ParentsInContact& in_contact,
                                  const Run& run) {
    Gathering gathering(report, input); // used in the process of the first tile
    const auto in_first = [&](const auto& work) {
        return tiles.step("repair", [&](Tile& b, Inbox& in, Outbox& out) -> Status {
            if (b.index == 0) work(b, in, out);
            return Done{};
        });
    };
    if (auto sent = tiles.step("repair", send_unclean); !sent) return sent.error();
    const auto begin = [&](Tile&, Inbox& in, Outbox& out) { gathering.begin(in, out); };
    if (auto begun = in_first(begin); !begun) return begun.error();
    const auto advance = [&](Tile& b, Inbox& in, Outbox& out) {
        gathering.advance(b, in, out, run);
    };
    while (true) {
        if (auto sent = tiles.step("repair", send_near); !sent) return sent.error();
        if (auto advanced = in_first(advance); !advanced) return advanced.error();
        auto outcome = outcome_of(tiles, gathering);
        if (!outcome) return outcome;
        if (outcome->is_waiting) continue;
        in_contact = std::move(gathering.repaired().in_contact);
        if (!outcome->is_clean) return outcome;
        GivenCorners corners;
        if (auto found = find_corners(tiles, gathering.parents(), corners); !found)
            return found.error();
        const auto end = [&](Tile& b, Inbox&, Outbox& out) { gathering.end(b, corners, out); };
        if (auto ended = in_first(end); !ended) return ended.error();
        return outcome_of(tiles, gathering);
    }
}

} // namespace

Result<RepairOfFew> detail::repair_few(Supersteps& tiles, TiledReport& report,
                                       const RepairInput& input, const Run& run) {
    RepairOfFew done;
    if (report.clean || report.contacts > input.most_gathered) return done;
    const auto outcome = gather_and_repair(tiles, report, input, done.in_contact, run);
    if (!outcome) return outcome.error();
    done.is_done = outcome->has_all;
    done.summary = outcome->summary;
    if (!outcome->is_clean) return done;
    const Step steps[] = {[&](Tile& b, Inbox& in, Outbox& out) {
                              return take_changes(b, in, out, outcome->max_move);
                          },
                          [](Tile&, Inbox& in, Outbox& out) -> Status {
                              decide_edges(in, out);
                              return Done{};
                          },
                          join_within,
                          join_across,
                          number_regions,
                          receive_regions};
    for (const Step& s : steps)
        if (auto passed = tiles.step("repair", s); !passed) return passed.error();
    auto after = summary_of(tiles);
    if (!after) return after.error();
    after->clean = true;
    after->limit = report.limit;
    after->digest = std::move(report.digest);
    after->repair = outcome->summary;
    report = std::move(*after);
    return done;
}

} // namespace terrane::tiles
