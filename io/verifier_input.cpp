// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/verifier_input.hpp>

#include <utility>

#include <fmt/format.h>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/reading.hpp>

namespace terrane {
namespace {

Result<InputFile> read_stated(const CertifiedInput& stated, const std::filesystem::path& path,
                              std::optional<Format> format, const ReadOptions& options) {
    const auto contents = read_file(path);
    if (!contents) return contents.error();
    if (!format)
        return Error{ErrorCode::unknown_format, "no format that can be read has this extension",
                     stated.name};
    auto surfaces = parse_surfaces(*contents, stated.name, *format, options);
    InputFile file = input_file(*contents, {});
    if (surfaces)
        file.surfaces = std::move(*surfaces);
    else if (file.sha256 == stated.sha256)
        return surfaces.error();
    return file;
}

} // namespace

ArrangementClaim claim_of(const Arrangement& a) {
    ArrangementClaim claim;
    for (std::uint32_t v = 0; v < a.vertices.size(); ++v)
        claim.vertices.push_back(a.construction(VertexId(v)));
    claim.triangles = a.triangles;
    claim.parents_of = a.parents_of;
    claim.intersection_edges = a.intersection_edges;
    claim.degenerate = a.degenerate;
    claim.duplicates = a.inputs.duplicates;
    return claim;
}

Result<std::vector<InputFile>> read_certified(const Certificate& certificate,
                                              const std::vector<std::filesystem::path>& paths,
                                              const CertifiedReading& reading) {
    const auto& inputs = certificate.inputs;
    if (paths.size() != inputs.size())
        return Error{ErrorCode::bad_option,
                     fmt::format("the certificate is about {} {}, not {}", inputs.size(),
                                 inputs.size() == 1 ? "file" : "files", paths.size()),
                     reading.paths_name};
    std::vector<std::optional<Format>> formats;
    for (const CertifiedInput& input : inputs)
        formats.push_back(reading.format ? reading.format : format_of(input.name));
    if (const auto sound = check_reading(formats, reading.options, reading.option_names); !sound)
        return sound.error();
    std::vector<InputFile> files;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        auto file = read_stated(inputs[i], paths[i], formats[i], reading.options);
        if (!file) return file.error();
        files.push_back(std::move(*file));
    }
    return files;
}

} // namespace terrane
