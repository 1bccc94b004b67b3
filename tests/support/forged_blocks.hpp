// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of blocks and tetrahedra with their output files, for forged.hpp.
#pragma once

#include <string>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/structure/structure_meshes.hpp>
#include <terrane/algorithms/tetgen/fill_blocks.hpp>
#include <terrane/io/block_certificate.hpp>
#include <terrane/io/meshes/gmsh.hpp>
#include <terrane/io/meshes/gmsh22.hpp>
#include <terrane/io/meshes/vtk.hpp>
#include <terrane/io/structure_json.hpp>

#include "support/forged.hpp"

namespace forged {

/// A model, with all that its certificate needs.
struct Modelled {
    Subject subject; ///< without certificate and outputs
    std::vector<InputRecord> records;
    Arrangement exact;
    RoundedMesh rounded;
    Model model;
};

inline Modelled modelled(const std::vector<File>& files) {
    Subject s;
    s.inputs = input_files(files);
    std::vector<InputRecord> records;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const InputFile& file = s.inputs[i];
        records.push_back({files[i].name, file.sha256, file.bytes, file.surfaces.size()});
        s.surfaces.insert(s.surfaces.end(), file.surfaces.begin(), file.surfaces.end());
    }
    auto exact = arrange(s.surfaces);
    REQUIRE(exact);
    auto rounded = round_to_doubles(exact.value());
    REQUIRE(rounded);
    REQUIRE(rounded->conforming);
    auto model = make_model(exact.value(), *rounded->conforming);
    REQUIRE(model);
    return {std::move(s), std::move(records), std::move(exact).value(), std::move(rounded).value(),
            std::move(model).value()};
}

using Cells = std::vector<CellArray>;

inline std::vector<std::int32_t> as_cells(const std::vector<std::uint32_t>& numbers) {
    return {numbers.begin(), numbers.end()};
}

/// The files of a folder as `terrane volume` writes it: name in the folder and contents.
inline std::vector<File> folder_of(const Model& model, const std::string& part_format) {
    std::vector<File> files;
    const auto add = [&](const std::string& name, const Mesh& mesh, const Cells& cells) {
        WriteOptions options;
        if (name.ends_with("vtp")) options.cells = cells;
        auto text =
            format_mesh(mesh, format_named(name.substr(name.rfind('.') + 1)).value(), options);
        REQUIRE(text);
        files.push_back({name, std::move(text).value()});
    };
    const Structure& s = model.structure;
    std::vector<std::uint32_t> front, back;
    for (const auto& sides : model.volumes.of_sides) {
        front.push_back(sides[0]);
        back.push_back(sides[1]);
    }
    add("result.vtp", model.mesh,
        {{"volume_front", as_cells(front)},
         {"volume_back", as_cells(back)},
         {"interface", as_cells(s.interface_of)},
         {"patch", as_cells(s.patch_of)}});
    const auto add_part = [&](const std::string& name, const MeshPart& part) {
        std::vector<std::uint32_t> interfaces, patches;
        for (const std::uint32_t t : part.triangles) {
            interfaces.push_back(s.interface_of[t]);
            patches.push_back(s.patch_of[t]);
        }
        add(name, part.mesh,
            {{"triangle", as_cells(part.triangles)},
             {"interface", as_cells(interfaces)},
             {"patch", as_cells(patches)}});
    };
    StructureExtras extras;
    extras.block_files.resize(s.blocks.size());
    for (std::uint32_t b = 1; b < s.blocks.size(); ++b) {
        if (s.blocks[b].interfaces.empty()) continue;
        extras.block_files[b] = "blocks/block_" + std::to_string(b) + "." + part_format;
        add_part(extras.block_files[b], block_part(model.mesh, model.volumes, s, BlockId(b)));
    }
    for (std::uint32_t i = 0; i < s.interfaces.size(); ++i) {
        extras.interface_files.push_back("interfaces/interface_" + std::to_string(i) + "." +
                                         part_format);
        add_part(extras.interface_files[i],
                 interface_part(model.mesh, model.volumes, s, InterfaceId(i)));
    }
    extras.exact_volumes = model.exact_volumes;
    extras.exact_volumes.resize(s.blocks.size());
    extras.free_borders = model.borders;
    files.push_back({"model.json", to_json(model.mesh, s, extras)});
    return files;
}

/// Returns the certificate of the blocks of these files, with the folder "model".
inline Subject block_subject(const std::vector<File>& files,
                             const std::string& part_format = "vtp") {
    Modelled m = modelled(files);
    std::vector<OutputRecord> outputs;
    for (const File& file : folder_of(m.model, part_format)) {
        outputs.push_back(record_output(file.contents, "model/" + file.name,
                                        file.name.substr(file.name.rfind('.') + 1),
                                        m.model.mesh->surfaces));
        m.subject.contents.push_back(file.contents);
    }
    m.subject.certificate =
        Json::parse(to_certificate({m.records, m.subject.surfaces, m.exact, &m.rounded, outputs},
                                   {m.model.volumes, m.model.block_count()}));
    return std::move(m.subject);
}

/// Returns the certificate of tetrahedra in the blocks of these files, in VTU, MSH 4.1 and MSH 2.2.
inline Subject tetrahedra_subject(const std::vector<File>& files,
                                  const TetrahedraRequest& request = {}) {
    Modelled m = modelled(files);
    const auto filled = fill_blocks(m.model, request);
    INFO((filled ? std::string() : filled.error().message()));
    REQUIRE(filled);
    REQUIRE(filled->report.violations.empty());
    const TetrahedralMesh& mesh = filled->tetrahedra;
    std::vector<OutputRecord> outputs;
    const auto add = [&](const std::string& format, std::string text) {
        outputs.push_back(record_output(text, "model." + format, format, mesh.surfaces));
        m.subject.contents.push_back(std::move(text));
    };
    add("vtu", to_vtu(mesh, true, {}).value());
    add("vtu", to_vtu(mesh, false, {}).value());
    add("msh", to_msh(mesh, filled->block_names));
    add("msh22", to_msh22(mesh, filled->block_names));
    m.subject.certificate =
        Json::parse(to_certificate({m.records, m.subject.surfaces, m.exact, &m.rounded, outputs},
                                   {m.model.volumes, m.model.block_count()}, mesh));
    return std::move(m.subject);
}

} // namespace forged
