// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Repairs doubles where they lie: moves few vertices to doubles nearby, snaps others to fine grids, and
// divides what still crosses. It works on a mesh, or on a part of one, where it does the same or tells
// which part it needs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/detail/decimal_frame.hpp>
#include <terrane/algorithms/rounding/detail/snapped_input.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>
#include <terrane/algorithms/search/box_cover.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::rounding::detail {

/// How doubles are repaired.
struct RepairTask {
    const KeptPlanes& kept;   ///< coordinates that stay
    double limit = 0;         ///< of the deviation of the state, with the part that is used up
    double used = 0;          ///< of the limit, as the input was moved
    unsigned max_rounds = 0;  ///< of moving and snapping
    std::size_t hopeless = 0; ///< least number of contacts that are not divided
    bool is_whole = true;     ///< see Repair::operator()
    bool tests_all = false;   ///< whether searches test all pairs
    std::array<double, 3> largest{}; ///< grids are made for absolute coordinates this large, per
                                     ///< axis, and for those of the state
    const BoxCover* covered{}; ///< all triangles that overlap one of these are in the state; null:
                               ///< it has the whole mesh
};

/// Returns a bound of the distance of surfaces from where they were before the input was moved.
inline double deviation_of(const RoundingState& state, double moved) {
    return moved == 0 ? state.deviation : (state.deviation + moved) * (1 + 0x1p-52);
}

/// Return the least number of contacts that is too large for a mesh of this size: crowded ones are left
/// for a moved input, hopeless ones are not divided.
std::size_t crowded_from(std::size_t triangles);
std::size_t hopeless_from(std::size_t triangles);

/// Finds the pairs that meet improperly. Afterwards only their corners are dirty. Two triangles without
/// a dirty corner never meet improperly; `tests_all` tests them all the same. `is_improper` may leave
/// pairs out.
std::vector<CandidatePair> find_contacts(RoundingState& state, bool tests_all,
                                         const PairFilter& is_improper, const Run& run);

/// Repairs a state in rounds, and keeps the mesh with fewest contacts.
class Repair {
public:
    Repair(RoundingState& state, const RepairTask& task, const Run& run) :
        state_(state), task_(task), run_(run) {}

    /// Performs the rounds. `pairs`: those that meet improperly, before and after. With a whole
    /// arrangement it ends as soon as a round does not help much, as the input can be snapped instead.
    /// The removed part of an arrangement would then have to be decided again, perhaps otherwise.
    /// Therefore a part of one gets coarser grids, too, each as long as it removes contacts.
    void operator()(std::vector<CandidatePair>& pairs);

    /// Returns the grid of these digits, or the coarsest finer one within the limit; no grid fits: none.
    [[nodiscard]] std::optional<SnapGrid> grid(int digits) const;
    /// Snaps what is in contact to a grid, round after round. Returns whether nothing is in contact then.
    bool on_grid(const SnapGrid& grid);

    /// Merges equal points and drops triangles without area, as RoundingState::tidy does. Returns
    /// false, and does nothing, if what it needs is missing.
    bool tidy();
    /// Finds all contacts, or some more than `most`, after which the state is of no use; none if what
    /// it needs is missing.
    std::vector<CandidatePair> contacts(std::size_t most = SIZE_MAX);

    [[nodiscard]] unsigned rounds() const { return rounds_; }
    /// Returns the boxes that have to be covered so that a part is repaired as the whole. If there are
    /// any, the state is unfinished.
    [[nodiscard]] const std::vector<Box>& missing() const { return missing_; }
    /// Returns how many boxes were compared for that.
    [[nodiscard]] std::uint64_t compared() const { return compared_; }
    /// Returns whether triangles may have changed, not points alone.
    [[nodiscard]] bool has_snapped() const { return has_snapped_; }

private:
    void search_nearby(std::vector<CandidatePair>& pairs);
    bool snap_round(std::span<const CandidatePair> pairs, const SnapGrid& grid);
    bool snap_corners(std::span<const CandidatePair> pairs, const SnapGrid& grid);
    bool divide_again(std::size_t most_pairs);
    [[nodiscard]] double deviation() const { return deviation_of(state_, task_.used); }
    bool has_all_near_dirty();
    bool has_all_in(std::span<const Box> boxes);
    [[nodiscard]] bool is_stuck() const { return !missing_.empty() || run_.stop.stop_requested(); }

    RoundingState& state_;
    const RepairTask& task_;
    const Run& run_;
    const Run quiet_ =
        without_progress(run_); ///< for one round, whose share says nothing of others
    unsigned rounds_ = 0;
    bool has_snapped_ = false;
    std::vector<Box> missing_;
    std::uint64_t compared_ = 0;
};

} // namespace terrane::rounding::detail
