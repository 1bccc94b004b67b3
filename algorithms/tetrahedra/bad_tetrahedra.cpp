// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/bad_tetrahedra.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {
namespace {

/// The ends of each edge in the order of dihedral_angles(), then the other two corners.
constexpr std::array<std::array<unsigned, 4>, 6> edges_of_tetrahedron{
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

Triangle sorted_face(Triangle face) {
    std::sort(face.begin(), face.end());
    return face;
}

/// Returns the angle at a, in degrees.
double angle_at(const Point3& a, const Point3& b, const Point3& c) {
    const Point3 u = minus(b, a), v = minus(c, a);
    return std::atan2(length(cross(u, v)), dot(u, v)) * 180 / std::numbers::pi;
}

double least_angle_of(const std::array<Point3, 3>& p) {
    return std::min(
        {angle_at(p[0], p[1], p[2]), angle_at(p[1], p[2], p[0]), angle_at(p[2], p[0], p[1])});
}

/// The edges of faces that are on curves.
class CurveEdges {
public:
    explicit CurveEdges(const TetrahedralMesh& mesh) {
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
            for (std::size_t k = 0; k < 3; ++k)
                sides_.push_back({of(mesh.faces[f][k], mesh.faces[f][(k + 1) % 3]), f});
        std::sort(sides_.begin(), sides_.end());
        for (std::size_t i = 0; i < sides_.size();) {
            std::size_t end = i + 1;
            while (end < sides_.size() && sides_[end].first == sides_[i].first) ++end;
            if (end - i != 2 || are_different(mesh, sides_[i].second, sides_[i + 1].second))
                curves_.push_back(sides_[i].first);
            i = end;
        }
    }

    [[nodiscard]] bool has(std::uint32_t a, std::uint32_t b) const {
        return std::binary_search(curves_.begin(), curves_.end(), of(a, b));
    }

private:
    using Ends = std::array<std::uint32_t, 2>;

    static Ends of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }
    static bool are_different(const TetrahedralMesh& mesh, std::uint32_t f, std::uint32_t g) {
        const auto one = mesh.surfaces_of[f], other = mesh.surfaces_of[g];
        return !std::equal(one.begin(), one.end(), other.begin(), other.end());
    }

    std::vector<std::pair<Ends, std::uint32_t>> sides_; ///< edge and face; sorted
    std::vector<Ends> curves_;                          ///< sorted
};

/// Marks the nodes at which two curves bound a face with a bad angle.
void mark_sharp_corners(const TetrahedralMesh& mesh, std::vector<bool>& at_input_angle) {
    const CurveEdges curves(mesh);
    for (const Triangle& face : mesh.faces)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = face[k], b = face[(k + 1) % 3], c = face[(k + 2) % 3];
            const auto& v = mesh.vertices;
            if (angle_at(v[a], v[b], v[c]) < bad_angle && curves.has(a, b) && curves.has(a, c))
                at_input_angle[a] = true;
        }
}

/// The bad tetrahedra by their index, and per node whether it is at a bad angle of the surfaces.
struct Found {
    std::vector<BadTetrahedron> bad;
    std::vector<bool> at_input_angle;
};

Found find_bad(const TetrahedralMesh& mesh) {
    const BadCauses causes(mesh);
    Found found{{}, std::vector<bool>(mesh.vertices.size(), false)};
    for (std::uint32_t number = 0; number < mesh.tetrahedra.size(); ++number) {
        const auto& t = mesh.tetrahedra[number];
        const auto corners = corners_of(mesh, number);
        const auto angles = dihedral_angles(corners);
        const double least = *std::min_element(angles.begin(), angles.end());
        if (least >= bad_angle) continue;
        found.bad.push_back({number, causes.of(t, corners, angles), least, false});
        for (std::size_t i = 0; i < angles.size(); ++i)
            if (angles[i] < bad_angle && causes.is_between_surfaces(t, i))
                for (const std::size_t end : {0U, 1U})
                    found.at_input_angle[t[edges_of_tetrahedron[i][end]]] = true;
    }
    mark_sharp_corners(mesh, found.at_input_angle);
    return found;
}

} // namespace

BadCauses::BadCauses(const TetrahedralMesh& mesh) : on_surface_(mesh.vertices.size(), false) {
    for (const Triangle& face : mesh.faces) {
        faces_.push_back(sorted_face(face));
        for (const std::uint32_t v : face) on_surface_[v] = true;
    }
    std::sort(faces_.begin(), faces_.end());
}

bool BadCauses::is_given(const std::array<std::uint32_t, 4>& t, std::size_t k) const {
    return std::binary_search(faces_.begin(), faces_.end(),
                              sorted_face({t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]}));
}

bool BadCauses::is_between_surfaces(const std::array<std::uint32_t, 4>& t, std::size_t i) const {
    return is_given(t, edges_of_tetrahedron[i][2]) && is_given(t, edges_of_tetrahedron[i][3]);
}

BadCause BadCauses::of(const std::array<std::uint32_t, 4>& t, const std::array<Point3, 4>& corners,
                       const std::array<double, 6>& angles) const {
    for (std::size_t i = 0; i < edges_of_tetrahedron.size(); ++i)
        if (angles[i] < bad_angle && is_between_surfaces(t, i)) return BadCause::input_angle;
    for (std::size_t k = 0; k < 4; ++k)
        if (is_given(t, k) && least_angle_of({corners[(k + 1) % 4], corners[(k + 2) % 4],
                                              corners[(k + 3) % 4]}) < bad_angle)
            return BadCause::thin_triangle;
    const bool between =
        std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return on_surface_[v]; });
    return between ? BadCause::gap : BadCause::other;
}

std::array<Point3, 4> corners_of(const TetrahedralMesh& mesh, std::uint32_t number) {
    std::array<Point3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.vertices[mesh.tetrahedra[number][k]];
    return corners;
}

std::vector<BadTetrahedron> bad_tetrahedra(const TetrahedralMesh& mesh) {
    const StandardArithmetic guard;
    Found found = find_bad(mesh);
    for (BadTetrahedron& b : found.bad) {
        const auto& t = mesh.tetrahedra[b.number];
        b.is_at_input_angle = std::any_of(t.begin(), t.end(),
                                          [&](std::uint32_t v) { return found.at_input_angle[v]; });
    }
    return std::move(found.bad);
}

std::vector<std::uint32_t> misshapen_tetrahedra(const TetrahedralMesh& mesh, double least) {
    const StandardArithmetic guard;
    const Found found = find_bad(mesh);
    std::vector<std::uint32_t> misshapen;
    auto bad = found.bad.begin();
    for (std::uint32_t number = 0; number < mesh.tetrahedra.size(); ++number) {
        if (bad != found.bad.end() && bad->number == number) {
            ++bad;
            continue;
        }
        const auto& t = mesh.tetrahedra[number];
        if (mean_ratio(corners_of(mesh, number)) < least &&
            std::none_of(t.begin(), t.end(),
                         [&](std::uint32_t v) { return found.at_input_angle[v]; }))
            misshapen.push_back(number);
    }
    return misshapen;
}

} // namespace terrane
