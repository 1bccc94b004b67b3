// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/tilewise.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/carry.hpp>
#include <terrane/algorithms/tiles/local_supersteps.hpp>
#include <terrane/algorithms/tiles/pieces.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/reports/tile_report.hpp>
#include <terrane/cli/stages/tile_volumes.hpp>
#include <terrane/io/meshes/cell_array.hpp>
#include <terrane/io/meshes/pvtp_output.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;
using namespace tiles;

namespace {

constexpr auto memory_option = "--memory";

/// Refuses options that arrangements in tiles do not have.
void check_alone(const CLI::App& command) {
    constexpr std::array allowed{"IN",        "--output", "--memory",       "--digest",
                                 "--volumes", "--stats",  "--threads",      "--quiet",
                                 "--color",   "--format", "--input-format", "--depth",
                                 "--unit",    "--column", "--max-edge"};
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        const std::string name = option->get_lnames().empty() ? option->get_name(true, false)
                                                              : "--" + option->get_lnames()[0];
        if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
            refuse(name + " needs the whole model in memory; leave it out, or --memory",
                   memory_option);
    }
}

bool is_in_pieces(const std::string& path) {
    return fs::path(path).extension() == ".pvtp";
}

/// Checks the outputs before any work is done.
void check_outputs(const FileOptions& files) {
    FileOptions others = files;
    std::erase_if(others.outputs, is_in_pieces);
    const auto outputs = plan_outputs(others, OutputKind::surfaces);
    for (const Output& output : outputs)
        if (output.format != Format::vtp || output.path == "-")
            refuse("in tiles only .pvtp and .vtp files are written; terrane convert makes "
                   "others of them",
                   output.path);
    for (const std::string& path : files.outputs)
        if (is_in_pieces(path)) must(check_pvtp(path));
}

/// Chooses the number of tiles such that one of them, with its computation, takes half of the
/// memory. A triangle is in 20 bytes of a file or more (binary STL has 50, OBJ 55), and takes 800
/// bytes in its tile at most, unless it meets many others.
std::size_t tiles_for(const FileOptions& files, std::uint64_t memory) {
    constexpr std::uint64_t per_byte = 800 / 20, most = 512;
    std::uint64_t bytes = 0;
    for (const std::string& input : files.inputs) {
        std::error_code failed;
        const auto size = fs::file_size(input, failed);
        bytes += failed ? 0 : size;
    }
    return static_cast<std::size_t>(
        std::clamp<std::uint64_t>(bytes * per_byte / (memory / 2 + 1) + 1, 1, most));
}

/// An arrangement in tiles. Where it is not clean, `whole` is its repair.
struct InTiles {
    TiledReport report;
    RepairedWhole whole;

    [[nodiscard]] const RoundingReport* repaired() const {
        return report.clean ? nullptr : &whole.report;
    }
};

/// Repairs the doubles of the whole model, if it fits into the memory.
RepairedWhole repair_whole(Supersteps& tiles, const TiledReport& report, std::uint64_t memory,
                           const Run& run) {
    constexpr std::uint64_t per_triangle = 1000; // bytes; 760 measured where grids overlap
    if (report.triangles > memory / per_triangle)
        refuse(ErrorCode::unsupported,
               fmt::format("the nearest doubles are not a conforming mesh ({} in the way), and a "
                           "repair needs the whole model in memory: {:.1f} GiB for {} triangles",
                           counted(report.contacts, "pair or point"),
                           static_cast<double>(report.triangles * per_triangle) * 0x1p-30,
                           report.triangles),
               memory_option);
    return must(repair_in_one_process(tiles, run));
}

/// The mesh of all pieces, and the volumes on the sides of each triangle, if they were found.
struct Joined {
    Mesh mesh;
    std::vector<CellArray> volumes;
};

/// Joins all pieces in memory.
Joined joined(Supersteps& tiles, InTiles& made) {
    const TiledReport& report = made.report;
    if (!report.clean) {
        Joined all{std::move(made.whole.piece.mesh), {}};
        if (report.volumes) all.volumes = volume_cells(made.whole.piece.volumes_of_sides);
        return all;
    }
    PieceJoiner joiner(report.vertices, report.triangles);
    must(tiles.visit([&](Tile& b) -> Status { return joiner.add(piece_of(b)); }));
    Joined all;
    if (report.volumes) all.volumes = volume_cells(joiner.volumes_of_sides());
    all.mesh = must(std::move(joiner).finish());
    return all;
}

