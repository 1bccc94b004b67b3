// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Winding numbers of operands in the volumes of an exact arrangement.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane {

/// Returns the sign of the turn of an input triangle, which lies in the plane of the projection.
Sign turn_of(const Arrangement& exact, std::uint32_t input, Axis axis);

/// Operands of an arrangement, each of one or more surfaces.
struct Operands {
    std::span<const std::uint32_t> of_surface; ///< per surface: its operand, or no_index
    std::span<const std::string> names;        ///< per operand: what an error calls it
};

/// Winding numbers of all operands in all volumes.
class Windings {
public:
    Windings(std::size_t volumes, std::size_t operands) :
        operands_(operands), numbers_(volumes * operands) {}

    /// Returns the winding numbers in a volume, one per operand.
    [[nodiscard]] std::span<const int> operator[](std::size_t volume) const {
        return {numbers_.data() + volume * operands_, operands_};
    }
    [[nodiscard]] std::span<int> operator[](std::size_t volume) {
        return {numbers_.data() + volume * operands_, operands_};
    }

private:
    std::size_t operands_;
    std::vector<int> numbers_;
};

/// Finds the winding numbers: all are 0 outside, and change across a triangle by its multiplicity in an
/// operand, the number of its parents there that face as it does, minus the number of the others.
/// Errors: not_closed if an operand bounds no solid, so that its numbers would depend on the way; it says
/// where. Cost: linear in triangles times operands.
Result<Windings> find_windings(const Arrangement& exact, const Volumes& volumes,
                               const Operands& operands);

/// Whether an operand ends somewhere: an odd number of its triangles meet at an edge. Cost: linear.
bool is_open(const Arrangement& exact, const Operands& operands, std::uint32_t operand);

} // namespace terrane
