// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/search.hpp>

#include <algorithm>
#include <array>
#include <stop_token>
#include <type_traits>
#include <utility>

#include <terrane/algorithms/search/detail/bvh_join.hpp>
#include <terrane/algorithms/search/methods.hpp>

namespace terrane {
namespace {

using Pairs = std::vector<CandidatePair>;

constexpr std::array names{std::pair{Search::automatic, "auto"},
                           std::pair{Search::grid, "grid"},
                           std::pair{Search::ab, "ab"},
                           std::pair{Search::ab_balanced, "ab-balanced"},
                           std::pair{Search::ab_median, "ab-median"},
                           std::pair{Search::mixed, "mixed"},
                           std::pair{Search::bvh, "hierarchy"},
                           std::pair{Search::brute, "brute"}};

/// Builds a search. Those that may take quadratic time for it listen to stop requests.
template <class Method>
Method built(std::span<const Box> boxes, const std::stop_token& stop) {
    if constexpr (std::is_constructible_v<Method, std::span<const Box>, const std::stop_token&>)
        return Method(boxes, stop);
    else
        return Method(boxes);
}

/// Queries all boxes with each box in turn, until a stop is requested.
template <class Method>
Pairs pairs_one_by_one(std::span<const Box> boxes, std::span<const std::uint32_t> groups,
                       const std::stop_token& stop) {
    auto method = built<Method>(boxes, stop);
    Pairs pairs;
    for (std::uint32_t i = 0; i < boxes.size() && !stop.stop_requested(); ++i) {
        const std::uint32_t group = groups.empty() ? no_group : groups[i];
        const auto row = static_cast<std::ptrdiff_t>(pairs.size());
        method.query(boxes[i], [&](std::uint32_t j) {
            if (j > i && (group == no_group || groups[j] != group)) pairs.push_back({i, j});
        });
        std::sort(pairs.begin() + row, pairs.end());
    }
    return pairs;
}

struct Part {
    std::vector<Box> boxes;
    std::vector<std::uint32_t> indices;
};

/// Splits the boxes into the paper's red and blue ones; the group of box 0 is red. Returns nothing
/// if there are more than two groups, or boxes without group.
std::vector<Part> red_and_blue(std::span<const Box> boxes, std::span<const std::uint32_t> groups) {
    std::vector<Part> parts(2);
    std::uint32_t blue = no_group;
    for (std::uint32_t i = 0; i < groups.size(); ++i) {
        const bool is_red = groups[i] == groups[0];
        if (!is_red && blue == no_group) blue = groups[i];
        if (groups[i] == no_group || (!is_red && groups[i] != blue)) return {};
        Part& part = parts[is_red ? 0 : 1];
        part.boxes.push_back(boxes[i]);
        part.indices.push_back(i);
    }
    return parts;
}

/// Queries the red boxes with each blue box, until a stop is requested.
template <class Method>
Pairs pairs_of_two(const Part& red, const Part& blue, std::size_t count,
                   const std::stop_token& stop) {
    auto method = built<Method>(red.boxes, stop);
    std::vector<Pairs> found(1);
    for (std::size_t b = 0; b < blue.boxes.size() && !stop.stop_requested(); ++b)
        method.query(blue.boxes[b], [&](std::uint32_t r) {
            const auto [i, j] = std::minmax(blue.indices[b], red.indices[r]);
            found[0].push_back({i, j});
        });
    return search::sorted(found, count);
}

template <class Method>
Pairs all_pairs(std::span<const Box> boxes, std::span<const std::uint32_t> groups,
                const std::stop_token& stop) {
    const auto parts = red_and_blue(boxes, groups);
    if (groups.empty() || parts.empty()) return pairs_one_by_one<Method>(boxes, groups, stop);
    return pairs_of_two<Method>(parts[0], parts[1], boxes.size(), stop);
}

/// Performs the mixed search of paper 2.3: a balanced tree of the boxes that the reduction leaves.
Pairs mixed_pairs(std::span<const Box> boxes, std::span<const std::uint32_t> groups,
                  const std::stop_token& stop) {
    const auto chosen = search::boxes_in_mixed_cells(boxes, groups);
    std::vector<Box> left;
    std::vector<std::uint32_t> groups_left;
    for (const std::uint32_t i : chosen) {
        left.push_back(boxes[i]);
        if (!groups.empty()) groups_left.push_back(groups[i]);
    }
    Pairs pairs = all_pairs<search::BalancedAbTree>(left, groups_left, stop);
    for (CandidatePair& p : pairs) p = {chosen[p.first], chosen[p.second]};
    return pairs;
}

Pairs pairs_by(Search method, std::span<const Box> boxes, std::span<const std::uint32_t> groups,
               const std::stop_token& stop) {
    switch (method) {
    case Search::grid:
        return all_pairs<search::CellGrid>(boxes, groups, stop);
    case Search::ab:
        return all_pairs<search::AbTree>(boxes, groups, stop);
    case Search::ab_balanced:
        return all_pairs<search::BalancedAbTree>(boxes, groups, stop);
    case Search::ab_median:
        return all_pairs<search::MedianAbTree>(boxes, groups, stop);
    case Search::mixed:
        return mixed_pairs(boxes, groups, stop);
    default:
        return pairs_one_by_one<search::Brute>(boxes, groups, stop);
    }
}

} // namespace

std::string_view name_of(Search method) {
    for (const auto& [search, name] : names)
        if (search == method) return name;
    return "auto";
}

std::optional<Search> search_named(std::string_view name) {
    for (const auto& [search, known] : names)
        if (name == known) return search;
    return std::nullopt;
}

Search choose(std::size_t boxes) {
    return boxes <= 24 ? Search::brute : Search::bvh;
}

Search method_used(Search method, std::size_t boxes) {
    return method == Search::automatic ? choose(boxes) : method;
}

std::vector<CandidatePair> candidate_pairs(const BoxSource& source,
                                           std::span<const std::uint32_t> groups, Search method,
                                           const Run& run, const CrowdFinder& find_crowds,
                                           bool* any_crowded) {
    method = method_used(method, source.size());
    if (method == Search::bvh)
        return search::bvh_pairs(source, groups, run, find_crowds, any_crowded);
    if (any_crowded != nullptr) *any_crowded = false;
    Pairs pairs = pairs_by(method, source.listed(), groups, run.stop);
    if (!find_crowds) return pairs;
    const auto crowds = search::crowds_of_busy(source, groups, run, find_crowds);
    if (!crowds.empty())
        std::erase_if(pairs, [&](const CandidatePair& p) {
            return crowds[p.first] != no_group && crowds[p.first] == crowds[p.second];
        });
    return pairs;
}

std::vector<CandidatePair> candidate_pairs_of(const BoxSource& boxes,
                                              std::span<const std::uint32_t> active,
                                              std::span<const std::uint32_t> groups,
                                              const PairFilter& filter, const Run& run) {
    return search::active_pairs(boxes, active, groups, filter, run);
}

std::optional<std::array<std::uint64_t, pair_classes>>
count_candidate_pairs(const BoxSource& boxes, const PairClassifier& class_of, std::uint64_t most,
                      const Run& run) {
    return search::bvh_counts(boxes, class_of, most, run);
}

} // namespace terrane
