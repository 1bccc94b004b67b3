// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/max_move.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/reports/pair_report.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/cli/stages/outputs.hpp>

namespace terrane::cli {
namespace {

struct LayerCommand {
    ModelCommand model;
    std::string hard, soft; ///< files; both or none
    std::string keep;
    std::vector<std::string> layers; ///< NAME=HARDNESS, from the top down
    double min_thickness = 0;
};

constexpr auto layer_footer =
    R"(Where a soft horizon is on the wrong side of a harder one it is replaced by the harder one's
own triangles: in files with groups these belong to both. --keep says on which side of the hard one
the soft one stays: upper makes it the higher of the two at each place, lower the lower one.
With --layer, horizons from the top down, each softer one gives way at each place to the nearest
harder ones that exist there, above and below it; of equals the upper one counts as harder. Horizons
that are not named are left out. The mesh is written only if its doubles are conforming, and no
horizon is anywhere above one that is higher in the order, by exact checks; else the status is 1.

Examples:
  terrane layer --hard salt.ts --soft shale.ts --keep upper -o layers.vtp
  terrane layer basin.ts --layer top=1 --layer middle=3 --layer base=2 -o basin.vtp
  terrane layer basin.ts --layer top=1 --layer base=2 --min-thickness 5 -o basin.obj
  terrane layer basin.ts --layer top=1 --layer base=2 -o basin.obj --certificate basin.json)";

/// Puts the input files into files.inputs, whichever of the two ways to call the command was used.
void plan_inputs(LayerCommand& command) {
    const bool pair = !command.hard.empty() || !command.soft.empty();
    if (pair) {
        if (command.hard.empty() || command.soft.empty() || command.keep.empty())
            refuse("needs --hard, --soft and --keep together", "layer");
        if (!command.layers.empty() || !command.model.files.inputs.empty())
            refuse("takes either --hard and --soft, or files and --layer", "layer");
        command.model.files.inputs = {command.hard, command.soft};
        return;
    }
    if (command.layers.empty() || command.model.files.inputs.empty())
        refuse("needs --hard and --soft, or files and --layer for each horizon", "layer");
    if (!command.keep.empty()) refuse("goes with --hard and --soft only", "--keep");
}

/// Returns the layers of a command whose surfaces were read.
ProjectLayers layers_of(const LayerCommand& command, const Inputs& inputs,
                        std::span<const SurfaceInfo> infos) {
    ProjectLayers layers{.min_thickness = command.min_thickness};
    if (command.layers.empty()) {
        for (const std::size_t file : {0U, 1U})
            if (inputs.surfaces_of_file[file] != 1)
                refuse("must hold one surface, or name them with --layer",
                       file == 0 ? "--hard" : "--soft");
        layers.order = {{inputs.labels[1], 0, 1}, {inputs.labels[0], 1, 0}};
        if (command.keep == "lower") std::swap(layers.order[0], layers.order[1]);
        return layers;
    }
    for (const std::string& text : command.layers) {
        const auto named = parse_named_length(text);
        if (!named) refuse("needs NAME=HARDNESS, a number: " + text, "--layer");
        auto found = surfaces_called(named->first, infos, inputs.labels);
        if (found.size() > 1) // labels are unique
            std::erase_if(found, [&](std::uint32_t s) { return inputs.labels[s] != named->first; });
        if (found.empty()) refuse(not_called("surface", named->first, inputs.labels), "--layer");
        layers.order.push_back({named->first, named->second, found[0]});
    }
    return layers;
}

ExitStatus layer_files(const LayerCommand& command, Session& session) {
    const FileOptions& files = command.model.files;
    const auto outputs = plan_outputs(files, OutputKind::surfaces);
    auto run = ModelRun::begin(command.model, session);
    auto layers = layers_of(command, run.inputs(), infos_of(run.surfaces()));
    run.project().layers = std::move(layers);
    run.make();
    if (!run.refused().empty()) return run.end(false);
    const Mesh& mesh = run.built().preprocessed.layered->rounded.mesh;
    write_outputs(mesh, false, run, outputs, session);
    run.certify(certified_outputs(outputs, mesh, files.ascii));
    return run.end(true);
}

} // namespace

Command layer_command(CLI::App& program) {
    auto command = std::make_shared<LayerCommand>();
    auto* app = program.add_subcommand("layer", "Make soft horizons give way to harder ones");
    add_inputs(*app, command->model.files);
    app->get_option("IN")->required(false); // or --hard and --soft
    add_value(*app, "--hard", command->hard, "FILE", "File with the hard horizon");
    add_value(*app, "--soft", command->soft, "FILE", "File with the soft horizon");
    add_value(*app, "--keep", command->keep, "upper|lower",
              "Side of the hard one on which the soft one stays")
        ->check(one_of({"upper", "lower"}));
    add_value(*app, "--layer", command->layers, "NAME=HARDNESS",
              "A horizon and its hardness; repeated, from the top down")
        ->allow_extra_args(false);
    add_value(*app, "--min-thickness", command->min_thickness, "LENGTH",
              "Least thickness along z between a soft horizon and harder ones, in the unit "
              "of the files (default: 0)");
    add_output(*app, command->model.files, "File for the mesh; - is standard output");
    add_max_move(*app, command->model.project.max_move);
    command->model.project.check = few_pairs;
    command->model.project.last = BuildStage::preprocess;
    add_check(*app, command->model.project.check);
    app->add_flag("--ascii", command->model.files.ascii, "STL as text, with doubles, not float32");
    add_certificate(*app, command->model.proof.certificate);
    add_run(*app, command->model.files);
    app->footer(layer_footer);
    return {app, [command] {
                plan_inputs(*command);
                Session session(command->model.files.threads);
                return layer_files(*command, session);
            }};
}

} // namespace terrane::cli
