// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writers of files and folders, and the report page. A failure must leave what was there, and nothing
// beside it.
#include <array>
#include <memory>

#include <terrane/algorithms/tiles/local_supersteps.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/meshes/pvtp_output.hpp>
#include <terrane/io/results.hpp>
#ifdef TERRANE_TESTS_PAGE
#include <terrane/io/page/page.hpp>
#endif

#include "fixture.hpp"
#include "scratch.hpp"
#include "stage.hpp"

namespace failing {
namespace {

using namespace terrane;
namespace fs = std::filesystem;

/// The upper half of an octahedron on a square face, in two blocks; each writer of tetrahedra can write it.
TetrahedralMesh few_tetrahedra() {
    TetrahedralMesh mesh;
    mesh.surfaces = {{.name = "a fault with a name that needs memory", .role = Role::fault},
                     {.name = "box", .role = Role::boundary}};
    mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 1}};
    mesh.tetrahedra = {{0, 1, 2, 4}, {0, 2, 3, 4}};
    mesh.block_of = {1, 2};
    mesh.block_count = 3;
    mesh.faces = {{0, 2, 4}, {0, 2, 1}, {0, 3, 2}};
    mesh.face_triangle = {0, UINT32_MAX, UINT32_MAX};
    for (const std::uint32_t surface : {0U, 1U, 1U}) mesh.surfaces_of.push_back({&surface, 1});
    return mesh;
}

std::vector<Stage> writing_tetrahedra() {
    static const TetrahedralMesh mesh = few_tetrahedra();
    static const std::vector<std::string> names{"outside", "a block with a long name", "another"};
    std::vector<Stage> stages;
    for (const std::string_view name : format_names()) {
        const Format format = *format_named(name);
        if (!holds_tetrahedra(format) || !is_first_name(name)) continue;
        for (const unsigned order : {1U, 2U}) {
            if (order == 2 && !holds_second_order(format)) continue;
            stages.push_back(writing_stage("write_tetrahedra, " + std::string(name) + ", order " +
                                               std::to_string(order),
                                           "tetrahedra with a long name." + std::string(name), true,
                                           [format, order](const fs::path& path) {
                                               WriteOptions options;
                                               options.format = format;
                                               options.order = order;
                                               if (format != Format::medit)
                                                   options.block_names = names;
                                               return write_tetrahedra(mesh, path, options);
                                           }));
        }
    }
    return stages;
}

/// Writes what a project asks for, and its certificates, into a new folder each time.
std::vector<Stage> writing_results(const Fixture& f, const std::optional<LeakAdvice>& leaks) {
    static const Project project = [] {
        Project made;
        made.surfaces.push_back({written("input of a certificate with a long name.obj",
                                         needed(format_mesh(*Fixture::get().mesh, Format::obj)))});
        made.outputs.surfaces = {"obj", "poly"};
        made.outputs.blocks = "vtp";
        made.outputs.certificate = true;
        return made;
    }();
    static const Results results{project, f.model, nullptr, f.arranged.sealed, leaks};
    const auto fresh = [] {
        const fs::path folder = project.surfaces[0].file.parent_path() / "results of a project";
        fs::remove_all(folder);
        fs::create_directories(folder);
        return folder;
    };
    ProjectInputs read;
    read.surfaces_of_entry.push_back(f.arranged.surfaces.size());
    for (const Surface& s : f.arranged.surfaces) read.as_read.push_back({s.name + "2", s.role});
    return {stage_of(
                "write_results", fresh,
                [](const fs::path& folder) { return write_results(results, folder); },
                [](const std::vector<std::string>& names) { return names.back(); }),
            stage_of(
                "write_certificates",
                [fresh] {
                    const fs::path folder = fresh();
                    needed(write_results(results, folder));
                    return folder;
                },
                [&f, read](const fs::path& folder) {
                    return write_certificates(results, read, f.arranged, folder);
                },
                [](const std::vector<WrittenCertificate>& made) { return made.back().name; })};
}

