// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/output.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>
#include <terrane/algorithms/verify/detail/sha256.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane {

namespace verifier {

namespace {

/// A format, and the writer that makes it of a mesh or of tetrahedra.
template <class Expected>
struct Writer {
    std::string_view format;
    void (*write)(Comparison& out, const Expected& expected);
};

constexpr std::array<Writer<ExpectedMesh>, 7> mesh_writers{{{"obj", write_obj},
                                                            {"off", write_off},
                                                            {"ply", write_ply},
                                                            {"stl", write_stl},
                                                            {"stl-ascii", write_stl_ascii},
                                                            {"ts", write_gocad},
                                                            {"vtp", write_vtp}}};

constexpr std::array<Writer<ExpectedTetrahedra>, 4> tetrahedra_writers{
    {{"vtu", write_vtu}, {"msh", write_msh}, {"msh22", write_msh22}, {"inp", write_inp}}};

/// Compares with what one of the writers makes.
std::string compared_with(std::string_view contents, std::string_view format, const auto& writers,
                          const auto& expected, OutputCheck& check) {
    const auto* const writer = std::ranges::find(writers, format, [](auto& w) { return w.format; });
    if (writer == writers.end()) {
        check = OutputCheck::hash_only;
        return "";
    }
    if (format == "stl") check = OutputCheck::float32;
    const bool is_xml = contents.starts_with("<?xml");
    if (is_xml && contents.substr(0, 200).find(" compressor=") != std::string_view::npos)
        check = OutputCheck::inflated;
    return compared(contents, format, [&](Comparison& out) { writer->write(out, expected); });
}

/// Returns the triangles of a mesh as the faces of no tetrahedra.
TetrahedraClaim as_faces(const WrittenMesh& mesh) {
    TetrahedraClaim claim;
    claim.vertices = mesh.vertices;
    claim.faces = mesh.triangles;
    return claim;
}

} // namespace

std::string compared(std::string_view contents, std::string_view format,
                     const std::function<void(Comparison& out)>& write) {
    try {
        Comparison out(contents);
        write(out);
        out.end();
    } catch (const Difference& difference) {
        return std::string(format) + ", " + difference.place + ": " + difference.sentence;
    }
    return "";
}

std::string difference(std::string_view contents, std::string_view format,
                       const ExpectedMesh& expected, OutputCheck& check) {
    if (!format.starts_with("msh") && format != "inp")
        return compared_with(contents, format, mesh_writers, expected, check);
    const TetrahedraClaim faces = as_faces(expected.mesh);
    return difference(contents, format,
                      ExpectedTetrahedra{faces, expected.surfaces, expected.mesh.surfaces_of, {}},
                      check);
}

std::string difference(std::string_view contents, std::string_view format,
                       const ExpectedTetrahedra& expected, OutputCheck& check) {
    return compared_with(contents, format, tetrahedra_writers, expected, check);
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

std::vector<std::string> distinct_names(std::span<const SurfaceInfo> surfaces,
                                        void (*change)(std::string& name)) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    std::map<std::string, unsigned> next;
    for (const SurfaceInfo& surface : surfaces) {
        std::string base = surface.name;
        change(base);
        if (base.empty()) base = "surface";
        std::string name = base;
        unsigned& number = next.try_emplace(base, 2).first->second;
        while (!taken.insert(name).second) name = base + "_" + std::to_string(number++);
        names.push_back(std::move(name));
    }
    return names;
}

void put_on_one_line(std::string& name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
}

void make_quotable(std::string& name) {
    put_on_one_line(name);
    std::ranges::replace(name, '"', '\'');
}

std::string name_of_block(std::uint32_t block, std::string name) {
    if (block == 0) return "outside";
    make_quotable(name);
    return "block " + std::to_string(block) + (name.empty() ? "" : ": ") + name;
}

void add_pairs(const TetrahedraClaim& claim, std::uint32_t front, std::uint32_t back,
               std::set<Edge>& pairs) {
    for (std::size_t k = 0; k < 3; ++k)
        if (claim.faces[front][k] != claim.faces[back][k])
            pairs.insert({claim.faces[front][k], claim.faces[back][k]});
}

std::string_view name_of(Role role) {
    return names_of_roles.at(static_cast<std::size_t>(role));
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_bits(const Point3& a, const Point3& b) {
    return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
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
    if (output.surfaces.size() != verifier::surface_count(certificate))
        return "another number of surfaces than in the inputs";
    verdict.renamed = verifier::renamed_surfaces(certificate, output);
    const auto mesh = verifier::find_kind(certificate.kind()).written(certificate);
    if (!mesh) return "";
    auto what = verifier::difference(contents, output.format,
                                     verifier::ExpectedMesh{*mesh, output.surfaces}, verdict.check);
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
