// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <terrane/algorithms/structure/detail/constants.hpp>
#include <terrane/algorithms/structure/detail/parts.hpp>

namespace terrane {

using namespace structure::detail;

namespace {

/// Area of a surface at a block: above, below, beside.
using Shares = std::array<double, 3>;

/// Returns the position that a triangle counts for, from the outward normal of the block.
std::size_t position_of(const Point3& outward) {
    const double level = std::hypot(outward.x, outward.y);
    if (outward.z >= level) return 0;
    return -outward.z >= level ? 1 : 2;
}

/// Adds the areas of the interface's surfaces to the shares of both its volumes.
void add_shares(const Mesh& mesh, const Volumes& volumes, const ModelInterface& interface,
                std::vector<std::map<std::uint32_t, Shares>>& shares) {
    for (const std::uint32_t t : interface.triangles) {
        const Point3 n = area_vector(mesh, t);
        const Point3 reversed{-n.x, -n.y, -n.z};
        const double area = triangle_area(mesh, t);
        const auto [front, back] = volumes.of_sides[t];
        for (const std::uint32_t s : interface.surfaces) {
            shares[front][s][position_of(reversed)] += area;
            shares[back][s][position_of(n)] += area;
        }
    }
}

void describe(const std::map<std::uint32_t, Shares>& shares, ModelBlock& block) {
    const std::array positions{&block.above, &block.below, &block.beside};
    for (const auto& [surface, share] : shares) {
        const double all = share[0] + share[1] + share[2];
        const auto most = std::max_element(share.begin(), share.end()) - share.begin();
        for (std::size_t p = 0; p < 3; ++p)
            if (static_cast<std::ptrdiff_t>(p) == most ||
                share[p] >= block_name_constants.least_share * all)
                positions[p]->push_back(surface);
    }
}

} // namespace

namespace structure::detail {

void add_blocks(const Mesh& mesh, const Volumes& volumes, Structure& structure) {
    auto& blocks = structure.blocks;
    blocks.resize(volumes.measures.size());
    std::vector<std::map<std::uint32_t, Shares>> shares(blocks.size());
    for (std::uint32_t i = 0; i < structure.interfaces.size(); ++i) {
        const ModelInterface& interface = structure.interfaces[i];
        const auto [low, high] = interface.volumes;
        if (interface.dangles()) {
            blocks[low].inner_interfaces.push_back(i);
            continue;
        }
        add_shares(mesh, volumes, interface, shares);
        for (const auto& [here, there] : {std::pair{low, high}, std::pair{high, low}}) {
            blocks[here].interfaces.push_back(i);
            blocks[here].neighbours.push_back(there);
            blocks[here].area += interface.area;
        }
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        auto& near = blocks[b].neighbours;
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        if (b == 0) continue; // the outside has no volume
        blocks[b].volume = volumes.measures[b];
        describe(shares[b], blocks[b]);
    }
}

} // namespace structure::detail

std::vector<NamedConstant> structure_constants() {
    const BlockNameConstants& c = block_name_constants;
    return {{"least_share", c.least_share},
            {"least_resultant", c.least_resultant},
            {"most_listed", static_cast<double>(c.most_listed)},
            {"most_added", static_cast<double>(c.most_added)},
            {"least_common", stated_block_constants.least_common}};
}

} // namespace terrane
