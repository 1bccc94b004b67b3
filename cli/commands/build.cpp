// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/cli/commands/build_help.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/commands/file_options.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/reports/fill_map.hpp>
#include <terrane/cli/reports/fill_report.hpp>
#include <terrane/cli/reports/pair_report.hpp>
#include <terrane/cli/session/journal.hpp>
#include <terrane/cli/stages/kept_stages.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/cli/stages/page_output.hpp>
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
    PairCheckOptions check = few_pairs;
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
        run_(
            project, std::move(page), std::move(files),
            [this](const std::string& text) { journal_.say(text); }, session),
        source_(command.project), folder_(project.folder), strict_(command.strict),
        session_(session) {
        if (command.resume && !folder_.empty()) kept_ = KeptStages::beside(folder_);
    }

    ExitStatus operator()() {
        try {
            const ExitStatus status = run();
            if (status != ExitStatus::done)
                tell_kept();
            else if (kept_)
                when_written([kept = *kept_] { kept.remove(); });
            return status;
        } catch (const Failure&) {
            tell_kept();
            throw;
        }
    }

private:
    void tell_kept() const {
        if (kept_ && kept_->any())
            print(stderr, complaint(fmt::format("finished stages are kept in {}; --resume goes on "
                                                "from there",
                                                kept_->folder().string())));
    }

    ExitStatus run() {
        journal_.note(fmt::format("terrane {}, {}", TERRANE_VERSION, source_));
        check();
        read();
        make();
        if (!run_.refused().empty()) return end(ExitStatus::negative);
        write();
        for (const std::string& name : written_)
            if (name.starts_with("certificate")) run_.add_certificate((folder_ / name).string());
        return end(ExitStatus::done);
    }

    ExitStatus end(ExitStatus status) {
        run_.write_page();
        return status;
    }

    /// Reports configuration errors before the work starts.
    void check() {
        if (folder_.empty()) refuse("the key folder is missing, and there is no -o", source_);
        must(check_certifiable(project_));
        if (project_.outputs.certificate) {
            auto certified = surface_files(project_);
            if (const auto* within = std::get_if<ProjectWithin>(&project_.volume))
                for (const fs::path& file : within->files) certified.push_back(file.string());
            check_certified_names((folder_ / "certificate.json").string(), certified);
        }
        if (!project_.outputs.tetrahedra.empty())
            if (const auto helper = find_tetgen_helper(); !helper)
                refuse(helper.error().code, helper.error().message(),
                       source_ + ": outputs.tetrahedra");
        must(check_new_folder(folder_));
    }

    void read() {
        StageTimer timer(session_.run(), "read");
        begin_stage("read", Phase::computing);
        read_ = must(terrane::read_inputs(project_, session_.run()));
        session_.end_stage();
        check_read_names();
        Inputs inputs;
        inputs.surfaces_of_file = read_.surfaces_of_entry;
        describe(read_.build.surfaces, inputs);
        inputs.vertices = read_.vertices;
        inputs.triangles = read_.triangles;
        inputs.strict = strict_;
        for (std::size_t f = 0; f < read_.surfaces_of_entry.size(); ++f)
            inputs.files.insert(inputs.files.end(), read_.surfaces_of_entry[f],
                                project_.surfaces[f].file.string());
        timer.stop();
        const ProjectOutputs& outputs = project_.outputs;
        const bool needs_blocks =
            !outputs.blocks.empty() || !outputs.tetrahedra.empty() || outputs.gocad;
        run_.take(std::move(read_.build), std::move(inputs), needs_blocks);
    }

    /// Checks that a certificate can state the names of the surfaces, if one is wanted.
    void check_read_names() const {
        if (!project_.outputs.certificate) return;
        std::vector<std::string> names, paths;
        for (std::size_t entry = 0; entry < project_.surfaces.size(); ++entry)
            paths.insert(paths.end(), read_.surfaces_of_entry[entry],
                         project_.surfaces[entry].file.string());
        for (const SurfaceInfo& surface : read_.as_read) names.push_back(surface.name);
        check_certified_surfaces(names, paths);
    }

    void make() {
        Json resumed = Json::array();
        const BuildObserver observer{
            .begins = [&](BuildStage stage) { begin_stage(name_of(stage), Phase::computing); },
            .taken =
                [&](BuildStage stage) {
                    journal_.say(fmt::format("taken from {}\n", kept_->folder().string()));
                    resumed.push_back(name_of(stage));
                }};
        run_.make(observer, kept_ ? kept_->store() : StageStore{});
        run_.statistics()["resumed"] = std::move(resumed);
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

    void write() {
        Stopwatch watch;
        begin_stage("write", Phase::folder);
        auto folder = must(NewFolder::create(folder_));
        const fs::path& to = folder.temporary();
        for (const auto step :
             {&Build::write_outputs, &Build::write_interpolated, &Build::write_certificates}) {
            (this->*step)(to);
            if (session_.stopped()) refuse(ErrorCode::interrupted, "", "");
        }
        written_.insert(written_.end(), {"statistics.json", "log.txt"});
        std::string list;
        for (const std::string& name : written_) list += "  " + name + "\n";
        const auto said = "wrote " + folder_.string() + ":\n" + list;
        session_.begin("write", Phase::folder); // so that the time up to here is known
        write_statistics(run_.statistics(), (to / "statistics.json").string(), session_);
        journal_.note("done");
        must(write_file(to / "log.txt", journal_.log() + said));
        must(folder.publish());
        session_.end_stage();
        tell_when_written(stdout, said);
    }

    [[nodiscard]] const Built& built() const { return run_.built(); }
    /// Returns what was built. It refers to this object.
    [[nodiscard]] Results results() const {
        return {project_,
                *built().model,
                built().filled ? &*built().filled : nullptr,
                built().arranged.sealed,
                run_.leaks(),
                run_.inputs().unit,
                values_,
                values_of_faces_};
    }

    void write_outputs(const fs::path& to) {
        if (!project_.outputs.certificate) {
            values_ = run_.values_on(built().model->mesh);
            if (built().filled) values_of_faces_ = run_.values_on(built().filled->tetrahedra);
        }
        warn_of_values();
        const auto written = must(write_results(results(), to, session_.run()));
        written_.insert(written_.end(), written.begin(), written.end());
    }

    /// Names the values that formats of the outputs have no place for.
    void warn_of_values() const {
        if (project_.outputs.certificate && !built().given.empty())
            warn(
                "values on points and triangles are left out of files that a certificate is about");
        const auto warn_of = [](const std::vector<std::string>& formats,
                                std::span<const SurfaceValues> values) {
            for (const std::string& format : formats)
                if (const auto names = values_left_out(*format_named(format), values);
                    !names.empty())
                    warn(fmt::format("the format {} has no place for these values: {}", format,
                                     fmt::join(names, ", ")));
        };
        warn_of(project_.outputs.surfaces, values_);
        warn_of(project_.outputs.tetrahedra, values_of_faces_);
    }

    void write_interpolated(const fs::path& to) {
        if (!built().preprocessed.filled) return;
        written_.insert(written_.end(), {"interpolated.csv", "filled.svg"});
        must(write_file(to / "interpolated.csv", csv_of(*built().preprocessed.filled)));
        must(write_file(to / "filled.svg", map_of(*built().preprocessed.filled)));
    }

    void write_certificates(const fs::path& to) {
        const auto written = must(
            terrane::write_certificates(results(), read_, built().arranged, to, session_.run()));
        for (const WrittenCertificate& c : written) {
            warn_of_refusal(c.name, to / c.name, result_of(built().arranged));
            written_.push_back(c.name);
        }
    }

    const Project& project_;
    Journal journal_;
    ModelRun run_;
    std::string source_; ///< the project file
    fs::path folder_;
    bool strict_; ///< warnings about the inputs are errors
    Session& session_;
    ProjectInputs read_; ///< its surfaces move into the build
    std::size_t stages_begun_ = 0;
    std::optional<KeptStages> kept_;                      ///< none: stages are not kept
    std::vector<std::string> written_;                    ///< names in the folder
    std::vector<SurfaceValues> values_, values_of_faces_; ///< of the mesh, and of tetrahedra
};

