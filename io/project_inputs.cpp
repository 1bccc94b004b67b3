// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/project.hpp>

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/text/units.hpp>

namespace terrane {
namespace {

std::string names_of(const std::vector<Surface>& surfaces) {
    constexpr std::size_t most = 10;
    std::string text;
    for (std::size_t s = 0; s < std::min(surfaces.size(), most); ++s)
        text += (s == 0 ? "" : ", ") + surfaces[s].name;
    return surfaces.size() > most ? text + ", ..." : text;
}

/// Those of the file that the entry asks for, in the order of the file.
Result<std::vector<Surface>> chosen(std::vector<Surface> surfaces, const ProjectSurfaces& entry,
                                    const Project& project, const std::string& key) {
    if (entry.objects.empty()) return surfaces;
    const auto has_name = [](const std::string& name) {
        return [&name](const Surface& s) { return s.name == name; };
    };
    for (std::size_t i = 0; i < entry.objects.size(); ++i)
        if (std::none_of(surfaces.begin(), surfaces.end(), has_name(entry.objects[i])))
            return at_key(project, fmt::format("{}.objects[{}]", key, i),
                          fmt::format("{} has no surface {}; it has {}", entry.file.string(),
                                      entry.objects[i], names_of(surfaces)));
    std::erase_if(surfaces, [&](const Surface& s) {
        return std::count(entry.objects.begin(), entry.objects.end(), s.name) == 0;
    });
    return surfaces;
}

/// One entry of "surfaces".
Result<std::vector<Surface>> surfaces_of_entry(const ProjectSurfaces& entry, const Project& project,
                                               const std::string& key,
                                               std::vector<SurfaceInfo>& as_read) {
    ReadOptions options;
    options.depth = entry.depth;
    options.unit = project.unit;
    auto read = read_surfaces(entry.file, std::nullopt, options);
    if (!read) return read.error();
    auto surfaces = chosen(std::move(read).value(), entry, project, key);
    if (!surfaces) return surfaces.error();
    if (!entry.name.empty() && surfaces.value().size() != 1)
        return at_key(project, key + ".name",
                      fmt::format("is for one surface, but {} are taken from {}",
                                  surfaces.value().size(), entry.file.string()));
    for (Surface& s : surfaces.value()) {
        as_read.push_back({s.name, s.role});
        if (!entry.name.empty()) s.name = entry.name;
        if (entry.role) s.role = *entry.role;
    }
    return surfaces;
}

Result<std::vector<Surface>> boundary_within(const ProjectWithin& within, const std::string& unit,
                                             const Run& run) {
    ReadOptions options;
    options.unit = unit;
    std::vector<Surface> all;
    for (const auto& file : within.files) {
        auto read = read_surfaces(file, std::nullopt, options);
        if (!read) return read.error();
        for (Surface& s : *read) all.push_back(std::move(s));
    }
    return closed_boundary(all, run);
}

/// Says at which key an error about the volume of interest arose, unless it is about a file.
Error at_volume(const Project& project, Error error) {
    const bool has_files = std::holds_alternative<ProjectWithin>(project.volume);
    if (!has_files || error.place.empty())
        error.place = place_of_key(project, "volume_of_interest");
    return error;
}

} // namespace

Result<std::vector<Surface>> boundary_of(const ProjectVolume& wanted, const std::string& unit,
                                         const Run& run) {
    const auto make = [&](const auto& volume) -> Result<std::vector<Surface>> {
        using Volume = std::decay_t<decltype(volume)>;
        if constexpr (std::is_same_v<Volume, ProjectBox>)
            return box_boundary(volume.low, volume.high);
        else if constexpr (std::is_same_v<Volume, RotatedBox>)
            return rotated_box_boundary(volume);
        else if constexpr (std::is_same_v<Volume, ProjectPolygon>)
            return polygon_boundary(volume.corners, volume.between[0], volume.between[1]);
        else if constexpr (std::is_same_v<Volume, ProjectWithin>)
            return boundary_within(volume, unit, run);
        else
            return std::vector<Surface>();
    };
    return guarded("for the volume of interest", "boundary",
                   [&] { return std::visit(make, wanted); });
}

std::vector<std::filesystem::path> named_files(const Project& project) {
    std::vector<std::filesystem::path> files;
    for (const ProjectSurfaces& entry : project.surfaces) files.push_back(entry.file);
    if (const auto* within = std::get_if<ProjectWithin>(&project.volume))
        files.insert(files.end(), within->files.begin(), within->files.end());
    for (const ProjectUncertainty& u : project.uncertainty)
        if (u.field && !u.field->map.empty()) files.push_back(u.field->map);
    return files;
}

Result<ProjectInputs> read_inputs(const Project& project, const Run& run) {
    return guarded("to read the files", "read", [&]() -> Result<ProjectInputs> {
        ProjectInputs read;
        for (std::size_t i = 0; i < project.surfaces.size(); ++i) {
            if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "", ""};
            const ProjectSurfaces& entry = project.surfaces[i];
            auto surfaces =
                surfaces_of_entry(entry, project, fmt::format("surfaces[{}]", i), read.as_read);
            if (!surfaces) return surfaces.error();
            read.surfaces_of_entry.push_back(surfaces->size());
            if (entry.objects.empty()) // otherwise numbers are not those of the file
                append_stated_blocks(read_stated_blocks(entry.file), read.build.surfaces.size(),
                                     read.build.stated_blocks);
            for (Surface& s : *surfaces) {
                read.vertices += s.vertices.size();
                read.triangles += s.triangles.size();
                read.build.surfaces.push_back(std::move(s));
            }
        }
        if (std::max(read.vertices, read.triangles) >= UINT32_MAX)
            return Error{ErrorCode::unsupported, "more than 4294967294 vertices or triangles", ""};
        read.unit = detail::common_unit(read.build.surfaces);
        auto boundary = boundary_of(project.volume, project.unit, run);
        if (!boundary) return at_volume(project, boundary.error());
        read.build.boundary = std::move(*boundary);
        return read;
    });
}

Result<Built> build_model(const Project& project, const Run& run) {
    return guarded("for the model", "build", [&]() -> Result<Built> {
        auto inputs = read_inputs(project, run);
        if (!inputs) return inputs.error();
        return build(project, std::move(inputs->build), run);
    });
}

namespace {

Result<Built> build_of(Project project, std::vector<Surface> surfaces, const Run& run) {
    const auto entries = std::exchange(project.surfaces, {});
    if (!entries.empty() && entries.size() != surfaces.size())
        return at_key(project, "surfaces",
                      fmt::format("has {} entries, but {} surfaces are given", entries.size(),
                                  surfaces.size()));
    if (auto valid = validate(surfaces, run); !valid) return valid.error();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (!entries[i].name.empty()) surfaces[i].name = entries[i].name;
        if (entries[i].role) surfaces[i].role = *entries[i].role;
    }
    auto inputs = read_inputs(project, run); // no file is read but that of the volume of interest
    if (!inputs) return inputs.error();
    inputs->build.surfaces = std::move(surfaces);
    return build(project, std::move(inputs->build), run);
}

} // namespace

Result<Built> build_model(Project project, std::vector<Surface> surfaces, const Run& run) {
    return guarded("for the model", "build",
                   [&] { return build_of(std::move(project), std::move(surfaces), run); });
}

} // namespace terrane
