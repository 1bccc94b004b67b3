// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/detail/bvh_join.hpp>

#include <algorithm>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/search/detail/packed_tree.hpp>

namespace terrane::search {
namespace {

using Pairs = std::vector<CandidatePair>;
using PairBlocks = std::vector<Pairs>;

constexpr std::size_t most_trees = 8; ///< with more groups than this, one tree holds all boxes
constexpr std::size_t leaves_per_block = 256;

/// The common inputs of all joins of one search.
struct Task {
    const BoxSource& boxes;
    std::span<const std::uint32_t> groups;
    const PairFilter& filter; ///< may be empty
    const Run& run;
};

/// Joins the leaves of one tree with another and adds the pairs that keep(i, j) and the filter
/// accept.
template <class Keep>
void join(const PackedTree& a, const PackedTree& b, const Task& task, PairBlocks& blocks,
          const Keep& keep) {
    const BoxSource& boxes = task.boxes;
    const PairFilter& filter = task.filter;
    auto found = for_blocks<Pairs>(
        a.leaf_count(), leaves_per_block, task.run, [&](std::size_t l, std::size_t end) {
            Pairs pairs;
            for (; l < end; ++l)
                a.join(static_cast<std::uint32_t>(l), b,
                       [&](std::uint32_t i, std::uint32_t j, bool inside) {
                           if (!keep(i, j) || !(inside || boxes[i].overlaps(boxes[j]))) return;
                           const CandidatePair pair{std::min(i, j), std::max(i, j)};
                           if (!filter || filter(pair)) pairs.push_back(pair);
                       });
            return pairs;
        });
    std::move(found.begin(), found.end(), std::back_inserter(blocks));
}

/// Appends boxes [k, end) of a selection.
void append(Selection& to, const Selection& from, std::size_t k, std::size_t end) {
    to.boxes.insert(to.boxes.end(), from.boxes.data() + k, from.boxes.data() + end);
    to.indices.insert(to.indices.end(), from.indices.data() + k, from.indices.data() + end);
}

/// Splits the selected boxes by group. Returns nothing if there are more than most_trees groups.
std::vector<Selection> by_group(const Selection& all, std::span<const std::uint32_t> groups) {
    std::vector<Selection> parts;
    std::vector<std::uint32_t> names;
    for (std::size_t k = 0, end = 0; k < all.indices.size(); k = end) {
        const std::uint32_t group = groups[all.indices[k]];
        while (end < all.indices.size() && groups[all.indices[end]] == group) ++end;
        const auto at = std::find(names.begin(), names.end(), group) - names.begin();
        if (static_cast<std::size_t>(at) == names.size()) {
            if (names.size() == most_trees) return {};
            names.push_back(group);
            parts.emplace_back();
        }
        append(parts[static_cast<std::size_t>(at)], all, k, end);
    }
    return parts;
}

PairBlocks join_groups(const std::vector<Selection>& parts, const Task& task) {
    const auto trees =
        for_blocks<PackedTree>(parts.size(), 1, task.run,
                               [&](std::size_t k, std::size_t) { return PackedTree(parts[k]); });
    PairBlocks blocks;
    const auto all = [](std::uint32_t, std::uint32_t) { return true; };
    for (std::size_t a = 0; a < trees.size(); ++a) {
        if (task.groups[parts[a].indices[0]] == no_group)
            join(trees[a], trees[a], task, blocks, all);
        for (std::size_t b = a + 1; b < trees.size(); ++b)
            join(trees[a], trees[b], task, blocks, all);
    }
    return blocks;
}

PairBlocks join_all(const Selection& selection, const Task& task) {
    const auto groups = task.groups;
    const PackedTree tree(selection);
    PairBlocks blocks;
    if (groups.empty())
        join(tree, tree, task, blocks, [](std::uint32_t, std::uint32_t) { return true; });
    else
        join(tree, tree, task, blocks, [&](std::uint32_t i, std::uint32_t j) {
            return groups[i] == no_group || groups[i] != groups[j];
        });
    return blocks;
}

} // namespace

std::vector<CandidatePair> sorted(const PairBlocks& blocks, std::size_t count) {
    std::size_t total = 0;
    for (const Pairs& b : blocks) total += b.size();
    Pairs pairs;
    if (total < count / 16) { // few pairs: an array of all rows would cost more
        pairs.reserve(total);
        for (const Pairs& b : blocks) pairs.insert(pairs.end(), b.begin(), b.end());
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }
    std::vector<std::uint64_t> row(count + 1); // 32 bits would not hold the number of pairs
    for (const Pairs& b : blocks)
        for (const CandidatePair& p : b) ++row[p.first + 1];
    for (std::size_t i = 0; i < count; ++i) row[i + 1] += row[i];
    pairs.resize(total);
    for (const Pairs& b : blocks)
        for (const CandidatePair& p : b) pairs[row[p.first]++] = p;
    auto begin = pairs.begin();
    for (std::size_t i = 0; i < count; ++i) { // row[i] is now the end of row i
        const auto end = pairs.begin() + static_cast<std::ptrdiff_t>(row[i]);
        std::sort(begin, end);
        begin = end;
    }
    return pairs;
}

std::vector<CandidatePair> bvh_pairs(const BoxSource& boxes, std::span<const std::uint32_t> groups,
                                     const Run& run) {
    const PairFilter none;
    if (groups.empty())
        return sorted(join_all(select_all(boxes), {boxes, groups, none, run}), boxes.size());
    const Selection selection = select_meeting(boxes, groups, run);
    const auto parts = by_group(selection, groups);
    return sorted(parts.empty() ? join_all(selection, {boxes, groups, none, run})
                                : join_groups(parts, {boxes, groups, none, run}),
                  boxes.size());
}

std::vector<CandidatePair> active_pairs(const BoxSource& boxes,
                                        std::span<const std::uint32_t> active,
                                        std::span<const std::uint32_t> groups,
                                        const PairFilter& filter, const Run& run) {
    const Selection selection = select_near(boxes, active, run);
    const Task task{boxes, groups, filter, run};
    Selection chosen, others;
    auto next = active.begin();
    for (std::size_t k = 0; k < selection.indices.size(); ++k) {
        while (next != active.end() && *next < selection.indices[k]) ++next;
        const bool is_active = next != active.end() && *next == selection.indices[k];
        append(is_active ? chosen : others, selection, k, k + 1);
    }
    const auto parts = groups.empty() ? std::vector<Selection>{} : by_group(chosen, groups);
    PairBlocks blocks = parts.empty() ? join_all(chosen, task) : join_groups(parts, task);
    const auto keep = [&](std::uint32_t i, std::uint32_t j) {
        return groups.empty() || groups[i] == no_group || groups[i] != groups[j];
    };
    join(PackedTree(chosen), PackedTree(others), task, blocks, keep);
    return sorted(blocks, boxes.size());
}

std::array<std::uint64_t, pair_classes> bvh_counts(const BoxSource& boxes,
                                                   const PairClassifier& class_of, const Run& run) {
    using Counts = std::array<std::uint64_t, pair_classes>;
    const PackedTree tree(select_all(boxes));
    const auto of_blocks = for_blocks<Counts>(
        tree.leaf_count(), leaves_per_block, run, [&](std::size_t leaf, std::size_t end) {
            Counts counts{};
            for (; leaf < end; ++leaf)
                tree.join(static_cast<std::uint32_t>(leaf), tree,
                          [&](std::uint32_t i, std::uint32_t j, bool inside) {
                              if (inside || boxes[i].overlaps(boxes[j]))
                                  ++counts.at(class_of({std::min(i, j), std::max(i, j)}));
                          });
            return counts;
        });
    Counts sum{};
    for (const Counts& counts : of_blocks)
        for (std::size_t k = 0; k < sum.size(); ++k) sum.at(k) += counts.at(k);
    return sum;
}

} // namespace terrane::search
