// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include <terrane/io/files.hpp>
#include <terrane/io/text/bytes.hpp>

namespace leapfrog_test {

using namespace terrane;

namespace {

/// Appends a number in a byte order.
template <class T>
void append(std::string& out, T value, std::endian order) {
    std::string bytes;
    detail::store(bytes, value); // little endian
    if (order == std::endian::big) std::ranges::reverse(bytes);
    out += bytes;
}

/// A tent of 5 vertices and 4 triangles, with an array that is passed over.
std::string tent(std::endian order, std::uint32_t corner = 4, double x = 10) {
    std::string out =
        "%ARANZ-1.0\n\n[index]\nLocation Double 3 5;\nvalue Float 1 2;\nTri Integer 3 "
        "4;\n\n[binary]";
    out += "\xff\x0f\xf0";
    out += '\0';
    append(out, 1.23456789, order);
    for (const double c :
         {0.0, 0.0, 0.0, x, 0.0, 0.0, 10.0, 10.0, 0.0, 0.0, 10.0, 0.0, 5.0, 5.0, 4.0})
        append(out, c, order);
    for (const float value : {1.0F, 2.0F}) append(out, value, order);
    for (std::uint32_t i = 0; i < 4; ++i)
        for (const std::uint32_t v : {i, (i + 1) % 4, corner}) append(out, v, order);
    return out;
}

Result<std::vector<Surface>> read(const std::string& contents) {
    return parse_surfaces(contents, "a/tent.msh", Format::msh);
}

} // namespace

TEST_CASE("leapfrog: a mesh in either byte order") {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const auto surfaces = read(tent(order));
        REQUIRE(surfaces);
        REQUIRE(surfaces->size() == 1);
        const Surface& s = surfaces->front();
        CHECK(s.name == "tent");
        CHECK(s.vertices ==
              std::vector<Point3>{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {5, 5, 4}});
        CHECK(s.triangles == std::vector<Triangle>{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    }
}

TEST_CASE("leapfrog: what is cut off, damaged or empty is refused") {
    const std::string whole = tent(std::endian::little);
    for (std::size_t n = 11; n < whole.size(); ++n) CHECK_FALSE(read(whole.substr(0, n)));
    CHECK(read(tent(std::endian::little, 5)).error().code == ErrorCode::bad_index);
    CHECK(read(tent(std::endian::little, 4, HUGE_VAL)).error().code == ErrorCode::bad_number);
    std::string other = whole;
    other.replace(other.find("Tri Integer 3"), 13, "Tri Integer 4");
    CHECK_FALSE(read(other));
    other = whole;
    other.replace(other.find("Location Double 3 5"), 19, "Location Double 3 x");
    CHECK_FALSE(read(other));
    other = whole;
    other.replace(other.find("3 5;"), 4, "3 99999999999;");
    CHECK_FALSE(read(other));
    other = whole;
    other.replace(other.find("Tri"), 3, "Trx");
    CHECK(read(other).error().code == ErrorCode::nothing_to_do);
}

} // namespace leapfrog_test
