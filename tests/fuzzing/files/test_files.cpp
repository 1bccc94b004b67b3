// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Terrane's readers find what dirty files have.
#include <terrane/fuzzing/files.hpp>

#include <catch2/catch.hpp>

#include <terrane/io/files.hpp>

#include "fuzzing/hash.hpp"

using namespace terrane::fuzzing;
using terrane::Format;

namespace {

using Corners = std::vector<std::array<double, 3>>;

Corners corners_of(const Part& part) {
    Corners corners;
    for (const Triangle& t : part.triangles)
        for (const auto v : t) {
            const Point& p = part.points[v];
            corners.push_back({p.x, p.y, p.z});
        }
    return corners;
}

Corners corners_of(const std::vector<terrane::Surface>& surfaces) {
    Corners corners;
    for (const terrane::Surface& s : surfaces)
        for (const auto& t : s.triangles)
            for (const auto v : t)
                corners.push_back({s.vertices[v].x, s.vertices[v].y, s.vertices[v].z});
    return corners;
}

} // namespace

TEST_CASE("fuzzing: readers find the triangles of dirty files, to the last bit") {
    const std::array<std::pair<TextFormat, Format>, 5> formats{{{TextFormat::obj, Format::obj},
                                                                {TextFormat::off, Format::off},
                                                                {TextFormat::stl, Format::stl},
                                                                {TextFormat::ply, Format::ply},
                                                                {TextFormat::ts, Format::gocad}}};
    std::size_t files = 0;
    fuzzing_test::for_each_string([&](const std::vector<std::uint8_t>& string) {
        Bytes of_mesh(string.data(), string.size());
        const Soup made = soup(of_mesh, 12);
        for (const Part& part : made) {
            if (part.triangles.empty()) continue;
            for (const auto& [text_format, format] : formats) {
                Bytes bytes(string.data() + string.size() / 2, string.size() - string.size() / 2);
                const std::string text = dirty_file(bytes, part, text_format);
                INFO(text);
                const auto read = terrane::parse_surfaces(text, "dirty", format);
                REQUIRE((read ? "" : read.error().message()) == std::string());
                CHECK(corners_of(*read) == corners_of(part));
                ++files;
            }
        }
    });
    CHECK(files > 1000);
}
