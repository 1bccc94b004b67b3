// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sections as files for drawings, maps and tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/sections/sections.hpp>

namespace terrane {

/// What the files of a section call its parts.
struct SectionNames {
    std::vector<std::string> blocks;   ///< per block of the model; [0]: the outside
    std::vector<std::string> units;    ///< per block: its unit, or empty
    std::vector<SurfaceInfo> surfaces; ///< of the model
    std::string title{};               ///< of a drawing
    std::string length_unit{};         ///< of the model; empty: not stated
    double exaggeration = 1;           ///< of a drawing: by which `up` is stretched
    bool shows_behind =
        false; ///< whether a drawing shows the block behind the section, as a geological map does

    bool shows_pairs =
        false; ///< whether it shows which block touches which across the section, as Allan diagrams do
    bool shows_heights = false; ///< whether a drawing names lines by their heights, as contours are

    /// Returns the block that stands for a polygon: the one on the side that is shown, or if that is the outside, the
    /// other one.
    [[nodiscard]] BlockId shown(const SectionPolygon& polygon) const {
        const BlockId first = shows_behind ? polygon.behind : polygon.block;
        return first != 0 ? first : shows_behind ? polygon.block : polygon.behind;
    }
};

/// Returns the names of the blocks, units and surfaces of a model; those of surfaces are made unique.
SectionNames names_in(const Model& model);

/// The formats of sections that are no formats of meshes.
enum class SectionFormat : std::uint8_t { svg, geojson, dxf, csv, shp };

/// Returns the format of an extension, ".svg"; nothing for others.
std::optional<SectionFormat> section_format(std::string_view extension);

/// A file of a section.
struct SectionFile {
    std::string ending;   ///< of its name, after the stem: ".svg", "_lines.dbf"
    std::string contents; ///< all bytes
};

/// Returns the files of a section in a format; the first is called like the format. Bytes of names that are not UTF-8
/// become U+FFFD. Errors: those of section_shapes().
Result<std::vector<SectionFile>> section_files(const Section& section, const SectionNames& names,
                                               SectionFormat format);

/// Writes them next to each other, all or none; a single one has this path, "-" is standard output. Returns their paths.
/// Errors: bad_option for several files on standard output; those of section_files() and write_file().
Result<std::vector<std::filesystem::path>> write_section(const Section& section,
                                                         const SectionNames& names,
                                                         SectionFormat format,
                                                         const std::filesystem::path& path);

/// Whether coordinates of the section are those of the map.
bool is_map(const Section& section);

/// Draws a section in SVG 1.1: polygons coloured by unit, or by block where there is no unit, and hatched from the
/// thirteenth one on; lines, thick for faults; names, scale and legend. Vertical and horizontal scale are the same, but
/// for the exaggeration.
std::string section_svg(const Section& section, const SectionNames& names);

/// Writes a FeatureCollection: polygons with "block", "behind", "unit" and "area", and lines with "surface" and
/// "role". Coordinates are those along the section and across it; z follows where these are x and y.
std::string section_geojson(const Section& section, const SectionNames& names);

/// Writes rings and lines as 3-D POLYLINEs of release 12, on layers called after blocks and surfaces.
std::string section_dxf(const Section& section, const SectionNames& names);

/// Writes a row per vertex of each ring and line: part (from 1), kind (outer, hole, line), block, behind, unit, surface,
/// x, y, z, along, up. Rings repeat their first vertex.
std::string section_csv(const Section& section, const SectionNames& names);

/// Returns the triangles of a section as a mesh, for the formats of meshes: its surfaces are the blocks that are shown.
Mesh section_mesh(const Section& section, const SectionNames& names);

} // namespace terrane
