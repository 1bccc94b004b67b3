// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the everyday mistakes of users: each is warned of with a sentence that names it, and is
// status 2 with --strict, or is refused with status 2 at once.
#include <functional>
#include <map>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// A sheet of 4 x 4 cells over a square.
struct Sheet {
    double x = 0, y = 0, size = 1000;
    std::function<double(double, double)> z = [](double, double) { return -1000.0; }; ///< of 0..1
    bool upright = false; ///< a wall along x at y, from z down by its size
};

Sheet at_height(double z, double x = 0, double y = 0, double size = 1000) {
    return {x, y, size, [z](double u, double v) { return z + 3 * u + 2 * v; }, false};
}

Sheet wall(double y, double x = 0) {
    return {x, y, 1000, [](double, double v) { return -500 - 1000 * v; }, true};
}

std::vector<std::array<double, 3>> points_of(const Sheet& s) {
    std::vector<std::array<double, 3>> points;
    for (int j = 0; j <= 4; ++j)
        for (int i = 0; i <= 4; ++i) {
            const double u = i / 4.0, v = j / 4.0;
            points.push_back({s.x + s.size * u, s.upright ? s.y + v : s.y + s.size * v, s.z(u, v)});
        }
    return points;
}

std::vector<std::array<int, 3>> triangles_of_sheet() {
    std::vector<std::array<int, 3>> all;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            const int a = 5 * j + i + 1;
            all.push_back({a, a + 1, a + 6});
            all.push_back({a, a + 6, a + 5});
        }
    return all;
}

/// A TSurf; `header` stands before its vertices.
std::string ts(const std::string& name, const Sheet& sheet, const std::string& header = "") {
    std::string text = "GOCAD TSurf 1\nHEADER {\nname:" + name + "\n}\n" + header + "TFACE\n";
    int id = 0;
    for (const auto& p : points_of(sheet))
        text += fmt::format("VRTX {} {} {} {}\n", ++id, p[0], p[1], p[2]);
    for (const auto& t : triangles_of_sheet())
        text += fmt::format("TRGL {} {} {}\n", t[0], t[1], t[2]);
    return text + "END\n";
}

std::string obj(const std::string& name, const Sheet& sheet) {
    std::string text = "o " + name + "\n";
    for (const auto& p : points_of(sheet)) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
    for (const auto& t : triangles_of_sheet())
        text += fmt::format("f {} {} {}\n", t[0], t[1], t[2]);
    return text;
}

std::string csv(const std::string& heading, const Sheet& sheet) {
    std::string text = heading + "\n";
    for (const auto& p : points_of(sheet)) text += fmt::format("{},{},{}\n", p[0], p[1], p[2]);
    return text;
}

std::string esri(double value) {
    std::string text =
        "ncols 5\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 200\nNODATA_value -9999\n";
    for (int j = 0; j < 5; ++j) text += fmt::format("{0} {0} {0} {0} {1}\n", value, value + 7);
    return text;
}

std::string units(const std::string& xy, const std::string& z,
                  const std::string& axis = "Elevation") {
    return fmt::format(
        "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n"
        "AXIS_UNIT \"{0}\" \"{0}\" \"{1}\"\nZPOSITIVE {2}\n"
        "END_ORIGINAL_COORDINATE_SYSTEM\n",
        xy, z, axis);
}

std::string system_called(const std::string& name, const std::string& projection) {
    return fmt::format("GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME {}\nPROJECTION {}\nDATUM Unknown\n"
                       "AXIS_UNIT \"m\" \"m\" \"m\"\nZPOSITIVE Elevation\n"
                       "END_ORIGINAL_COORDINATE_SYSTEM\n",
                       name, projection);
}

/// Coordinates like those of UTM, stored with 24 bits.
Sheet utm_in_float32() {
    Sheet s = at_height(-1000, 431234.5, 5834567.5, 300);
    s.z = [](double u, double v) { return static_cast<double>(float(-1000.123 - 7.77 * u * v)); };
    return s;
}

/// A corner-point grid of one cell over the sheets, at these depths.
std::string grdecl(double top, double base) {
    std::string text = "SPECGRID\n1 1 1 1 F /\nCOORD\n";
    for (const int y : {0, 1000})
        for (const int x : {0, 1000}) text += fmt::format("{0} {1} 0 {0} {1} 1\n", x, y);
    return text + fmt::format("/\nZCORN\n4*{} 4*{} /\n", top, base);
}

