// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/universal.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/meshes/detail/face_groups.hpp>
#include <terrane/io/meshes/detail/side_sets.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr int thin_shell = 91, solid_tetrahedron = 111; ///< linear elements
constexpr std::size_t most_name = 40;                   ///< bytes of the name of a group

/// A group of elements, which are counted from 1.
struct ElementGroup {
    std::string name;
    std::vector<std::uint64_t> elements;
};

/// Cuts names to 40 bytes. One that is cut gets its number, so that no two are the same.
std::vector<ElementGroup> with_short_names(std::vector<ElementGroup> groups) {
    for (std::size_t g = 0; g < groups.size(); ++g) {
        std::string& name = groups[g].name;
        if (name.size() <= most_name) continue;
        const auto ending = fmt::format("~{}", g + 1); // no word has a '~'
        std::size_t end = most_name - ending.size();   // not within a character of several bytes
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
        name.resize(end);
        name += ending;
    }
    return groups;
}

class UniversalWriter {
public:
    void add_nodes(const std::vector<Point3>& vertices) {
        out_ += "    -1\n  2411\n";
        for (std::size_t v = 0; v < vertices.size(); ++v) {
            const Point3& p = vertices[v];
            auto place = fmt::format("{:25.16E}{:25.16E}{:25.16E}\n", p.x, p.y, p.z);
            std::ranges::replace(place, 'E', 'D');
            out_ += fmt::format("{:10}{:10}{:10}{:10}\n", v + 1, 1, 1, 11) + place;
        }
        out_ += "    -1\n    -1\n  2412\n";
    }

    template <class Cells>
    void add_elements(int type, const Cells& cells, std::uint64_t property) {
        for (const auto& cell : cells) {
            out_ += fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}\n", ++elements_, type, property,
                                property, 7, cell.size());
            for (const auto v : cell) out_ += fmt::format("{:10}", std::uint64_t(v) + 1);
            out_ += '\n';
        }
    }

    std::string with_groups(const std::vector<ElementGroup>& groups) {
        constexpr int finite_element = 8;
        out_ += "    -1\n    -1\n  2467\n";
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const auto& [name, members] = groups[g];
            out_ += fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}{:10}{:10}\n{}\n", g + 1, 0, 0, 0, 0,
                                0, 0, members.size(), name);
            for (std::size_t i = 0; i < members.size(); ++i) {
                out_ += fmt::format("{:10}{:10}{:10}{:10}", finite_element, members[i], 0, 0);
                if (i % 2 == 1 || i + 1 == members.size()) out_ += '\n';
            }
        }
        return std::move(out_) + "    -1\n";
    }

private:
    std::string out_;
    std::uint64_t elements_ = 0;
};

MaybeError too_many(std::size_t elements) {
    if (elements <= INT32_MAX) return std::nullopt;
    return Error{ErrorCode::unsupported, "a universal file has at most 2147483647 elements", ""};
}

} // namespace

Result<std::string> to_universal(const Mesh& mesh) {
    if (auto trouble = too_many(mesh.triangles.size())) return *trouble;
    std::vector<ElementGroup> groups;
    WordNames names;
    for (const SurfaceInfo& surface : mesh.surfaces)
        groups.push_back({names.add(surface.name, "surface"), {}});
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const auto s : mesh.surfaces_of[t]) groups[s].elements.push_back(t + 1);
    std::erase_if(groups, [](const ElementGroup& g) { return g.elements.empty(); });
    UniversalWriter out;
    out.add_nodes(mesh.vertices);
    out.add_elements(thin_shell, mesh.triangles, 1);
    return out.with_groups(with_short_names(std::move(groups)));
}

Result<std::string> to_universal(const TetrahedralMesh& mesh,
                                 std::span<const std::string> block_names) {
    const std::size_t first_face = mesh.tetrahedra.size() + 1;
    if (auto trouble = too_many(first_face + mesh.faces.size())) return *trouble;
    const auto parts = named_parts(mesh, block_names);
    std::vector<ElementGroup> groups;
    for (const ElementBlock& block : parts.blocks) {
        auto& elements = groups.emplace_back(ElementGroup{block.name, {}}).elements;
        for (const auto t : block.tetrahedra) elements.push_back(std::uint64_t(t) + 1);
    }
    for (const FaceGroup& group : face_groups(mesh, parts)) {
        auto& elements = groups.emplace_back(ElementGroup{group.name, {}}).elements;
        for (const auto f : group.faces) elements.push_back(first_face + f);
    }
    UniversalWriter out;
    out.add_nodes(mesh.vertices);
    out.add_elements(solid_tetrahedron, mesh.tetrahedra, 1);
    out.add_elements(thin_shell, mesh.faces, 2);
    return out.with_groups(with_short_names(std::move(groups)));
}

} // namespace terrane
