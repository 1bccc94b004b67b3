// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Readers, writers, certificates and the verifier.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/certify.hpp>
#include <terrane/io/gocad/gocad_model.hpp>
#include <terrane/io/judgement/judgement.hpp>
#include <terrane/io/judgement/limits.hpp>
#include <terrane/io/meshes/pvtp.hpp>
#include <terrane/io/points/outline.hpp>
#include <terrane/io/points/shape_outline.hpp>
#include <terrane/io/reading.hpp>
#include <terrane/io/results.hpp>
#include <terrane/io/structure_json.hpp>
#include <terrane/io/text/bytes.hpp>
#include <terrane/io/uncertainty_maps.hpp>

#include "fixture.hpp"
#include "scratch.hpp"
#include "stage.hpp"

namespace failing {
namespace {

using namespace terrane;
namespace fs = std::filesystem;

/// Returns a text in each format that the library reads and does not write, after the name of the format.
std::vector<std::pair<std::string, std::string>> only_read() {
    return {{"irap", "-996 2 1 1\n0 2 0 1\n3 0 0 0\n0 0 0 0 0 0 0\n1 2 3 4 9999900 6\n"},
            {"zmap",
             "! made\n@top HEADER, GRID, 2\n10, -99999.0, , 4, 1\n2, 3, 0, 2, 0, 1\n0, 0, 0\n@\n"
             "+ data\n1 2\n-99999.0 3\n4 5\n"},
            {"cps3", "FSASCI 0 1 COMPUTED 0 0.1E+31\nFSATTR 0 0\nFSLIMI 0 2 0 1 0 1\nFSNROW 2 3\n"
                     "FSXINC 1 1\n->top\n1 2\n0.1E+31 3\n4 5\n"},
            {"grd", "DSAA\n3 2\n0 2\n0 1\n0 5\n0 1 2\n3 4 5\n"},
            {"asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
                    "NODATA_value -9999\n1 2 3\n4 5 6\n"},
            {"xyz", "0 0 1\n1 0 2\n0 1 3\n1 1 4\n2 0 1.5\n"},
            {"vs", "GOCAD VSet 1\nHEADER {\nname: points with a long name\n}\n"
                   "VRTX 1 0 0 1\nVRTX 2 1 0 2\nVRTX 3 0 1 3\nEND\n"},
            {"pl", "GOCAD PLine 1\nHEADER {\nname: a line with a long name\n}\nILINE\n"
                   "VRTX 1 0 0 1\nVRTX 2 1 0 2\nVRTX 3 0 1 3\nSEG 1 2\nSEG 2 3\nEND\n"},
            {"dxf", "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\nlayer\n10\n0\n20\n0\n30\n0\n11\n1\n"
                    "21\n0\n31\n0\n12\n0\n22\n1\n32\n0\n13\n0\n23\n1\n33\n0\n0\nENDSEC\n0\nEOF\n"},
            {"grdecl", "SPECGRID\n2 1 1 1 F /\nCOORD\n0 0 0 0 0 9\n1 0 0 1 0 9\n2 0 0 2 0 9\n"
                       "0 1 0 0 1 9\n1 1 0 1 1 9\n2 1 0 2 1 9 /\nZCORN\n1 1 1.5 1.5 1 1 1.5 1.5\n"
                       "2 2 2.5 2.5 2 2 2.5 2.5 /\n"},
            {"vts",
             "<VTKFile type=\"StructuredGrid\"><StructuredGrid><Piece Extent=\"0 1 0 1 0 0\">"
             "<PointData><DataArray type=\"Float64\" Name=\"a value\" format=\"ascii\">"
             "1 2 3 4</DataArray></PointData><Points><DataArray type=\"Float64\" "
             "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0"
             "</DataArray></Points></Piece></StructuredGrid></VTKFile>"},
            {"landxml", "<LandXML><Surfaces><Surface name=\"a surface with a long name\">"
                        "<Definition surfType=\"TIN\"><Pnts><P id=\"1\">0 0 0</P>"
                        "<P id=\"2\">0 1 0</P><P id=\"3\">1 0 0</P></Pnts>"
                        "<Faces><F>1 2 3</F></Faces></Definition></Surface></Surfaces></LandXML>"},
            {"sticks", "0 0 0 1\n0 0 1 1\n1 0 0 2\n1 0 1 2\n"}};
}

/// Tetrahedra of one format that is read and written.
std::string vtu_text() {
    TetrahedralMesh mesh;
    mesh.surfaces = {{.name = "a face with a name that needs memory"}};
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.tetrahedra = {{0, 1, 2, 3}};
    mesh.block_of = {1};
    mesh.block_count = 2;
    mesh.faces = {{0, 1, 2}};
    mesh.face_triangle = {0};
    const std::uint32_t surface = 0;
    mesh.surfaces_of.push_back({&surface, 1});
    const auto path = scratch() / "tetrahedra.vtu";
    needed(write_tetrahedra(mesh, path));
    return contents_of(path);
}

std::string leapfrog_text() {
    std::string text = "%ARANZ-1.0\n[index]\nLocation Double 3 3;\nTri Integer 3 1;\n[binary]";
    text += std::string(4, '\0');
    for (const double number : {1.23456789, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0})
        terrane::detail::store(text, number);
    for (const std::uint32_t corner : {0U, 1U, 2U}) terrane::detail::store(text, corner);
    return text;
}

/// Texts of all formats that are read. The fixture fails where one is missing.
std::vector<std::pair<std::string, std::string>> all_texts() {
    auto texts = only_read();
    const Fixture& f = Fixture::get();
    for (const char* name : {"ts", "obj", "off", "stl", "ply", "vtp", "msh", "msh22", "vtk"})
        texts.emplace_back(name, needed(format_mesh(*f.mesh, *format_named(name))));
    texts.emplace_back("vtu", vtu_text());
    texts.emplace_back("leapfrog", leapfrog_text());
    for (const std::string_view name : format_names()) {
        const auto is_of_format = [&](const auto& text) {
            return text.first != "leapfrog" && format_named(text.first) == format_named(name);
        };
        if (is_read(*format_named(name)) && std::ranges::none_of(texts, is_of_format))
            fail("there is no text of the format " + std::string(name));
    }
    return texts;
}

std::vector<Stage> reading() {
    const Fixture& f = Fixture::get();
    const auto as_text = [](const std::vector<Surface>& surfaces) { return text_of(surfaces); };
    std::vector<Stage> stages;
    for (const auto& [name, text] : all_texts()) {
        const Format format =
            name == "msh22" || name == "leapfrog" ? Format::msh : *format_named(name);
        stages.push_back(stage(
            "parse_surfaces, " + name,
            [contents = text, format] {
                return parse_surfaces(contents, "a file with a name that needs memory", format);
            },
            as_text));
    }
    const auto obj =
        written("surfaces with a long name.obj", needed(format_mesh(*f.mesh, Format::obj)));
    stages.push_back(stage(
        "read_surfaces", [obj] { return read_surfaces(obj); }, as_text));
    stages.push_back(stage(
        "check_reading",
        [] {
            return check_reading({Format::xyz}, {.depth = true}, {"depth", "max_edge", "columns"});
        },
        [](const Done&) { return std::string("sound"); }));
    stages.back().returns_errors = false; // its arguments are made here
    const auto msh = written(
        "tetrahedra with a long name.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
        "$EndNodes\n$Elements\n1\n1 4 2 7 1 1 2 3 4\n$EndElements\n");
    stages.push_back(stage(
        "read_tetrahedra", [msh] { return read_tetrahedra(msh); },
        [](const LabelledTetrahedra& read) { return std::to_string(read.labels[0]); }));
    const auto model =
        written("model with a long name.ml",
                to_gocad_model(*f.mesh, f.model.volumes, f.model.structure, "model"));
    stages.push_back(stage(
        "read_model", [model] { return read_model(model); },
        [](const GocadModel& read) { return text_of(read.surfaces); }));
    tiles::TilePiece piece{*f.mesh, {}, {}};
    piece.mesh.intersection_edges.clear();
    for (std::uint32_t v = 0; v < f.mesh->vertices.size(); ++v) piece.vertex_ids.push_back(v);
    for (std::uint32_t t = 0; t < f.mesh->triangles.size(); ++t) piece.triangle_ids.push_back(t);
    const std::vector<std::string> pieces{
        written("a piece with a long name.vtp", to_vtp_piece(piece)).filename().string()};
    const auto pvtp = written("pieces with a long name.pvtp", to_pvtp(pieces));
    stages.push_back(stage(
        "read_pvtp", [pvtp] { return read_pvtp(pvtp); },
        [](const Mesh& mesh) { return text_of(mesh); }));
    return stages;
}

/// The contents of a shapefile with one polygon, a square.
std::string shapefile() {
    std::string bytes;
    const auto integer = [&bytes](std::uint32_t value, bool big) {
        for (unsigned i = 0; i < 4; ++i)
            bytes += static_cast<char>(value >> 8 * (big ? 3 - i : i) & 255U);
    };
    const auto doubles = [&bytes](std::initializer_list<double> values) {
        for (const double value : values) {
            const auto bits = std::bit_cast<std::uint64_t>(value);
            for (unsigned i = 0; i < 8; ++i) bytes += static_cast<char>(bits >> 8 * i & 255U);
        }
    };
    constexpr std::uint32_t polygon = 5, of_record = 48 + 5 * 16;
    integer(9994, true);
    bytes += std::string(20, '\0');
    integer((100 + 8 + of_record) / 2, true);
    integer(1000, false);
    integer(polygon, false);
    doubles({0, 0, 8, 8, 0, 0, 0, 0});
    integer(1, true); // the record
    integer(of_record / 2, true);
    integer(polygon, false);
    doubles({0, 0, 8, 8});
    integer(1, false); // parts, points, first point
    integer(5, false);
    integer(0, false);
    doubles({0, 0, 0, 8, 8, 8, 8, 0, 0, 0});
    return bytes;
}

std::vector<Stage> reading_outlines() {
    const std::string outline = R"({"type": "FeatureCollection", "features": [{"type": "Feature",
        "properties": {"name": "a property that needs memory"}, "geometry": {"type": "Polygon",
        "coordinates": [[[0, 0], [8, 0], [8, 8], [0, 8], [0, 0]]]}}]})";
    std::vector<std::pair<std::string, std::string>> texts{
        {"geojson", outline}, {"txt", "# a comment\n0 0\n8 0\n8 8\n0 8\n"}};
    if (reads_shapefiles()) texts.emplace_back("shp", shapefile());
    std::vector<Stage> stages;
    for (const auto& [name, text] : texts)
        stages.push_back(stage(
            "read_outline, " + name,
            [contents = text, source = "an outline with a long name." + name] {
                return read_outline(contents, source);
            },
            [](const std::vector<std::array<double, 2>>& corners) {
                return std::to_string(corners.size());
            }));
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
        "boundary_of", [parsed] { return boundary_of(parsed.volume, parsed.unit); },
        [](const std::vector<Surface>& made) { return text_of(made); }));
    stages.push_back(stage(
        "build_model", [parsed] { return build_model(parsed); },
        [](const Built& built) { return text_of(*built.model->mesh); }));
    auto certified = parsed;
    certified.outputs.certificate = true;
    certified.surfaces[0].objects.emplace_back("an object with a long name");
    stages.push_back(stage(
        "check_certifiable",
        [certified] {
            const auto checked = check_certifiable(certified);
            const bool refused =
                !checked && checked.error().code == ErrorCode::bad_option; // as it must
            return refused ? Status(Done{}) : checked;
        },
        [](Done) { return std::string("refused"); }));
    stages.push_back(stage(
        "read_column", [column] { return read_column(column); },
        [](const StratigraphicColumn& read) { return read.front().name; }));
    stages.push_back(stage(
        "read_exact", [exact] { return read_exact(exact, "a file with a name that needs memory"); },
        [](const ExactText& read) { return to_text(read); }));
    const auto map = written("a map with a long name.asc", "ncols 2\nnrows 2\nxllcorner 0\n"
                                                           "yllcorner 0\ncellsize 8\n1 2 3 4\n");
    auto uncertain = parsed;
    uncertain.uncertainty.resize(2);
    uncertain.uncertainty[1].field.emplace().map = map;
    stages.push_back(stage(
        "read_uncertainty_maps", [uncertain] { return read_uncertainty_maps(uncertain); },
        [](const std::vector<std::optional<Surface>>& maps) { return text_of({*maps[1]}); }));
    stages.push_back(stage_of(
        "certify",
        [&f, obj] {
            CertifiedResult result = result_of(f.arranged);
            result.inputs.push_back({obj, f.arranged.surfaces.size()});
            return result;
        },
        [path = fs::path("a certificate with a long name.json")](const CertifiedResult& result) {
            return certify(result, path);
        },
        [](const std::string& text) { return text; }));
    stages.push_back(stage_of(
        "record_input", [] { return std::string("a name in the certificate, with memory"); },
        [obj](std::string name) { return record_input(obj, std::move(name), 1); },
        [](const InputRecord& record) { return record.sha256; }));
    return stages;
}

