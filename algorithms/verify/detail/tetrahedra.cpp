// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/tetrahedra.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>

namespace terrane::verifier {

namespace {

// --- R40: lists ---------------------------------------------------------------------------------

/// Checks that the indices in each element are below a count.
template <class Elements>
void check_elements(const Elements& elements, std::size_t count, const std::string& name,
                    Violations& found) {
    for (std::uint32_t i = 0; i < elements.size(); ++i)
        if (!all_below(elements[i], count))
            found.push_back({Rule::R40_tetrahedra_lists,
                             {i},
                             name + " " + text(i) + " names what does not exist"});
}

void check_lists(const TetrahedraClaim& claim, const FilledMesh& mesh, Violations& found) {
    constexpr Rule rule = Rule::R40_tetrahedra_lists;
    const auto wrong = [&](const std::string& sentence) { found.push_back({rule, {}, sentence}); };
    check_finite(claim.vertices, "node", rule, found);
    check_elements(claim.tetrahedra, claim.vertices.size(), "tetrahedron", found);
    check_elements(claim.faces, claim.vertices.size(), "face", found);
    check_elements(claim.twins, claim.faces.size(), "pair of twins", found);
    if (claim.block_of.size() != claim.tetrahedra.size())
        wrong("there is not one block per tetrahedron");
    if (!all_below(claim.block_of, mesh.volumes.size())) wrong("a block does not exist");
    if (claim.triangle_of.size() != claim.faces.size()) wrong("there is not one triangle per face");
    for (const std::uint32_t t : claim.triangle_of)
        if (t != no_number && t >= mesh.triangles.size())
            return wrong("a triangle of a face does not exist");
    if (claim.tetrahedra.empty()) wrong("there are no tetrahedra");
}

// --- R44: places --------------------------------------------------------------------------------

/// Finds the places of nodes and vertices. Without twins no two nodes are at one point.
void find_places(TetrahedraParts& parts, Violations& found) {
    const TetrahedraClaim& claim = parts.claim;
    std::vector<bool> used(claim.vertices.size());
    for (const auto& corners : claim.tetrahedra)
        for (const std::uint32_t node : corners) used[node] = true;
    std::map<Vector4, std::uint32_t> at;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        parts.place_of.push_back(v);
        if (!used[v]) {
            found.push_back(
                {Rule::R44_nodes, {v}, "node " + text(v) + " belongs to no tetrahedron"});
            continue;
        }
        const auto [first, added] = at.emplace(parts.nodes[v], v);
        if (added) continue;
        if (!claim.twins.empty())
            parts.place_of[v] = first->second;
        else
            found.push_back({Rule::R44_nodes,
                             {first->second, v},
                             "nodes " + text(Edge{first->second, v}) + " are the same point"});
    }
    for (const Vector4& p : parts.points) {
        const auto place = at.find(p);
        parts.place_of_vertex.push_back(place == at.end() ? no_number : place->second);
    }
}

void check_vertices(const TetrahedraParts& parts, Violations& found) {
    std::vector<bool> needed(parts.points.size());
    for (std::uint32_t t = 0; t < parts.mesh.triangles.size(); ++t)
        if (parts.needs_faces(t))
            for (const std::uint32_t v : parts.mesh.triangles[t]) needed[v] = true;
    for (std::uint32_t v = 0; v < needed.size(); ++v)
        if (needed[v] && parts.place_of_vertex[v] == no_number)
            found.push_back({Rule::R44_nodes, {v}, "no node is at vertex " + text(v)});
}

TetrahedraParts make_parts(const TetrahedraClaim& claim, const FilledMesh& mesh) {
    std::vector<Point3> all = claim.vertices;
    all.insert(all.end(), mesh.vertices.begin(), mesh.vertices.end());
    auto [points, scale] = scale_to_integers(all);
    TetrahedraParts parts{claim, mesh, {}, {}, scale, {}, {}, {}};
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(claim.vertices.size());
    parts.points.assign(middle, points.end());
    points.erase(middle, points.end());
    parts.nodes = std::move(points);
    for (const auto& corners : claim.tetrahedra)
        for (const std::uint32_t node : corners) parts.box.add(parts.nodes[node]);
    return parts;
}

// --- R41, R43, R47: volumes ---------------------------------------------------------------------

/// Checks the sign of each tetrahedron, and returns six times the volumes per block, in the unit of
/// the nodes.
std::vector<mpz_class> six_volumes_of_tetrahedra(const TetrahedraParts& parts, Violations& found) {
    std::vector<mpz_class> sums(parts.mesh.volumes.size());
    for (std::uint32_t t = 0; t < parts.claim.tetrahedra.size(); ++t) {
        const auto& [i, j, k, l] = parts.claim.tetrahedra[t];
        const Vector4& a = parts.nodes[i];
        const auto from_a = [&](std::uint32_t v) { return difference(parts.nodes[v], a); };
        const mpz_class volume = dot(cross(from_a(j), from_a(k)), from_a(l));
        if (sgn(volume) <= 0)
            found.push_back(
                {Rule::R41_positive,
                 {t},
                 "tetrahedron " + text(t) + " is " + (sgn(volume) == 0 ? "flat" : "inverted")});
        sums[parts.claim.block_of[t]] += volume;
    }
    return sums;
}

/// Checks that the tetrahedra add up to the box around them.
void check_box(const TetrahedraParts& parts, const std::vector<mpz_class>& sums,
               Violations& found) {
    mpz_class left = 6;
    for (std::size_t i = 0; i < 3; ++i) left *= parts.box.high[i] - parts.box.low[i];
    for (const mpz_class& sum : sums) left -= sum;
    if (sgn(left) != 0)
        found.push_back({Rule::R43_box,
                         {},
                         "the volumes of the tetrahedra do not add up to that of their box"});
}

/// Compares the volumes of blocks with those of their tetrahedra; returns the largest difference.
mpq_class check_volumes(const TetrahedraParts& parts, const std::vector<mpz_class>& sums,
                        const std::vector<bool>& divided, Violations& found) {
    const FilledMesh& mesh = parts.mesh;
    std::vector<mpq_class> bounds(mesh.volumes.size());
    for (std::uint32_t t = 0; t < divided.size(); ++t) {
        const auto [front, back] = mesh.sides[t];
        if (!divided[t] || front == back) continue;
        const auto& [a, b, c] = mesh.triangles[t];
        const mpq_class bound =
            volume_within_reach({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
        bounds[front] += bound;
        bounds[back] += bound;
    }
    mpq_class largest = 0;
    const mpz_class below = 6 * parts.scale * parts.scale * parts.scale;
    for (std::uint32_t b = 1; b < sums.size(); ++b) {
        mpq_class volume(sums[b], below);
        volume.canonicalize();
        const mpq_class difference = abs(volume - mesh.volumes[b]);
        largest = std::max(largest, difference);
        if (difference > bounds[b])
            found.push_back({Rule::R47_block_volumes,
                             {b},
                             "block " + text(b) +
                                 " and its tetrahedra differ in volume by more "
                                 "than nodes near its triangles allow"});
    }
    return largest;
}

} // namespace

MeasuredVolumes check_tetrahedra(const TetrahedraClaim& claim, const FilledMesh& mesh,
                                 Violations& found) {
    const std::size_t before = found.size();
    check_lists(claim, mesh, found);
    if (found.size() > before) return {};
    TetrahedraParts parts = make_parts(claim, mesh);
    find_places(parts, found);
    check_vertices(parts, found);
    const auto sums = six_volumes_of_tetrahedra(parts, found);
    if (claim.box) check_box(parts, sums, found);
    const auto faces_of = check_faces(parts, found);
    const auto divided = check_cover(parts, faces_of, found);
    const mpq_class difference = check_volumes(parts, sums, divided, found);
    return {static_cast<std::size_t>(std::count(divided.begin(), divided.end(), true)), difference};
}

} // namespace terrane::verifier
