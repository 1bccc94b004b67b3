// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/volume_options.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/text_width.hpp>
#include <terrane/io/points/outline.hpp>
#include <terrane/io/project.hpp>
#include <terrane/io/report_members.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_surfaces_cut = 40; ///< printed
constexpr std::size_t most_borders = 20;

ProjectVolume box_of(const std::string& text) {
    const auto n = numbers_in(text);
    if (!n || n->size() != 6) refuse("needs six numbers: x0,y0,z0,x1,y1,z1", "--box");
    return ProjectBox{{(*n)[0], (*n)[1], (*n)[2]}, {(*n)[3], (*n)[4], (*n)[5]}};
}

ProjectVolume rotated_box_of(const VolumeOptions& options) {
    const auto n = numbers_in(options.rotated_box);
    if (!n || (n->size() != 7 && n->size() != 9))
        refuse("needs seven or nine numbers: x,y,z,across,along,up,azimuth[,plunge,roll]",
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
    return box;
}

ProjectVolume prism_of(const VolumeOptions& options) {
    const auto depths = numbers_in(options.between);
    if (!depths || depths->size() != 2) refuse("needs two numbers: z0,z1", "--between");
    return ProjectPolygon{corners_of(options.polygon, "--polygon"), {(*depths)[0], (*depths)[1]}};
}

} // namespace

void add_volume_options(CLI::App& command, VolumeOptions& options) {
    const std::string group = "Volume of interest";
    add_value(command, "--box", options.box, "BOX",
              "Cut all surfaces by this box, and keep the inside: x0,y0,z0,x1,y1,z1")
        ->group(group);
    add_value(command, "--rotated-box", options.rotated_box, "BOX",
              "The same for a box turned about its centre: x,y,z,across,along,up,azimuth "
              "(degrees clockwise from y, of the edges along)[,plunge,roll]")
        ->group(group);
    command
        .add_flag("--corner", options.corner,
                  "Of a rotated box x,y,z is the lowest corner, not the centre")
        ->group(group);
    add_value(command, "--polygon", options.polygon, "POLYGON",
              "The same for a polygon between two depths: x,y,x,y,..., or a file: GeoJSON, "
              "a shapefile, or x and y on each line")
        ->group(group);
    add_value(command, "--between", options.between, "Z0,Z1",
              "The two depths of the polygon: z0,z1")
        ->group(group);
    add_value(command, "--within", options.within, "FILE",
              "The same for a closed surface; may be repeated where it is in several files")
        ->allow_extra_args(false)
        ->group(group);
    add_value(command, "--extend", options.extend, "D",
              "Extend surfaces that end inside, other than faults, along their tangent plane to "
              "the boundary where it is no farther than this (default: they end inside)")
        ->group(group);
}

std::vector<Point2> corners_of(const std::string& text, const char* option) {
    const auto numbers = numbers_in(text);
    if (!numbers) {
        std::ifstream file(text, std::ios::binary);
        if (!file)
            refuse(ErrorCode::cannot_open, "is neither numbers x,y,x,y,... nor a file: " + text,
                   option);
        return must(read_outline(std::string{std::istreambuf_iterator<char>(file), {}}, text));
    }
    if (numbers->size() % 2 != 0) refuse("needs pairs of numbers: x,y,x,y,...", option);
    std::vector<Point2> corners;
    for (std::size_t i = 0; i < numbers->size(); i += 2)
        corners.push_back({(*numbers)[i], (*numbers)[i + 1]});
    return corners;
}

bool is_polygon_file(const std::string& value) {
    return !numbers_in(value);
}

void check_volume_options(const VolumeOptions& o) {
    const int given = int{!o.box.empty()} + int{!o.rotated_box.empty()} + int{!o.polygon.empty()} +
                      int{!o.within.empty()};
    if (given > 1)
        refuse("only one of these can be given", "--box, --rotated-box, --polygon, --within");
    if (o.polygon.empty() != o.between.empty())
        refuse("each needs the other one", "--polygon, --between");
    if (o.extend != 0 && given == 0) refuse("needs a volume of interest", "--extend");
    if (o.corner && o.rotated_box.empty()) refuse("needs --rotated-box", "--corner");
}

ProjectVolume volume_of(const VolumeOptions& options) {
    if (!options.box.empty()) return box_of(options.box);
    if (!options.rotated_box.empty()) return rotated_box_of(options);
    if (!options.polygon.empty()) return prism_of(options);
    if (options.within.empty()) return {};
    return ProjectWithin{{options.within.begin(), options.within.end()}};
}

std::vector<Surface> boundary_of(const VolumeOptions& options, Session& session) {
    auto made = boundary_of(volume_of(options), {}, session.run());
    if (made) return *std::move(made);
    Error error = made.error();
    const auto is_about = [&](const std::string& file) { return error.place.starts_with(file); };
    if (!options.within.empty() && std::ranges::none_of(options.within, is_about))
        error.sentence = "--within " + options.within.front() + ": " + error.sentence;
    if (error.code == ErrorCode::not_closed || error.code == ErrorCode::improper_contact)
        error.code = ErrorCode::bad_option; // the options are wrong, the surfaces may be good
    throw Failure{error};
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
    return text + listed(report.borders, most_borders, [&](const OpenBorder& border) {
               return fmt::format("  {} ends inside: along {} at {}\n",
                                  inputs.labels[border.surface], quantities.length(border.length),
                                  quantities.place(border.place));
           });
}

std::string text_of(std::span<const ExtendedBorder> borders, const Inputs& inputs) {
    if (borders.empty()) return "extended: no surface ends inside\n";
    const Quantities quantities = inputs.quantities();
    const std::string head =
        "borders inside the volume, extended to its boundary or too far from it\n";
    return head + listed(borders, most_borders, [&](const ExtendedBorder& border) {
               return fmt::format("  {}: along {} at {}: {}\n", inputs.labels[border.surface],
                                  quantities.length(border.length), quantities.place(border.place),
                                  border.reached ? "extended" : "too far");
           });
}

void add_statistics(Json& json, std::span<const ExtendedBorder> borders) {
    Json list = Json::array();
    for (const ExtendedBorder& b : borders)
        list.push_back({{"surface", b.surface},
                        {"reached", b.reached},
                        {"length", b.length},
                        {"place", b.place}});
    json["extended"] = std::move(list);
}

void add_statistics(Json& json, const VolumeReport& report, const Inputs& inputs) {
    Json surfaces = Json::array();
    for (std::size_t s = 0; s < report.surfaces.size(); ++s) {
        const SurfaceCut& cut = report.surfaces[s];
        surfaces.push_back({{"name", inputs.labels[s]},
                            {"area_inside", cut.area_inside},
                            {"area_outside", cut.area_outside},
                            {"area_on_boundary", cut.area_on_boundary},
                            {"pieces", cut.pieces},
                            {"open_length", cut.open_length}});
    }
    json["volume_of_interest"] = {{"surfaces", std::move(surfaces)},
                                  {"open_borders", report.borders}};
}

} // namespace terrane::cli
