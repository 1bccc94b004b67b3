// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writing models with regions, lines and points for GOCAD; what is written is read again.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/gocad/gocad.hpp>
#include <terrane/io/gocad/gocad_curves.hpp>
#include <terrane/io/gocad/gocad_model.hpp>

#include "support/read.hpp"
#include "support/rounded.hpp"
#include "support/samples.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;

namespace {

Model built_model(const std::vector<Surface>& surfaces, const BlockNaming& naming = {}) {
    const auto exact = arranged(surfaces);
    const auto doubles = rounded(exact);
    REQUIRE(doubles.conforming);
    auto model = make_model(exact, *doubles.conforming, {}, naming);
    REQUIRE(model);
    return std::move(*model);
}

std::string model_text(const Model& model, const std::string& name = "m") {
    return to_gocad_model(model.mesh, model.volumes, model.structure, name);
}

GocadModel read_again(const std::string& text) {
    auto model = read_gocad_model(text, "a.ml", "a");
    INFO((model ? "" : model.error().message() + "\n" + text));
    REQUIRE(model);
    return std::move(*model);
}

/// A box divided by two horizons and a fault that ends within it; one horizon is turned over. A third
/// one lies on the base of the box.
std::vector<Surface> layered_box() {
    Surface base = level(3, -1, -1, 9, 9, "base"), top = level(5, -1, -1, 9, 9, "top {2}"),
            floor = level(0, 0, 0, 8, 8, "floor");
    for (Triangle& t : top.triangles) std::swap(t[1], t[2]);
    std::swap(base.triangles[1][0], base.triangles[1][1]); // each triangle the other way
    Surface fault = quad({4, -1, -1}, {4, 4, -1}, {4, 4, 9}, {4, -1, 9}, "F 1");
    base.role = top.role = Role::horizon;
    fault.role = Role::fault;
    Surface walls = cube(0, 8, "box");
    walls.role = Role::boundary;
    return {walls, base, top, fault, floor};
}

/// The corners of a triangle from the least one on; `any_turn`: without regard to its orientation.
std::array<Point3, 3> key_of(const std::vector<Point3>& vertices, const Triangle& t,
                             bool any_turn) {
    std::array<Point3, 3> key{vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    if (any_turn)
        std::sort(key.begin(), key.end());
    else
        std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    return key;
}

/// Six times the volume between a triangle and the origin, exact for small integers.
double prism_of(const Surface& s, const Triangle& t) {
    const Point3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
    return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) +
           a.z * (b.x * c.y - b.y * c.x);
}

/// Returns the volume that the sides of a region enclose, if + is the side that sees the corners of
/// a triangle counterclockwise.
double volume_of(const GocadModel& model, const ModelRegion& region) {
    double sum = 0;
    for (const ModelSide& side : region.sides) {
        const ModelPart& part = model.parts[side.part];
        const Surface& surface = model.surfaces[part.surface];
        for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count;
             ++t)
            sum -= (side.positive ? 1 : -1) * prism_of(surface, surface.triangles[t]);
    }
    return sum / 6;
}

std::vector<std::string> lines_with(const std::string& text, const std::string& start) {
    std::vector<std::string> found;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with(start)) found.push_back(line);
    return found;
}

/// Compares the triangles of all surfaces with those of a mesh, to the last bit.
void check_same_surfaces(const Mesh& mesh, const std::vector<Surface>& read) {
    const auto meant = surfaces_of_mesh(mesh);
    REQUIRE(read.size() == meant.size());
    for (std::size_t s = 0; s < meant.size(); ++s) {
        CHECK(read[s].name == meant[s].name);
        CHECK(read[s].role == meant[s].role);
        CHECK(read[s].vertices.size() == meant[s].vertices.size());
        std::vector<std::array<Point3, 3>> there, wanted;
        for (const Triangle& t : read[s].triangles)
            there.push_back(key_of(read[s].vertices, t, true));
        for (const Triangle& t : meant[s].triangles)
            wanted.push_back(key_of(meant[s].vertices, t, true));
        std::sort(there.begin(), there.end());
        std::sort(wanted.begin(), wanted.end());
        CHECK(there == wanted);
    }
}

} // namespace

