// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/stopwatch.hpp>
#include <terrane/algorithms/tetgen/tetgen_helper.hpp>
#include <terrane/algorithms/volumes/region_points.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/reports/fill_report.hpp>
#include <terrane/cli/reports/improve_report.hpp>
#include <terrane/cli/reports/tetrahedra_report.hpp>
#include <terrane/cli/stages/blocks.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/cli/stages/project_inputs.hpp>
#include <terrane/cli/stages/project_preprocessing.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/atomic_folder.hpp>
#include <terrane/io/project.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

struct BuildCommand {
    std::string project;             ///< the file
    std::string folder;              ///< empty: as the project says
    std::optional<unsigned> threads; ///< none: as the project says
};

constexpr auto build_footer =
    R"(The whole chain from one file: surfaces are read, on request their holes filled as `terrane fill`
does and horizons put in order as `terrane layer` does, cut by the boundary of the volume of interest
where there is one, arranged and rounded as `terrane arrange` does, made better on request as `terrane
improve` does, their blocks found as `terrane volume` does and filled as `terrane tetrahedralize`
does. All results go to one new folder:

  surfaces.vtp, ...      the conforming mesh, in the formats that outputs.surfaces names
  tetrahedra.vtu, ...    likewise, outputs.tetrahedra
  model/                 blocks, interfaces and model.json, with outputs.blocks
  invented.csv           points that fill made up, with expected errors
  filled.svg             surfaces before and after it
  certificate.json       for `terrane verify`, with outputs.certificate
  statistics.json        counts, times and memory, as --stats of the other commands
  log.txt                what was said, with times

The keys of PROJECT.json are in io/project.schema.json, which editors can use; docs/reference/project.md
explains them. A small one:

  {
    "format": "terrane-project 1",
    "folder": "run",
    "surfaces": [
      {"file": "horizons.ml", "role": "horizon"},
      {"file": "faults.ts", "objects": ["F1", "F2"], "role": "fault"}
    ],
    "volume_of_interest": {"box": {"low": [0, 0, -3000], "high": [9000, 9000, 500]}},
    "tetrahedra": {"edge_length": 400, "size_of": {"F1": 100}, "split": ["fault"]},
    "outputs": {"tetrahedra": ["vtu", "msh"], "blocks": "vtp"}
  }

Examples:
  terrane build project.json
  terrane build project.json -o another_run --threads 4)";

/// What is said, on the terminal and for log.txt, there with times.
class Journal {
public:
    void say(std::string_view text) {
        print(stdout, text);
        log_ += text;
    }
    /// In the log only.
    void note(std::string_view text) { log_ += fmt::format("[{:9.2f} s] {}\n", seconds(), text); }

    /// Since it was made.
    double seconds() { return seconds_ += watch_.lap(); }
    [[nodiscard]] const std::string& log() const { return log_; }

private:
    Stopwatch watch_;
    double seconds_ = 0;
    std::string log_;
};

/// A run, from its project to its folder.
class Build {
public:
    Build(const Project& project, std::string source, fs::path folder, Session& session) :
        project_(project), source_(std::move(source)), folder_(std::move(folder)),
        session_(session) {}

    Result<ExitStatus> operator()() {
        journal_.note(fmt::format("terrane {}, {}", TERRANE_VERSION, source_));
        if (auto done = check(); !done) return done.error();
        if (auto done = read(); !done) return done.error();
        if (auto done = mend_surfaces(); !done) return done.error();
        if (!mended_.refused.empty()) {
            print(stderr, mended_.refused + "terrane: nothing written\n");
            return ExitStatus::negative;
        }
        if (auto done = arrange_all(); !done) return done.error();
        if (!arranged_->rounded.report.clean) {
            print(stderr, offending_pairs(inputs_, *arranged_));
            print(stderr, "terrane: no blocks without a conforming mesh; nothing written\n");
            return ExitStatus::negative;
        }
        if (auto done = improve_triangles(); !done) return done.error();
        if (auto done = find_blocks(); !done) return done.error();
        if (auto done = fill_blocks(); !done) return done.error();
        if (filled_ && !filled_->report.violations.empty()) {
            print(stderr, violations_text(filled_->report) + "terrane: nothing written\n");
            return ExitStatus::negative;
        }
        if (auto done = write(); !done) return done.error();
        return ExitStatus::done;
    }

private:
    /// Reports errors of the configuration before the work starts.
    Status check() {
        if (folder_.empty())
            return Error{ErrorCode::bad_option, "the key folder is missing, and there is no -o",
                         source_};
        for (std::size_t i = 0; i < project_.surfaces.size(); ++i)
            if (project_.outputs.certificate && !project_.surfaces[i].objects.empty())
                return Error{ErrorCode::bad_option,
                             "a certificate is about whole files, not about some of their objects",
                             fmt::format("{}: surfaces[{}].objects", source_, i)};
        if (!project_.outputs.tetrahedra.empty())
            if (const auto helper = find_tetgen_helper(); !helper)
                return Error{helper.error().code, helper.error().message(),
                             source_ + ": outputs.tetrahedra"};
        return check_new_folder(folder_);
    }

