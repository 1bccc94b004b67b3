// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/detail/certificate_writer.hpp>

namespace terrane {

using namespace detail;

double stated_deviation(const Layered& layered) {
    const StandardArithmetic guard;
    // Vertices were rounded twice: to the nearest doubles, and after the final arrangement. What
    // the verifier shows is up to four times as large.
    constexpr double slack = 4;
    double largest = 0;
    for (const Point3& p : layered.rounded.mesh->vertices)
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    const double spacing =
        std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
    return slack * (layered.rounded.report.deviation + spacing + layered.height_error);
}

std::string to_layered_certificate(std::span<const InputRecord> files,
                                   std::span<const Surface> surfaces,
                                   std::span<const OutputRecord> outputs,
                                   std::span<const Layer> order, const Layered& layered) {
    const StandardArithmetic guard;
    const Mesh& mesh = layered.rounded.mesh;
    std::string text;
    CertificateWriter out(text);
    write_head(out, "layered", {files, surfaces, outputs});
    out.raw(",\n\"layered\":{\"order\":");
    out.array(order, [&](const Layer& layer) {
        out.raw("{\"surface\":");
        out.number(layer.surface);
        out.raw(",\"hardness\":");
        out.quote(layer.hardness);
        out.raw("}");
    });
    out.raw(",\n\"deviation\":");
    out.quote(stated_deviation(layered));
    if (layered.min_thickness > 0) {
        out.raw(",\n\"thickness\":");
        out.quote(layered.min_thickness);
    }
    out.raw(",\n\"vertices\":");
    write_points(out, mesh.vertices);
    out.raw(",\n\"triangles\":");
    out.arrays(mesh.triangles);
    out.raw(",\n\"layers\":");
    out.lists(mesh.surfaces_of);
    out.raw(",\n\"regions\":");
    out.lists(mesh.regions_of);
    out.raw(",\n\"parents\":");
    out.lists(mesh.parents_of);
    out.raw("}}\n");
    return text;
}

} // namespace terrane
