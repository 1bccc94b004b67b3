// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <utility>
#include <vector>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/detail/certificate_writer.hpp>

namespace terrane {

using namespace detail;

namespace {

std::array<PointIndex, 3> points_of(const Arrangement& a, const Triangle& t) {
    return {a.vertices[t[0]], a.vertices[t[1]], a.vertices[t[2]]};
}

/// Returns the triangles of the whole that a part of it lacks. Both have their triangles in the same
/// order.
Result<std::vector<std::uint32_t>> dropped_triangles(const Arrangement& whole,
                                                     const Arrangement& part) {
    std::vector<std::uint32_t> dropped;
    std::size_t next = 0;
    for (std::uint32_t t = 0; t < whole.triangles.size(); ++t)
        if (next < part.triangles.size() &&
            points_of(whole, whole.triangles[t]) == points_of(part, part.triangles[next]))
            ++next;
        else
            dropped.push_back(t);
    if (next < part.triangles.size())
        return Error{ErrorCode::internal, "what was cut is no part of the arrangement",
                     "certificate"};
    return dropped;
}

void write_boundary(CertificateWriter& out, std::span<const Surface> boundary) {
    out.array(
        boundary,
        [&](const Surface& s) {
            out.raw("{\"name\":");
            out.quote(s.name);
            out.raw(",\"vertices\":");
            write_points(out, s.vertices);
            out.raw(",\"triangles\":");
            out.arrays(s.triangles);
            out.raw("}");
        },
        ",\n");
}

void write_volume(CertificateWriter& out, const VolumeRecord& volume,
                  std::span<const Surface> boundary) {
    out.raw(",\n\"cut\":{\"volume\":{\"shape\":");
    out.quote(volume.shape);
    out.raw(",\"corners\":");
    out.array(volume.corners, [&](const std::array<double, 2>& corner) {
        out.array(corner, [&](double c) { out.quote(c); });
    });
    out.raw(",\"between\":");
    out.array(volume.between, [&](double height) { out.quote(height); });
    out.raw(",\"files\":");
    out.number(volume.files.size());
    out.raw(",\n\"boundary\":");
    write_boundary(out, boundary);
    out.raw("},\n\"dropped\":");
}

} // namespace

Result<std::string> to_cut_certificate(const Certified& cut, const VolumeRecord& volume,
                                       std::size_t boundary_count, const ArrangeOptions& options,
                                       const Run& run) {
    const auto whole = arrange(cut.surfaces, options, run);
    if (!whole) return whole.error();
    const auto dropped = dropped_triangles(whole.value(), cut.exact);
    if (!dropped) return dropped.error();
    std::vector<InputRecord> files(cut.files.begin(), cut.files.end());
    files.insert(files.end(), volume.files.begin(), volume.files.end());
    const auto own = cut.surfaces.first(cut.surfaces.size() - boundary_count);
    std::vector<Surface> surfaces(own.begin(), own.end());
    surfaces.insert(surfaces.end(), volume.surfaces.begin(), volume.surfaces.end());
    std::string text;
    CertificateWriter out(text);
    write_head(out, "cut", {files, surfaces, cut.outputs});
    write_volume(out, volume, cut.surfaces.last(boundary_count));
    out.numbers(dropped.value());
    out.raw("}");
    Certified certified = cut;
    certified.whole = &whole.value();
    write_arrangement(out, certified, run);
    out.raw("}\n");
    return text;
}

} // namespace terrane
