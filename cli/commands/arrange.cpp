// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>
#include <utility>
#include <vector>

#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/cli/stages/outputs.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/cli/stages/pipeline.hpp>
#include <terrane/cli/stages/tilewise.hpp>

namespace terrane::cli {
namespace {

struct ArrangeCommand {
    FileOptions files;
    ArrangeSettings settings;
    ProofOptions proof;
    TilewiseOptions tilewise;
    bool keep_unverified = false;
};

constexpr auto arrange_footer =
    R"(Writes .vtp .obj .ts .ply .off .stl .msh .inp .mesh .poly .smesh, borders and intersection curves as .pl, and
vertices as .vs; -o may be repeated. The mesh is written only if its doubles are conforming, by an exact check
of the doubles themselves. Otherwise the pairs of triangles in the way are named, and the exit status is 1.

Examples:
  terrane arrange horizons.ts faults.ts -o model.vtp
  terrane arrange *.obj -o model.obj -o model.vtp --stats model.json
  terrane arrange horizons.ts faults.ts -o part.vtp --box 0,0,-3000,10000,10000,500
  terrane arrange horizons.ts -o part.vtp --within salt.ts --certificate part.json
  terrane arrange --format ts --output-format obj - -o - < in.ts > out.obj
  terrane arrange large.obj -o model.pvtp --memory 4GiB)";

/// Checks before any work is done that a certificate can be made, if one is wanted.
Status check_certificate(const ArrangeCommand& command) {
    if (command.proof.certificate.empty()) return Done{};
    if (auto possible = check_certifiable(command.settings); !possible) return possible;
    return check_certified_names(command.proof.certificate, command.settings.volume.within);
}

/// Writes the certificate and the exact coordinates, if they are wanted. Rounded coordinates need not
/// be conforming, as the exact result holds anyway.
Status write_proof(const ArrangeCommand& command, const Inputs& inputs, const Arranged& arranged,
                   const std::vector<Output>& outputs, Session& session) {
    std::FILE* const told = summary_stream(command.files);
    if (!command.proof.certificate.empty()) {
        auto result =
            certified_arrangement(command.files.inputs, inputs, command.settings, arranged);
        if (!result) return result.error();
        auto files = certified_outputs(outputs, arranged.rounded.mesh, command.files.ascii);
        if (!files) return files.error();
        result->outputs = *std::move(files);
        if (auto done = write_certificate(command.proof.certificate, *result, told, session); !done)
            return done;
    }
    return write_exact(command.proof, arranged.exact, told, session);
}

Result<ExitStatus> arrange_files(const ArrangeCommand& command, Session& session) {
    if (command.tilewise.digest)
        return usage("it needs --memory; a certificate has the digest, too", "--digest");
    if (command.tilewise.volumes)
        return usage("it needs --memory; terrane volume finds them without", "--volumes");
    const FileOptions& files = command.files;
    const auto outputs = plan_outputs(files, OutputKind::surfaces);
    if (!outputs) return outputs.error();
    if (const auto named = plan_proof(command.proof, files); !named) return named.error();
    if (const auto sound = check_volume_options(command.settings.volume); !sound)
        return sound.error();
    if (const auto possible = check_certificate(command); !possible) return possible.error();
    auto page = plan_page(files, session);
    if (!page) return page.error();
    auto inputs = read_certified_inputs(command.proof.certificate, files, session);
    if (!inputs) return inputs.error();
    if (const auto added = add_page_inputs(*page, files, *inputs); !added) return added.error();
    Json statistics = statistics_of(inputs.value());

    const auto arranged = arrange_and_round(inputs.value(), command.settings, session, statistics);
    if (!arranged) return arranged.error();
    say(summary_stream(files),
        session.timed("summary", [&] { return summary(inputs.value(), arranged.value()); }));
    page->add_arranged(*arranged);
    const Mesh& mesh = arranged.value().rounded.mesh;
    bool clean = arranged.value().rounded.report.clean;
    if (!clean) print(stderr, offending_pairs(inputs.value(), arranged.value()));
    if (clean) {
        const auto narrow = stl_is_conforming(mesh, files, outputs.value(), session);
        if (!narrow) return narrow.error();
        clean = narrow.value();
        if (!clean) page->set_verdict(not_conforming_in_stl, false);
    }
    if (session.stopped()) return Error{ErrorCode::interrupted, "", ""};

    const bool keep = clean || command.keep_unverified;
    if (keep) {
        const auto written = write_outputs(mesh, clean, files, outputs.value(), session);
        if (!written) return written.error();
    }
    const bool proves = !command.proof.certificate.empty() || !command.proof.exact.empty();
    if (!keep)
        print(stderr, complaint(std::string(proves ? "the mesh is not" : "nothing") +
                                " written (see --keep-unverified)"));
    if (const auto proved = write_proof(command, *inputs, *arranged,
                                        keep ? outputs.value() : std::vector<Output>(), session);
        !proved)
        return proved.error();
    add_page_certificate(*page, files, command.proof.certificate, true, session);
    return write_run(*page, statistics, files, session, clean);
}

} // namespace

Command arrange_command(CLI::App& program) {
    auto options = std::make_shared<ArrangeCommand>();
    auto* app =
        program.add_subcommand("arrange", "Make one conforming mesh of surfaces that cross");
    add_inputs(*app, options->files);
    add_output(*app, options->files, "File for the mesh; - is standard output");
    add_settings(*app, options->settings);
    app->add_flag(
        "--keep-unverified", options->keep_unverified,
        "Write the mesh even where its doubles are not conforming (status 1 all the same)");
    app->add_flag("--ascii", options->files.ascii, "STL as text, with doubles, not float32");
    add_msh(*app, options->files);
    add_proof(*app, options->proof);
    add_tilewise(*app, options->tilewise);
    add_threads(*app, options->files);
    add_stats(*app, options->files);
    add_report(*app, options->files);
    app->footer(arrange_footer);
    return {app, [options] {
                Session session(options->files.threads);
                const auto status =
                    options->tilewise.wanted()
                        ? arrange_tilewise(options->files, options->tilewise, session)
                        : arrange_files(*options, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
