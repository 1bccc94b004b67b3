// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/files.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <unistd.h>

#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/reading.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/units.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

constexpr unsigned most_threads = 1024;

Format format_of_output(const FileOptions& options, const std::string& path) {
    const std::string& named = !options.output_format.empty() ? options.output_format
                               : path == "-"                  ? options.format
                                                              : std::string();
    const auto format = named.empty() ? format_of(path) : format_named(named);
    if (format == Format::msh && options.msh == "2.2") return Format::msh22;
    if (format) return *format;
    if (!named.empty()) refuse(ErrorCode::unknown_format, "unknown format " + named, "");
    if (path == "-") refuse("the format must be given: --format FORMAT", "standard output");
    refuse(ErrorCode::unknown_format, "no format that can be written has this extension", path);
}

bool fits(Format format, OutputKind kind) {
    if (kind == OutputKind::tetrahedra) return holds_tetrahedra(format);
    if (kind == OutputKind::grids) return holds_grids(format);
    return holds_surfaces(format) || holds_outlines(format);
}

/// Says why an output that can't hold a kind of output is refused.
std::string refusal(Format format, OutputKind kind) {
    if (kind == OutputKind::tetrahedra)
        return "tetrahedra are written as .vtu, .msh, .inp, .mesh, .exo or .ugi, "
               "and by --output-format as ogs, geos or pylith";
    if (kind == OutputKind::grids) return "grids are written as .asc, .zmap, .irap, .grd or .vti";
    if (holds_tetrahedra(format)) return "this format is for tetrahedra, not for surfaces";
    return holds_grids(format) ? "this format is for grids, which terrane map writes"
                               : "this format is read, not written";
}

/// Refuses what writing would refuse, before any work is done.
void check_tetrahedra(const FileOptions& options, const std::string& path, Format format) {
    if (path == "-" && has_several_files(format))
        refuse("in this format tetrahedra are several files: name the first", "standard output");
    if (options.order == 2 && !holds_second_order(format))
        refuse(ErrorCode::unsupported, "this format has no tetrahedra of second order", path);
}

/// Names the values that the format of an output has no place for.
void warn_of_values(const Output& output, const WriteOptions& options) {
    const auto names = values_left_out(output.format, options.values);
    if (names.empty()) return;
    warn(fmt::format("{}: the format has no place for {}: {}", output.path,
                     names.size() == 1 ? "this value" : "these values", fmt::join(names, ", ")));
}

/// Writes by write(mesh, path, options), and shows that at a terminal.
template <class AnyMesh, class Write>
auto write_with(const AnyMesh& mesh, const Output& output, WriteOptions options, Session& session,
                const Write& write) {
    const bool to_stream = output.path == "-"; // among which no progress may be
    session.begin(to_stream ? "" : "write", to_stream ? Phase::idle : Phase::writing);
    options.format = output.format;
    auto written = must(write(mesh, output.path, options));
    session.end_stage();
    return written;
}

} // namespace

void check_streams(const FileOptions& options) {
    const auto dashes = [](const std::vector<std::string>& names) {
        return std::count(names.begin(), names.end(), "-");
    };
    if (dashes(options.inputs) > 1) refuse("standard input can be read only once");
    if (dashes(options.outputs) + (options.stats == "-" ? 1 : 0) + (options.report == "-" ? 1 : 0) >
        1)
        refuse("standard output can take only one file");
    if (dashes(options.inputs) == 1 && options.format.empty() && options.input_format.empty())
        refuse("the format must be given: --format FORMAT", "standard input");
    if (!options.format.empty() && !format_named(options.format))
        refuse(ErrorCode::unknown_format, "unknown format " + options.format, "");
    if (!options.input_format.empty() && !format_named(options.input_format))
        refuse(ErrorCode::unknown_format, "unknown format " + options.input_format, "");
}

// Checks the folder before the work starts, as a missing one would otherwise show only at the end.
void check_folder(const std::string& path) {
    if (path == "-") return;
    const auto parent_of = [](const fs::path& file) {
        return file.has_parent_path() ? file.parent_path() : fs::path(".");
    };
    const auto refused = [&](std::string sentence) {
        refuse(ErrorCode::cannot_open, std::move(sentence), path);
    };
    std::error_code failed;
    if (const auto folder = parent_of(path); !fs::is_directory(folder, failed))
        return refused("there is no folder " + folder.string());
    const fs::path file = followed(path); // a link is kept, and what it names is replaced
    const auto folder = parent_of(file);
    const auto there = fs::status(path, failed).type();
    if (there == fs::file_type::directory) return refused("this is a folder");
    if (there == fs::file_type::none) return refused("cannot be written: " + failed.message());
    if (!fs::is_directory(folder, failed))
        return refused("this is a link into a folder that is not there, " + folder.string());
    if (there != fs::file_type::not_found && access(path.c_str(), W_OK) != 0)
        return refused("this file is protected against writing");
    const bool beside = there == fs::file_type::not_found || there == fs::file_type::regular;
    if (beside && access(folder.c_str(), W_OK) != 0) // the new file is made in the same folder
        return refused("nothing can be written in this folder");
}

