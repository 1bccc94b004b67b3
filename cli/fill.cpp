// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include <terrane/algorithms/check.hpp>
#include <terrane/algorithms/fill_kriging.hpp>
#include <terrane/algorithms/join.hpp>
#include <terrane/algorithms/rbf.hpp>
#include <terrane/algorithms/stopwatch.hpp>
#include <terrane/cli/command.hpp>
#include <terrane/cli/files.hpp>
#include <terrane/cli/fill_map.hpp>
#include <terrane/cli/statistics.hpp>
#include <terrane/io/atomic_file.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_listed = 30;   ///< holes on the terminal
constexpr std::size_t most_contacts = 10; ///< the same
constexpr const char* default_holes = "all";

struct FillCommand {
    FileOptions files;
    std::string method = "kriging";
    std::string model = "auto";
    std::string holes = default_holes;
    double max_area = HUGE_VAL;
    double mesh_size = 0;
    std::size_t rings = KrigingOptions{}.rings;
    double gap_slope = GapRule{}.slope;
    bool isotropic = false;
    bool bridge = false;
    bool list = false;
    std::string map;    ///< empty: none
    std::string points; ///< empty: none
};

constexpr auto footer =
    R"(Holes are the borders of a surface other than the one round it. A hole whose sides face each other
with a throw is a gap torn by a fault; gaps are left open unless --bridge-faults. --list says what
there is, by the numbers that --holes takes.

kriging needs a surface that is z = f(x, y) round the hole; it foresees its error. rbf (the zero level
of a radial basis function through points round the hole) takes any surface, folds too. The surface keeps all its vertices and
triangles; new ones come after them and share the border's vertices. Where new triangles would cross
others, nothing is written. VTP gets arrays invented (the number of the hole, 0 for what was given)
and deviation (the expected error, mean of the corners). A hole that can't be filled is named and
left open, and the exit status is 1.

Examples:
  terrane fill top.irap --list
  terrane fill --depth top.irap -o top.vtp --map top.svg
  terrane fill horizons.ts -o filled.ts --holes 1,3 --points invented.csv
  terrane fill fold.obj -o filled.obj --method rbf)";

/// A hole and where it is from.
struct NumberedHole {
    std::size_t number = 0; ///< from 1, through all surfaces
    std::size_t surface = 0;
    const BorderLoop* loop = nullptr;
    std::optional<FillReport> report{}; ///< where it was filled
    std::string refused{};              ///< why it was not
};

/// A surface as it becomes.
struct Progress {
    Surface filled;
    std::vector<double> deviation;      ///< per vertex; 0 for what was given
    std::vector<std::int32_t> invented; ///< per triangle: number of the hole, or 0
};

struct Work {
    Inputs inputs;
    std::vector<std::vector<BorderLoop>> loops; ///< per surface
    std::vector<NumberedHole> holes;            ///< by number
    std::vector<Progress> surfaces;
};

// ---- Which holes
// ---------------------------------------------------------------------------------

Result<std::vector<std::vector<BorderLoop>>> find_loops(const Inputs& inputs, double slope,
                                                        Session& session) {
    std::vector<std::vector<BorderLoop>> result;
    session.begin("holes", Phase::computing);
    for (const Surface& s : inputs.surfaces) {
        auto loops = find_border_loops(s, session.run(), {.slope = slope});
        if (!loops) return loops.error();
        result.push_back(std::move(loops).value());
    }
    session.end_stage();
    return result;
}

std::vector<NumberedHole> number_holes(const std::vector<std::vector<BorderLoop>>& loops) {
    std::vector<NumberedHole> holes;
    for (std::size_t s = 0; s < loops.size(); ++s)
        for (const BorderLoop& loop : loops[s])
            if (loop.kind != LoopKind::outer) holes.push_back({holes.size() + 1, s, &loop});
    return holes;
}

/// Per hole, whether it is to be filled.
Result<std::vector<bool>> chosen_holes(const FillCommand& command,
                                       const std::vector<NumberedHole>& holes) {
    const bool all = command.holes == default_holes;
    std::vector<bool> chosen(holes.size(), all);
    std::string_view rest = all ? std::string_view() : command.holes;
    while (!rest.empty()) {
        const auto token = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(token.size() + 1, rest.size()));
        std::size_t number = 0;
        for (const char c : token)
            number = c >= '0' && c <= '9' && number <= holes.size()
                         ? 10 * number + static_cast<std::size_t>(c - '0')
                         : holes.size() + 1;
        if (number < 1 || number > holes.size())
            return Error{
                ErrorCode::bad_option,
                fmt::format("there is no hole {}, only 1 to {}: see --list", token, holes.size()),
                "--holes"};
        chosen[number - 1] = true;
    }
    for (std::size_t i = 0; i < holes.size(); ++i) {
        const BorderLoop& loop = *holes[i].loop;
        if (loop.area > command.max_area || (loop.kind == LoopKind::fault_gap && !command.bridge))
            chosen[i] = false;
    }
    return chosen;
}

