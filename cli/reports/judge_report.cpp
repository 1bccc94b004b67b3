// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/judge_report.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/styles.hpp>

namespace terrane::cli {
namespace {

std::vector<std::uint32_t> first_triangles(const Inputs& output) {
    std::vector<std::uint32_t> first{0};
    for (const Surface& s : output.surfaces)
        first.push_back(first.back() + static_cast<std::uint32_t>(s.triangles.size()));
    return first;
}

std::string flaw_text(const PropertyFlaw& flaw, const JudgedMesh& mesh,
                      const std::vector<std::uint32_t>& first) {
    std::string elements;
    for (const std::uint32_t t : flaw.triangles)
        elements += (elements.empty() ? ": " : ", ") +
                    (mesh.tetrahedra > 0 ? fmt::format("tetrahedron {}", t)
                                         : triangle_name(t, first, mesh.surfaces.labels));
    return fmt::format("  {} at {}{}\n", flaw.sentence,
                       mesh.surfaces.quantities().place(flaw.place), elements);
}

std::string verdict_word(PropertyVerdict verdict) {
    const std::string word(name_of(verdict));
    return verdict == PropertyVerdict::holds   ? good(word)
           : verdict == PropertyVerdict::fails ? bad(word)
                                               : word;
}

} // namespace

std::string judge_text(const MeshJudgement& judged, const JudgedMesh& mesh) {
    const auto first = first_triangles(mesh.surfaces);
    std::string text =
        fmt::format("{}: {}\n", mesh.name,
                    mesh.tetrahedra > 0 ? fmt::format("{} tetrahedra", mesh.tetrahedra)
                                        : counted(mesh.surfaces.triangles, "triangle"));
    for (const JudgedProperty& p : judged.properties) {
        text += fmt::format("{}: {}: {}\n", p.name, verdict_word(p.verdict), p.sentence);
        for (const PropertyFlaw& flaw : p.flaws) text += flaw_text(flaw, mesh, first);
        if (p.count > p.flaws.size())
            text += fmt::format("  and {} more (--all lists them)\n", p.count - p.flaws.size());
    }
    const auto failed =
        std::ranges::count(judged.properties, PropertyVerdict::fails, &JudgedProperty::verdict);
    if (failed == 0 && !judged.complete()) return text + "result: not all judged\n";
    return text + (failed == 0 ? "result: all hold\n"
                               : fmt::format("result: {} of {} properties fail\n", failed,
                                             judged.properties.size()));
}

std::string judge_json(const MeshJudgement& judged, const JudgedMesh& mesh) {
    const auto first = first_triangles(mesh.surfaces);
    std::string lines;
    for (const JudgedProperty& p : judged.properties) {
        Json json{{"property", p.name}, {"verdict", name_of(p.verdict)}, {"count", p.count},
                  {"size", p.size},     {"sentence", p.sentence},        {"flaws", Json::array()}};
        for (const PropertyFlaw& flaw : p.flaws) {
            Json triangles = Json::array();
            for (const std::uint32_t t : flaw.triangles) {
                if (mesh.tetrahedra > 0) {
                    triangles.push_back(t);
                    continue;
                }
                const auto s = std::ranges::upper_bound(first, t) - first.begin() - 1;
                triangles.push_back(
                    {{"surface", s}, {"triangle", t - first[static_cast<std::size_t>(s)]}});
            }
            json["flaws"].push_back({{"sentence", flaw.sentence},
                                     {"place", flaw.place},
                                     {mesh.tetrahedra > 0 ? "tetrahedra" : "triangles", triangles},
                                     {"size", flaw.size}});
        }
        lines += json.dump() + "\n";
    }
    return lines;
}

Json judge_statistics(const MeshJudgement& judged) {
    Json properties;
    for (const JudgedProperty& p : judged.properties)
        properties[p.name] = {
            {"verdict", name_of(p.verdict)}, {"count", p.count}, {"size", p.size}};
    return properties;
}

std::string tag_line(std::string_view tag) {
    return fmt::format("{{\"TAG_NAME\": \"{}\", \"TAG\": \"{}\"}}\n", tag,
                       tag == "VALID_OUTPUT" ? "OK"
                       : tag == "TIMEOUT"    ? "Timeout"
                                             : "Error");
}

std::string_view tag_of(const MeshJudgement& judged) {
    if (judged.holds()) return judged.complete() ? "VALID_OUTPUT" : "NOT_JUDGED";
    const auto fails = [&](std::string_view name) {
        const JudgedProperty* p = judged.find(name);
        return p != nullptr && p->verdict == PropertyVerdict::fails;
    };
    if (fails("conforming")) return "SELF_INTERSECTING_OUTPUT";
    if (fails("distinct")) return "OUTPUT_HAS_DEGENERATED_FACES";
    if (fails("vertices")) return "OUTPUT_DISTANCE_IS_TOO_LARGE";
    if (fails("closed")) return "OUTPUT_HAS_BORDERS";
    if (fails("manifold")) return "OUTPUT_IS_COMBINATORIAL_NON_MANIFOLD";
    return "INVALID_OUTPUT";
}

} // namespace terrane::cli
