// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of layers with a minimum thickness: the verifier accepts what the producer writes
// and refutes each forgery.
#include "support/effort.hpp"
#include "support/layered_certificates.hpp"
#include "support/paths.hpp"

#include <cmath>
#include <optional>
#include <random>

namespace {

using namespace forged;

constexpr double gap = 0.4;
constexpr double wide_gap = 1.4;

/// Layers whose middle one is the softest, with this thickness.
Subject thick_subject(double thickness, const std::vector<Layer>& order = order_of_three()) {
    return layered_subject(three_horizons(), order, {"obj"}, thickness);
}

const Subject& thick_layers() {
    static const Subject subject = thick_subject(gap);
    return subject;
}

/// Four horizons, from the hardest: the lowest, the top, the third, the second. Over the lowest the
/// third stands on it, as top and lowest are less than twice the thickness apart. This leaves less
/// room than the thickness for the second one, which is squeezed.
Subject squeezed_subject(double thickness = wide_gap) {
    const auto three = three_horizons();
    const std::vector<File> files{
        three[0],
        {"second.obj",
         horizon_text("second", 0, [](double x, double y) { return 2.6 - 0.05 * x + 0.02 * y; })},
        three[1],
        three[2]};
    return layered_subject(files, order_of({4, 1, 2, 5}), {"obj"}, thickness);
}

const Subject& squeezed_layers() {
    static const Subject subject = squeezed_subject();
    return subject;
}

/// Returns the height of a layer of a mesh, or of a surface, over a place.
template <class Corner>
std::optional<double> height_at_place(std::size_t triangles, const Corner& corner, double x,
                                      double y) {
    for (std::size_t t = 0; t < triangles; ++t) {
        const std::array<Point3, 3> p{corner(t, 0), corner(t, 1), corner(t, 2)};
        const auto turn = [&](const Point3& a, const Point3& b) {
            return (a.x - x) * (b.y - y) - (a.y - y) * (b.x - x);
        };
        const double u = turn(p[1], p[2]), v = turn(p[2], p[0]), w = turn(p[0], p[1]);
        if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))
            if (const double all = u + v + w; all != 0)
                return (u * p[0].z + v * p[1].z + w * p[2].z) / all;
    }
    return std::nullopt;
}

/// The reasons for which a triangle of a layer stays.
enum class Held { by_own, by_upper, by_lower, squeezed };

/// Returns a triangle of `layer`, away from the borders of all surfaces, that is on its own surface
/// or on none; then it is below or above those of the layers `upper` and `lower` by the thickness.
std::size_t held_triangle(const Subject& s, std::uint32_t layer, Held held) {
    const Json& m = s.certificate["layered"];
    const double thickness = number_in(m["thickness"]);
    const auto corner = [&](std::size_t t, std::size_t k) {
        const auto v = m["triangles"][t][k].get<std::size_t>();
        return Point3{layer_coordinate(m, v, 0), layer_coordinate(m, v, 1),
                      layer_coordinate(m, v, 2)};
    };
    const auto height_of_layer = [&](std::uint32_t i, double x, double y) {
        std::vector<std::size_t> own;
        for (std::size_t t = 0; t < m["triangles"].size(); ++t)
            if (std::ranges::count(m["layers"][t], Json(i)) > 0) own.push_back(t);
        return height_at_place(
            own.size(), [&](std::size_t t, std::size_t k) { return corner(own[t], k); }, x, y);
    };
    for (std::size_t t = 0; t < m["triangles"].size(); ++t) {
        if (std::ranges::count(m["layers"][t], Json(layer)) == 0) continue;
        if ((m["layers"][t].size() > 1) != (held == Held::squeezed)) continue;
        Point3 mean{0, 0, 0};
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const Point3 p = corner(t, k);
            inside = inside && p.x > 0.1 && p.x < 7.9 && p.y > 0.1 && p.y < 7.9 &&
                     std::fabs(p.x - 5.47) > 0.1;
            mean = {mean.x + p.x / 3, mean.y + p.y / 3, mean.z + p.z / 3};
        }
        if (!inside) continue;
        if (held == Held::squeezed) return t;
        const Surface& own = s.surfaces[m["order"][layer]["surface"].get<std::size_t>()];
        const auto z = height_at_place(
            own.triangles.size(),
            [&](std::size_t o, std::size_t k) { return own.vertices[own.triangles[o][k]]; }, mean.x,
            mean.y);
        const bool on_own = z && std::fabs(*z - mean.z) < 1e-9;
        if (on_own && held == Held::by_own) return t;
        if (on_own || held == Held::by_own) continue;
        const std::uint32_t other = held == Held::by_upper ? layer - 1 : layer + 1;
        const double by = held == Held::by_upper ? -thickness : thickness;
        const auto bound = height_of_layer(other, mean.x, mean.y);
        if (bound && std::fabs(*bound + by - mean.z) < 1e-9) return t;
    }
    FAIL("there is no such triangle");
    return 0;
}

