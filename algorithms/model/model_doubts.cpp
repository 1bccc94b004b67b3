// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/model_doubts.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/labels.hpp>

namespace terrane {
namespace {

/// Share of the area that a surface without a role must show from above to count as a horizon: a
/// mean dip of 37 degrees.
constexpr double horizon_footprint = 0.8;
/// Patches at a line where two surfaces run through each other; where one ends there are 3.
constexpr std::size_t crossing_patches = 4;

std::vector<bool> horizons_of(const Mesh& mesh) {
    std::vector<double> area(mesh.surfaces.size()), footprint(mesh.surfaces.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [i, j, k] = mesh.triangles[t];
        const Point3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
        const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        for (const auto s : mesh.surfaces_of[t]) {
            area[s] += std::hypot(nx, ny, nz);
            footprint[s] += std::abs(nz);
        }
    }
    std::vector<bool> horizons(mesh.surfaces.size());
    for (std::size_t s = 0; s < horizons.size(); ++s) {
        const Role role = mesh.surfaces[s].role;
        horizons[s] = role == Role::horizon ||
                      (role == Role::unknown && footprint[s] >= horizon_footprint * area[s]);
    }
    return horizons;
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Returns the length along which each pair of horizons runs through each other.
std::map<Pair, double> crossings(const Model& model) {
    const auto horizons = horizons_of(model.mesh);
    std::map<Pair, double> lengths;
    for (const ModelLine& line : model.structure.lines) {
        if (line.surfaces.size() != 2 || line.patches.size() < crossing_patches) continue;
        if (std::ranges::all_of(line.surfaces, [&](std::uint32_t s) { return horizons[s]; }))
            lengths[{line.surfaces[0], line.surfaces[1]}] += line.length;
    }
    return lengths;
}

} // namespace

std::vector<PlausibilityWarning> find_model_doubts(const Model& model, bool blocks) {
    const StandardArithmetic guard;
    const auto labels = unique_labels(model.mesh->surfaces);
    std::vector<PlausibilityWarning> warnings;
    if (blocks && model.block_count() == 0)
        warnings.push_back(
            {Doubt::no_block,
             {},
             "the surfaces enclose no block",
             "A block is found only where surfaces close it on all sides, without a gap",
             "See the leaks above: --seal closes narrow ones, and a volume of interest "
             "(--box, --polygon, --within) closes the model around its border"});
    for (const auto& [pair, length] : crossings(model))
        warnings.push_back(
            {Doubt::horizons_cross,
             {SurfaceId(pair.first), SurfaceId(pair.second)},
             fmt::format("horizons {} and {} run through each other along {}; there are {} blocks",
                         labels[pair.first], labels[pair.second], figure(length, 4),
                         model.block_count()),
             "The layer between them is cut into pieces, and turned over in some of them",
             "`terrane layer`, or the key layers of a project, makes the softer one give way"});
    return warnings;
}

} // namespace terrane
