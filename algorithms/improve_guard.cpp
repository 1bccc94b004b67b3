// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/improve_guard.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/edges.hpp>
#include <terrane/algorithms/intersection.hpp>
#include <terrane/algorithms/patches.hpp>
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

} // namespace

void Guard::group_again(const Run& run) {
    mesh_.compact();
    const EdgeSides edges = group_edges(mesh_.triangles, mesh_.points.size(), run);
    Patches patches = prove_patches(mesh_.points, mesh_.triangles, mesh_.sheet_of, edges, run);
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
    seen_.assign(mesh_.triangles.size(), 0);
    its_corners_.assign(mesh_.points.size(), 0);
    change_ = 0;
    ungrouped_ = 0;
}

void Guard::find_whole_sheets() {
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

void Guard::fill_grid() {
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

bool Guard::in_one_patch(std::span<const std::uint32_t> triangles) const {
    const std::uint32_t p = patch_of_[triangles[0]];
    return p != no_group && std::all_of(triangles.begin(), triangles.end(),
                                        [&](std::uint32_t t) { return patch_of_[t] == p; });
}

/// With area, facing as before; in a proven patch, wound as all of it.
bool Guard::shapes_hold(const Change& change, std::uint32_t patch) const {
    for (std::size_t i = 0; i < change.added.size(); ++i) {
        const Triangle& t = change.added[i];
        const Point3 n = mesh_.normal(t);
        const std::uint32_t sheet = mesh_.sheet_of[change.from[i]];
        const auto facing =
            std::find_if(change.facing.begin(), change.facing.end(),
                         [&](const auto& of_sheet) { return of_sheet.first == sheet; });
        const Point3& f = facing->second;
        if (!(dot(n, f) > least_cosine * std::sqrt(dot(n, n) * dot(f, f)))) return false;
        if (patch != no_group) {
            if (turn_in(axis_[patch], mesh_.points, t) != turn_[patch]) return false;
        } else if (collinear(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]])) {
            return false;
        }
    }
    return true;
}

bool Guard::bounds_hold(const Change& change) {
    hints_.clear();
    alone_.clear();
    for (std::size_t i = 0; i < change.added.size(); ++i) {
        const Triangle& t = change.added[i];
        const std::uint32_t source = change.from[i];
        const auto hint = reference_.follows(
            {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]}, mesh_.hint_of[source]);
        if (!hint) return false;
        hints_.push_back(hint->hint);
        alone_.push_back(static_cast<char>(hint->alone));
    }
    return true;
}

void Guard::box_added(const Change& change) {
    boxes_.clear();
    for (const Triangle& t : change.added) boxes_.push_back(grid_.scaled(box_of(mesh_.points, t)));
}

/// Whether the other triangle is strictly on one side of the plane of `t`, but for common corners:
/// then they share no more than the hull of those.
bool Guard::is_beside(const QuickPlane& plane, const Triangle& t, const Triangle& other) const {
    std::optional<Sign> common;
    for (const std::uint32_t v : other) {
        if (has(t, v)) continue;
        const auto side = plane.side(mesh_.points[v]);
        if (!side || (common && *common != *side)) return false;
        common = side;
    }
    return common.has_value();
}

