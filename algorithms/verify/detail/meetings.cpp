// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/meetings.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/distance.hpp>

namespace terrane::verifier {

namespace {

Vector4 plane_of(const ExactParts& parts, std::uint32_t input) {
    const auto& [a, b, c] = parts.inputs.triangles[input];
    return orthogonal(parts.input_points[a], parts.input_points[b], parts.input_points[c]);
}

bool is_zero(const Vector3& v) {
    return std::all_of(v.begin(), v.end(), [](const mpz_class& x) { return sgn(x) == 0; });
}

/// The directions along which all planes and edges that were added continue.
class CommonDirections {
public:
    void add_plane(const Vector4& plane) {
        const Vector3 normal{plane[0], plane[1], plane[2]};
        if (dimension_ == 3) {
            dimension_ = 2;
            vector_ = normal;
        } else if (dimension_ == 2) {
            if (Vector3 line = cross(vector_, normal); !is_zero(line)) set_line(std::move(line));
        } else if (dimension_ == 1 && sgn(dot(vector_, normal)) != 0) {
            dimension_ = 0;
        }
    }
    /// Precondition: the plane of the edge's triangle was added.
    void add_edge(Vector3 along) {
        if (dimension_ == 2)
            set_line(std::move(along));
        else if (dimension_ == 1 && !is_zero(cross(vector_, along)))
            dimension_ = 0;
    }
    [[nodiscard]] bool none() const { return dimension_ == 0; }

private:
    void set_line(Vector3 along) {
        dimension_ = 1;
        vector_ = std::move(along);
    }

    int dimension_ = 3;
    Vector3 vector_; ///< dimension 2: the normal; 1: the direction
};

/// Tells whether a vertex is forced by the input triangles that contain it.
bool is_meeting(const ExactParts& parts, const Vector4& point,
                std::span<const std::uint32_t> parents) {
    CommonDirections common;
    for (const std::uint32_t parent : parents) {
        const Triangle& corners = parts.inputs.triangles[parent];
        const auto at = [&](std::size_t i) -> const Vector4& {
            return parts.input_points[corners[i % 3]];
        };
        if (point == at(0) || point == at(1) || point == at(2)) return true;
        const Vector4 plane = plane_of(parts, parent);
        common.add_plane(plane);
        const std::size_t axis = projection_axis(plane).value();
        for (std::size_t i = 0; i < 3; ++i)
            if (sgn(turn(at(i), at(i + 1), point, axis)) == 0)
                common.add_edge(difference(at(i + 1), at(i)));
    }
    return common.none();
}

/// Returns all pairs {vertex, parent of a triangle at it}, sorted and unique. Of input triangles
/// with the same points, the first one stands for all; those without area are left out (R6).
std::vector<Edge> parents_at_vertices(const ExactParts& parts) {
    std::vector<Edge> pairs;
    for (std::size_t t = 0; t < parts.claim.triangles.size(); ++t)
        for (const std::uint32_t parent : parts.claim.parents_of[t]) {
            if (std::ranges::binary_search(parts.set_aside.degenerate, parent)) continue;
            for (const std::uint32_t corner : parts.claim.triangles[t])
                pairs.push_back({corner, parts.set_aside.first_of[parent]});
        }
    make_set(pairs);
    return pairs;
}

} // namespace

void check_orientation(const ExactParts& parts, Violations& found) {
    for (std::uint32_t t = 0; t < parts.claim.triangles.size(); ++t) {
        const std::uint32_t parent = parts.claim.parents_of[t].front();
        const Vector4 plane = plane_of(parts, parent);
        const auto axis = projection_axis(plane);
        if (!axis || sgn(parts.mesh.planes[t][*axis]) * sgn(plane[*axis]) >= 0) continue;
        found.push_back({Rule::R19_orientation,
                         {t, parent},
                         "triangle " + text(t) + " is turned over: its first parent, input " +
                             "triangle " + text(parent) + ", faces the other side"});
    }
}

void check_meetings(const ExactParts& parts, Violations& found) {
    const auto pairs = parents_at_vertices(parts);
    Numbers parents;
    for (std::size_t i = 0; i < pairs.size();) {
        const std::uint32_t vertex = pairs[i][0];
        parents.clear();
        for (; i < pairs.size() && pairs[i][0] == vertex; ++i) parents.push_back(pairs[i][1]);
        if (is_meeting(parts, parts.mesh.points[vertex], parents)) continue;
        found.push_back({Rule::R20_meetings,
                         {vertex},
                         "vertex " + text(vertex) + " is no corner of an input triangle, and no " +
                             "intersection segments end or cross there"});
    }
}

} // namespace terrane::verifier
