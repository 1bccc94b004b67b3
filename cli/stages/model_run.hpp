// SPDX-License-Identifier: LGPL-3.0-or-later
//
// One run of a command that makes a model: it builds a project, and tells of each stage on the terminal,
// in the statistics, on the report page and in a certificate.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/options/volume_options.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/io/page/page.hpp>

namespace terrane::cli {

/// What a command takes that makes a model of the surfaces of files.
struct ModelCommand {
    FileOptions files;
    Project project;                ///< what to make of the surfaces, but for the options below
    VolumeOptions volume;           ///< the volume of interest
    std::vector<std::string> roles; ///< NAME=ROLE
    std::string column;             ///< file; empty: none
    ProofOptions proof;             ///< what proves the result
    bool needs_blocks = false;      ///< whether surfaces should close some
    bool tells_blocks = true;       ///< whether blocks and leaks are listed
};

/// Adds the options of arranging: --search, --rounds, --max-move, --check, --seal, --min-volume and
/// those of the volume of interest.
void add_arranging(CLI::App& app, ModelCommand& command);

/// Adds --role and --column.
void add_naming(CLI::App& app, ModelCommand& command);

/// Checks the options of a command, before any work is done. Errors: bad_option, cannot_open.
void check_command(const ModelCommand& command);

/// Names the option that stands for a key of the project, in an error about that key.
Error at_option(Error error, const CLI::App& app);

class ModelRun {
public:
    /// Says what a stage did.
    using Say = std::function<void(const std::string&)>;

    /// A run of a project whose surfaces the caller reads. Options are those of `files`.
    ModelRun(Project project, page::Page page, FileOptions files, Say say, Session& session) :
        project_(std::move(project)), page_(std::move(page)), files_(std::move(files)),
        say_(std::move(say)), session_(session) {}

    /// Begins the run of a command: checks its options, reads the surfaces, and makes the boundary of the volume
    /// of interest. Errors: those of check_command(), read_inputs(), boundary_of() and read_column();
    /// bad_option for names that no surface has.
    static ModelRun begin(const ModelCommand& command, Session& session);

    /// Takes the surfaces that were read, and looks for mistakes in them. Errors: bad_option with --strict.
    void take(BuildInput input, Inputs inputs, bool needs_blocks);

    /// Looks for mistakes that one more surface suggests, next to those that were taken. Errors: bad_option with
    /// --strict.
    void examine_with(const Surface& other);

    /// Builds the project. Errors: those of build(), but for results that are refused(), with the options that
    /// they are about; of doubts about the blocks with --strict.
    void make(BuildObserver observer = {}, const StageStore& store = {});

    /// Why no results are written, as it was told; empty: they may be.
    [[nodiscard]] const std::string& refused() const { return refused_; }

    /// Writes the certificate of what was built, if one is wanted: of tetrahedra, blocks, the improved
    /// mesh or the arrangement. Errors: those of certify() and of writing.
    void certify(std::vector<ResultFile> outputs);

    /// Adds the verdict about a certificate to the page.
    void add_certificate(const std::string& path);
    void write_page();
    /// Writes the page and the statistics. Returns the status of a run with this result.
    ExitStatus end(bool good);

    [[nodiscard]] const Built& built() const { return built_; }
    [[nodiscard]] const FileOptions& files() const { return files_; }
    /// Returns the values on a mesh that is the result. Files that a certificate is about have none, of
    /// which it warns.
    [[nodiscard]] std::vector<SurfaceValues> values_on(const Mesh& mesh) const;
    [[nodiscard]] std::vector<SurfaceValues> values_on(const TetrahedralMesh& tetrahedra) const;
    [[nodiscard]] const Inputs& inputs() const { return inputs_; }
    [[nodiscard]] const std::vector<Surface>& surfaces() const { return input_.surfaces; }
    [[nodiscard]] const std::vector<Surface>& boundary() const { return input_.boundary; }
    [[nodiscard]] Project& project() { return project_; }
    [[nodiscard]] const std::optional<LeakAdvice>& leaks() const { return leaks_; }
    [[nodiscard]] std::FILE* told() const { return summary_stream(files_); }
    [[nodiscard]] page::Page& page() { return page_; }
    [[nodiscard]] Json& statistics() { return statistics_; }

private:
    void ended(BuildStage stage, const Built& built);
    [[nodiscard]] std::string told_of(const Preprocessed& done);
    [[nodiscard]] std::string told_of(const Arranged& arranged);
    [[nodiscard]] std::string told_of_improved(const Built& built);
    void judge(const Arranged& arranged, const Model& model);
    [[nodiscard]] std::string told_of(const Model& model);
    void refuse(const std::string& why);
    [[nodiscard]] bool leaves_values_out() const;

    Project project_;
    page::Page page_;
    FileOptions files_;
    Say say_;
    Session& session_;
    Inputs inputs_;             ///< without surfaces
    std::vector<Surface> read_; ///< for a certificate: the surfaces as in their files
    BuildInput input_;          ///< moves into the build
    bool needs_blocks_ = false;
    bool tells_blocks_ = true;
    std::string certificate_; ///< file; empty: none
    Json statistics_;
    Built built_;
    std::optional<LeakAdvice> leaks_; ///< none: not judged
    std::optional<Error> doubts_;     ///< about the blocks, with --strict
    std::string refused_;
};

} // namespace terrane::cli
