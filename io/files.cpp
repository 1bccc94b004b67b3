// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/files.hpp>

#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/detail/recognition.hpp>
#include <terrane/io/gocad/gocad.hpp>
#include <terrane/io/gocad/gocad_curves.hpp>
#include <terrane/io/grids/cps3.hpp>
#include <terrane/io/grids/esri.hpp>
#include <terrane/io/grids/grdecl.hpp>
#include <terrane/io/grids/grid_text.hpp>
#include <terrane/io/grids/grid_writers.hpp>
#include <terrane/io/grids/irap.hpp>
#include <terrane/io/grids/surfer.hpp>
#include <terrane/io/grids/zmap.hpp>
#include <terrane/io/meshes/abaqus.hpp>
#include <terrane/io/meshes/cell_array.hpp>
#include <terrane/io/meshes/exodus.hpp>
#include <terrane/io/meshes/flac3d.hpp>
#include <terrane/io/meshes/geos.hpp>
#include <terrane/io/meshes/gmsh.hpp>
#include <terrane/io/meshes/gmsh22.hpp>
#include <terrane/io/meshes/gmsh_reader.hpp>
#include <terrane/io/meshes/leapfrog.hpp>
#include <terrane/io/meshes/legacy_vtk.hpp>
#include <terrane/io/meshes/medit.hpp>
#include <terrane/io/meshes/msh_values.hpp>
#include <terrane/io/meshes/opengeosys.hpp>
#include <terrane/io/meshes/pflotran.hpp>
#include <terrane/io/meshes/poly.hpp>
#include <terrane/io/meshes/pylith.hpp>
#include <terrane/io/meshes/universal.hpp>
#include <terrane/io/meshes/vti.hpp>
#include <terrane/io/meshes/vtk.hpp>
#include <terrane/io/meshes/vtp_reader.hpp>
#include <terrane/io/points/points.hpp>
#include <terrane/io/points/sticks.hpp>
#include <terrane/io/reading.hpp>
#include <terrane/io/surfaces/dxf.hpp>
#include <terrane/io/surfaces/landxml.hpp>
#include <terrane/io/surfaces/obj.hpp>
#include <terrane/io/surfaces/off.hpp>
#include <terrane/io/surfaces/ply.hpp>
#include <terrane/io/surfaces/stl.hpp>
#include <terrane/io/text/compressed.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/units.hpp>
#include <terrane/io/text/utf8.hpp>

