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

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/commands/file_options.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/column.hpp>
#include <terrane/cli/options/fields.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/reports/tetrahedra_report.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/cli/stages/pipeline.hpp>
#include <terrane/cli/stages/plausibility.hpp>

namespace terrane::cli {
namespace {

struct TetrahedralizeCommand {
    FileOptions files;
    ArrangeSettings settings;
    std::string around; ///< text of the option
    TetrahedraOptions options;
    std::vector<std::string> roles;            ///< NAME=ROLE
    std::vector<std::string> size_of, size_in; ///< NAME=L
    std::vector<std::string> split;
    std::string column; ///< file; empty: none
    bool blocks_only = false;
    std::string certificate; ///< file; empty: none
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
                 std::vector<NamedSize>& sizes) {
    for (const std::string& text : texts) {
        const auto size = parse_named_length(text);
        if (!size || !(size->length > 0))
            return Error{ErrorCode::bad_option, "needs NAME=L, with a positive length: " + text,
                         option};
        sizes.push_back({{size->name, option}, size->length});
    }
    return Done{};
}

Result<TetrahedraRequest> wishes_of(const TetrahedralizeCommand& command) {
    TetrahedraRequest wishes;
    wishes.options = command.options;
    if (!command.around.empty()) {
        wishes.options.box = parse_box(command.around);
        if (!wishes.options.box)
            return Error{ErrorCode::bad_option, "needs six numbers: x0,y0,z0,x1,y1,z1", "--around"};
    }
    if (auto added = add_sizes(command.size_of, "--size-of", wishes.size_of); !added)
        return added.error();
    if (auto added = add_sizes(command.size_in, "--size-in", wishes.size_in); !added)
        return added.error();
    for (const std::string& name : command.split) wishes.split.push_back({name, "--split"});
    wishes.outside = !command.blocks_only && !command.settings.volume.wanted();
    return wishes;
}

/// Names the option that an error is about, whose sentence begins with its name in the library.
Error at_option(Error error, const CLI::App& app) {
    if (error.code != ErrorCode::bad_option || !error.place.empty()) return error;
    std::string word = error.sentence.substr(0, error.sentence.find(' '));
    std::replace(word.begin(), word.end(), '_', '-');
    const std::string option = word == "box" ? "--around" : "--" + word;
    if (app.get_option_no_throw(option) != nullptr) error.place = option;
    return error;
}

Result<FilledBlocks> fill(const Model& model, const TetrahedraRequest& wishes, Session& session,
                          Json& statistics) {
    auto filled = fill_blocks(model, wishes, session.run());
    session.end_stage();
    if (filled) add_statistics(statistics, *filled);
    return filled;
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
Status check_call(const TetrahedralizeCommand& command, const std::vector<Output>& outputs) {
    for (const Output& output : outputs) {
        if (output.format == Format::pylith && !command.split.empty())
            return Error{ErrorCode::bad_option, "PyLith splits nodes itself: leave out --split",
                         output.path};
        if (!command.certificate.empty() && !is_certifiable(output.format, command.files.order))
            return Error{ErrorCode::bad_option,
                         "a certificate is about tetrahedra of first order in .vtu, .msh, .inp or "
                         ".mesh",
                         output.path};
    }
    if (auto planned = plan_certificate(command.certificate, command.files, command.settings);
        !planned)
        return planned;
    if (auto sound = check_volume_options(command.settings.volume); !sound) return sound;
    if (const auto helper = find_tetgen_helper(); !helper) return helper.error();
    return Done{};
}

Result<ExitStatus> tetrahedralize_files(const TetrahedralizeCommand& command, Session& session) {
    const FileOptions& files = command.files;
    const auto wishes = wishes_of(command);
    if (!wishes) return wishes.error();
    const auto outputs = plan_outputs(files, OutputKind::tetrahedra);
    if (!outputs) return outputs.error();
    if (const auto sound = check_files_beside(*files.app, *outputs); !sound) return sound.error();
    if (const auto sound = check_call(command, *outputs); !sound) return sound.error();
    auto page = plan_page(files, session);
    if (!page) return page.error();
    auto inputs = read_certified_inputs(command.certificate, files, session);
    if (!inputs) return inputs.error();
    if (const auto added = add_page_inputs(*page, files, *inputs); !added) return added.error();
    const auto roles = roles_of(inputs.value());
    if (const auto set = set_roles(command.roles, inputs.value()); !set) return set.error();
    const auto naming = naming_of(command.column, *inputs);
    if (!naming) return naming.error();
    Json statistics = statistics_of(inputs.value());
    const auto finish = [&](bool good) -> Result<ExitStatus> {
        add_page_certificate(*page, files, command.certificate, good, session);
        return write_run(*page, statistics, files, session, good);
    };

    auto arranged = arrange_and_round(inputs.value(), command.settings, session, statistics);
    if (!arranged) return arranged.error();
    say(summary_stream(files),
        session.timed("summary", [&] { return summary(inputs.value(), arranged.value()); }));
    page->add_arranged(*arranged);
    if (!arranged.value().rounded.report.clean) {
        print(stderr, offending_pairs(*inputs, *arranged) +
                          complaint("no tetrahedra without a conforming mesh; nothing written"));
        return finish(false);
    }

    session.begin("volumes", Phase::computing);
    const auto model = make_model(arranged.value().exact, *arranged.value().rounded.conforming,
                                  session.run(), *naming);
    if (!model) return model.error();
    if (const auto sound = examine(*model, *inputs, true, session, statistics); !sound)
        return sound.error();
    page->add_model(*model, std::nullopt);
    const auto filled = fill(model.value(), wishes.value(), session, statistics);
    if (!filled) return at_option(filled.error(), *files.app);
    page->add_tetrahedra(*filled);
    say(summary_stream(files),
        session.timed("summary", [&] { return filled_text(filled.value(), inputs->unit); }));
    const bool good = filled->report.violations.empty();
    if (good) {
        const auto written = write_all(filled.value(), outputs.value(), files, session);
        if (!written) return written.error();
        if (!command.certificate.empty()) {
            set_read_roles(roles, *arranged);
            auto result = certified_arrangement(files.inputs, *inputs, command.settings, *arranged);
            if (!result) return result.error();
            result->model = &*model;
            result->tetrahedra = &filled->tetrahedra;
            for (const Output& output : *outputs)
                result->outputs.push_back({output.path, certified_format(output.format)});
            const auto proved =
                write_certificate(command.certificate, *result, summary_stream(files), session);
            if (!proved) return proved.error();
        }
    } else {
        print(stderr, violations_text(filled->report) + complaint("nothing written"));
    }
    return finish(good);
}

void add_tetrahedra_options(CLI::App& app, TetrahedralizeCommand& command) {
    TetrahedraOptions& options = command.options;
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
    app.add_option("--split", command.split,
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
    add_inputs(*app, command->files);
    add_output(
        *app, command->files,
        "File for the tetrahedra, .vtu .msh .inp .mesh .exo .ugi; - is standard output; may be "
        "repeated");
    add_msh(*app, command->files);
    add_order(*app, command->files);
    add_roles(*app, command->roles);
    add_column(*app, command->column);
    add_tetrahedra_options(*app, *command);
    add_certificate(*app, command->certificate);
    add_settings(*app, command->settings);
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    add_report(*app, command->files);
    command->settings.blocks = true;
    app->footer(tetrahedralize_footer);
    return {app, [command] {
                Session session(command->files.threads);
                const auto status = tetrahedralize_files(*command, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