ExitStatus build(const BuildCommand& command) {
    Session session(command.threads.value_or(0));
    auto project = must(read_project(command.project));
    if (!command.folder.empty()) project.folder = command.folder;
    check_project_files(*command.page.app, project);
    project.check = command.check;
    session.use_threads(command.threads.value_or(project.threads));
    FileOptions page_files = command.page;
    page_files.inputs = surface_files(project);
    auto page = plan_page(page_files, session);
    return Build(project, command, std::move(page), std::move(page_files), session)();
}

} // namespace

Command build_command(CLI::App& program) {
    constexpr unsigned most_threads = 1024;
    auto command = std::make_shared<BuildCommand>();
    auto* app = program.add_subcommand("build", "The whole chain from one project file");
    add_value(*app, "PROJECT", command->project, "FILE.json",
              "What to read, to make and to write, as JSON")
        ->required();
    add_value(*app, "-o,--output", command->folder, "DIR",
              "Folder for the results, made by the program (default: as the project says)");
    add_value(*app, "--threads", command->threads, "N",
              "How many threads to use; the result is the same (default: as the project "
              "says)")
        ->check(CLI::Range(0U, most_threads).description(""));
    add_check(*app, command->check);
    add_report(*app, command->page);
    app->add_flag("--strict", command->strict, "Stop with status 2 at warnings about the inputs");
    app->add_flag("--resume", command->resume,
                  "Keep finished stages in DIR.stages until the run ends well, and take those that "
                  "are there");
    app->footer(build_footer);
    return {app, [command] { return build(*command); }};
}

} // namespace terrane::cli
