// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/parents_in_contact.hpp>

#include <algorithm>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>
#include <terrane/kernel/assertion.hpp>

namespace terrane::rounding::detail {
namespace {

/// Two different input triangles as one number; equal ones as 0, which is no pair.
std::uint64_t pair_number(std::uint32_t p, std::uint32_t q) {
    if (p == q) return 0;
    return std::uint64_t{std::min(p, q)} << 32 | std::max(p, q);
}

/// Which of 64 shards has a pair.
std::size_t shard_of(std::uint64_t pair) {
    return pair * 0x9e3779b97f4a7c15u >> 58;
}

} // namespace

ParentsInContact parents_in_contact(std::span<const CandidatePair> contacts,
                                    const IndexLists<std::uint32_t>& parents_of) {
    constexpr std::size_t most_parents = 4;
    const std::size_t most = contacts.size() > ParentsInContact::most_contacts ? 1 : most_parents;
    ParentsInContact found;
    for (const CandidatePair& c : contacts) {
        const auto first = parents_of[c.first], second = parents_of[c.second];
        found.all.insert(found.all.end(), first.begin(), first.end());
        found.all.insert(found.all.end(), second.begin(), second.end());
        for (const std::uint32_t p : first.first(std::min(first.size(), most)))
            for (const std::uint32_t q : second.first(std::min(second.size(), most)))
                if (p != q) found.pairs.emplace_back(std::min(p, q), std::max(p, q));
    }
    sort_unique(found.all);
    sort_unique(found.pairs);
    return found;
}

ParentsInContact parents_in_contact(const RoundedMesh& rounded) {
    std::vector<CandidatePair> contacts;
    for (const ImproperContact& c : rounded.report.contacts)
        contacts.push_back({c.triangles[0], c.triangles[1]});
    return parents_in_contact(contacts, rounded.mesh->parents_of);
}

std::vector<CandidatePair> contacts_of_sampled(std::span<const CandidatePair> contacts,
                                               const IndexLists<std::uint32_t>& parents_of) {
    std::vector<CandidatePair> found;
    for (const CandidatePair& c : contacts)
        if (is_sampled(parents_of[c.first][0]) || is_sampled(parents_of[c.second][0]))
            found.push_back(c);
    return found;
}

bool are_sampled_crowded(std::size_t contacts, std::size_t triangles) {
    return contacts <= most_sampled &&
           contacts >= std::max(RoundingReport::least_sampled,
                                triangles / rounding_tuning.sampled_crowded + 1);
}

std::vector<std::uint32_t> sample_of_parts(const IndexLists<std::uint32_t>& parents_of,
                                           std::size_t parts) {
    std::vector<std::uint32_t> sample;
    for (std::size_t first = 0, end = 0; first < parents_of.size(); first = end) {
        while (end < parents_of.size() && parents_of[end][0] == parents_of[first][0]) ++end;
        const std::size_t every = std::max<std::size_t>((end - first) / parts, 1);
        for (std::size_t t = first; t < end; t += every)
            sample.push_back(static_cast<std::uint32_t>(t));
    }
    return sample;
}

CrowdedContacts::CrowdedContacts(const IndexLists<std::uint32_t>& parents_of,
                                 std::size_t input_triangles, std::size_t most) :
    parents_of_(parents_of),
    most_(most), is_in_contact_(input_triangles) {
    TERRANE_ASSERT(most == 0 || most > ParentsInContact::most_contacts);
}

bool CrowdedContacts::adds_nothing(const CandidatePair& contact) const {
    if (!is_full()) return false;
    const auto is_known = [&](std::uint32_t parent) {
        return is_in_contact_[parent].load(std::memory_order_relaxed);
    };
    const auto first = parents_of_[contact.first], second = parents_of_[contact.second];
    if (!std::all_of(first.begin(), first.end(), is_known) ||
        !std::all_of(second.begin(), second.end(), is_known))
        return false;
    const std::uint64_t pair = pair_number(first[0], second[0]);
    if (pair == 0) return true;
    const Shard& shard = shards_[shard_of(pair)];
    const std::lock_guard lock(shard.mutex);
    return shard.pairs.contains(pair);
}

void CrowdedContacts::add(const CandidatePair& contact) {
    const auto first = parents_of_[contact.first], second = parents_of_[contact.second];
    for (const auto parents : {first, second})
        for (const std::uint32_t p : parents)
            is_in_contact_[p].store(true, std::memory_order_relaxed);
    if (const std::uint64_t pair = pair_number(first[0], second[0]); pair != 0) {
        Shard& shard = shards_[shard_of(pair)];
        const std::lock_guard lock(shard.mutex);
        shard.pairs.insert(pair);
    }
    count_.fetch_add(1, std::memory_order_relaxed);
}

ParentsInContact CrowdedContacts::parents() const {
    ParentsInContact found;
    for (std::uint32_t p = 0; p < is_in_contact_.size(); ++p)
        if (is_in_contact_[p].load(std::memory_order_relaxed)) found.all.push_back(p);
    for (const Shard& shard : shards_)
        for (const std::uint64_t pair : shard.pairs)
            found.pairs.emplace_back(static_cast<std::uint32_t>(pair >> 32),
                                     static_cast<std::uint32_t>(pair));
    std::sort(found.pairs.begin(), found.pairs.end());
    return found;
}

} // namespace terrane::rounding::detail
