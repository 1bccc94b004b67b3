// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/fields.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/reports/improve_report.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/cli/stages/outputs.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {
namespace {

struct ImproveCommand {
    ModelCommand model;
    std::string edge_length = "auto";        ///< text of the option
    std::vector<std::string> edge_length_of; ///< NAME=L
    std::string histogram;                   ///< empty: none
};

constexpr auto improve_footer =
    R"(The surfaces are arranged and rounded first, as `terrane arrange` does; then triangles are made
better: smoothed, swapped, collapsed, split, all surfaces together. The mesh stays conforming: each
step is allowed only where exact predicates show that no triangles meet improperly by it, and the
whole is checked exactly at the end. Corners stay; curves (intersections, borders, creases) keep their vertices
on the curves as they were. No point moves farther than D from its surface, and no point of a surface as it was is farther than
D from it as it is: shown for all of each triangle, and measured again by other code before anything
is written.

q is 2 r / R, radius of the inscribed by that of the circumscribed circle, 1 for an equilateral
triangle.

Examples:
  terrane improve horizons.ts faults.ts -o model.vtp --edge-length 200
  terrane improve model.ml -o model.vtp --max-deviation 5 --histogram model.svg
  terrane improve horizons.ts -o model.vtp --edge-length 200 --certificate model.json
  terrane improve model.ml -o model.vtp --edge-length 400 --edge-length-of F1=150 --turn 15)";

/// Reads the lengths among the options.
ProjectImprove improvement_of(const ImproveCommand& command) {
    ProjectImprove improve = *command.model.project.improve;
    if (command.edge_length != "auto") {
        const auto length = parse_number(command.edge_length);
        if (!length || !(*length > 0))
            refuse("needs a positive length or auto: " + command.edge_length, "--edge-length");
        improve.options.edge_length = *length;
    }
    for (const std::string& text : command.edge_length_of)
        improve.edge_length_of.push_back(positive_named_length(text, "--edge-length-of"));
    if (improve.resolution.dissolve && improve.resolution.length == 0)
        refuse("needs --resolution", "--dissolve");
    return improve;
}

ExitStatus improve_files(ImproveCommand& command, Session& session) {
    const FileOptions& files = command.model.files;
    const auto outputs = plan_outputs(files, OutputKind::surfaces);
    if (!command.histogram.empty()) check_folder(command.histogram);
    auto improve = improvement_of(command);
    command.model.project.improve = std::move(improve);
    auto run = ModelRun::begin(command.model, session);
    run.make();
    if (!run.refused().empty()) return run.end(false);
    const Improved& improved = run.built().improved->improved;
    const auto narrow = stl_is_conforming(improved.mesh, files, outputs, session);
    if (!narrow) {
        run.page().set_verdict(not_conforming_in_stl, false);
        print(stderr, complaint("nothing written"));
        return run.end(false);
    }
    if (!command.histogram.empty()) {
        must(write_file(command.histogram, histogram_of(improved.report)));
        say_written(run.told(), command.histogram);
    }
    write_outputs(improved.mesh, true, run, outputs, session);
    run.certify(certified_outputs(outputs, improved.mesh, files.ascii));
    return run.end(true);
}

/// Adds the options of improvement; those of lengths as texts, which are read with the surfaces.
void add_improvement(CLI::App& app, ImproveCommand& command) {
    ImproveOptions::describe(
        [&](const Field& field, const auto&) {
            if (field.name == "edge_length")
                add_value(app, "--edge-length", command.edge_length, "L",
                          help_of(field) + "; auto: " + std::string(field.otherwise) +
                              " (default: auto)");
            if (field.name == "edge_length_of")
                add_value(app, "--edge-length-of", command.edge_length_of, "NAME=L",
                          help_of(field) + "; may be repeated")
                    ->allow_extra_args(false);
        },
        command.model.project.improve->options);
    add_fields(app, command.model.project.improve->options);
    add_fields(app, command.model.project.improve->resolution);
    app.get_option("--strict")
        ->description(
            "Stop with status 2 at warnings about the inputs, and with status 1 where the volume "
            "of a block changes too much; nothing is written then");
}

} // namespace

Command improve_command(CLI::App& program) {
    auto command = std::make_shared<ImproveCommand>();
    auto* app = program.add_subcommand("improve", "Make better triangles, conforming all the way");
    add_inputs(*app, command->model.files);
    add_output(*app, command->model.files, "File for the mesh; - is standard output");
    command->model.project.improve.emplace();
    command->model.project.last = BuildStage::improve;
    add_improvement(*app, *command);
    add_value(*app, "--histogram", command->histogram, "FILE.svg",
              "Histograms of q before and after");
    add_arranging(*app, command->model);
    app->add_flag("--ascii", command->model.files.ascii, "STL as text, with doubles, not float32");
    add_msh(*app, command->model.files);
    add_certificate(*app, command->model.proof.certificate);
    add_run(*app, command->model.files);
    app->footer(improve_footer);
    return {app, [command, app] {
                check_fields<ImproveOptions>(*app);
                check_fields<Resolution>(*app);
                Session session(command->model.files.threads);
                return improve_files(*command, session);
            }};
}

} // namespace terrane::cli
