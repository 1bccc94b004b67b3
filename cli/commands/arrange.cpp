// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>

#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/reports/arranged_report.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/cli/stages/outputs.hpp>
#include <terrane/cli/stages/tilewise.hpp>

namespace terrane::cli {
namespace {

struct ArrangeCommand {
    ModelCommand model;
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

ExitStatus arrange_files(const ArrangeCommand& command, Session& session) {
    if (command.tilewise.digest)
        refuse("it needs --memory; a certificate has the digest, too", "--digest");
    if (command.tilewise.volumes)
        refuse("it needs --memory; terrane volume finds them without", "--volumes");
    const FileOptions& files = command.model.files;
    const ProofOptions& proof = command.model.proof;
    auto outputs = plan_outputs(files, OutputKind::surfaces);
    auto run = ModelRun::begin(command.model, session);
    run.make();
    const RoundedMesh& rounded = run.built().arranged.rounded;
    bool clean = rounded.report.clean;
    if (!clean) print(stderr, offending_pairs(run.inputs(), run.built().arranged));
    if (clean) {
        clean = stl_is_conforming(rounded.mesh, files, outputs, session);
        if (!clean) run.page().set_verdict(not_conforming_in_stl, false);
    }
    if (session.stopped()) refuse(ErrorCode::interrupted, "", "");

    if (clean || command.keep_unverified) {
        write_outputs(rounded.mesh, clean, run, outputs, session);
    } else {
        const bool proves = !proof.certificate.empty() || !proof.exact.empty();
        print(stderr, complaint(std::string(proves ? "the mesh is not" : "nothing") +
                                " written (see --keep-unverified)"));
        outputs.clear();
    }
    // The certificate of the exact result holds whether or not the doubles are conforming.
    run.certify(certified_outputs(outputs, rounded.mesh, files.ascii));
    write_exact(proof, run.built().arranged.exact, run.told(), session);
    return run.end(clean);
}

} // namespace

Command arrange_command(CLI::App& program) {
    auto options = std::make_shared<ArrangeCommand>();
    auto* app =
        program.add_subcommand("arrange", "Make one conforming mesh of surfaces that cross");
    add_inputs(*app, options->model.files);
    add_output(*app, options->model.files, "File for the mesh; - is standard output");
    add_arranging(*app, options->model);
    app->add_flag(
        "--keep-unverified", options->keep_unverified,
        "Write the mesh even where its doubles are not conforming (status 1 all the same)");
    app->add_flag("--ascii", options->model.files.ascii, "STL as text, with doubles, not float32");
    add_msh(*app, options->model.files);
    add_proof(*app, options->model.proof);
    add_tilewise(*app, options->tilewise);
    add_run(*app, options->model.files);
    options->model.project.last = BuildStage::arrange;
    app->footer(arrange_footer);
    return {app, [options] {
                Session session(options->model.files.threads);
                return options->tilewise.wanted()
                           ? arrange_tilewise(options->model.files, options->tilewise, session)
                           : arrange_files(*options, session);
            }};
}

} // namespace terrane::cli
