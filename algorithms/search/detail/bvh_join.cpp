// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/detail/bvh_join.hpp>

#include <algorithm>
#include <atomic>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/search/detail/packed_tree.hpp>
#include <terrane/algorithms/search/detail/stars.hpp>
#include <terrane/algorithms/search/detail/turned_tree.hpp>

namespace terrane::search {
namespace {

using Pairs = std::vector<CandidatePair>;
using PairBlocks = std::vector<Pairs>;

constexpr std::size_t most_trees = 8; ///< with more groups than this, one tree holds all boxes
constexpr std::size_t leaves_per_block = 256;

/// The common inputs of all joins of one search. Each join reports the share of the leaves that
/// have been joined, as stage "search".
struct Task {
    const BoxSource& boxes;
    std::span<const std::uint32_t> groups;
    std::span<const std::uint32_t> crowds; ///< per box: pairs within a crowd are left out; or empty
    const PairFilter& filter;              ///< may be empty
    const Run& run;
    bool turns; ///< whether pairs that turned boxes show to be apart may be left out

    /// Returns the task with another run.
    [[nodiscard]] Task with(const Run& other) const {
        return {boxes, groups, crowds, filter, other, turns};
    }
    /// Reports how many of the leaves of a join have been joined.
    void report(std::size_t leaves, std::size_t count) const {
        report_part(run, "search", 0, 1, leaves, count);
    }
    [[nodiscard]] bool are_of_one_group(std::uint32_t i, std::uint32_t j) const {
        return !groups.empty() && groups[i] != no_group && groups[i] == groups[j];
    }
    [[nodiscard]] bool are_of_one_crowd(std::uint32_t i, std::uint32_t j) const {
        return !crowds.empty() && crowds[i] != no_group && crowds[i] == crowds[j];
    }
    /// Tells whether two boxes overlap and have no group or crowd in common. inside: see PackedTree::join.
    [[nodiscard]] bool is_pair(std::uint32_t i, std::uint32_t j, bool inside) const {
        return !are_of_one_group(i, j) && !are_of_one_crowd(i, j) &&
               (inside || boxes[i].overlaps(boxes[j]));
    }
};

/// Calls visit(i, j) for the pairs of a sample of the leaves, for each leaf up to a number. Returns the number of
/// these leaves.
template <class Visit>
std::size_t sample_pairs(const PackedTree& a, const PackedTree& b, const Task& task,
                         std::size_t most_per_leaf, const Visit& visit) {
    constexpr std::size_t samples = 64;
    struct Report {
        const Task& task;
        const Visit& visit;
        std::size_t& left;

        void operator()(std::uint32_t i, std::uint32_t j, bool inside) const {
            if (left == 0 || !task.is_pair(i, j, inside)) return;
            --left;
            visit(i, j);
        }
        [[nodiscard]] bool is_full() const { return left == 0; }
    };
    const std::size_t step = std::max<std::size_t>(4, a.leaf_count() / samples);
    std::size_t leaves = 0;
    for (std::size_t l = 0; l < a.leaf_count(); l += step, ++leaves) {
        std::size_t left = most_per_leaf;
        a.join(static_cast<std::uint32_t>(l), b, Report{task, visit, left});
    }
    return leaves;
}

/// Tells whether boxes that are not turned say little of the triangles: whether a sample of the leaves has many
/// more pairs than triangles that meet their neighbours only, and turned boxes show nearly all of them to be apart.
bool say_little(const PackedTree& a, const PackedTree& b, const Task& task) {
    constexpr std::size_t few = 512, many = 24, share = 8;
    const std::size_t triangles = a.indices().size() + (&a == &b ? 0 : b.indices().size());
    if (!task.turns || triangles < few) return false;
    if (task.run.stop.stop_requested())
        return false; // the selection may be cut short, and its boxes unset
    std::size_t pairs = 0;
    const std::size_t leaves = sample_pairs(a, b, task, std::size_t{8} * 2048,
                                            [&](std::uint32_t, std::uint32_t) { ++pairs; });
    if (pairs * a.leaf_count() <= many * triangles * leaves) return false;
    const UnitMap map(task.boxes, a.indices(), b.indices());
    const auto turned = [&](std::uint32_t t) {
        const Triangle& c = task.boxes.triangles()[t];
        const auto points = task.boxes.points();
        const std::array corners{
            std::array{map(points[c[0]]), map(points[c[1]]), map(points[c[2]])}};
        return turned_box({&corners, 1});
    };
    std::size_t together = 0, tested = 0;
    sample_pairs(a, b, task, std::size_t{8} * 128, [&](std::uint32_t i, std::uint32_t j) {
        ++tested;
        if (!turned(i).is_apart(turned(j), map.room())) ++together;
    });
    return tested > share * together;
}

/// Adds the pairs of two trees that the filter accepts, but for those that turned boxes show to be apart.
void join_turned(const PackedTree& a, const PackedTree& b, const Task& task, PairBlocks& blocks) {
    const bool same = &a == &b;
    const UnitMap map(task.boxes, a.indices(),
                      same ? std::span<const std::uint32_t>{} : b.indices());
    const PairLabels labels{task.groups, task.crowds};
    const TurnedTree here(task.boxes, a.indices(), labels, map);
    std::optional<TurnedTree> other;
    if (!same) other.emplace(task.boxes, b.indices(), labels, map);
    const TurnedTree& there = same ? here : *other;
    auto found = for_reported_blocks<Pairs>(
        here.leaf_count(), leaves_per_block, task.run,
        [&](std::size_t l, std::size_t end) {
            Pairs pairs;
            for (; l < end; ++l)
                here.join(l, there, [&](std::uint32_t i, std::uint32_t j) {
                    const CandidatePair pair{std::min(i, j), std::max(i, j)};
                    if (!task.filter || task.filter(pair)) pairs.push_back(pair);
                });
            return pairs;
        },
        [&](std::size_t done) { task.report(done, here.leaf_count()); });
    std::move(found.begin(), found.end(), std::back_inserter(blocks));
}

/// Joins the leaves of one tree with another and adds the pairs that keep(i, j) and the filter
/// accept. keep: rejects pairs of one group, if any.
template <class Keep>
void join(const PackedTree& a, const PackedTree& b, const Task& task, PairBlocks& blocks,
          const Keep& keep) {
    if (say_little(a, b, task)) return join_turned(a, b, task, blocks);
    const BoxSource& boxes = task.boxes;
    const PairFilter& filter = task.filter;
    auto found = for_reported_blocks<Pairs>(
        a.leaf_count(), leaves_per_block, task.run,
        [&](std::size_t l, std::size_t end) {
            Pairs pairs;
            for (; l < end; ++l)
                a.join(static_cast<std::uint32_t>(l), b,
                       [&](std::uint32_t i, std::uint32_t j, bool inside) {
                           if (!keep(i, j) || task.are_of_one_crowd(i, j)) return;
                           if (!inside && !boxes[i].overlaps(boxes[j])) return;
                           const CandidatePair pair{std::min(i, j), std::max(i, j)};
                           if (!filter || filter(pair)) pairs.push_back(pair);
                       });
            return pairs;
        },
        [&](std::size_t done) { task.report(done, a.leaf_count()); });
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

/// Adds the pairs within a tree.
void join_itself(const PackedTree& tree, const Task& task, PairBlocks& blocks) {
    if (task.groups.empty())
        join(tree, tree, task, blocks, [](std::uint32_t, std::uint32_t) { return true; });
    else
        join(tree, tree, task, blocks,
             [&](std::uint32_t i, std::uint32_t j) { return !task.are_of_one_group(i, j); });
}

/// The pairs of a range of leaves, as far as no leaf has too many.
struct LimitedPairs {
    Pairs pairs;
    std::vector<std::uint32_t> busy; ///< boxes of leaves with too many
};

/// Joins a tree with itself, but ends the search of each leaf after `most` pairs. keeps: whether the pairs
/// are wanted.
std::vector<LimitedPairs> join_limited(const PackedTree& tree, const Task& task, std::size_t most,
                                       bool keeps) {
    struct Report {
        const Task& task;
        Pairs* pairs; ///< or null
        std::size_t& count;
        std::size_t most;

        void operator()(std::uint32_t i, std::uint32_t j, bool inside) const {
            if (!task.is_pair(i, j, inside)) return;
            ++count;
            if (pairs != nullptr) pairs->push_back({std::min(i, j), std::max(i, j)});
        }
        [[nodiscard]] bool is_full() const { return count > most; }
    };
    return for_reported_blocks<LimitedPairs>(
        tree.leaf_count(), leaves_per_block, task.run,
        [&](std::size_t l, std::size_t end) {
            LimitedPairs found;
            for (; l < end; ++l) {
                const auto leaf = static_cast<std::uint32_t>(l);
                std::size_t count = 0;
                const Report report{task, keeps ? &found.pairs : nullptr, count, most};
                tree.join(leaf, tree, report);
                if (!report.is_full()) continue;
                const auto busy = tree.indices_of(leaf);
                found.busy.insert(found.busy.end(), busy.begin(), busy.end());
            }
            return found;
        },
        [&](std::size_t done) { task.report(done, tree.leaf_count()); });
}

/// Returns the crowds of a task and, for boxes without, those that were found.
std::vector<std::uint32_t> with_crowds(const Task& task, const std::vector<std::uint32_t>& found) {
    std::vector<std::uint32_t> crowds(task.crowds.begin(), task.crowds.end());
    crowds.resize(task.boxes.size(), no_group);
    std::uint32_t next = 0;
    for (const std::uint32_t c : crowds) next = std::max(next, c + 1); // no_group + 1 wraps to 0
    for (std::size_t i = 0; i < found.size(); ++i)
        if (crowds[i] == no_group && found[i] != no_group) crowds[i] = next + found[i];
    return crowds;
}

/// Adds the pairs within a selection. Where some boxes have very many, find_crowds (if any) is
/// asked first; what is done before that is linear in the boxes, whatever they are.
void join_itself(const Selection& selection, const PackedTree& tree, const Task& task,
                 const CrowdFinder& find_crowds, PairBlocks& blocks) {
    if (!find_crowds) return join_itself(tree, task, blocks);
    constexpr std::size_t most_per_leaf = std::size_t{8} * 256;
    std::vector<std::uint32_t> busy;
    const bool turns = say_little(tree, tree, task);
    auto parts = join_limited(tree, task, most_per_leaf, !turns);
    for (const LimitedPairs& part : parts)
        busy.insert(busy.end(), part.busy.begin(), part.busy.end());
    const Run again = without_progress(task.run); // which has told of all leaves already
    if (busy.empty()) {
        if (turns) return join_turned(tree, tree, task.with(again), blocks);
        for (LimitedPairs& part : parts) blocks.push_back(std::move(part.pairs));
        return;
    }
    parts.clear();
    std::sort(busy.begin(), busy.end());
    const auto crowds = with_crowds(task, find_crowds(busy));
    join_itself(PackedTree(selection, crowds),
                {task.boxes, task.groups, crowds, task.filter, again, task.turns}, blocks);
}

PairBlocks join_groups(const std::vector<Selection>& parts, const Task& task,
                       const CrowdFinder& find_crowds = {}) {
    const auto trees =
        for_blocks<PackedTree>(parts.size(), 1, task.run, [&](std::size_t k, std::size_t) {
            return PackedTree(parts[k], task.crowds);
        });
    const auto has_pairs = [&](std::size_t a) { // within the tree
        return task.groups[parts[a].indices[0]] == no_group;
    };
    double leaves = 0, done = 0; // of all joins
    for (std::size_t a = 0; a < trees.size(); ++a) {
        const std::size_t joins = trees.size() - a - (has_pairs(a) ? 0 : 1);
        leaves += static_cast<double>(trees[a].leaf_count() * joins);
    }
    const auto next = [&](const PackedTree& tree) { // the run of the next join of its leaves
        const double from = done / leaves;
        done += static_cast<double>(tree.leaf_count());
        return part_of_stage(task.run, "search", from, done / leaves);
    };
    PairBlocks blocks;
    const auto all = [](std::uint32_t, std::uint32_t) { return true; };
    for (std::size_t a = 0; a < trees.size(); ++a) {
        if (has_pairs(a)) {
            const Run inside = next(trees[a]);
            join_itself(parts[a], trees[a], task.with(inside), find_crowds, blocks);
        }
        for (std::size_t b = a + 1; b < trees.size(); ++b) {
            const Run between = next(trees[a]);
            join(trees[a], trees[b], task.with(between), blocks, all);
        }
    }
    return blocks;
}

PairBlocks join_all(const Selection& selection, const Task& task,
                    const CrowdFinder& find_crowds = {}) {
    PairBlocks blocks;
    join_itself(selection, PackedTree(selection, task.crowds), task, find_crowds, blocks);
    return blocks;
}

/// Adds the pairs within the stars that keep() and the filter accept.
template <class Keep>
void add_pairs_of_stars(const Stars& stars, const Task& task, PairBlocks& blocks,
                        const Keep& keep) {
    for (std::size_t s = 0; s < stars.vertices.size(); ++s) {
        if (task.run.stop.stop_requested()) return;
        const Pairs pairs = pairs_of_star(task.boxes, stars, s, task.groups, task.run);
        auto kept = for_blocks<Pairs>(
            pairs.size(), 4096, task.run, [&](std::size_t first, std::size_t last) {
                Pairs part;
                for (; first < last; ++first)
                    if (keep(pairs[first]) && (!task.filter || task.filter(pairs[first])))
                        part.push_back(pairs[first]);
                return part;
            });
        std::move(kept.begin(), kept.end(), std::back_inserter(blocks));
    }
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
                                     const Run& run, const CrowdFinder& find_crowds,
                                     bool* any_crowded) {
    const PairFilter none;
    const Selection selection =
        groups.empty() ? select_all(boxes) : select_meeting(boxes, groups, run);
    const Stars stars = find_stars(boxes, selection.indices);
    if (any_crowded != nullptr) *any_crowded = !stars.vertices.empty();
    const Task task{boxes, groups, stars.of, none, run, !boxes.triangles().empty()};
    const auto parts = groups.empty() ? std::vector<Selection>{} : by_group(selection, groups);
    PairBlocks blocks = parts.empty() ? join_all(selection, task, find_crowds)
                                      : join_groups(parts, task, find_crowds);
    add_pairs_of_stars(stars, task, blocks, [](const CandidatePair&) { return true; });
    return sorted(blocks, boxes.size());
}

std::vector<std::uint32_t> crowds_of_busy(const BoxSource& boxes,
                                          std::span<const std::uint32_t> groups, const Run& run,
                                          const CrowdFinder& find_crowds) {
    std::vector<std::uint32_t> crowds;
    bvh_pairs(boxes, groups, run, [&](std::span<const std::uint32_t> busy) {
        crowds = find_crowds(busy);
        return crowds;
    });
    return crowds;
}

std::vector<CandidatePair> active_pairs(const BoxSource& boxes,
                                        std::span<const std::uint32_t> active,
                                        std::span<const std::uint32_t> groups,
                                        const PairFilter& filter, const Run& run) {
    const Selection selection = select_near(boxes, active, run);
    const Stars stars = find_stars(boxes, selection.indices);
    // Without a filter, the caller may move points.
    const bool turns = filter && !boxes.triangles().empty();
    const Task task{boxes, groups, stars.of, filter, run, turns};
    Selection chosen, others;
    auto next = active.begin();
    for (std::size_t k = 0; k < selection.indices.size(); ++k) {
        while (next != active.end() && *next < selection.indices[k]) ++next;
        const bool is_active = next != active.end() && *next == selection.indices[k];
        append(is_active ? chosen : others, selection, k, k + 1);
    }
    const auto parts = groups.empty() ? std::vector<Selection>{} : by_group(chosen, groups);
    const Run inside = part_of_stage(run, "search", 0, 0.5),
              beyond = part_of_stage(run, "search", 0.5, 1);
    PairBlocks blocks =
        parts.empty() ? join_all(chosen, task.with(inside)) : join_groups(parts, task.with(inside));
    const auto keep = [&](std::uint32_t i, std::uint32_t j) {
        return !task.are_of_one_group(i, j);
    };
    join(PackedTree(chosen, stars.of), PackedTree(others, stars.of), task.with(beyond), blocks,
         keep);
    const auto is_active = [&](std::uint32_t i) {
        return std::binary_search(active.begin(), active.end(), i);
    };
    add_pairs_of_stars(stars, task, blocks, [&](const CandidatePair& p) {
        return is_active(p.first) || is_active(p.second);
    });
    return sorted(blocks, boxes.size());
}

std::vector<CandidatePair> pairs_of_crowds(std::span<const Box> boxes,
                                           std::span<const std::uint32_t> groups,
                                           std::span<const std::uint32_t> crowds,
                                           const PairFilter& filter, const Run& run) {
    const BoxSource source(boxes);
    const Run quiet = without_progress(run);
    const Task task{source, groups, crowds, filter, quiet, false};
    return concatenated(join_all(select_all(source), task));
}

std::optional<std::array<std::uint64_t, pair_classes>> bvh_counts(const BoxSource& boxes,
                                                                  const PairClassifier& class_of,
                                                                  std::uint64_t most,
                                                                  const Run& run) {
    using Counts = std::array<std::uint64_t, pair_classes>;
    const PackedTree tree(select_all(boxes));
    std::atomic<std::uint64_t> met{0}; // pairs of all threads, after each leaf
    const auto of_blocks = for_reported_blocks<Counts>(
        tree.leaf_count(), leaves_per_block, run,
        [&](std::size_t leaf, std::size_t end) {
            Counts counts{};
            for (; leaf < end && met.load(std::memory_order_relaxed) <= most; ++leaf) {
                std::uint64_t here = 0;
                tree.join(static_cast<std::uint32_t>(leaf), tree,
                          [&](std::uint32_t i, std::uint32_t j, bool inside) {
                              if (!inside && !boxes[i].overlaps(boxes[j])) return;
                              ++here;
                              ++counts.at(class_of({std::min(i, j), std::max(i, j)}));
                          });
                met.fetch_add(here, std::memory_order_relaxed);
            }
            return counts;
        },
        [&](std::size_t done) { report_part(run, "search", 0, 1, done, tree.leaf_count()); });
    Counts sum{};
    for (const Counts& counts : of_blocks)
        for (std::size_t k = 0; k < sum.size(); ++k) sum.at(k) += counts.at(k);
    if (met > most) return std::nullopt;
    return sum;
}

} // namespace terrane::search