/// The cone from a corner of all added triangles over the removed ones, where they were.
void Guard::sweep(const Change& change) {
    swept_.clear();
    its_corners_.resize(mesh_.points.size(), 0);
    for (const Triangle& t : change.added)
        for (const std::uint32_t v : t) its_corners_[v] = change_;
    std::uint32_t apex = change.moved;
    for (const std::uint32_t v : change.added[0])
        if (apex == none && std::all_of(change.added.begin(), change.added.end(),
                                        [v](const Triangle& t) { return has(t, v); }))
            apex = v;
    if (apex == none) return; // no operation makes such changes
    const auto place = [&](std::uint32_t v) {
        return v == change.moved ? change.before : mesh_.points[v];
    };
    top_ = mesh_.points[apex];
    for (const std::uint32_t r : change.removed) {
        const Triangle& t = mesh_.triangles[r];
        for (const std::uint32_t v : t) its_corners_[v] = change_;
        if (change.moved == none && has(t, apex)) continue;
        std::array<Point3, 4> c{place(t[0]), place(t[1]), place(t[2]), top_};
        const Sign side = orient3d(c[0], c[1], c[2], c[3]);
        if (side == Sign::Zero) continue;
        if (side == Sign::Negative) std::swap(c[0], c[1]);
        Box box = box_of(c, Triangle{0, 1, 2});
        widen(box, box_of(c, Triangle{1, 2, 3}));
        swept_.push_back({c, box});
    }
}

/// Whether a corner that the change does not have is in what it sweeps, or at the place of its top:
/// pair tests take different vertices to be at different places.
bool Guard::is_swept(const Triangle& t) const {
    for (const std::uint32_t v : t) {
        if (its_corners_[v] == change_) continue;
        const Point3& p = mesh_.points[v];
        if (p == top_) return true;
        for (const auto& [c, box] : swept_)
            if (box.overlaps({{p.x, p.y, p.z}, {p.x, p.y, p.z}}) &&
                orient3d(c[0], c[1], c[2], p) != Sign::Negative &&
                orient3d(c[0], c[3], c[1], p) != Sign::Negative &&
                orient3d(c[1], c[3], c[2], p) != Sign::Negative &&
                orient3d(c[2], c[3], c[0], p) != Sign::Negative)
                return true;
    }
    return false;
}

