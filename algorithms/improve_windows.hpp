// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Many changes by several threads. Private to improve.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <terrane/algorithms/improve_operations.hpp>
#include <terrane/algorithms/parallel.hpp>

namespace terrane::improving {

/// How many changes one window has at most. Fixed: the result depends on it.
constexpr std::size_t window_size = 256;

/// Fewer are not worth several threads.
constexpr std::size_t few = 8;

constexpr auto nothing_more = [](const auto&, const Proposal&, bool) {};

/// Looks at items by propose(item, proposal), which has the change judged and returns whether that
/// is allowed, several at a time; carries changes out, one after another, and calls
/// done(item, proposal, whether it was carried out). Returns how many were.
/// Items are taken in windows, from places all over the list, so that few of a window are near each
/// other. All of a window see the mesh as it was before it. What shares a vertex with a change that
/// was carried out since then, or is not shown to be apart from it, is proposed again when its turn
/// comes. So the result does not depend on the threads.
template <class Item, class Propose, class Done>
std::size_t in_windows(Workshop& shop, const std::vector<Item>& items, const Propose& propose,
                       const Done& done) {
    if (items.empty()) return 0;
    WorkMesh& mesh = shop.mesh;
    const std::size_t size = std::clamp(items.size() / 16, std::size_t{1}, window_size);
    const std::size_t windows = (items.size() + size - 1) / size;
    shop.window.resize(std::max(shop.window.size(), size));
    std::vector<const Judgement*> made;
    std::size_t sum = 0;
    const auto is_stale = [&](const Proposal& p) {
        for (const std::uint32_t t : p.change.removed)
            for (const std::uint32_t v : mesh.triangles[t])
                if (v == none || shop.touched_at[v] == mesh.now) return true;
        return std::any_of(made.begin(), made.end(), [&](const Judgement* other) {
            return !Guard::are_apart(p.judgement, *other);
        });
    };
    const auto touch = [&](const Triangle& t) {
        for (const std::uint32_t v : t) shop.touched_at[v] = mesh.now;
    };
    const auto carry_out = [&](Proposal& p) {
        p.change.number_new(mesh.next_vertex());
        for (const std::uint32_t t : p.change.removed) touch(mesh.triangles[t]);
        shop.guard.carry_out(p.change, p.judgement);
        shop.touched_at.resize(mesh.points.size(), 0);
        for (const Triangle& t : p.change.added) touch(t);
        made.push_back(&p.judgement);
    };
    shop.touched_at.resize(mesh.points.size(), 0);
    with_threads(shop.run, [&] {
        tbb::affinity_partitioner where; // a thread goes on where it was in the window before
        for (std::size_t w = 0; w < windows && !shop.run.stop.stop_requested(); ++w) {
            ++mesh.now;
            made.clear();
            const auto look = [&](std::size_t k) {
                Proposal& p = shop.window[k];
                p.is_allowed = propose(items[w + k * windows], p);
            };
            const std::size_t count = (items.size() - w + windows - 1) / windows;
            if (shop.run.threads <= 1 || count < few)
                for (std::size_t k = 0; k < count; ++k) look(k);
            else
                tbb::parallel_for(std::size_t{0}, count, look, where);
            for (std::size_t k = 0; k < count; ++k) {
                Proposal& p = shop.window[k];
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

} // namespace terrane::improving