std::string listed(const Work& work) {
    std::string text;
    for (std::size_t s = 0; s < work.inputs.surfaces.size(); ++s) {
        std::map<LoopKind, std::size_t> kinds;
        for (const BorderLoop& loop : work.loops[s]) ++kinds[loop.kind];
        text += fmt::format("{}: {}, {}, {}\n", work.inputs.labels[s],
                            counted(kinds[LoopKind::outer], "outer border"),
                            counted(kinds[LoopKind::hole], "hole"),
                            counted(kinds[LoopKind::fault_gap], "fault gap"));
    }
    return text;
}

std::string table_of(const Work& work) {
    if (work.holes.empty()) return {};
    std::string text =
        fmt::format("{:>6}  {:<10} {:>8} {:>12} {:>12} {:>10} {:>10}  {}\n", "hole", "kind",
                    "border", "length", "area", "width", "throw", "centre, surface");
    for (const NumberedHole& hole : work.holes) {
        const BorderLoop& loop = *hole.loop;
        text += fmt::format("{:>6}  {:<10} {:>8} {:>12.6g} {:>12.6g} {:>10.4g} {:>10.4g}  "
                            "({:.8g}, {:.8g}, {:.6g}) {}\n",
                            hole.number, loop.kind == LoopKind::hole ? "hole" : "fault gap",
                            loop.vertices.size(), loop.length, loop.area, loop.width,
                            loop.fault_throw, loop.centre.x, loop.centre.y, loop.centre.z,
                            work.inputs.labels[hole.surface]);
    }
    return text;
}

// ---- Filling
// -------------------------------------------------------------------------------------

/// A surface with one hole filled, and the expected errors of its new vertices.
struct Filled {
    Surface surface;
    std::vector<double> deviation; ///< per vertex after those of the surface with the hole
    FillReport report;
};

Result<Filled> by_kriging(const FillCommand& command, const Surface& surface,
                          const BorderLoop& loop, std::span<const BorderLoop> loops,
                          const Run& run) {
    static const std::map<std::string, VariogramModel> models{
        {"spherical", VariogramModel::spherical},
        {"exponential", VariogramModel::exponential},
        {"gaussian", VariogramModel::gaussian},
        {"power", VariogramModel::power}};
    KrigingOptions options{.mesh_size = command.mesh_size, .rings = command.rings, .loops = loops};
    if (const auto model = models.find(command.model); model != models.end())
        options.variogram.model = model->second;
    options.variogram.anisotropy = !command.isotropic;
    auto filling = fill_by_kriging(surface, loop, options, run);
    if (!filling) return filling.error();
    Filled filled;
    filled.surface = joined(surface, filling.value());
    filled.report = std::move(filling.value().report);
    const auto border = filling.value().surface.vertices.size() - filled.report.invented;
    filled.deviation.assign(filling.value().deviation.begin() + static_cast<std::ptrdiff_t>(border),
                            filling.value().deviation.end());
    return filled;
}

/// The surface that RBF gives goes beyond the border and is joined.
Result<Filled> by_rbf(const FillCommand& command, const Surface& surface, const BorderLoop& loop,
                      std::span<const BorderLoop> loops, const Run& run) {
    const auto filling =
        fill_by_rbf(surface, loop, {.size = command.mesh_size, .loops = loops}, run);
    if (!filling) return filling.error();
    auto made = join_filling(surface, loop, filling.value().surface, {.loops = loops}, run);
    if (!made) return made.error();
    Filled filled;
    filled.report = filling.value().report;
    filled.report.invented = made.value().report.new_vertices;
    filled.report.area = made.value().report.area;
    for (const auto v : made.value().filling_vertices)
        filled.deviation.push_back(filling.value().deviation[v]);
    filled.surface = std::move(made.value().surface);
    return filled;
}

