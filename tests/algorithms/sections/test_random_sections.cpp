// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sections of random models, most of them degenerate, against the winding numbers of points in rationals, exact
// areas, and the segments in which a plane meets triangles.
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include <gmpxx.h>

#include <terrane/algorithms/sections/detail/cut.hpp>
#include <terrane/algorithms/sections/detail/parts.hpp>

#include "random_blocks.hpp"
#include "support/effort.hpp"

using namespace terrane;
using namespace test_support;

namespace {

using Flat = std::array<mpq_class, 2>;

/// Projects along an axis: 0, 1, 2.
Flat flat_of(const RationalPoint& q, std::size_t axis) {
    return {q[(axis + 1) % 3], q[(axis + 2) % 3]};
}

/// Whether a point is in a polygon, by the crossings of a ray with its rings.
bool is_inside(const Section& section, const SectionPolygon& polygon, const Flat& q,
               std::size_t axis) {
    bool inside = false;
    for (const auto& ring : polygon.rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Flat a = flat_of(rational(section.vertices[ring[i]]), axis);
            const Flat b = flat_of(rational(section.vertices[ring[(i + 1) % ring.size()]]), axis);
            if ((a[1] > q[1]) == (b[1] > q[1])) continue;
            if (a[0] + (b[0] - a[0]) * (q[1] - a[1]) / (b[1] - a[1]) > q[0]) inside = !inside;
        }
    return inside;
}

/// A plane, and a point in it that is not special.
struct Plane {
    SectionSurface along;
    RationalPoint normal; ///< that the triangle has
    std::size_t axis = 0; ///< in which the normal is longest

    [[nodiscard]] RationalPoint point(Random& random) const {
        const auto& v = along.surface.vertices;
        const auto any = [&] { return mpq_class(random_int(random, 0, 1 << 20), 2097169); };
        const mpq_class s = any(), t = any();
        RationalPoint q;
        const RationalPoint a = rational(v[0]), b = rational(v[1]), c = rational(v[2]);
        for (std::size_t k = 0; k < 3; ++k) q[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]);
        return q;
    }
};

/// A plane on the lattice of the model, across an axis, or in which a triangle lies.
Result<SectionSurface> random_section_plane(ModelMaker& maker, const Mesh& mesh) {
    const auto any = [&](std::size_t count) {
        return static_cast<std::size_t>(random_int(maker.random, 0, static_cast<int>(count) - 1));
    };
    const std::array<Point3, 3> axes{Point3{1, 0, 0}, Point3{0, -1, 0}, Point3{0, 0, 1}};
    const std::size_t kind = any(3);
    if (kind == 0) return section_plane(mesh, maker.point(4), axes[any(3)]);
    if (kind == 1) {
        Point3 normal;
        while (normal == Point3{}) normal = maker.point(1);
        return section_plane(mesh, maker.point(4), normal);
    }
    const Triangle& t = mesh.triangles[any(mesh.triangles.size())];
    const Point3& p = mesh.vertices[t[0]];
    return section_plane(mesh, p,
                         cross(minus(mesh.vertices[t[1]], p), minus(mesh.vertices[t[2]], p)));
}

