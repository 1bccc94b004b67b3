// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tetrahedra made without Terrane: a lattice of cubes, each divided into six around its diagonal. Its surfaces are
// some of the faces, so what is right and what is damaged is known by how it is made.
#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace terrane;
using Corners = std::array<std::uint32_t, 4>;

constexpr unsigned cubes = 5; ///< along each axis

/// Lattice points.
using Place = std::array<unsigned, 3>;

std::uint32_t node(const Place& p) {
    return (p[2] * (cubes + 1) + p[1]) * (cubes + 1) + p[0];
}
Place place(std::uint32_t node) {
    return {node % (cubes + 1), node / (cubes + 1) % (cubes + 1), node / (cubes + 1) / (cubes + 1)};
}

/// Tetrahedra, and the surfaces that they fill.
struct Filled {
    LabelledTetrahedra made;
    std::vector<Surface> inputs;
};

/// The cube in the upper block that is a block of its own.
bool in_body(const Place& cube) {
    return cube == Place{3, 3, 3};
}

/// Three blocks: below the horizon at 2, above it, and the body; a fault ends within the upper one. `at` places a point
/// of the lattice.
Filled lattice(const std::function<Point3(double, double, double)>& at) {
    Filled f;
    for (std::uint32_t v = 0; v < (cubes + 1) * (cubes + 1) * (cubes + 1); ++v) {
        const auto [i, j, k] = place(v);
        f.made.vertices.push_back(at(i, j, k));
    }
    std::map<Triangle, std::vector<std::uint32_t>> sides;
    for (unsigned c = 0; c < cubes * cubes * cubes; ++c) {
        const Place cube{c % cubes, c / cubes % cubes, c / cubes / cubes};
        std::array<unsigned, 3> axes{0, 1, 2};
        do {
            Corners corners{node(cube), 0, 0, 0};
            Place p = cube;
            for (unsigned step = 0; step < 3; ++step) {
                ++p[axes[step]];
                corners[step + 1] = node(p);
            }
            const bool even = (axes[1] + 3 - axes[0]) % 3 == 1;
            if (!even) std::swap(corners[2], corners[3]);
            const auto t = static_cast<std::uint32_t>(f.made.tetrahedra.size());
            f.made.tetrahedra.push_back(corners);
            f.made.labels.push_back(in_body(cube) ? 7 : cube[2] < 2 ? 4 : 9);
            for (unsigned left = 0; left < 4; ++left) {
                Triangle face{corners[(left + 1) % 4], corners[(left + 2) % 4],
                              corners[(left + 3) % 4]};
                std::ranges::sort(face);
                sides[face].push_back(t);
            }
        } while (std::next_permutation(axes.begin(), axes.end()));
    }
    f.inputs = {{"boundary", Role::boundary, f.made.vertices, {}},
                {"blocks", Role::horizon, f.made.vertices, {}},
                {"fault", Role::fault, f.made.vertices, {}}};
    for (const auto& [face, at_face] : sides) {
        const auto all = [&face = face](auto holds) { return std::ranges::all_of(face, holds); };
        if (at_face.size() == 1)
            f.inputs[0].triangles.push_back(face);
        else if (f.made.labels[at_face[0]] != f.made.labels[at_face[1]])
            f.inputs[1].triangles.push_back(face);
        else if (all([](std::uint32_t v) {
                     const Place p = place(v);
                     return p[0] == 1 && p[1] >= 1 && p[1] <= 3 && p[2] >= 3 && p[2] <= 4;
                 }))
            f.inputs[2].triangles.push_back(face);
    }
    return f;
}

/// A lattice without two faces in one plane.
Filled bent() {
    return lattice([](double x, double y, double z) {
        return Point3{x + 0.05 * std::sin(3 * y + 5 * z), y + 0.06 * std::sin(4 * x + z),
                      z + 0.07 * std::sin(2 * x + 6 * y)};
    });
}

