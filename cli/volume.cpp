// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include <terrane/algorithms/stopwatch.hpp>
#include <terrane/algorithms/structure_meshes.hpp>
#include <terrane/cli/command.hpp>
#include <terrane/cli/pipeline.hpp>
#include <terrane/io/atomic_file.hpp>
#include <terrane/io/atomic_folder.hpp>
#include <terrane/io/structure_json.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_pairs = 20;  ///< named on the terminal
constexpr std::size_t most_blocks = 50; ///< listed on the terminal
constexpr std::size_t most_leaks = 20;

struct VolumeCommand {
    FileOptions files;
    ArrangeSettings settings;
    std::string folder;
    std::vector<std::string> roles; ///< NAME=ROLE
    std::string part_format = "vtp";
};

constexpr auto footer =
    R"(The surfaces are arranged and rounded first, as `terrane arrange` does; where the doubles are not
a conforming mesh nothing is written, and the exit status is 1. Blocks are the volumes that the
surfaces enclose, 1, 2, ...; 0 is the outside. DIR must not exist, or be empty. It gets

  model.json         blocks, interfaces, lines, corners, free borders and leaks
  result.vtp         the whole mesh; arrays volume_front, volume_back, interface, patch
  blocks/            the closed boundary of each block, wound outward
  interfaces/        what lies between the same two blocks and in the same surfaces

Neighbours have the same vertices, to the last bit. Open surfaces are no error: they dangle, and the
summary says which, and how far their free borders are from other surfaces.

--seal D closes gaps: free borders that end short of another surface by at most D are extended onto it,
those that reach beyond by at most D are trimmed. Every change is listed, and is in model.json.

With a volume of interest (--box, --rotated-box, --polygon, --within) all surfaces are cut by its
boundary, exactly, the inside is kept, and the boundary closes it: its faces are surfaces of their
own, "boundary top", "boundary side 1", ... --extend D extends horizons that end inside.
Examples:
  terrane volume model.ml -o model  terrane volume model.ml -o model --seal 0.01
  terrane volume horizons.ts faults.ts -o model --box 0,0,-3000,10000,10000,500
  terrane volume *.ts -o model --polygon licence.txt --between -4000,0
  terrane volume top.ts base.ts F1.ts box.ts -o model --role F1=fault --role box=boundary)";

Status set_role(const std::string& text, Inputs& inputs) {
    static const std::map<std::string, Role> roles{
        {"horizon", Role::horizon}, {"fault", Role::fault}, {"boundary", Role::boundary}};
    const auto at = text.rfind('=');
    const auto role = at == std::string::npos ? roles.end() : roles.find(text.substr(at + 1));
    if (role == roles.end())
        return Error{ErrorCode::bad_option,
                     "needs NAME=ROLE, with horizon, fault or boundary: " + text, "--role"};
    const std::string name = text.substr(0, at);
    bool found = false;
    for (std::size_t s = 0; s < inputs.surfaces.size(); ++s) {
        if (inputs.surfaces[s].name != name && inputs.labels[s] != name) continue;
        inputs.surfaces[s].role = role->second;
        found = true;
    }
    if (found) return Done{};
    return Error{ErrorCode::bad_option, "no surface is called " + name, "--role"};
}

/// All that is known of the model, by numbers of the exact blocks.
struct Model {
    Volumes exact;   ///< of the exact arrangement
    Volumes volumes; ///< of the mesh, with the numbers of the exact ones
    Structure structure;
    std::vector<FreeBorder> borders;
    std::size_t lost = 0; ///< exact blocks that the mesh does not have
    std::size_t made = 0; ///< blocks of the mesh that are no exact ones
};

