// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What must hold of the engine. The judge is `terrane::judge_soup`, and, for numbers, another way to compute them.
#pragma once

#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/fuzzing/meshes.hpp>

#include "engine.hpp"

namespace under_test {

using terrane::fuzzing::Soup;

inline Soup generate(terrane::fuzzing::Bytes& bytes) {
    return terrane::fuzzing::any_mesh(bytes, 40);
}

inline engine::Mesh mesh_of(const Soup& soup) {
    engine::Mesh mesh;
    for (const auto& part : soup) {
        const auto first = unsigned(mesh.points.size());
        for (const auto& p : part.points) mesh.points.push_back({p.x, p.y, p.z});
        for (const auto& t : part.triangles)
            mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return mesh;
}

inline terrane::Result<terrane::MeshJudgement> judged(const engine::Mesh& mesh) {
    terrane::Surface surface;
    for (const auto& p : mesh.points) surface.vertices.push_back({p[0], p[1], p[2]});
    for (const auto& t : mesh.triangles) surface.triangles.push_back({t[0], t[1], t[2]});
    return terrane::judge_soup(std::span(&surface, 1),
                               {.most_flaws = std::numeric_limits<std::size_t>::max()});
}

/// Returns the winding number by solid angles, or none near the mesh.
inline std::optional<int> winding_by_angles(const engine::Mesh& mesh, const engine::Point& p) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        std::array<engine::Point, 3> r{};
        std::array<double, 3> l{};
        for (unsigned i = 0; i < 3; ++i) {
            for (unsigned k = 0; k < 3; ++k) r[i][k] = mesh.points[t[i]][k] - p[k];
            l[i] = std::hypot(r[i][0], r[i][1], r[i][2]);
        }
        const auto dot = [&](unsigned i, unsigned j) {
            return r[i][0] * r[j][0] + r[i][1] * r[j][1] + r[i][2] * r[j][2];
        };
        const double size = l[0] * l[1] * l[2],
                     sine = engine::determinant<double>({0, 0, 0}, r[0], r[1], r[2]),
                     cosine = size + dot(0, 1) * l[2] + dot(1, 2) * l[0] + dot(2, 0) * l[1];
        if (std::abs(sine) <= 1e-9 * size && cosine <= 1e-9 * size) return std::nullopt;
        sum += 2 * std::atan2(sine, cosine);
    }
    return int(std::round(sum / (4 * std::numbers::pi)));
}

/// Judges volume and winding numbers of a closed mesh of moderate size.
inline std::string flaw_of_solid(const engine::Mesh& mesh) {
    for (const auto& p : mesh.points)
        for (const double x : p)
            if (std::abs(x) > 1000 || (x != 0 && std::abs(x) < 0.001)) return "";
    mpq_class exact;
    for (const auto& t : mesh.triangles) {
        const auto& p = mesh.points;
        exact += engine::determinant<mpq_class>({0, 0, 0}, p[t[0]], p[t[1]], p[t[2]]);
    }
    if (std::abs(engine::six_volumes(mesh) - exact.get_d()) > 1e-3) return "the volume is wrong";
    for (std::size_t v = 0; v < mesh.points.size() && v < 8; ++v) {
        engine::Point p = mesh.points[v];
        p[2] -= 0.5;
        const auto expected = winding_by_angles(mesh, p);
        if (expected && *expected != engine::winding_number(mesh, p))
            return "a winding number is wrong";
    }
    return "";
}

/// Returns what is wrong with the engine, or "".
inline std::string flaw(const Soup& soup) {
    const engine::Mesh input = mesh_of(soup), clean = engine::clean(input);
    const auto before = judged(input), after = judged(clean);
    if (!before || !after) return "";
    if (input.triangles.size() - before->find("distinct")->count != clean.triangles.size())
        return "clean() leaves another number of triangles";
    if (after->find("distinct")->count > 0) return "clean() leaves triangles that it should not";
    if (after->find("welded")->count > 0) return "clean() leaves points twice";
    std::set<std::set<engine::Point>> there;
    for (const auto& t : input.triangles) {
        const auto c = engine::corners_of(input, t);
        there.insert({c[0], c[1], c[2]});
    }
    for (const auto& t : clean.triangles) {
        const auto c = engine::corners_of(clean, t);
        if (!there.contains({c[0], c[1], c[2]})) return "clean() changes a triangle";
    }
    engine::Pairs pairs;
    for (const auto& found : after->find("conforming")->flaws)
        pairs.insert(std::minmax(found.triangles[0], found.triangles[1]));
    const auto crossings = engine::crossings(clean);
    if (crossings.size() < pairs.size()) return "crossings() misses a pair";
    if (crossings != pairs) return "crossings() finds another pair";
    const auto [open, turned] = engine::open_and_turned(clean);
    if (open != after->find("closed")->count) return "the number of open edges is wrong";
    if (turned != after->find("oriented")->count) return "the number of turned edges is wrong";
    return open + turned == 0 && pairs.empty() ? flaw_of_solid(clean) : "";
}

} // namespace under_test
