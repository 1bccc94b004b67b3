// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Passes what one arrangement found about its triangles on to the next one, where most surfaces have not
// changed: the gaps of a model are closed in several arrangements, and the versions of a model share
// surfaces.
//
// If a surface has kept its triangles, its patches are taken over. Where all triangles at a vertex have
// kept their corners, so are its edges. If both triangles of a pair have kept their corners, the pair is
// neither searched for nor tested again: its contact is taken over, with the vertices by their new
// numbers. The next arrangement is the mesh that arrange() makes without this object. Nothing is kept
// where the search or the test left pairs out: at crowded vertices, in pencils, and in pools.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/intersection/tested_pairs.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane {

/// The candidate pairs of a soup.
struct Candidates {
    std::vector<CandidatePair> pairs; ///< sorted, unique
    TestedPairs tested;               ///< what earlier arrangements found; or empty
};

/// The triangles of an arrangement, and what it found about them.
struct KeptTriangles;

/// The triangles of a soup that an earlier arrangement had, with the same corners in the same order.
class KnownInSoup {
public:
    KnownInSoup(std::unique_ptr<const KeptTriangles> kept, const Soup& soup);
    ~KnownInSoup();
    KnownInSoup(const KnownInSoup&) = delete;
    KnownInSoup& operator=(const KnownInSoup&) = delete;

    /// Finds them again, after triangles of the soup were removed.
    void find_again();
    /// Returns what group_edges() finds in the soup. The edges of triangles that are in it are taken
    /// over.
    [[nodiscard]] EdgeSides edges(const Run& run = {}) const;
    /// Returns what find_injective_patches() finds in the soup. Only surfaces with other triangles than
    /// before are looked at.
    [[nodiscard]] InjectivePatches patches(const Run& run = {}) const;
    /// Returns the pairs that candidate_pairs() finds in the soup. Returns nothing if most triangles
    /// are new, if the new ones have very many pairs, or if a vertex is crowded: the caller then
    /// searches all. patches: per triangle, see find_injective_patches.
    [[nodiscard]] std::optional<Candidates> candidates(std::span<const std::uint32_t> patches,
                                                       const Run& run = {}) const;

private:
    [[nodiscard]] std::uint32_t old_surface(std::uint32_t first, std::uint32_t last) const;
    [[nodiscard]] std::vector<std::uint32_t> point_names() const;

    const std::unique_ptr<const KeptTriangles> kept_;
    const Soup& soup_;
    std::vector<std::uint32_t> old_of_; ///< per triangle: the kept one, or no_index
};

/// Keeps the findings of the last arrangement with this object; it begins empty. Several threads
/// may use one object. An arrangement takes the findings, and leaves its own at the end; another
/// one that begins in the meantime finds nothing.
class KnownTriangles {
public:
    KnownTriangles();
    ~KnownTriangles();
    KnownTriangles(const KnownTriangles&) = delete;
    KnownTriangles& operator=(const KnownTriangles&) = delete;

    /// Takes the findings and finds them in a soup, which must outlive the result. Returns null if
    /// nothing is there.
    [[nodiscard]] std::unique_ptr<KnownInSoup> find_in(const Soup& soup);

    /// Keeps the edges and patches of a soup, and its candidates, all of which have been tested.
    /// points: those of the soup.
    void keep(std::vector<Point3> points, const Soup& soup, const InjectivePatches& patches,
              Candidates candidates);

private:
    std::mutex mutex_;
    std::unique_ptr<const KeptTriangles> kept_;
};

/// Arranges surfaces and takes over what `known` has of the same triangles. The result is that of
/// arrange() without it; statistics.known says how many pairs needed no test.
Result<Arrangement> arrange(std::span<const Surface> surfaces, const ArrangeOptions& options,
                            KnownTriangles& known, const Run& run = {});

} // namespace terrane