Plane random_plane(ModelMaker& maker, const Mesh& mesh) {
    const auto along = random_section_plane(maker, mesh);
    REQUIRE(along);
    Plane plane{*along, {}, 0};
    const auto& v = along->surface.vertices;
    const RationalPoint a = between(v[1], rational(v[0])), b = between(v[2], rational(v[0]));
    for (std::size_t k = 0; k < 3; ++k) {
        plane.normal[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        if (abs(plane.normal[k]) > abs(plane.normal[plane.axis])) plane.axis = k;
    }
    return plane;
}

/// Compares the block on each side of points in the section; returns how many were compared.
int compare_points(const SectionModel& model, const Section& section, const Plane& plane,
                   Random& random) {
    const BlocksByWinding block_at(model);
    int compared = 0;
    for (int i = 0; i < 400; ++i) {
        const RationalPoint q = plane.point(random);
        if (abs(q[0]) > half || abs(q[1]) > half || abs(q[2]) > half) continue;
        std::array<std::optional<std::uint32_t>, 2> expected;
        for (const std::size_t side : {0U, 1U}) {
            RationalPoint moved = q;
            for (std::size_t k = 0; k < 3; ++k)
                moved[k] += plane.normal[k] / abs(plane.normal[plane.axis]) * (side == 0 ? 1 : -1) /
                            mpq_class("1" + std::string(40, '0'));
            expected[side] = block_at(moved);
        }
        if (!expected[0] || !expected[1]) continue;
        int found = 0;
        for (const SectionPolygon& p : section.polygons) {
            if (!is_inside(section, p, flat_of(q, plane.axis), plane.axis)) continue;
            ++found;
            CHECK(p.block == *expected[0]);
            CHECK(p.behind == *expected[1]);
        }
        CHECK(found == (*expected[0] == 0 && *expected[1] == 0 ? 0 : 1));
        if (++compared == 12) break;
    }
    return compared;
}

/// Exact areas of a section across an axis.
class ExactAreas {
public:
    ExactAreas(const Arrangement& exact, std::size_t axis) : exact_(exact), axis_(axis) {}

    [[nodiscard]] mpq_class of(std::span<const std::uint32_t> ring) const {
        mpq_class sum = 0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Flat a = at(ring[i]), b = at(ring[(i + 1) % ring.size()]);
            sum += a[0] * b[1] - a[1] * b[0];
        }
        return sum / 2;
    }

private:
    [[nodiscard]] Flat at(std::uint32_t v) const {
        const auto texts = exact_.coordinates(VertexId(v));
        return flat_of({mpq_class(texts[0]), mpq_class(texts[1]), mpq_class(texts[2])}, axis_);
    }
    const Arrangement& exact_;
    std::size_t axis_;
};

/// Checks that the rings of each region enclose its triangles, before and after they are straightened, and that
/// all regions together are the section of the box.
void check_areas(const SectionModel& model, const Plane& plane) {
    const auto cut = sections::cut(model.mesh, model.volumes, plane.along, {});
    REQUIRE(cut);
    const ExactAreas area(cut->exact, plane.axis);
    const int turn = sgn(plane.normal[plane.axis]);
    auto regions = sections::find_regions(*cut, plane.along);
    std::vector<mpq_class> expected;
    mpq_class sum = 0;
    for (const auto& region : regions) {
        mpq_class whole = 0;
        for (const std::uint32_t t : region.triangles) {
            const mpq_class one = turn * area.of(cut->triangles[t].corners);
            CHECK(one > 0);
            whole += one;
        }
        expected.push_back(whole);
        if (cut->triangles[region.triangles[0]].blocks[0] != 0) sum += whole;
    }
    auto lines = sections::find_lines(*cut);
    for (const int straightened : {0, 1}) {
        if (straightened == 1) sections::straighten(*cut, regions, lines);
        for (std::size_t r = 0; r < regions.size(); ++r) {
            mpq_class rings = 0;
            for (std::size_t k = 0; k < regions[r].rings.size(); ++k) {
                const mpq_class one = turn * area.of(regions[r].rings[k]);
                CHECK(sgn(one) == (k == 0 ? 1 : -1));
                rings += one;
            }
            CHECK(rings == expected[r]);
        }
    }
    const auto across = [&](std::size_t k) { return plane.normal[k] == 0; };
    if (!across((plane.axis + 1) % 3) || !across((plane.axis + 2) % 3)) return;
    const mpq_class at = rational(plane.along.surface.vertices[0])[plane.axis];
    if (abs(at) < half) CHECK(sum == 4 * half * half);
}

/// The length in which a plane crosses the triangles of a surface; nothing if it meets a vertex.
std::optional<double> crossed_length(const Mesh& mesh, std::uint32_t surface, const Plane& plane) {
    const RationalPoint origin = rational(plane.along.surface.vertices[0]);
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto of = mesh.surfaces_of[t];
        if (std::find(of.begin(), of.end(), surface) == of.end()) continue;
        std::array<RationalPoint, 3> p;
        std::array<mpq_class, 3> side;
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = rational(mesh.vertices[mesh.triangles[t][i]]);
            for (std::size_t k = 0; k < 3; ++k) side[i] += (p[i][k] - origin[k]) * plane.normal[k];
            if (side[i] == 0) return std::nullopt;
        }
        std::vector<RationalPoint> ends;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            if (sgn(side[i]) == sgn(side[j])) continue;
            RationalPoint q;
            for (std::size_t k = 0; k < 3; ++k)
                q[k] = p[i][k] + (p[j][k] - p[i][k]) * side[i] / (side[i] - side[j]);
            ends.push_back(q);
        }
        if (ends.size() != 2) continue;
        mpq_class square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const mpq_class d = ends[1][k] - ends[0][k];
            square += d * d;
        }
        sum += std::sqrt(square.get_d());
    }
    return sum;
}

