// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A certificate holds all that is needed to check a result against its input files. It is a JSON
// text in UTF-8:
//
//   { "format": "terrane-certificate", "version": 2,
//     "kind": "arrangement",         of the surfaces as they are in the files; other kinds have
//                                    more sections
//     "inputs": [                    the files, in the order of reading
//       { "name": "faults.ts",       relative to the folder of the certificate
//         "sha256": "9f86d0...",     of the bytes of the file, 64 lower-case hexadecimal digits
//         "bytes": 1204,
//         "surfaces": [{ "name": "F1", "role": "fault", "vertices": 12, "triangles": 14 }] } ],
//     "outputs": [                   the files with the mesh of doubles
//       { "name": "model.vtp",       relative to the folder of the certificate; "-" is standard
//                                    output
//         "format": "vtp",           "stl": binary; "stl-ascii"; else the extension
//         "sha256": "...", "bytes": 4711,
//         "surfaces": [{ "name": "F1", "role": "fault" }] } ],  what the file calls them
//     "exact": {                     the arrangement, in exact numbers
//       "vertices": [                by construction from input vertices; no two are equal
//         ["v", i],                  input vertex i
//         ["lp", p, q, a, b, c],     where line p q meets plane a b c
//         ["ppp", a, b, c, d, e, f, g, h, i],  where planes a b c, d e f and g h i meet
//         ["ll", p, q, r, s, "z"] ], where the coplanar lines p q and r s meet; they are not
//                                    parallel when seen along this axis
//       "triangles": [[u, v, w]],    three vertices, by position in "vertices"
//       "parents": [[p, ...]],       per triangle: all input triangles that contain it, ascending
//       "intersection_edges": [[u, v]],  u < v, ascending; rule R7 says which (verdict.hpp)
//       "degenerate": [t, ...],      input triangles without area, ascending
//       "duplicates": [[t, first]] },  input triangle t has the three points of an earlier one
//     "rounded": {                   the mesh of doubles, as written to files; or null
//       "vertices": [["0.5", "-1e-3", "7"]],  x, y, z: the shortest decimal that reads back as the
//                                    same double
//       "triangles", "parents", "intersection_edges": as above, of these vertices
//       "regions": [[r, ...]],       per triangle: its region in each of its surfaces
//       "clean": true,               triangles meet in shared vertices and edges only
//       "max_move": "1.1e-16",       upper bound of the distance of a vertex to its exact point;
//                                    null if the triangles are not those of "exact"
//       "deviation": "1.1e-16",      upper bound of the distances of triangles to their parents and
//                                    of parents to their triangles; the verifier computes its own
//       "vanished": [t, ...] },      input triangles with area that have no part left, ascending
//     "digest": "sha256:..." }       of the exact part; arrangement.hpp defines it
//
// Each object has these keys and no others. Numbers are whole and without sign.
// Input vertices and triangles are counted from 0 through all surfaces of all files. JSON cannot
// state names that are not UTF-8: each wrong byte becomes U+FFFD, and the verifier refuses the
// certificate. The program refuses such names before the work.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/io/files.hpp>

