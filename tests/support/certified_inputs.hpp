// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The inputs of tests/certified that are a single OBJ file, as models for testing laws.
#pragma once

#include "support/paths.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <terrane/io/files.hpp>

namespace test_support {

struct Model {
    std::string name;
    std::vector<terrane::Surface> surfaces;
};

/// Returns the models with at most `most` triangles, by name.
inline std::vector<Model> certified_inputs(std::size_t most = 1000) {
    const auto folder = std::filesystem::path(test_support::source_dir()) / "tests" / "certified";
    std::vector<Model> models;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const auto file = entry.path() / "input.obj";
        if (!std::filesystem::exists(file)) continue;
        auto surfaces = terrane::read_surfaces(file);
        REQUIRE(surfaces);
        std::size_t triangles = 0;
        for (const auto& s : surfaces.value()) triangles += s.triangles.size();
        if (triangles > most) continue;
        models.push_back({entry.path().filename().string(), std::move(surfaces.value())});
    }
    std::sort(models.begin(), models.end(),
              [](const Model& a, const Model& b) { return a.name < b.name; });
    REQUIRE(models.size() >= 60);
    return models;
}

} // namespace test_support
