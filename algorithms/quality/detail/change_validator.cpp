// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/change_validator.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::quality::detail {
namespace {

constexpr double cell_share = 1.5; ///< size of the smallest cells, in mean edge lengths

void widen(Box& box, const Box& by) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], by.low[k]);
        box.high[k] = std::max(box.high[k], by.high[k]);
    }
}

Sign orientation_in(Axis axis, std::span<const Point3> points, const Triangle& t) {
    return orient2d(axis, points[t[0]], points[t[1]], points[t[2]]);
}

/// Tells whether two triangles are proven to share only their one or two common corners: in a
/// projection, a line through a common corner separates them. Corners of the second triangle are
/// indices of `points`, in which the first one comes first.
bool are_parted(const std::array<Point3, 6>& points, const Triangle& other) {
    const auto is_shared = [&](std::size_t i) { return other[i] < 3; };
    const auto count = is_shared(0) + is_shared(1) + is_shared(2);
    if (count != 1 && count != 2) return false;
    const Point3 n = cross(minus(points[1], points[0]), minus(points[2], points[0]));
    const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
    const Axis axis = z >= x && z >= y ? Axis::z : x >= y ? Axis::x : Axis::y;
    const auto orientation = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        return orient2d(axis, points[i], points[j], points[k]);
    };
    const auto is_opposite = [](Sign a, Sign b) { return a != Sign::Zero && a == -b; };
    if (count == 2) {
        const std::size_t own = !is_shared(0) ? 0 : !is_shared(1) ? 1 : 2;
        const std::uint32_t a = other[(own + 1) % 3], b = other[(own + 2) % 3];
        return is_opposite(orientation(a, b, 3 - a - b), orientation(a, b, other[own]));
    }
    const std::size_t at = is_shared(0) ? 0 : is_shared(1) ? 1 : 2;
    const std::uint32_t v = other[at], r = other[(at + 1) % 3], s = other[(at + 2) % 3];
    const std::uint32_t p = (v + 1) % 3, q = (v + 2) % 3;
    const Sign pq = orientation(v, p, q), pr = orientation(v, p, r), ps = orientation(v, p, s);
    if (pr == ps && is_opposite(pq, pr)) return true; // the line through v and p
    const Sign qr = orientation(v, q, r), qs = orientation(v, q, s);
    if (qr == qs && qr == pq && pq != Sign::Zero) return true;
    const Sign rs = orientation(v, r, s);
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
    orientation_.assign(axis_.size(), Sign::Zero);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        const std::uint32_t p = patch_of_[t];
        if (p != no_group && orientation_[p] == Sign::Zero)
            orientation_[p] = orientation_in(axis_[p], mesh_.points, mesh_.triangles[t]);
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
    // Long slivers go to the coarser cells; new edges have about the target length.
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
        if (!is_contact_free(t)) grid_.enter(t, box_of_[t], patch_of_[t]);
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

/// Computes the orientation of an added triangle in the projection of a patch.
Sign ChangeValidator::orientation_of(const Change& change, const Triangle& t,
                                     std::uint32_t patch) const {
    return orientation_in(axis_[patch], corners_of(change, t), {0, 1, 2});
}

/// Checks that added triangles are not worse than allowed, have area, do not turn away from those
/// they replace and, in an injective patch, keep its orientation.
bool ChangeValidator::shapes_hold(const Change& change, std::uint32_t patch) const {
    for (std::size_t i = 0; i < change.added.size(); ++i) {
        const Triangle& t = change.added[i];
        const auto [a, b, c] = corners_of(change, t);
        if (quality_of(a, b, c) < least_quality_.at(mesh_.hint_of[change.from[i]])) return false;
        const Point3 n = cross(minus(b, a), minus(c, a));
        const std::uint32_t sheet = mesh_.sheet_of[change.from[i]];
        const auto facing =
            std::find_if(change.facing.begin(), change.facing.end(),
                         [&](const auto& of_sheet) { return of_sheet.first == sheet; });
        const Point3& f = facing->second;
        if (!(dot(n, f) > constants.least_normal_cosine * std::sqrt(dot(n, n) * dot(f, f))))
            return false;
        if (patch != no_group) {
            if (orientation_of(change, t, patch) != orientation_[patch]) return false;
        } else if (collinear(a, b, c)) {
            return false;
        }
    }
    return true;
}

