// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/search.hpp>

#include <algorithm>

#include <terrane/algorithms/search/methods.hpp>

namespace terrane {
namespace {

template <class Method>
std::vector<CandidatePair> all_pairs(std::span<const Box> boxes,
                                     std::span<const std::uint32_t> groups) {
    const Method method(boxes);
    std::vector<CandidatePair> pairs;
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const std::uint32_t group = groups.empty() ? no_group : groups[i];
        found.clear();
        method.query(boxes[i], [&](std::uint32_t j) {
            if (j > i && (group == no_group || groups[j] != group)) found.push_back(j);
        });
        std::sort(found.begin(), found.end());
        for (const std::uint32_t j : found) pairs.push_back({i, j});
    }
    return pairs;
}

template <class Method>
std::vector<CandidatePair> active_pairs(std::span<const Box> boxes, std::span<const Box> chosen,
                                        std::span<const std::uint32_t> active) {
    const Method method(chosen);
    std::vector<CandidatePair> pairs;
    auto next = active.begin();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const bool is_active = next != active.end() && *next == i;
        if (is_active) ++next;
        method.query(boxes[i], [&](std::uint32_t k) {
            const std::uint32_t j = active[k];
            if (j == i || (is_active && j < i)) return; // found from the other one
            pairs.push_back({std::min(i, j), std::max(i, j)});
        });
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace

std::vector<CandidatePair> candidate_pairs_of(std::span<const Box> boxes,
                                              std::span<const std::uint32_t> active) {
    std::vector<Box> chosen;
    chosen.reserve(active.size());
    for (const std::uint32_t i : active) chosen.push_back(boxes[i]);
    if (choose(chosen) == Search::grid) return active_pairs<search::Grid>(boxes, chosen, active);
    return active_pairs<search::Hierarchy>(boxes, chosen, active);
}

std::string_view name_of(Search method) {
    switch (method) {
    case Search::grid:
        return "grid";
    case Search::ab_balanced:
        return "ab-balanced";
    case Search::hierarchy:
        return "hierarchy";
    case Search::brute:
        return "brute";
    default:
        return "auto";
    }
}

Search choose(std::span<const Box> boxes) {
    for (unsigned k = 0; k < 3; ++k) {
        double sum = 0, largest = 0;
        for (const Box& b : boxes) {
            const double extent = b.high[k] - b.low[k];
            sum += extent;
            largest = std::max(largest, extent);
        }
        if (largest > 4 * sum / static_cast<double>(boxes.size())) return Search::hierarchy;
    }
    return Search::grid;
}

std::vector<CandidatePair> candidate_pairs(std::span<const Box> boxes,
                                           std::span<const std::uint32_t> groups, Search method) {
    switch (method == Search::automatic ? choose(boxes) : method) {
    case Search::brute:
        return all_pairs<search::Brute>(boxes, groups);
    case Search::hierarchy:
        return all_pairs<search::Hierarchy>(boxes, groups);
    case Search::ab_balanced:
        return all_pairs<search::AbTree>(boxes, groups);
    default:
        return all_pairs<search::Grid>(boxes, groups);
    }
}

} // namespace terrane