TEST_CASE("GOCAD model: surfaces, regions and volumes are read back", "[io][gocad]") {
    const Model model = built_model(layered_box());
    REQUIRE(model.structure.blocks.size() == 4);
    const std::string text = model_text(model, "a {model}");
    const GocadModel read = read_again(text);
    CHECK(read.name == "a (model)");
    check_same_surfaces(model.mesh, read.surfaces);
    REQUIRE(read.regions.size() == 4);
    CHECK(read.regions[0].name == "Universe");
    CHECK(volume_of(read, read.regions[0]) == -512);
    std::map<std::string, double> volumes;
    for (std::size_t b = 1; b < 4; ++b)
        volumes[model.structure.blocks[b].name] = model.structure.blocks[b].volume;
    for (std::size_t r = 1; r < 4; ++r) {
        std::string name = read.regions[r].name;
        std::replace(name.begin(), name.end(), '(', '{');
        std::replace(name.begin(), name.end(), ')', '}');
        REQUIRE(volumes.contains(name));
        CHECK(volume_of(read, read.regions[r]) == volumes[name]);
    }
    CHECK(read.layers.empty());
    // The fault dangles, so that its parts have the same region on both sides; the floor lies in the
    // box, which comes first.
    std::set<std::uint32_t> listed;
    for (const ModelRegion& region : read.regions)
        for (const ModelSide& side : region.sides) listed.insert(side.part);
    for (std::uint32_t p = 0; p < read.parts.size(); ++p)
        CHECK(listed.contains(p) == (read.surfaces[read.parts[p].surface].name != "floor"));
    CHECK(read.parts.size() == lines_with(text, "TFACE ").size());
    CHECK(lines_with(text, "TSURF ") == std::vector<std::string>{"TSURF box", "TSURF base",
                                                                 "TSURF top (2)", "TSURF F 1",
                                                                 "TSURF floor"});
    CHECK(lines_with(text, "TFACE 1 ") == std::vector<std::string>{"TFACE 1  boundary box"});
    CHECK(text.find("AXIS_UNIT") == std::string::npos); // no unit is known
    const auto feet = to_gocad_model(model.mesh, model.volumes, model.structure, "m", "ft");
    for (const Surface& s : read_again(feet).surfaces) CHECK(s.frame.vertical_unit == "ft");
}

TEST_CASE("GOCAD model: layers, names that would be misread, and blocks read as they were",
          "[io][gocad]") {
    BlockNaming naming;
    naming.column = {{"universe", "top {2}"}, {"Reservoir \"A\"", "base"}, {"Basement", ""}};
    auto surfaces = layered_box();
    surfaces[3] = quad({4, -1, -1}, {4, 9, -1}, {4, 9, 9}, {4, -1, 9}, "F 1"); // divides all
    const Model model = built_model(surfaces, naming);
    REQUIRE(model.structure.blocks.size() == 7);
    const GocadModel read = read_again(model_text(model));
    REQUIRE(read.layers.size() == 3);
    for (const ModelLayer& layer : read.layers) CHECK(layer.regions.size() == 2);
    const auto stated = stated_blocks_of(read);
    REQUIRE(stated.size() == 6);
    const Model again = built_model(read.surfaces, {{}, stated});
    std::map<std::string, std::pair<std::string, double>> before, after;
    for (std::size_t b = 1; b < 7; ++b) {
        const ModelBlock &x = model.structure.blocks[b], &y = again.structure.blocks[b];
        before[x.name] = {x.unit, x.volume};
        after[y.name] = {y.unit, y.volume};
    }
    CHECK(after == before);
}

TEST_CASE("GOCAD model: a real model has the same blocks when it is read again", "[io][gocad]") {
    const Model model = built_model(read_data("ringmesh/modelA1.ml"));
    const GocadModel read = read_again(model_text(model));
    check_same_surfaces(model.mesh, read.surfaces);
    const Model again = built_model(read.surfaces, {{}, stated_blocks_of(read)});
    REQUIRE(again.structure.blocks.size() == model.structure.blocks.size());
    std::map<std::string, double> before, after;
    for (std::size_t b = 1; b < model.structure.blocks.size(); ++b) {
        before[model.structure.blocks[b].name] = model.structure.blocks[b].volume;
        after[again.structure.blocks[b].name] = again.structure.blocks[b].volume;
    }
    CHECK(after == before);
}

