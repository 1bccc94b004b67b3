// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/without_outside.hpp>
#include <terrane/kernel/predicates.hpp>

using namespace terrane;
using namespace test_support;

namespace {

TetrahedralMesh filled(const std::vector<Surface>& surfaces,
                       const TetrahedraOptions& options = {}) {
    auto made = tetrahedralize(mesh_of(surfaces), options, {});
    INFO((made ? std::string() : made.error().message()));
    REQUIRE(made);
    return std::move(made).value();
}

TetrahedralMesh split(const TetrahedralMesh& mesh, const std::vector<std::uint32_t>& surfaces) {
    auto result = split_nodes(mesh, surfaces);
    REQUIRE(result);
    return std::move(result).value();
}

using Key = std::set<std::uint32_t>;

Key face_without(const std::array<std::uint32_t, 4>& corners, unsigned apex) {
    Key key;
    for (unsigned k = 0; k < 4; ++k)
        if (k != apex) key.insert(corners[k]);
    return key;
}

/// Applies the definition literally: which tetrahedra at a vertex are connected.
class Oracle {
public:
    Oracle(const TetrahedralMesh& mesh, const std::vector<std::uint32_t>& surfaces) : mesh_(mesh) {
        for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
            for (unsigned apex = 0; apex < 4; ++apex)
                at_face_[face_without(mesh.tetrahedra[t], apex)].push_back(t);
        for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
            const Key key(mesh.faces[f].begin(), mesh.faces[f].end());
            for (const std::uint32_t s : mesh.surfaces_of[f])
                if (std::count(surfaces.begin(), surfaces.end(), s) > 0 &&
                    at_face_.at(key).size() == 2)
                    split_.insert(key);
        }
        for (const Key& key : split_) vertices_.insert(key.begin(), key.end());
        for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
            for (const std::uint32_t v : mesh.tetrahedra[t])
                if (vertices_.contains(v)) around_[v].push_back(t);
    }

    /// Returns the sectors of each split vertex.
    [[nodiscard]] std::map<std::uint32_t, std::vector<Key>> sectors() const {
        std::map<std::uint32_t, std::vector<Key>> all;
        for (const auto& [vertex, tetrahedra] : around_) {
            Key left(tetrahedra.begin(), tetrahedra.end());
            while (!left.empty()) {
                Key sector{*left.begin()};
                std::vector<std::uint32_t> open{*left.begin()};
                while (!open.empty()) {
                    const std::uint32_t t = open.back();
                    open.pop_back();
                    for (const std::uint32_t next : neighbours(t, vertex))
                        if (sector.insert(next).second) open.push_back(next);
                }
                for (const std::uint32_t t : sector) left.erase(t);
                all[vertex].push_back(sector);
            }
        }
        return all;
    }

    [[nodiscard]] const std::set<Key>& split_faces() const { return split_; }

private:
    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t t,
                                                        std::uint32_t vertex) const {
        std::vector<std::uint32_t> found;
        for (unsigned apex = 0; apex < 4; ++apex) {
            const Key key = face_without(mesh_.tetrahedra[t], apex);
            if (!key.contains(vertex) || split_.contains(key)) continue;
            for (const std::uint32_t other : at_face_.at(key))
                if (other != t) found.push_back(other);
        }
        return found;
    }

    const TetrahedralMesh& mesh_;
    std::map<Key, std::vector<std::uint32_t>> at_face_;
    std::set<Key> split_;
    std::set<std::uint32_t> vertices_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> around_;
};

void check_places(const TetrahedralMesh& before, const TetrahedralMesh& after) {
    REQUIRE(after.tetrahedra.size() == before.tetrahedra.size());
    CHECK(after.block_of == before.block_of);
    CHECK(after.block_count == before.block_count);
    CHECK(std::equal(before.vertices.begin(), before.vertices.end(), after.vertices.begin()));
    bool same = true;
    for (std::size_t t = 0; t < after.tetrahedra.size(); ++t)
        for (unsigned k = 0; k < 4; ++k)
            same = same && after.vertices[after.tetrahedra[t][k]] ==
                               before.vertices[before.tetrahedra[t][k]];
    CHECK(same); // so that volumes are equal, too
}

