// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/plausibility.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/algorithms/model/model_doubts.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/io/structure_json.hpp>

namespace terrane::cli {

void report_doubts(const std::vector<PlausibilityWarning>& warnings,
                   const std::vector<std::string>& labels, bool strict, Json& statistics) {
    Json& list = statistics["warnings"];
    if (!list.is_array()) list = Json::array();
    for (const PlausibilityWarning& w : warnings) warn(w.message());
    const Json added = json_of(warnings, labels);
    for (const Json& warning : added) list.push_back(warning);
    if (!strict || warnings.empty()) return;
    refuse(
        fmt::format("{} about the inputs; nothing was done", counted(warnings.size(), "warning")),
        "--strict");
}

void examine(std::span<const Surface> surfaces, const PlausibilityContext& context,
             const Inputs& inputs, Session& session, Json& statistics) {
    session.begin("plausibility", Phase::computing);
    add_constants(statistics, "plausibility", plausibility_constants());
    report_doubts(find_doubts(surfaces, context), inputs.labels, inputs.strict, statistics);
    session.end_stage();
}

void examine(const Model& model, const Inputs& inputs, bool blocks, Session& session,
             Json& statistics) {
    session.begin("plausibility", Phase::computing);
    const Json& said = statistics["warnings"];
    const bool open = std::ranges::any_of(said, [](const Json& warning) {
        return warning["about"] == name_of(Doubt::no_top) ||
               warning["about"] == name_of(Doubt::no_base);
    });
    report_doubts(find_model_doubts(model, blocks && !open), inputs.labels, inputs.strict,
                  statistics);
    session.end_stage();
}

} // namespace terrane::cli
