// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares what must be the same. Each function returns the first thing that differs; nothing if all is
// the same.
#pragma once

#include <cstdint>
#include <string>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace test_support {

using namespace terrane;

/// Compares all but intersection edges, which pieces of a mesh do not have.
inline std::string difference(const Mesh& a, const Mesh& b) {
    if (a.surfaces != b.surfaces) return "surfaces";
    if (a.vertices != b.vertices) return "vertices";
    if (a.triangles != b.triangles) return "triangles";
    if (a.surfaces_of != b.surfaces_of) return "surfaces of triangles";
    if (a.regions_of != b.regions_of) return "regions of triangles";
    if (a.parents_of != b.parents_of) return "parents";
    return "";
}

/// Compares arrangements, down to what later stages take from them.
inline std::string difference(const Arrangement& a, const Arrangement& b) {
    const auto &s = *a.state, &t = *b.state;
    if (a.vertices != b.vertices) return "vertices";
    if (a.triangles != b.triangles) return "triangles";
    if (a.parents_of != b.parents_of) return "parents";
    if (a.surfaces_of != b.surfaces_of) return "surfaces of triangles";
    if (a.intersection_edges != b.intersection_edges) return "intersection edges";
    if (a.statistics.candidates != b.statistics.candidates) return "number of candidates";
    if (a.statistics.improper_contacts != b.statistics.improper_contacts)
        return "number of improper contacts";
    if (s.neighbours != t.neighbours) return "neighbours";
    if (s.crowded != t.crowded) return "crowded triangles";
    if (s.pools != t.pools) return "pools";
    if (s.adjacency.edges != t.adjacency.edges) return "edges";
    if (s.adjacency.triangles_at != t.adjacency.triangles_at) return "triangles at edges";
    if (s.adjacency.inner != t.adjacency.inner) return "inner edges";
    if (s.patches.of != t.patches.of) return "patches";
    if (s.patches.axis != t.patches.axis) return "axes of patches";
    if (s.patches.turn != t.patches.turn) return "turns of patches";
    for (std::uint32_t v = 0; v < a.vertices.size(); ++v)
        if (a.construction(VertexId(v)) != b.construction(VertexId(v)) ||
            a.nearest(VertexId(v)) != b.nearest(VertexId(v)))
            return "vertex " + std::to_string(v);
    return "";
}

} // namespace test_support
