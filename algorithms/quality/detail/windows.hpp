// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks many changes on several threads and carries them out one after another.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_group.h>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/operations.hpp>

namespace terrane::quality::detail {

/// Windows of fewer changes run on one thread.
constexpr std::size_t few = 8;

/// Footprints of the changes carried out in a window. Boxes are compared with all of them at once;
/// only near ones are examined closely.
class Footprints {
public:
    void clear() {
        footprints_.clear();
        for (auto& side : sides_) side.clear();
    }
    void add(const Footprint& footprint) {
        footprints_.push_back(footprint);
        for (std::size_t k = 0; k < 3; ++k) {
            sides_[k].push_back(footprint.around.low[k]);
            sides_[3 + k].push_back(footprint.around.high[k]);
        }
    }
    [[nodiscard]] bool are_apart(const Footprint& footprint) const {
        const auto& [low, high] = footprint.around;
        int near = 0, in_some_projection = 0;
        for (std::size_t i = 0; i < footprints_.size(); ++i) { // no branches, so that it vectorises
            const int x = static_cast<int>(low[0] <= sides_[3][i]) &
                          static_cast<int>(sides_[0][i] <= high[0]);
            const int y = static_cast<int>(low[1] <= sides_[4][i]) &
                          static_cast<int>(sides_[1][i] <= high[1]);
            const int z = static_cast<int>(low[2] <= sides_[5][i]) &
                          static_cast<int>(sides_[2][i] <= high[2]);
            near |= x & y & z;
            in_some_projection |= (x & y) | (y & z) | (z & x);
        }
        if (!footprint.borders.empty()) near = in_some_projection;
        return near == 0 ||
               std::all_of(footprints_.begin(), footprints_.end(),
                           [&](const Footprint& other) { return footprint.is_apart(other); });
    }

private:
    std::vector<Footprint> footprints_;
    std::array<std::vector<float>, 6> sides_; ///< per coordinate: lower bounds, then upper bounds
};

constexpr auto nothing_more = [](const auto&, const Proposal&, bool) {};

/// Calls propose(item, proposal) for the items of a window on several threads; it checks the change
/// and returns whether it is allowed. Then carries the allowed changes out one after another, calls
/// done(item, proposal, is_made) for each item, and returns how many were made.
/// Items of a window come from places all over the list, so that few of them are near each other.
/// All proposals of a window refer to the mesh before the window. A proposal that shares a vertex
/// with a change carried out since, or that is not proven to be apart from it, is made again when
/// it is due. The result therefore does not depend on the threads.
template <class Item, class Propose, class Done>
std::size_t in_windows(RemeshContext& context, const std::vector<Item>& items,
                       const Propose& propose, const Done& done) {
    if (items.empty()) return 0;
    WorkMesh& mesh = context.mesh;
    const std::size_t size = std::clamp(items.size() / 16, std::size_t{1}, constants.window_size);
    const std::size_t windows = (items.size() + size - 1) / size;
    context.window.resize(std::max(context.window.size(), size));
    Footprints made;
    std::size_t sum = 0;
    const auto can_be_anywhere = [](const Proposal& p) {
        return p.checked.footprint.is_contact_free && p.checked.footprint.borders.empty();
    };
    const auto is_stale = [&](const Proposal& p) {
        for (const std::uint32_t t : p.change.removed)
            for (const std::uint32_t v : mesh.triangles[t])
                if (v == none || context.touched_at[v] == mesh.now) return true;
        return !can_be_anywhere(p) && !made.are_apart(p.checked.footprint);
    };
    const auto touch = [&](const Triangle& t) {
        for (const std::uint32_t v : t) context.touched_at[v] = mesh.now;
    };
    const auto carry_out = [&](Proposal& p) {
        p.change.number_new(mesh.next_vertex());
        for (const std::uint32_t t : p.change.removed) touch(mesh.triangles[t]);
        context.validator.carry_out(p.change, p.checked);
        context.touched_at.resize(mesh.points.size(), 0);
        for (const Triangle& t : p.change.added) touch(t);
        if (!can_be_anywhere(p)) made.add(p.checked.footprint);
    };
    context.touched_at.resize(mesh.points.size(), 0);
    with_threads(context.run, [&] {
        tbb::task_group_context arithmetic(tbb::task_group_context::bound,
                                           tbb::task_group_context::fp_settings);
        tbb::affinity_partitioner where; // each thread keeps its part of the window
        for (std::size_t w = 0; w < windows && !context.run.stop.stop_requested(); ++w) {
            ++mesh.now;
            made.clear();
            const auto look = [&](std::size_t k) {
                Proposal& p = context.window[k];
                p.is_allowed = propose(items[w + k * windows], p);
            };
            const std::size_t count = (items.size() - w + windows - 1) / windows;
            if (context.run.threads <= 1 || count < few)
                for (std::size_t k = 0; k < count; ++k) look(k);
            else
                tbb::parallel_for(std::size_t{0}, count, look, where, arithmetic);
            for (std::size_t k = 0; k < count; ++k) {
                Proposal& p = context.window[k];
                const Item& item = items[w + k * windows];
                const bool is_made = p.is_allowed && (!is_stale(p) || propose(item, p));
                if (is_made) carry_out(p);
                sum += is_made;
                done(item, p, is_made);
            }
        }
    });
    return sum;
}

} // namespace terrane::quality::detail
