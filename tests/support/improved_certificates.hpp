// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of improved meshes, as the producer writes them, for forgers to change.
#pragma once

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/quality/improve_measured.hpp>

#include "support/forged.hpp"

namespace forged {

/// Returns the certificate of the improved arrangement of these files, with an output file in each
/// format.
inline Subject improved_subject(const std::vector<File>& files, const ImproveOptions& options,
                                const std::vector<std::string>& formats = {"obj"}) {
    Subject s;
    s.inputs = input_files(files);
    std::vector<InputRecord> records;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const InputFile& file = s.inputs[i];
        records.push_back({files[i].name, file.sha256, file.bytes, file.surfaces.size()});
        s.surfaces.insert(s.surfaces.end(), file.surfaces.begin(), file.surfaces.end());
    }
    const auto exact = arrange(s.surfaces);
    REQUIRE(exact);
    const auto rounded = round_to_doubles(exact.value());
    REQUIRE(rounded);
    REQUIRE(rounded->report.clean);
    const auto made = improve_and_measure(*rounded->conforming, options);
    REQUIRE(made);
    REQUIRE(made->is_near_back());
    const Mesh& mesh = made->improved.mesh;
    std::vector<OutputRecord> outputs;
    for (const std::string& format : formats) {
        auto text = format_mesh(mesh, format_named(format).value(), {});
        REQUIRE(text);
        outputs.push_back(record_output(text.value(), "out." + format, format, mesh.surfaces));
        s.contents.push_back(std::move(text).value());
    }
    s.certificate = Json::parse(
        to_improved_certificate({records, s.surfaces, exact.value(), &rounded.value(), outputs},
                                mesh, made->improved.report.bound_of));
    return s;
}

} // namespace forged
