// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/project/build.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/cli/commands/build_help.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/commands/file_options.hpp>
#include <terrane/cli/options/volume_options.hpp>
#include <terrane/cli/reports/fill_report.hpp>
#include <terrane/cli/reports/improve_report.hpp>
#include <terrane/cli/reports/pair_report.hpp>
#include <terrane/cli/reports/resolution_report.hpp>
#include <terrane/cli/reports/tetrahedra_report.hpp>
#include <terrane/cli/session/journal.hpp>
#include <terrane/cli/stages/blocks.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/cli/stages/kept_stages.hpp>
#include <terrane/cli/stages/layer_stage.hpp>
#include <terrane/cli/stages/outputs.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/cli/stages/plausibility.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/atomic_folder.hpp>
#include <terrane/io/project.hpp>
#include <terrane/io/results.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

struct BuildCommand {
    std::string project;             ///< the file
    std::string folder;              ///< empty: the folder that the project names
    FileOptions page;                ///< --report, and what the page says of the inputs
    std::optional<unsigned> threads; ///< none: the number that the project names
    PairCheckOptions check{PairCheck::bounds, SIZE_MAX};
    bool strict = false; ///< warnings about the inputs are errors
    bool resume = false; ///< stages that take long are kept until the run ends well
};

/// Returns the paths of the input files, one per entry of "surfaces".
std::vector<std::string> surface_files(const Project& project) {
    std::vector<std::string> files;
    for (const ProjectSurfaces& entry : project.surfaces) files.push_back(entry.file.string());
    return files;
}

/// Runs one project, from reading its file to publishing the folder of results.
class Build {
public:
    Build(const Project& project, const BuildCommand& command, page::Page page, FileOptions files,
          Session& session) :
        project_(project),
        page_(std::move(page)), page_files_(std::move(files)), source_(command.project),
        folder_(project.folder), strict_(command.strict), session_(session) {
        if (command.resume && !folder_.empty()) kept_ = KeptStages::beside(folder_);
    }

    Result<ExitStatus> operator()() {
        auto status = run();
        if (!kept_) return status;
        if (status && *status == ExitStatus::done)
            when_written([kept = *kept_] { kept.remove(); });
        else if (kept_->any())
            print(stderr, complaint(fmt::format("finished stages are kept in {}; --resume goes on "
                                                "from there",
                                                kept_->folder().string())));
        return status;
    }

private:
    Result<ExitStatus> run() {
        journal_.note(fmt::format("terrane {}, {}", TERRANE_VERSION, source_));
        if (auto done = check(); !done) return done.error();
        if (auto done = read(); !done) return done.error();
        if (auto done = make(); !done && refused_.empty()) return done.error();
        if (!refused_.empty()) return refuse(refused_);
        if (built_.filled && !built_.filled->report.violations.empty())
            return refuse(violations_text(built_.filled->report) + complaint("nothing written"));
        if (doubts_) return *doubts_;
        if (auto done = write(); !done) return done.error();
        add_certificates();
        if (auto done = write_the_page(); !done) return done.error();
        return ExitStatus::done;
    }

    Status write_the_page() { return write_page(page_, page_files_, statistics_, session_); }

    /// Adds the verdicts about the certificates that are among the results.
    void add_certificates() {
        for (const std::string& name : written_)
            if (name.starts_with("certificate"))
                add_page_certificate(page_, page_files_, (folder_ / name).string(), true, session_);
    }

    Result<ExitStatus> refuse(const std::string& reason) {
        print(stderr, reason);
        if (auto done = write_the_page(); !done) return done.error();
        return ExitStatus::negative;
    }

