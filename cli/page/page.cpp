// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/page/page.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/cli/page/html.hpp>
#include <terrane/cli/page/plots.hpp>
#include <terrane/cli/page/tables.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {
namespace {

/// Surfaces of more triangles than this are decimated for view.
constexpr std::size_t most_drawn = 2'000'000;
constexpr std::size_t most_tetrahedra = 1'000'000;
constexpr std::size_t most_findings = 500; ///< of each kind

} // namespace

Result<Page> Page::plan(const FileOptions& files) {
    Page page(files);
    if (files.report.empty()) return page;
    if (page::bundle() == nullptr)
        return Error{ErrorCode::unsupported,
                     "this terrane was built without npm, so it makes no report pages", "--report"};
    if (const auto folder = check_folder(files.report); !folder) return folder.error();
    return page;
}

Status Page::add_inputs(const Inputs& inputs) {
    if (!wanted()) return Done{};
    unit_ = inputs.unit;
    sources_ = inputs.files;
    for (const std::string& path : files_.inputs) {
        if (path == "-") {
            inputs_.push_back({"standard input", nullptr, nullptr});
            continue;
        }
        auto row = page::file_row(path);
        if (!row) return row.error();
        inputs_.push_back(*std::move(row));
    }
    return Done{};
}

void Page::describe(const std::vector<SurfaceInfo>& surfaces) {
    surfaces_ = surfaces;
    labels_ = unique_labels(surfaces_);
}

Status Page::add_check(const Inputs& inputs, const CheckReport& report, const Run& run) {
    if (!wanted()) return Done{};
    add_mesh(inputs, concatenate(inputs.surfaces));
    page::add_flaws(findings_, report, inputs);
    set_verdict(report.clean() ? "The surfaces are conforming, by an exact check."
                               : "The surfaces are not conforming, by an exact check.",
                report.clean());
    return page::add_holes(findings_, inputs, run);
}

Status Page::add_holes(const Inputs& inputs, const Run& run) {
    return wanted() ? page::add_holes(findings_, inputs, run) : Status(Done{});
}

void Page::add_mesh(const Inputs& inputs, const Mesh& mesh) {
    if (!wanted()) return;
    unit_ = inputs.unit;
    describe(mesh.surfaces);
    scene_ = page::scene_of(mesh);
    mesh_ = SharedMesh(mesh);
}

void Page::add_arranged(const Inputs& inputs, const Arranged& arranged) {
    if (!wanted()) return;
    unit_ = inputs.unit;
    const SharedMesh& mesh = arranged.rounded.mesh;
    describe(mesh->surfaces);
    scene_ = page::scene_of(mesh);
    mesh_ = mesh;
    page::add_contacts(findings_, arranged.rounded, labels_);
    page::add_seal(findings_, arranged, labels_);
    const bool clean = arranged.rounded.report.clean;
    set_verdict(
        clean ? "The mesh is conforming, by an exact check of its doubles."
              : fmt::format("The mesh is not conforming: {} left. Nothing was written.",
                            counted(arranged.rounded.report.contacts.size(), "improper contact")),
        clean);
}

void Page::add_improved(const Inputs& inputs, const ImprovedAndMeasured& measured,
                        const Mesh& before) {
    if (!wanted()) return;
    unit_ = inputs.unit;
    before_ = SharedMesh(before);
    scene_ = page::scene_of(measured.improved.mesh);
    mesh_ = measured.improved.mesh;
}

void Page::add_model(const Inputs& inputs, const Model& model,
                     const std::optional<LeakAdvice>& leaks) {
    if (!wanted()) return;
    unit_ = inputs.unit;
    describe(model.mesh->surfaces);
    scene_ = page::scene_of(model);
    mesh_ = model.mesh.mesh();
    blocks_ = page::blocks_json(model, labels_);
    for (auto& table : page::block_tables(model, labels_)) tables_.push_back(std::move(table));
    page::add_leaks(findings_, model, leaks, labels_);
    page::add_thin_blocks(findings_, model);
    page::add_volume_plot(plots_, model);
    page::add_gap_plot(plots_, model.borders);
}

void Page::add_tetrahedra(const FilledBlocks& filled) {
    if (!wanted()) return;
    page::add_tetrahedra(scene_, filled.tetrahedra, most_tetrahedra);
    page::add_worst_tetrahedra(findings_, filled.tetrahedra, filled.block_names);
    page::add_tetrahedra_plots(plots_, filled.report.shape);
    std::size_t flaws = 0;
    for (const TetrahedraViolation& v : filled.report.violations) flaws += v.count;
    if (flaws > 0)
        set_verdict(fmt::format("The tetrahedra are not what they must be: {}. Nothing was "
                                "written.",
                                counted(flaws, "violation")),
                    false);
}

