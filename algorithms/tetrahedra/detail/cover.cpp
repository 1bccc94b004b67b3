// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/detail/cover.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/tetrahedra/allowance.hpp>
#include <terrane/algorithms/tetrahedra/detail/outline.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::tetrahedra::detail {
namespace {

using Defect = TetrahedraDefect;
using Nodes = std::vector<std::uint32_t>;
using Step = std::array<std::uint32_t, 2>; ///< a side of a face, as it is wound

/// The outline of the faces of a triangle.
struct Outline {
    Nodes corners;                  ///< all nodes, from the first corner of the triangle
    std::array<Nodes, 3> inside_of; ///< per edge of the triangle: its nodes but for the ends
};

/// Returns the steps that the faces take in one direction only, sorted; nothing if two faces take
/// the same step.
std::optional<std::vector<Step>> border_of(std::span<const Triangle> faces) {
    std::vector<Step> steps, border;
    for (const Triangle& face : faces)
        for (std::size_t i = 0; i < 3; ++i) steps.push_back({face[i], face[(i + 1) % 3]});
    std::sort(steps.begin(), steps.end());
    if (std::adjacent_find(steps.begin(), steps.end()) != steps.end()) return std::nullopt;
    for (const Step& step : steps)
        if (!std::binary_search(steps.begin(), steps.end(), Step{step[1], step[0]}))
            border.push_back(step);
    return border;
}

/// Follows the border from corner to corner; nothing if it is not one closed polygon that has them
/// in their order.
std::optional<Outline> outline_of(std::span<const Triangle> faces, const Triangle& corners) {
    const auto border = border_of(faces);
    if (!border) return std::nullopt;
    Outline outline;
    std::uint32_t at = corners[0];
    for (std::size_t side = 0; side < 3;) {
        const auto step = std::lower_bound(border->begin(), border->end(), Step{at, 0});
        if (step == border->end() || (*step)[0] != at) return std::nullopt;
        if (step + 1 != border->end() && (*(step + 1))[0] == at) return std::nullopt;
        outline.corners.push_back(at);
        if (outline.corners.size() > border->size()) return std::nullopt;
        at = (*step)[1];
        if (at == corners[(side + 1) % 3])
            ++side;
        else
            outline.inside_of[side].push_back(at);
    }
    if (outline.corners.size() != border->size()) return std::nullopt;
    return outline;
}

/// The nodes on the edges of triangles that are divided.
class Edges {
public:
    explicit Edges(Findings& findings) : findings_(findings) {}

    /// Takes in how a divided triangle divides an edge, from its start to its end.
    void divide(std::uint32_t triangle, const Step& edge, Nodes inside) {
        if (edge[0] > edge[1]) std::reverse(inside.begin(), inside.end());
        const auto [at, added] = inside_of_.try_emplace(key_of(edge), std::move(inside));
        if (!added && at->second != inside) torn(triangle, edge);
    }
    /// Takes in that a triangle that is not divided has an edge.
    void leave(std::uint32_t triangle, const Step& edge) {
        const auto at = inside_of_.find(key_of(edge));
        if (at != inside_of_.end() && !at->second.empty()) torn(triangle, edge);
    }
    [[nodiscard]] bool empty() const { return inside_of_.empty(); }

private:
    static Edge key_of(const Step& edge) {
        return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
    }
    void torn(std::uint32_t triangle, const Step& edge) {
        findings_.add(Defect::torn_edge,
                      "triangle {} has other nodes between nodes {} and {} than another triangle "
                      "at that edge",
                      triangle, edge[0], edge[1]);
    }

    Findings& findings_;
    std::map<Edge, Nodes> inside_of_;
};

class Cover {
public:
    Cover(const Subject& subject, const Places& places, const IndexLists<std::uint32_t>& faces_of) :
        subject_(subject), places_(places), faces_of_(faces_of), edges_(subject.findings),
        divided_(subject.mesh.triangles.size()) {}

    std::vector<bool> operator()() {
        const auto count = static_cast<std::uint32_t>(divided_.size());
        for (std::uint32_t t = 0; t < count; ++t) check(t);
        for (std::uint32_t t = 0; t < count && !edges_.empty(); ++t) {
            if (divided_[t] || !subject_.needs_faces(t)) continue;
            for (std::size_t i = 0; i < 3; ++i) edges_.leave(t, edge(corners_of(t), i));
        }
        return std::move(divided_);
    }

private:
    static Step edge(const Triangle& corners, std::size_t i) {
        return {corners[i], corners[(i + 1) % 3]};
    }
    /// The places of the corners of a triangle.
    [[nodiscard]] Triangle corners_of(std::uint32_t triangle) const {
        Triangle corners = subject_.mesh.triangles[triangle];
        for (std::uint32_t& v : corners) v = places_.of_vertex[v];
        return corners;
    }
    [[nodiscard]] std::array<Point3, 3> points_of(std::uint32_t triangle) const {
        const auto& [a, b, c] = subject_.mesh.triangles[triangle];
        const auto& v = subject_.mesh.vertices;
        return {v[a], v[b], v[c]};
    }

