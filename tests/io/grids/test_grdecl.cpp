// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading corner-point grids: which surfaces they become, and what is refused.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/files.hpp>
#include <terrane/io/grids/grdecl.hpp>

using namespace terrane;

namespace {

/// A grid of 100 x 100 m columns; the depth of a corner is a function of its column, its place a, b
/// and its level: 0 for the top of layer 1, 1 for its base, and so on.
struct TestGrid {
    int nx = 1, ny = 1, nz = 1;
    std::function<double(int i, int j, int a, int b, int level)> depth =
        [](int, int, int, int, int level) { return 1000 + 50.0 * level; };
    double lean = 0; ///< how far the lower ends of the pillars, at a depth of 2000, lie to the east
    std::string more{};

    [[nodiscard]] std::string text() const {
        std::string text =
            fmt::format("-- a test\nSPECGRID\n{} {} {} 1 F /\n\nCOORD\n", nx, ny, nz);
        for (int j = 0; j <= ny; ++j)
            for (int i = 0; i <= nx; ++i)
                text += fmt::format("{0} {1} 1000 {2} {1} 2000\n", 100 * i, 100 * j,
                                    100 * i + lean * (1 + 0.1 * j));
        text += "/\n\nZCORN\n";
        for (int level = 0; level < 2 * nz; ++level)
            for (int j = 0; j < 2 * ny; ++j)
                for (int i = 0; i < 2 * nx; ++i)
                    text += fmt::format("{} ", depth(i / 2, j / 2, i % 2, j % 2, (level + 1) / 2));
        return text + "\n/\n" + more;
    }
};

std::vector<Surface> read_grid(const std::string& text) {
    auto read = parse_surfaces(text, "a", Format::grdecl);
    if (!read) FAIL(read.error().message());
    return std::move(read).value();
}

std::string names_of(const std::vector<Surface>& surfaces) {
    std::string names;
    for (const Surface& s : surfaces) names += (names.empty() ? "" : ", ") + s.name;
    return names;
}

const Surface& named(const std::vector<Surface>& surfaces, const std::string& name) {
    const auto found = std::ranges::find(surfaces, name, &Surface::name);
    REQUIRE(found != surfaces.end());
    return *found;
}

double area_of(const Surface& s) {
    double sum = 0;
    for (const Triangle& t : s.triangles) {
        const Point3 a = s.vertices[t[0]], b = s.vertices[t[1]], c = s.vertices[t[2]];
        const std::array<double, 3> u{b.x - a.x, b.y - a.y, b.z - a.z},
            v{c.x - a.x, c.y - a.y, c.z - a.z};
        sum += std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                          u[0] * v[1] - u[1] * v[0]) /
               2;
    }
    return sum;
}

/// Returns how many triangles of all surfaces have each edge, known by its places.
std::map<std::array<Point3, 2>, int> edges_of(const std::vector<Surface>& surfaces) {
    std::map<std::array<Point3, 2>, int> count;
    for (const Surface& s : surfaces)
        for (const Triangle& t : s.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [a, b] = std::minmax(s.vertices[t[k]], s.vertices[t[(k + 1) % 3]]);
                ++count[{a, b}];
            }
    return count;
}

/// Tells whether no edge is a free border, which is so where all surfaces fit together.
bool closed(const std::vector<Surface>& surfaces) {
    return std::ranges::none_of(edges_of(surfaces), [](const auto& e) { return e.second < 2; });
}

std::string message_of_grid(const std::string& text) {
    const auto read = parse_surfaces(text, "a", Format::grdecl);
    REQUIRE_FALSE(read);
    return read.error().message();
}

/// Replaces the text before the values of COORD.
std::string with(const std::string& text, const std::string& from, const std::string& to) {
    std::string result = text;
    const auto at = result.find(from);
    REQUIRE(at != std::string::npos);
    return result.replace(at, from.size(), to);
}

/// The second column lies deeper by `throw_p` at its south and by `throw_q` at its north.
TestGrid faulted(double throw_p, double throw_q, double lean = 0) {
    return {2, 1, 2,
            [=](int i, int, int, int b, int level) {
                return 1000 + 50.0 * level + (i == 0 ? 0 : b == 0 ? throw_p : throw_q);
            },
            lean};
}

} // namespace

TEST_CASE("GRDECL: a cell becomes top, base and sides", "[io][grdecl]") {
    const auto surfaces = read_grid(TestGrid{}.text());
    REQUIRE(names_of(surfaces) == "top, base, sides");
    CHECK(surfaces[0].vertices ==
          std::vector<Point3>{{0, 0, -1000}, {100, 0, -1000}, {100, 100, -1000}, {0, 100, -1000}});
    CHECK(surfaces[0].triangles == std::vector<Triangle>{{0, 1, 2}, {2, 3, 0}});
    CHECK(surfaces[1].vertices[0] == Point3{0, 0, -1050});
    CHECK(surfaces[0].role == Role::horizon);
    CHECK(surfaces[2].role == Role::boundary);
    CHECK(surfaces[2].triangles.size() == 8);
    CHECK(surfaces[0].frame.vertical_axis == VerticalAxis::down);
    CHECK(closed(surfaces));
}

