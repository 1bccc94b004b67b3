// SPDX-License-Identifier: LGPL-3.0-or-later
#include "models.hpp"

#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/io/files.hpp>

#include "paper_models.hpp"

namespace bench {
namespace {

using namespace terrane;
using Surfaces = std::vector<Surface>;

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
