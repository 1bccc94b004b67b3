// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Input and output files as the command line names them. "-" stands for standard input or output.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/core/must.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/io/files.hpp>

namespace terrane::cli {

struct FileOptions {
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;
    std::string format;            ///< format of every "-"
    std::string input_format;      ///< format of the inputs, whatever their extensions
    std::string output_format;     ///< format of the outputs, whatever their extensions
    ReadOptions read;              ///< how to read grids and points
    std::string stats;             ///< path of the statistics; empty: none
    std::string report;            ///< path of the report page; empty: none
    const CLI::App* app = nullptr; ///< the command, for the page's list of options
    unsigned threads = 0;          ///< 0: all cores
    bool ascii = false;            ///< STL as text
    bool strict = false;           ///< warnings about the inputs are errors
    std::string msh;               ///< version of MSH: 4.1, or 2.2; empty: 4.1
    unsigned order = 1;            ///< of tetrahedra in files: 1 or 2
};

void add_inputs(CLI::App& command, FileOptions& options);
/// Adds the options that say how grids and points are read.
void add_reading(CLI::App& command, FileOptions& options);
/// Adds --strict, which add_inputs does as well.
void add_strict(CLI::App& command, FileOptions& options);
void add_output(CLI::App& command, FileOptions& options, const char* help);
void add_msh(CLI::App& command, FileOptions& options);
/// Adds --order.
void add_order(CLI::App& command, FileOptions& options);
void add_threads(CLI::App& command, FileOptions& options);
void add_stats(CLI::App& command, FileOptions& options);
/// Adds --report, and notes the command.
void add_report(CLI::App& command, FileOptions& options);
/// Adds --threads, --stats and --report.
void add_run(CLI::App& command, FileOptions& options);

struct Output {
    std::string path;
    Format format{};
};

enum class OutputKind { surfaces, tetrahedra, grids };

/// Checks the output names before any work is done and finds the format of each. Errors: bad_option
/// for a standard stream used twice or without a format; unknown_format; unsupported for a format
/// that can't hold the kind of output, or its order; cannot_open for a missing folder.
std::vector<Output> plan_outputs(const FileOptions& options, OutputKind kind);

/// Checks the use of standard streams, which plan_outputs() does as well. Errors: bad_option, unknown_format.
void check_streams(const FileOptions& options);

/// Returns cannot_open if the file can't be written: its folder is missing or not writable, or it
/// is a folder.
void check_folder(const std::string& path);

/// Returns the format that the user states for an input, if any.
std::optional<Format> format_of_input(const FileOptions& options, const std::string& path);

struct Inputs {
    std::vector<Surface> surfaces;
    std::vector<std::string> files;            ///< per surface: the file it was read from
    std::vector<std::size_t> surfaces_of_file; ///< per input: number of surfaces read from it
    std::vector<StatedBlock> stated_blocks;    ///< that files state, by the surfaces
    std::string unit;                ///< of all coordinates, where files state one; else empty
    double extent = 0;               ///< longest side of the box of a surface
    std::vector<std::string> labels; ///< per surface: its name, made unique, on one line
    std::size_t vertices = 0, triangles = 0;
    bool strict = false; ///< warnings about them are errors

    [[nodiscard]] Quantities quantities() const { return Quantities(unit, extent); }
};

/// Reads all inputs. Errors: those of read_surfaces; interrupted; unsupported if 32 bits can't
/// count all vertices or triangles.
Inputs read_inputs(const FileOptions& options, Session& session);

/// Sets the labels, the unit and the extent of the inputs by their surfaces.
void describe(std::span<const Surface> surfaces, Inputs& inputs);

/// Returns a short name of the inputs: "basin.ts", "basin.ts and 3 more files".
std::string name_of_inputs(const FileOptions& options);

/// Writes the mesh with `options`, but in the format of `output`; of tetrahedra it returns the files.
/// Errors: those of write_mesh, write_tetrahedra and write_grid.
void write_output(const Mesh& mesh, const Output& output, WriteOptions options, Session& session);
std::vector<std::filesystem::path> write_output(const TetrahedralMesh& mesh, const Output& output,
                                                WriteOptions options, Session& session);

void write_output(const Grid& grid, const Output& output, Session& session);

/// Returns a clause that names what an output lacks although its format could hold it: the regions
/// of a model in a .ml file. It is empty for an output that lacks nothing.
std::string left_out_of(const Output& output);
/// Says that an output is written, and names the parts not in it; empty for standard output.
std::string wrote(const Output& output);

/// Returns the stream for the summary: standard error if a file goes to standard output.
std::FILE* summary_stream(const FileOptions& options);

/// Names an input triangle by its surface and its number within it, from 0: "top triangle 12".
/// `first` has the number of each surface's first triangle, counted through all surfaces, and at
/// the end the total.
std::string triangle_name(std::uint32_t triangle, std::span<const std::uint32_t> first,
                          std::span<const std::string> labels);

} // namespace terrane::cli
