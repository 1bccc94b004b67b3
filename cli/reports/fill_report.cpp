// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/fill_report.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/reconstruction/joining/join.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>
#include <terrane/cli/reports/fill_map.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/io/report_members.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_holes = 30; ///< printed

const char* name_of_kind(const BorderLoop& loop) {
    return loop.kind == LoopKind::hole ? "hole" : "fault gap";
}

/// Reports the error that the method expects, else the one measured at data left out.
std::string error_text(const FillReport& r) {
    if (std::isfinite(r.expected_error))
        return fmt::format("expected error {}", figure(r.expected_error, 4));
    if (std::isfinite(r.validated_error))
        return fmt::format("error {} at data left out", figure(r.validated_error, 4));
    return "error not known";
}

} // namespace

std::string borders_text(const FillWork& work) {
    std::string text;
    for (const HoledSurface& s : work.surfaces) {
        std::map<LoopKind, std::size_t> count_of;
        for (const BorderLoop& loop : s.loops) ++count_of[loop.kind];
        text += fmt::format("{}: {}, {}, {}\n", s.label,
                            counted(count_of[LoopKind::outer], "outer border"),
                            counted(count_of[LoopKind::hole], "hole"),
                            counted(count_of[LoopKind::fault_gap], "fault gap"));
    }
    return text;
}

std::string holes_table(const FillWork& work) {
    if (work.holes.empty()) return {};
    std::string text =
        heading(fmt::format("{:>6}  {:<10} {:>8} {:>12} {:>12} {:>10} {:>10}  {}", "hole", "kind",
                            "border", "length", "area", "width", "throw", "centre, surface")) +
        "\n";
    for (const NumberedHole& hole : work.holes) {
        const BorderLoop& loop = loop_of(work, hole);
        text += fmt::format("{:>6}  {:<10} {:>8} {:>12} {:>12} {:>10} {:>10}  "
                            "{} {}\n",
                            hole.number, name_of_kind(loop), loop.vertices.size(),
                            figure(loop.length, 6), figure(loop.area, 6), figure(loop.width, 4),
                            figure(loop.fault_throw, 4), place_text(loop.centre),
                            work.surfaces[hole.task].label);
    }
    return text;
}

std::string filled_text(const FillWork& work) {
    std::string text;
    std::size_t shown = 0, filled = 0, points = 0;
    double area = 0;
    for (const NumberedHole& hole : work.holes) {
        if (!hole.report) continue;
        const FillReport& r = *hole.report;
        ++filled;
        points += r.interpolated;
        area += r.area;
        if (shown++ >= most_holes) continue;
        text += fmt::format("hole {}: {} and area {} interpolated, {}, from {}\n  {}\n",
                            hole.number, counted(r.interpolated, "point"), figure(r.area, 6),
                            error_text(r), counted(r.data, "point"), r.model);
    }
    if (shown > most_holes) text += fmt::format("and {} more\n", shown - most_holes);
    text +=
        fmt::format("filled {} of {}: {} and area {} interpolated\n", filled,
                    counted(work.holes.size(), "hole"), counted(points, "point"), figure(area, 6));
    return text;
}

std::string refusals_text(const FillWork& work) {
    std::string text;
    for (const NumberedHole& hole : work.holes)
        if (!hole.refused.empty())
            text += complaint(fmt::format("hole {} of {} is left open: {}", hole.number,
                                          work.surfaces[hole.task].label, hole.refused));
    return text;
}

std::string contacts_text(const FillWork& work, std::span<const NewContact> contacts) {
    constexpr std::size_t most_contacts = 10;
    return listed(contacts, most_contacts, [&](const NewContact& c) {
        return fmt::format("  {}, hole {}: {} at {}\n", work.surfaces[c.task].label, c.hole,
                           name_of(c.kind), place_text(c.place));
    });
}

void add_statistics(Json& json, const FillWork& work) {
    Json list = Json::array();
    for (const NumberedHole& hole : work.holes) {
        const BorderLoop& loop = loop_of(work, hole);
        Json entry{{"hole", hole.number},        {"surface", work.surfaces[hole.task].label},
                   {"kind", name_of_kind(loop)}, {"border", loop.vertices.size()},
                   {"length", loop.length},      {"area", loop.area},
                   {"width", loop.width},        {"throw", loop.fault_throw},
                   {"centre", loop.centre}};
        if (hole.report) entry["filled"] = *hole.report;
        if (!hole.refused.empty()) entry["refused"] = hole.refused;
        list.push_back(std::move(entry));
    }
    json["holes"] = std::move(list);
    add_constants(json, "holes", hole_constants());
    const auto is_filled_by = [&](FillMethod method) {
        return std::any_of(work.holes.begin(), work.holes.end(), [&](const NumberedHole& hole) {
            return (hole.report || !hole.refused.empty()) &&
                   work.surfaces[hole.task].task.options.method == method;
        });
    };
    if (is_filled_by(FillMethod::kriging)) add_constants(json, "kriging", kriging_constants());
    if (is_filled_by(FillMethod::rbf)) {
        add_constants(json, "rbf", rbf_constants());
        add_constants(json, "join", join_constants());
    }
}

std::string csv_of(const FillWork& work) {
    std::string text = "x,y,z,deviation,variance,surface\n";
    for (const HoledSurface& s : work.surfaces) {
        std::string name = s.label;
        std::replace(name.begin(), name.end(), '"', '\'');
        for (auto v = s.given_vertices; v < s.filled.vertices.size(); ++v) {
            const Point3& q = s.filled.vertices[v];
            const double d = s.deviation[v];
            const auto errors =
                std::isfinite(d) ? fmt::format("{:.6g},{:.6g}", d, d * d) : std::string(",");
            text += fmt::format("{},{},{},{},\"{}\"\n", q.x, q.y, q.z, errors, name);
        }
    }
    return text;
}

std::string map_of(const FillWork& work) {
    std::vector<Surface> before; // the input surfaces, without the triangles added
    for (const HoledSurface& s : work.surfaces) {
        before.push_back(s.filled);
        before.back().vertices.resize(s.given_vertices);
        before.back().triangles.resize(s.given_triangles);
    }
    std::vector<FillMap> maps;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const HoledSurface& s = work.surfaces[i];
        maps.push_back({s.label, &before[i], &s.filled, s.deviation, s.loops});
    }
    return svg_of(maps);
}

} // namespace terrane::cli