TEST_CASE("GRDECL: layers of neighbours share their vertices", "[io][grdecl]") {
    const auto surfaces = read_grid(TestGrid{3, 2, 3}.text());
    REQUIRE(names_of(surfaces) == "top, layer 2, layer 3, base, sides");
    for (std::size_t s = 0; s < 4; ++s) {
        CHECK(surfaces[s].vertices.size() == 12);
        CHECK(surfaces[s].triangles.size() == 12);
    }
    CHECK(area_of(surfaces[4]) == Approx(1000 * 150));
    CHECK(closed(surfaces));
}

TEST_CASE("GRDECL: doubles are kept on vertical pillars", "[io][grdecl]") {
    TestGrid grid;
    grid.depth = [](int, int, int a, int b, int level) {
        return 1234.1 + a / 3.0 + b / 7.0 + 0.1 * level;
    };
    const auto surfaces =
        read_grid(with(grid.text(), "\n100 100 1000 100 100 2000",
                       "\n100.30000000000001 1e2 1000 100.30000000000001 1D2 2000"));
    const Point3 corner{100.30000000000001, 100, -(1234.1 + 1 / 3.0 + 1 / 7.0)};
    CHECK(std::ranges::count(surfaces[0].vertices, corner) == 1);
    CHECK(std::ranges::count(named(surfaces, "base").vertices, Point3{0, 0, -(1234.1 + 0.1)}) == 1);
}

TEST_CASE("GRDECL: where columns differ there is a fault", "[io][grdecl]") {
    for (const double lean : {0.0, 300.0}) { // vertical pillars, and others
        const auto surfaces = read_grid(faulted(30, 30, lean).text());
        REQUIRE(names_of(surfaces) == "top, layer 2, base, fault 1, sides");
        const Surface& fault = named(surfaces, "fault 1");
        CHECK(fault.role == Role::fault);
        if (lean == 0) CHECK(area_of(fault) == Approx(100 * 130));
        CHECK(closed(surfaces));
    }
}

TEST_CASE("GRDECL: a fault that dies out, and one whose throw changes sign", "[io][grdecl]") {
    const auto dying = read_grid(faulted(0, 30).text());
    CHECK(area_of(named(dying, "fault 1")) == Approx(100 * (100 + 130) / 2.0));
    CHECK(closed(dying));
    for (const double lean : {0.0, 300.0}) {
        const auto scissor = read_grid(faulted(-30, 30, lean).text());
        CHECK(closed(scissor)); // where edges of both sides cross, they have a vertex in common
        if (lean == 0) {
            CHECK(area_of(named(scissor, "fault 1")) == Approx(100 * 115));
            CHECK(std::ranges::count(named(scissor, "top").vertices, Point3{100, 50, -1000}) == 1);
        }
    }
}

TEST_CASE("GRDECL: the throw is larger than a layer", "[io][grdecl]") {
    CHECK(closed(read_grid(faulted(-170, 320, 200).text()))); // many edges cross
    const auto surfaces = read_grid(faulted(70, 80).text());
    CHECK(closed(surfaces));
    CHECK(area_of(named(surfaces, "fault 1")) == Approx(100 * 175));
}

TEST_CASE("GRDECL: faults that hang together are one, others are apart", "[io][grdecl]") {
    TestGrid grid{5, 2, 1};
    grid.depth = [](int i, int, int, int, int level) {
        return 1000 + 50.0 * level + (i == 0 || i == 4 ? 20 : 0);
    };
    CHECK(names_of(read_grid(grid.text())) == "top, base, fault 1, fault 2, sides");
    grid.more = "FAULTS\n'west' 1 1 1 2 1 1 'X' /\neast 5 5 1 1 1 1 I- / one of two faces\n/\n";
    const auto surfaces = read_grid(grid.text());
    CHECK(names_of(surfaces) == "top, base, west, east, fault 1, sides");
    CHECK(named(surfaces, "west").triangles.size() > named(surfaces, "east").triangles.size());
}

