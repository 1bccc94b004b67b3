// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/pair_decisions.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/kernel/assertion.hpp>

namespace terrane::rounding::detail {
namespace {

// The flags of a triangle.
constexpr std::uint8_t is_part = 1;        ///< tested against all but those of its patch
constexpr std::uint8_t is_dirty = 2;       ///< a corner has moved
constexpr std::uint8_t in_tested_pair = 4; ///< one of the tested pairs has it

constexpr std::uint32_t tested = UINT32_MAX; ///< in place of the index of a triangle

/// Per triangle of the state: the same triangle of the arrangement, or `tested` by (1).
std::vector<std::uint32_t> origins_of(const RoundingState& state,
                                      std::span<const Triangle> original) {
    std::vector<std::uint32_t> origins(state.triangles.size(), tested);
    std::map<Triangle, std::uint32_t> moved_on; // those whose index is no longer the same
    for (std::uint32_t t = 0; t < state.triangles.size(); ++t) {
        const Triangle& corners = state.triangles[t];
        if (state.is_tested(corners)) continue;
        if (t < original.size() && original[t] == corners)
            origins[t] = t;
        else
            moved_on.emplace(corners, t);
    }
    for (std::uint32_t o = 0; o < original.size() && !moved_on.empty(); ++o) {
        const auto at = moved_on.find(original[o]);
        if (at == moved_on.end()) continue;
        origins[at->second] = o;
        moved_on.erase(at);
    }
    TERRANE_ASSERT(moved_on.empty()); // by (2)
    return origins;
}

/// Whether two ascending lists have a common element. Each step skips in one list what is less than
/// the first element of the other.
bool have_common(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    while (!a.empty() && !b.empty() && a.front() != b.front()) {
        if (b.front() < a.front()) std::swap(a, b);
        a = {std::lower_bound(a.begin(), a.end(), b.front()), a.end()};
    }
    return !a.empty() && !b.empty();
}

} // namespace

bool Pools::need_test(const CandidatePair& pair) const {
    if (!has_both(pair)) return false;
    const auto [s, t] = pair;
    if (is_ill_conditioned[s] && is_ill_conditioned[t]) return true;
    return !have_common((*parents_of)[s], (*parents_of)[t]);
}

FirstSearch::FirstSearch(std::vector<CandidatePair> tested_pairs,
                         std::span<const std::uint32_t> parts, std::span<const std::uint32_t> dirty,
                         std::vector<std::uint32_t> patches_of, Pools pools_of) :
    pairs(std::move(tested_pairs)),
    flags(patches_of.size(), 0), patches(std::move(patches_of)), pools(std::move(pools_of)) {
    sort_unique(pairs);
    for (const std::uint32_t t : parts) flags[t] |= is_part;
    for (const std::uint32_t t : dirty) flags[t] |= is_dirty;
    for (const CandidatePair& pair : pairs)
        for (const std::uint32_t t : {pair.first, pair.second}) flags[t] |= in_tested_pair;
}

DecidedBy FirstSearch::decided_by(const CandidatePair& pair) const {
    if (flags.empty()) return DecidedBy::exact_mesh;
    const unsigned either = flags[pair.first] | flags[pair.second];
    if (either == 0) return DecidedBy::exact_mesh; // most pairs
    const unsigned both = flags[pair.first] & flags[pair.second];
    const bool in_one_patch =
        patches[pair.first] != no_group && patches[pair.first] == patches[pair.second];
    if ((!in_one_patch && (either & is_part) != 0 && !pools.has_both(pair)) ||
        ((both & in_tested_pair) != 0 && std::binary_search(pairs.begin(), pairs.end(), pair)))
        return DecidedBy::test;
    if ((either & is_dirty) == 0) return DecidedBy::exact_mesh;
    if (in_one_patch) return DecidedBy::patch;
    return pools.need_test(pair) ? DecidedBy::test : DecidedBy::separation;
}

std::optional<PairCounts> count_decisions(const RoundingState& state,
                                          std::span<const Triangle> original,
                                          const FirstSearch& first, const PairCheckOptions& check,
                                          const Run& run) {
    const std::uint64_t most = check.most_counted(original.size());
    if (most == 0) return std::nullopt;
    if (check.method == PairCheck::full)
        return count_pairs(
            state.points, state.triangles, [](const CandidatePair&) { return DecidedBy::test; },
            most, run);
    const auto origins = origins_of(state, original);
    const auto decided_by = [&](const CandidatePair& p) {
        const std::uint32_t a = origins[p.first], b = origins[p.second];
        if (a == tested || b == tested) return DecidedBy::test;
        return first.decided_by({std::min(a, b), std::max(a, b)});
    };
    return count_pairs(state.points, state.triangles, decided_by, most, run);
}

} // namespace terrane::rounding::detail
