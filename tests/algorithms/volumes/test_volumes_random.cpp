// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The oracle judges random models of planes, sheets, polyhedra and dangling pieces.
#include <terrane/algorithms/volumes/volumes.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/exact_numbers.hpp"
#include "support/random_models.hpp"
#include "support/volume_oracle.hpp"

using namespace terrane;
using namespace test_support;

namespace {

void judge_model(std::uint64_t seed, std::size_t& blocks) {
    ModelMaker maker(seed);
    const auto surfaces = maker.model();
    INFO("seed " << seed);
    const auto arrangement = arrange(surfaces);
    REQUIRE(arrangement);
    const auto volumes = find_volumes(arrangement.value());
    INFO((volumes ? std::string() : volumes.error().message()));
    REQUIRE(volumes);
    if (arrangement.value().triangles.empty()) return;
    const VolumeOracle judge(arrangement.value());
    REQUIRE(volumes.value().block_count() == judge.block_count());
    blocks += judge.block_count();
    for (int i = 0; i < 4; ++i)
        REQUIRE(judge.flaw_on_segment(volumes.value(), maker.random).empty());
    const auto expected = judge.measures(volumes.value());
    const auto exact = test_support::exact_numbers(arrangement.value(), volumes.value());
    mpq_class sum;
    for (std::size_t v = 0; v < exact.size(); ++v) {
        REQUIRE(exact[v] == expected[v]);
        REQUIRE((v == 0 ? volumes.value().total : volumes.value().measures[v]) ==
                Approx(expected[v].get_d()).epsilon(1e-15));
        if (v == 0) continue;
        REQUIRE(sgn(expected[v]) > 0);
        sum += expected[v];
    }
    REQUIRE(sum == expected[0]);
}

} // namespace

TEST_CASE("volumes: random models hold for the oracle", "[volumes][once]") {
    std::size_t blocks = 0;
    const char* const wanted = std::getenv("TERRANE_RANDOM_MODELS"); // for longer runs
    const int models = wanted != nullptr ? std::atoi(wanted) : cases(1000);
    for (int seed = 0; seed < models; ++seed) judge_model(static_cast<std::uint64_t>(seed), blocks);
    CHECK(blocks > 3 * static_cast<std::size_t>(models)); // otherwise the models are too easy
}
