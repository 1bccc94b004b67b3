// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/moved_attempts.hpp>

#include <algorithm>
#include <limits>

#include <terrane/algorithms/rounding/detail/tuning.hpp>

namespace terrane::rounding::detail {
namespace {

class MovedAttempts {
public:
    MovedAttempts(MovableInput& input, double limit, unsigned most) :
        input_(input), limit_(limit), left_(most) {}

    Result<bool> operator()() {
        if (auto done = as_decimals(); !done) return done.error();
        if (auto done = as_clusters(); !done) return done.error();
        double last = 0;
        for (const int digits : rounding_tuning.coarse_digits) {
            if (is_found_) break;
            const auto grid = input_.grid(digits, limit_ - room());
            if (!grid || grid->reach() == last) break; // coarser ones are as fine
            last = grid->reach();
            if (auto done = on_grid(*grid); !done) return done.error();
            if (is_over_) break;
        }
        return is_found_;
    }

private:
    [[nodiscard]] bool may_go_on() const { return !is_found_ && !is_over_ && left_ > 0; }
    template <class How>
    Status attempt(const How& how) {
        const auto done = input_.attempt(how);
        if (!done) return done.error();
        --left_;
        is_found_ = *done == Attempted::conforming;
        is_over_ = *done == Attempted::torn;
        return Done{};
    }

    Status as_decimals() {
        if (!may_go_on()) return Done{};
        const auto frame = input_.decimal_frame();
        if (!frame) return frame.error();
        if (!*frame || 2 * (*frame)->largest_error() > limit_) return Done{};
        if (auto done = attempt(**frame); !done) return done;
        is_over_ = false; // a grid may do
        return Done{};
    }

    Status as_clusters() {
        if (!may_go_on()) return Done{};
        const auto frame = input_.cluster_frame();
        if (!frame) return frame.error();
        if (!*frame || 2 * (*frame)->largest_error() > limit_) return Done{};
        return attempt(**frame);
    }

    /// Snaps the vertices of triangles in contact to a grid, then those of what is in contact then.
    Status on_grid(const SnapGrid& grid) {
        for (unsigned w = 0; w < rounding_tuning.widenings && may_go_on(); ++w) {
            if (auto done = attempt(grid); !done) return done;
            if (!may_go_on()) break;
            const auto more = input_.choose_more();
            if (!more) return more.error();
            if (!*more) break;
        }
        return Done{};
    }

    /// Returns what is left for the repair of the doubles after the input was moved.
    [[nodiscard]] double room() const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        double sum = 0;
        for (const int digits : rounding_tuning.fine_digits)
            if (const auto grid = input_.grid(digits, infinity)) sum += grid->reach();
        return std::min(sum, limit_ / 4);
    }

    MovableInput& input_;
    const double limit_;
    unsigned left_; ///< number of attempts
    bool is_found_ = false, is_over_ = false;
};

} // namespace

Result<bool> attempt_moves(MovableInput& input, double limit, unsigned most) {
    return MovedAttempts(input, limit, most)();
}

} // namespace terrane::rounding::detail
