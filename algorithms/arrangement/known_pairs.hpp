// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Passes the candidate pairs of one arrangement on to the next one, where most surfaces have not
// changed: the gaps of a model are closed in several arrangements, and the versions of a model share
// surfaces.
//
// If both triangles of a pair have kept their corners, the pair is not searched for again. If the
// two did not meet, they are not tested again. The next arrangement is the mesh that arrange() makes
// without this object. No pairs are kept where the search or the test left some out: at crowded
// vertices, in pencils, and in pools.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane {

/// The candidate pairs of a soup.
struct Candidates {
    std::vector<CandidatePair> pairs; ///< sorted, unique
    std::vector<char> known_apart; ///< per pair: 1 if an earlier arrangement found that the two do
                                   ///< not meet, and will not when their points are rounded;
                                   ///< or empty
};

/// What the last arrangement with this object tested; nothing at first. Several threads may use one
/// object. An arrangement takes what is there, and leaves its own at the end; another one that begins
/// in the meantime finds nothing.
class KnownPairs {
public:
    KnownPairs();
    ~KnownPairs();
    KnownPairs(const KnownPairs&) = delete;
    KnownPairs& operator=(const KnownPairs&) = delete;

    /// Returns the pairs that candidate_pairs() finds in a soup. Returns nothing if most triangles
    /// are new, if the new ones have very many pairs, or if a vertex is crowded: the caller then
    /// searches all. patches: per triangle, see find_injective_patches.
    [[nodiscard]] std::optional<Candidates>
    candidates(const Soup& soup, std::span<const std::uint32_t> patches, const Run& run = {});

    /// Keeps the candidates of a soup, all of them, and those that are near (see Contacts::near),
    /// sorted, for the next call of candidates(). points, triangles: those of the soup.
    void keep(std::vector<Point3> points, std::span<const Triangle> triangles,
              std::span<const std::uint32_t> patches, std::vector<CandidatePair> candidates,
              std::span<const CandidatePair> near);

private:
    struct Kept;

    std::mutex mutex_;
    std::unique_ptr<const Kept> kept_;
};

} // namespace terrane
