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

} // namespace

std::string_view name_of(Search method) {
    switch (method) {
    case Search::grid: return "grid";
    case Search::ab_balanced: return "ab-balanced";
    case Search::brute: return "brute";
    default: return "auto";
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
        if (largest > 16 * sum / static_cast<double>(boxes.size())) return Search::ab_balanced;
    }
    return Search::grid;
}

std::vector<CandidatePair> candidate_pairs(std::span<const Box> boxes,
                                           std::span<const std::uint32_t> groups, Search method) {
    switch (method == Search::automatic ? choose(boxes) : method) {
    case Search::brute: return all_pairs<search::Brute>(boxes, groups);
    case Search::ab_balanced: return all_pairs<search::AbTree>(boxes, groups);
    default: return all_pairs<search::Grid>(boxes, groups);
    }
}

} // namespace terrane
