// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/volume_options.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/text_width.hpp>
#include <terrane/io/points/outline.hpp>
#include <terrane/io/project.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_surfaces_cut = 40; ///< printed
constexpr std::size_t most_borders = 20;

/// Parses numbers separated by commas; returns none for anything else.
std::optional<std::vector<double>> numbers_in(std::string_view text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        if (at != end && *at == '+') ++at;
        const auto [after, failed] = std::from_chars(at, end, numbers.emplace_back());
        if (failed != std::errc()) return std::nullopt;
        if (after == end) return numbers;
        if (*after != ',') return std::nullopt;
        at = after + 1;
    }
}

Result<std::vector<Point2>> read_polygon(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return Error{ErrorCode::cannot_open, "is neither numbers x,y,x,y,... nor a file: " + path,
                     "--polygon"};
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return read_outline(text, path);
}

Result<std::vector<Point2>> polygon_of(const std::string& text) {
    const auto numbers = numbers_in(text);
    if (!numbers) return read_polygon(text);
    if (numbers->size() % 2 != 0) return usage("needs pairs of numbers: x,y,x,y,...", "--polygon");
    std::vector<Point2> corners;
    for (std::size_t i = 0; i < numbers->size(); i += 2)
        corners.push_back({(*numbers)[i], (*numbers)[i + 1]});
    return corners;
}

Result<ProjectVolume> box_of(const std::string& text) {
    const auto n = numbers_in(text);
    if (!n || n->size() != 6) return usage("needs six numbers: x0,y0,z0,x1,y1,z1", "--box");
    return ProjectVolume(ProjectBox{{(*n)[0], (*n)[1], (*n)[2]}, {(*n)[3], (*n)[4], (*n)[5]}});
}

Result<ProjectVolume> rotated_box_of(const VolumeOptions& options) {
    const auto n = numbers_in(options.rotated_box);
    if (!n || (n->size() != 7 && n->size() != 9))
        return usage("needs seven or nine numbers: x,y,z,across,along,up,azimuth[,plunge,roll]",
                     "--rotated-box");
    RotatedBox box;
    box.place = {(*n)[0], (*n)[1], (*n)[2]};
    box.is_corner = options.corner;
    box.lengths = {(*n)[3], (*n)[4], (*n)[5]};
    box.azimuth = (*n)[6];
    if (n->size() == 9) {
        box.plunge = (*n)[7];
        box.roll = (*n)[8];
    }
    return ProjectVolume(box);
}

Result<ProjectVolume> prism_of(const VolumeOptions& options) {
    const auto depths = numbers_in(options.between);
    if (!depths || depths->size() != 2) return usage("needs two numbers: z0,z1", "--between");
    auto corners = polygon_of(options.polygon);
    if (!corners) return corners.error();
    return ProjectVolume(ProjectPolygon{*std::move(corners), {(*depths)[0], (*depths)[1]}});
}

} // namespace

void add_volume_options(CLI::App& command, VolumeOptions& options) {
    const std::string group = "Volume of interest";
    command
        .add_option("--box", options.box,
                    "Cut all surfaces by this box, and keep the inside: x0,y0,z0,x1,y1,z1")
        ->type_name("BOX")
        ->group(group);
    command
        .add_option("--rotated-box", options.rotated_box,
                    "The same for a box turned about its centre: x,y,z,across,along,up,azimuth "
                    "(degrees clockwise from y, of the edges along)[,plunge,roll]")
        ->type_name("BOX")
        ->group(group);
    command
        .add_flag("--corner", options.corner,
                  "Of a rotated box x,y,z is the lowest corner, not the centre")
        ->group(group);
    command
        .add_option("--polygon", options.polygon,
                    "The same for a polygon between two depths: x,y,x,y,..., or a file: GeoJSON, "
                    "a shapefile, or x and y on each line")
        ->type_name("POLYGON")
        ->group(group);
    command.add_option("--between", options.between, "The two depths of the polygon: z0,z1")
        ->type_name("Z0,Z1")
        ->group(group);
    command
        .add_option("--within", options.within,
                    "The same for a closed surface; may be repeated where it is in several files")
        ->allow_extra_args(false)
        ->type_name("FILE")
        ->group(group);
    command
        .add_option(
            "--extend", options.extend,
            "Extend surfaces that end inside, other than faults, along their tangent plane to "
            "the boundary where it is no farther than this (default: they end inside)")
        ->type_name("D")
        ->group(group);
}

bool is_polygon_file(const std::string& value) {
    return !numbers_in(value);
}

Status check_volume_options(const VolumeOptions& o) {
    const int given = int{!o.box.empty()} + int{!o.rotated_box.empty()} + int{!o.polygon.empty()} +
                      int{!o.within.empty()};
    if (given > 1)
        return usage("only one of these can be given", "--box, --rotated-box, --polygon, --within");
    if (o.polygon.empty() != o.between.empty())
        return usage("each needs the other one", "--polygon, --between");
    if (o.extend != 0 && given == 0) return usage("needs a volume of interest", "--extend");
    if (o.corner && o.rotated_box.empty()) return usage("needs --rotated-box", "--corner");
    return Done{};
}

