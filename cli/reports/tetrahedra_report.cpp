// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/tetrahedra_report.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/io/report_members.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_blocks = 50; ///< listed on the terminal

struct Comparison {
    std::size_t blocks = 0;
    std::size_t equal = 0;      ///< volumes that agree exactly
    double most_difference = 0; ///< cubic unit
};

Comparison compared(const TetrahedraReport& report) {
    Comparison result;
    for (std::size_t v = 1; v < report.volumes.size(); ++v) { // 0 is the outside
        const BlockVolume& block = report.volumes[v];
        ++result.blocks;
        result.equal += block.equal ? 1 : 0;
        result.most_difference = std::max(result.most_difference, std::fabs(block.difference));
    }
    return result;
}

std::string volumes_text(const TetrahedraReport& report, const Quantities& quantities) {
    const Comparison c = compared(report);
    auto text = fmt::format("volumes: {} of {} exactly their tetrahedra", c.equal,
                            counted(c.blocks, "block"));
    if (c.equal < c.blocks)
        text += fmt::format(", the others within {} (vertices rounded)",
                            quantities.volume(c.most_difference, 3));
    return text + "\n";
}

std::string dihedral_text(const TetrahedraShape& shape) {
    auto text =
        fmt::format("dihedral angles {} to {} degrees, mean {}\n", figure(shape.dihedral.least, 3),
                    figure(shape.dihedral.largest, 4), figure(shape.dihedral.mean, 3));
    for (std::size_t i = 0; i < dihedral_bins; ++i)
        if (shape.dihedral_histogram[i] > 0)
            text += fmt::format("  {:>4} - {:<5} {:>9}\n", 10 * i, 10 * (i + 1),
                                shape.dihedral_histogram[i]);
    return text;
}

std::string radius_edge_text(const TetrahedraShape& shape) {
    auto text =
        fmt::format("ratio of circumradius to shortest edge {} to {}, mean {}\n",
                    figure(shape.radius_edge.least, 3), figure(shape.radius_edge.largest, 4),
                    figure(shape.radius_edge.mean, 3));
    const auto& counts = shape.radius_edge_histogram;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] == 0) continue;
        const double low = i == 0 ? 0 : radius_edge_bounds[i - 1];
        text += i < radius_edge_bounds.size()
                    ? fmt::format("  {:>4} - {:<5} {:>9}\n", low, radius_edge_bounds[i], counts[i])
                    : fmt::format("  {:>4} -       {:>9}\n", low, counts[i]);
    }
    return text;
}

std::string quality_text(const TetrahedraShape& shape) {
    return fmt::format("SICN {} to {}, mean {}; mean ratio {} to {}, mean {}\n",
                       figure(shape.sicn.least, 3), figure(shape.sicn.largest, 3),
                       figure(shape.sicn.mean, 3), figure(shape.mean_ratio.least, 3),
                       figure(shape.mean_ratio.largest, 3), figure(shape.mean_ratio.mean, 3));
}

constexpr std::array<const char*, bad_causes> cause_keys{"input_angle", "thin_triangle", "gap",
                                                         "other"};
constexpr std::array<const char*, bad_causes> cause_texts{
    "between surfaces that meet at such an angle", "at a triangle of a surface with such an angle",
    "with all corners on surfaces", "for other reasons"};

std::size_t bad_count(const TetrahedraShape& shape) {
    std::size_t all = 0;
    for (const BadTetrahedra& bad : shape.bad) all += bad.count;
    return all;
}

std::string bad_text(const TetrahedraShape& shape, const Quantities& quantities) {
    const std::size_t all = bad_count(shape);
    const double share =
        shape.count == 0 ? 0 : 100 * static_cast<double>(all) / static_cast<double>(shape.count);
    auto text = fmt::format("{} of {} tetrahedra have an angle below {} degrees ({} %)\n", all,
                            shape.count, bad_angle, figure(share, 3));
    for (std::size_t i = 0; i < bad_causes; ++i)
        if (const BadTetrahedra& bad = shape.bad[i]; bad.count > 0)
            text += fmt::format("  {:>9} {}, down to {} at {}\n", bad.count, cause_texts[i],
                                figure(bad.least, 2), quantities.place(bad.place));
    return text;
}

