// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/info_report.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/text_width.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane::cli {
namespace {

/// The box around the vertices of surfaces.
struct Extent {
    explicit Extent(std::span<const Surface> surfaces) {
        for (const Surface& s : surfaces)
            for (const Point3& p : s.vertices) {
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
    }
    static constexpr double inf = std::numeric_limits<double>::infinity();
    Point3 low{inf, inf, inf}, high{-inf, -inf, -inf};
};

std::string_view role_of(const Surface& surface) {
    return detail::role_names[static_cast<std::size_t>(surface.role)];
}

std::string_view direction_of(VerticalAxis axis) {
    switch (axis) {
    case VerticalAxis::unstated:
        return "unstated";
    case VerticalAxis::up:
        return "heights";
    case VerticalAxis::down:
        return "depths";
    }
    return "";
}

/// Says what the file states about the coordinates of a surface; empty: nothing.
std::string stated(const CoordinateFrame& frame) {
    std::vector<std::string> all;
    if (!frame.horizontal_unit.empty()) all.push_back("x and y in " + frame.horizontal_unit);
    if (!frame.vertical_unit.empty()) all.push_back("z in " + frame.vertical_unit);
    if (frame.vertical_axis == VerticalAxis::up) all.emplace_back("z is a height");
    if (frame.vertical_axis == VerticalAxis::down)
        all.emplace_back("z is a depth, which was turned over");
    if (!frame.system.empty()) all.push_back("coordinate system " + frame.system);
    return fmt::format("{}", fmt::join(all, "; "));
}

/// Joins what is said of several surfaces, each thing once.
template <class Said>
std::string said_of(std::span<const Surface> surfaces, const Said& said) {
    std::vector<std::string> all;
    for (const Surface& s : surfaces)
        for (const std::string& text : said(s))
            if (!text.empty() && std::ranges::find(all, text) == all.end()) all.push_back(text);
    return fmt::format("{}", fmt::join(all, ", "));
}

std::string shape_of(const CheckReport& surface) {
    if (surface.triangles == 0) return "points only";
    return surface.free_border_edges == 0
               ? "closed"
               : fmt::format("open, {}", counted(surface.free_border_edges, "border edge"));
}

/// Names the flaws of a surface by itself.
std::string flaws_of(const CheckReport& r) {
    std::vector<std::string> all;
    const auto add = [&](std::size_t count, std::string_view noun) {
        if (count > 0) all.push_back(counted(count, noun));
    };
    add(r.contacts.size(), "improper contact");
    add(r.degenerate.size(), "triangle");
    if (!r.degenerate.empty()) all.back() += " without area";
    add(r.repeated.size(), "repeated triangle");
    add(r.non_manifold_edges.size(), "non-manifold edge");
    return all.empty() ? "none" : fmt::format("{}", fmt::join(all, ", "));
}

/// Returns lines for the surfaces of one file, the first of which is number `first` of all.
std::string table_of(const FileInfo& file, std::size_t first, const Inputs& inputs) {
    std::vector<std::array<std::string, 7>> rows{
        {"surface", "role", "triangles", "vertices", "parts", "border", "flaws"}};
    for (std::size_t s = 0; s < file.surfaces.size(); ++s) {
        const CheckReport& r = file.surfaces[s];
        rows.push_back({inputs.labels[first + s], std::string(role_of(inputs.surfaces[first + s])),
                        std::to_string(r.triangles), std::to_string(r.vertices),
                        std::to_string(r.components), shape_of(r), flaws_of(r)});
    }
    std::array<std::size_t, 7> widths{};
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c)
            widths[c] = std::max(widths[c], width_of(row[c]));
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c) {
            const bool is_number = c >= 2 && c <= 4;
            line += "  " + (is_number ? std::string(widths[c] - width_of(row[c]), ' ') + row[c]
                                      : padded(row[c], widths[c]));
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string extent_text(std::span<const Surface> surfaces, const Inputs& inputs) {
    const Extent extent(surfaces);
    if (extent.low.x > extent.high.x) return "";
    const Quantities quantities = inputs.quantities();
    return fmt::format("  from {} to {}\n", quantities.place(extent.low),
                       quantities.place(extent.high));
}

/// Names the arrays of a surface, with their units.
std::vector<std::string> names_of_arrays(const Surface& surface) {
    std::vector<std::string> names;
    for (const ValueArray& a : surface.arrays)
        names.push_back(a.name + (a.unit.empty() ? "" : " in " + a.unit) +
                        (a.on_triangles ? " (triangles)" : ""));
    return names;
}

Json arrays_json(const Surface& surface) {
    Json arrays = Json::array();
    for (const ValueArray& a : surface.arrays)
        arrays.push_back({{"name", a.name},
                          {"on", a.on_triangles ? "triangles" : "vertices"},
                          {"type", std::string(name_of(a.type))},
                          {"components", a.components},
                          {"unit", a.unit}});
    return arrays;
}

Json json_of(const CheckReport& r, const Surface& surface) {
    const Extent extent(std::span(&surface, 1));
    const bool any = !surface.vertices.empty();
    return {{"name", surface.name},
            {"role", std::string(role_of(surface))},
            {"triangles", r.triangles},
            {"vertices", r.vertices},
            {"components", r.components},
            {"free_border_edges", r.free_border_edges},
            {"improper_contacts", r.contacts.size()},
            {"degenerate", r.degenerate.size()},
            {"repeated", r.repeated.size()},
            {"non_manifold_edges", r.non_manifold_edges.size()},
            {"low", any ? Json(extent.low) : Json()},
            {"high", any ? Json(extent.high) : Json()},
            {"horizontal_unit", surface.frame.horizontal_unit},
            {"vertical_unit", surface.frame.vertical_unit},
            {"vertical_axis", std::string(direction_of(surface.frame.vertical_axis))},
            {"system", surface.frame.system},
            {"values", arrays_json(surface)},
            {"values_not_read", surface.values}};
}

} // namespace

std::string text_of(const std::vector<FileInfo>& files, const CheckReport& together,
                    const Inputs& inputs) {
    const std::span all(inputs.surfaces);
    std::string text;
    std::size_t first = 0, alone = 0;
    for (const FileInfo& file : files) {
        const auto surfaces = all.subspan(first, file.surfaces.size());
        text += fmt::format("{}: {}, {}\n", file.file, file.format,
                            counted(surfaces.size(), "surface"));
        text += table_of(file, first, inputs) + extent_text(surfaces, inputs);
        const auto frames =
            said_of(surfaces, [](const Surface& s) { return std::array{stated(s.frame)}; });
        if (!frames.empty()) text += "  states: " + frames + "\n";
        const auto arrays = said_of(surfaces, names_of_arrays);
        if (!arrays.empty()) text += "  values: " + arrays + "\n";
        const auto values = said_of(surfaces, [](const Surface& s) { return s.values; });
        if (!values.empty()) text += "  values, which are not read: " + values + "\n";
        for (const CheckReport& r : file.surfaces) alone += r.contacts.size();
        first += file.surfaces.size();
    }
    if (files.size() > 1)
        text += fmt::format(
            "all: {}, {}, {} distinct vertices\n{}", counted(together.surfaces, "surface"),
            counted(together.triangles, "triangle"), together.vertices, extent_text(all, inputs));
    if (all.size() > 1)
        text += fmt::format("{} of triangles of different surfaces cross, touch or overlap\n",
                            counted(together.contacts.size() - alone, "pair"));
    return text;
}

Json json_of(const std::vector<FileInfo>& files, const CheckReport& together,
             const Inputs& inputs) {
    Json json;
    std::size_t s = 0, alone = 0;
    for (const FileInfo& file : files) {
        Json surfaces = Json::array();
        for (const CheckReport& r : file.surfaces) {
            surfaces.push_back(json_of(r, inputs.surfaces[s++]));
            alone += r.contacts.size();
        }
        json["files"].push_back(
            {{"file", file.file}, {"format", file.format}, {"surfaces", std::move(surfaces)}});
    }
    json["vertices"] = together.vertices;
    json["contacts_of_surfaces"] = together.contacts.size() - alone;
    return json;
}

} // namespace terrane::cli