std::vector<Stage> writing_models() {
    const Fixture& f = Fixture::get();
    static const std::optional<LeakAdvice> leaks = needed(judge_leaks(f.arranged, f.model.borders));
    std::vector<Stage> stages;
    stages.push_back(
        writing_stage("write_mesh", "a mesh with a long name.obj", true,
                      [&f](const fs::path& path) { return write_mesh(*f.mesh, path); }));
    for (const char* format : {"vtp", "msh22"}) // format_mesh has stages of the others
        stages.push_back(writing_stage(
            "write_model_folder, " + std::string(format), "a model with a long name", false,
            [&f, format = std::string(format)](const fs::path& path) {
                return write_model_folder({f.model, f.arranged.sealed, leaks}, format, path);
            }));
    for (Stage& made : writing_results(f, leaks)) stages.push_back(std::move(made));
    return stages;
}

std::vector<Stage> writing_pieces() {
    using namespace tiles;
    const auto arranged = [] {
        static const Run run;
        auto tiles = std::make_unique<LocalSupersteps>(LocalOptions{.tiles = 2, .spool = {}}, run);
        const auto read = [](std::size_t file) -> Result<std::vector<Surface>> {
            return std::vector{Fixture::get().surfaces[file]};
        };
        needed(arrange_in_tiles(*tiles, read, {.files = 3, .digest = false}));
        return tiles;
    };
    std::vector<Stage> stages{
        writing_stage("write_pvtp", "pieces with a long name.pvtp", true, arranged,
                      [](const fs::path& path, const std::unique_ptr<LocalSupersteps>& tiles) {
                          return write_pvtp(*tiles, path, false);
                      }),
        writing_stage("check_pvtp", "pieces with a long name.pvtp", true,
                      [](const fs::path& path) { return check_pvtp(path); })};
    for (Stage& s : stages) s.returns_errors = false; // see tiled_arrangement.hpp
    return stages;
}

#ifdef TERRANE_TESTS_PAGE
page::Page new_page() {
    return page::Page({.command = "volume",
                       .title = "a model with a long name",
                       .unit = "m",
                       .options = {{"--seal", "a value with a long text"}},
                       .files = {}});
}

/// A page with much that it can show.
page::Page page_of_model() {
    const Fixture& f = Fixture::get();
    page::Page page = new_page();
    page.add_arranged(f.arranged);
    page.add_model(f.model, std::nullopt);
    page.add_certificate({"c.json", true, {"a sentence of the verifier with a long text"}});
    page.set_verdict("A sentence that says how the run has ended.", true);
    return page;
}

std::vector<Stage> making_pages() {
    if (!page::check_pages()) return {};
    const Fixture& f = Fixture::get();
    static const CheckReport flaws = needed(check(f.surfaces));
    static const MeshJudgement judged = needed(judge_soup(f.surfaces));
    static const std::string file = written("an input with a long name.obj", "v 0 0 0\n").string();
    const auto done = [](const Done&) { return std::string("done"); };
    return {
        stage_of(
            "Page::add_file", new_page, [](page::Page page) { return page.add_file(file); }, done),
        stage_of(
            "Page::add_holes", new_page,
            [&f](page::Page page) { return page.add_holes(f.surfaces, {}); }, done),
        stage_of(
            "Page::add_check", new_page,
            [&f](page::Page page) { return page.add_check(f.surfaces, flaws, {}); }, done),
        stage_of(
            "Page::add_judged", new_page,
            [&f](page::Page page) { return page.add_judged(f.surfaces, judged); }, done),
        stage(
            "Page::add_model", [] { return page_of_model(); },
            [](page::Page page) {
                return needed(page.html(page::Json::object(), page::Json::object()));
            }),
        stage_of(
            "Page::html",
            [] { return std::pair(page_of_model(), page::Json(page::Json::object())); },
            [](std::pair<page::Page, page::Json> given) {
                static const page::Json run = page::Json::object();
                return given.first.html(std::move(given.second), run);
            },
            [](const std::string& html) { return html; })};
}
#else
std::vector<Stage> making_pages() {
    return {};
}
#endif

} // namespace

std::vector<Stage> stages_of_outputs() {
    std::vector<Stage> stages;
    for (const auto& part :
         {writing_tetrahedra(), writing_models(), writing_pieces(), making_pages()})
        stages.insert(stages.end(), part.begin(), part.end());
    return stages;
}

} // namespace failing
