// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of volumes of interest, as the producer writes them, for forgers to change.
#pragma once

#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

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
    const auto records = add_inputs(s, files);
    const auto arranged = arrange_within(s.surfaces, volume.boundary);
    REQUIRE(arranged);
    REQUIRE(arranged->rounded.report.clean);
    s.surfaces = arranged->surfaces; // for the digest
    for (InputFile& file : input_files(volume.files)) s.inputs.push_back(std::move(file));
    const auto outputs = add_outputs(s, arranged->rounded.mesh, formats);
    const auto text = to_cut_certificate(
        {records, arranged->surfaces, arranged->exact, &arranged->rounded, outputs}, volume.record,
        volume.boundary.size(), {});
    REQUIRE(text);
    s.certificate = Json::parse(text.value());
    return s;
}

inline std::string wave_text(const std::string& name, double z, double slope) {
    constexpr int count = 7;
    std::string text;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j)
            text += "v " + std::to_string(1.7 * i) + " " + std::to_string(1.7 * j) + " " +
                    std::to_string(z + slope * i + 0.3 * std::sin(1.1 * i + 0.7 * j)) + "\n";
    text += "g " + name + "\n";
    for (int i = 0; i + 1 < count; ++i)
        for (int j = 0; j + 1 < count; ++j) {
            const int a = 1 + i * count + j, b = a + count;
            text += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
                    std::to_string(b + 1) + "\nf " + std::to_string(a) + " " +
                    std::to_string(b + 1) + " " + std::to_string(a + 1) + "\n";
        }
    return text;
}

/// Two horizons that cross, and a fault.
inline std::vector<File> crossing_sheets() {
    return {{"first.obj", wave_text("first", 0, 0.3)},
            {"second.obj", wave_text("second", 1, -0.2)},
            {"fault.obj", "v 4 -1 -3\nv 5 12 -3\nv 7 12 4\nv 6 -1 4\ng fault\nf 1 2 3\nf 1 3 4\n"}};
}

/// A body with eight faces.
inline File octahedron() {
    return {"body.obj", "v 1 5 0.2\nv 9 5 0.3\nv 5 1 0.1\nv 5 9 0.4\nv 5 5 -3\nv 5.1 5 4\ng body\n"
                        "f 1 3 6\nf 3 2 6\nf 2 4 6\nf 4 1 6\nf 3 1 5\nf 2 3 5\nf 4 2 5\nf 1 4 5\n"};
}

inline Volume the_box() {
    return box_volume({0.9, 1.1, -1.3}, {8.3, 7.7, 2.4});
}

/// A polygon that is not convex.
inline Volume the_prism() {
    return prism_volume({{1, 1}, {8.2, 1.3}, {7.6, 8.8}, {4.1, 3.3}, {1.5, 7.1}}, -1.2, 2.3);
}

} // namespace forged