int compare_lines(const SectionModel& model, const Section& section, const Plane& plane) {
    std::map<std::uint32_t, double> lengths;
    for (const SectionLine& line : section.lines)
        for (std::size_t i = 1; i < line.vertices.size(); ++i)
            lengths[line.surface] += length(
                minus(section.vertices[line.vertices[i]], section.vertices[line.vertices[i - 1]]));
    int compared = 0;
    for (std::uint32_t s = 0; s < model.mesh.surfaces.size(); ++s)
        if (const auto expected = crossed_length(model.mesh, s, plane)) {
            CHECK(lengths[s] == Approx(*expected).margin(1e-9));
            ++compared;
        }
    return compared;
}

} // namespace

TEST_CASE("sections: random models against winding numbers, areas and crossed triangles",
          "[once]") {
    int points = 0, lines = 0, upon = 0, holes = 0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        ModelMaker maker(seed);
        const auto model = random_model(maker);
        if (!model) continue;
        for (int k = 0; k < 2; ++k) {
            INFO("seed " << seed << ", plane " << k);
            const Plane plane = random_plane(maker, model->mesh);
            const Section section = cut_along(*model, plane.along);
            points += compare_points(*model, section, plane, maker.random);
            lines += compare_lines(*model, section, plane);
            check_areas(*model, plane);
            for (const SectionPolygon& p : section.polygons) {
                upon += p.block != p.behind ? 1 : 0;
                holes += p.rings.size() > 1 ? 1 : 0;
            }
        }
    }
    CHECK(points > 800);
    CHECK(lines > 150);
    CHECK(upon > 15);
    CHECK(holes > 10);
}

TEST_CASE("sections: random fences and surfaces cover the box, with rings round what they hold") {
    int polygons = 0, upon = 0;
    const auto check = [&](const Section& section, double expected) {
        double sum = 0;
        for (const SectionPolygon& p : section.polygons) {
            double rings = 0;
            for (std::size_t k = 0; k < p.rings.size(); ++k) {
                const double one = shoelace(section, p.rings[k]);
                const bool is_thin =
                    std::abs(one) < 1e-12; // too thin for doubles, which shoelace() sums
                CHECK((is_thin || (one > 0) == (k == 0)));
                rings += one;
            }
            sum += p.block == 0 ? 0 : rings;
            ++polygons;
            upon += p.block != p.behind ? 1 : 0;
        }
        CHECK(sum == Approx(expected).margin(1e-9));
    };
    for (std::uint64_t seed = 100; seed < 150; ++seed) {
        ModelMaker maker(seed);
        const auto model = random_model(maker);
        if (!model) continue;
        INFO("seed " << seed);
        std::vector<std::array<double, 2>> corners;
        double length = 0;
        for (double x = -half + 1; x < half; x += 1 + std::abs(maker.number(2))) {
            corners.push_back({x, maker.number(half - 1)});
            if (corners.size() > 1)
                length +=
                    std::hypot(x - corners.end()[-2][0], corners.back()[1] - corners.end()[-2][1]);
        }
        if (corners.size() > 1)
            check(cut_along(*model, section_fence(model->mesh, corners)), length * 2 * half);
        Surface ground = maker.sheet(); // within the heights of the box
        double reach = 0;
        for (const Point3& p : ground.vertices) reach = std::max(reach, std::abs(p.x));
        reach = std::min(reach, double(half));
        if (reach > 0) check(cut_along(*model, section_along(ground)), 4 * reach * reach);
    }
    CHECK(polygons > 300);
    CHECK(upon > 0);
}