namespace terrane {

namespace fs = std::filesystem;
using namespace detail;

namespace {

/// The largest file that is read. It has at least 3 bytes per vertex, so 32-bit indices suffice.
constexpr std::uint64_t max_bytes = 3 * (std::uint64_t(1) << 32) - 3;

/// Reads a file, and what was compressed.
Result<std::string> plain_file(const fs::path& path, const std::string& place) {
    auto contents = read_file(path);
    if (!contents || !is_compressed(*contents)) return contents;
    return decompressed(*contents, place);
}

std::string place_of(const fs::path& path, bool reading) {
    if (path != "-") return path.string();
    return reading ? "standard input" : "standard output";
}

/// Returns the extensions of formats that are read: "ts, ml, ...".
std::string extensions_read() {
    std::string list;
    for (const std::string_view name : format_names())
        if (is_read(*format_named(name))) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

Error unknown_format(const fs::path& path, bool reading) {
    std::string sentence = path == "-" ? "the format must be given"
                           : path.extension().empty()
                               ? "the file name has no extension that tells the format"
                               : "unknown format " + shown(path.extension().string());
    if (reading) sentence += "; read are " + extensions_read();
    return {ErrorCode::unknown_format, std::move(sentence), place_of(path, reading)};
}

Result<Format> choose_format(const fs::path& path, std::optional<Format> wanted, bool reading) {
    const auto format = wanted ? wanted : reading ? format_to_read(path) : format_of(path);
    if (!format) return unknown_format(path, reading);
    return *format;
}

Result<Grid> parse_grid(std::string_view contents, std::string_view source, std::string_view name,
                        Format format) {
    switch (format) {
    case Format::irap:
        return read_irap(contents, source, name);
    case Format::zmap:
        return read_zmap(contents, source, name);
    case Format::cps3:
        return read_cps3(contents, source, name);
    case Format::esri:
        return read_esri(contents, source, name);
    case Format::surfer:
        return read_surfer(contents, source, name);
    default:
        return Error{ErrorCode::nothing_to_do, "the file has no grid", std::string(source)};
    }
}

Result<std::vector<Surface>> parse_as_stated(std::string_view contents, std::string_view source,
                                             Format format, const ReadOptions& options) {
    const std::string place(source);
    const auto name = without_compression(place).stem().string();
    if (contents.size() > max_bytes)
        return Error{ErrorCode::unsupported, "the file is larger than 12 GiB", place};
    switch (format) {
    case Format::gocad:
        return read_gocad(contents, source, name, !options.unit.empty());
    case Format::obj:
        return read_obj(contents, source, name);
    case Format::off:
        return read_off(contents, source, name);
    case Format::stl:
        return read_stl(contents, source, name);
    case Format::ply:
        return read_ply(contents, source, name);
    case Format::vtp:
        return read_vtp(contents, source, name);
    case Format::vtu:
        return read_vtu(contents, source, name);
    case Format::msh:
        if (is_leapfrog(contents)) return read_leapfrog(contents, source, name);
        return read_msh(contents, source, name);
    case Format::vtk:
        return read_vtk(contents, source, name);
    case Format::vts:
        return read_vts(contents, source, name);
    case Format::landxml:
        return read_landxml(contents, source, name);
    case Format::dxf:
        return read_dxf(contents, source, name);
    case Format::grdecl:
        return read_grdecl(contents, source);
    case Format::irap:
    case Format::zmap:
    case Format::cps3:
    case Format::esri:
    case Format::surfer:
        return surfaces_of(parse_grid(contents, source, name, format), source, options);
    case Format::xyz:
        if (const auto seen = format_seen_in(contents))
            return parse_as_stated(contents, source, *seen, options);
        return read_points(contents, source, name, options);
    case Format::sticks:
        return read_sticks(contents, source, name, options);
    case Format::vset:
    case Format::pline:
        return read_gocad_points(contents, source, name, options);
    default:
        break;
    }
    return Error{ErrorCode::unsupported,
                 "this format is written, not read; read are " + extensions_read(), place};
}

Result<std::vector<Surface>> parse(std::string_view contents, std::string_view source,
                                   Format format, const ReadOptions& options) {
    std::string plain;
    const bool is_ringmesh = format == Format::gocad && contents.starts_with("PK") &&
                             without_compression(source) == source; // refused by its reader
    if (is_compressed(contents) && !is_ringmesh) {
        auto done = decompressed(contents, source);
        if (!done) return done.error();
        contents = plain = std::move(*done);
    }
    const std::string utf8 = utf8_of_utf16(contents);
    if (!utf8.empty()) contents = utf8;
    auto surfaces = parse_as_stated(contents, source, format, options);
    if (!surfaces || options.unit.empty()) return surfaces;
    for (Surface& s : *surfaces)
        if (auto trouble = convert_units(s, options.unit))
            return Error{trouble->code, trouble->sentence, std::string(source)};
    return surfaces;
}

Result<std::string> contents_of(const Mesh& mesh, Format format, const WriteOptions& options) {
    switch (format) {
    case Format::gocad:
        return to_gocad(mesh, options.values);
    case Format::obj:
        return to_obj(mesh);
    case Format::off:
        return to_off(mesh);
    case Format::stl:
        return options.ascii ? to_stl_ascii(mesh) : to_stl(mesh);
    case Format::ply:
        return to_ply(mesh, options.values);
    case Format::msh:
        return to_msh(mesh) + to_msh_values(mesh, options.values, false);
    case Format::msh22:
        return to_msh22(mesh) + to_msh_values(mesh, options.values, true);
    case Format::inp:
        return to_abaqus(mesh);
    case Format::medit:
        return to_medit(mesh);
    case Format::vtk:
        return to_vtk(mesh, options.values);
    case Format::dxf:
        return to_dxf(mesh);
    case Format::unv:
        return to_universal(mesh);
    case Format::poly:
        return to_poly(mesh, options.block_points);
    case Format::smesh:
        return to_smesh(mesh, options.block_points);
    case Format::vtp:
        return to_vtp(mesh, options.compress, options.cells, options.block_names, options.values);
    case Format::vset:
        return to_vset(mesh);
    case Format::pline:
        return to_plines(mesh);
    default:
        break;
    }
    return Error{ErrorCode::unsupported,
                 holds_tetrahedra(format) ? "this format is for tetrahedra, not for surfaces"
                                          : "this format is read, not written",
                 ""};
}

Result<SeveralFiles> one_file(Result<std::string> contents) {
    if (!contents) return contents.error();
    return SeveralFiles{{"", std::move(*contents)}};
}

/// Returns the files of tetrahedra, of second order with `nodes`.
Result<SeveralFiles> files_of(const TetrahedralMesh& mesh, Format format, const fs::path& path,
                              const WriteOptions& options, const EdgeNodes* nodes) {
    const auto& block_names = options.block_names;
    const VtkFiles vtk{path.stem().string(), options.compress};
    switch (format) {
    case Format::vtu:
        return one_file(
            to_vtu(mesh, options.compress, options.cells, block_names, nodes, options.values));
    case Format::msh:
        return one_file(to_msh(mesh, block_names, nodes) +
                        to_msh_values(mesh, options.values, false));
    case Format::msh22:
        return one_file(to_msh22(mesh, block_names, nodes) +
                        to_msh_values(mesh, options.values, true));
    case Format::inp:
        return one_file(to_abaqus(mesh, block_names, nodes));
    case Format::medit:
        return one_file(to_medit(mesh));
    case Format::exodus:
        return one_file(to_exodus(mesh, block_names, nodes));
    case Format::unv:
        return one_file(to_universal(mesh, block_names));
    case Format::f3grid:
        return one_file(to_flac3d(mesh, block_names));
    case Format::pylith:
        return one_file(to_pylith(mesh));
    case Format::ogs:
        return to_opengeosys(mesh, vtk, block_names, nodes);
    case Format::geos:
        return to_geos(mesh, vtk, block_names);
    case Format::ugi:
        return to_pflotran(mesh, vtk.stem, block_names);
    default:
        break;
    }
    return Error{ErrorCode::unsupported, "this format does not hold tetrahedra", ""};
}

Result<SeveralFiles> files_of(const TetrahedralMesh& mesh, Format format, const fs::path& path,
                              const WriteOptions& options) {
    if (options.order != 1 && options.order != 2)
        return Error{ErrorCode::bad_option, "the order of tetrahedra is 1 or 2", ""};
    if (path == "-" && has_several_files(format))
        return Error{ErrorCode::bad_option,
                     "in this format tetrahedra are several files: name the first", ""};
    if (options.order == 1) return files_of(mesh, format, path, options, nullptr);
    if (holds_tetrahedra(format) && !holds_second_order(format))
        return Error{ErrorCode::unsupported, "this format has no tetrahedra of second order", ""};
    const auto nodes = find_edge_nodes(mesh);
    if (!nodes) return nodes.error();
    return files_of(mesh, format, path, options, &*nodes);
}

/// Writes all files or none.
Result<std::vector<fs::path>> write_several(const SeveralFiles& files, const fs::path& path) {
    std::optional<FileSet> together;
    if (files.size() > 1 && !FileSet::current()) together.emplace();
    std::vector<fs::path> paths;
    for (const auto& part : files) {
        paths.push_back(part.file.empty() ? path : path.parent_path() / part.file);
        if (auto written = write_file(paths.back(), part.contents); !written)
            return written.error();
    }
    if (together)
        if (auto published = together->publish(); !published) return published.error();
    return paths;
}

/// Calls work(place) with the place of the file for errors, of which lack of memory is one.
template <class Work>
auto guard_file(const fs::path& path, bool reading, const Work& work) {
    return guard_memory("", [&] {
        const std::string place = place_of(path, reading);
        return guard_memory(place, [&] { return work(place); });
    });
}

/// Returns an error about a file as a whole with its place.
Error at(const std::string& place, Error error) {
    if (error.place.empty()) error.place = place;
    return error;
}

} // namespace

Result<std::vector<Surface>> parse_surfaces(std::string_view contents, std::string_view source,
                                            Format format, const ReadOptions& options) {
    return guard_memory(source, [&] { return parse(contents, source, format, options); });
}

Result<std::vector<Surface>> read_surfaces(const fs::path& path, std::optional<Format> format,
                                           const ReadOptions& options) {
    return guard_file(path, true, [&](const std::string& place) -> Result<std::vector<Surface>> {
        const auto chosen = choose_format(path, format, true);
        if (!chosen) return chosen.error();
        const auto contents = read_file(path);
        if (!contents) return contents.error();
        return parse(contents.value(), place, chosen.value(), options);
    });
}

Result<Grid> read_grid(const fs::path& path, std::optional<Format> format) {
    return guard_file(path, true, [&](const std::string& place) -> Result<Grid> {
        auto chosen = choose_format(path, format, true);
        if (!chosen) return chosen.error();
        const auto contents = plain_file(path, place);
        if (!contents) return contents.error();
        const std::string utf8 = utf8_of_utf16(*contents);
        const std::string_view text = utf8.empty() ? *contents : utf8;
        if (*chosen == Format::xyz) chosen = format_seen_in(text).value_or(Format::xyz);
        return parse_grid(text, place, without_compression(path).stem().string(), *chosen);
    });
}

Result<LabelledTetrahedra> read_tetrahedra(const fs::path& path, std::optional<Format> format) {
    return guard_file(path, true, [&](const std::string& place) -> Result<LabelledTetrahedra> {
        const auto chosen = choose_format(path, format, true);
        if (!chosen) return chosen.error();
        const auto read = *chosen == Format::vtu   ? read_vtu_tetrahedra
                          : *chosen == Format::vtk ? read_vtk_tetrahedra
                          : *chosen == Format::msh ? read_msh_tetrahedra
                                                   : nullptr;
        if (!read) return Error{ErrorCode::nothing_to_do, "the format has no tetrahedra", place};
        const auto contents = plain_file(path, place);
        if (!contents) return contents.error();
        return read(*contents, place);
    });
}

Result<GocadModel> read_model(const fs::path& path) {
    return guard_file(path, true, [&](const std::string& place) -> Result<GocadModel> {
        const auto contents = plain_file(path, place);
        if (!contents) return contents.error();
        return read_gocad_model(contents.value(), place, without_compression(path).stem().string());
    });
}

std::vector<StatedBlock> read_stated_blocks(const fs::path& path, std::optional<Format> format) {
    const StandardArithmetic guard;
    const auto chosen = format ? format : format_to_read(path);
    if (path == "-" || chosen != Format::gocad) return {};
    const auto contents = plain_file(path, path.string());
    if (!contents || contents->find("Model3d") == std::string::npos) return {};
    const auto model =
        read_gocad_model(*contents, path.string(), without_compression(path).stem().string());
    return model ? stated_blocks_of(*model) : std::vector<StatedBlock>();
}

void append_stated_blocks(std::vector<StatedBlock> stated, std::size_t before,
                          std::vector<StatedBlock>& all) {
    for (StatedBlock& block : stated) {
        for (StatedBorder& border : block.borders)
            border.surface = SurfaceId(border.surface + static_cast<std::uint32_t>(before));
        all.push_back(std::move(block));
    }
}

Result<std::string> format_mesh(const Mesh& mesh, Format format, const WriteOptions& options) {
    return guard_memory("", [&] { return contents_of(mesh, format, options); });
}

Status write_mesh(const Mesh& mesh, const fs::path& path, const WriteOptions& options) {
    return guard_file(path, false, [&](const std::string& place) -> Status {
        const auto format = choose_format(path, options.format, false);
        if (!format) return format.error();
        const auto contents = contents_of(mesh, format.value(), options);
        if (!contents) return at(place, contents.error());
        return write_file(path, contents.value());
    });
}

Result<std::string> format_grid(const Grid& grid, Format format) {
    return guard_memory("", [&]() -> Result<std::string> {
        switch (format) {
        case Format::irap:
            return to_irap(grid);
        case Format::zmap:
            return to_zmap(grid);
        case Format::esri:
            return to_esri(grid);
        case Format::surfer:
            return to_surfer(grid);
        case Format::vti:
            return to_vti(grid);
        default:
            return Error{ErrorCode::unsupported,
                         "grids are written as .asc, .zmap, .irap, .grd or .vti", ""};
        }
    });
}

Status write_grid(const Grid& grid, const fs::path& path, std::optional<Format> wanted) {
    return guard_file(path, false, [&](const std::string& place) -> Status {
        const auto format = choose_format(path, wanted, false);
        if (!format) return format.error();
        const auto contents = format_grid(grid, *format);
        if (!contents) return at(place, contents.error());
        return write_file(path, *contents);
    });
}

Result<std::vector<fs::path>> write_tetrahedra_files(const TetrahedralMesh& mesh,
                                                     const fs::path& path,
                                                     const WriteOptions& options) {
    return guard_file(path, false, [&](const std::string& place) -> Result<std::vector<fs::path>> {
        const auto format = choose_format(path, options.format, false);
        if (!format) return format.error();
        const auto files = files_of(mesh, format.value(), path, options);
        if (!files) return at(place, files.error());
        return write_several(files.value(), path);
    });
}

Status write_tetrahedra(const TetrahedralMesh& mesh, const fs::path& path,
                        const WriteOptions& options) {
    const auto written = write_tetrahedra_files(mesh, path, options);
    if (!written) return written.error();
    return Done{};
}

} // namespace terrane
