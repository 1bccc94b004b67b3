// SPDX-License-Identifier: LGPL-3.0-or-later
//
// In which block each cell of a corner-point grid lies, judged by formulas.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

constexpr int across = 12, down = 10; ///< cells along x and y, and along z

/// A grid over [0, 1200] x [0, 1200] with depths from 1000 to 1500, whose pillars lean by `lean`.
std::string cell_grid(double lean, const std::string& more = "") {
    std::string text = fmt::format("SPECGRID\n{0} {0} {1} 1 F /\nCOORD\n", across, down);
    for (int j = 0; j <= across; ++j)
        for (int i = 0; i <= across; ++i)
            text += fmt::format("{0} {1} 1000 {2} {1} 2000\n", 100 * i, 100 * j, 100 * i + lean);
    text += "/\nZCORN\n";
    for (int level = 0; level < 2 * down; ++level)
        text += fmt::format("{}*{}\n", 4 * across * across, 1000 + 50 * ((level + 1) / 2));
    return text + "/\n" + more;
}

/// Calls visit(number, x, y, z) for the centre of each cell.
void for_each_centre(double lean,
                     const std::function<void(std::size_t, double, double, double)>& visit) {
    std::size_t cell = 0;
    for (int k = 0; k < down; ++k)
        for (int j = 0; j < across; ++j)
            for (int i = 0; i < across; ++i) {
                const double depth = 1025 + 50 * k;
                visit(cell++, 50 + 100 * i + lean * (depth - 1000) / 1000, 50 + 100 * j, -depth);
            }
}

/// Returns the values of a keyword.
std::vector<int> cell_values(const std::string& text, const std::string& keyword) {
    std::istringstream stream(text.substr(text.find("\n" + keyword + "\n") + keyword.size() + 2));
    std::vector<int> values;
    for (std::string word; stream >> word && word != "/";) {
        const auto star = word.find('*');
        const int count = star == std::string::npos ? 1 : std::stoi(word);
        const int value = std::stoi(word.substr(star == std::string::npos ? 0 : star + 1));
        values.insert(values.end(), std::size_t(count), value);
    }
    return values;
}

std::string plane(const std::string& name, double z, double dx, double dy, int first) {
    std::string text = "o " + name + "\n";
    for (const auto& [x, y] : {std::pair(-500, -500), {3500, -500}, {3500, 2500}, {-500, 2500}})
        text += fmt::format("v {} {} {}\n", x, y, z + dx * x + dy * y);
    return text + fmt::format("f {} {} {} {}\n", first, first + 1, first + 2, first + 3);
}

/// Two inclined horizons and a vertical fault at x = 640.
const std::string inclined_layers =
    plane("top", -1160, 0.125, 0.03125, 1) + plane("base", -1330, -0.0625, 0.03125, 5) +
    "o F1\nv 640 -500 -3000\nv 640 2500 -3000\nv 640 2500 500\nv 640 -500 500\n"
    "f 9 10 11 12\n";

const std::string in_box =
    " -o out --box -100,-100,-1470,1250,1300,-900 --role top=horizon --role base=horizon"
    " --role F1=fault ";

/// Returns the numbers of blocks by their names.
std::map<std::string, int> numbers_in(const std::string& model) {
    std::map<std::string, int> numbers;
    const auto blocks = Json::parse(model)["blocks"];
    for (std::size_t b = 0; b < blocks.size(); ++b) numbers[blocks[b]["name"]] = int(b);
    return numbers;
}

} // namespace

TEST_CASE("cli: cells of a grid in inclined layers on both sides of a fault", "[cli][grdecl]") {
    for (const double lean : {0.0, 250.0}) {
        const Folder folder;
        const auto in = folder.input("layers.obj", inclined_layers);
        folder.input("grid.grdecl", cell_grid(lean));
        const auto r =
            folder.run("volume " + in + in_box + "--grid in/grid.grdecl --cells cells.grdecl");
        INFO(r.err);
        REQUIRE(r.status == 0);
        const auto numbers = numbers_in(folder.read("out/model.json"));
        REQUIRE(numbers.size() == 7);
        const auto text = folder.read("cells.grdecl");
        const auto active = cell_values(text, "ACTNUM"), block = cell_values(text, "FIPNUM");
        REQUIRE(active.size() == std::size_t(across * across * down));
        REQUIRE(block.size() == active.size());
        std::map<int, int> wrong;
        std::map<std::string, int> counts;
        for_each_centre(lean, [&](std::size_t cell, double x, double y, double z) {
            const std::string side = x < 640 ? "west" : "east";
            std::string name = z > -1160 + 0.125 * x + 0.03125 * y ? "above top, " + side + " of F1"
                               : z > -1330 - 0.0625 * x + 0.03125 * y
                                   ? "below top, above base, " + side + " of F1"
                                   : "below base, " + side + " of F1";
            if (x > 1250 || z < -1470) name = "outside";
            REQUIRE(numbers.contains(name));
            const int meant = numbers.at(name);
            if (block[cell] != meant || active[cell] != std::min(meant, 1)) ++wrong[meant];
            ++counts[name];
        });
        CHECK(wrong.empty());
        CHECK(counts.size() == 7);
        for (const auto& [name, number] : numbers) // which the comments state
            if (number != 0)
                CHECK(contains(text,
                               fmt::format("-- {} {}: {} cells\n", number, name, counts[name])));
        CHECK(contains(r.out,
                       fmt::format("cells of in/grid.grdecl: {} in blocks, {} outside, 0 not "
                                   "active\nwrote cells.grdecl\n",
                                   across * across * down - counts["outside"], counts["outside"])));
    }
}