std::optional<Format> format_of_input(const FileOptions& options, const std::string& path) {
    if (!options.input_format.empty()) return format_named(options.input_format);
    return path == "-" ? format_named(options.format) : std::nullopt;
}

void add_inputs(CLI::App& command, FileOptions& options) {
    add_value(command, "IN", options.inputs, "FILE", "Files with surfaces; - is standard input")
        ->required();
    add_value(command, "--format", options.format, "FORMAT",
              "Format of whatever is -: ts, ml, obj, off, stl, ply, vtp, vtu, vtk, msh, inp, "
              "mesh, poly, smesh");
    add_reading(command, options);
    add_strict(command, options);
}

void add_reading(CLI::App& command, FileOptions& options) {
    add_value(command, "--input-format", options.input_format, "FORMAT",
              "Format of IN, where its extension does not tell; of grids and points: irap, "
              "zmap, cps3, asc, xyz, vs, sticks");
    command.add_flag("--depth", options.read.depth,
                     "Grids and points: heights are depths, positive down");
    add_value(command, "--max-edge", options.read.max_edge, "LENGTH",
              "Points: triangles with longer edges are left out (default: twice the median)")
        ->check(positive());
    add_value(
        command, "--columns", options.read.columns, "X,Y,Z",
        "Columns of numbers: those of x, y and z, by number from 1 or as a heading calls them "
        "(default: columns that are called x, easting, ...)");
    add_value(command, "--unit", options.read.unit, "UNIT",
              "Convert what has a stated unit: m, km, cm, ft, ftUS (default: as it is)")
        ->check(one_of({"m", "km", "cm", "ft", "ftUS"}));
}

void add_strict(CLI::App& command, FileOptions& options) {
    command.add_flag("--strict", options.strict, "Stop with status 2 at warnings about the inputs");
}

void add_output(CLI::App& command, FileOptions& options, const char* help) {
    add_value(command, "-o,--output", options.outputs, "OUT", help)
        ->required()
        ->allow_extra_args(false);
    add_value(command, "--output-format", options.output_format, "FORMAT",
              "Format of OUT, where its extension does not tell");
}

void add_msh(CLI::App& command, FileOptions& options) {
    add_value(command, "--msh", options.msh, "VERSION",
              "Version of .msh files: 4.1 or 2.2 (default: 4.1)")
        ->check(one_of({"4.1", "2.2"}));
}

void add_order(CLI::App& command, FileOptions& options) {
    add_value(command, "--order", options.order, "ORDER",
              "Order of tetrahedra in files: 2 has a node in the middle of each edge "
              "(default: 1)")
        ->check(CLI::Range(1U, 2U).description(""));
}

void add_threads(CLI::App& command, FileOptions& options) {
    add_value(command, "--threads", options.threads, "N",
              "How many threads to use; the result is the same (default: 0, all cores)")
        ->check(CLI::Range(0U, most_threads).description(""));
}

void add_stats(CLI::App& command, FileOptions& options) {
    add_value(command, "--stats", options.stats, "FILE.json",
              "Write counts, times and memory as JSON");
}

void add_report(CLI::App& command, FileOptions& options) {
    options.app = &command;
    add_value(command, "--report", options.report, "FILE.html",
              "Write a page to look at: the model and its flaws");
}

void add_run(CLI::App& command, FileOptions& options) {
    add_threads(command, options);
    add_stats(command, options);
    add_report(command, options);
}

/// Refuses options that say how files are read or written where there is no such file.
void check_use(const FileOptions& options, const std::vector<Output>& outputs) {
    const auto writes = [&outputs](Format format) {
        return std::any_of(outputs.begin(), outputs.end(),
                           [format](const Output& o) { return o.format == format; });
    };
    const auto is_stream = [](const std::vector<std::string>& names) {
        return std::find(names.begin(), names.end(), "-") != names.end();
    };
    if (options.ascii && !writes(Format::stl))
        refuse("is for STL files, and none is written", "--ascii");
    if (!options.msh.empty() && !writes(Format::msh) && !writes(Format::msh22))
        refuse("is for .msh files, and none is written", "--msh");
    if (!options.format.empty() && !is_stream(options.inputs) && !is_stream(options.outputs))
        refuse("is the format of -, and no file is -", "--format");
}

