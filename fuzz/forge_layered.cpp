// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The changes that only certificates of layers have.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "forge_geometry.hpp"
#include "forge_lists.hpp"

namespace terrane::fuzz {

namespace {

/// Changes the layers of each triangle; triangles that have none then are dropped.
void relabel(LayeredClaim& m, const std::function<void(std::size_t, Numbers&)>& edit) {
    auto layers = unpacked(m.surfaces_of);
    if (layers.size() != m.triangles.size()) return;
    for (std::size_t t = layers.size(); t-- > 0;) {
        edit(t, layers[t]);
        std::sort(layers[t].begin(), layers[t].end());
        if (!layers[t].empty()) continue;
        erase_at(layers, t);
        erase_at(m.triangles, t);
    }
    m.surfaces_of = packed(layers);
    m.regions_of = m.parents_of = {};
}

/// Exchanges two layers in the order, with their triangles or without.
void exchange_layers(Certificate& c, const Arguments& n) {
    LayeredClaim& m = *c.layered();
    if (m.order.empty()) return;
    const auto one = static_cast<std::uint32_t>(pick(n.a, m.order.size()));
    const auto other = static_cast<std::uint32_t>(pick(n.b, m.order.size()));
    std::swap(m.order[one], m.order[other]);
    if (n.c % 2 == 0) return;
    relabel(m, [&](std::size_t, Numbers& layers) {
        for (std::uint32_t& l : layers)
            if (l == one || l == other) l = l == one ? other : one;
    });
}

void change_hardness(Certificate& c, const Arguments& n) {
    auto& order = c.layered()->order;
    if (order.empty()) return;
    double& hardness = order[pick(n.a, order.size())].hardness;
    if (n.b % 3 == 0)
        hardness = n.c % 8;
    else if (n.b % 3 == 1)
        std::swap(hardness, order[pick(n.c, order.size())].hardness);
    else
        for (CertifiedLayer& layer : order) layer.hardness = n.c;
}

/// Leaves a layer out, of the order and of all triangles.
void drop_layer(Certificate& c, const Arguments& n) {
    LayeredClaim& m = *c.layered();
    if (m.order.empty()) return;
    const auto gone = static_cast<std::uint32_t>(pick(n.a, m.order.size()));
    erase_at(m.order, gone);
    relabel(m, [&](std::size_t, Numbers& layers) {
        std::erase(layers, gone);
        for (std::uint32_t& l : layers)
            if (l > gone) --l;
    });
}

/// Puts another surface into the order, with the triangles of an old layer or none.
void add_layer(Certificate& c, const Arguments& n) {
    LayeredClaim& m = *c.layered();
    const auto at = static_cast<std::uint32_t>(pick(n.a, m.order.size() + 1));
    m.order.insert(m.order.begin() + at, {n.b % 4, static_cast<double>(n.c % 8)});
    relabel(m, [&](std::size_t, Numbers& layers) {
        for (std::uint32_t& l : layers)
            if (l >= at) ++l;
        if (n.d % 2 == 1 && std::ranges::count(layers, at + 1) > 0) layers.push_back(at);
    });
}

/// Gives all triangles of the same layers those of another triangle.
void move_triangles(Certificate& c, const Arguments& n) {
    LayeredClaim& m = *c.layered();
    const auto layers = unpacked(m.surfaces_of);
    if (layers.empty()) return;
    const Numbers& from = layers[pick(n.a, layers.size())];
    const Numbers& to = layers[pick(n.b, layers.size())];
    relabel(m, [&](std::size_t, Numbers& own) {
        if (own == from) own = to;
    });
}

/// Drops all triangles that have the layers of one.
void drop_places(Certificate& c, const Arguments& n) {
    LayeredClaim& m = *c.layered();
    const auto layers = unpacked(m.surfaces_of);
    if (layers.empty()) return;
    const Numbers& gone = layers[pick(n.a, layers.size())];
    relabel(m, [&](std::size_t, Numbers& own) {
        if (own == gone) own.clear();
    });
}

/// Moves all vertices of a layer along an axis.
void move_layer(Certificate& c, const Arguments& n) {
    LayeredClaim& m = *c.layered();
    std::vector<bool> moves(m.vertices.size());
    for (std::size_t t = 0; t < m.triangles.size() && t < m.surfaces_of.size(); ++t)
        if (std::ranges::count(m.surfaces_of[t], n.a % 4) > 0)
            for (const std::uint32_t v : m.triangles[t])
                if (v < moves.size()) moves[v] = true;
    for (std::size_t v = 0; v < moves.size(); ++v) {
        if (!moves[v]) continue;
        Point3& p = m.vertices[v];
        double& x = n.b % 4 == 0 ? p.x : n.b % 4 == 1 ? p.y : p.z;
        x = moved(x, n.c, n.d);
    }
}

void change_layer_deviation(Certificate& c, const Arguments& n) {
    double& deviation = c.layered()->deviation;
    deviation = n.a % 2 == 0 ? deviation * (n.b + 1.0) / 64 : moved(deviation, n.b, n.c);
}

/// Gives the thickness another value, or none.
void change_thickness(Certificate& c, const Arguments& n) {
    auto& thickness = c.layered()->thickness;
    const double old = thickness.value_or(0);
    switch (n.a % 5) {
    case 0:
        thickness = old * (n.b + 1.0) / 16;
        break;
    case 1:
        thickness = moved(old, n.b, n.c);
        break;
    case 2:
        thickness = (n.b % 64) / 32.0;
        break;
    case 3:
        thickness = std::array{1e300, 5e-324, -old, HUGE_VAL, std::nan(""), 1e-12}[n.b % 6];
        break;
    default:
        thickness.reset();
    }
}

void change_layer_surface(Certificate& c, const Arguments& n) {
    auto& order = c.layered()->order;
    if (!order.empty()) change_number(order[pick(n.a, order.size())].surface, n);
}

constexpr std::array<Change, 10> layered_changes{{
    {"layers exchanged", exchange_layers},
    {"hardness changed", change_hardness},
    {"layer dropped", drop_layer},
    {"layer added", add_layer},
    {"triangles in other layers", move_triangles},
    {"triangles of the same layers dropped", drop_places},
    {"layer moved", move_layer},
    {"deviation of layers changed", change_layer_deviation},
    {"surface of a layer changed", change_layer_surface},
    {"thickness changed", change_thickness},
}};

} // namespace

std::span<const Change> changes_of_layers() {
    return layered_changes;
}

} // namespace terrane::fuzz
