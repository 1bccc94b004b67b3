// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/model_folder.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/structure/structure_meshes.hpp>
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

    Status operator()(const Run& run) {
        for (const char* inner : {"blocks", "interfaces"}) {
            std::error_code failed;
            std::filesystem::create_directory(folder_ / inner, failed);
            if (failed)
                return Error{ErrorCode::cannot_open, "cannot be made: " + failed.message(),
                             final_path_of(folder_ / inner).string()};
        }
        if (auto done = write_result(); !done) return done;
        const Structure& s = model_.structure;
        extras_.block_files.resize(s.blocks.size());
        for (std::uint32_t b = 1; b < s.blocks.size(); ++b) {
            if (run.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
            if (s.blocks[b].interfaces.empty()) continue;
            extras_.block_files[b] = name("blocks/block_", b);
            const auto part = block_part(model_.mesh, model_.volumes, s, BlockId(b));
            if (auto done = write_part(part, {&s.blocks[b].name, 1}, extras_.block_files[b]); !done)
                return done;
        }
        for (std::uint32_t i = 0; i < s.interfaces.size(); ++i) {
            if (run.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
            extras_.interface_files.push_back(name("interfaces/interface_", i));
            const auto part = interface_part(model_.mesh, model_.volumes, s, InterfaceId(i));
            const auto [low, high] = s.interfaces[i].volumes;
            const std::array block_names{s.blocks[low].name, s.blocks[high].name};
            if (auto done = write_part(part, block_names, extras_.interface_files[i]); !done)
                return done;
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
        std::vector<CellArray> cells = volume_cells(model_.volumes.of_sides);
        cells.push_back({"interface", as_cells(model_.structure.interface_of)});
        cells.push_back({"patch", as_cells(model_.structure.patch_of)});
        std::vector<std::string> block_names;
        for (const ModelBlock& block : model_.structure.blocks) block_names.push_back(block.name);
        WriteOptions options;
        options.cells = cells;
        options.region_names = block_names;
        return write_mesh(model_.mesh, folder_ / "result.vtp", options);
    }

    /// Writes a part; `block_names` are those of the block, or of the blocks on both sides.
    Status write_part(const MeshPart& part, std::span<const std::string> block_names,
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
        options.region_names = block_names;
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

std::vector<ModelFile> model_files(const Model& model, const std::string& part_format) {
    std::vector<ModelFile> files{{"model.json", "json"}, {"result.vtp", "vtp"}};
    const Structure& s = model.structure;
    for (std::size_t b = 1; b < s.blocks.size(); ++b)
        if (!s.blocks[b].interfaces.empty())
            files.push_back({fmt::format("blocks/block_{}.{}", b, part_format), part_format});
    for (std::size_t i = 0; i < s.interfaces.size(); ++i)
        files.push_back({fmt::format("interfaces/interface_{}.{}", i, part_format), part_format});
    return files;
}

std::vector<std::string> part_formats() {
    return {"vtp", "obj",   "ts",  "ply",  "off",  "stl",
            "msh", "msh22", "inp", "mesh", "poly", "smesh"};
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
