// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/structure_json.hpp>

#include <cmath>
#include <initializer_list>
#include <utility>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/io/report_members.hpp>
#include <terrane/io/text/json.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {
namespace {

using detail::Json;

Json surfaces_json(const Mesh& mesh, const Structure& structure) {
    std::vector<double> area(mesh.surfaces.size()), dangling(mesh.surfaces.size());
    for (const ModelInterface& i : structure.interfaces)
        for (const std::uint32_t s : i.surfaces) {
            area[s] += i.area;
            if (i.dangles()) dangling[s] += i.area;
        }
    Json all = Json::array();
    for (std::size_t s = 0; s < mesh.surfaces.size(); ++s)
        all.push_back(
            {{"name", mesh.surfaces[s].name},
             {"role", detail::role_names[static_cast<std::size_t>(mesh.surfaces[s].role)]},
             {"area", area[s]},
             {"dangling_area", dangling[s]}});
    return all;
}

Json blocks_json(const Structure& structure, const StructureExtras& extras) {
    Json all = Json::array();
    for (std::size_t b = 0; b < structure.blocks.size(); ++b) {
        const ModelBlock& block = structure.blocks[b];
        Json json{{"name", block.name}};
        if (!block.unit.empty()) json["unit"] = block.unit;
        if (block.age) json["age"] = *block.age;
        if (b > 0) { // the outside has no volume
            if (!extras.exact_volumes.empty()) json["volume"] = extras.exact_volumes[b];
            json["volume_written"] = block.volume;
        }
        json["area"] = block.area;
        json["above"] = block.above;
        json["below"] = block.below;
        json["beside"] = block.beside;
        json["interfaces"] = block.interfaces;
        json["inner_interfaces"] = block.inner_interfaces;
        json["neighbours"] = block.neighbours;
        if (!extras.block_files.empty() && !extras.block_files[b].empty())
            json["file"] = extras.block_files[b];
        all.push_back(std::move(json));
    }
    return all;
}

Json interfaces_json(const Structure& structure, const StructureExtras& extras) {
    Json all = Json::array();
    for (std::size_t i = 0; i < structure.interfaces.size(); ++i) {
        const ModelInterface& interface = structure.interfaces[i];
        Json json{{"volumes", interface.volumes},
                  {"surfaces", interface.surfaces},
                  {"area", interface.area},
                  {"patches", interface.patches}};
        if (!extras.interface_files.empty()) json["file"] = extras.interface_files[i];
        all.push_back(std::move(json));
    }
    return all;
}

/// Groups ascending numbers into ranges [first, last].
Json ranges(const std::vector<std::uint32_t>& numbers) {
    Json all = Json::array();
    for (std::size_t i = 0, end = 0; i < numbers.size(); i = end) {
        while (end < numbers.size() && numbers[end] - numbers[i] == end - i) ++end;
        all.push_back({numbers[i], numbers[end - 1]});
    }
    return all;
}

Json patches_json(const Structure& structure) {
    Json all = Json::array();
    for (const ModelPatch& patch : structure.patches)
        all.push_back({{"interface", std::uint32_t{patch.interface}},
                       {"area", patch.area},
                       {"triangles", ranges(patch.triangles)},
                       {"lines", patch.lines}});
    return all;
}

Json lines_json(const Structure& structure) {
    Json all = Json::array();
    for (const ModelLine& line : structure.lines) {
        Json json{{"kind", name_of(line.kind)}, {"vertices", line.vertices}};
        json["corners"] = line.corners[0] == no_index ? Json(nullptr) : Json(line.corners);
        json["patches"] = line.patches;
        json["surfaces"] = line.surfaces;
        json["length"] = line.length;
        all.push_back(std::move(json));
    }
    return all;
}

Json corners_json(const Mesh& mesh, const Structure& structure) {
    Json all = Json::array();
    for (const ModelCorner& corner : structure.corners)
        all.push_back({{"vertex", std::uint32_t{corner.vertex}},
                       {"position", mesh.vertices[corner.vertex]},
                       {"lines", corner.lines}});
    return all;
}

Json leaks_json(const StructureExtras& extras) {
    Json all = Json::array();
    const auto leaks = leaks_of(extras.free_borders);
    for (std::size_t l = 0; l < leaks.size(); ++l) {
        Json json = leaks[l];
        if (l < extras.leak_verdicts.size() && extras.leak_verdicts[l] != LeakVerdict::wide)
            json["separates"] = extras.leak_verdicts[l] == LeakVerdict::separates;
        all.push_back(std::move(json));
    }
    return all;
}

/// Writes one line per element of each array, so that people can read the text and programs can
/// compare it line by line.
std::string text_of(const Json& json) {
    std::string text = "{\n";
    bool first = true;
    for (const auto& [key, value] : json.items()) {
        text += first ? "" : ",\n";
        first = false;
        text += Json(key).dump() + ": ";
        if (!value.is_array() || value.empty()) {
            text += value.dump();
            continue;
        }
        text += "[\n";
        for (std::size_t i = 0; i < value.size(); ++i)
            text += (i > 0 ? ",\n" : "") + value[i].dump();
        text += "\n]";
    }
    return text + "\n}\n";
}

Json seal_json(const StructureExtras& extras) {
    Json json{{"distance", *extras.seal_distance}};
    if (!extras.seal_rules.empty()) json["rules"] = extras.seal_rules;
    json["changes"] = extras.seal_changes;
    return json;
}

/// Makes doubles strings, as certificates have them.
Json with_quoted_doubles(const Json& json) {
    if (json.is_number() && !json.is_number_integer()) {
        if (!std::isfinite(json.get<double>())) return nullptr;
        std::string text;
        detail::append_number(text, json.get<double>());
        return Json(text);
    }
    Json copy = json.is_array() ? Json::array() : json.is_object() ? Json::object() : json;
    for (const Json& entry : json) copy.push_back(with_quoted_doubles(entry));
    for (const auto& [key, value] : json.items()) copy.add_member(key, with_quoted_doubles(value));
    return copy;
}

/// Returns these members of an object; null for those that it does not have.
Json members_of(const Json& object, std::initializer_list<const char*> keys) {
    Json members = Json::object();
    for (const char* const key : keys) members.add_member(key, object[key]);
    return members;
}

} // namespace