std::vector<Output> plan_outputs(const FileOptions& options, OutputKind kind) {
    check_streams(options);
    std::vector<Output> outputs;
    for (const auto& path : options.outputs) {
        const auto format = format_of_output(options, path);
        if (!fits(format, kind)) refuse(ErrorCode::unsupported, refusal(format, kind), path);
        if (kind == OutputKind::tetrahedra) check_tetrahedra(options, path, format);
        check_folder(path);
        outputs.push_back({path, format});
    }
    if (!options.stats.empty()) check_folder(options.stats);
    check_use(options, outputs);
    return outputs;
}

Inputs read_inputs(const FileOptions& options, Session& session) {
    const StageTimer timer(session.run(), "read");
    std::vector<std::optional<Format>> formats;
    for (const auto& path : options.inputs) {
        const auto named = format_of_input(options, path);
        formats.push_back(named ? named : format_to_read(path));
    }
    must(check_reading(formats, options.read, {"--depth", "--max-edge", "--columns"}));
    Inputs all;
    session.begin("read", Phase::idle);
    for (const auto& path : options.inputs) {
        auto read = must(read_surfaces(path, format_of_input(options, path), options.read));
        all.surfaces_of_file.push_back(read.size());
        append_stated_blocks(read_stated_blocks(path, format_of_input(options, path)),
                             all.surfaces.size(), all.stated_blocks);
        for (Surface& s : read) {
            all.vertices += s.vertices.size();
            all.triangles += s.triangles.size();
            all.surfaces.push_back(std::move(s));
            all.files.push_back(path == "-" ? "standard input" : path);
        }
    }
    session.end_stage();
    if (std::max(all.vertices, all.triangles) >= UINT32_MAX)
        refuse(ErrorCode::unsupported, "more than 4294967294 vertices or triangles", "");
    describe(all.surfaces, all);
    all.strict = options.strict;
    return all;
}

void describe(std::span<const Surface> surfaces, Inputs& inputs) {
    inputs.labels = unique_labels(infos_of(surfaces));
    inputs.unit = detail::common_unit(surfaces);
    inputs.extent = 0;
    for (const Surface& s : surfaces)
        inputs.extent = std::max(inputs.extent, extent_of(s.vertices));
}

std::string name_of_inputs(const FileOptions& options) {
    const auto& first = options.inputs.front();
    const std::string name = first == "-" ? "standard input" : first;
    const auto others = options.inputs.size() - 1;
    return others == 0 ? name : fmt::format("{} and {}", name, counted(others, "more file"));
}

void write_output(const Mesh& mesh, const Output& output, WriteOptions options, Session& session) {
    warn_of_values(output, options);
    write_with(mesh, output, options, session, write_mesh);
}

std::vector<fs::path> write_output(const TetrahedralMesh& mesh, const Output& output,
                                   WriteOptions options, Session& session) {
    warn_of_values(output, options);
    return write_with(mesh, output, options, session, write_tetrahedra_files);
}

void write_output(const Grid& grid, const Output& output, Session& session) {
    const auto write = [](const Grid& values, const std::string& path,
                          const WriteOptions& options) {
        return write_grid(values, path, options.format);
    };
    write_with(grid, output, {}, session, write);
}

std::string left_out_of(const Output& output) {
    const auto extension = fs::path(output.path).extension().string();
    const bool is_model =
        output.format == Format::gocad && detail::same_ignoring_case(extension, ".ml");
    return is_model ? "surfaces without regions, which terrane volume --gocad writes" : "";
}

std::string wrote(const Output& output) {
    if (output.path == "-") return {};
    const auto left_out = left_out_of(output);
    return "wrote " + one_line(output.path) + (left_out.empty() ? "" : ": " + left_out) + "\n";
}

std::FILE* summary_stream(const FileOptions& options) {
    const auto& names = options.outputs;
    const bool taken = options.stats == "-" || options.report == "-" ||
                       std::find(names.begin(), names.end(), "-") != names.end();
    return taken ? stderr : stdout;
}

std::string triangle_name(std::uint32_t triangle, std::span<const std::uint32_t> first,
                          std::span<const std::string> labels) {
    const auto after = std::upper_bound(first.begin(), first.end(), triangle);
    const auto surface = static_cast<std::size_t>(std::distance(first.begin(), after)) - 1;
    return fmt::format("{} triangle {}", labels[surface], triangle - first[surface]);
}

} // namespace terrane::cli
