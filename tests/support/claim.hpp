// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Converts an arrangement to the claim that the independent verifier judges.
#pragma once

#include <sstream>
#include <string>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace test_support {

inline terrane::ArrangementClaim claim_of(const terrane::Arrangement& a) {
    terrane::ArrangementClaim claim;
    for (const terrane::PointIndex p : a.vertices)
        claim.vertices.push_back(a.state->points.construction(p));
    claim.triangles = a.triangles;
    claim.parents_of = a.parents_of;
    claim.intersection_edges = a.intersection_edges;
    claim.degenerate = a.degenerate;
    claim.duplicates = a.inputs.duplicates;
    return claim;
}

/// Returns the surfaces as C++ code, with coordinates that read back as the same doubles.
inline std::string written_out(std::span<const terrane::Surface> surfaces) {
    std::ostringstream out;
    out << std::hexfloat;
    for (const auto& s : surfaces) {
        out << "surface({";
        for (const auto& p : s.vertices) out << "{" << p.x << ", " << p.y << ", " << p.z << "}, ";
        out << "}, {";
        for (const auto& t : s.triangles)
            out << "{" << t[0] << ", " << t[1] << ", " << t[2] << "}, ";
        out << "})\n";
    }
    return out.str();
}

/// Returns the violations of an arrangement; empty if there are none.
inline std::string flaws(std::span<const terrane::Surface> surfaces,
                         const terrane::Arrangement& a) {
    const auto violations = terrane::verify_arrangement(surfaces, claim_of(a));
    if (violations.empty()) return "";
    std::string all = std::to_string(violations.size()) + " violations\n";
    for (std::size_t i = 0; i < violations.size() && i < 5; ++i)
        all += violations[i].sentence + "\n";
    return all + written_out(surfaces);
}

/// Arranges the surfaces and returns the violations; empty if there are none.
inline std::string flaws(std::span<const terrane::Surface> surfaces) {
    const auto a = terrane::arrange(surfaces);
    return a ? flaws(surfaces, a.value()) : a.error().message() + "\n" + written_out(surfaces);
}

inline terrane::Surface surface(std::vector<terrane::Point3> vertices,
                                std::vector<terrane::Triangle> triangles) {
    return {"", terrane::Role::unknown, std::move(vertices), std::move(triangles)};
}

} // namespace test_support
