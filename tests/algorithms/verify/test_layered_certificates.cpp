// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of layers: the verifier accepts what the producer writes and refutes each forgery.
#include "support/layered_certificates.hpp"
#include "support/paths.hpp"

#include <cmath>
#include <numeric>
#include <optional>

namespace {

using namespace forged;

const Subject& right_layers() {
    static const Subject subject = layered_subject(three_horizons(), order_of_three());
    return subject;
}

/// Adds all triangles once more, on vertices that are higher by less than the deviation.
void double_layers(Json& m) {
    const std::size_t vertices = m["vertices"].size(), triangles = m["triangles"].size();
    for (std::size_t v = 0; v < vertices; ++v) {
        m["vertices"].push_back(Json(m["vertices"][v]));
        move(m, vertices + v, 2, 2e-12);
    }
    for (std::size_t t = 0; t < triangles; ++t) {
        Json corners = m["triangles"][t];
        for (Json& corner : corners) corner = corner.get<std::size_t>() + vertices;
        m["triangles"].push_back(corners);
        for (const char* list : {"layers", "regions", "parents"})
            m[list].push_back(Json(m[list][t]));
    }
    m["deviation"] = "5e-12";
}

} // namespace

TEST_CASE("layered certificates: accepted with each format", "[layers]") {
    const Subject subject = layered_subject(three_horizons(), order_of_three(),
                                            {"obj", "off", "ply", "vtp", "ts", "stl"});
    CHECK(judged(subject) == "");
    const auto parsed = parse_certificate(subject.certificate.dump(), "c");
    REQUIRE(parsed);
    const Verdict verdict = verify_certificate(subject.inputs, parsed.value());
    REQUIRE(verdict.measured);
    CHECK(verdict.measured->deviation < 1e-13);
    CHECK(judged(subject, {.max_deviation = 1e-18}) == "R60");
    const double stated = number_in(subject.certificate["layered"]["deviation"]);
    CHECK(judged(subject, {.max_deviation = stated}) == "");
    CHECK(judged(subject, {.max_deviation = std::nextafter(stated, 0.0)}) == "R60");
    // All that is told apart is there: what is replaced from above and below, and steps.
    const Json& mesh = subject.certificate["layered"];
    triangle_of(mesh, {0, 1});
    triangle_of(mesh, {1, 2});
    triangle_of(mesh, {1});
}

TEST_CASE("layered certificates: the verifier accepts stacks of real and difficult surfaces",
          "[layers][once]") {
    const std::string data = test_support::source_dir() + "/tests/data/layers/";
    const std::vector<std::pair<std::string, std::vector<Layer>>> stacks{
        {"partial_mid.obj", order_of({3, 2, 1})},
        {"stack6_step.obj", order_of({6, 6})},           // two heights over one line
        {"stack90_upright.obj", order_of({1, 3, 1, 0})}, // a thin triangle became upright
        {"stack16_cross.obj", order_of({1, 3, 2, 4})},
        {"stack261_cross.obj", order_of({2, 4, 2, 2})},
        {"stack536_cross.obj", order_of({4, 6, 7, 3, 5, 3})}};
    for (const auto& [name, order] : stacks) {
        INFO(name);
        CHECK(judged(layered_subject({{name, text_in(data + name)}}, order)) == "");
    }
    const std::string docs = test_support::source_dir() + "/docs/data/";
    const std::vector<File> dome{{"salt.obj", obj_in(docs + "salt.ts")},
                                 {"shale.obj", obj_in(docs + "shale.ts")}};
    CHECK(judged(layered_subject(dome, {{SurfaceId(1), 0}, {SurfaceId(0), 1}})) == "");
    CHECK(judged(layered_subject(dome, {{SurfaceId(0), 1}, {SurfaceId(1), 0}})) == "");
    const std::vector<File> horizons{{"top.obj", obj_in(docs + "top.ts")},
                                     {"base.obj", obj_in(docs + "base.ts")}};
    CHECK(judged(layered_subject(horizons, order_of({1, 2}))) == "");
    // The upper horizon as the lower one: all of the softer one gives way.
    CHECK(judged(layered_subject(horizons, {{SurfaceId(1), 1}, {SurfaceId(0), 2}})) == "");
}

