// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <memory>
#include <vector>

#include <terrane/algorithms/mesh/carry.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/cli/stages/plausibility.hpp>
#include <terrane/io/meshes/pvtp.hpp>

namespace terrane::cli {
namespace {

struct ConvertCommand {
    FileOptions files;
    std::string input, output;
};

constexpr auto convert_footer =
    R"(Nothing is arranged, merged or repaired: the same triangles with the same coordinates, bit by bit, and the
same values on points and triangles; a warning names those that the format has no place for.
Binary STL holds float32 only, which is said. Reads .ts .ml .obj .off .stl .ply .vtp .vtu .vtk .msh .dxf .grdecl
.sticks, writes .vtp .vtk .obj .ts .ply .off .stl .msh .inp .mesh .poly .smesh, and the vertices of
surfaces as .vs, their borders as .pl. The pieces that a .pvtp file names become the mesh that they were made of.
Grids (Irap .irap .gri, ZMAP+ .zmap, CPS-3 .cps3, ESRI .asc, Surfer .grd) become surfaces with holes where heights
are missing, points (.xyz .csv .dat .txt .poi .pol, GOCAD .vs .pl) by Delaunay triangles without
edges longer than --max-edge. Corner-point grids (.grdecl) become top, base, layers, faults and sides.

Examples:
  terrane convert faults.ts faults.obj
  terrane convert --depth top.irap top.vtp
  terrane convert --format ts --output-format vtp - - < faults.ts > faults.vtp)";

bool loses_digits(const Mesh& mesh) {
    const auto narrow = [](double x) { return static_cast<double>(static_cast<float>(x)) != x; };
    for (const Point3& p : mesh.vertices)
        if (narrow(p.x) || narrow(p.y) || narrow(p.z)) return true;
    return false;
}

/// Joins the pieces of a .pvtp file to the mesh that they were made of.
ExitStatus join_pieces(const FileOptions& files, const std::vector<Output>& outputs,
                       Session& session) {
    if (!files.report.empty())
        refuse("there is no page of a model in pieces; convert it first", "--report");
    session.begin("read", Phase::idle);
    const auto mesh = must(read_pvtp(files.inputs.front()));
    session.end_stage();
    write_output(mesh, outputs.front(), {.ascii = files.ascii}, session);
    return ExitStatus::done;
}

ExitStatus convert_file(const ConvertCommand& command, Session& session) {
    FileOptions files = command.files;
    files.inputs = {command.input};
    files.outputs = {command.output};
    const auto outputs = plan_outputs(files, OutputKind::surfaces);
    if (std::filesystem::path(command.input).extension() == ".pvtp")
        return join_pieces(files, outputs, session);
    auto page = plan_page(files, session);
    const auto inputs = read_inputs(files, session);
    add_page_inputs(page, files, inputs);
    Json statistics = statistics_of(inputs); // for the page alone
    examine(inputs.surfaces, {}, inputs, session, statistics);
    const Mesh mesh = concatenate(inputs.surfaces);
    const Output& output = outputs.front();
    const auto values = values_of(inputs.surfaces);
    write_output(mesh, output, {.ascii = files.ascii, .values = values}, session);
    if (!left_out_of(output).empty())
        tell_when_written(stdout, wrote(output)); // else it says nothing
    if (output.format == Format::stl && !files.ascii && loses_digits(mesh))
        warn(output.path + ": coordinates were rounded to float32, all that binary STL holds; "
                           "--ascii or another format keeps them");
    page.add_mesh(mesh);
    return write_run(page, statistics, files, session, true);
}

} // namespace

Command convert_command(CLI::App& program) {
    auto options = std::make_shared<ConvertCommand>();
    auto* app = program.add_subcommand("convert", "Write surfaces in another format, unchanged");
    add_value(*app, "IN", options->input, "FILE", "File with surfaces; - is standard input")
        ->required();
    add_value(*app, "OUT", options->output, "FILE", "File to write; - is standard output")
        ->required();
    add_value(*app, "--format", options->files.format, "FORMAT",
              "Format of whatever is -: ts, ml, obj, off, stl, ply, vtp, vtu, vtk, msh, inp, "
              "mesh, poly, smesh");
    add_value(*app, "--output-format", options->files.output_format, "FORMAT",
              "Format of OUT, where its extension does not tell");
    add_reading(*app, options->files);
    add_strict(*app, options->files);
    add_msh(*app, options->files);
    app->add_flag("--ascii", options->files.ascii, "STL as text, with doubles, not float32");
    add_report(*app, options->files);
    app->footer(convert_footer);
    return {app, [options] {
                Session session(1);
                return convert_file(*options, session);
            }};
}

} // namespace terrane::cli
