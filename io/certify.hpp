// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Makes the certificate of a result whose files are written: the present contents of all files are
// hashed. A certificate claims and the verifier judges: files or results that do not belong together
// make one that is refuted. certificate.hpp and block_certificate.hpp define its text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/search/method.hpp>
#include <terrane/io/files.hpp>

namespace terrane {

/// A file that surfaces were read from.
struct SourceFile {
    std::filesystem::path file; ///< the certificate names it relative to its own folder
    std::size_t surfaces = 0;   ///< number of surfaces that were read from it
};

/// A file that holds the result.
struct ResultFile {
    std::filesystem::path file;            ///< "-": standard output
    std::string format;                    ///< see certified_format()
    std::optional<std::string> contents{}; ///< none: those of the file
};

/// Returns the name of an output's format in certificates, "stl-ascii" for an STL file in text;
/// empty: the verifier does not read the format.
std::string certified_format(Format format, bool ascii = false);

/// A surface whose holes were filled.
struct FilledRecord {
    const Surface* filled = nullptr;              ///< given ones, then new ones
    std::size_t given_vertices = 0;               ///< its first ones
    std::size_t given_triangles = 0;              ///< its first ones
    std::span<const std::int32_t> interpolated{}; ///< per triangle: the number of its hole, or 0
    std::span<const double> deviation{};          ///< per vertex: its expected error; NaN: unknown
};

/// A result and what it was made of, by reference: the values must outlive it. Members that are not
/// part of it are null or empty.
/// They decide on the kind of the certificate: `filled` makes it one of filled surfaces, `layered` one
/// of layers, `tetrahedra` one of tetrahedra, `model` one of blocks, `improved` one of an improved
/// mesh. Without them it is one of an arrangement, which also lists parts cut away and added.
struct CertifiedResult {
    std::vector<SourceFile> inputs{};    ///< in the order in which they were read
    std::vector<ResultFile> outputs{};   ///< the files that hold the result
    std::span<const Surface> surfaces{}; ///< of all inputs, with the names and roles of their files
                                         ///< and with added parts, then the boundary
    const Arrangement* exact = nullptr;  ///< of the surfaces, or the part of it that was kept
    const RoundedMesh* rounded = nullptr;        ///< `exact` in doubles
    const Improved* improved = nullptr;          ///< made of `rounded`
    const Model* model = nullptr;                ///< of the rounded mesh, not of an improved one
    std::optional<SealReport> sealed{};          ///< that the model's files tell of
    std::optional<LeakAdvice> leaks{};           ///< likewise
    const TetrahedralMesh* tetrahedra = nullptr; ///< of the model
    std::vector<FilledRecord> filled{};          ///< one per surface
    const Layered* layered = nullptr;            ///< a stack of the surfaces
    std::span<const Layer> order{};              ///< of the stack, from the top down
    ProjectVolume volume{};                      ///< the volume of interest
    std::size_t boundary_count = 0; ///< number of the last surfaces, which bound the volume
    std::span<const SurfaceGrowth> growth{}; ///< per surface before these; empty: unchanged
    Search search = Search::automatic;       ///< for arranging the left-out part again
};

/// Returns an arrangement as a result, without files.
CertifiedResult result_of(const Arranged& arranged);

/// Returns the files of a model that is in `folder`, with blocks and interfaces in `part_format`.
std::vector<ResultFile> outputs_of(const Model& model, const std::filesystem::path& folder,
                                   const std::string& part_format);

/// Returns the text of the certificate of a result, to be written to `path`. Errors: bad_option (the
/// path of a file or the name of a surface is not UTF-8), cannot_open, those of cut_sections().
Result<std::string> certify(const CertifiedResult& result, const std::filesystem::path& path,
                            const Run& run = {});

/// Returns the deviation that the certificate states; 0: it states none.
double stated_deviation(const CertifiedResult& result);

} // namespace terrane
