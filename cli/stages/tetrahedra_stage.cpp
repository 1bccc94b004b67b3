// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/tetrahedra_stage.hpp>

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/stopwatch.hpp>
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/algorithms/tetrahedra/without_outside.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/reports/tetrahedra_report.hpp>
#include <terrane/cli/session/console.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_regions = 50; ///< listed on the terminal

// ---- Names

Error nothing_called(const char* what, const NameOnCommandLine& named) {
    return {ErrorCode::bad_option, fmt::format("no {} is called {}", what, named.name),
            named.place};
}

Result<std::vector<std::uint32_t>> surfaces_of(const BlocksOfMesh& blocks,
                                               const NameOnCommandLine& named) {
    auto found = surfaces_called(named.name, blocks.mesh.surfaces, blocks.labels);
    if (found.empty()) return nothing_called("surface", named);
    return found;
}

/// By number, else by name.
Result<std::uint32_t> block_of(const BlocksOfMesh& blocks, const NameOnCommandLine& named) {
    const auto& all = blocks.structure.blocks;
    std::uint32_t number = 0;
    const char* const end = named.name.data() + named.name.size();
    const auto [after, failed] = std::from_chars(named.name.data(), end, number);
    if (failed == std::errc() && after == end && number < all.size()) return number;
    const auto at = std::find_if(all.begin(), all.end(),
                                 [&](const ModelBlock& block) { return block.name == named.name; });
    if (at == all.end()) return nothing_called("block", named);
    return static_cast<std::uint32_t>(at - all.begin());
}

/// Per volume of the mesh by its own numbers: the number that the user sees.
std::vector<std::uint32_t> shown_numbers(const Volumes& own, const Volumes& shown) {
    std::vector<std::uint32_t> number(own.measures.size());
    for (std::size_t t = 0; t < own.of_sides.size(); ++t)
        for (const std::size_t side : {0, 1})
            number[own.of_sides[t][side]] = shown.of_sides[t][side];
    return number;
}

Result<TetrahedraOptions> options_of(const BlocksOfMesh& blocks, const TetrahedraRequest& wishes,
                                     std::span<const std::uint32_t> shown) {
    TetrahedraOptions options = wishes.options;
    for (const NamedSize& size : wishes.size_of) {
        const auto surfaces = surfaces_of(blocks, size.of);
        if (!surfaces) return surfaces.error();
        for (const std::uint32_t s : surfaces.value())
            options.surface_sizes.push_back({s, size.edge_length});
    }
    for (const NamedSize& size : wishes.size_in) {
        const auto block = block_of(blocks, size.of);
        if (!block) return block.error();
        const auto own = std::find(shown.begin(), shown.end(), block.value());
        if (own == shown.end())
            return Error{ErrorCode::bad_option,
                         fmt::format("block {} is too thin for doubles", block.value()),
                         size.of.place};
        options.block_sizes.push_back(
            {static_cast<std::uint32_t>(own - shown.begin()), size.edge_length});
    }
    return options;
}

Result<std::vector<std::uint32_t>> surfaces_to_split(const BlocksOfMesh& blocks,
                                                     const std::vector<NameOnCommandLine>& split) {
    std::vector<std::uint32_t> all;
    const auto& surfaces = blocks.mesh.surfaces;
    for (const NameOnCommandLine& named : split) {
        auto found = surfaces_called(named.name, surfaces, blocks.labels);
        if (named.name == "fault")
            for (std::uint32_t s = 0; s < surfaces.size(); ++s)
                if (surfaces[s].role == Role::fault) found.push_back(s);
        if (found.empty())
            return named.name == "fault"
                       ? Error{ErrorCode::bad_option, "no surface has the role fault", named.place}
                       : nothing_called("surface", named);
        all.insert(all.end(), found.begin(), found.end());
    }
    sort_unique(all);
    return all;
}

// ---- Numbers

/// To the numbers that the user sees.
void renumber(std::span<const std::uint32_t> shown, std::size_t count, Filled& filled) {
    for (std::uint32_t& region : filled.tetrahedra.region_of) region = shown[region];
    filled.tetrahedra.region_count = static_cast<std::uint32_t>(count);
    std::vector<RegionVolume> volumes(count);
    for (std::size_t r = 0; r < filled.report.volumes.size(); ++r)
        volumes[shown[r]] = filled.report.volumes[r];
    for (std::size_t r = 0; r < count; ++r) // too thin for doubles: nothing to compare
        if (std::find(shown.begin(), shown.end(), r) == shown.end()) volumes[r].equal = true;
    filled.report.volumes = std::move(volumes);
}