TEST_CASE("GRDECL: cells that are not active bound nothing", "[io][grdecl]") {
    TestGrid grid{3, 3, 2};
    grid.more = "ACTNUM\n 4*1 0 13*1 /\n"; // a hole in the middle of layer 1
    const auto surfaces = read_grid(grid.text());
    CHECK(names_of(surfaces) == "top, layer 2, base, sides");
    CHECK(named(surfaces, "top").triangles.size() == 16);
    CHECK(named(surfaces, "layer 2").triangles.size() == 18);
    CHECK(area_of(named(surfaces, "sides")) == Approx(1200 * 100 + 400 * 50));
    CHECK(closed(surfaces));
    grid.more = "ACTNUM\n 18*0 /\n";
    CHECK(message_of_grid(grid.text()) == "a: no cell of the grid is active");
}

TEST_CASE("GRDECL: a gap between layers has a surface of its own", "[io][grdecl]") {
    const std::string text =
        "SPECGRID\n1 1 2 /\nCOORD\n0 0 0 0 0 9 1 0 0 1 0 9 0 1 0 0 1 9 1 1 0 1 "
        "1 9 /\nZCORN\n4*0 4*1 4*2 4*3 /\n";
    const auto surfaces = read_grid(text);
    CHECK(names_of(surfaces) == "top, layer 2, base, layer 1 base, sides");
    CHECK(named(surfaces, "layer 1 base").vertices[0].z == -1);
    CHECK(area_of(named(surfaces, "sides")) == Approx(8));
    CHECK(closed(surfaces));
}