std::string stated_json(const Structure& structure, const StructureExtras& extras) {
    const StandardArithmetic guard;
    Json blocks = Json::array(), gaps = Json::array(), leaks = Json::array(), seal;
    const Json all_blocks = blocks_json(structure, extras), borders = extras.free_borders,
               all_leaks = leaks_json(extras);
    for (const Json& block : all_blocks)
        blocks.push_back(members_of(block, {"unit", "age", "volume", "above", "below", "beside"}));
    for (const Json& border : borders) gaps.push_back(border["gaps"]);
    for (const Json& leak : all_leaks)
        leaks.push_back(members_of(
            leak, {"from", "to", "borders", "length", "least", "largest", "place", "separates"}));
    if (extras.seal_distance)
        seal = members_of(seal_json(extras), {"distance", "rules", "changes"});
    return with_quoted_doubles(Json{{"blocks", std::move(blocks)},
                                    {"gaps", std::move(gaps)},
                                    {"leaks", std::move(leaks)},
                                    {"seal", std::move(seal)}})
        .dump();
}

std::string to_json(const Mesh& mesh, const Structure& structure, const StructureExtras& extras) {
    const StandardArithmetic guard;
    Json json{{"format", "terrane-model 1"}};
    json["surfaces"] = surfaces_json(mesh, structure);
    json["blocks"] = blocks_json(structure, extras);
    json["interfaces"] = interfaces_json(structure, extras);
    json["patches"] = patches_json(structure);
    json["lines"] = lines_json(structure);
    json["corners"] = corners_json(mesh, structure);
    json["free_borders"] = extras.free_borders;
    json["leaks"] = leaks_json(extras);
    if (extras.seal_distance) json["seal"] = seal_json(extras);
    return text_of(json);
}

detail::Json json_of(std::span<const PlausibilityWarning> warnings,
                     std::span<const std::string> labels) {
    detail::Json list = detail::Json::array();
    for (const PlausibilityWarning& w : warnings) {
        detail::Json surfaces = detail::Json::array();
        for (const auto s : w.surfaces) surfaces.push_back(labels[s]);
        list.push_back({{"about", std::string(name_of(w.doubt))},
                        {"surfaces", std::move(surfaces)},
                        {"seen", w.seen},
                        {"why", w.why},
                        {"answer", w.answer}});
    }
    return list;
}

} // namespace terrane
