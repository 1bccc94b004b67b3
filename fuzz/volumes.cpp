// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: there are as many volumes as the homology of the triangles implies; segments cross from
// one to the other as stated; their measures are exact. The same holds for the blocks of a
// conforming rounded mesh.
#include "property.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

#include <random>

#include "support/exact_numbers.hpp"
#include "support/volume_oracle.hpp"

namespace terrane::fuzz {

Soup input(Bytes& bytes) {
    return fuzzing::soup(bytes, 24);
}

namespace {

std::string flaw_of(const Arrangement& a, const Volumes& volumes) {
    const test_support::VolumeOracle oracle(a);
    if (volumes.block_count() != oracle.block_count()) return "the number of blocks";
    for (const auto& sides : volumes.of_sides)
        for (const std::uint32_t v : sides)
            if (v >= volumes.measures.size()) return "a volume that does not exist";
    const auto expected = oracle.measures(volumes);
    const auto stated = test_support::exact_numbers(a, volumes);
    mpq_class sum;
    for (std::size_t b = 0; b < expected.size(); ++b) {
        if (stated[b] != expected[b]) return "the exact volume of a block";
        if (b > 0 && sgn(expected[b]) <= 0) return "a block without volume";
        if (b > 0) sum += expected[b];
    }
    if (sum != expected[0]) return "volumes do not add up";
    if (a.triangles.empty()) return "";
    std::mt19937_64 random(a.triangles.size()); // repeatable for equal surfaces
    for (int k = 0; k < 4; ++k)
        if (auto what = oracle.flaw_on_segment(volumes, random); !what.empty()) return what;
    return "";
}

} // namespace

std::string flaw(std::span<const Surface> surfaces) {
    const auto made = arrange(surfaces);
    if (!made) return made.error().message();
    const auto volumes = find_volumes(made.value());
    if (!volumes) return volumes.error().message();
    return flaw_of(made.value(), volumes.value());
}

} // namespace terrane::fuzz
