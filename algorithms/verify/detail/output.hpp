// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rule R21 of the verifier: readers of output files. Each follows a file from its first byte to its
// last and compares it with the mesh that it must hold. They read what Terrane writes, not all that
// a format allows, and share no code with its writer.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
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
    std::span<const SurfaceInfo> surfaces; ///< what the file calls them; order of the input
    std::vector<CellNumbers> cells{};      ///< further numbers; VTP only
};

/// Where a file differs from the mesh that it must hold. The readers throw it.
struct Difference {
    std::string place; ///< "line 12", "byte 4711"
    std::string sentence;
};

/// Compares a file in this format with a mesh; returns where they differ, or nothing. Precondition:
/// has_reader(format).
std::string difference(std::string_view contents, std::string_view format,
                       const ExpectedMesh& expected);
bool has_reader(std::string_view format);

/// Returns the surfaces with another name or role than in the inputs.
std::vector<std::uint32_t> renamed_surfaces(const Certificate& certificate,
                                            const CertifiedOutput& output);
std::size_t surface_count(const Certificate& certificate);

void compare_obj(std::string_view contents, const ExpectedMesh& expected);
void compare_off(std::string_view contents, const ExpectedMesh& expected);
void compare_stl_ascii(std::string_view contents, const ExpectedMesh& expected);
void compare_gocad(std::string_view contents, const ExpectedMesh& expected);
void compare_ply(std::string_view contents, const ExpectedMesh& expected);
void compare_vtp(std::string_view contents, const ExpectedMesh& expected);
/// Compares with the doubles rounded to float32. Normals are not compared: they follow from the
/// corners.
void compare_stl(std::string_view contents, const ExpectedMesh& expected);

/// "unknown", "horizon", "fault" or "boundary".
std::string_view name_of(Role role);

/// Tells whether two doubles are the same bits, so that 0 and -0 differ.
bool same_bits(double a, double b);
bool same_bits(const Point3& a, const Point3& b);

} // namespace terrane::verifier
