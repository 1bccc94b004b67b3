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
    const auto records = add_inputs(s, files);
    const auto layered = stack_layers(s.surfaces, order);
    REQUIRE(layered);
    REQUIRE(layered->is_stack());
    const Mesh& mesh = layered->rounded.mesh;
    const auto outputs = add_outputs(s, mesh, formats);
    s.certificate =
        Json::parse(to_layered_certificate(records, s.surfaces, outputs, order, *layered));
    return s;
}

} // namespace forged
