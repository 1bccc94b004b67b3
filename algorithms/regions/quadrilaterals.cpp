// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/regions/regions.hpp>

#include <algorithm>
#include <optional>
#include <span>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/diffusion.hpp>

namespace terrane {
namespace {

/// The triangle on one side of a quadrilateral's diagonal, as far as the mesh has it.
struct Half {
    std::size_t parts = 0;          ///< number of triangles of the mesh
    std::uint32_t first = no_index; ///< the lowest of them
};

/// Returns the quadrilateral of two triangles that share an edge that is no stop; nothing if they
/// do not.
std::optional<Quadrilateral> joined(const Triangle& s, const Triangle& t,
                                    std::span<const Edge> stops) {
    const auto is_in = [](const Triangle& c, std::uint32_t v) {
        return c[0] == v || c[1] == v || c[2] == v;
    };
    for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t apex = s[i], from = s[(i + 1) % 3], to = s[(i + 2) % 3];
        if (is_in(t, apex) || !is_in(t, from) || !is_in(t, to)) continue;
        const auto [low, high] = std::minmax(from, to);
        if (std::binary_search(stops.begin(), stops.end(), Edge{low, high})) return std::nullopt;
        const auto* const other =
            std::find_if(t.begin(), t.end(), [&](std::uint32_t v) { return v != from && v != to; });
        return Quadrilateral{to, apex, from, *other};
    }
    return std::nullopt;
}

/// Numbers the triangles of one surface among the parents of a mesh.
class Cells {
public:
    Cells(const Mesh& mesh, std::uint32_t first, std::uint32_t last) :
        mesh_(mesh), halves_(last - first), quad_of_(mesh.triangles.size(), no_index) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            for (const std::uint32_t p : mesh.parents_of[t]) {
                if (p < first || p >= last) continue;
                Half& half = halves_[p - first];
                if (half.parts++ == 0) half.first = t;
                quad_of_[t] = std::min(quad_of_[t], (p - first) / 2);
            }
    }

    /// (2a) Lists the cells: whole quadrilaterals, and the triangles of all others.
    [[nodiscard]] QuadCells listed() const {
        QuadCells all;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const std::uint32_t q = quad_of_[t];
            if (q == no_index) continue;
            if (const auto whole = whole_quad(q)) {
                if (t != std::min(halves_[2 * q].first, halves_[2 * q + 1].first)) continue;
                all.cells.push_back(*whole);
            } else {
                all.cells.push_back(mesh_.triangles[t]);
            }
            all.quad_of.push_back(q);
        }
        return all;
    }

private:
    [[nodiscard]] std::optional<Quadrilateral> whole_quad(std::uint32_t q) const {
        const Half &a = halves_[2 * q], &b = halves_[2 * q + 1];
        if (a.parts != 1 || b.parts != 1 || quad_of_[a.first] != q || quad_of_[b.first] != q)
            return std::nullopt;
        return joined(mesh_.triangles[a.first], mesh_.triangles[b.first], mesh_.intersection_edges);
    }

    const Mesh& mesh_;
    std::vector<Half> halves_; ///< per triangle of the surface
    std::vector<std::uint32_t>
        quad_of_; ///< per triangle of the mesh; no_index if not of this surface
};

} // namespace

Surface triangles_of(const QuadSurface& surface) {
    Surface all{surface.name, surface.role, surface.vertices, {}};
    all.triangles.reserve(2 * surface.quads.size());
    for (const auto& [a, b, c, d] : surface.quads) {
        all.triangles.push_back({a, b, c});
        all.triangles.push_back({a, c, d});
    }
    return all;
}

Result<QuadCells> quad_cells(const Mesh& mesh, const InputTriangles& inputs, SurfaceId surface) {
    return guarded("for the cells", "cells", [&]() -> Result<QuadCells> {
        if (std::size_t{surface} + 1 >= inputs.first.size())
            return Error{ErrorCode::bad_index, "there is no such surface",
                         "surface " + std::to_string(surface)};
        if (mesh.parents_of.size() != mesh.triangles.size())
            return Error{ErrorCode::nothing_to_do, "the triangles of the mesh have no parents", ""};
        const std::uint32_t first = inputs.first[surface], last = inputs.first[surface + 1];
        if ((last - first) % 2 != 0)
            return Error{ErrorCode::unsupported, "the surface is not one of quadrilaterals",
                         "surface " + std::to_string(surface)};
        QuadCells all = Cells(mesh, first, last).listed();
        all.region_of = regions_of_polygons(all.cells, mesh.intersection_edges); // (2b)
        for (const std::uint32_t r : all.region_of) all.regions = std::max(all.regions, r + 1);
        return all;
    });
}

} // namespace terrane