Json bad_json(const TetrahedraShape& shape) {
    Json json{{"below", bad_angle}, {"tetrahedra", bad_count(shape)}};
    for (std::size_t i = 0; i < bad_causes; ++i) {
        const BadTetrahedra& bad = shape.bad[i];
        const bool any = bad.count > 0;
        json[cause_keys[i]] = {{"tetrahedra", bad.count},
                               {"least", any ? Json(bad.least) : Json()},
                               {"place", any ? Json(bad.place) : Json()}};
    }
    return json;
}

Json spread_json(const ShapeSpread& spread) {
    return {{"min", spread.least}, {"mean", spread.mean}, {"max", spread.largest}};
}

/// Counts the violations of all kinds.
std::size_t count_of(const TetrahedraReport& report) {
    std::size_t count = 0;
    for (const TetrahedraViolation& violation : report.violations) count += violation.count;
    return count;
}

/// Counts the tetrahedra of each block.
std::vector<std::size_t> counts_of_blocks(const TetrahedralMesh& mesh) {
    std::vector<std::size_t> counts(mesh.block_count);
    for (const std::uint32_t block : mesh.block_of) ++counts[block];
    return counts;
}

std::string optimised_text(const OptimiseReport& report) {
    return fmt::format("shapes improved in {}{}: dihedral angles were {} to {} degrees, "
                       "and are {} to {}\n",
                       report.passes == 1 ? std::string("a pass")
                                          : fmt::format("{} passes", report.passes),
                       report.is_cut_short ? ", up to the limit of effort" : "",
                       figure(report.before.least_angle, 3), figure(report.before.largest_angle, 4),
                       figure(report.after.least_angle, 3), figure(report.after.largest_angle, 4));
}

/// Reports the verdict, the volumes and both histograms, whose empty classes are left out.
std::string report_text(const TetrahedraReport& report, const Quantities& quantities) {
    const auto verdict =
        report.violations.empty()
            ? std::string("checked: each triangle is a union of faces, each block is one that "
                          "surfaces enclose\n")
            : fmt::format("not good: {}\n", counted(count_of(report), "violation"));
    return verdict + volumes_text(report, quantities) + dihedral_text(report.shape) +
           radius_edge_text(report.shape) + quality_text(report.shape) +
           bad_text(report.shape, quantities);
}

} // namespace

std::string violations_text(const TetrahedraReport& report) {
    std::string text;
    for (const TetrahedraViolation& violation : report.violations)
        text += complaint(message(violation));
    return text;
}

Json report_json(const TetrahedraReport& report) {
    const Comparison c = compared(report);
    const TetrahedraShape& shape = report.shape;
    Json violations = Json::array();
    for (const TetrahedraViolation& violation : report.violations)
        violations.push_back(message(violation));
    Json json{{"violations", violations},
              {"exact_volumes", c.equal},
              {"volume_difference", c.most_difference}};
    json["dihedral"] = spread_json(shape.dihedral);
    json["dihedral"]["histogram"] = shape.dihedral_histogram;
    json["radius_edge"] = spread_json(shape.radius_edge);
    json["radius_edge"]["bounds"] = radius_edge_bounds;
    json["radius_edge"]["histogram"] = shape.radius_edge_histogram;
    json["sicn"] = spread_json(shape.sicn);
    json["sicn"]["histogram"] = shape.sicn_histogram;
    json["mean_ratio"] = spread_json(shape.mean_ratio);
    json["mean_ratio"]["histogram"] = shape.mean_ratio_histogram;
    json["bad"] = bad_json(shape);
    return json;
}

