// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/cell_array.hpp>
#include <terrane/io/results.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/atomic_folder.hpp>
#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/meshes/vtm.hpp>
#include <terrane/io/structure_json.hpp>

namespace terrane {
namespace {

std::vector<std::int32_t> as_cells(const std::vector<std::uint32_t>& values) {
    return {values.begin(), values.end()};
}

/// How the blocks and interfaces of a model are written.
struct PartsForm {
    std::string format;
    bool together = false; ///< whether all blocks are one file, and all interfaces another one
};

PartsForm form_of(const Model& model, const std::string& part_format) {
    if (part_format != automatic_parts) return {part_format};
    const Structure& s = model.structure;
    return {"vtp", s.blocks.size() - 1 + s.interfaces.size() > most_single_parts};
}

/// Returns "blocks/block_7.vtp", say. MSH 2.2 has the extension of MSH.
std::string file_of_part(const char* start, std::size_t number, const std::string& format) {
    return fmt::format("{}{}.{}", start, number, format == "msh22" ? "msh" : format);
}

constexpr auto block_start = "blocks/block_", interface_start = "interfaces/interface_";
constexpr auto all_blocks = "blocks.vtp", all_interfaces = "interfaces.vtp";

class FolderWriter {
public:
    FolderWriter(const ModelReports& reports, const std::string& part_format,
                 const std::filesystem::path& folder) :
        model_(reports.model),
        values_(reports.values), form_(form_of(reports.model, part_format)), folder_(folder),
        labels_(unique_labels(reports.model.mesh->surfaces)), extras_(extras_of(reports)) {}

    Status operator()(const Run& run) {
        if (auto done = write_result(); !done) return done;
        name_parts();
        if (auto done = form_.together ? write_parts_together(run) : write_single_parts(run); !done)
            return done;
        if (form_.format == "vtp")
            if (auto done = write_file(folder_ / "model.vtm", to_vtm(groups())); !done) return done;
        return write_json();
    }

private:
    [[nodiscard]] const Structure& structure() const { return model_.structure; }

    /// Names the file of each block and interface.
    void name_parts() {
        const auto& blocks = structure().blocks;
        extras_.block_files.resize(blocks.size());
        for (std::uint32_t b = 1; b < blocks.size(); ++b)
            if (!blocks[b].interfaces.empty())
                extras_.block_files[b] =
                    form_.together ? all_blocks : file_of_part(block_start, b, form_.format);
        for (std::uint32_t i = 0; i < structure().interfaces.size(); ++i)
            extras_.interface_files.push_back(
                form_.together ? all_interfaces : file_of_part(interface_start, i, form_.format));
    }

    Status write_single_parts(const Run& run) {
        for (const char* inner : {"blocks", "interfaces"}) {
            std::error_code failed;
            std::filesystem::create_directory(folder_ / inner, failed);
            if (failed)
                return Error{ErrorCode::cannot_open, "cannot be made: " + failed.message(),
                             final_path_of(folder_ / inner).string()};
        }
        const Structure& s = structure();
        const auto surfaces = form_.format == "vtp" ? PartSurfaces::own : PartSurfaces::all;
        for (std::uint32_t b = 1; b < s.blocks.size(); ++b) {
            if (run.stop.stop_requested()) return stopped();
            if (s.blocks[b].interfaces.empty()) continue;
            const auto part = block_part(model_.mesh, model_.volumes, s, BlockId(b), surfaces);
            if (auto done = write_part(part, {}, {&s.blocks[b].name, 1}, extras_.block_files[b]);
                !done)
                return done;
        }
        for (std::uint32_t i = 0; i < s.interfaces.size(); ++i) {
            if (run.stop.stop_requested()) return stopped();
            const auto part =
                interface_part(model_.mesh, model_.volumes, s, InterfaceId(i), surfaces);
            const auto [low, high] = s.interfaces[i].volumes;
            const std::array block_names{s.blocks[low].name, s.blocks[high].name};
            if (auto done = write_part(part, {}, block_names, extras_.interface_files[i]); !done)
                return done;
        }
        return Done{};
    }

    Status write_parts_together(const Run& run) {
        const auto block_names = names_of_blocks();
        const auto blocks = block_parts(model_.mesh, model_.volumes, structure());
        if (auto done = write_part(blocks.all, {{"block", as_cells(blocks.part_of)}}, block_names,
                                   all_blocks);
            !done)
            return done;
        if (run.stop.stop_requested()) return stopped();
        return write_part(interface_parts(model_.mesh, model_.volumes, structure()).all, {},
                          block_names, all_interfaces);
    }

    static Error stopped() { return {ErrorCode::interrupted, "stopped on request", ""}; }

    /// Names the blocks on both sides of an interface, and its surfaces.
    [[nodiscard]] std::string name_of_interface(const ModelInterface& i) const {
        const auto& blocks = structure().blocks;
        std::string surfaces;
        for (const std::uint32_t s : i.surfaces)
            surfaces += (surfaces.empty() ? "" : " and ") + labels_[s];
        if (i.dangles()) return fmt::format("{} in {}", surfaces, blocks[i.volumes[0]].name);
        return fmt::format("{} between {} and {}", surfaces, blocks[i.volumes[0]].name,
                           blocks[i.volumes[1]].name);
    }