/// A lattice whose surfaces are large triangles. Their corners are exact, and the nodes between these are rounded off
/// their planes.
Filled flat() {
    const auto turn = [](double x, double y, double z) {
        const auto part = [](double share, double at) {
            return std::round(share * 0x1p26) * 0x1p-26 * at;
        };
        return Point3{part(0.48, x) + part(-0.6, y) + part(0.64, z),
                      part(0.36, x) + part(0.8, y) + part(0.48, z), part(-0.8, x) + part(0.6, z)};
    };
    Filled f = lattice([&](double x, double y, double z) {
        return turn(x == 2 ? 2.1 : x, y == 2 ? 2.1 : y, z == 1 ? 0.9 : z);
    });
    const auto box = [&](const Point3& low, const Point3& high) {
        Surface s{"box", Role::boundary, {}, {}};
        for (unsigned i = 0; i < 8; ++i)
            s.vertices.push_back(turn((i & 1U) != 0 ? high.x : low.x,
                                      (i & 2U) != 0 ? high.y : low.y,
                                      (i & 4U) != 0 ? high.z : low.z));
        s.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
        return s;
    };
    const auto sheet = [&](const std::array<Point3, 4>& p) {
        Surface s{"sheet", Role::unknown, {}, {{0, 1, 2}, {0, 2, 3}}};
        for (const auto& [x, y, z] : p) s.vertices.push_back(turn(x, y, z));
        return s;
    };
    f.inputs = {box({0, 0, 0}, {5, 5, 2}), box({0, 0, 2}, {5, 5, 5}), box({3, 3, 3}, {4, 4, 4}),
                sheet({Point3{1, 1, 3}, {1, 3, 3}, {1, 3, 4}, {1, 1, 4}})};
    return f;
}

MeshJudgement judged(const Filled& f) {
    const auto found = judge(f.made, f.inputs);
    INFO((found ? std::string() : found.error().message()));
    REQUIRE(found);
    return *found;
}

/// A damage to the bent lattice, and the property that it breaks.
struct Damage {
    std::string name, breaks;
    std::function<void(Filled&)> make;
};

