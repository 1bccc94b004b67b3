// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of blocks and tetrahedra with their output files, for forged.hpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/io/block_certificate.hpp>
#include <terrane/io/meshes/abaqus.hpp>
#include <terrane/io/meshes/gmsh.hpp>
#include <terrane/io/meshes/gmsh22.hpp>
#include <terrane/io/meshes/vtk.hpp>

#include "support/block_folder.hpp"
#include "support/forged.hpp"

namespace forged {

/// A box from (low, low, low) to (high, high, high), as OBJ.
inline std::string cube(const std::string& name, const std::string& low, const std::string& high) {
    std::string text;
    for (const std::string& z : {low, high})
        for (const std::string& y : {low, high})
            for (const std::string& x : {low, high}) text += "v " + x + " " + y + " " + z + "\n";
    return text + "g " + name +
           "\nf 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\n"
           "f 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n";
}

/// A box with a box inside, which holds a third one and a sheet; a horizon divides the outer one;
/// and a box apart from all.
inline std::vector<File> nested() {
    return {{"outer.obj", cube("outer", "0", "9")},
            {"inner.obj", cube("inner", "1", "4")},
            {"innermost.obj", cube("innermost", "2", "2.1")},
            {"sheet.obj", "v 3 3 3\nv 3.5 3 3\nv 3 3.25 3.125\ng sheet\nf 1 2 3\n"},
            {"level.obj", "v -1 -1 6\nv 10 -1 6.5\nv 10 10 6\nv -1 10 6.25\n"
                          "g level\nf 1 2 3\nf 1 3 4\n"},
            {"apart.obj", cube("apart", "20", "21")}};
}

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

/// Returns the certificate of the blocks of these files, with the folder "model".
inline Subject block_subject(const std::vector<File>& files,
                             const std::string& part_format = "vtp") {
    Modelled m = modelled(files);
    std::vector<OutputRecord> outputs;
    for (const auto& file : block_folder::folder_of(m.model, part_format)) {
        outputs.push_back(record_output(file.contents, "model/" + file.name,
                                        file.name.substr(file.name.rfind('.') + 1),
                                        m.model.mesh->surfaces));
        m.subject.contents.push_back(file.contents);
    }
    m.subject.certificate =
        Json::parse(to_certificate({m.records, m.subject.surfaces, m.exact, &m.rounded, outputs},
                                   {m.model, extras_of({m.model, std::nullopt, std::nullopt})}));
    return std::move(m.subject);
}

/// Returns the certificate of tetrahedra in the blocks of these files, in VTU, MSH 4.1, MSH 2.2 and Abaqus.
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
    add("vtu", to_vtu(mesh, true, {}, filled->block_names).value());
    add("vtu", to_vtu(mesh, false, {}, filled->block_names).value());
    add("msh", to_msh(mesh, filled->block_names));
    add("msh22", to_msh22(mesh, filled->block_names));
    add("inp", to_abaqus(mesh, filled->block_names));
    m.subject.certificate = Json::parse(to_certificate(
        {m.records, m.subject.surfaces, m.exact, &m.rounded, outputs}, {m.model}, mesh));
    return std::move(m.subject);
}

} // namespace forged
