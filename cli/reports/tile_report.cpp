// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/tile_report.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/io/report_members.hpp>

namespace terrane::cli {

using namespace tiles;
using Json = terrane::detail::Json;

namespace {

/// Tells how the doubles were repaired: near what was in the way, by moving the input, in one process, or
/// not at all.
Json rounding_json(const TiledReport& r, const RoundingReport* whole) {
    Json all{{"in_tiles", whole == nullptr},
             {"arranged_again",
              whole != nullptr ? whole->arranged_again : r.repair && r.repair->is_moved},
             {"contacts", 0},
             {"gathered_triangles", 0},
             {"rounds", 0},
             {"deviation", r.deviation}};
    const auto set = [&](std::uint64_t contacts, std::uint64_t triangles, unsigned rounds,
                         double deviation) {
        all["contacts"] = contacts;
        all["gathered_triangles"] = triangles;
        all["rounds"] = rounds;
        all["deviation"] = deviation;
    };
    if (whole != nullptr)
        set(whole->naive_contacts, r.triangles, whole->rounds, whole->surface_deviation);
    else if (r.repair)
        set(r.repair->contacts, r.repair->triangles, r.repair->rounds, r.repair->surface_deviation);
    return all;
}

std::string rounding_text(const TiledReport& r, const RoundingReport* whole) {
    if (whole != nullptr)
        return fmt::format("doubles: repaired in one process, in {}; no surface moved farther than "
                           "{}\n",
                           counted(whole->rounds, "round"), figure(whole->surface_deviation, 3));
    if (r.repair && r.repair->is_moved)
        return fmt::format("doubles: {} in the way; the input was moved and arranged again, in {}; "
                           "no surface moved farther than {}\n",
                           counted(r.repair->contacts, "pair"), counted(r.repair->rounds, "round"),
                           figure(r.repair->surface_deviation, 3));
    if (r.repair && r.repair->contacts == 0)
        return fmt::format("doubles: triangles without area dropped; no surface moved farther than "
                           "{}\n",
                           figure(r.repair->surface_deviation, 3));
    if (r.repair)
        return fmt::format("doubles: {} in the way repaired, in {}, with {} near; no surface moved "
                           "farther than {}\n",
                           counted(r.repair->contacts, "pair"), counted(r.repair->rounds, "round"),
                           counted(r.repair->triangles, "triangle"),
                           figure(r.repair->surface_deviation, 3));
    return fmt::format("doubles: no vertex is more than {} from its exact place\n",
                       figure(r.deviation, 3));
}

/// Lists the blocks from 1 on, as there is nothing to say of the outside.
Json volumes_json(const Volumes& volumes, const std::vector<std::string>& names) {
    return {{"all", volumes.total},
            {"blocks", std::vector(volumes.measures.begin() + 1, volumes.measures.end())},
            {"names", std::vector(names.begin() + 1, names.end())}};
}

std::string volumes_text(const Volumes& volumes, const std::vector<std::string>& names) {
    constexpr std::size_t most = 50; // listed on the terminal
    const std::size_t count = volumes.block_count();
    auto text = fmt::format("{}, volume {} in all\n", counted(count, "closed block"),
                            figure(volumes.total));
    for (std::size_t v = 1; v <= std::min(count, most); ++v)
        text += fmt::format("  block {:<4} volume {:<16} {}\n", v, figure(volumes.measures[v]),
                            names.at(v));
    if (count > most) text += fmt::format("  and {} more\n", count - most);
    return text;
}

} // namespace

Json tile_json(const TiledReport& r, const RoundingReport* repaired, std::size_t tiles) {
    Json all{{"tiles", tiles},
             {"input", {{"vertices", r.input_vertices}, {"triangles", r.input_triangles}}},
             {"arrangement",
              {{"vertices", r.vertices},
               {"triangles", r.triangles},
               {"intersection_edges", r.intersection_edges}}},
             {"rounding", rounding_json(r, repaired)},
             {"most_in_a_tile", r.largest},
             {"all_tiles", r.total}};
    if (!r.digest.empty()) all["digest"] = r.digest;
    if (r.volumes) all["volumes"] = volumes_json(*r.volumes, r.volume_names);
    return all;
}

std::string tile_text(const TiledReport& r, const RoundingReport* repaired,
                      const std::string& tiles) {
    auto text = fmt::format("{}: {} triangles -> {}, {}\n", tiles, r.input_triangles, r.triangles,
                            counted(r.intersection_edges, "intersection edge"));
    text += rounding_text(r, repaired);
    if (!r.digest.empty()) text += "digest: " + r.digest + "\n";
    if (r.volumes) text += volumes_text(*r.volumes, r.volume_names);
    return text;
}

} // namespace terrane::cli
