// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/outputs.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/cli/reports/arranged_report.hpp>
#include <terrane/cli/session/console.hpp>

namespace terrane::cli {
namespace {

/// Finds a point in each block if an output is in a format of TetGen. Warns of blocks that contain
/// no point in doubles.
std::vector<BlockPoint> points_in_blocks(const Mesh& mesh, const std::vector<Output>& outputs,
                                         Session& session) {
    const bool wanted = std::any_of(outputs.begin(), outputs.end(), [](const Output& output) {
        return output.format == Format::poly || output.format == Format::smesh;
    });
    if (!wanted) return {};
    session.begin("volumes", Phase::computing);
    const auto volumes = must(find_volumes(mesh, session.run()));
    auto points = must(block_points(mesh, volumes, session.run()));
    session.end_stage();
    if (const auto missing = volumes.block_count() - points.size(); missing > 0)
        warn(fmt::format("{} too thin for a point inside", counted(missing, "block")));
    return points;
}

} // namespace

bool stl_is_conforming(const Mesh& mesh, const FileOptions& files,
                       const std::vector<Output>& outputs, Session& session) {
    for (const Output& output : outputs) {
        if (output.format != Format::stl || files.ascii) continue;
        session.begin("check float32", Phase::computing);
        const auto flaws = float32_flaws(mesh, session.run());
        session.end_stage();
        if (flaws == 0) continue;
        warn(fmt::format("{}: in float32, all that binary STL holds, the mesh has {}; --ascii or "
                         "another format keeps the doubles",
                         output.path, counted(flaws, "flaw")));
        return false;
    }
    return true;
}

void write_outputs(const Mesh& mesh, bool clean, const ModelRun& run,
                   const std::vector<Output>& outputs, Session& session) {
    WriteOptions options;
    options.ascii = run.files().ascii;
    const auto values = run.values_on(mesh);
    options.values = values;
    std::vector<BlockPoint> inside;
    if (clean) inside = points_in_blocks(mesh, outputs, session); // otherwise there are no blocks
    options.block_points = inside;
    for (const Output& output : outputs) {
        write_output(mesh, output, options, session);
        tell_when_written(run.told(), wrote(output));
    }
}

} // namespace terrane::cli