bool Guard::meets_properly(const Change& change) {
    ++change_;
    for (const std::uint32_t t : change.removed) seen_[t] = change_;
    planes_.clear();
    for (const auto& [a, b, c] : change.added)
        planes_.emplace_back(mesh_.points[a], mesh_.points[b], mesh_.points[c]);
    sweep(change);
    GridBox all = boxes_.front();
    for (const GridBox& b : boxes_) all.widen(b);
    for (const Tetrahedron& t : swept_) all.widen(grid_.scaled(t.box));
    const auto are_shown = [&](std::size_t i, std::uint32_t patch) {
        return patches_[i] != no_group && patches_[i] == patch;
    };
    const auto proper = [&](std::uint32_t t, const GridBox& box) {
        if (seen_[t] == change_) return true;
        seen_[t] = change_;
        const Triangle& other = mesh_.triangles[t];
        if (is_swept(other)) return false;
        for (std::size_t i = 0; i < change.added.size(); ++i)
            if (boxes_[i].overlaps(box) && !are_shown(i, patch_of_[t]) &&
                !is_beside(planes_[i], change.added[i], other) &&
                improper_contact(mesh_.points, change.added[i], other))
                return false;
        return true;
    };
    const bool is_one = std::all_of(patches_.begin(), patches_.end(),
                                    [&](std::uint32_t p) { return p == patches_[0]; });
    if (!grid_.visit(all, is_one ? patches_[0] : no_group, proper)) return false;
    for (std::size_t i = 0; i < change.added.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (boxes_[i].overlaps(boxes_[j]) && !are_shown(i, patches_[j]) &&
                improper_contact(mesh_.points, change.added[i], change.added[j]))
                return false;
    return true;
}

/// All triangles are wound in the patch as it is.
bool Guard::are_wound(const Change& change, std::uint32_t patch) const {
    for (std::size_t i = 0; i < change.added.size(); ++i)
        if (patch_of_[change.from[i]] == patch &&
            turn_in(axis_[patch], mesh_.points, change.added[i]) != turn_[patch])
            return false;
    return true;
}

/// The patches of what is added: of the only one of what is removed; where a curve changes, of
/// those that are shown to stay what they are. False where a whole sheet would not stay one patch.
bool Guard::find_patches(const Change& change) {
    patches_.assign(change.added.size(), no_group);
    if (!change.on_border) {
        if (in_one_patch(change.removed))
            std::fill(patches_.begin(), patches_.end(), patch_of_[change.removed[0]]);
        return true;
    }
    for (std::size_t i = 0; i < patches_.size(); ++i) {
        const std::uint32_t p = patch_of_[change.from[i]];
        const auto is_his = [&](std::uint32_t t) { return patch_of_[t] == p; };
        const auto first = static_cast<std::size_t>(
            std::find_if(change.from.begin(), change.from.end(), is_his) - change.from.begin());
        if (p == no_group) continue;
        if (first < i)
            patches_[i] = patches_[first];
        else if (are_wound(change, p) && borders_.keeps(change, patch_of_, p, axis_[p]))
            patches_[i] = p;
        else if (is_whole_[mesh_.sheet_of[change.from[i]]] != 0)
            return false;
    }
    return true;
}

/// Nothing that is added can meet anything else, by its patch and by what it follows.
bool Guard::is_free(const Change& change) const {
    for (std::size_t i = 0; i < change.added.size(); ++i)
        if (alone_[i] == 0 || is_whole_[mesh_.sheet_of[change.from[i]]] == 0) return false;
    return true;
}

Verdict Guard::judge(const Change& change) {
    const bool in_one = !change.on_border && in_one_patch(change.removed);
    if (!shapes_hold(change, in_one ? patch_of_[change.removed[0]] : no_group))
        return Verdict::shape;
    if (!bounds_hold(change)) return Verdict::deviation;
    box_added(change);
    if (!find_patches(change)) return Verdict::contact;
    if (!is_free(change) && !meets_properly(change)) return Verdict::contact;
    return Verdict::allowed;
}

/// Before the mesh is changed.
void Guard::leave_patches(const Change& change) {
    if (!change.in_place)
        for (const std::uint32_t t : change.removed)
            if (!is_quiet(t)) grid_.leave(t, box_of_[t]);
    if (!change.on_border && patches_[0] != no_group) return; // the border stays
    std::vector<std::uint32_t> done;
    for (const std::uint32_t t : change.removed) {
        const std::uint32_t p = patch_of_[t];
        if (p == no_group || std::find(done.begin(), done.end(), p) != done.end()) continue;
        done.push_back(p);
        const bool is_kept = std::find(patches_.begin(), patches_.end(), p) != patches_.end();
        borders_.update(change, patch_of_, p, is_kept);
    }
}

Verdict Guard::apply(const Change& change) {
    const Verdict verdict = judge(change);
    refusals_.shape += verdict == Verdict::shape;
    refusals_.deviation += verdict == Verdict::deviation;
    refusals_.contact += verdict == Verdict::contact;
    if (verdict != Verdict::allowed) return verdict;
    leave_patches(change);
    mesh_.apply(change, hints_, numbers_);
    if (mesh_.triangles.size() > patch_of_.size()) {
        patch_of_.resize(mesh_.triangles.size(), no_group);
        seen_.resize(mesh_.triangles.size(), 0);
        box_of_.resize(mesh_.triangles.size());
    }
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const std::uint32_t t = numbers_[i], patch = patches_[i];
        ungrouped_ += patch == no_group && patch_of_[t] != no_group;
        const bool was_there = change.in_place && !is_quiet(t);
        mesh_.alone[t] = alone_[i];
        const bool is_there = !is_quiet(t);
        if (was_there && is_there && patch_of_[t] == patch) {
            grid_.move(t, box_of_[t], boxes_[i], patch);
        } else {
            if (was_there) grid_.leave(t, box_of_[t]);
            if (is_there) grid_.enter(t, boxes_[i], patch);
        }
        patch_of_[t] = patch;
        box_of_[t] = boxes_[i];
    }
    return verdict;
}

} // namespace terrane::improving
