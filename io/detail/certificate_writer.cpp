// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/detail/certificate_writer.hpp>

#include <array>

#include <terrane/io/text/names.hpp>

namespace terrane::detail {

namespace {

void write_surface(CertificateWriter& out, const Surface& surface) {
    out.raw("{\"name\":");
    out.quote(surface.name);
    out.raw(",\"role\":");
    out.quote(role_names[static_cast<std::size_t>(surface.role)]);
    out.raw(",\"vertices\":");
    out.number(surface.vertices.size());
    out.raw(",\"triangles\":");
    out.number(surface.triangles.size());
    out.raw("}");
}

void write_inputs(CertificateWriter& out, const CertificateHead& head) {
    std::size_t first = 0;
    out.array(
        head.files,
        [&](const InputRecord& file) {
            out.raw("{\"name\":");
            out.quote(file.name);
            out.raw(",\"sha256\":");
            out.quote(file.sha256);
            out.raw(",\"bytes\":");
            out.number(file.bytes);
            out.raw(",\"surfaces\":");
            out.array(
                head.surfaces.subspan(first, file.surfaces),
                [&](const Surface& s) { write_surface(out, s); }, ",\n");
            out.raw("}");
            first += file.surfaces;
        },
        ",\n");
}

void write_outputs(CertificateWriter& out, std::span<const OutputRecord> outputs) {
    const auto surface = [&](const SurfaceInfo& s) {
        out.raw("{\"name\":");
        out.quote(s.name);
        out.raw(",\"role\":");
        out.quote(role_names[static_cast<std::size_t>(s.role)]);
        out.raw("}");
    };
    out.array(
        outputs,
        [&](const OutputRecord& file) {
            out.raw("{\"name\":");
            out.quote(file.name);
            out.raw(",\"format\":");
            out.quote(file.format);
            out.raw(",\"sha256\":");
            out.quote(file.sha256);
            out.raw(",\"bytes\":");
            out.number(file.bytes);
            out.raw(",\"surfaces\":");
            out.array(file.surfaces, surface, ",\n");
            out.raw("}");
        },
        ",\n");
}

} // namespace

void write_head(CertificateWriter& out, std::string_view kind, const CertificateHead& head) {
    out.raw("{\"format\":\"terrane-certificate\",\"version\":2,\"kind\":");
    out.quote(kind);
    out.raw(",\n\"inputs\":");
    write_inputs(out, head);
    out.raw(",\n\"outputs\":");
    write_outputs(out, head.outputs);
}

void write_head(CertificateWriter& out, std::string_view kind, const Certified& certified) {
    if (certified.cut == nullptr)
        write_head(out, kind, {certified.files, certified.surfaces, certified.outputs});
    else
        write_head(out, kind, {certified.cut->files, certified.cut->surfaces, certified.outputs});
}

void write_points(CertificateWriter& out, std::span<const Point3> points) {
    const auto point = [&](const Point3& p) {
        out.array(std::array{p.x, p.y, p.z}, [&](double c) { out.quote(c); });
    };
    out.array(points, point, ",\n");
}

} // namespace terrane::detail
