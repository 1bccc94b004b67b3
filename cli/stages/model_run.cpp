// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/model_run.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/reports/arranged_report.hpp>
#include <terrane/cli/reports/fill_report.hpp>
#include <terrane/cli/reports/improve_report.hpp>
#include <terrane/cli/reports/layer_report.hpp>
#include <terrane/cli/reports/resolution_report.hpp>
#include <terrane/cli/reports/tetrahedra_report.hpp>
#include <terrane/cli/stages/blocks.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/cli/stages/plausibility.hpp>
#include <terrane/io/certify.hpp>
#include <terrane/io/project.hpp>

namespace terrane::cli {
namespace {

/// Reads the stratigraphic column of a command, if it has one.
StratigraphicColumn column_of(const std::string& file, const Inputs& inputs) {
    if (file.empty()) return StratigraphicColumn();
    auto column = must(read_column(file));
    if (const auto sound = check_column(column, infos_of(inputs.surfaces)); !sound)
        refuse(sound.error().code, sound.error().sentence, file + ": " + sound.error().place);
    return column;
}

/// Returns what a certificate states of filled surfaces.
std::vector<FilledRecord> records_of(const std::optional<FillWork>& work) {
    std::vector<FilledRecord> records;
    if (work)
        for (const HoledSurface& s : work->surfaces)
            records.push_back(
                {&s.filled, s.given_vertices, s.given_triangles, s.interpolated, s.deviation});
    return records;
}

} // namespace

void check_command(const ModelCommand& command) {
    const Project& project = command.project;
    check_volume_options(command.volume);
    plan_proof(command.proof, command.files);
    if (command.proof.certificate.empty()) return;
    const auto refuse_proof = [](const std::string& what, const char* option) {
        refuse("a certificate can't show yet " + what + "; leave out " + option +
                   ", or the certificate",
               "--certificate");
    };
    if (project.tolerance) refuse_proof("what was joined within a tolerance", "--tolerance");
    if (project.min_volume) refuse_proof("that only small blocks were merged", "--min-volume");
    if (project.improve && project.improve->resolution.length > 0)
        refuse_proof("what was joined at a resolution", "--resolution");
    check_certified_names(command.proof.certificate, command.volume.within);
}

Error at_option(Error error, const CLI::App& app) {
    std::string word = error.place;
    if (error.code == ErrorCode::bad_option &&
        word.empty()) // of a stage, which names its option first
        word = error.sentence.substr(0, error.sentence.find(' '));
    for (const std::string_view group : {"improve.", "tetrahedra.", "layers."})
        if (word.starts_with(group)) word.erase(0, group.size());
    word.resize(std::min(word.size(), word.find_first_of(".[")));
    if (word == "box") word = "around";
    if (word == "seal_of") word = "seal";
    if (word == "order") word = "layer";
    std::replace(word.begin(), word.end(), '_', '-');
    if (!word.empty() && app.get_option_no_throw("--" + word) != nullptr) error.place = "--" + word;
    return error;
}

ModelRun ModelRun::begin(const ModelCommand& command, Session& session) {
    const FileOptions& files = command.files;
    check_command(command);
    auto page = plan_page(files, session);
    auto inputs = read_certified_inputs(command.proof.certificate, files, session);
    ModelRun run(
        command.project, std::move(page), files,
        [told = summary_stream(files)](const std::string& text) { say(told, text); }, session);
    run.certificate_ = command.proof.certificate;
    run.tells_blocks_ = command.tells_blocks;
    if (!run.certificate_.empty()) run.read_ = inputs.surfaces;
    set_roles(command.roles, inputs);
    run.project_.column = column_of(command.column, inputs);
    run.project_.volume = volume_of(command.volume);
    if (command.volume.extend != 0) run.project_.extend = command.volume.extend;
    BuildInput input{.stated_blocks = inputs.stated_blocks};
    if (command.volume.wanted()) input.boundary = boundary_of(command.volume, session);
    input.surfaces = std::exchange(inputs.surfaces, {});
    run.take(std::move(input), std::move(inputs), command.needs_blocks);
    return run;
}

void ModelRun::take(BuildInput input, Inputs inputs, bool needs_blocks) {
    inputs_ = std::move(inputs);
    input_ = std::move(input);
    needs_blocks_ = needs_blocks;
    add_page_inputs(page_, files_, inputs_);
    statistics_ = statistics_of(inputs_);
    examine(input_.surfaces, {input_.boundary, needs_blocks}, inputs_, session_, statistics_);
}

void ModelRun::examine_with(const Surface& other) {
    auto surfaces = input_.surfaces;
    const auto before = find_doubts(surfaces);
    surfaces.push_back(other);
    auto doubts = find_doubts(surfaces);
    std::erase_if(doubts, [&](const PlausibilityWarning& w) {
        return w.doubt == Doubt::duplicate_surface || // it is not added to the model
               std::ranges::count(before, w.doubt, &PlausibilityWarning::doubt) > 0;
    });
    auto labels = inputs_.labels;
    labels.push_back(other.name);
    report_doubts(doubts, labels, inputs_.strict, statistics_);
}

void ModelRun::make(BuildObserver observer, const StageStore& store) {
    if (!observer.begins)
        observer.begins = [&](BuildStage stage) {
            session_.begin(name_of(stage), Phase::computing);
        };
    observer.ended = [&](BuildStage stage, const Built& built) { ended(stage, built); };
    auto built = terrane::build(project_, std::move(input_), session_.run(), observer, store);
    session_.end_stage();
    if (!refused_.empty()) return print(stderr, refused_);
    if (!built)
        throw Failure{files_.app == nullptr ? built.error()
                                            : at_option(built.error(), *files_.app)};
    built_ = std::move(*built);
    if (doubts_) throw Failure{*doubts_};
}

void ModelRun::ended(BuildStage stage, const Built& built) {
    if (stage == BuildStage::blocks) judge(built.arranged, *built.model);
    say_(session_.timed("summary", [&] {
        switch (stage) {
        case BuildStage::preprocess:
            return told_of(built.preprocessed);
        case BuildStage::arrange:
            inputs_.labels = built.labels;
            return told_of(built.arranged);
        case BuildStage::improve:
            return told_of_improved(built);
        case BuildStage::blocks:
            return told_of(*built.model);
        case BuildStage::tetrahedra:
            break;
        }
        add_statistics(statistics_, *built.filled);
        add_changes(statistics_, built);
        page_.add_tetrahedra(*built.filled);
        if (const auto& report = built.filled->report; !report.violations.empty())
            refuse(violations_text(report));
        return changes_text(built, inputs_.unit) + filled_text(*built.filled, inputs_.unit);
    }));
}

std::string ModelRun::told_of(const Preprocessed& done) {
    const bool is_last = project_.last == BuildStage::preprocess;
    std::string text;
    if (done.filled) {
        const FillWork& work = *done.filled;
        text += borders_text(work) + filled_text(work);
        const auto open = refusals_text(work); // the rest is written if nothing else is to be done
        auto flaws = is_last ? std::string() : open;
        if (!done.contacts.empty())
            flaws += complaint("new triangles meet other triangles") +
                     contacts_text(work, done.contacts);
        refuse(flaws);
        add_statistics(statistics_, work);
        if (is_last) page_.add_filled(work);
        if (is_last) page_.set_verdict(page::filling_verdict(open.empty()), open.empty());
    }
    if (done.layered) {
        text += text_of(inputs_, *done.layered);
        refuse(flaws_text(*done.layered));
        add_statistics(statistics_, inputs_, *done.layered);
        if (is_last) page_.add_mesh(done.layered->rounded.mesh);
        if (is_last)
            page_.set_verdict("The layers are in order, and their mesh is conforming, by exact "
                              "checks.",
                              true);
    }
    if (!refused_.empty())
        page_.set_verdict("The new surfaces meet others improperly, or are not in order.", false);
    return text;
}

std::string ModelRun::told_of(const Arranged& arranged) {
    add_statistics(statistics_, arranged, inputs_);
    page_.add_arranged(arranged);
    if (!arranged.rounded.report.clean && project_.last > BuildStage::arrange)
        refuse(offending_pairs(inputs_, arranged) +
               complaint("the doubles are not a conforming mesh"));
    return summary(inputs_, arranged);
}

std::string ModelRun::told_of_improved(const Built& built) {
    add_statistics(statistics_, *built.improved);
    page_.add_improved(built.improved->improved.mesh, built.arranged.rounded.mesh);
    std::string flaws;
    for (const Error& flaw : built.flaws)
        flaws += complaint((files_.app == nullptr ? flaw : at_option(flaw, *files_.app)).message());
    if (!keeps_volumes(*built.improved, files_.strict, project_.improve->options))
        flaws += complaint("the volume of a block changed too much");
    refuse(flaws);
    if (!flaws.empty())
        page_.set_verdict("The improved mesh may be too far from the one before, or its blocks may "
                          "not be the same.",
                          false);
    return resolution_text(statistics_, built.arranged, inputs_) +
           improve_text(*built.improved, inputs_);
}

void ModelRun::judge(const Arranged& arranged, const Model& model) {
    if (tells_blocks_) leaks_ = judge_leaks(arranged, model, session_);
    try { // the model is shown all the same
        examine(model, inputs_, needs_blocks_, session_, statistics_);
    } catch (const Failure& failure) {
        doubts_ = failure.error;
    }
}

std::string ModelRun::told_of(const Model& model) {
    page_.add_model(model, leaks_);
    if (!tells_blocks_) return {};
    add_statistics(statistics_, model);
    return model_text(inputs_, model, leaks_);
}

void ModelRun::refuse(const std::string& why) {
    if (!why.empty()) refused_ = why + complaint("nothing written");
}

bool ModelRun::leaves_values_out() const {
    if (certificate_.empty() || built_.given.empty()) return false;
    warn("values on points and triangles are left out of files that a certificate is about");
    return true;
}

std::vector<SurfaceValues> ModelRun::values_on(const Mesh& mesh) const {
    if (leaves_values_out()) return {};
    if (project_.last == BuildStage::preprocess) return values_on_preprocessed(built_);
    return terrane::values_on(built_, mesh);
}

std::vector<SurfaceValues> ModelRun::values_on(const TetrahedralMesh& tetrahedra) const {
    if (leaves_values_out()) return {};
    return terrane::values_on(built_, tetrahedra);
}

void ModelRun::certify(std::vector<ResultFile> outputs) {
    if (certificate_.empty()) return;
    for (std::size_t s = 0; s < built_.arranged.surfaces.size() && s < read_.size(); ++s)
        built_.arranged.surfaces[s].role = read_[s].role; // as in the file
    const Preprocessed& first = built_.preprocessed;
    CertifiedResult result = result_of(built_.arranged);
    if (project_.last == BuildStage::preprocess)
        result = {.surfaces = read_, .filled = records_of(first.filled), .order = first.order};
    if (first.layered) result.layered = &*first.layered;
    if (built_.improved) result.improved = &built_.improved->improved;
    if (built_.model) result.model = &*built_.model;
    result.sealed = built_.arranged.sealed;
    result.leaks = leaks_;
    if (built_.filled) result.tetrahedra = &built_.filled->tetrahedra;
    result.inputs = certified_inputs(files_.inputs, inputs_);
    result.outputs = std::move(outputs);
    result.volume = project_.volume;
    result.search = project_.search;
    write_certificate(certificate_, result, told(), session_);
}

void ModelRun::add_certificate(const std::string& path) {
    add_page_certificate(page_, files_, path, true, session_);
}

void ModelRun::write_page() {
    cli::write_page(page_, files_, statistics_, session_);
}

ExitStatus ModelRun::end(bool good) {
    add_page_certificate(page_, files_, certificate_, good, session_);
    return write_run(page_, statistics_, files_, session_, good);
}

} // namespace terrane::cli
