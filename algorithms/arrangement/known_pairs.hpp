// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Keeps the pairs of triangles that one arrangement found and tested for the next one, in which most
// surfaces are the same: those of a model while its gaps are closed, or of the versions of a model.
//
// A pair of triangles that both have kept their corners is not searched for again, nor tested if the
// two stay apart. The next arrangement is the same mesh as without this. Nothing is kept where
// triangles meet so densely that pairs were left out: at crowded vertices, in pencils, and in pools.
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
    std::vector<char> known_apart; ///< per pair: whether an earlier arrangement found that the two
                                   ///< stay apart, also when their points are rounded; or empty
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

    /// Returns the candidates of a soup: what candidate_pairs() returns. Returns nothing where it
    /// would cost more than to find them anew, or where some may have to be left out. patches: per
    /// triangle, see find_injective_patches.
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