/// Takes over what is new in `filled`, made from the surface as it was read.
void append(const Surface& given, const Filled& filled, std::size_t number, Progress& progress) {
    const auto old = static_cast<std::uint32_t>(given.vertices.size());
    const auto shift = static_cast<std::uint32_t>(progress.filled.vertices.size()) - old;
    const auto& s = filled.surface;
    progress.filled.vertices.insert(progress.filled.vertices.end(), s.vertices.begin() + old,
                                    s.vertices.end());
    progress.deviation.insert(progress.deviation.end(), filled.deviation.begin(),
                              filled.deviation.end());
    for (auto t = given.triangles.size(); t < s.triangles.size(); ++t) {
        Triangle corners = s.triangles[t];
        for (auto& v : corners)
            if (v >= old) v += shift;
        progress.filled.triangles.push_back(corners);
        progress.invented.push_back(static_cast<std::int32_t>(number));
    }
}

/// A hole that can't be filled is no reason to leave the others.
bool only_this_hole(ErrorCode code) {
    return code != ErrorCode::interrupted && code != ErrorCode::out_of_memory &&
           code != ErrorCode::bad_option && code != ErrorCode::internal;
}

Status fill_holes(const FillCommand& command, const std::vector<bool>& chosen, Work& work,
                  Session& session) {
    for (const Surface& s : work.inputs.surfaces)
        work.surfaces.push_back({s, std::vector<double>(s.vertices.size()),
                                 std::vector<std::int32_t>(s.triangles.size())});
    for (std::size_t i = 0; i < work.holes.size(); ++i) {
        if (!chosen[i]) continue;
        NumberedHole& hole = work.holes[i];
        const Surface& given = work.inputs.surfaces[hole.surface];
        session.begin(fmt::format("fill hole {}", hole.number), Phase::computing);
        const auto filled =
            command.method == "rbf"
                ? by_rbf(command, given, *hole.loop, work.loops[hole.surface], session.run())
                : by_kriging(command, given, *hole.loop, work.loops[hole.surface], session.run());
        session.end_stage();
        if (filled) {
            hole.report = filled.value().report;
            append(given, filled.value(), hole.number, work.surfaces[hole.surface]);
        } else if (only_this_hole(filled.error().code)) {
            hole.refused = filled.error().message();
        } else {
            return filled.error();
        }
    }
    return Done{};
}

/// Contacts that new triangles make, by exact check; at most `most` in words.
Result<std::string> contacts_of_new(const Work& work, std::size_t most, Session& session) {
    std::string text;
    std::size_t count = 0;
    for (std::size_t s = 0; s < work.surfaces.size(); ++s) {
        const Progress& progress = work.surfaces[s];
        const auto old = work.inputs.surfaces[s].triangles.size();
        if (progress.filled.triangles.size() == old) continue;
        session.begin("check", Phase::computing);
        const auto report = check(std::span(&progress.filled, 1), session.run());
        session.end_stage();
        if (!report) return report.error();
        for (const ImproperContact& c : report.value().contacts) {
            const auto newer = std::max(c.triangles[0], c.triangles[1]);
            if (newer < old || count++ >= most) continue;
            text += fmt::format("  {}, hole {}: {} at {}\n", work.inputs.labels[s],
                                progress.invented[newer], name_of(c.kind), text_of(c.place));
        }
    }
    if (count > most) text += fmt::format("  and {} more\n", count - most);
    return text;
}

// ---- What is said and written
// --------------------------------------------------------------------

/// What the method itself expects; else what it misses of data that are left out.
std::string error_text(const FillReport& r) {
    if (std::isfinite(r.expected_error))
        return fmt::format("expected error {:.4g}", r.expected_error);
    if (std::isfinite(r.validated_error))
        return fmt::format("error {:.4g} at data left out", r.validated_error);
    return "error not known";
}

std::string filled_text(const Work& work) {
    std::string text;
    std::size_t shown = 0, filled = 0, points = 0;
    double area = 0;
    for (const NumberedHole& hole : work.holes) {
        if (!hole.report) continue;
        const FillReport& r = *hole.report;
        ++filled;
        points += r.invented;
        area += r.area;
        if (shown++ >= most_listed) continue;
        text += fmt::format("hole {}: {} and area {:.6g} invented, {}, from {}\n  {}\n",
                            hole.number, counted(r.invented, "point"), r.area, error_text(r),
                            counted(r.data, "point"), r.model);
    }
    if (shown > most_listed) text += fmt::format("and {} more\n", shown - most_listed);
    text += fmt::format("filled {} of {}: {} and area {:.6g} invented\n", filled,
                        counted(work.holes.size(), "hole"), counted(points, "point"), area);
    return text;
}

