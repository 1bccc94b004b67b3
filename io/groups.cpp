// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/groups.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <terrane/io/names.hpp>

namespace terrane::detail {

std::vector<SurfaceGroup> surface_groups(const Lists<std::uint32_t>& surfaces_of,
                                         std::size_t surface_count) {
    std::map<std::vector<std::uint32_t>, std::vector<std::size_t>> cells_of;
    for (std::size_t i = 0; i < surfaces_of.size(); ++i) {
        const auto list = surfaces_of[i];
        cells_of[{list.begin(), list.end()}].push_back(i);
    }
    std::vector<SurfaceGroup> groups;
    auto next_tag = surface_count + 1;
    for (auto& [surfaces, cells] : cells_of) {
        const std::size_t tag = surfaces.size() == 1 ? surfaces[0] + 1 : next_tag++;
        groups.push_back({tag, surfaces, std::move(cells)});
    }
    return groups;
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
        if (group.surfaces.size() > 1)
            for (const std::uint32_t s : group.surfaces) {
                std::string& line = line_of[group.tag];
                line += (line.empty() ? "" : ", ") + names[s];
            }
    std::string text;
    for (const auto& [tag, line] : line_of) text += fmt::format("# {}: {}\n", tag, line);
    return text;
}

std::string region_name(std::size_t region, std::span<const std::string> names) {
    if (region == 0) return "outside";
    auto name = fmt::format("region {}", region);
    if (region >= names.size() || names[region].empty()) return name;
    auto said = one_line(names[region]);
    std::replace(said.begin(), said.end(), '"', '\'');
    return name + ": " + said;
}

} // namespace terrane::detail