bool ChangeValidator::bounds_hold(const Change& change, CheckedChange& checked,
                                  ThreadScratch& scratch) const {
    checked.hints.clear();
    checked.isolated.clear();
    for (std::size_t i = 0; i < change.added.size(); ++i) {
        const auto hint = reference_.contains_within_tolerance(
            corners_of(change, change.added[i]), mesh_.hint_of[change.from[i]], scratch.search);
        if (!hint) return false;
        checked.hints.push_back(hint->hint);
        checked.isolated.push_back(static_cast<char>(hint->isolated));
    }
    return true;
}

void ChangeValidator::box_added(const Change& change, CheckedChange& checked) const {
    checked.boxes.clear();
    for (const Triangle& t : change.added)
        checked.boxes.push_back(grid_.scaled(box_of(corners_of(change, t), {0, 1, 2})));
}

/// Tells whether the other triangle, except for common corners, is strictly on one side of the
/// plane of `t`. The two then share no more than the hull of these corners.
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

/// Tells whether two triangles meet improperly after the change.
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

/// Finds the swept tetrahedra: those over the removed triangles from the corner that all added
/// triangles share.
void ChangeValidator::sweep(const Change& change, ThreadScratch& scratch) const {
    scratch.swept.clear();
    scratch.not_swept.resize(mesh_.points.size() + 1, 0);
    const auto note = [&](const Triangle& t) {
        for (const std::uint32_t v : t) scratch.not_swept[v] = scratch.change;
    };
    for (const Triangle& t : change.added) note(t);
    std::uint32_t apex = change.in_place ? change.placed : none;
    for (const std::uint32_t v : change.added[0])
        if (apex == none && std::all_of(change.added.begin(), change.added.end(),
                                        [v](const Triangle& t) { return has(t, v); }))
            apex = v;
    if (apex == none) return; // no operation makes such changes
    scratch.top = change.point(mesh_.points, apex);
    for (const std::uint32_t r : change.removed) {
        const Triangle& t = mesh_.triangles[r];
        note(t);
        if (!change.in_place && has(t, apex)) continue;
        std::array<Point3, 4> c{mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]],
                                scratch.top};
        const Sign side = orient3d(c[0], c[1], c[2], c[3]);
        if (side == Sign::Zero) continue;
        if (side == Sign::Negative) std::swap(c[0], c[1]);
        Box box = box_of(c, Triangle{0, 1, 2});
        widen(box, box_of(c, Triangle{1, 2, 3}));
        scratch.swept.push_back({c, box});
    }
}

/// Tells whether a corner of t outside of the change lies in a swept tetrahedron or coincides with
/// the apex: pair tests assume that different vertices have different positions.
bool ChangeValidator::is_swept(const Triangle& t, ThreadScratch& scratch) const {
    for (const std::uint32_t v : t) {
        if (scratch.not_swept[v] == scratch.change) continue;
        scratch.not_swept[v] = scratch.change;
        const Point3& p = mesh_.points[v];
        if (p == scratch.top) return true;
        for (const auto& [c, box] : scratch.swept)
            if (box.overlaps({{p.x, p.y, p.z}, {p.x, p.y, p.z}}) &&
                orient3d(c[0], c[1], c[2], p) != Sign::Negative &&
                orient3d(c[0], c[3], c[1], p) != Sign::Negative &&
                orient3d(c[1], c[3], c[2], p) != Sign::Negative &&
                orient3d(c[2], c[3], c[0], p) != Sign::Negative)
                return true;
    }
    return false;
}

