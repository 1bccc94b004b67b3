// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/detail/folds.hpp>

#include <algorithm>
#include <map>
#include <vector>

#include <terrane/algorithms/mesh/triangle_tree.hpp>

namespace terrane::simplification::detail {

void remove_folds(Complex& complex, double max_move) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> folded; // by surface: cells
    for (std::uint32_t t = 0; t < complex.cells().size(); ++t)
        for (const CellLayer& layer : complex.cells()[t].layers)
            if (layer.is_folded) folded[layer.surface].push_back(t);
    for (const auto& [surface, cells] : folded) {
        std::vector<Triangle> rest;
        for (const Cell& cell : complex.cells())
            for (const CellLayer& layer : cell.layers)
                if (layer.surface == surface && !layer.is_folded) rest.push_back(cell.corners);
        if (rest.empty()) continue;
        const TriangleTree tree(complex.points(), rest);
        std::vector<std::uint32_t> to_go;
        for (const std::uint32_t t : cells) {
            const Triangle& c = complex.cells()[t].corners;
            if (std::all_of(c.begin(), c.end(), [&](std::uint32_t v) {
                    return complex.moved(v) + tree.distance(complex.points()[v], 2 * max_move) <=
                           max_move;
                }))
                to_go.push_back(t);
        }
        for (const std::uint32_t t : to_go) complex.remove_layer(t, surface);
    }
}

} // namespace terrane::simplification::detail