Json json_of(const Work& work) {
    Json list = Json::array();
    for (const NumberedHole& hole : work.holes) {
        const BorderLoop& loop = *hole.loop;
        const auto known = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
        Json entry{{"hole", hole.number},
                   {"surface", work.inputs.labels[hole.surface]},
                   {"kind", loop.kind == LoopKind::hole ? "hole" : "fault gap"},
                   {"border", loop.vertices.size()},
                   {"length", loop.length},
                   {"area", loop.area},
                   {"width", loop.width},
                   {"throw", loop.fault_throw},
                   {"centre", {loop.centre.x, loop.centre.y, loop.centre.z}}};
        if (hole.report)
            entry["filled"] = {{"points", hole.report->invented},
                               {"area", hole.report->area},
                               {"data", hole.report->data},
                               {"expected_error", known(hole.report->expected_error)},
                               {"validated_error", known(hole.report->validated_error)},
                               {"model", hole.report->model}};
        if (!hole.refused.empty()) entry["refused"] = hole.refused;
        list.push_back(std::move(entry));
    }
    return list;
}

/// Invented points with their expected errors.
std::string csv_of(const Work& work) {
    std::string text = "x,y,z,deviation,variance,surface\n";
    for (std::size_t s = 0; s < work.surfaces.size(); ++s) {
        const Progress& p = work.surfaces[s];
        std::string name = work.inputs.labels[s];
        std::replace(name.begin(), name.end(), '"', '\'');
        for (auto v = work.inputs.surfaces[s].vertices.size(); v < p.filled.vertices.size(); ++v) {
            const Point3& q = p.filled.vertices[v];
            const double d = p.deviation[v];
            const auto errors =
                std::isfinite(d) ? fmt::format("{:.6g},{:.6g}", d, d * d) : std::string(",");
            text += fmt::format("{},{},{},{},\"{}\"\n", q.x, q.y, q.z, errors, name);
        }
    }
    return text;
}

Status write_map(const FillCommand& command, const Work& work) {
    std::vector<FillMap> maps;
    for (std::size_t s = 0; s < work.surfaces.size(); ++s)
        maps.push_back({work.inputs.labels[s], &work.inputs.surfaces[s], &work.surfaces[s].filled,
                        work.surfaces[s].deviation, work.loops[s]});
    return write_file(command.map, svg_of(maps));
}

Status write_all(const FillCommand& command, const std::vector<Output>& outputs, const Work& work,
                 Session& session) {
    std::vector<Surface> surfaces;
    std::vector<std::int32_t> invented;
    std::vector<double> deviation;
    for (const Progress& p : work.surfaces) {
        surfaces.push_back(p.filled);
        invented.insert(invented.end(), p.invented.begin(), p.invented.end());
        for (const Triangle& t : p.filled.triangles)
            deviation.push_back((p.deviation[t[0]] + p.deviation[t[1]] + p.deviation[t[2]]) / 3);
    }
    const Mesh mesh = concatenate(surfaces);
    const std::vector<CellArray> cells{{"invented", invented}, {"deviation", deviation}};
    for (const Output& output : outputs) {
        WriteOptions options{.ascii = command.files.ascii};
        if (output.format == Format::vtp) options.cells = cells;
        if (const auto written = write_output(mesh, output, options, session); !written)
            return written.error();
        print(summary_stream(command.files),
              output.path == "-" ? "" : "wrote " + output.path + "\n");
    }
    if (!command.map.empty())
        if (const auto written = write_map(command, work); !written) return written;
    if (!command.points.empty())
        if (const auto written = write_file(command.points, csv_of(work)); !written) return written;
    return Done{};
}

Result<std::vector<Output>> plan(const FillCommand& command) {
    auto outputs = plan_outputs(command.files, OutputKind::surfaces);
    if (!outputs) return outputs;
    if (outputs.value().empty() && !command.list)
        return Error{ErrorCode::bad_option, "-o OUT is needed, or --list", ""};
    for (const auto& path : {command.map, command.points})
        if (!path.empty())
            if (const auto folder = check_folder(path); !folder) return folder.error();
    return outputs;
}