/// Moves a corner of a triangle that is held so.
Forgery moved_corner(const std::string& name, Held held, std::size_t axis, double by,
                     const std::string& rule) {
    return layered(
        name,
        [=](Json& m) {
            const std::size_t t = held_triangle(thick_layers(), 1, held);
            move(m, m["triangles"][t][0].get<std::size_t>(), axis, by);
        },
        rule);
}

Forgery with_thickness(const std::string& name, const Json& thickness, const std::string& rule) {
    return layered(
        name, [=](Json& m) { m["thickness"] = thickness; }, rule);
}

/// Adds an upright triangle on an edge of a layer along x = 0, where all surfaces end.
void add_upright(Json& m, int layer, double height) {
    for (std::size_t t = 0; t < m["triangles"].size(); ++t) {
        if (m["layers"][t] != Json{layer}) continue;
        std::vector<std::size_t> edge;
        for (const Json& v : m["triangles"][t])
            if (layer_coordinate(m, v.get<std::size_t>(), 0) == 0)
                edge.push_back(v.get<std::size_t>());
        if (edge.size() != 2) continue;
        Json top = m["vertices"][edge[0]];
        shift_number(top[2], height);
        const std::size_t v = m["vertices"].size();
        m["vertices"].push_back(top);
        m["triangles"].push_back({edge[0], edge[1], v});
        for (const char* list : {"layers", "regions", "parents"}) m[list].push_back(m[list][t]);
        return;
    }
    FAIL("the layer has no edge along x = 0");
}

/// Gives the middle layer the triangles of another one, where this exists, and removes its own.
void put_middle_on(Json& m, int other) {
    erase_all(m, {1});
    for (std::size_t t = 0; t < m["triangles"].size(); ++t)
        if (m["layers"][t] == Json{other})
            set_layers(m, t, {std::min(other, 1), std::max(other, 1)});
}

/// Returns every fourth forgery under sanitizers, where each takes seconds, else all of them.
std::vector<Forgery> enough_of(std::vector<Forgery> all) {
#ifdef TERRANE_SANITIZED
    std::vector<Forgery> some;
    for (std::size_t f = 0; f < all.size(); f += 4) some.push_back(std::move(all[f]));
    return some;
#else
    return all;
#endif
}

} // namespace

TEST_CASE("thick layers: accepted where layers are held in all ways", "[layers][once]") {
    const Subject subject = layered_subject(three_horizons(), order_of_three(),
                                            {"obj", "off", "ply", "vtp", "ts", "stl"}, gap);
    CHECK(judged(subject) == "");
    CHECK(subject.certificate["layered"]["thickness"] == "0.4");
    for (const Held held : {Held::by_own, Held::by_upper, Held::by_lower})
        held_triangle(thick_layers(), 1, held);
    CHECK(judged(squeezed_layers()) == "");
    held_triangle(squeezed_layers(), 2, Held::by_lower);
    held_triangle(squeezed_layers(), 1, Held::squeezed);
    CHECK(judged(thick_subject(gap, order_of({1, 3, 2}))) == "");
    CHECK(judged(thick_subject(gap, order_of({1, 1, 1}))) == "");
    CHECK(judged(thick_subject(2, order_of({1, 3, 2}))) == "");
    CHECK(judged(squeezed_subject(0.3)) == "");
    CHECK(judged(squeezed_subject(30)) == "");
}

TEST_CASE("thick layers: without a thickness the certificate is as before", "[layers]") {
    const Subject subject = layered_subject(three_horizons(), order_of_three());
    CHECK_FALSE(subject.certificate["layered"].contains("thickness"));
}

