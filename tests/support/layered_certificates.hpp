// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of layers, as the producer writes them, for forgers to change.
#pragma once

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <initializer_list>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/layers/layers.hpp>

#include "support/forged.hpp"

namespace forged {

/// Returns the certificate of these surfaces in this order, with an output file in each format.
inline Subject layered_subject(const std::vector<File>& files, const std::vector<Layer>& order,
                               const std::vector<std::string>& formats = {"obj"},
                               double min_thickness = 0) {
    Subject s;
    const auto records = add_inputs(s, files);
    const auto layered = stack_layers(s.surfaces, order, {.min_thickness = min_thickness});
    REQUIRE(layered);
    REQUIRE(layered->is_stack());
    const Mesh& mesh = layered->rounded.mesh;
    const auto outputs = add_outputs(s, mesh, formats);
    s.certificate =
        Json::parse(to_layered_certificate(records, s.surfaces, outputs, order, *layered));
    return s;
}

inline constexpr int horizon_nodes = 9; // along each side of a grid

/// A horizon on a grid over [x0, x0 + 8] x [0, 8].
template <class Height>
std::string horizon_text(const std::string& name, double x0, const Height& height) {
    std::string text;
    for (int i = 0; i < horizon_nodes; ++i)
        for (int j = 0; j < horizon_nodes; ++j)
            text += "v " + std::to_string(x0 + i) + " " + std::to_string(j) + " " +
                    std::to_string(height(x0 + i, j)) + "\n";
    text += "g " + name + "\n";
    for (int i = 0; i + 1 < horizon_nodes; ++i)
        for (int j = 0; j + 1 < horizon_nodes; ++j) {
            const int a = 1 + i * horizon_nodes + j, b = a + horizon_nodes;
            text += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
                    std::to_string(b + 1) + "\nf " + std::to_string(a) + " " +
                    std::to_string(b + 1) + " " + std::to_string(a + 1) + "\n";
        }
    return text;
}

/// Three horizons: the middle one is the softest and crosses both others; the lower one is the
/// hardest and ends before the others.
inline std::vector<File> three_horizons() {
    return {{"top.obj", horizon_text("top", 0, [](double x, double) { return 3.1 + 0.07 * x; })},
            {"middle.obj", horizon_text("middle", 0,
                                        [](double x, double y) {
                                            return 2 + 1.9 * std::sin(0.9 * x) * std::cos(0.7 * y);
                                        })},
            {"base.obj", horizon_text("base", -2.53, [](double x, double y) {
                 return 0.9 + 0.3 * std::sin(0.5 * x + y);
             })}};
}

inline std::vector<Layer> order_of_three() {
    return {{SurfaceId(0), 2}, {SurfaceId(1), 1}, {SurfaceId(2), 3}};
}

inline Forgery layered(const std::string& name, const std::function<void(Json&)>& change,
                       const std::string& rule) {
    return {name, [change](Json& c) { change(c["layered"]); }, rule};
}

inline double layer_coordinate(const Json& mesh, std::size_t v, std::size_t axis) {
    return number_in(mesh["vertices"][v][axis]);
}

inline void move(Json& mesh, std::size_t v, std::size_t axis, double by) {
    shift_number(mesh["vertices"][v][axis], by);
}

/// Returns the first triangle of exactly these layers that is away from the borders of all.
inline std::size_t triangle_of(const Json& mesh, const Json& layers) {
    for (std::size_t t = 0; t < mesh["triangles"].size(); ++t) {
        bool inside = mesh["layers"][t] == layers;
        for (const Json& v : mesh["triangles"][t]) {
            const double x = layer_coordinate(mesh, v.get<std::size_t>(), 0),
                         y = layer_coordinate(mesh, v.get<std::size_t>(), 1);
            inside = inside && y > 1.5 && y < 7 && x > 0.5 && x < 7;
        }
        if (inside) return t;
    }
    FAIL("there is no triangle of these layers");
    return 0;
}

inline void erase_layered(Json& mesh, std::size_t t) {
    for (const char* list : {"triangles", "layers", "regions", "parents"}) mesh[list].erase(t);
}

/// Removes all triangles of these layers.
inline void erase_all(Json& mesh, const Json& layers) {
    for (std::size_t t = mesh["triangles"].size(); t-- > 0;)
        if (mesh["layers"][t] == layers) erase_layered(mesh, t);
    drop_unused(mesh);
}

inline void set_layers(Json& mesh, std::size_t t, const Json& layers) {
    mesh["layers"][t] = layers;
    mesh["regions"][t] = Json::array();
    for (std::size_t i = 0; i < layers.size(); ++i) mesh["regions"][t].push_back(0);
}

/// Divides a triangle into three by a vertex above its centroid.
inline void raise_peak(Json& mesh, std::size_t t, double height) {
    const Json corners = mesh["triangles"][t];
    Json peak = Json::array({"", "", ""});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double sum = 0;
        for (const Json& v : corners) sum += layer_coordinate(mesh, v.get<std::size_t>(), axis);
        peak[axis] = decimal_text(sum / 3 + (axis == 2 ? height : 0));
    }
    const auto v = static_cast<int>(mesh["vertices"].size());
    mesh["vertices"].push_back(peak);
    mesh["triangles"][t] = {corners[0], corners[1], v};
    for (const std::size_t i : {1U, 2U}) {
        mesh["triangles"].push_back({corners[i], corners[(i + 1) % 3], v});
        for (const char* list : {"layers", "regions", "parents"})
            mesh[list].push_back(mesh[list][t]);
    }
}

/// Moves all vertices of the triangles of one layer.
inline void move_layer(Json& mesh, int layer, double by) {
    std::set<std::size_t> vertices;
    for (std::size_t t = 0; t < mesh["triangles"].size(); ++t)
        for (const Json& l : mesh["layers"][t])
            if (l == layer)
                for (const Json& v : mesh["triangles"][t]) vertices.insert(v.get<std::size_t>());
    for (const std::size_t v : vertices) move(mesh, v, 2, by);
}

inline std::vector<Layer> order_of(std::initializer_list<double> hardness) {
    std::vector<Layer> order;
    for (const double h : hardness)
        order.push_back({SurfaceId(static_cast<std::uint32_t>(order.size())), h});
    return order;
}

} // namespace forged