/// Two sticks of a fault with these values of z.
std::string sticks(double first, double last) {
    std::string text;
    for (const int y : {300, 700})
        for (const double z : {first, last})
            text += fmt::format("INLINE- 1 1 500 {} {} F1 {}\n", y, z, y);
    return text;
}

using Files = std::map<std::string, std::string>;

struct Mistake {
    std::string name;
    Files files;
    std::string arguments; ///< with files as in/NAME
    std::string about;     ///< name of the doubt; empty: refused
    std::string sentence;  ///< part of what is said
};

const std::string volume_of = "volume in/*.ts -o out";

// clang-format off
std::vector<Mistake> heights_units_and_systems() {
    const auto top = ts("top", at_height(-900)), base = ts("base", at_height(-1400));
    const auto metres = units("m", "m");
    return {
        {"depths beside heights", {{"a.ts", top}, {"b.csv", csv("x,y,z", at_height(1400))}},
         "arrange in/a.ts in/b.csv -o out.obj", "heights_mixed", "z of b is between 1400 and 1405"},
        {"one depth among three", {{"a.ts", top}, {"b.ts", base}, {"c.csv", csv("x,y,z", at_height(1100))}},
         "arrange in/a.ts in/b.ts in/c.csv -o out.obj", "heights_mixed", "--depth"},
        {"a grid of depths beside ZPOSITIVE Depth", {{"a.ts", ts("top", at_height(900), units("m", "m", "Depth"))}, {"b.asc", esri(1400)}},
         "arrange in/a.ts in/b.asc -o out.obj", "depths_unstated", "top counts z downward"},
        {"a grid of depths beside a corner-point grid", {{"a.grdecl", grdecl(900, 1300)}, {"b.asc", esri(1400)}},
         "arrange in/a.grdecl in/b.asc -o out.obj", "depths_unstated", "counts z downward"},
        {"sticks of depths beside heights", {{"a.ts", top}, {"b.ts", base}, {"c.sticks", sticks(1000, 1300)}},
         "arrange in/a.ts in/b.ts in/c.sticks -o out.obj", "heights_mixed", "z of F1 is between 1000 and 1300"},
        {"a column called depth", {{"a.csv", csv("x,y,depth", at_height(1400))}},
         "arrange in/a.csv -o out.obj", "depths_unstated", "a column called depth, with positive values"},
        {"a column called TVDSS", {{"a.csv", csv("X;Y;TVDSS", at_height(1400))}},
         "check in/a.csv", "depths_unstated", "Read it with --depth"},
        {"a fault 6000 km away", {{"a.ts", top}, {"b.ts", base}, {"c.ts", ts("F1", wall(500, 6e6))}},
         "arrange in/a.ts in/b.ts in/c.ts -o out.obj", "far_apart", "F1 is 5,999,000 away from top and base"},
        {"two faults far away together", {{"a.ts", top}, {"b.ts", base}, {"c.ts", ts("F1", wall(500, 1e5))}, {"d.ts", ts("F2", wall(700, 1e5))}},
         "arrange in/*.ts -o out.obj", "far_apart", "F1 and F2 is 99000 away"},
        {"x and y exchanged", {{"a.ts", ts("top", at_height(-900, 50000, 9000))}, {"b.ts", ts("base", at_height(-1400, 9000, 50000))}, {"c.ts", ts("mid", at_height(-1200, 50000, 9000))}},
         "arrange in/*.ts -o out.obj", "far_apart", "if its x and y were exchanged"},
        {"degrees beside metres", {{"a.ts", ts("top", at_height(-900, 431000, 5834000))}, {"b.ts", ts("F1", at_height(-900, 8.1, 52.2, .02))}},
         "arrange in/*.ts -o out.obj", "systems_mixed", "x and y of F1 look like degrees"},
        {"heights in feet", {{"a.ts", ts("top", at_height(-900), metres)}, {"b.ts", ts("base", at_height(-4600), units("m", "ft"))}},
         "arrange in/*.ts -o out.obj", "units_mixed", "different units for z: ft (base) and m (top)"},
        {"positions in feet", {{"a.ts", ts("top", at_height(-900), metres)}, {"b.ts", ts("base", at_height(-1400), units("ft", "ft"))}},
         "check in/a.ts in/b.ts", "units_mixed", "different units for x and y: ft (base) and m (top)"},
        {"positions in kilometres", {{"a.ts", ts("top", at_height(-900), metres)}, {"b.ts", ts("base", at_height(-1), units("km", "km"))}},
         "arrange in/*.ts -o out.obj", "units_mixed", "km (base)"},
        {"metres across, feet down", {{"a.ts", ts("top", at_height(-900), units("m", "ft"))}},
         "arrange in/a.ts -o out.obj", "units_mixed", "top states m for x and y, but ft for z"},
        {"a column called Depth_ft", {{"a.ts", ts("top", at_height(-900), metres)}, {"b.csv", csv("X_m,Y_m,Depth_ft", at_height(-4600))}},
         "arrange in/a.ts in/b.csv -o out.obj", "units_mixed", "b states m for x and y, but ft for z"},
        {"a column called z (ft)", {{"a.csv", csv("x (m),y (m),z (ft)", at_height(-4600))}},
         "arrange in/a.csv -o out.obj", "units_mixed", "--unit m"},
        {"a column called elevation[ft]", {{"a.csv", csv("easting[m],northing[m],elevation[ft]", at_height(-4600))}},
         "arrange in/a.csv -o out.obj", "units_mixed", "but ft for z"},
        {"survey feet", {{"a.ts", ts("top", at_height(-900), metres)}, {"b.ts", ts("base", at_height(-1400), units("ftUS", "ftUS"))}},
         "arrange in/*.ts -o out.obj", "units_mixed", "ftUS (base)"},
        {"different projections", {{"a.ts", ts("top", at_height(-900), system_called("Default", "\"UTM 31N\""))}, {"b.ts", ts("base", at_height(-1400), system_called("Default", "\"UTM 32N\""))}},
         "arrange in/*.ts -o out.obj", "systems_mixed", "UTM 31N (top) and UTM 32N (base)"},
        {"different coordinate systems", {{"a.ts", ts("top", at_height(-900), system_called("ED50", "Unknown"))}, {"b.ts", ts("base", at_height(-1400), system_called("WGS84", "Unknown"))}},
         "arrange in/*.ts -o out.obj", "systems_mixed", "ED50 (top) and WGS84 (base)"},
    };
}