/// Checks that tetrahedra share a node iff they are in the same sector, that copies are numbered by
/// vertex, then by lowest tetrahedron, and that vertices off the cut stay.
void check_nodes(const TetrahedralMesh& before, const TetrahedralMesh& after,
                 const Oracle& oracle) {
    auto next = static_cast<std::uint32_t>(before.vertices.size());
    std::vector<std::array<std::uint32_t, 4>> wanted = before.tetrahedra;
    for (const auto& [vertex, sectors] : oracle.sectors())
        for (std::size_t i = 0; i < sectors.size(); ++i) {
            const std::uint32_t node = i == 0 ? vertex : next++;
            for (const std::uint32_t t : sectors[i])
                for (unsigned k = 0; k < 4; ++k)
                    if (before.tetrahedra[t][k] == vertex) wanted[t][k] = node;
        }
    CHECK(after.vertices.size() == next);
    CHECK(after.tetrahedra == wanted);
}

/// Checks that each face belongs to a tetrahedron, and that twins lie in front and behind with
/// equal corners.
void check_faces(const TetrahedralMesh& before, const TetrahedralMesh& after,
                 const Oracle& oracle) {
    std::map<Key, std::vector<std::uint32_t>> apexes;
    for (const auto& corners : after.tetrahedra)
        for (unsigned apex = 0; apex < 4; ++apex)
            apexes[face_without(corners, apex)].push_back(corners[apex]);
    REQUIRE(after.faces.size() == before.faces.size() + after.twins.size());
    REQUIRE(after.face_triangle.size() == after.faces.size());
    REQUIRE(after.surfaces_of.size() == after.faces.size());
    std::set<std::uint32_t> in_pairs;
    const auto apex_of = [&](std::uint32_t face) {
        const auto& v = after.faces[face];
        const auto& found = apexes.at(Key(v.begin(), v.end()));
        REQUIRE(found.size() == 1);
        return orient3d(after.vertices[v[0]], after.vertices[v[1]], after.vertices[v[2]],
                        after.vertices[found[0]]);
    };
    for (std::size_t i = 0; i < after.twins.size(); ++i) {
        const auto [front, back] = after.twins[i];
        CHECK(back == before.faces.size() + i);
        CHECK(apex_of(front) == Sign::Positive);
        CHECK(apex_of(back) == Sign::Negative);
        CHECK(after.face_triangle[front] == after.face_triangle[back]);
        CHECK(std::ranges::equal(after.surfaces_of[front], after.surfaces_of[back]));
        for (unsigned k = 0; k < 3; ++k)
            CHECK(after.vertices[after.faces[front][k]] == after.vertices[after.faces[back][k]]);
        in_pairs.insert(front);
    }
    std::size_t cut = 0;
    for (std::uint32_t f = 0; f < before.faces.size(); ++f) {
        const Key key(after.faces[f].begin(), after.faces[f].end());
        CHECK(apexes.contains(key));
        const Key old(before.faces[f].begin(), before.faces[f].end());
        if (!oracle.split_faces().contains(old)) {
            CHECK_FALSE(in_pairs.contains(f));
            continue;
        }
        ++cut;
        CHECK(in_pairs.contains(f) == (apexes.at(key).size() == 1));
    }
    CHECK(cut == oracle.split_faces().size());
}

/// Splits the nodes, compares the result with the oracle, and returns it.
TetrahedralMesh check_split(const TetrahedralMesh& before,
                            const std::vector<std::uint32_t>& surfaces) {
    auto after = split(before, surfaces);
    const Oracle oracle(before, surfaces);
    check_places(before, after);
    check_nodes(before, after, oracle);
    check_faces(before, after, oracle);
    return after;
}