void Page::add_filled(const FillWork& work) {
    if (!wanted()) return;
    std::vector<Surface> surfaces;
    for (const HoledSurface& s : work.surfaces) surfaces.push_back(s.filled);
    const Mesh mesh = concatenate(surfaces);
    describe(mesh.surfaces);
    scene_ = page::scene_of(mesh);
    mesh_ = SharedMesh(mesh);
    page::split_filled(scene_, work);
    page::add_fillings(findings_, work);
    page::add_fill_plots(plots_, work);
    tables_.push_back(page::fill_table(work));
}

void Page::set_verdict(std::string sentence, bool good) {
    verdict_ = std::move(sentence);
    good_ = good;
}

void Page::add_certificate(const std::string& path) {
    if (!path.empty()) certificates_.push_back(path);
}

Json Page::surfaces_json() const {
    Json json = Json::array();
    std::vector<std::size_t> triangles(surfaces_.size());
    std::vector<double> area(surfaces_.size());
    for (const page::ScenePart& part : scene_.parts)
        for (const std::uint32_t s : part.surfaces) {
            triangles[s] += part.count;
            area[s] += part.area;
        }
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
        json.push_back({{"label", labels_[s]},
                        {"name", surfaces_[s].name},
                        {"role", page::role_name(surfaces_[s].role)},
                        {"file", s < sources_.size() ? Json(sources_[s]) : Json()},
                        {"triangles", triangles[s]},
                        {"area", area[s]}});
    return json;
}

Json Page::tables(const Json& statistics) const {
    Json tables = tables_;
    tables.push_back(page::surface_table(surfaces_json()));
    tables.push_back(
        {{"title", "Input files"},
         {"columns", page::columns({{"file", "text"}, {"bytes", "count"}, {"SHA-256", "text"}})},
         {"rows", inputs_}});
    tables.push_back(page::option_table(*files_.app));
    Json verdicts = Json::array();
    if (!verdict_.empty()) verdicts.push_back({"result", verdict_});
    for (const std::string& path : certificates_)
        verdicts.push_back({"certificate " + path,
                            "written by this run; terrane verify judges it from the input files"});
    tables.push_back({{"title", "Verdict"},
                      {"columns", page::columns({{"of", "text"}, {"verdict", "text"}})},
                      {"rows", verdicts}});
    tables.push_back(page::value_table("Numbers of the run", statistics));
    return tables;
}

Json Page::content(Json statistics, page::Arrays& arrays) {
    if (mesh_) {
        const Mesh& before = before_;
        page::add_triangle_plots(plots_, *mesh_, before.triangles.empty() ? nullptr : &before);
        page::add_worst_triangles(findings_, *mesh_, labels_);
    }
    statistics.erase("seconds");
    Json json;
    json["format"] = "terrane-report";
    json["version"] = 1;
    json["terrane"] = TERRANE_VERSION;
    json["command"] = files_.app->get_name();
    json["title"] = page::title_of(files_);
    json["unit"] = unit_;
    json["verdict"] = {{"text", verdict_}, {"good", good_}};
    json["surfaces"] = surfaces_json();
    json["blocks"] = blocks_;
    json["findings"] = page::json_of(findings_, most_findings);
    json["plots"] = plots_;
    json["tables"] = tables(statistics);
    json["statistics"] = std::move(statistics);
    page::decimate(scene_, most_drawn);
    json.update(page::packed(std::move(scene_), arrays));
    return json;
}

Status Page::write(const Json& statistics, double total_seconds) {
    if (!wanted()) return Done{};
    page::Arrays arrays;
    const Json json = content(statistics, arrays);
    const Json run = page::run_json(statistics, total_seconds, files_);
    auto done = write_file(files_.report, page::html_of(json, arrays, run, *page::bundle()));
    if (done) say_written(summary_stream(files_), files_.report);
    return done;
}

Result<ExitStatus> write_run(Page& page, const Json& statistics, const FileOptions& files,
                             double total_seconds, bool good) {
    if (const auto done = page.write(statistics, total_seconds); !done) return done.error();
    if (const auto done = write_statistics(statistics, files.stats, total_seconds); !done)
        return done.error();
    return good ? ExitStatus::done : ExitStatus::negative;
}

} // namespace terrane::cli
