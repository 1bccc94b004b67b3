// SPDX-License-Identifier: LGPL-3.0-or-later
#include "damages.hpp"
#include "support/corefine_oracle.hpp"
#include "support/random_models.hpp"
#include "support/read.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"
#include "support/solids.hpp"

#include <terrane/algorithms/judge/judge.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <set>

namespace {

using namespace terrane;
using namespace test_support;

MeshJudgement judged(const std::vector<Surface>& output, const std::vector<Surface>& inputs,
                     std::optional<BooleanOperation> operation = {}) {
    JudgeOptions options;
    options.operation = operation;
    auto found = judge(output, inputs, options);
    INFO((found ? std::string() : found.error().message()));
    REQUIRE(found);
    return std::move(found).value();
}

/// Names the properties that fail, with what is said of them.
bool fails(const MeshJudgement& found, std::string_view property) {
    const JudgedProperty* p = found.find(property);
    return p != nullptr && p->verdict == PropertyVerdict::fails;
}

Surface as_surface(const Mesh& mesh) {
    return {"output", Role::unknown, mesh.vertices, mesh.triangles};
}

/// Returns a surface in which each place is one vertex.
Surface welded(const Surface& s) {
    Surface result{s.name, s.role, {}, s.triangles};
    std::map<std::array<double, 3>, std::uint32_t> number;
    for (Triangle& t : result.triangles)
        for (std::uint32_t& v : t) {
            const Point3& p = s.vertices[v];
            const auto [at, added] = number.try_emplace(
                {p.x, p.y, p.z}, static_cast<std::uint32_t>(result.vertices.size()));
            if (added) result.vertices.push_back(p);
            v = at->second;
        }
    return result;
}

/// Two bent sheets that cross.
std::vector<Surface> bent_sheets(const Point3& at) {
    return {unit_grid(
                6, 6,
                [&](double u, double v) {
                    return Point3{at.x + 10 * u, at.y + 10 * v,
                                  at.z + std::sin(7 * u) + std::cos(5 * v)};
                },
                "top"),
            unit_grid(
                4, 4,
                [&](double u, double v) {
                    return Point3{at.x + 5 + std::sin(4 * v), at.y + 1 + 8 * u, at.z - 4 + 8 * v};
                },
                "fault")};
}

/// A good mesh, and what it was made from.
struct Good {
    std::string name;
    std::vector<Surface> inputs;
    Surface output;
    std::optional<BooleanOperation> operation;
    double spacing; ///< of doubles at its largest coordinate
};

std::vector<Good> good_meshes() {
    std::vector<Good> all;
    const auto arrangement = [&](const std::string& name, const std::vector<Surface>& inputs,
                                 double spacing) {
        all.push_back({name, inputs, as_surface(mesh_of(inputs)), {}, spacing});
    };
    arrangement("sheets", bent_sheets({}), 2e-15);
    arrangement("sheets in UTM", bent_sheets({450000, 5600000, -1500}), 1e-9);
    arrangement("crossing solids", {octahedron({4, 4, 4}, 3.3), torus({4, 4, 5}, 3, 1, 7)}, 1e-15);
    const std::vector<Surface> pair{octahedron({4, 4, 4}, 3.3), torus({4, 4, 5}, 3, 1, 7)};
    const auto cgal = corefine_oracle::made_by_cgal(pair);
    REQUIRE(cgal);
    for (const auto& [i, operation] :
         {std::pair{0U, BooleanOperation::unite}, std::pair{1U, BooleanOperation::intersect},
          std::pair{2U, BooleanOperation::subtract}})
        if (cgal->booleans[i])
            all.push_back({"CGAL's " + std::string(name_of(operation)), pair, *cgal->booleans[i],
                           operation, 1e-15});
    return all;
}

} // namespace