bool ChangeValidator::meets_properly(const Change& change, const CheckedChange& checked,
                                     ThreadScratch& scratch) const {
    ++scratch.change;
    if (scratch.change == 0) { // overflow
        std::fill(scratch.seen.begin(), scratch.seen.end(), 0);
        std::fill(scratch.not_swept.begin(), scratch.not_swept.end(), 0);
        ++scratch.change;
    }
    scratch.seen.resize(mesh_.triangles.size(), 0);
    for (const std::uint32_t t : change.removed) scratch.seen[t] = scratch.change;
    scratch.planes.clear();
    for (const Triangle& t : change.added) {
        const auto [a, b, c] = corners_of(change, t);
        scratch.planes.emplace_back(a, b, c);
    }
    sweep(change, scratch);
    const auto& boxes = checked.boxes;
    const auto& patches = checked.patches;
    const auto are_shown = [&](std::size_t i, std::uint32_t patch) {
        return patches[i] != no_group && patches[i] == patch;
    };
    const auto proper = [&](std::uint32_t t, const GridBox& box) {
        if (scratch.seen[t] == scratch.change) return true;
        scratch.seen[t] = scratch.change;
        const Triangle& other = mesh_.triangles[t];
        if (is_swept(other, scratch)) return false;
        for (std::size_t i = 0; i < change.added.size(); ++i)
            if (boxes[i].overlaps(box) && !are_shown(i, patch_of_[t]) &&
                !is_beside(scratch.planes[i], change.added[i], other) &&
                meet(change, change.added[i], other))
                return false;
        return true;
    };
    if (!grid_.visit(checked.footprint.around, checked.footprint.patch, proper)) return false;
    for (std::size_t i = 0; i < change.added.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (boxes[i].overlaps(boxes[j]) && !are_shown(i, patches[j]) &&
                meet(change, change.added[i], change.added[j]))
                return false;
    return true;
}

/// Tells whether all added triangles have the orientation of the patch.
bool ChangeValidator::keeps_orientation(const Change& change, std::uint32_t patch) const {
    for (std::size_t i = 0; i < change.added.size(); ++i)
        if (patch_of_[change.from[i]] == patch &&
            orientation_of(change, change.added[i], patch) != orientation_[patch])
            return false;
    return true;
}

/// Finds the patches of the added triangles: the only patch of the removed ones or, if a curve
/// changes, those proven to stay injective. Returns false if a sheet that is one patch would not
/// remain so.
bool ChangeValidator::find_patches(const Change& change, CheckedChange& checked,
                                   ThreadScratch& scratch) const {
    std::vector<std::uint32_t>& patches = checked.patches;
    patches.assign(change.added.size(), no_group);
    if (!change.on_border) {
        if (in_one_patch(change.removed))
            std::fill(patches.begin(), patches.end(), patch_of_[change.removed[0]]);
        return true;
    }
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const std::uint32_t p = patch_of_[change.from[i]];
        const auto is_of_patch = [&](std::uint32_t t) { return patch_of_[t] == p; };
        const auto first = static_cast<std::size_t>(
            std::find_if(change.from.begin(), change.from.end(), is_of_patch) -
            change.from.begin());
        if (p == no_group) continue;
        if (first < i)
            patches[i] = patches[first];
        else if (keeps_orientation(change, p) &&
                 borders_.keeps(change, patch_of_, p, axis_[p], scratch.border_search))
            patches[i] = p;
        else if (is_whole_[mesh_.sheet_of[change.from[i]]] != 0)
            return false;
    }
    return true;
}

/// Tells whether no added triangle can meet others, by patches and isolation.
bool ChangeValidator::is_contact_free(const Change& change, const CheckedChange& checked) const {
    for (std::size_t i = 0; i < change.added.size(); ++i)
        if (checked.isolated[i] == 0 || is_whole_[mesh_.sheet_of[change.from[i]]] == 0)
            return false;
    return true;
}

