// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Readers, writers, certificates and the verifier.
#include <array>
#include <fstream>

#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/algorithms/verify/verify_certificate.hpp>
#include <terrane/io/points/outline.hpp>

#include "fixture.hpp"
#include "stage.hpp"

namespace failing {
namespace {

using namespace terrane;
namespace fs = std::filesystem;

/// The folder in which files are read and written; it lives as long as the program.
const test_support::TemporaryFolder& scratch() {
    static const test_support::TemporaryFolder folder;
    return folder;
}

std::string contents_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

fs::path written(std::string_view name, const std::string& text) {
    const fs::path path = scratch() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

/// Texts of formats that are only read.
std::vector<std::pair<Format, std::string>> grids_and_points() {
    return {{Format::esri, "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
                           "NODATA_value -9999\n1 2 3\n4 5 6\n"},
            {Format::xyz, "0 0 1\n1 0 2\n0 1 3\n1 1 4\n2 0 1.5\n"},
            {Format::vset, "GOCAD VSet 1\nHEADER {\nname: points with a long name\n}\n"
                           "VRTX 1 0 0 1\nVRTX 2 1 0 2\nVRTX 3 0 1 3\nEND\n"},
            {Format::dxf,
             "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\nlayer\n10\n0\n20\n0\n30\n0\n11\n1\n"
             "21\n0\n31\n0\n12\n0\n22\n1\n32\n0\n13\n0\n23\n1\n33\n0\n0\nENDSEC\n0\nEOF\n"},
            {Format::sticks, "0 0 0 1\n0 0 1 1\n1 0 0 2\n1 0 1 2\n"}};
}

std::vector<Stage> reading() {
    const Fixture& f = Fixture::get();
    auto texts = grids_and_points();
    for (const Format format : {Format::gocad, Format::obj, Format::off, Format::stl, Format::ply,
                                Format::vtp, Format::msh, Format::msh22, Format::vtk})
        texts.emplace_back(format, needed(format_mesh(*f.mesh, format)));
    const auto as_text = [](const std::vector<Surface>& surfaces) { return text_of(surfaces); };
    std::vector<Stage> stages;
    for (const auto& text : texts) {
        const auto number = std::to_string(static_cast<int>(text.first));
        const Format read_as = text.first == Format::msh22 ? Format::msh : text.first;
        stages.push_back(stage(
            "parse_surfaces, format " + number,
            [contents = text.second, read_as] {
                return parse_surfaces(contents, "a file with a name that needs memory", read_as);
            },
            as_text));
    }
    const auto obj =
        written("surfaces with a long name.obj", needed(format_mesh(*f.mesh, Format::obj)));
    stages.push_back(stage(
        "read_surfaces", [obj] { return read_surfaces(obj); }, as_text));
    const auto model =
        written("model with a long name.ml",
                to_gocad_model(*f.mesh, f.model.volumes, f.model.structure, "model"));
    stages.push_back(stage(
        "read_model", [model] { return read_model(model); },
        [](const GocadModel& read) { return text_of(read.surfaces); }));
    return stages;
}

std::vector<Stage> reading_json() {
    const Fixture& f = Fixture::get();
    const auto obj =
        written("input with a long name.obj", needed(format_mesh(*f.mesh, Format::obj)));
    const auto project = written(
        "a project with a long name.json",
        R"({"format": "terrane-project 1", "folder": "a folder with a name that needs memory",
            "surfaces": [{"file": "input with a long name.obj"}],
            "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8, 8, 8]}},
            "outputs": {"surfaces": ["obj"]}})");
    const auto column =
        written("a column with a long name.json",
                R"({"column": [{"unit": "an upper unit with a long name", "surface": "top"},
                       {"unit": "a lower one"}]})");
    const auto exact = to_text(to_exact(f.arranged.exact));
    std::vector<Stage> stages;
    stages.push_back(stage(
        "read_project", [project] { return read_project(project); },
        [](const Project& read) { return std::to_string(read.surfaces.size()); }));
    const auto parsed = needed(read_project(project));
    stages.push_back(stage(
        "read_inputs", [parsed] { return read_inputs(parsed); },
        [](const ProjectInputs& read) { return text_of(read.build.surfaces); }));
    stages.push_back(stage(
        "read_column", [column] { return read_column(column); },
        [](const StratigraphicColumn& read) { return read.front().name; }));
    stages.push_back(stage(
        "read_exact", [exact] { return read_exact(exact, "a file with a name that needs memory"); },
        [](const ExactText& read) { return to_text(read); }));
    const std::string outline = R"({"type": "FeatureCollection", "features": [{"type": "Feature",
        "properties": {"name": "a property that needs memory"}, "geometry": {"type": "Polygon",
        "coordinates": [[[0, 0], [8, 0], [8, 8], [0, 8], [0, 0]]]}}]})";
    stages.push_back(stage(
        "read_outline", [outline] { return read_outline(outline, "an outline in a file.geojson"); },
        [](const std::vector<std::array<double, 2>>& corners) {
            return std::to_string(corners.size());
        }));
    stages.push_back(stage_of(
        "record_input", [] { return std::string("a name in the certificate, with memory"); },
        [obj](std::string name) { return record_input(obj, std::move(name), 1); },
        [](const InputRecord& record) { return record.sha256; }));
    return stages;
}