TEST_CASE("judge: each damage to a good mesh is found by the property that it breaks") {
    const auto meshes = good_meshes();
    CHECK(meshes.size() >= 5);
    std::set<std::string> found_somewhere;
    for (const Good& good : meshes) {
        INFO(good.name);
        const auto whole = judged({good.output}, good.inputs, good.operation);
        INFO(whole.failures());
        REQUIRE(whole.holds());
        REQUIRE(whole.complete());
        for (const MeshDamage& damage : all_mesh_damages()) {
            INFO(damage.name);
            // What is smaller than the bound is rounding.
            const auto by = damage.name.find(" by -");
            const double size =
                by == std::string::npos ? 1 : std::pow(10, std::stod(damage.name.substr(by + 4)));
            if (size < 40 * good.spacing) continue;
            const auto damaged = damage.make(good.output);
            if (!damaged) continue;
            const auto found = judged({*damaged}, good.inputs, good.operation);
            INFO(found.failures());
            CHECK(fails(found, damage.breaks));
            found_somewhere.insert(damage.name);
        }
    }
    CHECK(found_somewhere.size() == all_mesh_damages().size());
    CHECK(found_somewhere.size() >= 80);
}

TEST_CASE("judge: other operations and lost operands are found") {
    const std::vector<Surface> pair{octahedron({4, 4, 4}, 3.3), torus({4, 4, 5}, 3, 1, 7)};
    const auto cgal = corefine_oracle::made_by_cgal(pair);
    REQUIRE(cgal);
    using enum BooleanOperation;
    const std::array operations{unite, intersect, subtract};
    for (unsigned made = 0; made < 3; ++made)
        for (unsigned asked = 0; asked < 3; ++asked) {
            if (!cgal->booleans[made]) continue;
            const auto found = judged({*cgal->booleans[made]}, pair, operations[asked]);
            INFO(made << " for " << asked << ": " << found.failures());
            CHECK(found.holds() == (made == asked));
            CHECK(found.failures().empty() == found.holds());
            CHECK(fails(found, "coverage") == (made != asked));
            CHECK(fails(found, "volume") == (made != asked));
        }
    for (const Surface& operand : pair) {
        CHECK(fails(judged({operand}, pair, unite), "coverage"));
        CHECK(fails(judged({operand}, pair, unite), "volume"));
    }
    CHECK(fails(judged(pair, pair, unite), "conforming"));
    CHECK(fails(judged({as_surface(mesh_of(pair))}, pair, unite), "coverage")); // walls inside
    CHECK(fails(judged({as_surface(mesh_of({pair[0]}))}, pair), "curves"));
}

TEST_CASE("judge: triangles that are too many do not widen the tolerance of the volume") {
    const std::vector<Surface> pair{octahedron({4, 4, 4}, 3.3), torus({4, 4, 5}, 3, 1, 7)};
    const auto cgal = corefine_oracle::made_by_cgal(pair);
    REQUIRE(cgal);
    REQUIRE(cgal->booleans[0]);
    Surface forged =
        *cgal->booleans[0]; // without a triangle, and with a large sheet there and back
    forged.triangles.pop_back();
    const auto first = static_cast<std::uint32_t>(forged.vertices.size());
    for (const Point3& p : {Point3{0, 0, 50}, Point3{1e9, 0, 50}, Point3{0, 1e9, 50}})
        forged.vertices.push_back(p);
    forged.triangles.push_back({first, first + 1, first + 2});
    forged.triangles.push_back({first, first + 2, first + 1});
    const auto found = judged({forged}, pair, BooleanOperation::unite);
    CHECK(fails(found, "volume"));
    CHECK(fails(found, "coverage"));
}

TEST_CASE("judge: an operand that bounds no solid is refused") {
    Surface open = octahedron({0, 0, 0}, 2);
    open.triangles.pop_back();
    JudgeOptions options;
    options.operation = BooleanOperation::unite;
    const std::vector<Surface> inputs{open, cube(0, 3)};
    const auto found = judge(inputs, inputs, options);
    REQUIRE(!found);
    CHECK(found.error().code == ErrorCode::not_closed);
    CHECK(found.error().place == "operand 1");
    options.operand_of = {0};
    CHECK(judge(inputs, inputs, options).error().code == ErrorCode::bad_option);
    options.operand_of = {0, 2};
    CHECK(judge(inputs, inputs, options).error().code == ErrorCode::bad_option);
    options = {};
    options.spacings = -1;
    CHECK(judge(inputs, inputs, options).error().code == ErrorCode::bad_option);
}