Result<Model> make_model(const Arranged& arranged, Session& session, Json& statistics) {
    Stopwatch watch;
    const Mesh& mesh = arranged.rounded.mesh;
    session.begin("volumes", Phase::computing);
    auto exact = find_volumes(arranged.exact, session.run());
    if (!exact) return exact.error();
    auto rounded = find_volumes(mesh, session.run());
    if (!rounded) return rounded.error();
    const auto match = match_volumes(arranged.exact, exact.value(), mesh, rounded.value());
    Model model;
    model.exact = std::move(exact).value();
    model.made = static_cast<std::size_t>(std::count(match.begin(), match.end(), UINT32_MAX));
    model.lost = model.exact.measures.size() - (match.size() - model.made);
    model.volumes = renumbered(rounded.value(), match, model.exact.measures.size());
    statistics["seconds"]["volumes"] = watch.lap();
    model.structure = build_structure(mesh, model.volumes);
    model.borders = find_free_borders(mesh, model.structure);
    statistics["seconds"]["structure"] = watch.lap();
    session.end_stage();
    if (session.stopped()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    return model;
}

// ---- What is said
// --------------------------------------------------------------------------------

std::string blocks_text(const Model& model) {
    const auto& blocks = model.structure.blocks;
    const std::size_t count = model.exact.block_count();
    auto text = fmt::format("{}, volume {:.9g} in all\n", counted(count, "closed block"),
                            model.exact.measures[0]);
    for (std::size_t b = 1; b <= std::min(count, most_blocks); ++b)
        text +=
            fmt::format("  block {:<4} volume {:<14.9g} {}\n", b, model.exact.measures[b],
                        blocks[b].interfaces.empty() ? "(too thin for doubles)" : blocks[b].name);
    if (count > most_blocks) text += fmt::format("  and {} more\n", count - most_blocks);
    if (model.lost > 0)
        text +=
            fmt::format("doubles: {} too thin, and not written\n", counted(model.lost, "block"));
    if (model.made > 0)
        text += fmt::format("doubles: {} that the exact surfaces do not enclose\n",
                            counted(model.made, "block"));
    return text;
}

std::string structure_text(const Model& model) {
    const Structure& s = model.structure;
    std::map<LineKind, std::size_t> kinds;
    for (const ModelLine& line : s.lines) ++kinds[line.kind];
    std::string lines;
    for (const auto& [kind, count] : kinds)
        lines += fmt::format("{}{}", lines.empty() ? "" : ", ",
                             counted(count, std::string(name_of(kind))));
    return fmt::format("{}, {}, {}{}\n", counted(s.interfaces.size(), "interface"),
                       s.patches.size() == 1 ? "1 patch"
                                             : fmt::format("{} patches", s.patches.size()),
                       counted(s.corners.size(), "corner"), lines.empty() ? "" : ", " + lines);
}

/// Surfaces of which a part has the same volume on both sides.
std::string dangling_text(const Inputs& inputs, const Model& model) {
    std::vector<double> area(inputs.surfaces.size()), dangling(inputs.surfaces.size()),
        border(inputs.surfaces.size());
    for (const ModelInterface& i : model.structure.interfaces)
        for (const std::uint32_t s : i.surfaces) {
            area[s] += i.area;
            if (i.dangles()) dangling[s] += i.area;
        }
    for (const FreeBorder& b : model.borders)
        for (const std::uint32_t s : b.surfaces) border[s] += b.length;
    std::string text;
    for (std::size_t s = 0; s < area.size(); ++s)
        if (dangling[s] > 0)
            text += fmt::format("  {}: {:.3g} of {:.3g} in area dangles, free border {:.3g}\n",
                                inputs.labels[s], dangling[s], area[s], border[s]);
    return text.empty() ? "no surface dangles\n" : "surfaces that dangle:\n" + text;
}

/// Where surfaces end near others, the smallest gaps first.
std::string leaks_text(const Inputs& inputs, const Model& model) {
    const auto leaks = leaks_of(model.borders);
    if (leaks.empty()) return {};
    std::string text = "free borders, by the surface nearest to them and how far it is:\n";
    for (std::size_t i = 0; i < std::min(leaks.size(), most_leaks); ++i) {
        const Leak& l = leaks[i];
        text += fmt::format("  {} ends by {}: along {:.4g}, {:.2g} to {:.2g} apart, most at {}\n",
                            inputs.labels[l.from], inputs.labels[l.to], l.length, l.least,
                            l.largest, text_of(l.place));
    }
    if (leaks.size() > most_leaks)
        text += fmt::format("  and {} more, farther apart\n", leaks.size() - most_leaks);
    return text;
}

void add_statistics(Json& json, const Model& model) {
    json["output"]["volumes"] = model.exact.block_count();
    Json volumes = Json::array();
    for (std::size_t b = 1; b < model.exact.measures.size(); ++b)
        volumes.push_back(model.exact.measures[b]);
    const Structure& s = model.structure;
    json["volumes"] = {{"all", model.exact.measures[0]},
                       {"blocks", volumes},
                       {"too_thin", model.lost},
                       {"made_by_rounding", model.made},
                       {"interfaces", s.interfaces.size()},
                       {"patches", s.patches.size()},
                       {"lines", s.lines.size()},
                       {"corners", s.corners.size()},
                       {"free_borders", model.borders.size()}};
}

// ---- What is written
// -----------------------------------------------------------------------------

std::vector<std::int32_t> as_cells(const std::vector<std::uint32_t>& values) {
    return {values.begin(), values.end()};
}

/// One column of the sides.
std::vector<std::int32_t> side_cells(const Volumes& volumes, std::size_t side) {
    std::vector<std::int32_t> values;
    for (const auto& sides : volumes.of_sides)
        values.push_back(static_cast<std::int32_t>(sides[side]));
    return values;
}

class FolderWriter {
public:
    FolderWriter(const Mesh& mesh, const Model& model, const VolumeCommand& command,
                 const std::filesystem::path& folder, const std::optional<SealReport>& sealed) :
        mesh_(mesh),
        model_(model), command_(command), folder_(folder) {
        if (!sealed) return;
        extras_.seal_distance = sealed->distance;
        extras_.seal_changes = sealed->changes;
    }

    Status operator()(const Session& session) {
        for (const char* inner : {"blocks", "interfaces"}) {
            std::error_code failed;
            std::filesystem::create_directory(folder_ / inner, failed);
            if (failed)
                return Error{ErrorCode::cannot_open, "cannot be made: " + failed.message(),
                             (folder_ / inner).string()};
        }
        if (auto done = write_result(); !done) return done;
        const Structure& s = model_.structure;
        extras_.block_files.resize(s.blocks.size());
        for (std::uint32_t b = 1; b < s.blocks.size(); ++b) {
            if (session.stopped()) return Error{ErrorCode::interrupted, "stopped on request", ""};
            if (s.blocks[b].interfaces.empty()) continue;
            extras_.block_files[b] = name("blocks/block_", b);
            const auto part = block_part(mesh_, model_.volumes, s, b);
            if (auto done = write_part(part, extras_.block_files[b]); !done) return done;
        }
        for (std::uint32_t i = 0; i < s.interfaces.size(); ++i) {
            if (session.stopped()) return Error{ErrorCode::interrupted, "stopped on request", ""};
            extras_.interface_files.push_back(name("interfaces/interface_", i));
            const auto part = interface_part(mesh_, model_.volumes, s, i);
            if (auto done = write_part(part, extras_.interface_files[i]); !done) return done;
        }
        return write_json();
    }

private:
    [[nodiscard]] std::string name(const char* start, std::uint32_t number) const {
        return fmt::format("{}{}.{}", start, number, command_.part_format);
    }

    Status write_result() {
        const std::vector<CellArray> cells{{"volume_front", side_cells(model_.volumes, 0)},
                                           {"volume_back", side_cells(model_.volumes, 1)},
                                           {"interface", as_cells(model_.structure.interface_of)},
                                           {"patch", as_cells(model_.structure.patch_of)}};
        WriteOptions options;
        options.cells = cells;
        return write_mesh(mesh_, folder_ / "result.vtp", options);
    }

    Status write_part(const MeshPart& part, const std::string& file) {
        std::vector<std::uint32_t> interfaces, patches;
        for (const std::uint32_t t : part.triangles) {
            interfaces.push_back(model_.structure.interface_of[t]);
            patches.push_back(model_.structure.patch_of[t]);
        }
        const std::vector<CellArray> cells{{"triangle", as_cells(part.triangles)},
                                           {"interface", as_cells(interfaces)},
                                           {"patch", as_cells(patches)}};
        WriteOptions options;
        if (command_.part_format == "vtp") options.cells = cells;
        return write_mesh(part.mesh, folder_ / file, options);
    }

    Status write_json() {
        extras_.exact_volumes = model_.exact.measures;
        extras_.exact_volumes.resize(model_.structure.blocks.size(),
                                     std::numeric_limits<double>::quiet_NaN());
        extras_.free_borders = model_.borders;
        return write_file(folder_ / "model.json", to_json(mesh_, model_.structure, extras_));
    }

    const Mesh& mesh_;
    const Model& model_;
    const VolumeCommand& command_;
    const std::filesystem::path& folder_;
    StructureExtras extras_;
};

Status write_folder(const VolumeCommand& command, const Arranged& arranged, const Model& model,
                    Session& session) {
    session.begin("write", Phase::computing);
    auto folder = NewFolder::create(command.folder);
    if (!folder) return folder.error();
    FolderWriter writer(arranged.rounded.mesh, model, command, folder.value().temporary(),
                        arranged.sealed);
    if (auto done = writer(session); !done) return done;
    auto published = folder.value().publish();
    session.end_stage();
    return published;
}

Result<ExitStatus> find_blocks(const VolumeCommand& command, Session& session) {
    Stopwatch total;
    const FileOptions& files = command.files;
    if (const auto planned = plan_outputs(files, OutputKind::surfaces); !planned)
        return planned.error();
    if (const auto good = check_new_folder(command.folder); !good) return good.error();
    if (const auto sound = check_volume_options(command.settings.volume); !sound)
        return sound.error();
    auto inputs = read_inputs(files, session);
    if (!inputs) return inputs.error();
    for (const std::string& role : command.roles)
        if (const auto set = set_role(role, inputs.value()); !set) return set.error();
    Json statistics = statistics_of(inputs.value());

    const auto arranged = arrange_and_round(inputs.value(), command.settings, session, statistics);
    if (!arranged) return arranged.error();
    print(summary_stream(files), summary(inputs.value(), arranged.value()));
    const bool clean = arranged.value().rounded.report.clean;
    if (!clean) {
        print(stderr, offending_pairs(inputs.value(), arranged.value(), most_pairs));
        print(stderr, "terrane: no blocks without a conforming mesh; nothing written\n");
    } else {
        const auto model = make_model(arranged.value(), session, statistics);
        if (!model) return model.error();
        add_statistics(statistics, model.value());
        print(summary_stream(files), blocks_text(model.value()) + structure_text(model.value()) +
                                         dangling_text(inputs.value(), model.value()) +
                                         leaks_text(inputs.value(), model.value()));
        Stopwatch writing;
        const auto written = write_folder(command, arranged.value(), model.value(), session);
        if (!written) return written.error();
        print(summary_stream(files), "wrote " + command.folder + "\n");
        statistics["seconds"]["write"] = writing.lap();
    }
    const auto status = write_statistics(statistics, files.stats, total.lap());
    if (!status) return status.error();
    return clean ? ExitStatus::done : ExitStatus::negative;
}

} // namespace

Command volume_command(CLI::App& program) {
    auto command = std::make_shared<VolumeCommand>();
    auto* app = program.add_subcommand("volume", "Find the blocks that surfaces enclose");
    add_inputs(*app, command->files);
    app->add_option("-o,--output", command->folder, "Folder for the model; made by the program")
        ->required()
        ->type_name("DIR");
    app->add_option("--role", command->roles,
                    "What a surface is: horizon, fault or boundary; may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME=ROLE");
    app->add_option("--parts", command->part_format, "Format of blocks and interfaces: vtp, obj")
        ->check(CLI::IsMember({"vtp", "obj"}).description(""))
        ->type_name("FORMAT");
    add_settings(*app, command->settings);
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    app->footer(footer);
    return {app, [command] {
                Session session(command->files.threads);
                const auto status = find_blocks(*command, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
