// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/grid.hpp>

#include <algorithm>

namespace terrane::quality::detail {
namespace {

constexpr std::size_t least_buckets = 1024;
constexpr std::size_t most_levels = 32; ///< the last level has one cell in each direction from the
                                        ///< origin

} // namespace

void TriangleGrid::Level::enter(const Entry& entry) {
    const std::size_t b = bucket_of(place_of(*this, entry.box.low));
    if (entries[b].empty()) patch_of[b] = entry.patch;
    if (patch_of[b] != entry.patch) patch_of[b] = no_group;
    entries[b].push_back(entry);
}

void TriangleGrid::Level::grow() {
    const auto before = std::move(entries);
    const std::size_t size = std::max(least_buckets, 2 * before.size());
    patch_of.assign(size, vacant);
    entries.assign(size, {});
    for (const auto& bucket : before)
        for (const Entry& e : bucket) enter(e);
}

void TriangleGrid::reset(const Point3& origin, double size) {
    origin_ = {origin.x, origin.y, origin.z};
    inverse_ = 1 / size;
    levels_.assign(most_levels, {});
    float inverse = 1;
    for (Level& level : levels_) {
        level.inverse = inverse;
        inverse /= 2;
    }
}

std::size_t TriangleGrid::level_of(const GridBox& box) const {
    float size = 0;
    for (std::size_t k = 0; k < 3; ++k) size = std::max(size, box.high[k] - box.low[k]);
    std::size_t level = 0;
    while (level + 1 < levels_.size() && size * levels_[level].inverse > 1) ++level;
    return level;
}

void TriangleGrid::enter(std::uint32_t t, const GridBox& box, std::uint32_t patch) {
    Level& level = levels_[level_of(box)];
    if (2 * level.count >= level.entries.size()) level.grow();
    ++level.count;
    level.enter({box, t, patch});
}

void TriangleGrid::leave(std::uint32_t t, const GridBox& box) {
    Level& level = levels_[level_of(box)];
    const std::size_t b = level.bucket_of(place_of(level, box.low));
    auto& entries = level.entries[b];
    const auto at = std::find_if(entries.begin(), entries.end(),
                                 [t](const Entry& e) { return e.triangle == t; });
    *at = entries.back();
    entries.pop_back();
    if (entries.empty()) level.patch_of[b] = vacant;
    --level.count;
}

void TriangleGrid::move(std::uint32_t t, const GridBox& before, const GridBox& box,
                        std::uint32_t patch) {
    const std::size_t here = level_of(box);
    Level& level = levels_[here];
    const std::size_t b = level.bucket_of(place_of(level, before.low));
    if (level_of(before) != here || level.bucket_of(place_of(level, box.low)) != b) {
        leave(t, before);
        enter(t, box, patch);
        return;
    }
    for (Entry& e : level.entries[b])
        if (e.triangle == t) e.box = box;
}

} // namespace terrane::quality::detail
