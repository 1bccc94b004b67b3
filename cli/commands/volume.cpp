// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/reports/relation_report.hpp>
#include <terrane/cli/reports/seal_plot.hpp>
#include <terrane/cli/reports/seal_report.hpp>
#include <terrane/cli/stages/blocks.hpp>
#include <terrane/cli/stages/cells.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/atomic_folder.hpp>
#include <terrane/io/gocad/gocad_model.hpp>
#include <terrane/io/results.hpp>

namespace terrane::cli {
namespace {

struct VolumeCommand {
    ModelCommand model;
    std::string folder;
    std::string part_format = automatic_parts;
    std::string relations;        ///< file for the table of relations; here and below, empty: none
    std::string juxtaposition;    ///< file for the table of areas between blocks
    std::string seal_plot;        ///< file for the plot of it; empty: none
    std::string gocad;            ///< file for the model with its regions
    std::string lines;            ///< file for the lines of the model
    CellOptions cells;            ///< of a grid
    std::vector<double> contacts; ///< levels of z
    bool suggests = false; ///< whether distances for sealing are tried, and nothing is written
};

constexpr auto volume_footer =
    R"(The surfaces are arranged and rounded first, as `terrane arrange` does; where the doubles are not
a conforming mesh nothing is written, and the exit status is 1. Blocks are the volumes that the
surfaces enclose, 1, 2, ...; 0 is the outside. DIR must not exist, or be empty. It gets