TEST_CASE("thick layers: accepted for difficult surfaces", "[layers]") {
    const std::string data = test_support::source_dir() + "/tests/data/layers/";
    const std::vector<std::pair<std::string, std::vector<Layer>>> stacks{
        {"partial_mid.obj", order_of({3, 2, 1})},
        {"stack16_cross.obj", order_of({1, 3, 2, 4})},
        {"stack261_cross.obj", order_of({2, 4, 2, 2})},
        {"stack536_cross.obj", order_of({4, 6, 7, 3, 5, 3})}};
    for (const auto& [name, order] : stacks)
        for (const double thickness : {0.03, 0.25}) {
            if (thickness < 0.1 && name != "partial_mid.obj") continue; // for time
#ifdef TERRANE_SANITIZED
            if (name == "stack536_cross.obj") continue; // takes half a minute there
#endif
            INFO(name << " " << thickness);
            CHECK(judged(layered_subject({{name, text_in(data + name)}}, order, {"obj"},
                                         thickness)) == "");
        }
    const std::string docs = test_support::source_dir() + "/docs/data/";
    const std::vector<File> dome{{"salt.obj", obj_in(docs + "salt.ts")},
                                 {"shale.obj", obj_in(docs + "shale.ts")}};
    for (const double thickness : {5.0, 200.0}) {
        INFO(thickness);
        const std::vector<Layer> shale_above{{SurfaceId(1), 0}, {SurfaceId(0), 1}},
            salt_above{{SurfaceId(0), 1}, {SurfaceId(1), 0}};
        CHECK(judged(layered_subject(dome, shale_above, {"obj"}, thickness)) == "");
        CHECK(judged(layered_subject(dome, salt_above, {"obj"}, thickness)) == "");
    }
}

TEST_CASE("thick layers: forged thicknesses", "[layers]") {
    check_forgeries(
        thick_layers(),
        enough_of({
            with_thickness("a larger thickness", "0.41", "R66"),
            with_thickness("a slightly larger thickness", "0.400000000001", "R66"),
            with_thickness("a smaller thickness", "0.39", "R63"),
            with_thickness("a slightly smaller thickness", "0.399999999999", "R63"),
            with_thickness("half the thickness, so that layers are at multiples", "0.2", "R63"),
            with_thickness("twice the thickness", "0.8", "R66"),
            with_thickness("the thickness of a metre in millimetres", "400", "R66"),
            with_thickness("a huge thickness", "1e+300", "R66"),
            with_thickness("the largest double", "1.7976931348623157e+308", "R66"),
            with_thickness("the smallest double", "5e-324", "R63"),
            with_thickness("a negative thickness", "-0.4", "R60"),
            with_thickness("no thickness, in words", "0", "R60"),
            with_thickness("the negative zero", "-0", "R60"),
            with_thickness("an infinite thickness", "inf", "a finite number"),
            with_thickness("an overflowing thickness", "1e+400", "a finite number"),
            with_thickness("a thickness that is no number", "nan", "a finite number"),
            with_thickness("a thickness in words", "thick", "a finite number"),
            with_thickness("a thickness with a unit", "0.4 m", "a finite number"),
            with_thickness("a thickness in a longer form", "0.40", "a finite number"),
            with_thickness("a thickness that is not in quotes", 4, "a string is needed"),
            with_thickness("a thickness for each layer", {"0.4", "0.4"}, "a string is needed"),
            with_thickness("null", nullptr, "a string is needed"),
            layered(
                "the thickness is left out", [](Json& m) { m.erase("thickness"); }, "R63"),
            layered(
                "the thickness has another key",
                [](Json& m) {
                    m["thicknes"] = m["thickness"];
                    m.erase("thickness");
                },
                "unknown key"),
            layered(
                "a thickness for blocks, too", [](Json& m) { m["min_thickness"] = m["thickness"]; },
                "unknown key"),
        }));
    std::string twice = thick_layers().certificate.dump();
    const std::string key = "\"thickness\":\"0.4\"";
    twice.insert(twice.find(key), key + ",");
    const auto parsed = parse_certificate(twice, "c.json");
    REQUIRE_FALSE(parsed);
    INFO(parsed.error().message());
    CHECK(parsed.error().message().find("twice") != std::string::npos);
}