TEST_CASE("GOCAD model: corners and borders are where faces end", "[io][gocad]") {
    const Model model = built_model({cube(0, 8, "box"), level(4, 0, 0, 8, 8, "middle")});
    const std::string text = model_text(model);
    const auto middle = text.substr(text.find("name_in_model_list: middle"));
    CHECK(lines_with(middle, "TFACE").size() == 1);
    CHECK(lines_with(middle, "VRTX").size() == 8);   // diagonals of the sides end there
    CHECK(lines_with(middle, "BORDER").size() == 1); // closed, without a corner
    CHECK(lines_with(middle, "BSTONE").size() == 1);
    const auto walls =
        text.substr(text.find("name_in_model_list: box"),
                    text.find("name_in_model_list: middle") - text.find("name_in_model_list: box"));
    CHECK(lines_with(walls, "TFACE").size() == 2);
    CHECK(lines_with(walls, "ATOM").size() == 8); // both parts have the vertices of the middle
    CHECK(lines_with(walls, "BORDER").size() == 2);
}

TEST_CASE("GOCAD: lines of a model are read back as points, by kind and surfaces", "[io][gocad]") {
    const Model model = built_model(layered_box());
    const auto text = lines_to_gocad(model.mesh, model.structure);
    REQUIRE(text);
    const auto names = lines_with(*text, "name: ");
    CHECK(std::ranges::count(names, "name: cutoff line of base and F 1") == 1);
    CHECK(std::ranges::count(names, "name: free border of F 1") == 1);
    CHECK(std::ranges::count(names, "name: \"cutoff line of top {2} and F 1\"") == 1);
    std::size_t edges = 0, vertices = 0;
    std::set<Point3> meant, found;
    for (const ModelLine& line : model.structure.lines) {
        edges += line.vertices.size() - 1;
        vertices += line.vertices.size() - (line.vertices.front() == line.vertices.back() ? 1 : 0);
        for (const auto v : line.vertices) meant.insert(model.mesh->vertices[v]);
    }
    CHECK(lines_with(*text, "SEG ").size() == edges);
    CHECK(lines_with(*text, "VRTX ").size() == vertices);
    CHECK(lines_with(*text, "ILINE").size() == model.structure.lines.size());
    const auto read = parse_surfaces(*text, "a.pl", Format::pline, {.max_edge = 100});
    REQUIRE(read);
    for (const Surface& s : *read) found.insert(s.vertices.begin(), s.vertices.end());
    CHECK(found == meant);
    CHECK(lines_to_gocad(Mesh{}, Structure{}).error().code == ErrorCode::nothing_to_do);
}

TEST_CASE("GOCAD: borders, intersections and vertices of a mesh", "[io][gocad]") {
    const Mesh mesh = mesh_of(
        {level(0, 0, 0, 4, 4, "flat"), quad({2, 1, -1}, {2, 3, -1}, {2, 3, 1}, {2, 1, 1}, "wall")});
    const auto lines = format_mesh(mesh, Format::pline);
    REQUIRE(lines);
    CHECK(lines_with(*lines, "name: ") == std::vector<std::string>{"name: flat border",
                                                                   "name: wall border",
                                                                   "name: flat and wall"});
    const auto cross = lines->substr(lines->find("name: flat and wall"));
    CHECK(lines_with(cross, "VRTX ").front() == "VRTX 1 2 1 0");
    CHECK(lines_with(cross, "VRTX ").back().ends_with(" 2 3 0"));
    CHECK(lines_with(cross, "ILINE").size() == 1);
    const auto border = lines->substr(0, lines->find("GOCAD PLine", 5));
    CHECK(lines_with(border, "SEG ").back() == "SEG 4 1"); // closed
    CHECK(lines_with(border, "VRTX ").size() == 4);
    const auto points = format_mesh(mesh, Format::vset);
    REQUIRE(points);
    const auto read = parse_surfaces(*points, "a.vs", Format::vset, {.max_edge = 100});
    REQUIRE(read);
    REQUIRE(read->size() == 2);
    CHECK(read->at(0).name == "flat");
    const auto meant = surfaces_of_mesh(mesh);
    CHECK(read->at(0).vertices == meant[0].vertices);
    CHECK(read->at(1).vertices == meant[1].vertices);
    const Mesh closed = mesh_of({cube(0, 1)});
    const auto none = format_mesh(closed, Format::pline);
    REQUIRE_FALSE(none);
    CHECK(none.error().message() == "there is no line: no border and no intersection");
    CHECK(holds_outlines(Format::vset));
    CHECK_FALSE(holds_surfaces(Format::pline));
    CHECK_FALSE(holds_outlines(Format::gocad));
}
