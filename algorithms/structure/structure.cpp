// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/structure.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/structure/block_names.hpp>
#include <terrane/algorithms/structure/build_structure.hpp>
#include <terrane/algorithms/structure/detail/parts.hpp>

namespace terrane {

using namespace structure::detail;

namespace {

/// Lists the ranks of the triangles' vertices, each once, ascending; parts are ordered by them.
std::vector<std::uint32_t> vertex_ranks(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                                        const std::vector<std::uint32_t>& ranks) {
    std::vector<std::uint32_t> all;
    all.reserve(3 * triangles.size());
    for (const std::uint32_t t : triangles)
        for (const std::uint32_t v : mesh.triangles[t]) all.push_back(ranks[v]);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/// Groups triangles that are equal in the order `before`; groups and their triangles are ascending.
template <class Before>
IndexLists<std::uint32_t> grouped(std::size_t count, const Before& before) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), before);
    IndexLists<std::uint32_t> groups;
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && before(order[i - 1], order[i])) groups.close();
        groups.values.push_back(order[i]);
    }
    if (count > 0) groups.close();
    return groups;
}

class Builder {
public:
    Builder(const Mesh& mesh, const Volumes& volumes) :
        mesh_(mesh), volumes_(volumes), ranks_(ranks_of(mesh.vertices)),
        edges_(group_edges(mesh.triangles, mesh.vertices.size())) {}

    Result<Structure> operator()(const Run& run) {
        const std::array<std::function<void()>, 5> steps{
            [&] { find_interfaces(); }, [&] { find_patches(); },
            [&] { add_lines(mesh_, edges_, ranks_, out_); },
            [&] { add_blocks(mesh_, volumes_, out_); },
            [&] { name_blocks(mesh_, volumes_, {}, out_); }};
        for (const auto& step : steps) {
            if (run.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", "structure"};
            step();
        }
        return std::move(out_);
    }

private:
    [[nodiscard]] std::array<std::uint32_t, 2> volumes_at(std::uint32_t t) const {
        const auto [front, back] = volumes_.of_sides[t];
        return {std::min(front, back), std::max(front, back)};
    }

    void find_interfaces() {
        const auto before = [&](std::uint32_t t, std::uint32_t u) {
            const auto a = volumes_at(t), b = volumes_at(u);
            if (a != b) return a < b;
            const auto s = mesh_.surfaces_of[t], r = mesh_.surfaces_of[u];
            return std::lexicographical_compare(s.begin(), s.end(), r.begin(), r.end());
        };
        const auto groups = grouped(mesh_.triangles.size(), before);
        for (std::size_t g = 0; g < groups.size(); ++g) {
            ModelInterface i;
            i.triangles.assign(groups[g].begin(), groups[g].end());
            i.volumes = volumes_at(i.triangles[0]);
            const auto surfaces = mesh_.surfaces_of[i.triangles[0]];
            i.surfaces.assign(surfaces.begin(), surfaces.end());
            out_.interfaces.push_back(std::move(i));
        }
        sort_by_place(out_.interfaces);
        out_.interface_of.resize(mesh_.triangles.size());
        for (std::uint32_t i = 0; i < out_.interfaces.size(); ++i)
            for (const std::uint32_t t : out_.interfaces[i].triangles) out_.interface_of[t] = i;
    }

    /// Sorts by volumes (of interfaces), then by vertices, then by the lowest triangle.
    template <class Part>
    void sort_by_place(std::vector<Part>& parts) {
        using Key =
            std::tuple<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>, std::uint32_t>;
        std::vector<std::pair<Key, std::uint32_t>> keys;
        for (std::uint32_t i = 0; i < parts.size(); ++i) {
            std::array<std::uint32_t, 2> volumes{};
            if constexpr (requires { parts[i].volumes; }) volumes = parts[i].volumes;
            keys.push_back(
                {{volumes, vertex_ranks(mesh_, parts[i].triangles, ranks_), parts[i].triangles[0]},
                 i});
        }
        std::sort(keys.begin(), keys.end());
        std::vector<Part> sorted;
        for (const auto& [key, i] : keys) sorted.push_back(std::move(parts[i]));
        parts = std::move(sorted);
    }

    void find_patches() {
        DisjointSets sets(mesh_.triangles.size());
        edges_.for_each([&](std::uint32_t, std::uint32_t, auto sides) {
            if (sides.size() == 2 &&
                out_.interface_of[sides[0].triangle] == out_.interface_of[sides[1].triangle])
                sets.join(sides[0].triangle, sides[1].triangle);
        });
        const auto groups = grouped(mesh_.triangles.size(), [&](std::uint32_t t, std::uint32_t u) {
            return sets.find(t) < sets.find(u);
        });
        for (std::size_t g = 0; g < groups.size(); ++g) {
            ModelPatch p;
            p.triangles.assign(groups[g].begin(), groups[g].end());
            p.interface = InterfaceId(out_.interface_of[p.triangles[0]]);
            out_.patches.push_back(std::move(p));
        }
        sort_by_place(out_.patches);
        out_.patch_of.resize(mesh_.triangles.size());
        for (std::uint32_t i = 0; i < out_.patches.size(); ++i) {
            ModelPatch& patch = out_.patches[i];
            for (const std::uint32_t t : patch.triangles) {
                out_.patch_of[t] = i;
                patch.area += triangle_area(mesh_, t);
            }
            ModelInterface& interface = out_.interfaces[patch.interface];
            interface.patches.push_back(i);
            interface.area += patch.area;
        }
    }

    const Mesh& mesh_;
    const Volumes& volumes_;
    std::vector<std::uint32_t> ranks_;
    EdgeSides edges_;
    Structure out_;
};

} // namespace

namespace structure::detail {

std::vector<std::uint32_t> ranks_of(const std::vector<Point3>& vertices) {
    std::vector<std::uint32_t> order(vertices.size()), ranks(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t v, std::uint32_t w) {
        return std::pair(vertices[v], v) < std::pair(vertices[w], w);
    });
    for (std::uint32_t r = 0; r < order.size(); ++r) ranks[order[r]] = r;
    return ranks;
}

Point3 area_vector(const Mesh& mesh, std::uint32_t triangle) {
    const auto& [i, j, k] = mesh.triangles[triangle];
    const Point3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const Point3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

double triangle_area(const Mesh& mesh, std::uint32_t triangle) {
    const auto& [i, j, k] = mesh.triangles[triangle];
    return area_between(mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]);
}

} // namespace structure::detail

Structure build_structure(const Mesh& mesh, const Volumes& volumes) {
    return build_structure(mesh, volumes, Run{}).value();
}

Result<Structure> build_structure(const Mesh& mesh, const Volumes& volumes, const Run& run) {
    const StandardArithmetic guard;
    return Builder(mesh, volumes)(run);
}

} // namespace terrane
