// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/page/tables.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::page {
namespace {

std::string names_of(const std::vector<std::uint32_t>& surfaces,
                     const std::vector<std::string>& labels) {
    std::string text;
    for (const std::uint32_t s : surfaces) text += (text.empty() ? "" : ", ") + labels[s];
    return text;
}

void add_values(Json& rows, const std::string& path, const Json& value) {
    constexpr std::size_t most = 64; // entries of a list
    if (value.is_object()) {
        for (const auto& [key, entry] : value.items())
            add_values(rows, fmt::format("{}{}{}", path, path.empty() ? "" : ".", key), entry);
    } else if (value.is_array() && value.size() <= most) {
        for (std::size_t i = 0; i < value.size(); ++i)
            add_values(rows, fmt::format("{}[{}]", path, i), value[i]);
    } else if (value.is_array()) {
        rows.push_back({path, fmt::format("{} entries", value.size())});
    } else {
        rows.push_back({path, value});
    }
}

} // namespace

Json columns(std::initializer_list<std::pair<const char*, const char*>> titles) {
    Json json = Json::array();
    for (const auto& [title, measure] : titles)
        json.push_back({{"title", title}, {"measure", measure}});
    return json;
}

Result<Json> file_row(const std::string& path) {
    const auto contents = read_file(path);
    if (!contents) return contents.error();
    return Json::array({path, contents->size(), hexadecimal(sha256(*contents))});
}

Json blocks_json(const Model& model, const std::vector<std::string>& labels) {
    Json json = Json::array();
    for (std::size_t b = 1; b < model.structure.blocks.size(); ++b) {
        const ModelBlock& block = model.structure.blocks[b];
        json.push_back(
            {{"number", b},
             {"name", block.name},
             {"unit", block.unit},
             {"volume", b < model.exact_volumes.size() ? model.exact_volumes[b] : block.volume},
             {"area", block.area},
             {"above", names_of(block.above, labels)},
             {"below", names_of(block.below, labels)},
             {"beside", names_of(block.beside, labels)},
             {"neighbours", block.neighbours}});
    }
    return json;
}

std::vector<Json> block_tables(const Model& model, const std::vector<std::string>& labels) {
    Json blocks = Json::array();
    for (const Json& b : blocks_json(model, labels))
        blocks.push_back(
            {b["number"], b["name"], b["volume"], b["area"], b["above"], b["below"], b["beside"]});
    std::map<std::array<std::uint32_t, 2>, std::pair<double, std::string>> areas;
    for (const ModelInterface& i : model.structure.interfaces) {
        if (i.dangles()) continue;
        auto& [area, across] = areas[i.volumes];
        area += i.area;
        across += (across.empty() ? "" : "; ") + names_of(i.surfaces, labels);
    }
    Json neighbours = Json::array();
    for (const auto& [pair, contact] : areas)
        neighbours.push_back({pair[0] == 0 ? Json("outside") : Json(pair[0]), pair[1],
                              contact.first, contact.second});
    return {
        {{"title", "Blocks"},
         {"columns", columns({{"block", "count"},
                              {"name", "text"},
                              {"volume", "volume"},
                              {"area", "area"},
                              {"above", "text"},
                              {"below", "text"},
                              {"beside", "text"}})},
         {"rows", blocks}},
        {{"title", "Neighbours"},
         {"columns",
          columns(
              {{"block", "count"}, {"neighbour", "count"}, {"area", "area"}, {"across", "text"}})},
         {"rows", neighbours}}};
}

Json surface_table(const Json& surfaces) {
    Json rows = Json::array();
    for (const Json& s : surfaces)
        rows.push_back({s["label"], s["role"], s["triangles"], s["area"], s["file"]});
    return {{"title", "Surfaces"},
            {"columns", columns({{"surface", "text"},
                                 {"role", "text"},
                                 {"triangles", "count"},
                                 {"area", "area"},
                                 {"file", "text"}})},
            {"rows", rows}};
}

Json option_table(const std::vector<std::pair<std::string, std::string>>& options) {
    Json rows = Json::array();
    for (const auto& [name, value] : options) rows.push_back({name, value});
    return {{"title", "Options"},
            {"columns", columns({{"option", "text"}, {"value", "text"}})},
            {"rows", rows}};
}

Json fill_table(const FillWork& work) {
    Json rows = Json::array();
    for (const NumberedHole& hole : work.holes) {
        const BorderLoop& loop = loop_of(work, hole);
        const bool done = hole.report.has_value();
        rows.push_back({hole.number, work.surfaces[hole.task].label,
                        loop.kind == LoopKind::fault_gap ? "fault gap" : "hole", loop.area,
                        done ? Json(hole.report->interpolated) : Json(),
                        done ? Json(hole.report->expected_error) : Json(),
                        done ? Json(hole.report->validated_error) : Json(),
                        done ? hole.report->model : "open: " + hole.refused});
    }
    return {{"title", "Holes"},
            {"columns", columns({{"hole", "count"},
                                 {"surface", "text"},
                                 {"kind", "text"},
                                 {"area", "area"},
                                 {"new vertices", "count"},
                                 {"expected error", "length"},
                                 {"cross-validated error", "length"},
                                 {"model", "text"}})},
            {"rows", rows}};
}

Json value_table(const char* title, const Json& document) {
    Json rows = Json::array();
    add_values(rows, "", document);
    return {{"title", title},
            {"columns", columns({{"key", "text"}, {"value", "number"}})},
            {"rows", rows}};
}

void split_filled(Scene& scene, const FillWork& work) {
    std::vector<ScenePart> parts;
    for (const ScenePart& part : scene.parts) {
        const HoledSurface& surface = work.surfaces[part.surfaces.front()];
        const std::size_t given = std::min(surface.given_triangles, part.count);
        const double area = part.area;
        double filled = 0;
        for (const NumberedHole& hole : work.holes)
            if (hole.report && hole.task == part.surfaces.front()) filled += hole.report->area;
        parts.push_back({part.surfaces, std::nullopt, part.first, given,
                         std::isfinite(area) ? area - filled : area});
        if (given < part.count)
            parts.push_back({part.surfaces, std::nullopt, part.first + given, part.count - given,
                             filled, true});
    }
    scene.parts = std::move(parts);
}

} // namespace terrane::page
