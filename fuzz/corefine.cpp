// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: the arrangement of two surfaces equals their corefinement by CGAL. They have, per input
// triangle, the same points, number of parts and area; the same intersection edges; and for closed
// surfaces the same volumes of the four Booleans. An input that violates a condition of CGAL is
// counted under the name of the condition.
#include "property.hpp"
#include "report.hpp"

#include "support/corefine_oracle.hpp"

#include <terrane/kernel/predicates.hpp>

#include <CGAL/assertions.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/exceptions.h>

#include <cstdio>
#include <map>

namespace terrane::fuzz {

namespace {

/// Counts skipped inputs by reason, and prints the counts at the end of a campaign.
class Tally {
public:
    Tally() { CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION); }
    Tally(const Tally&) = delete;
    Tally& operator=(const Tally&) = delete;
    ~Tally() {
        for (const auto& [what, times] : counts_)
            std::fprintf(stderr, "corefine: %9zu %s\n", times, what.c_str());
    }
    void count(const std::string& what) { ++counts_[what]; }

private:
    std::map<std::string, std::size_t> counts_;
};

Tally& tally() {
    static Tally all;
    return all;
}

/// Adds triangles around a point: a disc, or a part of one.
void add_disc(Part& part, Points& points, Bytes& bytes) {
    const unsigned corners = 3 + bytes.below(4);
    for (unsigned i = 0; i <= corners; ++i) part.points.push_back(points.next(bytes));
    const bool whole = bytes.flag();
    for (unsigned i = 1; i < corners; ++i) part.triangles.push_back({0, i, i + 1});
    if (whole) part.triangles.push_back({0, corners, 1});
}

Point3 point_of(const fuzzing::Point& p) {
    return {p.x, p.y, p.z};
}

/// Orients a closed piece outward if its points are in general position.
void turn_outward(Part& part, const Point3& below) {
    const Triangle t = part.triangles[0];
    const auto corner = [&](unsigned i) { return point_of(part.points[t[i]]); };
    if (orient3d(corner(0), corner(1), corner(2), below) == Sign::Negative) return;
    for (Triangle& each : part.triangles) std::swap(each[1], each[2]);
}

void add_closed(Part& part, Points& points, Bytes& bytes, unsigned corners) {
    std::array<fuzzing::Point, 5> p;
    for (unsigned i = 0; i < corners; ++i) p[i] = points.next(bytes);
    if (corners == 4) {
        add_tetrahedron(part, {p[0], p[1], p[2], p[3]});
        return turn_outward(part, point_of(p[3])); // triangle 0 is 0 2 1
    }
    add_double_pyramid(part, p);
    turn_outward(part, point_of(p[4])); // triangle 0 is 0 1 3
}

Part any_part(Points& points, Bytes& bytes) {
    Part part;
    switch (bytes.below(8)) {
    case 0:
    case 1:
    case 2:
        add_sheet(part, points, bytes, bytes.below(4) == 0);
        return part;
    case 3:
    case 4:
        add_closed(part, points, bytes, 4);
        return part;
    case 5:
        add_closed(part, points, bytes, 5);
        return part;
    case 6:
        add_disc(part, points, bytes);
        return part;
    default:
        add_box(part, points, bytes);
        return part;
    }
}

} // namespace

Soup input(Bytes& bytes) {
    Points points(bytes);
    return {any_part(points, bytes), any_part(points, bytes)};
}

std::string flaw(std::span<const Surface> pair) {
    Tally& counts = tally();
    if (pair.size() != 2) return "";
    try {
        const auto arranged = arrange(pair);
        if (!arranged) return arranged.error().message();
        const auto outcome = corefine_oracle::compare(pair, arranged.value());
        counts.count(!outcome.skipped.empty() ? "skipped, " + outcome.skipped
                     : !outcome.flaw.empty()  ? "different"
                     : outcome.crossing == 0  ? "the same, no intersection edge"
                     : outcome.with_volumes   ? "the same, with volumes"
                                              : "the same");
        return outcome.flaw.empty() ? "" : "CGAL's corefinement differs: " + outcome.flaw;
    } catch (const CGAL::Failure_exception& e) {
        return std::string("CGAL throws: ") + e.what();
    }
}

} // namespace terrane::fuzz
