// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/page/page.hpp>

#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/page/contact_lines.hpp>
#include <terrane/io/page/html.hpp>
#include <terrane/io/page/page_bundle.hpp>
#include <terrane/io/page/plots.hpp>
#include <terrane/io/page/tables.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane::page {
namespace {

/// Surfaces of more triangles than this are decimated for view.
constexpr std::size_t most_drawn = 2'000'000;
constexpr std::size_t most_tetrahedra = 1'000'000;
constexpr std::size_t most_findings = 500; ///< of each kind

} // namespace

const char* filling_verdict(bool all) {
    return all ? "All chosen holes are filled; the new triangles meet others properly, by an exact "
                 "check."
               : "Not all chosen holes could be filled.";
}

Status check_pages() {
    return guarded("for the page", "page", [&]() -> Status {
        if (bundle() != nullptr) return Done{};
        return Error{
            ErrorCode::unsupported,
            fmt::format("this terrane was built without report pages: {}", bundle_missing()), ""};
    });
}

void Page::set_inputs(std::string unit, std::vector<std::string> files) {
    facts_.unit = std::move(unit);
    facts_.files = std::move(files);
}

Status Page::add_file(const std::string& path) {
    return guarded("for the page", "page", [&]() -> Status {
        if (!wanted_) return Done{};
        const StageTimer timer(run_, "page");
        if (path == "-") {
            inputs_.push_back({"standard input", nullptr, nullptr});
            return Done{};
        }
        auto row = file_row(path);
        if (!row) return row.error();
        inputs_.push_back(*std::move(row));
        return Done{};
    });
}

void Page::describe(const std::vector<SurfaceInfo>& surfaces) {
    surfaces_ = surfaces;
    labels_ = unique_labels(surfaces_);
}

Status Page::add_check(std::span<const Surface> surfaces, const CheckReport& report,
                       const Run& run) {
    return guarded("for the page", "page", [&]() -> Status {
        if (!wanted_) return Done{};
        const StageTimer timer(run_, "page");
        add_mesh(SharedMesh(concatenate(surfaces)));
        add_flaws(findings_, report, surfaces);
        add_contact_lines(scene_, **mesh_, report.contacts);
        set_verdict(report.clean() ? "The surfaces are conforming, by an exact check."
                                   : "The surfaces are not conforming, by an exact check.",
                    report.clean());
        return add_holes(surfaces, run);
    });
}

Status Page::add_judged(std::span<const Surface> surfaces, const MeshJudgement& judged) {
    return guarded("for the page", "page", [&]() -> Status {
        if (!wanted_) return Done{};
        const StageTimer timer(run_, "page");
        add_mesh(SharedMesh(concatenate(surfaces)));
        add_flaws(findings_, judged, surfaces);
        set_verdict(!judged.holds()     ? "Not all properties hold."
                    : judged.complete() ? "All properties hold."
                                        : "No property fails, but not all are judged.",
                    judged.holds() && judged.complete());
        return Done{};
    });
}

Status Page::add_holes(std::span<const Surface> surfaces, const Run& run) {
    return guarded("for the page", "page", [&]() -> Status {
        if (!wanted_) return Done{};
        const StageTimer timer(run_, "page");
        return page::add_holes(findings_, surfaces, run);
    });
}

void Page::add_mesh(const SharedMesh& mesh) {
    if (!wanted_) return;
    const StageTimer timer(run_, "page");
    describe(mesh->surfaces);
    scene_ = scene_of(*mesh);
    mesh_ = mesh;
}

void Page::add_rounded(const SharedMesh& mesh, const RoundingReport& report) {
    if (!wanted_) return;
    const StageTimer timer(run_, "page");
    add_mesh(mesh);
    add_contacts(findings_, *mesh, report, labels_);
    add_contact_lines(scene_, *mesh, report.contacts);
    set_verdict(report.clean ? "The mesh is conforming, by an exact check of its doubles."
                             : fmt::format("The mesh is not conforming: {} left.",
                                           counted(report.contacts.size(), "improper contact")),
                report.clean);
}

void Page::add_mended(const std::optional<SealReport>& sealed,
                      const std::optional<BlockMerge>& merged) {
    if (wanted_) add_seal(findings_, sealed, merged, labels_);
}

void Page::add_arranged(const Arranged& arranged) {
    add_rounded(arranged.rounded.mesh, arranged.rounded.report);
    add_mended(arranged.sealed, arranged.merged);
}

void Page::add_improved(const SharedMesh& improved, const SharedMesh& before) {
    if (!wanted_) return;
    const StageTimer timer(run_, "page");
    before_ = before;
    scene_ = scene_of(*improved);
    mesh_ = improved;
}

void Page::add_model(const Model& model, const std::optional<LeakAdvice>& leaks) {
    if (!wanted_) return;
    const StageTimer timer(run_, "page");
    describe(model.mesh->surfaces);
    scene_ = scene_of(model);
    mesh_ = model.mesh.mesh();
    blocks_ = blocks_json(model, labels_);
    for (auto& table : block_tables(model, labels_)) tables_.push_back(std::move(table));
    add_leaks(findings_, model, leaks, labels_);
    add_thin_blocks(findings_, model);
    add_volume_plot(plots_, model);
    add_gap_plot(plots_, model.borders);
}

