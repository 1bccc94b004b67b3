// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/distribution_report.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>

namespace terrane::cli {

using namespace distribution;
using Json = terrane::detail::Json;

namespace {

Json counts_of_work(const Work& w) {
    return {{"read", w.homes},
            {"faces", w.faces},
            {"own_faces", w.owned},
            {"candidates", w.candidates},
            {"improper_contacts", w.improper},
            {"divided", w.divided},
            {"predicates", w.predicates},
            {"constructed_points", w.constructed},
            {"triangles", w.triangles},
            {"pairs_of_doubles", w.rounded_pairs},
            {"messages", w.messages},
            {"bytes", w.bytes},
            {"memory", w.memory}};
}

std::string volumes_text(const std::vector<double>& measures) {
    constexpr std::size_t most = 50; // listed on the terminal
    auto text = fmt::format("{}, volume {:.9g} in all\n",
                            counted(measures.size() - 1, "closed block"), measures[0]);
    for (std::size_t v = 1; v <= std::min(measures.size() - 1, most); ++v)
        text += fmt::format("  block {:<4} volume {:.9g}\n", v, measures[v]);
    if (measures.size() - 1 > most)
        text += fmt::format("  and {} more\n", measures.size() - 1 - most);
    return text;
}

} // namespace

Json distribution_json(const DistributedReport& r, const RoundingReport* repaired,
                       std::size_t blocks) {
    Json all{{"blocks", blocks},
             {"input", {{"vertices", r.input_vertices}, {"triangles", r.input_triangles}}},
             {"arrangement",
              {{"vertices", r.vertices},
               {"triangles", r.triangles},
               {"intersection_edges", r.intersection_edges}}},
             {"rounding",
              {{"in_blocks", repaired == nullptr},
               {"rounds", repaired == nullptr ? 0 : repaired->rounds},
               {"deviation", repaired == nullptr ? r.deviation : repaired->surface_deviation}}},
             {"most_in_a_block", counts_of_work(r.largest)},
             {"all_blocks", counts_of_work(r.total)}};
    if (!r.digest.empty()) all["digest"] = r.digest;
    if (r.volumes) all["volumes"] = {{"count", r.volumes->size() - 1}, {"measures", *r.volumes}};
    return all;
}

std::string distribution_text(const DistributedReport& r, const RoundingReport* repaired,
                              const std::string& blocks) {
    auto text = fmt::format("{}: {} triangles -> {}, {}\n", blocks, r.input_triangles, r.triangles,
                            counted(r.intersection_edges, "intersection edge"));
    if (repaired != nullptr)
        text +=
            fmt::format("doubles: repaired in one process, in {}; no surface moved farther than "
                        "{:.3g}\n",
                        counted(repaired->rounds, "round"), repaired->surface_deviation);
    else
        text += fmt::format("doubles: no vertex is more than {:.3g} from its exact place\n",
                            r.deviation);
    if (!r.digest.empty()) text += "digest: " + r.digest + "\n";
    if (r.volumes) text += volumes_text(*r.volumes);
    return text;
}

} // namespace terrane::cli
