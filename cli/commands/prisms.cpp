// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/cells/prisms.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/cli/stages/plausibility.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/meshes/prism_text.hpp>

namespace terrane::cli {
namespace {

struct PrismCommand {
    FileOptions files;
    PrismOptions options;
    std::string follow = "both";
};

constexpr auto prisms_footer =
    R"(IN are two surfaces, the top first, in one file or in two. Prisms stand on the triangles of the top. Which
triangle of the base is below a vertex is decided exactly; its height there is rounded once. At a vertical fault each
triangle of the top has the part of the base on its own side. Neither surface may fold over; vertical triangles do not
count.

--follow both      divides each vertical evenly
--follow top       layers of --thickness below the top; the base cuts them, and the last one has the rest
--follow base      layers of --thickness above the base; the top cuts them, and the first one has the rest

Where a layer has no thickness at one corner, a prism becomes a pyramid, at two a tetrahedron. Where the base is
missing, or above the top, no prism stands; these triangles are named, and --stats lists them. If none is left, the exit
status is 1.

OUT is .vtu or .msh (Gmsh 2.2): layers are numbered from 1 at the top.

Examples:
  terrane prisms top.ts base.ts --layers 8 -o reservoir.vtu
  terrane prisms top.ts base.ts --layers 20 --follow top --thickness 2 -o reservoir.msh)";

/// Checks that there are a top and a base. Errors: bad_option.
void check_surfaces(const Inputs& inputs) {
    if (inputs.surfaces.size() != 2)
        refuse(fmt::format("needs two surfaces, the top first, and has {}", inputs.surfaces.size()),
               "IN");
}

std::vector<Output> plan_prism_outputs(const FileOptions& files) {
    FileOptions others = files; // the formats of inputs are checked with those of no output
    others.outputs.clear();
    others.output_format.clear();
    plan_outputs(others, OutputKind::surfaces);
    std::vector<Output> outputs;
    for (const std::string& path : files.outputs) {
        const auto extension = files.output_format.empty()
                                   ? std::filesystem::path(path).extension().string()
                                   : "." + files.output_format;
        if (extension != ".vtu" && extension != ".msh")
            refuse(ErrorCode::unknown_format, "prisms are .vtu or .msh", path);
        check_folder(path);
        outputs.push_back({path, extension == ".vtu" ? Format::vtu : Format::msh});
    }
    if (std::ranges::count(files.outputs, "-") > 1 ||
        (std::ranges::count(files.outputs, "-") == 1 && files.stats == "-"))
        refuse("standard output can take only one file");
    return outputs;
}

/// Names the first triangle on which no prism stands, for one of two reasons.
void warn_of_gaps(const PrismMesh& mesh, const Surface& top, bool is_crossed) {
    const auto of_kind = [&](const PrismGap& gap) { return gap.is_crossed == is_crossed; };
    const auto first = std::ranges::find_if(mesh.gaps, of_kind);
    if (first == mesh.gaps.end()) return;
    const Point3& p = top.vertices[top.triangles[first->triangle][first->corner]];
    warn(fmt::format("the base is {} {}, on which no prism stands; the first is {} of the top, at "
                     "x = {}, y = {}",
                     is_crossed ? "above a corner of" : "missing below a corner of",
                     counted(std::ranges::count_if(mesh.gaps, of_kind), "triangle"),
                     first->triangle, p.x, p.y));
}

Json json_of_gaps(const PrismMesh& mesh) {
    Json gaps = Json::array();
    for (const PrismGap& gap : mesh.gaps)
        gaps.push_back({{"triangle", gap.triangle},
                        {"corner", gap.corner},
                        {"reason", gap.is_crossed ? "crossed" : "missing"}});
    return gaps;
}

std::string text_of(const PrismMesh& mesh, const Quantities& quantities) {
    std::array<std::size_t, 7> of_size{};
    for (const PrismCell& cell : mesh.cells) ++of_size[cell.size];
    return fmt::format("prisms: {}, {}, {} {}; {}; volume {}\n", counted(of_size[6], "prism"),
                       counted(of_size[5], "pyramid"), of_size[4],
                       of_size[4] == 1 ? "tetrahedron" : "tetrahedra",
                       counted(mesh.vertices.size(), "node"), quantities.volume(mesh.volume));
}

ExitStatus make_prism_files(const PrismCommand& command, const CLI::App& app, Session& session) {
    const auto outputs = plan_prism_outputs(command.files);
    PrismOptions options = command.options;
    options.follow = command.follow == "both"  ? PrismLayers::proportional
                     : command.follow == "top" ? PrismLayers::top
                                               : PrismLayers::base;
    const auto inputs = read_inputs(command.files, session);
    check_surfaces(inputs);
    const Surface &top = inputs.surfaces[0], &base = inputs.surfaces[1];
    Json statistics = statistics_of(inputs);
    examine(inputs.surfaces, {}, inputs, session, statistics);
    const auto mesh =
        session.timed("prisms", [&] { return make_prisms(top, base, options, session.run()); });
    if (!mesh && mesh.error().code == ErrorCode::nothing_to_do) {
        print(stderr, complaint("nothing written: " + mesh.error().sentence));
        write_statistics(std::move(statistics), command.files.stats, session);
        return ExitStatus::negative;
    }
    if (!mesh) {
        Error error = mesh.error();
        if (error.place == "layers" || error.place == "thickness") error.place = "--" + error.place;
        throw Failure{at_option(error, app)};
    }
    for (const bool is_crossed : {false, true}) warn_of_gaps(*mesh, top, is_crossed);
    std::FILE* const told = summary_stream(command.files);
    say(told, text_of(*mesh, inputs.quantities()));
    for (const Output& output : outputs) {
        session.begin("write", Phase::writing);
        must(write_file(output.path,
                        output.format == Format::vtu ? to_vtu(*mesh) : to_msh22(*mesh)));
        session.end_stage();
        say_written(told, output.path);
    }
    statistics["prisms"] = {{"cells", mesh->cells.size()},
                            {"nodes", mesh->vertices.size()},
                            {"volume", mesh->volume},
                            {"gaps", json_of_gaps(*mesh)}};
    write_statistics(std::move(statistics), command.files.stats, session);
    return ExitStatus::done;
}

} // namespace

Command prisms_command(CLI::App& program) {
    auto command = std::make_shared<PrismCommand>();
    auto* app = program.add_subcommand("prisms", "Fill the space between two surfaces with prisms");
    add_inputs(*app, command->files);
    add_output(*app, command->files, "File for the prisms: .vtu or .msh");
    add_value(*app, "--layers", command->options.layers, "N", "Number of layers (default: 1)");
    add_value(*app, "--follow", command->follow, "SURFACE",
              "What layers follow: both, top or base (default: both)")
        ->check(one_of({"both", "top", "base"}));
    add_value(*app, "--thickness", command->options.thickness, "LENGTH",
              "Thickness of layers that follow the top or the base")
        ->check(CLI::PositiveNumber.description(""));
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    app->footer(prisms_footer);
    return {app, [command, app] {
                Session session(command->files.threads);
                return make_prism_files(*command, *app, session);
            }};
}

} // namespace terrane::cli