TEST_CASE("layered certificates: forged layers", "[layers]") {
    check_forgeries(
        right_layers(),
        {
            layered(
                "a triangle of one layer is missing",
                [](Json& m) { erase_layered(m, triangle_of(m, {0})); }, "R64"),
            layered(
                "a triangle that replaces a part of another layer is missing",
                [](Json& m) {
                    erase_layered(m, triangle_of(m, {1, 2}));
                },
                "R64"),
            layered(
                "a replacement belongs to the harder layer alone",
                [](Json& m) {
                    set_layers(m, triangle_of(m, {1, 2}), {2});
                },
                "R64"),
            layered(
                "a replacement belongs to the softer layer alone",
                [](Json& m) {
                    set_layers(m, triangle_of(m, {0, 1}), {1});
                },
                "R63"),
            layered(
                "all replacements belong to the harder layer alone",
                [](Json& m) {
                    for (std::size_t t = 0; t < m["triangles"].size(); ++t)
                        if (m["layers"][t] == Json{1, 2}) set_layers(m, t, {2});
                },
                "R64"),
            layered(
                "a layer is missing where no other one is", [](Json& m) { erase_all(m, {1}); },
                "R64"),
            layered(
                "a vertex moved up by a little",
                [](Json& m) {
                    move(m, m["triangles"][triangle_of(m, {0})][0].get<std::size_t>(), 2, 1e-9);
                },
                "R63"),
            layered(
                "a vertex moved sideways by a little",
                [](Json& m) {
                    move(m, m["triangles"][triangle_of(m, {1})][1].get<std::size_t>(), 0, 1e-6);
                },
                "R63"),
            layered(
                "a peak on a triangle", [](Json& m) { raise_peak(m, triangle_of(m, {0}), 0.01); },
                "R63"),
            layered(
                "a pit in a triangle that replaces others",
                [](Json& m) {
                    raise_peak(m, triangle_of(m, {1, 2}), -0.01);
                },
                "R63"),
            layered(
                "a peak through the layer above",
                [](Json& m) { raise_peak(m, triangle_of(m, {1}), 5); }, "R61"),
            layered(
                "the middle layer raised by a little", [](Json& m) { move_layer(m, 1, 1e-5); },
                "R63"),
            layered(
                "the base lowered by much", [](Json& m) { move_layer(m, 2, -100); }, "R63"),
            layered(
                "a triangle turned over", [](Json& m) { turn_over(m, triangle_of(m, {1})); },
                "R65"),
            layered(
                "all triangles turned over",
                [](Json& m) {
                    for (std::size_t t = 0; t < m["triangles"].size(); ++t) turn_over(m, t);
                },
                "R65"),
            layered(
                "a triangle of the middle one belongs to the top, too",
                [](Json& m) {
                    set_layers(m, triangle_of(m, {1}), {0, 1});
                },
                "R63"),
            layered(
                "a triangle twice",
                [](Json& m) {
                    const std::size_t t = triangle_of(m, {1});
                    for (const char* list : {"triangles", "layers", "regions", "parents"})
                        m[list].push_back(m[list][t]);
                },
                "R61"),
        });
}

TEST_CASE("layered certificates: a layer is there once", "[layers]") {
    const auto flat = [](double z) { return [z](double, double) { return z; }; };
    for (const double thickness : {0.0, 0.5}) {
        const Subject two = layered_subject({{"top.obj", horizon_text("top", 0, flat(3))},
                                             {"base.obj", horizon_text("base", 0, flat(1))}},
                                            order_of({1, 2}), {"obj"}, thickness);
        CHECK(judged(two) == "");
        check_forgeries(two, {layered("all layers twice, a little apart", double_layers, "R62")});
    }
    const std::string body =
        "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 1 1 8\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    CHECK(judged(layered_subject({{"body.obj", body}}, order_of({1}))) == "");
}

