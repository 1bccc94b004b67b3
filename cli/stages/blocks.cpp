// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/blocks.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <system_error>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/structure/structure_meshes.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/meshes/vtm.hpp>
#include <terrane/io/structure_json.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_blocks = 50; ///< listed on the terminal
constexpr std::size_t most_leaks = 20;

// ---- Text

std::string blocks_text(const Inputs& inputs, const Model& model) {
    const Quantities quantities(inputs.unit);
    const auto& blocks = model.structure.blocks;
    const std::size_t count = model.block_count();
    auto text = fmt::format("{}, volume {} in all\n", counted(count, "closed block"),
                            quantities.volume(model.exact_volumes[0], 9));
    for (std::size_t b = 1; b <= std::min(count, most_blocks); ++b)
        text += fmt::format(
            "  block {:<4} volume {:<16} {}\n", b, quantities.volume(model.exact_volumes[b], 9),
            blocks[b].interfaces.empty() ? "(too thin for doubles)" : blocks[b].name);
    if (count > most_blocks) text += fmt::format("  and {} more\n", count - most_blocks);
    if (model.lost > 0)
        text +=
            fmt::format("doubles: {} too thin, and not written\n", counted(model.lost, "block"));
    if (model.made > 0)
        text += fmt::format("doubles: {} that the exact surfaces do not enclose\n",
                            counted(model.made, "block"));
    return text;
}

std::string structure_text(const Model& model) {
    const Structure& s = model.structure;
    std::map<LineKind, std::size_t> kinds;
    for (const ModelLine& line : s.lines) ++kinds[line.kind];
    std::string lines;
    for (const auto& [kind, count] : kinds)
        lines += fmt::format("{}{}", lines.empty() ? "" : ", ",
                             counted(count, std::string(name_of(kind))));
    return fmt::format("{}, {}, {}{}\n", counted(s.interfaces.size(), "interface"),
                       s.patches.size() == 1 ? "1 patch"
                                             : fmt::format("{} patches", s.patches.size()),
                       counted(s.corners.size(), "corner"), lines.empty() ? "" : ", " + lines);
}

/// Lists the surfaces of which a part has the same block on both sides.
std::string dangling_text(const Inputs& inputs, const Model& model) {
    std::vector<double> area(inputs.labels.size()), dangling(inputs.labels.size()),
        border(inputs.labels.size());
    const Quantities quantities(inputs.unit);
    for (const ModelInterface& i : model.structure.interfaces)
        for (const std::uint32_t s : i.surfaces) {
            area[s] += i.area;
            if (i.dangles()) dangling[s] += i.area;
        }
    for (const FreeBorder& b : model.borders)
        for (const std::uint32_t s : b.surfaces) border[s] += b.length;
    std::string text;
    for (std::size_t s = 0; s < area.size(); ++s)
        if (dangling[s] > 0)
            text += fmt::format("  {}: {} of {} in area dangles, free border {}\n",
                                inputs.labels[s], quantities.area(dangling[s], 3),
                                quantities.area(area[s], 3), quantities.length(border[s], 3));
    return text.empty() ? "no surface dangles\n" : "surfaces that dangle:\n" + text;
}

std::string leak_line(const Inputs& inputs, const Leak& l) {
    const Quantities quantities(inputs.unit);
    return fmt::format("  {} ends by {}: along {}, {} apart, most at {}\n", inputs.labels[l.from],
                       l.from == l.to ? "itself" : inputs.labels[l.to], quantities.length(l.length),
                       quantities.lengths(l.least, l.largest, 2), text_of(l.place));
}

std::string leak_lines(const Inputs& inputs, std::span<const Leak> leaks, const char* rest) {
    std::string text;
    for (std::size_t i = 0; i < std::min(leaks.size(), most_leaks); ++i)
        text += leak_line(inputs, leaks[i]);
    if (leaks.size() > most_leaks)
        text += fmt::format("  and {} more{}\n", leaks.size() - most_leaks, rest);
    return text;
}

/// Lists the leaks that separate blocks, counts the harmless ones, and returns the others.
std::string judged_text(const Inputs& inputs, const LeakAdvice& advice, std::vector<Leak>& leaks) {
    const Quantities quantities(inputs.unit);
    const auto distance = quantities.length(advice.distance, 15);
    auto text =
        advice.separating.empty()
            ? fmt::format("leaks: no gap of up to {} separates blocks\n", distance)
            : fmt::format("leaks: closing gaps of up to {} separates blocks where\n", distance) +
                  leak_lines(inputs, advice.separating, "");
    std::vector<Leak> others;
    std::size_t harmless = 0;
    double length = 0;
    for (std::size_t l = 0; l < leaks.size(); ++l) {
        if (advice.verdicts[l] == LeakVerdict::wide) others.push_back(leaks[l]);
        if (advice.verdicts[l] != LeakVerdict::harmless) continue;
        harmless += leaks[l].borders;
        length += leaks[l].length;
    }
    leaks = std::move(others);
    if (harmless > 0)
        text += fmt::format("harmless: {} as near to another surface, along {}\n",
                            counted(harmless, "border"), quantities.length(length));
    return text;
}

