// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What the verifier judges, from what the library made and from files. None of this is code of the verifier, and the
// library does not contain it: it would need the verifier.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/reading.hpp>

namespace terrane {

/// Returns the exact result as a claim.
inline ArrangementClaim claim_of(const Arrangement& a) {
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

/// How the input files of a certificate are read, and how the caller names that.
struct CertifiedReading {
    std::optional<Format> format{}; ///< none: that of each file's name
    ReadOptions options{};
    const char* paths_name = "";                  ///< of a wrong number of files
    std::array<const char*, 2> option_names = {}; ///< see check_reading()
};

namespace detail {
inline Result<InputFile> read_stated(const CertifiedInput& stated,
                                     const std::filesystem::path& path,
                                     std::optional<Format> format, const ReadOptions& options) {
    const auto contents = read_file(path);
    if (!contents) return contents.error();
    if (!format)
        return Error{ErrorCode::unknown_format, "no format that can be read has this extension",
                     path.string()};
    auto surfaces = parse_surfaces(*contents, stated.name, *format, options);
    InputFile file = input_file(*contents, {});
    if (surfaces)
        file.surfaces = std::move(*surfaces);
    else if (file.sha256 == stated.sha256)
        return surfaces.error();
    return file;
}
} // namespace detail

/// Reads the input files of a certificate, which are at these paths. A file whose hash differs from the certificate's
/// need not parse: the verifier rejects it by its hash. Errors: cannot_open; unknown_format; bad_option where there
/// are other files than the certificate is about, and those of check_reading; those of parsing a file that has the
/// stated hash.
inline Result<std::vector<InputFile>>
read_certified(const Certificate& certificate, const std::vector<std::filesystem::path>& paths,
               const CertifiedReading& reading) {
    const auto& inputs = certificate.inputs;
    if (paths.size() != inputs.size())
        return Error{ErrorCode::bad_option,
                     "the certificate is about " + std::to_string(inputs.size()) +
                         (inputs.size() == 1 ? " file, not " : " files, not ") +
                         std::to_string(paths.size()),
                     reading.paths_name};
    std::vector<std::optional<Format>> formats;
    for (const std::filesystem::path& path : paths)
        formats.push_back(reading.format ? reading.format : format_of(path));
    if (const auto sound = check_reading(formats, reading.options, reading.option_names); !sound)
        return sound.error();
    std::vector<InputFile> files;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        auto file = detail::read_stated(inputs[i], paths[i], formats[i], reading.options);
        if (!file) return file.error();
        files.push_back(std::move(*file));
    }
    return files;
}

} // namespace terrane
