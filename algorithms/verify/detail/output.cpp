// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/output.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>
#include <terrane/algorithms/verify/detail/sha256.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane {

namespace verifier {

namespace {

/// A format that the verifier reads.
struct Reader {
    std::string_view format;
    void (*compare)(std::string_view contents, const ExpectedMesh& expected);
};

constexpr std::array<Reader, 7> readers{{{"obj", compare_obj},
                                         {"off", compare_off},
                                         {"ply", compare_ply},
                                         {"stl", compare_stl},
                                         {"stl-ascii", compare_stl_ascii},
                                         {"ts", compare_gocad},
                                         {"vtp", compare_vtp}}};

} // namespace

bool has_reader(std::string_view format) {
    return std::ranges::find(readers, format, &Reader::format) != readers.end();
}

std::string difference(std::string_view contents, std::string_view format,
                       const ExpectedMesh& expected) {
    try {
        std::ranges::find(readers, format, &Reader::format)->compare(contents, expected);
    } catch (const Difference& difference) {
        return difference.place + ": " + difference.sentence;
    }
    return "";
}

std::vector<std::uint32_t> renamed_surfaces(const Certificate& certificate,
                                            const CertifiedOutput& output) {
    std::vector<std::uint32_t> renamed;
    const auto surfaces = surfaces_of_mesh(certificate);
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        const SurfaceInfo& named = output.surfaces[s];
        if (named.name != surfaces[s].name || named.role != surfaces[s].role) renamed.push_back(s);
    }
    return renamed;
}

std::size_t surface_count(const Certificate& certificate) {
    return surfaces_of_mesh(certificate).size();
}

} // namespace verifier

namespace {

using verifier::WrittenMesh;

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

/// Returns a bound of how far narrowing moves a vertex. The differences are exact: a double less
/// the nearest float32 has no more digits than the double.
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

/// Compares a file with the mesh of the certificate; returns what is wrong, or nothing.
std::string compare_mesh(std::string_view contents, const Certificate& certificate,
                         const CertifiedOutput& output, OutputVerdict& verdict) {
    const bool readable = verifier::has_reader(output.format);
    if (!readable)
        verdict.check = OutputCheck::hash_only;
    else if (output.format == "stl")
        verdict.check = OutputCheck::float32;
    if (output.surfaces.size() != verifier::surface_count(certificate))
        return "another number of surfaces than in the inputs";
    verdict.renamed = verifier::renamed_surfaces(certificate, output);
    const auto mesh = verifier::find_kind(certificate.kind()).written(certificate);
    if (!mesh || !readable) return "";
    auto what = verifier::difference(contents, output.format, {*mesh, output.surfaces});
    if (!what.empty() || verdict.check != OutputCheck::float32) return what;
    verdict.float32_move = narrowing_move(*mesh);
    return mesh->clean && !is_conforming_narrowed(*mesh)
               ? "the triangles are not conforming in float32"
               : "";
}

} // namespace

OutputVerdict verify_output(std::string_view contents, const Certificate& certificate,
                            std::size_t number) {
    return OutputVerifier(certificate)(contents, number);
}

OutputVerdict OutputVerifier::operator()(std::string_view contents, std::size_t number) {
    const StandardArithmetic arithmetic;
    const CertifiedOutput& output = certificate_.outputs[number];
    OutputVerdict verdict;
    const auto refute = [&](const std::string& what) {
        if (!what.empty())
            verdict.violations.push_back({Rule::R21_output,
                                          {static_cast<std::uint32_t>(number)},
                                          output.name + ": " + what});
    };
    if (output.bytes != contents.size() ||
        output.sha256 != verifier::in_hexadecimal(verifier::hash_of(contents)))
        refute("another SHA-256 or size than the certificate says");
    const verifier::Kind& kind = verifier::find_kind(certificate_.kind());
    if (kind.compare != nullptr)
        refute(kind.compare(contents, certificate_, output, folder_, verdict));
    else
        refute(compare_mesh(contents, certificate_, output, verdict));
    return verdict;
}

} // namespace terrane
