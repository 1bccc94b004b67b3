// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Scripts that replace TetGen's helper program and give the answers that a test wants.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stop_token>
#include <string>
#include <vector>

#include <unistd.h>

#include <catch2/catch.hpp>

#include <terrane/algorithms/tetgen/detail/process.hpp>
#include <terrane/algorithms/tetgen/detail/protocol.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

namespace impostor {

using namespace terrane;
using namespace terrane::tetgen::detail;

namespace fs = std::filesystem;

/// Returns the corners of a cube and its sides.
inline TetgenInput cube_input() {
    TetgenInput input;
    for (unsigned k = 0; k < 8; ++k)
        input.points.push_back({k & 1U ? 1.0 : 0, k & 2U ? 1.0 : 0, k & 4U ? 1.0 : 0});
    for (const auto& side : std::array<std::array<std::uint32_t, 4>, 6>{
             {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}})
        input.facets.push_back(side);
    input.time_limit = 1800; // for a hang
    return input;
}

inline std::size_t request_size(const TetgenInput& input) {
    return sizeof(RequestHeader) + input.points.size() * sizeof(Coordinates) +
           (input.facets.offsets.size() + input.facets.values.size()) * sizeof(std::uint32_t) +
           input.max_areas.size() * sizeof(double) + input.blocks.size() * sizeof(BlockRecord);
}

template <class T>
std::string bytes_of(const T& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

template <class T>
std::string bytes_of_all(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Returns the bytes of a reply that holds the output.
inline std::string reply_of(const TetgenOutput& output) {
    ReplyHeader header;
    header.points = output.points.size();
    header.tetrahedra = output.tetrahedra.size();
    header.faces = output.faces.size();
    std::vector<std::uint32_t> markers = output.face_facet;
    for (std::uint32_t& marker : markers) ++marker;
    return bytes_of(header) + bytes_of_all(output.points) + bytes_of_all(output.tetrahedra) +
           bytes_of_all(output.faces) + bytes_of_all(markers);
}

/// A script that replaces the helper, in a folder of its own.
class Impostor {
public:
    explicit Impostor(const std::string& lines) {
        auto name = (fs::temp_directory_path() / "terrane-impostor-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        folder_ = name;
        std::ofstream(path()) << "#!/bin/sh\n" << lines << "\n";
        fs::permissions(path(), fs::perms::owner_all);
    }
    /// Makes a script that reads the whole request, answers with the bytes, then runs the lines.
    Impostor(const std::string& reply, const TetgenInput& input, const std::string& lines = "") :
        Impostor("head -c " + std::to_string(request_size(input)) +
                 " >/dev/null\ncat \"${0%/*}/reply\"\n" + lines) {
        std::ofstream(folder_ / "reply", std::ios::binary) << reply;
    }
    ~Impostor() {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    Impostor(const Impostor&) = delete;
    Impostor& operator=(const Impostor&) = delete;

    [[nodiscard]] fs::path path() const { return folder_ / "terrane-tetgen"; }
    [[nodiscard]] Error fails(TetgenInput input, const std::stop_token& stop = {}) const {
        input.helper = path();
        const auto output = run_mesher(input, stop);
        REQUIRE_FALSE(output);
        return output.error();
    }
    [[nodiscard]] Error fails() const { return fails(cube_input()); }

private:
    fs::path folder_;
};

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

inline TetgenOutput true_output() {
    TetgenInput input = cube_input();
    input.helper = find_tetgen_helper().value();
    auto output = run_mesher(input, {});
    REQUIRE(output);
    return std::move(output).value();
}

} // namespace impostor