/// Lists where surfaces end near others: leaks that matter, then the others, the smallest gaps
/// first.
std::string leaks_text(const Inputs& inputs, const Model& model,
                       const std::optional<LeakAdvice>& advice) {
    auto leaks = leaks_of(model.borders);
    if (leaks.empty()) return {};
    std::string text;
    if (advice && advice->distance > 0) text = judged_text(inputs, *advice, leaks);
    if (leaks.empty()) return text;
    return text + "free borders, by the surface nearest to them and how far it is:\n" +
           leak_lines(inputs, leaks, ", farther apart");
}

// ---- Files

std::vector<std::int32_t> as_cells(const std::vector<std::uint32_t>& values) {
    return {values.begin(), values.end()};
}

/// Returns the block on one side of each triangle.
std::vector<std::int32_t> side_cells(const Volumes& volumes, std::size_t side) {
    std::vector<std::int32_t> values;
    for (const auto& sides : volumes.of_sides)
        values.push_back(static_cast<std::int32_t>(sides[side]));
    return values;
}

class FolderWriter {
public:
    FolderWriter(const ModelReports& reports, const std::string& part_format,
                 const std::filesystem::path& folder) :
        model_(reports.model),
        part_format_(part_format), folder_(folder),
        labels_(unique_labels(reports.model.mesh->surfaces)) {
        if (reports.leaks) extras_.leak_verdicts = reports.leaks->verdicts;
        if (!reports.sealed) return;
        extras_.seal_distance = reports.sealed->distance;
        extras_.seal_rules = reports.sealed->rules;
        extras_.seal_changes = reports.sealed->changes;
    }

    Status operator()(const Session& session) {
        for (const char* inner : {"blocks", "interfaces"}) {
            std::error_code failed;
            std::filesystem::create_directory(folder_ / inner, failed);
            if (failed)
                return Error{ErrorCode::cannot_open, "cannot be made: " + failed.message(),
                             (folder_ / inner).string()};
        }
        if (auto done = write_result(); !done) return done;
        const Structure& s = model_.structure;
        extras_.block_files.resize(s.blocks.size());
        for (std::uint32_t b = 1; b < s.blocks.size(); ++b) {
            if (session.stopped()) return Error{ErrorCode::interrupted, "stopped on request", ""};
            if (s.blocks[b].interfaces.empty()) continue;
            extras_.block_files[b] = name("blocks/block_", b);
            const auto part = block_part(model_.mesh, model_.volumes, s, BlockId(b));
            if (auto done = write_part(part, {&s.blocks[b].name, 1}, extras_.block_files[b]); !done)
                return done;
        }
        for (std::uint32_t i = 0; i < s.interfaces.size(); ++i) {
            if (session.stopped()) return Error{ErrorCode::interrupted, "stopped on request", ""};
            extras_.interface_files.push_back(name("interfaces/interface_", i));
            const auto part = interface_part(model_.mesh, model_.volumes, s, InterfaceId(i));
            const auto [low, high] = s.interfaces[i].volumes;
            const std::array names{s.blocks[low].name, s.blocks[high].name};
            if (auto done = write_part(part, names, extras_.interface_files[i]); !done) return done;
        }
        if (part_format_ == "vtp")
            if (auto done = write_file(folder_ / "model.vtm", to_vtm(groups())); !done) return done;
        return write_json();
    }

private:
    [[nodiscard]] std::string name(const char* start, std::uint32_t number) const {
        return fmt::format("{}{}.{}", start, number,
                           part_format_ == "msh22" ? "msh" : part_format_);
    }

    /// Names the blocks on both sides of an interface, and its surfaces.
    [[nodiscard]] std::string name_of_interface(const ModelInterface& i) const {
        const auto& blocks = model_.structure.blocks;
        std::string surfaces;
        for (const std::uint32_t s : i.surfaces)
            surfaces += (surfaces.empty() ? "" : " and ") + labels_[s];
        if (i.dangles()) return fmt::format("{} in {}", surfaces, blocks[i.volumes[0]].name);
        return fmt::format("{} between {} and {}", surfaces, blocks[i.volumes[0]].name,
                           blocks[i.volumes[1]].name);
    }