TEST_CASE("judge: meshes of random models raise no false alarm") {
    std::size_t meshes = 0, complete = 0;
    for (std::uint64_t seed = 1; seed <= 220; ++seed) {
        ModelMaker maker(seed);
        const auto model = maker.model();
        const auto exact = arrange(model);
        if (!exact) continue;
        const auto made = round_to_doubles(*exact);
        if (!made || !made->report.clean) continue;
        if (made->report.deviation > 16 * 2e-15) continue; // of points farther than the bound
        const auto found = judged({as_surface(made->mesh)}, model);
        INFO(seed << ": " << found.failures());
        CHECK(found.holds());
        ++meshes;
        complete += found.complete();
    }
    CHECK(meshes > 200);
    CHECK(complete >
          meshes - 12); // of the others, the exact result has parts thinner than the bound
}

TEST_CASE("judge: inputs whose areas are no doubles are refused, and results may not be so large") {
    for (const double size : {0x1p251, 0x1p-251}) {
        const std::vector<Surface> solid{octahedron({0, 0, 0}, size)};
        const auto found = judge(solid, solid);
        REQUIRE_FALSE(found);
        CHECK(found.error().code == ErrorCode::unsupported);
    }
    // The corners at the strip are near each other, so that thin triangles are in doubt.
    const std::vector<Surface> inputs{level(0, 0, 0, 8, 8), level(1e-13, 1, 1, 2, 2)};
    Surface spread = as_surface(mesh_of(inputs));
    spread.vertices.push_back({1e200, 1e200, 1e-200});
    spread.triangles[0][0] = static_cast<std::uint32_t>(spread.vertices.size() - 1);
    CHECK(fails(judged({spread}, inputs), "coverage"));
}

TEST_CASE("judge: a bound that is wide beside the inputs is refused") {
    const std::vector<Surface> inputs{level(0, 100, 0, 101, 1)};
    JudgeOptions options;
    options.spacings = 0x1p40; // of 2^-46
    const auto found = judge(inputs, inputs, options);
    REQUIRE_FALSE(found);
    CHECK(found.error().code == ErrorCode::unsupported);
    CHECK(found.error().place == "spacings");
}

TEST_CASE("judge: vertices that no triangle with area has do not count") {
    std::vector<Surface> inputs{level(0, 0, 0, 8, 8), level(1, 1, 1, 2, 2)};
    const Surface whole = as_surface(mesh_of(inputs));
    const auto far = static_cast<std::uint32_t>(inputs[0].vertices.size());
    for (const double x : {1e15, 2e15, 3e15}) inputs[0].vertices.push_back({x, 0, 0});
    inputs[0].triangles.push_back({far, far + 1, far + 1});
    inputs[1].vertices.push_back({0, -4e15, 0});
    Surface moved = whole;
    for (Point3& p : moved.vertices) p.z += 1e-3;
    CHECK(judged({whole}, inputs).holds());
    CHECK(fails(judged({moved}, inputs), "vertices"));
}

TEST_CASE("judge: meshes that the fuzz target made are accepted") {
    for (const std::string name : {"025-parts-in-no-region.obj", "026-plane-of-a-needle.obj"}) {
        const auto inputs = read_data("regression/" + name);
        CHECK(judged({as_surface(mesh_of(inputs))}, inputs).failures() == "");
    }
}

TEST_CASE("judge: a large flaw is found beside parts that rounding may join") {
    // Rounding can't tell the second surface from a corner of the first.
    const std::vector<Surface> inputs{level(0, 0, 0, 8, 8), level(1e-13, 1, 1, 2, 2)};
    const Surface whole = as_surface(mesh_of(inputs));
    CHECK(judged({whole}, inputs).holds());
    Surface torn = whole;
    torn.triangles.erase(torn.triangles.begin());
    CHECK(fails(judged({torn}, inputs), "coverage"));
    // A sliver that is long enough has any area, and may not excuse what is missing.
    for (const Point3& p : {Point3{1, 1, 1e-13}, Point3{1e16, 1, 0}, Point3{1e16, 1 + 2e-13, 0}})
        torn.vertices.push_back(p);
    const auto last = static_cast<std::uint32_t>(torn.vertices.size() - 1);
    torn.triangles.push_back({last - 2, last - 1, last});
    CHECK(fails(judged({torn}, inputs), "coverage"));
    Surface turned = whole;
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    CHECK(fails(judged({turned}, inputs), "orientation"));
    Surface more = whole;
    for (const Point3& p : {Point3{1, 1, 0}, Point3{8, 1, 3}, Point3{1, 8, 3}})
        more.vertices.push_back(p);
    const auto n = static_cast<std::uint32_t>(more.vertices.size());
    more.triangles.push_back({n - 3, n - 2, n - 1});
    CHECK(fails(judged({more}, inputs), "coverage"));
}

