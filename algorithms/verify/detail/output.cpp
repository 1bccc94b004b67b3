// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/output.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <terrane/algorithms/verify/detail/kinds.hpp>
#include <terrane/algorithms/verify/detail/sha256.hpp>
#include <terrane/algorithms/verify/verify_certificate.hpp>

namespace terrane {

namespace {

using verifier::Difference;
using verifier::ExpectedMesh;
using verifier::WrittenMesh;

/// A format that the verifier reads.
struct Reader {
    std::string_view format;
    void (*compare)(std::string_view contents, const ExpectedMesh& expected);
};

constexpr std::array<Reader, 7> readers{{{"obj", verifier::compare_obj},
                                         {"off", verifier::compare_off},
                                         {"ply", verifier::compare_ply},
                                         {"stl", verifier::compare_stl},
                                         {"stl-ascii", verifier::compare_stl_ascii},
                                         {"ts", verifier::compare_gocad},
                                         {"vtp", verifier::compare_vtp}}};

std::vector<std::uint32_t> renamed_surfaces(const Certificate& certificate,
                                            const CertifiedOutput& output) {
    std::vector<std::uint32_t> renamed;
    std::uint32_t surface = 0;
    for (const CertifiedInput& input : certificate.inputs)
        for (const CertifiedSurface& s : input.surfaces) {
            const SurfaceInfo& named = output.surfaces[surface];
            if (named.name != s.name || named.role != s.role) renamed.push_back(surface);
            ++surface;
        }
    return renamed;
}

std::size_t surface_count(const Certificate& certificate) {
    std::size_t count = 0;
    for (const CertifiedInput& input : certificate.inputs) count += input.surfaces.size();
    return count;
}

// --- float32 ----------------------------------------------------------------------------------

Point3 narrowed(const Point3& p) {
    const auto narrow = [](double c) { return static_cast<double>(static_cast<float>(c)); };
    return {narrow(p.x), narrow(p.y), narrow(p.z)};
}

/// Tells whether the mesh is conforming in float32, where vertices at the same place are one.
bool is_conforming_narrowed(const WrittenMesh& mesh) {
    std::map<Point3, std::uint32_t> number_of;
    std::vector<Point3> vertices;
    std::vector<std::uint32_t> merged;
    for (const Point3& p : mesh.vertices) {
        const auto [place, added] =
            number_of.try_emplace(narrowed(p), static_cast<std::uint32_t>(vertices.size()));
        if (added) vertices.push_back(place->first);
        merged.push_back(place->second);
    }
    std::vector<Triangle> triangles = mesh.triangles;
    for (Triangle& t : triangles)
        for (std::uint32_t& corner : t) corner = merged[corner];
    return verify_conforming(vertices, triangles).empty();
}

/// Returns a bound of how far narrowing moves a vertex. The differences are exact: a double less the
/// nearest float32 has no more digits than the double.
double narrowing_move(const WrittenMesh& mesh) {
    double most = 0;
    for (const Point3& p : mesh.vertices) {
        const Point3 q = narrowed(p);
        const double move = std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
        if (move > 0)
            most = std::max(most, std::nextafter(move * (1 + 0x1p-50),
                                                 std::numeric_limits<double>::infinity()));
    }
    return most;
}

/// Describes a difference between a file and the mesh that it must hold; empty if there is none.
std::string difference(std::string_view contents, const ExpectedMesh& expected,
                       const Reader& reader) {
    try {
        reader.compare(contents, expected);
    } catch (const Difference& difference) {
        return difference.place + ": " + difference.sentence;
    }
    return "";
}

} // namespace

OutputVerdict verify_output(std::string_view contents, const Certificate& certificate,
                            std::size_t number) {
    const CertifiedOutput& output = certificate.outputs[number];
    OutputVerdict verdict;
    const auto refute = [&](const std::string& what) {
        verdict.violations.push_back(
            {Rule::R21_output, {static_cast<std::uint32_t>(number)}, output.name + ": " + what});
    };
    const auto reader = std::ranges::find(readers, output.format, &Reader::format);
    if (reader == readers.end())
        verdict.check = OutputCheck::hash_only;
    else if (output.format == "stl")
        verdict.check = OutputCheck::float32;
    if (output.surfaces.size() != surface_count(certificate)) {
        refute("another number of surfaces than in the inputs");
        return verdict;
    }
    verdict.renamed = renamed_surfaces(certificate, output);
    if (output.bytes != contents.size() ||
        output.sha256 != verifier::in_hexadecimal(verifier::hash_of(contents)))
        refute("another SHA-256 or size than the certificate says");
    const auto mesh = verifier::find_kind(certificate.kind).written(certificate);
    if (!mesh || reader == readers.end()) return verdict;
    if (const auto what = difference(contents, {*mesh, output.surfaces}, *reader); !what.empty())
        refute(what);
    if (verdict.check == OutputCheck::float32) {
        verdict.float32_move = narrowing_move(*mesh);
        if (mesh->clean && !is_conforming_narrowed(*mesh))
            refute("the triangles are not conforming in float32");
    }
    return verdict;
}

} // namespace terrane
