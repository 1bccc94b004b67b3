// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/certify.hpp>
#include <terrane/io/detail/certificate_writer.hpp>

namespace terrane {

using namespace detail;

namespace {

struct Extent {
    std::array<double, 3> low, high;

    Extent() {
        low.fill(std::numeric_limits<double>::infinity());
        high.fill(-std::numeric_limits<double>::infinity());
    }
    void extend(const Point3& p) {
        const std::array at{p.x, p.y, p.z};
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], at[i]);
            high[i] = std::max(high[i], at[i]);
        }
    }
    /// Returns how far a point is outside, along the axis where it is farthest.
    [[nodiscard]] double excess(const Point3& p) const {
        const std::array at{p.x, p.y, p.z};
        double most = 0;
        for (std::size_t i = 0; i < 3; ++i)
            most = std::max({most, low[i] - at[i], at[i] - high[i]});
        return most;
    }
};

/// Joins the new triangles across their edges. Returns a triangle of the same filling for each.
std::vector<std::uint32_t> fillings_of(const FilledRecord& record) {
    const auto& triangles = record.filled->triangles;
    std::vector<std::uint32_t> up(triangles.size());
    std::iota(up.begin(), up.end(), 0U);
    const auto root = [&](std::uint32_t t) {
        while (up[t] != t) t = up[t] = up[up[t]];
        return t;
    };
    std::map<Edge, std::uint32_t> first_at;
    for (auto t = static_cast<std::uint32_t>(record.given_triangles); t < triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
            up[root(t)] = root(first_at.try_emplace({low, high}, t).first->second);
        }
    for (std::uint32_t t = 0; t < up.size(); ++t) up[t] = root(t);
    return up;
}

/// Returns how far the fillings of a surface reach out of the boxes around their borders, rounded
/// up.
double limit_of(const FilledRecord& record) {
    const Surface& s = *record.filled;
    const auto filling = fillings_of(record);
    std::map<std::uint32_t, Extent> borders;
    double most = 0;
    for (const bool measure : {false, true})
        for (std::size_t t = record.given_triangles; t < s.triangles.size(); ++t)
            for (const std::uint32_t v : s.triangles[t]) {
                if (measure)
                    most = std::max(most, borders[filling[t]].excess(s.vertices[v]));
                else if (v < record.given_vertices)
                    borders[filling[t]].extend(s.vertices[v]);
            }
    return most == 0 ? 0 : std::nextafter(most, std::numeric_limits<double>::infinity());
}

void write_expected_errors(CertificateWriter& out, std::span<const FilledRecord> filled) {
    std::vector<std::uint32_t> interpolated;
    std::vector<double> deviation;
    for (const FilledRecord& record : filled) {
        interpolated.insert(interpolated.end(), record.interpolated.begin(),
                            record.interpolated.end());
        deviation.insert(deviation.end(), record.deviation.begin(), record.deviation.end());
    }
    out.raw(",\n\"invented\":");
    out.numbers(interpolated);
    out.raw(",\n\"deviation\":");
    out.array(deviation, [&](double error) {
        if (std::isnan(error))
            out.raw("null");
        else
            out.quote(error);
    });
}

} // namespace

std::string to_filled_certificate(std::span<const InputRecord> files,
                                  std::span<const Surface> surfaces,
                                  std::span<const OutputRecord> outputs,
                                  std::span<const FilledRecord> filled) {
    const StandardArithmetic guard;
    std::vector<Surface> all;
    for (const FilledRecord& record : filled) all.push_back(*record.filled);
    const Mesh mesh = concatenate(all);
    std::string text;
    CertificateWriter out(text);
    write_head(out, "filled", {files, surfaces, outputs});
    out.raw(",\n\"filled\":{\"vertices\":");
    write_points(out, mesh.vertices);
    out.raw(",\n\"triangles\":");
    out.arrays(mesh.triangles);
    out.raw(",\n\"surfaces\":");
    const auto part = [&](const FilledRecord& record) {
        out.raw("{\"vertices\":");
        out.number(record.filled->vertices.size());
        out.raw(",\"triangles\":");
        out.number(record.filled->triangles.size());
        out.raw(",\"limit\":");
        out.quote(limit_of(record));
        out.raw("}");
    };
    out.array(filled, part, ",\n");
    write_expected_errors(out, filled);
    out.raw("}}\n");
    return text;
}

} // namespace terrane
