// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rounds one arrangement, the input of which may have been moved, and repairs what then crosses
// where it lies.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/regions/regions_over.hpp>
#include <terrane/algorithms/rounding/detail/pair_decisions.hpp>
#include <terrane/algorithms/rounding/detail/parents_in_contact.hpp>
#include <terrane/algorithms/rounding/detail/separation.hpp>
#include <terrane/algorithms/rounding/detail/snapped_input.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane::rounding::detail {

/// The values that all attempts to round one arrangement share.
struct Task {
    const RoundingOptions& options;
    double limit;           ///< of surface_deviation
    const KeptPlanes& kept; ///< as given, in no frame
    const Run& run;
    std::array<double, 3> largest{};             ///< see RepairTask
    bool repairs_places = false;                 ///< whether places are repaired that are left
    unsigned most_attempts = options.max_rounds; ///< with moved inputs
    std::optional<RoundedMesh>* spare{};         ///< gets a conforming mesh that is ill-joined, or
                                                 ///< that are_parted() is true of
};

/// How many contacts a rounding repairs at most.
enum class Repairs {
    sparse,   ///< fewer than are crowded
    possible, ///< fewer than are hopeless
    all       ///< any number, but for a whole arrangement: see Rounding
};

/// Rounds an arrangement once. A moved input may have used up the limit: see surface_deviation.
class Rounding {
public:
    /// Rounds `a`, the input of which was moved. If there are more contacts than it repairs, it
    /// leaves them all: what operator() returns then has no mesh. With Repairs::all it always has
    /// one; if `a` is whole and contacts are hopelessly many, it reports the first of them.
    Rounding(const Arrangement& a, const MovedInput& moved, Repairs repairs, const Task& task) :
        arrangement_(a), moved_(moved), repairs_(repairs), task_(task), options_(task.options),
        run_(task.run) {}

    Result<RoundedMesh> operator()() {
        to_nearest();
        if (moved_.largest == 0 && deviation() > task_.limit) return too_far();
        tell(0.2);
        if (state_.is_torn && repairs_ == Repairs::possible) {
            left_.emplace();
            return std::move(out_);
        }
        if (repairs_ != Repairs::all || arrangement_.state->whole)
            crowd_.emplace(state_.parents_of, arrangement_.state->corners.size(),
                           std::max(left_from(), ParentsInContact::most_contacts + 1));
        const bool looks_for_crowd = repairs_ == Repairs::sparse;
        if (looks_for_crowd && changed_ && leaves_crowd(sampled_contacts())) return std::move(out_);
        auto pairs = first_contacts_until_full();
        tell(0.7); // the shares are estimates, not measured
        if (run_.stop.stop_requested()) return interrupted();
        const bool is_full = crowd_ && crowd_->is_full();
        if (looks_for_crowd && !changed_ && !is_full &&
            leaves_crowd(contacts_of_sampled(pairs, state_.parents_of)))
            return std::move(out_);
        out_.report.naive_contacts = is_full ? crowd_->most() : pairs.size();
        if (repairs_ != Repairs::all &&
            (out_.report.naive_contacts >= left_from() || state_.is_torn)) {
            leave(pairs);
            return std::move(out_);
        }
        crowd_.reset();
        is_hopeless_ = is_full || state_.is_torn;
        if (is_full)
            pairs = lowest_contacts(RoundingReport::most_counted + 1);
        else
            state_.only_dirty(pairs);
        find_first_regions();
        tell(0.9);
        if (!pairs.empty() && !is_hopeless_) repair(pairs);
        if (changed_ && pairs.empty()) state_.open_closed_parts(deviation());
        if (run_.stop.stop_requested()) return interrupted();
        finish(pairs);
        tell(1);
        return std::move(out_);
    }

    /// The parents of the contacts, if they were left.
    [[nodiscard]] const std::optional<ParentsInContact>& left() const { return left_; }

private:
    static Error interrupted() { return {ErrorCode::interrupted, "stopped on request", ""}; }
    void tell(double share) const {
        if (run_.progress) run_.progress("round", share);
    }
    [[nodiscard]] std::size_t left_from() const;
    bool leaves_crowd(std::span<const CandidatePair> sampled);
    void leave(std::span<const CandidatePair> pairs);
    void take_sample();
    [[nodiscard]] ParentsInContact contacts_of_sample() const;
    void repair(std::vector<CandidatePair>& pairs);
    void to_nearest();
    void constructed_to_nearest(std::size_t v);
    [[nodiscard]] Point3 given(const Point3& input) const;
    [[nodiscard]] double deviation() const;
    [[nodiscard]] Error too_far() const;
    [[nodiscard]] bool is_improper(const CandidatePair& p) const;
    bool is_found(const CandidatePair& p);
    std::vector<CandidatePair> sampled_contacts();
    std::vector<CandidatePair> first_contacts_until_full();
    std::vector<CandidatePair> first_contacts(const Run& run);
    std::vector<CandidatePair> contacts_in_frame(const Run& run);
    std::vector<CandidatePair> lowest_contacts(std::size_t most);
    [[nodiscard]] MovedParts moved_parts() const;
    [[nodiscard]] Pools find_pools() const;
    std::vector<CandidatePair>
    contacts_in_pools(const Pools& pools, std::span<const std::uint32_t> patches, const Run& run);
    std::vector<CandidatePair> contacts(const Run& run);
    void find_first_regions();
    void finish(std::span<const CandidatePair> pairs);
    [[nodiscard]] bool tests_all() const { return options_.check.method == PairCheck::full; }
    void report_moves();
    void report_vanished();

    const Arrangement& arrangement_;
    const MovedInput& moved_;
    const Repairs repairs_;
    const Task& task_;
    const RoundingOptions& options_;
    const Run& run_;
    const Run quiet_ =
        without_progress(run_); ///< for one round, whose share says nothing of others
    RoundingState state_;
    std::optional<CrowdedContacts> crowd_; ///< of the first search, unless it repairs all
    std::vector<std::uint32_t> sample_;    ///< of parts, if it tells enough of a full crowd
    bool ends_when_full_ = false;          ///< whether the first search ends once the crowd is full
    std::stop_source full_;                ///< stops the first search then
    bool is_hopeless_ = false;             ///< whether nothing was repaired
    std::optional<ParentsInContact> left_;
    FirstSearch first_search_;       ///< how the first search decided pairs, if they are counted
    bool changed_ = false;           ///< whether the triangles differ from the arrangement's
    std::optional<Regions> regions_; ///< set in advance while the triangles do not differ
    RoundedMesh out_;
};

} // namespace terrane::rounding::detail