    void check(std::uint32_t triangle) {
        std::vector<Triangle> faces;
        for (const std::uint32_t f : faces_of_[triangle])
            faces.push_back(places_.of(subject_.made.faces[f]));
        if (faces.empty()) {
            if (subject_.needs_faces(triangle))
                subject_.findings.add(Defect::uncovered_triangle, "triangle {}, at {}, has no face",
                                      triangle, place_text(points_of(triangle)[0]));
            return;
        }
        const Triangle corners = corners_of(triangle);
        if (std::count(corners.begin(), corners.end(), none) > 0) return; // was reported
        if (faces.size() == 1 && is_turned(faces[0], corners)) return;
        divided_[triangle] = true;
        const auto outline = outline_of(faces, corners);
        if (!outline) {
            subject_.findings.add(Defect::broken_outline,
                                  "the outline of the faces of triangle {}, at {}, does not follow "
                                  "its sides",
                                  triangle, place_text(points_of(triangle)[0]));
            return;
        }
        check_nodes(triangle, faces, *outline);
        check_projection(triangle, faces, *outline);
        for (std::size_t i = 0; i < 3; ++i)
            edges_.divide(triangle, edge(corners, i), outline->inside_of[i]);
    }

    /// Whether two triangles have the same corners in the same cyclic order.
    static bool is_turned(Triangle a, Triangle b) {
        const auto turn = [](Triangle& t) {
            std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        };
        turn(a);
        turn(b);
        return a == b;
    }

    /// (b)
    void check_nodes(std::uint32_t triangle, std::span<const Triangle> faces,
                     const Outline& outline) {
        const auto corners = points_of(triangle);
        const auto& v = subject_.made.vertices;
        for (std::size_t i = 0; i < 3; ++i)
            for (const std::uint32_t node : outline.inside_of[i])
                if (!near_edge(v[node], corners[i], corners[(i + 1) % 3]))
                    subject_.findings.add(Defect::node_off_edge,
                                          "node {}, at {}, is too far from the edge of triangle {} "
                                          "that it is on",
                                          node, place_text(v[node]), triangle);
        Nodes nodes, on_outline = outline.corners;
        for (const Triangle& face : faces) nodes.insert(nodes.end(), face.begin(), face.end());
        sort_unique(nodes);
        std::sort(on_outline.begin(), on_outline.end());
        for (const std::uint32_t node : nodes) {
            if (std::binary_search(on_outline.begin(), on_outline.end(), node)) continue;
            if (!near_plane(v[node], corners))
                subject_.findings.add(Defect::node_off_plane,
                                      "node {}, at {}, is too far from the plane of triangle {}, "
                                      "which it is on",
                                      node, place_text(v[node]), triangle);
        }
    }

    /// (c)
    void check_projection(std::uint32_t triangle, std::span<const Triangle> faces,
                          const Outline& outline) {
        const auto& [a, b, c] = points_of(triangle);
        const auto& v = subject_.made.vertices;
        const Axis axis = projection_axis(a, b, c);
        const Sign winding = orient2d(axis, a, b, c);
        for (const auto& [i, j, k] : faces)
            if (orient2d(axis, v[i], v[j], v[k]) != winding)
                subject_.findings.add(Defect::folded_faces,
                                      "a face of triangle {}, at {}, is folded over or flat in the "
                                      "projection",
                                      triangle, place_text(v[i]));
        if (const auto node = crossing_of(outline.corners, v, axis))
            subject_.findings.add(Defect::folded_faces,
                                  "the outline of the faces of triangle {} meets itself near {}",
                                  triangle, place_text(v[*node]));
    }

    const Subject& subject_;
    const Places& places_;
    const IndexLists<std::uint32_t>& faces_of_;
    Edges edges_;
    std::vector<bool> divided_;
};

} // namespace

std::vector<bool> check_cover(const Subject& subject, const Places& places,
                              const IndexLists<std::uint32_t>& faces_of) {
    return Cover(subject, places, faces_of)();
}

} // namespace terrane::tetrahedra::detail
