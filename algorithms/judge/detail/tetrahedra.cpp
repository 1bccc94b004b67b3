// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/detail/tetrahedra.hpp>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <tuple>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::judging {
namespace {

/// The faces of a tetrahedron of positive volume: it is in front of each, from where corners are counterclockwise.
constexpr std::array<std::array<unsigned, 3>, 4> faces_inward{
    {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}};

/// A tetrahedron at a face.
struct FaceSide {
    Triangle corners; ///< ascending
    bool behind;      ///< it is behind these
    std::uint32_t tetrahedron;
};

FaceSide face_side(Triangle corners, bool inward, std::uint32_t tetrahedron) {
    auto& [a, b, c] = corners;
    const auto order = [&inward](std::uint32_t& low, std::uint32_t& high) {
        if (low < high) return;
        std::swap(low, high);
        inward = !inward;
    };
    order(a, b);
    order(b, c);
    order(a, b);
    return {corners, !inward, tetrahedron};
}

/// Finds the cells that nodes lie on, and the faces on them.
class SurfaceFaceChooser {
public:
    SurfaceFaceChooser(const TetrahedronFaces& tetrahedra, const Target& target, const Cells& cells,
                       double reach) :
        tetrahedra_(tetrahedra),
        target_(target), cells_(cells) {
        for (std::uint32_t x = 0; x < target.exact.vertices.size(); ++x)
            places_.push_back(target.exact.nearest(VertexId(x)));
        find_cells_at(reach);
    }

    SurfaceFaces operator()() {
        SurfaceFaces chosen;
        for (std::uint32_t t = 0; t < tetrahedra_.made.tetrahedra.size(); ++t)
            chosen.flat.push_back(!common(tetrahedra_.nodes(t)).empty());
        for (std::uint32_t f = 0; f < tetrahedra_.faces.size(); ++f)
            if (is_chosen(tetrahedra_.faces[f])) chosen.faces.push_back(f);
        return chosen;
    }

private:
    void find_cells_at(double reach) {
        const TriangleTree tree(places_, target_.triangles);
        const auto& made = tetrahedra_.made;
        std::vector<bool> used(made.vertices.size());
        for (const auto& corners : made.tetrahedra)
            for (const std::uint32_t v : corners) used[tetrahedra_.node_at[v]] = true;
        std::vector<std::uint32_t> here;
        for (std::uint32_t v = 0; v < used.size(); ++v) {
            here.clear();
            if (used[v])
                for (const auto& near : tree.within(made.vertices[v], reach))
                    add_cells(near.triangle, here);
            sort_unique(here);
            cells_at_.push_back(here);
        }
    }
    /// Adds the cells that have all corners of a triangle.
    void add_cells(const Triangle& t, std::vector<std::uint32_t>& here) const {
        const auto& at = cells_.at_vertex;
        for (const std::uint32_t c : at[t[0]])
            if (std::ranges::binary_search(at[t[1]], c) && std::ranges::binary_search(at[t[2]], c))
                here.push_back(c);
    }

    /// Returns the cells that all nodes lie on.
    template <std::size_t count>
    [[nodiscard]] std::vector<std::uint32_t>
    common(const std::array<std::uint32_t, count>& nodes) const {
        const auto first = cells_at_[nodes[0]];
        std::vector<std::uint32_t> all(first.begin(), first.end());
        for (unsigned i = 1; i < count && !all.empty(); ++i)
            std::erase_if(all, [&](std::uint32_t c) { return !is_on(nodes[i], c); });
        return all;
    }
    [[nodiscard]] bool is_on(std::uint32_t node, std::uint32_t cell) const {
        return std::ranges::binary_search(cells_at_[node], cell);
    }

    [[nodiscard]] bool is_chosen(const TetrahedronFace& face) const {
        const auto on = common(face.corners);
        if (on.empty()) return face.is_border();
        const auto& points = tetrahedra_.made.vertices;
        const Point3& a = points[face.corners[0]];
        const Point3 normal =
            cross(minus(points[face.corners[1]], a), minus(points[face.corners[2]], a));
        return std::ranges::any_of(on, [&](std::uint32_t c) {
            const std::uint32_t front = face.sides[dot(normal, cells_.cells[c].normal) > 0 ? 0 : 1];
            return front == no_index ||
                   !std::ranges::all_of(tetrahedra_.nodes(front),
                                        [&](std::uint32_t v) { return is_on(v, c); });
        });
    }

    const TetrahedronFaces& tetrahedra_;
    const Target& target_;
    const Cells& cells_;
    std::vector<Point3> places_;         ///< of exact vertices
    IndexLists<std::uint32_t> cells_at_; ///< per vertex; ascending
};

} // namespace

