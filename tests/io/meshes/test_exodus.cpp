// SPDX-License-Identifier: LGPL-3.0-or-later
//
// read_simulators.py opens such files with other programs' libraries.
#include <catch2/catch.hpp>

#include <vector>

#include <terrane/io/meshes/detail/netcdf.hpp>
#include <terrane/io/meshes/exodus.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;
using detail::NetcdfFile;

TEST_CASE("NetCDF: the bytes of a small file", "[io][exodus]") {
    NetcdfFile file;
    file.attribute("title", "hello");
    const auto n = file.dimension("n", 3);
    file.integers("v", {n}, std::vector<std::int32_t>{1, -2, 3});
    file.describe("unit", "m");
    using namespace std::string_literals;
    CHECK(file.contents().value() ==
          "CDF\2\0\0\0\0"s                             // no records
          "\0\0\0\x0a\0\0\0\1\0\0\0\1n\0\0\0\0\0\0\3"s // dimensions
          "\0\0\0\x0c\0\0\0\1\0\0\0\5title\0\0\0\0\0\0\2\0\0\0\5hello\0\0\0"s
          "\0\0\0\x0b\0\0\0\1\0\0\0\1v\0\0\0\0\0\0\1\0\0\0\0"s     // a variable and its dimension
          "\0\0\0\x0c\0\0\0\1\0\0\0\4unit\0\0\0\2\0\0\0\1m\0\0\0"s // its unit
          "\0\0\0\4\0\0\0\x0c\0\0\0\0\0\0\0\x84"s                  // integers, 12 bytes, from 132
          "\0\0\0\1\xff\xff\xff\xfe\0\0\0\3"s);
}

TEST_CASE("NetCDF: lists without entries, and records after all else", "[io][exodus]") {
    NetcdfFile empty;
    CHECK(empty.contents().value() == std::string("CDF\2", 4) + std::string(28, '\0'));
    NetcdfFile file;
    const auto time = file.dimension("time", 0);
    file.numbers("t", {time}, {});
    const auto n = file.dimension("n", 1);
    file.numbers("x", {n}, std::vector<double>{1.5});
    const auto bytes = file.contents().value();
    CHECK(bytes.ends_with(std::string("\x3f\xf8\0\0\0\0\0\0", 8)));
    const auto t = bytes.find("t\0\0\0", bytes.find(std::string("\0\0\0\x0b", 4)));
    CHECK(static_cast<unsigned char>(bytes[t + 35]) == bytes.size()); // where records would begin
}

TEST_CASE("Exodus: names that are longer than 32 characters are complete", "[io][exodus]") {
    auto mesh = two_tetrahedra();
    const std::string name(70, 'n'), block(90, 'b');
    mesh.surfaces[0].name = name;
    const std::vector<std::string> blocks{"outside", "", block};
    const auto text = to_exodus(mesh, blocks).value();
    CHECK(text.starts_with("CDF\2"));
    CHECK(text.find(name + "_front") != text.npos);
    CHECK(text.find(block) != text.npos);
    CHECK(text.find("block_") == text.npos);
    CHECK(text.find("_pairs_") == text.npos);
    CHECK(to_exodus(cut_tetrahedra()).value().find("base_pairs_back") != text.npos);
}
