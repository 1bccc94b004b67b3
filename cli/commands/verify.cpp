// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The command reads the input files again with the readers of io/; terrane::verify alone judges.
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/verify/verify_certificate.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_violations = 50; ///< named on the terminal

struct VerifyCommand {
    std::string certificate;
    FileOptions files;                ///< inputs and how they are read
    std::vector<std::string> outputs; ///< files to judge; empty: those that the certificate names
    VerifyOptions options;
    bool json = false;
};

constexpr auto verify_footer =
    R"(A certificate says how a mesh follows from its input files. It is judged with rational
arithmetic, by code that shares nothing with what made it. IN are the input files in the order of
the certificate; without IN they are looked for beside it, under the names that it gives. What
changed how they were read (--depth, --max-edge, --input-format) must be given here, too.

The output files that the certificate names are read and compared with it: every coordinate and
every triangle, bit for bit. Name a file that was moved with --output.

The verifier computes how far the mesh is from the inputs. It accepts at most 2^-20 of the diagonal
of the box around them or, if that is more, 2^-40 of their largest coordinate. Where surfaces were
changed, it accepts limits up to a twentieth of that diagonal.

Exit status: 0 all is verified; 1 refuted (which rule, which elements); 2 a file cannot be read, or
nothing is verified about an output file; 3 internal.

Examples:
  terrane arrange horizons.ts faults.ts -o model.vtp --certificate model.json
  terrane verify model.json
  terrane verify model.json data/horizons.ts data/faults.ts
  terrane verify model.json --output sent/model.vtp)";

fs::path folder_of(const VerifyCommand& command) {
    return command.certificate == "-" ? fs::path() : fs::path(command.certificate).parent_path();
}

std::vector<std::string> paths_of(const VerifyCommand& command, const Certificate& certificate) {
    if (!command.files.inputs.empty()) return command.files.inputs;
    std::vector<std::string> paths;
    for (const CertifiedInput& input : certificate.inputs)
        paths.push_back((folder_of(command) / input.name).string());
    return paths;
}

/// Reads and parses one input file. A file whose hash differs from the certificate's need not
/// parse: the verifier rejects it by its hash.
Result<InputFile> read_input(const std::string& path, const CertifiedInput& stated,
                             const FileOptions& options) {
    const auto contents = read_file(path);
    if (!contents) return contents.error();
    const auto format =
        options.input_format.empty() ? format_of(stated.name) : format_named(options.input_format);
    if (!format)
        return Error{ErrorCode::unknown_format, "no format that can be read has this extension",
                     stated.name};
    auto surfaces = parse_surfaces(contents.value(), stated.name, *format, options.read);
    InputFile file = input_file(contents.value(), {});
    if (surfaces)
        file.surfaces = std::move(surfaces.value());
    else if (file.sha256 == stated.sha256)
        return surfaces.error();
    return file;
}

Result<std::vector<InputFile>> read_inputs(const VerifyCommand& command,
                                           const Certificate& certificate) {
    const auto paths = paths_of(command, certificate);
    if (paths.size() != certificate.inputs.size())
        return Error{ErrorCode::bad_option,
                     fmt::format("the certificate is about {}, not {}",
                                 counted(certificate.inputs.size(), "file"), paths.size()),
                     command.certificate};
    std::vector<InputFile> files;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        auto file = read_input(paths[i], certificate.inputs[i], command.files);
        if (!file) return file.error();
        files.push_back(std::move(file.value()));
    }
    return files;
}

// --- Output files -----------------------------------------------------------------------------

/// An output file of the certificate, and what was found about it.
struct JudgedOutput {
    std::size_t number = 0; ///< in the certificate
    std::string path;       ///< where it was looked for
    std::string missing;    ///< why it could not be read; empty: it was
    OutputVerdict verdict;

    [[nodiscard]] bool verified() const {
        return missing.empty() && verdict.violations.empty() &&
               verdict.check != OutputCheck::hash_only;
    }
};

JudgedOutput judge_output(OutputVerifier& verifier, std::size_t number, const std::string& path) {
    JudgedOutput judged{number, path, {}, {}};
    const auto contents = read_file(path);
    if (contents)
        judged.verdict = verifier(contents.value(), number);
    else
        judged.missing = contents.error().sentence;
    return judged;
}

