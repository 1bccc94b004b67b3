// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests what is warned of, and above all what is not: unusual models that are right.
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include <terrane/algorithms/plausibility/plausibility.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

using namespace terrane;

namespace {

/// A square of 2 n^2 triangles at these heights; u and v are 0 to 1.
template <class Height>
Surface square(const char* name, double x, double y, double size, Height height) {
    constexpr std::uint32_t n = 8;
    Surface s;
    s.name = name;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double u = i / double(n), v = j / double(n);
            s.vertices.push_back({x + size * u, y + size * v, height(u, v)});
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto a = (n + 1) * j + i;
            s.triangles.push_back({a, a + 1, a + n + 2});
            s.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    return s;
}

Surface flat(const char* name, double z, double x = 0, double y = 0, double size = 1000) {
    return square(name, x, y, size, [z](double u, double v) { return z + u * v; });
}

/// A wall over the line from (x, 0) to (x, 1000), between two heights.
Surface wall(const char* name, double x, double low, double high) {
    Surface s = square(name, 0, 0, 1000, [&](double u, double) { return low + u * (high - low); });
    for (Point3& p : s.vertices) p.x = x;
    return s;
}

std::vector<Doubt> doubts(const std::vector<Surface>& surfaces,
                          const PlausibilityContext& context = {}) {
    std::vector<Doubt> found;
    for (const auto& w : find_doubts(surfaces, context)) found.push_back(w.doubt);
    return found;
}

using Doubts = std::vector<Doubt>;
const PlausibilityContext blocks{{}, true};

} // namespace

TEST_CASE("plausibility: unusual models that are right", "[plausibility]") {
    CHECK(doubts({}).empty());
    CHECK(doubts({Surface{}}).empty());
    const auto mountains = square("mountains", 0, 0, 1000, [](double u, double v) {
        return 400 + 900 * std::sin(3 * u) * v;
    });
    CHECK(doubts({mountains, flat("top", -300), flat("base", -1500)}, blocks).empty());
    const auto high_plain = flat("plain", 3900);
    CHECK(doubts({high_plain, flat("moho", -60000)}).empty());
    CHECK(doubts({flat("top", 100), flat("base", 50)}, blocks).empty()); // all above the sea
    CHECK(doubts({flat("a", -10), flat("b", -900, 1500)}).empty());      // side by side
    CHECK(doubts({flat("a", -10, 0, 0, 10), flat("b", -10, 11, 0, 1)}).empty());
    CHECK(doubts({flat("a", -10), flat("a", -11)}).empty()); // names are free
    const auto metres = square("rounded", 431000, 5834000, 800,
                               [](double u, double v) { return std::floor(-900 - 70 * u * v); });
    CHECK(doubts({metres}).empty());                    // whole metres are floats, too
    CHECK(doubts({wall("fault", 500, -9, 0)}).empty()); // no blocks wanted
}

TEST_CASE("plausibility: heights and depths", "[plausibility]") {
    const auto found =
        find_doubts(std::vector{flat("a", -1000), flat("b", 1200), flat("c", -1500)});
    REQUIRE(found.size() == 1);
    CHECK(found[0].doubt == Doubt::heights_mixed);
    CHECK(found[0].surfaces == std::vector{SurfaceId(1)});
    CHECK(found[0].message().find("z of b is between 1200 and 1201") == 0);
    Surface column = flat("a", 1000);
    column.frame.column_of_depths = true;
    CHECK(doubts({column}) == Doubts{Doubt::depths_unstated});
    for (Point3& p : column.vertices)
        p.z = -p.z; // a column of depths with negative values is heights
    CHECK(doubts({column}).empty());
    Surface down = flat("a", -1000), unstated = flat("b", -1200);
    down.frame.vertical_axis = VerticalAxis::down;
    CHECK(doubts({down, unstated}).empty());
}

