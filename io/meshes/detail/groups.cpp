// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/detail/groups.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <terrane/io/text/names.hpp>

namespace terrane::detail {

std::string_view ending_of(CutSide side) {
    switch (side) {
    case CutSide::front:
        return " front";
    case CutSide::back:
        return " back";
    default:
        return "";
    }
}

std::vector<CutSide> cut_sides(const TetrahedralMesh& mesh) {
    std::vector<CutSide> sides;
    if (mesh.twins.empty()) return sides;
    sides.resize(mesh.faces.size(), CutSide::none);
    for (const auto& [front, back] : mesh.twins) {
        sides[front] = CutSide::front;
        sides[back] = CutSide::back;
    }
    return sides;
}

std::vector<SurfaceGroup> surface_groups(const IndexLists<std::uint32_t>& surfaces_of,
                                         std::size_t surface_count,
                                         std::span<const CutSide> sides) {
    using Key = std::pair<std::vector<std::uint32_t>, CutSide>;
    std::map<Key, std::vector<std::size_t>> cells_of;
    for (std::size_t i = 0; i < surfaces_of.size(); ++i) {
        const auto list = surfaces_of[i];
        const CutSide side = sides.empty() ? CutSide::none : sides[i];
        cells_of[{{list.begin(), list.end()}, side}].push_back(i);
    }
    std::vector<SurfaceGroup> groups;
    auto next_tag = surface_count + 1;
    for (auto& [key, cells] : cells_of) {
        const auto& [surfaces, side] = key;
        const bool alone = surfaces.size() == 1 && side == CutSide::none;
        const std::size_t tag = alone ? surfaces[0] + 1 : next_tag++;
        groups.push_back({tag, surfaces, side, std::move(cells)});
    }
    return groups;
}

std::size_t side_tag(std::size_t surface, CutSide side, std::size_t surface_count) {
    if (side == CutSide::none) return surface + 1;
    return surface_count + 2 * surface + (side == CutSide::front ? 1 : 2);
}

std::size_t block_tag(std::size_t block, std::size_t surface_count) {
    return 3 * surface_count + block + 1;
}

std::vector<std::size_t> group_tags(const std::vector<SurfaceGroup>& groups,
                                    std::size_t triangle_count) {
    std::vector<std::size_t> tags(triangle_count);
    for (const SurfaceGroup& group : groups)
        for (const std::size_t cell : group.cells) tags[cell] = group.tag;
    return tags;
}

std::string tag_comments(const std::vector<SurfaceGroup>& groups,
                         const std::vector<SurfaceInfo>& surfaces) {
    const auto names = quotable_names(surfaces);
    std::map<std::size_t, std::string> line_of;
    for (std::size_t s = 0; s < names.size(); ++s) line_of[s + 1] = names[s];
    for (const SurfaceGroup& group : groups)
        if (group.tag > surfaces.size())
            for (const std::uint32_t s : group.surfaces) {
                std::string& line = line_of[group.tag];
                line += (line.empty() ? "" : ", ") + names[s];
                line += ending_of(group.side);
            }
    std::string text;
    for (const auto& [tag, line] : line_of) text += fmt::format("# {}: {}\n", tag, line);
    return text;
}

std::vector<SideName> side_names(const std::vector<SurfaceGroup>& groups,
                                 const std::vector<SurfaceInfo>& surfaces) {
    const auto names = quotable_names(surfaces);
    std::map<std::size_t, std::string> name_of;
    for (const SurfaceGroup& group : groups)
        if (group.side != CutSide::none)
            for (const std::uint32_t s : group.surfaces)
                name_of[side_tag(s, group.side, surfaces.size())] =
                    names[s] + std::string(ending_of(group.side));
    std::vector<SideName> sides;
    for (auto& [tag, name] : name_of) sides.push_back({tag, std::move(name)});
    return sides;
}

std::string block_name(std::size_t block, std::span<const std::string> names) {
    if (block == 0) return "outside";
    auto name = fmt::format("block {}", block);
    if (block >= names.size() || names[block].empty()) return name;
    auto said = one_line(names[block]);
    std::replace(said.begin(), said.end(), '"', '\'');
    return name + ": " + said;
}

} // namespace terrane::detail