  model.json         blocks, interfaces, lines, corners, free borders and leaks
  model.vtm          all blocks and interfaces under their names, for ParaView
  result.vtp         the whole mesh; arrays volume_front, volume_back, interface, patch
  blocks/            the closed boundary of each block, wound outward
  interfaces/        what lies between the same two blocks and in the same surfaces

More than 1000 blocks and interfaces are two files, blocks.vtp and interfaces.vtp, unless --parts is given.
Neighbours have the same vertices, to the last bit. Open surfaces are no error: they dangle, and the
summary says which, and how far their free borders are from other surfaces.

--seal D closes gaps: free borders that end short of another surface by at most D are extended onto it,
those that reach beyond by at most D are trimmed. Every change is listed, and is in model.json.
--seal F1=D and --seal F1/F2=D state other distances for one surface or one pair.
--suggest-seal lists the widths of gaps by their natural breaks and the number of blocks for each, and
writes nothing; --seal auto takes the last break below a fifth of the median edge length.
--min-volume V merges blocks below V with a neighbour, by removing the largest part of their boundary
with the same neighbour and the same surfaces; each is listed.

With a volume of interest (--box, --rotated-box, --polygon, --within) all surfaces are cut by its
boundary, exactly, the inside is kept, and the boundary closes it: its faces are surfaces of their
own, "boundary top", "boundary side 1", ... --extend D extends horizons that end inside.

Blocks are named by the units of --column FILE.json, else as a GOCAD model names its regions, else by
what bounds them: "below top, above base, west of F1". A column lists the units from the top down with
the horizons at their bases: {"column": [{"unit": "Cover", "surface": "top"}, {"unit": "Basement"}]}

--relations FILE.csv lists which surface stops at which other one, crosses it, or ends near it, along
which length and with which gap; --juxtaposition FILE.csv lists which blocks face each other across which
surface, and the area.

--gocad FILE.ml writes the model as GOCAD, SKUA and RINGMesh have it: TSurfs divided into TFACEs, and
blocks as regions of a Model3d; --lines FILE.pl writes its lines. --grid GRID.grdecl --cells FILE.grdecl
says in which block each cell of a corner-point grid lies: ACTNUM and FIPNUM.

--contact Z lists the volume of each block above that level, the area of its section there, and the height
of the column from there to its highest point.

--certificate FILE writes all that it takes to check the files in DIR from the input files alone.

Examples:
  terrane volume model.ml -o model
  terrane volume model.ml -o model --certificate model-certificate.json
  terrane volume model.ml -o model --seal 0.01
  terrane volume *.ts -o model --gocad model.ml --grid cells.grdecl --cells blocks.grdecl
  terrane volume model.ml -o model --seal 5 --seal F1=20 --seal F1/F2=0
  terrane volume *.ts --box 0,0,-3000,10000,10000,500 --suggest-seal
  terrane volume *.ts -o model --seal auto --min-volume auto
  terrane volume horizons.ts faults.ts -o model --box 0,0,-3000,10000,10000,500
  terrane volume *.ts -o model --polygon licence.txt --between -4000,0
  terrane volume top.ts base.ts F1.ts box.ts -o model --role F1=fault --role box=boundary)";

void write_folder(const VolumeCommand& command, const ModelReports& reports, Session& session) {
    session.begin("write", Phase::folder);
    auto folder = must(NewFolder::create(command.folder));
    must(write_model_files(reports, command.part_format, folder.temporary(), session.run()));
    must(folder.publish());
    session.end_stage();
}

/// Checks before any work is done that the folder is given and will do, or that none is wanted.
void check_output(const VolumeCommand& command) {
    const std::string& certificate = command.model.proof.certificate;
    if (!certificate.empty()) check_certified_names(certificate, {command.folder});
    if (!certificate.empty() && !is_certified(command.part_format))
        refuse("is about parts as vtp or obj only", "--certificate");
    for (const std::string& file : {command.gocad, command.lines})
        if (!file.empty()) check_folder(file);
    if (!command.suggests) {
        if (!command.seal_plot.empty())
            refuse("draws what --suggest-seal finds; that is missing", "--seal-plot");
        if (command.folder.empty()) refuse("the folder for the model is missing", "--output");
        must(check_new_folder(command.folder));
        return;
    }
    if (!command.contacts.empty())
        refuse("needs a model, and --suggest-seal makes none", "--contact");
    const std::array<std::pair<const char*, const std::string*>, 8> of_models{
        {{"--output", &command.folder},
         {"--certificate", &certificate},
         {"--report", &command.model.files.report},
         {"--relations", &command.relations},
         {"--juxtaposition", &command.juxtaposition},
         {"--gocad", &command.gocad},
         {"--lines", &command.lines},
         {"--cells", &command.cells.cells}}};
    for (const auto& [option, value] : of_models)
        if (!value->empty()) refuse("needs a model, and --suggest-seal makes none", option);
}

/// Writes a text to a file of its own, and says so.
void write_text(const VolumeCommand& command, const std::string& path, const std::string& text,
                Session& session) {
    session.begin("write", Phase::writing);
    must(write_file(path, text));
    session.end_stage();
    say_written(summary_stream(command.model.files), path);
}

void write_tables(const VolumeCommand& command, const ModelRun& run, Session& session) {
    const Model& model = *run.built().model;
    const Inputs& inputs = run.inputs();
    const auto write = [&](const std::string& path, const std::string& text) {
        write_text(command, path, text, session);
    };
    if (!command.relations.empty()) {
        const auto relations = find_relations(model.mesh, model.structure, model.borders);
        write(command.relations, csv_of(relations, inputs.labels));
    }
    if (!command.juxtaposition.empty())
        write(command.juxtaposition,
              csv_of(find_juxtapositions(model.structure), inputs.labels, model.structure));
    if (!command.gocad.empty())
        write(command.gocad,
              to_gocad_model(model.mesh, model.volumes, model.structure,
                             std::filesystem::path(command.gocad).stem().string(), inputs.unit));
    if (command.lines.empty()) return;
    write(command.lines, must(lines_to_gocad(model.mesh, model.structure), command.lines));
}

ExitStatus suggest_seal(const VolumeCommand& command, ModelRun& run, Session& session) {
    const auto options = arranging_of(run.project(), run.surfaces());
    if (!options) throw Failure{at_option(options.error(), *command.model.files.app)};
    session.begin("seal", Phase::computing);
    const auto advice = must(advise_seal(run.surfaces(), run.boundary(), *options, session.run()));
    session.end_stage();
    print(run.told(), text_of(advice, run.inputs()));
    if (!command.seal_plot.empty())
        write_text(command, command.seal_plot, seal_plot(advice, run.inputs()), session);
    add_statistics(run.statistics(), advice);
    add_constants(run.statistics(), "seal", seal_constants());
    add_constants(run.statistics(), "seal_choice", seal_choice_constants());
    return run.end(true);
}

ExitStatus find_blocks(const VolumeCommand& command, Session& session) {
    const FileOptions& files = command.model.files;
    plan_outputs(files, OutputKind::surfaces);
    check_output(command);
    const auto grid = read_grid(command.cells);
    auto run = ModelRun::begin(command.model, session);
    if (command.suggests) return suggest_seal(command, run, session);
    run.make();
    if (!run.refused().empty()) return run.end(false);
    const Model& model = *run.built().model;
    const auto values = run.values_on(model.mesh);
    write_folder(command, {model, run.built().arranged.sealed, run.leaks(), values}, session);
    say_written(run.told(), command.folder);
    say(run.told(), contacts_text(run.inputs(), model, command.contacts, run.statistics()));
    write_tables(command, run, session);
    if (grid)
        tell_when_written(run.told(),
                          write_cells(command.cells, *grid, model, run.inputs(), session));
    run.certify(outputs_of(model, command.folder, command.part_format));
    return run.end(true);
}

} // namespace