void Page::add_tetrahedra(const FilledBlocks& filled) {
    if (!wanted_) return;
    const StageTimer timer(run_, "page");
    page::add_tetrahedra(scene_, filled.tetrahedra, most_tetrahedra);
    add_worst_tetrahedra(findings_, filled.tetrahedra, filled.block_names);
    add_tetrahedra_plots(plots_, filled.report.shape);
    std::size_t flaws = 0;
    for (const TetrahedraViolation& v : filled.report.violations) flaws += v.count;
    if (flaws > 0)
        set_verdict(fmt::format("The tetrahedra are not what they must be: {}.",
                                counted(flaws, "violation")),
                    false);
}

void Page::add_filled(const FillWork& work) {
    if (!wanted_) return;
    const StageTimer timer(run_, "page");
    std::vector<Surface> surfaces;
    for (const HoledSurface& s : work.surfaces) surfaces.push_back(s.filled);
    add_mesh(SharedMesh(concatenate(surfaces)));
    split_filled(scene_, work);
    add_fillings(findings_, work);
    add_fill_plots(plots_, work);
    tables_.push_back(fill_table(work));
}

void Page::set_verdict(std::string sentence, bool good) {
    verdict_ = std::move(sentence);
    good_ = good;
}

void Page::add_certificate(CertificateVerdict verdict) {
    if (!wanted_) return;
    if (verdict.valid == false)
        set_verdict("The verifier refutes the certificate of this run.", false);
    certificates_.push_back(std::move(verdict));
}

Json Page::surfaces_json() const {
    Json json = Json::array();
    std::vector<std::size_t> triangles(surfaces_.size());
    std::vector<double> area(surfaces_.size());
    for (const ScenePart& part : scene_.parts)
        for (const std::uint32_t s : part.surfaces) {
            triangles[s] += part.count;
            area[s] += part.area;
        }
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
        json.push_back({{"label", labels_[s]},
                        {"name", surfaces_[s].name},
                        {"role", detail::role_names[static_cast<std::size_t>(surfaces_[s].role)]},
                        {"file", s < facts_.files.size() ? Json(facts_.files[s]) : Json()},
                        {"triangles", triangles[s]},
                        {"area", area[s]}});
    return json;
}

Json Page::verdict_table() const {
    Json rows = Json::array();
    if (!verdict_.empty()) rows.push_back({"result", verdict_});
    if (certificates_.empty()) rows.push_back({"certificate", "None was asked for."});
    for (const CertificateVerdict& certificate : certificates_)
        for (const std::string& line : certificate.lines)
            rows.push_back({"certificate " + certificate.file, line});
    return {{"title", "Verdict"},
            {"columns", columns({{"of", "text"}, {"verdict", "text"}})},
            {"rows", rows}};
}

Json Page::certificates_json() const {
    Json json = Json::array();
    for (const CertificateVerdict& c : certificates_)
        json.push_back(
            {{"file", c.file}, {"valid", c.valid ? Json(*c.valid) : Json()}, {"lines", c.lines}});
    return json;
}

Json Page::tables(const Json& statistics) const {
    Json tables = tables_;
    tables.push_back(surface_table(surfaces_json()));
    tables.push_back(
        {{"title", "Input files"},
         {"columns", columns({{"file", "text"}, {"bytes", "count"}, {"SHA-256", "text"}})},
         {"rows", inputs_}});
    tables.push_back(option_table(facts_.options));
    tables.push_back(verdict_table());
    tables.push_back(value_table("Numbers of the run", statistics));
    return tables;
}

Json Page::content(Json statistics, Arrays& arrays) {
    if (mesh_) {
        const Mesh& before = before_;
        add_triangle_plots(plots_, *mesh_, before.triangles.empty() ? nullptr : &before);
        add_worst_triangles(findings_, *mesh_, labels_);
    }
    Json json;
    json["format"] = "terrane-report";
    json["version"] = 1;
    json["terrane"] = TERRANE_VERSION;
    json["command"] = facts_.command;
    json["title"] = facts_.title;
    json["unit"] = facts_.unit;
    json["verdict"] = {{"text", verdict_}, {"good", good_}};
    json["certificates"] = certificates_json();
    json["surfaces"] = surfaces_json();
    json["blocks"] = blocks_;
    json["findings"] = json_of(findings_, most_findings);
    json["plots"] = plots_;
    json["tables"] = tables(statistics);
    json["statistics"] = std::move(statistics);
    decimate(scene_, most_drawn);
    json.update(packed(std::move(scene_), arrays));
    return json;
}

Result<std::string> Page::html(Json statistics, const Json& run) {
    return guarded("for the page", "page", [&]() -> Result<std::string> {
        if (const auto possible = check_pages(); !possible) return possible.error();
        statistics.erase("seconds");
        Arrays arrays;
        const Json json = content(std::move(statistics), arrays);
        return html_of(json, arrays, run, *bundle());
    });
}

} // namespace terrane::page