    /// Reports configuration errors before the work starts.
    Status check() {
        if (folder_.empty())
            return Error{ErrorCode::bad_option, "the key folder is missing, and there is no -o",
                         source_};
        if (auto possible = check_certifiable(project_); !possible) return possible;
        if (project_.outputs.certificate) {
            auto certified = surface_files(project_);
            if (const auto* within = std::get_if<ProjectWithin>(&project_.volume))
                for (const fs::path& file : within->files) certified.push_back(file.string());
            if (auto named =
                    check_certified_names((folder_ / "certificate.json").string(), certified);
                !named)
                return named;
        }
        if (!project_.outputs.tetrahedra.empty())
            if (const auto helper = find_tetgen_helper(); !helper)
                return Error{helper.error().code, helper.error().message(),
                             source_ + ": outputs.tetrahedra"};
        return check_new_folder(folder_);
    }

    Status read() {
        StageTimer timer(session_.run(), "read");
        begin_stage("read", Phase::computing);
        auto inputs = terrane::read_inputs(project_, session_.run());
        session_.end_stage();
        if (!inputs) return inputs.error();
        read_ = std::move(*inputs);
        if (auto sound = check_read_names(); !sound) return sound;
        inputs_.surfaces_of_file = read_.surfaces_of_entry;
        describe(read_.build.surfaces, inputs_);
        inputs_.vertices = read_.vertices;
        inputs_.triangles = read_.triangles;
        inputs_.strict = strict_;
        for (std::size_t f = 0; f < read_.surfaces_of_entry.size(); ++f)
            inputs_.files.insert(inputs_.files.end(), read_.surfaces_of_entry[f],
                                 project_.surfaces[f].file.string());
        if (auto added = add_page_inputs(page_, page_files_, inputs_); !added) return added;
        timer.stop();
        statistics_ = statistics_of(inputs_);
        statistics_["resumed"] = Json::array();
        add_constants(statistics_, "plausibility", plausibility_constants());
        const PlausibilityContext use{read_.build.boundary, wants_blocks()};
        session_.begin("plausibility", Phase::computing);
        auto sound = report_doubts(find_doubts(read_.build.surfaces, use), inputs_.labels,
                                   inputs_.strict, statistics_);
        session_.end_stage();
        return sound;
    }

    /// Checks that a certificate can state the names of the surfaces, if one is wanted.
    [[nodiscard]] Status check_read_names() const {
        if (!project_.outputs.certificate) return Done{};
        std::vector<std::string> names, paths;
        for (std::size_t entry = 0; entry < project_.surfaces.size(); ++entry)
            paths.insert(paths.end(), read_.surfaces_of_entry[entry],
                         project_.surfaces[entry].file.string());
        for (const SurfaceInfo& surface : read_.as_read) names.push_back(surface.name);
        return check_certified_surfaces(names, paths);
    }

    Status make() {
        const BuildObserver observer{
            .begins = [&](BuildStage stage) { begins(stage); },
            .ended = [&](BuildStage stage, const Built& built) { ended(stage, built); },
            .taken = [&](BuildStage stage) { taken(stage); }};
        auto built = terrane::build(project_, std::move(read_.build), session_.run(), observer,
                                    kept_ ? kept_->store() : StageStore{});
        session_.end_stage();
        if (!built) return built.error();
        built_ = std::move(*built);
        return Done{};
    }

    void begins(BuildStage stage) { begin_stage(name_of(stage), Phase::computing); }

    void taken(BuildStage stage) {
        journal_.say(fmt::format("taken from {}\n", kept_->folder().string()));
        statistics_["resumed"].push_back(name_of(stage));
    }

    /// Counts the stages of the project: reading, those that are wanted, and writing.
    [[nodiscard]] std::size_t stage_count() const {
        const bool mends = !project_.fill.empty() || project_.layers;
        return 4 + std::size_t{mends} + std::size_t{project_.improve.has_value()} +
               std::size_t{!project_.outputs.tetrahedra.empty()};
    }

