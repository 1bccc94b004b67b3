// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the input triangles that layers use as a whole, so that their subdivision can be undone:
// walls and dropped surfaces leave many of these.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/layers/detail/resolver.hpp>

namespace terrane::layers::detail {

class WholeTriangles {
public:
    /// `layers`: the triangles of each layer. The arrangement must outlive the object.
    WholeTriangles(const Arrangement& arrangement, std::span<const Set> layers);

    /// Returns the input triangle that replaces the part, if any.
    [[nodiscard]] std::optional<std::uint32_t> operator()(std::uint32_t part) const {
        const std::uint32_t t = whole_of_[part];
        return t != UINT32_MAX && is_whole_[t] ? std::optional(t) : std::nullopt;
    }

private:
    void find_parts();
    void exclude_partly_used(const Set& layer);
    void exclude_divided(std::span<const Set> layers);

    const Arrangement& a_;
    Set whole_of_;               ///< per triangle of the arrangement: its only input triangle
    std::vector<Set> parts_;     ///< per input triangle
    std::vector<bool> is_whole_; ///< per input triangle
};

} // namespace terrane::layers::detail
