// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rule R21 of the verifier: each output file is, byte for byte, what the verifier's own writers make
// of the certificate. They share no code with those of Terrane.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/comparison.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>

namespace terrane::verifier {

/// A number per triangle, by its name in VTP.
struct CellNumbers {
    std::string name;
    std::vector<std::int32_t> values;
};

/// The mesh that an output file must hold.
struct ExpectedMesh {
    const WrittenMesh& mesh;
    std::span<const SurfaceInfo> surfaces;      ///< what the file calls them; order of the input
    std::vector<CellNumbers> cells{};           ///< further numbers; VTP only
    std::span<const std::string> block_names{}; ///< VTP only; empty: the file has none
};

/// The tetrahedra that an output file must hold; without any, the faces are all triangles of a mesh.
struct ExpectedTetrahedra {
    const TetrahedraClaim& claim;
    std::span<const SurfaceInfo>
        surfaces; ///< what the file calls them; "box" last, if there is one
    IndexLists<std::uint32_t> surfaces_of;    ///< per face: those of its triangle, or the box
    std::span<const std::string> block_names; ///< by block; empty for a mesh
};

/// Compares a file with what write(out) makes; returns the place of the first difference with the name
/// of the format, or nothing.
std::string compared(std::string_view contents, std::string_view format,
                     const std::function<void(Comparison& out)>& write);

/// Compares a file in this format with a mesh, or with tetrahedra; fills in how it was compared.
/// Returns where they differ, or nothing.
std::string difference(std::string_view contents, std::string_view format,
                       const ExpectedMesh& expected, OutputCheck& check);
std::string difference(std::string_view contents, std::string_view format,
                       const ExpectedTetrahedra& expected, OutputCheck& check);

/// Returns the surfaces with another name or role than in the inputs.
std::vector<std::uint32_t> renamed_surfaces(const Certificate& certificate,
                                            const CertifiedOutput& output);
std::size_t surface_count(const Certificate& certificate);

// Writers, one for each format.
void write_obj(Comparison& out, const ExpectedMesh& expected);
void write_off(Comparison& out, const ExpectedMesh& expected);
void write_ply(Comparison& out, const ExpectedMesh& expected);
void write_stl(Comparison& out, const ExpectedMesh& expected);
void write_stl_ascii(Comparison& out, const ExpectedMesh& expected);
void write_gocad(Comparison& out, const ExpectedMesh& expected);
void write_vtp(Comparison& out, const ExpectedMesh& expected);
void write_vtu(Comparison& out, const ExpectedTetrahedra& expected);
void write_msh(Comparison& out, const ExpectedTetrahedra& expected);
void write_msh22(Comparison& out, const ExpectedTetrahedra& expected);
void write_inp(Comparison& out, const ExpectedTetrahedra& expected);

/// The side of a cut on which a face is: 1 in front, 2 behind, 0 if it has no twin.
std::vector<std::int32_t> cut_sides(const TetrahedraClaim& claim);

/// Adds the nodes of twin faces that differ, as pairs in front of the cut and behind it.
void add_pairs(const TetrahedraClaim& claim, std::uint32_t front, std::uint32_t back,
               std::set<Edge>& pairs);
/// Returns "outside" for block 0, else "block 1", ..., and its name if it has one.
std::string name_of_block(std::uint32_t block, std::string name);

/// Returns the names of surfaces after change(name), all different: an empty one is "surface", and
/// one that was there before gets _2, _3, ...
std::vector<std::string> distinct_names(std::span<const SurfaceInfo> surfaces,
                                        void (*change)(std::string& name));
/// Makes control characters blanks.
void put_on_one_line(std::string& name);
/// Does so, and makes double quotes single ones.
void make_quotable(std::string& name);

/// "unknown", "horizon", "fault" or "boundary".
std::string_view name_of(Role role);

/// Tells whether two doubles are the same bits, so that 0 and -0 differ.
bool same_bits(double a, double b);
bool same_bits(const Point3& a, const Point3& b);

} // namespace terrane::verifier
