// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests what files of sections call their parts; tests/cli/section_files.py reads them back as a whole.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include <terrane/io/sections/section_text.hpp>
#include <terrane/io/text/utf8.hpp>

using namespace terrane;

namespace {

/// A row of unit squares in the plane x, z, one per block, and a line below them.
Section row_of_squares(std::uint32_t count) {
    Section s;
    for (std::uint32_t k = 0; k <= count; ++k)
        for (const double z : {0.0, 1.0}) {
            s.vertices.push_back({double(k), 7, z});
            s.flat.push_back({double(k), z});
        }
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t v = 2 * k;
        s.polygons.push_back({BlockId(k + 1), BlockId(k + 1), {{v, v + 2, v + 3, v + 1}}, 1});
        s.triangles.push_back({v, v + 2, v + 3});
        s.triangles.push_back({v, v + 3, v + 1});
        s.polygon_of.insert(s.polygon_of.end(), 2, k);
    }
    s.lines.push_back({SurfaceId(0), {0, 2 * count}});
    return s;
}

SectionNames numbered_names(std::uint32_t count) {
    SectionNames names{{"outside"}, {""}, {{"base", Role::horizon}}};
    for (std::uint32_t k = 1; k <= count; ++k) {
        names.blocks.push_back("block " + std::to_string(k));
        names.units.emplace_back();
    }
    return names;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::size_t times(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
    return count;
}

} // namespace

TEST_CASE("section files: formats by their extensions") {
    CHECK(section_format(".svg") == SectionFormat::svg);
    CHECK(section_format(".GeoJSON") == SectionFormat::geojson);
    CHECK(!section_format(".vtp"));
    CHECK(!section_format(""));
}

TEST_CASE("section files: names with signs of the formats") {
    Section section = row_of_squares(1);
    SectionNames names = numbered_names(1);
    names.blocks[1] = "a, \"b\" <c> & d";
    names.surfaces[0].name = "x<y>\n0";
    names.title = "A < B";
    const auto svg = section_svg(section, names);
    CHECK(has(svg, "a, &quot;b&quot; &lt;c&gt; &amp; d"));
    CHECK(has(svg, "A &lt; B"));
    CHECK(!has(svg, "<c>"));
    const auto csv = section_csv(section, names);
    CHECK(has(csv, "\n1,outer,\"a, \"\"b\"\" <c> & d\",\"a, \"\"b\"\" <c> & d\",,,0,7,0,0,0\n"));
    CHECK(has(csv, "\n2,line,,,,\"x<y>\n0\",0,7,0,0,0\n"));
    CHECK(has(section_geojson(section, names), R"("block":"a, \"b\" <c> & d")"));
    const auto dxf = section_dxf(section, names);
    CHECK(has(dxf, "\na___b___c__&_d\n"));
    CHECK(has(dxf, "\nx_y__0\n"));
}

TEST_CASE("section files: a unit has one colour, and fills are hatched from the thirteenth on") {
    const Section section = row_of_squares(30);
    SectionNames names = numbered_names(30);
    const auto many = section_svg(section, names);
    CHECK(times(many, "<pattern id=") == 18);
    CHECK(times(many, "fill=\"url(#fill29)\"") == 2); // a polygon, and the legend
    CHECK(times(many, "fill-rule=\"evenodd\"") == 30);
    for (std::size_t k = 1; k < names.units.size(); ++k) names.units[k] = k < 20 ? "sand" : "clay";
    const auto units = section_svg(section, names);
    CHECK(times(units, "<pattern") == 0);
    CHECK(times(units, ">sand</text>") == 1);
    CHECK(times(units, ">clay</text>") == 1);
    CHECK(times(units, "#88ccee") == 20); // 19 polygons, and the legend
    CHECK(has(units, "<title>block 7</title>"));
    CHECK(has(units, ">base</text>"));
}

TEST_CASE("section files: the side that is shown") {
    Section section = row_of_squares(3);
    section.polygons[0].behind = BlockId(2);
    section.polygons[1].block = BlockId(0);
    section.polygons[2].behind = BlockId(0);
    SectionNames names = numbered_names(3);
    const auto shown = [&] {
        std::vector<std::uint32_t> blocks;
        for (const SectionPolygon& p : section.polygons) blocks.push_back(names.shown(p));
        return blocks;
    };
    CHECK(shown() == std::vector<std::uint32_t>{1, 2, 3}); // the outside is never shown
    names.shows_behind = true;
    CHECK(shown() == std::vector<std::uint32_t>{2, 2, 3});
    CHECK(section_mesh(section, names).surfaces_of[0][0] == 2);
    names.shows_behind = false;
    names.shows_pairs = true;
    CHECK(has(section_svg(section, names), ">block 1 | block 2</text>"));
    names.shows_heights = true;
    CHECK(has(section_svg(section, names), ">0</text>"));
    CHECK(!has(section_svg(section, names), ">base</text>"));
}

TEST_CASE("section files: a map has heights as third coordinates") {
    Section section = row_of_squares(1);
    CHECK(!is_map(section));
    CHECK(has(section_geojson(section, numbered_names(1)), "[[[0.0,0.0],[1.0,0.0],"));
    for (std::size_t v = 0; v < section.flat.size(); ++v)
        section.flat[v] = {section.vertices[v].x, section.vertices[v].y};
    CHECK(is_map(section));
    CHECK(has(section_geojson(section, numbered_names(1)), "[[[0.0,7.0,0.0],[1.0,7.0,0.0],"));
}

TEST_CASE("section files: drawings of one point, of large numbers and far away end") {
    Section section = row_of_squares(1);
    for (auto& p : section.flat) p = {1e300, 1e300};
    CHECK(has(section_svg(section, numbered_names(1)), "</svg>"));
    for (std::size_t v = 0; v < section.flat.size(); ++v)
        section.flat[v] = {5e15 + 2 * double(v), 5e15 + double(v % 2)};
    CHECK(has(section_svg(section, numbered_names(1)), "</svg>"));
    CHECK(has(section_svg(Section{}, numbered_names(1)), "</svg>"));
}

TEST_CASE("section files: names in Latin-1 become UTF-8 in all formats of text") {
    SectionNames names = numbered_names(2);
    names.blocks[1] = "bl\xf6"
                      "ck";
    names.units[1] = "gr\xe8s";
    names.surfaces[0].name = "caf\xe9";
    names.title = "\xe9t\xe9";
    for (const auto format :
         {SectionFormat::svg, SectionFormat::geojson, SectionFormat::csv, SectionFormat::dxf}) {
        const auto files = section_files(row_of_squares(2), names, format);
        REQUIRE(files);
        CHECK(detail::is_utf8(files->front().contents));
        CHECK(has(files->front().contents, "caf\ufffd"));
    }
}
