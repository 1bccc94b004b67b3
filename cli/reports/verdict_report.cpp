// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/verdict_report.hpp>

#include <algorithm>
#include <set>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/styles.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_violations = 50; ///< named on the terminal

/// Names the part of an output file that is the verifier's own, byte for byte.
std::string_view bound_part(OutputCheck check) {
    switch (check) {
    case OutputCheck::every_byte:
    case OutputCheck::float32:
        return "every byte";
    case OutputCheck::inflated:
        return "every byte, once decompressed";
    case OutputCheck::hash_only:
        break;
    }
    return "";
}

/// Says what an output file holds. `cells` are those of the certificate's mesh.
std::string contents_text(const JudgedOutput& output, const std::string& format,
                          const std::string& cells) {
    if (format == "json")
        return "holds these blocks, interfaces, patches, lines and corners, and names, exact "
               "volumes, "
               "surfaces above, below and beside, gaps and leaks as the certificate states them";
    if (output.verdict.check != OutputCheck::float32) return "holds these " + cells;
    return fmt::format("holds these triangles rounded to float32, at most {} away",
                       figure(output.verdict.float32_move, 3));
}

std::string output_text(const JudgedOutput& output, const std::string& format,
                        const std::string& cells) {
    const auto renamed = output.verdict.renamed.size();
    const std::string path = one_line(output.path);
    const std::string names =
        renamed > 0 ? fmt::format("; names or roles of {} are not those of the inputs",
                                  counted(renamed, "surface"))
                    : "";
    if (!output.missing.empty())
        return fmt::format("{}: {} {}\n", path, bad("NOT verified:"), output.missing);
    if (output.verdict.check == OutputCheck::hash_only)
        return fmt::format("{}: {} its SHA-256 is that of the certificate, but the verifier has no "
                           "writer for its format\n",
                           path, bad("NOT verified:"));
    return fmt::format("{}: {}: {}{}\n", path, contents_text(output, format, cells),
                       bound_part(output.verdict.check), names);
}

std::string doubles_text(const Judgement& judged) {
    const auto& rounded = judged.certificate.rounded;
    if (!rounded || !judged.verdict.measured) return "no doubles";
    const Measured& measured = *judged.verdict.measured;
    auto text = counted(rounded->triangles.size(), "triangle") + " of doubles, " +
                (rounded->clean ? "conforming" : "not conforming, as it says");
    if (measured.same_cells) text += ", with the same regions, curves and blocks";
    text += measured.deviation > 0
                ? fmt::format(", at most {} from the exact result ({} is accepted)",
                              figure(measured.deviation, 3), figure(measured.max_deviation, 3))
                : ", at their exact places";
    if (measured.vanished > 0)
        text += fmt::format("; {} vanished", counted(measured.vanished, "input triangle"));
    if (measured.partly_vanished > 0)
        text += fmt::format("; a thin part of {} vanished",
                            counted(measured.partly_vanished, "input triangle"));
    const auto& [lost, made, turned] = measured.differences;
    if (lost + made > 0)
        text += fmt::format("; {} of input triangles lost, {} new", counted(lost, "meeting"), made);
    if (turned > 0)
        text += fmt::format("; another order of triangles around {}", counted(turned, "edge"));
    return text;
}

std::string blocks_text(const Judgement& judged) {
    if (!judged.verdict.blocks) return "";
    const MeasuredBlocks& measured = *judged.verdict.blocks;
    auto text = counted(measured.blocks, "block") + " with their exact volumes";
    if (measured.tetrahedra > 0)
        text += fmt::format(
            "; {} that fill them, {}",
            measured.tetrahedra == 1 ? std::string("1 tetrahedron")
                                     : fmt::format("{} tetrahedra", measured.tetrahedra),
            measured.volume_difference > 0 ? fmt::format("with volumes that differ by {} at most",
                                                         figure(measured.volume_difference, 3))
                                           : "with the same volumes");
    return text + "\n";
}

/// Says how far the surfaces were changed, with a line end before it; nothing if they were not.
std::string change_text(const Judgement& judged) {
    const auto& change = judged.verdict.change;
    const ImprovedClaim* improved = judged.certificate.improved();
    if (!change || improved == nullptr) return "";
    const auto& limits = improved->limits;
    return fmt::format("\nimproved: {}, conforming; the same regions, curves and corners, at most "
                       "{} away, both ways",
                       counted(improved->triangles.size(), "triangle"),
                       figure(limits.empty() ? 0 : *std::ranges::max_element(limits), 3));
}

