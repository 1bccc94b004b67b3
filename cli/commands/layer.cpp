// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/max_move.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/reports/pair_report.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/cli/stages/layer_stage.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/cli/stages/plausibility.hpp>

namespace terrane::cli {
namespace {

struct LayerCommand {
    FileOptions files;
    std::string hard, soft; ///< files; both or none
    std::string keep;
    std::vector<std::string> layers; ///< NAME=HARDNESS, from the top down
    double min_thickness = 0;
    std::optional<double> max_move;
    PairCheckOptions check = few_pairs;
    ProofOptions proof; ///< a certificate only
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
Status plan_inputs(LayerCommand& command) {
    const bool pair = !command.hard.empty() || !command.soft.empty();
    if (pair) {
        if (command.hard.empty() || command.soft.empty() || command.keep.empty())
            return usage("needs --hard, --soft and --keep together", "layer");
        if (!command.layers.empty() || !command.files.inputs.empty())
            return usage("takes either --hard and --soft, or files and --layer", "layer");
        command.files.inputs = {command.hard, command.soft};
        return Done{};
    }
    if (command.layers.empty() || command.files.inputs.empty())
        return usage("needs --hard and --soft, or files and --layer for each horizon", "layer");
    if (!command.keep.empty()) return usage("goes with --hard and --soft only", "--keep");
    return Done{};
}

Result<Layer> layer_named(const std::string& text, const Inputs& inputs) {
    const auto at = text.rfind('=');
    double hardness = 0;
    const char* const end = text.data() + text.size();
    const auto read = at == std::string::npos
                          ? std::from_chars_result{text.data(), std::errc::invalid_argument}
                          : std::from_chars(text.data() + at + 1, end, hardness);
    if (read.ec != std::errc{} || read.ptr != end || !std::isfinite(hardness))
        return usage("needs NAME=HARDNESS, a number: " + text, "--layer");
    const std::string name = text.substr(0, at);
    std::vector<std::uint32_t> found;
    for (std::uint32_t s = 0; s < inputs.surfaces.size(); ++s)
        if (inputs.labels[s] == name || inputs.surfaces[s].name == name) found.push_back(s);
    if (found.empty()) return usage(not_called("surface", name, inputs.labels), "--layer");
    if (found.size() > 1) // labels are unique
        std::erase_if(found, [&](std::uint32_t s) { return inputs.labels[s] != name; });
    return Layer{SurfaceId(found.at(0)), hardness};
}

Result<std::vector<Layer>> order_of(const LayerCommand& command, const Inputs& inputs) {
    std::vector<Layer> order;
    if (command.layers.empty()) {
        for (const std::size_t file : {0U, 1U})
            if (inputs.surfaces_of_file[file] != 1)
                return usage("must hold one surface, or name them with --layer",
                             file == 0 ? "--hard" : "--soft");
        order = {{SurfaceId(1), 0}, {SurfaceId(0), 1}};
        if (command.keep == "lower") std::swap(order[0], order[1]);
        return order;
    }
    for (const std::string& text : command.layers) {
        const auto layer = layer_named(text, inputs);
        if (!layer) return layer.error();
        order.push_back(layer.value());
    }
    return order;
}

/// Checks before any work is done that a certificate can be made, if one is wanted.
Status check_certificate(const LayerCommand& command) {
    if (command.proof.certificate.empty()) return Done{};
    return plan_proof(command.proof, command.files);
}

Status write_all(const Mesh& mesh, const FileOptions& files, const std::vector<Output>& outputs,
                 Session& session) {
    WriteOptions options;
    options.ascii = files.ascii;
    for (const Output& output : outputs) {
        const auto written = write_output(mesh, output, options, session);
        if (!written) return written.error();
        tell_when_written(summary_stream(files), wrote(output));
    }
    return Done{};
}

Result<ExitStatus> layer_files(LayerCommand& command, Session& session) {
    const FileOptions& files = command.files;
    const auto outputs = plan_outputs(files, OutputKind::surfaces);
    if (!outputs) return outputs.error();
    if (const auto possible = check_certificate(command); !possible) return possible.error();
    auto page = plan_page(files, session);
    if (!page) return page.error();
    const auto inputs = read_certified_inputs(command.proof.certificate, files, session);
    if (!inputs) return inputs.error();
    if (const auto added = add_page_inputs(*page, files, *inputs); !added) return added.error();
    Json statistics = statistics_of(inputs.value());
    if (const auto sound = examine(inputs.value(), {}, session, statistics); !sound)
        return sound.error();
    const auto order = order_of(command, inputs.value());
    if (!order) return order.error();

    const auto layered = layer_inputs(inputs.value(), order.value(),
                                      {.min_thickness = command.min_thickness,
                                       .check = check_of(command.check, inputs.value()),
                                       .max_move = command.max_move},
                                      session, statistics);
    if (!layered) return layered.error();
    const RoundedMesh& rounded = layered.value().rounded;
    const bool is_stack = layered->is_stack();
    page->add_mesh(rounded.mesh);
    say(summary_stream(files),
        text_of(inputs.value(), layered->reports, rounded.report,
                is_stack ? std::optional(layered->step_width) : std::nullopt));
    print(stderr, flaws_text(rounded.report, layered->out_of_order));
    if (is_stack)
        if (const auto written = write_all(rounded.mesh, files, outputs.value(), session); !written)
            return written.error();
    if (is_stack && !command.proof.certificate.empty()) {
        auto certified = certified_outputs(*outputs, rounded.mesh, files.ascii);
        if (!certified) return certified.error();
        CertifiedResult result{.inputs = certified_inputs(files.inputs, *inputs),
                               .outputs = *std::move(certified),
                               .surfaces = inputs->surfaces,
                               .layered = &*layered,
                               .order = *order};
        const auto proved =
            write_certificate(command.proof.certificate, result, summary_stream(files), session);
        if (!proved) return proved.error();
    }
    page->set_verdict(is_stack ? "The layers are in order, and their mesh is conforming, by exact "
                                 "checks."
                               : "The layers are not in order, or their mesh is not conforming.",
                      is_stack);
    add_page_certificate(*page, files, command.proof.certificate, is_stack, session);
    return write_run(*page, statistics, files, session, is_stack);
}

} // namespace

Command layer_command(CLI::App& program) {
    auto command = std::make_shared<LayerCommand>();
    auto* app = program.add_subcommand("layer", "Make soft horizons give way to harder ones");
    add_inputs(*app, command->files);
    app->get_option("IN")->required(false); // or --hard and --soft
    app->add_option("--hard", command->hard, "File with the hard horizon")->type_name("FILE");
    app->add_option("--soft", command->soft, "File with the soft horizon")->type_name("FILE");
    app->add_option("--keep", command->keep, "Side of the hard one on which the soft one stays")
        ->check(one_of({"upper", "lower"}))
        ->type_name("upper|lower");
    app->add_option("--layer", command->layers,
                    "A horizon and its hardness; repeated, from the top down")
        ->allow_extra_args(false)
        ->type_name("NAME=HARDNESS");
    app->add_option("--min-thickness", command->min_thickness,
                    "Least thickness along z between a soft horizon and harder ones, in the unit "
                    "of the files (default: 0)")
        ->type_name("LENGTH");
    add_output(*app, command->files, "File for the mesh; - is standard output");
    add_max_move(*app, command->max_move);
    add_check(*app, command->check);
    app->add_flag("--ascii", command->files.ascii, "STL as text, with doubles, not float32");
    add_certificate(*app, command->proof.certificate);
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    add_report(*app, command->files);
    app->footer(layer_footer);
    return {app, [command] {
                if (const auto planned = plan_inputs(*command); !planned)
                    return fail(planned.error());
                Session session(command->files.threads);
                const auto status = layer_files(*command, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
