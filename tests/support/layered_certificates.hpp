// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of layers, as the producer writes them, for forgers to change.
#pragma once

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/layers/layers.hpp>

#include "support/forged.hpp"

namespace forged {

/// Returns the certificate of these surfaces in this order, with an output file in each format.
inline Subject layered_subject(const std::vector<File>& files, const std::vector<Layer>& order,
                               const std::vector<std::string>& formats = {"obj"}) {
    Subject s;
    s.inputs = input_files(files);
    std::vector<InputRecord> records;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const InputFile& file = s.inputs[i];
        records.push_back({files[i].name, file.sha256, file.bytes, file.surfaces.size()});
        s.surfaces.insert(s.surfaces.end(), file.surfaces.begin(), file.surfaces.end());
    }
    const auto layered = stack_layers(s.surfaces, order);
    REQUIRE(layered);
    REQUIRE(layered->is_stack());
    const Mesh& mesh = layered->rounded.mesh;
    std::vector<OutputRecord> outputs;
    for (const std::string& format : formats) {
        auto text = format_mesh(mesh, format_named(format).value(), {});
        REQUIRE(text);
        outputs.push_back(record_output(text.value(), "out." + format, format, mesh.surfaces));
        s.contents.push_back(std::move(text).value());
    }
    s.certificate =
        Json::parse(to_layered_certificate(records, s.surfaces, outputs, order, *layered));
    return s;
}

} // namespace forged