namespace terrane {

/// An input file: the hash of its bytes, and the number of surfaces that were read from it.
struct InputRecord {
    std::string name;         ///< its name in the certificate
    std::string sha256;       ///< 64 lower-case hexadecimal digits
    std::uint64_t bytes = 0;  ///< length of the file
    std::size_t surfaces = 0; ///< number of surfaces read from it
};

/// Hashes the current contents of a file. Errors: cannot_open.
Result<InputRecord> record_input(const std::filesystem::path& path, std::string name,
                                 std::size_t surfaces);

/// An output file: the hash of its bytes, and its names of the surfaces.
struct OutputRecord {
    std::string name;                  ///< its name in the certificate; "-": standard output
    std::string format;                ///< "obj", "stl", "stl-ascii", ...
    std::string sha256;                ///< 64 lower-case hexadecimal digits
    std::uint64_t bytes = 0;           ///< length of the file
    std::vector<SurfaceInfo> surfaces; ///< order of the input
};

/// Hashes the contents of an output file, which calls the surfaces so.
OutputRecord record_output(std::string_view contents, std::string name, std::string format,
                           const std::vector<SurfaceInfo>& surfaces);

/// Returns the name of a file in a certificate: its path relative to the folder of the
/// certificate.
std::string certified_name(const std::filesystem::path& path,
                           const std::filesystem::path& certificate);

/// A volume of interest, as it was asked for.
struct VolumeRecord {
    std::string shape = "prism"; ///< "prism", "hexahedron" or "surface": see verify.hpp
    std::vector<std::array<double, 2>> corners{}; ///< of a prism: its polygon, in order
    std::vector<double> between{};                ///< of a prism: its two heights, the lower first
    std::vector<InputRecord> files{};             ///< of a surface
    std::vector<Surface> surfaces{};              ///< of a surface: of these files, in order
};

/// The parts that were left out of surfaces, and those that were added.
struct CutRecord {
    const VolumeRecord* volume = nullptr; ///< the cut volume; nullptr: none
    std::size_t boundary_count = 0;       ///< number of the last surfaces, which bound the volume
    std::span<const SurfaceGrowth> growth{}; ///< per surface before these; empty: nothing was
                                             ///< sealed or extended
};

/// The claims of certificates about surfaces that were cut, sealed or extended: the keys "cut" and,
/// if something can have been added, "sealed".
struct CutSections {
    Arrangement whole;               ///< of all surfaces, which `Certified::exact` is a part of
    std::string text;                ///< the keys
    std::vector<InputRecord> files;  ///< all input files, with those of the volume
    std::vector<Surface> surfaces{}; ///< in these files, without added parts
};

/// The contents of a certificate, by reference: the values must outlive it.
struct Certified {
    std::span<const InputRecord> files;      ///< in the order in which they were read
    std::span<const Surface> surfaces;       ///< of all files, in order
    const Arrangement& exact;                ///< of these surfaces
    const RoundedMesh* rounded = nullptr;    ///< nullptr: "rounded" is null
    std::span<const OutputRecord> outputs{}; ///< the files that hold the rounded mesh
    /// With a volume of interest, or sealed or extended surfaces; nullptr: nothing was changed.
    const CutSections* cut = nullptr;
};

/// Returns the text of a certificate. Cost: linear; a second for 200 000 triangles.
/// Precondition: the sum of files[].surfaces is the number of surfaces.
std::string to_certificate(const Certified& certified, const Run& run = {});

/// Returns the deviation that a certificate states of a rounded arrangement, or of layers: more
/// than `report.deviation`, as the verifier shows it without knowing how the mesh was made.
double stated_deviation(const Arrangement& exact, const RoundedMesh& rounded);
double stated_deviation(const Layered& layered);

/// Returns the text of a certificate of the kind "cut". It has the keys of a certificate of an
/// arrangement, of which "exact" and "digest" are about all surfaces with the boundary of the
/// volume as the last ones, and "rounded" about the kept part; and
///
///   "cut": {
///     "volume": {
///       "shape": "prism",          or "hexahedron", or "surface", of the last input files
///       "corners": [["0", "7.5"]], "between": ["-1", "1"],   of a prism; else empty
///       "files": 0,                of a surface: how many input files hold it
///       "boundary": [{ "name": "boundary top",
///                      "vertices": [["0.5", "-1e-3", "7"]], "triangles": [[u, v, w]] }] },
///     "dropped": [t, ...] }        the triangles of "exact" that are outside
///
/// `cut.exact` is a part of the arrangement of `cut.surfaces`, of which the last `boundary_count`
/// are the boundary. It is arranged again for the dropped part. Errors: those of arrange().
Result<std::string> to_cut_certificate(const Certified& cut, const VolumeRecord& volume,
                                       std::size_t boundary_count, const ArrangeOptions& options,
                                       const Run& run = {});

/// Returns the sections of any kind of certificate about surfaces that were changed. Errors: those
/// of arrange() and locate().
Result<CutSections> cut_sections(const Certified& cut, const CutRecord& record,
                                 const ArrangeOptions& options, const Run& run = {});

/// Returns the text of a certificate of the kind "cut" or, with `growth`, "sealed". This one has
/// the keys of the kind "cut" and one more. "volume" is null without a volume, and "dropped"
/// lists trimmed parts, too, and unused ones of those that were added.
///
///   "sealed": [                    per surface of the files
///     { "limit": "0.25",           the surface as given and as kept are nowhere farther apart
///       "extended": [[[x, y, z], [x, y, z], [x, y, z]]],   triangles that were added to reach the
///                                  boundary, each number as text
///       "sealed": [...] }]         and those that close gaps, likewise
///
/// Added triangles count as input triangles of their surface, after the given ones, and have three
/// vertices of their own.
Result<std::string> to_cut_certificate(const Certified& cut, const CutRecord& record,
                                       const ArrangeOptions& options, const Run& run = {});

struct FilledRecord; // certify.hpp

/// Returns the text of a certificate of the kind "filled". It has the keys "format" to "outputs" of
/// a certificate of an arrangement, and
///
///   "filled": {
///     "vertices": [["0.5", "-1e-3", "7"]],   of all surfaces; of each first the given ones
///     "triangles": [[u, v, w]],              likewise
///     "surfaces": [                          per surface: the number of its vertices and
///       { "vertices": 4, "triangles": 2,     triangles; no filling reaches farther out of the
///         "limit": "0.25" }],                box around the border of its hole
///     "invented": [0, 1],                    per triangle: the number of its hole; 0: it was given
///     "deviation": ["0", "0.5", null] }      per vertex: its expected error; null: unknown
///
/// `surfaces` are those of the files, and there is one record for each.
std::string to_filled_certificate(std::span<const InputRecord> files,
                                  std::span<const Surface> surfaces,
                                  std::span<const OutputRecord> outputs,
                                  std::span<const FilledRecord> filled);

/// Returns the text of a certificate of the kind "layered". It has the keys "format" to "outputs"
/// of a certificate of an arrangement, and
///
///   "layered": {
///     "order": [{ "surface": 1, "hardness": "2" }],  from the top down; surfaces of the files
///     "deviation": "1e-12",        no triangle is farther from where it must be
///     "thickness": "0.25",         the minimum thickness; only if there is one
///     "vertices": [["0.5", "-1e-3", "7"]], "triangles": [[u, v, w]],
///     "layers": [[i, ...]],        per triangle: positions in "order"
///     "regions": [[r, ...]], "parents": [[p, ...]] }  per triangle: what the output files say
///
/// Precondition: layered.is_stack(), made of `surfaces`.
std::string to_layered_certificate(std::span<const InputRecord> files,
                                   std::span<const Surface> surfaces,
                                   std::span<const OutputRecord> outputs,
                                   std::span<const Layer> order, const Layered& layered);

/// Returns the text of a certificate of the kind "improved" about a mesh that improve() made of
/// before.rounded; `limits` has one bound per surface (ImproveReport::bound_of). It has the keys
/// of a certificate of an arrangement, which is about the mesh before, and
///
///   "improved": {
///     "vertices": [["0.5", "-1e-3", "7"]], "triangles": [[u, v, w]],
///     "surfaces": [[s, ...]],      per triangle
///     "regions": [[r, ...]],       per triangle: its region in each of its surfaces, numbered as
///                                  in "rounded"
///     "intersection_edges": [[u, v]],
///     "limits": ["0.25"] }         per surface: no point of it is farther from the same region of
///                                  the other mesh
///
/// `before.outputs` are the files that hold the improved mesh.
std::string to_improved_certificate(const Certified& before, const Mesh& improved,
                                    std::span<const double> limits, const Run& run = {});

} // namespace terrane
