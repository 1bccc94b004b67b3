// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/gocad/gocad.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/gocad/gocad_objects.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Refuses surfaces with different units, whose coordinates cannot be compared.
MaybeError check_units(const LineParser& in, const std::vector<TsurfObject>& objects) {
    const TsurfObject* first = nullptr;
    for (const auto& object : objects) {
        if (object.units.empty()) continue;
        if (!first) first = &object;
        if (object.units != first->units)
            return in.error_at(object.line, ErrorCode::unsupported,
                               fmt::format("AXIS_UNIT is {}, but {} for the object in line {}",
                                           shown(object.units), shown(first->units), first->line));
    }
    return std::nullopt;
}

Error no_tsurf(const LineParser& in, const GocadFile& file) {
    std::string found;
    for (const auto& [type, count] : file.others)
        found += fmt::format("{}{} {}", found.empty() ? "" : ", ", count, type);
    if (file.model) found += found.empty() ? "1 Model3d" : ", 1 Model3d";
    if (file.others.contains("VSet") || file.others.contains("PLine"))
        found += "; --input-format vs connects their points";
    return in.file_error(ErrorCode::nothing_to_do, "there is no TSurf, only " + found);
}

MaybeError read_objects(LineParser& in, GocadFile& file, bool mixed_units = false) {
    in.allow_d_exponents();
    if (auto trouble = read_gocad_file(in, file)) return trouble;
    if (file.tsurfs.empty()) return no_tsurf(in, file);
    if (std::ranges::all_of(file.tsurfs, [](const TsurfObject& object) {
            return object.surface.triangles.empty();
        }))
        return in.file_error(ErrorCode::nothing_to_do, "there is no triangle");
    return mixed_units ? std::nullopt : check_units(in, file.tsurfs);
}

std::string_view name_in_model(const TsurfObject& object) {
    return object.name_in_model.empty() ? object.surface.name : object.name_in_model;
}

/// Gives surfaces without a role of their own the role from the model's list of TFACE.
void take_roles(GocadFile& file) {
    if (!file.model) return;
    std::map<std::string_view, Role> role_of; // of the first part that has one
    for (const auto& part : file.model->parts) {
        const bool none = lower(part.feature) == "none";
        const auto role = none ? Role::horizon : role_of_feature(part.feature);
        if (role != Role::unknown) role_of.emplace(part.surface, role);
    }
    for (auto& object : file.tsurfs) {
        const auto role = role_of.find(name_in_model(object));
        if (object.surface.role == Role::unknown && role != role_of.end())
            object.surface.role = role->second;
    }
}

void name_nameless(GocadFile& file, std::string_view name) {
    for (auto& object : file.tsurfs)
        if (object.surface.name.empty()) object.surface.name = name;
}

/// Converts the names and ids in a model object to indices.
class ModelBuilder {
public:
    ModelBuilder(const LineParser& in, const GocadFile& file) : in_(in), file_(file) {}

    MaybeError build(GocadModel& model) {
        if (auto trouble = find_surfaces()) return trouble;
        for (const auto& part : file_.model->parts)
            if (auto trouble = add_part(part, model)) return trouble;
        if (auto trouble = check_part_counts()) return trouble;
        for (const auto& region : file_.model->regions)
            if (auto trouble = add_region(region, model)) return trouble;
        for (const auto& layer : file_.model->layers)
            if (auto trouble = add_layer(layer, model)) return trouble;
        model.name = file_.model->name;
        return std::nullopt;
    }

private:
    MaybeError find_surfaces() {
        for (std::size_t i = 0; i < file_.tsurfs.size(); ++i)
            surfaces_.emplace(name_in_model(file_.tsurfs[i]), static_cast<std::uint32_t>(i));
        parts_of_.resize(file_.tsurfs.size());
        for (const auto& name : file_.model->surfaces)
            if (!surfaces_.contains(name))
                return in_.error_at(file_.model->line, ErrorCode::bad_syntax,
                                    fmt::format("the model names surface {}, which is no TSurf of "
                                                "the file",
                                                shown(name)));
        return std::nullopt;
    }

    MaybeError add_part(const ModelObject::Part& part, GocadModel& model) {
        const auto surface = surfaces_.find(part.surface);
        if (surface == surfaces_.end())
            return in_.error_at(part.line, ErrorCode::bad_syntax,
                                fmt::format("TFACE {} is part of {}, which is no TSurf of the file",
                                            part.id, shown(part.surface)));
        const auto& object = file_.tsurfs[surface->second];
        const auto block = parts_of_[surface->second]++;
        if (block >= object.part_begins.size()) return wrong_count(object, part.line);
        const auto begin = object.part_begins[block];
        const auto end = block + 1 < object.part_begins.size()
                             ? object.part_begins[block + 1]
                             : static_cast<std::uint32_t>(object.surface.triangles.size());
        if (!part_of_id_.emplace(part.id, model.parts.size()).second)
            return in_.error_at(part.line, ErrorCode::bad_syntax,
                                fmt::format("TFACE {} is listed twice", part.id));
        model.parts.push_back({part.id, part.feature,
                               SurfaceId(static_cast<std::uint32_t>(surface->second)), begin,
                               end - begin});
        return std::nullopt;
    }