TEST_CASE("thick layers: stacks that were made in another way", "[layers][once]") {
    const auto claims = [](const Subject& made, const std::string& thickness,
                           const std::vector<Layer>& order) {
        Subject wrong = made;
        Json& m = wrong.certificate["layered"];
        m["thickness"] = thickness;
        for (std::size_t i = 0; i < order.size(); ++i)
            m["order"][i]["hardness"] = decimal_text(order[i].hardness);
        seal(wrong);
        return judged(wrong);
    };
    const auto right = order_of_three();
    CHECK(claims(thick_subject(0.4), "0.4", right) == "");
    // Thinned out to nothing where there is room, as if no thickness had been asked for.
    CHECK(claims(thick_subject(0), "0.4", right).find("R66") != std::string::npos);
    CHECK(claims(thick_subject(0.2), "0.4", right).find("R66") != std::string::npos);
    CHECK(claims(thick_subject(0.8), "0.4", right) == "R63");
    // At twice the thickness from the only harder layer, above or below, with its surface beyond.
    const auto three = three_horizons();
    const auto below = order_of({2, 1}), above = order_of({1, 2});
    CHECK(claims(layered_subject({three[0], three[1]}, below, {"obj"}, 0.8), "0.8", below) == "");
    CHECK(claims(layered_subject({three[0], three[1]}, below, {"obj"}, 0.8), "0.4", below) ==
          "R63");
    CHECK(claims(layered_subject({three[1], three[2]}, above, {"obj"}, 0.8), "0.8", above) == "");
    CHECK(claims(layered_subject({three[1], three[2]}, above, {"obj"}, 0.8), "0.4", above) ==
          "R63");
    // The softer layers push the harder ones.
    CHECK(claims(thick_subject(0.4, order_of({2, 9, 3})), "0.4", right).find("R63") !=
          std::string::npos);
    CHECK(claims(thick_subject(0.4, order_of({1, 2, 3})), "0.4", right).find("R63") !=
          std::string::npos);
    // A stack in which the third layer moved up instead of squeezing the second one.
    CHECK(claims(squeezed_subject(0.7), "1.4", order_of({4, 1, 2, 5})).find("R66") !=
          std::string::npos);
    CHECK(claims(squeezed_subject(1.4), "0.7", order_of({4, 1, 2, 5})).find("R63") !=
          std::string::npos);
}

TEST_CASE("thick layers: forged heights", "[layers]") {
    check_forgeries(
        thick_layers(),
        enough_of({
            moved_corner("what hangs below a harder layer is raised", Held::by_upper, 2, 1e-9,
                         "R66"),
            moved_corner("what hangs below a harder layer is lowered", Held::by_upper, 2, -1e-9,
                         "R63"),
            moved_corner("what stands on a harder layer is raised", Held::by_lower, 2, 1e-9, "R63"),
            moved_corner("what stands on a harder layer is lowered", Held::by_lower, 2, -1e-9,
                         "R66"),
            moved_corner("what is on its surface is raised", Held::by_own, 2, 1e-9, "R63"),
            moved_corner("what is on its surface is lowered", Held::by_own, 2, -1e-9, "R63"),
            moved_corner("what hangs is moved sideways", Held::by_upper, 0, 1e-6, "R63"),
            moved_corner("what stands is moved sideways", Held::by_lower, 1, 1e-6, "R63"),
            layered(
                "the middle layer is raised by a little", [](Json& m) { move_layer(m, 1, 1e-10); },
                "R66"),
            layered(
                "the middle layer is lowered by a little",
                [](Json& m) { move_layer(m, 1, -1e-10); }, "R66"),
            layered(
                "a part of the middle layer is raised into the gap",
                [](Json& m) {
                    raise_peak(m, held_triangle(thick_layers(), 1, Held::by_upper), gap / 2);
                },
                "R66"),
            layered(
                "the top is raised: a hard layer leaves its surface",
                [](Json& m) { move_layer(m, 0, gap); }, "R63"),
            layered(
                "the base is lowered: a hard layer leaves its surface",
                [](Json& m) { raise_peak(m, triangle_of(m, {2}), -gap); }, "R63"),
            layered(
                "a peak on what hangs below a harder layer",
                [](Json& m) {
                    raise_peak(m, held_triangle(thick_layers(), 1, Held::by_upper), 0.01);
                },
                "R66"),
            layered(
                "a pit in what hangs below a harder layer",
                [](Json& m) {
                    raise_peak(m, held_triangle(thick_layers(), 1, Held::by_upper), -0.01);
                },
                "R63"),
            layered(
                "a pit in what stands on a harder layer",
                [](Json& m) {
                    raise_peak(m, held_triangle(thick_layers(), 1, Held::by_lower), -0.01);
                },
                "R66"),
            layered(
                "what hangs below a harder layer is turned over",
                [](Json& m) { turn_over(m, held_triangle(thick_layers(), 1, Held::by_upper)); },
                "R65"),
            layered(
                "an upright triangle along the border", [](Json& m) { add_upright(m, 1, 0.25); },
                "R63"),
            layered(
                "a larger deviation, for a corner moved as far",
                [](Json& m) {
                    const std::size_t t = held_triangle(thick_layers(), 1, Held::by_upper);
                    move(m, m["triangles"][t][0].get<std::size_t>(), 2, 1e-3);
                    m["deviation"] = "0.01";
                },
                "R60"),
            layered(
                "no deviation", [](Json& m) { m["deviation"] = "0"; }, "R63"),
        }));
}