TEST_CASE("GRDECL: rows that run south do not turn surfaces over", "[io][grdecl]") {
    const std::string text =
        "DIMENS\n1 1 1 /\nCOORD\n0 9 0 0 9 9 5 9 0 5 9 9 0 4 0 0 4 9 5 4 0 5 4 "
        "9 /\nZCORN\n4*0 4*1 /\n";
    const Surface top = read_grid(text)[0];
    for (const Triangle& t : top.triangles) {
        const Point3 a = top.vertices[t[0]], b = top.vertices[t[1]], c = top.vertices[t[2]];
        CHECK((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0);
    }
}

TEST_CASE("GRDECL: units and map axes", "[io][grdecl]") {
    TestGrid grid;
    grid.more = "GRIDUNIT\nMETRES /\nMAPAXES\n500 100 500 0 400 0 /\n";
    auto surfaces = read_grid(grid.text());
    CHECK(surfaces[0].frame.horizontal_unit == "m");
    CHECK(surfaces[0].frame.vertical_unit == "m");
    CHECK(surfaces[0].vertices[0] == Point3{500, 0, -1000});
    CHECK(std::ranges::count(surfaces[0].vertices, Point3{400, 100, -1000}) == 1);
    grid.more = "GRIDUNIT\n'FEET' 'MAP' /\nMAPUNITS\n'METRES' /\nMAPAXES\n500 100 500 0 400 0 /\n";
    surfaces = read_grid(grid.text());
    CHECK(surfaces[0].vertices[0] == Point3{0, 0, -1000});
    CHECK(surfaces[0].frame.horizontal_unit == "ft");
    grid.more = "GRIDUNIT\n'FEET' /\nMAPUNITS\n'METRES' /\nMAPAXES\n500 100 500 0 400 0 /\n";
    CHECK(message_of_grid(grid.text()) == "a: MAPUNITS is \"m\", but GRIDUNIT is \"ft\"");
}

TEST_CASE("GRDECL: other keywords are passed over", "[io][grdecl]") {
    const auto plain = read_grid(TestGrid{}.text());
    const auto text = "RUNSPEC\nTITLE\nZCORN of the north -- a title\nMETRIC\nGRID\nNOECHO\n"
                      "PINCH /\nCOORDSYS\n 1 1 /\n" +
                      TestGrid{}.text() +
                      "PORO\n 0.25 /\nEQUALS\n'PERMX' 100 /\nPERMY 10 1 1 /\n/\nEND\nCOORD\n";
    const auto surfaces = read_grid(text);
    REQUIRE(surfaces.size() == plain.size());
    CHECK(surfaces[2].vertices == plain[2].vertices);
    CHECK(surfaces[0].frame.vertical_unit == "m");
}

TEST_CASE("GRDECL: what can't be read is named with its line", "[io][grdecl]") {
    const std::string good = TestGrid{}.text();
    CHECK(message_of_grid("") == "a: there is no SPECGRID and no DIMENS, so this is no grid");
    CHECK(message_of_grid("COORD\n1 2 /\n") ==
          "a:1: COORD stands before SPECGRID, which tells how many cells there are");
    CHECK(message_of_grid("SPECGRID\n1 0 1 1 F /\n") ==
          "a:2: SPECGRID needs three numbers of cells, not \"0\"");
    CHECK(message_of_grid("SPECGRID\n1 1 1 2 F /\n") ==
          "a:2: SPECGRID: several reservoirs (\"2\") are not read");
    CHECK(message_of_grid("SPECGRID\n1 1 1 1 T /\n") ==
          "a:2: SPECGRID: radial grids (T) are not read, only Cartesian ones (F)");
    CHECK(message_of_grid("DIMENS\n2 1 1 /\nSPECGRID\n1 1 1 1 F /\n") ==
          "a:4: SPECGRID says 1 x 1 x 1 cells, but 2 x 1 x 1 were stated");
    CHECK(message_of_grid("SPECGRID\n90000 90000 1 1 F /\n") ==
          "a:2: the grid has more than 536870912 cells");
    CHECK(message_of_grid("SPECGRID\n900 900 9 1 F /\nCOORD\n4870806*0 /\n") ==
          "a:3: COORD x 4870806 values are more than 256 for each byte of the file");
    CHECK(message_of_grid("SPECGRID\n1 1 1 1 F /\nDX\n1*5 /\n") ==
          "a: there is no COORD; only corner-point grids are read, not DX, DY, DZ and TOPS");
    CHECK(message_of_grid(with(good, "1000 1000", "1000 nan")) ==
          "a:13: \"nan\" is not a finite number");
    CHECK(message_of_grid(with(good, "1000 1000", "1000 PORO")) ==
          "a:13: \"PORO\" is not a number");
    CHECK(message_of_grid(with(good, "1000 1000", "1000")) ==
          "a:14: ZCORN has 7 values; 1 x 1 x 1 cells need 8");
    CHECK(message_of_grid(with(good, "1000 1000", "1000 2*1000")) ==
          "a:13: ZCORN has more than the 8 values that 1 x 1 x 1 cells need");
    CHECK(message_of_grid(with(good, "1000 1000", "1000 x*1000")) ==
          "a:13: \"x*1000\" does not repeat a value, as in 3*0.5");
    CHECK(message_of_grid(with(good, "1000 1000", "1000 1*")) ==
          "a:13: ZCORN has no default values, as 3* would ask for");
    CHECK(message_of_grid(good.substr(0, good.size() - 2)) ==
          "a:13: the file ends within ZCORN, after 8 of 8 values");
    CHECK(message_of_grid(good + "ZCORN\n8*0 /\n") ==
          "a:15: ZCORN is there twice, first in line 12");
    CHECK(message_of_grid(good + "INCLUDE\n 'props.inc' /\n") ==
          "a:16: INCLUDE names the file \"props.inc\", which is not read; put its text in place of "
          "these lines");
    CHECK(message_of_grid(good + "CARFIN\n") ==
          "a:15: CARFIN: local grids are not read, only one grid");
    CHECK(message_of_grid(good + "EQUALS\n 'ACTNUM' 0 1 1 1 1 1 1 /\n/\n") ==
          "a:16: EQUALS changes ACTNUM, which is not done; write the values under ACTNUM itself");
    CHECK(message_of_grid(good + "FAULTS\n'F1' 1 2 1 1 1 1 'X' /\n/\n") ==
          "a:16: fault \"F1\" is at cells \"2\", but there are 1 x 1 x 1");
    CHECK(message_of_grid(good + "FAULTS\n'F1' 1 1 1 1 1 1 'W' /\n/\n") ==
          "a:16: fault \"F1\" is no row of faces X, Y or Z");
    CHECK(message_of_grid(good + "MAPAXES\n0 0 0 0 1 0 /\n") ==
          "a:16: MAPAXES: an axis has no direction");
}

TEST_CASE("GRDECL: leaning pillars, and numbers one in a line", "[io][grdecl]") {
    std::string text = "SPECGRID\n2 3 4 1 F \n/\nCOORD\n";
    for (const auto& [x, y] : std::vector<std::pair<int, int>>{{1000, 2000},
                                                               {1040, 2000},
                                                               {1120, 2000},
                                                               {1000, 2200},
                                                               {1100, 2200},
                                                               {1200, 2200},
                                                               {1000, 2600},
                                                               {1150, 2600},
                                                               {1300, 2600},
                                                               {1000, 3200},
                                                               {1200, 3200},
                                                               {1400, 3200}})
        text += fmt::format("{} {} 1000\n{} {} 1100\n", x, y, x + 100, y);
    text += "/\nZCORN\n";
    for (int level = 0; level < 8; ++level)
        for (int n = 0; n < 24; ++n) text += fmt::format("{}.0000\n", 1000 + (level + 1) / 2 * 100);
    text += "/\nLITHOLOGYTYPE\n1 2 3 4 5 6\n/\nAGE\n1.0 1.0\n/";
    const auto surfaces = read_grid(text);
    CHECK(names_of(surfaces) == "top, layer 2, layer 3, layer 4, base, sides");
    CHECK(surfaces[1].vertices[0] == Point3{1100, 2000, -1100});
    CHECK(surfaces[4].vertices[0] == Point3{1400, 2000, -1400});
    CHECK(closed(surfaces));
}