    [[nodiscard]] std::vector<FileGroup> groups() const {
        FileGroup blocks{"blocks", {}}, interfaces{"interfaces", {}};
        const Structure& s = model_.structure;
        for (std::size_t b = 1; b < s.blocks.size(); ++b)
            if (!extras_.block_files[b].empty())
                blocks.files.push_back({s.blocks[b].name, extras_.block_files[b]});
        for (std::size_t i = 0; i < s.interfaces.size(); ++i)
            interfaces.files.push_back(
                {name_of_interface(s.interfaces[i]), extras_.interface_files[i]});
        return {std::move(blocks), std::move(interfaces)};
    }

    Status write_result() {
        const std::vector<CellArray> cells{{"volume_front", side_cells(model_.volumes, 0)},
                                           {"volume_back", side_cells(model_.volumes, 1)},
                                           {"interface", as_cells(model_.structure.interface_of)},
                                           {"patch", as_cells(model_.structure.patch_of)}};
        std::vector<std::string> names;
        for (const ModelBlock& block : model_.structure.blocks) names.push_back(block.name);
        WriteOptions options;
        options.cells = cells;
        options.region_names = names;
        return write_mesh(model_.mesh, folder_ / "result.vtp", options);
    }

    /// Writes a part; `names` are those of the block, or of the blocks on both sides.
    Status write_part(const MeshPart& part, std::span<const std::string> names,
                      const std::string& file) {
        std::vector<std::uint32_t> interfaces, patches;
        for (const std::uint32_t t : part.triangles) {
            interfaces.push_back(model_.structure.interface_of[t]);
            patches.push_back(model_.structure.patch_of[t]);
        }
        const std::vector<CellArray> cells{{"triangle", as_cells(part.triangles)},
                                           {"interface", as_cells(interfaces)},
                                           {"patch", as_cells(patches)}};
        WriteOptions options;
        options.format = format_named(part_format_);
        options.ascii = true; // binary STL would round the checked coordinates
        options.cells = cells;
        options.region_names = names;
        return write_mesh(part.mesh, folder_ / file, options);
    }

    Status write_json() {
        extras_.exact_volumes = model_.exact_volumes;
        extras_.exact_volumes.resize(model_.structure.blocks.size(), 0); // what rounding made
        extras_.free_borders = model_.borders;
        return write_file(folder_ / "model.json", to_json(model_.mesh, model_.structure, extras_));
    }

    const Model& model_;
    const std::string& part_format_;
    const std::filesystem::path& folder_;
    std::vector<std::string> labels_; ///< per surface
    StructureExtras extras_;
};

} // namespace

void add_statistics(Json& json, const Model& model, const StageTimes& times) {
    add_constants(json, "structure", structure_constants());
    json["seconds"]["volumes"] = times.latest("volumes");
    json["seconds"]["structure"] = times.latest("structure");
    json["output"]["volumes"] = model.block_count();
    Json volumes = Json::array();
    for (std::size_t b = 1; b < model.exact_volumes.size(); ++b)
        volumes.push_back(model.exact_volumes[b]);
    const Structure& s = model.structure;
    json["volumes"] = {{"all", model.exact_volumes[0]},
                       {"blocks", volumes},
                       {"too_thin", model.lost},
                       {"made_by_rounding", model.made},
                       {"interfaces", s.interfaces.size()},
                       {"patches", s.patches.size()},
                       {"lines", s.lines.size()},
                       {"corners", s.corners.size()},
                       {"free_borders", model.borders.size()}};
}

Result<Model> find_model(const Arranged& arranged, const BlockNaming& naming, Session& session,
                         Json& statistics) {
    session.begin("volumes", Phase::computing);
    auto model =
        make_model(arranged.exact, arranged.rounded.conforming.value(), session.run(), naming);
    session.end_stage();
    if (model) add_statistics(statistics, *model, session.times());
    return model;
}

Result<std::optional<LeakAdvice>> judge_leaks(const Arranged& arranged, const Model& model,
                                              Session& session) {
    if (arranged.sealed || model.borders.empty()) return std::optional<LeakAdvice>();
    session.begin("leaks", Phase::computing);
    auto advice = judge_leaks(arranged, model.borders, {}, session.run());
    session.end_stage();
    if (!advice) return advice.error();
    return std::optional(std::move(*advice));
}

std::string model_text(const Inputs& inputs, const Model& model,
                       const std::optional<LeakAdvice>& advice) {
    return blocks_text(inputs, model) + structure_text(model) + dangling_text(inputs, model) +
           leaks_text(inputs, model, advice);
}

std::vector<std::string> part_formats() {
    return {"vtp", "obj",   "ts",  "ply",  "off",  "stl",
            "msh", "msh22", "inp", "mesh", "poly", "smesh"};
}

Status write_model(const ModelReports& reports, const std::string& part_format,
                   const std::filesystem::path& folder, const Session& session) {
    return FolderWriter(reports, part_format, folder)(session);
}

} // namespace terrane::cli