std::string filled_text(const FilledBlocks& filled, const std::string& unit) {
    const TetrahedralMesh& mesh = filled.tetrahedra;
    const Quantities quantities(unit, extent_of(mesh.vertices));
    const auto counts = counts_of_blocks(mesh);
    const std::size_t first = counts[0] == 0 ? 1 : 0;
    auto text = fmt::format(
        "{} tetrahedra, {}, {}{}\n", mesh.tetrahedra.size(), counted(mesh.faces.size(), "face"),
        counted(counts.size() - first, "block"), first == 0 ? " with the outside" : "");
    if (filled.optimised && filled.optimised->passes > 0) text += optimised_text(*filled.optimised);
    if (!mesh.failure.empty()) text += fmt::format("made by {}: {}\n", mesh.mesher, mesh.failure);
    for (std::size_t r = first; r < std::min(counts.size(), most_blocks); ++r)
        text += fmt::format("  block {:<3} {:>9} tetrahedra  volume {:<14} {}\n", r, counts[r],
                            quantities.volume(filled.report.volumes[r].tetrahedra, 6),
                            filled.block_names[r]);
    if (counts.size() > most_blocks)
        text += fmt::format("  and {} more\n", counts.size() - most_blocks);
    if (!mesh.twins.empty())
        text += fmt::format("cut: {} more, {} of faces\n", counted(filled.added_nodes, "node"),
                            counted(mesh.twins.size(), "pair"));
    return text + report_text(filled.report, quantities);
}

void add_statistics(Json& json, const FilledBlocks& filled) {
    add_constants(json, "structure", structure_constants()); // they decide the names of blocks
    add_constants(json, "tetrahedralize", tetrahedra_constants());
    const TetrahedralMesh& mesh = filled.tetrahedra;
    json["output"]["volumes"] = mesh.block_count - 1;
    Json volumes = Json::array();
    for (const BlockVolume& block : filled.report.volumes) volumes.push_back(block.tetrahedra);
    json["tetrahedra"] = {{"mesher", mesh.mesher},
                          {"tetrahedra", mesh.tetrahedra.size()},
                          {"vertices", mesh.vertices.size()},
                          {"faces", mesh.faces.size()},
                          {"blocks", mesh.block_count},
                          {"tetrahedra_of_block", counts_of_blocks(mesh)},
                          {"volume_of_block", volumes},
                          {"added_nodes", filled.added_nodes},
                          {"twin_faces", mesh.twins.size()}};
    if (filled.optimised) {
        add_constants(json, "optimise", optimise_constants());
        json["tetrahedra"]["optimised"] = *filled.optimised;
    }
    json["tetrahedra"]["check"] = report_json(filled.report);
}

std::string changes_text(const Built& built, const std::string& unit) {
    std::string text;
    for (std::size_t k = 0; k < built.rounds.size(); ++k) {
        const RefinementRound& round = built.rounds[k];
        text +=
            fmt::format("  round {:<3} {:>9} triangles {:>9} tetrahedra {:>6} below {} degrees, "
                        "{} of them apart from such angles of the surfaces, {} others "
                        "misshapen{}\n",
                        k, round.triangles, round.tetrahedra, round.bad, bad_angle, round.apart,
                        round.misshapen, k == built.kept_round ? "; taken" : "");
    }
    if (!text.empty()) text.insert(0, "smaller triangles where tetrahedra were bad:\n");
    if (const LoosenedVertices& moved = built.loosened; moved.count > 0)
        text +=
            fmt::format("{} of improved surfaces moved by at most {} where tetrahedra were bad\n",
                        moved.count == 1 ? "1 vertex" : fmt::format("{} vertices", moved.count),
                        Quantities(unit).length(moved.farthest));
    return text;
}

void add_changes(Json& json, const Built& built) {
    json["tetrahedra"]["moved_vertices"] = built.loosened;
    if (built.rounds.empty()) return;
    json["tetrahedra"]["rounds"] = built.rounds;
    json["tetrahedra"]["taken_round"] = built.kept_round;
}

} // namespace terrane::cli