/// Says that layers are in their order: "2 layers: shale, salt".
std::string layers_text(const Judgement& judged) {
    const LayeredClaim& layered = *judged.certificate.layered();
    std::vector<std::string> names;
    for (const CertifiedInput& input : judged.certificate.inputs)
        for (const CertifiedSurface& s : input.surfaces) names.push_back(one_line(s.name));
    std::string text = counted(layered.order.size(), "layer") + ", from the top down:";
    for (const CertifiedLayer& layer : layered.order)
        text += fmt::format("{} {} (hardness {})", &layer == &layered.order.front() ? "" : ",",
                            names[layer.surface], layer.hardness);
    text += fmt::format("; {}, conforming, in this order, ",
                        counted(layered.triangles.size(), "triangle"));
    if (!layered.thickness)
        return text + fmt::format("at most {} from their surfaces or from the harder ones that "
                                  "replace these",
                                  figure(layered.deviation, 3));
    return text + fmt::format("at most {} from their surfaces or from harder ones moved by "
                              "multiples of the thickness {}; that they keep it is not judged",
                              figure(layered.deviation, 3), figure(*layered.thickness));
}

/// Says what was added to surfaces, with a line end before it; nothing if they were not changed.
std::string sealed_text(const Certificate& certificate) {
    if (!certificate.sealed) return "";
    std::string text = "\nsealed or extended:";
    std::size_t s = 0;
    for (const CertifiedInput& input : certificate.inputs)
        for (const CertifiedSurface& surface : input.surfaces) {
            if (s == certificate.sealed->surfaces.size()) return text;
            const SealedPart& part = certificate.sealed->surfaces[s++];
            if (part.limit > 0)
                text +=
                    fmt::format(" {} by at most {}", one_line(surface.name), figure(part.limit, 4));
        }
    return text;
}

/// Says what surfaces were cut by, with a line end before it; nothing if they were not.
std::string cut_text(const Certificate& certificate) {
    if (!certificate.cut) return "";
    const VolumeClaim& volume = certificate.cut->volume;
    if (volume.shape.empty()) return sealed_text(certificate);
    std::string text = sealed_text(certificate) + "\ncut by ";
    if (volume.shape == "prism") {
        text += volume.corners.size() > 12
                    ? fmt::format("a polygon of {} corners", volume.corners.size())
                    : std::string("the polygon");
        if (volume.corners.size() <= 12)
            for (const auto& [x, y] : volume.corners) text += " " + place_text({x, y});
        text +=
            fmt::format(" between {} and {}", figure(volume.between[0]), figure(volume.between[1]));
    } else if (volume.shape == "hexahedron") {
        std::set<Point3> corners;
        for (const Surface& s : volume.boundary)
            corners.insert(s.vertices.begin(), s.vertices.end());
        text += "the box with the corners";
        for (const Point3& p : corners) text += " " + place_text(p);
    } else {
        text += "the surface of";
        for (const CertifiedInput& input : std::span(certificate.inputs).last(volume.files))
            text += " " + one_line(input.name);
    }
    return text +
           fmt::format(": all that is inside, and nothing else; {} of {} exact triangles "
                       "{}",
                       certificate.cut->dropped.size(), certificate.exact.triangles.size(),
                       certificate.sealed ? "are outside, trimmed or not needed" : "are outside");
}

/// Says what a valid certificate states.
std::string subject_text(const Judgement& judged) {
    if (judged.certificate.layered() != nullptr) return layers_text(judged);
    if (const FilledClaim* filled = judged.certificate.filled();
        filled != nullptr && judged.verdict.change) {
        std::size_t given = 0;
        for (const CertifiedInput& input : judged.certificate.inputs)
            for (const CertifiedSurface& s : input.surfaces) given += s.triangles;
        return fmt::format("{} given and kept; {} new, which close borders and meet no others of "
                           "their surface, at most {} out of the boxes around these borders",
                           counted(given, "triangle"), filled->triangles.size() - given,
                           figure(judged.verdict.change->limit, 3));
    }
    return fmt::format("{} exact triangles; {}{}{}", judged.certificate.exact.triangles.size(),
                       doubles_text(judged), change_text(judged), cut_text(judged.certificate));
}

