// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/change_validator.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::improving {
namespace {

constexpr double cell_share = 1.5;   ///< of the mean edge: the smallest cells
constexpr double least_cosine = 0.2; ///< of the angle by which an added triangle may turn away

void widen(Box& box, const Box& by) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], by.low[k]);
        box.high[k] = std::max(box.high[k], by.high[k]);
    }
}

Sign turn_in(Axis axis, std::span<const Point3> points, const Triangle& t) {
    return orient2d(axis, points[t[0]], points[t[1]], points[t[2]]);
}

/// Whether a triangle and one that has one or two corners with it, numbered as those of it, are
/// shown to share no more: in a projection, a line through a common corner has them on its sides.
bool are_parted(const std::array<Point3, 6>& points, const Triangle& other) {
    const auto is_shared = [&](std::size_t i) { return other[i] < 3; };
    const auto count = is_shared(0) + is_shared(1) + is_shared(2);
    if (count != 1 && count != 2) return false;
    const Point3 n = cross(minus(points[1], points[0]), minus(points[2], points[0]));
    const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
    const Axis axis = z >= x && z >= y ? Axis::z : x >= y ? Axis::x : Axis::y;
    const auto turn = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        return orient2d(axis, points[i], points[j], points[k]);
    };
    const auto is_opposite = [](Sign a, Sign b) { return a != Sign::Zero && a == -b; };
    if (count == 2) {
        const std::size_t own = !is_shared(0) ? 0 : !is_shared(1) ? 1 : 2;
        const std::uint32_t a = other[(own + 1) % 3], b = other[(own + 2) % 3];
        return is_opposite(turn(a, b, 3 - a - b), turn(a, b, other[own]));
    }
    const std::size_t at = is_shared(0) ? 0 : is_shared(1) ? 1 : 2;
    const std::uint32_t v = other[at], r = other[(at + 1) % 3], s = other[(at + 2) % 3];
    const std::uint32_t p = (v + 1) % 3, q = (v + 2) % 3;
    const Sign pq = turn(v, p, q), pr = turn(v, p, r), ps = turn(v, p, s);
    if (pr == ps && is_opposite(pq, pr)) return true; // the line through v and p
    const Sign qr = turn(v, q, r), qs = turn(v, q, s);
    if (qr == qs && qr == pq && pq != Sign::Zero) return true;
    const Sign rs = turn(v, r, s);
    return (pr == qr && pr == rs && rs != Sign::Zero) || (ps == qs && is_opposite(ps, rs));
}

} // namespace

void ChangeValidator::group_again(const Run& run) {
    mesh_.compact();
    const EdgeSides edges = group_edges(mesh_.triangles, mesh_.points.size(), run);
    InjectivePatches patches =
        find_injective_patches(mesh_.points, mesh_.triangles, mesh_.sheet_of, edges, run);
    patch_of_ = std::move(patches.of);
    axis_ = std::move(patches.axis);
    turn_.assign(axis_.size(), Sign::Zero);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        const std::uint32_t p = patch_of_[t];
        if (p != no_group && turn_[p] == Sign::Zero)
            turn_[p] = turn_in(axis_[p], mesh_.points, mesh_.triangles[t]);
    }
    borders_.find(patch_of_, axis_.size());
    find_whole_sheets();
    fill_grid();
    ungrouped_ = 0;
}

void ChangeValidator::find_whole_sheets() {
    std::vector<std::uint32_t> patch_of_sheet;
    is_whole_.clear();
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        const std::uint32_t s = mesh_.sheet_of[t], p = patch_of_[t];
        if (s >= is_whole_.size()) {
            is_whole_.resize(s + 1, 1);
            patch_of_sheet.resize(s + 1, no_group);
        }
        if (patch_of_sheet[s] == no_group) patch_of_sheet[s] = p;
        if (p == no_group || p != patch_of_sheet[s]) is_whole_[s] = 0;
    }
}

void ChangeValidator::fill_grid() {
    // Long slivers are in the coarser cells; what comes is as long as is wanted.
    double edges = 0, wanted = 0;
    const auto count = static_cast<double>(mesh_.triangles.size());
    for (const Triangle& t : mesh_.triangles) {
        edges += mesh_.edge_length(t[0], t[1]);
        wanted += mesh_.wanted_length(t[0], t[1]);
    }
    grid_.reset(mesh_.points[mesh_.triangles[0][0]], cell_share * std::min(edges, wanted) / count);
    box_of_.resize(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        box_of_[t] = grid_.scaled(box_of(mesh_.points, mesh_.triangles[t]));
        if (!is_quiet(t)) grid_.enter(t, box_of_[t], patch_of_[t]);
    }
}