/// Counts the nodes at a point.
std::ptrdiff_t nodes_at(const TetrahedralMesh& mesh, const Point3& place) {
    return std::count(mesh.vertices.begin(), mesh.vertices.end(), place);
}

} // namespace

TEST_CASE("split nodes: a fault that ends inside is cut but for its border", "[split_nodes]") {
    const auto before = filled({cube(0, 8), quad({4, 2, 2}, {4, 6, 2}, {4, 6, 6}, {4, 2, 6}, "F1")},
                               {.edge_length = 2});
    const auto after = check_split(before, {1});
    CHECK(after.vertices.size() > before.vertices.size());
    for (const Point3& tip : {Point3{4, 2, 2}, Point3{4, 6, 6}}) CHECK(nodes_at(after, tip) == 1);
    std::set<std::uint32_t> on_fault;
    for (std::size_t f = 0; f < before.faces.size(); ++f)
        if (before.surfaces_of[f][0] == 1)
            on_fault.insert(before.faces[f].begin(), before.faces[f].end());
    for (const std::uint32_t v : on_fault) {
        const auto& [x, y, z] = before.vertices[v];
        const bool border = y == 2 || y == 6 || z == 2 || z == 6;
        CHECK(nodes_at(after, before.vertices[v]) == (border ? 1 : 2));
    }
    const auto pairs = node_pairs(after);
    CHECK(pairs[0].empty());
    CHECK(pairs[1].size() == after.vertices.size() - before.vertices.size());
}

TEST_CASE("split nodes: where faults cross, each sector has its node", "[split_nodes]") {
    const std::vector<Surface> crossing{
        cube(0, 8), quad({4, 0, 0}, {4, 8, 0}, {4, 8, 8}, {4, 0, 8}, "F1"),
        quad({0, 4, 0}, {8, 4, 0}, {8, 4, 8}, {0, 4, 8}, "F2"), level(3, 0, 0, 8, 8, "base")};
    const auto before = filled(crossing);
    CHECK(nodes_at(check_split(before, {1, 2}), {4, 4, 3}) == 4);
    CHECK(nodes_at(check_split(before, {1, 2, 3}), {4, 4, 3}) == 8);
    CHECK(nodes_at(check_split(before, {1}), {4, 4, 3}) == 2);
    // On the border of the box the cuts end, unless there is nothing beyond it.
    CHECK(nodes_at(check_split(before, {1, 2}), {4, 4, 0}) == 1);
    const auto inner = without_outside(before);
    CHECK(nodes_at(check_split(inner, {1, 2}), {4, 4, 0}) == 4);
    // A branch that ends on the other fault makes three sectors.
    const std::vector<Surface> branching{
        cube(0, 8), quad({4, 0, 0}, {4, 8, 0}, {4, 8, 8}, {4, 0, 8}, "F1"),
        quad({4, 4, 0}, {8, 4, 0}, {8, 4, 8}, {4, 4, 8}, "F2"), level(3, 0, 0, 8, 8, "base")};
    CHECK(nodes_at(check_split(filled(branching), {1, 2}), {4, 4, 3}) == 3);
}

TEST_CASE("split nodes: of all surfaces, each block stands alone", "[split_nodes]") {
    const auto before = filled({cube(0, 4), cube(1, 2), level(3, -1, -1, 5, 5)});
    const auto after = check_split(before, {0, 1, 2});
    std::map<std::uint32_t, std::uint32_t> block_of;
    for (std::size_t t = 0; t < after.tetrahedra.size(); ++t)
        for (const std::uint32_t v : after.tetrahedra[t])
            CHECK(block_of.try_emplace(v, after.block_of[t]).first->second == after.block_of[t]);
}