/// Returns the first tetrahedron in a cube.
std::uint32_t in_cube(const Place& p) {
    return 6 * ((p[2] * cubes + p[1]) * cubes + p[0]);
}
void remove(Filled& f, std::uint32_t t) {
    f.made.tetrahedra.erase(f.made.tetrahedra.begin() + t);
    f.made.labels.erase(f.made.labels.begin() + t);
}
void add(Filled& f, const Corners& corners, std::uint32_t label) {
    f.made.tetrahedra.push_back(corners);
    f.made.labels.push_back(label);
}
std::uint32_t add(Filled& f, const Point3& p) {
    f.made.vertices.push_back(p);
    return static_cast<std::uint32_t>(f.made.vertices.size() - 1);
}
/// Gives a tetrahedron vertices of its own.
void detach(Filled& f, std::uint32_t t, double by) {
    for (std::uint32_t& v : f.made.tetrahedra[t]) {
        const Point3 p = f.made.vertices[v];
        v = add(f, {p.x, p.y, p.z + by});
    }
}
Point3 middle(const Filled& f, std::uint32_t u, std::uint32_t w) {
    const Point3 &p = f.made.vertices[u], &q = f.made.vertices[w];
    return {(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2};
}
/// Divides a tetrahedron, but not its neighbours, at the middle of an edge.
void divide(Filled& f, std::uint32_t t, unsigned i, unsigned j) {
    const Corners whole = f.made.tetrahedra[t];
    const std::uint32_t m = add(f, middle(f, whole[i], whole[j]));
    Corners half = whole;
    half[i] = m;
    f.made.tetrahedra[t][j] = m;
    add(f, half, f.made.labels[t]);
}
void relabel(Filled& f, std::uint32_t from, std::uint32_t to, std::size_t every = 1) {
    for (std::size_t t = 0; t < f.made.labels.size(); t += every)
        if (f.made.labels[t] == from) f.made.labels[t] = to;
}

constexpr std::uint32_t inner =
    6 * ((1 * cubes + 2) * cubes + 2); ///< in the lower block, at no surface
const std::uint32_t inner_node = node({2, 2, 1}), horizon_node = node({2, 2, 2}),
                    fault_node = node({1, 2, 4});

std::vector<Damage> damages() {
    return {
        {"a tetrahedron inside is missing", "coverage", [](Filled& f) { remove(f, inner); }},
        {"a tetrahedron at the boundary is missing", "coverage", [](Filled& f) { remove(f, 0); }},
        {"a tetrahedron of the body is missing", "coverage",
         [](Filled& f) {
             remove(f, in_cube({3, 3, 3}));
         }},
        {"a tetrahedron at the horizon is missing", "volume",
         [](Filled& f) {
             remove(f, in_cube({2, 2, 2}));
         }},
        {"a block is missing", "volume",
         [](Filled& f) {
             for (std::uint32_t t = 0; t < 6; ++t) remove(f, in_cube({3, 3, 3}));
         }},
        {"a tetrahedron is there twice", "conforming",
         [](Filled& f) { add(f, f.made.tetrahedra[inner], 4); }},
        {"a block is there twice, with vertices of its own", "conforming",
         [](Filled& f) {
             for (std::uint32_t t = in_cube({3, 3, 3}), k = 0; k < 6; ++k) {
                 add(f, f.made.tetrahedra[t + k], 7);
                 detach(f, static_cast<std::uint32_t>(f.made.tetrahedra.size()) - 1, 0);
             }
         }},
        {"a tetrahedron is turned inside out", "positive",
         [](Filled& f) { std::swap(f.made.tetrahedra[inner][0], f.made.tetrahedra[inner][1]); }},
        {"a tetrahedron names a node twice", "positive",
         [](Filled& f) { f.made.tetrahedra[inner][0] = f.made.tetrahedra[inner][1]; }},
        {"a node is moved through its neighbours", "positive",
         [](Filled& f) { f.made.vertices[inner_node].x += 2; }},
        {"two nodes are exchanged", "positive",
         [](Filled& f) {
             std::swap(f.made.vertices[inner_node], f.made.vertices[node({3, 2, 1})]);
         }},
        {"a node is moved onto a face", "positive",
         [](Filled& f) {
             f.made.vertices[f.made.tetrahedra[inner][0]] =
                 f.made.vertices[f.made.tetrahedra[inner][1]];
         }},
        {"a wrong node is named", "coverage",
         [](Filled& f) {
             f.made.tetrahedra[inner][0] = node({0, 0, 0});
         }},
        {"a node of the horizon is moved", "vertices",
         [](Filled& f) { f.made.vertices[horizon_node].z += 1e-6; }},
        {"a node of the horizon is moved by 1e-12", "vertices",
         [](Filled& f) { f.made.vertices[horizon_node].z += 1e-12; }},
        {"a node at the border of the fault is moved", "vertices",
         [](Filled& f) { f.made.vertices[fault_node].x += 1e-3; }},
        {"all is moved", "vertices",
         [](Filled& f) {
             for (Point3& p : f.made.vertices) p.y += 1e-9;
         }},
        {"all is larger", "volume",
         [](Filled& f) {
             for (Point3& p : f.made.vertices) p = {p.x * 1.001, p.y * 1.001, p.z * 1.001};
         }},
        {"a tetrahedron has vertices of its own", "welded", [](Filled& f) { detach(f, inner, 0); }},
        {"a node is there twice, away from surfaces", "welded",
         [](Filled& f) {
             const std::uint32_t again = add(f, f.made.vertices[inner_node]);
             auto& corners = f.made.tetrahedra[inner];
             std::ranges::replace(corners, f.made.tetrahedra[inner][1], again);
             f.made.vertices[again] = f.made.vertices[Filled(bent()).made.tetrahedra[inner][1]];
         }},
        {"a tetrahedron is detached by 1e-9", "coverage",
         [](Filled& f) { detach(f, inner, 1e-9); }},
        {"a tetrahedron is detached by less than the bound", "coverage",
         [](Filled& f) { detach(f, inner, 0x1p-50); }},
        {"a tetrahedron has another label", "labels", [](Filled& f) { f.made.labels[inner] = 9; }},
        {"a tetrahedron at a surface has the label of the other side", "labels",
         [](Filled& f) {
             f.made.labels[in_cube({2, 2, 2})] = 4;
         }},
        {"two blocks have one label", "labels", [](Filled& f) { relabel(f, 7, 9); }},
        {"all blocks have one label", "labels",
         [](Filled& f) {
             relabel(f, 7, 9);
             relabel(f, 4, 9);
         }},
        {"a block has two labels", "labels", [](Filled& f) { relabel(f, 9, 11, 2); }},
        {"an edge inside is divided in one tetrahedron alone", "conforming",
         [](Filled& f) { divide(f, inner, 0, 3); }},
        {"an edge of the boundary is divided in one tetrahedron alone", "conforming",
         [](Filled& f) { divide(f, 0, 0, 1); }},
        {"a tetrahedron lies outside", "coverage",
         [](Filled& f) {
             const std::uint32_t apex = add(f, {0.4, 0.4, -1});
             Triangle face{};
             for (const Triangle& t : f.inputs[0].triangles)
                 if (std::ranges::all_of(t, [](std::uint32_t v) { return place(v)[2] == 0; }))
                     face = t;
             const auto& p = f.made.vertices;
             const bool up = (p[face[1]].x - p[face[0]].x) * (p[face[2]].y - p[face[0]].y) >
                             (p[face[1]].y - p[face[0]].y) * (p[face[2]].x - p[face[0]].x);
             add(f,
                 up ? Corners{face[0], face[2], face[1], apex}
                    : Corners{face[0], face[1], face[2], apex},
                 4);
         }},
        {"a small tetrahedron lies within another one", "coverage",
         [](Filled& f) {
             const Corners around = f.made.tetrahedra[inner];
             Corners small{};
             const Point3 centre = middle(f, add(f, middle(f, around[0], around[1])),
                                          add(f, middle(f, around[2], around[3])));
             for (unsigned i = 0; i < 4; ++i)
                 small[i] = add(f, middle(f, around[i], add(f, centre)));
             add(f, small, 4);
         }},
        {"a surface has a triangle that is no face", "coverage",
         [](Filled& f) {
             f.inputs[2].triangles.push_back({node({2, 2, 3}), node({2, 3, 3}), node({1, 2, 5})});
         }},
        {"a surface has the other diagonal", "coverage",
         [](Filled& f) { // of the square from (2, 2) at the horizon
             auto& triangles = f.inputs[1].triangles;
             const auto a = node({2, 2, 2}), b = node({3, 2, 2}), c = node({3, 3, 2}),
                        d = node({2, 3, 2});
             std::erase_if(triangles, [&](const Triangle& t) {
                 return std::ranges::count(t, a) != 0 && std::ranges::count(t, c) != 0 &&
                        (std::ranges::count(t, b) != 0 || std::ranges::count(t, d) != 0);
             });
             triangles.push_back({a, b, d});
             triangles.push_back({b, c, d});
         }},
        {"there is another surface", "curves",
         [](Filled& f) {
             f.inputs.push_back(
                 {"wall", Role::fault, {{2.5, -1, -1}, {2.5, 9, -1}, {2.5, 2, 9}}, {{0, 1, 2}}});
         }},
        {"there are no tetrahedra", "coverage", [](Filled& f) { f.made = {}; }},
    };
}

} // namespace