Command volume_command(CLI::App& program) {
    auto command = std::make_shared<VolumeCommand>();
    auto* app = program.add_subcommand("volume", "Find the blocks that surfaces enclose");
    add_inputs(*app, command->model.files);
    add_value(*app, "-o,--output", command->folder, "DIR",
              "Folder for the model; made by the program");
    app->add_flag("--suggest-seal", command->suggests,
                  "List natural breaks in the widths of gaps, and the blocks for each distance; "
                  "write no model");
    add_value(*app, "--seal-plot", command->seal_plot, "FILE.svg",
              "Draw this, with --suggest-seal: lengths of gaps by their widths, and blocks");
    add_naming(*app, command->model);
    add_value(*app, "--parts", command->part_format, "FORMAT",
              "Format of blocks and interfaces: vtp, obj, ts, ply, off, stl, msh, msh22, "
              "inp, mesh, poly, smesh, a file of each; auto: vtp, and if they are more than "
              "1000, one file for all blocks and one for all interfaces (default: auto)")
        ->check(one_of(part_formats()));
    add_value(*app, "--relations", command->relations, "FILE.csv",
              "Which surface stops at, crosses or ends near which other one, as a table");
    add_value(*app, "--juxtaposition", command->juxtaposition, "FILE.csv",
              "Which blocks face each other across which surface, as a table");
    add_value(*app, "--gocad", command->gocad, "FILE.ml",
              "The model with its blocks as regions, for GOCAD and RINGMesh");
    add_value(*app, "--lines", command->lines, "FILE.pl",
              "The lines of the model as PLine of GOCAD: cutoffs, free borders, ...");
    add_cells(*app, command->cells);
    add_value(*app, "--contact", command->contacts, "Z",
              "z of a contact, above which volumes, areas and columns are measured; repeated")
        ->allow_extra_args(false);
    add_certificate(*app, command->model.proof.certificate);
    add_arranging(*app, command->model);
    add_run(*app, command->model.files);
    command->model.needs_blocks = true;
    command->model.project.last = BuildStage::blocks;
    app->footer(volume_footer);
    return {app, [command] {
                Session session(command->model.files.threads);
                return find_blocks(*command, session);
            }};
}

} // namespace terrane::cli
