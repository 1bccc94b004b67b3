// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <terrane/algorithms/structure/detail/parts.hpp>

namespace terrane {
namespace {

constexpr double least_share = 0.1; ///< least share of a surface's area at a block to be named
                                    ///< above, below or beside

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
        const double area = std::hypot(n.x, n.y, n.z) / 2;
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
            if (static_cast<std::ptrdiff_t>(p) == most || share[p] >= least_share * all)
                positions[p]->push_back(surface);
    }
}

std::string joined(const Mesh& mesh, const std::vector<std::uint32_t>& surfaces) {
    std::string text;
    for (const std::uint32_t s : surfaces)
        text += (text.empty() ? "" : "+") + mesh.surfaces[s].name;
    return text.empty() ? "-" : text;
}

void name_blocks(const Mesh& mesh, std::vector<ModelBlock>& blocks) {
    std::set<std::string> taken{"outside"};
    blocks[0].name = "outside";
    for (std::size_t b = 1; b < blocks.size(); ++b) {
        ModelBlock& block = blocks[b];
        std::string name = joined(mesh, block.above) + "/" + joined(mesh, block.below);
        if (!block.beside.empty()) name += "|" + joined(mesh, block.beside);
        block.name = name;
        for (int k = 2; !taken.insert(block.name).second; ++k)
            block.name = name + " " + std::to_string(k);
    }
}

} // namespace

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
        blocks[b].volume = volumes.measures[b];
        if (b > 0) describe(shares[b], blocks[b]);
    }
    name_blocks(mesh, blocks);
}

} // namespace terrane