TEST_CASE("judge: tetrahedra that fill their blocks hold, and each damage is found by the property "
          "that it breaks") {
    const auto whole = judged(bent());
    INFO(whole.failures());
    REQUIRE(whole.holds());
    REQUIRE(whole.complete());
    CHECK(whole.properties.size() == 9);
    CHECK(damages().size() >= 30);
    for (const Damage& damage : damages()) {
        Filled f = bent();
        damage.make(f);
        const auto found = judged(f);
        INFO(damage.name << ": " << found.failures());
        const JudgedProperty* property = found.find(damage.breaks);
        REQUIRE(property != nullptr);
        CHECK(property->verdict == PropertyVerdict::fails);
        CHECK(property->count >= property->flaws.size());
        for (const JudgedProperty& p : found.properties)
            for (const PropertyFlaw& flaw : p.flaws)
                for (const std::uint32_t t : flaw.triangles) CHECK(t < f.made.tetrahedra.size());
    }
}

TEST_CASE("judge: tetrahedra may divide flat regions, and be rounded off them") {
    const auto whole = judged(flat());
    INFO(whole.failures());
    CHECK(whole.holds());
    CHECK(whole.complete());
    std::size_t off = 0; // the plane of the horizon
    const Filled given = flat();
    const auto& p = given.made.vertices;
    for (unsigned i = 0; i <= cubes; ++i)
        off += orient3d(p[node({0, 0, 2})], p[node({5, 0, 2})], p[node({0, 5, 2})],
                        p[node({i, 2, 2})]) != Sign::Zero;
    CHECK(off > 2);
    for (const auto& [t, property] : {std::pair{0U, "coverage"}, std::pair{inner, "coverage"}}) {
        Filled f = flat();
        remove(f, t);
        CHECK(judged(f).find(property)->verdict == PropertyVerdict::fails);
    }
    Filled f = flat();
    f.made.vertices[horizon_node].x += 1e-9;
    CHECK(!judged(f).holds());
}

