// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <utility>

#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/text/compressed.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

namespace fs = std::filesystem;
using namespace detail;

namespace {

constexpr std::array<std::pair<std::string_view, Format>, 51> names{{
    {"ts", Format::gocad},    {"ml", Format::gocad},        {"gp", Format::gocad},
    {"mx", Format::gocad},    {"gm", Format::gocad},        {"obj", Format::obj},
    {"off", Format::off},     {"stl", Format::stl},         {"ply", Format::ply},
    {"vtp", Format::vtp},     {"vtu", Format::vtu},         {"msh", Format::msh},
    {"msh22", Format::msh22}, {"inp", Format::inp},         {"mesh", Format::medit},
    {"poly", Format::poly},   {"smesh", Format::smesh},     {"irap", Format::irap},
    {"gri", Format::irap},    {"fgr", Format::irap},        {"zmap", Format::zmap},
    {"zycor", Format::zmap},  {"cps3", Format::cps3},       {"cps", Format::cps3},
    {"asc", Format::esri},    {"agr", Format::esri},        {"grd", Format::surfer},
    {"xyz", Format::xyz},     {"csv", Format::xyz},         {"txt", Format::xyz},
    {"dat", Format::xyz},     {"poi", Format::xyz},         {"pol", Format::xyz},
    {"vs", Format::vset},     {"pl", Format::pline},        {"vtk", Format::vtk},
    {"dxf", Format::dxf},     {"grdecl", Format::grdecl},   {"sticks", Format::sticks},
    {"exo", Format::exodus},  {"e", Format::exodus},        {"ugi", Format::ugi},
    {"ogs", Format::ogs},     {"geos", Format::geos},       {"pylith", Format::pylith},
    {"vts", Format::vts},     {"unv", Format::unv},         {"f3grid", Format::f3grid},
    {"xml", Format::landxml}, {"landxml", Format::landxml}, {"vti", Format::vti},
}};

} // namespace

std::vector<std::string_view> format_names() {
    std::vector<std::string_view> all;
    for (const auto& [name, format] : names) all.push_back(name);
    return all;
}

bool is_read(Format format) {
    switch (format) {
    case Format::gocad:
    case Format::obj:
    case Format::off:
    case Format::stl:
    case Format::ply:
    case Format::vtp:
    case Format::vtu:
    case Format::msh:
    case Format::vtk:
    case Format::dxf:
        return true;
    default:
        return format >= Format::irap;
    }
}

bool holds_surfaces(Format format) {
    return format != Format::vtu && format < Format::exodus;
}

bool holds_outlines(Format format) {
    return format == Format::vset || format == Format::pline;
}

bool is_grid(Format format) {
    return format >= Format::irap && format <= Format::surfer;
}

bool holds_grids(Format format) {
    return format == Format::vti || (is_grid(format) && format != Format::cps3);
}

bool holds_tetrahedra(Format format) {
    return format == Format::vtu || format == Format::msh || format == Format::msh22 ||
           format == Format::inp || format == Format::medit || format == Format::unv ||
           (format >= Format::exodus && format < Format::vti);
}

bool holds_second_order(Format format) {
    return format == Format::vtu || format == Format::msh || format == Format::msh22 ||
           format == Format::inp || format == Format::exodus || format == Format::ogs;
}

bool has_several_files(Format format) {
    return format == Format::ugi || format == Format::ogs || format == Format::geos;
}

bool may_be_beside(Format format, const fs::path& first, const fs::path& other) {
    if (!has_several_files(format)) return false;
    const auto extension = other.extension();
    const bool fits =
        format == Format::ugi ? extension == ".txt" || extension == ".ss" : extension == ".vtu";
    const auto folder_of = [](const fs::path& file) { return fs::absolute(file).parent_path(); };
    return fits && other.filename().string().starts_with(first.stem().string() + "_") &&
           are_same(folder_of(first), folder_of(other));
}

std::optional<Format> format_named(std::string_view name) {
    for (const auto& [known, format] : names)
        if (same_ignoring_case(name, known)) return format;
    return std::nullopt;
}

std::optional<Format> format_of(const fs::path& path) {
    const auto extension = path.extension().string();
    return extension.empty() ? std::nullopt : format_named(std::string_view(extension).substr(1));
}

std::optional<Format> format_to_read(const fs::path& path) {
    return format_of(without_compression(path));
}

} // namespace terrane
