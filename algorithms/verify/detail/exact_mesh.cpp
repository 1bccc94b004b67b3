// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/exact_mesh.hpp>

#include <cstddef>
#include <utility>

#include <terrane/algorithms/verify/detail/box_tree.hpp>

namespace terrane::verifier {

ExactMesh make_exact_mesh(std::vector<Vector4> points, const mpz_class& scale,
                          std::span<const Triangle> triangles) {
    ExactMesh mesh{std::move(points), scale, {triangles.begin(), triangles.end()}, {}};
    mesh.planes.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        mesh.planes.push_back(orthogonal(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
        make_primitive(mesh.planes.back());
    }
    return mesh;
}

std::vector<Box> boxes_of_triangles(const ExactMesh& mesh) {
    std::vector<Box> corners;
    corners.reserve(mesh.points.size());
    for (const Vector4& point : mesh.points) corners.push_back(enclose(point, mesh.scale));
    std::vector<Box> boxes;
    boxes.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        Box box = corners[t[0]];
        extend(box, corners[t[1]]);
        extend(box, corners[t[2]]);
        boxes.push_back(box);
    }
    return boxes;
}

Vector4 centroid_of(const ExactMesh& mesh, std::uint32_t triangle) {
    const auto& [i, j, k] = mesh.triangles[triangle];
    const Vector4 &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    const mpz_class bc = b[3] * c[3], ca = c[3] * a[3], ab = a[3] * b[3];
    Vector4 point{0, 0, 0, mpz_class(3 * a[3] * bc)};
    for (std::size_t x = 0; x < 3; ++x) point[x] = a[x] * bc + b[x] * ca + c[x] * ab;
    make_primitive(point);
    return point;
}

} // namespace terrane::verifier