TEST_CASE("judge: what tetrahedra may be") {
    SECTION("wound the other way, all of them") {
        Filled f = bent();
        for (auto& corners : f.made.tetrahedra) std::swap(corners[0], corners[1]);
        CHECK(judged(f).failures().empty());
    }
    SECTION("without labels") {
        Filled f = bent();
        f.made.labels.clear();
        const auto found = judged(f);
        CHECK(found.failures().empty());
        CHECK(found.find("labels") == nullptr);
    }
    SECTION("with other numbers for blocks") {
        Filled f = bent();
        relabel(f, 7, 0);
        relabel(f, 4, 7);
        CHECK(judged(f).failures().empty());
    }
    SECTION("torn along a surface") {
        Filled f = bent();
        for (std::uint32_t t = 0; t < f.made.tetrahedra.size(); ++t)
            if (f.made.labels[t] == 4) detach(f, t, 0);
        CHECK(judged(f).failures().find("welded") == 0);
        f = bent();
        std::map<std::uint32_t, std::uint32_t> again;
        for (std::uint32_t t = 0; t < f.made.tetrahedra.size(); ++t)
            for (std::uint32_t& v : f.made.tetrahedra[t])
                if (f.made.labels[t] == 4) {
                    const auto [copy, added] = again.try_emplace(v, 0);
                    if (added) copy->second = add(f, f.made.vertices[v]);
                    v = copy->second;
                }
        CHECK(judged(f).failures().empty());
    }
    SECTION("outside of the blocks, up to a box round all") {
        Filled f = bent();
        f.inputs = {f.inputs[1]};
        std::erase_if(f.inputs[0].triangles, [](const Triangle& t) { // but those of the body
            return std::ranges::any_of(t, [](std::uint32_t v) { return place(v)[2] == 2; });
        });
        for (std::uint32_t v = 0; v < f.made.vertices.size(); ++v) { // straight sides
            const auto [i, j, k] = place(v);
            const auto is_outer = [](unsigned x) { return x == 0 || x == cubes; };
            if (is_outer(i) || is_outer(j) || is_outer(k))
                f.made.vertices[v] = {1. * i, 1. * j, 1. * k};
        }
        relabel(f, 4, 9);
        CHECK(judged(f).failures().empty());
        remove(f, 0);
        CHECK(judged(f).failures().find("coverage") != std::string::npos);
    }
}

TEST_CASE(
    "judge: a tetrahedron that rounding leaves between two layers of faces is of either side") {
    constexpr double spacing = 0x1p-52;
    const std::vector<Point3> corners{{0, 0, 0}, {1, 0, 0},     {1, 1, 0},
                                      {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
    Filled f;
    f.inputs = {
        {"hull",
         Role::boundary,
         corners,
         {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}},
        {"sheet", Role::horizon, corners, {{0, 1, 2}, {0, 2, 3}}}};
    f.made = {corners, {{0, 1, 2, 4}, {0, 2, 3, 4}, {1, 0, 3, 5}, {2, 1, 3, 5}, {1, 0, 2, 3}}, {}};
    f.made.vertices[0].z = f.made.vertices[2].z = spacing;
    for (const std::uint32_t between : {1U, 2U})
        for (const bool turned : {false, true}) {
            f.made.labels = {1, 1, 2, 2, between};
            for (Triangle& t : f.inputs[1].triangles)
                if (turned) std::swap(t[0], t[1]);
            const auto found = judged(f);
            INFO(found.failures());
            CHECK(found.holds());
            CHECK(found.complete());
        }
    f.made.tetrahedra.pop_back();
    f.made.labels.pop_back();
    CHECK(!judged(f).holds());
}

TEST_CASE("judge: tetrahedra that are none are errors") {
    Filled f = bent();
    f.made.tetrahedra[3][2] = 5000;
    CHECK(judge(f.made, f.inputs).error().code == ErrorCode::bad_index);
    f = bent();
    f.made.labels.pop_back();
    CHECK(judge(f.made, f.inputs).error().place == "labels");
    f = bent();
    f.made.vertices[0].x = NAN;
    CHECK(judge(f.made, f.inputs).error().code == ErrorCode::bad_number);
    JudgeOptions options;
    options.operation = BooleanOperation::unite;
    CHECK(judge(bent().made, bent().inputs, options).error().place == "operation");
}
