// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>

#include <terrane/cli/command.hpp>
#ifdef TERRANE_HAS_TETGEN
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/stopwatch.hpp>
#include <terrane/algorithms/tetrahedra.hpp>
#include <terrane/cli/pipeline.hpp>
#endif

namespace terrane::cli {

#ifdef TERRANE_HAS_TETGEN

namespace {

constexpr std::size_t most_pairs = 20;   ///< named on the terminal
constexpr std::size_t most_regions = 50; ///< listed on the terminal

struct TetrahedralizeCommand {
    FileOptions files;
    ArrangeSettings settings;
    std::string box; ///< as given
    TetrahedraOptions options;
};

constexpr auto footer =
    R"(The surfaces are arranged and rounded first, as `terrane arrange` does; where the doubles are not
a conforming mesh nothing is written, and the exit status is 1. The box closes the domain: what
touches it is the outside, each further region is a volume that the surfaces enclose. The VTU has
arrays region, surface and parent; the MSH has physical groups.

Examples:
  terrane tetrahedralize model.ml -o model.vtu
  terrane tetrahedralize faults.ts topography.ts -o model.msh --edge-length 200
  terrane tetrahedralize model.ml -o model.vtu --box 0,0,-3000,10000,10000,500)";

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
    if (command.box.empty()) return options;
    options.box = parse_box(command.box);
    if (!options.box)
        return Error{ErrorCode::bad_option, "needs six numbers: x0,y0,z0,x1,y1,z1", "--box"};
    return options;
}

struct RegionTally {
    std::size_t tetrahedra = 0;
    double volume = 0;
};

double volume_of(const TetrahedralMesh& mesh, const std::array<std::uint32_t, 4>& t) {
    const Point3& o = mesh.vertices[t[0]];
    const auto from_o = [&](std::uint32_t v) {
        const Point3& p = mesh.vertices[v];
        return Point3{p.x - o.x, p.y - o.y, p.z - o.z};
    };
    const Point3 a = from_o(t[1]), b = from_o(t[2]), c = from_o(t[3]);
    const double det = a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) +
                       a.z * (b.x * c.y - b.y * c.x);
    return det / 6;
}

std::vector<RegionTally> tally(const TetrahedralMesh& mesh) {
    std::vector<RegionTally> regions(mesh.region_count);
    for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
        RegionTally& region = regions[mesh.region_of[i]];
        ++region.tetrahedra;
        region.volume += std::abs(volume_of(mesh, mesh.tetrahedra[i]));
    }
    return regions;
}

std::string region_text(const TetrahedralMesh& mesh) {
    const auto regions = tally(mesh);
    auto text = fmt::format("{} tetrahedra, {}, {} with the outside\n", mesh.tetrahedra.size(),
                            counted(mesh.faces.size(), "face"), counted(regions.size(), "region"));
    for (std::size_t r = 0; r < std::min(regions.size(), most_regions); ++r)
        text += fmt::format("  region {:<3} {:>9} tetrahedra  volume {:.6g}{}\n", r,
                            regions[r].tetrahedra, regions[r].volume, r == 0 ? "  (outside)" : "");
    if (regions.size() > most_regions)
        text += fmt::format("  and {} more\n", regions.size() - most_regions);
    return text;
}

void add_statistics(Json& json, const TetrahedralMesh& mesh, double seconds) {
    json["output"]["volumes"] = mesh.region_count - 1;
    Json volumes = Json::array();
    for (const auto& region : tally(mesh)) volumes.push_back(region.volume);
    json["tetrahedra"] = {{"tetrahedra", mesh.tetrahedra.size()},
                          {"vertices", mesh.vertices.size()},
                          {"faces", mesh.faces.size()},
                          {"regions", mesh.region_count},
                          {"volume_of_region", volumes}};
    json["seconds"]["tetrahedralize"] = seconds;
}

/// The outputs, the statistics, the last line for people.
Result<ExitStatus> write_all(const TetrahedralMesh& mesh, const std::vector<Output>& outputs,
                             const FileOptions& files, Session& session) {
    for (const Output& output : outputs) {
        const auto written = write_output(mesh, output, session);
        if (!written) return written.error();
        print(summary_stream(files), output.path == "-" ? "" : "wrote " + output.path + "\n");
    }
    return ExitStatus::done;
}

Result<ExitStatus> tetrahedralize_files(const TetrahedralizeCommand& command, Session& session) {
    Stopwatch total;
    const FileOptions& files = command.files;
    const auto options = options_of(command);
    if (!options) return options.error();
    const auto outputs = plan_outputs(files, OutputKind::tetrahedra);
    if (!outputs) return outputs.error();
    const auto inputs = read_inputs(files, session);
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

    Stopwatch watch;
    session.begin("tetrahedralize", Phase::computing);
    const auto mesh = tetrahedralize(arranged.value().rounded.mesh, options.value(), session.run());
    session.end_stage();
    if (!mesh) return mesh.error();
    add_statistics(statistics, mesh.value(), watch.lap());
    print(summary_stream(files), region_text(mesh.value()));
    const auto written = write_all(mesh.value(), outputs.value(), files, session);
    if (!written) return written.error();
    statistics["seconds"]["write"] = watch.lap();
    const auto status = write_statistics(statistics, files.stats, total.lap());
    if (!status) return status.error();
    return ExitStatus::done;
}

void add_tetrahedra_options(CLI::App& app, TetrahedralizeCommand& command) {
    TetrahedraOptions& options = command.options;
    app.add_option("--box", command.box,
                   "Box that closes the domain, x0,y0,z0,x1,y1,z1, around all surfaces")
        ->type_name("BOX");
    app.add_option("--margin", options.margin,
                   "Without --box: the bounding box, larger on each side by this share of its "
                   "longest edge (default: 0.1)")
        ->type_name("SHARE");
    app.add_option("--edge-length", options.edge_length,
                   "Wanted edge length, in the unit of the input (default: as few tetrahedra as "
                   "possible)")
        ->type_name("L");
    app.add_option("--quality", options.radius_edge_ratio,
                   "Largest ratio of circumradius to shortest edge, at least 1.1 (default: none)")
        ->type_name("RATIO");
}

} // namespace

Command tetrahedralize_command(CLI::App& program) {
    auto command = std::make_shared<TetrahedralizeCommand>();
    auto* app = program.add_subcommand("tetrahedralize",
                                       "Fill the regions between the surfaces with tetrahedra");
    add_inputs(*app, command->files);
    add_output(*app, command->files, "File for the tetrahedra, .vtu or .msh; - is standard output");
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