std::vector<Mistake> open_or_double() {
    const auto top = ts("top", at_height(-900)), base = ts("base", at_height(-1400));
    const auto metres = units("m", "m");
    const auto box = " --box 100,100,-2000,900,900,-100";
    return {
        {"a box beside the data", {{"a.ts", top}, {"b.ts", base}},
         volume_of + " --box 5000,5000,-2000,6000,6000,0", "volume_without_data", "the volume of interest holds no surface"},
        {"a box of depths", {{"a.ts", top}, {"b.ts", base}},
         volume_of + " --box 0,0,500,1000,1000,2000", "volume_without_data", "depths are negative z"},
        {"a polygon beside the data", {{"a.ts", top}, {"b.ts", base}},
         volume_of + " --polygon 5000,0,6000,0,6000,1000 --between -2000,0", "volume_without_data", "x 5000 to 6000"},
        {"a polygon between depths", {{"a.ts", top}, {"b.ts", base}},
         volume_of + " --polygon 0,0,1000,0,1000,1000 --between 500,2000", "volume_without_data", "z 500 to 2000"},
        {"a rotated box beside the data", {{"a.ts", top}, {"b.ts", base}},
         volume_of + " --rotated-box 9000,9000,-1000,500,500,500,30", "volume_without_data", "no surface"},
        {"no top", {{"a.ts", base}, {"b.ts", ts("F1", wall(300))}, {"c.ts", ts("F2", wall(700))}},
         volume_of, "no_top", "base spans the model, and no other surface does: the model is open at its top"},
        {"no base", {{"a.ts", ts("top", at_height(-300))}, {"b.ts", ts("F1", wall(300))}, {"c.ts", ts("F2", wall(700))}},
         volume_of, "no_base", "the model is open at its base"},
        {"faults only", {{"b.ts", ts("F1", wall(300))}, {"c.ts", ts("F2", wall(700))}},
         volume_of, "no_top", "no surface spans the model from above"},
        {"tetrahedra without a top", {{"a.ts", base}, {"b.ts", ts("F1", wall(300))}},
         "tetrahedralize in/*.ts -o out.vtu", "no_top", "open at its top"},
        {"layers without sides", {{"a.ts", top}, {"b.ts", base}},
         volume_of, "no_block", "the surfaces enclose no block"},
        {"float32 in text", {{"a.obj", obj("top", utm_in_float32())}},
         "arrange in/a.obj -o out.obj", "float32", "multiples of 0.5"},
        {"float32 among others", {{"a.obj", obj("top", utm_in_float32())}, {"b.ts", ts("base", at_height(-1400.1, 431234.1, 5834567.1, 300))}},
         "check in/a.obj in/b.ts", "float32", "the coordinates of top were stored with 24 bits"},
        {"a file given twice", {{"a.ts", top}, {"b.ts", base}},
         "arrange in/a.ts in/b.ts in/a.ts -o out.obj", "duplicate_surface", "top_2 has the same 32 triangles as top"},
        {"a surface under two names", {{"a.ts", top}, {"b.ts", ts("horizon 1", at_height(-900))}},
         "arrange in/*.ts -o out.obj", "duplicate_surface", "horizon 1 has the same 32 triangles as top"},
        {"horizons that cross", {{"a.ts", ts("top", {0, 0, 1000, [](double u, double) { return -900 - 400 * u; }})}, {"b.ts", ts("base", {0, 0, 1000, [](double u, double) { return -1290 + 380 * u; }})}},
         volume_of + box, "horizons_cross", "horizons top and base run through each other"},
        {"units, in fill", {{"a.ts", ts("top", at_height(-900), metres)}, {"b.ts", ts("base", at_height(-4600), units("m", "ft"))}},
         "fill in/a.ts in/b.ts --list", "units_mixed", "ft (base)"},
        {"a column of depths, in convert", {{"a.csv", csv("x,y,depth", at_height(1400))}},
         "convert in/a.csv out.obj", "depths_unstated", "a column called depth"},
        {"far apart, in layer", {{"a.ts", top}, {"b.ts", ts("base", at_height(-1400, 90000))}},
         "layer in/a.ts in/b.ts --layer top=2 --layer base=1 -o out.obj", "far_apart", "base is"},
        {"a copy, in improve", {{"a.ts", top}, {"b.ts", ts("twin", at_height(-900))}},
         "improve in/a.ts in/b.ts -o out.obj", "duplicate_surface", "twin has the same"},
    };
}

