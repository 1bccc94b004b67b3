// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reads surfaces from texts and from tests/data.
#pragma once

#include "support/paths.hpp"

#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/io/files.hpp>

namespace test_support {

/// Reads a text or bytes as the contents of a file in `format`; a surface without a name is "a".
struct Reader {
    terrane::Format format;
    std::string_view file_name; ///< in messages: "a.obj"

    terrane::Result<std::vector<terrane::Surface>> operator()(std::string_view contents) const {
        return terrane::parse_surfaces(contents, file_name, format);
    }
};

/// Reads a file of tests/data.
inline std::vector<terrane::Surface> read_data(std::string_view name) {
    auto surfaces = terrane::read_surfaces(std::filesystem::path(test_support::test_data()) / name);
    INFO(name << (surfaces ? "" : ": " + surfaces.error().message()));
    REQUIRE(surfaces);
    return std::move(surfaces).value();
}

} // namespace test_support