    /// Says which stage begins, in log.txt and on standard output at once.
    void begin_stage(std::string_view name, Phase phase) {
        const auto text = fmt::format("stage {} of {}: {}", ++stages_begun_, stage_count(), name);
        journal_.note(text);
        say(stdout, text + "\n");
        std::fflush(stdout);
        session_.number(stages_begun_, stage_count());
        session_.begin(name, phase);
    }
    /// Prints what a stage did and adds it to the statistics.
    void ended(BuildStage stage, const Built& built) {
        session_.begin("summary", Phase::computing);
        add_stage(stage, built);
        session_.end_stage();
    }
    void add_stage(BuildStage stage, const Built& built) {
        switch (stage) {
        case BuildStage::preprocess:
            return preprocessed(built.preprocessed);
        case BuildStage::arrange:
            inputs_.labels = built.labels;
            add_statistics(statistics_, built.arranged, inputs_);
            journal_.say(summary(inputs_, built.arranged));
            page_.add_arranged(built.arranged);
            if (!built.arranged.rounded.conforming)
                refused_ = offending_pairs(inputs_, built.arranged) +
                           complaint("no blocks without a conforming mesh; nothing written");
            return;
        case BuildStage::improve:
            add_statistics(statistics_, *built.improved);
            if (!keeps_volumes(*built.improved, strict_)) refused_ = complaint("nothing written");
            page_.add_improved(built.improved->improved.mesh, built.arranged.rounded.mesh);
            return journal_.say(resolution_text(statistics_, built.arranged, inputs_) +
                                improve_text(*built.improved, inputs_));
        case BuildStage::blocks:
            add_statistics(statistics_, *built.model);
            if (auto judged = judge_leaks(built.arranged, *built.model, session_)) leaks_ = *judged;
            journal_.say(model_text(inputs_, *built.model, leaks_));
            page_.add_model(*built.model, leaks_);
            return doubt(*built.model);
        case BuildStage::tetrahedra:
            add_statistics(statistics_, *built.filled);
            add_changes(statistics_, built);
            page_.add_tetrahedra(*built.filled);
            return journal_.say(changes_text(built, inputs_.unit) +
                                filled_text(*built.filled, inputs_.unit));
        }
    }

    [[nodiscard]] bool wants_blocks() const {
        return !project_.outputs.blocks.empty() || !project_.outputs.tetrahedra.empty() ||
               project_.outputs.gocad;
    }

    /// Warns about the blocks; with --strict nothing will be written.
    void doubt(const Model& model) {
        const auto sound = examine(model, inputs_, wants_blocks(), session_, statistics_);
        if (!sound) doubts_ = sound.error();
    }

    void preprocessed(const Preprocessed& done) {
        std::string said;
        if (done.filled) {
            said += borders_text(*done.filled) + filled_text(*done.filled);
            refused_ = refusals_text(*done.filled);
            if (!done.contacts.empty())
                refused_ += complaint("new triangles meet other triangles") +
                            contacts_text(*done.filled, done.contacts);
            add_statistics(statistics_, *done.filled);
        }
        if (done.stack) {
            said += text_of(inputs_, done.layers, *done.stack, done.step_width);
            refused_ = flaws_text(*done.stack, done.out_of_order);
            add_statistics(statistics_, inputs_, done.layers);
        }
        journal_.say(said);
        if (!refused_.empty()) refused_ += complaint("nothing written");
    }

    Status write() {
        Stopwatch watch;
        begin_stage("write", Phase::folder);
        auto folder = NewFolder::create(folder_);
        if (!folder) return folder.error();
        const fs::path& to = folder.value().temporary();
        for (const auto step :
             {&Build::write_outputs, &Build::write_interpolated, &Build::write_certificates}) {
            if (auto done = (this->*step)(to); !done) return done;
            if (session_.stopped()) return Error{ErrorCode::interrupted, "", ""};
        }
        written_.insert(written_.end(), {"statistics.json", "log.txt"});
        std::string list;
        for (const std::string& name : written_) list += "  " + name + "\n";
        const auto said = "wrote " + folder_.string() + ":\n" + list;
        session_.begin("write", Phase::folder); // so that the time up to here is known
        if (auto done = write_statistics(statistics_, (to / "statistics.json").string(), session_);
            !done)
            return done;
        journal_.note("done");
        if (auto done = write_file(to / "log.txt", journal_.log() + said); !done) return done;
        auto published = folder.value().publish();
        session_.end_stage();
        if (published) tell_when_written(stdout, said);
        return published;
    }