std::vector<Mistake> refused() {
    const auto top = ts("top", at_height(-900)), base = ts("base", at_height(-1400));
    const Files two{{"a.ts", top}, {"b.ts", base}};
    return {
        {"a file that is not there", {}, "arrange in/none.ts -o out.obj", "", "in/none.ts"},
        {"an unknown extension", {{"a.doc", top}}, "arrange in/a.doc -o out.obj", "", "doc"},
        {"an empty file", {{"a.ts", ""}}, "arrange in/a.ts -o out.obj", "", "in/a.ts"},
        {"a truncated file", {{"a.ts", top.substr(0, top.size() - 4)}}, "arrange in/a.ts -o out.obj", "", "has no END"},
        {"an archive of RINGMesh", {{"a.gm", "PK\3\4mesh"}}, "arrange in/a.gm -o out.obj", "", "this is a ZIP archive"},
        {"points of GOCAD as surfaces", {{"a.gp", "GOCAD VSet 1\nVRTX 1 0 0 0\nEND\n"}}, "arrange in/a.gp -o out.obj", "", "--input-format vs"},
        {"a corner-point grid that includes files", {{"a.grdecl", "INCLUDE\n 'geo.inc' /\n"}}, "arrange in/a.grdecl -o out.obj", "", "INCLUDE names the file \"geo.inc\""},
        {"a grid of blocks without corners", {{"a.grdecl", "DIMENS\n1 1 1 /\nDX\n1*9 /\n"}}, "arrange in/a.grdecl -o out.obj", "", "only corner-point grids are read"},
        {"a fault of one stick", {{"a.sticks", "0 0 0\n0 0 -9\n"}}, "arrange in/a.sticks -o out.obj", "", "no fault has two sticks"},
        {"polygons called a grid", {{"a.vtu", "<VTKFile type=\"PolyData\"/>"}}, "arrange in/a.vtu -o out.obj", "", "only UnstructuredGrid is read"},
        {"a polygon of which only a corner is repeated", two, volume_of + " --polygon 0,0,1,1,0,0 --between 0,1", "", "a polygon needs three corners"},
        {"units mixed in a file", {{"a.ts", ts("top", at_height(-900), units("m", "m")) + ts("base", at_height(-900), units("m", "ft"))}}, "arrange in/a.ts -o out.obj", "", "AXIS_UNIT"},
        {"a box of five numbers", two, volume_of + " --box 0,0,0,1,1", "", "--box"},
        {"a box without extent", two, volume_of + " --box 0,0,0,0,1,1", "", "the first corner must be below"},
        {"a box beyond doubles", two, volume_of + " --box -1e308,-1e308,-1e308,1e308,1e308,1e308", "",
         "box: the box is too large for doubles"},
        {"a box that is not a number", two, volume_of + " --box 0,0,nan,1,1,1", "", "--box: needs a finite number"},
        {"a polygon of two corners", two, volume_of + " --polygon 0,0,1,1 --between 0,1", "", "a polygon needs three corners"},
        {"a polygon without heights", two, volume_of + " --polygon 0,0,1,0,1,1", "", "--between"},
        {"heights without a polygon", two, volume_of + " --between 0,1", "", "--between"},
        {"two volumes of interest", two, volume_of + " --box 0,0,0,1,1,1 --polygon 0,0,1,0,1,1 --between 0,1", "", "--polygon"},
        {"a negative width to seal", two, volume_of + " --seal -1", "", "seal"},
        {"a width to seal that is no number", two, volume_of + " --seal nan", "", "seal"},
        {"an unknown unit", two, volume_of + " --unit parsec", "", "--unit"},
        {"a role of an unknown surface", two, volume_of + " --role F1=fault", "", "F1"},
        {"an unknown role", two, volume_of + " --role top=roof", "", "roof"},
        {"an output of an unknown format", two, "arrange in/a.ts -o out.doc", "", "out.doc"},
        {"an output folder that is not there", two, "arrange in/a.ts -o none/out.obj", "", "there is no folder none"},
        {"a folder that is not empty", two, "volume in/a.ts -o in", "", "in"},
        {"surfaces as tetrahedra", two, "tetrahedralize in/a.ts -o out.obj", "", "tetrahedra are written as"},
        {"a third order of tetrahedra", two, "tetrahedralize in/a.ts -o out.vtu --order 3", "", "--order"},
        {"second order where a format has none", two, "tetrahedralize in/a.ts -o out.ugi --order 2", "", "no tetrahedra of second order"},
        {"several files on standard output", two, "tetrahedralize in/a.ts -o - --format geos", "", "several files: name the first"},
        {"split nodes for PyLith", two, "tetrahedralize in/a.ts -o out.msh --output-format pylith --split top", "", "leave out --split"},
        {"a certificate of a format that is not read", two, "tetrahedralize in/a.ts -o out.exo --certificate c.json", "", "tetrahedra of first order in .vtu"},
        {"a certificate of second order", two, "tetrahedralize in/a.ts -o out.vtu --order 2 --certificate c.json", "", "tetrahedra of first order in .vtu"},
        {"a negative count of threads", two, volume_of + " --threads -1", "", "--threads"},
        {"a longest edge of 0", two, volume_of + " --max-edge 0", "", "--max-edge"},
        {"a command that is misspelt", two, "volum in/a.ts -o out", "", "there is no command volum; did you mean volume?"},
        {"an option that is misspelt", two, "tetrahedralize in/a.ts -o out.vtu --edge-lenght 3", "", "tetrahedralize has no option --edge-lenght; did you mean --edge-length?"},
        {"points on a line", {{"a.csv", "0,0,0\n1,1,1\n2,2,2\n"}}, "arrange in/a.csv -o out.obj", "", "near enough"},
        {"standard input twice", {}, "arrange --format ts - - -o out.obj", "", "only once"},
        {"a layer without hardness", two, "layer in/a.ts in/b.ts --layer top --layer base=1 -o out.obj", "", "top"},
        {"a layer that is not there", two, "layer in/a.ts in/b.ts --layer roof=1 --layer base=1 -o out.obj", "", "roof"},
        {"a negative thickness", two, "layer in/a.ts in/b.ts --layer top=2 --layer base=1 --min-thickness -1 -o out.obj", "", "thickness"},
        {"a project that is not there", {}, "build in/none.json", "", "in/none.json"},
        {"a project with an unknown key", {{"p.json", R"({"format": "terrane-project 1", "folder": "run", "surfacs": []})"}}, "build in/p.json", "", "surfacs"},
        {"a project with a missing file", {{"p.json", R"({"format": "terrane-project 1", "folder": "run", "surfaces": [{"file": "none.ts"}], "outputs": {"surfaces": ["obj"]}})"}}, "build in/p.json", "", "none.ts"},
    };
}
// clang-format on

