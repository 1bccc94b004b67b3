// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The verifier's rules about tetrahedra: each kind of damage is refused, and sound ones are
// accepted.
#include "support/divided_models.hpp"
#include "support/effort.hpp"
#include "support/exact_numbers.hpp"
#include "support/tetrahedra_damage.hpp"

#include <limits>
#include <map>
#include <set>

#include <gmpxx.h>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra.hpp>

namespace tetrahedra_rules_test {

using namespace test_support;

namespace {

TetrahedraClaim claim_of(const TetrahedralMesh& m, bool box) {
    return {box, m.vertices, m.tetrahedra, m.block_of, m.faces, m.face_triangle, m.twins};
}

/// The data of a mesh by which the verifier judges tetrahedra.
struct Known {
    explicit Known(const Filled& f) :
        sides(f.volumes.of_sides), volumes(test_support::exact_numbers(f.mesh, f.volumes)) {}
    std::vector<verifier::BlockSides> sides;
    std::vector<mpq_class> volumes;
};

bool has_box(const Filled& f) {
    return f.tetrahedra.surfaces.size() > f.mesh.surfaces.size();
}

std::set<Rule> broken(const Filled& f, const Known& known, bool box) {
    verifier::Violations found;
    verifier::check_tetrahedra(claim_of(f.tetrahedra, box),
                               {f.mesh.vertices, f.mesh.triangles, known.sides, known.volumes},
                               found);
    std::set<Rule> rules;
    for (const Violation& v : found) rules.insert(v.rule);
    return rules;
}

/// The rule that a kind of damage breaks; none if it is about names, which a claim does not have.
std::optional<Rule> rule_of(TetrahedraDefect defect) {
    using D = TetrahedraDefect;
    const std::map<D, Rule> rules{{D::unusable_lists, Rule::R40_tetrahedra_lists},
                                  {D::doubled_node, Rule::R44_nodes},
                                  {D::wrong_twins, Rule::R48_cuts},
                                  {D::no_volume, Rule::R41_positive},
                                  {D::open_face, Rule::R42_faces},
                                  {D::crowded_face, Rule::R42_faces},
                                  {D::box_not_filled, Rule::R43_box},
                                  {D::missing_vertex, Rule::R44_nodes},
                                  {D::stray_face, Rule::R42_faces},
                                  {D::uncovered_triangle, Rule::R45_cover},
                                  {D::broken_outline, Rule::R45_cover},
                                  {D::torn_edge, Rule::R45_cover},
                                  {D::node_off_edge, Rule::R45_cover},
                                  {D::node_off_plane, Rule::R45_cover},
                                  {D::folded_faces, Rule::R45_cover},
                                  {D::wrong_block, Rule::R46_blocks},
                                  {D::wrong_volume, Rule::R47_block_volumes}};
    const auto rule = rules.find(defect);
    if (rule == rules.end()) return std::nullopt;
    return rule->second;
}

std::string names_of(const std::set<Rule>& rules) {
    std::string text;
    for (const Rule rule : rules) text += name_of(rule) + " ";
    return text;
}

std::size_t check_refused(const Filled& sound, const std::vector<Damage>& damage) {
    const Known known(sound);
    std::size_t count = 0;
    for (const Damage& kind : damage) {
        const auto rule = rule_of(kind.expected);
        if (!rule || (kind.needs_outside && !has_box(sound))) continue;
        INFO(kind.name);
        Filled f = sound;
        kind.inflict(f);
        if (f.volumes.of_sides != sound.volumes.of_sides) continue; // the verifier has its own
        const auto found = broken(f, known, has_box(sound));
        INFO(names_of(found));
        // Nothing is judged where nothing is left; and the outside has faces, but no tetrahedra.
        const bool otherwise = found.contains(
            f.tetrahedra.tetrahedra.empty() ? Rule::R40_tetrahedra_lists : Rule::R42_faces);
        CHECK((found.contains(*rule) ||
               (otherwise && (f.tetrahedra.tetrahedra.empty() || !has_box(sound)))));
        ++count;
    }
    return count;
}

void check_model(const Filled& f, const std::vector<Filled>& forms) {
    for (const auto& [form, tetrahedra] : forms_of(f)) {
        INFO(form);
        Filled other = f;
        other.tetrahedra = tetrahedra;
        CHECK(names_of(broken(other, Known(f), has_box(other))) == "");
    }
    std::size_t count = 0;
    for (const Filled& form : forms) {
        count += check_refused(form, damage_to_nodes());
        count += check_refused(form, damage_to_tetrahedra());
        count += check_refused(form, damage_to_attributes());
    }
    Filled cut = f;
    cut.tetrahedra = split_everywhere(f, f.tetrahedra);
    count += check_refused(cut, damage_to_cuts());
    CHECK(count > 60 * forms.size() / 2);
}

/// The longest edge at a node that was added on a triangle, times a share.
double share_of_edge(const Filled& f, std::uint32_t node, double share) {
    double longest = 0;
    const auto& v = f.tetrahedra.vertices;
    for (const Triangle& face : f.tetrahedra.faces)
        if (has_all(face, std::array{node}))
            for (const std::uint32_t other : face)
                longest =
                    std::max(longest, std::hypot(v[other].x - v[node].x, v[other].y - v[node].y,
                                                 v[other].z - v[node].z));
    return share * longest;
}

} // namespace

TEST_CASE("verifier: each kind of damage to tetrahedra is refused, on a cube", "[tetrahedra]") {
    const Filled f = tilted_cube();
    check_model(f, is_sanitized ? std::vector{blocks_of(f)} : std::vector{blocks_of(f), f});
}

TEST_CASE("verifier: each kind of damage to tetrahedra is refused, on a geological model",
          "[tetrahedra][once]") {
    const Filled f = geological_model();
    check_model(f, {blocks_of(f)});
}

TEST_CASE("verifier: each kind of damage to tetrahedra is refused, on faults",
          "[tetrahedra][once]") {
    const Filled f = faults();
    check_model(f, {f});
}

TEST_CASE("verifier: a node on a triangle that is off by a thousandth of an edge is refused",
          "[tetrahedra]") {
    const Filled sound = tilted_cube();
    const Known known(sound);
    for (const auto* nodes : {&sound.on_faces, &sound.on_edges})
        for (const std::uint32_t node : *nodes)
            for (const double share : {1e-3, -1e-3, 1e-6, 1e-12})
                for (double Point3::*coordinate : {&Point3::x, &Point3::y, &Point3::z}) {
                    Filled f = sound;
                    f.tetrahedra.vertices[node].*coordinate += share_of_edge(f, node, share);
                    CHECK(broken(f, known, true).contains(Rule::R45_cover));
                }
}

TEST_CASE("verifier: the volume of a block that is wrong by one part in 10^15 is refused",
          "[tetrahedra]") {
    const Filled sound = fill({box({0, 0, 0}, {4, 4, 4}, "cube")});
    Known known(sound);
    CHECK(broken(sound, known, true).empty());
    known.volumes[1] += known.volumes[1] / mpq_class("1000000000000000");
    CHECK(names_of(broken(sound, known, true)) == "R47 ");
}

TEST_CASE("verifier: tetrahedra that fill their box twice are refused by its volume alone",
          "[tetrahedra]") {
    using Four = std::array<std::uint32_t, 4>;
    TetrahedraClaim claim{true, {}, {}, {}, {}, {}, {}};
    for (const double z : {0, 1})
        for (const double y : {0, 1})
            for (const double x : {0, 1}) claim.vertices.push_back({x, y, z});
    const auto volume = [&](const Four& t) {
        const auto from_first = [&](std::size_t k) {
            return minus(claim.vertices[t[k]], claim.vertices[t[0]]);
        };
        return dot(cross(from_first(1), from_first(2)), from_first(3));
    };
    const auto on_side = [](const Triangle& t) {
        const std::uint32_t all = t[0] & t[1] & t[2], any = t[0] | t[1] | t[2];
        return all != 0 || any != 7;
    };
    const auto add = [&](Four t) {
        if (volume(t) < 0) std::swap(t[0], t[1]);
        claim.tetrahedra.push_back(t);
        claim.block_of.push_back(0);
        for (std::size_t k = 0; k < 4; ++k) {
            Triangle face{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
            if (!on_side(face)) continue;
            if (volume({face[0], face[1], face[2], t[k]}) > 0) std::swap(face[0], face[1]);
            claim.faces.push_back(face);
            claim.triangle_of.push_back(verifier::no_number);
        }
    };
    const std::vector<mpq_class> volumes(1);
    const auto rules = [&] {
        verifier::Violations found;
        verifier::check_tetrahedra(claim, {{}, {}, {}, volumes}, found);
        std::set<Rule> broken;
        for (const Violation& v : found) broken.insert(v.rule);
        return names_of(broken);
    };
    // The cube's corners with an even number of ones, and at each other corner the rest.
    for (const Four& t :
         {Four{0, 3, 5, 6}, Four{1, 0, 3, 5}, Four{2, 0, 3, 6}, Four{4, 0, 5, 6}, Four{7, 3, 5, 6}})
        add(t);
    CHECK(rules().empty());
    // The other corners: the sides of the cube are divided by their other diagonals.
    for (const Four& t :
         {Four{1, 2, 4, 7}, Four{0, 1, 2, 4}, Four{3, 1, 2, 7}, Four{5, 1, 4, 7}, Four{6, 2, 4, 7}})
        add(t);
    CHECK(rules() == "R43 ");
}

TEST_CASE("verifier: what is within reach of a triangle depends on its coordinates only") {
    const std::array<Point3, 3> t{Point3{0, 0, 1}, Point3{4, 0, 1}, Point3{0, 3, 1}};
    // Spacings: 2^-50, 2^-51 and 2^-52; five are allowed, along z with twice the others. The reach
    // is the length of (5 * 2^-50, 5 * 2^-51, 5 * (2^-52 + 2 * 2^-50 + 2 * 2^-51)).
    const double e = 5 * 0x1p-52;
    const double reach = std::hypot(4 * e, 2 * e, e + 8 * e + 4 * e);
    const double volume = 2 * reach * 6;
    const double bound = verifier::volume_within_reach(t).get_d();
    CHECK(bound >= volume);
    CHECK(bound <= volume * (1 + 1e-9));
}

TEST_CASE("verifier: the double nearest to a fraction, of two the even one", "[verify]") {
    using verifier::nearest_double;
    constexpr double largest = std::numeric_limits<double>::max();
    CHECK(nearest_double(mpq_class(1, 3)) == 1.0 / 3);
    CHECK(nearest_double(mpq_class("9007199254740993")) == 0x1p53);     // 2^53 + 1
    CHECK(nearest_double(mpq_class("9007199254740995")) == 0x1p53 + 4); // 2^53 + 3
    CHECK(nearest_double(mpq_class("-9007199254740995")) == -0x1p53 - 4);
    const mpz_class limit = mpz_class(largest) + (mpz_class(1) << 970);
    CHECK(nearest_double(mpq_class(mpz_class(limit - 1))) == largest);
    CHECK(nearest_double(mpq_class(mpz_class(-limit))) == -std::numeric_limits<double>::infinity());
}

} // namespace tetrahedra_rules_test
