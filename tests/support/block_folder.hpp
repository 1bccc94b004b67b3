// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The files of a folder as `terrane volume` writes it, for tests and fuzz targets without files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/results.hpp>
#include <terrane/io/structure_json.hpp>

namespace block_folder {

using namespace terrane;

/// A file: its name in the folder, and its contents.
struct FolderFile {
    std::string name, contents;
};

inline std::vector<std::int32_t> as_cells(const std::vector<std::uint32_t>& numbers) {
    return {numbers.begin(), numbers.end()};
}

/// Stands for the format in which all blocks are one file, and all interfaces another one.
inline constexpr const char* together = "together";

/// Makes files one after the other.
class FolderFiles {
public:
    FolderFiles(const Model& model, std::string part_format) :
        model_(model), part_format_(std::move(part_format)) {}

    std::vector<FolderFile> operator()() {
        const Structure& s = model_.structure;
        add_result();
        StructureExtras extras;
        extras.block_files.resize(s.blocks.size());
        for (std::uint32_t b = 1; b < s.blocks.size(); ++b)
            if (!s.blocks[b].interfaces.empty())
                extras.block_files[b] = name("blocks", "/block_", b);
        for (std::uint32_t i = 0; i < s.interfaces.size(); ++i)
            extras.interface_files.push_back(name("interfaces", "/interface_", i));
        if (part_format_ == together)
            add_all_parts();
        else
            add_single_parts(extras);
        const StructureExtras more = extras_of({model_, std::nullopt, std::nullopt});
        extras.exact_volumes = more.exact_volumes;
        extras.free_borders = more.free_borders;
        files_.push_back({"model.json", to_json(model_.mesh, s, extras)});
        return std::move(files_);
    }

    /// Returns the file of all blocks.
    [[nodiscard]] std::string text_of(const MeshParts& blocks) {
        add_part("blocks.vtp", blocks.all, block_names(), {{"block", as_cells(blocks.part_of)}});
        std::string text = std::move(files_.back().contents);
        files_.pop_back();
        return text;
    }

private:
    [[nodiscard]] std::string name(const std::string& kind, const std::string& start,
                                   std::size_t number) const {
        if (part_format_ == together) return kind + ".vtp";
        return kind + start + std::to_string(number) + "." + part_format_;
    }

    [[nodiscard]] std::vector<std::string> block_names() const {
        std::vector<std::string> names;
        for (const ModelBlock& block : model_.structure.blocks) names.push_back(block.name);
        return names;
    }

    void add_single_parts(const StructureExtras& extras) {
        const Structure& s = model_.structure;
        const auto named = part_format_ == "vtp" ? PartSurfaces::own : PartSurfaces::all;
        for (std::uint32_t b = 1; b < s.blocks.size(); ++b)
            if (!extras.block_files[b].empty())
                add_part(extras.block_files[b],
                         block_part(model_.mesh, model_.volumes, s, BlockId(b), named),
                         {s.blocks[b].name});
        for (std::uint32_t i = 0; i < s.interfaces.size(); ++i) {
            const auto [low, high] = s.interfaces[i].volumes;
            add_part(extras.interface_files[i],
                     interface_part(model_.mesh, model_.volumes, s, InterfaceId(i), named),
                     {s.blocks[low].name, s.blocks[high].name});
        }
    }

    void add_all_parts() {
        const Structure& s = model_.structure;
        files_.push_back({"blocks.vtp", text_of(block_parts(model_.mesh, model_.volumes, s))});
        add_part("interfaces.vtp", interface_parts(model_.mesh, model_.volumes, s).all,
                 block_names());
    }

    void add(const std::string& name, const Mesh& mesh, const std::vector<CellArray>& cells,
             const std::vector<std::string>& names) {
        WriteOptions options;
        if (name.ends_with("vtp")) options.cells = cells;
        options.block_names = names;
        const auto format = format_named(name.substr(name.rfind('.') + 1)).value();
        files_.push_back({name, format_mesh(mesh, format, options).value()});
    }

    void add_result() {
        const Structure& s = model_.structure;
        std::vector<std::uint32_t> front, back;
        for (const auto& sides : model_.volumes.of_sides) {
            front.push_back(sides[0]);
            back.push_back(sides[1]);
        }
        add("result.vtp", model_.mesh,
            {{"volume_front", as_cells(front)},
             {"volume_back", as_cells(back)},
             {"interface", as_cells(s.interface_of)},
             {"patch", as_cells(s.patch_of)}},
            block_names());
    }

    void add_part(const std::string& name, const MeshPart& part,
                  const std::vector<std::string>& names, std::vector<CellArray> cells = {}) {
        std::vector<std::uint32_t> interfaces, patches;
        for (const std::uint32_t t : part.triangles) {
            interfaces.push_back(model_.structure.interface_of[t]);
            patches.push_back(model_.structure.patch_of[t]);
        }
        cells.push_back({"triangle", as_cells(part.triangles)});
        cells.push_back({"interface", as_cells(interfaces)});
        cells.push_back({"patch", as_cells(patches)});
        add(name, part.mesh, cells, names);
    }

    const Model& model_;
    std::string part_format_;
    std::vector<FolderFile> files_;
};

/// Returns the files of a folder with a model; parts are in this format, or `together`.
inline std::vector<FolderFile> folder_of(const Model& model, const std::string& part_format) {
    return FolderFiles(model, part_format)();
}

} // namespace block_folder