Result<ProjectVolume> volume_of(const VolumeOptions& options) {
    if (!options.box.empty()) return box_of(options.box);
    if (!options.rotated_box.empty()) return rotated_box_of(options);
    if (!options.polygon.empty()) return prism_of(options);
    if (options.within.empty()) return ProjectVolume();
    return ProjectVolume(ProjectWithin{{options.within.begin(), options.within.end()}});
}

Result<std::vector<Surface>> boundary_of(const VolumeOptions& options, Session& session) {
    const auto volume = volume_of(options);
    if (!volume) return volume.error();
    auto made = boundary_of(*volume, {}, session.run());
    if (made) return made;
    Error error = made.error();
    const auto is_about = [&](const std::string& file) { return error.place.starts_with(file); };
    if (!options.within.empty() && std::ranges::none_of(options.within, is_about))
        error.sentence = "--within " + options.within.front() + ": " + error.sentence;
    if (error.code == ErrorCode::not_closed || error.code == ErrorCode::improper_contact)
        error.code = ErrorCode::bad_option; // the options are wrong, the surfaces may be good
    return error;
}

std::string text_of(const VolumeReport& report, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    std::string text = "volume of interest: areas inside, of all, and where surfaces end inside\n";
    constexpr std::size_t least_width = 7;
    const std::size_t width = column_width(inputs.labels, least_width);
    std::size_t shown = 0, outside = 0;
    for (std::size_t s = 0; s < report.surfaces.size(); ++s) {
        const SurfaceCut& cut = report.surfaces[s];
        const double all = cut.area_inside + cut.area_outside + cut.area_on_boundary;
        if (all == cut.area_on_boundary) continue;
        if (cut.pieces == 0) {
            ++outside;
            continue;
        }
        if (++shown > most_surfaces_cut) continue;
        text += fmt::format("  {}  {:>13} of {:>13}, {}", padded(inputs.labels[s], width),
                            quantities.area(cut.area_inside + cut.area_on_boundary),
                            quantities.area(all), counted(cut.pieces, "piece"));
        if (cut.open_borders > 0)
            text += fmt::format("; ends inside along {}", quantities.length(cut.open_length));
        text += '\n';
    }
    if (shown > most_surfaces_cut)
        text += fmt::format("  and {} more\n", shown - most_surfaces_cut);
    if (outside > 0) text += fmt::format("  {} outside\n", counted(outside, "surface"));
    for (std::size_t b = 0; b < std::min(report.borders.size(), most_borders); ++b)
        text += fmt::format(
            "  {} ends inside: along {} at {}\n", inputs.labels[report.borders[b].surface],
            quantities.length(report.borders[b].length), quantities.place(report.borders[b].place));
    if (report.borders.size() > most_borders)
        text += fmt::format("  and {} more\n", report.borders.size() - most_borders);
    return text;
}

std::string text_of(std::span<const ExtendedBorder> borders, const Inputs& inputs) {
    if (borders.empty()) return "extended: no surface ends inside\n";
    const Quantities quantities = inputs.quantities();
    std::string text = "borders inside the volume, extended to its boundary or too far from it\n";
    for (std::size_t b = 0; b < std::min(borders.size(), most_borders); ++b)
        text +=
            fmt::format("  {}: along {} at {}: {}\n", inputs.labels[borders[b].surface],
                        quantities.length(borders[b].length), quantities.place(borders[b].place),
                        borders[b].reached ? "extended" : "too far");
    if (borders.size() > most_borders)
        text += fmt::format("  and {} more\n", borders.size() - most_borders);
    return text;
}

void add_statistics(Json& json, std::span<const ExtendedBorder> borders) {
    Json list = Json::array();
    for (const ExtendedBorder& b : borders)
        list.push_back({{"surface", std::uint32_t{b.surface}},
                        {"reached", b.reached},
                        {"length", b.length},
                        {"place", {b.place.x, b.place.y, b.place.z}}});
    json["extended"] = std::move(list);
}

void add_statistics(Json& json, const VolumeReport& report, const Inputs& inputs) {
    Json surfaces = Json::array(), borders = Json::array();
    for (std::size_t s = 0; s < report.surfaces.size(); ++s) {
        const SurfaceCut& cut = report.surfaces[s];
        surfaces.push_back({{"name", inputs.labels[s]},
                            {"area_inside", cut.area_inside},
                            {"area_outside", cut.area_outside},
                            {"area_on_boundary", cut.area_on_boundary},
                            {"pieces", cut.pieces},
                            {"open_length", cut.open_length}});
    }
    for (const OpenBorder& b : report.borders)
        borders.push_back({{"surface", std::uint32_t{b.surface}},
                           {"length", b.length},
                           {"place", {b.place.x, b.place.y, b.place.z}}});
    json["volume_of_interest"] = {{"surfaces", std::move(surfaces)},
                                  {"open_borders", std::move(borders)}};
}

} // namespace terrane::cli