std::vector<std::uint32_t> TetrahedronFace::tetrahedra() const {
    std::vector<std::uint32_t> all(sides.begin(), sides.end());
    std::erase(all, no_index);
    return all;
}

TetrahedronFaces::TetrahedronFaces(const LabelledTetrahedra& tetrahedra, std::size_t most_flaws) :
    made(tetrahedra), positive("positive", most_flaws), conforming("conforming", most_flaws) {
    join_nodes();
    std::vector<int> signs;
    std::ptrdiff_t sum = 0;
    for (const auto& [a, b, c, d] : made.tetrahedra) {
        const auto& p = made.vertices;
        signs.push_back(static_cast<int>(orient3d(p[a], p[b], p[c], p[d])));
        sum += signs.back();
    }
    if (sum < 0) winding = -1;
    for (std::uint32_t t = 0; t < signs.size(); ++t)
        if (signs[t] != winding)
            positive.add({signs[t] == 0 ? "a tetrahedron has no volume"
                                        : "a tetrahedron is wound the other way",
                          middle(t),
                          {t}});
    find_faces(signs);
}

void TetrahedronFaces::join_nodes() {
    node_at.resize(made.vertices.size());
    std::vector<std::uint32_t> order(node_at.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto place = [this](std::uint32_t v) {
        const Point3& p = made.vertices[v];
        return std::tuple(p.x, p.y, p.z, v);
    };
    std::ranges::sort(order, {}, place);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool again = i > 0 && made.vertices[order[i]] == made.vertices[order[i - 1]];
        node_at[order[i]] = again ? node_at[order[i - 1]] : order[i];
    }
}

void TetrahedronFaces::find_faces(const std::vector<int>& signs) {
    std::vector<FaceSide> sides;
    for (std::uint32_t t = 0; t < signs.size(); ++t) {
        const auto corners = nodes(t);
        if (signs[t] == 0) continue;
        for (const auto& [i, j, k] : faces_inward)
            sides.push_back(face_side({corners[i], corners[j], corners[k]}, signs[t] > 0, t));
    }
    const auto key = [](const FaceSide& s) {
        return std::tuple(s.corners, s.behind, s.tetrahedron);
    };
    std::ranges::sort(sides, {}, key);
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        TetrahedronFace face{sides[i].corners, {no_index, no_index}};
        for (end = i; end < sides.size() && sides[end].corners == face.corners; ++end) {
            auto& side = face.sides[sides[end].behind ? 1 : 0];
            if (side == no_index)
                side = sides[end].tetrahedron;
            else
                conforming.add({"a face has several tetrahedra on one side",
                                middle(face),
                                {side, sides[end].tetrahedron}});
        }
        faces.push_back(face);
    }
}

std::array<std::uint32_t, 4> TetrahedronFaces::nodes(std::uint32_t tetrahedron) const {
    auto corners = made.tetrahedra[tetrahedron];
    for (std::uint32_t& v : corners) v = node_at[v];
    return corners;
}

bool TetrahedronFaces::is_torn(const TetrahedronFace& face) const {
    if (face.is_border()) return false;
    const auto &s = made.tetrahedra[face.sides[0]], &t = made.tetrahedra[face.sides[1]];
    return std::ranges::any_of(face.corners, [&](std::uint32_t node) {
        const auto at_node = [&](std::uint32_t v) { return node_at[v] == node; };
        return *std::ranges::find_if(s, at_node) != *std::ranges::find_if(t, at_node);
    });
}

Point3 TetrahedronFaces::middle(std::uint32_t tetrahedron) const {
    Point3 sum{};
    for (const std::uint32_t v : made.tetrahedra[tetrahedron]) {
        const Point3& p = made.vertices[v];
        sum = {sum.x + p.x / 4, sum.y + p.y / 4, sum.z + p.z / 4};
    }
    return sum;
}

Point3 TetrahedronFaces::middle(const TetrahedronFace& face) const {
    Point3 sum{};
    for (const std::uint32_t v : face.corners) {
        const Point3& p = made.vertices[v];
        sum = {sum.x + p.x / 3, sum.y + p.y / 3, sum.z + p.z / 3};
    }
    return sum;
}

SurfaceFaces choose_surface_faces(const TetrahedronFaces& tetrahedra, const Target& target,
                                  const Cells& cells, double reach) {
    return SurfaceFaceChooser(tetrahedra, target, cells, reach)();
}

} // namespace terrane::judging
