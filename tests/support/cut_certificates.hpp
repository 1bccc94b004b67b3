// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of volumes of interest, as the producer writes them, for forgers to change.
#pragma once

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/volume_of_interest/boundary_surfaces.hpp>

#include "support/forged.hpp"

namespace forged {

/// A volume of interest, and what a certificate says about it.
struct Volume {
    std::vector<Surface> boundary;
    VolumeRecord record;
    std::vector<File> files{}; ///< of a surface
};

inline Volume prism_volume(const std::vector<Point2>& corners, double low, double high) {
    auto boundary = polygon_boundary(corners, low, high);
    REQUIRE(boundary);
    return {std::move(boundary).value(), {"prism", corners, {low, high}}};
}

inline Volume box_volume(const Point3& low, const Point3& high) {
    return prism_volume({{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}, low.z,
                        high.z);
}

inline Volume rotated_volume(const RotatedBox& box) {
    auto boundary = rotated_box_boundary(box);
    REQUIRE(boundary);
    return {std::move(boundary).value(), {"hexahedron", {}, {}}};
}

/// Returns the volume in the closed surfaces of a file.
inline Volume file_volume(const File& file) {
    const auto read = input_files({file});
    auto boundary = closed_boundary(read[0].surfaces);
    REQUIRE(boundary);
    VolumeRecord record{"surface", {}, {}, {}, read[0].surfaces};
    record.files.push_back({file.name, read[0].sha256, read[0].bytes, read[0].surfaces.size()});
    return {std::move(boundary).value(), std::move(record), {file}};
}

/// Returns the certificate of what is inside of a volume, with an output file in each format.
inline Subject cut_subject(const std::vector<File>& files, const Volume& volume,
                           const std::vector<std::string>& formats = {"obj"}) {
    Subject s;
    s.inputs = input_files(files);
    std::vector<InputRecord> records;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const InputFile& file = s.inputs[i];
        records.push_back({files[i].name, file.sha256, file.bytes, file.surfaces.size()});
        s.surfaces.insert(s.surfaces.end(), file.surfaces.begin(), file.surfaces.end());
    }
    const auto arranged = arrange_within(s.surfaces, volume.boundary);
    REQUIRE(arranged);
    REQUIRE(arranged->rounded.report.clean);
    s.surfaces = arranged->surfaces; // for the digest
    for (InputFile& file : input_files(volume.files)) s.inputs.push_back(std::move(file));
    std::vector<OutputRecord> outputs;
    for (const std::string& format : formats) {
        auto text = format_mesh(arranged->rounded.mesh, format_named(format).value(), {});
        REQUIRE(text);
        outputs.push_back(
            record_output(text.value(), "out." + format, format, arranged->rounded.mesh->surfaces));
        s.contents.push_back(std::move(text).value());
    }
    const auto text = to_cut_certificate(
        {records, arranged->surfaces, arranged->exact, &arranged->rounded, outputs}, volume.record,
        volume.boundary.size(), {});
    REQUIRE(text);
    s.certificate = Json::parse(text.value());
    return s;
}

} // namespace forged
