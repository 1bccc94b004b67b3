// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The changes still to be tried, and the effort that they may take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <terrane/algorithms/optimisation/detail/constants.hpp>

namespace terrane::optimisation::detail {

/// The cells or vertices that are still to be tried, in order.
class Queue {
public:
    explicit Queue(std::vector<std::uint32_t> items) : items_(std::move(items)) {}

    [[nodiscard]] bool is_empty() const { return first_ == items_.size() && kept_.empty(); }

    /// Returns the next items of which `claim` says that they do not depend on those before; those
    /// of which it does not come again first.
    template <class Claim>
    std::vector<std::uint32_t> next(const Claim& claim) {
        std::vector<std::uint32_t> batch, later;
        const auto take = [&](std::uint32_t item) {
            (claim(item) ? batch : later).push_back(item);
        };
        std::size_t k = 0;
        for (; k < kept_.size() && batch.size() < constants.batch; ++k) take(kept_[k]);
        later.insert(later.end(), kept_.begin() + static_cast<std::ptrdiff_t>(k), kept_.end());
        while (first_ < items_.size() && batch.size() < constants.batch &&
               later.size() < constants.batch)
            take(items_[first_++]);
        kept_ = std::move(later);
        return batch;
    }

    /// Adds what could not be changed since another change came first.
    void again(std::uint32_t item) { kept_.push_back(item); }

private:
    std::vector<std::uint32_t> items_;
    std::size_t first_ = 0;
    std::vector<std::uint32_t> kept_;
};

/// The effort that may still be made, in tetrahedra that are measured.
class Budget {
public:
    Budget() = default;
    Budget(std::size_t most, std::size_t cells) :
        most_(most), credit_(static_cast<double>(constants.effort_per_cell * cells)) {}

    [[nodiscard]] bool is_spent() const { return spent_ >= most_; }
    [[nodiscard]] bool is_over() const { return is_spent() || credit_ <= 0; }
    [[nodiscard]] std::size_t spent() const { return spent_; }
    void spend(std::size_t effort) {
        spent_ += effort;
        credit_ -= static_cast<double>(effort);
    }
    /// Adds as much again.
    void renew(std::size_t most, std::size_t cells) {
        most_ = spent_ + most;
        credit_ = static_cast<double>(constants.effort_per_cell * cells);
    }
    /// Adds what a change is worth to the effort that may be made in vain.
    void reward() { credit_ += static_cast<double>(constants.effort_per_change); }

private:
    std::size_t most_ = 0, spent_ = 0;
    double credit_ = 0; ///< work ends where it has too little success
};

} // namespace terrane::optimisation::detail
