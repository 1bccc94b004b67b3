// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/tetgen/tetgen_helper.hpp>
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
sets. PFLOTRAN (.ugi) and, by --output-format, OpenGeoSys (ogs), GEOS (geos) and PyLith (pylith) get
files of their own. With --order 2 tetrahedra have 10 nodes; edges stay straight.

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

/// Parses "x0,y0,z0,x1,y1,z1".
std::optional<Box3> parse_box(std::string_view text) {
    std::array<double, 6> numbers{};
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i > 0 && (at == end || *at++ != ',')) return std::nullopt;
        const auto [after, failed] = std::from_chars(at, end, numbers[i]);
        if (failed != std::errc()) return std::nullopt;
        at = after;
    }
    if (at != end) return std::nullopt;
    return Box3{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

Status add_sizes(const std::vector<std::string>& texts, const char* option,
                 std::vector<ProjectSize>& sizes) {
    for (const std::string& text : texts) {
        const auto size = parse_named_length(text);
        if (!size || !(size->second > 0))
            return usage("needs NAME=L, with a positive length: " + text, option);
        sizes.push_back(*size);
    }
    return Done{};
}

/// Adds what the texts of options say.
Status read_texts(TetrahedralizeCommand& command) {
    ProjectTetrahedra& wanted = command.model.project.tetrahedra;
    if (!command.around.empty()) {
        wanted.options.box = parse_box(command.around);
        if (!wanted.options.box) return usage("needs six numbers: x0,y0,z0,x1,y1,z1", "--around");
    }
    if (command.blocks_only) wanted.outside = false;
    if (auto added = add_sizes(command.size_of, "--size-of", wanted.size_of); !added) return added;
    return add_sizes(command.size_in, "--size-in", wanted.size_in);
}

/// Names an output, and the number of its further files.
std::string said_of(const Output& output, std::size_t files) {
    if (output.path == "-" || files == 1) return output.path;
    return fmt::format("{}, and {} that begin with {}_", output.path, counted(files - 1, "file"),
                       std::filesystem::path(output.path).stem().string());
}

Status write_all(const FilledBlocks& filled, const std::vector<Output>& outputs,
                 const FileOptions& files, Session& session) {
    WriteOptions options;
    options.block_names = filled.block_names;
    options.order = files.order;
    for (const Output& output : outputs) {
        const auto written = write_output(filled.tetrahedra, output, options, session);
        if (!written) return written.error();
        say_written(summary_stream(files), said_of(output, written->size()));
    }
    return Done{};
}

/// Checks before any work is done what can be checked then.
Status check_outputs(const ModelCommand& command, const std::vector<Output>& outputs) {
    if (auto sound = check_files_beside(*command.files.app, outputs); !sound) return sound;
    const bool is_certified = !command.proof.certificate.empty();
    for (const Output& output : outputs) {
        if (output.format == Format::pylith && !command.project.tetrahedra.split.empty())
            return usage("PyLith splits nodes itself: leave out --split", output.path);
        if (is_certified && output.path == "-")
            return usage("a certificate is about files, and is one", "--certificate");
        if (is_certified && !is_certifiable(output.format, command.files.order))
            return usage("a certificate is about tetrahedra of first order in .vtu, .msh, .inp or "
                         ".mesh",
                         output.path);
    }
    if (const auto helper = find_tetgen_helper(); !helper) return helper.error();
    return Done{};
}

Result<ExitStatus> tetrahedralize_files(TetrahedralizeCommand& command, Session& session) {
    const FileOptions& files = command.model.files;
    if (auto read = read_texts(command); !read) return read.error();
    const auto outputs = plan_outputs(files, OutputKind::tetrahedra);
    if (!outputs) return outputs.error();
    if (auto sound = check_outputs(command.model, *outputs); !sound) return sound.error();
    auto run = ModelRun::begin(command.model, session);
    if (!run) return run.error();
    if (auto made = run->make(); !made) return made.error();
    if (!run->refused().empty()) return run->end(false);
    if (auto done = write_all(*run->built().filled, *outputs, files, session); !done)
        return done.error();
    std::vector<ResultFile> written;
    for (const Output& output : *outputs)
        written.push_back({output.path, certified_format(output.format)});
    if (auto done = run->certify(std::move(written)); !done) return done.error();
    return run->end(true);
}

void add_tetrahedra_options(CLI::App& app, TetrahedralizeCommand& command) {
    ProjectTetrahedra& wanted = command.model.project.tetrahedra;
    TetrahedraOptions& options = wanted.options;
    app.add_option("--around", command.around,
                   "Box that closes the domain, x0,y0,z0,x1,y1,z1, around all that is kept")
        ->type_name("BOX");
    add_fields(app, options);
    app.add_option("--size-of", command.size_of,
                   "Edge length on a surface, and near it; may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME=L");
    app.add_option(
           "--size-in", command.size_in,
           "Edge length in a block, by its number or name, instead of --edge-length; may be "
           "repeated")
        ->allow_extra_args(false)
        ->type_name("BLOCK=L");
    app.add_option("--split", wanted.split,
                   "Nodes of their own on either side of a surface; fault: of all with that role; "
                   "may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME");
    app.add_flag("--blocks-only", command.blocks_only,
                 "No tetrahedra outside of the blocks, in region 0");
    app.add_flag_callback(
        "--no-optimise", [&options] { options.optimise.reset(); },
        "Leave the shapes of tetrahedra as the mesher made them");
    app.add_option("--mesher", options.mesher,
                   "tetgen, gmsh, or auto: TetGen, and Gmsh where that fails (default: auto)")
        ->transform(
            CLI::CheckedTransformer(std::map<std::string, Mesher>{{"auto", Mesher::automatic},
                                                                  {"tetgen", Mesher::tetgen},
                                                                  {"gmsh", Mesher::gmsh}})
                .description(""))
        ->transform(listing({"auto", "tetgen", "gmsh"}))
        ->type_name("PROGRAM");
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
    add_threads(*app, command->model.files);
    add_stats(*app, command->model.files);
    add_report(*app, command->model.files);
    command->model.needs_blocks = true;
    command->model.tells_blocks = false;
    command->model.project.outputs.tetrahedra = {"vtu"}; // so that there are some
    app->footer(tetrahedralize_footer);
    return {app, [command] {
                Session session(command->model.files.threads);
                const auto status = tetrahedralize_files(*command, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
