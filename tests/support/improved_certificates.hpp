// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of improved meshes, as the producer writes them, for forgers to change.
#pragma once

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/quality/improve.hpp>

#include "support/forged.hpp"

namespace forged {

/// Returns the certificate of the improved arrangement of these files, with an output file in each
/// format.
inline Subject improved_subject(const std::vector<File>& files, const ImproveOptions& options,
                                const std::vector<std::string>& formats = {"obj"}) {
    Subject s;
    const auto [records, exact, rounded] = rounded_inputs(s, files);
    REQUIRE(rounded.report.clean);
    const auto made = improve_and_measure(*rounded.conforming, options);
    REQUIRE(made);
    REQUIRE(made->is_near_back());
    const Mesh& mesh = made->improved.mesh;
    const auto outputs = add_outputs(s, mesh, formats);
    s.certificate = Json::parse(to_improved_certificate(
        {records, s.surfaces, exact, &rounded, outputs}, mesh, made->improved.report.bound_of));
    return s;
}

} // namespace forged