/// Returns how an output file is bound to the certificate; null if it is not.
Json bound_json(const JudgedOutput& output) {
    if (!output.missing.empty() || !output.verdict.violations.empty()) return Json();
    const std::string_view part = bound_part(output.verdict.check);
    return Json(part.empty() ? "hash" : part);
}

std::string_view output_state(const JudgedOutput& output) {
    if (!output.missing.empty()) return "missing";
    if (!output.verdict.violations.empty()) return "refuted";
    if (output.verdict.check == OutputCheck::hash_only) return "hash only";
    return output.verdict.check == OutputCheck::float32 ? "verified as float32" : "verified";
}

} // namespace

std::string verdict_text(const Judgement& judged, const std::string& name) {
    const auto violations = judged.violations();
    if (violations.empty()) {
        auto text = fmt::format("{}: {} {}\n", name, good("valid:"), subject_text(judged));
        const std::string cells =
            judged.certificate.tetrahedra() != nullptr ? "tetrahedra" : "triangles";
        text += blocks_text(judged);
        for (const JudgedInput& input : judged.inputs)
            text += fmt::format("{}: {} bytes, read as all commands read them, sha256:{}\n",
                                one_line(input.path), input.bytes, input.sha256);
        for (const JudgedOutput& output : judged.outputs)
            text += output_text(output, judged.certificate.outputs[output.number].format, cells);
        if (judged.outputs.empty())
            text += bad("NOT verified") + " about any file: the certificate names no output file\n";
        const auto& digest = judged.certificate.digest;
        return digest.empty() ? text : text + one_line(digest) + "\n";
    }
    return fmt::format("{}: {} {}\n", name, bad("refuted:"),
                       counted(violations.size(), "violation")) +
           listed(violations, most_violations, [](const Violation& violation) {
               return fmt::format("  {}: {}\n", name_of(violation.rule),
                                  one_line(violation.sentence));
           });
}

std::string verdict_json(const Judgement& judged) {
    const auto violations = judged.violations();
    Json json{{"valid", violations.empty()}, {"digest", judged.certificate.digest},
              {"deviation", nullptr},        {"max_deviation", nullptr},
              {"vanished", nullptr},         {"change", nullptr},
              {"max_change", nullptr},       {"inputs", Json::array()},
              {"outputs", Json::array()},    {"violations", Json::array()}};
    if (const auto& measured = judged.verdict.measured) {
        json["deviation"] = measured->deviation;
        json["max_deviation"] = measured->max_deviation;
        json["vanished"] = measured->vanished;
        json["partly_vanished"] = measured->partly_vanished;
        json["same_cells"] = measured->same_cells;
        json["lost_meetings"] = measured->differences.lost;
        json["new_meetings"] = measured->differences.made;
        json["turned_edges"] = measured->differences.turned;
    }
    if (const auto& blocks = judged.verdict.blocks) {
        json["blocks"] = blocks->blocks;
        json["tetrahedra"] = blocks->tetrahedra;
        json["divided"] = blocks->divided;
        json["volume_difference"] = blocks->volume_difference;
    }
    if (const auto& change = judged.verdict.change) {
        json["change"] = change->limit;
        json["max_change"] = change->max_limit;
    }
    for (const JudgedInput& input : judged.inputs)
        json["inputs"].push_back(
            {{"file", input.path}, {"bytes", input.bytes}, {"sha256", input.sha256}});
    for (const JudgedOutput& output : judged.outputs)
        json["outputs"].push_back({{"name", judged.certificate.outputs[output.number].name},
                                   {"file", output.path},
                                   {"state", output_state(output)},
                                   {"bound", bound_json(output)},
                                   {"renamed", output.verdict.renamed},
                                   {"float32_move", output.verdict.float32_move}});
    for (const Violation& v : violations)
        json["violations"].push_back(
            {{"rule", name_of(v.rule)}, {"elements", v.elements}, {"sentence", v.sentence}});
    return text_of(json);
}

} // namespace terrane::cli
