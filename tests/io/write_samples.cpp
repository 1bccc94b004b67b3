// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writes files for read_back.py, which opens them with VTK and gmsh. The cases are hidden: they run
// only by their tag.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include <nlohmann/json.hpp>

#include <terrane/io/files.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;
using nlohmann::json;

namespace {

/// Makes a mesh large enough for several compressed blocks.
Mesh waves(std::uint32_t n) {
    Mesh mesh;
    mesh.surfaces = {{"waves", Role::horizon}};
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            mesh.vertices.push_back({500000 + i * 12.3, 4200000 + j * 7.1, std::sin(i * 0.1 + j)});
    const std::vector<std::uint32_t> first{0};
    for (std::uint32_t i = 0; i + 1 < n; ++i)
        for (std::uint32_t j = 0; j + 1 < n; ++j) {
            const auto a = i * n + j;
            mesh.triangles.push_back({a, a + 1, a + n});
            mesh.triangles.push_back({a + 1, a + n + 1, a + n});
            mesh.surfaces_of.push_back(first);
            mesh.surfaces_of.push_back(first);
        }
    return mesh;
}

template <class T>
json lists_json(const IndexLists<T>& lists) {
    auto result = json::array();
    for (std::size_t i = 0; i < lists.size(); ++i)
        result.push_back(std::vector<T>(lists[i].begin(), lists[i].end()));
    return result;
}

template <class AnyMesh>
json common_json(const AnyMesh& mesh) {
    json result;
    for (const auto& surface : mesh.surfaces) result["names"].push_back(surface.name);
    for (const auto& p : mesh.vertices) result["points"].push_back({p.x, p.y, p.z});
    result["surfaces_of"] = lists_json(mesh.surfaces_of);
    return result;
}

json to_json(const Mesh& mesh) {
    auto result = common_json(mesh);
    result["cells"] = mesh.triangles;
    result["regions_of"] = lists_json(mesh.regions_of);
    result["parents_of"] = lists_json(mesh.parents_of);
    return result;
}

json to_json(const TetrahedralMesh& mesh) {
    auto result = common_json(mesh);
    result["cells"] = mesh.tetrahedra;
    result["faces"] = mesh.faces;
    result["block_of"] = mesh.block_of;
    result["twins"] = mesh.twins;
    return result;
}

template <class AnyMesh>
void save(const std::filesystem::path& folder, const std::string& name, const AnyMesh& mesh,
          const std::string& vtk) {
    const auto write = [&](const std::string& file, const WriteOptions& options) {
        if constexpr (std::is_same_v<AnyMesh, Mesh>)
            CHECK(message_of(write_mesh(mesh, folder / file, options)) == "no error");
        else
            CHECK(message_of(write_tetrahedra(mesh, folder / file, options)) == "no error");
    };
    write(name + vtk, {});
    write(name + "_plain" + vtk, {.compress = false});
    if (vtk == ".vtp") write(name + ".vtk", {});
    write(name + ".msh", {});
    write(name + "_22.msh", {.format = Format::msh22});
    write(name + ".mesh", {});
    write(name + ".inp", {});
    write(name + ".unv", {});
    if constexpr (std::is_same_v<AnyMesh, TetrahedralMesh>) write(name + ".f3grid", {});
    std::ofstream(folder / (name + ".json")) << to_json(mesh);
}

} // namespace

TEST_CASE("samples for other programs", "[.samples]") {
    const char* folder = std::getenv("TERRANE_SAMPLES");
    REQUIRE(folder != nullptr);
    save(folder, "awkward", awkward_mesh(), ".vtp");
    save(folder, "grid", waves(220), ".vtp");
    save(folder, "tetrahedra", two_tetrahedra(), ".vtu");
    save(folder, "cut", cut_tetrahedra(), ".vtu");
}
