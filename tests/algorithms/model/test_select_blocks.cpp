// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Regions of models by expressions over blocks: volumes against those of the blocks, as fractions, and parents against
// the blocks on both sides of triangles.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <gmpxx.h>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/selection/selection.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include "support/random_models.hpp"
#include "support/samples.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// A model, or nothing if its doubles are not conforming.
std::optional<Model> model_of(std::vector<Surface> surfaces, double half,
                              const StratigraphicColumn& column = {}) {
    const auto made = arrange_within(std::move(surfaces),
                                     *box_boundary({-half, -half, -half}, {half, half, half}));
    REQUIRE(message_of(made) == "no error");
    if (!made->rounded.conforming) return std::nullopt;
    const auto model = make_model(made->exact, *made->rounded.conforming, {}, {column, {}});
    REQUIRE(message_of(model) == "no error");
    return *model;
}

/// A box of 4 x 4 x 4 around the origin with horizons at 1 and -1, and units of ages 10, 20 and 30.
Model layered_model() {
    return *model_of({level(1, -3, -3, 3, 3, "upper"), level(-1, -3, -3, 3, 3, "lower")}, 2,
                     {{"sand", "upper", 10}, {"shale", "lower", 20}, {"salt", "", 30}});
}

Selected selected(const Model& model, const std::string& expression,
                  const std::vector<Surface>& others = {}) {
    SelectOptions options;
    options.fractions = true;
    const auto made = select(model, expression, others, options);
    INFO(expression);
    REQUIRE(message_of(made) == "no error");
    CHECK(made->rounding.clean);
    return *made;
}

mpq_class volume_of(const Selected& made) {
    return made.exact_volume.empty() ? mpq_class(0) : mpq_class(made.exact_volume);
}

std::string refusal(const Model& model, const std::string& expression) {
    const auto made = select(model, expression);
    REQUIRE(!made);
    CHECK(made.error().code == ErrorCode::bad_option);
    return made.error().message();
}

} // namespace

TEST_CASE("select of a model: blocks by name, number, unit, age and volume") {
    const Model model = layered_model();
    const auto volume = [&](const std::string& expression) {
        return volume_of(selected(model, expression)).get_d();
    };
    CHECK(volume("unit(sand)") == 16);
    CHECK(volume("unit(sand) | unit(salt)") == 32);
    CHECK(volume("block(\"shale\")") == 32);
    CHECK(volume("block(1)") + volume("block(2)") + volume("block(3)") == 64);
    CHECK(volume("volume > 16") == 32);
    CHECK(volume("volume < 16.5") == 32);
    CHECK(volume("age > 1e1") == 48 - 0);
    CHECK(volume("age < 20 | age > 25") == volume("unit(sand)") + volume("age > 25"));
    CHECK(volume("volume < -1") == 0);
    CHECK(volume("below(upper) & above(lower) & unit(shale)") == 32);
    CHECK(volume("block(1) & block(2)") == 0);
    CHECK(selected(model, "unit(sand) | unit(salt)").pieces.size() == 2);
    const std::vector<Surface> contact{level(0, -9, -9, 9, 9, "contact")};
    CHECK(volume_of(selected(model, "unit(shale) & above(contact)", contact)) == 16);
    CHECK(volume_of(selected(model, "volume > 0 - above(contact)", contact)) == 32);
}

TEST_CASE("select of a model: a part of a surface within blocks") {
    const Model model = layered_model();
    const std::vector<Surface> fault{quad({0, -9, -9}, {0, 9, -9}, {0, 9, 9}, {0, -9, 9}, "fault")};
    const Selected made = selected(model, "fault & unit(shale)", fault);
    CHECK(made.is_surface);
    CHECK(made.regions == 1);
    CHECK(made.mesh.regions_of.size() == made.mesh.triangles.size());
    for (const Point3& p : made.mesh.vertices) CHECK((p.x == 0 && std::abs(p.z) <= 1));
    CHECK(made.mesh.surfaces.back().name == "fault");
    for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t)
        CHECK(made.mesh.surfaces_of[t].back() == made.mesh.surfaces.size() - 1);
}

TEST_CASE("select of a model: mistakes name what there is") {
    const Model model = layered_model();
    CHECK(refusal(model, "unit(snad)") == "expression: no unit is called snad; did you mean sand?");
    CHECK(refusal(model, "unit(zzzzzz)") ==
          "expression: no unit is called zzzzzz; there are salt, sand, shale");
    CHECK(refusal(model, "block(9)").find("no block is called 9") != std::string::npos);
    CHECK(refusal(model, "block(0)").find("no block is called 0") != std::string::npos);
    CHECK(refusal(model, "block()").find("column 7") != std::string::npos);
    CHECK(refusal(model, "block(a b)").find("takes the name of one block") != std::string::npos);
    CHECK(refusal(model, "volume < sand").find("expected a number") != std::string::npos);
    CHECK(refusal(model, "volume > inf").find("expected a number") != std::string::npos);
    CHECK(refusal(model, "~unit(sand)").find("has no end") != std::string::npos);
    CHECK(refusal(model, "unit(sand) & above(nothing)").find("no surface") != std::string::npos);
    const auto alone = select(std::vector<Surface>{cube(0, 1, "a")}, "a & block(b)");
    REQUIRE(!alone);
    CHECK(alone.error().sentence.find("those of a model") != std::string::npos);
    // Surfaces may have the names of functions and of numbers of blocks.
    const auto named = select(std::vector<Surface>{cube(0, 2, "volume"), cube(1, 3, "age")},
                              "volume & age", SelectOptions{});
    REQUIRE(named);
    CHECK(named->volume == 1);
}

TEST_CASE("select of a model: random models, block by block") {
    int blocks = 0, cut = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        INFO("seed " << seed);
        ModelMaker maker(seed);
        const auto model = model_of(maker.model(), 6);
        if (!model || model->lost + model->made > 0 || model->block_count() > 12) continue;
        const Mesh& mesh = model->mesh;
        const auto exact = exact_volumes(mesh, model->volumes);
        const std::vector<Surface> contact{level(maker.number(3), -9, -9, 9, 9, "a contact")};
        std::string all;
        for (std::size_t b = 1; b <= model->block_count(); ++b) {
            const std::string block = "block(" + std::to_string(b) + ")";
            all += (b == 1 ? "" : " | ") + ("block(\"" + model->structure.blocks[b].name + "\")");
            const Selected made = selected(*model, block);
            CHECK(made.exact_volume == exact.measures[b]);
            ++blocks;
            for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
                std::vector<std::uint32_t> surfaces;
                for (const std::uint32_t p : made.mesh.parents_of[t]) {
                    REQUIRE(p < mesh.triangles.size());
                    const auto [front, behind] = model->volumes.of_sides[p];
                    CHECK((front == b) != (behind == b));
                    surfaces.insert(surfaces.end(), mesh.surfaces_of[p].begin(),
                                    mesh.surfaces_of[p].end());
                }
                std::ranges::sort(surfaces);
                CHECK(std::ranges::includes(made.mesh.surfaces_of[t], surfaces));
            }
            const mpq_class above =
                volume_of(selected(*model, block + " & above(\"a contact\")", contact));
            const mpq_class below =
                volume_of(selected(*model, block + " - above(\"a contact\")", contact));
            CHECK(above + below == mpq_class(exact.measures[b]));
            cut += above > 0 && below > 0 ? 1 : 0;
        }
        CHECK(selected(*model, all).exact_volume == exact.total);
    }
    CHECK(blocks > 60);
    CHECK(cut > 20);
}