std::vector<std::size_t> counts_of_regions(const TetrahedralMesh& mesh) {
    std::vector<std::size_t> counts(mesh.region_count);
    for (const std::uint32_t region : mesh.region_of) ++counts[region];
    return counts;
}

void add_statistics(Json& json, const Filled& filled) {
    const TetrahedralMesh& mesh = filled.tetrahedra;
    json["output"]["volumes"] = mesh.region_count - 1;
    Json volumes = Json::array();
    for (const RegionVolume& region : filled.report.volumes) volumes.push_back(region.tetrahedra);
    json["tetrahedra"] = {{"tetrahedra", mesh.tetrahedra.size()},
                          {"vertices", mesh.vertices.size()},
                          {"faces", mesh.faces.size()},
                          {"regions", mesh.region_count},
                          {"tetrahedra_of_region", counts_of_regions(mesh)},
                          {"volume_of_region", volumes},
                          {"added_nodes", filled.added_nodes},
                          {"twin_faces", mesh.twins.size()},
                          {"check", report_json(filled.report)}};
}

/// Without the outside, then cut.
Status finish(const TetrahedraRequest& wishes, std::span<const std::uint32_t> split,
              TetrahedralMesh& mesh, std::size_t& added_nodes) {
    if (!wishes.outside) mesh = without_outside(std::move(mesh));
    if (mesh.tetrahedra.empty())
        return Error{ErrorCode::nothing_to_do, "there is no closed block to fill", ""};
    if (split.empty()) return Done{};
    auto cut = split_nodes(mesh, split);
    if (!cut) return cut.error();
    added_nodes = cut.value().vertices.size() - mesh.vertices.size();
    mesh = std::move(cut).value();
    return Done{};
}

std::string region_text(const Filled& filled) {
    const TetrahedralMesh& mesh = filled.tetrahedra;
    const auto counts = counts_of_regions(mesh);
    const std::size_t first = counts[0] == 0 ? 1 : 0;
    auto text = fmt::format(
        "{} tetrahedra, {}, {}{}\n", mesh.tetrahedra.size(), counted(mesh.faces.size(), "face"),
        counted(counts.size() - first, "region"), first == 0 ? " with the outside" : "");
    for (std::size_t r = first; r < std::min(counts.size(), most_regions); ++r)
        text += fmt::format("  region {:<3} {:>9} tetrahedra  volume {:.6g}{}\n", r, counts[r],
                            filled.report.volumes[r].tetrahedra, r == 0 ? "  (outside)" : "");
    if (counts.size() > most_regions)
        text += fmt::format("  and {} more\n", counts.size() - most_regions);
    if (!mesh.twins.empty())
        text += fmt::format("cut: {} more, {} of faces\n", counted(filled.added_nodes, "node"),
                            counted(mesh.twins.size(), "pair"));
    return text;
}

} // namespace

Result<Filled> fill_and_check(const BlocksOfMesh& blocks, const TetrahedraRequest& wishes,
                              Session& session, Json& statistics) {
    Stopwatch watch;
    session.begin("tetrahedralize", Phase::computing);
    const auto own = find_volumes(blocks.mesh, session.run());
    if (!own) return own.error();
    const auto shown = shown_numbers(own.value(), blocks.volumes);
    const auto options = options_of(blocks, wishes, shown);
    if (!options) return options.error();
    const auto split = surfaces_to_split(blocks, wishes.split);
    if (!split) return split.error();
    auto made = tetrahedralize(blocks.mesh, options.value(), session.run());
    if (!made) return made.error();
    statistics["seconds"]["tetrahedralize"] = watch.lap();

    session.begin("check tetrahedra", Phase::computing);
    Filled filled;
    filled.tetrahedra = std::move(made).value();
    filled.report = check_tetrahedra(filled.tetrahedra, blocks.mesh, own.value());
    statistics["seconds"]["check"] = watch.lap();
    renumber(shown, blocks.volumes.measures.size(), filled);
    if (filled.report.violations.empty())
        if (auto done = finish(wishes, split.value(), filled.tetrahedra, filled.added_nodes); !done)
            return done.error();
    for (const ModelBlock& block : blocks.structure.blocks)
        filled.block_names.push_back(block.name);
    session.end_stage();
    statistics["seconds"]["split"] = watch.lap();
    add_statistics(statistics, filled);
    if (session.stopped()) return Error{ErrorCode::interrupted, "", ""};
    return filled;
}

std::string filled_text(const Filled& filled) {
    return region_text(filled) + report_text(filled.report);
}

} // namespace terrane::cli