Outcome run(const Folder& folder, const Mistake& mistake, const std::string& more = "") {
    for (const auto& [name, text] : mistake.files) (void)folder.input(name, text);
    return folder.run(mistake.arguments + more);
}

bool takes_stats(const std::string& arguments) {
    return !arguments.starts_with("check") && !arguments.starts_with("convert");
}

} // namespace

TEST_CASE("cli: mistakes lead to warnings, and to status 2 with --strict",
          "[cli][plausibility][once]") {
    auto mistakes = heights_units_and_systems();
    for (Mistake& m : open_or_double()) mistakes.push_back(std::move(m));
    REQUIRE(mistakes.size() + refused().size() >= 60);
    for (const Mistake& m : mistakes) {
        INFO(m.name);
        const Folder folder;
        const bool stats = takes_stats(m.arguments);
        const auto warned = run(folder, m, stats ? " --stats s.json" : "");
        INFO(warned.err);
        CHECK(warned.status <= 1);
        CHECK(contains(warned.err, "terrane: warning: "));
        CHECK(contains(warned.err, m.sentence));
        if (stats) {
            const auto warnings = Json::parse(folder.read("s.json")).at("warnings");
            CHECK(std::ranges::any_of(warnings,
                                      [&](const Json& w) { return w["about"] == m.about; }));
        }
        const Folder again;
        const auto strict = run(again, m, " --strict");
        CHECK(strict.status == 2);
        CHECK(contains(strict.err, m.sentence));
        CHECK(again.left().empty());
    }
}

