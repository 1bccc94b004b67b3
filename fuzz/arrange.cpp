// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: an arrangement holds for the independent verifier, and doubles that are said to be
// conforming are.
#include <cstdlib>

#include <terrane/algorithms/rounding.hpp>
#include <terrane/algorithms/verify.hpp>

#include "soup.hpp"

using namespace terrane;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    FuzzedDataProvider data(bytes, size);
    const auto surfaces = fuzz::surfaces(data, 2, 12);
    const auto made = arrange(surfaces);
    if (!made) std::abort();
    const Arrangement& a = made.value();
    ArrangementClaim claim;
    for (const PointIndex p : a.vertices) claim.vertices.push_back(a.points.construction(p));
    claim.triangles = a.triangles;
    claim.parents_of = a.parents_of;
    claim.intersection_edges = a.intersection_edges;
    claim.degenerate = a.degenerate;
    claim.duplicates = a.inputs.duplicates;
    if (!verify_arrangement(surfaces, claim).empty()) std::abort();
    const auto rounded = round_to_doubles(a);
    if (!rounded) std::abort();
    const Mesh& mesh = rounded.value().mesh;
    const bool conforming = verify_conforming(mesh.vertices, mesh.triangles).empty();
    if (conforming != rounded.value().report.clean) std::abort();
    return 0;
}
