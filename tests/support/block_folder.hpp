// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The files of a folder as `terrane volume` writes it, for tests and fuzz targets without files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/structure/structure_meshes.hpp>
#include <terrane/io/files.hpp>
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
        for (std::uint32_t b = 1; b < s.blocks.size(); ++b) {
            if (s.blocks[b].interfaces.empty()) continue;
            extras.block_files[b] = "blocks/block_" + std::to_string(b) + "." + part_format_;
            add_part(extras.block_files[b], block_part(model_.mesh, model_.volumes, s, BlockId(b)));
        }
        for (std::uint32_t i = 0; i < s.interfaces.size(); ++i) {
            extras.interface_files.push_back("interfaces/interface_" + std::to_string(i) + "." +
                                             part_format_);
            add_part(extras.interface_files[i],
                     interface_part(model_.mesh, model_.volumes, s, InterfaceId(i)));
        }
        extras.exact_volumes = model_.exact_volumes;
        extras.exact_volumes.resize(s.blocks.size());
        extras.free_borders = model_.borders;
        files_.push_back({"model.json", to_json(model_.mesh, s, extras)});
        return std::move(files_);
    }

private:
    void add(const std::string& name, const Mesh& mesh, const std::vector<CellArray>& cells) {
        WriteOptions options;
        if (name.ends_with("vtp")) options.cells = cells;
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
             {"patch", as_cells(s.patch_of)}});
    }

    void add_part(const std::string& name, const MeshPart& part) {
        std::vector<std::uint32_t> interfaces, patches;
        for (const std::uint32_t t : part.triangles) {
            interfaces.push_back(model_.structure.interface_of[t]);
            patches.push_back(model_.structure.patch_of[t]);
        }
        add(name, part.mesh,
            {{"triangle", as_cells(part.triangles)},
             {"interface", as_cells(interfaces)},
             {"patch", as_cells(patches)}});
    }

    const Model& model_;
    std::string part_format_;
    std::vector<FolderFile> files_;
};

/// Returns the files of a folder with a model; parts are in this format.
inline std::vector<FolderFile> folder_of(const Model& model, const std::string& part_format) {
    return FolderFiles(model, part_format)();
}

} // namespace block_folder