TEST_CASE("judge: CGAL's corefinements and Booleans raise no false alarm") {
    std::size_t corefined = 0, booleans = 0;
    for (std::uint64_t seed = 1; seed <= 120; ++seed) {
        ModelMaker maker(seed);
        const std::vector<Surface> pair{welded(maker.solid()), welded(maker.solid())};
        const auto cgal = corefine_oracle::made_by_cgal(pair);
        if (!cgal) continue;
        INFO(seed);
        const auto both = judged(cgal->corefined, pair);
        // Rounding to doubles one by one may make triangles meet: that is an alarm, and a right one.
        if (fails(both, "conforming") || fails(both, "distinct")) continue;
        INFO(both.failures());
        CHECK(both.holds());
        ++corefined;
        using enum BooleanOperation;
        for (const auto& [i, operation] :
             {std::pair{0U, unite}, std::pair{1U, intersect}, std::pair{2U, subtract}}) {
            if (!cgal->booleans[i]) continue;
            const auto found = judged({welded(*cgal->booleans[i])}, pair, operation);
            INFO(name_of(operation) << ": " << found.failures());
            CHECK(found.holds());
            ++booleans;
        }
    }
    CHECK(corefined > 40);
    CHECK(booleans > 60);
}

TEST_CASE("judge: flat regions may be divided otherwise") {
    const std::vector<Surface> inputs{level(0, 0, 0, 4, 4), level(0, 2, 2, 6, 6)};
    const Surface made = as_surface(mesh_of(inputs));
    CHECK(judged({made}, inputs).holds());
    // A point more in a flat region.
    Surface finer = made;
    const auto [a, b, c] = finer.triangles[0];
    const auto& p = finer.vertices;
    const Point3 middle{(p[a].x + p[b].x + p[c].x) / 3, (p[a].y + p[b].y + p[c].y) / 3, 0};
    const auto m = static_cast<std::uint32_t>(p.size());
    finer.vertices.push_back(middle);
    finer.triangles[0] = {a, b, m};
    finer.triangles.insert(finer.triangles.end(), {{b, c, m}, {c, a, m}});
    CHECK(judged({finer}, inputs).holds());
    // Both surfaces have the part that they share.
    const std::vector<Surface> parts{made, made};
    CHECK_FALSE(judged(parts, inputs).holds());
}

TEST_CASE("judge_soup: what is wrong with triangles alone is named") {
    const auto of = [](const std::vector<Surface>& soup) {
        auto found = judge_soup(soup);
        REQUIRE(found);
        return std::move(found).value();
    };
    const Surface solid = octahedron({0, 0, 0}, 2);
    CHECK(of({solid}).holds());
    Surface s = solid;
    s.triangles.pop_back();
    CHECK(fails(of({s}), "closed"));
    s = solid;
    std::swap(s.triangles[0][0], s.triangles[0][1]);
    CHECK(fails(of({s}), "oriented"));
    s = solid;
    s.triangles.push_back(s.triangles[0]);
    CHECK(fails(of({s}), "distinct"));
    CHECK(fails(of({s}), "tetgen"));
    CHECK(fails(of({solid, octahedron({1, 0.5, 0.25}, 2)}), "conforming"));
    CHECK(fails(of({solid, octahedron({4, 0, 0}, 2)}), "manifold")); // a common vertex
    CHECK(fails(of({cube(0, 1)}), "welded"));
    s = solid; // a flap that lies nearly upon a triangle
    s.vertices.push_back({0.7, 0.7, 0.5999});
    s.triangles.push_back({0, 2, 6});
    CHECK(fails(of({s}), "manifold"));
    s = solid;
    s.vertices.push_back({2, 1e-9, 0});
    s.triangles[0][0] = 6;
    CHECK(fails(of({s}), "tetgen")); // two points that are one for TetGen
}
