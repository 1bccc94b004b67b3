// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/structure.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/edges.hpp>

namespace terrane {
namespace {

/// The triangles at one edge of each line. The triangles at all of its edges are of the same
/// patches.
std::vector<std::vector<std::uint32_t>> triangles_at_lines(const Mesh& mesh,
                                                           const Structure& structure) {
    std::vector<std::pair<Edge, std::uint32_t>> wanted; // edge, line
    for (std::uint32_t l = 0; l < structure.lines.size(); ++l) {
        const auto& v = structure.lines[l].vertices;
        wanted.push_back({{std::min(v[0], v[1]), std::max(v[0], v[1])}, l});
    }
    std::sort(wanted.begin(), wanted.end());
    std::vector<std::vector<std::uint32_t>> at(structure.lines.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] =
                std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
            const Edge edge{low, high};
            const auto found =
                std::lower_bound(wanted.begin(), wanted.end(), edge,
                                 [](const auto& entry, const Edge& e) { return entry.first < e; });
            if (found != wanted.end() && found->first == edge) at[found->second].push_back(t);
        }
    return at;
}

/// The triangles of two surfaces at an edge.
struct Counts {
    std::size_t first = 0, second = 0, both = 0;
};

Counts count(const Mesh& mesh, std::span<const std::uint32_t> triangles, std::uint32_t first,
             std::uint32_t second) {
    Counts counts;
    for (const std::uint32_t t : triangles) {
        const auto surfaces = mesh.surfaces_of[t];
        const bool in_first = std::binary_search(surfaces.begin(), surfaces.end(), first);
        const bool in_second = std::binary_search(surfaces.begin(), surfaces.end(), second);
        counts.first += in_first ? 1 : 0;
        counts.second += in_second ? 1 : 0;
        counts.both += in_first && in_second ? 1 : 0;
    }
    return counts;
}

/// Sums relations of lines; their places are on the longest lines.
class Relations {
public:
    void add(std::uint32_t from, std::uint32_t to, RelationKind kind, double length,
             const Point3& place) {
        auto& [relation, longest] = all_[{from, to, kind}];
        relation.from = SurfaceId(from);
        relation.to = SurfaceId(to);
        relation.kind = kind;
        relation.length += length;
        if (length <= longest) return;
        longest = length;
        relation.place = place;
    }

    void add(const Mesh& mesh, const ModelLine& line, std::span<const std::uint32_t> triangles) {
        const Point3& place = mesh.vertices[line.vertices[line.vertices.size() / 2]];
        for (std::size_t i = 0; i < line.surfaces.size(); ++i)
            for (std::size_t j = i + 1; j < line.surfaces.size(); ++j) {
                std::uint32_t from = line.surfaces[i], to = line.surfaces[j];
                const Counts counts = count(mesh, triangles, from, to);
                RelationKind kind = RelationKind::crosses;
                if (counts.both > 0)
                    kind = RelationKind::overlaps;
                else if (counts.first == 1 && counts.second == 1)
                    kind = RelationKind::meets;
                else if (counts.first == 1 || counts.second == 1)
                    kind = RelationKind::stops;
                if (kind == RelationKind::stops && counts.second == 1) std::swap(from, to);
                add(from, to, kind, line.length, place);
            }
    }

    [[nodiscard]] std::vector<SurfaceRelation> list() const {
        std::vector<SurfaceRelation> relations;
        for (const auto& [key, entry] : all_) relations.push_back(entry.first);
        return relations;
    }

private:
    using Key = std::tuple<std::uint32_t, std::uint32_t, RelationKind>;
    std::map<Key, std::pair<SurfaceRelation, double>> all_; ///< with the longest line
};

} // namespace

std::string_view name_of(RelationKind kind) {
    constexpr std::array<std::string_view, 5> names{"stops at", "crosses", "meets", "overlaps",
                                                    "ends near"};
    return names[static_cast<std::size_t>(kind)];
}

std::vector<SurfaceRelation> find_relations(const Mesh& mesh, const Structure& structure,
                                            std::span<const FreeBorder> borders) {
    const StandardArithmetic guard;
    const auto at = triangles_at_lines(mesh, structure);
    Relations lines;
    for (std::size_t l = 0; l < structure.lines.size(); ++l)
        lines.add(mesh, structure.lines[l], at[l]);
    auto relations = lines.list();
    for (const Leak& leak : leaks_of(borders))
        relations.push_back({leak.from, leak.to, RelationKind::near, leak.length, leak.least,
                             leak.largest, leak.place});
    std::stable_sort(relations.begin(), relations.end(), [](const auto& a, const auto& b) {
        return std::tie(a.from, a.to, a.kind, a.largest) <
               std::tie(b.from, b.to, b.kind, b.largest);
    });
    return relations;
}

std::vector<Juxtaposition> find_juxtapositions(const Structure& structure) {
    const StandardArithmetic guard;
    std::map<std::pair<std::uint32_t, std::array<std::uint32_t, 2>>, double> areas;
    for (const ModelInterface& between : structure.interfaces) {
        if (between.dangles()) continue;
        for (const std::uint32_t s : between.surfaces) areas[{s, between.volumes}] += between.area;
    }
    std::vector<Juxtaposition> all;
    for (const auto& [key, area] : areas) all.push_back({SurfaceId(key.first), key.second, area});
    return all;
}

} // namespace terrane
