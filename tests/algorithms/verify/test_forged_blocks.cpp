// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of blocks and tetrahedra: those of the producer are accepted, and each forgery is
// refuted by its rule.
#include "support/forged_blocks.hpp"
#include "support/paths.hpp"

#include <cctype>

#include <gmpxx.h>

namespace forged_blocks_test {

using namespace forged;

namespace {

/// Boxes that touch in a corner, in an edge and in a side.
std::vector<File> touching() {
    return {{"a.obj", cube("a", "0", "2")},
            {"b.obj", cube("b", "2", "4")},
            {"c.obj", "v 0 0 2\nv 2 0 2\nv 0 2 2\nv 1 1 4\ng c\n"
                      "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"},
            {"d.obj", cube("d", "1", "1.5")}};
}

/// A tetrahedron, and four triangles that divide it into two blocks with the same five vertices. Both blocks
/// have the triangle of the three least vertices, from different sides.
std::vector<File> halves(bool turned) {
    return {{"whole.obj", "v 0 0 0\nv 0 8 0\nv 8 0 0\nv 8 8 8\ng whole\n"
                          "f 1 2 3\nf 1 3 4\nf 2 3 4\nf 1 2 4\n"},
            {"wall.obj", "v 0 0 0\nv 0 8 0\nv 8 0 0\nv 8 8 8\nv 2 3 1\ng wall\n" +
                             std::string(turned ? "f 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n"
                                                : "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n")}};
}

Forgery blocks(const std::string& name, const std::function<void(Json&)>& change,
               const std::string& rule) {
    return {name, [change](Json& c) { change(c["blocks"]); }, rule};
}

/// The first shell that bounds this block, from the outside or not.
std::size_t shell_of(const Json& b, int block, bool outer = true) {
    for (std::size_t s = 0; s < b["block_of_shell"].size(); ++s)
        if (b["block_of_shell"][s] == block && b["around"][s].is_null() == outer) return s;
    FAIL("no such shell");
    return 0;
}

/// Adds a unit in the last place of the numerator.
std::string next(const std::string& fraction) {
    const auto bar = fraction.find('/');
    const mpz_class numerator(fraction.substr(0, bar));
    return mpz_class(numerator + 1).get_str() +
           (bar == std::string::npos ? "" : fraction.substr(bar));
}

void swap_numbers(Json& b, int first, int second) {
    for (Json& n : b["block_of_shell"])
        if (n == first)
            n = second;
        else if (n == second)
            n = first;
    std::swap(b["volumes"][static_cast<std::size_t>(first)],
              b["volumes"][static_cast<std::size_t>(second)]);
}

std::vector<File> files_of_model(const std::string& name) {
    const auto surfaces = read_surfaces(test_support::source_dir() + "/tests/data/" + name);
    REQUIRE(surfaces);
    std::vector<File> files;
    for (std::size_t s = 0; s < surfaces->size(); ++s) {
        const Surface& surface = (*surfaces)[s];
        Mesh mesh{
            {{surface.name, surface.role}}, surface.vertices, surface.triangles, {}, {}, {}, {}};
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
        files.push_back({std::to_string(s) + ".obj", format_mesh(mesh, Format::obj).value()});
    }
    return files;
}

} // namespace

TEST_CASE("certificates of blocks: accepted") {
    for (const auto& files :
         {nested(), touching(), std::vector<File>{{"c.obj", cube("c", "0", "1")}}, pierced(),
          overlapping()})
        for (const char* format : {"vtp", "obj"}) {
            const Subject s = block_subject(files, format);
            CHECK(judged(s) == "");
        }
}

TEST_CASE("certificates of blocks: accepted, real models", "[once]") {
    CHECK(judged(block_subject(files_of_model("ringmesh/modelA1.ml"))) == "");
}

TEST_CASE("certificates of blocks: shells, nesting and volumes") {
    const Json b = block_subject(nested()).certificate["blocks"];
    CHECK(b["exact"] == 5);
    CHECK(b["volumes"].size() == 6);
    CHECK(b["volumes"][5] == "1");                                // apart
    CHECK(std::ranges::count(b["block_of_shell"], Json(0)) == 2); // all, and what is apart
    const auto inner =
        std::ranges::count_if(b["around"], [](const Json& a) { return !a.is_null(); });
    CHECK(inner == 3); // inner in outer, innermost in inner, sheet in inner
}

TEST_CASE("certificates of blocks: with the same vertices, the least side decides the numbers") {
    for (const bool turned : {false, true}) {
        const Subject s = block_subject(halves(turned));
        CHECK(s.certificate["blocks"]["volumes"] == Json({"256/3", "160/3", "32"}));
        check_forgeries(s, {blocks(
                               "swapped numbers", [](Json& b) { swap_numbers(b, 1, 2); }, "R33")});
    }
}

TEST_CASE("certificates of blocks: the least coordinate decides the numbers, by one double") {
    const auto box = [](const std::string& name, const std::string& x, const std::string& y) {
        std::string text;
        for (const char* z : {"0", "1"})
            for (const std::string& to_y : {y, y + ".5"})
                for (const std::string& to_x : {x, std::string("3")})
                    text += "v " + to_x + " " + to_y + " " + z + "\n";
        const std::string whole = cube(name, "0", "1");
        return File{name + ".obj", text + whole.substr(whole.find("g "))};
    };
    const Subject s =
        block_subject({box("first", "1.0000000000000002", "0"), box("second", "1", "5")});
    CHECK(judged(s) == "");
    CHECK(s.certificate["blocks"]["volumes"][1] == "1"); // the second box
}

TEST_CASE("forged certificates of blocks") {
    const Subject s = block_subject(nested());
    check_forgeries(
        s,
        {
            blocks(
                "a relabelled block", [](Json& b) { b["block_of_shell"][shell_of(b, 5)] = 4; },
                "R33"),
            blocks(
                "a block claimed to be the outside",
                [](Json& b) { b["block_of_shell"][shell_of(b, 5)] = 0; }, "R33"),
            blocks(
                "the outside claimed to be a block",
                [](Json& b) { b["block_of_shell"][shell_of(b, 0)] = 1; }, "R33"),
            blocks(
                "swapped numbers", [](Json& b) { swap_numbers(b, 1, 2); }, "R33"),
            blocks(
                "swapped numbers of nested blocks", [](Json& b) { swap_numbers(b, 2, 3); }, "R33"),
            blocks(
                "swapped numbers of blocks apart", [](Json& b) { swap_numbers(b, 4, 5); }, "R33"),
            blocks(
                "a number beyond all", [](Json& b) { b["block_of_shell"][0] = 77; }, "R33"),
            blocks(
                "a shell of another block",
                [](Json& b) { b["block_of_shell"][shell_of(b, 3, false)] = 1; }, "R33"),
            blocks(
                "a volume with another last digit",
                [](Json& b) { b["volumes"][1] = next(b["volumes"][1]); }, "R34"),
            blocks(
                "another sum of volumes", [](Json& b) { b["volumes"][0] = next(b["volumes"][0]); },
                "R34"),
            blocks(
                "swapped volumes", [](Json& b) { std::swap(b["volumes"][3], b["volumes"][5]); },
                "R34"),
            blocks(
                "a volume that is not reduced", [](Json& b) { b["volumes"][5] = "2/2"; }, "R34"),
            blocks(
                "a volume as a decimal", [](Json& b) { b["volumes"][5] = "1.0"; }, "R34"),
            blocks(
                "a negative volume", [](Json& b) { b["volumes"][5] = "-1"; }, "R34"),
            blocks(
                "a volume that is no number", [](Json& b) { b["volumes"][5] = ""; }, "R34"),
            blocks(
                "a volume missing", [](Json& b) { b["volumes"].erase(2); }, "R33"),
            blocks(
                "a volume too many", [](Json& b) { b["volumes"].push_back("0"); }, "R33"),
            blocks(
                "no volumes", [](Json& b) { b["volumes"] = Json::array(); }, "R33"),
            blocks(
                "an exact block more", [](Json& b) { b["exact"] = 6; }, "R33"),
            blocks(
                "an exact block less", [](Json& b) { b["exact"] = 4; }, "R33"),
            blocks(
                "an inner shell that claims to be an outer one",
                [](Json& b) { b["around"][shell_of(b, 3, false)] = nullptr; }, "R32"),
            blocks(
                "an outer shell that claims to be an inner one",
                [](Json& b) { b["around"][shell_of(b, 5)] = shell_of(b, 1); }, "R32"),
            blocks(
                "an inner shell within another block",
                [](Json& b) { b["around"][shell_of(b, 3, false)] = shell_of(b, 1); }, "R32"),
            blocks(
                "a shell around itself",
                [](Json& b) {
                    const auto inner = shell_of(b, 3, false);
                    b["around"][inner] = inner;
                },
                "R32"),
            blocks(
                "an outer shell around the outside",
                [](Json& b) { b["around"][shell_of(b, 0)] = shell_of(b, 5); }, "R32"),
            blocks(
                "all nesting forgotten",
                [](Json& b) {
                    for (Json& a : b["around"]) a = nullptr;
                },
                "R32"),
            blocks(
                "shells in another order",
                [](Json& b) {
                    for (const char* list : {"shells", "block_of_shell", "around"})
                        std::swap(b[list][0], b[list][1]);
                },
                "R31"),
            blocks(
                "a side in another shell",
                [](Json& b) {
                    b["shells"][1].push_back(b["shells"][0].back());
                    b["shells"][0].erase(b["shells"][0].size() - 1);
                },
                "R31"),
            blocks(
                "two shells made one",
                [](Json& b) {
                    for (const Json& side : b["shells"][1]) b["shells"][0].push_back(side);
                    std::sort(b["shells"][0].begin(), b["shells"][0].end());
                    for (const char* list : {"shells", "block_of_shell", "around"})
                        b[list].erase(1);
                },
                "R31"),
            blocks(
                "a side dropped", [](Json& b) { b["shells"][0].erase(0); }, "R31"),
            blocks(
                "a side twice", [](Json& b) { b["shells"][0].push_back(b["shells"][0].back()); },
                "R31"),
            blocks(
                "a side that does not exist", [](Json& b) { b["shells"][0].push_back(99999); },
                "R31"),
            blocks(
                "sides in another order",
                [](Json& b) { std::swap(b["shells"][0][0], b["shells"][0][1]); }, "R31"),
            blocks(
                "no shells",
                [](Json& b) {
                    for (const char* list : {"shells", "block_of_shell", "around"})
                        b[list] = Json::array();
                },
                "R31"),
            blocks(
                "blocks of shells missing", [](Json& b) { b["block_of_shell"].erase(0); }, "R30"),
            blocks(
                "places of shells missing", [](Json& b) { b["around"].erase(0); }, "R30"),
            {"doubles that are said not to be conforming",
             [](Json& c) { c["rounded"]["clean"] = false; }, "R11"},
            {"no doubles", [](Json& c) { c["rounded"] = nullptr; }, "R30"},
        });
}

TEST_CASE("forged certificates of blocks: texts that are refused") {
    const Subject right = block_subject({{"c.obj", cube("c", "0", "1")}});
    const auto refused = [&](const std::function<void(Json&)>& change) {
        Subject s = right;
        change(s.certificate);
        return !parse_certificate(s.certificate.dump(), "c");
    };
    CHECK_FALSE(refused([](Json&) {}));
    CHECK(refused([](Json& c) { c["blocks"]["around"][0] = 4294967295U; }));
    CHECK(refused([](Json& c) { c["blocks"]["more"] = 1; }));
    CHECK(refused([](Json& c) { c["blocks"].erase("around"); }));
    CHECK(refused([](Json& c) { c.erase("blocks"); }));
    CHECK(refused([](Json& c) { c.erase("model"); }));
    CHECK(refused([](Json& c) { c["model"]["blocks"][1]["name"] = "c"; }));
    CHECK(refused([](Json& c) { c["model"]["blocks"][1]["volume"] = "nan"; }));
    CHECK(refused([](Json& c) { c["model"]["leaks"].push_back(Json::object()); }));
    CHECK(refused([](Json& c) { c["kind"] = "arrangement"; }));
    CHECK(refused([](Json& c) { c["kind"] = "tetrahedra"; }));
    CHECK(refused([](Json& c) { c["blocks"]["volumes"][0] = 1; }));
}

TEST_CASE("certificates of tetrahedra: accepted", "[tetrahedra]") {
    for (const auto& files : {nested(), std::vector<File>{{"c.obj", cube("c", "0", "1")}}}) {
        TetrahedraRequest whole, only_blocks, split;
        only_blocks.outside = false;
        split.split = {{"level", ""}, {"inner", ""}};
        if (files.size() == 1) split.split = {{"c", ""}};
        split.options.edge_length = 2;
        for (const TetrahedraRequest& request : {whole, only_blocks, split})
            CHECK(judged(tetrahedra_subject(files, request)) == "");
    }
}

TEST_CASE("forged certificates of tetrahedra", "[tetrahedra]") {
    TetrahedraRequest request;
    request.options.edge_length = 2;
    const Subject s = tetrahedra_subject(nested(), request);
    const auto change = [](const std::string& name, const std::function<void(Json&)>& how,
                           const std::string& rule) {
        return Forgery{name, [how](Json& c) { how(c["tetrahedra"]); }, rule};
    };
    const auto list = [](Json& t, const char* name) -> Json& { return t[name]; };
    check_forgeries(
        s,
        {
            change(
                "a tetrahedron dropped",
                [&](Json& t) {
                    list(t, "tetrahedra").erase(0);
                    list(t, "blocks").erase(0);
                },
                "R42"),
            change(
                "a tetrahedron twice",
                [&](Json& t) {
                    list(t, "tetrahedra").push_back(list(t, "tetrahedra")[0]);
                    list(t, "blocks").push_back(list(t, "blocks")[0]);
                },
                "R42"),
            change(
                "a tetrahedron inverted",
                [&](Json& t) { std::swap(t["tetrahedra"][3][0], t["tetrahedra"][3][1]); }, "R41"),
            change(
                "a tetrahedron in another block",
                [&](Json& t) { t["blocks"][0] = t["blocks"][0] == 1 ? 2 : 1; }, "R46"),
            change(
                "a block that does not exist", [&](Json& t) { t["blocks"][0] = 99; }, "R40"),
            change(
                "a block missing", [&](Json& t) { list(t, "blocks").erase(0); }, "R40"),
            change(
                "a node that does not exist", [&](Json& t) { t["tetrahedra"][0][0] = 999999; },
                "R40"),
            change(
                "a face dropped",
                [&](Json& t) {
                    list(t, "faces").erase(0);
                    list(t, "triangles").erase(0);
                },
                "R45"),
            change(
                "a face twice",
                [&](Json& t) {
                    list(t, "faces").push_back(list(t, "faces")[0]);
                    list(t, "triangles").push_back(list(t, "triangles")[0]);
                },
                "R42"),
            change(
                "a face turned over",
                [&](Json& t) { std::swap(t["faces"][0][0], t["faces"][0][1]); }, "R45"),
            change(
                "a face on another triangle", [&](Json& t) { t["triangles"][0] = 1; }, "R45"),
            change(
                "a face on the box that is not", [&](Json& t) { t["triangles"][0] = nullptr; },
                "R42"),
            change(
                "a face on a triangle that does not exist",
                [&](Json& t) { t["triangles"][0] = 99999; }, "R40"),
            change(
                "no box", [&](Json& t) { t["box"] = false; }, "R42"),
            change(
                "a corner moved by one bit", [&](Json& t) { t["vertices"][0][0] = "1e-300"; },
                "R44"),
            change(
                "a node that nothing needs",
                [&](Json& t) {
                    t["vertices"].push_back({"1e+300", "0", "0"});
                },
                "R44"),
            change(
                "twins that are none",
                [&](Json& t) {
                    t["twins"].push_back({0, 1});
                },
                "R48"),
            change(
                "a twin of itself",
                [&](Json& t) {
                    t["twins"].push_back({0, 0});
                },
                "R48"),
            change(
                "twins that do not exist",
                [&](Json& t) {
                    t["twins"].push_back({0, 99999});
                },
                "R40"),
            change(
                "nothing",
                [&](Json& t) {
                    for (const char* name :
                         {"vertices", "tetrahedra", "blocks", "faces", "triangles"})
                        t[name] = Json::array();
                },
                "R40"),
            {"blocks with other numbers in all places",
             [](Json& c) {
                 swap_numbers(c["blocks"], 1, 2);
                 for (Json& n : c["tetrahedra"]["blocks"])
                     if (n == 1)
                         n = 2;
                     else if (n == 2)
                         n = 1;
             },
             "R33"},
        });
}

TEST_CASE("forged certificates of tetrahedra: a file with other tetrahedra", "[tetrahedra]") {
    TetrahedraRequest split;
    split.split = {{"c", ""}};
    for (const TetrahedraRequest& request : {TetrahedraRequest{}, split}) {
        const Subject right = tetrahedra_subject({{"c.obj", cube("c", "0", "1")}}, request);
        check_each_byte(right);
        for (const std::size_t i : {2U, 3U}) // MSH is text: any digit
            for (std::size_t k = 0; k < right.contents[i].size(); k += 3) {
                if (!std::isdigit(static_cast<unsigned char>(right.contents[i][k]))) continue;
                Subject s = right;
                s.contents[i][k] = s.contents[i][k] == '7' ? '6' : '7';
                seal(s);
                INFO(k);
                CHECK(judged(s) == "R21");
            }
        for (const std::size_t i : {0U, 1U})
            for (const std::size_t other : {0U, 1U, 2U}) {
                Subject s = right;
                s.contents[i] = right.contents[other];
                s.contents[i][s.contents[i].size() / 2] ^= 1;
                seal(s);
                CHECK(judged(s) == "R21");
            }
    }
}

} // namespace forged_blocks_test