bool ChangeValidator::in_one_patch(std::span<const std::uint32_t> triangles) const {
    const std::uint32_t p = patch_of_[triangles[0]];
    return p != no_group && std::all_of(triangles.begin(), triangles.end(),
                                        [&](std::uint32_t t) { return patch_of_[t] == p; });
}

Corners ChangeValidator::corners_of(const Change& change, const Triangle& t) const {
    return {change.point(mesh_.points, t[0]), change.point(mesh_.points, t[1]),
            change.point(mesh_.points, t[2])};
}

/// How an added triangle is wound in the projection of a patch.
Sign ChangeValidator::turn_of(const Change& change, const Triangle& t, std::uint32_t patch) const {
    return turn_in(axis_[patch], corners_of(change, t), {0, 1, 2});
}

/// With area, facing as before; in a proven patch, wound as all of it.
bool ChangeValidator::shapes_hold(const Change& change, std::uint32_t patch) const {
    for (std::size_t i = 0; i < change.added.size(); ++i) {
        const Triangle& t = change.added[i];
        const auto [a, b, c] = corners_of(change, t);
        const Point3 n = cross(minus(b, a), minus(c, a));
        const std::uint32_t sheet = mesh_.sheet_of[change.from[i]];
        const auto facing =
            std::find_if(change.facing.begin(), change.facing.end(),
                         [&](const auto& of_sheet) { return of_sheet.first == sheet; });
        const Point3& f = facing->second;
        if (!(dot(n, f) > least_cosine * std::sqrt(dot(n, n) * dot(f, f)))) return false;
        if (patch != no_group) {
            if (turn_of(change, t, patch) != turn_[patch]) return false;
        } else if (collinear(a, b, c)) {
            return false;
        }
    }
    return true;
}

bool ChangeValidator::bounds_hold(const Change& change, CheckedChange& judgement,
                                  ThreadScratch& bench) const {
    judgement.hints.clear();
    judgement.alone.clear();
    for (std::size_t i = 0; i < change.added.size(); ++i) {
        const auto hint = reference_.contains_within_tolerance(
            corners_of(change, change.added[i]), mesh_.hint_of[change.from[i]], bench.search);
        if (!hint) return false;
        judgement.hints.push_back(hint->hint);
        judgement.alone.push_back(static_cast<char>(hint->alone));
    }
    return true;
}

void ChangeValidator::box_added(const Change& change, CheckedChange& judgement) const {
    judgement.boxes.clear();
    for (const Triangle& t : change.added)
        judgement.boxes.push_back(grid_.scaled(box_of(corners_of(change, t), {0, 1, 2})));
}

/// Whether the other triangle is strictly on one side of the plane of `t`, but for common corners:
/// then they share no more than the hull of those.
bool ChangeValidator::is_beside(const PlaneFilter& plane, const Triangle& t,
                                const Triangle& other) const {
    std::optional<Sign> common;
    for (const std::uint32_t v : other) {
        if (has(t, v)) continue;
        const auto side = plane.side(mesh_.points[v]);
        if (!side || (common && *common != *side)) return false;
        common = side;
    }
    return common.has_value();
}

/// Whether two triangles meet improperly after the change.
bool ChangeValidator::meet(const Change& change, const Triangle& t, const Triangle& other) const {
    std::array<Point3, 6> points;
    Triangle second{};
    for (std::size_t i = 0; i < 3; ++i) {
        points[i] = change.point(mesh_.points, t[i]);
        points[3 + i] = change.point(mesh_.points, other[i]);
        const auto shared = std::find(t.begin(), t.end(), other[i]);
        second[i] = static_cast<std::uint32_t>(shared == t.end() ? 3 + i : shared - t.begin());
    }
    return !are_parted(points, second) && improper_contact(points, {0, 1, 2}, second).has_value();
}

/// The cone from a corner of all added triangles over the removed ones, where they were.
void ChangeValidator::sweep(const Change& change, ThreadScratch& bench) const {
    bench.swept.clear();
    bench.not_swept.resize(mesh_.points.size() + 1, 0);
    const auto note = [&](const Triangle& t) {
        for (const std::uint32_t v : t) bench.not_swept[v] = bench.change;
    };
    for (const Triangle& t : change.added) note(t);
    std::uint32_t apex = change.in_place ? change.placed : none;
    for (const std::uint32_t v : change.added[0])
        if (apex == none && std::all_of(change.added.begin(), change.added.end(),
                                        [v](const Triangle& t) { return has(t, v); }))
            apex = v;
    if (apex == none) return; // no operation makes such changes
    bench.top = change.point(mesh_.points, apex);
    for (const std::uint32_t r : change.removed) {
        const Triangle& t = mesh_.triangles[r];
        note(t);
        if (!change.in_place && has(t, apex)) continue;
        std::array<Point3, 4> c{mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]],
                                bench.top};
        const Sign side = orient3d(c[0], c[1], c[2], c[3]);
        if (side == Sign::Zero) continue;
        if (side == Sign::Negative) std::swap(c[0], c[1]);
        Box box = box_of(c, Triangle{0, 1, 2});
        widen(box, box_of(c, Triangle{1, 2, 3}));
        bench.swept.push_back({c, box});
    }
}

