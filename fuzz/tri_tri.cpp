// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: two triangles meet improperly for the contact test iff they do for the verifier's
// rationals, in either order.
#include <algorithm>
#include <cstdlib>
#include <vector>

#include <terrane/algorithms/intersection.hpp>
#include <terrane/algorithms/verify.hpp>
#include <terrane/kernel/predicates.hpp>

#include "soup.hpp"

using namespace terrane;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    FuzzedDataProvider data(bytes, size);
    const auto soup = fuzz::surfaces(data, 2, 2);
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    for (const Surface& s : soup)
        for (const Triangle& t : s.triangles) {
            Triangle named{};
            for (unsigned i = 0; i < 3; ++i) {
                const Point3& p = s.vertices[t[i]];
                const auto at = std::find(points.begin(), points.end(), p);
                named[i] = static_cast<std::uint32_t>(at - points.begin());
                if (at == points.end()) points.push_back(p);
            }
            if (collinear(points[named[0]], points[named[1]], points[named[2]])) return 0;
            triangles.push_back(named);
        }
    Triangle a = triangles[0], b = triangles[1];
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    if (a == b) return 0;
    const bool improper = improper_contact(points, triangles[0], triangles[1]).has_value();
    if (improper != improper_contact(points, triangles[1], triangles[0]).has_value()) std::abort();
    if (improper == verify_conforming(points, triangles).empty()) std::abort();
    return 0;
}