TEST_CASE("layered certificates: forged orders and numbers", "[layers]") {
    check_forgeries(
        right_layers(),
        {
            layered(
                "two layers exchanged",
                [](Json& m) { std::swap(m["order"][0]["surface"], m["order"][1]["surface"]); },
                "R63"),
            layered(
                "the order reversed", [](Json& m) { std::swap(m["order"][0], m["order"][2]); },
                "R63"),
            layered(
                "the order reversed, and the layers of all triangles",
                [](Json& m) {
                    std::swap(m["order"][0], m["order"][2]);
                    for (std::size_t t = 0; t < m["triangles"].size(); ++t) {
                        std::set<int> layers;
                        for (const Json& l : m["layers"][t]) layers.insert(2 - l.get<int>());
                        m["layers"][t] = layers;
                    }
                },
                "R62"),
            layered(
                "the softest is said to be the hardest",
                [](Json& m) { m["order"][1]["hardness"] = "9"; }, "R63"),
            layered(
                "all of the same hardness",
                [](Json& m) {
                    for (Json& layer : m["order"]) layer["hardness"] = "1";
                },
                "R63"),
            layered(
                "a layer is left out",
                [](Json& m) {
                    m["order"].erase(2);
                    for (std::size_t t = m["triangles"].size(); t-- > 0;) {
                        Json layers = Json::array();
                        for (const Json& l : m["layers"][t])
                            if (l != 2) layers.push_back(l);
                        if (layers.empty())
                            erase_layered(m, t);
                        else
                            set_layers(m, t, layers);
                    }
                    drop_unused(m);
                },
                "R63"),
            layered(
                "a smaller deviation", [](Json& m) { m["deviation"] = "0"; }, "R63"),
            layered(
                "a larger deviation, for a vertex moved as far",
                [](Json& m) {
                    move(m, m["triangles"][triangle_of(m, {0})][0].get<std::size_t>(), 2, 1e-3);
                    m["deviation"] = "0.01";
                },
                "R60"),
            layered(
                "a negative deviation", [](Json& m) { m["deviation"] = "-1"; }, "R60"),
            layered(
                "a corner out of range",
                [](Json& m) { m["triangles"][3][0] = m["vertices"].size(); }, "R60"),
            layered(
                "a triangle of no layer", [](Json& m) { set_layers(m, 3, Json::array()); }, "R60"),
            layered(
                "a triangle of a layer that does not exist", [](Json& m) { set_layers(m, 3, {3}); },
                "R60"),
            layered(
                "layers of a triangle in another order",
                [](Json& m) {
                    set_layers(m, triangle_of(m, {0, 1}), {1, 0});
                },
                "R60"),
            layered(
                "a surface is in the order twice", [](Json& m) { m["order"][0]["surface"] = 1; },
                "R60"),
            layered(
                "a layer names no surface", [](Json& m) { m["order"][0]["surface"] = 3; },
                "names no surface"),
            layered(
                "a vertex without a triangle",
                [](Json& m) {
                    m["vertices"].push_back({"1", "1", "50"});
                },
                "R61"),
            {"another hash of an input",
             [](Json& c) { c["inputs"][1]["sha256"] = std::string(64, '0'); }, "R9"},
            {"names of two inputs exchanged",
             [](Json& c) {
                 std::swap(c["inputs"][0]["surfaces"][0]["name"],
                           c["inputs"][1]["surfaces"][0]["name"]);
             },
             "R9"},
            {"as filled surfaces", [](Json& c) { c["kind"] = "filled"; }, "missing"},
        });
}

TEST_CASE("layered certificates: output files", "[layers]") {
    const Subject right =
        layered_subject(three_horizons(), order_of_three(), {"obj", "ply", "vtp", "ts"});
    check_changed_digits(right, middle_of);
    Subject wrong = right;
    wrong.certificate["outputs"][0]["surfaces"].erase(0);
    CHECK(judged(wrong) == "R21");
    wrong = right;
    std::swap(wrong.certificate["outputs"][2]["surfaces"][0],
              wrong.certificate["outputs"][2]["surfaces"][1]);
    CHECK(judged(wrong) == "R21");
}
