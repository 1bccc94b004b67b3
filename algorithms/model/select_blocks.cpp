// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Regions of a model by expressions over its blocks. The boundary of each set of blocks that an expression names is a
// closed surface, so that a region of blocks is one of surfaces.
#include <algorithm>
#include <string>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/regions/regions.hpp>
#include <terrane/algorithms/selection/parsed.hpp>

namespace terrane {
namespace {

using Kind = Expression::Kind;

/// Surfaces of which a region is selected, and where their triangles come from.
struct Operands {
    std::vector<Surface> surfaces;
    std::vector<std::uint32_t>
        origins; ///< per triangle, counted through all: of the mesh, then of the others
};

Error not_there(std::string_view kind, const std::string& name, std::vector<std::string> names) {
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return {ErrorCode::bad_option, not_called(kind, name, names), "expression"};
}

/// Returns per block whether an operand names it, never the outside. Errors: bad_option.
Result<std::vector<bool>> blocks_of(const Model& model, const Expression::Operand& operand) {
    const auto& blocks = model.structure.blocks;
    std::vector<bool> in(blocks.size());
    std::vector<std::string> names;
    bool has = operand.kind == Kind::volume || operand.kind == Kind::age;
    for (std::size_t b = 1; b < blocks.size(); ++b) {
        const ModelBlock& block = blocks[b];
        const auto fits = [&](double number) {
            return operand.is_less ? number < operand.number : number > operand.number;
        };
        if (operand.kind == Kind::block)
            in[b] = block.name == operand.name;
        else if (operand.kind == Kind::unit)
            in[b] = block.unit == operand.name;
        else if (operand.kind == Kind::volume)
            in[b] = fits(model.exact_volumes[b]);
        else
            in[b] = block.age && fits(*block.age);
        has = has || in[b];
        const std::string& name = operand.kind == Kind::unit ? block.unit : block.name;
        if (!name.empty()) names.push_back(name);
    }
    if (!has && operand.kind == Kind::block)
        for (std::size_t b = 1; b < blocks.size() && !has; ++b)
            has = in[b] = std::to_string(b) == operand.name;
    if (!has) return not_there(operand.kind == Kind::unit ? "unit" : "block", operand.name, names);
    return in;
}

/// Appends the boundary of blocks, whose triangles face outwards.
void append_boundary(const Model& model, const std::vector<bool>& in, std::string name,
                     Operands& operands) {
    const Mesh& mesh = model.mesh;
    Surface made{std::move(name), Role::unknown, mesh.vertices, {}};
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [front, behind] = model.volumes.of_sides[t];
        if (in[front] == in[behind]) continue;
        const auto [a, b, c] = mesh.triangles[t];
        made.triangles.push_back(in[behind] ? Triangle{a, b, c} : Triangle{a, c, b});
        operands.origins.push_back(t);
    }
    operands.surfaces.push_back(std::move(made));
}

/// Lists the surfaces of the model, the others, and the boundaries of blocks, by which the expression names them then.
Result<Operands> operands_of(const Model& model, std::span<const Surface> others,
                             Expression& expression) {
    const Mesh& mesh = model.mesh;
    Operands operands{surfaces_of_mesh(mesh), {}};
    for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s)
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            if (std::ranges::count(mesh.surfaces_of[t], s) > 0) operands.origins.push_back(t);
    auto next = static_cast<std::uint32_t>(mesh.triangles.size());
    for (const Surface& other : others) {
        operands.surfaces.push_back(other);
        for (std::size_t t = 0; t < other.triangles.size(); ++t) operands.origins.push_back(next++);
    }
    for (std::uint32_t k = 0; k < expression.operands.size(); ++k) {
        if (!expression.is_of_blocks(k)) continue;
        auto& operand = expression.operands[k];
        const auto in = blocks_of(model, operand);
        if (!in) return in.error();
        // No surface has this name: names have no control characters.
        std::string name = "blocks\n" + std::to_string(k);
        operand = {name, Kind::inside};
        append_boundary(model, *in, std::move(name), operands);
    }
    return operands;
}

/// Names the surfaces and parents of the model, not those of the boundaries.
void name_origins(const Model& model, std::span<const Surface> others, const Operands& operands,
                  Mesh& made) {
    const Mesh& mesh = model.mesh;
    std::vector<std::uint32_t> surface_of_other;
    for (std::uint32_t s = 0; s < others.size(); ++s)
        surface_of_other.insert(surface_of_other.end(), others[s].triangles.size(),
                                static_cast<std::uint32_t>(mesh.surfaces.size()) + s);
    IndexLists<std::uint32_t> parents_of, surfaces_of;
    for (std::size_t t = 0; t < made.triangles.size(); ++t) {
        std::vector<std::uint32_t> parents, surfaces;
        for (const std::uint32_t p : made.parents_of[t]) {
            const std::uint32_t origin = operands.origins[p];
            parents.push_back(origin);
            if (origin >= mesh.triangles.size()) {
                surfaces.push_back(surface_of_other[origin - mesh.triangles.size()]);
                continue;
            }
            const auto of = mesh.surfaces_of[origin];
            surfaces.insert(surfaces.end(), of.begin(), of.end());
        }
        sort_unique(parents);
        sort_unique(surfaces);
        parents_of.push_back(parents);
        surfaces_of.push_back(surfaces);
    }
    made.parents_of = std::move(parents_of);
    made.surfaces_of = std::move(surfaces_of);
    made.regions_of = {};
    made.surfaces = mesh.surfaces;
    for (const Surface& other : others) made.surfaces.push_back({other.name, other.role});
}

/// Lists the edges at which triangles of different surfaces meet.
void find_intersection_edges(Mesh& mesh) {
    const auto edges = group_edges(mesh.triangles, mesh.vertices.size());
    edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
        const auto first = mesh.surfaces_of[sides.front().triangle];
        if (std::ranges::any_of(sides, [&](const auto& side) {
                return !std::ranges::equal(mesh.surfaces_of[side.triangle], first);
            }))
            mesh.intersection_edges.push_back({low, high});
    });
    sort_unique(mesh.intersection_edges);
}

} // namespace

Result<Selected> select(const Model& model, std::string_view text, std::span<const Surface> others,
                        const SelectOptions& options, const Run& run) {
    return guarded("for the selection", "select", [&]() -> Result<Selected> {
        auto expression = parse_expression(text);
        if (!expression) return expression.error();
        if (const auto valid = validate(others, run); !valid) return valid.error();
        const auto operands = operands_of(model, others, *expression);
        if (!operands) return operands.error();
        auto made = select_parsed(operands->surfaces, std::move(*expression), options, run);
        if (!made) return made.error();
        name_origins(model, others, *operands, made->mesh);
        find_intersection_edges(made->mesh);
        if (!made->is_surface) return made;
        auto regions = find_regions(made->mesh, run);
        made->mesh.regions_of = std::move(regions.regions_of);
        made->regions = regions.regions.size();
        return made;
    });
}

} // namespace terrane