    /// Returns what was built. It refers to this object.
    [[nodiscard]] Results results() const {
        return {project_,
                *built_.model,
                built_.filled ? &*built_.filled : nullptr,
                built_.arranged.sealed,
                leaks_,
                inputs_.unit};
    }

    Status write_outputs(const fs::path& to) {
        const auto written = write_results(results(), to, session_.run());
        if (!written) return written.error();
        written_.insert(written_.end(), written->begin(), written->end());
        return Done{};
    }

    Status write_interpolated(const fs::path& to) {
        if (!built_.preprocessed.filled) return Done{};
        written_.insert(written_.end(), {"interpolated.csv", "filled.svg"});
        if (auto done = write_file(to / "interpolated.csv", csv_of(*built_.preprocessed.filled));
            !done)
            return done;
        return write_file(to / "filled.svg", map_of(*built_.preprocessed.filled));
    }

    Status write_certificates(const fs::path& to) {
        const auto written =
            terrane::write_certificates(results(), read_, built_.arranged, to, session_.run());
        if (!written) return written.error();
        for (const WrittenCertificate& c : *written) {
            warn_of_deviation(c.name, c.deviation, built_.arranged.surfaces);
            written_.push_back(c.name);
        }
        return Done{};
    }

    const Project& project_;
    page::Page page_;
    FileOptions page_files_; ///< the project's, with --report
    std::string source_;     ///< the project file
    fs::path folder_;
    bool strict_; ///< warnings about the inputs are errors
    Session& session_;
    Journal journal_;
    Json statistics_;
    Inputs inputs_;      ///< names and counts; the surfaces are in built_
    ProjectInputs read_; ///< its surfaces move into the build
    std::size_t stages_begun_ = 0;
    std::optional<Error> doubts_;     ///< about the blocks, with --strict
    std::optional<LeakAdvice> leaks_; ///< none: not judged
    std::string refused_;             ///< why nothing is written; empty: all is well
    Built built_;
    std::optional<KeptStages> kept_;   ///< none: stages are not kept
    std::vector<std::string> written_; ///< names in the folder
};

Result<ExitStatus> build(const BuildCommand& command) {
    Session session(command.threads.value_or(0));
    auto project = read_project(command.project);
    if (!project) return project.error();
    if (!command.folder.empty()) project->folder = command.folder;
    if (auto sound = check_project_files(*command.page.app, *project); !sound) return sound.error();
    project->check = command.check;
    session.use_threads(command.threads.value_or(project->threads));
    FileOptions page_files = command.page;
    page_files.inputs = surface_files(*project);
    auto page = plan_page(page_files, session);
    if (!page) return page.error();
    return Build(project.value(), command, std::move(*page), std::move(page_files), session)();
}

} // namespace

Command build_command(CLI::App& program) {
    constexpr unsigned most_threads = 1024;
    auto command = std::make_shared<BuildCommand>();
    auto* app = program.add_subcommand("build", "The whole chain from one project file");
    app->add_option("PROJECT", command->project, "What to read, to make and to write, as JSON")
        ->required()
        ->type_name("FILE.json");
    app->add_option("-o,--output", command->folder,
                    "Folder for the results, made by the program (default: as the project says)")
        ->type_name("DIR");
    app->add_option("--threads", command->threads,
                    "How many threads to use; the result is the same (default: as the project "
                    "says)")
        ->check(CLI::Range(0U, most_threads).description(""))
        ->type_name("N");
    add_check(*app, command->check);
    add_report(*app, command->page);
    app->add_flag("--strict", command->strict, "Stop with status 2 at warnings about the inputs");
    app->add_flag("--resume", command->resume,
                  "Keep finished stages in DIR.stages until the run ends well, and take those that "
                  "are there");
    app->footer(build_footer);
    return {app, [command] {
                const auto status = build(*command);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