Result<ExitStatus> fill_files(const FillCommand& command, Session& session) {
    Stopwatch total;
    const auto outputs = plan(command);
    if (!outputs) return outputs.error();
    auto inputs = read_inputs(command.files, session);
    if (!inputs) return inputs.error();
    Work work;
    work.inputs = std::move(inputs).value();
    auto loops = find_loops(work.inputs, command.gap_slope, session);
    if (!loops) return loops.error();
    work.loops = std::move(loops).value();
    work.holes = number_holes(work.loops);
    const auto stream = summary_stream(command.files);
    print(stream, listed(work) + (command.list ? table_of(work) : ""));
    Json statistics = statistics_of(work.inputs);
    bool whole = true;
    if (!command.list) {
        const auto chosen = chosen_holes(command, work.holes);
        if (!chosen) return chosen.error();
        if (const auto done = fill_holes(command, chosen.value(), work, session); !done)
            return done.error();
        print(stream, filled_text(work));
        for (const NumberedHole& hole : work.holes)
            if (!hole.refused.empty()) {
                whole = false;
                print(stderr, fmt::format("terrane: hole {} of {} is left open: {}\n", hole.number,
                                          work.inputs.labels[hole.surface], hole.refused));
            }
        const auto contacts = contacts_of_new(work, most_contacts, session);
        if (!contacts) return contacts.error();
        if (!contacts.value().empty()) {
            print(stderr, "terrane: nothing written: what was invented meets other triangles\n" +
                              contacts.value());
            return ExitStatus::negative;
        }
        if (const auto done = write_all(command, outputs.value(), work, session); !done)
            return done.error();
    }
    statistics["holes"] = json_of(work);
    if (const auto done = write_statistics(statistics, command.files.stats, total.lap()); !done)
        return done.error();
    return whole ? ExitStatus::done : ExitStatus::negative;
}

void add_choice(CLI::App& app, FillCommand& command) {
    app.add_option("--holes", command.holes,
                   "Which ones, by the numbers of --list: all, or N,N,... (default: all)")
        ->type_name("LIST");
    app.add_option("--max-area", command.max_area, "Leave larger holes open")
        ->check(CLI::PositiveNumber.description(""))
        ->type_name("AREA");
    app.add_flag("--bridge-faults", command.bridge, "Fill gaps that a fault has torn as well");
    app.add_option("--gap-slope", command.gap_slope,
                   "A throw of so many widths makes a hole a gap (default: 0.25)")
        ->check(CLI::PositiveNumber.description(""))
        ->type_name("S");
    app.add_flag("--list", command.list, "Say which holes there are, and fill none");
}

void add_method(CLI::App& app, FillCommand& command) {
    app.add_option("--method", command.method,
                   "kriging, for z = f(x, y), or rbf, for any surface (default: kriging)")
        ->check(CLI::IsMember({"kriging", "rbf"}).description(""))
        ->type_name("METHOD");
    app.add_option(
           "--model", command.model,
           "Of the variogram: auto, spherical, exponential, gaussian, power (default: auto, "
           "what fits best)")
        ->check(CLI::IsMember({"auto", "spherical", "exponential", "gaussian", "power"})
                    .description(""))
        ->type_name("MODEL");
    app.add_flag("--isotropic", command.isotropic, "The variogram is the same in all directions");
    app.add_option("--mesh-size", command.mesh_size,
                   "Edges of the filling (default: the median edge of the hole's border)")
        ->check(CLI::PositiveNumber.description(""))
        ->type_name("LENGTH");
    app.add_option("--rings", command.rings,
                   "Rings of triangles round the hole that are data (default: 5)")
        ->check(CLI::Range(1U, 1000U).description(""))
        ->type_name("N");
}

} // namespace

Command fill_command(CLI::App& program) {
    auto options = std::make_shared<FillCommand>();
    auto* app =
        program.add_subcommand("fill", "Fill the holes of surfaces, and say how sure it is");
    add_inputs(*app, options->files);
    add_output(*app, options->files, "File for the surfaces; - is standard output");
    app->get_option("--output")->required(false);
    add_method(*app, *options);
    add_choice(*app, *options);
    app->add_option("--map", options->map, "Draw it before and after, and the expected error")
        ->type_name("FILE.svg");
    app->add_option("--points", options->points,
                    "Write invented points with deviation and variance")
        ->type_name("FILE.csv");
    app->add_flag("--ascii", options->files.ascii, "STL as text, with doubles, not float32");
    add_msh(*app, options->files);
    add_threads(*app, options->files);
    add_stats(*app, options->files);
    app->footer(footer);
    return {app, [options] {
                Session session(options->files.threads);
                const auto status = fill_files(*options, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