Grid small_grid() {
    return {"a grid with a name that needs memory", 0, 0, 2, 2, 4, 4, 0, {1, 2, 3, 4}};
}

std::vector<Stage> formatting() {
    const Fixture& f = Fixture::get();
    std::vector<Stage> stages;
    const auto as_it_is = [](const std::string& text) { return text; };
    for (const std::string_view name : format_names()) {
        const Format format = *format_named(name);
        if ((holds_surfaces(format) || holds_outlines(format)) && is_first_name(name))
            stages.push_back(stage(
                "format_mesh, " + std::string(name),
                [&f, format] { return format_mesh(*f.mesh, format); }, as_it_is));
        if (holds_grids(format) && is_first_name(name))
            stages.push_back(stage(
                "format_grid, " + std::string(name),
                [grid = small_grid(), format] { return format_grid(grid, format); }, as_it_is));
    }
    const auto path = scratch() / "a grid with a long name.asc";
    needed(write_grid(small_grid(), path));
    stages.push_back(stage(
        "read_grid", [path] { return read_grid(path); },
        [](const Grid& read) { return std::to_string(read.values.size()); }));
    stages.push_back(stage(
        "write_grid", [path, grid = small_grid()] { return write_grid(grid, path); },
        [path](Done) { return contents_of(path); }));
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
    const std::vector<InputRecord> beside{
        needed(record_input(path, path.filename().string(), surfaces.size()))};
    const auto stated = written("stated.json", to_certificate({beside, surfaces, exact, &rounded}));
    stages.push_back(stage(
        "judge", [request = JudgementRequest{.certificate = stated}] { return judge(request); },
        [](const Judgement& judged) { return std::to_string(judged.violations().size()); }));
    const auto judged_text = [](const MeshJudgement& judged) {
        std::string all;
        for (const JudgedProperty& p : judged.properties) all += p.name + ": " + p.sentence + "\n";
        return all;
    };
    stages.push_back(stage(
        "judge_within",
        [surfaces] {
            return judge_within({}, {}, [&](const std::stop_token& stop) {
                return judge(surfaces, surfaces, {}, {.stop = stop});
            });
        },
        judged_text));
    stages.push_back(stage(
        "judge, tetrahedra",
        [surfaces, made = LabelledTetrahedra{surfaces[0].vertices, {{0, 1, 2, 3}}, {1}}] {
            return judge(made, surfaces);
        },
        judged_text));
    stages.push_back(stage(
        "judge_soup", [surfaces] { return judge_soup(surfaces); }, judged_text));
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
    for (const auto& part :
         {reading(), reading_outlines(), reading_json(), formatting(), certifying()})
        stages.insert(stages.end(), part.begin(), part.end());
    return stages;
}

} // namespace failing
