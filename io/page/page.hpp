// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The report page of a run: one HTML file with the model, its flaws, and its numbers.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/io/page/arrays.hpp>
#include <terrane/io/page/findings.hpp>
#include <terrane/io/page/json.hpp>
#include <terrane/io/page/scene.hpp>

namespace terrane::page {

/// The facts of a run that are known before its results.
struct PageFacts {
    std::string command;                                      ///< that makes the page
    std::string title;                                        ///< of the inputs; may be empty
    std::string unit;                                         ///< of all coordinates; empty: none
    std::vector<std::pair<std::string, std::string>> options; ///< and their values
    std::vector<std::string> files; ///< per surface of the input: its file; may be empty
};

/// The verdict of the verifier about a certificate.
struct CertificateVerdict {
    std::string file;               ///< of the certificate
    std::optional<bool> valid;      ///< none: it could not be judged
    std::vector<std::string> lines; ///< sentences; >= 1
};

/// Returns a sentence about holes of which all, or not all, that were chosen are filled.
const char* filling_verdict(bool all);

/// Checks that this build can make pages. Errors: unsupported, with the reason.
Status check_pages();

/// The page of one run. Add its results in any order, and take the page at the end. Nothing
/// happens unless a page is wanted.
class Page {
public:
    Page() = default; ///< no page is wanted
    /// `timing` is told how long the page took, as Run::timing is.
    explicit Page(PageFacts facts, std::function<void(std::string_view, double)> timing = {}) :
        wanted_(true), facts_(std::move(facts)) {
        run_.timing = std::move(timing);
    }

    [[nodiscard]] bool wanted() const { return wanted_; }
    /// Adds facts that are known only after the page was begun.
    void set_inputs(std::string unit, std::vector<std::string> files);
    /// Lists an input file with its size and SHA-256; "-" is standard input, of which neither is
    /// known. Errors: cannot_open.
    Status add_file(const std::string& path);

    /// Lists the holes of the surfaces as they are. Errors: those of find_border_loops.
    Status add_holes(std::span<const Surface> surfaces, const Run& run);
    /// Draws the surfaces as they are, with the findings of an exact check, and their holes.
    /// Errors: those of find_border_loops.
    Status add_check(std::span<const Surface> surfaces, const CheckReport& report, const Run& run);
    /// Draws surfaces with the listed flaws of a judged mesh: those of the mesh, or those that it fills.
    Status add_judged(std::span<const Surface> surfaces, const MeshJudgement& judged);
    /// Draws a rounded mesh, and the places left to mend.
    void add_rounded(const SharedMesh& mesh, const RoundingReport& report);
    /// Draws the rounded mesh, the places left to mend, and the changes by sealing and merging.
    void add_arranged(const Arranged& arranged);
    /// Lists the gaps that sealing closed or left open, and the blocks that were merged. It follows
    /// add_rounded().
    void add_mended(const std::optional<SealReport>& sealed,
                    const std::optional<BlockMerge>& merged);
    /// Draws an improved mesh instead, and its triangles before and after.
    void add_improved(const SharedMesh& improved, const SharedMesh& before);
    /// Draws blocks, and the leaks between them.
    void add_model(const Model& model, const std::optional<LeakAdvice>& leaks);
    /// Adds tetrahedra to the blocks of the model.
    void add_tetrahedra(const FilledBlocks& filled);
    /// Draws surfaces with their filled holes.
    void add_filled(const FillWork& work);
    /// Draws another conforming mesh of the surfaces.
    void add_mesh(const SharedMesh& mesh);
    /// States the verdict about the result, a sentence; `good`: the wish was fulfilled.
    void set_verdict(std::string sentence, bool good);
    /// Adds what the verifier says of a certificate. One that it refutes makes the page's verdict
    /// a bad one.
    void add_certificate(CertificateVerdict verdict);

    /// Returns the page. `statistics` are those of the run, without what differs from run to run,
    /// which is in `run`. It may be called once. Errors: those of check_pages().
    Result<std::string> html(Json statistics, const Json& run);

private:
    void describe(const std::vector<SurfaceInfo>& surfaces);
    [[nodiscard]] Json surfaces_json() const;
    [[nodiscard]] Json verdict_table() const;
    [[nodiscard]] Json certificates_json() const;
    [[nodiscard]] Json tables(const Json& statistics) const;
    [[nodiscard]] Json content(Json statistics, Arrays& arrays);

    bool wanted_ = false;
    Run run_; ///< its timing alone
    PageFacts facts_;
    std::vector<SurfaceInfo> surfaces_;
    std::vector<std::string> labels_; ///< per surface
    Json blocks_ = Json::array();     ///< from block 1 on
    Json tables_ = Json::array();     ///< of the blocks
    Json inputs_ = Json::array();     ///< rows of the table of files
    Json plots_ = Json::array();
    Findings findings_;
    std::vector<CertificateVerdict> certificates_;
    std::string verdict_;
    bool good_ = true;
    Scene scene_;
    SharedMesh before_;              ///< before it was improved
    std::optional<SharedMesh> mesh_; ///< whose triangles are measured
};

} // namespace terrane::page