    Status read() {
        journal_.note("read");
        auto inputs = read_inputs(project_, source_, session_);
        if (!inputs) return inputs.error();
        inputs_ = std::move(inputs.value().inputs);
        as_read_ = std::move(inputs.value().as_read);
        statistics_ = statistics_of(inputs_);
        auto boundary = boundary_of(project_, source_, session_);
        if (!boundary) return boundary.error();
        boundary_ = std::move(boundary).value();
        return Done{};
    }

    Status mend_surfaces() {
        if (project_.fill.empty() && !project_.layers) return Done{};
        journal_.note("mend");
        auto mended = mend(project_, source_, inputs_, session_, statistics_);
        if (!mended) return mended.error();
        mended_ = std::move(mended).value();
        journal_.say(mended_.said);
        return Done{};
    }

    Status arrange_all() {
        journal_.note("arrange");
        ArrangeSettings settings;
        settings.seal = project_.seal.value_or(0);
        settings.volume.extend = project_.extend.value_or(0);
        auto arranged =
            arrange_within(inputs_, std::move(boundary_), settings, session_, statistics_);
        if (!arranged) return arranged.error();
        arranged_ = std::move(arranged).value();
        journal_.say(summary(inputs_, *arranged_));
        return Done{};
    }

    [[nodiscard]] const Mesh& mesh() const {
        return better_ ? better_->mesh : arranged_->rounded.mesh;
    }

    Status improve_triangles() {
        if (!project_.improve) return Done{};
        journal_.note("improve");
        const ProjectImprove& wanted = *project_.improve;
        ImproveOptions options;
        options.edge_length = wanted.edge_length.value_or(0);
        options.max_deviation = wanted.max_deviation.value_or(0);
        if (!wanted.edge_length_of.empty()) options.edge_length_of.resize(mesh().surfaces.size());
        for (const auto& [name, length] : wanted.edge_length_of) {
            const auto found = surfaces_called(name, mesh().surfaces, inputs_.labels);
            if (found.empty())
                return Error{ErrorCode::bad_option, "no surface is called " + name,
                             source_ + ": improve.edge_length_of." + name};
            for (const std::uint32_t s : found) options.edge_length_of[s] = length;
        }
        auto measured =
            improve_and_measure(*arranged_->rounded.conforming, options, session_, statistics_);
        if (!measured) return measured.error();
        add_statistics(statistics_, measured.value());
        journal_.say(improve_text(measured.value(), inputs_));
        better_ = std::move(measured.value().improved);
        return Done{};
    }

    Status find_blocks() {
        journal_.note("blocks");
        auto model = better_ ? find_model(*arranged_, *better_, session_, statistics_)
                             : find_model(*arranged_, session_, statistics_);
        if (!model) return model.error();
        model_ = std::move(model).value();
        journal_.say(model_text(inputs_, *model_));
        return Done{};
    }

    [[nodiscard]] TetrahedraRequest wishes() const {
        const ProjectTetrahedra& t = project_.tetrahedra;
        const std::string start = source_ + ": tetrahedra.";
        TetrahedraRequest w;
        w.options.edge_length = t.edge_length;
        w.options.max_volume = t.max_volume;
        w.options.radius_edge_ratio = t.quality;
        w.options.time_limit = t.time_limit;
        for (const auto& [name, length] : t.size_of)
            w.size_of.push_back({{name, fmt::format("{}size_of.{}", start, name)}, length});
        for (const auto& [name, length] : t.size_in)
            w.size_in.push_back({{name, fmt::format("{}size_in.{}", start, name)}, length});
        for (std::size_t i = 0; i < t.split.size(); ++i)
            w.split.push_back({t.split[i], fmt::format("{}split[{}]", start, i)});
        w.outside = t.outside.value_or(project_.volume.index() == 0);
        return w;
    }

    Status fill_blocks() {
        if (project_.outputs.tetrahedra.empty()) return Done{};
        journal_.note("tetrahedra");
        session_.begin("tetrahedralize", Phase::computing);
        auto filled = terrane::fill_blocks(*model_, wishes(), session_.run());
        session_.end_stage();
        if (!filled) return filled.error();
        filled_ = std::move(filled).value();
        add_statistics(statistics_, *filled_);
        journal_.say(filled_text(*filled_));
        return Done{};
    }

