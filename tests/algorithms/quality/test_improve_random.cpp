// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Improves random models after arranging and rounding them; other stages check the invariants.
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/quality/bounds_back.hpp>
#include <terrane/algorithms/quality/improve.hpp>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/structure/structure.hpp>

#include "support/effort.hpp"
#include "support/random_models.hpp"

using namespace terrane;
using namespace test_support;

namespace {

struct Judged {
    std::size_t blocks = 0;
    std::vector<Point3> corners; ///< sorted
    std::size_t lines = 0, patches = 0, interfaces = 0;

    friend bool operator==(const Judged&, const Judged&) = default;
};

Judged structure_of(const Mesh& mesh) {
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    const Structure s = build_structure(mesh, volumes.value());
    Judged judged{
        volumes.value().block_count(), {}, s.lines.size(), s.patches.size(), s.interfaces.size()};
    for (const ModelCorner& c : s.corners) judged.corners.push_back(mesh.vertices[c.vertex]);
    std::sort(judged.corners.begin(), judged.corners.end());
    return judged;
}

std::set<std::uint32_t> regions_of(const Mesh& mesh) {
    return {mesh.regions_of.values.begin(), mesh.regions_of.values.end()};
}

struct Means {
    double before = 0, after = 0; ///< sums of the mean q of models
};

/// Improves one model and checks all guarantees. Returns whether there was something to improve.
bool judge(std::uint64_t seed, Means& means, int& jumped) {
    ModelMaker maker(seed);
    const auto exact = arrange(maker.model());
    REQUIRE(exact);
    const auto rounded = round_to_doubles(exact.value());
    REQUIRE(rounded);
    const Mesh& mesh = rounded.value().mesh;
    if (!rounded.value().report.clean || mesh.triangles.empty()) return false;
    ImproveOptions options;
    options.edge_length = 1 + 0.5 * random_int(maker.random, 0, 4);
    options.max_deviation = random_int(maker.random, 0, 1) ? 0.3 : 0;
    options.passes = 3;
    if (seed % 5 < 3)
        for (int list = random_int(maker.random, 1, 2); list > 0; --list) {
            const int vertex =
                random_int(maker.random, 0, static_cast<int>(mesh.vertices.size()) - 1);
            options.refinements.push_back({{mesh.vertices[static_cast<std::size_t>(vertex)], 0.4}});
        }
    const auto improved = improve(mesh, options);
    INFO("seed " << seed << (improved ? "" : ": " + improved.error().message()));
    REQUIRE(improved);
    const Mesh& better = improved.value().mesh;
    const auto report =
        check(std::vector{Surface{"", Role::unknown, better.vertices, better.triangles}});
    REQUIRE(report);
    REQUIRE(report.value().clean());
    REQUIRE(regions_of(better) == regions_of(mesh));
    // The flag is false for seed 316, for example, where a piece of size 1e-17 changes sides.
    const bool kept = structure_of(better) == structure_of(mesh);
    REQUIRE(kept == improved.value().report.sides_kept);
    jumped += !kept;
    const auto back = bounds_back(mesh, improved.value(), options);
    REQUIRE(back);
    for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
        const double bound = improved.value().report.bound_of[s];
        REQUIRE(sampled_distance(surface_of_mesh(better, s), surface_of_mesh(mesh, s)) <= bound);
        REQUIRE(back.value()[s] <= bound);
    }
    means.before += improved.value().report.before.q.mean;
    means.after += improved.value().report.after.q.mean;
    return true;
}

} // namespace

TEST_CASE("improve: random models stay conforming, with the same blocks, corners, lines",
          "[improve]") {
    const char* const wanted = std::getenv("TERRANE_RANDOM_MODELS"); // for longer runs
    const int models = wanted != nullptr ? std::atoi(wanted) : cases(200);
    int improved = 0;
    int jumped = 0;
    Means means;
    for (int seed = 0; seed < models; ++seed)
        improved += judge(static_cast<std::uint64_t>(seed), means, jumped);
    CHECK(500 * jumped <= models);
    CHECK(10 * improved > 9 * models);
    CHECK(means.after > means.before + 0.2 * improved);
}

TEST_CASE("improve: random models for which a guarantee once failed", "[improve]") {
    // 509, 538: a vertex moved to the position of another; 1143: slivers, and the bound back.
    Means means;
    int jumped = 0;
    for (const std::uint64_t seed : {509U, 538U, 1143U}) CHECK(judge(seed, means, jumped));
    CHECK(jumped == 0);
}