/// Returns the output that a file is compared with: the one with its bytes, else the one with its
/// extension, else the first.
std::size_t output_like(const Certificate& certificate, const std::string& path) {
    const auto& outputs = certificate.outputs;
    const auto found_if = [&](const auto& fits) {
        return static_cast<std::size_t>(std::ranges::find_if(outputs, fits) - outputs.begin());
    };
    if (const auto contents = read_file(path); contents) {
        const auto hash = input_file(contents.value(), {}).sha256;
        const auto same = found_if([&](const CertifiedOutput& o) { return o.sha256 == hash; });
        if (same < outputs.size()) return same;
    }
    const auto extension = fs::path(path).extension();
    const auto alike = found_if(
        [&](const CertifiedOutput& o) { return fs::path(o.name).extension() == extension; });
    return alike < outputs.size() ? alike : 0;
}

Result<std::vector<JudgedOutput>> judge_outputs(const VerifyCommand& command,
                                                const Certificate& certificate) {
    const auto& outputs = certificate.outputs;
    std::vector<JudgedOutput> judged;
    if (!command.outputs.empty() && outputs.empty())
        return Error{ErrorCode::bad_option, "the certificate names no output file", "--output"};
    OutputVerifier verifier(certificate);
    for (const std::string& path : command.outputs)
        judged.push_back(judge_output(verifier, output_like(certificate, path), path));
    if (command.outputs.empty())
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            const auto path = (folder_of(command) / outputs[i].name).string();
            judged.push_back(outputs[i].name == "-"
                                 ? JudgedOutput{i, "standard output", "give it with --output", {}}
                                 : judge_output(verifier, i, path));
        }
    return judged;
}

/// All that was found.
struct Judgement {
    const Certificate& certificate;
    Verdict verdict;
    std::vector<JudgedOutput> outputs; ///< none if the certificate is refuted

    [[nodiscard]] std::vector<Violation> violations() const {
        auto all = verdict.violations;
        for (const JudgedOutput& output : outputs)
            all.insert(all.end(), output.verdict.violations.begin(),
                       output.verdict.violations.end());
        return all;
    }
    [[nodiscard]] ExitStatus status() const {
        if (!violations().empty()) return ExitStatus::negative;
        const bool all = std::ranges::all_of(outputs, &JudgedOutput::verified);
        return all && !outputs.empty() ? ExitStatus::done : ExitStatus::bad_input;
    }
};

// --- Text and JSON ----------------------------------------------------------------------------

std::string output_text(const JudgedOutput& output, const std::string& what) {
    const auto renamed = output.verdict.renamed.size();
    const std::string path = one_line(output.path);
    const std::string names =
        renamed > 0 ? fmt::format("; names or roles of {} are not those of the inputs",
                                  counted(renamed, "surface"))
                    : "";
    if (!output.missing.empty())
        return fmt::format("{}: {} {}\n", path, bad("NOT verified:"), output.missing);
    switch (output.verdict.check) {
    case OutputCheck::doubles:
        return fmt::format("{}: holds these {}, bit for bit{}\n", path, what, names);
    case OutputCheck::numbers:
        return fmt::format("{}: holds these blocks, interfaces, patches, lines and corners; block "
                           "names, exact volumes, gaps and leaks are not verified{}\n",
                           path, names);
    case OutputCheck::float32:
        return fmt::format("{}: holds these triangles rounded to float32, at most {:.3g} away{}\n",
                           path, output.verdict.float32_move, names);
    case OutputCheck::hash_only:
        break;
    }
    return fmt::format("{}: {} its SHA-256 is that of the certificate, but there is no "
                       "reader for its format\n",
                       path, bad("NOT verified:"));
}

