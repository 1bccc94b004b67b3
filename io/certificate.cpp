// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/certificate.hpp>

#include <array>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/certify.hpp>
#include <terrane/io/detail/certificate_writer.hpp>

namespace terrane {

namespace fs = std::filesystem;
using namespace detail;

namespace {

void write_construction(CertificateWriter& out, const Construction& how) {
    struct Kind {
        std::string_view name;
        std::size_t indices;
    };
    constexpr std::array<Kind, 4> kinds{{{"v", 1}, {"lp", 5}, {"ppp", 9}, {"ll", 4}}};
    const Kind& kind = kinds[static_cast<std::size_t>(how.kind)];
    out.raw("[\"");
    out.raw(kind.name);
    out.raw("\"");
    for (std::size_t i = 0; i < kind.indices; ++i) {
        out.raw(",");
        out.number(how.v[i]);
    }
    constexpr std::array<std::string_view, 3> axes{",\"x\"]", ",\"y\"]", ",\"z\"]"};
    const bool has_axis = how.kind == Construction::Kind::line_line;
    out.raw(has_axis ? axes[static_cast<std::size_t>(how.axis)] : "]");
}

void write_exact(CertificateWriter& out, const Arrangement& a) {
    out.raw("{\"vertices\":");
    out.array(
        a.vertices, [&](PointIndex p) { write_construction(out, a.state->points.construction(p)); },
        ",\n");
    out.raw(",\n\"triangles\":");
    out.arrays(a.triangles);
    out.raw(",\n\"parents\":");
    out.lists(a.parents_of);
    out.raw(",\n\"intersection_edges\":");
    out.arrays(a.intersection_edges);
    out.raw(",\n\"degenerate\":");
    out.numbers(a.degenerate);
    out.raw(",\n\"duplicates\":");
    out.arrays(a.inputs.duplicates);
    out.raw("}");
}

/// Tells whether the mesh has the vertices, triangles and parents of the arrangement, and its
/// vertices at most other places.
bool has_exact_triangles(const Arrangement& a, const Mesh& mesh) {
    return a.vertices.size() == mesh.vertices.size() && a.triangles == mesh.triangles &&
           a.parents_of == mesh.parents_of;
}

void write_report(CertificateWriter& out, const RoundingReport& report, bool exact_triangles,
                  double deviation) {
    out.raw(",\n\"clean\":");
    out.raw(report.clean ? "true" : "false");
    out.raw(",\"max_move\":");
    if (exact_triangles)
        out.quote(report.max_move);
    else
        out.raw("null");
    out.raw(",\"deviation\":");
    out.quote(deviation);
    out.raw(",\"vanished\":");
    out.numbers(report.vanished);
}

void write_rounded(CertificateWriter& out, const Arrangement& exact, const RoundedMesh& rounded) {
    const Mesh& mesh = rounded.mesh;
    out.raw("{\"vertices\":");
    write_points(out, mesh.vertices);
    out.raw(",\n\"triangles\":");
    out.arrays(mesh.triangles);
    out.raw(",\n\"parents\":");
    out.lists(mesh.parents_of);
    out.raw(",\n\"intersection_edges\":");
    out.arrays(mesh.intersection_edges);
    out.raw(",\n\"regions\":");
    out.lists(mesh.regions_of);
    write_report(out, rounded.report, has_exact_triangles(exact, mesh),
                 stated_deviation(exact, rounded));
    out.raw("}");
}

} // namespace

double stated_deviation(const Arrangement& exact, const RoundedMesh& rounded) {
    const StandardArithmetic guard;
    // With other triangles than those of the arrangement the verifier's bound is up to 5/2 times
    // the sum of all moves.
    constexpr double proof_slack = 4;
    const double deviation = rounded.report.deviation;
    return has_exact_triangles(exact, rounded.mesh) ? deviation : proof_slack * deviation;
}

void detail::write_arrangement(CertificateWriter& out, const Certified& certified, const Run& run) {
    const Arrangement& all = certified.cut == nullptr ? certified.exact : certified.cut->whole;
    if (certified.cut != nullptr) out.raw(certified.cut->text);
    out.raw(",\n\"exact\":");
    write_exact(out, all);
    out.raw(",\n\"rounded\":");
    if (certified.rounded == nullptr)
        out.raw("null");
    else
        write_rounded(out, certified.exact, *certified.rounded);
    out.raw(",\n\"digest\":");
    out.quote(canonical_digest(certified.surfaces, all, run));
}

Result<InputRecord> record_input(const fs::path& path, std::string name, std::size_t surfaces) {
    return guarded("for the certificate", "certificate", [&]() -> Result<InputRecord> {
        const auto contents = read_file(path);
        if (!contents) return contents.error();
        return InputRecord{std::move(name), hexadecimal(sha256(contents.value())),
                           contents.value().size(), surfaces};
    });
}

OutputRecord record_output(std::string_view contents, std::string name, std::string format,
                           const std::vector<SurfaceInfo>& surfaces) {
    return {std::move(name), std::move(format), hexadecimal(sha256(contents)), contents.size(),
            surfaces};
}

std::string certified_format(Format format, bool ascii) {
    if (format == Format::gocad) return "ts";
    if (format == Format::stl) return ascii ? "stl-ascii" : "stl";
    for (const char* name :
         {"obj", "off", "ply", "vtp", "vtu", "msh", "msh22", "inp", "mesh", "poly", "smesh"})
        if (format_named(name) == format) return name;
    return "";
}

std::string certified_name(const fs::path& path, const fs::path& certificate) {
    std::error_code failed;
    const auto folder = certificate == "-" ? fs::path() : certificate.parent_path();
    // fs::proximate makes only existing paths absolute, and cannot compare them with others.
    const auto from = fs::absolute(folder.empty() ? fs::path(".") : folder, failed);
    const auto to = failed ? path : fs::absolute(path, failed);
    const auto relative = failed ? path : fs::proximate(to, from, failed);
    return (failed ? path : relative).generic_string();
}

std::string to_certificate(const Certified& certified, const Run& run) {
    const StandardArithmetic guard;
    std::string text;
    text.reserve(200 * certified.exact.triangles.size() + 4096);
    CertificateWriter out(text);
    write_head(out, "arrangement", certified);
    write_arrangement(out, certified, run);
    out.raw("}\n");
    return text;
}

std::string to_improved_certificate(const Certified& before, const Mesh& improved,
                                    std::span<const double> limits, const Run& run) {
    const StandardArithmetic guard;
    std::string text;
    CertificateWriter out(text);
    write_head(out, "improved", before);
    write_arrangement(out, before, run);
    out.raw(",\n\"improved\":{\"vertices\":");
    write_points(out, improved.vertices);
    out.raw(",\n\"triangles\":");
    out.arrays(improved.triangles);
    out.raw(",\n\"surfaces\":");
    out.lists(improved.surfaces_of);
    out.raw(",\n\"regions\":");
    out.lists(improved.regions_of);
    out.raw(",\n\"intersection_edges\":");
    out.arrays(improved.intersection_edges);
    out.raw(",\n\"limits\":");
    out.array(limits, [&](double limit) { out.quote(limit); });
    out.raw("}}\n");
    return text;
}

} // namespace terrane
