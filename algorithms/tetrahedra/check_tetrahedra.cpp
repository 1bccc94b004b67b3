// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

#include <array>
#include <cmath>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/tetrahedra/allowance.hpp>
#include <terrane/algorithms/tetrahedra/detail/cell_faces.hpp>
#include <terrane/algorithms/tetrahedra/detail/cover.hpp>
#include <terrane/algorithms/tetrahedra/detail/findings.hpp>
#include <terrane/algorithms/tetrahedra/detail/lists.hpp>
#include <terrane/algorithms/tetrahedra/detail/places.hpp>
#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

using namespace tetrahedra;
using namespace tetrahedra::detail;

namespace {

void check_orientation(const Subject& subject) {
    const auto& v = subject.made.vertices;
    for (std::size_t t = 0; t < subject.made.tetrahedra.size(); ++t) {
        const auto& [a, b, c, d] = subject.made.tetrahedra[t];
        if (orient3d(v[a], v[b], v[c], v[d]) != Sign::Positive)
            subject.findings.add(TetrahedraDefect::no_volume,
                                 "tetrahedron {} at {} is inverted or flat", t, place_text(v[a]));
    }
}

/// Six times the volume of each block, from the triangles around it.
std::vector<Exact> six_volumes_of_blocks(const Subject& subject) {
    const auto& [made, mesh, volumes, whole, findings] = subject;
    std::vector<Exact> sums(volumes.measures.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [front, back] = volumes.of_sides[t];
        if (front == back) continue;
        const auto& [a, b, c] = mesh.triangles[t];
        const auto& v = mesh.vertices;
        const Exact part = six_volumes(v[a], v[b], v[c]);
        sums[back] += part;
        sums[front] -= part;
    }
    return sums;
}

/// By statement (8): what points nearer to the divided triangles of a block than their reach amount
/// to.
std::vector<double> bounds_of_differences(const Subject& subject,
                                          const std::vector<bool>& divided) {
    const auto& [made, mesh, volumes, whole, findings] = subject;
    std::vector<double> bounds(volumes.measures.size());
    for (std::size_t t = 0; t < divided.size(); ++t) {
        if (!divided[t] || volumes.dangles(t)) continue;
        const auto& [a, b, c] = mesh.triangles[t];
        const auto& v = mesh.vertices;
        const double volume = volume_within_reach({v[a], v[b], v[c]});
        for (const std::uint32_t side : volumes.of_sides[t]) bounds[side] += volume;
    }
    constexpr double rounded_up = 1 + 0x1p-20; // the sum of up to 2^32 numbers
    for (double& bound : bounds) bound *= rounded_up;
    return bounds;
}

std::vector<BlockVolume> compare_volumes(const Subject& subject, const FaceResult& faces,
                                         const std::vector<bool>& divided) {
    const auto of_blocks = six_volumes_of_blocks(subject);
    const auto bounds = bounds_of_differences(subject, divided);
    std::vector<BlockVolume> compared;
    // The outside has no volume but that of its tetrahedra, where they are kept.
    const double outside = subject.whole ? nearest_quotient(faces.six_volumes[0], Exact(6)) : 0;
    compared.push_back({outside, outside, 0, 0, true});
    for (std::size_t v = 1; v < of_blocks.size(); ++v) {
        const Exact difference = faces.six_volumes[v] - of_blocks[v];
        const BlockVolume block{nearest_quotient(of_blocks[v], Exact(6)),
                                nearest_quotient(faces.six_volumes[v], Exact(6)),
                                nearest_quotient(difference, Exact(6)), bounds[v],
                                exact_sign(difference) == Sign::Zero};
        if (!block.equal && std::fabs(block.difference) > block.bound)
            subject.findings.add(TetrahedraDefect::wrong_volume,
                                 "block {} has volume {}, its tetrahedra {}; they may differ by {}",
                                 v, block.block, block.tetrahedra, block.bound);
        compared.push_back(block);
    }
    return compared;
}

} // namespace

std::string_view name_of(TetrahedraDefect defect) {
    constexpr std::array<std::string_view, 18> names{
        "unusable_lists", "wrong_attributes", "doubled_node",       "wrong_twins",
        "no_volume",      "open_face",        "crowded_face",       "box_not_filled",
        "missing_vertex", "stray_face",       "uncovered_triangle", "broken_outline",
        "torn_edge",      "node_off_edge",    "node_off_plane",     "folded_faces",
        "wrong_block",    "wrong_volume"};
    return names[static_cast<std::size_t>(defect)];
}

std::string message(const TetrahedraViolation& violation) {
    if (violation.count == 1) return violation.first;
    return fmt::format("{}; {} more of this kind ({})", violation.first, violation.count - 1,
                       name_of(violation.defect));
}

TetrahedraReport check_tetrahedra(const TetrahedralMesh& tetrahedra, const Mesh& mesh,
                                  const Volumes& volumes) {
    const StandardArithmetic guard;
    TetrahedraReport report;
    Findings findings;
    const bool whole = tetrahedra.surfaces.size() > mesh.surfaces.size();
    const Subject subject{tetrahedra, mesh, volumes, whole, findings};
    if (check_lists(subject)) {
        check_attributes(subject);
        const Places places = find_places(subject);
        check_orientation(subject);
        const FaceResult faces = check_faces(subject, places);
        check_vertices(subject, places);
        const auto divided = check_cover(subject, places, faces.faces_of);
        report.volumes = compare_volumes(subject, faces, divided);
        report.shape = shape_of(tetrahedra);
    }
    report.violations = std::move(findings).taken();
    return report;
}

} // namespace terrane
