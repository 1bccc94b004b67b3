// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>

#include <terrane/cli/command.hpp>
#ifdef TERRANE_HAS_TETGEN
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/check_tetrahedra.hpp>
#include <terrane/algorithms/stopwatch.hpp>
#include <terrane/algorithms/structure.hpp>
#include <terrane/algorithms/tetrahedra.hpp>
#include <terrane/algorithms/without_outside.hpp>
#include <terrane/cli/pipeline.hpp>
#include <terrane/cli/tetrahedra_report.hpp>
#endif

namespace terrane::cli {

#ifdef TERRANE_HAS_TETGEN

namespace {

constexpr std::size_t most_pairs = 20;   ///< named on the terminal
constexpr std::size_t most_regions = 50; ///< listed on the terminal

struct TetrahedralizeCommand {
    FileOptions files;
    ArrangeSettings settings;
    std::string around; ///< as given
    TetrahedraOptions options;
};

constexpr auto footer =
    R"(The surfaces are arranged and rounded first, as `terrane arrange` does; where the doubles are not
a conforming mesh nothing is written, and the exit status is 1. A box round
all closes the domain: what touches it is region 0, the outside, each further region is a volume that
the surfaces enclose. With a volume of interest (--box, --rotated-box, --polygon, --within) all
surfaces are cut by its boundary, and only what is inside gets tetrahedra: there is no region 0.

The result is checked: tetrahedra have positive volume, each triangle is a union of their faces, each
region is one block (found in two ways) and has its volume. Where that fails nothing is written, and
the exit status is 1. The shapes are reported: dihedral angles, ratios of circumradius to shortest
edge.

VTU has arrays region, surface and parent; MSH physical groups; Abaqus INP element sets, node sets
and surfaces; MEDIT references: region and surface + 1.

Examples:
  terrane tetrahedralize model.ml -o model.vtu
  terrane tetrahedralize faults.ts topography.ts -o model.msh --edge-length 200
  terrane tetrahedralize model.ml -o model.msh --msh 2.2 -o model.inp -o model.mesh
  terrane tetrahedralize horizons.ts faults.ts -o model.vtu --box 0,0,-3000,10000,10000,500)";

/// "x0,y0,z0,x1,y1,z1"
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

Result<TetrahedraOptions> options_of(const TetrahedralizeCommand& command) {
    TetrahedraOptions options = command.options;
    if (command.around.empty()) return options;
    options.box = parse_box(command.around);
    if (!options.box)
        return Error{ErrorCode::bad_option, "needs six numbers: x0,y0,z0,x1,y1,z1", "--around"};
    return options;
}

std::string region_text(const TetrahedralMesh& mesh, const TetrahedraReport& report) {
    std::vector<std::size_t> tetrahedra(mesh.region_count);
    for (const std::uint32_t region : mesh.region_of) ++tetrahedra[region];
    const std::size_t first = tetrahedra[0] == 0 ? 1 : 0; // in a volume of interest
    auto text = fmt::format(
        "{} tetrahedra, {}, {}{}\n", mesh.tetrahedra.size(), counted(mesh.faces.size(), "face"),
        counted(tetrahedra.size() - first, "region"), first == 0 ? " with the outside" : "");
    for (std::size_t r = first; r < std::min(tetrahedra.size(), most_regions); ++r)
        text += fmt::format("  region {:<3} {:>9} tetrahedra  volume {:.6g}{}\n", r, tetrahedra[r],
                            report.volumes[r].tetrahedra, r == 0 ? "  (outside)" : "");
    if (tetrahedra.size() > most_regions)
        text += fmt::format("  and {} more\n", tetrahedra.size() - most_regions);
    return text;
}

void add_statistics(Json& json, const TetrahedralMesh& mesh, const TetrahedraReport& report) {
    json["output"]["volumes"] = mesh.region_count - 1;
    Json volumes = Json::array();
    for (const RegionVolume& region : report.volumes) volumes.push_back(region.tetrahedra);
    json["tetrahedra"] = {
        {"tetrahedra", mesh.tetrahedra.size()}, {"vertices", mesh.vertices.size()},
        {"faces", mesh.faces.size()},           {"regions", mesh.region_count},
        {"volume_of_region", volumes},          {"check", report_json(report)}};
}

struct Filled {
    TetrahedralMesh tetrahedra;
    TetrahedraReport report;
    std::vector<std::string> block_names; ///< per region, of the surfaces around it
};

Result<Filled> fill_and_check(const Mesh& mesh, const TetrahedraOptions& options, Session& session,
                              Json& statistics) {
    Stopwatch watch;
    session.begin("tetrahedralize", Phase::computing);
    auto made = tetrahedralize(mesh, options, session.run());
    if (!made) return made.error();
    statistics["seconds"]["tetrahedralize"] = watch.lap();
    session.begin("check tetrahedra", Phase::computing);
    const auto volumes = find_volumes(mesh, session.run());
    if (!volumes) return volumes.error();
    auto report = check_tetrahedra(made.value(), mesh, volumes.value());
    session.end_stage();
    statistics["seconds"]["check"] = watch.lap();
    auto structure = build_structure(mesh, volumes.value());
    std::vector<std::string> names;
    for (auto& block : structure.blocks) names.push_back(std::move(block.name));
    return Filled{std::move(made).value(), std::move(report), std::move(names)};
}

Status write_all(const Filled& filled, const std::vector<Output>& outputs, const FileOptions& files,
                 Session& session) {
    WriteOptions options;
    options.region_names = filled.block_names;
    for (const Output& output : outputs) {
        const auto written = write_output(filled.tetrahedra, output, options, session);
        if (!written) return written.error();
        print(summary_stream(files), output.path == "-" ? "" : "wrote " + output.path + "\n");
    }
    return Done{};
}

Result<ExitStatus> tetrahedralize_files(const TetrahedralizeCommand& command, Session& session) {
    Stopwatch total;
    const FileOptions& files = command.files;
    const auto options = options_of(command);
    if (!options) return options.error();
    const auto outputs = plan_outputs(files, OutputKind::tetrahedra);
    if (!outputs) return outputs.error();
    if (const auto sound = check_volume_options(command.settings.volume); !sound)
        return sound.error();
    auto inputs = read_inputs(files, session);
    if (!inputs) return inputs.error();
    Json statistics = statistics_of(inputs.value());

    const auto arranged = arrange_and_round(inputs.value(), command.settings, session, statistics);
    if (!arranged) return arranged.error();
    print(summary_stream(files), summary(inputs.value(), arranged.value()));
    if (!arranged.value().rounded.report.clean) {
        print(stderr, offending_pairs(inputs.value(), arranged.value(), most_pairs));
        print(stderr, "terrane: no tetrahedra without a conforming mesh; nothing written\n");
        const auto status = write_statistics(statistics, files.stats, total.lap());
        if (!status) return status.error();
        return ExitStatus::negative;
    }

    auto filled =
        fill_and_check(arranged.value().rounded.mesh, options.value(), session, statistics);
    if (!filled) return filled.error();
    if (command.settings.volume.wanted())
        filled.value().tetrahedra = without_outside(std::move(filled.value().tetrahedra));
    const TetrahedralMesh& tetrahedra = filled.value().tetrahedra;
    const TetrahedraReport& report = filled.value().report;
    add_statistics(statistics, tetrahedra, report);
    print(summary_stream(files), region_text(tetrahedra, report) + report_text(report));
    const bool good = report.violations.empty();
    if (session.stopped()) return Error{ErrorCode::interrupted, "", ""};
    Stopwatch writing;
    if (good) {
        const auto written = write_all(filled.value(), outputs.value(), files, session);
        if (!written) return written.error();
    } else {
        print(stderr, violations_text(report) + "terrane: nothing written\n");
    }
    statistics["seconds"]["write"] = writing.lap();
    const auto status = write_statistics(statistics, files.stats, total.lap());
    if (!status) return status.error();
    return good ? ExitStatus::done : ExitStatus::negative;
}

void add_tetrahedra_options(CLI::App& app, TetrahedralizeCommand& command) {
    TetrahedraOptions& options = command.options;
    app.add_option("--around", command.around,
                   "Box that closes the domain, x0,y0,z0,x1,y1,z1, around all that is kept")
        ->type_name("BOX");
    app.add_option("--margin", options.margin,
                   "Without --around: the bounding box, larger on each side by this share of its "
                   "longest edge (default: 0.1)")
        ->type_name("SHARE");
    app.add_option("--edge-length", options.edge_length,
                   "Wanted edge length, in the unit of the input (default: as few tetrahedra as "
                   "possible)")
        ->type_name("L");
    app.add_option("--quality", options.radius_edge_ratio,
                   "Largest ratio of circumradius to shortest edge, at least 1.1 (default: none)")
        ->type_name("RATIO");
    app.add_option("--time-limit", options.time_limit,
                   "For each of the ways in which TetGen is tried (default: 600)")
        ->type_name("SECONDS");
}

} // namespace

Command tetrahedralize_command(CLI::App& program) {
    auto command = std::make_shared<TetrahedralizeCommand>();
    auto* app = program.add_subcommand("tetrahedralize",
                                       "Fill the regions between the surfaces with tetrahedra");
    add_inputs(*app, command->files);
    add_output(
        *app, command->files,
        "File for the tetrahedra, .vtu .msh .inp .mesh; - is standard output; may be repeated");
    add_msh(*app, command->files);
    add_tetrahedra_options(*app, *command);
    add_settings(*app, command->settings);
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    app->footer(footer);
    return {app, [command] {
                Session session(command->files.threads);
                const auto status = tetrahedralize_files(*command, session);
                return status ? status.value() : fail(status.error());
            }};
}

#else

Command tetrahedralize_command(CLI::App& program) {
    auto* app = program.add_subcommand("tetrahedralize", "Not in this build: made without TetGen");
    app->allow_extras();
    return {app, [] {
                return fail({ErrorCode::unsupported, "this program was built without TetGen",
                             "tetrahedralize"});
            }};
}

#endif

} // namespace terrane::cli