    [[nodiscard]] std::vector<FileGroup> groups() const {
        if (form_.together)
            return {{"parts", {{"blocks", all_blocks}, {"interfaces", all_interfaces}}}};
        FileGroup blocks{"blocks", {}}, interfaces{"interfaces", {}};
        const Structure& s = structure();
        for (std::size_t b = 1; b < s.blocks.size(); ++b)
            if (!extras_.block_files[b].empty())
                blocks.files.push_back({s.blocks[b].name, extras_.block_files[b]});
        for (std::size_t i = 0; i < s.interfaces.size(); ++i)
            interfaces.files.push_back(
                {name_of_interface(s.interfaces[i]), extras_.interface_files[i]});
        return {std::move(blocks), std::move(interfaces)};
    }

    [[nodiscard]] std::vector<std::string> names_of_blocks() const {
        std::vector<std::string> result;
        for (const ModelBlock& block : structure().blocks) result.push_back(block.name);
        return result;
    }

    Status write_result() {
        std::vector<CellArray> cells = volume_cells(model_.volumes.of_sides);
        cells.push_back({"interface", as_cells(structure().interface_of)});
        cells.push_back({"patch", as_cells(structure().patch_of)});
        const auto block_names = names_of_blocks();
        WriteOptions options;
        options.cells = cells;
        options.block_names = block_names;
        options.values = values_;
        return write_mesh(model_.mesh, folder_ / "result.vtp", options);
    }

    /// Writes parts; `block_names` are those of the block, of the blocks on both sides, or of all.
    Status write_part(const MeshPart& part, std::vector<CellArray> cells,
                      std::span<const std::string> block_names, const std::string& file) {
        std::vector<std::uint32_t> interfaces, patches;
        for (const std::uint32_t t : part.triangles) {
            interfaces.push_back(structure().interface_of[t]);
            patches.push_back(structure().patch_of[t]);
        }
        cells.push_back({"triangle", as_cells(part.triangles)});
        cells.push_back({"interface", as_cells(interfaces)});
        cells.push_back({"patch", as_cells(patches)});
        WriteOptions options;
        options.format = format_named(form_.format);
        options.ascii = true; // binary STL would round the checked coordinates
        options.cells = cells;
        options.block_names = block_names;
        return write_mesh(part.mesh, folder_ / file, options);
    }

    Status write_json() {
        return write_file(folder_ / "model.json", to_json(model_.mesh, structure(), extras_));
    }

    const Model& model_;
    const std::span<const SurfaceValues> values_;
    const PartsForm form_;
    const std::filesystem::path& folder_;
    std::vector<std::string> labels_; ///< per surface
    StructureExtras extras_;
};

} // namespace

StructureExtras extras_of(const ModelReports& reports) {
    const Model& model = reports.model;
    StructureExtras extras;
    extras.exact_volumes = model.exact_volumes;
    extras.exact_volumes.resize(model.structure.blocks.size(), 0); // what rounding made
    extras.free_borders = model.borders;
    if (reports.leaks) extras.leak_verdicts = reports.leaks->verdicts;
    if (!reports.sealed) return extras;
    extras.seal_distance = reports.sealed->distance;
    extras.seal_rules = reports.sealed->rules;
    extras.seal_changes = reports.sealed->changes;
    return extras;
}

std::vector<ModelFile> model_files(const Model& model, const std::string& part_format) {
    std::vector<ModelFile> files{{"model.json", "json"}, {"result.vtp", "vtp"}};
    const PartsForm form = form_of(model, part_format);
    if (form.together) {
        files.insert(files.end(), {{all_blocks, "vtp"}, {all_interfaces, "vtp"}});
        return files;
    }
    const Structure& s = model.structure;
    for (std::size_t b = 1; b < s.blocks.size(); ++b)
        if (!s.blocks[b].interfaces.empty())
            files.push_back({file_of_part(block_start, b, form.format), form.format});
    for (std::size_t i = 0; i < s.interfaces.size(); ++i)
        files.push_back({file_of_part(interface_start, i, form.format), form.format});
    return files;
}

std::vector<std::string> part_formats() {
    return {automatic_parts, "vtp",   "obj", "ts",   "ply",  "off",  "stl",
            "msh",           "msh22", "inp", "mesh", "poly", "smesh"};
}

bool is_certified(const std::string& part_format) {
    return part_format == automatic_parts || part_format == "vtp" || part_format == "obj";
}

Status write_model_files(const ModelReports& reports, const std::string& part_format,
                         const std::filesystem::path& folder, const Run& run) {
    return guarded("to write the model", "model",
                   [&]() -> Status { return FolderWriter(reports, part_format, folder)(run); });
}

Status write_model_folder(const ModelReports& reports, const std::string& part_format,
                          const std::filesystem::path& folder, const Run& run) {
    return guarded("to write the model", "model", [&]() -> Status {
        const auto known = part_formats();
        if (std::find(known.begin(), known.end(), part_format) == known.end())
            return Error{ErrorCode::unknown_format, "no format of blocks is called " + part_format,
                         ""};
        auto made = NewFolder::create(folder);
        if (!made) return made.error();
        if (auto done = write_model_files(reports, part_format, made->temporary(), run); !done)
            return done;
        return made->publish();
    });
}

} // namespace terrane
