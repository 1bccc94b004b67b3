// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Laws for the arrangement of any surfaces and its rounded mesh. Each function describes a
// violation in a sentence, or returns nothing. The independent verifier is the judge.
#pragma once

#include "support/metamorphic.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/verify/detail/digest.hpp>
#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>
#include <terrane/algorithms/verify/verify.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace soup_laws {

using namespace terrane;
using namespace test_support;

/// Describes the first violation, and states the number of violations.
inline std::string sentence(std::span<const Violation> violations) {
    if (violations.empty()) return "";
    return name_of(violations[0].rule) + ": " + violations[0].sentence + " (" +
           std::to_string(violations.size()) + " violations)";
}

inline std::string arrangement_flaw(const Surfaces& surfaces, const Arrangement& a) {
    const auto claim = claim_of(a);
    if (const auto broken = verify_arrangement(surfaces, claim); !broken.empty())
        return sentence(broken);
    if (verifier::digest_of(surfaces, claim) != canonical_digest(surfaces, a))
        return "the digest is not the verifier's";
    return "";
}

/// Compares with arrangements of the same surfaces in another order, reflected, with permuted axes
/// and scaled, by all search methods.
inline std::string metamorphic_flaw(const Surfaces& surfaces, const Arrangement& a) {
    const auto digest = canonical_digest(surfaces, a);
    std::mt19937 random(1);
    const auto other = shuffled(surfaces, random);
    const auto again = arrange(other);
    if (!again || canonical_digest(other, again.value()) != digest)
        return "another order gives another digest";
    const auto carried = [&](const Surfaces& model, bool was_turned) {
        const auto made = arrange(model);
        if (!made) return false;
        auto claim = claim_of(made.value());
        if (was_turned) turn_back(claim);
        return made.value().triangles.size() == a.triangles.size() &&
               verifier::digest_of(surfaces, claim) == digest;
    };
    for (const Change& reflected : reflections)
        if (!carried(changed(surfaces, reflected), false))
            return "a reflection is arranged otherwise";
    if (!carried(changed(surfaces, turned), true)) return "other axes give another arrangement";
    for (const int k : {-3, 11})
        if (const auto model = scaled(surfaces, k); !model.empty() && !carried(model, false))
            return "times 2^k it is arranged otherwise";
    return "";
}

/// Compares with arrangements by another search method and with two threads, which must be equal to
/// the last index.
inline std::string run_flaw(const Surfaces& surfaces, const Arrangement& a) {
    for (const Search search : {Search::grid, Search::bvh}) {
        const auto made = arrange(surfaces, {.search = search}, {.threads = 2});
        if (!made) return made.error().message();
        const Arrangement& b = made.value();
        if (a.triangles != b.triangles || a.parents_of != b.parents_of ||
            a.vertices != b.vertices || a.intersection_edges != b.intersection_edges)
            return "search or threads change the arrangement";
    }
    return "";
}

/// Returns what a certificate states about the mesh (io/certificate.cpp).
inline RoundedClaim claim_of(const Arrangement& a, const RoundedMesh& rounded) {
    const Mesh& mesh = rounded.mesh;
    const RoundingReport& report = rounded.report;
    RoundedClaim claim;
    claim.vertices = mesh.vertices;
    claim.triangles = mesh.triangles;
    claim.parents_of = mesh.parents_of;
    claim.intersection_edges = mesh.intersection_edges;
    claim.regions_of = mesh.regions_of;
    claim.clean = report.clean;
    const bool same = a.vertices.size() == mesh.vertices.size() && a.triangles == mesh.triangles &&
                      a.parents_of == mesh.parents_of;
    if (same) claim.max_move = report.max_move;
    claim.deviation = same ? report.deviation : 4 * report.deviation;
    claim.vanished = report.vanished;
    return claim;
}

/// Checks that the arrangement of a conforming mesh is the mesh itself.
inline std::string idempotence_flaw(const Mesh& mesh) {
    const auto surfaces = surfaces_of(mesh);
    const auto checked = check(surfaces);
    if (!checked || !checked.value().clean()) return "check finds what rounding left";
    const auto again = arrange(surfaces);
    if (!again) return again.error().message();
    const auto rounded = round_to_doubles(again.value());
    if (!rounded) return rounded.error().message();
    const Mesh& same = rounded.value().mesh;
    if (again.value().statistics.constructed_points != 0 || rounded.value().report.max_move != 0)
        return "arranged again, it has other points";
    if (triangles_of(same.vertices, same.triangles) != triangles_of(mesh.vertices, mesh.triangles))
        return "arranged again, it has other triangles";
    return "";
}

