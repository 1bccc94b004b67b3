// SPDX-License-Identifier: LGPL-3.0-or-later
#include "models.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/io/files.hpp>

#include "paper_models.hpp"
#include "support/thin_solids.hpp"

namespace bench {
namespace {

using namespace terrane;
using Surfaces = std::vector<Surface>;

/// Returns a ball of radius 100 that faces outwards, of 8 n^2 triangles: a divided octahedron.
Surface ball(const Point3& centre, int n, std::string name) {
    Surface s{std::move(name), Role::boundary, {}, {}};
    std::map<std::array<int, 3>, std::uint32_t> numbers;
    const auto vertex = [&](const std::array<int, 3>& p) {
        const auto [at, is_new] =
            numbers.try_emplace(p, static_cast<std::uint32_t>(s.vertices.size()));
        const double scale = 100 / std::hypot(p[0], p[1], p[2]);
        if (is_new)
            s.vertices.push_back(
                {centre.x + scale * p[0], centre.y + scale * p[1], centre.z + scale * p[2]});
        return at->second;
    };
    for (unsigned octant = 0; octant < 8; ++octant) {
        const auto sign = [&](unsigned axis) { return (octant >> axis & 1U) != 0 ? -1 : 1; };
        const auto at = [&](int i, int j) {
            return vertex({sign(0) * i, sign(1) * j, sign(2) * (n - i - j)});
        };
        const bool turns = sign(0) * sign(1) * sign(2) < 0;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            s.triangles.push_back(turns ? Triangle{a, c, b} : Triangle{a, b, c});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
    }
    return s;
}

const std::map<std::string, std::function<Surfaces()>>& makers() {
    using namespace models;
    static const std::map<std::string, std::function<Surfaces()>> all{
        {"pair1_7k", [] { return pair_1(r7k); }},
        {"pair1_68k", [] { return pair_1(r68k); }},
        {"pair1_680k", [] { return pair_1(r680k); }},
        {"pair1_6800k", [] { return pair_1(r6800k); }},
        {"pair2_7k", [] { return pair_2(r7k); }},
        {"pair2_68k", [] { return pair_2(r68k); }},
        {"pair2_680k", [] { return pair_2(r680k); }},
        {"pair2_6800k", [] { return pair_2(r6800k); }},
        {"nonuniform1", nonuniform_1},
        {"nonuniform2", nonuniform_2},
        {"rectangles_100", [] { return random_squares(rectangles_100); }},
        {"rectangles_1000", [] { return random_squares(rectangles_1000); }},
        {"balls_160k",
         [] {
             return Surfaces{ball({0, 0, 0}, 100, "a"), ball({61, 31, 17}, 100, "b")};
         }},
        {"loft_20k", [] { return Surfaces{thin_solids::solid("loft", 20000)}; }},
        {"extrusion_20k", [] { return Surfaces{thin_solids::solid("extrusion", 20000)}; }},
        {"fans_1000k", [] { return Surfaces{thin_solids::solid("fans", 1000000)}; }},
        {"thread_1000k", [] { return Surfaces{thin_solids::solid("thread", 1000000)}; }},
    };
    return all;
}

Model united(Surfaces surfaces) {
    Model m;
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        const auto base = static_cast<std::uint32_t>(m.points.size());
        m.points.insert(m.points.end(), surfaces[s].vertices.begin(), surfaces[s].vertices.end());
        for (const Triangle& t : surfaces[s].triangles)
            m.triangles.push_back({base + t[0], base + t[1], base + t[2]});
        m.groups.resize(m.triangles.size(), s);
    }
    m.boxes = boxes_of(m.points, m.triangles);
    m.surfaces = std::move(surfaces);
    return m;
}

Surfaces read(const std::string& file) {
    auto surfaces = read_surfaces(file, std::nullopt, {});
    if (!surfaces) throw std::runtime_error(surfaces.error().message());
    return std::move(surfaces).value();
}

} // namespace

const Model& model(const std::string& name) {
    static std::string kept;
    static Model m;
    if (kept != name) {
        m = {};
        const auto made = makers().find(name);
        m = united(made != makers().end() ? made->second() : read(name));
        kept = name;
    }
    return m;
}

} // namespace bench
