// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of surfaces that were sealed, extended or trimmed.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include "support/cut_certificates.hpp"

namespace forged {

struct Growing {
    std::optional<Volume> volume{};
    double seal = 0, extend = 0;
};

/// Adds the records of inputs and outputs and the certificate to a subject.
inline void certify(Subject& s, const std::vector<File>& files, const Arranged& arranged,
                    const Volume* volume, const std::vector<std::string>& formats) {
    std::vector<InputRecord> records;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const InputFile& file = s.inputs[i];
        records.push_back({files[i].name, file.sha256, file.bytes, file.surfaces.size()});
    }
    s.surfaces = arranged.surfaces; // for the digest
    if (volume != nullptr)
        for (InputFile& file : input_files(volume->files)) s.inputs.push_back(std::move(file));
    std::vector<OutputRecord> outputs;
    const Mesh& mesh = arranged.rounded.mesh;
    for (const std::string& format : formats) {
        auto text = format_mesh(mesh, format_named(format).value(), {});
        REQUIRE(text);
        outputs.push_back(record_output(text.value(), "out." + format, format, mesh.surfaces));
        s.contents.push_back(std::move(text).value());
    }
    const auto text =
        to_cut_certificate({records, arranged.surfaces, arranged.exact, &arranged.rounded, outputs},
                           {volume == nullptr ? nullptr : &volume->record,
                            volume == nullptr ? 0 : volume->boundary.size(), arranged.growth},
                           {});
    REQUIRE(text);
    s.certificate = Json::parse(text.value());
}

/// Returns the certificate of surfaces that were sealed or extended, with an output file in each
/// format.
inline Subject sealed_subject(const std::vector<File>& files, const Growing& how,
                              const std::vector<std::string>& formats = {"obj"}) {
    Subject s;
    s.inputs = input_files(files);
    std::vector<Surface> surfaces;
    for (const InputFile& file : s.inputs)
        surfaces.insert(surfaces.end(), file.surfaces.begin(), file.surfaces.end());
    ArrangeWithinOptions options;
    options.seal = how.seal;
    options.extend = how.extend;
    const auto arranged = arrange_within(
        surfaces, how.volume ? how.volume->boundary : std::vector<Surface>(), options);
    REQUIRE(arranged);
    REQUIRE(arranged->rounded.report.clean);
    certify(s, files, arranged.value(), how.volume ? &*how.volume : nullptr, formats);
    return s;
}

using Corners = std::array<Point3, 3>;

/// Returns the certificate that a producer would write who adds these triangles to surfaces, by their
/// numbers, and keeps the exact triangles for which keep(corners, parents) is true.
inline Subject
self_made(const std::vector<File>& files, const std::map<std::size_t, std::vector<Corners>>& added,
          const std::function<bool(const Corners&, const std::set<std::uint32_t>&)>& keep) {
    Subject s;
    s.inputs = input_files(files);
    Arranged arranged;
    for (const InputFile& file : s.inputs)
        arranged.surfaces.insert(arranged.surfaces.end(), file.surfaces.begin(),
                                 file.surfaces.end());
    for (const Surface& surface : arranged.surfaces)
        arranged.growth.push_back({surface.triangles.size(), surface.triangles.size()});
    for (const auto& [number, triangles] : added)
        for (const Corners& corners : triangles) {
            Surface& surface = arranged.surfaces[number];
            const auto v = static_cast<std::uint32_t>(surface.vertices.size());
            surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
            surface.triangles.push_back({v, v + 1, v + 2});
        }
    auto whole = arrange(arranged.surfaces);
    REQUIRE(whole);
    const auto rounded = round_to_doubles(whole.value());
    REQUIRE(rounded);
    const Mesh& mesh = rounded->mesh;
    REQUIRE(mesh.triangles.size() == whole->triangles.size());
    std::vector<bool> kept;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const auto parents = mesh.parents_of[t];
        kept.push_back(keep({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]},
                            {parents.begin(), parents.end()}));
    }
    arranged.exact = restricted(std::move(whole).value(), kept);
    auto rounded_part = round_to_doubles(arranged.exact);
    REQUIRE(rounded_part);
    arranged.rounded = std::move(rounded_part).value();
    certify(s, files, arranged, nullptr, {"obj"});
    return s;
}

/// Computes the surfaces of the exact part, the digest and the hashes anew.
inline void seal_grown(Subject& s) {
    const auto parsed = parse_certificate(s.certificate.dump(), "c");
    if (parsed && parsed->cut && parsed->sealed) {
        std::size_t own = 0;
        std::vector<Surface> files;
        for (const InputFile& file : s.inputs) {
            own += file.surfaces.size();
            files.insert(files.end(), file.surfaces.begin(), file.surfaces.end());
        }
        if (parsed->sealed->surfaces.size() == own && parsed->cut->volume.files == 0)
            s.surfaces = verifier::surfaces_of_exact(files, parsed.value());
    }
    seal(s);
}

/// Does what check_forgeries() does, for certificates of grown surfaces.
inline void check_grown(const Subject& right, const std::vector<Forgery>& forgeries) {
    REQUIRE(judged(right) == "");
    for (const Forgery& forgery : forgeries) {
        INFO(forgery.name);
        Subject wrong = right;
        forgery.change(wrong.certificate);
        REQUIRE(wrong.certificate != right.certificate);
        seal_grown(wrong);
        const auto rules = judged(wrong);
        INFO(rules);
        CHECK((" " + rules + " ").find(" " + forgery.rule + " ") != std::string::npos);
    }
}

/// A sheet z = height + slope y over x from `low` to `high` and y from 0 to 10, of 6 by 5 cells.
inline std::string sheet_text(const std::string& name, double low, double high, double height,
                              double slope) {
    std::string text;
    for (int i = 0; i <= 6; ++i)
        for (int j = 0; j <= 5; ++j)
            text += "v " + std::to_string(low + (high - low) * i / 6) + " " +
                    std::to_string(2 * j) + " " +
                    std::to_string(height + slope * 2 * j + 0.1 * ((i * j) % 3)) + "\n";
    text += "g " + name + "\n";
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 5; ++j) {
            const int a = 1 + 6 * i + j, b = a + 6;
            text += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
                    std::to_string(b + 1) + "\nf " + std::to_string(a) + " " +
                    std::to_string(b + 1) + " " + std::to_string(a + 1) + "\n";
        }
    return text;
}

/// A sheet that ends 0.1 short of a fault, one that reaches 0.15 beyond it, and the fault.
inline std::vector<File> gaping() {
    return {{"short.obj", sheet_text("short", 0, 4.9, 0, 0.05)},
            {"long.obj", sheet_text("long", 0, 5.15, 2, -0.03)},
            {"fault.obj", "v 5 -1 -3\nv 5 11 -3\nv 5 11 5\nv 5 -1 5\ng fault\nf 1 2 3\nf 1 3 4\n"}};
}

inline Volume gaping_box() {
    return box_volume({1.3, 1.1, -1.3}, {5.5, 8.7, 3.4});
}

} // namespace forged