/// Checks what is documented about --max-move: its default is 1024 spacings of the doubles at the
/// largest coordinate, surface_deviation is at most the limit, and no part of an input triangle is
/// farther from it than surface_deviation.
inline std::string movement_flaw(const Surfaces& surfaces, const RoundedMesh& rounded,
                                 const RoundingOptions& options) {
    const RoundingReport& report = rounded.report;
    double largest = 0;
    for (const Surface& s : surfaces)
        for (const Point3& p : s.vertices)
            largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    const double spacing =
        std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
    const double allowed = options.max_move.value_or(largest == 0 ? 0x1p-1000 : 1024 * spacing);
    if (!(report.max_allowed <= allowed)) return "more movement is allowed than is documented";
    if (!(report.surface_deviation <= report.max_allowed))
        return "surfaces are said to be farther away than is allowed";
    // The distance from a triangle is a convex function, so a corner of the part is the farthest point.
    std::vector<Point3> points;
    std::vector<Triangle> inputs;
    for (const Surface& surface : surfaces) {
        const auto first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), surface.vertices.begin(), surface.vertices.end());
        for (const auto& [u, v, w] : surface.triangles)
            inputs.push_back({first + u, first + v, first + w});
    }
    const Mesh& mesh = rounded.mesh;
    const std::size_t first = points.size();
    points.insert(points.end(), mesh.vertices.begin(), mesh.vertices.end());
    points.push_back({report.surface_deviation, 0, 0});
    const auto exact = verifier::scale_to_integers(points).points;
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t parent : mesh.parents_of[t])
            for (const std::uint32_t v : mesh.triangles[t]) {
                const auto& [p, q, r] = inputs[parent];
                if (seen.emplace(parent, v).second &&
                    !verifier::within(exact[first + v], {&exact[p], &exact[q], &exact[r]},
                                      exact.back()[0]))
                    return "a part is farther from its input triangle than surfaces moved";
            }
    return "";
}

/// Tells whether all triangles are thinner than what surfaces may move by.
inline bool are_thin(const Surfaces& surfaces) {
    const auto arranged = arrange(surfaces);
    if (!arranged) return false;
    std::vector<Point3> points;
    for (const Surface& s : surfaces)
        points.insert(points.end(), s.vertices.begin(), s.vertices.end());
    points.push_back({2 * default_max_move(arranged.value()), 0, 0});
    const auto exact = verifier::scale_to_integers(points).points;
    std::size_t first = 0;
    for (const Surface& s : surfaces) {
        for (const auto& [u, v, w] : s.triangles) {
            const std::array at{&exact[first + u], &exact[first + v], &exact[first + w]};
            const auto height = verifier::squared_height(at);
            if (sgn(height.below) != 0 && !verifier::within(height, exact.back()[0])) return false;
        }
        first += s.vertices.size();
    }
    return true;
}

/// Checks that the rounded mesh is conforming or stated not to be, and that its other claims are
/// true.
inline std::string rounding_flaw(const Surfaces& surfaces, const Arrangement& a,
                                 const RoundingOptions& options = {}) {
    const auto made = round_to_doubles(a, options);
    if (!made) {
        const ErrorCode code = made.error().code;
        const bool is_right = code == ErrorCode::bad_number ||
                              (code == ErrorCode::nothing_to_do && are_thin(surfaces));
        return is_right ? "" : made.error().message();
    }
    const RoundedMesh& rounded = made.value();
    const bool conforming =
        verify_conforming(rounded.mesh->vertices, rounded.mesh->triangles).empty();
    if (conforming != rounded.report.clean)
        return conforming ? "conforming doubles are refused" : "the doubles are not conforming";
    if (rounded.report.clean != rounded.report.contacts.empty())
        return "clean, but with contacts, or the reverse";
    // Any deviation is accepted that is stated: inputs that are a few units of their last place in
    // size are rounded by more than the default.
    const auto broken =
        verify_rounded(surfaces, test_support::claim_of(a), soup_laws::claim_of(a, rounded),
                       {.max_deviation = std::numeric_limits<double>::max()})
            .violations;
    if (!broken.empty()) return sentence(broken);
    if (auto what = movement_flaw(surfaces, rounded, options); !what.empty()) return what;
    return rounded.report.clean ? idempotence_flaw(rounded.mesh) : "";
}

/// Arranges the surfaces and checks all laws.
inline std::string flaw(const Surfaces& surfaces) {
    const auto made = arrange(surfaces);
    if (!made) return made.error().message();
    const Arrangement& a = made.value();
    for (const auto law : {arrangement_flaw, metamorphic_flaw, run_flaw})
        if (auto what = law(surfaces, a); !what.empty()) return what;
    return rounding_flaw(surfaces, a);
}

} // namespace soup_laws