TEST_CASE("split nodes: random models hold for the oracle", "[split_nodes]") {
    Random random(31);
    int split_up = 0, with_copies = 0, unclean = 0, refused = 0;
    for (int i = 0; i < cases(40); ++i) {
        std::vector<Surface> model{cube(-9, 9)};
        const auto number = [&] { return double(random_int(random, -8, 8)); };
        for (int k = random_int(random, 1, 4); k > 0; --k) {
            Surface s{"triangle", Role::fault, {}, {{0, 1, 2}, {0, 2, 3}}};
            for (int v = 0; v < 4; ++v) s.vertices.push_back(point_of(number));
            model.push_back(s);
        }
        const auto rounded = round_to_doubles(arrange(model).value());
        if (!rounded.value().report.clean) {
            ++unclean;
            continue;
        }
        const auto made = tetrahedralize(rounded.value().mesh, {}, {});
        if (!made) { // TetGen may find surfaces too close
            CHECK(made.error().code == ErrorCode::unsupported);
            ++refused;
            continue;
        }
        std::vector<std::uint32_t> surfaces;
        for (std::uint32_t s = 0; s < model.size(); ++s)
            if (random_int(random, 0, 2) > 0) surfaces.push_back(s);
        const auto after = check_split(made.value(), surfaces);
        with_copies += after.vertices.size() > made.value().vertices.size() ? 1 : 0;
        ++split_up;
    }
    CHECK(unclean == 0);
    CHECK(refused == 0);
    CHECK(split_up == cases(40));
    CHECK(with_copies >=
          split_up / 2); // the others: no surface is split, or all its nodes are shared
}

TEST_CASE("split nodes: without the outside, the blocks are left as they were", "[split_nodes]") {
    const auto before =
        filled({cube(0, 4), cube(1, 2), level(3, -1, -1, 5, 5), level(9, 0, 0, 2, 2, "apart")});
    const auto inner = without_outside(before);
    CHECK(inner.surfaces.size() == 4);
    std::vector<std::array<Point3, 4>> wanted, found;
    std::set<Point3> used;
    for (std::size_t t = 0; t < before.tetrahedra.size(); ++t) {
        if (before.block_of[t] == 0) continue;
        auto& corners = wanted.emplace_back();
        for (unsigned k = 0; k < 4; ++k) {
            corners[k] = before.vertices[before.tetrahedra[t][k]];
            used.insert(corners[k]);
        }
    }
    for (const auto& tetrahedron : inner.tetrahedra)
        for (unsigned k = 0; auto& corner : found.emplace_back())
            corner = inner.vertices[tetrahedron[k++]];
    CHECK(found == wanted);
    CHECK(inner.vertices.size() == used.size());
    CHECK(std::count(inner.block_of.begin(), inner.block_of.end(), 0U) == 0);
    CHECK(inner.block_count == before.block_count);
    // Each face belongs to a tetrahedron, and the border of the blocks consists of faces.
    std::map<Key, int> times;
    for (const auto& corners : inner.tetrahedra)
        for (unsigned apex = 0; apex < 4; ++apex) ++times[face_without(corners, apex)];
    std::set<Key> faces;
    for (std::size_t f = 0; f < inner.faces.size(); ++f) {
        faces.insert(Key(inner.faces[f].begin(), inner.faces[f].end()));
        CHECK(inner.surfaces_of[f][0] < 3);
    }
    for (const Key& face : faces) CHECK(times.contains(face));
    for (const auto& [key, count] : times) CHECK((count == 2 || faces.contains(key)));
}

TEST_CASE("split nodes: nothing to split, nothing changes; nonsense is refused", "[split_nodes]") {
    const auto before = filled({cube(0, 4), level(2, 1, 1, 3, 3)});
    const auto same = split(before, {});
    CHECK(same.tetrahedra == before.tetrahedra);
    CHECK(same.faces == before.faces);
    CHECK(same.twins.empty());
    CHECK(split(before, {2}).twins.empty()); // the box: no tetrahedra beyond it
    const auto missing = split_nodes(before, std::vector<std::uint32_t>{3});
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == ErrorCode::bad_index);
    const auto cut = split(before, {0});
    REQUIRE_FALSE(cut.twins.empty());
    const auto again = split_nodes(cut, std::vector<std::uint32_t>{0});
    REQUIRE_FALSE(again);
    CHECK(again.error().code == ErrorCode::bad_option);
}
