// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The report page of a run, which --report writes: one HTML file with the model, what is wrong with
// it, and its numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/leak_advice.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/quality/improve_measured.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/tetgen/fill_blocks.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/page/findings.hpp>
#include <terrane/cli/page/scene.hpp>
#include <terrane/cli/session/console.hpp>

namespace terrane::cli {

/// What one run shows. A command adds what it has, in any order, and writes the page at its end;
/// nothing happens unless a page is wanted.
class Page {
public:
    /// Checks before any work is done that the page can be written. Errors: unsupported in a build
    /// without npm, cannot_open.
    static Result<Page> plan(const FileOptions& files);

    [[nodiscard]] bool wanted() const { return !files_.report.empty(); }

    /// Takes names, roles and unit, and hashes the files. Call it before surfaces are moved.
    Status add_inputs(const Inputs& inputs);
    /// Lists the holes of the surfaces as they are.
    Status add_holes(const Inputs& inputs, const Run& run);
    /// Draws the surfaces as they are, with what an exact check says of them, and their holes.
    Status add_check(const Inputs& inputs, const CheckReport& report, const Run& run);
    /// Draws the rounded mesh, what is left to mend, and what sealing did.
    void add_arranged(const Inputs& inputs, const Arranged& arranged);
    /// Draws an improved mesh instead, and its triangles before and after.
    void add_improved(const Inputs& inputs, const ImprovedAndMeasured& measured,
                      const Mesh& before);
    /// Draws blocks, and the leaks between them.
    void add_model(const Inputs& inputs, const Model& model,
                   const std::optional<LeakAdvice>& leaks);
    /// Adds tetrahedra to the blocks of the model.
    void add_tetrahedra(const FilledBlocks& filled);
    /// Draws surfaces with their filled holes.
    void add_filled(const FillWork& work);
    /// Draws another conforming mesh of the surfaces.
    void add_mesh(const Inputs& inputs, const Mesh& mesh);
    /// States the verdict about the result, a sentence; `good`: it is what was asked for.
    void set_verdict(std::string sentence, bool good);
    /// Names a certificate that the run writes.
    void add_certificate(const std::string& path);

    /// Writes the page, with the statistics of the run.
    Status write(const Json& statistics, double total_seconds);

private:
    explicit Page(const FileOptions& files) : files_(files) {}

    void describe(const std::vector<SurfaceInfo>& surfaces);
    [[nodiscard]] Json surfaces_json() const;
    [[nodiscard]] Json tables(const Json& statistics) const;
    [[nodiscard]] Json content(Json statistics, page::Arrays& arrays);

    FileOptions files_;
    std::string unit_;
    std::vector<SurfaceInfo> surfaces_;
    std::vector<std::string> labels_;  ///< per surface
    std::vector<std::string> sources_; ///< per surface of the input: its file
    Json blocks_ = Json::array();      ///< from block 1 on
    Json tables_ = Json::array();      ///< of the blocks
    Json inputs_ = Json::array();      ///< rows of the table of files
    Json plots_ = Json::array();
    page::Findings findings_;
    page::Findings worst_; ///< triangles, of the last mesh
    std::vector<std::string> certificates_;
    std::string verdict_;
    bool good_ = true;
    page::Scene scene_;
    SharedMesh before_;              ///< before it was improved
    std::optional<SharedMesh> mesh_; ///< whose triangles are measured
};

/// Writes the page and the statistics of a run, as far as they are wanted. Returns the status of a
/// run with this result. Errors: those of writing.
Result<ExitStatus> write_run(Page& page, const Json& statistics, const FileOptions& files,
                             double total_seconds, bool good);

} // namespace terrane::cli