/// Whether a corner that the change does not have is in what it sweeps, or at the place of its top:
/// pair tests take different vertices to be at different places.
bool ChangeValidator::is_swept(const Triangle& t, ThreadScratch& bench) const {
    for (const std::uint32_t v : t) {
        if (bench.not_swept[v] == bench.change) continue;
        bench.not_swept[v] = bench.change;
        const Point3& p = mesh_.points[v];
        if (p == bench.top) return true;
        for (const auto& [c, box] : bench.swept)
            if (box.overlaps({{p.x, p.y, p.z}, {p.x, p.y, p.z}}) &&
                orient3d(c[0], c[1], c[2], p) != Sign::Negative &&
                orient3d(c[0], c[3], c[1], p) != Sign::Negative &&
                orient3d(c[1], c[3], c[2], p) != Sign::Negative &&
                orient3d(c[2], c[3], c[0], p) != Sign::Negative)
                return true;
    }
    return false;
}

bool ChangeValidator::meets_properly(const Change& change, const CheckedChange& judgement,
                                     ThreadScratch& bench) const {
    ++bench.change;
    if (bench.change == 0) { // counted round
        std::fill(bench.seen.begin(), bench.seen.end(), 0);
        std::fill(bench.not_swept.begin(), bench.not_swept.end(), 0);
        ++bench.change;
    }
    bench.seen.resize(mesh_.triangles.size(), 0);
    for (const std::uint32_t t : change.removed) bench.seen[t] = bench.change;
    bench.planes.clear();
    for (const Triangle& t : change.added) {
        const auto [a, b, c] = corners_of(change, t);
        bench.planes.emplace_back(a, b, c);
    }
    sweep(change, bench);
    const auto& boxes = judgement.boxes;
    const auto& patches = judgement.patches;
    const auto are_shown = [&](std::size_t i, std::uint32_t patch) {
        return patches[i] != no_group && patches[i] == patch;
    };
    const auto proper = [&](std::uint32_t t, const GridBox& box) {
        if (bench.seen[t] == bench.change) return true;
        bench.seen[t] = bench.change;
        const Triangle& other = mesh_.triangles[t];
        if (is_swept(other, bench)) return false;
        for (std::size_t i = 0; i < change.added.size(); ++i)
            if (boxes[i].overlaps(box) && !are_shown(i, patch_of_[t]) &&
                !is_beside(bench.planes[i], change.added[i], other) &&
                meet(change, change.added[i], other))
                return false;
        return true;
    };
    if (!grid_.visit(judgement.reach.around, judgement.reach.patch, proper)) return false;
    for (std::size_t i = 0; i < change.added.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (boxes[i].overlaps(boxes[j]) && !are_shown(i, patches[j]) &&
                meet(change, change.added[i], change.added[j]))
                return false;
    return true;
}

/// All triangles are wound in the patch as it is.
bool ChangeValidator::are_wound(const Change& change, std::uint32_t patch) const {
    for (std::size_t i = 0; i < change.added.size(); ++i)
        if (patch_of_[change.from[i]] == patch &&
            turn_of(change, change.added[i], patch) != turn_[patch])
            return false;
    return true;
}

/// The patches of what is added: of the only one of what is removed; where a curve changes, of
/// those that are shown to stay what they are. False where a whole sheet would not stay one patch.
bool ChangeValidator::find_patches(const Change& change, CheckedChange& judgement,
                                   ThreadScratch& bench) const {
    std::vector<std::uint32_t>& patches = judgement.patches;
    patches.assign(change.added.size(), no_group);
    if (!change.on_border) {
        if (in_one_patch(change.removed))
            std::fill(patches.begin(), patches.end(), patch_of_[change.removed[0]]);
        return true;
    }
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const std::uint32_t p = patch_of_[change.from[i]];
        const auto is_his = [&](std::uint32_t t) { return patch_of_[t] == p; };
        const auto first = static_cast<std::size_t>(
            std::find_if(change.from.begin(), change.from.end(), is_his) - change.from.begin());
        if (p == no_group) continue;
        if (first < i)
            patches[i] = patches[first];
        else if (are_wound(change, p) &&
                 borders_.keeps(change, patch_of_, p, axis_[p], bench.border_search))
            patches[i] = p;
        else if (is_whole_[mesh_.sheet_of[change.from[i]]] != 0)
            return false;
    }
    return true;
}