std::string doubles_text(const Judgement& judged) {
    const auto& rounded = judged.certificate.rounded;
    if (!rounded || !judged.verdict.measured) return "no doubles";
    const Measured& measured = *judged.verdict.measured;
    auto text = counted(rounded->triangles.size(), "triangle") + " of doubles, " +
                (rounded->clean ? "conforming" : "not conforming, as it says");
    text += measured.deviation > 0
                ? fmt::format(", at most {:.3g} from the exact result", measured.deviation)
                : ", at their exact places";
    if (measured.vanished > 0)
        text += fmt::format("; {} vanished", counted(measured.vanished, "input triangle"));
    if (measured.partly_vanished > 0)
        text += fmt::format("; a thin part of {} vanished",
                            counted(measured.partly_vanished, "input triangle"));
    return text;
}

std::string blocks_text(const Judgement& judged) {
    if (!judged.verdict.blocks) return "";
    const MeasuredBlocks& measured = *judged.verdict.blocks;
    auto text = counted(measured.blocks, "block") + " with their exact volumes";
    if (measured.tetrahedra > 0)
        text += fmt::format("; {} that fill them, {}",
                            measured.tetrahedra == 1
                                ? std::string("1 tetrahedron")
                                : fmt::format("{} tetrahedra", measured.tetrahedra),
                            measured.volume_difference > 0
                                ? fmt::format("with volumes that differ by {:.3g} at most",
                                              measured.volume_difference)
                                : "with the same volumes");
    return text + "\n";
}

/// Says how far the surfaces were changed, with a line end before it; nothing if they were not.
std::string change_text(const Judgement& judged) {
    const auto& change = judged.verdict.change;
    const auto& improved = judged.certificate.improved;
    if (!change || !improved) return "";
    const auto& limits = improved->limits;
    return fmt::format("\nimproved: {}, conforming; the same regions, curves and corners, at most "
                       "{:.3g} away, both ways",
                       counted(improved->triangles.size(), "triangle"),
                       limits.empty() ? 0 : *std::ranges::max_element(limits));
}

/// Says that layers are in their order: "2 layers: shale, salt".
std::string layers_text(const Judgement& judged) {
    const LayeredClaim& layered = *judged.certificate.layered;
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
        return text + fmt::format("at most {:.3g} from their surfaces or from the harder ones that "
                                  "replace these",
                                  layered.deviation);
    return text + fmt::format("with a thickness of at least {} where harder ones leave room; at "
                              "most {:.3g} from where they must be",
                              *layered.thickness, layered.deviation);
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
                text += fmt::format(" {} by at most {:.4g}", one_line(surface.name), part.limit);
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
            for (const auto& [x, y] : volume.corners) text += fmt::format(" ({}, {})", x, y);
        text += fmt::format(" between {} and {}", volume.between[0], volume.between[1]);
    } else if (volume.shape == "hexahedron") {
        std::set<Point3> corners;
        for (const Surface& s : volume.boundary)
            corners.insert(s.vertices.begin(), s.vertices.end());
        text += "the box with the corners";
        for (const Point3& p : corners) text += fmt::format(" ({}, {}, {})", p.x, p.y, p.z);
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
    if (judged.certificate.layered) return layers_text(judged);
    if (const auto& filled = judged.certificate.filled; filled && judged.verdict.change) {
        std::size_t given = 0;
        for (const CertifiedInput& input : judged.certificate.inputs)
            for (const CertifiedSurface& s : input.surfaces) given += s.triangles;
        return fmt::format("{} given and kept; {} new, which close borders and meet no others of "
                           "their surface, at most {:.3g} out of the boxes around these borders",
                           counted(given, "triangle"), filled->triangles.size() - given,
                           judged.verdict.change->limit);
    }
    return fmt::format("{} exact triangles; {}{}{}", judged.certificate.exact.triangles.size(),
                       doubles_text(judged), change_text(judged), cut_text(judged.certificate));
}

std::string verdict_text(const Judgement& judged, const std::string& name) {
    const auto violations = judged.violations();
    if (violations.empty()) {
        auto text = fmt::format("{}: {} {}\n", name, good("valid:"), subject_text(judged));
        const std::string cells = judged.certificate.tetrahedra ? "tetrahedra" : "triangles";
        text += blocks_text(judged);
        for (const JudgedOutput& output : judged.outputs) text += output_text(output, cells);
        if (judged.outputs.empty())
            text += bad("NOT verified") + " about any file: the certificate names no output file\n";
        const auto& digest = judged.certificate.digest;
        return digest.empty() ? text : text + one_line(digest) + "\n";
    }
    auto text =
        fmt::format("{}: {} {}\n", name, bad("refuted:"), counted(violations.size(), "violation"));
    for (std::size_t i = 0; i < violations.size() && i < most_violations; ++i)
        text += fmt::format("  {}: {}\n", name_of(violations[i].rule),
                            one_line(violations[i].sentence));
    if (violations.size() > most_violations)
        text += fmt::format("  and {} more\n", violations.size() - most_violations);
    return text;
}