std::vector<Stage> formatting() {
    const Fixture& f = Fixture::get();
    std::vector<Stage> stages;
    const auto as_it_is = [](const std::string& text) { return text; };
    for (const Format format : {Format::gocad, Format::obj, Format::off, Format::stl, Format::ply,
                                Format::vtp, Format::msh, Format::msh22, Format::poly,
                                Format::smesh, Format::vtk, Format::vset, Format::pline})
        stages.push_back(stage(
            "format_mesh, format " + std::to_string(static_cast<int>(format)),
            [&f, format] { return format_mesh(*f.mesh, format); }, as_it_is));
    stages.push_back(stage(
        "lines_to_gocad", [&f] { return lines_to_gocad(*f.mesh, f.model.structure); }, as_it_is));
    stages.push_back(stage(
        "to_gocad_model",
        [&f] { return to_gocad_model(*f.mesh, f.model.volumes, f.model.structure, "model"); },
        as_it_is));
    stages.push_back(stage(
        "to_json", [&f] { return to_json(*f.mesh, f.model.structure, {}); }, as_it_is));
    return stages;
}

/// Describes the folder of files that are written: their names and contents.
std::string left(const fs::path& folder) {
    std::string text;
    for (const auto& entry : fs::directory_iterator(folder))
        text += entry.path().filename().string() + ": " + contents_of(entry.path()) + "\n";
    return text;
}

/// Writes over an old file. A failure must leave that, and nothing beside it.
std::vector<Stage> writing() {
    const Fixture& f = Fixture::get();
    const fs::path folder = scratch() / "written";
    fs::create_directory(folder);
    const fs::path path = folder / "a mesh with a long name.obj";
    const auto anew = [path] {
        std::ofstream(path) << "old";
        return 0;
    };
    Stage write = stage_of(
        "write_mesh", anew, [&f, path](int) { return write_mesh(*f.mesh, path); },
        [path](const Done&) { return contents_of(path); });
    write.call = [call = write.call, folder](long n, Mode mode) {
        Answer answer = call(n, mode);
        if (answer.error && left(folder) != "a mesh with a long name.obj: old\n")
            answer.error = Error{ErrorCode::internal, "something was written", left(folder)};
        return answer;
    };
    return {write};
}

std::vector<Stage> certifying() {
    const Fixture& f = Fixture::get();
    const auto obj = needed(
        format_mesh(needed(round_to_doubles(needed(arrange(f.surfaces)))).mesh, Format::obj));
    const auto path = written("certified with a long name.obj", obj);
    const auto surfaces = needed(read_surfaces(path));
    const std::vector<InputRecord> files{needed(record_input(path, "in.obj", surfaces.size()))};
    const auto exact = needed(arrange(surfaces));
    const auto rounded = needed(round_to_doubles(exact));
    const auto write = [files, surfaces, exact, rounded] {
        return to_certificate({files, surfaces, exact, &rounded});
    };
    const std::string text = write();
    const auto certificate = needed(parse_certificate(text, "certificate"));
    const std::vector<InputFile> found{input_file(obj, surfaces)};
    std::vector<Stage> stages;
    stages.push_back(stage("to_certificate", write, [](const std::string& made) { return made; }));
    stages.push_back(stage(
        "parse_certificate",
        [text] { return parse_certificate(text, "a file with a name that needs memory"); },
        [](const Certificate& read) { return read.digest; }));
    stages.push_back(stage(
        "verify_certificate",
        [found, certificate] { return verify_certificate(found, certificate); },
        [](const Verdict& verdict) { return std::to_string(verdict.violations.size()); }));
    const VolumeRecord box{
        .shape = "prism", .corners = {{0, 0}, {8, 0}, {8, 8}, {0, 8}}, .between = {0, 8}};
    auto all = f.surfaces;
    all.insert(all.end(), f.box.begin(), f.box.end());
    stages.push_back(stage(
        "to_cut_certificate",
        [&f, all, box, files] {
            return to_cut_certificate({files, all, f.arranged.exact, &f.arranged.rounded}, box,
                                      f.box.size(), {});
        },
        [](const std::string& made) { return made; }));
    return stages;
}

} // namespace

std::vector<Stage> stages_of_files() {
    std::vector<Stage> stages;
    for (const auto& part : {reading(), reading_json(), formatting(), writing(), certifying()})
        stages.insert(stages.end(), part.begin(), part.end());
    return stages;
}

} // namespace failing
