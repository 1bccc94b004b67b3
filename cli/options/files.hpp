// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Files as they are named on the command line; "-" is a standard stream.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/io/files.hpp>

namespace terrane::cli {

struct FileOptions {
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;
    std::string format;        ///< of every "-"
    std::string input_format;  ///< of the inputs, whatever they are called
    std::string output_format; ///< of the outputs, whatever they are called
    ReadOptions read;          ///< of grids and points
    std::string stats;         ///< empty: none
    unsigned threads = 0;      ///< 0: all cores
    bool ascii = false;        ///< STL as text
    std::string msh = "4.1";   ///< version of MSH, or 2.2
};

void add_inputs(CLI::App& command, FileOptions& options);
/// How grids and points are read.
void add_reading(CLI::App& command, FileOptions& options);
void add_output(CLI::App& command, FileOptions& options, const char* help);
void add_msh(CLI::App& command, FileOptions& options);
void add_threads(CLI::App& command, FileOptions& options);
void add_stats(CLI::App& command, FileOptions& options);

struct Output {
    std::string path;
    Format format{};
};

enum class OutputKind { surfaces, tetrahedra };

/// bad_option: what is wrong with how the program was called; `place`: the option, or a file.
Error usage(std::string sentence, std::string place = {});

/// What is wrong with the names on the command line, found before any work is done: formats that
/// do not exist or do not fit, folders that are missing, a standard stream used twice.
Result<std::vector<Output>> plan_outputs(const FileOptions& options, OutputKind kind);

/// An error if a file can't be written there: no such folder, or no right to.
Status check_folder(const std::string& path);

struct Inputs {
    std::vector<Surface> surfaces;
    std::vector<std::string> files;            ///< per surface: where it comes from
    std::vector<std::size_t> surfaces_of_file; ///< per input on the command line: how many
    std::vector<std::string> labels;           ///< per surface: its name, made unique, on one line
    std::size_t vertices = 0, triangles = 0;
    double seconds = 0;
};

/// Errors: those of read_surfaces; interrupted; unsupported where 32 bits can't count it all.
Result<Inputs> read_inputs(const FileOptions& options, Session& session);


/// "basin.ts", "basin.ts and 3 more files"
std::string name_of_inputs(const FileOptions& options);

/// `options` but for the format, which is that of the output.
Status write_output(const Mesh& mesh, const Output& output, WriteOptions options, Session& session);
Status write_output(const TetrahedralMesh& mesh, const Output& output, WriteOptions options,
                    Session& session);

/// Where people are told about the result: standard error if a file goes to standard output.
std::FILE* summary_stream(const FileOptions& options);

/// An input triangle, named: "top triangle 12"; counted within its surface, from 0.
/// first: per surface its first triangle, counted through all surfaces, and the total at the end.
std::string triangle_name(std::uint32_t triangle, std::span<const std::uint32_t> first,
                          std::span<const std::string> labels);

} // namespace terrane::cli