TEST_CASE("thick layers: forged neighbours", "[layers]") {
    check_forgeries(
        thick_layers(),
        enough_of({
            layered(
                "the middle layer lies on the top, though there is room",
                [](Json& m) { put_middle_on(m, 0); }, "R66"),
            layered(
                "the middle layer lies on the base, though there is room",
                [](Json& m) { put_middle_on(m, 2); }, "R66"),
            layered(
                "a triangle of the top belongs to the middle layer, too",
                [](Json& m) {
                    set_layers(m, triangle_of(m, {0}), {0, 1});
                },
                "R66"),
            layered(
                "a triangle that hangs belongs to the top, too",
                [](Json& m) {
                    set_layers(m, held_triangle(thick_layers(), 1, Held::by_upper), {0, 1});
                },
                "R63"),
            layered(
                "a triangle that hangs is missing",
                [](Json& m) { erase_layered(m, held_triangle(thick_layers(), 1, Held::by_upper)); },
                "R64"),
            layered(
                "two layers exchanged", [](Json& m) { std::swap(m["order"][0], m["order"][1]); },
                "R63"),
            layered(
                "surfaces exchanged",
                [](Json& m) { std::swap(m["order"][0]["surface"], m["order"][1]["surface"]); },
                "R63"),
            layered(
                "the softest is said to be the hardest",
                [](Json& m) { m["order"][1]["hardness"] = "9"; }, "R63"),
            layered(
                "all of the same hardness",
                [](Json& m) {
                    for (Json& layer : m["order"]) layer["hardness"] = "1";
                },
                "R63"),
        }));
    check_forgeries(
        squeezed_layers(),
        enough_of({
            layered(
                "a squeezed triangle belongs to the layer above alone",
                [](Json& m) {
                    set_layers(m, held_triangle(squeezed_layers(), 1, Held::squeezed), {0});
                },
                "R64"),
            layered(
                "a pit in the third layer, which stands on the lowest",
                [](Json& m) {
                    raise_peak(m, held_triangle(squeezed_layers(), 2, Held::by_lower), -gap);
                },
                "R66"),
            layered(
                "nothing squeezes the second layer: it is as hard as the third",
                [](Json& m) { m["order"][1]["hardness"] = "3"; }, "R66"),
            layered(
                "nothing squeezes the second layer: the third is left out",
                [](Json& m) {
                    erase_all(m, {2});
                    m["order"].erase(2);
                    for (std::size_t t = 0; t < m["triangles"].size(); ++t) {
                        Json layers = Json::array();
                        for (const Json& l : m["layers"][t])
                            if (l != 2) layers.push_back(l == 3 ? Json(2) : l);
                        set_layers(m, t, layers);
                    }
                },
                "R66"),
            with_thickness("the thickness does not squeeze the second layer", "1.1", "R66"),
        }));
}