TEST_CASE("plausibility: tops below bases are depths that no file states", "[plausibility]") {
    const std::vector<Surface> depths{flat("TopUpperReek", 1547), flat("topmidreek", 1700),
                                      flat("Base_Reek", 1933)};
    CHECK(doubts(depths) == Doubts{Doubt::depths_unstated});
    CHECK(doubts({flat("TopUpperReek", 1933), flat("topmidreek", 1700), flat("Base_Reek", 1547)})
              .empty());
    CHECK(doubts({flat("TopUpperReek", 1547), flat("topmidreek", 1933), flat("Base_Reek", 1700)})
              .empty());
    CHECK(doubts({flat("top", -1933), flat("base", -1547)}).empty());
    auto stated = depths;
    for (Surface& s : stated) s.frame.vertical_axis = VerticalAxis::up;
    CHECK(doubts(stated).empty());
}

TEST_CASE("plausibility: top and base", "[plausibility]") {
    const auto faults = std::vector{wall("F1", 300, -2000, 0), wall("F2", 700, -2000, 0)};
    const auto with = [&](std::vector<Surface> layers) {
        layers.insert(layers.end(), faults.begin(), faults.end());
        return layers;
    };
    CHECK(doubts(with({flat("base", -2000)}), blocks) == Doubts{Doubt::no_top});
    CHECK(doubts(with({flat("top", -10)}), blocks) == Doubts{Doubt::no_base});
    CHECK(doubts(faults, blocks) == Doubts{Doubt::no_top});
    CHECK(doubts(with({flat("top", -10), flat("base", -2000)}), blocks).empty());
    // Two halves of a top are one layer together.
    CHECK(doubts(with({flat("west", -10, 0, 0, 750), flat("east", -10, 260, 260, 740),
                       flat("base", -2000)}),
                 blocks)
              .empty());
    const auto box = box_boundary({0, 0, -9}, {1000, 1000, 9});
    REQUIRE(box);
    CHECK(doubts(with({flat("base", -5)}), {*box, true}).empty());
    // A closed surface encloses a block alone.
    const Surface body{"body",
                       Role::unknown,
                       {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}},
                       {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    CHECK(doubts({body}, blocks).empty());
    Surface open = body;
    open.triangles.pop_back();
    CHECK(doubts({open}, blocks).size() == 1);
}

TEST_CASE("plausibility: a volume of interest", "[plausibility]") {
    const std::vector<Surface> data{flat("a", -500), wall("F", 400, -600, -300)};
    const auto beside = box_boundary({2000, 0, -600}, {3000, 900, 0});
    const auto touching = box_boundary({1000, 0, -600}, {3000, 900, 0});
    REQUIRE((beside && touching));
    CHECK(doubts(data, {*beside, true}) == Doubts{Doubt::volume_without_data});
    CHECK(doubts(data, {*touching, true}).empty());
}

TEST_CASE("plausibility: copies, floats", "[plausibility]") {
    Surface first = flat("a", -10), other = first;
    std::reverse(other.triangles.begin(), other.triangles.end());
    for (Triangle& t : other.triangles) t = {t[1], t[0], t[2]};
    CHECK(doubts({first, other}) == Doubts{Doubt::duplicate_surface});
    other.triangles.pop_back();
    CHECK(doubts({first, other}).empty());
    other = first;
    other.vertices.back().z = std::nextafter(other.vertices.back().z, 0);
    CHECK(doubts({first, other}).empty());

    const auto narrow = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    Surface utm = square("utm", 431000.3, 5834000.7, 800,
                         [](double u, double v) { return -900.123 - 70 * u * v; });
    CHECK(doubts({utm}).empty());
    for (Point3& p : utm.vertices) p = {narrow(p.x), narrow(p.y), narrow(p.z)};
    CHECK(doubts({utm}) == Doubts{Doubt::float32});
    Surface local = utm; // near the origin, floats are fine enough
    for (Point3& p : local.vertices) p = {narrow(p.x - 431000), narrow(p.y - 5834000), narrow(p.z)};
    CHECK(doubts({local}).empty());
}
