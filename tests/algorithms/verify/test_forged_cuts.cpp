// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Forged certificates of volumes of interest that one rule alone refutes.
#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <random>

#include <terrane/algorithms/verify/detail/cut.hpp>

#include "support/cut_certificates.hpp"

namespace {

using namespace forged;

const Subject& boxed_sheets() {
    static const Subject subject = cut_subject(crossing_sheets(), the_box());
    return subject;
}

/// Returns the number of input triangles without those of the box.
std::size_t own_inputs(const Subject& s) {
    std::size_t count = 0;
    for (const Surface& surface : s.surfaces) count += surface.triangles.size();
    return count - 12;
}

/// Adds a sliver to the doubles at an edge on the boundary, on the outer side. It is nearer to what is
/// inside than the deviation, which is stated larger for that.
void add_sliver_outside(Json& m, std::size_t own) {
    const auto is_boundary = [&](std::size_t t) { return m["parents"][t].back() >= own; };
    std::set<std::set<std::size_t>> boundary;
    const auto edge = [&](std::size_t t, std::size_t i) {
        const Json& corners = m["triangles"][t];
        return std::set<std::size_t>{corners[i].get<std::size_t>(),
                                     corners[(i + 1) % 3].get<std::size_t>()};
    };
    for (std::size_t t = 0; t < m["triangles"].size(); ++t)
        for (std::size_t i = 0; i < 3 && is_boundary(t); ++i) boundary.insert(edge(t, i));
    for (std::size_t t = 0; t < m["triangles"].size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            if (is_boundary(t) || m["parents"][t].size() != 1 || !boundary.contains(edge(t, i)))
                continue;
            const auto corner = [&](std::size_t k) {
                const Json& at = m["vertices"][m["triangles"][t][(i + k) % 3].get<std::size_t>()];
                return std::array{number_in(at[0]), number_in(at[1]), number_in(at[2])};
            };
            const auto a = corner(0), b = corner(1), inner = corner(2);
            Json point = Json::array({"", "", ""});
            for (std::size_t k = 0; k < 3; ++k)
                point[k] = decimal_text((a[k] + b[k]) / 2 + 2e-9 * ((a[k] + b[k]) / 2 - inner[k]));
            const Json& corners = m["triangles"][t];
            add_triangle(m, {corners[(i + 1) % 3], corners[i], m["vertices"].size()},
                         {m["parents"][t][0].get<int>()});
            m["vertices"].push_back(point);
            m["regions"].back() = {999};
            m["max_move"] = nullptr;
            m["deviation"] = decimal_text(1e-7);
            return;
        }
    FAIL("no edge of a surface is on the boundary");
}

} // namespace

TEST_CASE("cut certificates: a triangle of doubles outside is refused", "[volume_of_interest]") {
    Subject wrong = boxed_sheets();
    add_sliver_outside(wrong.certificate["rounded"], own_inputs(wrong));
    number_regions(wrong.certificate["rounded"], wrong.surfaces);
    wrong.certificate["outputs"] = Json::array();
    wrong.contents.clear();
    CHECK(judged(wrong, {.max_deviation = 1e-7}).find("R52") != std::string::npos);
}

TEST_CASE("cut certificates: volumes that no text can state are refused", "[volume_of_interest]") {
    const auto rule_of = [](Certificate certificate) {
        const auto verdict = verify_certificate(boxed_sheets().inputs, certificate);
        REQUIRE_FALSE(verdict.violations.empty());
        return verdict.violations.front().rule;
    };
    const auto parsed = parse_certificate(boxed_sheets().certificate.dump(), "c");
    REQUIRE(parsed);
    Certificate more_files = *parsed;
    more_files.cut->volume.files = 99;
    CHECK(rule_of(more_files) == Rule::R50_volume);
    Certificate nameless = *parsed;
    nameless.cut->volume.shape = "";
    CHECK(rule_of(nameless) == Rule::R50_volume);
    Certificate rotated = *parsed; // a box is a hexahedron, too, which has no polygon
    rotated.cut->volume.shape = "hexahedron";
    rotated.cut->volume.between.clear();
    CHECK(rule_of(rotated) == Rule::R50_volume);
    rotated.cut->volume.corners.clear();
    CHECK(verify_certificate(boxed_sheets().inputs, rotated).violations.empty());
}

TEST_CASE("cut certificates: a hexahedron is a box", "[volume_of_interest]") {
    std::mt19937_64 random(1);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    const auto is_accepted = [](const std::vector<Surface>& boundary) {
        verifier::Violations found;
        verifier::check_volume({"hexahedron", {}, {}, 0, boundary}, {}, found);
        return found.empty();
    };
    const auto changed = [](std::vector<Surface> boundary, const Point3& from, const auto& change) {
        for (Surface& s : boundary)
            for (Point3& p : s.vertices)
                if (p == from) change(p);
        return boundary;
    };
    for (int run = 0; run < 100; ++run) {
        const double far = run % 2 == 0 ? 1 : 1e7, thin = run % 3 == 0 ? 1e-3 : 1;
        const RotatedBox box{{far * number(-9, 9), far * number(-9, 9), number(-9, 9)},
                             run % 5 == 0,
                             {number(1, 9), thin * number(1, 9), number(1, 9)},
                             number(-360, 360),
                             number(-90, 90),
                             number(-90, 90)};
        const auto boundary = rotated_box_boundary(box);
        REQUIRE(boundary);
        CHECK(is_accepted(*boundary));
        const Point3 corner = boundary->front().vertices[run % 4];
        const double little = 1e-12 * far;
        CHECK_FALSE(is_accepted(changed(*boundary, corner, [&](Point3& p) { p.x += little; })));
        auto sheared = *boundary;
        for (Surface& s : sheared)
            for (Point3& p : s.vertices) p.y += 1000 * little * (p.x - corner.x);
        CHECK_FALSE(is_accepted(sheared));
    }
}
