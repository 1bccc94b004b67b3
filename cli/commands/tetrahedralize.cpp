// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/commands/file_options.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/fields.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/stages/model_run.hpp>

namespace terrane::cli {
namespace {

struct TetrahedralizeCommand {
    ModelCommand model;
    std::string around;                        ///< text of the option
    std::vector<std::string> size_of, size_in; ///< NAME=L
    bool blocks_only = false;
};

constexpr auto tetrahedralize_footer =
    R"(The surfaces are arranged and rounded first, as `terrane arrange` does; where the doubles are not
a conforming mesh nothing is written, and the exit status is 1. A box round all closes the domain:
what touches it is block 0, the outside, each further block is a volume that the surfaces enclose.
With a volume of interest (--box, --rotated-box, --polygon, --within) all surfaces are cut by its
boundary, and only what is inside gets tetrahedra: there is no block 0.

The result is checked: tetrahedra have positive volume, each triangle is a union of their faces, each
block is one that surfaces enclose (found in two ways) and has its volume. Where that fails nothing
is written, and the exit status is 1. The shapes are reported: dihedral angles, ratios of circumradius to shortest
edge.

VTU has arrays block, surface and parent; MSH physical groups; Abaqus INP element sets, node sets
and surfaces; MEDIT references: block and surface + 1; Exodus II element blocks, side sets and node
sets; UNV and FLAC3D (.f3grid) groups. PFLOTRAN (.ugi) and, by --output-format, OpenGeoSys (ogs),
GEOS (geos) and PyLith (pylith) get files of their own. With --order 2 tetrahedra have 10 nodes; edges stay straight.

Names of blocks are those of `terrane volume`: units of --column, regions of a GOCAD model, or "below
top, above base, west of F1". With --split two tetrahedra at a surface share a node only where they hang together round it
without crossing what is split: a surface that ends inside keeps one node at its border, and each
sector where surfaces cross has its own. VTU then has the arrays twin and cut_side, MSH groups for
both sides and $Periodic, INP pairs as unsorted node sets, MEDIT references and comments.

--certificate FILE writes all that it takes to check the tetrahedra from the input files alone.

Examples:
  terrane tetrahedralize model.ml -o model.vtu
  terrane tetrahedralize model.ml -o model.vtu --certificate model.json
  terrane tetrahedralize model.ml -o model.vtu --size-of F1=50 --size-in 3=100 --edge-length 400
  terrane tetrahedralize model.ml -o model.msh --split fault --blocks-only
  terrane tetrahedralize faults.ts topography.ts -o model.msh --edge-length 200
  terrane tetrahedralize model.ml -o model.msh --msh 2.2 -o model.inp -o model.mesh
  terrane tetrahedralize model.ml -o model.exo --order 2 --split fault
  terrane tetrahedralize model.ml -o model.vtu --output-format ogs --blocks-only
  terrane tetrahedralize horizons.ts faults.ts -o model.vtu --box 0,0,-3000,10000,10000,500)";

void add_sizes(const std::vector<std::string>& texts, const char* option,
               std::vector<ProjectSize>& sizes) {
    for (const std::string& text : texts) sizes.push_back(positive_named_length(text, option));
}

/// Adds what the texts of options say.
void read_texts(TetrahedralizeCommand& command) {
    ProjectTetrahedra& wanted = command.model.project.tetrahedra;
    if (!command.around.empty()) {
        const auto n = numbers_in(command.around);
        if (!n || n->size() != 6) refuse("needs six numbers: x0,y0,z0,x1,y1,z1", "--around");
        wanted.options.box = Box3{{(*n)[0], (*n)[1], (*n)[2]}, {(*n)[3], (*n)[4], (*n)[5]}};
    }
    if (command.blocks_only) wanted.outside = false;
    add_sizes(command.size_of, "--size-of", wanted.size_of);
    add_sizes(command.size_in, "--size-in", wanted.size_in);
}

/// Names an output, and the number of its further files.
std::string said_of(const Output& output, std::size_t files) {
    if (output.path == "-" || files == 1) return output.path;
    return fmt::format("{}, and {} that begin with {}_", output.path, counted(files - 1, "file"),
                       std::filesystem::path(output.path).stem().string());
}

void write_all(const ModelRun& run, const std::vector<Output>& outputs, Session& session) {
    const FilledBlocks& filled = *run.built().filled;
    const FileOptions& files = run.files();
    WriteOptions options;
    const auto values = run.values_on(filled.tetrahedra);
    options.values = values;
    options.block_names = filled.block_names;
    options.order = files.order;
    for (const Output& output : outputs) {
        const auto written = write_output(filled.tetrahedra, output, options, session);
        say_written(summary_stream(files), said_of(output, written.size()));
    }
}

/// Checks before any work is done what can be checked then.
void check_outputs(const ModelCommand& command, const std::vector<Output>& outputs) {
    check_files_beside(*command.files.app, outputs);
    const bool is_certified = !command.proof.certificate.empty();
    for (const Output& output : outputs) {
        if (output.format == Format::pylith && !command.project.tetrahedra.split.empty())
            refuse("PyLith splits nodes itself: leave out --split", output.path);
        if (is_certified && output.path == "-")
            refuse("a certificate is about files, and is one", "--certificate");
        if (is_certified && !is_certifiable(output.format, command.files.order))
            refuse("a certificate is about tetrahedra of first order in .vtu, .msh, .inp or "
                   ".mesh",
                   output.path);
    }
    must(find_tetgen_helper());
}

ExitStatus tetrahedralize_files(TetrahedralizeCommand& command, Session& session) {
    const FileOptions& files = command.model.files;
    read_texts(command);
    const auto outputs = plan_outputs(files, OutputKind::tetrahedra);
    check_outputs(command.model, outputs);
    auto run = ModelRun::begin(command.model, session);
    run.make();
    if (!run.refused().empty()) return run.end(false);
    write_all(run, outputs, session);
    std::vector<ResultFile> written;
    for (const Output& output : outputs)
        written.push_back({output.path, certified_format(output.format)});
    run.certify(std::move(written));
    return run.end(true);
}

void add_tetrahedra_options(CLI::App& app, TetrahedralizeCommand& command) {
    ProjectTetrahedra& wanted = command.model.project.tetrahedra;
    TetrahedraOptions& options = wanted.options;
    add_value(app, "--around", command.around, "BOX",
              "Box that closes the domain, x0,y0,z0,x1,y1,z1, around all that is kept");
    add_fields(app, options);
    add_value(app, "--size-of", command.size_of, "NAME=L",
              "Edge length on a surface, and near it; may be repeated")
        ->allow_extra_args(false);
    add_value(app, "--size-in", command.size_in, "BLOCK=L",
              "Edge length in a block, by its number or name, instead of --edge-length; may be "
              "repeated")
        ->allow_extra_args(false);
    add_value(app, "--split", wanted.split, "NAME",
              "Nodes of their own on either side of a surface; fault: of all with that role; "
              "may be repeated")
        ->allow_extra_args(false);
    app.add_flag("--blocks-only", command.blocks_only,
                 "No tetrahedra outside of the blocks, in region 0");
    app.add_flag_callback(
        "--no-optimise", [&options] { options.optimise.reset(); },
        "Leave the shapes of tetrahedra as the mesher made them");
    add_value(app, "--mesher", options.mesher, "PROGRAM",
              "tetgen, gmsh, or auto: TetGen, and Gmsh where that fails (default: auto)")
        ->transform(
            CLI::CheckedTransformer(std::map<std::string, Mesher>{{"auto", Mesher::automatic},
                                                                  {"tetgen", Mesher::tetgen},
                                                                  {"gmsh", Mesher::gmsh}})
                .description(""))
        ->transform(listing({"auto", "tetgen", "gmsh"}));
}

} // namespace

Command tetrahedralize_command(CLI::App& program) {
    auto command = std::make_shared<TetrahedralizeCommand>();
    auto* app = program.add_subcommand("tetrahedralize",
                                       "Fill the blocks between the surfaces with tetrahedra");
    add_inputs(*app, command->model.files);
    add_output(
        *app, command->model.files,
        "File for the tetrahedra, .vtu .msh .inp .mesh .exo .ugi; - is standard output; may be "
        "repeated");
    add_msh(*app, command->model.files);
    add_order(*app, command->model.files);
    add_naming(*app, command->model);
    add_tetrahedra_options(*app, *command);
    add_certificate(*app, command->model.proof.certificate);
    add_arranging(*app, command->model);
    add_run(*app, command->model.files);
    command->model.needs_blocks = true;
    command->model.tells_blocks = false;
    command->model.project.outputs.tetrahedra = {"vtu"}; // so that there are some
    app->footer(tetrahedralize_footer);
    return {app, [command] {
                Session session(command->model.files.threads);
                return tetrahedralize_files(*command, session);
            }};
}

} // namespace terrane::cli
