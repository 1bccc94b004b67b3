// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Packs boxes into 16 bytes, for a first test that never misses an overlap.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <terrane/algorithms/search/search.hpp>

namespace terrane::search {

/// A box of six 20-bit coordinates. Each coordinate has a field of 21 bits, x in the lowest. The
/// highest bit of a field is a guard, set in `high` only, so that one subtraction compares three
/// coordinates: a guard survives iff its field needs no borrow.
struct PackedBox {
    std::uint64_t low, high;

    static constexpr unsigned bits = 20;
    static constexpr unsigned field = bits + 1;
    static constexpr std::uint64_t last = (1u << bits) - 1; ///< largest coordinate
    static constexpr std::uint64_t guards = (std::uint64_t{1} << bits) |
                                            (std::uint64_t{1} << (field + bits)) |
                                            (std::uint64_t{1} << (2 * field + bits));

    [[nodiscard]] bool overlaps(const PackedBox& o) const {
        return (((o.high - low) & (high - o.low)) & guards) == guards;
    }
    /// Whether each box ends strictly beyond the start of the other along all axes. If so, the
    /// boxes that they were packed from overlap. Precondition: overlaps(o).
    [[nodiscard]] bool overlaps_inside(const PackedBox& o) const {
        constexpr std::uint64_t ones =
            1 | std::uint64_t{1} << field | std::uint64_t{1} << 2 * field;
        return ((o.high - low - ones) & (high - o.low - ones) & guards) == guards;
    }
    [[nodiscard]] std::uint32_t low_of(unsigned axis) const {
        return static_cast<std::uint32_t>((low >> (axis * field)) & last);
    }
    [[nodiscard]] std::uint32_t high_of(unsigned axis) const {
        return static_cast<std::uint32_t>((high >> (axis * field)) & last);
    }

    static PackedBox of(const std::array<std::uint64_t, 3>& low,
                        const std::array<std::uint64_t, 3>& high) {
        return {low[0] | low[1] << field | low[2] << 2 * field,
                high[0] | high[1] << field | high[2] << 2 * field | guards};
    }
    /// Returns a box that overlaps nothing: each low coordinate is 2^20.
    static constexpr PackedBox none() { return {guards, guards}; }
};

/// Eight boxes, initially none(), laid out so that two of them are compared with another at once.
class EightBoxes {
public:
    EightBoxes() {
        low_.fill(PackedBox::none().low);
        high_.fill(PackedBox::none().high);
    }

    void set(unsigned i, const PackedBox& b) {
        low_[place(i)] = b.low;
        high_[place(i)] = b.high;
    }
    PackedBox operator[](unsigned i) const { return {low_[place(i)], high_[place(i)]}; }

    /// Returns a mask whose bit i says whether box i overlaps q.
    [[nodiscard]] unsigned overlapping(const PackedBox& q) const {
        constexpr unsigned bits = PackedBox::bits, field = PackedBox::field;
        std::array<std::uint64_t, lanes> found{}; // the guards of box k, shifted down by 3 - k bits
        for (unsigned k = 0; k < per_lane; ++k)
            for (unsigned l = 0; l < lanes; ++l) {
                const std::uint64_t left =
                    (q.high - low_[lanes * k + l]) & (high_[lanes * k + l] - q.low);
                found[l] |= (left & PackedBox::guards) >> (per_lane - 1 - k);
            }
        for (std::uint64_t& f : found) // boxes with all three guards
            f = (f & f >> field & f >> 2 * field) >> (bits + 1 - per_lane) & ((1u << per_lane) - 1);
        return static_cast<unsigned>(found[0] | found[1] << per_lane);
    }

private:
    static constexpr unsigned lanes = 2, per_lane = 4;

    static unsigned place(unsigned i) { return lanes * (i % per_lane) + i / per_lane; }

    std::array<std::uint64_t, std::size_t{lanes} * per_lane> low_{}, high_{};
};

/// Maps a region onto coordinates 0 .. 2^20 - 1 of each axis and clamps coordinates outside the
/// region. The map is monotone even when rounded, so boxes that overlap still overlap when packed.
class Lattice {
public:
    explicit Lattice(const Box& region) {
        for (unsigned k = 0; k < 3; ++k) {
            half_low_[k] = region.low[k] / 2;
            const double half = region.high[k] / 2 - half_low_[k]; // no overflow
            factor_[k] = half > 0x1p-1000 ? (PackedBox::last + 1) / half : 0;
        }
    }

    [[nodiscard]] PackedBox pack(const Box& b) const {
        std::array<std::uint64_t, 3> low{}, high{};
        for (unsigned k = 0; k < 3; ++k) {
            low[k] = coordinate(k, b.low[k]);
            high[k] = coordinate(k, b.high[k]);
        }
        return PackedBox::of(low, high);
    }

private:
    [[nodiscard]] std::uint64_t coordinate(unsigned axis, double x) const {
        const double c = (x / 2 - half_low_[axis]) * factor_[axis];
        return static_cast<std::uint32_t>(std::min(std::max(c, 0.0), double{PackedBox::last}));
    }

    std::array<double, 3> half_low_{}, factor_{};
};

} // namespace terrane::search
