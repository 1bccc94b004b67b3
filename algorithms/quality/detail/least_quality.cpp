// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/least_quality.hpp>

#include <utility>

#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/quality.hpp>

namespace terrane::quality::detail {

std::vector<std::uint32_t> worse_than(const WorkMesh& mesh, double q) {
    std::vector<std::uint32_t> bad;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!mesh.in_use(t)) continue;
        const auto& [a, b, c] = mesh.triangles[t];
        if (quality_of(mesh.points[a], mesh.points[b], mesh.points[c]) < q) bad.push_back(t);
    }
    return bad;
}

void make_strict_near(std::span<const std::uint32_t> bad, const WorkMesh& mesh, const Mesh& input,
                      LeastQuality& least) {
    least.strict.resize(input.triangles.size(), 0);
    std::vector<std::vector<std::uint32_t>> star(input.vertices.size());
    for (std::uint32_t t = 0; t < input.triangles.size(); ++t)
        for (const std::uint32_t v : input.triangles[t]) star[v].push_back(t);
    std::vector<std::uint32_t> seen(input.vertices.size(), none), front;
    for (const std::uint32_t b : bad) {
        const std::uint32_t v = mesh.triangles[b][0], hint = mesh.hint_of[b];
        const Point3 here = mesh.points[v];
        const double reach = constants.strict_lengths * mesh.sizes[v];
        front.clear();
        const auto add = [&](std::uint32_t u) {
            if (std::exchange(seen[u], b) != b) front.push_back(u);
        };
        for (const std::uint32_t u : input.triangles[hint]) add(u);
        for (std::size_t k = 0; k < front.size(); ++k)
            for (const std::uint32_t t : star[front[k]]) {
                least.strict[t] = 1;
                for (const std::uint32_t u : input.triangles[t])
                    if (length(minus(input.vertices[u], here)) < reach) add(u);
            }
    }
}

} // namespace terrane::quality::detail