/// Nothing that is added can meet anything else, by its patch and by what it follows.
bool ChangeValidator::is_free(const Change& change, const CheckedChange& judgement) const {
    for (std::size_t i = 0; i < change.added.size(); ++i)
        if (judgement.alone[i] == 0 || is_whole_[mesh_.sheet_of[change.from[i]]] == 0) return false;
    return true;
}

void ChangeValidator::find_reach(const Change& change, CheckedChange& judgement) const {
    Footprint& reach = judgement.reach;
    reach.around = judgement.boxes.front();
    for (const GridBox& b : judgement.boxes) reach.around.widen(b);
    for (const std::uint32_t r : change.removed) reach.around.widen(box_of_[r]);
    const auto& patches = judgement.patches;
    const bool is_one = std::all_of(patches.begin(), patches.end(),
                                    [&](std::uint32_t p) { return p == patches[0]; });
    reach.patch = is_one ? patches[0] : no_group;
    reach.borders.clear();
    if (change.on_border)
        for (const std::uint32_t r : change.removed) {
            const std::uint32_t p = patch_of_[r];
            const auto is_it = [p](const Footprint::Border& b) { return b.patch == p; };
            if (p != no_group && std::none_of(reach.borders.begin(), reach.borders.end(), is_it))
                reach.borders.push_back({p, axis_[p]});
        }
    reach.is_free = is_free(change, judgement);
}

Outcome ChangeValidator::verdict_on(const Change& change, CheckedChange& judgement,
                                    ThreadScratch& bench) {
    const bool in_one = !change.on_border && in_one_patch(change.removed);
    if (!shapes_hold(change, in_one ? patch_of_[change.removed[0]] : no_group))
        return Outcome::shape;
    if (!bounds_hold(change, judgement, bench)) return Outcome::deviation;
    box_added(change, judgement);
    if (!find_patches(change, judgement, bench)) return Outcome::contact;
    find_reach(change, judgement);
    if (!judgement.reach.is_free && !meets_properly(change, judgement, bench))
        return Outcome::contact;
    return Outcome::allowed;
}

Outcome ChangeValidator::check(const Change& change, CheckedChange& judgement) {
    ThreadScratch& bench = benches_.local();
    const Outcome verdict = verdict_on(change, judgement, bench);
    bench.refusals.shape += verdict == Outcome::shape;
    bench.refusals.deviation += verdict == Outcome::deviation;
    bench.refusals.contact += verdict == Outcome::contact;
    return verdict;
}

Refusals ChangeValidator::refusals() const {
    Refusals sum;
    for (const ThreadScratch& b : benches_) {
        sum.shape += b.refusals.shape;
        sum.deviation += b.refusals.deviation;
        sum.contact += b.refusals.contact;
    }
    return sum;
}

/// Before the mesh is changed.
void ChangeValidator::leave_patches(const Change& change, const CheckedChange& judgement) {
    if (!change.in_place)
        for (const std::uint32_t t : change.removed)
            if (!is_quiet(t)) grid_.leave(t, box_of_[t]);
    if (!change.on_border && judgement.patches[0] != no_group) return; // the border stays
    std::vector<std::uint32_t> done;
    for (const std::uint32_t t : change.removed) {
        const std::uint32_t p = patch_of_[t];
        if (p == no_group || std::find(done.begin(), done.end(), p) != done.end()) continue;
        done.push_back(p);
        const bool is_kept = std::find(judgement.patches.begin(), judgement.patches.end(), p) !=
                             judgement.patches.end();
        borders_.update(change, patch_of_, p, is_kept);
    }
}

void ChangeValidator::carry_out(const Change& change, const CheckedChange& judgement) {
    leave_patches(change, judgement);
    mesh_.apply(change, judgement.hints, numbers_);
    if (mesh_.triangles.size() > patch_of_.size()) {
        patch_of_.resize(mesh_.triangles.size(), no_group);
        box_of_.resize(mesh_.triangles.size());
    }
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const std::uint32_t t = numbers_[i], patch = judgement.patches[i];
        const GridBox& box = judgement.boxes[i];
        ungrouped_ += patch == no_group && patch_of_[t] != no_group;
        const bool was_there = change.in_place && !is_quiet(t);
        mesh_.alone[t] = judgement.alone[i];
        const bool is_there = !is_quiet(t);
        if (was_there && is_there && patch_of_[t] == patch) {
            grid_.move(t, box_of_[t], box, patch);
        } else {
            if (was_there) grid_.leave(t, box_of_[t]);
            if (is_there) grid_.enter(t, box, patch);
        }
        patch_of_[t] = patch;
        box_of_[t] = box;
    }
}

} // namespace terrane::improving