void ChangeValidator::find_footprint(const Change& change, CheckedChange& checked) const {
    Footprint& footprint = checked.footprint;
    footprint.around = checked.boxes.front();
    for (const GridBox& b : checked.boxes) footprint.around.widen(b);
    for (const std::uint32_t r : change.removed) footprint.around.widen(box_of_[r]);
    const auto& patches = checked.patches;
    const bool is_one = std::all_of(patches.begin(), patches.end(),
                                    [&](std::uint32_t p) { return p == patches[0]; });
    footprint.patch = is_one ? patches[0] : no_group;
    footprint.borders.clear();
    if (change.on_border)
        for (const std::uint32_t r : change.removed) {
            const std::uint32_t p = patch_of_[r];
            const auto is_it = [p](const Footprint::Border& b) { return b.patch == p; };
            if (p != no_group &&
                std::none_of(footprint.borders.begin(), footprint.borders.end(), is_it))
                footprint.borders.push_back({p, axis_[p]});
        }
    footprint.is_contact_free = is_contact_free(change, checked);
}

Outcome ChangeValidator::check_with(const Change& change, CheckedChange& checked,
                                    ThreadScratch& scratch) {
    const bool in_one = !change.on_border && in_one_patch(change.removed);
    if (!shapes_hold(change, in_one ? patch_of_[change.removed[0]] : no_group))
        return Outcome::shape;
    if (!bounds_hold(change, checked, scratch)) return Outcome::deviation;
    box_added(change, checked);
    if (!find_patches(change, checked, scratch)) return Outcome::contact;
    find_footprint(change, checked);
    if (!checked.footprint.is_contact_free && !meets_properly(change, checked, scratch))
        return Outcome::contact;
    return Outcome::allowed;
}

Outcome ChangeValidator::check(const Change& change, CheckedChange& checked) {
    ThreadScratch& scratch = scratches_.local();
    const Outcome outcome = check_with(change, checked, scratch);
    scratch.refusals.shape += outcome == Outcome::shape;
    scratch.refusals.deviation += outcome == Outcome::deviation;
    scratch.refusals.contact += outcome == Outcome::contact;
    return outcome;
}

Refusals ChangeValidator::refusals() const {
    Refusals sum;
    for (const ThreadScratch& b : scratches_) {
        sum.shape += b.refusals.shape;
        sum.deviation += b.refusals.deviation;
        sum.contact += b.refusals.contact;
    }
    return sum;
}

/// Removes the old triangles from grid and patches; must be called before the mesh changes.
void ChangeValidator::leave_patches(const Change& change, const CheckedChange& checked) {
    if (!change.in_place)
        for (const std::uint32_t t : change.removed)
            if (!is_contact_free(t)) grid_.leave(t, box_of_[t]);
    if (!change.on_border && checked.patches[0] != no_group) return; // the border does not change
    std::vector<std::uint32_t> done;
    for (const std::uint32_t t : change.removed) {
        const std::uint32_t p = patch_of_[t];
        if (p == no_group || std::find(done.begin(), done.end(), p) != done.end()) continue;
        done.push_back(p);
        const bool is_kept =
            std::find(checked.patches.begin(), checked.patches.end(), p) != checked.patches.end();
        borders_.update(change, patch_of_, p, is_kept);
    }
}

void ChangeValidator::carry_out(const Change& change, const CheckedChange& checked) {
    leave_patches(change, checked);
    mesh_.apply(change, checked.hints, numbers_);
    if (mesh_.triangles.size() > patch_of_.size()) {
        patch_of_.resize(mesh_.triangles.size(), no_group);
        box_of_.resize(mesh_.triangles.size());
    }
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const std::uint32_t t = numbers_[i], patch = checked.patches[i];
        const GridBox& box = checked.boxes[i];
        ungrouped_ += patch == no_group && patch_of_[t] != no_group;
        const bool was_there = change.in_place && !is_contact_free(t);
        mesh_.isolated[t] = checked.isolated[i];
        const bool is_there = !is_contact_free(t);
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

} // namespace terrane::quality::detail
