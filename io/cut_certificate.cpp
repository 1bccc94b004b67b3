// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <utility>
#include <vector>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/detail/certificate_writer.hpp>
#include <terrane/io/detail/growth_writer.hpp>

namespace terrane {

using namespace detail;

namespace {

std::array<PointIndex, 3> points_of(const Arrangement& a, const Triangle& t) {
    return {a.vertices[t[0]], a.vertices[t[1]], a.vertices[t[2]]};
}

/// Returns the triangles of the whole that a part of it lacks. Both have their triangles in the
/// same order.
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
        return Error{ErrorCode::internal, "the cut is no part of the arrangement", "certificate"};
    return dropped;
}

/// The input of the parts of a certificate in addition to the arrangement.
struct CutParts {
    std::vector<std::uint32_t> dropped; ///< triangles of the whole
    std::vector<double> limits;         ///< per surface that grew
};

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
    out.raw("{\"shape\":");
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
    out.raw("}");
}

/// Writes the keys "cut", and "sealed" if surfaces were sealed or extended.
void write_cut(CertificateWriter& out, const Certified& cut, const CutRecord& record,
               const CutParts& parts) {
    out.raw(",\n\"cut\":{\"volume\":");
    if (record.volume == nullptr)
        out.raw("null");
    else
        write_volume(out, *record.volume, cut.surfaces.last(record.boundary_count));
    out.raw(",\n\"dropped\":");
    out.numbers(parts.dropped);
    out.raw("}");
    if (record.growth.empty()) return;
    out.raw(",\n\"sealed\":");
    write_growth(out, cut.surfaces, record.growth, parts.limits);
}

/// Returns the surfaces of the input files, without what was added to them.
std::vector<Surface> surfaces_in_files(const Certified& cut, const CutRecord& record) {
    const auto own = cut.surfaces.first(cut.surfaces.size() - record.boundary_count);
    std::vector<Surface> surfaces(own.begin(), own.end());
    for (std::size_t s = 0; s < record.growth.size(); ++s) {
        const std::size_t given = record.growth[s].given;
        surfaces[s].vertices.resize(surfaces[s].vertices.size() -
                                    3 * (surfaces[s].triangles.size() - given));
        surfaces[s].triangles.resize(given);
    }
    if (record.volume != nullptr)
        surfaces.insert(surfaces.end(), record.volume->surfaces.begin(),
                        record.volume->surfaces.end());
    return surfaces;
}

} // namespace

Result<CutSections> cut_sections(const Certified& cut, const CutRecord& record,
                                 const ArrangeOptions& options, const Run& run) {
    return guarded("for the certificate", "certificate", [&]() -> Result<CutSections> {
        auto whole = arrange(cut.surfaces, options, run);
        if (!whole) return whole.error();
        auto dropped = dropped_triangles(whole.value(), cut.exact);
        if (!dropped) return dropped.error();
        CutParts parts{std::move(dropped).value(), {}};
        if (!record.growth.empty()) {
            auto limits = growth_limits(whole.value(), parts.dropped, record, run);
            if (!limits) return limits.error();
            parts.limits = std::move(limits).value();
        }
        CutSections sections{std::move(whole).value(), "", {cut.files.begin(), cut.files.end()}};
        if (record.volume != nullptr)
            sections.files.insert(sections.files.end(), record.volume->files.begin(),
                                  record.volume->files.end());
        sections.surfaces = surfaces_in_files(cut, record);
        CertificateWriter out(sections.text);
        write_cut(out, cut, record, parts);
        return sections;
    });
}

Result<std::string> to_cut_certificate(const Certified& cut, const CutRecord& record,
                                       const ArrangeOptions& options, const Run& run) {
    return guarded("for the certificate", "certificate", [&]() -> Result<std::string> {
        const auto sections = cut_sections(cut, record, options, run);
        if (!sections) return sections.error();
        Certified certified = cut;
        certified.cut = &sections.value();
        std::string text;
        CertificateWriter out(text);
        write_head(out, record.growth.empty() ? "cut" : "sealed", certified);
        write_arrangement(out, certified, run);
        out.raw("}\n");
        return text;
    });
}

Result<std::string> to_cut_certificate(const Certified& cut, const VolumeRecord& volume,
                                       std::size_t boundary_count, const ArrangeOptions& options,
                                       const Run& run) {
    const StandardArithmetic guard;
    return to_cut_certificate(cut, {&volume, boundary_count, {}}, options, run);
}

} // namespace terrane