TEST_CASE("cli: cells of a grid in nested boxes, some of them not active", "[cli][grdecl]") {
    const Folder folder;
    std::string boxes; // whose sides pass through some centres
    int first = 1;
    const auto add = [&](const std::string& name, double low, double high, double base,
                         double top) {
        boxes += "o " + name + "\n";
        for (const double z : {base, top})
            for (const auto& [x, y] : {std::pair(low, low), {high, low}, {high, high}, {low, high}})
                boxes += fmt::format("v {} {} {}\n", x, y, z);
        for (const std::array<int, 4>& f : {std::array{0, 3, 2, 1},
                                            {4, 5, 6, 7},
                                            {0, 1, 5, 4},
                                            {1, 2, 6, 5},
                                            {2, 3, 7, 6},
                                            {3, 0, 4, 7}})
            boxes += fmt::format("f {} {} {} {}\n", first + f[0], first + f[1], first + f[2],
                                 first + f[3]);
        first += 8;
    };
    add("outer", 150, 1010, -1475, -1040);
    add("inner", 333, 850, -1390, -1125);
    const auto in = folder.input("boxes.obj", boxes);
    std::string inactive = "ACTNUM\n";
    for (int k = 0; k < down; ++k)
        inactive += fmt::format("{}*{}\n", across * across, k % 3 == 0 ? 0 : 1);
    const auto grid = cell_grid(0, inactive + "/\n");
    folder.input("grid.grdecl", grid);
    const auto r = folder.run("volume " + in + " -o out --grid in/grid.grdecl --cells - > cells");
    INFO(r.err);
    REQUIRE(r.status == 0);
    const auto text = folder.read("cells");
    const auto active = cell_values(text, "ACTNUM"), block = cell_values(text, "FIPNUM");
    REQUIRE(block.size() == std::size_t(across * across * down));
    bool all_right = true;
    std::size_t cells_inside = 0;
    for_each_centre(0, [&](std::size_t cell, double x, double y, double z) {
        // A centre on a side counts to what is east of it, else north, else above.
        const auto in_range = [](double v, double low, double high) {
            return v >= low && v < high;
        };
        const auto in_box_of = [&](double low, double high, double base, double top) {
            return in_range(x, low, high) && in_range(y, low, high) && in_range(z, base, top);
        };
        const int meant = cell / (across * across) % 3 == 0    ? 0
                          : in_box_of(333, 850, -1390, -1125)  ? 2
                          : in_box_of(150, 1010, -1475, -1040) ? 1
                                                               : 0;
        all_right = all_right && block[cell] == meant && active[cell] == std::min(meant, 1);
        cells_inside += meant == 0 ? 0U : 1U;
    });
    CHECK(all_right);
    CHECK(cells_inside > 200);

    // After the grid without its own ACTNUM the file is part of a grid, which is read.
    const auto whole = folder.input("whole.grdecl", cell_grid(0) + text);
    const auto again = folder.run("volume " + whole + " -o again --stats again.json");
    REQUIRE(again.status == 0);
    const auto stats = Json::parse(folder.read("again.json"));
    CHECK(double(stats["volumes"]["all"]) == Approx(100 * 100 * 50 * double(cells_inside)));
}

TEST_CASE("cli: cells: what is refused, before the work", "[cli][grdecl]") {
    const Folder folder;
    const auto in = folder.input("layers.obj", inclined_layers);
    folder.input("grid.grdecl", cell_grid(0));
    folder.input("feet.grdecl", "GRIDUNIT\nFEET /\n" + cell_grid(0));
    folder.input("bad.grdecl", "SPECGRID\n2 2 2 1 F /\n");
    const auto metres = folder.input(
        "metres.ts",
        "GOCAD TSurf 1\nHEADER {\nname:m\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\n"
        "AXIS_UNIT m m m\nZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\nVRTX 1 0 "
        "0 -1000\nVRTX 2 9 0 -1000\nVRTX 3 0 9 -1000\nTRGL 1 2 3\nEND\n");
    const auto refused = [&](const std::string& arguments, const std::string& reason) {
        const auto r = folder.run("volume " + arguments);
        INFO(r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, reason));
    };
    refused(in + in_box + "--cells c", "--grid, --cells: each needs the other one");
    refused(in + in_box + "--grid in/grid.grdecl", "--grid, --cells: each needs the other one");
    refused(in + in_box + "--grid in/bad.grdecl --cells c", "in/bad.grdecl: there is no COORD");
    refused(in + in_box + "--grid in/no.grdecl --cells c", "in/no.grdecl: cannot be read");
    refused(in + in_box + "--grid in/grid.grdecl --cells no/c", "there is no folder no");
    CHECK(folder.left().empty());
    refused(metres + " -o out --grid in/feet.grdecl --cells c",
            "the grid in/feet.grdecl is in ft, but the surfaces are in m; --unit ft converts them");
}
