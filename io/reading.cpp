// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/reading.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/detail/recognition.hpp>
#include <terrane/io/meshes/leapfrog.hpp>
#include <terrane/io/text/utf8.hpp>

namespace terrane {
namespace {

/// Whether a file may have points; one whose format is not known may.
bool has_points(std::optional<Format> format) {
    return !format || format == Format::xyz || format == Format::vset || format == Format::pline;
}

bool has_depths(std::optional<Format> format) {
    return has_points(format) || format == Format::irap || format == Format::zmap ||
           format == Format::cps3 || format == Format::esri || format == Format::surfer ||
           format == Format::sticks;
}

constexpr std::array<std::pair<Format, std::string_view>, 21> titles{{
    {Format::gocad, "GOCAD"},
    {Format::obj, "Wavefront OBJ"},
    {Format::off, "OFF"},
    {Format::stl, "STL"},
    {Format::ply, "PLY"},
    {Format::vtp, "VTK PolyData"},
    {Format::vtu, "VTK UnstructuredGrid"},
    {Format::msh, "Gmsh MSH"},
    {Format::vtk, "legacy VTK"},
    {Format::irap, "Irap grid"},
    {Format::zmap, "ZMAP+ grid"},
    {Format::cps3, "CPS-3 grid"},
    {Format::esri, "ESRI ASCII grid"},
    {Format::surfer, "Surfer grid"},
    {Format::xyz, "points in columns"},
    {Format::vset, "GOCAD points"},
    {Format::dxf, "DXF"},
    {Format::grdecl, "corner-point grid"},
    {Format::sticks, "fault sticks"},
    {Format::vts, "VTK StructuredGrid"},
    {Format::landxml, "LandXML"},
}};

} // namespace

std::string format_in(const std::filesystem::path& path, std::optional<Format> format) {
    if (!format) format = format_to_read(path);
    if (format == Format::pline) format = Format::vset;
    if ((format == Format::xyz || format == Format::msh) && path != "-")
        if (const auto contents = read_file(path)) {
            const std::string utf8 = detail::utf8_of_utf16(*contents);
            if (format == Format::xyz)
                format = detail::format_seen_in(utf8.empty() ? *contents : utf8).value_or(*format);
            else if (is_leapfrog(*contents))
                return "Leapfrog mesh";
        }
    const auto* const title =
        std::ranges::find(titles, format, &decltype(titles)::value_type::first);
    return std::string(title == titles.end() ? "unknown" : title->second);
}

Status check_reading(const std::vector<std::optional<Format>>& files, const ReadOptions& options,
                     const std::array<const char*, 3>& option_names) {
    if (options.depth && std::none_of(files.begin(), files.end(), has_depths))
        return Error{ErrorCode::bad_option, "is for grids and points, and no file is one",
                     option_names[0]};
    if (options.max_edge != 0 && std::none_of(files.begin(), files.end(), has_points))
        return Error{ErrorCode::bad_option, "is for points, and no file has any", option_names[1]};
    if (options.columns.empty()) return Done{};
    const auto has_columns = [](std::optional<Format> format) {
        return !format || format == Format::xyz;
    };
    if (std::none_of(files.begin(), files.end(), has_columns))
        return Error{ErrorCode::bad_option, "is for columns of numbers, and no file has any",
                     option_names[2]};
    const std::string_view columns = options.columns;
    if (std::ranges::count(columns, ',') != 2 || columns.starts_with(',') ||
        columns.ends_with(',') || columns.find(",,") != std::string_view::npos)
        return Error{ErrorCode::bad_option, "must name three columns: those of x, y and z",
                     option_names[2]};
    return Done{};
}

} // namespace terrane
