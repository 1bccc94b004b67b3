// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tells which input triangles have parts that meet improperly.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::rounding::detail {

/// The parents of triangles in contact: input triangles.
struct ParentsInContact {
    /// A parent of each of two triangles in contact, the lower one first: of the first four, which
    /// are all in one plane, or of the first one if more than `most_contacts` pairs are in contact.
    /// Ascending, without repetitions.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs{};
    std::vector<std::uint32_t> all{}; ///< every parent of a triangle in contact; ascending

    static constexpr std::size_t most_contacts = RoundingReport::most_counted;
};

ParentsInContact parents_in_contact(std::span<const CandidatePair> contacts,
                                    const IndexLists<std::uint32_t>& parents_of);
/// Does the same for the contacts that remain after rounding.
ParentsInContact parents_in_contact(const RoundedMesh& rounded);

/// Tells whether an input triangle is in a sample of one in 32. Whether contacts are crowded, and
/// which input triangles are in contact then, shows in the contacts of the sample.
constexpr bool is_sampled(std::uint32_t parent) {
    return parent * 0x9e3779b9U >> 27 == 0;
}
/// Returns the contacts of triangles whose first parent is sampled.
std::vector<CandidatePair> contacts_of_sampled(std::span<const CandidatePair> contacts,
                                               const IndexLists<std::uint32_t>& parents_of);
/// Tells whether this number of contacts of sampled triangles makes them crowded in a mesh of this
/// size. CrowdedContacts judges more than most_sampled.
bool are_sampled_crowded(std::size_t contacts, std::size_t triangles);
constexpr std::size_t most_sampled = ParentsInContact::most_contacts / 32;

/// Returns a sample of the triangles, ascending. If a first parent has fewer than `parts` parts, the
/// sample contains them all. Otherwise it contains `parts` to 2 * `parts` - 1 of them, evenly chosen.
/// The parts of a first parent are consecutive, as in an arrangement.
std::vector<std::uint32_t> sample_of_parts(const IndexLists<std::uint32_t>& parents_of,
                                           std::size_t parts);

/// Collects the parents of very many contacts, so that the contacts need neither be listed nor all
/// be tested. Once it is full, a pair whose parents are known adds nothing. The collection
/// at the end does not depend on the order, so that threads may add at the same time.
class CrowdedContacts {
public:
    /// The collector is full once it has `most` contacts: more than
    /// ParentsInContact::most_contacts, or 0, so that it is full from the start.
    CrowdedContacts(const IndexLists<std::uint32_t>& parents_of, std::size_t input_triangles,
                    std::size_t most);

    /// The number of contacts that it takes to be full.
    [[nodiscard]] std::size_t most() const { return most_; }
    [[nodiscard]] bool is_full() const { return count_.load(std::memory_order_relaxed) >= most_; }
    /// Whether it is full, and no parents would be new.
    [[nodiscard]] bool adds_nothing(const CandidatePair& contact) const;
    void add(const CandidatePair& contact);
    /// Returns the parents, those of pairs as of more than most_contacts. It must be full.
    [[nodiscard]] ParentsInContact parents() const;

private:
    struct Shard {
        mutable std::mutex mutex{};
        std::unordered_set<std::uint64_t> pairs{};
    };

    const IndexLists<std::uint32_t>& parents_of_;
    const std::size_t most_;
    std::atomic<std::size_t> count_{0};
    std::vector<std::atomic<bool>> is_in_contact_; ///< per input triangle
    std::array<Shard, 64> shards_;                 ///< pairs of first parents
};

} // namespace terrane::rounding::detail
