// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/check/check.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/check/count_pairs.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/work_hook.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane {
namespace {

Error contact(std::string sentence, std::uint32_t triangle) {
    return {ErrorCode::improper_contact, std::move(sentence),
            "triangle " + std::to_string(triangle)};
}

Status distinct_triangles(std::span<const Triangle> triangles) {
    std::vector<std::pair<Triangle, std::uint32_t>> sorted;
    sorted.reserve(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        Triangle corners = triangles[t];
        std::sort(corners.begin(), corners.end());
        sorted.emplace_back(corners, t);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].first == sorted[i - 1].first)
            return contact("it repeats triangle " + std::to_string(sorted[i - 1].second),
                           sorted[i].second);
    return Done{};
}

Status distinct_points(std::span<const Point3> points, std::span<const Triangle> triangles) {
    const auto used = used_vertices(points.size(), triangles);
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < points.size(); ++v)
        if (used[v]) order.push_back(v);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return points[a] < points[b]; });
    for (std::size_t i = 1; i < order.size(); ++i)
        if (points[order[i]] == points[order[i - 1]])
            return Error{ErrorCode::improper_contact,
                         "it is at the place of vertex " + std::to_string(order[i - 1]),
                         "vertex " + std::to_string(order[i])};
    return Done{};
}

/// Returns the injective patch of each triangle; empty for a full check, which uses none.
std::vector<std::uint32_t> patches_of(std::span<const Point3> points,
                                      std::span<const Triangle> triangles,
                                      std::span<const std::uint32_t> label_of, PairCheck method,
                                      const Run& run) {
    if (method == PairCheck::full) return {};
    const EdgeSides edges = group_edges(triangles, points.size(), run);
    return find_injective_patches(points, triangles, label_of, edges, run).of;
}

/// Returns the first pair of triangles that meet improperly.
std::optional<CandidatePair> first_contact(std::span<const Point3> points,
                                           std::span<const Triangle> triangles,
                                           std::span<const std::uint32_t> patches, const Run& run) {
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto improper = [&](const CandidatePair& p) {
        return improper_contact(points, triangles[p.first], triangles[p.second]).has_value();
    };
    const auto pairs =
        candidate_pairs_of({points, triangles}, all, patches, improper, without_progress(run));
    return pairs.empty() ? std::nullopt : std::optional(pairs.front());
}

} // namespace

Status conforming(std::span<const Point3> points, std::span<const Triangle> triangles,
                  std::span<const std::uint32_t> label_of, const Run& run) {
    return guarded("for the check", "conforming", [&]() -> Status {
        const auto proof = conforming(points, triangles, label_of, PairCheckOptions{}, run);
        if (!proof) return proof.error();
        return Done{};
    });
}

Result<std::optional<PairCounts>> conforming(std::span<const Point3> points,
                                             std::span<const Triangle> triangles,
                                             std::span<const std::uint32_t> label_of,
                                             const PairCheckOptions& check, const Run& run) {
    return guarded("for the check", "conforming", [&]() -> Result<std::optional<PairCounts>> {
        if (auto valid = validate_areas(points, triangles, run); !valid) return valid.error();
        if (auto distinct = distinct_points(points, triangles); !distinct) return distinct.error();
        if (auto distinct = distinct_triangles(triangles); !distinct) return distinct.error();
        detail::announce_work("prove conforming", points, triangles);
        const auto patches = patches_of(points, triangles, label_of, check.method, run);
        const auto pair = first_contact(points, triangles, patches, run);
        if (run.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        if (pair) {
            const auto how =
                improper_contact(points, triangles[pair->first], triangles[pair->second]);
            return contact("it meets triangle " + std::to_string(pair->second) +
                               " improperly: " + std::string(name_of(kind_of(*how))),
                           pair->first);
        }
        const auto decided_by = [&](const CandidatePair& p) {
            const bool in_one = !patches.empty() && patches[p.first] != no_group &&
                                patches[p.first] == patches[p.second];
            return in_one ? DecidedBy::patch : DecidedBy::test;
        };
        return count_pairs(points, triangles, decided_by, check.most_counted(triangles.size()),
                           run);
    });
}

Result<ConformingMesh> prove_conforming(Mesh mesh, std::span<const std::uint32_t> label_of,
                                        const Run& run) {
    const StandardArithmetic guard;
    return prove_conforming(std::move(mesh), label_of, PairCheckOptions{}, run);
}

Result<ConformingMesh> prove_conforming(Mesh mesh, std::span<const std::uint32_t> label_of,
                                        const PairCheckOptions& check, const Run& run) {
    return guarded("for the check", "conforming", [&]() -> Result<ConformingMesh> {
        const auto proof = conforming(mesh.vertices, mesh.triangles, label_of, check, run);
        if (!proof) return proof.error();
        return ConformingMesh(std::move(mesh), proof.value());
    });
}

Result<ConformingMesh> prove_conforming(Mesh mesh, const Run& run) {
    return guarded("for the check", "conforming", [&]() -> Result<ConformingMesh> {
        std::vector<std::uint32_t> labels(mesh.triangles.size());
        for (std::size_t t = 0; t < std::min(labels.size(), mesh.surfaces_of.size()); ++t)
            if (!mesh.surfaces_of[t].empty()) labels[t] = mesh.surfaces_of[t][0];
        return prove_conforming(std::move(mesh), labels, run);
    });
}

} // namespace terrane