    Status write() {
        Stopwatch watch;
        journal_.note("write");
        session_.begin("write", Phase::computing);
        auto folder = NewFolder::create(folder_);
        if (!folder) return folder.error();
        const fs::path& to = folder.value().temporary();
        for (const auto step :
             {&Build::write_surfaces, &Build::write_tetrahedra_files, &Build::write_blocks,
              &Build::write_invented, &Build::write_certificate}) {
            if (auto done = (this->*step)(to); !done) return done;
            if (session_.stopped()) return Error{ErrorCode::interrupted, "", ""};
        }
        statistics_["seconds"]["write"] = watch.lap();
        written_.insert(written_.end(), {"statistics.json", "log.txt"});
        std::string list;
        for (const std::string& name : written_) list += "  " + name + "\n";
        const auto said = "wrote " + folder_.string() + ":\n" + list;
        if (auto done = write_statistics(statistics_, (to / "statistics.json").string(),
                                         journal_.seconds());
            !done)
            return done;
        journal_.note("done");
        if (auto done = write_file(to / "log.txt", journal_.log() + said); !done) return done;
        auto published = folder.value().publish();
        session_.end_stage();
        if (published) print(stdout, said);
        return published;
    }

    /// "surfaces.obj"; MSH 2.2 is "surfaces_22.msh", so that both versions have room.
    static std::string file_name(const std::string& start, const std::string& format) {
        return start + (format == "msh22" ? "_22.msh" : "." + format);
    }

    Status write_surfaces(const fs::path& to) {
        WriteOptions options;
        options.ascii = true; // STL: binary ones hold other numbers than those that were checked
        std::vector<RegionPoint> points;
        for (const std::string& format : project_.outputs.surfaces) {
            options.format = format_named(format);
            if (points.empty() && (format == "poly" || format == "smesh")) {
                auto found = region_points(mesh(), model_->volumes, session_.run());
                if (!found) return found.error();
                points = std::move(found).value();
                options.regions = points;
            }
            written_.push_back(file_name("surfaces", format));
            if (auto done = write_mesh(mesh(), to / written_.back(), options); !done) return done;
        }
        return Done{};
    }

    Status write_tetrahedra_files(const fs::path& to) {
        if (!filled_) return Done{};
        WriteOptions options;
        options.region_names = filled_->block_names;
        for (const std::string& format : project_.outputs.tetrahedra) {
            options.format = format_named(format);
            written_.push_back(file_name("tetrahedra", format));
            if (auto done = write_tetrahedra(filled_->tetrahedra, to / written_.back(), options);
                !done)
                return done;
        }
        return Done{};
    }

    Status write_blocks(const fs::path& to) {
        if (project_.outputs.blocks.empty()) return Done{};
        std::error_code failed;
        fs::create_directory(to / "model", failed);
        if (failed)
            return Error{ErrorCode::cannot_open, "cannot be made: " + failed.message(),
                         (to / "model").string()};
        written_.emplace_back("model/");
        return write_model(*model_, arranged_->sealed, project_.outputs.blocks, to / "model",
                           session_);
    }

    Status write_invented(const fs::path& to) {
        if (!mended_.filled) return Done{};
        written_.insert(written_.end(), {"invented.csv", "filled.svg"});
        if (auto done = write_file(to / "invented.csv", csv_of(*mended_.filled)); !done)
            return done;
        return write_file(to / "filled.svg", map_of(*mended_.filled));
    }

    Status write_certificate(const fs::path& to) {
        if (!project_.outputs.certificate) return Done{};
        written_.emplace_back("certificate.json");
        const auto path = to / written_.back();
        Inputs as_read = inputs_; // the verifier reads the files, not the project
        for (std::size_t s = 0; s < as_read_.size(); ++s) {
            as_read.surfaces[s].name = as_read_[s].name;
            as_read.surfaces[s].role = as_read_[s].role;
        }
        const auto text =
            certificate_text(path.string(), files_of(project_), as_read, *arranged_, session_);
        if (!text) return text.error();
        return write_file(path, text.value());
    }

    const Project& project_;
    std::string source_; ///< the project file
    fs::path folder_;
    Session& session_;
    Journal journal_;
    Json statistics_;
    Inputs inputs_;
    std::vector<SurfaceInfo> as_read_; ///< per surface of a file
    std::vector<Surface> boundary_;    ///< of the volume of interest, until surfaces are arranged
    Preprocessed mended_;              ///< where the project asks for it
    std::optional<Arranged> arranged_;
    std::optional<Improved> better_; ///< where the project asks for it
    std::optional<Model> model_;
    std::optional<FilledBlocks> filled_;
    std::vector<std::string> written_; ///< names in the folder
};

Result<ExitStatus> build(const BuildCommand& command) {
    const auto project = read_project(command.project);
    if (!project) return project.error();
    Session session(command.threads.value_or(project.value().threads));
    const fs::path folder =
        command.folder.empty() ? project.value().folder : fs::path(command.folder);
    return Build(project.value(), command.project, folder, session)();
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
    app->footer(build_footer);
    return {app, [command] {
                const auto status = build(*command);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
