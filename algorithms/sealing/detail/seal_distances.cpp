// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/detail/seal_distances.hpp>

#include <algorithm>

namespace terrane::sealing::detail {

SealDistances::SealDistances(double general, std::span<const SealRule> rules) :
    general_(general), largest_(general) {
    for (const SealRule& rule : rules) {
        if (rule.other)
            of_pair_[{std::min(rule.surface, *rule.other), std::max(rule.surface, *rule.other)}] =
                rule.distance;
        else
            of_surface_[rule.surface] = rule.distance;
        largest_ = std::max(largest_, rule.distance);
    }
}

double SealDistances::between(std::uint32_t surface, std::uint32_t other) const {
    if (const auto pair = of_pair_.find({std::min(surface, other), std::max(surface, other)});
        pair != of_pair_.end())
        return pair->second;
    const auto one = of_surface_.find(surface), two = of_surface_.find(other);
    if (one == of_surface_.end() && two == of_surface_.end()) return general_;
    if (one == of_surface_.end()) return two->second;
    if (two == of_surface_.end()) return one->second;
    const auto [less, more] = std::minmax(one->second, two->second);
    return less == 0 ? 0 : more;
}

} // namespace terrane::sealing::detail