TEST_CASE("cli: mistakes that are refused", "[cli][plausibility]") {
    for (const Mistake& m : refused()) {
        INFO(m.name);
        const Folder folder;
        const auto outcome = run(folder, m);
        INFO(outcome.err);
        CHECK(outcome.status == 2);
        CHECK(contains(outcome.err, m.sentence));
        CHECK(folder.left().empty());
    }
}

TEST_CASE("cli: inputs that fit together are not warned of", "[cli][plausibility][once]") {
    const Folder folder;
    for (const std::string name : {"ringmesh/modelA1.ml", "ringmesh/modelA2.ml"}) {
        INFO(name);
        const auto made =
            folder.run("volume $D/" + name + " -o " + name.substr(9, 7) + " --strict");
        INFO(made.err);
        CHECK(made.status == 0);
        CHECK(made.err.empty());
    }
    // GOCAD names coordinate systems after how an object was made.
    const auto shape =
        folder.input("shape.ts", ts("F1", wall(500), system_called("from_Shape", "Unknown")));
    const auto column = folder.input(
        "column.ts", ts("moho", at_height(-1400), system_called("\" gocad Local\"", "Unknown")));
    const auto named =
        folder.input("named.ts", ts("top", at_height(-900), system_called("UTM 11N", "Unknown")));
    const auto systems =
        folder.run("arrange " + shape + " " + column + " " + named + " -o systems.obj --strict");
    INFO(systems.err);
    CHECK(systems.status == 0);
    const auto faults = folder.run(
        "arrange $D/arch-platform/faults.ts $D/arch-platform/mnt.ts -o out.obj --strict");
    INFO(faults.err);
    CHECK(faults.status == 0);
}

TEST_CASE("cli: --unit converts what states its unit", "[cli][plausibility]") {
    const Folder folder;
    const auto a = folder.input("a.ts", ts("top", at_height(-900), units("m", "m")));
    const auto b = folder.input("b.ts", ts("base", at_height(-4600), units("m", "ft")));
    const auto made = folder.run("arrange " + a + " " + b + " -o out.obj --unit m --strict");
    INFO(made.err);
    CHECK(made.status == 0);
    CHECK(contains(folder.read("out.obj"), fmt::format("v 0 0 {}\n", -4600 * 0.3048)));
}