void write_in_tiles(const FileOptions& files, Supersteps& tiles, InTiles& made, Session& session) {
    const bool has_volumes = made.report.volumes.has_value();
    const TilePiece* whole = made.report.clean ? nullptr : &made.whole.piece;
    bool wants_whole = false;
    for (const std::string& path : files.outputs) {
        if (!is_in_pieces(path)) {
            wants_whole = true;
            continue;
        }
        must(write_pvtp(tiles, path, has_volumes, whole));
        tell_when_written(summary_stream(files), "wrote " + path + "\n");
    }
    if (!wants_whole) return;
    const auto all = joined(tiles, made);
    WriteOptions options;
    options.cells = all.volumes;
    options.block_names = made.report.volume_names;
    for (const std::string& path : files.outputs) {
        if (is_in_pieces(path)) continue;
        const Output output{path, Format::vtp};
        write_output(all.mesh, output, options, session);
        tell_when_written(summary_stream(files), wrote(output));
    }
}

} // namespace

void add_tilewise(CLI::App& command, TilewiseOptions& options) {
    add_value(command, memory_option, options.memory, "SIZE",
              "Work in tiles of space, one after the other, with files next to the output, "
              "in about so much memory; writes .vtp and .pvtp (default: the whole model in "
              "memory)")
        ->check([](const std::string& text) {
            return bytes_of_size(text) ? std::string()
                                       : "'" + text + "' is no size, such as 4GiB or 512MiB";
        });
    command.add_flag("--digest", options.digest,
                     "With --memory: say the digest of the exact result");
    command.add_flag("--volumes", options.volumes,
                     "With --memory: find the volumes that the surfaces enclose; .pvtp files then "
                     "tell those on both sides of each triangle");
}

std::optional<std::uint64_t> bytes_of_size(std::string_view text) {
    std::uint64_t number = 0;
    const auto [at, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failed != std::errc() || number == 0) return std::nullopt;
    const std::string_view unit(at, static_cast<std::size_t>(text.data() + text.size() - at));
    unsigned shift = 0;
    for (const std::string_view known : {"", "KiB", "MiB", "GiB", "TiB"}) {
        if (unit == known)
            return number > (UINT64_MAX >> shift) ? std::nullopt : std::optional(number << shift);
        shift += 10;
    }
    return std::nullopt;
}

ExitStatus arrange_tilewise(const FileOptions& files, const TilewiseOptions& options,
                            Session& session) {
    check_alone(*files.app);
    check_outputs(files);
    const std::uint64_t memory = *bytes_of_size(options.memory);
    const std::size_t count = tiles_for(files, memory);
    const fs::path beside = fs::path(files.outputs.front()).parent_path();
    LocalSupersteps tiles({count, beside.empty() ? "." : beside}, session.run());
    session.begin("arrange in tiles", Phase::computing);
    const auto read = [&](std::size_t file) -> Result<std::vector<Surface>> {
        FileOptions one = files;
        one.inputs = {files.inputs[file]};
        try { // the library takes errors as values
            auto inputs = read_inputs(one, session);
            if (have_values(inputs.surfaces))
                warn(one.inputs[0] +
                     ": with --memory the output has no values on points and triangles");
            session.begin("arrange in tiles", Phase::computing);
            return std::move(inputs.surfaces);
        } catch (const Failure& failure) {
            return failure.error;
        }
    };
    const Run& run = session.run();
    auto report = must(arrange_in_tiles(tiles, read, {files.inputs.size(), options.digest}, run));
    InTiles made{std::move(report), {}};
    if (!made.report.clean) {
        auto whole = repair_whole(tiles, made.report, memory, run);
        made.whole = std::move(whole);
        if (!made.whole.report.clean)
            refuse(ErrorCode::unsupported,
                   "no conforming mesh of doubles was found; without this option the pairs in the "
                   "way are named",
                   memory_option);
    }
    if (options.volumes) must(find_tile_volumes(tiles, made.report, made.whole.piece));
    session.end_stage();
    say(summary_stream(files), tile_text(made.report, made.repaired(), counted(count, "tile")));
    write_in_tiles(files, tiles, made, session);
    Json statistics = tile_json(made.report, made.repaired(), count);
    write_statistics(std::move(statistics), files.stats, session);
    return ExitStatus::done;
}

} // namespace terrane::cli