std::string_view output_state(const JudgedOutput& output) {
    if (!output.missing.empty()) return "missing";
    if (!output.verdict.violations.empty()) return "refuted";
    switch (output.verdict.check) {
    case OutputCheck::doubles:
        return "verified";
    case OutputCheck::numbers:
        return "numbers verified";
    case OutputCheck::float32:
        return "verified as float32";
    case OutputCheck::hash_only:
        break;
    }
    return "hash only";
}

std::string verdict_json(const Judgement& judged) {
    const auto violations = judged.violations();
    Json json{{"valid", violations.empty()}, {"digest", judged.certificate.digest},
              {"deviation", nullptr},        {"max_deviation", nullptr},
              {"vanished", nullptr},         {"change", nullptr},
              {"max_change", nullptr},       {"outputs", Json::array()},
              {"violations", Json::array()}};
    if (const auto& measured = judged.verdict.measured) {
        json["deviation"] = measured->deviation;
        json["max_deviation"] = measured->max_deviation;
        json["vanished"] = measured->vanished;
        json["partly_vanished"] = measured->partly_vanished;
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
    for (const JudgedOutput& output : judged.outputs)
        json["outputs"].push_back({{"name", judged.certificate.outputs[output.number].name},
                                   {"file", output.path},
                                   {"state", output_state(output)},
                                   {"renamed", output.verdict.renamed},
                                   {"float32_move", output.verdict.float32_move}});
    for (const Violation& v : violations)
        json["violations"].push_back(
            {{"rule", name_of(v.rule)}, {"elements", v.elements}, {"sentence", v.sentence}});
    return text_of(json);
}

Result<ExitStatus> verify_file(const VerifyCommand& command) {
    const std::string name = command.certificate == "-" ? "standard input" : command.certificate;
    const auto text = read_file(command.certificate);
    if (!text) return text.error();
    const auto certificate = parse_certificate(text.value(), name);
    if (!certificate) return certificate.error();
    const auto files = read_inputs(command, certificate.value());
    if (!files) return files.error();
    Judgement judged{certificate.value(),
                     verify_certificate(files.value(), certificate.value(), command.options),
                     {}};
    if (judged.verdict.violations.empty()) {
        auto outputs = judge_outputs(command, certificate.value());
        if (!outputs) return outputs.error();
        judged.outputs = std::move(outputs).value();
    }
    if (command.json)
        print(stdout, verdict_json(judged));
    else
        say(stdout, verdict_text(judged, one_line(name)));
    return judged.status();
}

} // namespace

Command verify_command(CLI::App& program) {
    auto options = std::make_shared<VerifyCommand>();
    auto* app = program.add_subcommand("verify", "Judge a certificate from its input files");
    app->add_option("CERT", options->certificate, "Certificate; - is standard input")
        ->required()
        ->type_name("CERT");
    app->add_option("IN", options->files.inputs, "The input files")->type_name("FILE");
    add_reading(*app, options->files);
    app->add_option("--output", options->outputs,
                    "An output file that is not where the certificate says; may be repeated")
        ->type_name("FILE");
    app->add_option("--max-deviation", options->options.max_deviation,
                    "The largest distance between the mesh and the inputs that is accepted")
        ->check(CLI::NonNegativeNumber.description(""))
        ->type_name("D");
    app->add_option("--max-change", options->options.max_change,
                    "The largest limit of a change to surfaces that is accepted, for instance of "
                    "improved triangles")
        ->check(CLI::NonNegativeNumber.description(""))
        ->type_name("D");
    app->add_flag("--json", options->json, "The verdict as JSON");
    app->footer(verify_footer);
    return {app, [options] {
                const auto status = verify_file(*options);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