    [[nodiscard]] Error wrong_count(const TsurfObject& object, std::size_t line) const {
        return in_.error_at(line, ErrorCode::bad_syntax,
                            fmt::format("the model does not list the {} TFACE of surface {}",
                                        object.part_begins.size(), shown(name_in_model(object))));
    }

    [[nodiscard]] MaybeError check_part_counts() const {
        for (const auto& [name, index] : surfaces_) {
            const auto& object = file_.tsurfs[index];
            if (parts_of_[index] != 0 && parts_of_[index] != object.part_begins.size())
                return wrong_count(object, object.line);
        }
        return std::nullopt;
    }

    MaybeError add_region(const ModelObject::Region& region, GocadModel& model) {
        region_ids_.insert(region.id);
        auto& result = model.regions.emplace_back();
        result.id = region.id;
        result.name = region.name;
        for (const auto side : region.sides) {
            const auto part = part_of_id_.find(side < 0 ? -side : side);
            if (part == part_of_id_.end())
                return in_.error_at(
                    region.line, ErrorCode::bad_index,
                    fmt::format("region {} names TFACE {}, which does not exist", region.id, side));
            result.sides.push_back({static_cast<std::uint32_t>(part->second), side > 0});
        }
        return std::nullopt;
    }

    MaybeError add_layer(const ModelObject::Layer& layer, GocadModel& model) const {
        auto& result = model.layers.emplace_back();
        result.name = layer.name;
        for (const auto id : layer.regions) {
            if (!region_ids_.contains(id))
                return in_.error_at(file_.model->line, ErrorCode::bad_index,
                                    fmt::format("layer {} names region {}, which does not exist",
                                                shown(layer.name), id));
            result.regions.push_back(static_cast<std::uint32_t>(id));
        }
        return std::nullopt;
    }

    const LineParser& in_;
    const GocadFile& file_;
    std::map<std::string_view, std::uint32_t> surfaces_; ///< by name in the model
    std::vector<std::size_t> parts_of_;                  ///< per surface: number of parts so far
    std::map<std::int64_t, std::size_t> part_of_id_;
    std::set<std::int64_t> region_ids_;
};

} // namespace

Result<std::vector<Surface>> read_gocad(std::string_view contents, std::string_view source,
                                        std::string_view name, bool mixed_units) {
    return guard_memory(source, [&]() -> Result<std::vector<Surface>> {
        LineParser in(contents, source);
        GocadFile file;
        if (auto trouble = read_objects(in, file, mixed_units)) return *trouble;
        take_roles(file);
        name_nameless(file, name);
        std::vector<Surface> surfaces;
        for (auto& object : file.tsurfs) surfaces.push_back(std::move(object.surface));
        return surfaces;
    });
}

std::vector<StatedBlock> stated_blocks_of(const GocadModel& model) {
    std::vector<StatedBlock> blocks;
    for (const ModelRegion& region : model.regions) {
        if (same_ignoring_case(region.name, "Universe")) continue;
        StatedBlock& stated = blocks.emplace_back();
        stated.name = region.name;
        for (const ModelLayer& layer : model.layers)
            if (std::ranges::count(layer.regions, region.id) > 0 && stated.layer.empty())
                stated.layer = layer.name;
        for (const ModelSide& side : region.sides) {
            const auto is_same = [&](const ModelSide& s) { return s.part == side.part; };
            if (std::ranges::count_if(region.sides, is_same) > 1) continue;
            const ModelPart& part = model.parts[side.part];
            stated.borders.push_back({part.surface, part.first_triangle, part.triangle_count});
        }
    }
    return blocks;
}

Result<GocadModel> read_gocad_model(std::string_view contents, std::string_view source,
                                    std::string_view name) {
    return guard_memory(source, [&]() -> Result<GocadModel> {
        LineParser in(contents, source);
        GocadFile file;
        if (auto trouble = read_objects(in, file)) return *trouble;
        if (!file.model) return in.file_error(ErrorCode::nothing_to_do, "there is no Model3d");
        GocadModel model;
        if (auto trouble = ModelBuilder(in, file).build(model)) return *trouble;
        take_roles(file);
        name_nameless(file, name);
        for (auto& object : file.tsurfs) model.surfaces.push_back(std::move(object.surface));
        return model;
    });
}

} // namespace terrane
